"""The tableau, its symplectic conjugate and their pair, entry by entry."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from flint import arb, fmpq
from markupsafe import Markup

from garkcli.check.analysis import is_pair_of_itself
from garkcli.exact.display import to_ball, to_text
from garkcli.exact.letters import letters_now
from garkcli.exact.parametric import Parametric
from garkcli.page.cells import TableauLine, lines_of, parts_of, remark
from garkcli.page.exactly import definition, definition_latex
from garkcli.page.tableau_latex import dense_polynomials
from garkcli.page.tableau_text import readable
from garkcli.report.tableau import OF_POSITIONS, shown_parts
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.forms import pair
from garkcli.tableau.garkmethod import derivation_of
from garkcli.tableau.pointwise import Cell, Entries, entries
from garkcli.tableau.tableau import Tableau
from garkcli.webpage.mathml import Typeset, typeset, typeset_cell
from garkcli.webpage.reported import Content, Reported

MOST_COLUMNS = 64
"""Most stages side by side; a larger tableau is left out."""
LONGEST = 64
"""Longer exact entries are shown as decimals."""
_DIGITS = 17
_WIDE, _VAST = 6, 12
"""More columns need smaller letters in print."""


_TITLES = {"": "The method", "conjugate": "The symplectic conjugate", "pair": "The symplectic pair"}
"""Titles by derivation."""


def content(method: Reported) -> Content | None:
    outcome = method.outcome
    if outcome.of_other_kind is not None:
        return _of_other_kind(method)
    of_fields = outcome.analysis or outcome.every
    if of_fields is None:
        return None
    analysis = outcome.analysis
    if analysis is None:
        shown = list(_of_family(method))
        dense: list[tuple[Markup, Markup]] = []
    else:
        further = NOTHING if method.method is None else method.method.further
        tableau, tolerance = analysis.tableau, method.tolerance
        found = _entries(tableau, tolerance, further)
        shown = [_table(_TITLES[derivation_of(method.method)], tableau, found)]
        dense = [(typeset(left), typeset(right)) for left, right in dense_polynomials(found)]
        others = {
            "Its symplectic conjugate": analysis.conjugate,
            "Their symplectic pair": analysis.pair,
        }
        for title, other in others.items() if method.tells_pair else ():
            if other is None or is_pair_of_itself(tableau, other):
                continue
            same = {"title": title, "is_same": True}
            is_same = other == tableau
            table = same if is_same else _table(title, other, _entries(other, tolerance, NOTHING))
            shown.append(table)
    obstacle = of_fields.obstacle
    told = Markup(Typeset().reason(obstacle)) if obstacle else ""
    told = told if method.tells_pair else ""
    return {"tables": shown, "dense": dense, "obstacle": told, "letters": _definitions()}


def _of_other_kind(method: Reported) -> Content:
    """Returns the tableaus of a method that is not a GARK method, as in ``gark tableau``."""
    shown = method.method
    assert shown is not None
    whole = entries(shown.tableau, _DIGITS).beside(shown.further)
    tables: list[Content] = []
    dense: list[tuple[Markup, Markup]] = []
    for title, tableau, own in shown_parts(shown.tableau, whole):
        found = own if method.tolerance is None else readable(own)
        weights = r"\bar{b}" if title == OF_POSITIONS[0] else "b"
        tables.append(_table(title, tableau, found, weights))
        dense += [(typeset(left), typeset(right)) for left, right in dense_polynomials(found)]
    return {"tables": tables, "dense": dense, "obstacle": "", "letters": _definitions()}


def _definitions() -> list[Markup]:
    letters = letters_now()
    found = {} if letters is None else letters.of
    return [typeset(definition_latex(x, y), definition(x, y)) for x, y in found.items()]


def _of_family(method: Reported) -> Iterator[Content]:
    """Yields the tableaus of a file with free parameters, if their nodes can be written down."""
    every = method.outcome.every
    assert every is not None
    family = every.family
    made = {"The method": every.tableau}
    if method.tells_pair and every.conjugate_order is not None:
        made["Its symplectic conjugate"] = conjugate(every.tableau)
    if method.tells_pair and every.pair_order is not None and not every.tableau.is_partitioned:
        made["Their symplectic pair"] = pair(every.tableau)
    for title, tableau in made.items():
        printed = family.printed(tableau)
        why = "the nodes have no simple radicals beside free parameters"
        left_out = {"title": title, "left_out": why}
        yield left_out if printed is None else _table(title, printed, entries(printed))


def _entries(tableau: Tableau, tolerance: fmpq | None, further: Further) -> Entries:
    found = entries(tableau, _DIGITS).beside(further)
    return found if tolerance is None else readable(found)


def _table(title: str, tableau: Tableau, found: Entries, weights: str = "b") -> Content:
    """Returns a tableau with the letter of its weights, or a note that it is too large."""
    widest = max(sum(len(found.b[m]) for m in colours) for _, _, colours in parts_of(tableau))
    if widest > MOST_COLUMNS:
        why = f"it has {widest} columns; gark tableau prints it"
        return {"title": title, "left_out": why}
    note = remark(found)
    shortened = found.changed(_short)
    if not note and shortened != found:
        note = f"entries of more than {LONGEST} signs as decimals, {found.digits} digits"
    parts = [_part(tableau, shortened, weights, *part) for part in parts_of(tableau)]
    return {"title": title, "parts": parts, "remark": note}


def _short(cell: Cell) -> Cell:
    if isinstance(cell, (arb, Parametric)) or len(to_text(cell)) <= LONGEST:
        return cell
    return to_ball(cell, _DIGITS)


def _part(
    tableau: Tableau,
    found: Entries,
    weights: str,
    letter: str,
    stages: Sequence[int],
    colours: Sequence[int],
) -> Content:
    heads = [(m + 1, tableau.colours[m].name, len(found.b[m])) for m in colours]
    columns = sum(span for _, _, span in heads)
    return {
        "letter": letter,
        "width": "vast" if columns > _VAST else "wide" if columns > _WIDE else "",
        "heads": heads,
        "lines": [
            _line(tableau, found, weights, x, colours) for x in lines_of(found, stages, colours)
        ],
        "has_colours": tableau.size > 1,
    }


def _line(
    tableau: Tableau, found: Entries, weights: str, line: TableauLine, colours: Sequence[int]
) -> Content:
    """Returns the blocks of a stage of several colours, or of weights; blanks for absent ones."""
    blocks = []
    for m, row in zip(colours, line.groups, strict=True):
        cells = [Markup()] * len(found.b[m])
        if row is not None:
            cells = [typeset_cell(cell, found.digits) for cell in row]
        blocks.append({"colour": m + 1, "is_own": line.colour == m, "cells": cells})
    shown = {"blocks": blocks, "is_first": line.is_first}
    if line.colour is None or line.node is None:
        letter = rf"\hat{{{weights}}}" if line.place else weights
        return {**shown, "head": typeset(letter), "group": ""}
    space = tableau.colours[line.colour].space
    return {
        **shown,
        "head": typeset_cell(line.node, found.digits),
        "group": ", ".join(x.name for x in tableau.colours if x.space == space),
        "size": len(found.c[line.colour]),
        "colour": line.colour + 1,
    }
