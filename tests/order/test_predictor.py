"""Orders of predictors: against all trees, as polynomials in the ratio of step sizes, and against
two steps as power series, which know no trees; published ones; files, claims, what is refused.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from itertools import product
from pathlib import Path
from random import Random
from typing import Any

import pytest
from flint import fmpq, fmpq_poly

from garkcli import load, loads
from garkcli.errors import MethodFileError
from garkcli.methodfile.build import MethodFile
from garkcli.order.predictor import PredictorOrders, predictor_orders
from tests.cli.harness import gark
from tests.oracles.brute import Plain, Trees, order_of

RATIO = fmpq_poly([0, 1])
TRAPEZOIDAL = "A: [[0, 0], [1/2, 1/2]]\nb: [1/2, 1/2]\n"
TR_BDF2 = """parameters: {g: 1 - sqrt(2)/2, w: sqrt(2)/4}
A: [[0], [g, g], [w, w, g]]
b: [w, w, g]
predictor: {new: [[], [2*g], [w + g*(-sqrt(2)/2), w + g*(1 + sqrt(2)/2)]]}
"""
"""With the stage 3 that OrdinaryDiffEq predicts: k_3 ≈ -sqrt(2)/2 k_1 + (1 + sqrt(2)/2) k_2."""


def orders(method: MethodFile, limit: int = 6) -> PredictorOrders:
    assert method.predictor is not None
    return predictor_orders(method.tableau, method.predictor, limit)


def by_stage(found: PredictorOrders) -> list[tuple[int, int, int]]:
    return [(x.stage + 1, x.order, x.equal_steps) for x in found.stages]


# two oracles


def matrices(method: MethodFile) -> tuple[Any, Any, list[Any], list[Any]]:
    """A and b, and for each stage pair the polynomials in r of its weights of old and new slopes."""
    predictor = method.predictor
    assert predictor is not None

    def polynomials(powers: Sequence[Any]) -> list[list[fmpq_poly]]:
        s = range(len(powers[0]))
        return [[fmpq_poly([matrix[i][j] for matrix in powers]) for j in s] for i in s]

    return method.A, method.b, polynomials(predictor.old), polynomials(predictor.new)


def vectors(method: MethodFile, u: Plain) -> tuple[list[fmpq_poly], list[fmpq_poly]]:
    """The products over the branches of a tree at the stages of both steps, in units of h_old."""
    A, b, _, _ = matrices(method)
    s = range(len(b))
    old, new = [fmpq_poly([1])] * len(b), [fmpq_poly([1])] * len(b)
    for branch in u[1]:
        first, second = vectors(method, branch)
        step = sum((b[j] * first[j] for j in s), fmpq_poly())
        seen = [sum((A[i][j] * first[j] for j in s), fmpq_poly()) for i in s]
        later = [step + RATIO * sum((A[i][j] * second[j] for j in s), fmpq_poly()) for i in s]
        old = [x * y for x, y in zip(old, seen, strict=True)]
        new = [x * y for x, y in zip(new, later, strict=True)]
    return old, new


def missed_by_trees(method: MethodFile, stage: int, order: int) -> list[fmpq_poly]:
    """What the trees of an order give of the prediction minus the stage, polynomials in r."""
    A, b, p, q = matrices(method)
    found = []
    for u in Trees(method.tableau).of_order(order):
        old, new = vectors(method, u)
        pairs = [*zip(p[stage], old, strict=True)]
        pairs += [(x - a, v) for x, a, v in zip(q[stage], A[stage], new, strict=True)]
        found.append(sum((x * v for x, v in pairs), fmpq_poly()))
    assert all(order_of(u) == order for u in Trees(method.tableau).of_order(order))
    assert len(b) > stage
    return found


def order_by_trees(method: MethodFile, stage: int, limit: int, ratio: int | None = None) -> int:
    """The order of the prediction of a stage, from 0; of equal steps with the ratio 1."""
    for order in range(1, limit + 1):
        values = missed_by_trees(method, stage, order)
        if any(x if ratio is None else x(ratio) for x in values):
            return order - 1
    return limit


Series = list[list[fmpq]]
"""Coefficients of h⁰, h¹, … of each component."""


def slope(y: Series, powers: int) -> Series:
    """A vector field whose derivatives are all there: products of affine forms."""
    one, x = [fmpq(1), *[fmpq(0)] * powers], y
    forms = [[[1, 2, -1], [3, 1, 1]], [[-1, 1, 2], [2, -3, 1]], [[1, 1, 1], [-2, 1, 3]]]
    constants = [[1, 2], [-1, 1], [3, -2]]

    def affine(constant: int, weights: list[int]) -> list[fmpq]:
        return [
            constant * one[k] + sum((w * x[i][k] for i, w in enumerate(weights)), fmpq(0))
            for k in range(powers + 1)
        ]

    def times(u: list[fmpq], v: list[fmpq]) -> list[fmpq]:
        return [sum((u[i] * v[k - i] for i in range(k + 1)), fmpq(0)) for k in range(powers + 1)]

    found = []
    for pair, own in zip(forms, constants, strict=True):
        first, second = (affine(c, w) for c, w in zip(own, pair, strict=True))
        found.append(times(times(first, second), first))
    return found


def plus(start: Series, terms: Iterator[tuple[Any, Series]], powers: int) -> Series:
    """The sum start + h Σ weight · slope."""
    found = [list(row) for row in start]
    for weight, k in terms:
        for row, add in zip(found, k, strict=True):
            for n in range(powers):
                row[n + 1] = row[n + 1] + weight * add[n]
    return found


def order_by_series(method: MethodFile, stage: int, limit: int, ratio: int) -> int:
    """The power of h up to which the stage of a step of size ratio · h is predicted after one of
    size h, by two steps as power series.
    """
    A, b, p, q = matrices(method)
    s, powers = range(len(b)), limit + 1

    def solved(start: Series, size: int) -> tuple[list[Series], list[Series]]:
        stages = [start for _ in s]
        for _ in range(powers + 1):  # each round is right up to a power more
            k = [slope(y, powers) for y in stages]
            stages = [plus(start, ((size * A[i][j], k[j]) for j in s), powers) for i in s]
        return stages, [slope(y, powers) for y in stages]

    begin: Series = [[fmpq(0)] * (powers + 1) for _ in range(3)]
    _, old = solved(begin, 1)
    y = plus(begin, ((b[j], old[j]) for j in s), powers)
    stages, new = solved(y, ratio)
    foreseen = plus(y, ((ratio * p[stage][j](ratio), old[j]) for j in s), powers)
    foreseen = plus(foreseen, ((ratio * q[stage][j](ratio), new[j]) for j in s), powers)
    for n in range(powers + 1):
        if any(x[n] != z[n] for x, z in zip(foreseen, stages[stage], strict=True)):
            return n - 1
    return limit


# random predictors, and such as meet conditions


def random_file(seed: int) -> str:
    """A DIRK method of two or three stages with a predictor of degree 0 or 1, whose old weights sum
    to what order 1 asks for, in two cases of three.
    """
    dice = Random(seed)
    s, powers = dice.choice([2, 3]), dice.choice([1, 2])

    def row(count: int) -> list[fmpq]:
        return [fmpq(dice.randint(-4, 4), dice.choice([1, 2, 3])) for _ in range(count)]

    A = [[*row(i), fmpq(dice.randint(1, 5), 3)] for i in range(s)]
    old = [[row(s) for _ in range(s)] for _ in range(powers)]
    new = [[row(i) for i in range(s)] for _ in range(powers)]
    if seed % 3:
        for k, i in product(range(powers), range(s)):
            wanted = sum(A[i], fmpq(0)) if k == 0 else fmpq(0)
            old[k][i][0] += wanted - sum([*old[k][i], *new[k][i]], fmpq(0))
    file = {"A": A, "b": row(s), "predictor": {"old": old, "new": new}}
    return json.dumps(file, default=str)


@pytest.mark.parametrize("seed", range(30))
def test_orders_of_random_predictors_are_those_of_both_oracles(seed: int) -> None:
    method = loads(random_file(seed))
    for x in orders(method, 3).stages:
        assert x.order == order_by_trees(method, x.stage, 3)
        assert x.equal_steps == order_by_trees(method, x.stage, 3, ratio=1)
        if seed < 9:
            assert x.equal_steps == order_by_series(method, x.stage, 3, 1)
            assert x.order == min(order_by_series(method, x.stage, 3, r) for r in (1, 2, 3))


def extrapolated(nodes: list[fmpq], A: Any, b: Any) -> str:
    """The collocation polynomial of the last step at the nodes of this one, minus y_n, over h:
    Σ_k (b_j)_k ((1 + r c)^k − 1)/r.
    """
    s = len(nodes)
    powers: list[list[list[Any]]] = [[[fmpq(0)] * s for _ in range(s)] for _ in range(s)]
    for j in range(s):
        basis = fmpq_poly([1])
        for k in range(s):
            if k != j:
                basis *= fmpq_poly([-nodes[k], 1]) / (nodes[j] - nodes[k])
        weights = basis.integral()
        for i in range(s):
            shifted = weights(fmpq_poly([1, nodes[i]])) - weights(1)
            for k in range(s):
                powers[k][i][j] = shifted[k + 1]
    return json.dumps({"A": A, "b": b, "predictor": {"old": powers}}, default=str)


@pytest.mark.parametrize(("name", "order"), [("lobatto-iiia-3", 3), ("radau-iia-2", 2)])
def test_the_collocation_polynomial_goes_on(name: str, order: int) -> None:
    """E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, IV.8: the error of the
    starting values is O(h^(s+1)), whatever the ratio of the steps.
    """
    known = load(name)
    method = loads(extrapolated([fmpq(x) for x in known.c], known.A, known.b))
    found = orders(method)
    assert found.order == found.equal_steps == order
    for x in found.stages:
        assert order_by_series(method, x.stage, order + 1, 2) == x.order
        assert order_by_trees(method, x.stage, order + 1) == x.order


def test_a_published_predictor() -> None:
    """TR-BDF2 in OrdinaryDiffEq: the slope at stage 3 continues the line through those at the
    stages 1 and 2, so its value is right up to O(h^3), whatever the steps; stage 2, foreseen by
    Euler's method from the beginning of the step, has order 1.
    """
    assert by_stage(orders(loads(TR_BDF2))) == [(2, 1, 1), (3, 2, 2)]


def test_equal_steps_do_more_than_any_ratio() -> None:
    """Two slopes give order 2 for steps of one size; for any ratio the weights depend on it."""
    fixed = loads(TRAPEZOIDAL + "predictor: {old: [[], [-1/2, 3/2]]}")
    assert by_stage(orders(fixed)) == [(2, 1, 2)]
    moving = loads(TRAPEZOIDAL + "predictor: {old: [[[], [0, 1]], [[], [-1/2, 1/2]]]}")
    assert by_stage(orders(moving)) == [(2, 2, 2)]
    assert order_by_series(fixed, 1, 3, 1) == 2
    assert order_by_series(fixed, 1, 3, 2) == 1
    assert order_by_series(moving, 1, 3, 5) == 2


def test_claims_and_what_speaks_against_them(tmp_path: Path) -> None:
    file = tmp_path / "m.yaml"
    text = TRAPEZOIDAL + "predictor: {old: [[], [-1/2, 3/2]]}\nexpect: {order: 2, %s}\n"
    file.write_text(text % "predictor-order: 1, predictor-order-equal-steps: 2")
    assert gark("check", str(file)).code == 0
    file.write_text(text % "predictor-order: 2")
    run = gark("check", str(file), "--format", "json")
    assert run.code == 1
    (found,) = json.loads(run.out)["files"]
    assert found["predictor_order"] == 1
    assert found["predictor"] == {
        "equal_steps": 2,
        "stages": [{"stage": 2, "order": 1, "equal_steps": 2}],
    }
    told = " ".join(gark("check", str(file)).out.split())
    assert "1: fails at order 2: [[]] of stage 2, r = 2: -1/2 instead of 0" in told
    file.write_text(TRAPEZOIDAL + "expect: {predictor-order: 2}\n")
    assert "there is no predictor" in gark("check", str(file)).out


def test_files_come_back() -> None:
    """As spelled out, and with the conversions that leave the stages alone."""
    from garkcli import convert

    method = loads(TR_BDF2)
    assert loads(convert(method).method.text).predictor == method.predictor
    assert convert(method, "canonical").method.predictor is None


def test_export_says_it_or_leaves_it_out() -> None:
    from garkcli import export

    method = loads(TRAPEZOIDAL + "predictor: {old: [[], [-1/2, 3/2]]}")
    document = json.loads(export(method, "json"))
    assert document["predictor"]["old"] == [[["0", "0"], ["-1/2", "3/2"]]]
    space: dict[str, Any] = {}
    exec(export(method, "numpy"), space)
    assert space["predictor_old"][0].tolist() == [[0, 0], [-0.5, 1.5]]
    assert "gark_text_predictor_old_r0[2][2]" in export(method, "c")
    for target in ("petsc", "csv", "matlab", "julia"):
        assert "Left out: predictor." in export(method, target)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("A: [[], [1]]\nb: [0, 1]\npredictor: {old: [[], [1, 0]]}", "every stage is explicit"),
        (TRAPEZOIDAL + "predictor: {new: [[], [0, 1]]}", "stage 2 is not known where stage 2"),
        (
            "A: [[1, 1], [1, 1]]\nb: [0, 1]\npredictor: {new: [[], [1]]}",
            "stage 1 is not known where stage 2",
        ),
        (TRAPEZOIDAL + "predictor: {old: [[1]]}", "predictor, old is 1 by 2"),
        (TRAPEZOIDAL + "predictor: {}", "no weights"),
        (TRAPEZOIDAL + "predictor: {old: [[1, 2, 3], [1]]}", "should have 2"),
        (TRAPEZOIDAL + "predictor: {old: [[], [1, 0]]}\ntolerance: 1e-9", "exact coefficients"),
        (TRAPEZOIDAL + "predictor: {old: [[], [1, 0]]}\nconjugate: true", "or predictor"),
        (
            "tableau: {A: [[[[1]], null], [null, [[1]]]], b: [[1], [1]], predictor: {old: [[1]]}}",
            "one colour",
        ),
        ("methods: gauss-2\npredictor: {old: [[1]]}", "beside b of a Butcher tableau"),
    ],
)
def test_what_is_refused(text: str, message: str) -> None:
    with pytest.raises(MethodFileError, match=message):
        loads(text)
