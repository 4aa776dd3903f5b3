"""gark import: files written, reports, exit codes."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema

from garkcli.report.schemas import report_schema
from tests.cli.harness import gark
from tests.whole import in_whole

SOURCES = Path(__file__).parent / "sources"
KUTTA = (
    "A = [[], [0.5], [-1, 2]]\nb = ['1/6', '2/3', '1/6']\nb = [1/6, 2/3, 1/6]\nc = [0, 0.5, 1]\n"
)


@in_whole
def test_files_and_their_claims(tmp_path: Path) -> None:
    """Every table becomes a method file whose claims hold, named after it."""
    folder = tmp_path / "out"
    run = gark("import", str(SOURCES), "--output-dir", str(folder), "--format", "json")
    assert run.code == 0
    report = json.loads(run.out)
    jsonschema.validate(report, report_schema("import"))
    files = [Path(x["file"]) for x in report["methods"]]
    assert len(files) == len(set(files)) == len(list(folder.iterdir()))
    checked = gark("check", "-q", str(folder))
    assert checked.code == 0, checked.out
    first = files[0].read_text(encoding="utf-8")
    assert first.startswith(f"# from {SOURCES / 'heun_euler.def'}:1, read as c")


def test_standard_input() -> None:
    """The format is told by what is found; the method file goes to standard output."""
    run = gark("import", "-", "--format", "yaml", stdin=KUTTA)
    assert run.code == 0
    assert "b: [1/6, 2/3, 1/6]" in run.out
    assert "expect: {order: 3}" in run.out


def test_what_the_source_declares_and_is_not_so() -> None:
    """A declared order that the method has not is told with its witness."""
    text = KUTTA + "order = 4\n"
    run = gark("import", "-", "--from", "python", stdin=text)
    assert run.code == 1
    assert "order 3, declared 4; fails at order 4: [[[[]]]]" in run.out


def test_a_folder_for_the_files_that_cannot_be(tmp_path: Path) -> None:
    """It is told before anything is read."""
    path = tmp_path / "file"
    path.write_text("")
    run = gark("import", "-", "--output-dir", str(path / "x"), stdin=KUTTA)
    assert run.code == 2
    assert "cannot make the folder" in run.err


def test_no_such_source_and_no_such_format() -> None:
    """Both are told with the cure."""
    run = gark("import", "nowhere.c")
    assert run.code == 2
    assert "nowhere.c cannot be read: No such file" in run.err
    run = gark("import", "-", "--from", "julai", stdin="")
    assert "did you mean 'julia'?" in run.err


def test_a_constructor_that_cannot_be_read() -> None:
    """It is told where it stands and what is wrong with it."""
    text = "void f() { ARKodeButcherTable_Create(n, 2, 1, c, A, b, d); }"
    run = gark("import", "-", "--from", "c", stdin=text)
    assert run.code == 2
    assert "<stdin>:1: f is not a method" in run.err
    assert "the number of stages is not written out" in run.err


def test_decimals_become_exact() -> None:
    """--recognise says what each decimal is taken for, and how far it is away."""
    text = "A = [[0, 0], [0.6666666666666666, 0]]\nb = [0.25, 0.75]\nc = [0, 0.6666666666666666]\n"
    run = gark("import", "-", "--from", "python", "--recognise", stdin=text)
    assert "0.6666666666666666 is 2/3, 6.7e-17 away" in run.out
    assert "tolerance" not in run.out


def test_arrays_that_may_be_no_method_are_told(tmp_path: Path) -> None:
    """Of a file that is named: as the error where there is nothing else, and beside what there is."""
    path = tmp_path / "gauss.jl"
    matrix = "[1//4 1//4-sqrt(3)/6; 1//4+sqrt(3)/6 1//4]"
    path.write_text(f"A = {matrix}\nb = [1//4, 3//4]\n", encoding="utf-8")
    refused = gark("import", "gauss.jl", cwd=tmp_path)
    assert refused.code == 2
    assert "gauss.jl:1: A and b without nodes may be no" in refused.err
    assert "help: --from julia takes them for one" in refused.err
    chosen = gark("import", "gauss.jl", "--from", "julia", cwd=tmp_path)
    assert (chosen.code, chosen.err) == (0, "")
    (tmp_path / "kutta.py").write_text(KUTTA, encoding="utf-8")
    both = gark("import", "gauss.jl", "kutta.py", cwd=tmp_path)
    assert both.code == 0
    assert both.err.startswith("gauss.jl:1: A and b without nodes")
    assert gark("import", str(tmp_path)).err == ""


def test_what_was_not_read_is_named(tmp_path: Path) -> None:
    """One line on standard error; -v has each table with its reason."""
    path = tmp_path / "two.py"
    table = "class {0}:\n    A = [[0, 0], [{1}, 0]]\n    b = [0.5, 0.5]\n    c = [0, 1]\n"
    path.write_text(table.format("Heun", 1) + table.format("Other", "x"), encoding="utf-8")
    run = gark("import", str(path), "--format", "yaml")
    assert run.code == 0
    assert run.err == "1 more looks like a table and was not read: -v lists them\n"
    run = gark("import", str(path), "-v")
    assert run.err == f"{path}:6: Other is not read: the name x, line 6, is not known\n"
