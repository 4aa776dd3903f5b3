"""The modified equation, against flows and steps on random polynomial fields, without trees."""

from __future__ import annotations

from collections.abc import Sequence
from math import factorial, prod
from random import Random
from typing import TypeAlias

import pytest
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli import backward_analysis, find_order, load, loads
from garkcli.backward.modified import ModifiedEquation, modified_equation
from garkcli.backward.series import (
    Forest,
    _Powers,
    bracket,
    elementary_weights,
    logarithm,
    possible_order,
    product,
    transported,
)
from garkcli.errors import UsageProblem
from garkcli.ntrees.count import Admissible
from garkcli.ntrees.notation import parse_tree
from garkcli.ntrees.tree import Tree
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import interpolation
from tests.oracles import series
from tests.oracles.brute import Weights, plain
from tests.oracles.samples import everywhere
from tests.order.random_rounded import Rounding, listed
from tests.whole import at_most

Field: TypeAlias = dict[series.Component, fmpq_mpoly]
"""A polynomial for each component."""


class _Polynomials:
    """The vector fields of a random problem, written out."""

    def __init__(self, problem: series.Problem) -> None:
        self.components = list(problem.fields)
        names = [f"x{m}_{i}" for m, i in self.components]
        self.ring = fmpq_mpoly_ctx.get(names, Ordering.lex)
        self.x = dict(zip(self.components, self.ring.gens(), strict=True))
        self.fields = {
            key: prod(map(self._form, forms), start=self.ring.constant(1))
            for key, forms in problem.fields.items()
        }

    def _form(self, form: series.Affine) -> fmpq_mpoly:
        total = self.ring.constant(form.constant)
        for component, weight in form.weights.items():
            total += weight * self.x[component]
        return total

    def elementary(self, tree: Tree) -> Field:
        """F(u) by its definition, f^l differentiated once for each branch."""
        along = [self.elementary(u) for u in tree.branches]
        field = {}
        for key in self.components:
            if key[0] == tree.root:
                field[key] = self._derivative(self.fields[key], along)
        return field

    def _derivative(self, f: fmpq_mpoly, along: Sequence[Field]) -> fmpq_mpoly:
        """The k-th derivative along k fields, which are not differentiated."""
        if not along:
            return f
        first, *rest = along
        total = self.ring.constant(0)
        for key, component in first.items():
            slope = f.derivative(self.components.index(key))
            if slope:
                total += component * self._derivative(slope, rest)
        return total

    def modified(self, equation: ModifiedEquation, order: int) -> Field:
        """The coefficient of h^order in h f̃."""
        total = dict.fromkeys(self.components, self.ring.constant(0))
        for tree, b in equation.terms(order):
            for key, value in self.elementary(tree).items():
                total[key] += value * (b / tree.symmetry)
        return total

    def flow(self, fields: Sequence[Field]) -> dict[series.Component, list[fmpq]]:
        """x(h) from 0 for h f̃ = Σ h^n fields[n − 1]: Σ_j 1/j! (Σ h^n L_n)^j x."""
        order = len(fields)
        origin = [fmpq(0)] * len(self.components)
        found = {}
        for key in self.components:
            levels = [self.x[key], *[self.ring.constant(0)] * order]
            values = [fmpq(0)] * (order + 1)
            for j in range(order + 1):
                for k, value in enumerate(levels):
                    values[k] += value(*origin) / factorial(j)
                levels = [self._lie(fields, levels, k) for k in range(order + 1)]
            found[key] = values
        return found

    def _lie(self, fields: Sequence[Field], levels: Sequence[fmpq_mpoly], k: int) -> fmpq_mpoly:
        """The coefficient of h^k after one more derivative along the field."""
        total = self.ring.constant(0)
        for n in range(1, k + 1):
            for i, key in enumerate(self.components):
                slope = levels[k - n].derivative(i)
                if slope:
                    total += slope * fields[n - 1][key]
        return total


SAMPLES = {
    "rk4": ("methods/rk4.gark.yaml", 5),
    "Störmer-Verlet": ("methods/stoermer-verlet.gark.yaml", 5),
    "Lobatto IIIA-IIIB": ("methods/prk-lobatto-iiia-iiib.gark.yaml", 4),
}


