"""gark audit: every planted error is found, and none is invented."""

from __future__ import annotations

import json
import re
import shutil
from decimal import Decimal
from pathlib import Path

import jsonschema
import pytest

from garkcli.bridges.audit import audited
from garkcli.errors import UsageProblem
from garkcli.report.schemas import report_schema
from garkcli.sources import evaluate
from tests.cli.harness import gark
from tests.whole import in_whole, sample

SOURCES = Path(__file__).parent / "sources"
PLANTED = {
    "c, a digit": ("ralston.c", "{-1, 2}", "{-1, 2.5}", "order"),
    "c, a sign": ("ralston.c", "{-1, 2}", "{1, 2}", "order"),
    "c, a node": ("ralston.c", "{0, .5, 1}", "{0, .6, 1}", "nodes"),
    "c, an embedded weight": ("ralston.c", "{1.0, 0.0}", "{0.9, 0.0}", "embedded-weights"),
    "c, the order": ("ralston.c", "kutta_order = 3", "kutta_order = 4", "order"),
    "c, a constant": ("ralston.c", "SUN_RCONST(2.0) /", "SUN_RCONST(1.0) /", "order"),
    "c, missing numbers": (
        "ralston.c",
        "sunrealtype A[4] = {SUN_RCONST(0.0), ",
        "sunrealtype A[4] = {",
        "transposed",
    ),
    "def, a digit": (
        "heun_euler.def",
        "A[1][0] = SUN_RCONST(1.0);",
        "A[1][0] = SUN_RCONST(1.1);",
        "order",
    ),
    "def, transposed": (
        "heun_euler.def",
        "A[1][0] = SUN_RCONST(1.0) - gamma;",
        "A[0][1] = SUN_RCONST(1.0) - gamma;",
        "transposed",
    ),
    "def, a node": (
        "heun_euler.def",
        "c[1] = SUN_RCONST(1.0);\n    return B;\n  })\nARK",
        "c[1] = SUN_RCONST(0.5);\n    return B;\n  })\nARK",
        "nodes",
    ),
    "def, a root": (
        "heun_euler.def",
        "SUNRsqrt(SUN_RCONST(2.0))",
        "SUNRsqrt(SUN_RCONST(3.0))",
        "order",
    ),
    "def, p": ("heun_euler.def", "B->p = 1", "B->p = 2", "embedded-order"),
    "def, d": (
        "heun_euler.def",
        "d[0] = SUN_RCONST(1.0)",
        "d[1] = SUN_RCONST(0.9)",
        "embedded-weights",
    ),
    "petsc, a digit": ("register.cpp", "{-1, 2, 0}", "{-1, 3, 0}", "order"),
    "petsc, a weight": (
        "register.cpp",
        "RC(2.0) / 3, RC(1.0) / 6}",
        "RC(2.0) / 3, RC(1.0) / 5}",
        "order",
    ),
    "petsc, an embedded weight": (
        "register.cpp",
        "bembed[3] = {0, 1, 0}",
        "bembed[3] = {0, 1, 1}",
        "embedded-weights",
    ),
    "petsc, implicit first": ("register.cpp", "0, 0, 0, 0.5}, A", "0, 0, 0, 0.25}, A", "order"),
    "petsc, the order": ("register.cpp", '"imex-midpoint", 2', '"imex-midpoint", 3', "order"),
    "petsc, a digit far behind": (
        "register.cpp",
        "0.29289321881345254",
        "0.29289321882345254",
        "order",
    ),
    "petsc, symplectic": ("register.cpp", "c[2] = {0.5, 0.5}", "c[2] = {0.4, 0.6}", "order"),
    "scipy, a digit": ("solvers.py", "[0, 3 / 4, 0]", "[0, 2 / 4, 0]", "order"),
    "scipy, a node": ("solvers.py", "[0, 1 / 2, 3 / 4]", "[0, 1 / 2, 2 / 4]", "nodes"),
    "scipy, E": ("solvers.py", "[5 / 72, -1", "[5 / 72, 1", "embedded-weights"),
    "scipy, the order": ("solvers.py", "order = 3\n", "order = 4\n", "order"),
    "scipy, its estimate": (
        "solvers.py",
        "error_estimator_order = 2",
        "error_estimator_order = 3",
        "embedded-order",
    ),
    "scipy, n_stages": ("solvers.py", "n_stages = 3", "n_stages = 4", "shape"),
    "python, a sign": ("solvers.py", "[-1, 2]]", "[1, 2]]", "order"),
    "rklab, a digit": ("rklab.m", "[0, 0; 2/3, 0]", "[0, 0; 1/3, 0]", "order"),
    "rklab, q": ("rklab.m", "2, b; 1, b2", "3, b; 1, b2", "order"),
    "rklab, p": ("rklab.m", "2, b; 1, b2", "2, b; 2, b2", "embedded-order"),
    "rklab, a node": ("rklab.m", "c = [gamma; 1]", "c = [gamma; 1/2]", "nodes"),
    "fortran, a digit": ("kutta.f90", "2*third", "3*third", "order"),
    "fortran, the order": ("kutta.f90", "order = 2", "order = 3", "order"),
    "matlab, a sign": ("kutta.m", "-1 2 0]", "-1 -2 0]", "order"),
    "matlab, a cell": ("kutta.m", "m.b{2} = [0 1]", "m.b{2} = [1 0]", "order"),
    "julia, a node": ("tableaus.jl", "c = [0; 2 // 3]", "c = [0; 3 // 2]", "nodes"),
    "julia, the order": ("tableaus.jl", "A, c, α, 2, αEEst", "A, c, α, 3, αEEst", "order"),
    "julia, fsal": ("tableaus.jl", "fsal = false", "fsal = true", "fsal"),
    "julia, an embedded weight": (
        "tableaus.jl",
        "αEEst = [1; 0]",
        "αEEst = [1; 1]",
        "embedded-weights",
    ),
    "julia, big": ("tableaus.jl", 'big"2.0"', 'big"2.1"', "nodes"),
    "julia, additive": ("tableaus.jl", "0//1 0//1; 1//2 0//1]", "0//1 0//1; 1//3 0//1]", "nodes"),
    "tsv, a digit": ("ralston.tsv", "\t0.6666666666666666\t", "\t0.6666666667666666\t", "order"),
    "tsv, a node": ("ralston.tsv", "\n0.6666666666666666", "\n0.6666666766666666", "nodes"),
    "tsv, the order": ("ralston.tsv", "# 2 2", "# 3 2", "order"),
    "printed, a weight": (
        "printed.txt",
        "2.500000000000000e-01",
        "3.500000000000000e-01",
        "weights",
    ),
    "printed, a digit": (
        "printed.txt",
        "6.666666666666666e-01   0",
        "6.666666766666666e-01   0",
        "nodes",
    ),
    "printed, d": ("printed.txt", "d =  1.0", "d =  1.1", "embedded-weights"),
    "mathematica, a root": ("lists.wl", "1/4 - Sqrt[3]/6}", "1/4 - Sqrt[3]/5}", "order"),
    "mathematica, a node": ("lists.wl", "{1/2 - Sqrt[3]/6, ", "{1/2 + Sqrt[3]/6, ", "nodes"),
    "mathematica, evec": ("lists.wl", "{1/4 - 1, 3/4}", "{1/4 - 1, 1/4}", "embedded-weights"),
    "latex, a digit": ("paper.tex", "\\tfrac{2}{3}", "\\tfrac{1}{3}", "nodes"),
    "latex, a weight": ("paper.tex", "\\frac34", "\\frac14", "weights"),
    "latex, an embedded weight": ("paper.tex", "& 1 & 0\n", "& 1 & 1\n", "embedded-weights"),
    "latex, of two colours": ("paper.tex", "& 0 & 1 & 0 & 1", "& 0 & 1 & 0 & 2", "weights"),
    "rust, an entry": ("methods.rs", "a[2][1] = 2.0", "a[2][1] = 1.0", "order"),
    "rust, the order": ("methods.rs", "ORDER: u8 = 2", "ORDER: u8 = 3", "order"),
    "java, a weight": ("Ralston.java", ".multiply(3)", ".multiply(2)", "order"),
    "typescript, an entry": ("kutta.ts", "[-1, 2]", "[1, 2]", "order"),
    "typescript, the order": ("kutta.ts", "return 2;", "return 3;", "order"),
    "go, a whole quotient": ("kutta.go", "{1.0 / 2}", "{1 / 2}", "order"),
    "go, the order": ("kutta.go", "Order: 3", "Order: 4", "order"),
    "c#, a whole quotient": ("Kutta.cs", "2 / 3.0", "2 / 3", "order"),
    "c#, the order": ("Kutta.cs", "Order = 2", "Order = 3", "order"),
    "notebook, a node": (
        "methods.ipynb",
        "c = np.array([0, 1/2])",
        "c = np.array([0, 1/3])",
        "nodes",
    ),
    "json, the order": ("table.json", '"order": 2', '"order": 3', "order"),
    "json, a node": ("table.json", '[0, "1/2"]', '[0, "1/3"]', "nodes"),
    "csv, a sign": ("kutta.csv", "1,-1,2,0", "1,1,2,0", "nodes"),
    "csv, a node": ("kutta.csv", "1/2,1/2", "1/3,1/2", "nodes"),
    "csv, a weight": ("kutta.csv", ",1/6,2/3,1/6", ",1/6,1/3,1/6", "weights"),
}
"""What is planted: in which file, what stands there, what takes its place, and what it is."""


