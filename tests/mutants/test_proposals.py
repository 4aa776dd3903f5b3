"""Wrong proposals of the code that `make mutants` excuses as such: no verdict follows them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from flint import fmpq

from garkcli import (
    find_order,
    find_parameters,
    find_property,
    loads,
    loads_family,
    minimise,
    search_methods,
)
from garkcli.design.search.least_squares import Minima
from garkcli.design.search.optimum import Optimum
from garkcli.exact.display import to_float
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, real_roots
from garkcli.frozen import replace
from garkcli.ntrees.table import TreeTable
from garkcli.order.admissible import coupling_graph
from garkcli.order.conditions import conditions
from garkcli.order.meant import as_meant
from garkcli.order.rounded import RoundedTableau, find_order_within
from garkcli.tableau.pointwise import numeric_entries
from garkcli.tableau.tableau import Tableau

EXPLICIT = """parameters: {c: free, a: free, b: free, d: free}
A: [[0, 0, 0], [c, 0, 0], [d - a, a, 0]]
b: [1 - b - 1/4, b, 1/4]
"""
SDIRK = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
RNG = np.random.default_rng(5)


@pytest.fixture(autouse=True)
def same_numbers_in_every_test() -> None:
    """A test gets the same errors alone and among others."""
    RNG.bit_generator.state = np.random.default_rng(5).bit_generator.state


def astray(x: Any) -> Any:
    """A point, or points, some way off."""
    return np.asarray(x, float) + RNG.normal(0.0, 0.3, np.shape(x))


def any_points(_system: object, starts: Any, *_: object, **__: object) -> Minima:
    """Points that solve nothing, as solutions."""
    return Minima(astray(starts), np.ones(starts.shape[1], bool))


def far_snapped(original: Callable[..., Any]) -> Callable[..., Any]:
    """A system with short numbers, and a point that is no solution of it."""

    def snapped(*arguments: Any) -> Any:
        system, x = original(*arguments)
        return system, astray(x)

    return snapped


def assert_order(tableau: Tableau, order: int) -> None:
    """All conditions hold, to the digits of the numbers."""
    table = TreeTable.of(coupling_graph(tableau), order)
    for condition in conditions(tableau, map(table.tree, range(len(table)))):
        assert abs(to_float(condition.residual)) < 1e-30


@pytest.mark.parametrize("text", [SDIRK, EXPLICIT], ids=["sdirk", "explicit"])
@pytest.mark.parametrize("name", ["least_squares", "snapped"])
def test_points_that_solve_nothing(name: str, text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each method of a search has the order that is told of it, whatever points it comes from."""
    from garkcli.design.search import search

    wrong = any_points if name == "least_squares" else far_snapped(search.snapped)
    monkeypatch.setattr(search, name, wrong)
    found = search_methods(loads_family(text), 3, starts=12)
    for method in found.methods:
        assert method.order >= 3
        assert_order(loads(text, settings=dict(method.values)).tableau, method.order)
    assert found.methods or name == "least_squares"


