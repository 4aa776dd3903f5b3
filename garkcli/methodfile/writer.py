"""Methods written as YAML from which the same blocks are read."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import chain
from typing import Any, TypeAlias

from flint import arb, fmpq

from garkcli.exact.display import decimal, plain_decimal, to_ball, to_text
from garkcli.exact.expression import read_decimal
from garkcli.exact.field import Number
from garkcli.exact.letters import NAMES
from garkcli.exact.matrix import Matrix, Vector, apply
from garkcli.exact.rewriting import format_expression
from garkcli.frozen import replace
from garkcli.grammar.editing import quoted, row_text
from garkcli.methodfile.description import block_name
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.letters import Defined, with_letters
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Tableau

NumberText: TypeAlias = Callable[[Number], str]
Written: TypeAlias = "fmpq | Mapping[str, fmpq]"


def write_tableau_file(
    tableau: Tableau,
    name: str,
    tolerance: Written | None = None,
    note: str = "",
    text: NumberText = to_text,
    parameters: Sequence[str] = (),
    further: Further = NOTHING,
) -> str:
    """Returns a method file with exact numbers on point stages. ``note`` is a comment,
    ``parameters`` has ``tau: free`` and so on.
    """
    tableau.demand_fields("a method file")
    with with_letters(None if parameters else tableau, NAMES) as letters:
        spelled_out = _spelled_out(tableau, text, further)
    parameters = [*parameters, *_defined(letters)]
    lines = [*(f"# {line}" for line in note.splitlines()), "gark: 1", f"name: {quoted(name)}"]
    if parameters:
        lines.append(f"parameters: {{{', '.join(parameters)}}}")
    lines += spelled_out
    if tolerance is not None:
        lines.append(f"tolerance: {tolerance_text(tolerance)}")
    return "\n".join(lines) + "\n"


def _spelled_out(tableau: Tableau, text: NumberText, further: Further) -> list[str]:
    if _is_prk(tableau):
        return _prk(tableau, text, further)
    lines = _ark(tableau, text) if _is_ark(tableau) else _blocks(tableau, text)
    lines += _further(further, text)
    linear = [str(l) for l, x in enumerate(tableau.colours, start=1) if x.is_linear]
    return [*lines, f"linear: [{', '.join(linear)}]"] if linear else lines


def _defined(letters: Defined) -> list[str]:
    return [f"{NAMES[x]}: {quoted(format_expression(root))}" for root, x in letters.items()]


def tolerance_text(written: Written) -> str:
    if isinstance(written, fmpq):
        return decimal(written)
    return f"{{{', '.join(f'{key}: {decimal(t)}' for key, t in written.items())}}}"


def tolerance_of_file(method: GarkMethod, further: Further) -> Written | None:
    own = method.tolerance
    by_key = {
        "embedded": None if further.embedded is None else method.embedded_tolerance,
        "dense": None if further.dense is None else method.dense_tolerance,
    }
    apart = {key: t for key, t in by_key.items() if t is not None and t != own}
    if own is None or not apart:
        return apart or own
    return {"others": own, **apart}


def write_method(
    tableau: Tableau, name: str, tolerance: Written | None, further: Further = NOTHING
) -> str:
    text = to_text if tolerance is None else _decimal_text
    return write_tableau_file(tableau, name, tolerance, text=text, further=further)


def write_form(
    form: str,
    keys: Mapping[str, Any],
    tableau: Tableau,
    name: str,
    tolerance: Written | None = None,
    further: Further = NOTHING,
) -> str:
    """Nodes are written unless they are the row sums of A."""
    text = to_text if tolerance is None else _decimal_text
    with with_letters(tableau, NAMES) as letters:
        lines = _in_form(form, keys, tableau, text, further)
    parameters = _defined(letters)
    head = [f"parameters: {{{', '.join(parameters)}}}"] if parameters else []
    lines = ["gark: 1", f"name: {quoted(name)}", *head, *lines]
    if tolerance is not None:
        lines.append(f"tolerance: {tolerance_text(tolerance)}")
    return "\n".join(lines) + "\n"


def _in_form(
    form: str, keys: Mapping[str, Any], tableau: Tableau, text: NumberText, further: Further
) -> list[str]:
    lines = [f"{form}:"]
    for key, value in keys.items():
        if isinstance(value, str):
            lines.append(f"  {key}: {value}")
        elif isinstance(value[0], tuple):
            lines += [f"  {key}:", *_items(value, 4, text)]
        else:
            lines.append(f"  {key}: {_row(value, text)}")
    colour = tableau.colours[0]
    block = tableau.block(0, 0)
    sums = apply(block, tableau.spaces[0].one) if block else (fmpq(0),) * len(colour.c)
    if sums != colour.c:
        lines.append(f"  c: {_row(colour.c, text)}")
    return [*lines, *(x.removeprefix("  ") for x in _further_of_part(further, 0, text))]


def write_rounded(tableau: Tableau, entries: Entries, name: str, further: Further = NOTHING) -> str:
    """Entries are within half a unit of their last digit; the tolerance is a hundred units of the
    largest, as residuals are sums of entries and of products.
    """
    digits = entries.digits
    made = _rounded_tableau(tableau, entries)
    largest = max(abs(x) for x in _rationals(made))
    digits_before_the_point = len(str(int(largest.floor())))
    # a hundred units in the last digit
    tolerance = fmpq(10) ** (2 + digits_before_the_point - digits)
    note = f"rounded to {digits} digits"
    rounded = further.changed(lambda number: _rounded(to_ball(number, digits), digits))
    return write_tableau_file(made, name, tolerance, note, _decimal_text, further=rounded)


def _rounded_tableau(tableau: Tableau, entries: Entries) -> Tableau:
    def rounded(cells: Sequence[Cell]) -> Vector:
        return tuple(_rounded(cell, entries.digits) for cell in cells)

    colours: list[Colour] = []
    nodes: dict[int, Vector] = {}
    for l, colour in enumerate(tableau.colours):
        b = rounded(entries.b[l])
        c = rounded(entries.c[l])
        colours.append(replace(colour, b=b, c=c))
        nodes[colour.space] = c
    spaces = tuple(map(PointSpace, [nodes[k] for k in range(len(tableau.spaces))]))
    blocks: dict[tuple[int, int], Matrix] = {}
    for l, m in tableau.edges():
        blocks[(colours[l].space, m)] = tuple(map(rounded, entries.A[l][m] or ()))
    return Tableau(spaces, tuple(colours), blocks)


def _rounded(cell: Cell, digits: int) -> fmpq:
    assert isinstance(cell, arb)
    if cell.contains(0):
        return fmpq(0)
    return read_decimal(cell.str(digits, radius=False))


def _decimal_text(number: Number) -> str:
    return plain_decimal(number) if isinstance(number, fmpq) else to_text(number)


def _rationals(tableau: Tableau) -> Iterator[fmpq]:
    yield from (x for x in chain.from_iterable(tableau.rows) if isinstance(x, fmpq))


def can_spell_out(tableau: Tableau) -> bool:
    """Whether a spelled-out file represents ``tableau``: a GARK tableau or a partitioned pair."""
    if not tableau.is_gark:
        return False
    return not tableau.is_partitioned or _is_prk(tableau)


def _is_prk(tableau: Tableau) -> bool:
    """Whether the form ``prk`` represents a tableau: both blocks exist."""
    parts = [colour.part for colour in tableau.colours]
    linear = [colour.is_linear for colour in tableau.colours]
    if parts != ["q", "p"]:
        return False
    if len(tableau.spaces) == 1:
        return _is_complete(tableau) and not any(linear)
    return set(tableau.blocks) == {(0, 1), (1, 0)} and not linear[1]


def _is_ark(tableau: Tableau) -> bool:
    colours = tableau.colours
    if len(colours) == 1 or len(tableau.spaces) > 1:
        return False
    is_plain = not any(colour.is_linear for colour in colours)
    return len({colour.c for colour in colours}) == 1 and is_plain and _is_complete(tableau)


def _is_complete(tableau: Tableau) -> bool:
    return len(tableau.blocks) == len(tableau.spaces) * tableau.size


def _ark(tableau: Tableau, text: NumberText) -> list[str]:
    lines = ["ark:", f"  c: {_row(tableau.colours[0].c, text)}", "  A:"]
    for m in range(tableau.size):
        lines += [f"    -  # A^{{{m + 1}}}", *_items(tableau.blocks[0, m], 6, text)]
    return [*lines, "  b:", *_items((colour.b for colour in tableau.colours), 4, text)]


def _items(rows: Iterable[Vector], indent: int, text: NumberText) -> Iterator[str]:
    for row in rows:
        yield " " * indent + f"- {_row(row, text)}"


def _blocks(tableau: Tableau, text: NumberText) -> list[str]:
    colours = tableau.colours
    nodes = [colour.c for colour in colours]
    weights = [colour.b for colour in colours]
    lines = ["tableau:", "  c:", *_items(nodes, 4, text), "  A:"]
    for l in range(tableau.size):
        for m in range(tableau.size):
            lines += _block(tableau, l, m, text)
    return [*lines, "  b:", *_items(weights, 4, text)]


def _further(further: Further, text: NumberText) -> list[str]:
    lines = []
    if further.embedded is not None:
        lines += ["  embedded:", *_items(further.embedded, 4, text)]
    if further.dense is not None:
        lines += ["  dense:", f"    degree: {further.dense.degree}", "    weights:"]
        for l, rows in enumerate(further.dense.weights, start=1):
            lines += [f"      -  # colour {l}: θ, θ², … a stage", *_items(rows, 8, text)]
    if further.predictor is not None:
        lines.append("  predictor:")
        for key, matrices in further.predictor.parts:
            lines.append(f"    {key}:")
            for k, rows in enumerate(matrices):
                lines += [f"      -  # r^{k}", *_items(rows, 8, text)]
    return lines


def _further_of_part(further: Further, colour: int, text: NumberText) -> list[str]:
    lines = []
    if further.embedded is not None:
        lines.append(f"    embedded: {_row(further.embedded[colour], text)}")
    if further.dense is not None:
        lines += ["    dense:", f"      degree: {further.dense.degree}", "      weights:"]
        lines += _items(further.dense.weights[colour], 8, text)
    return lines


def _block(tableau: Tableau, l: int, m: int, text: NumberText) -> Iterator[str]:
    block = tableau.block(l, m)
    dash = "    - -" if m == 0 else "      -"
    comment = f"  # {block_name(l, m)}" if tableau.size > 1 else ""
    if block is None:
        yield f"{dash} null{comment}"
        return
    yield f"{dash}{comment}"
    yield from _items(block, 8, text)


def _prk(tableau: Tableau, text: NumberText, further: Further) -> list[str]:
    lines = ["prk:"]
    for part, drives, seen_at in (("q", 0, 1), ("p", 1, 0)):
        block = tableau.blocks[tableau.colours[seen_at].space, drives]
        lines += [f"  {part}:", "    A:", *_items(block, 6, text)]
        lines.append(f"    b: {_row(tableau.colours[drives].b, text)}")
        lines.append(f"    c: {_row(tableau.colours[seen_at].c, text)}")
        lines += _further_of_part(further, drives, text)
    structure = "separable"
    if len(tableau.spaces) == 1:
        structure = "general"
    elif tableau.colours[0].is_linear:
        structure = "nystrom"
    return [*lines, f"structure: {structure}"]


def _row(numbers: Sequence[Number], text: NumberText) -> str:
    return row_text(map(text, numbers))
