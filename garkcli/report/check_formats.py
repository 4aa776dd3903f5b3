"""The formats of ``gark check``: each is named here."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, TypeAlias

from garkcli.check.outcome import Outcome

if TYPE_CHECKING:
    from garkcli.page.look import Look

Renderer: TypeAlias = "Callable[[Sequence[Outcome], Look, int, int | None, int], str]"
MACHINES = ("sarif", "junit", "github")


def _render(
    format: str,
    outcomes: Sequence[Outcome],
    look: Look,
    verbosity: int,
    digits: int | None,
    width: int,
) -> str:
    if format == "text":
        from garkcli.report import check_text

        return check_text.render(outcomes, look, verbosity, digits, width)
    from garkcli.report import check_findings
    from garkcli.report.checked import REPORT

    if format in MACHINES:
        return str(getattr(check_findings, format)(outcomes))
    text = REPORT.render(outcomes, format, look, verbosity, places=digits, width=width)
    return text + check_findings.markdown_findings(outcomes) if format == "markdown" else text


FORMATS: Mapping[str, Renderer] = {
    format: partial(_render, format) for format in ("text", "json", *MACHINES, "markdown", "latex")
}
