"""A find as text of method files: what reports and files need of it, without exact numbers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import floor, log10

from flint import arb

from garkcli.design.chosen import DIGITS, values_text
from garkcli.design.search.points import small_bits
from garkcli.design.search.search import BITS, Find, Proof
from garkcli.design.solutions import value_at
from garkcli.errors import MethodError
from garkcli.exact.field import Number
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_decimal, root_text
from garkcli.exact.roots import RealRoot

DECIMALS = 40
"""Decimals of numbers that are not known exactly."""
RESIDUAL = f"1e-{floor(log10(2) * small_bits(BITS))}"
"""What all residuals are below after the last step of Newton's method. The residuals themselves are
rounding, and no two machines need to agree on them.
"""
TOLERANCE = "1e-30"
"""What a file with so many decimals is meant up to."""


@dataclass(frozen=True)
class Method:
    """A method that was found.

    Attributes:
        start: the number of the start that led to it, from 1.
        proof: what is known of it.
        order: its exact order where that is known; else that of the conditions that were solved.
        values: of the parameters, exact or decimals.
        residual: a bound on all residuals up to the order; "0" where they vanish.
    """

    start: int
    proof: Proof
    order: int
    values: Mapping[str, str]
    residual: str

    @property
    def is_exact(self) -> bool:
        """Whether the values are exact and the order proved."""
        return self.proof == "exact"


def told(find: Find, parameters: tuple[str, ...]) -> Method:
    """A find as text.

    Args:
        find: as it was found.
        parameters: the names that have a value in the file.
    """
    if find.found is not None:
        solution = find.found.solution
        exact = {name: solution.values[name] for name in parameters}
        values = _exact(exact, solution.real[0])
    else:
        values = {name: decimals(find.digits[name]) for name in parameters}
    residual = "0" if find.found is not None else RESIDUAL
    return Method(find.start, find.proof, find.order, values, residual)


def _exact(values: dict[str, Number], root: RealRoot) -> dict[str, str]:
    try:
        return values_text(values, root)
    except MethodError:
        # none of them generates the field of all: each by a polynomial of its own
        return {name: _alone(value, root) for name, value in values.items()}


def _alone(value: Number, root: RealRoot) -> str:
    number = value_at(value, root)
    simple = root_text(number)
    if simple is not None:
        return simple
    polynomial = polynomial_text(Polynomial.from_flint(number.polynomial), "x")
    near = root_decimal(number, DIGITS)
    return f"root_of({polynomial}, {near})".replace("^", "**")


def decimals(number: arb, count: int = DECIMALS) -> str:
    """The nearest decimal number with ``count`` decimals.

    >>> decimals(arb("0.25"), 3)
    '0.250'
    """
    mantissa, exponent = number.mid().man_exp()
    scaled = int(mantissa) * 10**count
    shift = int(exponent)
    # half up, in whole numbers
    rounded = scaled << shift if shift >= 0 else ((scaled >> (-shift - 1)) + 1) >> 1
    digits = f"{abs(rounded):0{count + 1}d}"
    sign = "-" if rounded < 0 else ""
    return f"{sign}{digits[:-count]}.{digits[-count:]}"
