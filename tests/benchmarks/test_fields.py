"""Stability in a number field of degree 12 against the same method with rational coefficients."""

from __future__ import annotations

from functools import partial

from garkcli import loads
from garkcli.stability.summary import stability
from tests.benchmarks.measuring import assert_ratio, interleaved

IRRATIONAL = """\
A: [["sqrt(2)/4", "1/2 + sqrt(3)/6", "1/4"], ["0", "0", "cbrt(2)/3"],
    ["1 - sqrt(2)/2", "-1/2", "1/2 - sqrt(3)/6"]]
b: ["-sqrt(3)/6", "-sqrt(3)/6", "1 + sqrt(3)/3"]
"""
RATIONAL = IRRATIONAL.replace("sqrt(2)", "7/5").replace("sqrt(3)", "7/4").replace("cbrt(2)", "5/4")


def test_degree_twelve_against_rational_numbers() -> None:
    """Euclid's algorithm over the field, with a fraction in each step, takes minutes."""
    tableaus = [loads(text).tableau for text in (IRRATIONAL, RATIONAL)]
    field, rational = interleaved(*[partial(stability, x) for x in tableaus], 3)
    assert_ratio("stability in degree 12 / rational", field / rational, 60, f"{field:.2f} s")
