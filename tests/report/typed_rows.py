"""Rows that are wrong: mypy refuses each of them, or this file for an ignore that nothing needs."""

from __future__ import annotations

from typing import NamedTuple

from garkcli.tell.facts import Answer, Row, Rows, Section, maybe, via
from garkcli.tell.kinds import COUNT, TEXT
from garkcli.tell.parts import answer, parts, told


class Leaf(NamedTuple):
    """A part of a result."""

    size: int


class Result(NamedTuple):
    """A result."""

    name: str
    first: Leaf | None
    leaves: tuple[Leaf, ...] = ()


LEAF: Section[Leaf] = Section(
    Row("size", COUNT, lambda x: x.size),
    Row("bulk", COUNT, lambda x: x.bulk),  # type: ignore[attr-defined]
)
OF_LEAF: Rows[Leaf] = (
    Row("size", COUNT, lambda x: Answer(x.size)),
    Row("bulk", COUNT, lambda x: x.bulk),  # type: ignore[attr-defined]
)
RESULT: Section[Result] = Section(
    answer(lambda x, d: d.prose(x.title)),  # type: ignore[attr-defined]
    Row("name", TEXT, lambda x: x.nam),  # type: ignore[attr-defined]
    Row("name", COUNT, lambda x: x.name),  # type: ignore[arg-type, return-value]
    Row("name", told(lambda x, d: d.prose(x.siz)), lambda x: x.first),  # type: ignore[attr-defined]
    maybe("first", COUNT, lambda x: x.first.size),  # type: ignore[union-attr]
    via(lambda x: x.fist, OF_LEAF),  # type: ignore[attr-defined]
    via(lambda x: x.first, OF_LEAF),
    Row("leaves", parts(LEAF), lambda x: x.leaves),
    Row("leaves", parts(LEAF), lambda x: x.name),  # type: ignore[arg-type, return-value]
    title=lambda x, d: d.prose(x.titel),  # type: ignore[attr-defined]
)
