"""JSON objects that are declared field by field: the document and its schema agree."""

from __future__ import annotations

from dataclasses import dataclass

import pytest
from jsonschema import Draft7Validator

from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import COUNT, TEXT, array, nullable


@dataclass(frozen=True)
class _Stage:
    number: int
    note: str | None = None


@dataclass(frozen=True)
class _Method:
    name: str
    stages: tuple[_Stage, ...] = ()


_STAGE: Record[_Stage] = Record(
    Field("number", COUNT, lambda x: x.number),
    Field("note", TEXT, lambda x: x.note, is_optional=True),
)
_METHOD: Record[_Method] = Record(
    Field("name", nullable(TEXT), lambda x: x.name or None),
    _STAGE.every("stages", lambda x: x.stages),
)
_SAMPLES = [
    _Method(""),
    _Method("heun", (_Stage(1),)),
    _Method("heun", (_Stage(1), _Stage(2, "last"))),
]


@pytest.mark.parametrize("method", _SAMPLES)
def test_documents_keep_to_their_schema(method: _Method) -> None:
    """Whatever is there or missing, the document is as the schema of the same fields says."""
    Draft7Validator.check_schema(_METHOD.schema)
    assert Draft7Validator(_METHOD.schema).is_valid(_METHOD.data(method))


def test_what_is_missing_is_null_or_left_out() -> None:
    """A field that may be left out is; others are null."""
    assert _METHOD.data(_SAMPLES[0]) == {"name": None, "stages": []}
    stages = [{"number": 1}, {"number": 2, "note": "last"}]
    assert _METHOD.data(_SAMPLES[2]) == {"name": "heun", "stages": stages}


def test_the_schema_is_closed_and_needs_its_fields() -> None:
    """Other fields, missing ones and other types are refused, unless the record is open."""
    allowed = Draft7Validator(_STAGE.schema).is_valid
    assert allowed({"number": 1})
    assert not allowed({"number": 1, "mood": "good"})
    assert not allowed({"note": "last"})
    assert not allowed({"number": "1"})
    is_open: Record[_Stage] = Record(*_STAGE.fields, is_open=True)
    assert Draft7Validator(is_open.schema).is_valid({"number": 1, "mood": "good"})


def test_null_is_allowed_of_any_schema() -> None:
    """Numbers, texts, lists and objects that may be null are as before, or null."""
    for schema, value in (
        (COUNT, 3),
        (TEXT, "b"),
        (array(COUNT), [1, 2]),
        (_STAGE.schema, {"number": 1}),
    ):
        allowed = Draft7Validator(nullable(schema)).is_valid
        assert allowed(value)
        assert allowed(None)
        assert not allowed({"mood": "good"})
        assert not Draft7Validator(schema).is_valid(None)


def test_a_report_begins_with_the_name_of_its_schema() -> None:
    """The schema admits that name alone, and the text is the document with a final newline."""
    report: Record[_Stage] = Record(schema_named("a/1"), *_STAGE.fields)
    assert report.text(_Stage(3)) == ('{\n  "schema": "a/1",\n  "number": 3\n}\n')
    check = Draft7Validator(report.schema)
    assert check.is_valid({"schema": "a/1", "number": 3})
    assert not check.is_valid({"schema": "a/2", "number": 3})
