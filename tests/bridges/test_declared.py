"""What an imported file claims is what its source declares, true or not."""

from __future__ import annotations

from pathlib import Path

import pytest

import garkcli
from garkcli.bridges.collecting import TableResult, collected
from garkcli.check.check_file import check_method
from garkcli.methodfile.load import loads
from tests.bridges.test_audit import PLANTED, SOURCES
from tests.cli.harness import gark
from tests.whole import IS_WHOLE, in_whole, sample

KUTTA = "A = [[], [0.5], [-1, 2]]\nb = [1/6, 2/3, 1/6]\nc = [0, 0.5, 1]\n"
WRONG = KUTTA.replace("-1, 2", "1, 2") + "order = 3\n"
"""Kutta's method with a sign changed in its last row."""
TWO = """
struct ButcherTableau{S,T}
    A::SMatrix{S,S,T}
    b::SVector{S,T}
    c::SVector{S,T}
    order::Int
end
function ralston3()
    A = [0 0 0; 1//2 0 0; 0 3//4 0]
    b = [2//9, 1//3, 4//9]
    c = [0, 1//2, 3//4]
    return ButcherTableau(A, b, c, 3)
end
function kutta38()
    A = [0 0 0 0; 1//3 0 0 0; -1//3 1 0 0; 1 1 1 0]
    b = [1//8, 3//8, 3//8, 1//8]
    c = [0, 1//3, 2//3, 1]
    return ButcherTableau(A, b, c, 4)
end
"""
"""Ralston's method, and the 3/8 rule with a sign changed in its last row."""


def verdict(found: TableResult) -> int:
    """What ``gark check`` makes of the file of a method: its exit code."""
    assert found.method is not None
    return check_method(loads(found.method.text)).exit_code


def expected(text: str, tmp_path: Path, is_as_found: bool = False) -> list[str]:
    """What the files claim that are made of a source in Python."""
    path = tmp_path / "m.py"
    path.write_text(text, encoding="utf-8")
    found = collected([str(path)], is_as_found=is_as_found)
    lines = [line for x in found if x.method for line in x.method.text.splitlines()]
    return [x.removeprefix("expect: ") for x in lines if x.startswith("expect")]


LONG = {"printed, a digit"}
"""An audit that takes seconds."""


@pytest.mark.parametrize(
    "name",
    [
        x
        for x in sample([x for x in PLANTED if PLANTED[x][3] != "shape"], 3)
        if IS_WHOLE or x not in LONG
    ],
)
def test_a_false_declaration_is_claimed(name: str, tmp_path: Path) -> None:
    """In every format, by every kind of error that an audit finds: the file of this table fails
    ``gark check``, and as it was found it does not.
    """
    file, before, after, code = PLANTED[name]
    text = (SOURCES / file).read_text(encoding="utf-8")
    path = tmp_path / file
    path.write_text(text.replace(before, after, 1), encoding="utf-8")
    (wrong,) = [x for x in collected([str(path)]) if x.errors]
    # an import holds the numbers as they are stored against what is declared
    assert [x.code for x in wrong.errors] == [{"transposed": "order"}.get(code, code)]
    assert verdict(wrong) == 1
    (true,) = [x for x in collected([str(path)], is_as_found=True) if x.errors]
    assert verdict(true) == 0


def test_the_command_tells_it_and_exits_with_1(tmp_path: Path) -> None:
    """Of two tables one is wrong: named with its witness and the cure, both are written, and check
    fails the one; with --as-found the file claims order 1 and passes.
    """
    (tmp_path / "Tables.jl").write_text(TWO, encoding="utf-8")
    run = gark("import", "Tables.jl", "--output-dir", "out", cwd=tmp_path)
    assert run.code == 1
    assert run.out.startswith("2 methods, 1 wrong\n")
    told = " ".join(run.out.split())
    assert "kutta38: order 1 error order 1, declared 4; fails at order 2" in told
    assert "help row 4 has the sum 3, its node is 1" in told
    assert "--as-found claims what is true" in run.err
    assert gark("check", "-q", "out/ralston3.gark.yaml", cwd=tmp_path).code == 0
    checked = gark("check", "-q", "out/kutta38.gark.yaml", cwd=tmp_path)
    assert (checked.code, "expected 4, found 1" in checked.out) == (1, True)
    found = gark("import", "Tables.jl", "--as-found", "--output-dir", "out", cwd=tmp_path)
    assert found.code == 0
    assert gark("check", "-q", "out", cwd=tmp_path).code == 0
    assert "{order: 1}" in (tmp_path / "out/kutta38.gark.yaml").read_text(encoding="utf-8")


