"""Files of other formats in place of YAML: programs, LaTeX, CSV, tables as text."""

from __future__ import annotations

import re

from garkcli.errors import printable

MOST_LOOKED_AT = 20_000
_READS = "gark import {file} reads it"
_PASTED = "gark new FILE --tableau - < {file} makes a method file of it"
_PROGRAMS = (
    ".c",
    ".h",
    ".cc",
    ".cpp",
    ".cxx",
    ".hpp",
    ".hh",
    ".cu",
    ".jl",
    ".py",
    ".f90",
    ".m",
    ".wl",
    ".rs",
    ".java",
)
_LOOKS: tuple[tuple[str, str], ...] = (
    (
        r"\\(begin|frac|dfrac|hline|sqrt)\b|\\\\\s*$",
        f"this looks like LaTeX: {_READS}, and in a method file write 1/2",
    ),
    (
        r"^[ \t]*([Abc]|b?hat|bt?|embedded):[-\[0-9]",
        "put a blank behind the colon: A: [[0, 0], [1/2, 0]]",
    ),
    (r"^[ \t]*//", "comments begin with #"),
    (r"^[ \t]*%", "comments begin with #"),
    (
        r"^[^:#\n]*\w[ \t]*=[ \t]*[\[({\w]",
        f"this looks like a program: {_READS}; a method file has A: in place of A =",
    ),
)
"""Patterns of files that are not YAML, and the cures; the first match counts."""
_WITHOUT_KEYS: tuple[tuple[str, str], ...] = (
    (r"^[ \t]*([-+0-9/.]*[0-9][ \t]*[|│]|[|│][ \t]*[-+0-9])", _PASTED),
    (r"^[-+0-9/.]*,[-+0-9/., ]*$", f"this looks like CSV: {_READS}"),
    (r"\A[-+0-9/. \t\n]+\Z", _PASTED),
)


def cure_of_foreign(text: str, name: str, is_yaml: bool) -> str:
    """A cure for a file that is not a YAML mapping; empty if its kind is not recognised.

    >>> cure_of_foreign("A = [0 0; 1/2 0];", "m.txt", True)
    'this looks like a program: gark import m.txt reads it; a method file has A: in place of A ='
    >>> cure_of_foreign("// rk4", "rk4.cpp", True)
    'this is a program: gark import rk4.cpp reads it'
    >>> cure_of_foreign("hello", "m.yaml", True)
    ''
    """
    if name.lower().endswith(_PROGRAMS):
        return f"this is a program: {_READS}".replace("{file}", printable(name))
    looked_at = text[:MOST_LOOKED_AT]
    looks = (*_LOOKS, *_WITHOUT_KEYS) if is_yaml else _LOOKS
    for pattern, cure in looks:
        if re.search(pattern, looked_at, re.MULTILINE):
            file = "FILE" if name.startswith("<") else printable(name)
            return cure.replace("{file}", file)
    return ""
