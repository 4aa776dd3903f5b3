"""Plots of results, in text and as files."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from flint import arb, fmpq
from hypothesis import given
from hypothesis import strategies as st
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgb
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from garkcli.convergence.convergence import converge
from garkcli.convergence.result import Convergence
from garkcli.errors import UsageProblem
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.plots import saving
from garkcli.plots.convergence import errors_scene
from garkcli.plots.figure import figure as draw
from garkcli.plots.saving import check_suffix, save
from garkcli.plots.scene import Curve, RuledLine, logarithmic_marks
from garkcli.problems.oscillator import Oscillator
from garkcli.tableau.forms import gark
from tests.whole import in_whole

OSCILLATOR = Oscillator.default(1, fmpq(1))


TINY = tuple(fmpq(1, 2**k) for k in (34, 36, 38, 40))
"""Steps with which Gauss 16 has errors no float reaches."""


def convergence_figure(result: Convergence, name: str) -> Figure:
    """The figure of one method."""
    return draw(errors_scene([(name, result)]))


def comparison_figure(named: Sequence[tuple[str, Convergence]], against: str = "h") -> Figure:
    """The figure of several."""
    return draw(errors_scene(named, against))


def names_in(figure: Figure) -> list[str]:
    """What the legend of a figure says."""
    legend = figure.axes[0].get_legend()
    return [] if legend is None else [text.get_text() for text in legend.get_texts()]


@cache
def result_of(
    name: str, s: int | None = None, steps: tuple[fmpq, ...] | None = None
) -> Convergence:
    """The convergence test of one method, once."""
    return converge(gark([diagonal_method(name, s)], {}), OSCILLATOR, steps=steps)


def beyond_floats() -> Convergence:
    """All its errors are below 1e-308."""
    result = result_of("gauss", 16, TINY)
    assert all(row.error < fmpq(1, 10**308) for row in result.rows)
    return result


@in_whole
@pytest.mark.parametrize(
    ("suffix", "start"), [(".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")]
)
def test_figures_are_saved(tmp_path: Path, suffix: str, start: bytes) -> None:
    """Each format is what its name says, nothing else is left behind, and an old file is
    replaced.
    """
    path = tmp_path / f"figure{suffix}"
    path.write_text("old")
    save(convergence_figure(result_of("rk4"), "method"), path)
    assert path.read_bytes().startswith(start)
    assert path.stat().st_size > 5000
    assert list(tmp_path.iterdir()) == [path]


def test_convergence_figure_shows_the_result() -> None:
    """Its lines are the errors, a reference of the right slope, and the energy errors, in decimal
    logarithms; all are labelled, and the marks below are the step sizes.
    """
    result = result_of("rk4")
    figure = convergence_figure(result, "a method")
    (axes,) = figure.axes
    error, reference, energy = axes.get_lines()
    assert 10 ** error.get_ydata() == pytest.approx([float(r.error) for r in result.rows])
    assert 10 ** energy.get_ydata() == pytest.approx([float(r.energy_error) for r in result.rows])
    assert _slope(reference) == pytest.approx(4)
    assert names_in(figure) == ["error", "reference, slope 4", "energy error"]
    marks = {
        text.get_text(): x
        for text, x in zip(axes.get_xticklabels(), axes.get_xticks(), strict=True)
    }
    assert marks["1/8"] == pytest.approx(np.log10(1 / 8))


def _slope(line: Line2D) -> float:
    (a, b), (c, d) = line.get_xdata(), line.get_ydata()
    return float((d - c) / (b - a))


def test_comparison_figure_shows_every_method() -> None:
    """Errors with a mark and a dash each, a line a visible order with its slope, and all names in
    the legend.
    """
    names = ("explicit-euler", "rk4", "heun", "kutta", "rk4")
    named = [(f"{k}, {name}", result_of(name)) for k, name in enumerate(names)]
    figure = comparison_figure(named)
    (axes,) = figure.axes
    *slopes, _, _, _, _, _ = axes.get_lines()
    curves = axes.get_lines()[-5:]
    for drawn, (_, result) in zip(curves, named, strict=True):
        assert 10 ** drawn.get_ydata() == pytest.approx([float(row.error) for row in result.rows])
    assert len({(x.get_marker(), x.get_linestyle()) for x in curves}) >= 4
    assert sorted(round(_slope(line), 9) for line in slopes) == [1, 2, 3, 4]
    assert sorted(text.get_text() for text in axes.texts) == [f"slope {p}" for p in (1, 2, 3, 4)]
    assert names_in(figure) == [name for name, _ in named]


def test_comparison_figure_in_grey() -> None:
    """Without colours curves differ by marks, or by dashes where marks repeat; all stand out from
    white.
    """
    curves = (
        comparison_figure([(str(k), result_of("rk4")) for k in range(20)]).axes[0].get_lines()[-20:]
    )
    assert len({(x.get_marker(), str(x._dash_pattern)) for x in curves}) == 20
    for one, other in pairwise(curves):
        assert one.get_marker() != other.get_marker()
        assert one._dash_pattern != other._dash_pattern
    colours = [to_rgb(x.get_color()) for x in curves]
    assert max(0.299 * r + 0.587 * g + 0.114 * b for r, g, b in colours) < 0.6


@pytest.mark.parametrize("against", ["evaluations", "seconds"])
def test_work_figure(against: str) -> None:
    """Errors against what they cost; the line beside them falls as fast as the order says."""
    tableau = gark([diagonal_method("rk4")], {})
    result = converge(tableau, OSCILLATOR, is_timed=True)
    (panel,) = errors_scene([("rk4", result)], against).panels
    rule, curve = panel.shapes
    assert isinstance(curve, Curve)
    assert isinstance(rule, RuledLine)
    if against == "evaluations":
        assert [10**x for x, _ in curve.points] == pytest.approx(
            [row.cost.evaluations for row in result.rows if row.cost]
        )
    (a, c), (b, d) = rule.start, rule.end
    assert (d - c) / (b - a) == pytest.approx(-4)
    assert rule.label == "slope −4"


@in_whole
def test_names_are_no_formulas(tmp_path: Path) -> None:
    """Dollars, braces, a first underscore, letters that the font has not, and a very long name are
    all drawn.
    """
    names = ["$x^{", "_hidden", "方法", "long " * 40]
    figure = comparison_figure([(name, result_of("rk4")) for name in names])
    shown = names_in(figure)
    assert shown[:3] == names[:3]
    assert len(shown[3]) < 80
    save(figure, tmp_path / "figure.svg")
    save(figure, tmp_path / "figure.pdf")


@in_whole
def test_figures_without_errors(tmp_path: Path) -> None:
    """Where a method makes no error there is nothing to draw but the axes, and that is no fault."""
    result = result_of("rk4")
    exact = replace(
        result,
        rows=(replace(result.rows[0], error=arb(0), energy_error=arb(0)),),
        observed_order=None,
    )
    for k, figure in enumerate(
        (convergence_figure(exact, "a method"), comparison_figure([("rk4", exact)]))
    ):
        assert figure.axes[0].get_lines() == []
        save(figure, tmp_path / f"{k}.png")
    mixed = comparison_figure([("exact", exact), ("rk4", result)])
    assert names_in(mixed) == ["rk4"]


@in_whole
def test_comparison_beyond_the_floats(tmp_path: Path) -> None:
    """Errors below 1e-308 beside large ones: logarithms are drawn instead."""
    path = tmp_path / "figure.svg"
    save(comparison_figure([("gauss 16", beyond_floats()), ("rk4", result_of("rk4"))]), path)
    assert path.stat().st_size > 5000


@pytest.mark.parametrize(
    ("name", "s", "steps"),
    [("gauss", 2, None), ("gauss", 16, TINY), ("explicit-euler", None, None)],
)
def test_figures_without_energy_errors_or_floats(
    tmp_path: Path, name: str, s: int | None, steps: tuple[fmpq, ...] | None
) -> None:
    """Exact conservation and errors below 1e-308 have figures too."""
    path = tmp_path / "figure.svg"
    save(convergence_figure(result_of(name, s, steps), "method"), path)
    assert path.stat().st_size > 5000


@pytest.mark.parametrize("name", ["figure.jpg", "figure", "figure.txt"])
def test_other_suffixes_are_refused(tmp_path: Path, name: str) -> None:
    """Before anything is written."""
    with pytest.raises(UsageProblem, match="no figure can be saved"):
        save(Figure(), tmp_path / name)
    assert not list(tmp_path.iterdir())


def test_failed_save_leaves_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A fault while drawing removes the half-written file and keeps the old one."""

    def fail(*_: object, **__: object) -> None:
        raise OSError("disk full")

    path = tmp_path / "figure.png"
    path.write_text("old")
    monkeypatch.setattr(Figure, "savefig", fail)
    with pytest.raises(OSError, match="disk full"):
        save(Figure(), path)
    assert [x.read_text() for x in tmp_path.iterdir()] == ["old"]


