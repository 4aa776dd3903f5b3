"""The three small, smooth problems of the programs of ``gark export --test``.

Each is also a problem file, for which ``gark converge`` prints the same errors.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Payload
from garkcli.frozen import Frozen

STEPS = (8, 16, 32, 64)


class Trial(Frozen):
    """A problem with two unknowns.

    Attributes:
        sides: the right-hand sides, pairs of formulas in ``{y1}``, ``{y2}``, ``{t}``, ``{sin}`` and
            ``{cos}``; q' and p' for the separable one.
        final: the solution at ``t_end``, correct to all digits.
        hamiltonian: the terms of the separable one, in x and px.
    """

    name: str
    title: str
    sides: tuple[tuple[str, str], ...]
    t_end: int
    final: tuple[str, str]
    initial: tuple[str, str] = ("1.2", "0.4")
    hamiltonian: tuple[str, ...] = ()

    def formulas(self, side: int, words: Mapping[str, str]) -> tuple[str, str]:
        """A right-hand side in a language with words for y1, y2, t, sin and cos."""
        first, second = self.sides[side]
        return first.format(**words), second.format(**words)

    @property
    def file(self) -> str:
        words = {x: x for x in ("y1", "y2", "t", "sin", "cos")}
        sides = [self.formulas(side, words) for side in range(len(self.sides))]
        form, q, p = ("hamiltonian", "x", "px") if self.hamiltonian else ("rhs", "y1", "y2")
        lines = [
            f"name: {self.title}",
            f"variables: [{'x' if self.hamiltonian else 'y1, y2'}]",
            f"{form}:",
            *(f"  - {x}" for x in self.hamiltonian or [f"{{y1: {a}, y2: {b}}}" for a, b in sides]),
            f"initial: {{{q}: {self.initial[0]}, {p}: {self.initial[1]}}}",
            f"t_end: {self.t_end}",
        ]
        return "".join(f"{x}\n" for x in lines)


WORDS = {"y1": "y[0]", "y2": "y[1]", "t": "t", "sin": "sin", "cos": "cos", "zero": "0.0"}
CPP_WORDS = {**WORDS, "sin": "std::sin", "cos": "std::cos"}
WHOLE = Trial(
    name="whole",
    title="one right-hand side, with time in it",
    sides=(("{y2}*{cos}({t})", "-{sin}({y1})"),),
    t_end=2,
    final=("1.17800823846054054133145213501406815", "-1.43877953451330962805445307202278551"),
)
SPLIT = Trial(
    name="split",
    title="two right-hand sides",
    sides=(("{y2}", "0.3*{sin}({y1})*{y2}"), ("-0.5*{y1}*{y2}", "(1.0 - {y1}*{y1})*{y2} - {y1}")),
    t_end=1,
    final=("1.11251631371073201960701475776329010", "-0.78381339848673613949632823473644073"),
)
SEPARABLE = Trial(
    name="separable",
    title="a pendulum",
    sides=(("{y2}", "-{sin}({y1})"),),
    t_end=2,
    final=("0.20358087395061007056665965504276729", "-1.18067026009027434070547740953813522"),
    hamiltonian=("px**2/2", "-cos(x)"),
)
TRIALS = (WHOLE, SPLIT, SEPARABLE)


def trial_of(payload: Payload) -> Trial:
    if payload.kind == "rk":
        return WHOLE
    if payload.kind == "prk":
        return SEPARABLE
    if payload.size == 2 and not payload.tableau.is_partitioned:
        return SPLIT
    raise CannotExport(f"no problem to test {payload.size} vector fields with", "leave out --test")


def sides(
    payload: Payload, fields: Sequence[int], words: Mapping[str, str]
) -> Sequence[tuple[str, str]]:
    """The right-hand sides of some vector fields; for a pair (q, p) each has one component."""
    trial = trial_of(payload)
    if payload.kind != "prk":
        return [trial.formulas(m, words) for m in fields]
    (q, p), zero = trial.formulas(0, words), words["zero"]
    return [((q, zero), (zero, p))[m] for m in fields]


def command_of(payload: Payload, problem_file: str) -> str:
    """The command with the same errors, for the head of a program."""
    steps = ",".join(f"{trial_of(payload).t_end}/{n}" for n in STEPS)
    taken = f" --{payload.derivation}" if payload.derivation else ""
    return f"gark converge FILE{taken} --problem {problem_file} --steps {steps}"
