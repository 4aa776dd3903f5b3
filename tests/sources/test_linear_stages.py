"""Rosenbrock methods as programs store them are known by their row sums, whatever the names."""

from __future__ import annotations

import pytest

from garkcli.bridges.audit import audit
from garkcli.sources.languages import c, fortran, python

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


PRINTED = """
template <class T> struct Ros3p {
  static constexpr T gamma = 0.7886751345948129;
  static constexpr arr c = {0, 1, 1}, b = {2/3., 0, 1/3.}, bstar = {1/3., 1/3., 1/3.};
  static constexpr arr2 a = {arr{0, 0, 0}, arr{1, 0, 0}, arr{1, 0, 0}};
  static constexpr arr2 g = {arr{0, 0, 0}, arr{-1, 0, 0},
                             arr{-0.7886751345948129, -1.0773502691896258, 0}};
};
"""


def test_a_gamma_beside_two_triangles() -> None:
    """Rosenbrock's, with nodes and embedded weights, although α and b have order 1 alone."""
    (table,) = c.find(PRINTED, "x.hpp")
    found = audit(table)
    assert found is not None
    assert found.order is not None
    assert found.embedded_order is not None
    assert (found.order.order, found.embedded_order.order, found.findings) == (3, 2, ())
    assert table.c == (("0", "1", "1"),)


@pytest.mark.parametrize(
    ("declared", "level"), [("", "warning"), ("  static constexpr int order = 3;\n", "error")]
)
def test_one_digit_of_a_method_with_or_without_its_order(declared: str, level: str) -> None:
    """The number is named, also if only its repair says which order is meant; two numbers that
    mend it are a doubt.
    """
    head, brace, rest = PRINTED.partition("{\n")
    text = (head + brace + declared + rest).replace("1.0773502691896258", "1.0873502691896258")
    (table,) = c.find(text, "x.hpp")
    found = audit(table)
    assert found is not None
    (remark,) = found.findings
    assert (remark.code, remark.level) == ("order", level)
    assert "order 3 would hold with" in remark.help
    assert "instead of -1.08735" in remark.help


@pytest.mark.parametrize(
    ("weight", "code", "cure"),
    [("0.6766666666666666", "order", "instead of 0.6766666666666666"), ("1/2.", "weights", "")],
)
def test_a_weight_of_a_method_without_its_order(weight: str, code: str, cure: str) -> None:
    """The cure is sought among decimals."""
    (table,) = c.find(PRINTED.replace("b = {2/3.", f"b = {{{weight}"), "x.hpp")
    found = audit(table)
    assert found is not None
    (remark,) = found.findings
    assert (remark.code, remark.level) == (code, "error")
    assert cure in remark.help


def test_names_that_others_have_too() -> None:
    """Without γ, or with a full second matrix, it is a Runge–Kutta method and something else."""
    (table,) = c.find(PRINTED.replace("gamma", "other"), "x.hpp")
    assert table.gamma is None
    for entries in ("arr{0, 0, 1}, arr{-1, 0, 0}", "arr{0, 0, 0}, arr{-1, 2, 0}"):
        text = PRINTED.replace("arr{0, 0, 0}, arr{-1, 0, 0}", entries)
        (table,) = c.find(text.replace("2/3., 0, 1/3.}, b", "1/2., 1/4., 1/4.}, b"), "x.hpp")
        assert table.gamma is None


RECORDS = """
METHODS = {{
    "ros3p": dict(gamma=0.7886751345948129, alpha=[[], [1], [1, 0]], b=[2/3, 0, 1/3], b_hat=[1/3, 1/3, 1/3],
        gamma_ij=[[], [-1], [-0.7886751345948129, {}]]),
    "kutta": dict(A=[[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]], b=[1/6, 2/3, 1/6], c=[0, 1/2, 1]),
}}
"""


def test_records_of_letters() -> None:
    """Each is a method of its own kind; a Rosenbrock method without order 2 is none."""
    found = [audit(x) for x in python.find(RECORDS.format(-1.0773502691896258), "x.py")]
    assert [(x.table.name, x.order.order) for x in found if x and x.order] == [
        ("ros3p", 3),
        ("kutta", 3),
    ]
    assert [x.table.gamma is None for x in found if x] == [False, True]
    found = [audit(x) for x in python.find(RECORDS.format(-1.2773502691896258), "x.py")]
    assert [x.order.order for x in found if x and x.order and x.table.gamma] == [1]


@pytest.mark.parametrize("own", ["", ", a32 = 1", ", c21 = 0"])
def test_a_last_entry_and_zeros_may_be_left_out(own: str) -> None:
    """The weights are the last row and 1; of 0 and 1 one alone has order 2."""
    numbers = f"gamma = 0.5, a21 = 1, a31 = 0.5, c31 = 3, c32 = -4{own}"
    (table,) = c.find(f"namespace rosenbrock {{ const double {numbers}; }}", "x")
    found = audit(table)
    assert found is not None
    assert found.order is not None
    assert (found.order.order, table.b) == (2, (("1/2", "1", "1"),))
