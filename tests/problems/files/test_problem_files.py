"""Problem files: what is read, and every fault with its place."""

from __future__ import annotations

from pathlib import Path
from textwrap import dedent

import pytest
import sympy
from flint import arb, ctx, fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.errors import MethodFileError
from garkcli.methodfile.load import loads
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.files.formulas import BITS, nearby
from garkcli.problems.files.load import load_problem, loads_problem
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.problem import quantities_function
from garkcli.problems.righthandside import RightHandSide

PROBLEMS = Path(__file__).resolve().parents[3] / "problems"
ONE = "variables: [x]\nhamiltonian: px**2/2 - cos(x)\ninitial: {x: 1, px: 0}\n"


def faults(text: str) -> list[tuple[int, int, str, str]]:
    """Line, column, message and help of every fault."""
    with pytest.raises(MethodFileError) as caught:
        loads_problem(dedent(text))
    return [(x.line, x.column, x.message, x.help) for x in caught.value.faults]


def read(text: str) -> Hamiltonian:
    """The Hamiltonian of a text."""
    problem = loads_problem(dedent(text))
    assert isinstance(problem, Hamiltonian)
    return problem


def test_smallest_file() -> None:
    """A single formula is one term; name, time and invariants have defaults."""
    problem = loads_problem(ONE, "folder/my pendulum.yaml")
    assert problem.name == "my pendulum"
    assert problem.variables == ("x",)
    assert [str(x) for x in problem.terms] == ["px**2/2 - cos(x)"]
    assert problem.initial == (fmpq(1), fmpq(0))
    assert problem.t_end == 2
    assert problem.invariants == ()


def test_every_key() -> None:
    """All keys at once, with parameters that build on each other."""
    problem = read(
        """\
        gark: 1
        name: |
          two
          bodies
        description: text
        reference: text
        variables: [x, y]
        parameters: {m: 2, k: m/4, r: sqrt(m), w: 2*pi, n: 3}
        hamiltonian:
          - (px**2 + py**2)/(2*m) + r*0
          - k*x**2 + y**2/2
          - k*x**2 + y**2/2
          - w*(1 + x**2)**(n/2) - m**0.5*y
        initial: {y: 1/3, x: m/10, py: 0.25, px: -1e-1}
        t_end: m + 1/2
        invariants: {J: x*py - y*px}
        """
    )
    x, y, px, py = (sympy.Symbol(s, real=True) for s in ("x", "y", "px", "py"))
    assert problem.name == "two bodies"
    assert problem.terms == (
        px**2 / 4 + py**2 / 4,
        x**2 / 2 + y**2 / 2,
        x**2 / 2 + y**2 / 2,
        2 * sympy.pi * (1 + x**2) ** sympy.Rational(3, 2) - sympy.sqrt(2) * y,
    )
    assert problem.initial == (fmpq(1, 5), fmpq(1, 3), fmpq(-1, 10), fmpq(1, 4))
    assert problem.t_end == fmpq(5, 2)
    assert problem.invariants == (("J", x * py - y * px),)


@pytest.mark.parametrize("name", ["kepler", "double-pendulum"])
def test_files_of_built_in_problems(name: str) -> None:
    """The file in the folder problems is the built-in problem: the same energy at random places."""
    built_in, own = (hamiltonian(name, 1), load_problem(str(PROBLEMS / f"{name}.yaml")).unsplit())
    assert own.variables == built_in.variables
    with ctx.workprec(200):
        one, other = (quantities_function(x, 50) for x in (built_in, own))
        for k in range(5):
            at = [arb(fmpq(7 * k + 3 * i + 1, 11)) for i in range(len(own.initial))]
            assert all(a.overlaps(b) for a, b in zip(one(*at), other(*at), strict=True))
    assert own.initial == built_in.initial
    assert own.t_end == built_in.t_end


def test_irrational_initial_values() -> None:
    """To sixty decimals, by the simplest fraction that is so near."""
    problem = read(
        "{variables: [x], hamiltonian: px**2, initial: {x: pi/2, px: sqrt(2)/2 + 0*exp(1)}}"
    )
    with ctx.workprec(BITS):
        for found, wanted in zip(problem.initial, (arb.pi() / 2, arb(2).sqrt() / 2), strict=True):
            assert abs(found - wanted) < arb(10) ** -60
            assert found.q < 10**31


