"""Files that are something else than YAML: what they look like, and what to do with them."""

from __future__ import annotations

import re

from garkcli.errors import printable

MOST_LOOKED_AT = 20_000
"""Characters of a file that are looked at."""
_READS = "gark import {file} reads it"
_PASTED = "gark new FILE --tableau - < {file} makes a method file of it"
_LOOKS: tuple[tuple[re.Pattern[str], str], ...] = tuple(
    (re.compile(pattern, re.MULTILINE), cure)
    for pattern, cure in (
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
)
"""What a text has that is none of a method file, and the cure; the first that is found counts."""
_WITHOUT_KEYS: tuple[tuple[re.Pattern[str], str], ...] = tuple(
    (re.compile(pattern, re.MULTILINE), cure)
    for pattern, cure in (
        (r"^[ \t]*([-+0-9/.]*[0-9][ \t]*[|│]|[|│][ \t]*[-+0-9])", _PASTED),
        (r"^[-+0-9/.]*,[-+0-9/., ]*$", f"this looks like CSV: {_READS}"),
        (r"\A[-+0-9/. \t\n]+\Z", _PASTED),
    )
)
"""The same of a text that is read as YAML, but has no keys."""


def cure_of_foreign(text: str, name: str, is_yaml: bool) -> str:
    r"""What to do with a file that is no YAML mapping; empty where it looks like nothing known.

    Args:
        text: of the file.
        name: what it is called.
        is_yaml: whether it is YAML all the same, a text or a list.

    >>> cure_of_foreign("A = [0 0; 1/2 0];", "m.m", True)
    'this looks like a program: gark import m.m reads it; a method file has A: in place of A ='
    >>> cure_of_foreign("hello", "m.yaml", True)
    ''
    """
    looked_at = text[:MOST_LOOKED_AT]
    looks = (*_LOOKS, *_WITHOUT_KEYS) if is_yaml else _LOOKS
    for pattern, cure in looks:
        if pattern.search(looked_at):
            file = "FILE" if name.startswith("<") else printable(name)
            return cure.replace("{file}", file)
    return ""
