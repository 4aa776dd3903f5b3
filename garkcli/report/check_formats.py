"""The formats of ``gark check``: each is named here."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TypeAlias

from garkcli.check.outcome import Outcome
from garkcli.page.paint import Paint

Renderer: TypeAlias = "Callable[[Sequence[Outcome], Paint, int, int | None, int], str]"


def _text(
    outcomes: Sequence[Outcome], paint: Paint, verbosity: int, digits: int | None, width: int
) -> str:
    from garkcli.report import check_text

    return check_text.render(outcomes, paint, verbosity, digits, width)


def _told(format: str) -> Renderer:
    """A format of all results; findings follow a table."""

    def render(
        outcomes: Sequence[Outcome], paint: Paint, verbosity: int, digits: int | None, width: int
    ) -> str:
        from garkcli.report.check_findings import markdown_findings
        from garkcli.report.checked import REPORT

        text = REPORT.render(outcomes, format, paint, verbosity, places=digits, width=width)
        return text + markdown_findings(outcomes) if format == "markdown" else text

    return render


def _machine(name: str) -> Renderer:
    """A format that is always the same: a function of a file that is imported when used."""

    def render(
        outcomes: Sequence[Outcome], paint: Paint, verbosity: int, digits: int | None, width: int
    ) -> str:
        del paint, verbosity, digits, width  # for people
        from garkcli.report import check_findings

        text: str = getattr(check_findings, name)(outcomes)
        return text

    return render


FORMATS: Mapping[str, Renderer] = {
    "text": _text,
    "json": _told("json"),
    "sarif": _machine("sarif"),
    "junit": _machine("junit"),
    "github": _machine("github"),
    "markdown": _told("markdown"),
    "latex": _told("latex"),
}
"""Each choice of ``--format`` with what writes it."""
