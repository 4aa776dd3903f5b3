"""Problems with random coefficients, made to see every tree of a structure."""

from __future__ import annotations

from collections.abc import Callable

from flint import fmpq

from garkcli.frozen import Frozen
from garkcli.problems.deferred import Deferred
from garkcli.problems.draw import Draw
from garkcli.problems.expr import Expr, Exprs, Vector, dot, rational
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.mechanical import half_square
from garkcli.problems.righthandside import RightHandSide
from garkcli.problems.vectorfield import symbols

DEGREE = 8
"""The degree of the terms, enough for all trees of order 8."""
VARIABLES = ("x", "y")
UNKNOWNS = ("x", "y", "z")
_FORMS = 3  # powers of linear forms in each term
# step and time; the solutions need not exist for longer
_LONG_RUN = (fmpq(1, 100), fmpq(1))


def generic(terms: int, seed: int) -> Hamiltonian:
    """H^{l} = Σ_k c_k (1 + a_k·(q, p))^8, with every derivative; small, so that solutions exist."""
    draw = Draw(seed)
    split = [_polynomial(draw, "qp", terms) for _ in range(terms)]
    return _problem("generic", seed, split, draw)


def semi_separable(terms: int, seed: int) -> Hamiltonian:
    """H^{1}(q, p) + Σ_l U^{l}(q), for methods that give forces to all terms except the first."""
    draw = Draw(seed)
    split = [_polynomial(draw, "qp", terms)]
    while len(split) < terms:
        split.append(_polynomial(draw, "q", terms))
    return _problem("generic-semi-separable", seed, split, draw)


def separable(terms: int, seed: int) -> Hamiltonian:
    """T(p) + Σ_l U^{l}(q): sees all trees in which velocities and forces alternate."""
    draw = Draw(seed)
    kinetic = _polynomial(draw, "p", terms)
    return _separated("generic-separable", seed, kinetic, terms, draw)


def nystrom(terms: int, seed: int) -> Hamiltonian:
    """½|p|² + Σ_l U^{l}(q): velocities are linear, so they do not branch."""
    return _separated("generic-nystrom", seed, half_square, terms, Draw(seed))


def generic_rhs(terms: int, seed: int, linear: frozenset[int] = frozenset()) -> RightHandSide:
    """f^{l} = Σ_k v_k (1 + a_k·y)^7, with random rational v_k and a_k: every component of every
    term has every derivative. The terms in ``linear`` are Σ_k v_k (1 + a_k·y).
    """
    draw = Draw(seed)
    split = [_forms(draw, len(UNKNOWNS), len(UNKNOWNS), 100 * terms) for _ in range(terms)]
    name = f"generic-rhs seed={seed} terms={terms}"
    if linear:
        name += f" linear={','.join(str(term + 1) for term in sorted(linear))}"

    def make() -> list[Exprs]:
        y = symbols(UNKNOWNS, "y")
        degrees = [1 if term in linear else DEGREE - 1 for term in range(terms)]
        return [_sums(forms, y, n) for forms, n in zip(split, degrees, strict=True)]

    return RightHandSide(
        "generic-rhs",
        UNKNOWNS,
        Deferred(name, make, terms),
        _near_zero(draw, len(UNKNOWNS)),
        fmpq(1),
        is_generic=True,
        long_run=_LONG_RUN,
    )


class _Form(Frozen):
    """1 + a·y, and the factors of its power in several sums."""

    slopes: tuple[fmpq, ...]
    factors: tuple[fmpq, ...]

    def power(self, y: Vector, degree: int) -> Expr:
        return (1 + dot([rational(a) for a in self.slopes], y)) ** degree


def _forms(draw: Draw, variables: int, sums: int, divisor: int) -> list[_Form]:
    forms = []
    for _ in range(_FORMS):
        slopes = [fmpq(draw.sign() * draw.between(3, 12), 20) for _ in range(variables)]
        factors = [fmpq(draw.sign() * draw.between(5, 20), divisor) for _ in range(sums)]
        forms.append(_Form(tuple(slopes), tuple(factors)))
    return forms


def _sums(forms: list[_Form], y: Vector, degree: int) -> Exprs:
    """Σ_k v_k (1 + a_k·y)^degree, one expression for each factor."""
    powers = [form.power(y, degree) for form in forms]
    rows = zip(*(form.factors for form in forms), strict=True)
    return tuple(dot([rational(v) for v in row], powers) for row in rows)


_Term = Callable[[Exprs, Exprs], Expr]  # of positions and momenta


def _polynomial(draw: Draw, groups: str, terms: int) -> _Term:
    """Σ_k c_k (1 + a_k·y)^8: powers span all polynomials; with three no derivative vanishes."""
    forms = _forms(draw, len(groups) * len(VARIABLES), 1, 1600 * terms)

    def make(q: Exprs, p: Exprs) -> Expr:
        y = (*(q if "q" in groups else ()), *(p if "p" in groups else ()))
        return _sums(forms, y, DEGREE)[0]

    return make


def _separated(name: str, seed: int, kinetic: _Term, terms: int, draw: Draw) -> Hamiltonian:
    if terms == 1:
        U = _polynomial(draw, "q", terms)
        return _problem(name, seed, [lambda q, p: kinetic(q, p) + U(q, p)], draw)
    potentials = [_polynomial(draw, "q", terms) for _ in range(terms - 1)]
    return _problem(name, seed, [kinetic, *potentials], draw)


def _problem(name: str, seed: int, split: list[_Term], draw: Draw) -> Hamiltonian:
    def make() -> list[Expr]:
        q, p = symbols(VARIABLES, "q"), symbols(VARIABLES, "p")
        return [term(q, p) for term in split]

    terms = Deferred(f"{name} seed={seed} terms={len(split)}", make, len(split))
    return Hamiltonian(
        name, VARIABLES, terms, start(draw), fmpq(1), is_generic=True, long_run=_LONG_RUN
    )


def start(draw: Draw) -> tuple[fmpq, ...]:
    return _near_zero(draw, 2 * len(VARIABLES))


def _near_zero(draw: Draw, count: int) -> tuple[fmpq, ...]:
    numerators = [draw.between(-10, 10) for _ in range(count)]
    return tuple(fmpq(n, 50) for n in numerators)
