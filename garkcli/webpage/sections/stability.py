"""Stability on linear, oscillating and contractive problems, decided exactly."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from garkcli.api.calls import find_stability
from garkcli.constructions.derivatives import is_derivatives
from garkcli.constructions.nprk import is_nprk
from garkcli.constructions.nystrom import Nystrom, is_nystrom
from garkcli.exact.display import decimal
from garkcli.report.stability import REPORT, StabilityReport, formulas
from garkcli.tableau.tableau import Tableau
from garkcli.tell.facts import Level
from garkcli.webpage.mathml import Typeset, typeset
from garkcli.webpage.reported import Content, Reported

_TYPESET = ("R", "R_alike", "trace", "determinant")
_LONGEST = 400
"""Longer formulas in LaTeX are left to ``gark stability``."""


def _has_stability(tableau: Tableau) -> bool:
    if is_nystrom(tableau):
        return Nystrom.of(tableau).A is None
    return is_derivatives(tableau) or (tableau.exact_to is None and not is_nprk(tableau))


def _together(facts: Sequence[tuple[str, str]]) -> list[tuple[Markup, Markup]]:
    texts: dict[str, list[str]] = {}
    for label, text in facts:
        texts.setdefault(label, []).append(text)
    return [(Markup(label), Markup("; ".join(found))) for label, found in texts.items()]


def content(method: Reported) -> Content | None:
    file = method.outcome.file
    if method.free is not None:
        return {"free": method.free, "file": file}
    if method.method is None or not _has_stability(method.method.tableau):
        return None
    if method.is_slow:
        return {"file": file, "near": ""}
    shown = StabilityReport("", "", find_stability(method.method))
    level = Level.DETAIL if method.has_details else Level.USUAL
    named = [*formulas(shown.found)]
    if not method.has_details:  # the oscillator is drawn, or R(z) tells more
        named = [x for x in named if "M(x)" not in x[0]]
    told = REPORT.labelled(shown, Typeset(**REPORT.signs(shown)), level, _TYPESET)
    return {
        "formulas": [typeset(f"{x} {y}") for x, y in named if len(y) <= _LONGEST],
        "parts": [(Markup(title), _together(facts)) for title, facts in told],
        "near": method.tolerance and decimal(method.tolerance),
        "file": file,
    }
