"""The embeddings of number fields: norms and multiplicities in balls, against resultants and common
divisors over the field.
"""

from __future__ import annotations

from typing import Any

import pytest
from flint import fmpq, fmpq_poly

from garkcli import loads
from garkcli.exact.conjugates import Image, conjugates, images
from garkcli.exact.display import to_ball
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Algebraic, Number, NumberField
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import _multiplicity_by_gcds, multiplicity_at, real_roots
from garkcli.stability.summary import stability
from tests.whole import in_whole

FIELDS = [
    ["sqrt(2)"],
    ["root_of(6*x**3 - 18*x**2 + 9*x - 1, 0.43586652)"],
    ["sqrt(2)", "sqrt(3)"],
    ["root_of(3*x**5 - x - 1, 1)"],
    ["sqrt(2)", "cbrt(3)"],
    ["sqrt(2)", "sqrt(3)", "sqrt(5)"],
]
NEAR = f"root_of(x**5 - 2*({10**60}*x - 1)**2, 1/{10**60} + 1/{10**210})"
"""Another root is as near to it as 10^−209."""


def numbers(texts: list[str]) -> tuple[NumberField, list[Number]]:
    """A field and its radicals."""
    expressions = [parse(text) for text in texts]
    domain = Domain(expressions)
    assert domain.field is not None
    return domain.field, [domain.evaluate(x) for x in expressions]


def polynomials(texts: list[str]) -> list[Polynomial]:
    """Polynomials with roots that are simple and multiple, in the field and not."""
    _, values = numbers(texts)
    a, b = values[0], values[-1]
    x = Polynomial([0, 1])
    p, q = x - a, x * x - b - 1
    return [p, q, p * p * q, p * q * (x + a), p * p * (x + a) * (x - 3), q * q * (x * x - 2) * p]


@pytest.mark.parametrize("texts", FIELDS)
def test_norms_are_products_of_resultants(texts: list[str]) -> None:
    """The norm in balls has the factors, and their powers, that values at integers give."""
    for p in polynomials(texts):
        assert p.field is not None
        _, expected = p._norm_by_resultants(p.field).factor()
        _, found = p.norm().factor()
        key = str
        assert sorted(found, key=key) == sorted(expected, key=key)


@pytest.mark.parametrize("texts", FIELDS)
def test_multiplicities_are_those_of_common_divisors(texts: list[str]) -> None:
    """Every real root of the norm is one of the polynomial as often as Euclid's algorithm says."""
    for p in polynomials(texts):
        found = dict(real_roots(p))
        for root, _ in real_roots(Polynomial.from_flint(p.norm())):
            expected = _multiplicity_by_gcds(p, root)
            assert multiplicity_at(p, root) == expected == found.get(root, 0)


def test_real_roots_divide_nothing_in_the_field(monkeypatch: pytest.MonkeyPatch) -> None:
    """No inverse is taken: they are what grows long."""
    given = polynomials(["sqrt(2)", "sqrt(3)", "sqrt(5)"])

    def inverse(number: Algebraic) -> Number:
        raise AssertionError(f"1/({number})")

    monkeypatch.setattr(Algebraic, "inverse", inverse)
    assert [sum(power for _, power in real_roots(p)) for p in given] == [1, 2, 4, 4, 4, 7]


@in_whole
def test_few_inverses_decide_stability(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of three stages in degree 8, where common divisors with the factors of norms took 181."""
    method = loads(
        'A: [["0", "0", "-sqrt(3)/6"], ["sqrt(5)/5", "1/2 - sqrt(3)/6", "0"],'
        ' ["1 - sqrt(2)/2", "1 - sqrt(2)/2", "3/4"]]\n'
        'b: ["sqrt(2)/4", "1", "1/4 + sqrt(3)/12"]\n'
    )
    taken: list[Algebraic] = []
    inverse = Algebraic.inverse

    def counted(number: Algebraic) -> Number:
        taken.append(number)
        return inverse(number)

    monkeypatch.setattr(Algebraic, "inverse", counted)
    assert stability(method.tableau).linear[0].a_stable is False
    assert len(taken) < 30


@pytest.mark.parametrize("texts", FIELDS)
@pytest.mark.parametrize("bits", [64, 1000])
def test_conjugates_are_roots_with_theta_first(texts: list[str], bits: int) -> None:
    """One for every real root of the minimal polynomial and one for every pair that is not real."""
    field, _ = numbers(texts)
    found = conjugates(field, bits)
    assert found is not None
    assert found[0].real.overlaps(to_ball(field.element(fmpq_poly([0, 1])), bits // 4))
    real = [z for z in found if z.imag.is_zero()]
    assert 2 * len(found) - len(real) == field.degree
    assert all(z.real.rad() < fmpq(1, 2 ** (bits // 2)) for z in found)


def test_conjugates_that_are_near_are_not_sought() -> None:
    """Then resultants and common divisors decide, with the same result."""
    field, [theta] = numbers([NEAR])
    assert conjugates(field, 64) is None
    x = Polynomial([0, 1])
    ((root, power),) = real_roots((x - theta) * (x - theta))
    assert power == 2
    assert root.polynomial.degree() == 5


def test_the_norm_is_divided_by_no_factor_again(monkeypatch: pytest.MonkeyPatch) -> None:
    """How often a root is one of the norm is known from its factors, and one image serves all."""
    f, g, *_ = polynomials(FIELDS[-1])
    divided, made = [], []
    monkeypatch.setattr("garkcli.exact.roots._multiplicity", divided.append)

    def counted(*arguments: Any) -> list[Image] | None:
        made.append(arguments)
        return images(*arguments)

    monkeypatch.setattr("garkcli.exact.polynomial.images", counted)
    found = real_roots(f * f * g)
    assert len(found) > 1
    assert not divided
    assert len(made) == len({bits for _, _, bits in made})
