"""The counterparts of generic see every tree of their structure: no elementary differential
vanishes, and methods that fail at trees of the structure show their order.
"""

from __future__ import annotations

from functools import cache
from itertools import combinations_with_replacement, permutations
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx, fmpq

from garkcli.convergence.convergence import converge, in_common, seeing_problem
from garkcli.errors import UsageProblem
from garkcli.families.registry import diagonal_method
from garkcli.methodfile.load import load
from garkcli.ntrees.count import counts_upto
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import coupling_graph
from garkcli.problems.builtin import GENERIC, hamiltonian
from garkcli.problems.hamiltonian import Hamiltonian, vector_field
from garkcli.problems.straightline import function
from garkcli.problems.vectorfield import symbols
from garkcli.stepping.fields import visible_tableau
from garkcli.stepping.integrator import bind
from garkcli.tableau.forms import gark, spelled_out, symplectic_pair, with_linear
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import ROOT
from tests.whole import at_most, in_whole

VELOCITIES_AND_FORCES = {
    "generic": ([0, 1], [0, 1]),
    "generic-semi-separable": ([0], [0, 1]),
    "generic-separable": ([0], [1, 2]),
    "generic-nystrom": ([0], [1, 2]),
}
"""Of the terms of a method of each structure."""


def of_structure(name: str, tableau: Tableau) -> Tableau:
    """The symplectic pair of the structure that the problem is for."""
    velocities, forces = VELOCITIES_AND_FORCES[name]
    both = symplectic_pair(tableau, velocities, forces)
    return with_linear(both, ["V1"]) if name == "generic-nystrom" else both


def spelled(terms: int, seed: int) -> Tableau:
    """A GARK method of two stages a colour with random coefficients; its weights sum to 1."""
    draw = Random(seed)

    def number() -> fmpq:
        return fmpq(int(draw.random() * 19) - 9, 10)

    first = [fmpq(1 + int(draw.random() * 4), 5) for _ in range(terms)]
    A: list[list[Any]] = [
        [tuple(tuple(number() for _ in range(2)) for _ in range(2)) for _ in range(terms)]
        for _ in range(terms)
    ]
    return spelled_out(A, [(b, 1 - b) for b in first], [None] * terms)


