"""The double pendulum: its Hamiltonian against the Euler–Lagrange equations, its splits, its
observed orders.
"""

from __future__ import annotations

from typing import Any

import mpmath
import pytest
import sympy
from flint import arb, ctx, fmpq

from garkcli.convergence.convergence import converge
from garkcli.errors import UsageProblem
from garkcli.families.registry import diagonal_method
from garkcli.methodfile.load import load
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.vectorfield import symbols
from garkcli.stepping.fields import fields_of, split_into
from garkcli.stepping.integrator import bind, integrate
from garkcli.tableau.forms import gark, pair
from tests.cli.harness import ROOT
from tests.stepping.test_step import RECTANGULAR, coupled
from tests.whole import in_whole

SEMI_SEPARABLE = str(ROOT / "methods" / "semi-separable.gark.yaml")


def euler_lagrange(t: Any, y: Any) -> list[Any]:  # noqa: ARG001 -- mpmath's signature
    """(α, β, α', β')˙ from the equations in any textbook, for masses, lengths and gravity 1."""
    a, b, u, w = y
    c, s = mpmath.cos(a - b), mpmath.sin(a - b)
    # 2α'' + cβ'' + sβ'² + 2 sin α = 0 and cα'' + β'' − sα'² + sin β = 0
    right = mpmath.matrix([-s * w**2 - 2 * mpmath.sin(a), s * u**2 - mpmath.sin(b)])
    determinant = 2 - c * c
    return [
        u,
        w,
        (right[0] - c * right[1]) / determinant,
        (2 * right[1] - c * right[0]) / determinant,
    ]


@in_whole
def test_it_is_the_solution_of_the_euler_lagrange_equations() -> None:
    """Taylor series of mpmath on second-order equations, and a Gauss method on H: one solution to
    18 digits.
    """
    problem = hamiltonian("double-pendulum", 2)
    with mpmath.workdps(25):
        a, b, p, r = (mpmath.mpf(int(x.p)) / int(x.q) for x in problem.initial)
        c = mpmath.cos(a - b)
        u, w = (p - c * r) / (2 - c * c), (2 * r - c * p) / (2 - c * c)
        end = mpmath.odefun(euler_lagrange, 0, [a, b, u, w], tol=mpmath.mpf(10) ** -22)(
            mpmath.mpf(1) / 2
        )
        c = mpmath.cos(end[0] - end[1])
        wanted = [end[0], end[1], 2 * end[2] + c * end[3], c * end[2] + end[3]]
        texts = [mpmath.nstr(x, 22) for x in wanted]
    gauss = gark([diagonal_method("gauss", 10)], {})
    found = integrate(bind(gauss, hamiltonian("double-pendulum", 1)).at(25), fmpq(1, 20), 10)
    with ctx.workprec(100):
        assert all(abs(x - arb(text)) < 1e-18 for x, text in zip(found, texts, strict=True))


@pytest.mark.parametrize("terms", [1, 2, 3, 4, 5])
def test_splits_are_of_one_problem(terms: int) -> None:
    """All of it in one term; T and V; V by masses; V in equal shares."""
    problem = hamiltonian("double-pendulum", terms)
    whole = hamiltonian("double-pendulum", 1)
    assert len(problem.terms) == terms
    assert sympy.expand(problem.energy - whole.energy) == 0
    assert len(set(problem.terms)) == min(terms, 3 if terms == 3 else 2)
    momenta = set(symbols(problem.variables, "p"))
    assert all(not V.free_symbols & momenta for V in problem.terms[1:])
    # at rest the energy is zero
    rest = dict.fromkeys((*symbols(problem.variables, "q"), *momenta), 0)
    assert all(x.xreplace(rest) == 0 for x in problem.terms)


def test_its_kinetic_energy_depends_on_the_positions() -> None:
    """A semi-separable method takes it; a separable one says that it cannot."""
    problem = hamiltonian("double-pendulum", 2)
    assert fields_of(load(SEMI_SEPARABLE).tableau, problem)
    with pytest.raises(UsageProblem, match="depends on q"):
        fields_of(RECTANGULAR, problem)


@in_whole
def test_observed_orders() -> None:
    """Four by the semi-separable method of the paper, and by a general pair."""
    for tableau in (load(SEMI_SEPARABLE).tableau, pair(coupled(2, 3))):
        steps = [fmpq(1, 2**k) for k in (4, 5, 6)]
        result = converge(tableau, hamiltonian("double-pendulum", 2), steps=steps)
        assert result.agrees
        assert result.observed_order == pytest.approx(4, abs=0.05)


def test_natural_splits() -> None:
    """One term into summands with momenta and shares of the others; the same for more; no other
    splits.
    """
    whole = hamiltonian("double-pendulum", 1)
    assert split_into(whole, 2).terms == hamiltonian("double-pendulum", 2).terms
    assert split_into(whole, 4).terms == hamiltonian("double-pendulum", 4).terms
    assert split_into(whole, 1) is whole
    assert split_into(hamiltonian("kepler", 2), 1).terms == hamiltonian("kepler", 1).terms
    with pytest.raises(UsageProblem, match="has 2 terms, the method is for 3"):
        split_into(hamiltonian("kepler", 2), 3)
    with pytest.raises(UsageProblem, match="has 1 term, the method is for 2"):
        split_into(hamiltonian("generic", 1), 2)
