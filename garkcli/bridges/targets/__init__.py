"""The targets of ``gark export``: each file has one or more ``Bridge`` values in ``BRIDGES``."""
