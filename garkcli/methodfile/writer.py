"""A method back to YAML, such that it loads again with the same blocks."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

import yaml
from flint import arb, fmpq
from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.exact.display import decimal, plain_decimal, to_text
from garkcli.exact.expression import read_decimal
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.source import Source
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau

_DROPPED = ("expect", "conjugate", "name", "description")


def write_tableau_file(
    tableau: Tableau,
    name: str,
    tolerance: fmpq | None = None,
    note: str = "",
    text: Callable[[Number], str] = to_text,
) -> str:
    """A method file with every block of ``tableau`` spelled out.

    Args:
        tableau: over point spaces, every entry exact.
        name: what the file calls the method.
        tolerance: the rounding of its coefficients, or None.
        note: a comment above it.
        text: how a coefficient is written.
    """
    lines = [f"# {line}" for line in note.splitlines()]
    lines += ["gark: 1", f"name: {_quoted(name)}"]
    lines += _prk(tableau, text) if _is_prk(tableau) else _blocks(tableau, text)
    if tolerance is not None:
        lines.append(f"tolerance: {decimal(tolerance)}")
    return "\n".join(lines) + "\n"


def write_rounded(tableau: Tableau, entries: Entries, name: str) -> str:
    """A method file with entries rounded to decimals, and the tolerance that this rounding needs.

    An entry is at most half a unit in its last digit off; the tolerance allows for a hundred units
    in the last digit of the largest, as residuals are sums of such entries and of their products.

    Args:
        tableau: for its colours.
        entries: its entries as enclosures.
        name: what the file calls the method.
    """
    digits = entries.digits

    def rounded(cells: Sequence[Cell]) -> Vector:
        return tuple(_rounded(cell, digits) for cell in cells)

    colours = tuple(
        replace(colour, b=rounded(b), c=rounded(c))
        for colour, b, c in zip(tableau.colours, entries.b, entries.c, strict=True)
    )
    nodes = {colour.space: colour.c for colour in colours}
    spaces = tuple(PointSpace(nodes[k]) for k in range(len(tableau.spaces)))
    blocks: dict[tuple[int, int], Matrix] = {}
    for l, m in tableau.edges():
        block = entries.A[l][m] or ()
        blocks[colours[l].space, m] = tuple(map(rounded, block))
    made = Tableau(spaces, colours, blocks)
    largest = max(abs(x) for x in _rationals(made))
    digits_before_the_point = len(str(int(largest.floor())))
    tolerance = fmpq(10) ** (2 + digits_before_the_point - digits)
    note = f"rounded to {digits} digits"
    return write_tableau_file(made, name, tolerance, note, _decimal_text)


def _rounded(cell: Cell, digits: int) -> fmpq:
    if not isinstance(cell, arb):
        raise TypeError("an enclosure is rounded, not an exact number")
    return fmpq(0) if cell.contains(0) else read_decimal(cell.str(digits, radius=False))


def _decimal_text(number: Number) -> str:
    return plain_decimal(number) if isinstance(number, fmpq) else to_text(number)


def _rationals(tableau: Tableau) -> Iterator[fmpq]:
    """Every coefficient of a tableau whose coefficients are rational."""
    rows = [row for colour in tableau.colours for row in (colour.b, colour.c)]
    rows += [row for block in tableau.blocks.values() for row in block]
    for row in rows:
        yield from (x for x in row if isinstance(x, fmpq))


def can_spell_out(tableau: Tableau) -> bool:
    """Whether a spelled-out file says everything about ``tableau``: a GARK tableau, or a
    partitioned pair.
    """
    return not tableau.is_partitioned or _is_prk(tableau)


def _is_prk(tableau: Tableau) -> bool:
    return [colour.part for colour in tableau.colours] == ["q", "p"]


def _blocks(tableau: Tableau, text: Callable[[Number], str]) -> list[str]:
    lines = ["tableau:", "  c:"]
    lines += [f"    - {_row(colour.c, text)}" for colour in tableau.colours]
    lines.append("  A:")
    for l in range(tableau.size):
        for m in range(tableau.size):
            block = tableau.block(l, m)
            dash = "    - -" if m == 0 else "      -"
            comment = f"  # A^{{{l + 1},{m + 1}}}"
            if block is None:
                lines.append(f"{dash} null{comment}")
                continue
            lines.append(f"{dash}{comment}")
            lines += [f"        - {_row(row, text)}" for row in block]
    lines.append("  b:")
    lines += [f"    - {_row(colour.b, text)}" for colour in tableau.colours]
    linear = [
        str(l + 1) for l, colour in enumerate(tableau.colours) if colour.is_linear
    ]
    return [*lines, f"linear: [{', '.join(linear)}]"] if linear else lines


def _prk(tableau: Tableau, text: Callable[[Number], str]) -> list[str]:
    """The form ``prk``: the rows of q.A are the positions at which the colour p evaluates its
    forces.
    """
    lines = ["prk:"]
    for part, drives, seen_at in (("q", 0, 1), ("p", 1, 0)):
        block = tableau.block(seen_at, drives) or ()
        lines += [f"  {part}:", "    A:"]
        lines += [f"      - {_row(row, text)}" for row in block]
        lines += [
            f"    b: {_row(tableau.colours[drives].b, text)}",
            f"    c: {_row(tableau.colours[seen_at].c, text)}",
        ]
    if len(tableau.spaces) == 1:
        return [*lines, "structure: general"]
    return [
        *lines,
        f"structure: {'nystrom' if tableau.colours[0].is_linear else 'separable'}",
    ]


def _row(numbers: Sequence[Number], text: Callable[[Number], str]) -> str:
    texts = [text(x) for x in numbers]
    return f"[{', '.join(_quoted(x) if ',' in x else x for x in texts)}]"


def _quoted(text: str) -> str:
    escaped = text.replace("\\", "\\\\").replace('"', '\\"')
    return (
        '"'
        + "".join(x if x.isprintable() else f"\\U{ord(x):08x}" for x in escaped)
        + '"'
    )


def write_conjugate_of(method: MethodFile, name: str) -> str:
    """The file of ``method`` with ``conjugate: true`` added, or taken away where it stands.

    Exact for every method: nothing is spelled out. Claims and description are left behind, as they
    are about the other method.
    """
    root = Source(method.source, method.text).compose()
    if root is None:
        raise ValueError("the text of a method file")
    kept: list[tuple[Node, Node]] = [
        (key, x) for key, x in root.value if key.value not in _DROPPED
    ]
    kept.insert(0, (_scalar("name"), _scalar(name)))
    if not method.is_conjugate:
        kept.append(
            (_scalar("conjugate"), ScalarNode("tag:yaml.org,2002:bool", "true"))
        )
    text = yaml.serialize(
        MappingNode(root.tag, kept, flow_style=False), allow_unicode=True, width=110
    )
    return str(text)


def _scalar(text: str) -> ScalarNode:
    return ScalarNode("tag:yaml.org,2002:str", text)
