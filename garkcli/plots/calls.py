"""Figures as a call."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from garkcli.convergence.result import Convergence
from garkcli.errors import MethodError
from garkcli.longtime.history import LongRun
from garkcli.plots.saving import check_suffix, need_matplotlib, save
from garkcli.report.stability_data import StabilityReport
from garkcli.report.sweep import SweepReport
from garkcli.stability.summary import Stability

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_CURE = "give what converge, long_run, find_stability or run_sweep returned"


def plot(
    *results: Convergence | LongRun | Stability | SweepReport,
    path: str | os.PathLike[str] | None = None,
    names: Sequence[str] = (),
    against: str = "h",
    is_order_star: bool = False,
) -> Figure:
    """A figure of results, as ``--plot`` draws it; needs ``garkcli[plot]``.

    Args:
        results: what ``converge``, ``long_run``, ``find_stability`` or ``run_sweep`` returned;
            several convergence tests or stabilities are drawn together.
        path: where to save it besides: .png, .svg or .pdf.
        names: of the methods, one a result.
        against: of convergence tests: ``"h"``, ``"evaluations"`` or ``"seconds"``.
        is_order_star: of stability: draw |R(z)| > |e^z| in place of |R(z)| ≤ 1.

    Returns:
        A figure of matplotlib.

    Raises:
        MethodError: there is nothing to draw, or the results are of several kinds.
        UsageProblem: matplotlib is not there, or the path has another suffix.

    >>> from garkcli import find_stability
    >>> type(plot(find_stability("rk4"), names=["RK4"])).__name__
    'Figure'
    """
    need_matplotlib()
    if path is not None:
        check_suffix(Path(path))
    labels = [*names, *[""] * (len(results) - len(names))]
    figure = _figure(results, labels, against, is_order_star)
    if path is not None:
        save(figure, Path(path))
    return figure


def _figure(
    results: Sequence[Any], names: Sequence[str], against: str, is_order_star: bool
) -> Figure:
    if not results:
        raise MethodError("there is nothing to draw", _CURE)
    kind = type(results[0])
    if any(type(result) is not kind for result in results):
        raise MethodError("the results are of several kinds", "draw them apart")
    if kind is Convergence:
        return _errors(results, names, against)
    if kind is Stability:
        from garkcli.plots.stability_plot import stability_figure

        reports = [
            StabilityReport(name, name, found) for name, found in zip(names, results, strict=True)
        ]
        return stability_figure(reports, is_order_star)
    if len(results) > 1:
        raise MethodError("several are not drawn together", "draw them apart")
    (result,) = results
    if isinstance(result, LongRun):
        from garkcli.plots.energy_plot import energy_figure

        return energy_figure(result)
    if isinstance(result, SweepReport):
        return _front(result)
    raise MethodError(f"there is no figure of the kind {kind.__name__}", _CURE)


def _errors(results: Sequence[Convergence], names: Sequence[str], against: str) -> Figure:
    from garkcli.plots.convergence_plot import comparison_figure, convergence_figure

    if len(results) == 1 and against == "h":
        return convergence_figure(results[0], names[0])
    return comparison_figure(list(zip(names, results, strict=True)), against)


def _front(report: SweepReport) -> Figure:
    from garkcli.plots.sweep_plot import sweep_figure

    if len(report.plan.pareto) < 2:
        raise MethodError("the sweep compares no two columns", "say pareto: [x, y] in its file")
    x, y = report.plan.pareto[:2]
    return sweep_figure(report, x, y)
