"""The list of built-in problems: what is made from it is made from all of it."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest

from garkcli.errors import UsageProblem
from garkcli.problems.builtin import PROBLEMS, BuiltIn, built_in, check_seed, hamiltonian
from garkcli.problems.builtin import problem as made
from garkcli.problems.hamiltonian import Hamiltonian
from garkcli.problems.problem import Problem

PAGE = Path(__file__).resolve().parents[2] / "docs" / "problems.md"
BEGIN, END = "<!-- problems -->\n", "<!-- end of problems -->\n"


def row(entry: BuiltIn) -> str:
    """The row of one problem in the table of the page."""
    cells = (f"`{entry.name}`", entry.formula.replace("|", r"\|"), entry.sees)
    return f"| {' | '.join(cells)} |\n"


def test_the_page_has_every_problem() -> None:
    """docs/problems.md shows the table that the list makes; GARK_UPDATE_SNAPSHOTS writes it."""
    page = PAGE.read_text(encoding="utf-8")
    head, begin, rest = page.partition(BEGIN)
    found, end, tail = rest.partition(END)
    assert begin
    assert end
    table = "| `--problem` | H, or ẏ | sees |\n|---|---|---|\n" + "".join(
        map(row, PROBLEMS.values())
    )
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        PAGE.write_text(head + begin + table + end + tail, encoding="utf-8")
        return
    assert found == table


@pytest.mark.parametrize("entry", PROBLEMS.values(), ids=lambda x: x.name)
@pytest.mark.parametrize("terms", [2, 3])
def test_entries_are_whole(entry: BuiltIn, terms: int) -> None:
    """Each is found by its name, has the terms that are asked for, and one seed makes one problem.

    The sum of the terms does not depend on their number unless the coefficients do.
    """
    problem = made(entry.name, terms)
    assert built_in(entry.name) is entry
    assert problem.name == entry.name
    assert len(problem.terms) == terms
    assert len(problem.initial) == problem.layout.unknowns
    assert entry.make(terms, 1) == problem
    assert (entry.make(terms, 2) != problem) is entry.takes_seed
    if not entry.takes_seed:
        for whole, alone in zip(total(problem), total(made(entry.name, 1)), strict=True):
            assert (whole - alone).expand() == 0


def total(problem: Problem) -> tuple[Any, ...]:
    """H, or the sum of the right-hand sides."""
    return (problem.energy,) if isinstance(problem, Hamiltonian) else problem.total


def test_seeds_are_for_random_coefficients() -> None:
    """A seed that would change nothing is refused, for files too; none is always right."""
    for entry in PROBLEMS.values():
        check_seed(entry.name, None)
        if entry.takes_seed:
            check_seed(entry.name, 3)
        else:
            with pytest.raises(UsageProblem, match=f"generic.*not for {entry.name}"):
                check_seed(entry.name, 3)
    with pytest.raises(UsageProblem, match=r"not for a\.yaml"):
        check_seed("a.yaml", 3)


def test_what_is_close_is_proposed() -> None:
    """An unknown name, with the nearest one."""
    with pytest.raises(UsageProblem, match="no problem 'penduluum'") as caught:
        hamiltonian("penduluum", 1)
    assert "pendulum" in str(caught.value.help)
