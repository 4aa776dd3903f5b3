"""Problem files that nobody would write: read or refused, soon, with nothing executed and no other
error.
"""

from __future__ import annotations

import time
from itertools import pairwise
from pathlib import Path
from random import Random

import pytest

from garkcli.errors import MethodFileError
from garkcli.problems.files.load import loads_problem
from tests.whole import in_whole, sample

PROBLEMS = Path(__file__).resolve().parents[3] / "problems"
LONGEST = 20.0
"""Seconds; a tenth of it is usual on an idle machine."""
WORDS = (
    "variables: ", "hamiltonian: ", "lagrangian: ", "initial: ", "parameters: ", "t_end: ", "invariants: ",
    "x", "y", "px", "py", "vx", "vy", "q", "a", "pi", "sin(", "cos(", "exp(", "log(", "sqrt(", "tan(", "acos(",
    ")", "(", "+", "-", "*", "/", "**", "^", "1", "2", "1/2", "0", "0.1", "1e400", "64", "9**9", ", ", "[", "]",
    "{", "}", ": ", "\n", "\n  - ", "\n  ", "|", ">-", "&a ", "*a", "!!python/object/apply:os.system ", "!x ", "'",
    '"', "~", "yes", "010", ".nan", "x(1)", "__import__('os')", "lambda: 0", "x.y", "²", "−", "\0", "🌲", "#",
)  # fmt: skip


def problem(variables: str, form: str, formula: str, initial: str, rest: str = "") -> str:
    """A file of one term."""
    return f"variables: [{variables}]\n{form}: {formula}\ninitial: {{{initial}}}\n{rest}"


def one(formula: str, rest: str = "") -> str:
    """A Hamiltonian of one variable."""
    return problem("x", "hamiltonian", formula, "x: 1/2, px: 1/3", rest)


MANY = [f"x{i}" for i in range(20)]
START = ", ".join(f"{x}: 1/2, p{x}: 0" for x in MANY)
CHAIN = "+".join(
    f"v{u}*v{w}*cos({u}-{w})*{6 - max(i, j)}/2"
    for i, u in enumerate("abcde")
    for j, w in enumerate("abcde")
)
REFUSED = {
    "100 kB": (one("+".join(["x*px"] * 20_000)), "a formula of 99999 characters"),
    "product": (
        one("px**2/2+" + "*".join(f"(x+{i})" for i in range(1, 600))),
        "second derivatives of",
    ),
    "parentheses": (one("(" * 500 + "x" + ")" * 500), "nested more than 60 deep"),
    "powers of powers": (one("(" * 29 + "x" + "+1)**1.5" * 29), "a number above 2^1000"),
    "large powers": (one("(" * 10 + "x" + "/9)**64" * 10), "a number of more than 60000 bits"),
    "power of a sum": (
        problem(
            ", ".join(MANY),
            "hamiltonian",
            f"({'+'.join(MANY)}+{'+'.join('p' + x for x in MANY)})**64",
            START,
        ),
        "second derivatives of",
    ),
    "tower": (one("px**2/2+exp(exp(exp(exp(9))))*x"), "a number above 2^1000"),
    "integer": (one("px**2/2+(10**64)**64*x"), "a number above 2^1000"),
    "parameters": (
        one(
            "a20*x",
            "parameters:\n  a0: sqrt(2)\n"
            + "".join(f"  a{i}: a{i - 1}*a{i - 1}\n" for i in range(1, 21)),
        ),
        "more than 2000 operations",
    ),
    "variables": (
        problem(", ".join(f"x{i}" for i in range(4_000)), "hamiltonian", "1", "x: 1"),
        "4000 variables",
    ),
    "terms": (one("[" + "0, " * 4_000 + "]"), "4000 terms"),
    "invariants": (
        one("px**2", "invariants: {" + ", ".join(f"j{i}: x" for i in range(99)) + "}"),
        "99 invariants",
    ),
    "aliases": (
        "a: &a [1, 1]\n"
        + "".join(f"b{i}: &b{i} [*{'ab'[i > 0]}{i - 1 if i else ''}]\n" for i in range(30)),
        "nested more than 12 deep",
    ),
    "alias": (one("&a [x, *a]"), "nested more than 12 deep"),
    "tag": (one("!!python/object/apply:os.system ['true']"), "H{1}: 'true' is not a variable"),
    "tagged text": (one("!!python/name:os.system x"), "the tag"),
    "code": (one("__import__('os').system('true')"), "'__import__' is not a function of formulas"),
    "long coefficient": (
        one(f"({'7' * 150}*x/1e150)**60"),
        "hamiltonian: a coefficient of about 9000 digits",
    ),
    "attribute": (one("x.__class__"), "the sign '.' is not allowed"),
    "mass matrix": (
        problem(
            "a,b,c,d,e",
            "lagrangian",
            CHAIN,
            "a: 1, b: 2, c: 3, d: 4, e: 5, va: 0, vb: 0, vc: 0, vd: 0, ve: 0",
        ),
        "second derivatives of",
    ),
    "equation": (
        problem(
            "x", "lagrangian", "+".join(f"sqrt(1+{i}*vx**2)" for i in range(1, 40)), "x: 1, vx: 1"
        ),
        "was not solved for vx",
    ),
    "sum of powers": (
        problem("x", "lagrangian", "vx**5+vx**3*sin(x*vx)+log(cosh(vx))", "x: 1, vx: 1"),
        "not solved",
    ),
}
READ = {
    "sum": one("px**2/2+" + "+".join(f"sin({i}*x)" for i in range(1, 240))),
    "nested": one("px**2/2+" + "sin(" * 59 + "x" + ")" * 59),
    "nested sums": one("px**2/2+" + "sin(x+cos(" * 25 + "x" + "))" * 25),
    "dense": problem(
        ", ".join(MANY),
        "hamiltonian",
        f"({'+'.join(MANY)})**4+" + "+".join(f"p{x}**2/2" for x in MANY),
        START,
    ),
    "chain of masses": problem(
        ",".join(MANY),
        "lagrangian",
        "+".join(f"(v{a}-v{b})**2" for a, b in pairwise(MANY)) + "+vx0**2",
        ", ".join(f"{x}: 0, v{x}: 1" for x in MANY),
    ),
    "quotients": one("px**2/2+" + "+".join(f"(x**{i}+1)/(x**{i + 1}-3)" for i in range(1, 60))),
}