def audit(folder: Path) -> dict[str, object]:
    """The report on a folder, which agrees with its schema."""
    run = gark("audit", str(folder), "--format", "json")
    assert run.code in {0, 1}, run.err
    report = json.loads(run.out)
    jsonschema.validate(report, report_schema("audit"))
    assert (run.code == 1) == bool(report["summary"]["wrong"])
    assert isinstance(report, dict)
    return report


def findings(report: dict[str, object]) -> list[tuple[str, str]]:
    """The source and the code of every finding."""
    tables = report["tables"]
    assert isinstance(tables, list)
    return [
        (Path(table["source"]).name, finding["code"])
        for table in tables
        for finding in table["findings"]
    ]


@in_whole
def test_none_is_invented() -> None:
    """The sources as they are have no finding of any level, and all their tables are seen."""
    report = audit(SOURCES)
    assert findings(report) == []
    summary = {"tables": 41, "wrong": 0, "unread": 0}
    assert report["summary"] == summary


@pytest.mark.parametrize("name", PLANTED)
def test_every_planted_error_is_found(name: str, tmp_path: Path) -> None:
    """In its file, as what it is, as an error; the other tables of the file have none."""
    file, before, after, code = PLANTED[name]
    text = (SOURCES / file).read_text(encoding="utf-8")
    assert text.count(before) >= 1
    changed = text.replace(before, after, 1)
    (tmp_path / file).write_text(changed, encoding="utf-8")
    report = audit(tmp_path)
    assert findings(report) == [(file, code)]
    summary = report["summary"]
    assert isinstance(summary, dict)
    assert summary["wrong"] == 1


