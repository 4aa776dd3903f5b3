"""B, C and D for each block, and their bounds of the order."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from markupsafe import Markup

from garkcli.check.every_facts import FamilyFact
from garkcli.check.findings import BOUND, SHARP_BOUND
from garkcli.order.simplifying import Simplifying
from garkcli.webpage.mathml import typeset
from garkcli.webpage.reported import Content, Reported

_GREEK = {"η": r"\eta ", "ζ": r"\zeta ", "ξ": r"\xi ", "χ": r"\chi "}
_LEVELS = 6
"""Shades of the grid; larger numbers have the last one."""


def content(method: Reported) -> Content | None:
    whole: Any = method.outcome.analysis or method.outcome.every
    if whole is None or not method.has_details:
        return None
    found, told = whole.simplifying, whole  # the bounds as far as the order bears them out
    if isinstance(found, FamilyFact):
        found = told = found.value
    if not isinstance(found, Simplifying):
        return None
    return {
        "names": [colour.name for colour in whole.tableau.colours],
        "B": _cells(found.B, found.limit),
        "C": [_cells(row, found.limit) for row in found.C],
        "D": [_cells(row, found.limit) for row in found.D],
        "captions": {
            letter: typeset(latex, letter)
            for letter, latex in {"B": "B(r)", "C": r"C(\eta)", "D": r"D(\zeta)"}.items()
        },
        "numbers": _numbers(found),
        "bounds": [
            ("bound", found.bound, _formula(BOUND), told.bound),
            ("sharper bound", found.sharp_bound, _formula(SHARP_BOUND), told.sharp_bound),
        ],
        "every": method.outcome.every,
    }


def _cells(numbers: Sequence[int | None], limit: int) -> list[tuple[str, int | None]]:
    """Returns the text and the shade of each cell; no shade without a block."""
    found: list[tuple[str, int | None]] = []
    for number in numbers:
        if number is None:
            found.append(("–", None))
            continue
        text = f"≥ {number}" if number >= limit else str(number)
        found.append((text, max(0, min(number, _LEVELS))))
    return found


def _formula(text: str) -> Markup:
    latex = text.replace("min{", r"\min\{").replace("}", r"\}")
    for letter, name in _GREEK.items():
        latex = latex.replace(letter, name)
    return typeset(latex, text)


def _numbers(found: Simplifying) -> list[Markup]:
    """Returns the numbers of the bounds; those that reached the limit may be larger."""
    numbers = {"r": found.r, "η": found.eta, "ζ": found.zeta, "ξ": found.xi, "χ": found.chi}
    shown = []
    for name, number in numbers.items():
        sign, latex = ("≥", r"\ge ") if found.is_open(number) else ("=", "=")
        shown.append(typeset(f"{_GREEK.get(name, name)}{latex}{number}", f"{name} {sign} {number}"))
    return shown