@pytest.mark.parametrize("name", REFUSED)
def test_refused_soon(name: str) -> None:
    """The limit or fault is named, before much work is done."""
    text, message = REFUSED[name]
    before = time.process_time()
    with pytest.raises(MethodFileError) as caught:
        loads_problem(text)
    assert time.process_time() - before < LONGEST
    assert any(message in fault.message for fault in caught.value.faults)


@in_whole
@pytest.mark.parametrize("name", sample([*READ], 3))
def test_read_soon(name: str) -> None:
    """Large, but within the limits."""
    before = time.process_time()
    assert loads_problem(READ[name]).terms
    assert time.process_time() - before < LONGEST


@in_whole
@pytest.mark.parametrize("seed", range(4))
def test_any_text_is_read_or_refused(seed: int) -> None:
    """Soups of words, and good files with pieces replaced: nothing but ``MethodFileError`` comes
    out.
    """
    random = Random(seed)
    seeds = [path.read_text(encoding="utf-8") for path in sorted(PROBLEMS.glob("*.yaml"))]
    for _ in range(100):
        try_one(hostile(random, seeds))


def hostile(random: Random, seeds: list[str]) -> str:
    """One text."""
    if random.random() < 0.2:
        return "".join(random.choice(WORDS) for _ in range(random.randrange(40)))
    text = random.choice(seeds)
    for _ in range(random.randrange(1, 4)):
        i = random.randrange(len(text))
        j = i + random.choice((0, 1, 1, 3, 12))
        text = text[:i] + random.choice(("", *WORDS, text[j : j + 9])) + text[j:]
    return text


def try_one(text: str) -> None:
    """Read or refuse it; a refusal has faults with places."""
    try:
        loads_problem(text)
    except MethodFileError as error:
        faults = error.faults
    else:
        return
    assert faults
    lines = text.count("\n") + text.count("\r") + 1
    for fault in faults:
        assert fault.message
        assert 1 <= fault.line <= lines + 1
        assert fault.column >= 1
