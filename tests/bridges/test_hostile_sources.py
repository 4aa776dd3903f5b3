"""Sources made to exhaust or to fool a reader: nothing is run, nothing is raised."""

from __future__ import annotations

import json
import random
import sys
from pathlib import Path
from types import FrameType

import pytest

from garkcli.bridges.readers.registry import all_readers, find_tables, reader_named, readers_for
from garkcli.sources import allowance
from garkcli.sources.found import MAX_LENGTH
from tests.cli.harness import gark
from tests.whole import in_whole

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
    "one word": "classdef",
    "calls": 'A = eval("1")\nb = exec("2")\nA = open("x")\n',
    "a type": "# 2 2 run(`false`)\n0 0 0\n0 0 0\n0 0 0\n",
    "null bytes": "A = [\x000]\nb = [\x001]\n",
    "stages": "ARKodeButcherTable_Create(999999999, 1, 1, c, A, b, d)",
    "indices": "B->A[99999999][99999999] = 1; B->b[99999999] = 1;",
    "zeros": "A = zeros(99999, 99999)\nb = np.zeros((10**9, 10**9))",
    "repetition": "A = [0] * 999999999999\nb = [[0] * 10] * 10**9",
    "steps far away": "def heun(f, y0, t):\n    y = [y0]\n    for i in range(len(t) - 1):\n"
    "        h = t[i+1] - t[i]\n        guess = y[-1] + h*f(t[i], y[-1])\n"
    f"        y.append(y[-1] + h/2*(f(t[i], y[-1]) + f(t[i+{'9' * LONG}], guess)))\n    return y\n",
    "a comprehension that is cut": "k = [f(i, t, y) for* i in eachindex(y)]",
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


AUDITED = {
    "huge.json": (
        f'{{"A": [[0, 0], [1e400, 0]], "b": [1, 0], "c": [0, "1{"0" * 330}.1234567890123456789"]}}',
        "a table: order 1",
    ),
    "blocks.jl": (
        "m = (\n    A = [\n        [[0 0; 1 0], reshape([0, 1], 2, 1)],\n"
        "        [[1//2 1//2], reshape([1//2], 1, 1)],\n        [nothing],\n    ],\n"
        "    b = [[1//2, 1//2], [1], [1]],\n    order = 1,\n)\n",
        "blocks",
    ),
    "registers.jl": (
        "LowStorageRK2NConstantCache([1.2345678e400, 0.5], 0.3, [0.4, 0.2], [0.3, 0.7])\n",
        "a number beyond those of floats",
    ),
    "empty.json": ('{"A": [], "b": [[]], "c": [], "embedded": []}', "there are no weights"),
    "dense.json": (
        '{"A": [[["1"]]], "b": [["1"]], "c": [["1"]], "dense": [[]]}',
        "degree: a whole number",
    ),
    "nodes.json": (
        '{"A": [[[[1]], null], [null, [[1]]]], "b": [[1], [1]], "c": [[1], [1], [1]]}',
        "3 rows of numbers for 2 vector fields",
    ),
    "nystrom.jl": (
        "NystromVITableau([0 0; 1//2 0], [0], [1//2, 1//2], [0, 0], [0, 0], [0, 1])\n",
        "1 weights of positions, 2 of velocities",
    ),
    "powers.jl": (
        "LowStorageRK2NConstantCache([sqrt(2)^90, 0.5], 0.3, [0.4, 0.2], [0.3, 0.7])\n",
        "exponent is larger",
    ),
    "parts.py": ("IMEXTableau([], [], [], [], [], [])\n", "number of stages"),
    "many_names.py": (
        "".join(f"v{i} = 1.5\n" for i in range(5_000))
        + "".join(f"A = [[0, 0], [{i}.5, 0]]\nb = [0, {i}]\n" for i in range(990)),
        "characters of numbers",
    ),
}
"""Tables of a strange size or shape, with a word of what is said of them."""


@pytest.mark.parametrize(
    "name", [pytest.param(x, marks=[in_whole] * (x == "many_names.py")) for x in AUDITED]
)
def test_strange_tables_are_audited(name: str, tmp_path: Path) -> None:
    """Numbers beyond floats, rows that lack blocks, arrays anew among many names: no internal
    fault, and no long work.
    """
    text, word = AUDITED[name]
    (tmp_path / name).write_text(text, encoding="utf-8")
    run = gark("audit", "-v", name, cwd=tmp_path)
    assert run.code in {0, 1, 2}
    assert word in run.out + run.err


def _doubled(line: str, first: str, count: int = 24) -> str:
    """Lines of which each has twice the numbers of the one before."""
    return f"{first}\n" + "".join(line.format(k + 1, k) for k in range(count))


