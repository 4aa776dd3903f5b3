"""The words of a file, as they are shown in messages and as they were meant."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.errors import nearest

_OTHER_WORDS = {
    "weights": "b",
    "weight": "b",
    "nodes": "c",
    "abscissae": "c",
    "abscissas": "c",
    "matrix": "A",
    "coefficients": "A",
    "title": "name",
    "method": "methods",
    "params": "parameters",
    "butcher": "tableau",
    "claims": "expect",
}
"""What people call keys besides their names."""


def meant_key(key: str, known: Sequence[str]) -> str:
    """The key that an unknown one stands for; empty where it is none of them."""
    other = _OTHER_WORDS.get(key.lower(), "")
    return other if other in known else nearest(key, known)


def one_line(text: str) -> str:
    r"""A name as it can stand in a heading: blanks for line ends and for what a terminal would act
    on.

    >>> one_line("Gauss 2\n  and \x1b more")
    'Gauss 2 and more'
    """
    signs = [x if x.isprintable() else " " for x in text]
    words = "".join(signs).split()
    return " ".join(words)


def unquoted(name: str) -> str:
    """A name of the file, cut where it is long; in quotes where it is no plain word.

    >>> unquoted("tau"), unquoted("no name")
    ('tau', "'no name'")
    """
    shown = shortened(name)
    is_word = name.isidentifier() or not name
    return shown[1:-1] if is_word else shown


def shortened(text: str, length: int = 60) -> str:
    """``text`` in quotes, cut where it is long."""
    if len(text) > length:
        text = text[:length] + "…"
    return repr(text)
