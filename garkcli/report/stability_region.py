"""Regions of stability in plain text."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

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
    P, Q = _floats(R)
    reach = reach_of([P, Q])
    right = reach / 3 if len(Q) == 1 else reach

    def is_inside(z: complex) -> bool:
        return _is_bounded(P, Q, z)

    picture = terminal_region(is_inside, -reach, right, reach, COLUMNS, LINES)
    yield "|R(z)| ≤ 1, roughly"
    yield from picture.splitlines()


def damped_lines(pair: ImexPair, explicit: StabilityFunction) -> Iterator[str]:
    """A small picture of the z_E for which all z_I are damped, each of its points decided.

    Args:
        pair: the method.
        explicit: the stability function of its explicit colour alone.
    """
    P, Q = _floats(explicit)
    reach = reach_of([P, Q])

    def is_damped(z: complex) -> bool:
        a, b = _rational(z.real), _rational(z.imag)
        return pair.is_damped(a, abs(b))

    def is_bounded(z: complex) -> bool:
        return _is_bounded(P, Q, z)

    picture = terminal_region(is_damped, -reach, reach / 3, reach, COLUMNS, LINES, is_bounded)
    e = f"z{pair.explicit + 1}"
    i = f"z{pair.implicit + 1}"
    yield f"█ {e} with every {i} damped, decided at each sign"
    yield f": further {e} damped where {i} = 0, roughly"
    yield from picture.splitlines()


def _rational(x: float) -> fmpq:
    numerator, denominator = x.as_integer_ratio()
    return fmpq(numerator, denominator)


def _floats(R: StabilityFunction) -> tuple[list[float], list[float]]:
    P = [to_float(a) for a in R.numerator.coefficients]
    return P, [to_float(a) for a in R.denominator.coefficients]


def _is_bounded(P: Sequence[float], Q: Sequence[float], z: complex) -> bool:
    over = abs(_horner(P, z))
    under = abs(_horner(Q, z))
    return over <= under * EDGE


def reach_of(polynomials: Sequence[Sequence[float]]) -> float:
    """A radius that holds all zeros and poles, by Fujiwara's bound, with some room."""
    reach = 2.0
    for *others, leading in polynomials:
        for k, a in enumerate(reversed(others), start=1):
            reach = max(reach, abs(a / leading) ** (1 / k))
    with_room = 1.6 * reach
    return float(f"{with_room:.1g}")


def _horner(coefficients: Sequence[float], z: complex) -> complex:
    value = 0j
    for a in reversed(coefficients):
        value = value * z + a
    return value
