"""Searches as a part of sweeps: a row a seed."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml

from garkcli import analyse, loads
from garkcli.errors import MethodFileError
from garkcli.order.certificate import find_order
from garkcli.report.schemas import report_schema
from garkcli.sweep.file import load_plan
from garkcli.sweep.row import row_of
from garkcli.tableau.forms import pair
from tests.cli.harness import gark
from tests.whole import in_whole

EXPLICIT = """unknown: {stages: 3, shape: explicit}
design: {order: 3}
"""
SPEC = """files: explicit.yaml
methods:
  - {family: gauss, stages: 1}
  - {family: lobatto-iiia, stages: 2}
transfer: [collocation, {interpolation: tau, collocation: 1 - tau}]
parameters: {c2: [1/3, 1/2], tau: free}
search: {seeds: 1..2, starts: 3, order: 2}
columns: [order, stages]
best: [error]
"""
NINTH = "parameters: {t: free}\nA: [[t**9 + t/3]]\nb: [1]\ndesign: {order: 2}\n"


@pytest.fixture(scope="module")
def swept(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Any]:
    """A sweep that was run, with its report."""
    folder = tmp_path_factory.mktemp("swept")
    (folder / "explicit.yaml").write_text(EXPLICIT, "utf-8")
    spec = folder / "spec.yaml"
    spec.write_text(SPEC, "utf-8")
    run = gark("sweep", str(spec), "--format", "json", "--top", "99")
    assert run.code == 0
    return spec, json.loads(run.out)


@in_whole
def test_rows_are_finds(swept: tuple[Path, Any]) -> None:
    """Each seed has what ``gark design --search`` finds first from it, with the criteria of ``gark
    check``; a find that another seed had is told once.
    """
    spec, report = swept
    jsonschema.validate(report, report_schema("sweep"))
    jsonschema.validate(yaml.safe_load(SPEC), json.loads(gark("schema", "--sweep").out))
    lines = spec.with_suffix(".jsonl").read_text("utf-8").splitlines()
    rows = [json.loads(line) for line in lines]
    assert len({row["key"] for row in rows}) == len(rows) == 2 * 2 + 1 + 2
    assert report["methods"] == report["kept"] + report["repeated"] == 7
    found = [row for row in rows if row["method"] == "explicit.yaml"]
    assert len(found) == 4
    for row in found[:3:2]:
        c2, target = row["parameters"]["c2"], spec.with_name("one.yaml")
        command = ["design", str(spec.with_name("explicit.yaml"))]
        command += ["--set", f"c2={c2}", "--search", "3", "--most", "1"]
        command += ["--order", "2", "--seed", str(row["seed"])]
        run = gark(*command, "--emit", str(target), "--format", "json")
        (method,) = json.loads(run.out)["methods"]
        assert row["values"] == method["values"]
        assert row["proof"] == method["proof"] == "exact"
        judged = analyse(loads(target.read_text("utf-8")))
        assert row["order"] == judged.order.order


def test_resumed(swept: tuple[Path, Any], tmp_path: Path) -> None:
    """Seeds that are in the file are not done again; other starts are another spec; text and CSV
    have the values.
    """
    spec, report = swept
    lines = spec.with_suffix(".jsonl").read_bytes().splitlines(True)
    rows = tmp_path / "rows.jsonl"
    rows.write_bytes(b"".join(lines[:5]) + lines[5][:-3])
    resumed = ("sweep", str(spec), "--rows", str(rows), "--resume")
    run = gark(*resumed, "--jobs", "2")
    assert "2 rows added" in run.err
    assert sorted(rows.read_bytes().splitlines(True)) == sorted(lines)
    again = f", {report['repeated']} found again"
    assert f"7 methods, {report['kept']} kept{again}" in run.out
    (row, *_) = [x for x in report["best"] if x["method"] == "explicit.yaml"]
    value = f"a32 = {row['values']['a32']}"
    assert f"exact: c3 = {row['values']['c3']}, {value}" in " ".join(run.out.split())
    table = gark(*resumed, "--format", "csv").out
    assert "key,method,c2,seed,proof,values,order" in table.splitlines()[0]
    assert value in table
    other = tmp_path / "spec.yaml"
    other.write_text(SPEC.replace("starts: 3", "starts: 4"), "utf-8")
    (tmp_path / "explicit.yaml").write_text(EXPLICIT, "utf-8")
    refused = gark("sweep", str(other), "--rows", str(rows), "--resume")
    assert (refused.code, "rows of another spec" in refused.err) == (2, True)


def test_what_is_not_exact(tmp_path: Path) -> None:
    """A find that is proved to exist has its digits and no criteria; where nothing is found the row
    says so.
    """
    (tmp_path / "ninth.yaml").write_text(NINTH, "utf-8")
    none = "parameters: {g: free}\nA: [[g]]\nb: [1]\ndesign: {order: 3}\n"
    (tmp_path / "none.yaml").write_text(none, "utf-8")
    spec = tmp_path / "spec.yaml"
    text = "files: [ninth.yaml, none.yaml]\nsearch: {seeds: 7}\ncolumns: order\n"
    spec.write_text(text, "utf-8")
    plan = load_plan(str(spec))
    ninth, nothing = (row_of(plan.criteria, x) for x in plan.points())
    assert (ninth["proof"], ninth["kept"]) == ("exists", True)
    assert "order" not in ninth
    assert nothing["failure"] == "nothing found from 20 starts"
    assert "proved to exist: t = " in " ".join(gark("sweep", str(spec)).out.split())
    spec.write_text(f"{text}where: {{order: 2}}\n", "utf-8")
    plan = load_plan(str(spec))
    assert row_of(plan.criteria, next(plan.points()))["kept"] is False


FAULTS = {
    "search: {seeds: 1..2, starts: 3, order: 2}\n": ("", "leaves tau to a search"),
    ", order: 2": ("", "a search is for an order"),
    "seeds: 1..2, ": ("", "seeds missing"),
    "1..2": ("2..1", "is not a range"),
    "starts: 3": ("starts: 0", "of at least 1"),
    "tau: free": ("tau: [1/2]", "no method has an unknown"),
}  # fmt: skip


@pytest.mark.parametrize("old", FAULTS)
def test_faults(old: str, tmp_path: Path) -> None:
    """Each has its place and its message."""
    new, message = FAULTS[old]
    given = EXPLICIT.replace("design: {order: 3}\n", "")
    (tmp_path / "explicit.yaml").write_text(given, "utf-8")
    path, text = tmp_path / "spec.yaml", SPEC.replace(old, new)
    if "tau: [" in text:
        text = text.replace("files: explicit.yaml\n", "")
        text = text.replace("c2: [1/3, 1/2], ", "")
    path.write_text(text, "utf-8")
    with pytest.raises(MethodFileError) as caught:
        load_plan(str(path))
    faults = caught.value.faults
    assert any(message in fault.message for fault in faults), faults
    assert all(fault.line for fault in faults)


TRANSFERS = """methods:
  - {family: gauss, stages: 2}
  - {family: lobatto-iiia, stages: 3}
