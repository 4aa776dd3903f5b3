"""The generic problem sees every tree: no elementary differential vanishes."""

from __future__ import annotations

from functools import cache
from itertools import combinations_with_replacement, permutations, product
from typing import Any

import numpy as np
import pytest
from sympy import Poly, Rational

from garkcli.families.registry import diagonal_method
from garkcli.ntrees.tree import Tree
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.hamiltonian import vector_field
from garkcli.problems.vectorfield import GROUPS, symbols
from garkcli.stepping.integrator import bind, integrate
from garkcli.tableau.forms import gark
from tests.whole import in_whole

PROBLEM = hamiltonian("generic", 2)
Y = (*symbols(PROBLEM.variables, "q"), *symbols(PROBLEM.variables, "p"))


@cache
def trees(order: int) -> tuple[Tree, ...]:
    """All trees of the four colours V1, V2, F1, F2."""
    forests: list[tuple[Tree, ...]] = [()] if order == 1 else []
    for parts in partitions(order - 1, order - 1):
        choices = [
            combinations_with_replacement(trees(n), parts.count(n)) for n in sorted(set(parts))
        ]
        forests += [tuple(u for group in groups for u in group) for groups in product(*choices)]
    return tuple(Tree(root, forest) for root in range(4) for forest in forests)


def partitions(n: int, largest: int) -> list[tuple[int, ...]]:
    """The partitions of n ≥ 1 into parts no larger than ``largest``; none of 0."""
    if n == 0:
        return []
    found = [(n,)] if n <= largest else []
    for part in range(1, min(n - 1, largest) + 1):
        found += [(part, *rest) for rest in partitions(n - part, part)]
    return found


@cache
def as_polynomial(expression: Any) -> Poly:
    """An expression in all variables, multiplied out once."""
    return Poly(expression, *Y)


def derived(polynomial: Any, where: tuple[int, ...]) -> Any:
    """A derivative of a polynomial by the variables of these numbers."""
    whole = as_polynomial(polynomial)
    return whole.diff(*((Y[k], where.count(k)) for k in set(where))) if where else whole


@cache
def derivative(colour: int, count: int) -> Any:
    """The tensor of ``count``-th derivatives of one field at the initial values, shape (4, 4,
    …).
    """
    group = GROUPS[colour // 2]
    field = vector_field(PROBLEM, colour % 2, group)
    places = list(combinations_with_replacement(range(4), count))
    at = [Rational(int(x.p), int(x.q)) for x in PROBLEM.initial]
    values = iter([float(derived(f, where)(*at)) for f in field.components for where in places])
    tensor = np.zeros((4,) * (count + 1))
    for i in range(2):
        for where in places:
            value = next(values)
            for k in permutations(where):
                tensor[(i + 2 * (group == "p"), *k)] = value
    return tensor


@cache
def differential(tree: Tree) -> Any:
    """F(u)(y_0), shape (4,)."""
    tensor = derivative(tree.root, len(tree.branches))
    for branch in tree.branches:
        tensor = np.tensordot(tensor, differential(branch), axes=([1], [0]))
    return tensor


@in_whole
def test_no_elementary_differential_vanishes() -> None:
    """All 4-coloured trees of order up to 4, of which there are 4, 16, 104 and 752.

    Each vertex may take a factor: the smallest is compared with a power.
    """
    assert [len(trees(n)) for n in range(1, 5)] == [4, 16, 104, 752]
    for order in range(1, 5):
        sizes = [float(np.abs(differential(u)).max()) for u in trees(order)]
        assert min(sizes) > 0.02**order * max(sizes) > 0


@pytest.mark.parametrize(("terms", "seed"), [(1, 44), (1, 55), (1, 86), (1, 107), (2, 78), (2, 1)])
def test_solutions_stay_small(terms: int, seed: int) -> None:
    """To the final time: these seeds have the largest solutions of the first 120 for one, two and
    three terms.
    """
    problem = hamiltonian("generic", terms, seed)
    method = bind(gark([diagonal_method("rk4")], {}), problem.unsplit()).at()
    assert max(map(abs, integrate(method, problem.t_end / 200, 200))) < 1 / 2