def test_products_are_no_better_than_their_factors(tmp_path: Path) -> None:
    """Weights of 15 digits beside products of them that are written out in 30: a sum that is off by
    the rounding of the former is no error, one that is off by more is.
    """
    table = (
        "double A[4] = {0.0, 0.0, 0.577350269189626, 0.0};\n"
        "double c[2] = {0.0, 0.577350269189626};\n"
        "double b[2] = {0.133974596215560894837234396224,"
        " 0.866025403784440};\nint order = 2;\n"
    )
    path = tmp_path / "product.c"
    path.write_text(table, encoding="utf-8")
    run = gark("audit", str(tmp_path))
    assert (run.code, "none wrong" in run.out) == (0, True)
    path.write_text(table.replace("0.8660254", "0.8660264"), encoding="utf-8")
    assert gark("audit", str(tmp_path)).code == 1


def test_careless_digits_hide_no_misprint(tmp_path: Path) -> None:
    """A matrix whose last digits are careless, so that the order is open, with a node that is off at
    the sixth digit, or an embedded weight: an error.
    """
    table = (
        "double A[3][3] = {{0}, {0.33333333333333333333}, {0, 0.66666666666666667000}};\n"
        "double b[3] = {0.25, 0, 0.75}, bembed[3] = {0.20000000000000000001, 0.5, 0.3};\n"
        "double c[3] = {0, 0.33333333333333333333, 0.66666666666666666667};\nint order = 3;\n"
        "int embedded_order = 1;\n"
    )
    wrong = {
        "careless": (table, []),
        "node": (table.replace("c[3] = {0, 0.33333", "c[3] = {0, 0.33334"), ["nodes"]),
        "weight": (table.replace("0.2000000", "0.2000010"), ["embedded-weights"]),
    }
    for name, (text, codes) in wrong.items():
        (tmp_path / "m.c").write_text(text, encoding="utf-8")
        (read,) = audited([str(tmp_path / "m.c")])
        assert [x.code for x in read.findings if x.level == "error"] == codes, name