def _clearance(line: Line2D, curves: Sequence[Line2D]) -> float:
    """The least distance of a line from curves, in decades of the error."""
    (a, b), (c, d) = line.get_xdata(), line.get_ydata()
    least = float("inf")
    for x in np.linspace(a, b, 50):
        y = c + (d - c) * (x - a) / (b - a)
        for curve in curves:
            xs, ys = curve.get_xdata()[::-1], curve.get_ydata()[::-1]
            if xs[0] <= x <= xs[-1]:
                least = min(least, abs(y - np.interp(x, xs, ys)))
    return least


@in_whole
def test_lines_of_slopes_are_on_no_curve() -> None:
    """A second method whose errors are where the line of the first would be: the line is somewhere
    else.
    """
    result = result_of("rk4")
    for factor in (1e-3, 0.03, 0.3, 0.5, 2, 30):
        shifted = replace(
            result, rows=tuple(replace(row, error=row.error * factor) for row in result.rows)
        )
        (axes,) = comparison_figure([("one", result), ("other", shifted)]).axes
        line, *curves = axes.get_lines()
        errors = [y for x in curves for y in x.get_ydata()]
        assert _clearance(line, curves) > 0.03 * np.ptp(errors)


def test_the_reference_is_not_on_the_energy_error() -> None:
    """Energy errors may be a little above the errors, where the reference usually is."""
    steps = [fmpq(1, 2**k) for k in range(1, 9)]
    result = converge(gark([diagonal_method("rk4")], {}), OSCILLATOR, steps=steps)
    rows = tuple(replace(row, energy_error=row.error * 3) for row in result.rows)
    (axes,) = convergence_figure(replace(result, rows=rows), "rk4").axes
    error, line, energy = axes.get_lines()
    assert _clearance(line, [error, energy]) > 0.3