GROWING = {
    "python": _doubled("x{0} = [x{1}, x{1}]\n", "x0 = [1, 1]"),
    "python, entries": "x = [[1], [1]]\n" + "x[0] = [x, x]\n" * 24,
    "python, zeros": "import numpy as np\n" + "x = np.zeros((200, 200))\n" * 50,
    "python, products": f"y = [{'1, ' * 200}]\nq = {'9' * 900}\n" + "x = y*q\n" * 9,
    "python, lists of nothing": _doubled("x{0} = [x{1}, x{1}]\n", "x0 = []"),
    "python, names": f"A = [1]\nq = {'9' * 900}\n" + "".join(f"x{k} = q\n" for k in range(1_400)),
    "python, rows of zeros": "".join(
        f"class C{k}:\n A = [{'[1], ' * 200}]\n b = [{'1, ' * 200}]\n" for k in range(20)
    ),
    "julia": _doubled("x{0} = [x{1}, x{1}]\n", "x0 = [1, 1]"),
    "matlab": _doubled("x{0} = [x{1} x{1}];\n", "x0 = [1 1];"),
    "matlab, cells": _doubled("x{0} = {{x{1}, x{1}}};\n", "x0 = {1, 1};"),
    "matlab, entries": "".join(f"m{k}.A(199,199)=1; m{k}.b(199)=1;\n" for k in range(50)),
    "mathematica": _doubled("x{0} = {{x{1}, x{1}}};\n", "x0 = {1, 1};"),
    "c": _doubled("double x{0}[] = {{x{1}, x{1}}};\n", "double x0[] = {1, 1};"),
    "c, entries": "".join(f"void f{k}() {{A[199][199] = 1; b[199] = 1;}}\n" for k in range(50)),
    "c, arrays": "void f() {double A[200][200] = {{1}};}\n" * 50,
    "python, branches": "A = [" + "0.5," * 2_000 + "]\n" + "if c:\n y = 0.5\n" * 50,
    "csv": ("1," * 200 + "1\n" + "1\n" * 199 + ",1" * 200 + "\n\n") * 2,
    "json": json.dumps([{"A": [[1]] * 200, "b": [1] * 200}] * 20),
    "latex": (
        r"\begin{array}{c|c}" + "0&" * 200 + r"0\\" * 200 + r"\hline" + "&1" * 200 + r"\end{array}"
    )
    * 2,
}
"""Short sources whose numbers are many when they are written out."""


@pytest.mark.parametrize("name", GROWING)
def test_what_a_short_source_says_is_counted_before_it_is_written_out(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A source that becomes too large has a line that says so, and no table."""
    most_of_all = 60_000
    monkeypatch.setattr(allowance, "MAX_WRITTEN", most_of_all)
    monkeypatch.setattr(allowance, "FREE", 20_000)
    source = GROWING[name]
    found = find_tables(source, "x", [reader_named(name.partition(",")[0])])
    most = min(allowance.FREE + allowance.TIMES * len(source), most_of_all)
    if name in {"csv", "json", "latex"}:
        most = most_of_all
    assert [table.trouble for table in found] == [
        f"the source has more than {most} characters of numbers when its names and zeros are "
        "written out"
    ]


def test_a_list_that_two_names_have_is_two_lists() -> None:
    """An entry that is assigned to one name is not one of the other, and no list holds itself."""
    text = "a = [[0, 0], [1, 0]]\nA = a\na[1] = [9, 9]\nA[0] = A[0]\nb = [1/2, 1/2]\n"
    (table,) = find_tables(text, "x.py", [reader_named("python")])
    assert table.A == (((("0", "0"), ("1", "0")),),)


LONG_WAYS = {
    "c": ["a[", "a->", "a.b.", "a1->A[0][0] = 1;"],
    "julia": ["Tableau{", "a.b.", "x = -"],
    "matlab": ["a."],
    "mathematica": ["x = Sqrt["],
}
"""Pieces that a reader went over again and again."""


@pytest.mark.parametrize(
    ("reader", "piece"), [(name, piece) for name, pieces in LONG_WAYS.items() for piece in pieces]
)
def test_twice_the_source_is_twice_the_work(reader: str, piece: str) -> None:
    """Of a source of many open brackets, signs or members, by the calls that reading it takes."""
    of_one, of_two = (_calls(reader, piece * count) for count in (400, 800))
    assert of_two < 2.2 * of_one


def _calls(reader: str, text: str) -> int:
    """How many functions are called while a text is read."""
    count = 0

    def profile(frame: FrameType, event: str, given: object) -> None:
        nonlocal count
        del frame, given
        count += event in {"call", "c_call"}

    find_tables("", "x", [reader_named(reader)])
    sys.setprofile(profile)
    try:
        find_tables(text, "x", [reader_named(reader)])
    finally:
        sys.setprofile(None)
    return count


@in_whole
@pytest.mark.parametrize("arrays", ["A = [[0]]\n b = [1]", "A = B = U = [[0]]"])
def test_tables_have_a_limit(arrays: str) -> None:
    """What stands behind the last table is not passed over in silence, nor are a million tables of
    another kind told.
    """
    many = f"def f():\n {arrays}\n" * 1_001
    (table,) = find_tables(many, "x.py", [reader_named("python")])
    assert table.trouble == "the source has more than 1000 tables"


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
    assert run.err.startswith("gark: no table found in -")


@in_whole
def test_the_command_names_the_line_at_which_a_source_is_too_large() -> None:
    """Exit code 2, the line and the limit."""
    run = gark("import", "-", "--from", "python", stdin=GROWING["python"])
    assert run.code == 2
    assert run.err.startswith("gark: <stdin>:17: no method: the source has more than 1")