@given(st.fractions(-1000, 1000, max_denominator=10**9))
def test_fractions_are_found_again(number: fmpq) -> None:
    """The simplest fraction near the ball of a fraction is that fraction."""
    wanted = fmpq(number.numerator, number.denominator)
    with ctx.workprec(BITS):
        assert nearby(arb(wanted)) == wanted


def test_velocities_become_momenta() -> None:
    """Exactly where they are rational, and to sixty decimals where not."""
    problem = read(
        """\
        variables: [x, y]
        lagrangian: (1 + x**2)*vx**2 + vx*vy + vy**2 - x*vy - cos(y)
        initial: {x: 1/2, y: 0, vx: 1/3, vy: -2}
        """
    )
    assert problem.initial == (fmpq(1, 2), fmpq(0), fmpq(5, 6) - 2, fmpq(1, 3) - 4 - fmpq(1, 2))
    problem = read("{variables: [x], lagrangian: vx**2*cos(x)/2, initial: {x: 1, vx: 2}}")
    with ctx.workprec(BITS):
        assert abs(problem.initial[1] - 2 * arb(1).cos()) < arb(10) ** -60


def test_momenta_of_a_lagrangian() -> None:
    """They may be given instead; and must be where several terms have velocities that are not
    quadratic.
    """
    problem = read("{variables: [x], lagrangian: [vx**2*3/2, -cos(x)], initial: {x: 1, px: 2}}")
    assert [str(x) for x in problem.terms] == ["px**2/6", "cos(x)"]
    assert problem.initial == (fmpq(1), fmpq(2))
    several = "{variables: [x], lagrangian: [vx**2/2, x*vx**2], initial: {x: 1, vx: 3}}"
    assert read(several).initial == (fmpq(1), fmpq(2))  # p + p/2 = 3
    text = "{variables: [x], lagrangian: [vx**2/2, -sqrt(1 - vx**2)], initial: {x: 1, %s: 1/3}}"
    assert len(read(text % "px").terms) == 2
    ((_, _, message, help_),) = faults(text % "vx")
    assert "p = ∂L/∂v was not solved" in message or "momenta that belong to their sum" in message
    assert help_


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("", [(1, 1, "the file is empty")]),
        ("[1, 2]", [(1, 1, "a problem file is a mapping of keys to values")]),
        ("variables: [x", [(1, 14, "this is not YAML")]),
        (
            "methods: [{family: gauss, stages: 2}]",
            [(1, 1, "this is a method file, not a problem file")],
        ),
        (
            "name: x",
            [(1, 1, "variables missing"), (1, 1, "no hamiltonian, no"), (1, 1, "initial missing")],
        ),
        (ONE + "inital: {}", [(4, 1, "the file: unknown key 'inital'")]),
        (ONE + "initial: {}", [(4, 1, "the file: the key 'initial' appears twice")]),
        (ONE + "lagrangian: vx**2", [(4, 13, "given by hamiltonian already")]),
        (ONE + "gark: 2", [(4, 7, "gark: this program reads version 1")]),
        (ONE + "name: [a]", [(4, 7, "name: a single value is expected here")]),
        (ONE + "t_end: 0", [(4, 8, "t_end: a positive rational number")]),
        (ONE + "t_end: pi", [(4, 8, "t_end: a positive rational number")]),
        (ONE + "t_end: 1/0", [(4, 10, "t_end: division by zero")]),
        (ONE + "t_end: 010", [(4, 8, "t_end: 010 means different numbers")]),
        (ONE + "t_end: x", [(4, 8, "t_end: 'x' is not a parameter")]),
        (ONE + "invariants: {energy: x}", [(4, 22, "invariants: energy is reported always")]),
        (
            ONE + "invariants: {J: vx}",
            [(4, 17, "invariants: J: 'vx' is not a variable, momentum or parameter")],
        ),
        (
            ONE + "invariants: {J: log(px)}",
            [(4, 17, "invariants: J at the initial values: log of px = 0")],
        ),
        (ONE + "parameters: {x: 1}", [(4, 14, "parameters: x is a variable already")]),
        (ONE + "parameters: {px: 1}", [(4, 14, "parameters: px is the momentum of x already")]),
        (ONE + "parameters: {pi: 3}", [(4, 18, "parameters: pi has a meaning already")]),
        (ONE + "parameters: {sin: 3}", [(4, 19, "parameters: sin has a meaning already")]),
        (ONE + "parameters: {a: b, b: 1}", [(4, 17, "parameters: a: 'b' is not a parameter")]),
        (
            ONE + "parameters: {a: log(-1)}",
            [(4, 17, "parameters: a: log of -1 is not a real number")],
        ),
        (ONE + "parameters: {a: x}", [(4, 17, "parameters: a: 'x' is not a parameter")]),
        (ONE + "parameters: {'a b': 1}", [(4, 21, "parameters: 'a b' is not a name")]),
        (
            ONE + "parameters: {a: yes}",
            [(4, 17, "parameters: a: 'yes' is not a number: YAML reads it as bool")],
        ),
        (ONE.replace("[x]", "[pi]"), [(1, 13, "variables: 'pi' has a meaning already")]),
        (
            "variables: [i]\nhamiltonian: pi**2/2 - cos(i)\ninitial: {i: 1, pi: 0}",
            [(1, 13, "variables: the momentum of i would be pi, which has a meaning already")],
        ),
        (
            ONE + "invariants: {z: x - x, one: 7, j: px**2}",
            [(4, 17, "invariants: z is constant"), (4, 29, "invariants: one is constant")],
        ),
        (ONE + "invariants: {z: sin(x)**2 + cos(x)**2}", [(4, 17, "invariants: z is constant")]),
        (
            "variables: [x]\nhamiltonian: (x + 1)**2 - x**2 - 2*x\ninitial: {x: 1, px: 0}",
            [(2, 14, "the Hamiltonian is constant: it depends on no variable, and nothing moves")],
        ),
        (
            "variables: [x]\nhamiltonian: [0, 0]\ninitial: {x: 1, px: 0}",
            [(2, 15, "the Hamiltonian is constant: the sum of its terms")],
        ),
        (ONE.replace("[x]", "[x, px]"), [(1, 16, "variables: px is the momentum of x")]),
        (ONE.replace("[x]", "[x, x]"), [(1, 16, "variables: 'x' is named twice")]),
        (ONE.replace("[x]", "[]"), [(1, 12, "variables is empty")]),
        (ONE.replace("[x]", "[[x]]"), [(1, 13, "variables: a single value is expected here")]),
        (ONE.replace("[x]", "'x, y'"), [(1, 13, "variables: 'x, y' is not a name")]),
        (ONE.replace("[x]", f"[{'x' * 31}]"), [(1, 13, "is longer than 30 characters")]),
        (
            ONE.replace("cos(x)", "cos(z)"),
            [(2, 28, "hamiltonian: 'z' is not a variable, momentum or parameter")],
        ),
        (ONE.replace("px**2", "vx**2"), [(2, 14, "hamiltonian: 'vx' is not a variable, momentum")]),
        (ONE.replace("cos(x)", "cos(x"), [(2, 29, "hamiltonian: ')' expected, the end found")]),
        (
            ONE.replace("cos(x)", "log(x - 1)"),
            [(2, 24, "hamiltonian at the initial values: log of x-1 = 0")],
        ),
        (
            ONE.replace("cos(x)", "1/(x - 1)"),
            [(2, 27, "hamiltonian at the initial values: division by zero")],
        ),
        (
            ONE.replace("cos(x)", "sqrt(x - 2)"),
            [(2, 24, "hamiltonian at the initial values: an even root")],
        ),
        (
            ONE.replace("cos(x)", "(x - 2)**1.5"),
            [(2, 24, "hamiltonian at the initial values: a power with")],
        ),
        (
            ONE.replace("cos(x)", "sqrt(x - 1)"),
            [(2, 14, "hamiltonian at the initial values: no derivative by x")],
        ),
        (ONE.replace("cos(x)", "sqrt(x**2)"), [(2, 24, "hamiltonian: this has |x|")]),
        (
            ONE.replace("cos(x)", "abs(x)"),
            [(2, 24, "hamiltonian: 'abs' is not a function of formulas")],
        ),
        (ONE.replace("cos(x)", "2**x"), [(2, 27, "hamiltonian: the exponent depends on x")]),
        (ONE.replace("px**2/2 - cos(x)", "[]"), [(2, 14, "hamiltonian is empty")]),
        (
            ONE.replace("px**2/2 - cos(x)", "{a: 1}"),
            [(2, 14, "hamiltonian: a list is expected here")],
        ),
        (
            ONE.replace("px**2/2 - cos(x)", "[px**2, [1]]"),
            [(2, 22, "H{2}: a single value is expected here")],
        ),
        (ONE.replace("px**2/2 - cos(x)", "[px**2, ~]"), [(2, 22, "H{2}: nothing is here")]),
        (ONE.replace(", px: 0", ""), [(3, 10, "initial: no value for px")]),
        (ONE.replace("{x: 1, px: 0}", "{}"), [(3, 10, "initial: no value for x, px")]),
        (ONE.replace("{x: 1, px: 0}", "[1, 0]"), [(3, 10, "initial: a mapping of keys to values")]),
        (ONE.replace("px: 0", "vx: 0"), [(3, 17, "initial: unknown key 'vx'")]),
        (ONE.replace("px: 0", "px: nan"), [(3, 21, "initial: px: nan is not a number")]),
        (ONE.replace("px: 0", "px: !!str 0"), []),
        (
            ONE.replace("px: 0", "px: !x 0"),
            [(3, 21, "initial: px: the tag '!x' is not allowed here")],
        ),
    ],
)
def test_faults_of_hamiltonians(text: str, wanted: list[tuple[int, int, str]]) -> None:
    """Each fault with its place; no other is reported."""
    if not wanted:
        assert loads_problem(text)
        return
    found = faults(text)
    assert [x[:2] for x in found] == [x[:2] for x in wanted]
    for (*_, message, _), (*_, part) in zip(found, wanted, strict=True):
        assert part in message


