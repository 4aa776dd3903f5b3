"""Texts fit the terminal, and numbers are decimals where that is asked for."""

from __future__ import annotations

import csv
import io
import json
import re
from pathlib import Path

import pytest

from garkcli.report.paint import folded
from tests.cli.harness import gark

RUNS = [
    ("list",),
    ("--help",),
    ("trees", "-n", "7"),
    ("trees", "--tree", "[" * 40 + "[]_1,[]_1" + "]_1" * 40),
    ("conditions", "-n", "7"),
    ("conditions", "--symplectic", "-n", "6"),
    ("conditions", "-N", "2", "-n", "4", "--coloured"),
    ("conditions", "methods/rectangular.gark.yaml", "-n", "5"),
    ("conditions", "methods/collocation.gark.yaml", "-n", "5", "--pair", "--failing"),
]


@pytest.mark.parametrize("run", RUNS, ids=lambda run: " ".join(run)[:40])
def test_a_text_fits_80_columns(run: tuple[str, ...]) -> None:
    """No line is wider than the terminal, however long its formula or tree is."""
    lines = gark(*run).out.splitlines()
    assert [line for line in lines if len(line) > 80] == []


def test_folding_loses_nothing() -> None:
    """A formula in lines is the formula, and only what has no place to break is too wide."""
    text = "b{l}ᵀ((A{l,m}A{m,n}𝟙) ⊙ (A{l,u}𝟙) ⊙ (A{l,v}𝟙)) = 1/12   ∀ l,m,n,u,v"
    for width in range(12, 80):
        lines = folded(text, width, "  ")
        assert "".join(line.strip() for line in lines).replace(" ", "") == text.replace(
            " ", ""
        )
        assert all(len(line) <= max(width, 16) for line in lines)


@pytest.mark.parametrize("format_", ["text", "json", "csv", "latex"])
def test_conditions_in_decimals(format_: str) -> None:
    """--digits writes values and residuals in decimals, in every format; they are the exact ones,
    rounded.
    """
    arguments = (
        "conditions",
        "methods/rk4.gark.yaml",
        "-n",
        "5",
        "--only",
        "--format",
        format_,
    )
    exact, rounded = gark(*arguments).out, gark(*arguments, "--digits", "4").out
    assert exact != rounded
    if format_ == "json":
        pairs = zip(
            json.loads(exact)["conditions"],
            json.loads(rounded)["conditions"],
            strict=True,
        )
        for before, after in pairs:
            for key in ("value", "required", "residual"):
                numerator, _, denominator = before[key].partition("/")
                meant = int(numerator) / int(denominator or 1)
                assert float(after[key]) == pytest.approx(meant, rel=1e-3)
                assert "/" not in after[key]
    if format_ == "text":
        assert not re.search(r"is -?[0-9]+/", rounded)
    assert gark("conditions", "--digits", "4").code == 2


def test_names_in_csv_are_no_formulas(tmp_path: Path) -> None:
    """A method with the name of a formula is text in a spreadsheet; numbers stay numbers."""
    for name in ("=1+1", "@SUM(A1)"):
        text = f'methods: [{{family: gauss, stages: 1}}]\nname: "{name}"\n'
        (tmp_path / f"{name[1]}.gark.yaml").write_text(text)
    arguments = ("converge", ".", "--problem", "oscillator", "--steps", "1/2,1/4")
    run = gark(*arguments, "--format", "csv", cwd=tmp_path)
    heads, *rows = csv.reader(io.StringIO(run.out))
    assert {row[heads.index("method")] for row in rows} == {"'=1+1", "'@SUM(A1)"}
    assert all(float(row[heads.index("h")]) > 0 for row in rows)


RK4 = """
A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]]
b: [1/6, 1/3, 1/3, 1/6]
expect: {order: 4}
"""
COUPLED = """
methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]
transfer: collocation
"""

WIDE = [
    ("check", "--error-constants", "coupled.yaml"),
    ("check", "broken.yaml"),
    ("stability", "--help"),
    ("energy", "--help"),
]


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
@pytest.mark.parametrize("run", [("list",), *WIDE], ids=lambda run: run[0])
def test_a_text_fits_80_columns_in_ascii_too(
    run: tuple[str, ...], encoding: str, tmp_path: Path
) -> None:
    """Hints, error constants and helps leave room for the longer ASCII forms of their signs."""
    broken = RK4.replace("1/2, 0, 0]", "1/3, 0, 0]")
    assert broken != RK4
    (tmp_path / "broken.yaml").write_text(broken, encoding="utf-8")
    (tmp_path / "coupled.yaml").write_text(COUPLED, encoding="utf-8")
    found = gark(*run, cwd=tmp_path, encoding=encoding)
    lines = found.out.splitlines()
    too_wide = [line for line in lines if len(line) > 80]
    assert too_wide == []


def test_a_repair_too_wide_for_its_line_has_one_of_its_own(tmp_path: Path) -> None:
    """The wrong entry is named whole, in a line that is searched for as it stands."""
    broken = RK4.replace("1/2, 0, 0]", "1/3, 0, 0]")
    (tmp_path / "m.yaml").write_text(broken, encoding="utf-8")
    lines = gark("check", "m.yaml", cwd=tmp_path).out.splitlines()
    at = lines.index("        the claimed order would hold with")
    assert lines[at + 1] == "          A{1,1}, row 3, entry 2, = 1/2 instead of 1/3"
