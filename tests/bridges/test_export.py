"""``gark export``: what is written is the method, and heads are comments whatever is in them."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Payload
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import bridges
from garkcli.frozen import replace
from garkcli.methodfile.load import load, loads
from garkcli.tableau.pointwise import in_points
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole

METHODS = sorted(ROOT.glob("methods/*.gark.yaml"))
ROUNDED = ROOT / "tests/examples/valid/rounded.gark.yaml"


def executed(text: str) -> dict[str, Any]:
    """The names that a Python module has, written by us."""
    names: dict[str, Any] = {}
    exec(compile(text, "exported", "exec"), names)
    return names


@pytest.mark.parametrize("path", METHODS, ids=lambda path: path.name)
def test_json_has_every_entry_exactly(path: Path) -> None:
    """The text of each entry is that of the exact tableau, where the nodes have simple radicals."""
    method = load(str(path))
    exact = in_points(method.tableau)
    text = bridges()["json"].written(prepared(method))
    found = json.loads(text)
    assert found["exact"] == (exact is not None)
    if exact is None:
        return
    several = found["kind"] != "rk"
    for l, m in exact.edges():
        block = found["A"][l][m] if several else found["A"]
        wanted = [[str(x) for x in row] for row in exact.block(l, m) or ()]
        assert block == wanted
    rows = found["b"] if several else [found["b"]]
    assert rows == [[str(x) for x in y.b] for y in exact.colours]


@pytest.mark.parametrize("path", METHODS, ids=lambda path: path.name)
def test_numpy_arrays_are_the_nearest_floats(path: Path) -> None:
    """Each entry of the arrays is the float nearest to the decimals of 40 digits."""
    method = load(str(path))
    found = executed(bridges()["numpy"].written(prepared(method)))
    text = bridges()["json"].written(prepared(method, 40))
    wanted = json.loads(text)
    if wanted["kind"] == "rk":
        assert np.array_equal(found["A"], np.array(wanted["A"], dtype=float))
        assert np.array_equal(found["c"], np.array(wanted["c"], dtype=float))
        return
    for blocks, others in zip(found["A"], wanted["A"], strict=True):
        for block, other in zip(blocks, others, strict=True):
            assert (block is None) == (other is None)
            if other is not None:
                assert np.array_equal(block, np.array(other, dtype=float))
    for row, other in zip(found["b"], wanted["b"], strict=True):
        assert np.array_equal(row, np.array(other, dtype=float))


def test_orders_are_proved_when_the_file_is_written() -> None:
    """Claims of the file have no part in it; nodes that are no row sums are told."""
    text = "A: [[0, 0], [1/2, 0]]\nb: [0, 1]\nc: [0, 1/3]\nexpect: {order: 4}\n"
    found = bridges()["json"].written(prepared(loads(text)))
    data = json.loads(found)
    assert (data["order"], data["nonautonomous_order"]) == (2, 1)
    head = bridges()["numpy"].written(prepared(loads(text))).splitlines()[:6]
    assert any("order 1 where f depends on t" in line for line in head)


@pytest.mark.parametrize("target", [n for n, x in bridges().items() if "rk" in x.kinds])
def test_stages_that_see_nothing_have_zeros(target: str) -> None:
    """A method for one vector field without a block is written, with a matrix of zeros for it."""
    absent = prepared(loads("tableau: {c: [[0, 1/2]], A: [[null]], b: [[1/2, 1/2]]}\n"))
    zeros = prepared(loads("tableau: {c: [[0, 1/2]], A: [[[[0, 0], [0, 0]]]], b: [[1/2, 1/2]]}\n"))
    assert absent.A == zeros.A == ((((0, 0), (0, 0)),),)
    # the orders are those of f that sees nothing
    absent = replace(absent, orders=zeros.orders)
    assert attempt(target, absent) == attempt(target, zeros)


def attempt(target: str, payload: Payload) -> str:
    """What a target writes, or why it does not."""
    try:
        return bridges()[target].written(payload)
    except CannotExport as refusal:
        return refusal.message


def test_a_tolerance_is_named() -> None:
    """Of rounded coefficients the order is one within a tolerance, and the head says so."""
    written = bridges()["numpy"].written(prepared(load(str(ROUNDED))))
    assert "order conditions met within" in written


def test_what_there_is_no_target_for() -> None:
    """A misspelt target, and a test of data, are usage errors with a cure."""
    path = "methods/rk4.gark.yaml"
    run = gark("export", path, "--to", "numpi")
    assert run.code == 2
    assert "did you mean 'numpy'?" in run.err
    run = gark("export", path, "--to", "json", "--test", "-o", "x.json")
    assert run.code == 2
    assert "leave out --test" in run.err
    assert not Path(ROOT, "x.json").exists()


def test_free_parameters_are_refused() -> None:
    """A family is no method; the cure names the option."""
    run = gark("export", "tests/examples/families/sdirk.gark.yaml", "--to", "json")
    assert run.code == 2
    assert "--set" in run.err


def test_the_certificate_is_a_target_that_hints_know() -> None:
    """A misspelt target is told which one was meant, the certificate too; the hint counts those of
    the list.
    """
    assert "did you mean 'certificate'?" in gark("export", "rk4", "--to", "certifcate").err
    count = gark("list", "exports").out.split()[0]
    assert f"({count} in all)" in gark("export", "rk4", "--to", "zzz").err


def test_the_list_of_targets() -> None:
    """Every target is in the list, for people and for programs."""
    run = gark("list", "exports", "--format", "json")
    listed = json.loads(run.out)
    assert [x["name"] for x in listed] == sorted([*bridges(), "certificate"])
    shown = gark("list", "exports").out
    assert all(f"  {name} " in shown for name in bridges())
    assert max(map(len, shown.splitlines())) <= 80


def test_a_test_is_named_after_the_file(tmp_path: Path) -> None:
    """Whatever the file is called, its program reads it, and lies beside it with the problem."""
    name = 'my "best" \\ method.v2.py'
    rk4 = ROOT / "methods/rk4.gark.yaml"
    run = gark(*("export", str(rk4), "--to", "scipy", "--test", "-o", name), cwd=tmp_path)
    assert run.code == 0, run.err
    stem = name.removesuffix(".py")
    program = (tmp_path / f"{stem}_test.py").read_text(encoding="utf-8")
    assert ascii(name) in program
    compile(program, "program", "exec")
    assert (tmp_path / f"{stem}_problem.yaml").exists()


@pytest.mark.parametrize("target", ["boost", "desolve", "scipy", "sundials", "torchdiffeq"])
def test_a_program_names_the_files_that_are_there(target: str, tmp_path: Path) -> None:
    """Its head names the program and the problem as they are written, whatever FILE ends with."""
    rk4 = str(ROOT / "methods/rk4.gark.yaml")
    run = gark("export", rk4, "--to", target, "--test", "-o", "x.txt", cwd=tmp_path)
    assert run.code == 0, run.err
    (program,) = tmp_path.glob("x_test.*")
    named = re.findall(r"\bx\S*_(?:test|problem)\.\w+", program.read_text(encoding="utf-8"))
    assert "x_problem.yaml" in named
    assert [name for name in named if not (tmp_path / name).exists()] == []


def test_nothing_is_written_where_there_is_no_test(tmp_path: Path) -> None:
    """A method that the target cannot hold is refused before any file is written."""
    text = "ark: {A: [[[0]], [[1]], [[0]]], b: [[1], [1], [1]]}\n"
    (tmp_path / "three.yaml").write_text(text)
    run = gark(*("export", "three.yaml", "--to", "petsc", "--test", "-o", "x.c"), cwd=tmp_path)
    assert run.code == 2
    assert [x.name for x in tmp_path.iterdir()] == ["three.yaml"]


@pytest.mark.parametrize("target", sorted(bridges()))
def test_files_are_what_a_target_writes(target: str, tmp_path: Path) -> None:
    """No sign of it is changed on its way to the file or to the terminal, tabs of tables neither."""
    path = ROOT / "garkcli/catalogue/data/erk/ralston-euler.gark.yaml"
    payload = prepared(load(str(path)))
    bridge = bridges()[target]
    if payload.kind not in bridge.kinds:
        run = gark("export", str(path), "--to", target)
        assert run.code == 2
        assert "these have: amrex, boost, c," in run.err
        return
    written = bridge.written(payload)
    output = tmp_path / "method"
    assert gark("export", str(path), "--to", target, "-o", str(output)).code == 0
    assert output.read_text(encoding="utf-8") == written
    assert gark("export", str(path), "--to", target).out == written


@in_whole
def test_digits_beyond_those_of_the_file_are_recovered() -> None:
    """Gauss 2 in twelve decimals: with 30 digits the entries are those of Gauss 2; with as many as
    the file has they are those of the file.
    """
    method = loads(
        "{tolerance: 1e-12, A: [[0.25, -0.038675134595], [0.538675134595, 0.25]], b: [0.5, 0.5]}"
    )
    found = json.loads(bridges()["json"].written(prepared(method, 30)))
    assert found["A"] == [
        ["0.25", "-0.038675134594812882254574390251"],
        ["0.538675134594812882254574390251", "0.25"],
    ]
    assert (found["order"], found["moved_within"]) == (4, "1e-12")
    assert "Numbers: within 1e-12 of those of its file" in bridges()["c"].written(
        prepared(method, 30)
    )
    short = json.loads(bridges()["json"].written(prepared(method, 10)))
    assert (short["A"][1], short["moved_within"]) == (["0.5386751346", "0.25"], None)


def test_digits_of_rounded_embedded_weights_are_recovered() -> None:
    """A, b and c are exact; the embedded weights are a third each, as their sum is 1."""
    method = loads(
        "{tolerance: {embedded: 1e-6}, A: [[0, 0, 0], [1/2, 0, 0], [0, 3/4, 0]],"
        " b: [2/9, 1/3, 4/9], embedded: [0.333333, 0.333333, 0.333333]}"
    )
    found = json.loads(bridges()["json"].written(prepared(method, 20)))
    assert found["embedded"] == ["0.33333333333333333333"] * 3
    assert found["b"][2] == "0.44444444444444444444"
