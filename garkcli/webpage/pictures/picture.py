"""A picture of the report, or why there is none."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Picture:
    """A picture of one method.

    Attributes:
        name: what it is of, a word for addresses and classes.
        title: its heading, a few words.
        description: what one sees, for those who do not see it.
        svg: the element, without ids and in the colours of the page; empty where there is no
            picture.
        note: a sentence below it; why there is none where it is missing.
    """

    name: str
    title: str
    description: str
    svg: str
    note: str


class NotDrawn(Exception):
    """A picture that a method has not. The text says why, as a sentence; it is empty where nobody
    would expect one.
    """
