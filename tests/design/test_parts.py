"""Solution sets in parts: of products of planes each point is known, and is in one part."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import product

import pytest
from flint import fmpq, fmpq_mat, fmpq_mpoly
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.design.ideal import Ideal
from garkcli.design.member import value_of
from garkcli.design.parts import (
    Changes,
    Part,
    Pieces,
    charts,
    nodes_as_coordinates,
    parts_of,
    parts_within,
    points_of,
    rank,
    values_on,
    what_is_asked,
)
from garkcli.exact.cells import Interval
from garkcli.exact.field import Number
from garkcli.exact.parametric import Parameters, evaluated, fraction
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot
from garkcli.frozen import replace
from garkcli.methodfile.family import loads_family
from tests.whole import at_most

RING = Parameters(["x", "y", "z"])
X, Y, Z = RING.context.gens()
PLANES = st.tuples(*[st.integers(-2, 2)] * 3, st.integers(-2, 2)).filter(lambda a: any(a[:3]))
Plane = tuple[int, int, int, int]
Point = tuple[fmpq, ...]
PRODUCTS = st.lists(st.lists(PLANES, min_size=1, max_size=2), min_size=1, max_size=3)


def form(plane: Plane) -> fmpq_mpoly:
    """The polynomial of degree one that vanishes there."""
    a, b, c, d = plane
    return a * X + b * Y + c * Z + d


def points_in(planes: Sequence[Plane]) -> list[Point]:
    """Some common points, as many as planes leave free; none if there is none."""
    rows = fmpq_mat([[fmpq(k) for k in plane] for plane in planes])
    reduced, count = rows.rref()
    pivots = [next(j for j in range(4) if reduced[i, j]) for i in range(count)]
    if 3 in pivots:
        return []
    free = [j for j in range(3) if j not in pivots]
    found = []
    for values in product([fmpq(0), fmpq(1), fmpq(-3, 7), fmpq(5, 2)], repeat=len(free)):
        point = dict(zip(free, values, strict=True))
        for i, j in enumerate(pivots):
            point[j] = -reduced[i, 3] - sum((reduced[i, k] * point[k] for k in free), fmpq(0))
        found.append(tuple(point[k] for k in range(3)))
    return found


def is_in(part: Part, point: Point) -> bool:
    """Whether a point belongs to a part."""
    at = dict(zip(RING.names, point, strict=True))
    coordinates = [at[name] for name in part.ring.names]
    if any(evaluated(p, coordinates) for p in part.equations):
        return False
    if not all(evaluated(p, coordinates) for p in part.nonzero):
        return False
    for name, x in part.values.items():
        over, under = (evaluated(p, coordinates) for p in fraction(x, part.ring))
        if not under or over / under != at[name]:
            return False
    return True


def solutions_of(part: Part) -> list[dict[str, Number]]:
    """Some points of a part, in all unknowns."""
    if not part.dimension:
        return [dict(part.extended(x).values) for x in points_of(part)]
    found: list[dict[str, Number]] = []
    for chart in charts(part):
        for values in product([fmpq(2, 3), fmpq(-7, 5), fmpq(11)], repeat=len(chart.names)):
            solution = chart.point(part, values)
            if solution is not None:
                found.append(dict(solution.values))
    return found


@given(PRODUCTS, st.lists(PLANES, max_size=1), st.sampled_from([(), ("z",), ("y", "x")]))
@settings(max_examples=at_most(12, 120))
def test_each_point_is_in_one_part(
    products: list[list[Plane]], excluded: list[Plane], kept: tuple[str, ...]
) -> None:
    """With a Gröbner basis and without; no part has others; the largest has the dimension of all."""
    equations = []
    for planes in products:
        p = RING.constant(fmpq(1))
        for plane in planes:
            p *= form(plane)
        equations.append(p)
    nonzero = [form(plane) for plane in excluded]
    points = {x for chosen in product(*products) for x in points_in(chosen)}
    allowed = {x for x in points if all(evaluated(p, x) for p in nonzero)}
    ideal = Ideal(RING, nonzero).with_zeros(equations)
    pieces = Pieces.of(equations, nonzero, Changes(RING, RING, {}), kept)
    for parts in (list(parts_of(ideal, kept=kept)), list(pieces.parts)):
        for x in points:
            assert sum(is_in(part, x) for part in parts) == (x in allowed)
        for part in parts:
            some = solutions_of(part)
            assert some
            for values in some:
                assert not any(value_of(p, RING, values) for p in equations)
                assert all(value_of(p, RING, values) for p in nonzero)
        largest = max((part.dimension for part in parts), default=-1)
        assert largest == ideal.dimension
    assert pieces.dimension == ideal.dimension
    assert pieces.is_everything == (ideal.dimension < 0)
    further = form((1, 1, -1, 0))
    smaller = pieces.with_zeros([further])
    for x in points:
        is_left = x in allowed and not evaluated(further, x)
        assert sum(is_in(part, x) for part in smaller.parts) == is_left
        for part in pieces.parts:
            at = dict(zip(RING.names, x, strict=True))
            within = list(parts_within(part, [part.ring.context.gen(0)] if part.ring.names else []))
            if is_in(part, x):
                is_there = not part.ring.names or at[part.ring.names[0]] == 0
                assert sum(is_in(other, x) for other in within) == is_there


@pytest.mark.parametrize(
    ("equations", "nonzero", "dimension"),
    [
        ([X * Y - Z, X * Z - Y], [], 1),
        ([X**2 - 2, Y * X - 1], [], 1),
        ([X**2 - 2, Y**2 - X - 1, Z - X * Y], [], 0),
        ([X * Y - 1, Z * X], [], 1),
        ([X * Y * Z], [X], 2),
        ([X**2 + Y**2 - 1, X * Z], [X], 1),
        ([X**2 * Y - Z], [X, Z], 2),
    ],
)
def test_curves_and_surfaces_in_parts(
    equations: list[fmpq_mpoly], nonzero: list[fmpq_mpoly], dimension: int
) -> None:
    """Their points are zeros, and no zero is excluded; the largest has their dimension."""
    ideal = Ideal(RING, nonzero).with_zeros(equations)
    for parts in (
        list(parts_of(ideal)),
        list(Pieces.of(equations, nonzero, Changes(RING, RING, {})).parts),
    ):
        assert max(part.dimension for part in parts) == dimension
        for part in parts:
            for values in solutions_of(part):
                assert not any(value_of(p, RING, values) for p in equations)
                assert all(value_of(p, RING, values) for p in nonzero)


def test_one_coordinate_of_a_part() -> None:
    """The equation in it alone, and its values; those of a free one within sets."""
    [part] = parts_of(Ideal(RING).with_zeros([X**2 - 2, Z - X * Y]), kept=("y",))
    equation = what_is_asked(part, "x")
    assert equation is not None
    assert str(equation) == "x^2 - 2"
    assert what_is_asked(part, "y") is None
    assert values_on(part, "y") is None
    one, two = (RealRoot.rational(fmpq(k)) for k in (1, 2))
    within = replace(part, sets=(("y", (Interval(None, two),)), ("z", (Interval(None, one),))))
    at_least_one = Polynomial([fmpq(-1), fmpq(1)])
    assert values_on(within, "y", [at_least_one]) == (Interval(one, two, has_start=True),)
    charts_of_both = charts(part)
    assert [chart.index for chart in charts_of_both] == [0, 1]
    assert [float(chart.root) for chart in charts_of_both] == pytest.approx([-(2**0.5), 2**0.5])
    assert all(chart.names == ("y",) for chart in charts_of_both)
    assert charts(next(parts_of(Ideal(RING).with_zeros([X**2 + Y**2 - 3])))) == []


@given(st.lists(st.lists(st.integers(-2, 2), min_size=3, max_size=3), min_size=1, max_size=4))
def test_the_rank(rows: list[list[int]]) -> None:
    """That of python-flint."""
    matrix = [[fmpq(x) for x in row] for row in rows]
    assert rank(matrix) == fmpq_mat(matrix).rank()


def test_nodes_take_the_place_of_unknowns() -> None:
    """c₂ and c₃ as sums of unknowns, each instead of one that is in no other node."""
    names = "{a: free, b: free, d: free, e: free}"
    family = loads_family(
        f"parameters: {names}\nA: [[0, 0, 0], [a, b, 0], [2*d, b, 3*e]]\nb: [1, 0, 0]\n"
    )
    changes = nodes_as_coordinates(family.tableau, family.ring)
    assert changes.nodes == ("c2", "c3")
    assert set(changes.ring.names) == {"c2", "b", "c3", "e"}
    values = changes.values()
    new = {name: fmpq(k + 2, 3) for k, name in enumerate(changes.ring.names)}
    at = list(new.values())

    def old(name: str) -> fmpq:
        over, under = (evaluated(p, at) for p in fraction(values[name], changes.ring))
        return fmpq(over / under)

    assert old("a") + old("b") == new["c2"]
    assert 2 * old("d") + old("b") + 3 * old("e") == new["c3"]
    moved = changes.polynomial(family.ring.parameter("d").numerator ** 2)
    assert evaluated(moved, at) == old("d") ** 2
