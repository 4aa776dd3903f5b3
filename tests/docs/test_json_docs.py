"""The outlines of reports name what they hold, docs/json.md the columns of CSV, with examples."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from garkcli.properties.registry import KEYS
from tests.cli.harness import ROOT, gark
from tests.docs.tables import fields_page

PAGE = (ROOT / "docs" / "json.md").read_text(encoding="utf-8")
NESTED = {*re.findall(r"[\w-]+", fields_page().partition("\n## Fields\n")[0]), *KEYS}
NESTED |= {x.replace("-", "_") for x in KEYS}
"""The names that the outlines of reports have; these are made of the schemas. An entry of them has
all properties.
"""
METHOD = "methods/collocation.gark.yaml"
MISPRINTED = "tests/examples/failing/collocation-misprinted.gark.yaml"

REPORTS = {
    "check": [["check", METHOD]],
    "claims": [["claims", METHOD]],
    "explain": [["explain", "density"], ["explain", "gamma"]],
    "trees": [
        ["trees", "--order", "3", "--colours", "2"],
        ["trees", "--order", "3", "--symplectic", "--members"],
    ],
    "conditions": [
        ["conditions", "--order", "2"],
        ["conditions", METHOD, "--order", "2"],
        ["conditions", METHOD, "--order", "2", "--symplectic", "--members"],
    ],
    "diff": [
        ["diff", METHOD, MISPRINTED],
        ["diff", METHOD, "methods/interpolation.gark.yaml"],
        ["diff", METHOD, METHOD],
    ],
    "tableau": [["tableau", METHOD], ["conjugate", METHOD]],
    "stability": [
        ["stability", METHOD],
        ["stability", "methods/rectangular.gark.yaml"],
        ["stability", METHOD, "--slow", "1/100", "--fast", "2"],
        ["stability", METHOD, "--slow", "0..1", "--fast", "2"],
        ["stability", "methods/ark-ars222.gark.yaml"],
    ],
    "modified": [
        ["modified", METHOD],
        ["modified", "methods/rectangular.gark.yaml", "--problem", "pendulum"],
    ],
    "converge": [
        ["converge", METHOD, "--problem", "oscillator"],
        ["converge", METHOD, "--problem", "kepler", "--steps", "1/8,1/16", "--work"],
        ["converge", METHOD, METHOD, "--problem", "oscillator"],
    ],
    "energy": [
        ["energy", METHOD, "--t-end", "100"],
        ["energy", METHOD, "--pair", "--t-end", "1", "--modified"],
        ["energy", METHOD, "--problem", "pendulum", "--t-end", "10", "--bounded"],
        ["energy", METHOD, "--problem", "pendulum", "--t-end", "10", "--symplecticity"],
    ],
    "design": [
        ["design", "tests/examples/families/sdirk.gark.yaml"],
        [
            *["design", "tests/examples/families/sdirk.gark.yaml"],
            *["--order", "3", "--search", "3"],
        ],
    ],
    "export": [["list", "exports"], ["export", METHOD, "--to", "json"]],
    "audit": [["audit", "tests/bridges/sources/register.cpp"]],
    "import": [["import", "tests/bridges/sources/register.cpp"]],
    "list": [["list"], ["list", "methods", "rk4"]],
    "show": [["show", "rk4"]],
    "cite": [["cite", "rk4", "collocation"]],
}
"""Of each command runs with a report."""

GIVEN_NAMES = re.compile(r"[VFfHP]?\d+|angular momentum|g|\w*order_is_lower_bound|\w+_tolerance")
"""Keys that are names of colours, invariants or parameters, or stand beside any order or weights."""


def section(name: str) -> str:
    """What the page says of a command."""
    return re.split(r"^## ", PAGE.partition(f"## gark {name}\n")[2], flags=re.MULTILINE)[0]


def keys(data: Any) -> Iterator[str]:
    """All keys in a report, however deep."""
    if isinstance(data, dict):
        yield from data
        data = list(data.values())
    if isinstance(data, list):
        for entry in data:
            yield from keys(entry)


@pytest.mark.parametrize("name", REPORTS)
def test_every_key_is_on_the_page(name: str) -> None:
    """What a report holds is in an outline."""
    for arguments in REPORTS[name]:
        format = () if "--to" in arguments else ("--format", "json")
        found = gark(*arguments, *format)
        assert found.code in {0, 1, 3}, found.err
        wanted = {key for key in keys(json.loads(found.out)) if not GIVEN_NAMES.fullmatch(key)}
        assert wanted <= NESTED


def agrees(shown: Any, real: Any) -> bool:
    """Whether a report, shortened where it says …, is as shown."""
    if isinstance(shown, dict):
        named = {key for key in shown if key != "…"}
        is_whole = "…" in shown or named == set(real)
        return is_whole and all(key in real and agrees(shown[key], real[key]) for key in named)
    if isinstance(shown, list):
        first = [x for x in shown if x != "…"]
        is_whole = len(first) == len(real) or ("…" in shown and len(first) < len(real))
        return is_whole and all(map(agrees, first, real))
    return bool(shown == real)


def test_the_example_of_a_check_is_real() -> None:
    """Each pair of key and value that it shows is in the report that it is said to be from."""
    found = json.loads(gark("check", METHOD, "--format", "json").out)
    example, _ = re.findall(r"```json\n(.*?)```", PAGE, re.DOTALL)
    shown = json.loads(re.sub(r"…(?=\])", '"…"', re.sub(r"…(?=\})", '"…": 0', example)))
    assert agrees(shown, found)
    assert not agrees({**shown, "schema": "gark/check/0"}, found)


def test_the_example_of_an_export_is_real(tmp_path: Path) -> None:
    """It is what the method with these coefficients is written as, but for texts left out."""
    _, example = re.findall(r"```json\n(.*?)```", PAGE, re.DOTALL)
    shown = json.loads(example)
    fields = {key: shown[key] for key in ("A", "b", "c", "embedded")}
    (tmp_path / "m.yaml").write_text(json.dumps(fields), encoding="utf-8")
    found = json.loads(gark("export", "m.yaml", "--to", "json", cwd=tmp_path).out)
    left_out = {key for key in shown if shown[key] == "…"}
    assert left_out == {"name", "reference"}
    assert {**found, "name": "…", "reference": "…"} == shown


def test_what_a_failing_check_adds_is_on_the_page() -> None:
    """The parts of a report that only a failure has are named."""
    found = gark("check", MISPRINTED, "--format", "json", "--error-constants")
    (file,) = json.loads(found.out)["files"]
    assert set(file) <= NESTED
    assert {"blame", "error_constants"} <= set(file)


@pytest.mark.parametrize(
    ("name", "arguments"),
    [
        ("converge", ["converge", METHOD, "--problem", "kepler", "--steps", "1/8,1/16"]),
        ("converge", ["converge", METHOD, METHOD, "--problem", "oscillator", "--work"]),
        ("energy", ["energy", METHOD, "--problem", "kepler", "--t-end", "10"]),
    ],
)
def test_every_column_is_on_the_page(name: str, arguments: list[str]) -> None:
    """The columns of the CSV are named in the section of the command."""
    head = gark(*arguments, "--format", "csv").out.splitlines()[0]
    assert set(head.split(",")) - {"angular_momentum_error"} <= {
        *re.findall(r"`(\w+)`", section(name))
    }
