"""A file is told which method of the catalogue it is: exactly, renumbered, rounded, or not at all."""

from __future__ import annotations

import json
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from flint import fmpq

from garkcli.catalogue.known import WINDOW, Known, find_known, fingerprint
from garkcli.check.check_file import check_method
from garkcli.comparison.comparison import compare
from garkcli.methodfile.load import load, loads
from tests.cli.harness import gark
from tests.whole import in_whole, sample

ROOT = Path(__file__).resolve().parents[2]
INDEX = ROOT / "garkcli" / "catalogue" / "index.json"
RK4 = "{A: [[], [1/2], [0, 1/2], [0, 0, 1]], b: [1/6, 1/3, 1/3, 1/6]}"


def known(text: str) -> Known | None:
    """What a file is told, whatever its order is."""
    outcome = check_method(loads(text), limit=2)
    assert outcome.analysis is not None
    return find_known(outcome.analysis, outcome.file, outcome.text)


def test_a_method_as_it_stands() -> None:
    """Its name, and that nothing was rounded."""
    assert known(RK4) == Known("rk4")


def test_a_method_with_its_stages_renumbered() -> None:
    """The last stage first: no entry stands where it stood; ``gark diff`` says the same."""
    turned = (
        "{A: [[0, 0, 0, 1], [0, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1/2, 0]], b: [1/6, 1/6, 1/3, 1/3]}"
    )
    assert known(turned) == Known("rk4")
    assert compare(loads(turned), load("rk4")).relation == "same"


def test_a_method_with_a_stage_too_many() -> None:
    """What no weight and no stage sees changes nothing."""
    assert known("{A: [[], [1], [1/3, 1/3]], b: [1/2, 1/2, 0]}") == Known("heun-euler", None, True)


@pytest.mark.parametrize(
    "tolerance", ["", pytest.param(", tolerance: 1e-11", marks=in_whole), ", tolerance: 1e-10"]
)
def test_a_rounded_method(tolerance: str) -> None:
    """Kutta's method with ten threes is the same within the rounding of its file, and differs from
    Kutta's where that is smaller, or the file is exact; ``gark diff`` says the same.
    """
    third = "0.3333333333"
    text = (
        f"{{A: [[], [1/3], [-{third}, 1], [1, -1, 1]], b: [1/8, 3/8, 3/8, 1/8],"
        f" c: [0, 1/3, 2/3, 1]{tolerance}}}"
    )
    is_same = tolerance.endswith("1e-10")
    assert known(text) == Known("kutta-38", fmpq(1, 10**10), is_same=is_same)
    relation = compare(loads(text), load("kutta-38")).relation
    assert relation == ("within-rounding" if is_same else "different")


def test_other_embedded_weights_are_told() -> None:
    """The step alone is the same, whichever of both has more."""
    step = "A: [[], [1/2], [0, 3/4], [2/9, 1/3, 4/9]], b: [2/9, 1/3, 4/9, 0]"
    printed = "embedded: [7/24, 1/4, 1/3, 1/8]"
    assert known(f"{{{step}, {printed}}}") == Known("bogacki-shampine-3")
    assert known(f"{{{step}, embedded: [1, 0, 0, 0]}}") == Known("bogacki-shampine-3", None, True)


def test_what_the_catalogue_has_not() -> None:
    """One entry is another one, or a node; a node alone has a name among the errata."""
    assert known(RK4.replace("0, 0, 1]", "0, 1/8, 7/8]")) is None
    assert known(RK4.replace("}", ", c: [0, 1/2, 1/3, 1]}")) is None


@pytest.mark.parametrize("name", ["rk4", "methods/rk4.gark.yaml", "rectangular", "gauss-4"])
def test_a_file_of_the_catalogue_is_not_told(name: str) -> None:
    """By its name, or as a copy: nothing is the same as itself."""
    done = gark("check", name, cwd=ROOT)
    assert "the same as" not in done.out


@in_whole
def test_it_is_told_in_every_format(tmp_path: Path) -> None:
    """In text, JSON, Markdown and LaTeX; a quiet report does not ask."""
    (tmp_path / "mine.yaml").write_text(RK4, encoding="utf-8")
    assert "the same as  rk4\n" in gark("check", "mine.yaml", cwd=tmp_path).out
    found: dict[str, Any] = json.loads(
        gark("check", "mine.yaml", "--format", "json", cwd=tmp_path).out
    )
    assert found["files"][0]["same_as"] == {"method": "rk4", "within": None, "step_only": False}
    for output in ("markdown", "latex"):
        text = gark("check", "mine.yaml", "--format", output, cwd=tmp_path).out
        assert "the same as" in text
    assert gark("check", "mine.yaml", "--quiet", cwd=tmp_path).out == ""
    (tmp_path / "mine.yaml").write_text(
        RK4.replace("1/3, 1/6]", "1/3, 0.1666667]"), encoding="utf-8"
    )
    assert "differs from  rk4 by at most 1e-7\n" in gark("check", "mine.yaml", cwd=tmp_path).out


def test_huge_coefficients_have_a_fingerprint() -> None:
    assert fingerprint(loads("A: [[0, 0], [1e200, 0]]\nb: [1, 1e300]\n").tableau) > 0


def test_fingerprints_of_the_index() -> None:
    """Each is that of its file; those of methods with other steps are rarely near each other."""
    methods = json.loads(INDEX.read_text(encoding="utf-8"))["methods"]
    for entry in sample(methods, 25):
        file = INDEX.parent / "data" / entry["file"]
        assert abs(fingerprint(load(str(file)).tableau) - entry["fingerprint"]) < 1e-8, file
    numbers = sorted(x["fingerprint"] for x in methods)
    near = [b - a for a, b in pairwise(numbers) if b - a <= WINDOW]
    assert len(near) < len(numbers) / 4


def test_a_sum_of_roundings_has_few_digits() -> None:
    """The rounding of a copy with ten digits and that of the catalogue with forty are one of two
    digits, which is at least their sum.
    """
    text = """tolerance: 1e-10
A: [[0, 0, 0, 0], [0.4358665215, 0.4358665215, 0, 0],
    [0.2576482460, -0.0935147675, 0.4358665215, 0],
    [0.1876410243, -0.5952974735, 0.9717899277, 0.4358665215]]
b: [0.1876410243, -0.5952974735, 0.9717899277, 0.4358665215]
"""
    assert known(text) == Known("esdirk-324", fmpq(11, 10**11), True)
