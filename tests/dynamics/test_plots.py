"""Plots of results, in text and as files."""

from __future__ import annotations

from pathlib import Path

import pytest
from flint import arb, fmpq
from matplotlib.figure import Figure

from garkcli.dynamics.convergence import Convergence, converge
from garkcli.dynamics.energy import drift
from garkcli.dynamics.problems import Oscillator
from garkcli.errors import UsageProblem
from garkcli.families.registry import diagonal_method
from garkcli.report.asciiplot import terminal_plot
from garkcli.report.energy_plot import drift_figure
from garkcli.report.plot import convergence_figure, save
from garkcli.tableau.forms import gark

OSCILLATOR = Oscillator.default(1, fmpq(1))


def result_of(name: str, s: int | None = None) -> Convergence:
    """The convergence test of one method."""
    return converge(gark([diagonal_method(name, s)], {}), OSCILLATOR)


def test_terminal_plot_is_a_straight_line() -> None:
    """Points of error = h² rise from the lower left to the upper right corner, in equal steps."""
    h = [10.0**-k for k in range(4)]
    lines = terminal_plot(h, [x**2 for x in h], width=31, height=7).splitlines()
    at = [(i, line.index("•")) for i, line in enumerate(lines) if "•" in line]
    assert [i for i, _ in at] == [1, 3, 5, 7]
    assert [at[k][1] - at[k + 1][1] for k in range(3)] == [10, 10, 10]


@pytest.mark.parametrize("name", ["explicit-euler", "rk4"])
def test_terminal_plot_fits_the_terminal(name: str) -> None:
    """Every point is there, the reference line too, within 80 columns."""
    result = result_of(name)
    text = terminal_plot([r.h for r in result.rows], [r.error for r in result.rows], order=result.visible_order)
    lines = text.splitlines()
    assert len(lines) == 16 + 3
    assert max(map(len, lines)) <= 80
    assert text.count("•") == len(result.rows)
    assert "·" in text


def test_terminal_plot_below_the_floats() -> None:
    """Errors that no float can hold are plotted all the same."""
    tiny = [arb(10) ** -(k * 400) for k in (1, 2, 3)]
    text = terminal_plot([fmpq(1), fmpq(1, 2), fmpq(1, 4)], tiny)
    assert "1e-400" in text
    assert text.count("•") == 3


def test_terminal_plot_of_little() -> None:
    """One point has a plot, none has words."""
    assert terminal_plot([0.5], [0.1]).count("•") == 1
    assert terminal_plot([0.5], [0.0]) == "no positive errors to plot"


@pytest.mark.parametrize(("suffix", "start"), [(".png", b"\x89PNG"), (".svg", b"<?xml"), (".pdf", b"%PDF")])
def test_figures_are_saved(tmp_path: Path, suffix: str, start: bytes) -> None:
    """Each format is what its name says, nothing else is left behind, and an old file is replaced."""
    path = tmp_path / f"figure{suffix}"
    path.write_text("old")
    save(convergence_figure(result_of("rk4")), path)
    assert path.read_bytes().startswith(start)
    assert path.stat().st_size > 5000
    assert list(tmp_path.iterdir()) == [path]


def test_convergence_figure_shows_the_result() -> None:
    """Its lines are the errors, the energy errors and a reference of the right slope; all are labelled."""
    result = result_of("rk4")
    (axes,) = convergence_figure(result).axes
    error, energy, reference = axes.get_lines()
    assert list(error.get_ydata()) == pytest.approx([float(r.error) for r in result.rows])
    assert list(energy.get_ydata()) == pytest.approx([float(r.energy_error) for r in result.rows])
    x, y = reference.get_xdata(), reference.get_ydata()
    assert y[0] / y[1] == pytest.approx((x[0] / x[1]) ** 4)
    assert reference.get_label() == "reference, slope 4"
    assert (axes.get_xscale(), axes.get_yscale()) == ("log", "log")


@pytest.mark.parametrize(("name", "s"), [("gauss", 2), ("gauss", 40), ("explicit-euler", None)])
def test_figures_without_energy_errors_or_floats(tmp_path: Path, name: str, s: int | None) -> None:
    """Exact conservation and errors below 1e-308 have figures too."""
    path = tmp_path / "figure.svg"
    save(convergence_figure(result_of(name, s)), path)
    assert path.stat().st_size > 5000


@pytest.mark.parametrize("name", ["rk4", "explicit-euler", "gauss"])
def test_drift_figure(tmp_path: Path, name: str) -> None:
    """Small, exploded and zero energy errors all make a figure of the series."""
    tableau = gark([diagonal_method(name, 2 if name == "gauss" else None)], {})
    result = drift(tableau, OSCILLATOR, fmpq(1000), fmpq(1, 2))
    figure = drift_figure(result)
    assert list(figure.axes[0].get_lines()[0].get_ydata()) == list(result.energy_errors)
    save(figure, tmp_path / "drift.png")
    assert (tmp_path / "drift.png").stat().st_size > 5000


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
