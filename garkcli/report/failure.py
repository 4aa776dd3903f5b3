"""Why a file cannot be used, or a run has failed."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from garkcli.errors import Fault
from garkcli.tell.facts import Row, Section, maybe
from garkcli.tell.kinds import POSITION, TEXT
from garkcli.tell.parts import parts

FAULT: Section[Fault] = Section(
    maybe("line", POSITION, lambda f: f.line or None),
    maybe("column", POSITION, lambda f: f.column or None),
    Row("code", TEXT, lambda x: x.code),
    Row("message", TEXT, lambda x: x.message),
    Row("help", TEXT, lambda x: x.help),
)
"""A fault and its cure; the place is null where the whole file is meant."""


class Failure(NamedTuple):
    """A run without a result."""

    name: str
    faults: Sequence[Fault]


FAILURE: Section[Failure] = Section(
    Row("name", TEXT, lambda x: x.name), Row("errors", parts(FAULT), lambda x: x.faults)
)
"""The report of such a run, for programs; people read it elsewhere."""
