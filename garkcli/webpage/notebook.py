"""How a notebook shows runs: what their commands tell, and a picture."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from typing import TypeVar

from garkcli.convergence.result import Convergence
from garkcli.longtime.history import LongRun
from garkcli.plots.scene import Panel
from garkcli.plots.svg import svg
from garkcli.report.rendering import html
from garkcli.webpage.pictures import NotDrawn, energy, errors

T = TypeVar("T")


def convergence_html(result: Convergence) -> str:
    """What ``gark converge`` tells, and the errors in a picture."""
    return _shown(html(result), errors, result)


def long_run_html(run: LongRun) -> str:
    """What ``gark energy`` tells, and the error of the first invariant in a picture."""
    return _shown(html(run), energy, run)


def _shown(report: str, draw: Callable[[T], Panel], result: T) -> str:
    """The report, and below it the picture where there is one."""
    with suppress(NotDrawn):
        return f'{report}<div style="max-width:32rem">{svg(draw(result))}</div>'
    return report
