"""One deadline for every engine of ``gark design``."""

from __future__ import annotations

import ast
from collections.abc import Callable, Iterator
from contextlib import suppress
from itertools import combinations, count, islice, product
from math import prod
from pathlib import Path
from random import Random

import pytest
from flint import Ordering, arb, fmpq, fmpq_mat, fmpq_mpoly, fmpz_mpoly_ctx

import garkcli
from garkcli import deadline, load, loads, search_methods
from garkcli.deadline import check_time, checked, only_small, spending, until, within
from garkcli.design.choices import walk_down
from garkcli.design.conditions import FamilyConditions
from garkcli.design.critical import smooth_points
from garkcli.design.design import Design, find_parameters
from garkcli.design.groebner import groebner_basis, grown_basis, leading, unproved_basis
from garkcli.design.ideal import Ideal, characteristic_polynomial, least_meeting
from garkcli.design.minimise.climbing import climbed
from garkcli.design.minimise.minimise import minimise
from garkcli.design.minimise.smallest import critical_point_near
from garkcli.design.minimise.squared_error import squared_error
from garkcli.design.parts import nodes_as_coordinates, parts_of
from garkcli.design.real_points import has_methods, without_complex
from garkcli.design.search.recognise import recognised
from garkcli.design.search.run import results
from garkcli.design.search.search import Search
from garkcli.design.solutions import solutions
from garkcli.design.stability_kinds import TwoSprings
from garkcli.design.stable_parts import stable_part
from garkcli.design.stable_set import stable_set
from garkcli.design.steps import Undecided
from garkcli.errors import NotDecided
from garkcli.exact.apart import apart, first_of
from garkcli.exact.fibre import Fibre
from garkcli.exact.parametric import Parameters, factors
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.projection import (
    PLANE,
    discriminant,
    is_nowhere_negative,
    kept_sign,
    projected,
    resultant,
)
from garkcli.exact.roots import RealRoot, real_roots
from garkcli.frozen import replace
from garkcli.methodfile.family import loads_family
from garkcli.order.certificate import find_order
from garkcli.order.hulls import hulls
from garkcli.order.weak_stages import weak_stage_order
from garkcli.report.rendering import render
from tests.whole import in_whole

SDIRK2 = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
RANGE3 = "parameters: {a: free}\nA: [[0, 0, 0], [2*a, 0, 0], [0, 1/2, 0]]\nb: [0, 0, 1]\n"
EXPLICIT3 = "unknown: {stages: 3, shape: explicit}\n"
FULL2 = "unknown: {stages: 2, shape: full}\n"
VERLET = "parameters: {t: free}\nsplitting: {a: [t, 1 - 2*t, t], b: [1/2, 1/2]}\n"
SPRINGS = """parameters: {t: free}
methods:
  - {family: lobatto-iiia, stages: 2}
  - {family: gauss, stages: 1}
transfer: {default: collocation, blocks: {"2,1": [[1/2 - t, t]]}}
structure: semi-separable
"""
DIRK2 = "parameters: {g: free, d: free}\nA: [[g, 0], [1 - d, d]]\nb: [1/2, 1/2]\n"
COMBINED = """parameters: {s: free, t: free}
methods: [{family: gauss, stages: 1}, {family: lobatto-iiia, stages: 2}]
transfer: {default: collocation, blocks: {"1,2": [[1/4 + s, 1/4 + t]]}}
"""
TRANSFERS = """parameters: {s: free}
methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]
transfer: {interpolation: s, collocation: 1 - s}
"""
CONTEXT = fmpz_mpoly_ctx.get(("x", "y"), Ordering.degrevlex)
X, Y = CONTEXT.gens()
PAIR = Parameters(["x", "y"])
P, Q = PAIR.context.gens()
PLANE_Y, PLANE_T = PLANE.gens()
CURVE = PLANE_Y**3 - PLANE_T * PLANE_Y + PLANE_T**2 - 2
QUINTIC = Polynomial([-1, -1, 0, 0, 0, 1])


def designed(text: str, order: int) -> Design:
    """What an order asks of a family."""
    return find_parameters(loads_family(text), order)


def ideal_of(text: str, order: int) -> Ideal:
    """The ideal of an order."""
    found = designed(text, order).last.ideal
    assert found is not None
    return found


