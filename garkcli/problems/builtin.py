"""The built-in problems; an entry and a test add one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

from flint import fmpq

from garkcli.errors import UsageProblem, did_you_mean
from garkcli.frozen import Frozen
from garkcli.problems import equations
from garkcli.problems import mechanical as systems
from garkcli.problems.generic import generic, generic_rhs, nystrom, semi_separable, separable
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.problem import Problem
from garkcli.problems.righthandside import RightHandSide

Maker: TypeAlias = Callable[[int, int], Problem]
StiffMaker: TypeAlias = Callable[[int, fmpq], RightHandSide]


class BuiltIn(Frozen):
    """A built-in problem; ``formula`` and ``sees`` (its trees) are for people. ``make`` takes the
    terms and a seed, ``stiff`` the terms and a stiffness.
    """

    name: str
    summary: str
    formula: str
    sees: str
    make: Maker
    takes_seed: bool = False
    stiff: StiffMaker | None = None


def mechanical(
    name: str, summary: str, formula: str, sees: str, made: systems.Mechanical
) -> BuiltIn:
    def make(terms: int, _: int) -> Hamiltonian:
        return made.problem(name, terms)

    return BuiltIn(name, summary, formula, sees, make)


def stiff_one(name: str, summary: str, formula: str, sees: str, made: StiffMaker) -> BuiltIn:
    def make(terms: int, _: int) -> RightHandSide:
        return made(terms, fmpq(1))

    return BuiltIn(name, summary, formula, sees, make, stiff=made)


def problem(name: str, terms: int, seed: int = 1, stiffness: fmpq | None = None) -> Problem:
    """Returns a problem split into ``terms``; UsageProblem if unknown or without stiffness."""
    entry = built_in(name)
    if stiffness is None:
        return entry.make(terms, seed)
    check_stiffness(name)
    assert entry.stiff is not None
    return entry.stiff(terms, stiffness)


def check_stiffness(name: str) -> None:
    """Raises UsageProblem for a built-in problem without a stiffness."""
    if built_in(name).stiff is None:
        takers = ", ".join(x.name for x in PROBLEMS.values() if x.stiff is not None)
        message = f"--stiffness is for the problems {takers}, not for {name}"
        raise UsageProblem(message, "leave it out, or choose one of these", code="other-problem")


def hamiltonian(name: str, terms: int, seed: int = 1) -> Hamiltonian:
    """Returns a Hamiltonian problem in ``terms``; UsageProblem if unknown or not Hamiltonian."""
    made = built_in(name).make(terms, seed)
    if not isinstance(made, Hamiltonian):
        message = f"{name} is not Hamiltonian"
        raise UsageProblem(message, "its maker is problem(...)", code="other-problem")
    return made


def built_in(name: str) -> BuiltIn:
    if name not in PROBLEMS:
        message = f"no problem {name!r}"
        raise UsageProblem(message, did_you_mean(name, tuple(PROBLEMS)), code="unknown-word")
    return PROBLEMS[name]


def is_path(text: str) -> bool:
    """Whether a text is the path of a problem file, not the name of a built-in problem."""
    return text == "-" or text.endswith((".yaml", ".yml")) or "/" in text or "\\" in text


def check_seed(name: str, seed: int | None) -> None:
    """Raises UsageProblem if a seed is given that would change nothing."""
    takers = [x.name for x in PROBLEMS.values() if x.takes_seed]
    if seed is not None and name not in takers:
        plural = "s" if len(takers) > 1 else ""
        whose = f"problem{plural} {', '.join(takers)}"
        message = f"--seed is for the {whose}, not for {name}"
        raise UsageProblem(message, "leave it out", code="other-problem")


_ALTERNATING = "alternating trees in which velocities do not branch"
_TENTHS = (fmpq(1, 10), fmpq(1000))  # a step size and a time

_ENTRIES = (
    stiff_one(
        "dahlquist",
        "ẏ = λy, λ = −1 or minus the stiffness; the solution is known",
        "ẏ = λ y, −λ the stiffness",
        "the unbranched trees",
        equations.dahlquist,
    ),
    BuiltIn(
        "logistic",
        "ẏ = y (1 − y): growth and its limit; the solution is known",
        "ẏ = y − y²: y and the rest",
        "all, up to degree 2 at a vertex of the rest, 1 at the first",
        equations.logistic,
    ),
    BuiltIn(
        "lotka-volterra",
        "predator and prey; with an invariant",
        "u̇ = u (1 − v), v̇ = v (u − 1): u̇ and the rest",
        "all, up to degree 2",
        equations.lotka_volterra,
    ),
    BuiltIn(
        "damped-pendulum",
        "q″ = −sin q − q′ (1 + q′²)/4, for Nyström methods with y′",
        "q̇ = v, v̇ = −sin q − v (1 + v²)/4",
        "those of q″ = g(q, q′), up to degree 3 in q′",
        equations.damped_pendulum,
    ),
    mechanical(
        "oscillator",
        "½p² and parts of ½ω²q²; sees the unbranched trees only",
        "½p² + ½ω²q², the step map taken exactly",
        "the unbranched trees",
        systems.Mechanical(("q",), systems.spring, systems.numbers("1 1/2"), fmpq(4)),
    ),
    mechanical(
        "split-oscillator",
        "two springs of frequencies 1 and 5/2; sees the unbranched trees only",
        "½|p|² + ½x² + ½(5/2)²(y − x)²",
        "the unbranched trees",
        systems.Mechanical(
            ("x", "y"), systems.two_springs, systems.numbers("1 1/2 0 1"), fmpq(2), long_run=_TENTHS
        ),
    ),
    mechanical(
        "pendulum",
        "½p² + 1 − cos q",
        "½p² + 1 − cos q",
        _ALTERNATING,
        systems.Mechanical(
            ("x",), systems.pendulum_potential, systems.numbers("1 1/2"), fmpq(4), long_run=_TENTHS
        ),
    ),
    mechanical(
        "kepler",
        "½|p|² − 1/|q|, eccentricity 3/5; with angular momentum",
        "½|p|² − 1/|q|, eccentricity 3/5, with angular momentum",
        _ALTERNATING,
        systems.Mechanical(
            ("x", "y"),
            systems.kepler_potential,
            # at the pericentre, with eccentricity 3/5 and period 2π
            systems.numbers("2/5 0 0 2"),
            fmpq(2),
            invariants=(("angular momentum", systems.angular_momentum),),
            long_run=(fmpq(1, 50), fmpq(1000)),
        ),
    ),
    mechanical(
        "henon-heiles",
        "½|p|² + ½|q|² + x²y − y³/3",
        "½|p|² + ½|q|² + x²y − y³/3",
        _ALTERNATING,
        systems.Mechanical(
            ("x", "y"),
            systems.henon_heiles_potential,
            systems.numbers("0 3/10 2/5 1/10"),
            fmpq(4),
            long_run=_TENTHS,
        ),
    ),
    mechanical(
        "fput",
        "three masses between walls, on springs with quadratic and cubic forces",
        "three masses between walls, α = 1/4, β = 1/2",
        _ALTERNATING,
        systems.Mechanical(
            ("x", "y", "z"),
            systems.springs,
            systems.numbers("1 1/2 -1/4 0 1/2 0"),
            fmpq(2),
            long_run=_TENTHS,
        ),
    ),
    mechanical(
        "double-pendulum",
        "two rods; the kinetic energy depends on the angles",
        "two rods, by the Legendre transform of their Lagrangian",
        "all; parts that depend on positions alone have only velocities as branches",
        systems.Mechanical(
            ("a", "b"),
            systems.rods_potential,
            systems.numbers("1 -1/2 1 1/2"),
            fmpq(2),
            kinetic=systems.rods,
        ),
    ),
    stiff_one(
        "prothero-robinson",
        "stiff about a solution that is known; not Hamiltonian",
        "ẏ = φ'(t) − λ (y − φ(t)), φ = cos t, λ the stiffness: φ' and the rest",
        "those that branch into time alone",
        equations.prothero_robinson,
    ),
    stiff_one(
        "van-der-pol",
        "the oscillator near the smooth solution; two parts, one stiff; not Hamiltonian",
        "ẏ = z, ż = σ ((1 − y²) z − y), σ the stiffness: z and the rest",
        "all, up to degree 3 at a vertex of the stiff part",
        equations.van_der_pol,
    ),
    stiff_one(
        "robertson",
        "three chemical reactions, one slow and two fast; mass is conserved",
        "ȧ = −a/25 + 10⁴σbc, ċ = 3·10⁷σb², a + b + c constant, σ the stiffness: slow and fast",
        "all, up to degree 2 at a fast reaction, 1 at the slow one",
        equations.robertson,
    ),
    stiff_one(
        "reaction-diffusion",
        "eight cells in a line; reaction and diffusion; not Hamiltonian",
        "u̇ᵢ = rᵢ uᵢ (1 − uᵢ) + k (uᵢ₋₁ − 2uᵢ + uᵢ₊₁), k the stiffness: reaction and diffusion",
        "all, up to degree 2 at a reaction, 1 at a diffusion",
        equations.reaction_diffusion,
    ),
    BuiltIn(
        "generic",
        "a random polynomial in N terms, none separable; sees every tree",
        "Σ c (1 + a·(q, p))⁸, three powers a term, random rational c, a",
        "all, up to degree 7",
        generic,
        takes_seed=True,
    ),
    BuiltIn(
        "generic-semi-separable",
        "like generic, all terms but the first of positions",
        "H¹(q, p) + Σ U(q), powers as in `generic`",
        "all of a semi-separable structure, up to degree 7",
        semi_separable,
        takes_seed=True,
    ),
    BuiltIn(
        "generic-separable",
        "like generic, as T(p) + Σ U(q); sees every tree of this form",
        "T(p) + Σ U(q), powers as in `generic`",
        "all alternating trees, up to degree 7",
        separable,
        takes_seed=True,
    ),
    BuiltIn(
        "generic-nystrom",
        "like generic, as ½|p|² + Σ U(q); sees every tree of this form",
        "½|p|² + Σ U(q), powers as in `generic`",
        "alternating trees in which velocities do not branch, forces at most 7 times",
        nystrom,
        takes_seed=True,
    ),
    BuiltIn(
        "generic-rhs",
        "random right-hand sides, one per colour; sees every tree",
        "ẏ = Σ v (1 + a·y)⁷ in three unknowns, three powers a term, random rational v, a",
        "all, up to degree 7",
        generic_rhs,
        takes_seed=True,
    ),
)
PROBLEMS: Mapping[str, BuiltIn] = {entry.name: entry for entry in _ENTRIES}
GENERIC = ("generic", "generic-semi-separable", "generic-separable", "generic-nystrom")
GENERIC_RHS = "generic-rhs"
