"""Text from strangers made harmless: for terminals, the log of GitHub Actions, spreadsheets.

Names of files and methods, and lines of files that are shown, are not ours. Every report writes
them through here.
"""

from __future__ import annotations

import re

_COMMAND = r"^([^\S\n]*):(?=:)"
"""A line that GitHub Actions takes for a workflow command: it begins with two colons."""
_OLD_COMMAND = r"##(?=\[)"
"""The older form of these commands, which is sought anywhere in a line."""
_FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""What a spreadsheet takes for the beginning of a formula."""


def inert(text: str) -> str:
    r"""Lines of a report that GitHub Actions would take for commands, written as text.

    >>> print(inert("::error::no"))
    \x3a:error::no
    """
    return re.sub(_OLD_COMMAND, r"#\\x23", re.sub(_COMMAND, r"\1\\x3a", text, flags=re.MULTILINE))


def csv_cell(text: str) -> str:
    """A name as the cell of a CSV file: never a formula; numbers stay as they are.

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
