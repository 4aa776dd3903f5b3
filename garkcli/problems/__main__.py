"""``python -m garkcli.problems``: writes sympy's answers about built-in problems."""

from __future__ import annotations

import json
from collections.abc import Iterable
from itertools import combinations

from flint import arb

from garkcli.deadline import checked
from garkcli.problems import problem as problems
from garkcli.problems.builtin import PROBLEMS, problem
from garkcli.problems.deferred import KNOWN, Record, recorded
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.righthandside import RightHandSide, clock, solution, steepness
from garkcli.problems.straightline import code_of
from garkcli.problems.vectorfield import GROUPS, Group, StateLayout, VectorField

TERMS = (1, 2, 3)


def answers(name: str, terms: int) -> Record:
    def work() -> None:
        code_of.cache_clear()
        split = problem(name, terms)
        _ask_all(split)
        _ask_all(split.unsplit())

    return recorded(work)


def _ask_all(of: problems.Problem) -> None:
    problems.texts_of(of)
    groups: tuple[Group, ...] = GROUPS if isinstance(of, Hamiltonian) else ("y",)
    for term in range(len(of.terms)):
        for group in groups:
            _ask_field(problems.field_of(of, term, group), of.layout)
    for k in range(len(problems.conserved_names(of))):
        for is_for_balls in (False, True):
            code_of(problems.conserved(of), problems.unknowns(of), is_for_balls)
        code_of(problems.summands(of, k), problems.unknowns(of), False)
    if isinstance(of, Hamiltonian):
        code_of(of.terms, problems.unknowns(of), False)
        return
    steepness(of)
    if of.exact is not None:
        solution(of, arb(0))


def _ask_field(field: VectorField, layout: StateLayout) -> None:
    if field.is_zero:
        return
    for group in field.depends:
        field.is_linear_in(group)
    _ = field.degree
    for is_for_balls in (False, True):
        code_of(field.components, field.arguments, is_for_balls)
    for count in range(1, len(field.depends) + 1):
        for groups in checked(combinations(field.depends, count)):
            by = [(group, k) for group in groups for k in range(layout.size(group))]
            code_of(field.slopes(by), field.arguments, False)


def answers_of_clock() -> Record:
    def work() -> None:
        code_of.cache_clear()
        of = problem("prothero-robinson", 1)
        assert isinstance(of, RightHandSide)
        _ask_field(clock(of), of.layout)

    return recorded(work)


def _write(name: str, records: Iterable[Record]) -> None:
    made_by_name = {x.name: made for record in records for x, made in record.items()}
    text = json.dumps(made_by_name, indent=1, ensure_ascii=True)
    (KNOWN / f"{name}.json").write_bytes(text.encode("ascii") + b"\n")


def main() -> None:
    for name in PROBLEMS:
        _write(name, [answers(name, terms) for terms in TERMS])
    _write("clock", [answers_of_clock()])


if __name__ == "__main__":
    main()