@pytest.mark.parametrize(
    ("lagrangian", "initial", "message"),
    [
        (
            "vx**2 - x*py",
            "{x: 1, y: 1, vx: 0, vy: 0}",
            "lagrangian: 'py' is not a variable, velocity or parameter",
        ),
        (
            "vx**2 - x",
            "{x: 1, y: 1, vx: 0, vy: 0}",
            "the mass matrix is singular: vy does not occur beside vx",
        ),
        ("(vx + vy)**2", "{x: 1, y: 1, vx: 0, vy: 0}", "the mass matrix of vx, vy is singular"),
        ("x + y", "{x: 1, y: 1, vx: 0, vy: 0}", "the Lagrangian has no velocities"),
        ("vx**2 + vy**2", "{x: 1, y: 1, vx: 0, py: 0}", "initial: velocities and momenta"),
        ("vx**2 + vy**2", "{x: 1, y: 1, vx: 0}", "initial: no value for vy"),
        ("vx**2 + vy**2", "{x: 1, y: 1, px: 0}", "initial: no value for py"),
        ("vx**2 + vy**2", "{x: 1, y: 1}", "initial: no value for vx, vy"),
        (
            "[vx**2 + vy**2, 1/(x - y)]",
            "{x: 1, y: 1, vx: 0, vy: 0}",
            "L{2} at the initial values: division by zero",
        ),
        ("vx**4 + vx**2 + vy**2", "{x: 1, y: 1, vx: 1, vy: 0}", "p = ∂L/∂v was not solved for vx"),
        (
            "vx**2*log(x - 1) + vy**2",
            "{x: 1, y: 1, vx: 1, vy: 0}",
            "log of x-1 = 0 is not a real number",
        ),
        (
            "vx**2*log(x - 1) + vy**2",
            "{x: 1, y: 1, px: 1, py: 0}",
            "the mass matrix of vx is singular",
        ),
        (
            "vx**2*(x - 1) + vy**2",
            "{x: 1, y: 1, vx: 1, vy: 0}",
            "the mass matrix of vx is singular",
        ),
    ],
)
def test_faults_of_lagrangians(lagrangian: str, initial: str, message: str) -> None:
    """Degenerate ones, wrong names, incomplete starts: one fault each, with a cure."""
    ((line, _, found, _),) = faults(
        f"variables: [x, y]\nlagrangian: {lagrangian}\ninitial: {initial}\n"
    )
    assert message in found
    assert line == (3 if found.startswith("initial") else 2)


