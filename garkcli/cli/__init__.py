"""The command line: ``main`` is the entry point of ``gark``."""

from garkcli.cli.main import main

__all__ = ["main"]
