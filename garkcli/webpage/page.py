"""The page of ``gark report``: its heading, its table of contents and its sections."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator, Sequence
from functools import cache
from hashlib import sha256
from importlib import import_module
from importlib.resources import files

from jinja2 import Environment, PackageLoader, StrictUndefined
from markupsafe import Markup

from garkcli.api.anymethod import AnyMethod
from garkcli.api.numbers import Whole, whole
from garkcli.check.outcome import Outcome
from garkcli.doing import doing
from garkcli.errors import MethodError, counted, printable
from garkcli.frozen import replace
from garkcli.plots.svg import STYLE
from garkcli.report.check import METHOD, truth
from garkcli.report.checked import REPORT
from garkcli.tableau.letters import with_letters
from garkcli.tell.dialect import Plain
from garkcli.tell.outputs import cell, phrase, words
from garkcli.webpage.mathml import Typeset
from garkcli.webpage.pictures import dots
from garkcli.webpage.reported import MOST_CONDITIONS, USUAL_CONDITIONS, Content, Reported, reported
from garkcli.webpage.sections.pictures import of_several

MARKS = {0: "holds", 1: "fails", 2: "fault", 3: "fault"}
"""The class of a verdict, by the exit code of ``gark check``."""


def heading(method: Reported) -> Content:
    """Returns the text above the sections of a method: the arithmetic, the verdict and the file."""
    outcome = method.outcome
    verdict = f"The file cannot be read as a method: {counted(len(outcome.faults), 'fault')}."
    if outcome.is_read:
        verdict = f"{_order_and_properties(outcome)} {claims_text(outcome)}"
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


def _order_and_properties(outcome: Outcome) -> str:
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


MOST_ROWS = 2000
"""Most conditions of all methods on a page: about 3 MB."""

SECTIONS = {
    "faults": "What is wrong with the file",
    "remarks": "Warnings and hints",
    "tableau": "Tableau",
    "picture": "Stability picture",
    "claims": "Claims",
    "orders": "Orders",
    "stability": "Stability",
    "properties": "Properties",
    "simplifying": "Simplifying assumptions",
    "pictures": "Further pictures",
    "reference": "Reference",
    "conditions": "Order conditions",  # the longest, and across on paper: pages of its own
}
"""Headings of sections, in order; ``content`` of a file in ``sections`` is for its template."""


def report_page(
    *methods: AnyMethod, order: Whole | None = None, pictures: bool = True, details: bool = False
) -> str:
    """Results about methods as one self-contained HTML page: ``gark report``.

    Args:
        methods: names, paths, or methods; several are compared in a table. Faults of a file are
            part of the page.
        order: the largest order of the conditions that are listed; by default the first that fails.
        pictures: whether stability, errors and energy are drawn.
        details: whether the page has everything: reasons, simplifying assumptions, all on
            stability, more conditions.

    Raises:
        MethodError: no method is given, or something else.

    >>> report_page("heun", pictures=False).splitlines()[0]
    '<!doctype html>'
    """
    if not methods:
        raise MethodError("a page of no method", "give at least one", code="arrays")
    listed = None if order is None else whole(order, "order", 1)
    return render([reported(x, listed, has_pictures=pictures) for x in methods], details)


def render(methods: Sequence[Reported], has_details: bool) -> str:
    has_several = len(methods) > 1
    room = min(MOST_CONDITIONS, MOST_ROWS // max(len(methods), 1))
    few = room if has_details else min(room, USUAL_CONDITIONS)
    methods = [
        replace(x, has_details=has_details, most_conditions=room if x.wanted_order else few)
        for x in methods
    ]
    shown = [
        {"place": f"m{number}", "heading": heading(x), "sections": list(_sections(x))}
        for number, x in enumerate(methods, 1)
    ]
    compared = [comparison_row(x) for x in methods] if has_several else []
    # trees of the pair have twice the colours, those with time, g or a matrix no more than one more
    sizes = [2 * x.tableau.size + 1 for x in methods if x.tableau is not None]
    script = _static("page.js")
    page = _environment().get_template("page.html")
    return page.render(
        title=counted(len(methods), "method") if has_several else methods[0].outcome.name,
        methods=shown,
        has_several=has_several,
        compared=compared,
        pictures=of_several(methods),
        columns=list(COLUMNS),
        has_details=has_details,
        dots=dots(sizes),
        style=Markup(_static("colours.css") + _static("page.css") + STYLE),
        script=Markup(script),
        policy=_policy(script),
    )


def _sections(method: Reported) -> Iterator[tuple[Content, Content]]:
    """Yields the nonempty sections with the content for their templates."""
    with with_letters(method.tableau):
        for name, title in SECTIONS.items():
            with doing(f"{method.outcome.name}: {title}"):
                content = import_module(f"garkcli.webpage.sections.{name}").content(method)
            if content is not None:
                yield {"name": name, "title": title}, content


def _policy(script: str) -> str:
    """Returns the content security policy: the page may run its script and load nothing."""
    digest = b64encode(sha256(script.encode()).digest()).decode()
    return (
        "default-src 'none'; style-src 'unsafe-inline'; img-src data:; "
        f"script-src 'sha256-{digest}'"
    )


@cache
def _environment() -> Environment:
    return Environment(
        loader=PackageLoader("garkcli.webpage"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        finalize=_visible,
    )


def _visible(value: object) -> object:
    """Returns a text with all its characters visible; markup is unchanged."""
    return printable(value) if isinstance(value, str) and not isinstance(value, Markup) else value


@cache
def _static(name: str) -> str:
    return (files("garkcli.webpage") / "static" / name).read_text(encoding="utf-8")
