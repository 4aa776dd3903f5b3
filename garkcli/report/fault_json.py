"""Why a file cannot be used, or a run has failed, in JSON reports."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from garkcli.errors import Fault
from garkcli.glossary.faults import code_of
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import POSITION, TEXT, nullable

FAULT: Record[Fault] = Record(
    Field("line", nullable(POSITION), lambda x: x.line or None),
    Field("column", nullable(POSITION), lambda x: x.column or None),
    Field("code", TEXT, lambda x: code_of(x.message)),
    Field("message", TEXT, lambda x: x.message),
    Field("help", TEXT, lambda x: x.help),
)
"""A fault and its cure; the place is null where the whole file is meant."""


class Failure(NamedTuple):
    """A run that has no result: of which method, and why."""

    name: str
    faults: Sequence[Fault]


def failure_form(schema: str) -> Record[Failure]:
    """The report of such a run, in place of the one that is called ``schema``."""
    return Record(
        schema_named(schema),
        Field("name", TEXT, lambda x: x.name),
        FAULT.every("errors", lambda x: x.faults),
    )
