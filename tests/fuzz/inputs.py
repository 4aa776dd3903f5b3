"""Method files and numbers that nobody would write, from a random source: the input of every fuzz
run.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random

ROOT = Path(__file__).resolve().parents[2]
WORDS = (
    "methods", "transfer", "tableau", "ark", "prk", "structure", "linear", "parameters", "tolerance", "expect",
    "family", "stages", "A", "b", "c", "q", "p", "default", "blocks", '"1,2"', '"2,1"', "gauss", "lobatto-iiia",
    "radau-iia", "rk4", "heun", "collocation", "interpolation", "conjugate-collocation", "symplectic-collocation",
    "legendre", "rule", "degree", "separable", "semi-separable", "nystrom", "general", "order", "pair-order", "C", "symplectic", "conjugate",
    "true", "false", "null", "~", "yes", "tau", "1", "2", "3", "0", "-1", "1/2", "1/0", "sqrt(3)", "sqrt(-1)",
    "1/2 - sqrt(3)/6", "root(2, 5)", "cbrt(-2)", "9**9**9", "1e999", "0.1", "010", "1:30", ".nan", ".inf", "1_0",
    "__import__('os')", "!!python/object/apply:os.system [true]", "&a", "*a", "<<", "- ", "{", "}", "[", "]", ": ",
    ", ", "\n", "\n  ", "\n    - ", "#", "|", ">", "'", '"', "\\", "\t", "\0", "\x85", "\u2028", "١", "−", "🌲",
)  # fmt: skip
"""Words of method files, and signs that mean something to YAML or to the grammar of numbers."""
SIGNS = (*"0123456789.+-*/^()eE, ", "sqrt(", "cbrt(", "root(", "**", "tau", "√", "²", "\n")
"""Signs that numbers are made of, and some that look like them."""


def seeds() -> tuple[str, ...]:
    """The files of the project: good ones to damage."""
    folders = (ROOT / "methods", ROOT / "tests" / "examples")
    files = sorted(file for folder in folders for file in folder.rglob("*.gark.yaml"))
    return tuple(
        file.read_bytes().decode("utf-8", "replace") for file in files if file.stat().st_size < 4000
    )


def soup(random: Random, signs: Sequence[str] = WORDS, longest: int = 60) -> str:
    """Words one after the other."""
    return "".join(random.choice(signs) for _ in range(random.randrange(longest)))


def damaged(random: Random, text: str, words: Sequence[str] = WORDS) -> str:
    """``text`` with a few pieces cut, doubled, swapped or replaced."""
    for _ in range(random.randrange(1, 6)):
        i, j = sorted((random.randrange(len(text) + 1), random.randrange(len(text) + 1)))
        j = min(j, i + random.choice((1, 3, 10, 100)))
        piece = random.choice(
            ("", text[i:j] * 2, random.choice(words), chr(random.randrange(0x3000)), text[j:i])
        )
        text = text[:i] + piece + text[j:]
    return text


def replaced(random: Random, text: str, words: Sequence[str] = WORDS) -> str:
    """``text`` with some of its words replaced by others: mostly good YAML that means something
    else.
    """
    lines = text.split("\n")
    for _ in range(random.randrange(1, 4)):
        k = random.randrange(len(lines))
        pieces = lines[k].split(" ")
        pieces[random.randrange(len(pieces))] = random.choice(words)
        lines[k] = " ".join(pieces)
    return "\n".join(lines)


def number_file(random: Random, _: str) -> str:
    """A method with one coefficient made of signs."""
    number = soup(random, SIGNS, 25).replace("'", "")
    return f"methods: [{{A: [['{number}']], b: [1]}}]"


RADICALS = (
    "1/2 - sqrt(3)/6", "sqrt(2)", "1/sqrt(2)", "cbrt(2)", "cbrt(-2)/2", '"root(2, 4)"', "sqrt(2 + sqrt(2))",
    "sqrt(5)/10", "sqrt(3/4)", "1/(1 - sqrt(3))", "sqrt(-1)", "sqrt(4)", "(1 + sqrt(6))**-3", "sqrt(2 - sqrt(4))",
)  # fmt: skip
"""Radicals as people write them, and some that are rational, or nothing at all."""


class _Writer:
    """Writes one file with the shape of a method file; its coefficients mostly are numbers."""

    def __init__(self, random: Random) -> None:
        self.random = random
        self.radicals: Sequence[str] = random.sample(RADICALS, random.choice((0, 0, 1, 1, 2)))

    def coefficient(self) -> str:
        """A good number, or nearly."""
        random = self.random
        p, q = random.randrange(-4, 13), random.randrange(1, 13)
        plain = (
            str(p),
            f"{p}/{q}",
            f"{p}/{q}",
            f"{p / 8}",
            f"{p}e-{q}",
            "tau",
            "1 - tau",
            f"tau**{q}",
        )
        return random.choice((*plain, *self.radicals))

    def row(self, size: int) -> str:
        """A row of coefficients."""
        return f"[{', '.join(self.coefficient() for _ in range(size))}]"

    def matrix(self, rows: int, columns: int) -> str:
        """A matrix of coefficients."""
        return f"[{', '.join(self.row(columns) for _ in range(rows))}]"

    def butcher(self, rows: int, columns: int) -> str:
        """A and b, and sometimes c."""
        nodes = f", c: {self.row(rows)}" if self.random.random() < 0.3 else ""
        return f"{{A: {self.matrix(rows, columns)}, b: {self.row(columns)}{nodes}}}"

    def methods(self) -> str:
        """Diagonal methods and their transfer."""
        random = self.random
        sizes = [random.randrange(1, 5) for _ in range(random.randrange(1, 4))]
        families = ("gauss", "radau-iia", "lobatto-iiia", "lobatto-iiib", "ssp2")
        methods = [
            self.butcher(s, s)
            if random.random() < 0.6
            else f"{{family: {random.choice(families)}, stages: {s}}}"
            for s in sizes
        ]
        text = f"methods: [{', '.join(methods)}]"
        if len(sizes) == 1:
            return text
        rules = ("collocation", "interpolation", "conjugate-collocation", "symplectic-collocation")
        mixed = "{collocation: tau, interpolation: 1 - tau}"
        rule = random.choice((*rules, mixed, "legendre", "{rule: legendre, degree: 2}"))
        if random.random() < 0.4:
            rule = f'{{default: {rule}, blocks: {{"1,2": {self.matrix(sizes[0], sizes[1])}}}}}'
        structure = random.choice(("general", "semi-separable", "separable", "nystrom"))
        return f"{text}\ntransfer: {rule}" + (
            f"\nstructure: {structure}" if len(sizes) == 2 else ""
        )

    def tableau(self) -> str:
        """Every block spelled out."""
        random = self.random
        sizes = [random.randrange(1, 4) for _ in range(random.randrange(1, 4))]
        blocks = [
            [self.matrix(s, t) if random.random() < 0.9 else "null" for t in sizes] for s in sizes
        ]
        rows = ", ".join(f"[{', '.join(row)}]" for row in blocks)
        return f"tableau: {{A: [{rows}], b: [{', '.join(self.row(s) for s in sizes)}]}}"

    def ark(self) -> str:
        """Shared stages."""
        s, colours = self.random.randrange(1, 5), self.random.randrange(1, 4)
        matrices = ", ".join(self.matrix(s, s) for _ in range(colours))
        return f"ark: {{A: [{matrices}], b: {self.row(s)}}}"

    def prk(self) -> str:
        """A partitioned method."""
        q, p = self.random.randrange(1, 4), self.random.randrange(1, 4)
        structure = self.random.choice(("separable", "nystrom", "general"))
        return f"prk: {{q: {self.butcher(p, q)}, p: {self.butcher(q, p)}}}\nstructure: {structure}"


def written_file(random: Random) -> str:
    """A file of any form with any sizes that fit."""
    writer = _Writer(random)
    lines = [random.choice((writer.methods, writer.tableau, writer.ark, writer.prk))()]
    lines.insert(0, f"parameters: {{tau: {random.choice(('1/2', '1/3', '2', '1', '0'))}}}")
    lines += ["conjugate: true"] if random.random() < 0.2 else []
    lines += ["tolerance: 1e-10"] if random.random() < 0.1 else []
    return "\n".join(lines)


def radical_file(random: Random) -> str:
    """A file with many different radicals: fields of a degree near the limit, where time may be
    short.
    """
    writer = _Writer(random)
    p, q, r = (random.randrange(1, 14) for _ in range(3))
    writer.radicals = (
        f"sqrt({p})/{q}", f"cbrt({q})", f'"root({r}, 4)"', f"sqrt({p} + sqrt({q}))", f"1/(cbrt({q}) - sqrt({r}))",
    )  # fmt: skip
    return f"parameters: {{tau: 1/2}}\n{random.choice((writer.methods, writer.tableau, writer.ark, writer.prk))()}"


def method_file(random: Random, files: Sequence[str]) -> str:
    """One file of any kind."""
    makers: tuple[Callable[[Random, str], str], ...] = (damaged, replaced, replaced, number_file)
    chance = random.random()
    if chance < 0.15:
        return soup(random)
    if chance < 0.35:
        return written_file(random)
    return random.choice(makers)(random, random.choice(files))