def _check_on_a_random_field(tableau: Tableau, order: int) -> None:
    problem = series.random_problem(tableau, order - 1, Random(7))
    equation = modified_equation(tableau, order)
    polynomials = _Polynomials(problem)
    fields = [polynomials.modified(equation, n) for n in range(1, order + 1)]
    found = polynomials.flow(fields)
    assert found == series.step(tableau, problem, order)


@pytest.mark.parametrize("name", SAMPLES)
def test_its_flow_is_the_step(name: str) -> None:
    """On a random polynomial field the flow of the modified equation is the step, power by power,
    in rational arithmetic.
    """
    path, order = SAMPLES[name]
    _check_on_a_random_field(load(path).tableau, order)


def test_its_flow_is_the_step_of_other_forms() -> None:
    """The same for two vector fields coupled by blocks, for a pair of four colours, and for an
    additive method of order 1.
    """
    coupled = everywhere(interpolation, "gauss 1", "lobatto-iiia 2")
    _check_on_a_random_field(coupled, 4)
    _check_on_a_random_field(pair(coupled), 3)
    ark = "{ark: {A: [[[0, 0], [1, 0]], [[0, 0], [0, 1]]], b: [[0, 1], [0, 1]]}}"
    _check_on_a_random_field(loads(ark).tableau, 4)


def test_known_coefficients() -> None:
    """The explicit Euler and the implicit midpoint method, as Hairer, Lubich and Wanner print
    them in examples IX.7.1 and IX.7.2 of their second edition.
    """
    euler = modified_equation(loads("{A: [[0]], b: [1]}").tableau, 4)
    printed = {
        "[[]]": "-1/2",
        "[[],[]]": "1/6",
        "[[[]]]": "1/3",
        "[[],[],[]]": "0",
        "[[[]],[]]": "-1/12",
        "[[[],[]]]": "-1/6",
        "[[[[]]]]": "-1/4",
    }
    for text, value in printed.items():
        assert str(euler[parse_tree(text)]) == value
    midpoint = modified_equation(loads("{A: [[1/2]], b: [1]}").tableau, 4)
    assert str(midpoint[parse_tree("[[],[]]")]) == "-1/12"
    assert str(midpoint[parse_tree("[[[]]]")]) == "1/12"
    assert not list(midpoint.terms(4))  # a symmetric method has odd orders alone


@pytest.mark.parametrize("path", ["rk4", "collocation", "rectangular", "ark-ars222"])
def test_the_order_is_that_of_the_certificate(path: str) -> None:
    """The first order with a coefficient is one above the order of the method."""
    tableau = load(f"methods/{path}.gark.yaml").tableau
    equation = modified_equation(tableau, 5)
    assert equation.order == min(5, find_order(tableau).order)


def test_elementary_weights() -> None:
    """By numbers of trees they are those of the brute force, in a number field too."""
    tableau = load("methods/rectangular.gark.yaml").tableau
    forest = Forest.seen_by(tableau, 5)
    weights = Weights(tableau)
    for tree, weight in zip(forest.trees, elementary_weights(tableau, forest), strict=True):
        assert weight == weights.weight(plain(tree))


FOREST = Forest.of(Admissible.of(2, [[True, True], [True, False]]), 4)


def _random_coefficients(seed: int) -> list[fmpq]:
    dice = Random(seed)
    return [fmpq(dice.randint(-4, 4), dice.choice([1, 2, 3])) for _ in FOREST.trees]


def exponential(b: list[fmpq]) -> list[object]:
    """The a with B(a, y) the flow of B(b, y) over the time 1."""
    powers, weights = _Powers(FOREST), []
    for number, coefficient in enumerate(b):
        weights.append(coefficient + powers.sum_of_higher(number))
        powers.add(number, coefficient)
    return weights


COEFFICIENTS = st.integers(0, 10**9).map(_random_coefficients)


@given(COEFFICIENTS)
@settings(max_examples=at_most(8, 160), deadline=None)
def test_logarithm_and_exponential(b: list[fmpq]) -> None:
    """They undo each other."""
    assert logarithm(FOREST, exponential(b)) == b
    assert exponential(logarithm(FOREST, b)) == b