def test_the_order_of_an_estimate_is_the_lower_one(tmp_path: Path) -> None:
    """SciPy has it, where the embedded weights are those of the higher order: no finding."""
    table = gark("export", "fehlberg-1", "--to", "scipy").out
    (tmp_path / "m.py").write_text(table, encoding="utf-8")
    (read,) = audited([str(tmp_path / "m.py")])
    assert read.embedded_order is not None
    assert (read.table.embedded_order, read.embedded_order.order, read.findings) == (1, 2, ())


@in_whole
@pytest.mark.parametrize(("target", "ending"), [("c", "h"), ("numpy", "py"), ("julia", "jl")])
def test_kicks_and_drifts_of_second_order_equations(
    target: str, ending: str, tmp_path: Path
) -> None:
    """A method for q'' = g(q) in a format that does not say so has its order there: a note."""
    path = tmp_path / f"m.{ending}"
    path.write_text(gark("export", "calvo-sanz-serna-4", "--to", target).out, encoding="utf-8")
    (read,) = audited([str(path)])
    assert read.order is not None
    assert read.order.order == 4
    assert [(x.level, x.message) for x in read.findings] == [
        ("note", "as its numbers say: for q'' = f(q)")
    ]


def test_an_order_of_a_function_is_none_of_its_class(tmp_path: Path) -> None:
    """What a class declares has its margin; what a function of it sets has a larger one."""
    (tmp_path / "tables.py").write_text(
        "_HEUN = ButcherTableau(a=[[0, 0], [1, 0]], b=[0.5, 0.5], c=[0, 1])\n"
    )
    (tmp_path / "solvers.py").write_text(
        "class Heun:\n    tableau = _HEUN\n\n    def spline(self):\n        order = 3\n"
    )
    (read,) = audited(map(str, sorted(tmp_path.iterdir())))
    assert (read.table.order, read.findings) == (None, ())


LONG = re.compile(r"SUN_RCONST\((-?[0-9]+\.[0-9]{15,})\)")