class Differentials:
    """F(u)(y_0) of the trees of a method's structure on a problem, as balls."""

    def __init__(self, tableau: Tableau, problem: Hamiltonian) -> None:
        bound = bind(tableau, problem)
        seen = visible_tableau(bound.tableau, bound.fields)
        self.problem = bound.problem
        self.keys = [(bound.tableau.colours[m].term, group) for m, group in bound.fields]
        self.branches = {l: [m for k, m in seen.edges() if k == l] for l in range(seen.size)}
        self.is_linear = [colour.is_linear for colour in seen.colours]
        self.derivative = cache(self._derivative)
        self.of = cache(self._of)

    def trees(self, order: int) -> list[Tree]:
        """All of one order: branches of colours that are seen, one at most where linear."""
        found = []
        for root, colours in self.branches.items():
            for forest in self._forests(order - 1, order - 1, colours):
                if len(forest) <= 1 or not self.is_linear[root]:
                    found.append(Tree(root, forest))  # noqa: PERF401 -- a step a line
        return found

    def _forests(self, n: int, largest: int, colours: list[int]) -> list[tuple[Tree, ...]]:
        if n == 0:
            return [()]
        found = []
        for size in range(min(n, largest), 0, -1):
            choices = [u for u in self.trees(size) if u.root in colours]
            for count in range(1, n // size + 1):
                for group in combinations_with_replacement(choices, count):
                    for rest in self._forests(n - count * size, size - 1, colours):
                        found.append((*group, *rest))  # noqa: PERF401
        return found

    def _derivative(self, colour: int, count: int) -> Any:
        """The tensor of ``count``-th derivatives of one field, shape (4, 4, …)."""
        term, group = self.keys[colour]
        field = vector_field(self.problem, term, group)
        names = [x for g in ("q", "p") for x in symbols(self.problem.variables, g)]  # type: ignore[arg-type]
        tensor = np.full((4,) * (count + 1), arb(0), dtype=object)
        places = list(combinations_with_replacement(range(4), count))
        for i, f in enumerate(field.components):
            made = tuple(f.diff(*(names[k] for k in where)) if where else f for where in places)
            values = function(made, tuple(names), True)(*map(arb, self.problem.initial))
            for where, value in zip(places, values, strict=True):
                for k in permutations(where):
                    tensor[(i + 2 * (group == "p"), *k)] = arb(value)
        return tensor

    def _of(self, tree: Tree) -> Any:
        tensor = self.derivative(tree.root, len(tree.branches))
        for branch in tree.branches:
            tensor = np.tensordot(tensor, self.of(branch), axes=([1], [0]))
        return tensor


@in_whole
@pytest.mark.parametrize(
    ("name", "counts"),
    [
        ("generic-semi-separable", [3, 7, 30, 139]),
        ("generic-separable", [3, 4, 11, 30]),  # the last one by hand: 14 for V, 8 for each F
        ("generic-nystrom", [3, 4, 8, 16]),
    ],
)
def test_no_elementary_differential_vanishes(name: str, counts: list[int]) -> None:
    """Of all trees of the structure up to order 3, in ``make whole`` 4, by ball arithmetic; they are
    as many as the coupling graph of the method has.
    """
    terms = len(set().union(*VELOCITIES_AND_FORCES[name]))
    gauss = diagonal_method("gauss", 2)
    blocks = {(l, m): gauss.A for l in range(terms) for m in range(terms) if l != m}
    tableau = of_structure(name, gark([gauss] * terms, blocks))
    found = Differentials(tableau, hamiltonian(name, terms))
    assert [len(found.trees(n)) for n in range(1, 5)] == counts
    assert [sum(x) for x in counts_upto(coupling_graph(tableau), 4)] == counts
    with ctx.workprec(200):
        for order in range(1, at_most(4, 5)):
            for tree in found.trees(order):
                assert any(not arb(x).contains(0) for x in found.of(tree)), tree


@pytest.mark.parametrize("name", GENERIC)
@pytest.mark.parametrize("seed", range(4))
def test_methods_of_the_structure_show_their_order(name: str, seed: int) -> None:
    """Random methods fail at some trees of order 2 or 3: the slope is their order, never more; and
    the problem is the one that a test without a problem takes.
    """
    terms = len(set().union(*VELOCITIES_AND_FORCES[name]))
    tableau = of_structure(name, spelled(terms, seed))
    result = converge(tableau)
    assert result.problem.name == name  # type: ignore[union-attr]
    assert result.visible.is_sharp
    assert result.visible_order == result.predicted_order
    assert result.verdict == "agree"


@pytest.mark.parametrize(
    ("file", "name"),
    [
        ("rk4", "generic"),
        ("ark-ars222", "generic"),
        ("prk-lobatto-iiia-iiib", "generic"),
        ("semi-separable", "generic-semi-separable"),
        ("rectangular", "generic-separable"),
        ("stoermer-verlet", "generic-separable"),
    ],
)
def test_problem_of_a_file(file: str, name: str) -> None:
    """The methods of the paper have the problem of their structure."""
    assert seeing_problem([load(str(ROOT / "methods" / f"{file}.gark.yaml")).tableau]) == name


def test_one_problem_for_several_structures() -> None:
    """The most general one that is for all; a method with fewer terms gets the same sum."""
    rk4, verlet, semi = (
        load(str(ROOT / "methods" / f"{file}.gark.yaml")).tableau
        for file in ("rk4", "stoermer-verlet", "semi-separable")
    )
    assert seeing_problem([rk4, semi]) == "generic-semi-separable"
    assert seeing_problem([rk4, verlet, semi]) == "generic-separable"
    problems = in_common("generic-separable", [rk4, verlet], 1)
    assert [len(x.terms) for x in problems] == [1, 2]
    assert (problems[0].energy - problems[1].energy).expand() == 0


def test_structures_without_a_problem_are_told() -> None:
    """A method whose colours see nothing, not even themselves, is for no problem at all."""
    none = spelled_out([[None]], [(fmpq(1),)], [(fmpq(0),)])
    with pytest.raises(UsageProblem, match="no problem with random coefficients"):
        seeing_problem([none])