def test_beside_method_files_it_goes_to_standard_error(tmp_path: Path) -> None:
    """``-o`` of a method file has the method alone, with the declared claim."""
    (tmp_path / "m.py").write_text(WRONG, encoding="utf-8")
    run = gark("import", "m.py", "-o", "m.gark.yaml", cwd=tmp_path)
    assert (run.code, run.out) == (1, "")
    assert "m.py:1: order 1, declared 3; fails at order 2" in run.err
    assert "help: row 3 has the sum 3, its node is 1" in run.err
    assert gark("check", "-q", "m.gark.yaml", cwd=tmp_path).code == 1


def test_what_is_declared_elsewhere(tmp_path: Path) -> None:
    """The order of the class that uses a table, in another file; words alone are a doubt."""
    table = KUTTA.replace("-1, 2", "1, 2")
    (tmp_path / "tables.py").write_text(f"class K3:\n{table}".replace("\n", "\n    "))
    assert gark("import", "tables.py", "--as-found", cwd=tmp_path).code == 0
    (tmp_path / "solvers.py").write_text("class Solver:\n    order = 3\n    tableau = K3\n")
    run = gark("import", "tables.py", "solvers.py", cwd=tmp_path)
    assert (run.code, "order 1, declared 3" in run.out) == (1, True)
    said = "# Kutta's method of order 4\n" + KUTTA
    run = gark("import", "-", "--from", "python", stdin=said)
    assert (run.code, "a comment or docstring says 4" in run.out) == (0, True)


def test_declared_orders_that_are_too_low(tmp_path: Path) -> None:
    """They hold: as bounds, unless what is true is asked for."""
    text = KUTTA + "order = 2\n"
    assert expected(text, tmp_path) == ['{order: ">= 2"}']
    assert expected(text, tmp_path, is_as_found=True) == ["{order: 3}"]
    assert expected(KUTTA, tmp_path) == ["{order: 3}"]


def test_an_embedded_order_that_the_matrix_spoils(tmp_path: Path) -> None:
    """The declared one is claimed beside the order: once the entry is mended, both hold."""
    text = WRONG + "bhat = [0, 1, 0]\nembedded_order = 2\n"
    (claims,) = expected(text, tmp_path)
    assert claims == "{order: 3, embedded-order: 2}"
    assert expected(text.replace("1, 2", "-1, 2"), tmp_path) == [claims]
    # what nothing declares is no claim of a wrong table: the cure changes it
    assert expected(WRONG + "bhat = [0, 1, 0]\n", tmp_path) == ["{order: 3}"]


def test_what_the_digits_leave_open_is_not_claimed(tmp_path: Path) -> None:
    """A declared order that rounding may explain: no error, and the file claims what is proved."""
    text = (
        "A = [[0], [0.33333333333333333333], [0, 0.66666666666666667000]]\n"
        "b = [0.25, 0, 0.75]\nc = [0, 0.33333333333333333333, 0.66666666666666666667]\norder = 3\n"
    )
    path = tmp_path / "m.py"
    path.write_text(text, encoding="utf-8")
    (found,) = collected([str(path)])
    assert found.method is not None
    assert (found.errors, found.method.order.order < 3) == ([], True)
    assert any("rounding" in x for x in found.notes())
    assert verdict(found) == 0


def test_the_last_stage(tmp_path: Path) -> None:
    """A true declaration that it is the first of the next step is a claim; none is none."""
    text = "A = [[], [0.5], [0, 1]]\nb = [0, 1, 0]\nc = [0, 0.5, 1]\nfsal = True\n"
    assert expected(text, tmp_path) == ["{order: 2, fsal: true}"]
    assert expected(text.replace("fsal = True", ""), tmp_path) == ["{order: 2}"]


@in_whole
def test_exact_forms_of_a_false_declaration(tmp_path: Path) -> None:
    """Whether its decimals stay or become fractions, the file claims the same."""
    path = tmp_path / "m.py"
    path.write_text(
        "A = [[0], [0.33333333333333333333], [0, 0.66666666666666666667]]\n"
        "b = [0.25, 0, 0.75]\nc = [0, 0.33333333333333333333, 0.66666666666666666667]\norder = 4\n"
    )
    for is_as_found, order in ((False, 4), (True, 3)):
        (method,) = garkcli.import_methods(path, is_recognising=True, is_as_found=is_as_found)
        assert method.tolerance is None
        assert [(x.key, x.value) for x in method.claims] == [("order", order)]


def test_in_python(tmp_path: Path) -> None:
    """``import_methods`` claims the same, and ``claims_of`` has what is true."""
    path = tmp_path / "m.py"
    path.write_text(WRONG, encoding="utf-8")
    (method,) = garkcli.import_methods(path)
    assert [(x.key, x.value) for x in method.claims] == [("order", 3)]
    assert garkcli.claims_of(method)["order"] == "1"
    (found,) = garkcli.import_methods(path, is_as_found=True)
    assert [(x.key, x.value) for x in found.claims] == [("order", 1)]