def engines() -> Iterator[tuple[str, Callable[[], object]]]:
    """Everything that may take long, each on a small input that is made before."""
    sdirk, explicit = loads_family(SDIRK2), loads_family(EXPLICIT3)
    third = designed(EXPLICIT3, 3)
    gauss = ideal_of(FULL2, 4)
    family = ideal_of(EXPLICIT3, 3)
    square = Ideal(PAIR).with_zeros([P**2 + Q**2])
    root = real_roots(QUINTIC)[0][0]
    yield "conditions", lambda: list(FamilyConditions(explicit.tableau, explicit.ring).of_order(4))
    yield "Gröbner basis", lambda: groebner_basis([X**2 + Y, X * Y - 1], CONTEXT)
    yield "Gröbner basis that grows", lambda: grown_basis([X], [X], [Y], CONTEXT)
    yield "msolve", lambda: unproved_basis([X**2 + Y, X * Y - 1], CONTEXT)
    yield "ideal", lambda: Ideal(PAIR).with_zeros([P * Q - 1])
    yield "elimination", lambda: Ideal(PAIR, [P])._with_generators([]).with_zeros([Q]).closure
    yield "covering", lambda: least_meeting([frozenset({1, 2})])
    yield "quotient", lambda: Ideal(PAIR).with_zeros([P**2 - Q, Q**2 - 1]).multiplications
    yield "characteristic polynomial", lambda: characteristic_polynomial(fmpq_mat(2, 2))
    yield "solutions", lambda: solutions(gauss)
    yield "real methods", lambda: has_methods(explicit, family, family, lambda *_: True)
    yield "definite forms", lambda: without_complex(square)
    yield "critical points", lambda: smooth_points(Ideal(PAIR).with_zeros([P**2 + Q**2 - 1]))
    yield "signs in the plane", lambda: kept_sign(P**2 + P * Q + Q**2)
    yield "cells of the plane", lambda: is_nowhere_negative(CURVE)
    yield "parameters", lambda: decided(find_parameters(sdirk, 3))
    yield "choices", lambda: walk_down(third, {"c2": ("1/2", fmpq(1, 2))})
    yield "parts", lambda: list(parts_of(family, nodes_as_coordinates(third.tableau, family.ring)))
    yield "error", lambda: squared_error(sdirk.tableau, 3, sdirk.ring)
    line, points, split = designed(RANGE3, 2), designed(SDIRK2, 3), designed(VERLET, 2)
    for name in ("error", "coefficients", "-ssp", "-real-interval", "-imaginary-interval"):
        yield f"minimise {name}", lambda key=name: minimise(line, key)
    yield "minimise -oscillator-interval", lambda: minimise(split, "-oscillator-interval")
    yield "minimise on a plane", lambda: minimise(third, "error")
    yield "minimise by trial", lambda: minimise(third, "-ssp")
    yield "minimise of solutions", lambda: minimise(points, "error")
    yield "trial", lambda: climbed(lambda point: (point[0],), 1)
    yield (
        "critical point",
        lambda: critical_point_near([fmpq(1), fmpq(1)], [P - 1, Q - 1], [], PAIR),
    )
    yield "stable values", lambda: stable_set(sdirk, "a-stable")
    two = designed("unknown: {stages: 2, shape: sdirk}\ndesign: {a-stable: true}\n", 2)
    assert two.last.ideal is not None
    [part, *_] = parts_of(two.last.ideal, kept=["gamma"])
    yield "stable parts", lambda: stable_part(two.family, "method", part)
    yield "minimise of stable methods", lambda: minimise(two, "coefficients")
    yield "stable on the oscillator", lambda: stable_set(split.family, "p-stable")
    springs, of_pair = loads_family(SPRINGS), find_parameters(loads_family(TRANSFERS), 4, "pair")
    yield (
        "stable on two springs",
        lambda: stable_set(springs, "p-stable", two_springs=TwoSprings(fmpq(1), 1)),
    )
    yield "stable in a plane", lambda: stable_set(loads_family(DIRK2), "a-stable")
    yield "stable in one combination", lambda: stable_set(loads_family(COMBINED), "a-stable")
    transfers = loads_family(TRANSFERS)
    yield "order of the pair", lambda: decided(find_parameters(transfers, 5, "pair"))
    yield "error of the pair", lambda: minimise(of_pair, "error")
    dirk = load("wso-433").tableau
    yield "weak stage order", lambda: weak_stage_order(dirk, [0], 9)
    yield "hulls", lambda: hulls(dirk, 3)
    yield "recognition of roots", lambda: recognised({"x": arb(2).sqrt()}, 60)
    yield "search", lambda: list(results(Search(sdirk, 3), 3))
    yield "proof of a find", lambda: Search(sdirk, 3).find(1, [0.7886751345948129])
    yield "real roots", lambda: real_roots(QUINTIC)
    yield "comparison of roots", lambda: root < RealRoot.rational(fmpq(2))
    yield "projection", lambda: projected([CURVE], [fmpq(0)])
    yield "discriminant", lambda: discriminant(CURVE)
    yield "resultant", lambda: resultant(CURVE, PLANE_Y - PLANE_T)
    yield "fibre", lambda: Fibre(root, factors([CURVE])).roots
    method = loads("A: [[1/4, 1/4 - sqrt(3)/6], [1/4 + sqrt(3)/6, 1/4]]\nb: [1/2, 1/2]\n")
    yield "certificate", lambda: find_order(method.tableau)
    yield "process", lambda: apart(sorted, [2, 1])
    yield "processes", lambda: first_of((sorted, ([2, 1],)))