@in_whole
@pytest.mark.parametrize("place", sample([9, 6, 12], 3))
def test_a_short_decimal_is_exact_among_long_ones(place: int, tmp_path: Path) -> None:
    """The node 0.161 or the weight 0.01 does not make the others uncertain: a digit
    changed at any place is an error, and the table as it is has none.
    """
    table = gark("export", "tsitouras-5", "--to", "sundials").out
    path = tmp_path / "table.c"
    path.write_text(table, encoding="utf-8")
    assert gark("audit", str(path)).code == 0
    literals = list(LONG.finditer(table))
    for literal in sample(literals[:: len(literals) // 3], 3):
        number = literal[1]
        digits = [i for i, x in enumerate(number) if x.isdigit()]
        first = next(k for k, i in enumerate(digits) if number[i] != "0")
        at = literal.start(1) + digits[first + place - 1]
        changed = str((int(table[at]) + 5) % 10)
        path.write_text(table[:at] + changed + table[at + 1 :], encoding="utf-8")
        assert gark("audit", str(path)).code == 1, number


def _of_floats(*numbers: float) -> str:
    return ", ".join(f"{Decimal(x):.25f}" for x in numbers)


ROUNDED = {
    "floats with 25 digits": f"A = [[0, 0, 0], [{_of_floats(0.7)}, 0, 0], "
    f"[{_of_floats(1 / 3, 1 / 7)}, 0]]\nb = [{_of_floats(0.1, 0.7, 0.2)}]\n"
    f"c = [0, {_of_floats(0.7, 10 / 21)}]\n",
    "a node with 8 digits": "A = [[0, 0], [0.66666666666666666667, 0]]\nb = [0.25, 0.75]\n"
    "c = [0, 0.66666667]\n",
}


@pytest.mark.parametrize("name", ROUNDED)
def test_what_rounding_explains_is_no_error(name: str, tmp_path: Path) -> None:
    """Decimals that are floats are as good as these, and a short node as its last digit: a note. A
    digit changed before these is an error.
    """
    path = tmp_path / "m.py"
    path.write_text(ROUNDED[name], encoding="utf-8")
    assert gark("audit", str(path)).code == 0
    assert "with notes alone" in gark("audit", str(path)).out
    head, _, nodes = ROUNDED[name].rpartition("c = ")
    path.write_text(f"{head}c = {nodes.replace('66666', '66966').replace('476', '477')}")
    assert gark("audit", str(path)).code == 1


UNLIKE = {
    "m.py": "A = [[0.0], [0.5, 0.0], [1, 2, 3]]\nb = [0.1, 0.8]\nc = [0, 0.5]\n",
    "m.m": "A = [0 0; 0.5 0 0];\nb = [0 1];\n",
    "m.jl": "A = [0 0 0; 0.5 0 0; 0 0 0]\nb = [0, 1]\n",
    "m.json": '{"A": [[0, 0], [0.5, 0, 1]], "b": [0, 1], "c": [0, 0.5]}',
}


@pytest.mark.parametrize("name", UNLIKE)
def test_arrays_that_do_not_fit_are_told(name: str, tmp_path: Path) -> None:
    """Arrays of a method's names and of no shape of one are no table; where nothing else is there it
    is said what was seen.
    """
    (tmp_path / name).write_text(UNLIKE[name], encoding="utf-8")
    run = gark("audit", name, cwd=tmp_path)
    assert (run.code, run.out) == (2, "")
    assert f"no table found in {name} (1 file); {name}:1: " in run.err
    assert "arrays called A and b do not fit together: " in run.err
    assert " for 2 stages" in run.err
    shutil.copy(SOURCES / "kutta.m", tmp_path / "k.m")
    assert gark("audit", ".", cwd=tmp_path).code == 0


@in_whole
def test_a_table_that_cannot_be_read_is_counted(tmp_path: Path) -> None:
    """It is none that is right: the summary says so, and without any other the exit code is 2."""
    text = (SOURCES / "ralston.c").read_text(encoding="utf-8")
    call = "\nt = ARKodeButcherTable_Create(n, 3, 2, c, A, b, d);\n"
    (tmp_path / "m.c").write_text(call, encoding="utf-8")
    run = gark("audit", "m.c", cwd=tmp_path)
    assert run.code == 2
    assert run.out.startswith("no table is read; 1 looks like a table and was not read: ")
    (tmp_path / "n.c").write_text(text, encoding="utf-8")
    run = gark("audit", ".", cwd=tmp_path)
    assert run.code == 0
    told = " ".join(run.out.split())
    assert "none wrong; 1 more looks like a table and was not read: -v lists them" in told
    assert gark("audit", ".", "--strict", cwd=tmp_path).code == 1
    (tmp_path / "m.c").unlink()
    assert gark("audit", ".", "--strict", cwd=tmp_path).code == 0
    (tmp_path / "m.c").write_text(call, encoding="utf-8")
    summary = audit(tmp_path)["summary"]
    assert isinstance(summary, dict)
    assert (summary["wrong"], summary["unread"]) == (0, 1)


def test_what_needs_no_hand_is_counted_and_listed_on_demand(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A table of another method, and a function that takes too much work: neither is an error; the
    first line counts them, ``-v`` lists them.
    """
    shutil.copy(SOURCES / "ralston.c", tmp_path)
    (tmp_path / "glee.c").write_text(
        "void f(void) {\nconst double A[2][2] = {{0, 0}, {1, 0}}, G[2][2] = {{1, 0}, {-1, 1}};\n"
        'const double b[2] = {0.5, 0.5};\nTSGLEERegister("two", 2, 2, &A[0][0], &G[0][0], b, 0, 0, 0);'
        "\n}\n",
        encoding="utf-8",
    )
    told = " ".join(gark("audit", ".", cwd=tmp_path).out.split())
    assert told.endswith("none wrong; 1 of other methods is not judged: -v lists them")
    assert "glee.c:" in gark("audit", ".", "-v", cwd=tmp_path).out
    monkeypatch.setattr(evaluate, "MAX_STEPS", 5)
    run = gark("audit", "ralston.c", "--format", "json", cwd=tmp_path)
    assert run.code == 2
    found = [x for table in json.loads(run.out)["tables"] for x in table["findings"]]
    assert {(x["code"], x["level"], x["message"]) for x in found} == {
        ("unread", "note", "it takes too much work to read")
    }


def test_an_order_that_is_higher_is_a_warning(tmp_path: Path) -> None:
    """It is told, and fails nothing: a code may well declare less than a method has."""
    text = (SOURCES / "kutta.m").read_text(encoding="utf-8")
    (tmp_path / "kutta.m").write_text(text.replace("order = 3", "order = 2"))
    report = audit(tmp_path)
    assert findings(report) == [("kutta.m", "order-higher")]
    assert gark("audit", str(tmp_path)).code == 0


@pytest.fixture
def wrong(tmp_path: Path) -> Path:
    """A folder with one wrong table among others."""
    shutil.copy(SOURCES / "register.cpp", tmp_path)
    text = (SOURCES / "kutta.m").read_text(encoding="utf-8")
    (tmp_path / "kutta.m").write_text(text.replace("-1 2 0]", "1 2 0]"))
    return tmp_path


@in_whole
def test_text_names_the_place_and_the_culprit(wrong: Path) -> None:
    """Only the wrong table is told, with the row that does not fit its node."""
    run = gark("audit", "kutta.m", "register.cpp", cwd=wrong)
    assert run.code == 1
    answer, place, finding, *_ = run.out.splitlines()
    assert (answer, place) == ("6 tables in 2 files, 1 wrong", "  kutta.m:3 kutta: order 1")
    assert finding.startswith("    error  order 1, declared 3;")
    assert "    help   row 3 has the sum 3, its node is 1" in run.out
    assert run.out.count("order ") < gark(
        "audit", "kutta.m", "register.cpp", "-v", cwd=wrong
    ).out.count("order ")
    assert all(len(line) <= 80 for line in run.out.splitlines())


def test_the_embedded_weight_that_is_wrong_is_named(tmp_path: Path) -> None:
    """Without a declared order too, if one entry alone mends the sum and an order above."""
    source = "A = [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 3/4, 0, 0], [2/9, 1/3, 4/9, 0]]\n"
    source += "b = [2/9, 1/3, 4/9, 0]\nbhat = [7/24, 1/4, 1/3, 1/6]\nc = [0, 1/2, 3/4, 1]\n"
    (tmp_path / "solver.py").write_text(source)
    (found,) = audited([str(tmp_path / "solver.py")])
    (finding,) = found.findings
    assert finding.code == "embedded-weights"
    entry = "embedded b[4] = 1/8 instead of 1/6"
    assert finding.help == f"embedded order 2 would hold with {entry}"
    (tmp_path / "solver.py").write_text(source.replace("1/6", "1/8"))
    (mended,) = audited([str(tmp_path / "solver.py")])
    assert (mended.findings, mended.embedded_order.order) == ((), 2)


@in_whole
def test_formats_for_machines(wrong: Path) -> None:
    """Annotations of GitHub, SARIF with a rule for each code, a table in Markdown."""
    run = gark("audit", str(wrong), GITHUB_ACTIONS="true")
    place = f"file={wrong.as_posix()}/kutta.m,line=3".replace(":", "%3A")
    assert run.out.startswith(f"::error {place}")
    sarif = json.loads(gark("audit", str(wrong), "--format", "sarif").out)
    (result,) = sarif["runs"][0]["results"]
    rules = sarif["runs"][0]["tool"]["driver"]["rules"]
    assert rules[result["ruleIndex"]]["id"] == result["ruleId"] == "order"
    assert result["level"] == "error"
    told = gark("audit", str(wrong), "--format", "markdown").out
    assert "kutta.m:3 kutta: order 1\n" in told
    assert "| error | order 1, declared 3; fails at order 2: \\[\\[\\]\\]: 5/6" in told


def test_a_folder_without_tables(tmp_path: Path) -> None:
    """It is told, with exit code 2: a path may be misspelt."""
    (tmp_path / "a.c").write_text("int main(void) { return 0; }")
    run = gark("audit", str(tmp_path))
    assert run.code == 2
    assert "no table found in" in run.err


def test_processes_find_what_one_finds(tmp_path: Path) -> None:
    """In the same order, whoever reads a source; what keeps one from being read is told."""
    for name in ("kutta.csv", "ralston.c"):
        (tmp_path / name).write_text((SOURCES / name).read_text("utf-8"), "utf-8")
    files = [str(x) for x in sorted(tmp_path.iterdir())] * 2
    alone, several = (
        [(x.table, repr(x.order), x.findings) for x in audited(files, jobs)] for jobs in (1, 2)
    )
    assert alone == several
    assert len(alone) > 2
    with pytest.raises(UsageProblem, match="cannot be read"):
        list(audited([*files, str(tmp_path / "none.py")], 2))


@pytest.mark.parametrize(
    ("weights", "count"), [("[[1/2, 1/2], [1/2, 1/2]]", 1), ("[[3, 0], [4, 0]]", 0)]
)
def test_numbers_in_blocks_are_a_method_if_they_fit(
    tmp_path: Path, weights: str, count: int
) -> None:
    """Arrays of arrays called A and B are no method of two vector fields unless weights fit."""
    path = tmp_path / "x.py"
    first, second = "[[0, 0], [1, 0]]", "[[1/2, 0], [1/2, 0]]"
    path.write_text(f"A = [[{first}, {second}], [{first}, {second}]]\nB = {weights}\n", "utf-8")
    found = list(audited([str(path)]))
    assert [x.has_errors for x in found] == [False] * count


@pytest.mark.parametrize(("weights", "count"), [("[1/2, 1/2]", 2), ("[3, 4]", 1)])
def test_calls_of_one_name_are_methods_if_they_fit(
    tmp_path: Path, weights: str, count: int
) -> None:
    """A function ``check`` that is given a method once may be given other numbers, too."""
    zeros, others = "[0, 0, 0, 0]", "[1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]"
    method = f"check([0, 1/2, 1/2, 1], [{zeros}, {others}], [1/6, 1/3, 1/3, 1/6])"
    path = tmp_path / "x.py"
    path.write_text(f"{method}\ncheck([0, 1], [[0, 0], [1, 0]], {weights})\n", "utf-8")
    found = list(audited([str(path)]))
    assert [x.has_errors for x in found if x.is_read] == [False] * count


@pytest.mark.parametrize(("name", "count"), [("backward_euler", 2), ("ratio", 1)])
def test_calls_with_one_stage_are_methods_if_their_name_says_so(
    tmp_path: Path, name: str, count: int
) -> None:
    zeros, others = "[0, 0, 0, 0]", "[1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]"
    method = f"check([0, 1/2, 1/2, 1], [{zeros}, {others}], [1/6, 1/3, 1/3, 1/6])"
    path = tmp_path / "x.py"
    path.write_text(f"kutta = {method}\n{name} = check([1], [[1]], [1])\n", "utf-8")
    assert [x.order.order for x in audited([str(path)]) if x.order] == [4, 1][:count]


@pytest.mark.parametrize(
    "text",
    [
        "Q = [[1e-6, 0, 0], [0, 3e-9, 0], [0, 0, 1]]",
        "a = [[1e-4, 0], [2e-4, 0]]\nb = [0.5, 0.5]\nc = [0, 1e-3]",
    ],
)
def test_tiny_numbers_are_no_row_sums(tmp_path: Path, text: str) -> None:
    """Entries of covariances are near any nodes that are as small."""
    path = tmp_path / "filter.py"
    path.write_text(f"{text}\n", encoding="utf-8")
    assert [*audited([str(path)])] == []
