"""Tables in sources of every format that is read: which are found, where, with which numbers."""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli import loads
from garkcli.bridges.collecting import TableResult, collected
from garkcli.bridges.importing import entry_text
from garkcli.bridges.readers.registry import all_readers, find_tables, readers_for, suffixes
from garkcli.bridges.sources import source_files
from tests.whole import in_whole

SOURCES = Path(__file__).parent / "sources"
FOUND = {
    ("heun_euler.def", 1): ("MY_HEUN_EULER_2_1_2", 1, 2, 1),
    ("heun_euler.def", 12): ("MY_SDIRK_2_1_2", 1, 2, 1),
    ("kutta.csv", 1): ("kutta", 1, 3, None),
    ("kutta.f90", 8): ("ralston", 1, 2, None),
    ("kutta.f90", 15): ("kutta_step", 1, 3, None),
    ("Kutta.cs", 6): ("Kutta", 1, 3, None),
    ("Kutta.cs", 18): ("Ralston", 1, 2, None),
    ("kutta.go", 11): ("Kutta", 1, 3, None),
    ("kutta.go", 19): ("ralston", 1, 2, None),
    ("kutta.m", 3): ("kutta", 1, 3, None),
    ("kutta.m", 11): ("imex", 2, 2, None),
    ("kutta.ts", 4): ("kutta", 1, 3, None),
    ("kutta.ts", 14): ("Ralston", 1, 2, None),
    ("lists.wl", 2): ("Ralston", 1, 2, 1),
    ("lists.wl", 3): ("Midpoint", 1, 2, None),
    ("lists.wl", 4): ("gauss", 1, 4, None),
    ("lists.wl", 9): ("", 1, 2, None),
    ("methods.ipynb", 19): ("", 1, 2, None),
    ("methods.rs", 18): ("kutta", 1, 3, None),
    ("methods.rs", 25): ("Heun", 1, 2, None),
    ("Ralston.java", 6): ("Ralston", 1, 2, None),
    ("paper.tex", 1): ("", 1, 2, 1),
    ("paper.tex", 7): ("", 2, 2, None),
    ("printed.txt", 1): ("", 1, 2, 1),
    ("ralston.c", 10): ("ralston_euler", 1, 2, 1),
    ("ralston.c", 14): ("kutta", 1, 3, None),
    ("ralston.tsv", 1): ("ralston", 1, 2, None),
    ("register.cpp", 6): ("imex-midpoint", 2, 2, None),
    ("register.cpp", 12): ("kutta3", 1, 3, 2),
    ("register.cpp", 17): ("sdirk2", 1, 2, None),
    ("register.cpp", 21): ("verlet", 2, 2, None),
    ("rklab.m", 7): ("ERK-2-1", 1, 2, 1),
    ("rklab.m", 14): ("SDIRK-2-2", 1, 2, None),
    ("solvers.py", 9): ("BogackiShampine", 1, 3, 2),
    ("solvers.py", 23): ("heun", 1, 2, None),
    ("solvers.py", 31): ("KUTTA", 1, 3, None),
    ("rotated.json", 1): ("a midpoint rule for two parts", 2, 2, None),
    ("table.json", 1): ("midpoint", 1, 2, None),
    ("tableaus.jl", 10): ("constructRalston", 1, 2, 1),
    ("tableaus.jl", 20): ("constructBig", 1, 2, None),
    ("tableaus.jl", 22): ("imex", 2, 2, None),
}
"""By file and line: the name, the colours, the order, the embedded order."""


@pytest.fixture(scope="module")
def results() -> dict[tuple[str, int], TableResult]:
    """What is found in the folder of sources, by file and line."""
    found = {}
    for result in collected(source_files([str(SOURCES)])):
        table = result.table
        found[Path(table.source).name, table.line] = result
    return found


@in_whole
def test_every_table_is_found(results: dict[tuple[str, int], TableResult]) -> None:
    """Each at its line with its name, its orders as the certificate has them; nothing else is
    taken for a table: neither a linear system nor a table of words.
    """
    told = {}
    for place, result in results.items():
        method = result.method
        assert method is not None, result.trouble
        embedded = method.embedded_order
        told[place] = (
            result.table.name,
            result.table.colours,
            method.order.order,
            None if embedded is None else embedded.order,
        )
    assert told == FOUND


