"""Problem files with ``rhs``: what they mean, and every fault at its place."""

from __future__ import annotations

from textwrap import dedent

import pytest
import sympy
from flint import fmpq

from garkcli.errors import MethodFileError
from garkcli.problems.files.load import loads_problem
from garkcli.problems.righthandside import RightHandSide

HEAD = "variables: [x, y]\n"
TAIL = "initial: {x: 1, y: 2}\n"


def read(text: str, stiffness: fmpq | None = None) -> RightHandSide:
    """The right-hand sides of a text."""
    made = loads_problem(dedent(text), stiffness=stiffness)
    assert isinstance(made, RightHandSide)
    return made


def faults(text: str, stiffness: fmpq | None = None) -> list[tuple[int, int, str]]:
    """Line, column and message of every fault."""
    with pytest.raises(MethodFileError) as caught:
        loads_problem(dedent(text), stiffness=stiffness)
    assert all(x.help for x in caught.value.faults if "no real" not in x.message)
    return [(x.line, x.column, x.message) for x in caught.value.faults]


def test_terms_by_names() -> None:
    """A mapping is one term, a list has one per colour; what is left out is 0."""
    x, y, t = (sympy.Symbol(name, real=True) for name in "xyt")
    one = read(HEAD + "rhs: {x: y, y: -x}\n" + TAIL)
    assert one.terms == ((y, -x),)
    two = read(HEAD + "rhs: [{x: y}, {y: t*x}]\n" + TAIL)
    assert two.terms == ((y, 0), (0, t * x))
    assert two.total == (y, t * x)
    assert two.initial == (1, 2)
    assert (one.has_time, two.has_time) == (False, True)


def test_one_variable_needs_no_name() -> None:
    """Its formulas alone are right-hand sides."""
    made = read("variables: y\nrhs: [t, -y]\ninitial: {y: 1}\n")
    assert [str(x) for (x,) in made.terms] == ["t", "-y"]


def test_the_solution_gives_the_start() -> None:
    """``exact`` at t = 0, where ``initial`` is left out; an irrational one to sixty decimals."""
    made = read("variables: y\nrhs: -y\nexact: {y: 3*exp(-t)}\n")
    assert made.initial == (3,)
    rounded = read("variables: y\nrhs: -y\nexact: {y: sqrt(2)*exp(-t)}\n")
    assert abs(rounded.initial[0] ** 2 - 2) < fmpq(1, 10**58)
    both = read("variables: y\nrhs: -y\nexact: {y: 3*exp(-t)}\ninitial: {y: 3}\n")
    assert both.initial == (3,)


def test_stiffness_takes_the_place_of_the_parameter() -> None:
    """Parameters after it see the new value."""
    text = """
        variables: y
        parameters: {stiffness: 10, eps: 1/stiffness}
        rhs: -y/eps
        initial: {y: 1 + eps}
    """
    assert read(text).stiffness == 10
    stiff = read(text, fmpq(1000))
    assert stiff.stiffness == 1000
    assert stiff.initial == (fmpq(1001, 1000),)
    assert str(stiff.total[0]) == "-1000*y"


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("variables: [t]\nrhs: {t: 1}\ninitial: {t: 0}\n", [(1, 13, "t is time")]),
        (
            "variables: [x]\nparameters: {t: 1}\nrhs: x\ninitial: {x: 1}\n",
            [(2, 14, "parameters: t is time already")],
        ),
        (HEAD + "rhs: x + y\n" + TAIL, [(2, 6, "by the names of variables")]),
        (HEAD + "rhs: []\n" + TAIL, [(2, 6, "rhs is empty")]),
        (
            HEAD + "rhs: [{x: q}, {z: x}]\n" + TAIL,
            [(2, 11, "'q' is not a variable"), (2, 16, "unknown key 'z'")],
        ),
        (HEAD + "rhs: {x: y, y: -x}\n", [(1, 1, "initial missing")]),
        (HEAD + "rhs: {x: y}\ninitial: {x: 1}\n", [(3, 10, "no value for y")]),
        (HEAD + "rhs: {x: y}\nhamiltonian: px\n" + TAIL, [(2, 6, "given by hamiltonian already")]),
        (HEAD + "rhs: {x: 1/(x - 1)}\n" + TAIL, [(2, 13, "at the initial values")]),
        (HEAD + "rhs: {x: sqrt(y - 2)}\n" + TAIL, [(2, 10, "no derivative by y")]),
        (HEAD + "rhs: {x: log(-1)*x}\n" + TAIL, [(2, 10, "f")]),
        (HEAD + "rhs: [{x: y}, {x: -y}]\n" + TAIL, [(2, 11, "the right-hand sides sum to 0")]),
        (
            HEAD + "rhs: {x: y}\n" + TAIL + "invariants: {I: x - t}\n",
            [(4, 21, "'t' is not a variable or parameter")],
        ),
        (HEAD + "rhs: {x: y}\n" + TAIL + "invariants: {I: 2}\n", [(4, 17, "is constant")]),
        (
            HEAD + "rhs: {x: y, y: -x}\nexact: {x: sin(t), y: sin(t)}\n",
            [(3, 12, "not a solution: at t = 2/3 its derivative is 0.785887")],
        ),
        (
            "variables: y\nrhs: -y\nexact: {y: exp(-t)}\ninitial: {y: 2}\n",
            [(3, 12, "starts at 1.00000, but initial has 2.00000")],
        ),
        (HEAD + "rhs: {x: y, y: -x}\nexact: {x: sin(t)}\n", [(3, 8, "no value for y")]),
        (
            HEAD + "rhs: {x: y, y: -x}\nexact: {x: y, y: cos(t)}\n",
            [(3, 12, "'y' is not a parameter")],
        ),
        (
            "variables: x\nhamiltonian: px**2/2\nexact: {x: t}\ninitial: {x: 0, px: 1}\n",
            [(3, 8, "exact is for rhs")],
        ),
    ],
)
def test_faults(text: str, wanted: list[tuple[int, int, str]]) -> None:
    """Each fault with its place; no other is reported."""
    found = faults(text)
    assert [x[:2] for x in found] == [x[:2] for x in wanted], found
    for (*_, message), (*_, part) in zip(found, wanted, strict=True):
        assert part in message


def test_a_stiffness_that_is_no_parameter() -> None:
    """It would change nothing: neither where there is no such parameter, nor of a Hamiltonian."""
    ((line, _, message),) = faults("variables: y\nrhs: -y\ninitial: {y: 1}\n", fmpq(2))
    assert line == 1
    assert "no parameter called stiffness" in message
    text = "variables: x\nhamiltonian: px**2/2\ninitial: {x: 0, px: 1}\n"
    ((_, _, message),) = faults(text, fmpq(2))
    assert "--stiffness is for rhs" in message


@pytest.mark.parametrize(
    "formula",
    [
        "__import__('os').system('true')",
        "x.__class__",
        "(lambda: x)()",
        "exec('x')",
        "9**9**9**9",
        "x" + "*(x + 1)" * 30_000,
        "(" * 500 + "x" + ")" * 500,
        "(x + y)**64" + "*(x + 2*y)**64" * 200,
    ],
)
def test_hostile_formulas(formula: str) -> None:
    """Nothing runs, and nothing takes long: faults with a place."""
    found = faults(f'{HEAD}rhs: {{x: "{formula}"}}\n{TAIL}')
    assert {line for line, *_ in found} == {2}
