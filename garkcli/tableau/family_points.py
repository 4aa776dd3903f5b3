"""The tableau of a family of methods entry by entry, with the roots of its nodes as unknowns.

A block of a stage algebra has the entries V_l A V_m⁻¹, V the Vandermonde matrices of the nodes, as
in ``garkcli.tableau.pointwise``: here the blocks are rational functions of the parameters.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import chain
from typing import Any, cast

from flint import fmpq

from garkcli.errors import LimitExceeded
from garkcli.exact.domain import Domain
from garkcli.exact.field import Number, with_radicals
from garkcli.exact.matrix import Vector
from garkcli.exact.nodes import Root
from garkcli.exact.parametric import Parameters, Parametric, Rule
from garkcli.exact.rewriting import format_expression
from garkcli.tableau.pointwise import at_points, nodes_in_radicals
from garkcli.tableau.tableau import Tableau

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
    nodes = nodes_in_radicals(tableau)
    if not nodes:
        return None if nodes is None else tableau
    try:
        domain = Domain(list(chain.from_iterable(nodes.values())))
    except LimitExceeded:
        return None
    roots = [] if domain.field is None else domain.field.radicals
    if domain.field is not None and domain.field.degree != 2 ** len(roots):
        return None  # one root is a product of others
    larger = _with_roots(ring, [cast("Root", root) for root, _ in roots])
    into = _Into(ring, larger)
    return at_points(tableau, nodes, domain, into.function, into.number)


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
        roots = larger.names[len(ring.names) :]
        self._radicals = [larger.parameter(name) for name in roots]
        self._zeros = (0,) * len(roots)

    def number(self, x: Number) -> Any:
        """A number of the field of the nodes."""
        return with_radicals(x, self._radicals)

    def function(self, x: object) -> Any:
        """A coefficient of the family."""
        if not isinstance(x, Parametric):
            return x
        parts = []
        for p in (x.numerator, x.denominator):
            terms = {(*map(int, e), *self._zeros): a for e, a in p.to_dict().items()}
            parts.append(self.larger.context.from_dict(terms))
        return Parametric(self.larger, *parts)
