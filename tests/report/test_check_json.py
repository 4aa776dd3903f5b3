"""The JSON of ``gark check`` keeps to its schema on every file there is."""

import json
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator

from garkcli.methodfile.check import check_file
from garkcli.report.check_json import render

ROOT = Path(__file__).parents[2]
VALIDATOR = Draft202012Validator(
    json.loads((Path(__file__).parent / "check.schema.json").read_text(encoding="utf-8"))
)
READABLE = sorted([*ROOT.glob("methods/*.gark.yaml"), *ROOT.glob("tests/examples/valid/*.gark.yaml")])
REFUSED = [ROOT / f"tests/examples/invalid/{name}.gark.yaml" for name in ("many-faults", "empty", "not-utf8")]


def report(*paths: Path, limit: int = 60) -> dict[str, object]:
    """The report on some files, as JSON read back."""
    found = json.loads(render([check_file(str(path), limit) for path in paths]))
    assert isinstance(found, dict)
    return found


def test_the_schema_is_one() -> None:
    """The schema itself is valid, and it refuses a report without its fields."""
    Draft202012Validator.check_schema(VALIDATOR.schema)
    assert not VALIDATOR.is_valid({"schema": "gark/check/1", "files": [{"file": "m"}], "summary": {}})


@pytest.mark.parametrize("limit", [1, 60])
def test_reports_keep_to_the_schema(limit: int) -> None:
    """Every readable file, refused file and missing file gives a report that the schema allows."""
    found = report(*READABLE, *REFUSED, Path("nowhere.gark.yaml"), limit=limit)
    errors = [f"{list(error.absolute_path)}: {error.message}" for error in VALIDATOR.iter_errors(found)]
    assert errors == []
    assert found["summary"] == {"files": len(READABLE) + 4, "failed": 4}


def test_each_table_has_a_row_a_colour() -> None:
    """B, C and D are as large as the method has colours."""
    for found in report(*READABLE)["files"]:  # type: ignore[attr-defined]
        N = len(found["colours"])
        assert len(found["simplifying"]["B"]) == N
        for table in "CD":
            assert [len(row) for row in found["simplifying"][table]] == [N] * N
