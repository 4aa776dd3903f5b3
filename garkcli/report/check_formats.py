"""The formats of ``gark check``: one file each, named here."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from garkcli.check.outcome import Outcome
    from garkcli.page.paint import Paint

Renderer: TypeAlias = "Callable[[Sequence[Outcome], Paint, int, int | None], str]"


def _text(outcomes: Sequence[Outcome], paint: Paint, verbosity: int, digits: int | None) -> str:
    from garkcli.report import check_text

    return check_text.render(outcomes, paint, verbosity, digits)


def _machine(module: str) -> Renderer:
    """A format that is always the same: the ``render`` of its file, which is imported when used."""

    def render(
        outcomes: Sequence[Outcome], paint: Paint, verbosity: int, digits: int | None
    ) -> str:
        del paint, verbosity, digits  # for people
        text: str = import_module(f"garkcli.report.{module}").render(outcomes)
        return text

    return render


FORMATS: Mapping[str, Renderer] = {
    "text": _text,
    "json": _machine("check_json"),
    "sarif": _machine("check_sarif"),
    "junit": _machine("check_junit"),
    "github": _machine("check_github"),
    "markdown": _machine("check_markdown"),
}
"""Each choice of ``--format`` with what writes it."""
