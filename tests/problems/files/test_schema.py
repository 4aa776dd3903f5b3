"""The JSON Schema of problem files: what loads is allowed, and slips of a single value are not."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import yaml
from jsonschema import Draft7Validator

from garkcli.errors import MethodFileError
from garkcli.problems.files.keys import KEYS, problem_file_schema
from garkcli.problems.files.load import loads_problem
from tests.cli.harness import gark
from tests.docs.test_problem_file_docs import FILES

SCHEMA = problem_file_schema()
VALIDATOR = Draft7Validator(SCHEMA)
PROBLEMS = Path(__file__).resolve().parents[3] / "problems"
RIGHT = [*FILES, *(path.read_text(encoding="utf-8") for path in sorted(PROBLEMS.glob("*.yaml")))]
GOOD: dict[str, Any] = {
    "variables": ["x"],
    "hamiltonian": "px**2",
    "initial": {"x": 1, "px": "1/2"},
}


def test_the_schema_is_one() -> None:
    """Valid draft-07, with the keys of the loader; the command writes it."""
    Draft7Validator.check_schema(SCHEMA)
    assert set(SCHEMA["properties"]) == set(KEYS)
    assert json.loads(gark("schema", "--problem").out) == SCHEMA
    both = gark("schema", "--problem", "--report")
    assert both.code == 2
    assert "2 schemas" in both.err


@pytest.mark.parametrize("text", RIGHT)
def test_what_loads_is_allowed(text: str) -> None:
    """Every example of the page and of the folder."""
    assert [error.message for error in VALIDATOR.iter_errors(yaml.safe_load(text))] == []


@pytest.mark.parametrize(
    "change",
    [
        {"variables": []},
        {"variables": ["pi"]},
        {"variables": ["2x"]},
        {"variables": ["i"], "hamiltonian": "pi**2 + i**2", "initial": {"i": 1, "pi": 0}},
        {"variables": ["x", "x"]},
        {"variables": ["x" * 31]},
        {"variables": None},
        {"hamiltonian": None},
        {"hamiltonian": []},
        {"hamiltonian": "x²"},
        {"hamiltonian": True},
        {"lagrangian": "vx**2"},
        {"initial": [1, 0]},
        {"initial": {"x": [1], "px": 0}},
        {"initial": {"x": "a b ?", "px": 0}},
        {"parameters": {"sin": 1}},
        {"parameters": {"a": True}},
        {"invariants": {f"j{i}": "x" for i in range(11)}},
        {"gark": 2},
        {"name": ["a"]},
        {"unknown": 1},
    ],
)
def test_slips_are_refused_by_both(change: dict[str, Any]) -> None:
    """By the schema, and by the loader."""
    changed = {key: value for key, value in {**GOOD, **change}.items() if value is not None}
    assert not VALIDATOR.is_valid(changed)
    with pytest.raises(MethodFileError):
        loads_problem(yaml.safe_dump(changed))


def test_the_file_that_is_changed_is_good() -> None:
    """So that each change is what is refused."""
    assert VALIDATOR.is_valid(GOOD)
    assert loads_problem(yaml.safe_dump(GOOD))
