"""Problems that are not Hamiltonian: their splits, their solutions, and what the random ones see."""

from __future__ import annotations

from typing import Any

import pytest
import sympy
from flint import arb, fmpq, fmpq_mat

from garkcli import converge, find_order, loads
from garkcli.convergence.convergence import in_common, seeing_problem
from garkcli.errors import UsageProblem
from garkcli.problems.builtin import PROBLEMS, problem
from garkcli.problems.equations import reaction_diffusion, shared
from garkcli.problems.files.load import load_problem
from garkcli.problems.generic import generic_rhs
from garkcli.problems.righthandside import RightHandSide, solution, steepness
from garkcli.problems.vectorfield import symbols
from tests.whole import in_whole


def rhs(name: str, terms: int, stiffness: int = 1) -> RightHandSide:
    """A built-in problem."""
    made = problem(name, terms, stiffness=fmpq(stiffness))
    assert isinstance(made, RightHandSide)
    return made


def test_the_solution_of_prothero_and_robinson() -> None:
    """φ solves it for any λ, and starts where the problem does."""
    made = rhs("prothero-robinson", 2, 1000)
    assert made.exact is not None
    ((y,), (t,)) = (symbols(made.variables, group) for group in ("y", "t"))
    (phi,) = made.exact
    assert sympy.simplify(made.total[0].subs(y, phi) - phi.diff(t)) == 0
    assert phi.subs(t, 0) == made.initial[0] == 1
    assert float(solution(made, arb(1) / 2)[0]) == pytest.approx(0.8775825618903728)


@pytest.mark.parametrize("name", ["prothero-robinson", "van-der-pol"])
def test_files_are_the_built_in_problems(name: str) -> None:
    """problems/*.yaml with a stiffness, and the built-in problem with the same."""
    own = load_problem(f"problems/{name}.yaml", fmpq(10**6))
    built_in = rhs(name, 2, 10**6)
    assert isinstance(own, RightHandSide)
    for a, b in zip(own.terms, built_in.terms, strict=True):
        assert [sympy.expand(x - y) for x, y in zip(a, b, strict=True)] == [0] * len(a)
    assert own.initial == built_in.initial
    assert own.exact == built_in.exact
    assert own.stiffness == built_in.stiffness == 10**6
    assert own.t_end == built_in.t_end


def test_the_start_of_van_der_pol_is_smooth() -> None:
    """On z(y) = Σ ε^k z_k the equation ε z' z = (1 − y²) z − y holds to ε³, by its recursion."""
    v = sympy.Symbol("v")
    z = [v / (1 - v**2)]
    for k in range(3):
        total = sum(z[i].diff(v) * z[k - i] for i in range(k + 1))
        z.append(sympy.together(total / (1 - v**2)))
    start = sum(x.subs(v, 2) * sympy.Rational(1, 1000) ** k for k, x in enumerate(z))
    y, found = rhs("van-der-pol", 1, 1000).initial
    assert y == 2
    assert sympy.Rational(int(found.p), int(found.q)) == start


def test_the_line_of_cells() -> None:
    """Diffusion keeps the total, and the start balances the reaction but for its mean."""
    made = reaction_diffusion(2, fmpq(1000))
    reaction, diffusion = made.terms
    assert sympy.expand(sum(diffusion)) == 0
    u = symbols(made.variables, "y")
    at = {x: sympy.Rational(1, 4) for x in u}
    start = {x: sympy.Rational(int(y.p), int(y.q)) for x, y in zip(u, made.initial, strict=True)}
    growth = [x.subs(at) for x in reaction]
    mean = sum(growth) / len(growth)
    for grows, flows in zip(growth, diffusion, strict=True):
        assert flows.subs(start) == mean - grows


def test_shares() -> None:
    """Parts go to terms in order; the last one is shared out or has the rest."""
    a, b, c = sympy.symbols("a b c")
    parts = [(a,), (b,), (c,)]
    assert shared("parts", lambda: parts, 1) == ((a + b + c,),)
    assert shared("parts", lambda: parts, 2) == ((a,), (b + c,))
    assert shared("parts", lambda: parts, 3) == tuple(parts)
    assert shared("parts", lambda: parts, 4) == ((a,), (b,), (c / 2,), (c / 2,))


def test_steepness() -> None:
    """λ of Prothero and Robinson; 4 k and a bit for a line with diffusion k."""
    assert float(steepness(rhs("prothero-robinson", 2, 1000))) == 1000
    assert float(steepness(rhs("reaction-diffusion", 2, 1000))) == pytest.approx(4000, rel=1e-2)


def test_stiffness_is_for_those_that_have_one() -> None:
    """Others refuse it, and say which have one."""
    for entry in PROBLEMS.values():
        if entry.stiff is not None:
            assert rhs(entry.name, 2, 7).stiffness == 7
        else:
            with pytest.raises(UsageProblem, match="for the problems dahlquist"):
                problem(entry.name, 2, stiffness=fmpq(7))


