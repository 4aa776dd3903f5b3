"""gark import --recognise: exact forms of decimals, as far as the order bears them out."""

from __future__ import annotations

from decimal import Decimal

import pytest
from flint import arb, fmpq

from garkcli.bridges.claiming import imported
from garkcli.bridges.recognising import proposed, recognised
from garkcli.exact.display import to_decimal
from garkcli.families.registry import diagonal_method
from garkcli.sources.found import FoundTable
from garkcli.tableau.forms import gark as gark_tableau
from garkcli.tableau.pointwise import Cell, entries

KNOWN = {
    "0.33333333333333333": "1/3",
    "-0.38196601125010515": "-3/2 + sqrt(5)/2",
    "0.2928932188134525": "1 - sqrt(2)/2",
    "0.435866521508458999416019451194": "root_of(6*x**3 - 18*x**2 + 9*x - 1, "
    "0.435866521508458999416019451194)",
}


@pytest.mark.parametrize("text", KNOWN)
def test_proposals(text: str) -> None:
    """Fractions, quadratic numbers, roots of cubics; the distance is below the last place."""
    found = proposed(text)
    assert found is not None
    assert found.exact == KNOWN[text]
    places = len(text.partition(".")[2])
    assert Decimal(found.distance) <= 2 * Decimal(10) ** -places


@pytest.mark.parametrize("text", ["0.5", "0.7182818284590452", "0.577215664901532"])
def test_no_proposal(text: str) -> None:
    """Neither what is exact already nor what is no short algebraic number."""
    assert proposed(text) is None


def rounded(stages: int, digits: int) -> FoundTable:
    """Gauss's method in decimals, as a source might print it."""
    tableau = gark_tableau([diagonal_method("gauss", stages)], {})
    exact = entries(tableau, 40)

    def text(x: Cell) -> str:
        assert not isinstance(x, arb)
        return to_decimal(x, digits)

    block = exact.A[0][0] or ()
    A = tuple(tuple(map(text, row)) for row in block)
    b = tuple(map(text, exact.b[0]))
    c = tuple(map(text, exact.c[0]))
    return FoundTable("x", 1, "json", "gauss", ((A,),), (b,), (c,))


def test_gauss_becomes_exact() -> None:
    """Sixteen digits of two stages are enough for the square root of 3; then no tolerance is left
    and the order is that of the certificate over ℚ(√3).
    """
    before = imported(rounded(2, 17), "gauss")
    assert before.tolerance is not None
    found = recognised(before, "gauss")
    assert found.left == ()
    assert found.refused == ()
    assert found.method.tolerance is None
    assert found.method.order.order == 4
    assert "sqrt(3)" in found.method.text


def test_a_wrong_form_is_refused() -> None:
    """A decimal that is near a fraction is not taken for it where the order falls: here the
    weights are those of Heun's rule with the digits of 1/2 + 10⁻⁹.
    """
    near = "0.50000000100000000"
    other = "0.49999999900000000"
    A = (("0", "0"), ("1", "0"))
    table = FoundTable("x", 1, "c", "near", ((A,),), ((near, other),))
    before = imported(table, "near")
    found = recognised(before, "near")
    assert found.method.order.order >= before.order.order
    for x in found.taken:
        assert fmpq(1, 2) != fmpq_of(x.exact)


def fmpq_of(text: str) -> fmpq:
    """A fraction from its text."""
    p, _, q = text.partition("/")
    return fmpq(int(p), int(q or 1))