@given(COEFFICIENTS, COEFFICIENTS, COEFFICIENTS)
@settings(max_examples=at_most(8, 160), deadline=None)
def test_the_product_is_pre_lie(a: list[fmpq], b: list[fmpq], c: list[fmpq]) -> None:
    """(a ◁ b) ◁ c − a ◁ (b ◁ c) is symmetric in b and c: the second derivative of a field along two
    others.
    """

    def associator(x: list[fmpq], y: list[fmpq]) -> list[fmpq]:
        left = product(FOREST, product(FOREST, a, x), y)
        right = product(FOREST, a, product(FOREST, x, y))
        return [u - v for u, v in zip(left, right, strict=True)]

    assert associator(b, c) == associator(c, b)


@given(COEFFICIENTS, COEFFICIENTS)
@settings(max_examples=at_most(10, 80), deadline=None)
def test_transport_and_back(b: list[fmpq], c: list[fmpq]) -> None:
    """A change of coordinates and its inverse cancel, and it keeps brackets."""
    back = [-x for x in c]
    there = transported(FOREST, b, c, 1)
    assert transported(FOREST, there, back, 1) == b
    whole = transported(FOREST, bracket(FOREST, b, c), c, 1)
    assert whole == bracket(FOREST, there, c)  # a field keeps itself


def test_the_exact_flow_has_no_modified_terms() -> None:
    """The logarithm of 1/γ is 1 at vertices alone."""
    values = logarithm(FOREST, [fmpq(1, tree.density) for tree in FOREST.trees])
    assert values == [fmpq(int(tree.order == 1)) for tree in FOREST.trees]


def test_too_many_trees() -> None:
    """What would take too long is refused with the order that is possible."""
    with pytest.raises(UsageProblem, match="limit 40000") as caught:
        modified_equation(load("methods/three-colours.gark.yaml").tableau, 9)
    assert "--order" in caught.value.help
    # 20299 rooted trees have up to 13 vertices, 53272 up to 14: sums of OEIS A000081
    tableau = load("rk4").tableau
    assert [possible_order(tableau, n) for n in (12, 13, 14, 20)] == [12, 13, 13, 13]
    with pytest.raises(UsageProblem, match="53272 trees of order up to 14") as caught:
        modified_equation(tableau, 20)
    assert caught.value.help == "ask for --order 13 at most"


def test_trees_that_are_not_there() -> None:
    """A tree that the method does not see has no coefficient, one that is too large no answer."""
    equation = modified_equation(load("methods/stoermer-verlet.gark.yaml").tableau, 3)
    assert not equation[Tree(0, [Tree(0)])]
    with pytest.raises(KeyError):
        equation[Tree(0, [Tree(1), Tree(1), Tree(1)])]


def test_a_rounded_method_has_the_coefficients_of_one_that_it_may_be() -> None:
    """Gauss 2 in twelve decimals: 0 up to order 4, and those of Gauss 2 beyond, to the digits of
    the file.
    """
    digits = "A: [[0.25, -0.038675134595], [0.538675134595, 0.25]], b: [0.5, 0.5]"
    rounded = backward_analysis(loads(f"{{tolerance: 1e-12, {digits}}}"), 5).equation
    exact = modified_equation(load("gauss-2").tableau, 5)
    for order in (2, 3, 4):
        assert not list(rounded.terms(order))
    found, wanted = dict(rounded.terms(5)), dict(exact.terms(5))
    assert set(found) == set(wanted)
    assert all(abs(found[u] - wanted[u]) < fmpq(1, 10**14) for u in wanted)


@pytest.mark.parametrize("name", ["gauss-2", "radau-iia-2", "rk4", "ralston-2", "lobatto-iiic-2"])
def test_orders_of_a_rounded_method_are_those_that_it_has(name: str) -> None:
    """The energy, symplectic and effective order of a method in twelve decimals are bounds that the
    exact method has; the first two are no less.
    """
    method = load(name)
    exact = backward_analysis(method, 5)
    write = Rounding(12)
    text = f"{{A: {listed(method.A, write)}, b: {listed(method.b, write)}, tolerance: 5e-13}}"
    found = backward_analysis(loads(text), 5)
    assert found.is_symplectic == exact.is_symplectic
    for one, other in ((found.symplectic, exact.symplectic), (found.energy, exact.energy)):
        assert one is not None
        assert other is not None
        assert (one.order, one.is_lower_bound) == (other.order, True)
    assert found.effective.order == exact.order.order <= exact.effective.order
    trees = [[term.tree.representative for term in x.hamiltonian or ()] for x in (found, exact)]
    assert trees[0] == trees[1]
