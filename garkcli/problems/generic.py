"""Problems with random coefficients, made to see every tree of a structure."""

from __future__ import annotations

from flint import fmpq

from garkcli.problems.draw import Draw
from garkcli.problems.expr import Expr, Exprs, Vector, dot
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.righthandside import RightHandSide
from garkcli.problems.vectorfield import symbols

DEGREE = 8
"""The degree of the terms: fields have nonzero derivatives up to the seventh, for all trees of
order 8.
"""
VARIABLES = ("x", "y")
"""The positions."""
UNKNOWNS = ("x", "y", "z")
"""Those of right-hand sides."""
_FORMS = 3  # powers of linear forms in each term
# step and time; the solutions need not exist for longer
_LONG_RUN = (fmpq(1, 100), fmpq(1))


def generic(terms: int, seed: int) -> Hamiltonian:
    """H^{l} = Σ_k c_k (1 + a_k·(q, p))^8, with random rational c_k and a_k: every term has every
    derivative.

    The terms stay small, so that all solutions from the start exist to the final time.
    """
    draw = Draw(seed)
    y = (*_positions(), *_momenta())
    return _problem("generic", [polynomial(draw, y, terms) for _ in range(terms)], draw)


def semi_separable(terms: int, seed: int) -> Hamiltonian:
    """H^{1}(q, p) + Σ_l U^{l}(q), for methods that give forces to all terms but the first."""
    draw = Draw(seed)
    q, p = _positions(), _momenta()
    split = [polynomial(draw, (*q, *p), terms)]
    while len(split) < terms:
        split.append(polynomial(draw, q, terms))
    return _problem("generic-semi-separable", split, draw)


def separable(terms: int, seed: int) -> Hamiltonian:
    """T(p) + Σ_l U^{l}(q): velocities and forces alternate, and nothing else is missing."""
    draw = Draw(seed)
    return _separated("generic-separable", polynomial(draw, _momenta(), terms), terms, draw)


def nystrom(terms: int, seed: int) -> Hamiltonian:
    """½|p|² + Σ_l U^{l}(q): velocities are linear, so that they do not branch."""
    return _separated("generic-nystrom", sum(p**2 for p in _momenta()) / 2, terms, Draw(seed))


def generic_rhs(terms: int, seed: int, linear: frozenset[int] = frozenset()) -> RightHandSide:
    """f^{l} = Σ_k v_k (1 + a_k·y)^7, with random rational v_k and a_k: every component of every
    term has every derivative.

    Args:
        terms: how many.
        seed: of the coefficients.
        linear: the terms that are linear instead, Σ_k v_k (1 + a_k·y), for methods that take them
            to be.
    """
    draw = Draw(seed)
    y = symbols(UNKNOWNS, "y")
    split = [
        _right_hand_side(draw, y, terms, 1 if term in linear else DEGREE - 1)
        for term in range(terms)
    ]
    return RightHandSide(
        "generic-rhs",
        UNKNOWNS,
        tuple(split),
        _near_zero(draw, len(UNKNOWNS)),
        fmpq(1),
        is_generic=True,
        long_run=_LONG_RUN,
    )


def _right_hand_side(draw: Draw, y: Vector, terms: int, degree: int) -> Exprs:
    """Σ_k v_k (1 + a_k·y)^degree, as many expressions as there are unknowns."""
    import sympy

    total = [sympy.Integer(0) for _ in y]
    for _ in range(_FORMS):
        power = _form(draw, y) ** degree
        for i in range(len(y)):
            total[i] += sympy.Rational(draw.sign() * draw.between(5, 20), 100 * terms) * power
    return tuple(total)


def _form(draw: Draw, variables: Vector) -> Expr:
    """1 + a·y with random a."""
    import sympy

    slopes = [sympy.Rational(draw.sign() * draw.between(3, 12), 20) for _ in variables]
    return 1 + dot(slopes, variables)


def _separated(name: str, kinetic: Expr, terms: int, draw: Draw) -> Hamiltonian:
    """T + Σ U, in one term where there is no other."""
    q = _positions()
    if terms == 1:
        return _problem(name, [kinetic + polynomial(draw, q, terms)], draw)
    potentials = [polynomial(draw, q, terms) for _ in range(terms - 1)]
    return _problem(name, [kinetic, *potentials], draw)


def _problem(name: str, split: Vector, draw: Draw) -> Hamiltonian:
    return Hamiltonian(
        name, VARIABLES, tuple(split), start(draw), fmpq(1), is_generic=True, long_run=_LONG_RUN
    )


def _positions() -> Exprs:
    return symbols(VARIABLES, "q")


def _momenta() -> Exprs:
    return symbols(VARIABLES, "p")


def polynomial(draw: Draw, variables: Vector, terms: int) -> Expr:
    """Σ_k c_k (1 + a_k·y)^8 in the symbols y, one of ``terms`` terms of a Hamiltonian.

    Powers of linear forms span all polynomials; three of them a term are enough for no derivative
    to vanish, and are cheap to evaluate.
    """
    import sympy

    total = sympy.Integer(0)
    for _ in range(_FORMS):
        form = _form(draw, variables)
        total += sympy.Rational(draw.sign() * draw.between(5, 20), 1600 * terms) * form**DEGREE
    return total


def start(draw: Draw) -> tuple[fmpq, ...]:
    """q(0), then p(0), each at most 1/5 from zero."""
    return _near_zero(draw, 2 * len(VARIABLES))


def _near_zero(draw: Draw, count: int) -> tuple[fmpq, ...]:
    """Random numbers, each at most 1/5 from zero."""
    numerators = [draw.between(-10, 10) for _ in range(count)]
    return tuple(fmpq(n, 50) for n in numerators)
