"""``gark design --search`` with ``--front`` and ``--along``: optima along a curve."""

from __future__ import annotations

import csv
import io
import json
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from garkcli import find_parameters, loads_family, minimise
from garkcli.crew.work import Alone
from garkcli.design.search.curve import OptimaCurve, along, front
from garkcli.design.search.run import do
from garkcli.design.search.search import Search
from garkcli.errors import UsageProblem
from tests.cli.harness import gark
from tests.whole import in_whole

TWO = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - 1/(2*t), 1/(2*t)]\ndesign: {order: 2}"
SDIRK = """
unknown: {stages: 2, shape: sdirk}
design: {order: 2, range: {gamma: [1/10, 1/2]}}
"""


def last(steps: Any) -> OptimaCurve:
    """The finished curve."""
    *_, curve = steps
    assert isinstance(curve, OptimaCurve)
    return curve


def searched(text: str, objective: str) -> tuple[Search, Any]:
    family = loads_family(text)
    assert family.order is not None
    search = Search(family, family.order, objective=objective)
    return search, Alone(partial(do, search))


def test_a_front_is_between_the_optima() -> None:
    """With one unknown t it is the curve of both objectives from the one least t to the other:
    (1/6 − t/4)² + 1/36 and t² + (1 − 1/2t)² + (1/2t)².
    """
    search, workers = searched(TWO, "error")
    curve = last(front(search, "coefficients", 6, 0, workers))
    assert (curve.across, curve.up) == ("error", "coefficients")
    assert len(curve.knots) > 10
    ups = [knot.up for knot in curve.knots]
    assert ups == sorted(ups, reverse=True)
    for knot in curve.knots:
        [t] = knot.point
        assert knot.across == pytest.approx((1 / 6 - t / 4) ** 2 + 1 / 36)
        assert knot.up == pytest.approx(t**2 + (1 - 1 / (2 * t)) ** 2 + 1 / (4 * t**2))
    for knot, key in ((curve.knots[0], "error"), (curve.knots[-1], "coefficients")):
        exact = minimise(loads_family(TWO), key).value
        assert exact is not None
        found = knot.across if key == "error" else knot.up
        assert found == pytest.approx(float(exact.ball(64)), rel=1e-6)


@in_whole
def test_levels_grow_along_a_front() -> None:
    """Four stages of order 3: from the order 4, with no SSP coefficient, to Kraaijevanger's 2."""
    text = "unknown: {stages: 4, shape: explicit}\ndesign: {order: 3}"
    search, workers = searched(text, "A")
    curve = last(front(search, "-ssp", 3, 0, workers))
    assert curve.knots[0].across == pytest.approx(0, abs=1e-9)
    assert curve.knots[-1].up == pytest.approx(2, rel=1e-6)
    ups = [knot.up for knot in curve.knots]
    assert ups == sorted(ups)


def test_optima_along_an_unknown_are_the_exact_ones() -> None:
    """For each γ the least error is that of the exact minimum with this γ."""
    search, workers = searched(SDIRK, "error")
    curve = last(along(search, "gamma", 6, 0, workers))
    assert len(curve.knots) == 17
    for knot in curve.knots[::8]:
        text = SDIRK.replace("range: {gamma: [1/10, 1/2]}", f"fix: {{gamma: {knot.across!r}}}")
        exact = minimise(find_parameters(loads_family(text), 2), "error").value
        assert exact is not None
        assert knot.up == pytest.approx(float(exact.ball(64)), rel=1e-6)


def test_what_a_curve_refuses() -> None:
    """An unknown that there is not, or without a range; sums on a front."""
    search, workers = searched(SDIRK, "error")
    with pytest.raises(UsageProblem, match="no unknown 'g'"):
        last(along(search, "g", 3, 0, workers))
    with pytest.raises(UsageProblem, match="no range with two ends"):
        last(along(search, "c2", 3, 0, workers))
    with pytest.raises(UsageProblem, match="two single objectives"):
        last(front(search, "A + D", 3, 0, workers))


def test_the_command_tells_curves_in_every_format(tmp_path: Path) -> None:
    """Text, CSV with the coefficients, JSON, a picture in a file and one with -v."""
    file = tmp_path / "sdirk.yaml"
    file.write_text(SDIRK, encoding="utf-8")
    asked = "design", str(file), "--search", "4", "--minimise", "error", "--along", "gamma"
    picture = tmp_path / "curve.svg"
    text = gark(*asked, "-v", "--plot", str(picture))
    assert text.code == 0, text.err
    assert "the best error for 17 points of gamma" in " ".join(text.out.split())
    assert "• error against gamma" in text.out
    assert picture.read_text(encoding="utf-8").startswith("<?xml")
    rows = list(csv.DictReader(io.StringIO(gark(*asked, "--format", "csv").out)))
    data = json.loads(gark(*asked, "--format", "json").out)
    assert [float(row["error"]) for row in rows] == [
        knot["coordinates"]["error"] for knot in data["knots"]
    ]
    assert set(rows[0]) == {"gamma", "error", "c2", "b1", "b2"}
    assert data["schema"] == "gark/design-curve/1"
    for form in ("markdown", "latex"):
        assert gark(*asked, "--format", form).code == 0


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ("--front error D", "--front goes with --search"),
        ("--search 2 --along gamma", "--along goes with --minimise"),
        ("--search 2 --front error D --minimise error", "--front names two objectives"),
        ("--search 2 --front error D --emit x.yaml", "optima in floats"),
        ("--search 2 --front error speed", "no objective 'speed'"),
        ("--format csv", "CSV has a line a point"),
    ],
)
def test_options_that_do_not_go_together(tmp_path: Path, options: str, says: str) -> None:
    """Exit code 2, before any work."""
    file = tmp_path / "sdirk.yaml"
    file.write_text(SDIRK, encoding="utf-8")
    result = gark("design", str(file), *options.split())
    assert result.code == 2
    assert says in result.err


def test_nothing_found_is_no_answer(tmp_path: Path) -> None:
    """Exit code 3, as other searches."""
    file = tmp_path / "none.yaml"
    file.write_text("unknown: {stages: 2, shape: explicit}\ndesign: {order: 3}", encoding="utf-8")
    result = gark("design", str(file), "--search", "3", "--front", "A", "D")
    assert result.code == 3
    assert "does not say that there is none" in " ".join(result.out.split())


@in_whole
def test_processes_do_not_change_a_curve(tmp_path: Path) -> None:
    """The points are those of one process."""
    file = tmp_path / "sdirk.yaml"
    file.write_text(SDIRK, encoding="utf-8")
    asked = "design", str(file), "--search", "20", "--front", "error", "D", "--format", "csv"
    assert gark(*asked, "-j", "1").out == gark(*asked, "-j", "2").out
