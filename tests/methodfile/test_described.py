"""What schemas say of keys: every key has its meaning, an example that is right, its default."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from typing import Any

import pytest
from jsonschema import Draft7Validator

from garkcli.check.meanings import explain
from garkcli.cli.project import project_schema
from garkcli.glossary.key import KINDS, keys_of
from garkcli.methodfile.file_keys import method_file_schema
from garkcli.problems.files.keys import problem_file_schema
from garkcli.sweep.file import sweep_schema

SCHEMAS = {
    "method": method_file_schema,
    "problem": problem_file_schema,
    "sweep": sweep_schema,
    "project": project_schema,
}


def every_key(part: Any) -> Iterator[tuple[str, Any]]:
    """The keys in a schema, wherever they are allowed."""
    if isinstance(part, list):
        for item in part:
            yield from every_key(item)
    if not isinstance(part, dict):
        return
    for word, item in part.items():
        if word == "properties":
            for name, value in item.items():
                if isinstance(value, dict):  # others are barred
                    yield name, value
                    yield from every_key(value)
        elif word == "definitions":
            for value in item.values():
                yield from every_key(value)
        elif word not in {"if", "then", "not"}:
            yield from every_key(item)


@pytest.mark.parametrize("kind", SCHEMAS)
def test_every_key_is_described(kind: str) -> None:
    """Each key of a schema says what it is, and has an example that it allows itself."""
    schema = SCHEMAS[kind]()
    definitions = schema.get("definitions", {})
    found = list(every_key(schema))
    assert len(found) > 4
    for name, key in found:
        assert key["description"].endswith("."), name
        validator = Draft7Validator({**key, "definitions": definitions})
        examples = [*key["examples"], *([key["default"]] if "default" in key else [])]
        for example in examples:
            assert validator.is_valid(example), (name, example)


def test_keys_of_projects_are_toml() -> None:
    """The example of each key of .gark.toml is TOML that the schema allows."""
    validator = Draft7Validator(project_schema())
    for name, key in keys_of("project").items():
        table = tomllib.loads(key.example)
        assert list(table) == [name]
        assert validator.is_valid(table)


def test_every_key_is_a_word() -> None:
    """Keys are found by their paths and by their own names, also in files of other kinds."""
    for kind, files in KINDS.items():
        for path in keys_of(kind):
            name = path.rpartition(".")[2]
            is_word = keys_of(kind)[path].is_word and len(name) > 1
            for word in (path, name) if is_word else (path,):
                found = {(x.kind, x.name) for x in explain(word)}
                assert (f"key of {files.files}", path) in found, word
