"""The terms, a file a topic; a file is found by its ``TERMS``."""
