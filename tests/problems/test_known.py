"""The known answers about built-in problems agree with sympy, and commands need no others."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from typing import Any

import pytest
import sympy
from flint import arb, ctx, fmpq

from garkcli.problems import straightline
from garkcli.problems.__main__ import answers, answers_of_clock
from garkcli.problems.builtin import PROBLEMS, problem
from garkcli.problems.deferred import KNOWN, Deferred, Record, ask, known
from garkcli.problems.draw import Draw
from garkcli.problems.straightline import StraightLineCode, code_of, function

DIGITS = 40
TERMS = {name: 2 if of.takes_seed else 3 for name, of in PROBLEMS.items()}
"""A number of terms for each problem; in one term comes its sum. Random ones in three take long."""
SHARING = [name for name, of in PROBLEMS.items() if not of.takes_seed]
"""The problems whose sum does not depend on how they are split."""
NO_SYMPY = """
import sys
sys.modules["sympy"] = None
from garkcli.cli.main import main
for command in sys.argv[1:]:
    sys.argv = ["gark", *command.split()]
    try:
        main()
    except SystemExit as end:
        print("code", end.code)
"""
COMMANDS = (
    "converge rk4",
    "converge verlet",
    "converge radau-iia-2 --problem prothero-robinson",
    "energy rk4",
    "energy verlet --problem kepler --t-end 20",
)


@pytest.fixture
def no_programs(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Known programs are not written anew, which takes long: their values are compared."""
    written = straightline._written

    def none(expressions: Any, *others: Any) -> StraightLineCode:
        if isinstance(expressions, Deferred):
            return StraightLineCode(0, (), (), (), False)
        return written(expressions, *others)

    monkeypatch.setattr(straightline, "_written", none)
    yield
    code_of.cache_clear()


def as_ball(x: Any) -> arb:
    """A number of sympy, to ``DIGITS``."""
    return arb(str(sympy.N(x, DIGITS)))


def assert_same_values(expressions: Deferred, question: str) -> None:
    """The known program gives what sympy finds for the expressions at a rational point."""
    kind, _, names = question.partition(" of ")
    arguments = names.split()
    draw = Draw(len(question))
    point = [fmpq(draw.between(20, 80), 100) for _ in arguments]
    place = {
        sympy.Symbol(name, real=True): sympy.Rational(int(x.p), int(x.q))
        for name, x in zip(arguments, point, strict=True)
    }
    is_for_balls = kind == "balls"
    with ctx.workprec(200):
        exact = [as_ball(sympy.sympify(x).subs(place)) for x in expressions]
        evaluate = function(expressions, Deferred(names, list, len(arguments)), is_for_balls)
        found = evaluate(*[arb(x) if is_for_balls else float(arb(x)) for x in point])
        size = 1 + sum(map(abs, exact), arb(0))
        limit = size * arb(10) ** (3 - DIGITS if is_for_balls else -13)
        for x, y in zip(found, exact, strict=True):
            assert abs(arb(x) - y) < limit, (expressions.name, question)


def assert_known(record: Record, problem: str) -> None:
    """Every answer is known, a fact as sympy gives it now, a program by its values."""
    for expressions, answered in record.items():
        for question, answer in answered.items():
            assert question in known(problem)[expressions.name]
            if question.startswith(("floats of", "balls of")):
                assert_same_values(expressions, question)
            elif question != "texts":
                assert known(problem)[expressions.name][question] == answer, expressions.name


@pytest.mark.parametrize(("name", "terms"), TERMS.items())
@pytest.mark.usefixtures("no_programs")
def test_answers(name: str, terms: int) -> None:
    """Facts and programs agree with sympy's own derivatives, evaluated by sympy."""
    record = answers(name, terms)
    code_of.cache_clear()
    assert_known(record, name)


@pytest.mark.usefixtures("no_programs")
def test_clock() -> None:
    """So do those of time."""
    record = answers_of_clock()
    code_of.cache_clear()
    assert_known(record, "clock")


@pytest.mark.parametrize("name", SHARING)
def test_equal_names_mean_equal_expressions(name: str) -> None:
    """The sum of two or three terms has the name of the problem in one term, and is that."""
    whole = problem(name, 1).terms
    assert isinstance(whole, Deferred)
    for terms in (2, 3):
        total = problem(name, terms).unsplit().terms
        assert isinstance(total, Deferred)
        assert (total.name, total.made) == (whole.name, whole.made)


def test_files() -> None:
    """There is a file for each problem and for the clock, and no other."""
    assert {x.stem for x in KNOWN.glob("*")} == {*PROBLEMS, "clock"}


def test_unknown() -> None:
    """What a file does not answer is computed."""
    other = Deferred("pendulum terms=2", lambda: (sympy.Integer(2),), 1)
    assert ask(other, "texts", list) == ["px**2/2", "1 - cos(x)"]
    assert ask(other, "a question", lambda: 7) == 7


def test_commands_without_sympy() -> None:
    """Convergence tests and long runs of built-in problems work where sympy cannot be imported."""
    ended = subprocess.run(
        [sys.executable, "-c", NO_SYMPY, *COMMANDS], capture_output=True, text=True, check=True
    )
    assert not ended.stderr
    assert len(re.findall(r"^  problem ", ended.stdout, re.MULTILINE)) == len(COMMANDS)
