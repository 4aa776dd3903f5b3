"""Figures from Python."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from garkcli.api.calls import find_stability
from garkcli.api.files import path_of
from garkcli.convergence.result import Convergence
from garkcli.design.stable_values import StableValues
from garkcli.errors import MethodError
from garkcli.longtime.history import LongRun
from garkcli.plots.convergence import errors_scene
from garkcli.plots.curves import energy_scene, stable_plane_scene, sweep_scene
from garkcli.plots.regions import stability_scene
from garkcli.plots.saving import check_suffix, need_matplotlib, save
from garkcli.plots.scene import Scene
from garkcli.stability.summary import Stability
from garkcli.sweep.report import SweepReport

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from garkcli.tableau.garkmethod import GarkMethod

_CURE = "give what converge, long_run, find_stability, run_sweep or stable_values returned"


def plot(
    *results: Convergence | LongRun | Stability | StableValues | SweepReport,
    path: str | os.PathLike[str] | None = None,
    names: Sequence[str] = (),
    against: str = "h",
    is_order_star: bool = False,
) -> Figure:
    """A figure of results, as ``--plot`` draws it; needs ``garkcli[plot]``.

    Args:
        results: of ``converge``, ``long_run``, ``find_stability``, ``run_sweep``, or
            ``stable_values`` of two parameters; several of the first or third kind are drawn
            together.
        path: where to save it besides: .png, .svg or .pdf.
        names: of the methods, one for each result.
        against: of convergence tests: ``"h"``, ``"evaluations"`` or ``"seconds"``.
        is_order_star: of stability: draw |R(z)| > |e^z| in place of |R(z)| ≤ 1.

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
    from garkcli.plots.figure import figure

    drawn = figure(_scene(results, labels, against, is_order_star))
    if path is not None:
        save(drawn, Path(path))
    return drawn


def plot_method(method: GarkMethod, path: str | os.PathLike[str] | None = None) -> Figure:
    """Plots the region of stability of a method, and saves it if a path is given."""
    if path is not None:
        path = path_of(path)
    return plot(find_stability(method), path=path, names=[method.name])


def _scene(
    results: Sequence[Any], names: Sequence[str], against: str, is_order_star: bool
) -> Scene:
    if not results:
        raise MethodError("there is nothing to draw", _CURE, code="arrays")
    kind = type(results[0])
    if any(type(result) is not kind for result in results):
        raise MethodError("the results are of several kinds", "draw them apart", code="arrays")
    named = list(zip(names, results, strict=True))
    if kind is Convergence:
        return errors_scene(named, against)
    if kind is Stability:
        return stability_scene(named, is_order_star)
    if len(results) > 1:
        raise MethodError("several are not drawn together", "draw them apart", code="arrays")
    (result,) = results
    if isinstance(result, LongRun):
        return energy_scene(result, names[0])
    if isinstance(result, StableValues) and result.is_plane:
        return stable_plane_scene(result, names[0] or result.family.name)
    if isinstance(result, SweepReport):
        if len(result.plan.pareto) < 2:
            message = "the sweep compares no two columns"
            raise MethodError(message, "say pareto: [x, y] in its file", code="arrays")
        return sweep_scene(result)
    raise MethodError(f"there is no figure of the kind {kind.__name__}", _CURE, code="arrays")
