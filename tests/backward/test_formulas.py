"""Modified Hamiltonians as formulas, against the Baker–Campbell–Hausdorff formula, exactly."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from flint import Ordering, fmpq, fmpq_mpoly, fmpq_mpoly_ctx

from garkcli import hamiltonian, load, loads
from garkcli.backward import formulas
from garkcli.backward.formulas import in_sympy, modified_formula
from garkcli.errors import UsageProblem
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.vectorfield import symbols
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau
from tests.oracles import bch
from tests.whole import in_whole

RING = fmpq_mpoly_ctx.get(["x", "p", "s", "c"], Ordering.lex)
X, P, S, C = RING.gens()
VERLET = [(fmpq(1, 2), "U"), (fmpq(1), "T"), (fmpq(1, 2), "U")]
"""Kick, drift, kick."""


def _reduced(f: fmpq_mpoly) -> fmpq_mpoly:
    """With s² = 1 − c²."""
    result = RING.constant(0)
    for (i, j, k, l), a in f.to_dict().items():
        pythagoras = (1 - C**2) ** (k // 2)
        result += a * X**i * P**j * S ** (k % 2) * C**l * pythagoras
    return result


def _by_position(f: fmpq_mpoly) -> fmpq_mpoly:
    """∂f/∂x with s = sin x, c = cos x."""
    return f.derivative(0) + f.derivative(2) * C - f.derivative(3) * S


def _bracket(f: fmpq_mpoly, g: fmpq_mpoly) -> fmpq_mpoly:
    """The Hamiltonian of the commutator of two derivations: {g, f} = g_x f_p − g_p f_x, since the
    derivation of f is {·, f}.
    """
    first = _by_position(g) * f.derivative(1)
    return _reduced(first - g.derivative(1) * _by_position(f))


def _in_ring(formula: Any, problem: Hamiltonian) -> fmpq_mpoly:
    """A formula of sympy in x, p, sin x, cos x."""
    (x,), (p,) = (symbols(problem.variables, "q"), symbols(problem.variables, "p"))
    s, c = sympy.symbols("s c")
    written = sympy.sympify(formula).subs({sympy.sin(x): s, sympy.cos(x): c})
    polynomial = sympy.Poly(written, x, p, s, c)
    result = RING.constant(0)
    for (i, j, k, l), a in polynomial.terms():
        result += fmpq(int(a.p), int(a.q)) * X**i * P**j * S**k * C**l
    return _reduced(result)


def _check(
    tableau: Tableau,
    problem: Hamiltonian,
    flows: list[tuple[fmpq, str]],
    letters: dict[str, fmpq_mpoly],
    order: int,
) -> list[int]:
    """Compare all powers of h; those that are not zero."""
    known = bch.in_brackets(bch.logarithm(flows, order), letters, _bracket, RING.constant(0))
    found = modified_formula(tableau, problem, order).expanded()
    assert found.of == "hamiltonian"
    by_power = {x.power: x.formulas[0] for x in found.terms}
    for power, expected in enumerate(known):
        assert _in_ring(by_power.get(power, 0), problem) == _reduced(expected)
    return sorted(by_power)


def test_stoermer_verlet_on_the_pendulum() -> None:
    """Up to h⁶, three terms beyond H, all equal to those of the composition of the flows of p²/2 and
    1 − cos x.
    """
    verlet = load("methods/stoermer-verlet.gark.yaml").tableau
    problem = hamiltonian("pendulum", 2)
    letters = {"T": P**2 / 2, "U": 1 - C}
    assert _check(verlet, problem, VERLET, letters, 7) == [0, 2, 4, 6]


def test_the_known_formula() -> None:
    """H + h² (p² cos x/12 − sin² x/24) + O(h⁴), from the literature."""
    verlet = load("methods/stoermer-verlet.gark.yaml").tableau
    problem = hamiltonian("pendulum", 2)
    _, second = modified_formula(verlet, problem, 3).expanded().terms
    (x,), (p,) = symbols(("x",), "q"), symbols(("x",), "p")
    known = p**2 * sympy.cos(x) / 12 - sympy.sin(x) ** 2 / 24
    assert second.power == 2
    assert second.formulas == (sympy.expand(known),)


def test_symplectic_euler_has_all_powers() -> None:
    """A method that is not symmetric, on a quartic oscillator: also the odd powers, with the sign
    of the order in which the flows are composed.
    """
    euler = "{prk: {q: {A: [[0]], b: [1]}, p: {A: [[1]], b: [1]}}, structure: separable}"
    (x,), (p,) = symbols(("x",), "q"), symbols(("x",), "p")
    problem = Hamiltonian("quartic", ("x",), (p**2 / 2, x**4 / 4), (fmpq(1), fmpq(0)), fmpq(1))
    letters = {"T": P**2 / 2, "U": X**4 / 4}
    tableau = loads(euler).tableau
    # the force at the old position comes first; as operators on functions flows compose in this
    # order too
    flows = [(fmpq(1), "U"), (fmpq(1), "T")]
    found = _check(tableau, problem, flows, letters, 5)
    assert found == [0, 1, 2, 3, 4]


def _yoshida() -> list[tuple[fmpq, str]]:
    """Three Störmer–Verlet steps with rational lengths, kicks put together."""
    lengths = [fmpq(3, 2), fmpq(-2), fmpq(3, 2)]
    flows: list[tuple[fmpq, str]] = [(lengths[0] / 2, "U")]
    for here, after in zip(lengths, [*lengths[1:], fmpq(0)], strict=True):
        flows += [(here, "T"), ((here + after) / 2, "U")]
    return flows


def test_a_composition() -> None:
    """Three steps of different lengths as one tableau, on the pendulum."""
    flows = _yoshida()
    kicks = [c for c, letter in flows if letter == "U"]
    drifts = [c for c, letter in flows if letter == "T"]
    A_q = [[c if j < i else 0 for j, c in enumerate(drifts)] for i in range(len(kicks))]
    A_p = [[c if j <= i else 0 for j, c in enumerate(kicks)] for i in range(len(drifts))]
    text = f"""
