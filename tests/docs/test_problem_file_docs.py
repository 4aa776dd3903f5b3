"""docs/problem-file.md is true: its files load, its words are those of the program, its commands
run.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from garkcli.exact.formula import FUNCTIONS, parse_formula
from garkcli.problems.files.formulas import PLACES
from garkcli.problems.files.keys import KEYS, MAX_INVARIANTS, MAX_TERMS, MAX_VARIABLES
from garkcli.problems.files.load import loads_problem

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "problem-file.md"
TEXT = PAGE.read_text(encoding="utf-8")
FILES = re.findall(r"^```yaml\n(.*?)^```$", TEXT, re.DOTALL | re.MULTILINE)


@pytest.mark.parametrize("text", FILES)
def test_files_load(text: str) -> None:
    """Each example is a whole problem file."""
    assert loads_problem(text).terms


def test_the_example_is_the_built_in_problem() -> None:
    """Kepler by eccentricity starts where the built-in one does."""
    from garkcli.problems.builtin import hamiltonian

    own, built_in = loads_problem(FILES[0]), hamiltonian("kepler", 2)
    assert own.terms == built_in.terms
    assert own.initial == built_in.initial
    assert own.invariants == built_in.invariants


def test_words_are_those_of_the_program() -> None:
    """Keys, functions and limits."""
    for word in (*KEYS, *FUNCTIONS):
        assert re.search(rf"`{word}(: 1)?`", TEXT), word
    assert f"{MAX_VARIABLES} variables, {MAX_TERMS} terms, {MAX_INVARIANTS} invariants" in TEXT
    assert PLACES == 60
    assert "sixty decimals" in TEXT


@pytest.mark.parametrize("code", ["[vx**2/2, vx**2/2]", "vx**2/2 + vx**2/2"])
def test_two_readings_of_a_sum(code: str) -> None:
    """What the page says of terms with velocities of their own."""
    assert code in TEXT.replace("\n", " ")
    (p,) = (
        loads_problem(f"{{variables: [x], lagrangian: {code}, initial: {{x: 0, px: 1}}}}")
        .unsplit()
        .terms
    )
    assert str(p) == ("px**2" if code.startswith("[") else "px**2/4")


def test_formulas_of_the_page_are_formulas() -> None:
    """The powers and roots that it gives as examples."""
    for text in (
        "x**2",
        "x**-1",
        "x**(3/2)",
        "x**0.5",
        "x**n",
        "cbrt(2)",
        "root(2, 5)",
        "x**(1/3)",
    ):
        assert f"`{text}`" in TEXT
        parse_formula(text)
