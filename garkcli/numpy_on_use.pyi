"""numpy's names, for type checkers."""

from numpy import *  # noqa: F403
