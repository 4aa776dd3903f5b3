"""Terminals: which streams are terminals, and their width."""

from __future__ import annotations

import os

TERMINAL = 80
"""The width of texts for people where no terminal says its own."""


def is_terminal(stream: object) -> bool:
    isatty = getattr(stream, "isatty", None)
    return bool(isatty is not None and isatty())


def is_drawn_on(stream: object) -> bool:
    return is_terminal(stream) and os.environ.get("TERM") != "dumb"


def width_of_terminal() -> int:
    from shutil import get_terminal_size

    return get_terminal_size((TERMINAL, 24)).columns
