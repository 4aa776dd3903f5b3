"""Untrusted text made harmless for terminals, the log of GitHub Actions and spreadsheets.

Names of files and methods, and quoted lines of files, come from others. Every report writes them
through this module.
"""

from __future__ import annotations

import re

_COMMAND = r"^([^\S\n]*):(?=:)"
"""A line that GitHub Actions takes for a workflow command: it begins with two colons."""
_OLD_COMMAND = r"##(?=\[)"
"""The older form of these commands, which may be anywhere in a line."""
_FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""The characters that start a formula in spreadsheets."""


def inert(text: str) -> str:
    r"""Returns text with the lines escaped that GitHub Actions would take for commands.

    >>> print(inert("::error::no"))
    \x3a:error::no
    """
    return re.sub(_OLD_COMMAND, r"#\\x23", re.sub(_COMMAND, r"\1\\x3a", text, flags=re.MULTILINE))


def csv_cell(text: str) -> str:
    """Returns a name as a CSV cell that is never a formula; numbers are unchanged.

    >>> csv_cell("=1+1"), csv_cell("-1.5e-3")
    ("'=1+1", '-1.5e-3')
    """
    if not text.startswith(_FORMULA):
        return text
    try:
        float(text)
    except ValueError:
        return f"'{text}"
    return text
