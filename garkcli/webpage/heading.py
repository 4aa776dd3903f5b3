"""A method in a sentence, and its row in the comparison of several."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from garkcli.check.analysis import Analysis
from garkcli.check.every_value import EveryValue
from garkcli.check.outcome import Outcome
from garkcli.errors import counted
from garkcli.exact.display import decimal
from garkcli.report.check import METHOD
from garkcli.tell.dialect import Plain
from garkcli.tell.outputs import words
from garkcli.webpage.reported import Reported
from garkcli.webpage.sections.orders import order_number, said

MARKS = {0: "holds", 1: "fails", 2: "fault", 3: "fault"}
"""The class of a verdict, by the exit code of ``gark check``."""


@dataclass(frozen=True)
class Heading:
    """What stands above the sections of a method.

    Attributes:
        title: its name.
        file: the file or the name that it came from.
        about: what is judged, and in which arithmetic.
        verdict: in a sentence or two.
        mark: holds, fails or fault.
        description: what its file says of it.
    """

    title: str
    file: str
    about: str
    verdict: str
    mark: str
    description: str


def heading(method: Reported) -> Heading:
    """What stands above the sections of a method."""
    outcome = method.outcome
    return Heading(
        outcome.name,
        outcome.file,
        _about(outcome),
        _verdict(outcome),
        _mark(outcome),
        method.description,
    )


def _mark(outcome: Outcome) -> str:
    return MARKS[outcome.exit_code]


def _about(outcome: Outcome) -> str:
    """What is judged, and in which arithmetic."""
    return words(METHOD.fact(outcome), Plain()) if outcome.is_read else ""


def _verdict(outcome: Outcome) -> str:
    """The order, what decided it, symplecticity, and what becomes of the claims."""
    if not outcome.is_read:
        faults = counted(len(outcome.faults), "fault")
        return f"The file cannot be read as a method: {faults}."
    return f"{_found(outcome)} {claims_text(outcome)}"


def _found(outcome: Outcome) -> str:
    every = outcome.every
    if every is not None:
        names = ", ".join(every.parameters)
        return f"Order {every.order.order} for every value of {names}."
    analysis = outcome.analysis
    assert analysis is not None
    number = order_number(analysis.order)
    text, _ = said(analysis.order)
    return f"Order {number}. {text} {_symplectic(analysis)}"


def _symplectic(analysis: Analysis) -> str:
    if not analysis.symplectic:
        return "Not symplectic."
    if analysis.tolerance is None:
        return "Symplectic."
    return f"Symplectic within {decimal(analysis.tolerance)}."


def claims_text(outcome: Outcome) -> str:
    """What becomes of the claims, in a sentence."""
    if not outcome.claims:
        return "Nothing is claimed of it."
    claims = counted(len(outcome.claims), "claim")
    failed = len(outcome.failed_claims)
    if failed:
        verb = "fails" if failed == 1 else "fail"
        return f"Of {claims}, {failed} {verb}."
    if len(outcome.claims) == 1:
        return "The one claim of its file holds."
    return f"All {claims} of its file hold."


def comparison_row(method: Reported) -> dict[str, Any]:
    """A method among others: its numbers, as ``gark check --format json`` has them."""
    data = method.data
    outcome = method.outcome
    analysis = outcome.analysis
    cells: dict[str, str] = dict.fromkeys(COLUMNS, "–")
    if outcome.every is not None:
        cells |= _of_family(outcome.every)
    if analysis is not None:
        cells |= _cells(data)
        cells["order"] = order_number(analysis.order)
        cells["how"] = said(analysis.order)[1]
    cells["claims"] = _claims(outcome)
    return {
        "title": outcome.name,
        "mark": "none" if outcome.makes_no_claim else _mark(outcome),
        "cells": cells,
    }


COLUMNS = (
    "claims",
    "order",
    "how",
    "embedded",
    "conjugate",
    "pair",
    "symplectic",
    "symmetric",
    "stage order",
    "stages",
)
"""Of the comparison; the first has the verdict."""
_WORDS = {True: "yes", False: "no", None: "–"}


def _cells(data: dict[str, Any]) -> dict[str, str]:
    properties = data["properties"]
    found = {
        "embedded": data["embedded_order"],
        "conjugate": data["conjugate_order"],
        "pair": data["pair_order"],
        "stage order": properties["stage_order"],
    }
    cells = {key: "–" if number is None else str(number) for key, number in found.items()}
    stages = [str(colour["stages"]) for colour in data["colours"]]
    cells["stages"] = ", ".join(stages)
    cells["symplectic"] = _WORDS[data["symplectic"]]
    cells["symmetric"] = _WORDS[properties["symmetric"]]
    return cells


def _of_family(every: EveryValue) -> dict[str, str]:
    """Orders for every value of the parameters."""
    found = {
        "order": every.order,
        "embedded": every.embedded,
        "conjugate": every.conjugate,
        "pair": every.pair,
    }
    cells = {key: "–" if order is None else str(order.order) for key, order in found.items()}
    tableau = every.tableau
    stages = [str(tableau.space(l).stages) for l in range(tableau.size)]
    return {**cells, "how": "for every value", "stages": ", ".join(stages)}


def _claims(outcome: Outcome) -> str:
    if not outcome.is_read:
        return "cannot be read"
    if not outcome.claims:
        return "none"
    failed = len(outcome.failed_claims)
    return f"{failed} of {len(outcome.claims)} fail" if failed else "all hold"
