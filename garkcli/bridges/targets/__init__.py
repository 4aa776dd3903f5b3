"""The targets of ``gark export``: each file has its ``Bridge`` values in ``BRIDGES``."""
