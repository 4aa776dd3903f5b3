"""Results travel between processes unchanged."""

from __future__ import annotations

import copy
import pickle

from flint import arb, fmpq, fmpq_mat, fmpq_poly, fmpz_poly

from garkcli.exact.display import to_text
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.pickling import register
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots


def sent(value: object) -> object:
    """The value as it arrives on the other side."""
    register()
    return pickle.loads(pickle.dumps(value))


def test_exact_numbers_arrive_unchanged() -> None:
    """Rationals, polynomials and matrices are the same on the other side."""
    values = (
        fmpq(-3, 7),
        fmpq_poly([1, fmpq(1, 3)]),
        fmpz_poly([-2, 0, 10**30]),
        fmpq_mat([[1, fmpq(1, 2)]]),
    )
    assert sent(values) == values


def test_balls_arrive_unchanged() -> None:
    """A ball keeps its midpoint and its radius exactly, whatever the precision there."""
    ball = arb(1) / 3 + arb(0, "1e-30")
    arrived = sent(ball)
    assert isinstance(arrived, arb)
    assert arrived.mid().man_exp() == ball.mid().man_exp()
    assert arrived.contains(ball)
    assert sent(arb(0)) == 0


def test_numbers_of_one_field_stay_together() -> None:
    """Two irrational numbers sent together still belong to one field and can be added."""
    expressions = [parse("sqrt(2)"), parse("cbrt(5)")]
    domain = Domain(expressions)
    values = [domain.evaluate(expression) for expression in expressions]
    to_text(values[0])  # fills what the field keeps
    one, other = sent(values)  # type: ignore[misc]
    assert to_text(one + other) == "sqrt(2) + cbrt(5)"


def test_polynomials_arrive_whose_roots_are_known() -> None:
    """What was found with them in balls stays behind."""
    p = Polynomial([Domain([parse("sqrt(2)")]).evaluate(parse("sqrt(2)")), 3, 1])
    roots = real_roots(p)
    assert p._images
    arrived = sent(p)
    assert arrived == copy.deepcopy(p) == p
    assert isinstance(arrived, Polynomial)
    assert real_roots(arrived) == roots
