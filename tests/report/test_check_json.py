"""The JSON of ``gark check`` keeps to its published schema on every file there is, with every
option.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft7Validator

from garkcli.check.check_file import check_file
from garkcli.report.checked import REPORT
from tests.whole import in_whole, sample

ROOT = Path(__file__).parents[2]
SCHEMA = REPORT.schema
VALIDATOR = Draft7Validator(SCHEMA)
READABLE = sample(
    sorted([*ROOT.glob("methods/*.gark.yaml"), *ROOT.glob("tests/examples/valid/*.gark.yaml")]), 6
)
FAILING = sorted(ROOT.glob("tests/examples/failing/*.gark.yaml"))
INVALID = ROOT / "tests/examples/invalid"
FREE = [INVALID / "parameter-free.gark.yaml", INVALID / "unknown-entries.gark.yaml"]
"""No methods to step with, but families, of which is told what holds for every value."""
REFUSED = sorted({*INVALID.glob("*.gark.yaml")} - {*FREE})
MISPRINTED = ROOT / "tests/examples/failing/collocation-misprinted.gark.yaml"


def report(*paths: Path, limit: int = 60, constants: bool = False) -> dict[str, Any]:
    """The report on some files, as JSON read back."""
    found = json.loads(REPORT.json([check_file(str(path), limit, constants) for path in paths]))
    assert isinstance(found, dict)
    return found


@cache
def every_file() -> dict[str, Any]:
    """The report on every file there is: readable, failing, of families, refused, missing, and a
    directory without files.
    """
    return report(
        *READABLE, *FAILING, *FREE, *REFUSED, Path("nowhere.gark.yaml"), Path("tests/report")
    )


def one(tmp_path: Path, text: str, **options: Any) -> dict[str, Any]:
    """The report on one text, allowed by the schema."""
    file = tmp_path / "m.gark.yaml"
    file.write_text(text, encoding="utf-8")
    found = report(file, **options)
    assert complaints(found) == []
    return dict(found["files"][0])


def complaints(found: object) -> list[str]:
    """What the schema has against a report."""
    return [
        f"{list(error.absolute_path)}: {error.message[:200]} {[x.message[:200] for x in error.context or ()]}"
        for error in VALIDATOR.iter_errors(found)
    ]


@in_whole
def test_the_schema_is_one() -> None:
    """The schema itself is valid draft-07, and it refuses a report without its fields."""
    Draft7Validator.check_schema(SCHEMA)
    assert not VALIDATOR.is_valid(
        {"schema": "gark/check/1", "files": [{"file": "m"}], "summary": {}}
    )


@in_whole
def test_reports_keep_to_the_schema() -> None:
    """Every readable, failing, refused and missing file gives a report that the schema allows."""
    found = every_file()
    assert complaints(found) == []
    refused = len(REFUSED) + 2
    total = len(READABLE) + len(FAILING) + len(FREE) + refused
    silent = sum("claims" in file and not file["claims"] for file in found["files"])
    counts = {
        "files": total,
        "failed": len(FAILING) + refused,
        "undecided": 0,
        "without_claims": silent,
    }
    assert found["summary"] == counts


@pytest.mark.parametrize(
    "key", ["order", "witness", "simplifying", "claims", "tolerance", "symplectic", "colours"]
)
def test_the_schema_needs_every_field(key: str) -> None:
    """A report that lacks a field, or has it with another type, is refused."""
    found = report(READABLE[0])
    (file,) = found["files"]
    kept = file.pop(key)
    assert not VALIDATOR.is_valid(found)
    file[key] = 1.5
    assert not VALIDATOR.is_valid(found)
    file[key] = kept
    assert VALIDATOR.is_valid(found)


def test_a_field_that_nobody_described_is_noticed() -> None:
    """The schema is closed: a new field of a report has to be described before it is written."""
    found = report(READABLE[0])
    found["files"][0]["mood"] = "good"
    assert not VALIDATOR.is_valid(found)


@in_whole
def test_each_table_has_a_row_a_colour() -> None:
    """B, C and D of a GARK method are as large as it has colours."""
    files = every_file()["files"]
    families = [found for found in files if "every_value" in found]
    assert len(families) == len(FREE)
    checked = [found for found in files if "errors" not in found and found not in families]
    assert len(checked) == len(READABLE) + len(FAILING)
    of_fields = [found for found in checked if "simplifying" in found]
    assert len(of_fields) > len(checked) // 2
    for found in of_fields:
        N = len(found["colours"])
        assert len(found["simplifying"]["B"]) == N
        for table in "CD":
            assert [len(row) for row in found["simplifying"][table]] == [N] * N


def test_lower_bounds_and_error_constants() -> None:
    """With a low limit and error constants every file keeps to the schema, and says that orders are
    bounds.
    """
    no_claims = ROOT / "tests/examples/valid/smallest.gark.yaml"
    found = report(*{*READABLE[::3], no_claims}, *FAILING, limit=2, constants=True)
    assert complaints(found) == []
    bounded = [x for x in found["files"] if x.get("order_is_lower_bound")]
    assert bounded
    assert all(x["witness"] is None and "error_constants" not in x for x in bounded)
    assert any("error_constants" in x for x in found["files"])


def test_error_constants_are_of_the_first_failing_order() -> None:
    """The constants belong to the order after the last that holds, exact where the method is."""
    found = report(ROOT / "methods/stoermer-verlet.gark.yaml", constants=True)
    assert complaints(found) == []
    (file,) = found["files"]
    assert file["error_constants"]["order"] == file["order"] + 1
    assert file["error_constants"]["exact"] is True
    assert file["error_constants"]["all"]["two_norm"] > 0


def test_numbers_beyond_floats(tmp_path: Path) -> None:
    """Norms too large for floats are null, those too small 0.0, as the schema allows; the exact value
    and the tree of the largest coefficient stand beside them.
    """
    big = "A: [[0, 0], [1e400, 0]]\nb: [1/2, 1/2]\n"
    norms = one(tmp_path, big, constants=True)["error_constants"]["all"]
    assert (norms["two_norm"], norms["inf_norm"]) == (None, None)
    assert (norms["worst"], norms["worst_value"]) == ("[[]_1]_1", f"{10**400 - 1}/2")
    small = "A: [[1/2 + 1e-400]]\nb: [1]\n"
    norms = one(tmp_path, small, constants=True)["error_constants"]["all"]
    assert (norms["two_norm"], norms["inf_norm"]) == (0.0, 0.0)
    assert (norms["worst"], norms["worst_value"]) == ("[[]_1]_1", f"1/{10**400}")


@in_whole
def test_a_rounded_method_says_so(tmp_path: Path) -> None:
    """A tolerance is repeated as text, ``exact`` is false, and the largest residual is within the
    tolerance.
    """
    found = one(
        tmp_path, "methods: [{A: [[0.5000000000000001]], b: [1]}]\ntolerance: 1e-14\n", limit=4
    )
    assert (found["exact"], found["tolerance"], found["order"]) == (False, "1e-14", 2)
    assert 0 < found["order_largest_residual"] <= 1e-14
    assert "remark" not in found


def test_what_the_digits_say_is_in_the_report(tmp_path: Path) -> None:
    """The line to add, or the entry that is off, with the order that the method would have."""
    found = one(tmp_path, "methods: [{A: [[0.5000000000000001]], b: [1]}]\n")
    assert (found["exact"], found["order"]) == (True, 1)
    line = "tolerance: 1e-16"
    assert found["remark"] == {"of": "order", "order": 2, "line": line, "repairs": []}
    off = "[[0.2500000000, -0.0386751346], [0.5386761346, 0.2500000000]]"
    found = one(tmp_path, f"A: {off}\nb: [0.5, 0.5]\n")
    assert "line" not in found["remark"]
    assert found["remark"]["order"] == 4
    (repair,) = found["remark"]["repairs"]
    assert (repair["row"], repair["entry"], repair["new"]) == (2, 1, "2693375673/5000000000")


def test_a_failing_method_is_blamed() -> None:
    """A claim on the order that fails comes with the failing conditions, and the schema knows
    them.
    """
    found = report(MISPRINTED)
    assert complaints(found) == []
    (file,) = found["files"]
    assert file["ok"] is False
    assert file["blame"]["order"] == file["order"] + 1
    assert 0 < file["blame"]["failing"] <= file["blame"]["conditions"]


@pytest.mark.parametrize(
    ("place", "key"), [("A: [[1/3]], b: [1]", "A"), ("A: [[1/2]], b: [2]", "b")]
)
def test_a_repair_names_its_place(tmp_path: Path, place: str, key: str) -> None:
    """A single wrong entry is found again, in A or in b, with what it was and what it should be."""
    found = one(tmp_path, f"methods: [{{{place}}}]\nexpect: {{order: {2 if key == 'A' else 1}}}\n")
    (repair,) = found["blame"]["repairs"]
    assert (repair["old"], repair["new"]) == {"A": ("1/3", "1/2"), "b": ("2", "1")}[key]
    assert key in repair
    assert repair["entry"] == 1


def test_a_file_that_cannot_be_read_has_its_errors() -> None:
    """Faults are in file order with places from 1, null for a file that is not there."""
    found = report(ROOT / "tests/examples/invalid/many-faults.gark.yaml", Path("nowhere.gark.yaml"))
    assert complaints(found) == []
    many, missing = (file["errors"] for file in found["files"])
    places = [(x["line"], x["column"]) for x in many]
    assert len(places) > 3
    assert places == sorted(places)
    assert [(x["line"], x["column"]) for x in missing] == [(None, None)]
