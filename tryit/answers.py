"""What the page shows of a method file. It runs in a browser, under Pyodide."""

from __future__ import annotations

import json
from html import escape
from pathlib import Path

from garkcli import catalogue, load
from garkcli.check.check_file import check_file
from garkcli.check.outcome import Outcome
from garkcli.deadline import within
from garkcli.errors import GarkError, Remark
from garkcli.families.registry import BY_STAGES
from garkcli.methodfile.transfers import RULES
from garkcli.ntrees.notation import format_tree
from garkcli.report.checked import REPORT

NAME = "method.yaml"
"""The file of the page, in the memory of the browser."""
SECONDS = 20.0
"""Seconds after which the rest stays undecided."""
HIGHEST = 6
"""The highest order whose conditions are listed."""
SIGNS = {0: "holds", 1: "fails", 2: "fault", 3: "open"}


def choices() -> str:
    """Families, rules and names to choose from, as JSON."""
    names = sorted({*catalogue}, key=str.casefold)
    return json.dumps({"families": [*BY_STAGES], "rules": [*RULES], "methods": names})


def named(name: str) -> str:
    """The file of a method of the catalogue, as JSON: ``text``, or ``error``, why there is none."""
    try:
        return json.dumps({"text": load(name).text})
    except GarkError as error:
        return json.dumps({"error": str(error)})


def checked(text: str, width: int) -> str:
    """The output of ``gark check`` in so many columns, its sign and the first tree that fails, as
    JSON.
    """
    outcome = _outcome(text)
    return json.dumps(
        {
            "said": REPORT.render([outcome], width=width).rstrip("\n"),
            "sign": SIGNS[outcome.exit_code],
            "tree": _tree(outcome),
        }
    )


def _outcome(text: str) -> Outcome:
    Path(NAME).write_text(text, encoding="utf-8")
    try:
        with within(SECONDS):
            return check_file(NAME)
    except GarkError as error:  # it takes too long
        fault = Remark(error.message, error.help, code=error.code)
        return Outcome(NAME, NAME, faults=(fault,), text=text)


def _tree(outcome: Outcome) -> str:
    """The first tree whose condition fails, as a picture."""
    from garkcli.webpage.pictures import dots, tree_picture

    analysis = outcome.analysis
    witness = None if analysis is None else analysis.order.witness
    if analysis is None or witness is None:
        return ""
    has_colours = analysis.tableau.size > 1
    title = f"The tree that fails, {format_tree(witness.tree, has_colours)}"
    return str(dots([analysis.tableau.size]) + tree_picture(witness.tree, title, has_colours))


def drawn(text: str) -> str:
    """The stability region, as HTML; empty without one."""
    from markupsafe import Markup

    from garkcli.plots.regions import region_of
    from garkcli.plots.svg import svg

    Path(NAME).write_text(text, encoding="utf-8")
    try:
        with within(SECONDS):
            method = load(NAME)
            panel = region_of(method.tableau, method.tolerance)
    except GarkError:  # of a family there is none
        return ""
    if panel is None:
        return ""
    caption = Markup("<figcaption>{}</figcaption>").format(panel.note)
    return str(Markup(svg(panel)) + caption)


def reported(text: str) -> str:
    """The page of ``gark report``."""
    from garkcli.webpage.page import report_page

    Path(NAME).write_text(text, encoding="utf-8")
    try:
        with within(SECONDS):
            return report_page(NAME, order=HIGHEST)
    except GarkError as error:  # it takes too long
        return f"<p>{escape(str(error))}</p>"
