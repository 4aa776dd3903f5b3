"""Why a file cannot be used, in JSON reports."""

from __future__ import annotations

from garkcli.errors import Fault
from garkcli.glossary.faults import code_of
from garkcli.page.record import Field, Record
from garkcli.page.schema import POSITION, TEXT, nullable

FAULT: Record[Fault] = Record(
    Field("line", nullable(POSITION), lambda x: x.line or None),
    Field("column", nullable(POSITION), lambda x: x.column or None),
    Field("code", TEXT, lambda x: code_of(x.message)),
    Field("message", TEXT, lambda x: x.message),
    Field("help", TEXT, lambda x: x.help),
)
"""A fault and its cure; the place is null where the whole file is meant."""
