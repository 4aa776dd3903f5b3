"""Problems with random coefficients, made to see every tree of a structure."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import fmpq

from garkcli.problems.draw import Draw
from garkcli.problems.hamiltonian import Hamiltonian, symbols

DEGREE = 8
"""The degree of the terms: fields have nonzero derivatives up to the seventh, for all trees of
order 8.
"""
VARIABLES = ("x", "y")
"""The positions."""
_FORMS = 3  # powers of linear forms in each term


def generic(terms: int, seed: int) -> Hamiltonian:
    """H^{l} = Σ_k c_k (1 + a_k·(q, p))^8, with random rational c_k and a_k: every term has every
    derivative.

    The terms stay small, so that all solutions from the start exist to the final time.
    """
    draw = Draw(seed)
    y = (*_positions(), *_momenta())
    split = [polynomial(draw, y, terms) for _ in range(terms)]
    return _problem("generic", split, draw)


def semi_separable(terms: int, seed: int) -> Hamiltonian:
    """H^{1}(q, p) + Σ_l U^{l}(q), for methods that give forces to all terms but the first."""
    draw = Draw(seed)
    split = [polynomial(draw, (*_positions(), *_momenta()), terms)]
    split += [polynomial(draw, _positions(), terms) for _ in range(terms - 1)]
    return _problem("generic-semi-separable", split, draw)


def separable(terms: int, seed: int) -> Hamiltonian:
    """T(p) + Σ_l U^{l}(q): velocities and forces alternate, and nothing else is missing."""
    draw = Draw(seed)
    return _separated(
        "generic-separable", polynomial(draw, _momenta(), terms), terms, draw
    )


def nystrom(terms: int, seed: int) -> Hamiltonian:
    """½|p|² + Σ_l U^{l}(q): velocities are linear, so that they do not branch."""
    kinetic = sum(p**2 for p in _momenta()) / 2
    return _separated("generic-nystrom", kinetic, terms, Draw(seed))


def _separated(name: str, kinetic: Any, terms: int, draw: Draw) -> Hamiltonian:
    if terms == 1:
        return _problem(name, [kinetic + polynomial(draw, _positions(), terms)], draw)
    potentials = [polynomial(draw, _positions(), terms) for _ in range(terms - 1)]
    return _problem(name, [kinetic, *potentials], draw)


def _problem(name: str, split: Sequence[Any], draw: Draw) -> Hamiltonian:
    return Hamiltonian(
        name,
        VARIABLES,
        tuple(split),
        start(draw),
        fmpq(1),
        is_generic=True,
        long_run=(fmpq(1, 100), fmpq(1)),  # the solutions need not exist for longer
    )


def _positions() -> tuple[Any, ...]:
    return symbols(VARIABLES, "q")


def _momenta() -> tuple[Any, ...]:
    return symbols(VARIABLES, "p")


def polynomial(draw: Draw, variables: Sequence[Any], terms: int) -> Any:
    """Σ_k c_k (1 + a_k·y)^8 in the symbols y, one of ``terms`` terms of a Hamiltonian.

    Powers of linear forms span all polynomials; three of them a term are enough for no derivative
    to vanish, and are cheap to evaluate.
    """
    import sympy

    total = sympy.Integer(0)
    for _ in range(_FORMS):
        slopes = []
        for _variable in variables:
            numerator = draw.sign() * draw.between(3, 12)
            slopes.append(sympy.Rational(numerator, 20))
        form = 1 + sum(a * x for a, x in zip(slopes, variables, strict=True))
        numerator = draw.sign() * draw.between(5, 20)
        factor = sympy.Rational(numerator, 1600 * terms)
        total += factor * form**DEGREE
    return total


def start(draw: Draw) -> tuple[fmpq, ...]:
    """q(0), then p(0), each at most 1/5 from zero."""
    count = 2 * len(VARIABLES)
    return tuple(fmpq(draw.between(-10, 10), 50) for _ in range(count))
