"""The simplifying conditions that the digits of a method suggest."""

from __future__ import annotations

from garkcli.methodfile.load import loads
from garkcli.methodfile.printed import at_full_length
from garkcli.order.meant import within_digits
from garkcli.order.shape import candidates

LARGE = """\
A: [[], [0.3333333333333333], [-1234567.123456789, 1234567.790123456]]
b: [0.25, 0, 0.75]
c: [0, 0.3333333333333333, 0.6666666666666667]
"""
"""Heun's nodes and weights, with large coefficients, whose last digits are 10⁻⁹."""


def test_small_rows_count_beside_large_coefficients() -> None:
    """The sum of the second row and the sums of the nodes are right to 10⁻¹⁶, far less than the
    last digit of the large coefficients, and no rounding errors of zeros: they are conditions.
    """
    rounded = within_digits(loads(LARGE).tableau, at_full_length)
    assert rounded is not None
    chosen = {(x.kind, x.k): which for x, which in candidates(rounded.search.origin).items()}
    assert chosen == {("B", 2): [0], ("B", 3): [0], ("C", 1): [1, 2]}
