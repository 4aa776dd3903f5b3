"""What a method answers by itself, and how it is shown in a line."""

from __future__ import annotations

from fractions import Fraction

import pytest
from flint import fmpq

import garkcli
from garkcli import (
    GarkMethod,
    assert_order,
    conjugate,
    diagonal_method,
    find_order,
    find_orders,
    from_arrays,
    is_symplectic,
    load,
    loads,
    pair,
)
from garkcli.check.analysis import analyse as analyse_tableau
from garkcli.errors import ZeroWeight
from garkcli.order.certificate import find_order as exact_order

METHODS = {
    "catalogue": load("rk4"),
    "rounded": loads(
        "A: [[0.25, -0.038675134594813], [0.538675134594813, 0.25]]\n"
        "b: [0.5, 0.5]\ntolerance: 1e-14"
    ),
    "two colours": loads(
        "methods: [{family: gauss, stages: 1},"
        " {family: lobatto-iiia, stages: 2}]\ntransfer: collocation"
    ),
    "family": diagonal_method("radau-iia", 2),
}
PAIR = from_arrays([[0, 0], [1, 0]], ["1/2", "1/2"], embedded=[1, 0])


@pytest.mark.parametrize("kind", METHODS)
def test_attributes_are_what_the_functions_say(kind: str) -> None:
    """Order, conjugate, pair and symplecticity: as attributes and as calls."""
    method = METHODS[kind]
    assert method.order == find_order(method).order
    assert method.conjugate.tableau == conjugate(method).tableau
    assert method.pair.tableau == pair(method).tableau
    assert method.is_symplectic == is_symplectic(method)
    assert method.conjugate.conjugate is method
    assert isinstance(method.pair, GarkMethod)


@pytest.mark.parametrize("kind", METHODS)
def test_all_orders_are_those_of_the_report(kind: str) -> None:
    """``orders`` has what ``gark check`` analyses, and ``assert_order`` agrees."""
    method = METHODS[kind]
    found = analyse_tableau(method.tableau, tolerance=method.tolerance)
    assert found.conjugate_order is not None
    assert found.pair_order is not None
    assert method.orders == {
        "order": found.order.order,
        "conjugate": found.conjugate_order.order,
        "pair": found.pair_order.order,
    }
    assert_order(method, **method.orders)


def test_orders_honour_the_tolerance_of_the_file() -> None:
    """Rounded coefficients have order 2 exactly and 4 within their tolerance; so has what is made
    of them.
    """
    rounded = METHODS["rounded"]
    assert exact_order(rounded.tableau).order == 2
    assert rounded.order == 4
    assert rounded.conjugate.order == 4
    assert rounded.orders == {"order": 4, "conjugate": 4, "pair": 4}


def test_what_there_is_not_has_no_order() -> None:
    """Embedded weights have an order where there are some; a weight of zero leaves no conjugate."""
    assert PAIR.orders["embedded"] == 1
    assert "embedded" not in METHODS["catalogue"].orders
    midpoint = from_arrays([[0, 0], ["1/2", 0]], [0, 1])
    assert midpoint.orders == {"order": 2}
    with pytest.raises(ZeroWeight):
        midpoint.conjugate  # noqa: B018 -- the attribute is the point


def test_orders_beyond_the_search_are_lower_bounds() -> None:
    """Where the search stops the order is said as a claim says it, which is true of the method."""
    gauss = diagonal_method("gauss", 2)
    orders = find_orders(gauss, 3)
    assert orders == {"order": ">= 3", "conjugate": ">= 3", "pair": ">= 3"}
    assert_order(gauss, **orders)
    assert find_orders(gauss, 4)["order"] == ">= 4"
    assert find_orders(gauss, 5)["order"] == 4
    assert repr(find_order(gauss, 3)) == "<Order at least 3>"


def test_the_entries_of_conjugate_and_pair_are_those_printed() -> None:
    """Â_ij = b_j − b_j A_ji / b_i, from the entries of A and b alone."""
    method = METHODS["catalogue"]
    A = [[_fraction(x) for x in row] for row in method.A]
    b = [_fraction(x) for x in method.b]
    wanted = [[b[j] - b[j] * A[j][i] / b[i] for j in range(4)] for i in range(4)]
    found = method.conjugate.A
    assert [[_fraction(x) for x in row] for row in found] == wanted
    both = method.pair
    assert both.b == {1: method.b, 2: method.b}
    # where forces are evaluated velocities are seen by A
    assert both.A[2, 1] == method.A
    assert both.A[1, 2] == found


def _fraction(x: fmpq) -> Fraction:
    return Fraction(int(x.p), int(x.q))


def test_an_order_is_shown_in_a_line() -> None:
    """Without its witness, which is an attribute."""
    found = find_order(METHODS["catalogue"])
    assert repr(found) == "<Order 4>"
    assert found.witness is not None
    tree = str(found.witness.tree)
    assert tree == "[[[[[]]]]]"
    assert repr(found.witness) == f"<Witness {tree}: 0 instead of 1/120>"
    many = find_order(diagonal_method("gauss", 8))
    assert many.witness is not None
    assert "of order 17" in repr(many.witness)
    assert len(repr(many.witness)) < 80
    assert garkcli.find_order(METHODS["rounded"]).order == 4
