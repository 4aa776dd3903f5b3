"""The tableau of a family of methods entry by entry, with the roots of its nodes as unknowns.

A block of a stage algebra has the entries V_l A V_m⁻¹, V the Vandermonde matrices of the nodes, as
in ``garkcli.tableau.pointwise``: here the blocks are rational functions of the parameters.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from itertools import chain
from typing import Any, cast

from flint import fmpq

from garkcli.errors import LimitExceeded
from garkcli.exact.domain import Domain
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.matrix import Matrix, Vector, apply, apply_left, identity, multiply
from garkcli.exact.nodes import Expression, Root
from garkcli.exact.parametric import Parameters, Parametric, Rule
from garkcli.exact.rewriting import format_expression
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.simple_nodes import simple_nodes
from garkcli.tableau.tableau import Edge, Tableau

NAME = "_node"
"""What the names of unknowns begin with that are roots of nodes."""


def ring_of(tableau: Tableau) -> Parameters:
    """The ring of the coefficients of a family; one of them at least is no number.

    Raises:
        TypeError: all of them are numbers.
    """
    rows: list[Vector] = [*chain.from_iterable(tableau.blocks.values())]
    for colour in tableau.colours:
        rows += [colour.b, colour.c]
    numbers: Iterable[object] = chain.from_iterable(rows)
    for x in numbers:
        if isinstance(x, Parametric):
            return x.ring
    raise TypeError("no coefficient depends on a parameter")


def family_in_points(tableau: Tableau, ring: Parameters) -> Tableau | None:
    """The same family with one coordinate a stage; None where the nodes have no simple radicals.

    Args:
        tableau: of the family.
        ring: its parameters, without roots.
    """
    nodes: dict[int, tuple[Expression, ...]] = {}
    for k, space in enumerate(tableau.spaces):
        if isinstance(space, PolynomialSpace):
            found = simple_nodes(space)
            if found is None:
                return None
            nodes[k] = found
    if not nodes:
        return tableau
    try:
        domain = Domain(list(chain.from_iterable(nodes.values())))
    except LimitExceeded:
        return None
    roots = [] if domain.field is None else domain.field.radicals
    if domain.field is not None and domain.field.degree != 2 ** len(roots):
        return None  # one root is a product of others
    larger = _with_roots(ring, [cast("Root", root) for root, _ in roots])
    return _at_points(tableau, nodes, domain, _Into(ring, larger))


def _with_roots(ring: Parameters, roots: Sequence[Root]) -> Parameters:
    """The ring with square roots of rational numbers."""
    names = [f"{NAME}{k}" for k in range(1, len(roots) + 1)]
    larger = Parameters([*ring.names, *names])
    rules = []
    for k, (name, root) in enumerate(zip(names, roots, strict=True)):
        radicand = Domain([]).evaluate(root.radicand)
        square = larger.constant(cast("fmpq", radicand))
        rules.append(Rule(len(ring.names) + k, 2, square))
        latex = format_expression(root, latex=True)
        larger.shown[name] = format_expression(root), latex
    larger.rules = tuple(rules)
    return larger


class _Into:
    """The map of numbers and rational functions into a ring with roots."""

    def __init__(self, ring: Parameters, larger: Parameters) -> None:
        self.ring = ring
        self.larger = larger
        self._zeros = (0,) * (len(larger.names) - len(ring.names))

    def number(self, x: Number) -> Any:
        """A number of the field of the nodes."""
        if not isinstance(x, Algebraic):
            return x
        total: Any = fmpq(0)
        for coefficient, word in x.terms():
            term: Any = coefficient
            for index in word:
                name = self.larger.names[len(self.ring.names) + index]
                term = term * self.larger.parameter(name)
            total = total + term
        return total

    def function(self, x: object) -> Any:
        """A coefficient of the family."""
        if not isinstance(x, Parametric):
            return x
        parts = []
        for p in (x.numerator, x.denominator):
            terms = {(*map(int, e), *self._zeros): a for e, a in p.to_dict().items()}
            parts.append(self.larger.context.from_dict(terms))
        return Parametric(self.larger, *parts)


def _at_points(
    tableau: Tableau, nodes: dict[int, tuple[Expression, ...]], domain: Domain, into: _Into
) -> Tableau:
    spaces: list[PointSpace] = []
    forth: list[Matrix] = []
    back: list[Matrix] = []
    for k, old in enumerate(tableau.spaces):
        if k not in nodes:
            points = tuple(into.function(x) for x in old.nodes)
            spaces.append(PointSpace(points))
            forth.append(identity(old.stages))
            back.append(identity(old.stages))
            continue
        values = tuple(map(domain.evaluate, nodes[k]))
        space = PointSpace(values)
        V = space.reductions(space.stages)
        forth.append(_mapped(V, into.number))
        back.append(_mapped(space.lifts(), into.number))
        spaces.append(PointSpace(tuple(map(into.number, values))))
    blocks: dict[Edge, Matrix] = {}
    for (k, m), block in tableau.blocks.items():
        from_right = back[tableau.colours[m].space]
        inside = multiply(_mapped(block, into.function), from_right)
        blocks[k, m] = multiply(forth[k], inside)
    colours = []
    for colour in tableau.colours:
        b = tuple(map(into.function, colour.b))
        c = tuple(map(into.function, colour.c))
        k = colour.space
        colours.append(replace(colour, b=apply_left(b, back[k]), c=apply(forth[k], c)))
    return Tableau(tuple(spaces), tuple(colours), blocks)


def _mapped(rows: Matrix, change: Callable[[Any], Any]) -> Matrix:
    return tuple(tuple(map(change, row)) for row in rows)
