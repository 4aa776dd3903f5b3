"""Method files and numbers that nobody would write, from a random source: the input of every fuzz run."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from random import Random

ROOT = Path(__file__).resolve().parents[2]
WORDS = (
    "methods", "transfer", "tableau", "ark", "prk", "structure", "linear", "parameters", "tolerance", "expect",
    "family", "stages", "A", "b", "c", "q", "p", "default", "blocks", '"1,2"', '"2,1"', "gauss", "lobatto-iiia",
    "radau-iia", "rk4", "heun", "collocation", "interpolation", "conjugate-collocation", "symplectic-collocation",
    "separable", "semi-separable", "nystrom", "general", "order", "pair-order", "C", "symplectic", "conjugate",
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
    return tuple(file.read_bytes().decode("utf-8", "replace") for file in files if file.stat().st_size < 4000)


def soup(random: Random, signs: Sequence[str] = WORDS, longest: int = 60) -> str:
    """Words one after the other."""
    return "".join(random.choice(signs) for _ in range(random.randrange(longest)))


def damaged(random: Random, text: str) -> str:
    """``text`` with a few pieces cut, doubled, swapped or replaced."""
    for _ in range(random.randrange(1, 6)):
        i, j = sorted((random.randrange(len(text) + 1), random.randrange(len(text) + 1)))
        j = min(j, i + random.choice((1, 3, 10, 100)))
        piece = random.choice(("", text[i:j] * 2, random.choice(WORDS), chr(random.randrange(0x3000)), text[j:i]))
        text = text[:i] + piece + text[j:]
    return text


def replaced(random: Random, text: str) -> str:
    """``text`` with some of its words replaced by others: mostly good YAML that means something else."""
    lines = text.split("\n")
    for _ in range(random.randrange(1, 4)):
        k = random.randrange(len(lines))
        words = lines[k].split(" ")
        words[random.randrange(len(words))] = random.choice(WORDS)
        lines[k] = " ".join(words)
    return "\n".join(lines)


def number_file(random: Random, _: str) -> str:
    """A method with one coefficient made of signs."""
    number = soup(random, SIGNS, 25).replace("'", "")
    return f"methods: [{{A: [['{number}']], b: [1]}}]"


def method_file(random: Random, files: Sequence[str]) -> str:
    """One file of any kind."""
    makers: tuple[Callable[[Random, str], str], ...] = (damaged, replaced, replaced, number_file)
    if random.random() < 0.15:
        return soup(random)
    return random.choice(makers)(random, random.choice(files))