def test_velocities_clash_in_lagrangians_only() -> None:
    """A variable vx beside x is the velocity of x; a Hamiltonian has no such name."""
    text = "{variables: [x, vx], %s: %s**2 + %s**2, initial: {x: 0, vx: 0, px: 1, pvx: 1}}"
    assert read(text % ("hamiltonian", "px", "pvx")).variables == ("x", "vx")
    assert "variables: vx is the velocity of x" in faults(text % ("lagrangian", "vx", "vvx"))[0][2]


def test_places_in_texts_of_several_lines() -> None:
    """Block, folded, quoted and plain scalars: the caret stands under the fault."""
    text = dedent(
        """\
        variables: [x]
        hamiltonian:
          - |
            px**2/2
              - cos(a)
          - >-
            x**2

            + b
          - x +
             c*x
          - "x +
             d"
          - 'x + e'
        initial: {x: 1, px: 0}
        """
    )
    places = {}
    for line, column, message, _ in faults(text):
        places[message.split("'")[1]] = text.splitlines()[line - 1][column - 1]
    assert places == {name: name for name in "abcde"}


def test_all_faults_at_once() -> None:
    """Faults of every part of one file are found in one run."""
    found = faults(
        """\
        variables: [x]
        parameters: {k: 1/0}
        hamiltonian: [px**2 + q, k*y + sin(, k*log(x - 2)]
        initial: {x: log(0), py: 1}
        t_end: -1
        invariants: {J: (}
        nam: x
        """.replace("sin(,", "sin((),")
    )
    assert [x[0] for x in found] == [2, 3, 3, 4, 4, 5, 6, 7]


