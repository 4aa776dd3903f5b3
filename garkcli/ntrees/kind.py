"""Kinds of vertices: how many branches they have, how many orders they count, and whether the exact
solution has them.
"""

from __future__ import annotations

from functools import cached_property
from math import perm
from typing import TypeAlias

from garkcli.frozen import Frozen

Arity: TypeAlias = "frozenset[int]"
"""Numbers of branches; 2 stands for all from 2 on."""
SEVERAL = 2
ANY: Arity = frozenset({0, 1, SEVERAL})
_WORDS = {0: "no branch", 1: "one branch", SEVERAL: "several branches"}


class Kind(Frozen):
    """The kind of the vertices of a colour.

    Attributes:
        arity: how many branches they may have.
        weight: how many orders a vertex counts: as often the exact solution is integrated at it.
        is_exact: whether the exact solution has such vertices. Otherwise the elementary weights of
            trees with one should be 0.
        is_field: whether the colour is a vector field, and not an argument of one.
    """

    arity: Arity = ANY
    weight: int = 1
    is_exact: bool = True
    is_field: bool = True

    def allows(self, branches: int) -> bool:
        """Whether a vertex may have so many branches."""
        return min(branches, SEVERAL) in self.arity

    def integrated(self, order: int) -> int:
        """ρ (ρ − 1) ⋯, a factor for each order of the weight: what a tree of order ρ with such a
        root contributes to its density.

        >>> Kind().integrated(4), Kind(weight=2).integrated(4)
        (4, 12)
        """
        return perm(order, self.weight)

    @property
    def of_linear_field(self) -> Kind:
        """The kind where the vector field is linear.

        >>> Kind().of_linear_field == LINEAR
        True
        """
        return Kind(self.arity - {SEVERAL}, self.weight, self.is_exact)

    @cached_property
    def stems(self) -> Arity:
        """The numbers of branches, 0 or 1, that no vertex has, and that are left of larger ones
        without their last branch.
        """
        below = {n for n in (0, 1) if max(self.arity, default=0) > n}
        return frozenset(below) - self.arity

    @property
    def branches(self) -> str:
        """How many branches a vertex has, in words.

        >>> LINEAR.branches, Kind(frozenset({0, 2})).branches
        ('no branch or one branch', 'no branch or several branches')
        """
        return " or ".join(_WORDS[n] for n in sorted(self.arity))


PLAIN = Kind()
LINEAR = Kind(frozenset({0, 1}))
"""Of a vector field that is linear."""
LEAF = Kind(frozenset({0}))
"""Of a constant one, as ṫ = 1 of time."""
ONE_BRANCH = Kind(frozenset({1}))
"""Of the Jacobian of a vector field at the beginning of the step."""
ARGUMENT = Kind(is_field=False)
"""The kind of a vector field of several arguments, one of which a branch is in."""
NOT_ONE = Kind(frozenset({0, SEVERAL}))
"""The kind of a vector field beside its Jacobian."""
MATRIX = Kind(frozenset({1}), is_exact=False)
"""Of an arbitrary matrix."""
ERROR_OF_MATRIX = Kind(frozenset({1}), weight=2, is_exact=False)
"""Of the E in a matrix f' + h E."""
FIELDS = (PLAIN, LINEAR, LEAF)
"""The kinds whose vertices are a vector field, as it is evaluated at stages."""
