"""A method in a sentence, and its row in the comparison of several."""

from __future__ import annotations

from markupsafe import Markup

from garkcli.check.outcome import Outcome
from garkcli.errors import counted
from garkcli.report.check import METHOD, truth
from garkcli.report.checked import REPORT
from garkcli.tell.dialect import Plain
from garkcli.tell.outputs import cell, phrase, words
from garkcli.webpage.mathml import Typeset
from garkcli.webpage.reported import Content, Reported

MARKS = {0: "holds", 1: "fails", 2: "fault", 3: "fault"}
"""The class of a verdict, by the exit code of ``gark check``."""


def heading(method: Reported) -> Content:
    """Returns the text above the sections of a method: the arithmetic, the verdict and the file."""
    outcome = method.outcome
    verdict = f"The file cannot be read as a method: {counted(len(outcome.faults), 'fault')}."
    if outcome.is_read:
        verdict = f"{_found(outcome)} {claims_text(outcome)}"
    return {
        "title": outcome.name,
        "file": outcome.file,
        "about": _about(outcome) if outcome.is_read else "",
        "verdict": Markup(verdict),
        "mark": _mark(outcome),
        "description": method.description,
    }


def _about(outcome: Outcome) -> str:
    """Returns the kind of a method and its number of stages."""
    if outcome.of_other_kind is None:
        return words(METHOD.fact(outcome), Plain())
    row = next(x for x in REPORT.form(outcome).rows if x.key == METHOD.key)
    return Markup(words(row.fact(outcome), Typeset()))


def _mark(outcome: Outcome) -> str:
    return "open" if outcome.is_open else MARKS[outcome.exit_code]


def _found(outcome: Outcome) -> str:
    """Returns the order and the properties, as in ``gark check``."""
    d = Typeset(**REPORT.signs(outcome))
    facts = REPORT.form(outcome).named(outcome, ("order", "symplectic", "stability"))
    if outcome.every is not None:
        parameters = ", ".join(map(d.expression, outcome.every.parameters))
        return f"Order {cell(facts['order'], d)} of {parameters}."
    facts = {key: x for key, x in facts.items() if x.is_something}
    said = [words(x, d) if key == "stability" else phrase(x, d) for key, x in facts.items()]
    return " ".join(f"{x[:1].upper()}{x[1:]}." for x in said)


def claims_text(outcome: Outcome) -> str:
    """Returns the result for the claims in a sentence."""
    if not outcome.claims:
        return "Its file claims nothing."
    claims = counted(len(outcome.claims), "claim")
    failed, left_open = len(outcome.failed_claims), len(outcome.undecided_claims)
    if len(outcome.claims) == 1:
        verdict = "fails" if failed else "is undecided" if left_open else "holds"
        return f"The claim of its file {verdict}."
    told = [f"{failed} fail{'s' if failed == 1 else ''}"] if failed else []
    told += [f"{left_open} {'is' if left_open == 1 else 'are'} undecided"] if left_open else []
    if told:
        return f"Of its {claims}, {' and '.join(told)}."
    return f"All {claims} of its file hold."


COLUMNS = {
    "claims": "claims_in_brief",
    "order": "order",
    "embedded": "embedded_order",
    "conjugate": "conjugate_order",
    "pair": "pair_order",
    "symplectic": "symplectic",
    "symmetric": "",
    "stage order": "stage_order",
    "stages": "",
}
"""The columns of the comparison, with the rows of ``gark check`` that they show."""


def comparison_row(method: Reported) -> Content:
    """Returns the row of a method in the comparison."""
    outcome = method.outcome
    cells: dict[str, str] = dict.fromkeys(COLUMNS, "–")
    d = REPORT.dialect(outcome, "text")
    facts = REPORT.form(outcome).named(outcome, COLUMNS.values())
    for column, key in COLUMNS.items():
        if key in facts and facts[key].value is not None:
            cells[column] = cell(facts[key], d)
    if method.stages:
        cells["stages"] = ", ".join(map(str, method.stages))
    if outcome.analysis is not None:
        cells["symmetric"] = cell(truth("symmetric").fact(outcome.analysis), d)
    mark = "none" if outcome.makes_no_claim else _mark(outcome)
    return {"title": outcome.name, "mark": mark, "cells": cells}
