"""Every report for programs keeps to the schema that is published of it, on many methods and
problems, and the schema refuses what is not such a report.
"""

from __future__ import annotations

import json
import os
import re
from copy import deepcopy
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft7Validator

from garkcli.report.schemas import REPORTS, report_schema
from tests.cli.harness import NAMES, ROOT, gark
from tests.whole import sample

METHODS = [f"methods/{path.name}" for path in sorted(ROOT.glob("methods/*.gark.yaml"))]
EXAMPLES = [
    f"tests/examples/{folder}/{path.name}"
    for folder in ("valid", "failing")
    for path in sorted(ROOT.glob(f"tests/examples/{folder}/*.gark.yaml"))
]
FILES = sample([*METHODS[::3], *EXAMPLES[::6], EXAMPLES[-1]], 2)
PROBLEMS = [f"problems/{path.name}" for path in sorted(ROOT.glob("problems/*.yaml"))]
SLOW = {
    "methods/gauss6-lobatto7.gark.yaml",
    "methods/three-colours.gark.yaml",
    "tests/examples/valid/families-implicit.gark.yaml",
}
"""Files whose stability takes a good part of a second."""
FAMILY = "tests/examples/families/sdirk.gark.yaml"
PLANE = "tests/examples/families/plane.gark.yaml"
IMEX = "methods/ark-ars222.gark.yaml"
VERLET = "methods/stoermer-verlet.gark.yaml"
COLLOCATION = "methods/collocation.gark.yaml"
ROUNDED = "tests/examples/valid/rounded.gark.yaml"
RUNS: dict[str, list[tuple[str, ...]]] = {
    "check": [(file, "--max-order", "3") for file in sample(METHODS, 3)],
    "explain": [("density",), ("gamma",), ()],
    "trees": [
        ("-n", "4"),
        ("-N", "2", "-n", "3", "--upto"),
        ("-N", "2", "-n", "3", "--colours-used", "1,2"),
        ("-n", "30", "--count"),
        ("-N", "3", "-n", "5", "--count", "--upto", "--root", "2"),
        ("--tree", "[[]_2]_1"),
        ("-n", "5", "--symplectic"),
        ("-n", "4", "--upto", "--symplectic", "--members"),
        ("-n", "5", "--upto", "--symplectic", "--count"),
    ],
    "conditions": [
        (),
        ("-N", "2", "--coloured", "-n", "3"),
        ("--symplectic", "--members"),
        (COLLOCATION, "--digits", "5"),
        (COLLOCATION, "--failing", "-n", "5"),
        (COLLOCATION, "--failing", "-n", "2"),
        (VERLET, "--symplectic", "--members"),
        *((file, "-n", "2") for file in FILES),
    ],
    "tableau": [(file,) for file in FILES] + [(COLLOCATION, "--digits", "8")],
    "conjugate": [(file, "--pair") for file in FILES] + [(COLLOCATION,)],
    "reduce": [(file,) for file in FILES],
    "stability": [
        *((file,) for file in sample([x for x in METHODS if x not in SLOW], 8)),
        (ROUNDED,),
        (VERLET, COLLOCATION),
        (COLLOCATION, "--slow", "1/4", "--fast", "2"),
        (COLLOCATION, "--slow", "0..1/4", "--fast", "2"),
        (IMEX, "--ratio", "2"),
    ],
    "stability-every": [("stability", FAMILY)],
    "modified": [
        *((file, "-n", "3") for file in FILES if file not in SLOW),
        (VERLET, "-n", "3", "--problem", "pendulum"),
        (VERLET, "-n", "3", "--digits", "5"),
    ],
    "modified-energy": [("energy", COLLOCATION, "--pair", "--modified", "--t-end", "1")],
    "design-search": [("design", FAMILY, "--order", "3", "--search", "4")],
    "design-curve": [
        ("design", FAMILY, "--order", "2", "--search", "3", "--front", "error", "coefficients")
    ],
    "design": [
        (FAMILY,),
        (FAMILY, "--order", "4"),
        (FAMILY, "--pair"),
        (FAMILY, "--order", "2", "--minimise", "error"),
    ],
    "design-within": [("design", "tests/examples/families/rounded-sdirk.gark.yaml")],
    "design-stability": [
        ("design", FAMILY, option, *of)
        for option in ("--a-stable", "--l-stable", "--p-stable")
        for of in ((), ("--pair",))
    ]
    + [("design", PLANE, "--a-stable")],
    "import": [("tests/bridges/sources",)],
    "audit": [("tests/bridges/sources",), ("tests/bridges/texts",)],
    "sweep": [("tests/examples/sweeps/small.yaml", "--rows", os.devnull)],
    "certificate": [(file,) for file in FILES],
    "list": [(), ("families",), ("transfer",)],
    "list-methods": [
        ("list", "methods"),
        ("list", "methods", "--catalogue", "tests/examples/valid"),
    ],
    "show": [("rk4",), ("collocation",), ("ark-ars222",)],
    "cite": [("rk4", "collocation", "stoermer-verlet")],
    "list-exports": [("list", "exports")],
    "export": [(file,) for file in FILES],
    "claims": [(file,) for file in sample(METHODS, 4)],
    "diff": [(VERLET, COLLOCATION), (IMEX, IMEX), *((COLLOCATION, x) for x in METHODS[:4])],
    "convert": [(IMEX, "--to", "tableau"), (COLLOCATION, "--to", "pair")],
    "energy": [
        (VERLET, "--t-end", "10"),
        (COLLOCATION, "--t-end", "10"),
        (VERLET, "--problem", "kepler", "--t-end", "3", "--step", "1/20"),
        (ROUNDED, "--t-end", "10", "--bounded"),
        (VERLET, "--problem", "pendulum", "--t-end", "2", "--symplecticity"),
        (VERLET, "--problem", PROBLEMS[1], "--t-end", "1"),
        (IMEX, "--problem", "van-der-pol", "--t-end", "1"),
    ],
    "converge": [
        (VERLET, "--problem", "oscillator"),
        (VERLET, "--problem", "pendulum", "--work"),
        (VERLET, COLLOCATION, "nowhere.yaml", "--problem", "oscillator"),
        (IMEX, "--problem", "prothero-robinson"),
    ],
}
"""How each report is asked for."""
LISTS = {"list-exports", "list-methods"}
"""Reports that are lists."""
FORMAT = {"export": "--to"}
"""The option that asks for JSON, where it is another."""


