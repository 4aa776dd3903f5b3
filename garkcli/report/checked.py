"""The rows of ``gark check``, by the kind of the method."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from garkcli.check.outcome import Outcome
from garkcli.frozen import replace
from garkcli.report.check import CHECKED, SUMMARY, UNREADABLE
from garkcli.tell.facts import Section, itself
from garkcli.tell.parts import part
from garkcli.tell.report import DialectSigns, Report

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.check.outcome import OtherAnalysis


def _signs(outcome: Outcome) -> DialectSigns:
    found = outcome.found
    if found is None:
        return {}
    names: DialectSigns = {"colours": [colour.name for colour in found.tableau.colours]}
    if not found.tableau.has_fields_alone:
        names["names"] = names["colours"]
    if outcome.every is None:
        return names
    return {**names, "parameter": next(iter(outcome.every.parameters), "")}


def form(outcome: Outcome) -> Section[Outcome]:
    if outcome.every is not None:
        from garkcli.report.every import EVERY

        return EVERY
    if outcome.of_other_kind is not None:
        from garkcli.report.other_methods import TOLD_BY

        return TOLD_BY[type(outcome.of_other_kind).__name__][0]
    return UNREADABLE if outcome.analysis is None else CHECKED


def forms() -> Iterator[Section[Outcome]]:
    from garkcli.report.every import EVERY
    from garkcli.report.other_methods import TOLD_BY

    yield from (UNREADABLE, CHECKED, EVERY, *(form for form, _ in TOLD_BY.values()))


REPORT: Report[Outcome] = Report(
    "gark/check/1",
    "report of gark check",
    forms,
    form,
    _signs,
    tail=Section(itself("summary", part(SUMMARY))),
    is_open=True,
    letters=lambda x: None if x.analysis is None else x.analysis.tableau,
    taken="ξηζ",
)


OF_ANALYSES = {
    "Analysis": "analysis",
    "RosenbrockAnalysis": "rosenbrock",
    "NystromAnalysis": "nystrom",
    "NprkAnalysis": "nprk",
    "DerivativesAnalysis": "derivatives",
    "InfinitesimalAnalysis": "infinitesimal",
}


def whole(found: Outcome | Analysis | OtherAnalysis, name: str) -> Outcome:
    """The outcome itself, or one of an analysis and a name."""
    if isinstance(found, Outcome):
        return found
    return replace(Outcome(name, name), **{OF_ANALYSES[type(found).__name__]: found})