@in_whole
def test_every_reader_has_a_source() -> None:
    """No format is left out of this test."""
    used = {result.table.format for result in collected(source_files([str(SOURCES)]))}
    assert used == set(all_readers())


@pytest.mark.parametrize(
    "ending", ["c", "cs", "cuh", "for", "go", "inc", "ipynb", "java", "mjs", "pyx", "rs", "ts"]
)
def test_endings_choose_a_language(ending: str) -> None:
    """In a folder such files are read, each by the readers of its language alone."""
    assert f".{ending}" in suffixes()
    assert len(readers_for(f"x.{ending}")) < len(all_readers()) / 2


INCLUDED = {
    "c": "static const double A[2][2] = {{0, 0}, {2.0/3, 0}};\nstatic const double b[2] = {.25, .75};\n",
    "fortran": "      real A(2,2), b(2)\nC     of Ralston\n      A = 0\n      A(2,1) = 2.0/\n"
    "     &  3.0\n      b = [0.25, 0.75]\n",
}


@pytest.mark.parametrize("language", INCLUDED)
def test_what_is_included_is_of_one_language(language: str) -> None:
    """C and Fortran include files with the same ending: what is one is not read as the other."""
    found = find_tables(INCLUDED[language], "x.inc", readers_for("x.inc"))
    assert [(x.format, x.trouble, x.b) for x in found] == [(language, "", (("1/4", "3/4"),))]


RALSTON = "A: [[], [2/3]]\nb: [1/4, 3/4]\n"
KUTTA = "A: [[], [1/2], [-1, 2]]\nb: [1/6, 2/3, 1/6]\n"
SDIRK = """\
parameters: {g: 1 - sqrt(2)/2}
A: [[g], [1 - g, g]]
b: [1 - g, g]
"""
SAME = {
    ("ralston.c", 10): RALSTON,
    ("tableaus.jl", 10): RALSTON,
    ("tableaus.jl", 20): RALSTON,
    ("lists.wl", 2): RALSTON,
    ("rklab.m", 7): RALSTON,
    ("paper.tex", 1): RALSTON,
    ("kutta.f90", 8): RALSTON,
    ("kutta.f90", 15): KUTTA,
    ("ralston.c", 14): KUTTA,
    ("register.cpp", 12): KUTTA,
    ("kutta.m", 3): KUTTA,
    ("kutta.ts", 4): KUTTA,
    ("kutta.ts", 14): RALSTON,
    ("kutta.go", 11): KUTTA,
    ("kutta.go", 19): RALSTON,
    ("Kutta.cs", 6): KUTTA,
    ("Kutta.cs", 18): RALSTON,
    ("kutta.csv", 1): KUTTA,
    ("solvers.py", 31): KUTTA,
    ("heun_euler.def", 12): SDIRK,
    ("rklab.m", 14): SDIRK,
}


@pytest.mark.parametrize("place", SAME, ids=lambda x: f"{x[0]}:{x[1]}")
def test_numbers_are_exact(
    results: dict[tuple[str, int], TableResult], place: tuple[str, int]
) -> None:
    """Fractions, products of constants and roots are what they are, in every language."""
    found = results[place].method
    assert found is not None
    wanted = loads(SAME[place])
    assert str(found.method.A) == str(wanted.A)
    assert str(found.method.b) == str(wanted.b)
    assert str(found.method.c) == str(wanted.c)


def test_a_method_that_is_first_same_as_last(results: dict[tuple[str, int], TableResult]) -> None:
    """SciPy leaves out the last stage, whose weight is the last one of E: it is there again."""
    found = results["solvers.py", 9].method
    assert found is not None
    assert str(found.method.A[3]) == "(2/9, 1/3, 4/9, 0)"
    assert str(found.method.embedded) == "((7/24, 1/4, 1/3, 1/8),)"


def test_numbers_keep_their_digits() -> None:
    """Long decimals stay as they are printed, short ones and quotients are fractions."""
    assert entry_text("0.3333333333333333") == "0.3333333333333333"
    assert entry_text("1.0/3.0") == "1/3"
    assert entry_text("2.500000000000000e-01") == "1/4"
    assert entry_text("123456789012345/9876543210987654321").count("/") == 1
