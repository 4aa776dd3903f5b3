"""Problem files that nobody would write, from a random source."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from random import Random

from garkcli.exact.formula import FUNCTIONS
from tests.fuzz.inputs import ROOT, damaged, replaced, soup

WORDS = (
    "variables", "hamiltonian", "lagrangian", "initial", "parameters", "t_end", "invariants", "name", "reference",
    "gark", "methods", "x", "y", "z", "px", "py", "pz", "vx", "vy", "vz", "q", "a", "pi", "e", "sin(x)", "cos(y)",
    "tan(x)", "asin(x)", "acos(px)", "exp(", "log(x)", "sqrt(", "cosh(vx)", "atan(", "cbrt(2)", "root(2, 5)",
    "x**2", "vx**2", "px**2/2", "x**-1", "x**(3/2)", "x**0.5", "sqrt(x**2)", "1/x", "1/(x - x)", "vx*vy", "x*px",
    "sqrt(1 - vx**2)", "0*x", "x - x", "sqrt(-1)", "9**9**9", "1e999", "2**64", "0", "1", "-1", "2", "1/2", "0.1",
    "010", "1:30", ".nan", ".inf", "1_0", "true", "null", "~", "yes", "x.y", "x(1)", "lambda: 0", "(", ")", "+",
    "-", "*", "/", "**", "^", "__import__('os')", "!!python/object/apply:os.system [true]", "!x", "&a", "*a", "<<",
    "- ", "{", "}", "[", "]", ": ", ", ", "\n", "\n  ", "\n  - ", "#", "|", ">-", "'", '"', "\\", "\t", "\0",
    "\x85", "\u2028", "²", "−", "🌲",
)  # fmt: skip
"""Words of problem files, and signs that mean something to YAML or to the grammar of formulas."""
SMALL = (
    "variables: [x]\nhamiltonian: px**2/2 - cos(x)\ninitial: {x: 1, px: 0}\n",
    "variables: [x, y]\nparameters: {m: 2, c: sqrt(m)/3}\nlagrangian:\n  - m*(vx**2 + vy**2)/2 + vx*y\n"
    "  - -c*(x**2 + y**2)**2\ninitial: {x: 1, y: 1/2, vx: 0, vy: 1}\n",
    "variables: [x]\nlagrangian: [-sqrt(1 - vx**2), -x**2/2]\ninitial: {x: 1, vx: 1/3}\nt_end: 5/2\n",
    "variables: [x, y]\nlagrangian: exp(vx) - vx*y + vy**4 - log(x)\ninitial: {x: 2, y: 0, vx: 1/4, vy: 1}\n",
)
"""Good files besides those of the folder ``problems``."""


def problem_seeds() -> tuple[str, ...]:
    """Good files to damage."""
    return (
        *SMALL,
        *(file.read_text(encoding="utf-8") for file in sorted((ROOT / "problems").glob("*.yaml"))),
    )


class _Writer:
    """Writes one file with the shape of a problem file; its formulas mostly are formulas."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.names = random.sample(
            ("x", "y", "z", "theta", "q1"), random.choice((1, 1, 1, 2, 2, 3))
        )
        self.is_lagrangian = random.random() < 0.6
        letter = "v" if self.is_lagrangian else "p"
        self.motion = [f"{letter}{name}" for name in self.names]

    def number(self) -> str:
        """A constant."""
        p, q = self.random.randrange(-3, 6), self.random.randrange(1, 8)
        numbers = (
            str(p),
            str(p),
            f"{p}/{q}",
            f"{p / 8}",
            "m",
            "sqrt(2)",
            "pi",
            f"cbrt({q})",
            f"{p}e-{q}",
        )
        return self.random.choice(numbers)

    def exponent(self) -> str:
        """An exponent, mostly a small one."""
        return self.random.choice(
            ("2", "2", "2", "3", "4", "-1", "-2", "(1/2)", "(3/2)", "0.5", "m", "7", "64", "0")
        )

    def formula(self, names: Sequence[str], depth: int) -> str:
        """Any formula."""
        random = self.random
        if depth == 0 or random.random() < 0.15:
            return random.choice((*names, *names, self.number()))
        kind = random.randrange(6)
        first = self.formula(names, depth - 1)
        if kind < 3:
            sign = random.choice(("+", "+", "-", "*", "*", "/"))
            return f"({first} {sign} {self.formula(names, depth - 1)})"
        if kind == 3:
            return f"({first})**{self.exponent()}"
        if kind == 4:
            function = random.choice((*FUNCTIONS, "sqrt"))
            return f"{function}({first})"
        return f"(1 + {first}**2)"

    def kinetic(self) -> str:
        """A function of velocities or momenta that has a transform, or nearly."""
        random = self.random
        squares = [
            f"{self.number()}*{x}**{random.choice(('2', '2', '2', '4'))}" for x in self.motion
        ]
        if random.random() < 0.3:
            squares.append(
                f"{random.choice(self.motion)}*{random.choice(self.motion)}*{self.formula(self.names, 1)}"
            )
        if random.random() < 0.3:
            squares.append(f"{random.choice(self.motion)}*{self.formula(self.names, 1)}")
        text = " + ".join(squares)
        return random.choice(
            (text, text, text, f"-m*sqrt(1 - ({text}))", f"exp({text})", f"log({text})")
        )

    def term(self) -> str:
        """One formula."""
        random = self.random
        chance = random.random()
        if chance < 0.4:
            return f"{self.kinetic()} - {self.formula(self.names, 2)}"
        if chance < 0.7:
            return random.choice((self.kinetic(), self.formula(self.names, 3)))
        return self.formula((*self.names, *self.motion), random.randrange(1, 5))

    def file(self) -> str:
        """The whole file."""
        random = self.random
        terms = [self.term() for _ in range(random.choice((1, 1, 2, 3)))]
        form = "lagrangian" if self.is_lagrangian else "hamiltonian"
        initial = ", ".join(f"{x}: {self.number()}" for x in (*self.names, *self.motion))
        lines = [
            f"variables: [{', '.join(self.names)}]",
            f"parameters: {{m: {random.choice(('1', '2', '1/3', 'sqrt(5)', '0', '-1'))}}}",
            f"{form}: {terms[0]}"
            if len(terms) == 1
            else f"{form}:" + "".join(f"\n  - {x}" for x in terms),
            f"initial: {{{initial}}}",
        ]
        if random.random() < 0.2:
            names = [*self.names, *(f"p{x}" for x in self.names)]
            lines.append(f"invariants: {{j: {self.formula(names, 2).replace(': ', '')}}}")
        return "\n".join(lines)


def written_problem(random: Random) -> str:
    """A file of either form with formulas of any kind."""
    return _Writer(random).file()


def problem_file(random: Random, files: Sequence[str]) -> str:
    """One file of any kind."""
    chance = random.random()
    if chance < 0.1:
        return soup(random, WORDS)
    if chance < 0.45:
        return written_problem(random)
    if chance < 0.55:
        return replaced(random, written_problem(random), WORDS)
    makers: tuple[Callable[[Random, str, Sequence[str]], str], ...] = (damaged, replaced)
    return random.choice(makers)(random, random.choice(files), WORDS)
