"""Rosenbrock methods as programs store them are known by their row sums, whatever the names."""

from __future__ import annotations

import pytest

from garkcli.bridges.audit import audit
from garkcli.sources.languages import fortran, python

ROS3P = """
def lang_verwer():
    g = 1/2 + sqrt(3)/6
    x = [[], [1/g], [1/g, 0]]
    y = [[], [-1/g**2], [-(1 + (2 - 1/(2*g))/g)/g, -(2 - 1/(2*g))/g]]
    u = [(1 + (2/3 - 1/(6*g))/g)/g, (2/3 - 1/(6*g))/g, 1/(3*g)]
    {}
    return g, x, y, u
"""
"""Of Lang and Verwer (2001), order 3."""
BESIDE = "v, w = [0, 1, 1], [g, g - 1, 1/2 - 2*g]"
ON_DIAGONALS = """
def two_stages():
    g = 1.707106781186547
    a = [[0, 0], [0.585786437626905, 1.0]]
    c = [[g, 0], [-1.171572875253810, -g]]
    m1 = [0.8786796564403575, 0.2928932188134525]
    m2 = [0.585786437626905, 0]
    order = {}
    return g, a, c, m1, m2
"""
"""Ros2 of Verwer, Spee, Blom and Hundsdorfer (1999), order 2."""


def test_nodes_and_sums_are_beside_the_matrices() -> None:
    (table,) = python.find(ROS3P.format(BESIDE), "x.py")
    found = audit(table)
    assert found is not None
    assert found.order is not None
    assert found.nonautonomous_order is not None
    assert (found.order.order, found.nonautonomous_order.order) == (3, 3)


@pytest.mark.parametrize(
    "beside",
    [
        "v, w = [0, 1, 1], [g, g - 1, 1/3 - 2*g]",
        "v, w = [0, 1, 1/2], [g, g - 1, 1/2 - 2*g]",
        "v = [0, 1, 1]",
    ],
)
def test_other_sums_say_nothing(beside: str) -> None:
    """Nor do they without one another."""
    found = [audit(x) for x in python.find(ROS3P.format(beside), "x.py")]
    assert not any(x is not None and x.order for x in found)


@pytest.mark.parametrize(("declared", "count"), [(2, 0), (3, 1)])
def test_they_are_the_diagonals(declared: int, count: int) -> None:
    """The second weights are embedded ones; a declared order is compared."""
    (table,) = python.find(ON_DIAGONALS.format(declared), "x.py")
    found = audit(table)
    assert found is not None
    assert found.order is not None
    assert found.embedded_order is not None
    assert (found.order.order, found.embedded_order.order) == (2, 1)
    assert [x.code for x in found.findings] == ["order"] * count


def test_two_matrices_are_combinations_by_their_sums_alone() -> None:
    """Rows of alpha have the sum 1; without that the names a and c say nothing."""
    text = "def f():\n    a = [[1], [0, {}]]\n    c = [[1], [{}, 1/2]]\n    return a, c\n"
    (table,) = python.find(text.format("1/2", "1/2"), "x.py")
    assert table.is_read
    assert not any(x.is_read for x in python.find(text.format("1/2", "1/4"), "x.py"))


def test_reshape_with_unknown_sizes_twice_is_square() -> None:
    """As in classes of Fortran; named arguments are known, too."""
    text = (
        "subroutine set(this)\n  class(rk) :: this\n  this%b = (/ 1./6., 2./3., 1./6. /)\n"
        "  this%c = (/ 0., .5, 1. /)\n  this%a = transpose(reshape((/ &\n"
        "    0., 0., 0., .5, 0., 0., -1., 2., 0. /), {}))\nend subroutine\n"
    )
    for shape in ("(/ this%m, this%m /)", "shape=(/ 3, 3 /)"):
        (table,) = fortran.find(text.format(shape), "x.f90")
        found = audit(table)
        assert found is not None
        assert found.order is not None
        assert found.order.order == 3, shape
    others = fortran.find(text.format("(/ this%m, this%n /)"), "x.f90")
    assert not any(x.is_read for x in others)