@pytest.mark.parametrize(
    ("steps", "shown"),
    [
        ((fmpq(1, 3), fmpq(1, 5), fmpq(1, 7)), ["1/3", "1/5", "1/7"]),
        (tuple(fmpq(1, k) for k in range(2, 40)), ["1/2", "1/4"]),
        ((fmpq(1, 2), fmpq(1, 100), fmpq(1, 1234567)), ["1/2", "1/100", "8.1·10⁻⁷"]),
    ],
)
def test_numbers_below_do_not_collide(steps: tuple[fmpq, ...], shown: list[str]) -> None:
    """The step sizes themselves are below, as many as there is space for, and never one on
    another.
    """
    tableau = gark([diagonal_method("rk4")], {})
    rows = tuple(replace(result_of("rk4").rows[0], h=h) for h in steps)
    result = replace(converge(tableau, OSCILLATOR), rows=rows)
    figure = comparison_figure([("rk4", result)])
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    labels = figure.axes[0].get_xticklabels()
    assert set(shown) <= {text.get_text() for text in labels}
    boxes = sorted((text.get_window_extent() for text in labels), key=lambda box: box.x0)
    assert all(one.x1 < other.x0 for one, other in pairwise(boxes))


@given(st.floats(-400, 400), st.floats(0.01, 300), st.integers(3, 9))
def test_marks_of_logarithms(low: float, width: float, most: int) -> None:
    """Marks lie between the ends, at most one more than asked for, and there is one at least where
    floats reach.
    """
    marks = logarithmic_marks(low, low + width, most)
    assert len(marks) <= most + 1
    assert all(low - 1e-6 <= x.at <= low + width + 1e-6 for x in marks)
    assert marks or width < 0.5


def test_a_figure_of_one_method_names_it() -> None:
    """In its title, a long name in lines of their own; dollars are no formula."""
    figure = convergence_figure(result_of("rk4"), "$the$ method " * 8)
    *names, last = figure.get_suptitle().splitlines()
    assert last == "Oscillator to t = 4: observed order 4.00"
    assert names[0].startswith("$the$ method")
    assert max(map(len, names)) <= 60


def test_who_has_no_matplotlib_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Before the work, with what to install."""
    check_suffix(tmp_path / "a.png")
    monkeypatch.setattr(saving, "find_spec", lambda _: None)
    with pytest.raises(UsageProblem, match="a figure needs matplotlib"):
        check_suffix(tmp_path / "a.png")