def itertools_without_clock() -> Iterator[str]:
    """Calls of itertools that have very many items and are not looked at the clock for: all whose
    number of factors is not written down.
    """
    many = {"combinations", "combinations_with_replacement", "permutations", "product"}
    for path in sorted(Path(garkcli.__file__).parent.rglob("*.py")):
        text = path.read_text(encoding="utf-8")
        if "itertools" not in text:
            continue
        tree = ast.parse(text)
        imported = {
            x.asname or x.name
            for node in ast.walk(tree)
            if isinstance(node, ast.ImportFrom) and node.module == "itertools"
            for x in node.names
            if x.name in many
        }
        whole = [x for node in ast.walk(tree) if isinstance(node, ast.Import) for x in node.names]
        assert "itertools" not in {x.name for x in whole}, path
        calls = [node for node in ast.walk(tree) if isinstance(node, ast.Call)]
        within_checked = {
            id(inner)
            for call in calls
            if isinstance(call.func, ast.Name) and call.func.id == "checked"
            for inner in ast.walk(call)
        }
        for call in calls:
            is_many = isinstance(call.func, ast.Name) and call.func.id in imported
            if is_many and not has_few_factors(call) and id(call) not in within_checked:
                yield f"{path}:{call.lineno}: {ast.unparse(call)}"


def has_few_factors(call: ast.Call) -> bool:
    """Whether the number of factors of a product, or the size of a choice, is written down."""
    assert isinstance(call.func, ast.Name)
    if call.func.id == "product":
        is_open = any(isinstance(x, ast.Starred) for x in call.args)
        return not is_open and all(isinstance(x.value, ast.Constant) for x in call.keywords)
    return len(call.args) == 2 and isinstance(call.args[1], ast.Constant)


def test_every_loop_over_very_many_looks_at_the_clock() -> None:
    """No combination or product of any size is gone through without."""
    assert list(itertools_without_clock()) == []


def test_a_loop_over_very_many_ends_with_its_time() -> None:
    """The items are made one by one, and none after the deadline."""
    with within(0.05), pytest.raises(NotDecided) as raised:
        for _ in islice(checked(product((0, 1), repeat=100)), 3_000_000):
            pass
    assert raised.value.is_late


MANY_UNKNOWNS = """methods: [gauss-2, lobatto-iiia-3, lobatto-iiib-3]
transfer: "?"
"""


def test_real_points_of_many_unknowns() -> None:
    """Of forty unknowns those that nothing relates are chosen by covering, not one choice after
    the other, of which there are millions.
    """
    family = loads_family(MANY_UNKNOWNS)
    step = find_parameters(family, 2, seconds=1e3).last
    assert isinstance(step.ideal, Ideal)
    chosen = step.ideal.independent
    assert chosen is not None
    supports = [{i for i, k in enumerate(leading(p)) if k} for p in step.ideal.basis]
    assert len(chosen) == step.ideal.dimension > 30
    assert not any(x <= set(chosen) for x in supports)


@pytest.mark.parametrize("seed", range(12))
def test_the_first_independent_unknowns(seed: int) -> None:
    """They are the first of all choices of so many that have no leading monomial."""
    random = Random(seed)
    names = [f"x{k}" for k in range(random.randint(2, 5))]
    ring = Parameters(names)
    gens = list(ring.context.gens())

    def monomial() -> fmpq_mpoly:
        return prod(random.sample(gens, random.randint(1, 2)), start=ring.constant(fmpq(1)))

    nonzero = [monomial()] * random.randint(0, 1)
    ideal = Ideal(ring, nonzero).with_zeros(monomial() - monomial() for _ in range(2))
    supports = [{i for i, k in enumerate(leading(p)) if k} for p in ideal.basis]
    choices = combinations(range(len(names)), ideal.dimension)
    free = (x for x in choices if not any(support <= set(x) for support in supports))
    assert ideal.independent == next(free, None)


def decided(found: Design) -> None:
    """An order that is left open, as the exception that other engines raise."""
    if found.last.kind == "undecided":
        raise NotDecided


