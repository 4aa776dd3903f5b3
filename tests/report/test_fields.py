"""Every field of every JSON report says what it holds."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from garkcli.check.meanings import explain
from garkcli.glossary import read
from garkcli.glossary.fields import ORDERS, field_entries
from garkcli.report.schemas import REPORTS, report_schema, text_of
from tests.docs.tables import fields_of
from tests.whole import in_whole


@pytest.fixture(scope="module")
def paths() -> set[tuple[str, ...]]:
    """The path of every field of every report."""
    return {path for report in REPORTS for path, _ in fields_of(report_schema(report), (report,))}


def _described(node: Any) -> Iterator[tuple[str, Any]]:
    if isinstance(node, list):
        for part in node:
            yield from _described(part)
    if isinstance(node, dict):
        for word, part in node.items():
            if word == "properties":
                yield from part.items()
                yield from _described(list(part.values()))
            else:
                yield from _described(part)


def test_every_field_has_a_text(paths: set[tuple[str, ...]]) -> None:
    """No report has a field of which nothing is said."""
    assert len(paths) > 1500
    assert {path for path in paths if not text_of(path)} == set()


def test_no_entry_is_of_no_field(paths: set[tuple[str, ...]]) -> None:
    """Each entry is of a field that a report has."""
    names = {path[-1] for path in paths}
    names |= {".".join(path[-2:]) for path in paths}
    entries = {x for x in read("fields") if not x.startswith("_")}
    assert entries - names == set()
    assert set(ORDERS) <= names


def test_schemas_tell_their_fields() -> None:
    """The schema that is printed has the texts, and keeps what it says of numbers."""
    schema = report_schema("check")
    for name, field in _described(schema):
        assert field["description"].strip(), name
    file = schema["properties"]["files"]["items"]
    shown = [x for x in _described(file) if x[0] == "residual"]
    assert any("An exact number" in x["description"] for _, x in shown)


VERDICTS = {"verdict", "relation", "trend", "proof", "among"}
"""Fields whose values say in a word what was found."""


def test_every_verdict_is_a_word() -> None:
    """What a report says was found is a word of gark explain."""
    found = set()
    for report in REPORTS:
        for path, schema in fields_of(report_schema(report), (report,)):
            if path[-1] in VERDICTS:
                found |= {x for x in schema.get("enum", []) if x}
    assert len(found) > 15
    for word in found:
        assert explain(word), word


@in_whole
def test_every_field_is_a_word() -> None:
    """What gark explain tells: each field, as a term, a claim or a key, or by its entry."""
    for name, text in field_entries().items():
        assert text.endswith("."), name
        assert explain(name), name
    (found,) = explain("simplifying")
    assert (found.kind, found.name) == ("field of JSON reports", "simplifying")


HOMONYMS = {
    ("trees", "trees", "gamma"): "density",
    ("conditions", "conditions", "gamma"): "density",
    ("check", "files", "properties", "gamma"): "implicit stage",
    ("converge", "steps", "error"): "at the end",
    ("sweep", "best", "error"): "error coefficients",
    ("check", "files", "colours"): "by their names",
    ("list-methods", "colours"): "The number",
    ("check", "files", "witness", "order"): "vertices",
    ("check", "files", "order"): "order conditions",
    ("check", "files", "order", "fact", "where"): "parameter",
    ("show", "publication", "where"): "in the work",
    ("show", "publication", "note"): "Further information",
    ("converge", "note"): "visible order",
    ("design-search", "methods", "residual"): "power of ten",
    ("show", "title"): "the method",
    ("show", "publication", "title"): "publication",
}
"""Fields whose name means something else in another place, with a word of their text."""


def test_a_name_is_told_by_its_place(paths: set[tuple[str, ...]]) -> None:
    """What a field holds is not what a claim, a column or a key of the same name is."""
    for path, word in HOMONYMS.items():
        assert path in paths
        assert word in text_of(path), path
