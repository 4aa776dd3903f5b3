"""The command line; ``gark`` runs ``main``."""

import gc

OBJECTS_BETWEEN_COLLECTIONS = 50_000
# few objects are in circles: to look for them as often as Python does costs a tenth of a start
gc.set_threshold(OBJECTS_BETWEEN_COLLECTIONS, 10, 10)

from garkcli.cli.main import main  # noqa: E402 -- the imports are the files to look through

__all__ = ["main"]
