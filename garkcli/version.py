"""The version of the package, for what is below it too."""

__version__ = "0.1.0"