@cache
def validator(command: str) -> Draft7Validator:
    """What decides whether something is a report of a command."""
    return Draft7Validator(report_schema(command))


@cache
def reports(command: str) -> list[dict[str, Any]]:
    """The reports of all runs of a command; those that end with a message have none."""
    found = []
    for arguments in RUNS[command]:
        words = (command, *arguments) if command in NAMES else arguments
        run = gark(*words, FORMAT.get(command, "--format"), "json")
        assert run.code in (0, 1, 2, 3), run.err
        if run.out:
            found.append(json.loads(run.out))
    return found


def complaints(command: str, report: object) -> list[str]:
    """What the schema has against a report."""
    return [
        f"{list(error.absolute_path)}: {error.message[:300]}"
        for error in validator(command).iter_errors(report)
    ]


@pytest.mark.parametrize("command", REPORTS)
def test_the_schema_is_one(command: str) -> None:
    """Draft-07, with a title; the command prints it."""
    schema = report_schema(command)
    Draft7Validator.check_schema(schema)
    assert schema["$schema"] == "http://json-schema.org/draft-07/schema#"
    assert command.split("-")[-1] in schema["title"]
    printed = gark("schema", "--report", command)
    assert json.loads(printed.out) == schema


def test_every_command_with_a_report_has_a_schema() -> None:
    """All commands but ``gark schema``, whose output is a schema itself, ``gark new``, and ``gark
    report``, ``gark plot`` and ``gark lsp``, which show what others report; and every name of a report that the
    program writes is the constant of a schema.
    """
    assert NAMES - {"schema", "new", "report", "plot", "lsp"} <= set(REPORTS)
    assert RUNS.keys() == REPORTS.keys()
    names = set()
    for path in Path(ROOT, "garkcli").rglob("*.py"):
        names |= set(re.findall(r"gark/[a-z-]+/1", path.read_text(encoding="utf-8")))
    schemas = json.dumps([report_schema(command) for command in REPORTS])
    assert names == set(re.findall(r'"const": "(gark/[a-z-]+/1)"', schemas))


@pytest.mark.parametrize("command", REPORTS)
def test_reports_keep_to_their_schema(command: str) -> None:
    """Whatever the method, the problem and the options, the schema allows the report."""
    found = reports(command)
    assert len(found) >= len(RUNS[command]) * 3 // 5
    for report in found:
        assert complaints(command, report) == []


def objects(value: Any, at: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """The paths to all objects in plain data, the first of each list alone."""
    if isinstance(value, dict):
        inner = [x for key, one in value.items() for x in objects(one, (*at, key))]
        return [at, *inner]
    return objects(value[0], (*at, 0)) if isinstance(value, list) and value else []


def changed(report: dict[str, Any], path: tuple[Any, ...]) -> tuple[Any, Any]:
    """A copy of a report, and the object in it at a path."""
    copy = deepcopy(report)
    here: Any = copy
    for step in path:
        here = here[step]
    return copy, here


OPEN = {("check", ())}
"""Objects to which a later release may add fields without a new schema."""


@pytest.mark.parametrize("command", REPORTS)
def test_what_is_wrong_is_refused(command: str) -> None:
    """At each place of a report: a field that nobody described, a value of another type; and a
    report of another command.
    """
    report: Any = max(reports(command), key=lambda x: len(objects(x)))
    if isinstance(report, list):
        report = report[:1]  # the others are the same objects again
    for path in sample(objects(report), 3):
        copy, here = changed(report, path)
        if {"invariant_errors", "values", "parameters"} & {*path}:
            continue  # the keys are names of the problem or of parameters
        here["mood"] = "good"
        assert bool(complaints(command, copy)) != ((command, path) in OPEN), path
        del here["mood"]
        for key in list(here):
            kept = here[key]
            here[key] = {"not": ["this"]}
            assert complaints(command, copy), (*path, key)
            here[key] = kept
    if isinstance(report, dict):  # lists have no place for a name
        assert complaints(command, {**report, "schema": "gark/other/1"})


@pytest.mark.parametrize("command", REPORTS)
def test_a_field_that_is_missing_is_refused(command: str) -> None:
    """Each field at the top of a report has to be there, but for those that only some have: an ideal that was
    not found is left out, and whether all of its zeros are listed.
    """
    found = reports(command)
    if command in LISTS:  # the fields of its items
        found = [item for report in found for item in report]
    report = found[0]
    always = set.intersection(*(set(x) for x in found))
    # Rosenbrock methods have alpha and gamma in place of A
    for key in sorted(always - {"ideal", "dimension", "complete", "A"}):
        shorter = {name: value for name, value in report.items() if name != key}
        wrong = [shorter] if command in LISTS else shorter
        assert complaints(command, wrong), key


def test_a_report_that_nobody_has() -> None:
    """An unknown name is refused with the nearest known one."""
    run = gark("schema", "--report", "condition")
    assert run.code == 2
    assert "conditions" in run.err
