"""The words of a file, as they are shown in messages and as they were meant."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from garkcli.errors import nearest


def meant_key(key: str, known: Sequence[str], words: Mapping[str, str]) -> str:
    """The key that an unknown one stands for; empty where it is none of them.

    Args:
        key: as it is written.
        known: the keys there are.
        words: what people call some of them besides.
    """
    return words.get(key.lower(), "") or nearest(key, known)


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
