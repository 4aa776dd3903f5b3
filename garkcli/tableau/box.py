"""The box of all methods that a rounded one may mean."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeAlias

from flint import arb_mat, ctx, fmpq

from garkcli.exact.affine import Affine, FormMatrix, Forms, constant
from garkcli.exact.display import to_float
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.matrix import Vector, apply, apply_left, identity, multiply
from garkcli.frozen import Frozen, replace
from garkcli.remade import Remade
from garkcli.tableau.polynomial_space import PolynomialSpace, coordinates_at_nodes, powers_of_nodes
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge, Tableau

Make: TypeAlias = Callable[[Sequence[Any]], Tableau]


FAMILY_BITS = 1000


class Box(Frozen, eq=False):
    """All methods whose printed numbers are off by at most their radii t_k > 0. Further weights are
    colours that no stage sees, as in ``embedded.as_colours``.
    """

    numbers: tuple[Number, ...]
    radii: tuple[fmpq, ...]
    make: Make

    def at(self, shifts: Sequence[fmpq]) -> Tableau:
        """The method with shifted numbers, in parts of their radii."""
        moved = zip(self.numbers, self.radii, shifts, strict=True)
        return self.make([rational_or_ball(x) + t * shift for x, t, shift in moved])

    def around(self, shifts: Sequence[fmpq]) -> FormTableau:
        """All methods within the radii of this one, as forms in the further shifts."""
        moved = enumerate(zip(self.numbers, self.radii, shifts, strict=True))
        forms = [
            Affine(constant(x) + constant(t * shift), {k: to_float(t)})
            for k, (x, t, shift) in moved
        ]
        return FormTableau(self.make(forms), len(forms))


class FormTableau:
    """A tableau of affine forms in the same K printed numbers, on point stages."""

    def __init__(self, made: Tableau, numbers: int) -> None:
        self.made = made
        self.numbers = numbers
        self.b = [Forms.of(colour.b, numbers) for colour in made.colours]
        self.c = [Forms.of(colour.c, numbers) for colour in made.colours]
        self.A = {key: FormMatrix(block, numbers) for key, block in made.blocks.items()}

    @property
    def in_balls(self) -> Tableau:
        """Returns the tableau with each entry as a ball around all its values."""
        return self.made.changed(lambda x: x.ball if isinstance(x, Affine) else constant(x))

    def block(self, l: int, m: int) -> FormMatrix:
        return self.A[self.made.colours[l].space, m]

    def one(self, l: int) -> Forms:
        return Forms.of([fmpq(1)] * len(self.b[l]), self.numbers)


def rational_or_ball(number: Any) -> Any:
    return constant(number) if isinstance(number, Algebraic) else number


def to_points(tableau: Tableau) -> Tableau:
    """Returns the tableau on point stages, in balls if nodes are irrational."""
    if all(isinstance(space, PointSpace) for space in tableau.spaces):
        return tableau
    into, back = [], []
    stages = max(space.stages for space in tableau.spaces)
    for space in tableau.spaces:
        if isinstance(space, PolynomialSpace):
            # Vandermonde matrices lose bits
            with ctx.workprec(ctx.prec + 16 * stages):
                into.append(_rows(powers_of_nodes(space)))
                back.append(_rows(coordinates_at_nodes(space)))
        else:
            into.append(identity(space.stages))
            back.append(identity(space.stages))
    blocks: dict[Edge, Any] = {
        (k, m): multiply(into[k], multiply(in_balls(block), back[tableau.colours[m].space]))
        for (k, m), block in tableau.blocks.items()
    }
    colours = tuple(
        replace(
            x,
            b=apply_left(in_balls([x.b])[0], back[x.space]),
            c=apply(into[x.space], in_balls([x.c])[0]),
        )
        for x in tableau.colours
    )
    spaces = tuple(
        PointSpace(apply(into[k], in_balls([x.nodes])[0])) for k, x in enumerate(tableau.spaces)
    )
    return Tableau(spaces, colours, blocks)


def in_balls(rows: Any) -> Any:
    return tuple(tuple(map(rational_or_ball, row)) for row in rows)


def _rows(matrix: arb_mat) -> Any:
    return tuple(map(tuple, matrix.tolist()))


def plain_box(tableau: Tableau, radius_of: Callable[[Number], fmpq], colours: int) -> Box:
    """The box of a method whose coefficients are the printed numbers.

    Nodes that are the row sums of a block depend on it; others are printed. Equal nodes of colours
    that share stages count once. Families are exact. ``radius_of`` is 0 for an exact coefficient;
    ``colours`` counts no further weights.
    """
    sums = [_block_of_nodes(tableau, l) for l in range(colours)]
    nodes = [(x.space, tuple(x.c)) for x in tableau.colours[:colours]]
    first = [nodes.index(x) for x in nodes]
    is_family = [isinstance(space, PolynomialSpace) for space in tableau.spaces]
    of_families = [is_family[x.space] for x in tableau.colours]
    in_families = list(of_families)
    for (k, m), block in tableau.blocks.items():
        in_families += [is_family[k] and of_families[m]] * len(block)
    with ctx.workprec(FAMILY_BITS if any(is_family) else ctx.prec):
        tableau = to_points(tableau)
    rows: list[Vector] = [colour.b for colour in tableau.colours]
    for block in tableau.blocks.values():
        rows += block
    printed_nodes = [l for l in range(colours) if sums[l] is None and first[l] == l]
    rows += [tableau.colours[l].c for l in printed_nodes]
    in_families += [of_families[l] for l in printed_nodes]
    radii = [
        [radius_of(x) if x and not is_exact else fmpq(0) for x in row]
        for row, is_exact in zip(rows, in_families, strict=True)
    ]
    printed = [
        (x, t)
        for row, off in zip(rows, radii, strict=True)
        for x, t in zip(row, off, strict=True)
        if t
    ]

    made_of = tableau, rows, radii, sums, first
    make = Remade(_maker(*made_of), _maker, *made_of)
    return Box(tuple(x for x, _ in printed), tuple(t for _, t in printed), make)


def _maker(
    tableau: Tableau,
    rows: Sequence[Vector],
    radii: Sequence[Sequence[fmpq]],
    sums: Sequence[int | None],
    first: Sequence[int],
) -> Make:
    """Returns the function that makes the method of other numbers.

    ``rows`` are weights, rows of blocks and printed nodes; ``radii`` are 0 for exact numbers.
    ``sums`` has for each colour l the m with A^{l,m} 𝟙 as nodes, None if they are printed;
    ``first`` is the first colour with these nodes and stages.
    """
    colours = len(sums)

    def make(values: Sequence[Any]) -> Tableau:
        left = iter(values)
        made = _filled(rows, radii, left)
        b = [next(made) for _ in tableau.colours]
        blocks: dict[Edge, Any] = {
            key: tuple(next(made) for _ in block) for key, block in tableau.blocks.items()
        }
        c: list[Any] = []
        for l, m in enumerate(sums):
            if first[l] < l:
                c.append(c[first[l]])
            elif m is None:
                c.append(next(made))
            else:
                block = blocks[tableau.colours[l].space, m]
                c.append(apply(block, PointSpace(block[0]).one))
        new = [
            replace(colour, b=b[l], c=c[l % colours]) for l, colour in enumerate(tableau.colours)
        ]
        spaces = [
            PointSpace(next(x.c for x in new if x.space == k)) for k in range(len(tableau.spaces))
        ]
        return Tableau(tuple(spaces), tuple(new), blocks)

    return make


def _filled(
    rows: Sequence[Vector], radii: Sequence[Sequence[fmpq]], values: Iterator[Any]
) -> Iterator[tuple[Any, ...]]:
    """The rows with ``values`` in place of the numbers with a radius."""
    for row, off in zip(rows, radii, strict=True):
        yield tuple(
            next(values) if t else rational_or_ball(x) for x, t in zip(row, off, strict=True)
        )


def _block_of_nodes(tableau: Tableau, l: int) -> int | None:
    """A colour m with A^{l,m} 𝟙 = c^{l}; None if there is none."""
    nodes = tuple(tableau.colours[l].c)
    for m in range(tableau.size):
        block = tableau.block(l, m)
        if block is not None and apply(block, tableau.space(m).one) == nodes:
            return m
    return None