@pytest.mark.parametrize("name", ["descended", "settled", "shortened"])
def test_better_methods_that_are_none(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Values of objectives are those of the methods told, not those that the optimiser thinks."""
    from garkcli.design.search import optimum

    if name == "descended":
        monkeypatch.setattr(optimum, name, lambda _task, _equations, x: astray(x))
    else:
        original = getattr(optimum.Optimisation, name)

        def changed(self: Any, *arguments: Any) -> Any:
            found = original(self, *arguments)
            if name == "settled":
                return Optimum(found.value - 1, tuple(astray(found.point)))
            system, near = found
            return system, Optimum(near.value - 1, tuple(astray(near.point)))

        monkeypatch.setattr(optimum.Optimisation, name, changed)
    found = search_methods(loads_family(EXPLICIT), 2, starts=3, objective="coefficients")
    assert found.methods
    for method in found.methods:
        tableau = loads(EXPLICIT, settings=dict(method.values)).tableau
        assert method.order >= 2
        assert_order(tableau, method.order)
        entries = numeric_entries(tableau)
        squares = [float(x) ** 2 for row in entries.A[0][0] or () for x in row]
        squares += [float(x) ** 2 for x in entries.b[0]]
        assert float(method.objective or 0) == pytest.approx(sum(squares), rel=1e-5)


@pytest.mark.parametrize(
    "wrong",
    [
        lambda numbers: replace(numbers, values={k: x + 1 for k, x in numbers.values.items()}),
        lambda numbers: replace(numbers, values={k: fmpq(1, 3) for k in numbers.values}),
        lambda numbers: replace(
            numbers, root=real_roots(Polynomial.from_flint(numbers.modulus))[0][0]
        ),
        lambda _: None,
    ],
)
@pytest.mark.parametrize("text", [SDIRK, EXPLICIT], ids=["sdirk", "explicit"])
def test_wrong_guesses_of_numbers(
    text: str, wrong: Callable[[Any], Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A method is exact with numbers that have the order alone; else it is one in digits."""
    from garkcli.design.search import search

    original = search.recognised

    def guessed(*arguments: Any) -> Any:
        numbers = original(*arguments)
        return numbers and wrong(numbers)

    monkeypatch.setattr(search, "recognised", guessed)
    found = search_methods(loads_family(text), 3, starts=3)
    assert found.methods
    for method in found.methods:
        tableau = loads(text, settings=dict(method.values)).tableau
        assert_order(tableau, 3)
        if method.proof == "exact":
            assert find_order(tableau).order == method.order


@pytest.mark.parametrize(
    ("curve", "has_methods"), [("x**2 + y**2 - 3", True), ("x**2 + y**2 + 3", False)]
)
@pytest.mark.parametrize("far", [fmpq(1, 10**6), fmpq(1000)])
def test_samples_where_nothing_is(
    curve: str, has_methods: bool, far: fmpq, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where no sample is a method, the cells of the plane decide, or it stays open."""
    from garkcli.design import real_points

    monkeypatch.setattr(real_points._MethodSearch, "_sample", lambda *_: far)
    entry = f"A: [[0, 0], [0, 0]]\nb: [x, '1 - x + {curve}']\n"
    two = loads_family(f"parameters: {{x: free, y: free}}\n{entry}")
    assert find_parameters(two, 1).last.has_methods is has_methods
    three = entry.replace(curve, f"{curve} + z**4 - z")
    found = find_parameters(loads_family(f"parameters: {{x: free, y: free, z: free}}\n{three}"), 1)
    assert found.last.has_methods in ({True, None} if has_methods else {False, None})


def test_a_goal_that_is_no_stability(monkeypatch: pytest.MonkeyPatch) -> None:
    """A-stable methods are wanted; the optimiser is told that all are, and unstable ones go."""
    from garkcli.design.search import goals

    monkeypatch.setattr(goals.AStable, "at", lambda _self, x: (np.ones(3), np.zeros((3, len(x)))))
    text = f"{SDIRK}design: {{a-stable: true}}\n"
    found = search_methods(loads_family(text), 2, starts=6, objective="error")
    assert found.methods or found.unstable
    for method in found.methods:
        tableau = loads(SDIRK, settings=dict(method.values)).tableau
        assert find_property(tableau, "a-stable").value is True


def test_a_bad_point_by_trial(monkeypatch: pytest.MonkeyPatch) -> None:
    """It has its own value, and is called found."""
    from garkcli.design.minimise import comparison, smallest

    monkeypatch.setattr(comparison, "climbed", lambda _rank, n: (fmpq(5, 7),) * n)
    monkeypatch.setattr(smallest, "MOST_COORDINATES", 0)
    monkeypatch.setattr(smallest, "critical_point_near", lambda *_: None)
    text = "parameters: {c: free, d: free}\nA: [[0, 0], [c, 0]]\nb: [1 - d**2 - c, d**2 + c]\n"
    found = minimise(find_parameters(loads_family(text), 1), "coefficients")
    value = fmpq(5, 7) ** 2 + (1 - fmpq(60, 49)) ** 2 + fmpq(60, 49) ** 2
    assert (found.extent, found.value) == ("found", RealRoot.rational(value))


ROUNDED = """tolerance: 1e-8
A: [[0, 0, 0, 0], [{}, 0, 0, 0], [-0.33333333, 1, 0, 0], [1, -1, 1, 0]]
b: [0.125, 0.375, 0.375, 0.125]
"""


@pytest.mark.parametrize("name", ["nearest", "bounded_least_squares", "compromise"])
@pytest.mark.parametrize(("entry", "order"), [("0.33333333", 4), ("0.33333433", 1)])
def test_shifts_that_meet_nothing(
    name: str, entry: str, order: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No order is recovered that rounding does not explain."""
    from garkcli.order import bounded, existence, recovering, shape

    size = {"nearest": 1, "bounded_least_squares": 1, "compromise": 0}[name]

    def anything(J: Any, *_: object) -> Any:
        return RNG.uniform(-1, 1, J.shape[size])

    for module in (bounded, existence, recovering, shape):
        if hasattr(module, name):
            monkeypatch.setattr(module, name, anything)
    method: Any = as_meant(loads(ROUNDED.format(entry)))
    found = find_order_within(method, 6)
    assert found.order <= order
    if found.order < order:
        assert not found.is_proved


@pytest.mark.parametrize("off", [fmpq(0), fmpq(3), fmpq(-1000)])
@pytest.mark.parametrize("doubt", [0.0, 5.0, 1e5])
def test_wrong_candidates_for_a_misprint(
    off: fmpq, doubt: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An entry is said to be wrong only if the method has the order with another number there."""
    from garkcli.order import suspects

    original = suspects._candidate

    def moved(*arguments: Any) -> Any:
        found = original(*arguments)
        return found and replace(found, shift=found.shift + off, doubt=doubt, is_sure=True)

    monkeypatch.setattr(suspects, "_candidate", moved)
    gauss = """tolerance: 1e-10
A: [[0.25, -0.03867513459481288], [{}, 0.25]]
b: [0.5, 0.5]
"""
    method: Any = as_meant(loads(gauss.format("0.53867513559481288")))
    found = suspects.suspects(method, 4)
    if (off, doubt) == (0, 5):
        assert found
    for repair, order in found.items():
        assert order == 4
        mended = RoundedTableau.within(repair.carried_out(method.tableau), fmpq(1, 10**10))
        assert find_order_within(mended, 4).order == 4