def test_wrong_variables_spoil_no_other_names() -> None:
    """Names are not judged where the variables are in doubt; all else is."""
    found = faults(
        """\
        variables: [x, pi]
        hamiltonian: [px**2 + y, 2x]
        initial: {x: log(0), py: 1}
        """
    )
    assert [x[0] for x in found] == [1, 2, 3]


def test_names_are_shown_on_one_line() -> None:
    """No control characters reach a terminal, and no name is longer than a line."""
    assert loads_problem(f'name: "a\\e[31m\\n b"\n{ONE}').name == "a [31m b"
    assert len(loads_problem(f"name: {'n' * 500}\n{ONE}").name) == 60
    text = f'invariants: {{"J\\a": x}}\n{ONE}'
    assert loads_problem(text).invariants[0][0] == "J"


def test_method_files_and_problem_files_know_each_other() -> None:
    """Each says what it is when it is given for the other."""
    with pytest.raises(MethodFileError, match="this is a problem file, not a method file"):
        loads(ONE)


@pytest.mark.parametrize("path", sorted(PROBLEMS.glob("*.yaml")), ids=lambda x: x.stem)
def test_files_of_the_folder(path: Path) -> None:
    """Every file of the folder problems is read; its invariants are first integrals: by their
    Poisson brackets, or along the right-hand sides.
    """
    problem = load_problem(str(path))
    if isinstance(problem, RightHandSide):
        y = [sympy.Symbol(x, real=True) for x in problem.variables]
        for _, made in problem.invariants:
            pairs = zip(y, problem.total, strict=True)
            change = sum(made.diff(x) * f for x, f in pairs)
            assert sympy.simplify(change) == 0
        return
    H = problem.energy
    q = [sympy.Symbol(x, real=True) for x in problem.variables]
    p = [sympy.Symbol(f"p{x}", real=True) for x in problem.variables]
    for _, made in problem.invariants:
        bracket = sum(
            made.diff(a) * H.diff(b) - made.diff(b) * H.diff(a) for a, b in zip(q, p, strict=True)
        )
        assert sympy.simplify(bracket) == 0
