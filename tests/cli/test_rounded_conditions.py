"""``gark conditions`` and ``gark conjugate`` on rounded coefficients; what failing conditions are
counted among.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from flint import fmpq

from garkcli.exact.display import to_decimal, to_float
from garkcli.methodfile.load import loads
from garkcli.order.rounded import RoundedTableau, find_order_within
from tests.cli.harness import ROOT, gark

DECIMALS = ROOT / "tests" / "examples" / "hints" / "gauss2-decimals.gark.yaml"
PAIR = "methods/gauss2-lobatto4.gark.yaml"


@pytest.fixture
def rounded(tmp_path: Path) -> str:
    """Gauss 2 in fifteen decimals with a tolerance."""
    file = tmp_path / "rounded.gark.yaml"
    file.write_text(DECIMALS.read_text() + "\ntolerance: 1e-15\n")
    return str(file)


def test_conditions_within_the_tolerance_do_not_fail(rounded: str) -> None:
    """Up to the order within the tolerance all conditions are met; none is said to hold that only
    nearly does.
    """
    report = json.loads(gark("conditions", rounded, "-n", "5", "--format", "json").out)
    assert report["tolerance"] == "1e-15"
    rows = report["conditions"]
    assert {row["order"] for row in rows if not row["holds"]} == {5}
    text = gark("conditions", rounded, "-n", "4").out
    assert "FAILS" not in text
    exactly = sum(row["residual"] == "0" for row in rows if row["order"] <= 4)
    assert len(re.findall("  holds +bᵀ", text)) == exactly
    assert len(re.findall("  within +bᵀ", text)) == 8 - exactly
    assert text.endswith("8 conditions, all hold within 1e-15\n")
    assert max(map(len, text.splitlines())) < 100
    exact = gark("conditions", str(DECIMALS), "-n", "4").out
    assert exact.endswith("8 conditions, 7 fail\n")


def test_independent_conditions_within_the_tolerance(rounded: str) -> None:
    """The independent conditions of the pair are judged within the tolerance of the file too."""
    rows = json.loads(
        gark("conditions", rounded, "-n", "4", "--symplectic", "--format", "json").out
    )["conditions"]
    assert all(row["holds"] for row in rows)
    assert any(row["residual"] != "0" for row in rows)


def test_the_conjugate_of_a_rounded_method_is_rounded(rounded: str) -> None:
    """Its file has the tolerance, so that it is checked within it, also the pair's."""
    for options in ((), ("--pair",)):
        again = loads(gark("conjugate", rounded, "--format", "yaml", *options).out)
        assert again.tolerance is not None
        assert to_float(again.tolerance) == 1e-15
        assert (
            find_order_within(RoundedTableau.within(again.tableau, again.tolerance), 6).order == 4
        )


@pytest.mark.parametrize("command", ["tableau", "conditions", "conjugate"])
@pytest.mark.parametrize("layout", ["latex", "text"])
def test_rounded_methods_are_printed_in_decimals(command: str, layout: str, tmp_path: Path) -> None:
    """No fraction of twenty digits where people read; the decimals are those of the exact numbers
    in the JSON.
    """
    file = tmp_path / "rounded.gark.yaml"
    methods = DECIMALS.read_text().partition("methods:")[2].partition("\n\n")[0]
    file.write_text(
        f"methods:{methods}\n  - {{family: lobatto-iiia, stages: 3}}\ntransfer: collocation\ntolerance: 1e-13\n"
    )
    order = ["-n", "4"] if command == "conditions" else []
    shown = gark(command, str(file), *order, "--format", layout).out
    assert not re.search(r"\d{20}", shown)
    exact = gark(command, str(file), *order, "--format", "json").out
    assert re.search(r"\d{20}", exact)
    if command == "conditions":
        rows = [row for row in json.loads(exact)["conditions"] if len(row["value"]) > 60]
        assert rows
        assert shown.count(r"\approx" if layout == "latex" else "is about") == len(rows)
        return
    entries = json.loads(exact)
    assert entries["exact"]
    long = [x for row in entries["A"][0][1] for x in row if len(x) > 20]
    assert long
    for x in long:
        p, q = x.split("/")
        assert to_decimal(fmpq(int(p), int(q)), 17).rstrip("0") in shown
    assert "long fractions as decimals, 17 digits" in shown


def test_exact_methods_are_printed_exactly(tmp_path: Path) -> None:
    """Without a tolerance a long fraction is a coefficient as meant, and stays one."""
    file = tmp_path / "long.gark.yaml"
    file.write_text("methods: [{A: [[12345678901234567890123/98765432109876543210988]], b: [1]}]")
    for layout in ("text", "latex"):
        shown = gark("tableau", str(file), "--format", layout).out
        assert "12345678901234567890123" in shown
        assert "decimals" not in shown


def test_failing_conditions_are_counted_among_all() -> None:
    """With --failing the summary still counts every condition, and order headings without failures
    are left out.
    """
    every, failing = (
        gark("conditions", PAIR, "--pair", "-n", "3", *more).out.splitlines()
        for more in ([], ["--failing"])
    )
    assert every[-1] == failing[-1] == "62 conditions, 2 fail"
    assert [line for line in every if "FAILS" in line] == [
        line for line in failing if "FAILS" in line
    ]
    assert [line for line in failing if line.startswith("order")] == ["order 3"]


@pytest.mark.parametrize("more", [[], ["--symplectic"]])
def test_a_csv_without_failing_conditions_has_its_heading(more: list[str]) -> None:
    """Programs that read the table find its columns, whether there are rows or not."""
    asked = ["conditions", "methods/collocation.gark.yaml", "-n", "3", "--format", "csv", *more]
    every, failing = gark(*asked).out, gark(*asked, "--failing").out
    assert failing == every.splitlines(keepends=True)[0]


def test_colours_with_names_are_named() -> None:
    """Where trees say 3 and the colour is called F1, a line says so; where numbers are names, none
    does.
    """
    assert gark("conditions", PAIR, "--pair", "-n", "1").out.startswith(
        "colours: 1 V1, 2 V2, 3 F1, 4 F2\n"
    )
    assert gark("conditions", PAIR, "-n", "1").out.startswith("order 1\n")
