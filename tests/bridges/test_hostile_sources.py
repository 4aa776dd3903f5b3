"""Sources made to exhaust or to fool a reader: nothing is run, nothing is raised."""

from __future__ import annotations

import random
from pathlib import Path

import pytest

from garkcli.bridges.readers.registry import all_readers, find_tables, readers_for
from garkcli.bridges.readers.scalars import MAX_LENGTH
from tests.cli.harness import gark

SOURCES = sorted((Path(__file__).parent / "sources").iterdir())
LONG = 5_000
HOSTILE = {
    "open brackets": "A = " + "[" * LONG,
    "open braces": "A = " + "{" * LONG + "}" * LONG,
    "parentheses": "A = [" + "(" * LONG + "1" + ")" * LONG + "]",
    "signs": "A = [" + "-" * LONG + "1]\nb = [1]",
    "quotes": '"\\' * LONG,
    "single quotes": "'" * LONG,
    "block comments": "/*" * LONG + "(*" * LONG + "#=" * LONG + "%{" * LONG,
    "digits": "b = [" + "9" * LONG + "]",
    "exponents": "b = [1e" + "9" * LONG + "]; A = [2^9^9^9^9]",
    "commas": "1," * LONG,
    "ampersands": "\\begin{array}{c|c}" + "&" * LONG + "\\end{array}",
    "arrays": "\\begin{array}" * 2_000,
    "columns": "\\begin{array}{" + "*{999}{c}" * 500 + "}\\end{array}",
    "fractions": "\\begin{array}{c|c}" + "\\frac" * LONG + "\\\\\\hline&1\\end{array}",
    "nested lists": '{"A": ' * 2_000,
    "doubling": "#define A0 (1+1)\n"
    + "".join(f"#define A{k + 1} (A{k}*A{k})\n" for k in range(60))
    + "double A[1][1] = {{A60}}, b[1] = {1};",
    "a power tower": "a = 2\n" + "".join(f"a = a*a + {k}\n" for k in range(60)),
    "names": "import os\nA = os.system('false')\nb = __import__('os')\n",
    "calls": 'A = eval("1")\nb = exec("2")\nA = open("x")\n',
    "a type": "# 2 2 run(`false`)\n0 0 0\n0 0 0\n0 0 0\n",
    "null bytes": "A = [\x000]\nb = [\x001]\n",
    "stages": "ARKodeButcherTable_Create(999999999, 1, 1, c, A, b, d)",
    "indices": "B->A[99999999][99999999] = 1; B->b[99999999] = 1;",
    "zeros": "A = zeros(99999, 99999)\nb = np.zeros((10**9, 10**9))",
    "repetition": "A = [0] * 999999999999\nb = [[0] * 10] * 10**9",
    "surrogates": "b = ['\udcff']",
    "slices": "A = [0]\nA[0:9**9**9] = [1]\nb = A[10**10**10]\n",
}


@pytest.mark.parametrize("name", HOSTILE)
def test_nothing_is_raised(name: str) -> None:
    """Every reader comes back from every one of them, with no table of its making."""
    for reader in all_readers().values():
        for table in reader.find(HOSTILE[name], "x"):
            texts = [x for row in table.b for x in row]
            assert all(len(x) <= MAX_LENGTH for x in texts)


@pytest.mark.parametrize("path", SOURCES, ids=lambda x: x.name)
def test_damaged_sources(path: Path) -> None:
    """Cut, doubled, exchanged and foreign pieces: readers find what they find, and raise
    nothing.
    """
    text = path.read_text(encoding="utf-8")
    draw = random.Random(path.name)
    for _ in range(12):
        pieces = list(text)
        for _ in range(draw.randint(1, 8)):
            place = draw.randrange(len(pieces))
            length = draw.randint(0, 30)
            sign = draw.choice('{}[]()";,&\\|/*#%=-\n\t9.e_A\x00')
            pieces[place : place + length] = sign * draw.randint(0, 3)
        damaged = "".join(pieces)
        find_tables(damaged, path.name, readers_for(path.name))


@pytest.mark.parametrize("name", ["names", "calls", "doubling"])
def test_the_command_says_what_is_missing(name: str) -> None:
    """A source without a table exits 2 with the formats that are read, and no traceback."""
    run = gark("import", "-", "--from", "python", stdin=HOSTILE[name])
    assert run.code == 2
    assert run.out == ""
    assert run.err.startswith("gark: no table is found in -")
