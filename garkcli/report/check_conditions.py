"""The lines of ``gark check`` on conditions that are not on trees: B, C and D with the bounds that
they give, whether the nodes are the row sums, and symplecticity.
"""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.check.analysis import Analysis
from garkcli.check.explained import BOUND, SHARP_BOUND, bound_numbers
from garkcli.exact.display import decimal
from garkcli.order.simplifying import Simplifying
from garkcli.page.paint import Paint, aligned
from garkcli.report.check_orders import LABEL

_NAMED_BLOCKS = 4
"""How many blocks with wrong row sums are named; the others are counted."""


def simplifying_lines(analysis: Analysis) -> list[str]:
    """B, C and D, and the bounds of Theorem 5 on the order."""
    found = analysis.simplifying
    limit = analysis.limit
    quadrature = "  ".join(_capped(found.B, limit))
    rows = labelled("B(r)", [quadrature])
    for label, table in (("C(eta)", found.C), ("D(zeta)", found.D)):
        cells = [_capped(row, limit) for row in table]
        rows += labelled(label, aligned(cells))
    rows += _bounds(found, "bound", "sharper bound", analysis.bound, analysis.sharp_bound)
    both = analysis.pair_simplifying
    bound, sharper_of_pair = analysis.pair_bound, analysis.pair_sharp_bound
    if both is None or both is found or bound is None or sharper_of_pair is None:
        return rows
    return rows + _bounds(both, "pair bound", "pair, sharper", bound, sharper_of_pair)


def _bounds(
    found: Simplifying, label: str, sharp_label: str, bound: int, sharp_bound: int
) -> list[str]:
    """Both bounds, and what they are made of."""
    of_paper, own = found.bound, found.sharp_bound
    return [
        *_bound(label, of_paper, BOUND, bound, found.is_open(of_paper)),
        *_bound(sharp_label, own, SHARP_BOUND, sharp_bound, found.is_open(own)),
        *labelled("", [bound_numbers(found)]),
    ]


def labelled(label: str, texts: Sequence[str]) -> list[str]:
    """Lines beside a label."""
    lines = []
    for text in texts:
        lines.append(f"  {label:{LABEL}}{text}")
        label = ""
    return lines


def _capped(numbers: Sequence[int | None], limit: int) -> list[str]:
    """Numbers of conditions that hold; those at the limit may be larger."""
    cells = []
    for number in numbers:
        cell = str(number)
        if number is None:
            cell = "-"
        elif number >= limit:
            cell = f">={number}"
        cells.append(cell)
    return cells


def _bound(label: str, computed: int, formula: str, bound: int, is_open: bool) -> list[str]:
    """A bound with its formula.

    Args:
        label: which bound.
        computed: what the formula gives.
        formula: it, in letters.
        bound: as far as the order bears it out, within a tolerance.
        is_open: whether it may be larger, as the search stopped.
    """
    equation = f"{'at least ' if is_open else ''}{computed} = {formula}"
    if bound == computed:
        return labelled(label, [equation])
    doubt = f"{bound}   {computed} is not decided within the tolerance,"
    return labelled(label, [doubt, equation])


def structure_lines(analysis: Analysis, paint: Paint) -> list[str]:
    """Whether the nodes are the row sums, and whether the method is its own conjugate."""
    names = [colour.name for colour in analysis.tableau.colours]
    near = ""
    if analysis.tolerance is not None:
        near = f" within {decimal(analysis.tolerance)}"
    text = consistent_text(analysis.inconsistent, names, "A", near, paint)
    lines = labelled("consistent", [text])
    if analysis.conjugate is not None:
        text = consistent_text(analysis.conjugate_inconsistent, names, "Â", near, paint)
        lines += labelled("conjugate nodes", [text])
    own = "its own conjugate"
    if analysis.tableau.is_partitioned:
        own = "each part the conjugate of the other"
    symplectic = f"yes{near}, {own}" if analysis.symplectic else "no"
    return lines + labelled("symplectic", [symplectic])


def consistent_text(
    wrong: Sequence[tuple[int, int]], names: Sequence[str], letter: str, near: str, paint: Paint
) -> str:
    """Whether the nodes are the row sums, and of which blocks they are not.

    Args:
        wrong: these blocks, counted from 0.
        names: of the colours.
        letter: of the matrices.
        near: within which tolerance; empty for exactly.
        paint: colour or none.
    """
    if not wrong:
        yes = paint("good", "yes" + near)
        return f"{yes}, {letter}{{l,m}}𝟙 = c{{l}} for every block"
    sums = []
    for l, m in wrong[:_NAMED_BLOCKS]:
        colours = f"{names[l]},{names[m]}"
        sums.append(f"{letter}{{{colours}}}𝟙")
    blocks = ", ".join(sums)
    others = len(wrong) - len(sums)
    if others:
        blocks += f" and {others} more"
    no = paint("bad", "no")
    verb = "differs" if len(wrong) == 1 else "differ"
    return f"{no}: {blocks} {verb} from c"
