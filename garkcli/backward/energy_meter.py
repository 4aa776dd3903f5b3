"""Errors of the modified Hamiltonian up to each of its powers, measured over step sizes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import log10
from typing import Any

from flint import arb, ctx, fmpq

from garkcli.convergence.ladder import has_settled
from garkcli.convergence.result import Row, slope_between
from garkcli.doing import counting
from garkcli.problems.straightline import function
from garkcli.problems.vectorfield import symbols
from garkcli.stepping.integrator import Binding
from garkcli.stepping.step import trajectory

ROWS = 5
"""Step sizes; more, up to ``MAX_ROWS``, while the slopes have not settled."""
MAX_ROWS = 7
MAX_STEPS = 20_000
"""Most steps of a row."""
_DIGITS = 30  # of the first look
_MOST_DIGITS = 200
_SPARE = 15  # digits of the smallest error
_LOST = 4  # digits that steps and formulas lose, besides those of their number


@dataclass
class Meter:
    """Steps, and measures every truncation of the modified Hamiltonian at once.

    Attributes:
        bound: the method on the problem.
        formulas: H, and what multiplies the powers.
        powers: of h, 0 first.
        t_end: the final time.
        digits: of the steps.
    """

    bound: Binding
    formulas: Sequence[Any]
    powers: Sequence[int]
    t_end: fmpq
    digits: int = _DIGITS

    def choose_digits(self, first: int, order: int) -> None:
        """So many that the smallest error, which falls with h^order, is far above rounding."""
        while True:
            smallest = self.errors(first)[-1]
            is_seen = not smallest.contains(0)
            if is_seen or self.digits >= _MOST_DIGITS:
                break
            self.digits = min(2 * self.digits, _MOST_DIGITS)
        if is_seen:
            fall = arb(2) ** (-order * (MAX_ROWS - 1))
            needed = _places(smallest.mid() * fall) + _SPARE
            self.digits = min(max(self.digits, needed), _MOST_DIGITS)

    def table(self, first: int) -> list[list[Row]]:
        """For each step size a row of each truncation."""
        table: list[list[Row]] = []
        for k in range(MAX_ROWS):
            count = first * 2**k
            h = self.t_end / count
            if k >= ROWS and (count > MAX_STEPS or self._have_settled(table)):
                break
            row = []
            for i, error in enumerate(self.errors(count)):
                before = table[-1][i] if table else None
                slope = slope_between(before, h, error)
                row.append(Row(h, error, slope, error, digits=self.digits))
            table.append(row)
        return table

    def _have_settled(self, table: Sequence[Sequence[Row]]) -> bool:
        columns = zip(*table, strict=True)
        return all(slopes_have_settled(rows) for rows in columns)

    def errors(self, count: int) -> list[arb]:
        """The root mean square over time, by the trapezoidal rule, of H̃(y_n) − H̃(y_0) for each
        truncation, in so many steps.
        """
        integrator = self.bound.at(self.digits)
        h = self.t_end / count
        variables = self.bound.problem.variables
        q = symbols(variables, "q")
        p = symbols(variables, "p")
        steps = trajectory(integrator, h, count)
        path = counting(f"h = {h}", steps, count + 1)
        with ctx.workprec(integrator.bits):
            values_of = function(tuple(self.formulas), (*q, *p), True)
            squares = [arb(0) for _ in self.powers]
            start: list[arb] = []
            for n, y in enumerate(path):
                values = self._truncations(values_of(*y), h)
                start = start or values
                for k, first in enumerate(start):
                    square = (values[k] - first).mid() ** 2
                    # the trapezoidal rule; the change is 0 at the start
                    squares[k] += square / 2 if n == count else square
            sizes = [abs(x) for x in start]
            rounding = arb(10) ** (_LOST - self.digits)
            noise = sum(sizes, arb(1)) * rounding * count
            means = [(x / count).sqrt() for x in squares]
            return [_enclosed(x, noise) for x in means]

    def _truncations(self, values: Sequence[arb], h: fmpq) -> list[arb]:
        """H̃ up to each of the powers."""
        total = arb(0)
        sums = []
        for power, value in zip(self.powers, values, strict=True):
            total += value * arb(h**power)
            sums.append(total)
        return sums


def are_above_noise(rows: Sequence[Row]) -> bool:
    """Whether no error is one that rounding may have made."""
    return not any(row.error.contains(0) for row in rows)


def slopes_have_settled(rows: Sequence[Row]) -> bool:
    """Whether the errors of one truncation show an order, as in a convergence test."""
    are_enough = len(rows) >= ROWS
    return are_enough and are_above_noise(rows) and has_settled(rows)


def _enclosed(error: arb, noise: arb) -> arb:
    """An error with what rounding can have done to it."""
    return arb(error.mid(), noise.mid())


def _places(x: arb) -> int:
    """How many zeros a small positive number has behind the point, about.

    >>> _places(arb("1e-30"))
    30
    """
    mantissa, exponent = x.mid().man_exp()
    bits = mantissa.bit_length() + int(exponent)
    places = round(-bits * log10(2))
    return max(0, places)