# three stages, of order 3 but for one tree
_TALL = "{A: [[0, 0, 0], [1/2, 0, 0], [0, 1, 0]], b: [1/6, 2/3, 1/6]}"
_BUSHY = "{A: [[0, 0, 0], [1/2, 0, 0], [-1/3, 4/3, 0]], b: [1/4, 1/2, 1/4]}"


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("text", [_TALL, _BUSHY])
def test_one_tree_that_fails_is_seen(text: str, seed: int) -> None:
    """Of the two trees of order 3, [[t]] or [t,t] alone fails: the slope is 2."""
    tableau = loads(f"methods: [{text}]").tableau
    assert find_order(tableau).order == 2
    result = converge(tableau, generic_rhs(1, seed))
    assert result.verdict == "agree"
    assert result.observed_order == pytest.approx(2, abs=0.05)


@pytest.mark.parametrize("l", [0, 1])
@pytest.mark.parametrize("m", [0, 1])
def test_one_block_that_fails_is_seen(l: int, m: int) -> None:
    """RK4 for two colours with one entry of A^{l,m} moved so that nodes stay: only the trees of
    order 3 with a vertex m above l fail, and the slope is 2.
    """
    rows = [["0"] * 4, ["1/2", "0", "0", "0"], ["0", "1/2", "0", "0"], ["0", "0", "1", "0"]]
    blocks = [[[list(x) for x in rows] for _ in range(2)] for _ in range(2)]
    moved = blocks[l][m]
    moved[2][0], moved[2][1] = "1/4", "1/4"
    b = [["1/6", "1/3", "1/3", "1/6"]] * 2
    text = f"tableau: {{A: {blocks}, b: {b}}}".replace("'", '"')
    tableau = loads(text).tableau
    assert find_order(tableau).order == 2
    result = converge(tableau, generic_rhs(2, 1))
    assert result.visible_order == 2
    assert result.observed_order == pytest.approx(2, abs=0.05)


@in_whole
def test_every_elementary_differential_is_there() -> None:
    """The differentials of all 20 trees of two colours up to order 3 are linearly independent, by
    their values at some places: no combination of their conditions is hidden.
    """
    made = generic_rhs(2, 1)
    y = symbols(made.variables, "y")
    J = [[[x.diff(a) for a in y] for x in term] for term in made.terms]
    H = [[[[x.diff(b) for b in y] for x in row] for row in term] for term in J]
    rows: list[list[fmpq]] = [[] for _ in range(20)]
    for k in range(7):
        place = {x: sympy.Rational(3 * i + 2 * k - 4, 20) for i, x in enumerate(y)}
        for row, values in zip(rows, _differentials((tuple(made.terms), J, H), place), strict=True):
            row += values
    assert fmpq_mat(rows).rank() == 20


def _differentials(
    derivatives: tuple[Any, Any, Any], place: dict[sympy.Symbol, sympy.Rational]
) -> list[list[fmpq]]:
    """f^l, f^l' f^m, f^l' f^m' f^n and f^l''(f^m, f^n) for all colours, by the definition."""
    n = range(len(place))

    def at(x: Any) -> Any:
        if isinstance(x, list | tuple):
            return [at(y) for y in x]
        value = x.xreplace(place)
        return fmpq(int(value.p), int(value.q))

    f, J, H = map(at, derivatives)

    def slope(l: int, u: list[fmpq]) -> list[fmpq]:
        return [sum((J[l][i][j] * u[j] for j in n), fmpq(0)) for i in n]

    found = list(f)
    colours = range(2)
    found += [slope(l, f[m]) for l in colours for m in colours]
    for l in colours:
        found += [slope(l, slope(m, f[k])) for m in colours for k in colours]
    for l in colours:
        for m, k in ((0, 0), (0, 1), (1, 1)):
            products = [(a, b, f[m][a] * f[k][b]) for a in n for b in n]
            found.append([sum((H[l][i][a][b] * x for a, b, x in products), fmpq(0)) for i in n])
    return found


@in_whole
def test_the_default_for_linear_colours() -> None:
    """A colour that is linear and drives all unknowns has no Hamiltonian counterpart: the default is
    generic-rhs, linear there, and shows the order. All other methods have a Hamiltonian one.
    """
    A, B = [["0", "0"], ["1", "0"]], [["0", "0"], ["1/2", "1/2"]]
    text = f"tableau: {{A: {[[A, B], [A, B]]}, b: {[['1/2', '1/2']] * 2}}}".replace("'", '"')
    plain = loads(text).tableau
    linear = loads(f"{text}\nlinear: [2]").tableau
    assert seeing_problem([plain]) == "generic"
    assert seeing_problem([linear]) == "generic-rhs"
    (made,) = in_common("generic-rhs", [linear], 1)
    assert isinstance(made, RightHandSide)
    assert all(sympy.Poly(x).total_degree() == 1 for x in made.terms[1])
    result = converge(linear)
    assert result.problem.name == "generic-rhs"  # type: ignore[union-attr]
    assert result.verdict == "agree"
