"""The problem that was stepped, in one line and as rows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from garkcli.constructions.nystrom import is_nystrom
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.oscillator import Oscillator
from garkcli.problems.problem import Problem, texts_of
from garkcli.problems.righthandside import RightHandSide
from garkcli.tell.facts import Json, Kind, Level, Row, Rows, maybe, via
from garkcli.tell.kinds import EXACT, TEXT
from garkcli.tell.parts import SAID

if TYPE_CHECKING:
    from garkcli.backward.energy import ModifiedRun
    from garkcli.convergence.result import Convergence
    from garkcli.longtime.history import LongRun

Stepped: TypeAlias = Oscillator | Problem
P = TypeVar("P", Oscillator, Hamiltonian, RightHandSide)

_LONGEST = 80
"""Longer terms are counted."""


def describe(problem: Stepped) -> str:
    if isinstance(problem, Oscillator):
        energies = [_energy(k, v) for k, v in problem.shares]
        return f"q̈ = −ω²q, ω = {problem.omega}; {', '.join(_numbered('H', energies))}"
    name, variables = problem.name, ", ".join(problem.variables)
    if isinstance(problem, Hamiltonian):
        texts = list(map(_formula, texts_of(problem)))
        if _is_short(texts):
            return f"{name}; {', '.join(_numbered('H', texts))}"
        if len(texts) == 1:
            return f"{name}, a single H of {variables} and their momenta"
        return f"{name}, H in {len(texts)} terms of {variables} and their momenta"
    if problem.stiffness is not None:
        name += f", stiffness {problem.stiffness}"
    sides = [", ".join(map(_formula, term)) for term in texts_of(problem)]
    fields = _numbered("f", [f"({x})" if problem.dimension > 1 else x for x in sides])
    if _is_short(fields):
        return f"{name}; {', '.join(fields)}"
    count = f"{len(fields)} right-hand sides" if len(fields) > 1 else "one right-hand side"
    return f"{name}, {count} of {variables}"


def _numbered(letter: str, texts: Sequence[str]) -> list[str]:
    if len(texts) == 1:
        return [f"{letter}: {texts[0]}"]
    return [f"{letter}{{{l}}}: {text}" for l, text in enumerate(texts, start=1)]


def _energy(k: object, v: object) -> str:
    terms = []
    for share, energy in ((k, "½p²"), (v, "½ω²q²")):
        if share != 0:
            terms.append(energy if share == 1 else f"{share}·{energy}")
    return " + ".join(terms) or "0"


def _formula(text: str) -> str:
    return text.replace("**", "^")


def _is_short(texts: Sequence[str]) -> bool:
    return sum(map(len, texts)) <= _LONGEST


_LISTS: Kind[Sequence[Sequence[object]]] = Kind(
    Json(S.array(S.array(S.TEXT)), lambda xs, _: [[str(x) for x in term] for term in xs])
)
_FORMULAS: Kind[Sequence[object]] = Kind(Json(S.array(S.TEXT), lambda xs, _: [str(x) for x in xs]))


Run: TypeAlias = "Convergence | LongRun | ModifiedRun"


def _stepped(kind: type[P], terms: Rows[P]) -> Rows[Run]:
    def problem(x: Run) -> P | None:
        return x.problem if isinstance(x.problem, kind) else None

    return [
        Row("problem", TEXT, lambda x: x.problem.name, Level.DATA),
        Row(
            "problem_in_words",
            SAID,
            lambda x: f"{describe(x.problem)}; to t = {x.t_end}",
            label="problem",
        ),
        Row("colours_in_words", SAID, driving, label="colours"),
        *via(problem, terms),
    ]


def driving(run: Run) -> str:
    """The part of the Hamiltonian that each colour steps; empty if known otherwise."""
    method, problem = run.method, run.problem
    if method is None or isinstance(problem, RightHandSide):
        return ""
    terms = problem.shares if isinstance(problem, Oscillator) else problem.terms
    if method.tableau.is_partitioned or is_nystrom(method.tableau) or len(terms) == 1:
        return ""
    return "colour l steps the whole vector field of H{l}"


STEPPED: dict[type[Stepped], Rows[Run]] = {
    Oscillator: _stepped(
        Oscillator,
        (
            Row("omega", EXACT, lambda x: x.omega, Level.DATA),
            Row("split", _LISTS, lambda x: x.shares, Level.DATA),
        ),
    ),
    Hamiltonian: _stepped(Hamiltonian, (Row("hamiltonian", _FORMULAS, texts_of, Level.DATA),)),
    RightHandSide: _stepped(
        RightHandSide,
        (
            Row("right_hand_sides", _LISTS, texts_of, Level.DATA),
            maybe("stiffness", EXACT, lambda x: x.stiffness, Level.DATA),
        ),
    ),
}
"""For programs: ω and shares (k_l, v_l) of each term, terms H^{l}, or components of f^{l}."""
