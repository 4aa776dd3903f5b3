"""The report of ``gark check``: which rows tell of a file."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from garkcli.check.outcome import Outcome
from garkcli.frozen import replace
from garkcli.report.check import CHECKED, SUMMARY, UNREADABLE
from garkcli.tell.facts import Row, Section
from garkcli.tell.parts import part
from garkcli.tell.report import Report, Signs

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.check.outcome import OtherAnalysis


def _signs(outcome: Outcome) -> Signs:
    found = outcome.found
    if found is None:
        return {}
    names: Signs = {"colours": [colour.name for colour in found.tableau.colours]}
    if not found.tableau.has_fields_alone:
        names["names"] = names["colours"]
    if outcome.every is None:
        return names
    return {**names, "parameter": next(iter(outcome.every.parameters), "")}


def form(outcome: Outcome) -> Section[Outcome]:
    """The rows of a file: of a method, of a family, of one that cannot be read."""
    if outcome.every is not None:
        from garkcli.report.every import EVERY

        return EVERY
    if outcome.rosenbrock is not None:
        from garkcli.report.rosenbrock import ROSENBROCK

        return ROSENBROCK
    if outcome.nystrom is not None:
        from garkcli.report.nystrom import NYSTROM

        return NYSTROM
    if outcome.nprk is not None:
        from garkcli.report.nprk import NPRK

        return NPRK
    if outcome.derivatives is not None:
        from garkcli.report.derivatives import DERIVATIVES

        return DERIVATIVES
    if outcome.infinitesimal is not None:
        from garkcli.report.infinitesimal import INFINITESIMAL

        return INFINITESIMAL
    return UNREADABLE if outcome.analysis is None else CHECKED


def forms() -> Iterator[Section[Outcome]]:
    """The rows of every kind of file."""
    from garkcli.report.derivatives import DERIVATIVES
    from garkcli.report.every import EVERY
    from garkcli.report.infinitesimal import INFINITESIMAL
    from garkcli.report.nprk import NPRK
    from garkcli.report.nystrom import NYSTROM
    from garkcli.report.rosenbrock import ROSENBROCK

    yield from (UNREADABLE, CHECKED, EVERY)
    yield from (ROSENBROCK, NYSTROM, NPRK, DERIVATIVES, INFINITESIMAL)


REPORT: Report[Outcome] = Report(
    "gark/check/1",
    "report of gark check",
    forms,
    form,
    _signs,
    tail=Section(Row("summary", part(SUMMARY), lambda xs: xs)),
    is_open=True,
)


OF_ANALYSES = {
    "Analysis": "analysis",
    "RosenbrockAnalysis": "rosenbrock",
    "NystromAnalysis": "nystrom",
    "NprkAnalysis": "nprk",
    "DerivativesAnalysis": "derivatives",
    "InfinitesimalAnalysis": "infinitesimal",
}
"""Where an outcome has the analysis of a method."""


def whole(found: Outcome | Analysis | OtherAnalysis, name: str) -> Outcome:
    """The outcome that the report tells: itself, or of an analysis by a name."""
    if isinstance(found, Outcome):
        return found
    return replace(Outcome(name, name), **{OF_ANALYSES[type(found).__name__]: found})