FEW_LOOKS = 8
"""At the clock."""
SPARE_LOOKS = 4
"""Of what is tried in other ways where the time is over."""
ENGINES = [pytest.param(run, id=name) for name, run in engines()]


@pytest.mark.parametrize("engine", ENGINES)
def test_no_engine_works_after_the_deadline(engine: Callable[[], object]) -> None:
    """Each one gives up at once where the time is over; without a limit it ends."""
    with within(0), pytest.raises(NotDecided):
        engine()


LONG = {"minimise by trial", "stable in a plane", "stable on two springs"}
"""Those that take a second, twice."""


@pytest.mark.parametrize(
    "engine", [pytest.param(*x.values, id=x.id, marks=[in_whole] * (x.id in LONG)) for x in ENGINES]
)
def test_no_engine_works_past_the_deadline(
    engine: Callable[[], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of as many looks at the clock as it takes, the second half is not reached where the time is
    over in the middle. What looks fewer times works in a process of its own, or is one step.
    """

    def looks(most: float) -> int:
        readings = count()
        with monkeypatch.context() as patched, until(most):
            patched.setattr(deadline, "monotonic", lambda: next(readings))
            with suppress(NotDecided):
                engine()
        return next(readings)

    everything = looks(1e5)
    if everything > FEW_LOOKS:
        assert looks(everything // 2) <= everything // 2 + SPARE_LOOKS


def test_what_is_said_without_time() -> None:
    """The first order is left open, an order below one that takes too long is not."""
    family = loads_family(SDIRK2)
    with within(0):
        found = find_parameters(family)
    [step] = found.steps
    assert isinstance(step, Undecided)
    assert (step.has_methods, step.is_late) == (None, True)
    assert found.reaches() is None


@pytest.mark.parametrize("is_late", [True, False])
def test_more_time_is_advised_where_it_helps(is_late: bool) -> None:
    """What ended with its time may be decided in more; what is beyond the limits of gark is not."""
    found = find_parameters(loads_family(SDIRK2), 1)
    text = " ".join(render(replace(found, steps=(Undecided(1, None, is_late),))).split())
    assert ("not decided in the time of --seconds; give it more" in text) is is_late
    assert ("not decided within the limits of gark; fewer unknowns" in text) is not is_late


@pytest.mark.parametrize("is_late", [True, False])
def test_why_an_order_is_open(is_late: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is known of the work that was given up."""

    def given_up(*_: object) -> Ideal:
        raise NotDecided(is_late)

    monkeypatch.setattr(Ideal, "with_zeros", given_up)
    last = find_parameters(loads_family(SDIRK2), 3).last
    assert isinstance(last, Undecided)
    assert last.is_late is is_late


def test_a_search_without_time() -> None:
    """It has what was found by then, which is nothing, and says why it ended."""
    found = search_methods(loads_family(SDIRK2), 3, starts=3, seconds=0)
    assert (found.ending, found.starts, found.methods) == ("time", 0, [])


def test_only_what_is_small() -> None:
    """What needs a process of its own is refused without a limit, and the rest is done."""
    with only_small():
        assert groebner_basis([X * Y - 1, Y - 1], CONTEXT)
        with pytest.raises(NotDecided, match="within the limits of gark; give parameters values"):
            apart(sorted, [2, 1])


def test_limits_within_limits() -> None:
    """An earlier deadline around another one stays, and none is left behind."""
    with within(1e6):
        outer = deadline.seconds_left()
        with within(1e8):
            inner = deadline.seconds_left()
        with within(None):
            check_time()
    assert outer is not None
    assert inner is not None
    assert inner <= outer
    assert deadline.seconds_left() is None


def test_a_process_that_fails_leaves_it_open() -> None:
    """Where one ends without a result the other one has it; where all do, it is open."""
    with within(60):
        assert first_of((_fails, ()), (sorted, ([2, 1],))) == [1, 2]
        with pytest.raises(NotDecided) as caught:
            apart(_fails)
        assert not caught.value.is_late


def _fails() -> list[int]:
    raise MemoryError


def test_processor_time_ends_a_process(monkeypatch: pytest.MonkeyPatch) -> None:
    """A process counts its own; work that waits has no deadline by the clock."""
    with spending(0.05), pytest.raises(NotDecided) as raised:
        apart(_count_for_ever)
    assert raised.value.is_late
    with spending(3600):
        assert apart(divmod, 7, 2) == (3, 1)
        monkeypatch.setattr(deadline, "processor_time", lambda: 1e8)
        with pytest.raises(NotDecided):
            check_time()


def _count_for_ever() -> None:
    for _ in count():
        pass
