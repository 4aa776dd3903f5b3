"""The tableau, its symplectic conjugate and their pair, entry by entry."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from flint import arb, fmpq
from markupsafe import Markup

from garkcli.check.analysis import is_pair_of_itself
from garkcli.exact.display import to_ball, to_text
from garkcli.exact.parametric import Parametric
from garkcli.frozen import Frozen
from garkcli.page.cells import Line, lines_of, parts_of, remark
from garkcli.page.tableau_latex import dense_polynomials
from garkcli.page.tableau_text import readable
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.forms import pair
from garkcli.tableau.pointwise import Cell, Entries, entries
from garkcli.tableau.tableau import Tableau
from garkcli.webpage.mathml import Typeset, typeset, typeset_cell
from garkcli.webpage.reported import Reported
from garkcli.webpage.section import Content, Section

MOST_COLUMNS = 64
"""Most stages side by side; a larger tableau is left out."""
LONGEST = 64
"""Signs of an exact entry; a longer one is shown as a decimal."""
_DIGITS = 17
_WIDE, _VAST = 6, 12
"""More columns need smaller letters on paper."""


class Block(Frozen):
    """Cells of a colour in one row.

    Attributes:
        colour: the number of the colour, from 1.
        is_own: whether the row is of the same colour.
        cells: as MathML, blanks where there is no block.
    """

    colour: int
    is_own: bool
    cells: list[Markup]


class Shown(Frozen):
    """A row of a tableau.

    Attributes:
        head: the node, or the name of the weights.
        blocks: from left to right.
        is_first: whether it is the first of its colours, or of the weights.
        group: the names of these colours; empty for weights.
        size: how many rows the group has.
        colour: the number of the first of these colours, from 1.
    """

    head: Markup
    blocks: list[Block]
    is_first: bool
    group: str = ""
    size: int = 0
    colour: int = 0


class Table(Frozen):
    """A tableau, or why it is not shown.

    Attributes:
        title: whose it is.
        parts: one, or Q and P.
        remark: that entries are decimals.
        left_out: why it is not shown.
        is_same: whether it is that of the method.
    """

    title: str
    parts: Sequence[Content] = ()
    remark: str = ""
    left_out: str = ""
    is_same: bool = False


def _content(method: Reported) -> Content | None:
    outcome = method.outcome
    if outcome.found is None:
        return None
    analysis = outcome.analysis
    if analysis is None:
        shown = list(_of_family(method))
        dense: list[tuple[Markup, Markup]] = []
    else:
        further = NOTHING if method.method is None else method.method.further
        tableau, tolerance = analysis.tableau, method.tolerance
        found = _entries(tableau, tolerance, further)
        shown = [_table("The method", tableau, found)]
        dense = [(typeset(left), typeset(right)) for left, right in dense_polynomials(found)]
        shown += _companions(
            tableau,
            {
                "Its symplectic conjugate": analysis.conjugate,
                "Their symplectic pair": analysis.pair,
            },
            tolerance,
        )
    obstacle = outcome.found.obstacle
    told = Markup(Typeset().reason(obstacle)) if obstacle else ""
    return {"tables": shown, "dense": dense, "obstacle": told}


def _companions(
    tableau: Tableau, found: dict[str, Tableau | None], tolerance: fmpq | None
) -> Iterator[Table]:
    """Those of the conjugate and the pair that are not the method itself."""
    for title, other in found.items():
        if other is None or is_pair_of_itself(tableau, other):
            continue
        if other == tableau:
            yield Table(title, is_same=True)
            continue
        yield _table(title, other, _entries(other, tolerance, NOTHING))


def _of_family(method: Reported) -> Iterator[Table]:
    """The tableaus of a file with free parameters, where their nodes can be written down."""
    every = method.outcome.every
    assert every is not None
    family = every.family
    made = {"The method": every.tableau}
    if every.conjugate_order is not None:
        made["Its symplectic conjugate"] = conjugate(every.tableau)
    if every.pair_order is not None and not every.tableau.is_partitioned:
        made["Their symplectic pair"] = pair(every.tableau)
    for title, tableau in made.items():
        printed = family.printed(tableau)
        if printed is None:
            yield Table(title, left_out="the nodes have no simple radicals beside free parameters")
            continue
        yield _table(title, printed, entries(printed))


def _entries(tableau: Tableau, tolerance: fmpq | None, further: Further) -> Entries:
    """The entries as they are shown: long ones of rounded methods in decimals."""
    found = entries(tableau, _DIGITS).beside(further)
    return found if tolerance is None else readable(found)


def _table(title: str, tableau: Tableau, found: Entries) -> Table:
    """A tableau with its title, or that it is too large to be shown."""
    widest = max(sum(len(found.b[m]) for m in colours) for _, _, colours in parts_of(tableau))
    if widest > MOST_COLUMNS:
        why = f"it has {widest} columns; gark tableau and gark conjugate print it"
        return Table(title, left_out=why)
    note = remark(found)
    shortened = found.changed(_short)
    if not note and shortened != found:
        note = f"entries of more than {LONGEST} signs as decimals, {found.digits} digits"
    return Table(title, [_part(tableau, shortened, *part) for part in parts_of(tableau)], note)


def _short(cell: Cell) -> Cell:
    """An entry as it is shown: a decimal where its exact form is longer than a line."""
    if isinstance(cell, (arb, Parametric)) or len(to_text(cell)) <= LONGEST:
        return cell
    return to_ball(cell, _DIGITS)


def _part(
    tableau: Tableau, found: Entries, letter: str, stages: Sequence[int], colours: Sequence[int]
) -> Content:
    """The rows of some colours over the columns of others."""
    heads = [(m + 1, tableau.colours[m].name, len(found.b[m])) for m in colours]
    return {
        "letter": letter,
        "width": _width(sum(len(found.b[m]) for m in colours)),
        "heads": heads,
        "lines": [_line(tableau, found, x, colours) for x in lines_of(found, stages, colours)],
        "has_colours": tableau.size > 1,
    }


def _width(columns: int) -> str:
    """A class for what needs small letters on paper."""
    if columns > _VAST:
        return "vast"
    return "wide" if columns > _WIDE else ""


def _line(tableau: Tableau, found: Entries, line: Line, colours: Sequence[int]) -> Shown:
    """A stage, whose group are the colours that share it, or weights."""
    blocks = []
    for m, row in zip(colours, line.groups, strict=True):
        cells = [Markup()] * len(found.b[m])
        if row is not None:
            cells = [typeset_cell(cell, found.digits) for cell in row]
        blocks.append(Block(m + 1, line.colour == m, cells))
    if line.colour is None or line.node is None:
        return Shown(typeset(r"\hat{b}" if line.place else "b"), blocks, line.is_first)
    space = tableau.colours[line.colour].space
    together = ", ".join(x.name for x in tableau.colours if x.space == space)
    node = typeset_cell(line.node, found.digits)
    size = len(found.c[line.colour])
    return Shown(node, blocks, line.is_first, together, size, line.colour + 1)


SECTION = Section("tableau", "Tableau", _content)
