"""The version of the package, for what is below it too."""

__version__ = "1.0.0"