prk:
  q: {{A: {A_q}, b: {drifts}}}
  p: {{A: {A_p}, b: {kicks}}}
structure: separable
"""
    tableau = loads(text).tableau
    letters = {"T": P**2 / 2, "U": 1 - C}
    found = _check(tableau, hamiltonian("pendulum", 2), flows, letters, 5)
    assert found == [0, 2, 4]


def test_unsplit_problems_and_methods_of_one_vector_field() -> None:
    """The implicit midpoint rule as a pair and as a method of one vector field has one modified
    Hamiltonian: known as H − h²/24 H''(J⁻¹∇H, J⁻¹∇H).
    """
    text = "methods: [{family: gauss, stages: 1}]"
    midpoint = loads(text).tableau
    problem = hamiltonian("pendulum", 1)
    one = modified_formula(midpoint, problem, 5).expanded()
    other = modified_formula(pair(midpoint), problem, 5).expanded()
    assert one.terms == other.terms
    (x,), (p,) = symbols(("x",), "q"), symbols(("x",), "p")
    known = -(sympy.sin(x) ** 2 + sympy.cos(x) * p**2) / 24
    assert one.terms[1].formulas == (sympy.expand(known),)


def test_coefficients_in_a_number_field() -> None:
    """Radicals come into the formula as they are."""
    tableau = load("methods/rectangular.gark.yaml").tableau
    irrational = next(x for row in tableau.blocks[0, 1] for x in row if not hasattr(x, "p"))
    value = in_sympy(irrational)
    assert value.has(sympy.sqrt(3))
    assert float(value) == pytest.approx(float(sympy.N(value)))
    assert str(value) == str(sympy.sympify(value))


def test_coefficients_without_radicals() -> None:
    """A root of a polynomial that has none is refused in a formula."""
    gamma = "root_of(6*x^3 - 18*x^2 + 9*x - 1, 0.4358665)"
    text = f'{{parameters: {{g: "{gamma}"}}, A: [[g, 0], [1 - g, g]], b: [1 - g, g]}}'
    with pytest.raises(UsageProblem, match="written in radicals"):
        modified_formula(loads(text).tableau, hamiltonian("pendulum", 1), 3)


def test_a_method_that_is_not_symplectic_has_an_equation() -> None:
    """The explicit Euler method: ẏ = f − h/2 f'f + …, on the pendulum."""
    found = modified_formula(
        loads("{A: [[0]], b: [1]}").tableau, hamiltonian("pendulum", 1), 2
    ).expanded()
    (x,), (p,) = symbols(("x",), "q"), symbols(("x",), "p")
    assert found.of == "equation"
    assert [term.power for term in found.terms] == [0, 1]
    assert found.terms[0].formulas == (p, -sympy.sin(x))
    assert found.terms[1].formulas == (sympy.sin(x) / 2, p * sympy.cos(x) / 2)


@in_whole
def test_long_formulas_are_refused() -> None:
    """Both the operations and the summands are bounded, and the raw formula is there still."""
    verlet = load("methods/stoermer-verlet.gark.yaml").tableau
    raw = modified_formula(verlet, hamiltonian("generic-separable", 2), 5)
    assert [x.power for x in raw.terms] == [0, 2, 4]
    with pytest.raises(UsageProblem, match="too many summands") as caught:
        raw.expanded()
    assert "--order 2" in caught.value.help


def test_the_limit_of_operations(monkeypatch: pytest.MonkeyPatch) -> None:
    """A formula that is longer is named with its power of h."""
    monkeypatch.setattr(formulas, "MAX_OPERATIONS", 10)
    verlet = load("methods/stoermer-verlet.gark.yaml").tableau
    with pytest.raises(UsageProblem, match=r"h\^4 has \d+ operations"):
        modified_formula(verlet, hamiltonian("pendulum", 2), 5).expanded()
