"""Kinds of vertices: numbers of branches, counted orders, and the exact solution."""

from __future__ import annotations

from functools import cached_property
from math import perm
from typing import TypeAlias

from garkcli.frozen import Frozen

Arity: TypeAlias = "frozenset[int]"
"""Numbers of branches; 2 means two or more."""
SEVERAL = 2
ANY: Arity = frozenset({0, 1, SEVERAL})
_WORDS = {0: "no branch", 1: "one branch", SEVERAL: "several branches"}


class VertexKind(Frozen):
    """The kind of the vertices of a colour.

    Attributes:
        arity: the possible numbers of branches.
        weight: the orders that a vertex counts: so often the exact solution is integrated at it.
        is_exact: whether the exact solution has such vertices; if not, weights with one should be
            0.
        is_field: whether the colour is a vector field, not an argument of one.
    """

    arity: Arity = ANY
    weight: int = 1
    is_exact: bool = True
    is_field: bool = True

    def allows(self, branches: int) -> bool:
        return min(branches, SEVERAL) in self.arity

    def integrated(self, order: int) -> int:
        """ρ (ρ − 1) ⋯ with ``weight`` factors: the factor of the root in γ(u) for ρ(u) = ``order``.

        >>> VertexKind().integrated(4), VertexKind(weight=2).integrated(4)
        (4, 12)
        """
        return perm(order, self.weight)

    @property
    def of_linear_field(self) -> VertexKind:
        return VertexKind(self.arity - {SEVERAL}, self.weight, self.is_exact)

    @cached_property
    def stems(self) -> Arity:
        """The numbers of branches, 0 or 1, that only larger ones without the last leave."""
        below = {n for n in (0, 1) if max(self.arity, default=0) > n}
        return frozenset(below) - self.arity

    @property
    def branches(self) -> str:
        return " or ".join(_WORDS[n] for n in sorted(self.arity))


PLAIN = VertexKind()
LINEAR = VertexKind(frozenset({0, 1}))
LEAF = VertexKind(frozenset({0}))
"""A constant vector field, such as ṫ = 1 of time."""
ONE_BRANCH = VertexKind(frozenset({1}))
"""The Jacobian of a vector field at the beginning of the step."""
ARGUMENT = VertexKind(is_field=False)
"""One argument of a vector field with several arguments."""
NOT_ONE = VertexKind(frozenset({0, SEVERAL}))
"""A vector field beside its Jacobian."""
MATRIX = VertexKind(frozenset({1}), is_exact=False)
"""An arbitrary matrix."""
ERROR_OF_MATRIX = VertexKind(frozenset({1}), weight=2, is_exact=False)
"""The E of a matrix f' + h E."""
FIELDS = (PLAIN, LINEAR, LEAF)
"""The kinds of vector fields that stages evaluate."""
