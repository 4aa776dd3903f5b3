"""Arithmetic of Julia as Julia has it, where its grammar takes it for something else."""

from __future__ import annotations

import pytest

from garkcli.sources.found import FoundTable
from garkcli.sources.languages.julia import find

MEANT = {
    "[1 -2]": ("1", "-2"),
    "[1 - 2 3]": ("-1", "3"),
    "[1 (2)]": ("1", "2"),
    "[5//6 -8//3]": ("5/6", "-8/3"),
    "[-(big(1)//2) -(1//3)]": ("-1/2", "-1/3"),
    "[3*(2)^2 5^(1/2)]": ("12", "sqrt(5)"),
    "[-(1 + 1)^2 2*√(3)]": ("-4", "2*sqrt(3)"),
    "[2sqrt(3) -2^2]": ("2*sqrt(3)", "-4"),
    "[1//2//3 6/3*2]": ("1/6", "4"),
    "[2(1//4) +1]": ("1/2", "1"),
}


@pytest.mark.parametrize("text", MEANT)
def test_a_row_of_a_matrix(text: str) -> None:
    """Blanks part entries before a sign or a bracket, and powers hold before products."""
    rows = text.strip("[]")
    (table,) = find(f"A = [{rows}\n-1 2]\nb = [1, 0]\n", "x.jl")
    assert block(table)[0] == MEANT[text]
    assert block(table)[1] == ("-1", "2")


def block(table: FoundTable) -> tuple[tuple[str, ...], ...]:
    """The matrix of a table."""
    assert not table.trouble
    found = table.A[0][0]
    assert found is not None
    return found


def test_what_is_not_known_is_told_and_is_no_zero() -> None:
    """An entry that a function computes leaves the table unread, with the place and the reason."""
    text = "A = [0 0\n compute(2) 0]\nb = [1//2, 1//2]\nc = [0, 1]\n"
    (table,) = find(text, "x.jl")
    assert table.trouble == "the call compute, line 1, is not known"
    assert table.b == ()


def test_both_ways_of_a_branch_are_tables() -> None:
    """Each arm of a branch may complete a table; what it assigns is not known behind it."""
    text = "b = [1//2, 1//2]\nif precise\n    {0}1.0{1}\nelse\n    {0}2.0{1}\nend\n"
    first, second = find(text.format("A = [0 0; ", " 0]"), "x.jl")
    assert (block(first)[1], block(second)[1]) == (("1", "0"), ("2", "0"))
    (table,) = find(text.format("a = ", "") + "A = [0 0; a 0]\n", "x.jl")
    assert table.trouble == "assigned in one of several branches, line 5, is not known"