transfer: [legendre, "?"]
columns: [pair-order]
search: {seeds: 1..2, order: 4}
"""


@in_whole
def test_any_transfer(tmp_path: Path) -> None:
    """Each seed draws one whose pair has the order, not more, by the certificate; refused without a
    search, and told where no transfer has it.
    """
    spec = tmp_path / "spec.yaml"
    spec.write_text(TRANSFERS, "utf-8")
    plan = load_plan(str(spec))
    legendre, *rows = (row_of(plan.criteria, point) for point in plan.points())
    assert legendre["pair-order"] == 4
    assert [row["pair-order"] for row in rows] == [4, 4]
    values = [row["values"] for row in rows]
    assert values[0] != values[1]
    for settings in values:
        text = "methods: [gauss-2, lobatto-iiia-3]\ntransfer: {default: legendre, blocks: {%s}}"
        block = ", ".join(
            f'"{l + 1},{m + 1}": [{", ".join(rows_of_block(settings, l, m, *size))}]'
            for l, m, size in ((0, 1, (2, 3)), (1, 0, (3, 2)))
        )
        assert find_order(pair(loads(text % block).tableau)).order == 4
    spec.write_text(TRANSFERS.replace("order: 4", "order: 5"), "utf-8")
    plan = load_plan(str(spec))
    *_, row = (row_of(plan.criteria, point) for point in plan.points())
    assert row["failure"] == "no transfer is known whose pair has order 5"
    fourth = TRANSFERS.replace("stages: 3", "stages: 4").replace("1..2", "1")
    spec.write_text(fourth.replace('[legendre, "?"]', '"?"'), "utf-8")
    assert gark("sweep", str(spec)).out.count("root_of") == 1  # which has a name
    spec.write_text(TRANSFERS.partition("search")[0], "utf-8")
    with pytest.raises(MethodFileError, match="leaves the transfer to a search") as told:
        load_plan(str(spec))
    assert told.value.faults[0].help == "write search: {order: 4, seeds: 1..100}"


def rows_of_block(settings: Any, l: int, m: int, height: int, width: int) -> list[str]:
    """The rows of a block as method files write them."""
    name = f"a{l + 1}{m + 1}_"
    rows = ([settings[f"{name}{i}{j}"] for j in range(1, width + 1)] for i in range(1, height + 1))
    return [f"[{', '.join(row)}]" for row in rows]
