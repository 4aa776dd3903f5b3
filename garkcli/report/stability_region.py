"""Regions of stability in plain text."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

from flint import fmpq

from garkcli.exact.display import to_float
from garkcli.page.asciiplot import terminal_region
from garkcli.stability.damping import ImexPair
from garkcli.stability.linear import StabilityFunction

COLUMNS, LINES = 51, 15
"""A picture with its margin is below 60 columns wide."""
EDGE = 1 + 1e-9
"""Keeps points on the very edge inside on every machine."""


def region_lines(R: StabilityFunction) -> Iterator[str]:
    """A small picture of the region |R(z)| ≤ 1."""
    is_inside, reach = _bounded(R)
    right = reach if R.denominator.degree else reach / 3
    picture = terminal_region(is_inside, -reach, right, reach, COLUMNS, LINES)
    yield "|R(z)| ≤ 1, roughly"
    yield from picture.splitlines()


def damped_lines(pair: ImexPair, explicit: StabilityFunction) -> Iterator[str]:
    """A small picture of the z_E for which all z_I are damped, each of its points decided.

    Args:
        pair: the method.
        explicit: the stability function of its explicit colour alone.
    """
    is_bounded, reach = _bounded(explicit)

    def is_damped(z: complex) -> bool:
        a, b = (fmpq(*x.as_integer_ratio()) for x in (z.real, z.imag))
        return pair.is_damped(a, abs(b))

    picture = terminal_region(is_damped, -reach, reach / 3, reach, COLUMNS, LINES, is_bounded)
    e, i = f"z{pair.explicit + 1}", f"z{pair.implicit + 1}"
    yield f"█ {e} with every {i} damped, decided at each sign"
    yield f": further {e} damped where {i} = 0, roughly"
    yield from picture.splitlines()


def _bounded(R: StabilityFunction) -> tuple[Callable[[complex], bool], float]:
    """Whether |R(z)| ≤ 1 in floats, and a radius for a picture of that."""
    P, Q = ([to_float(a) for a in p.coefficients] for p in (R.numerator, R.denominator))

    def is_bounded(z: complex) -> bool:
        return abs(_horner(P, z)) <= abs(_horner(Q, z)) * EDGE

    return is_bounded, reach_of([P, Q])


def reach_of(polynomials: Sequence[Sequence[float]]) -> float:
    """A radius that holds all zeros and poles, by Fujiwara's bound, with some room."""
    reach = 2.0
    for *others, leading in polynomials:
        for k, a in enumerate(reversed(others), start=1):
            reach = max(reach, abs(a / leading) ** (1 / k))
    return float(f"{1.6 * reach:.1g}")


def _horner(coefficients: Sequence[float], z: complex) -> complex:
    value = 0j
    for a in reversed(coefficients):
        value = value * z + a
    return value
