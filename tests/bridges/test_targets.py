"""Targets that no test of the suite runs: their texts, and what each would do wrong in silence."""

from __future__ import annotations

import os
import re
from fractions import Fraction
from pathlib import Path

import pytest
from flint import fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.importing import fmpq_of
from garkcli.bridges.readers.registry import find_tables, reader_named
from garkcli.bridges.registry import EVERYTHING, bridges
from garkcli.bridges.structure import table, with_first_stage, with_last_stage
from garkcli.bridges.targets import python_solvers
from garkcli.methodfile.load import loads
from garkcli.order.certificate import find_order
from tests.bridges.examples import (
    BOGACKI,
    GAUSS,
    MIDPOINTS,
    RALSTON,
    SDIRK,
    VERLET,
    payload_of,
    written,
)
from tests.bridges.test_round_trip import READERS
from tests.cli.harness import ROOT

TEXTS = Path(__file__).parent / "texts"
EXPORTS = (ROOT / "docs/export.md").read_text(encoding="utf-8")
TARGETS = [
    row.strip("| ").split(" | ")
    for row in EXPORTS.partition("\n\n##")[0].splitlines()
    if row.startswith("| ") and "`" in row
]
"""The rows of its table: which methods, and the targets that take them."""
OF_MIDPOINTS = (
    *("c", "csv", "dedalus", "diffrax", "fortran", "json", "julia", "latex", "mathematica"),
    *("matlab", "numpy", "petsc", "rootedtrees", "sundials", "tempus"),
)
OF_VERLET = (
    *("c", "fortran", "geometricintegrators", "julia", "mathematica", "matlab", "numpy", "petsc"),
    *("rootedtrees", "sundials"),
)
OF_RALSTON = tuple(name for name, bridge in bridges().items() if "rk" in bridge.kinds)
DENSE = """\
name: dense
A: [[0, 0], [1, 0]]
b: [1/2, 1/2]
dense: {degree: 2, weights: [[1, -1/2], [0, 1/2]]}
"""
OF_DENSE = ("c", "csv", "fortran", "json", "matlab", "numpy", "petsc", "scipy", "torchdiffeq")
OF_SDIRK = ("diffrax", "irksome", "mathematica", "nodepy", "petsc", "sundials", "tempus")
ROS2 = """\
name: ROS2
rosenbrock:
  alpha: [[], [1]]
  gamma: [[1/2], [-1, 1/2]]
  b: [1/2, 1/2]
  embedded: [1, 0]
  dense: {degree: 2, weights: [[1, -1/2], [0, 1/2]]}
"""
OF_ROS2 = ("c", "json", "kpp", "numpy", "ordinarydiffeq", "petsc")
RECORDED = [
    *[(target, "ralston-euler", RALSTON) for target in OF_RALSTON],
    *[(target, "midpoints", MIDPOINTS) for target in OF_MIDPOINTS],
    *[(target, "stoermer-verlet", VERLET) for target in OF_VERLET],
    *[(target, "dense", DENSE) for target in OF_DENSE],
    *[(target, "sdirk", SDIRK) for target in OF_SDIRK],
    *[(target, "ros2", ROS2) for target in OF_ROS2],
]
RECORDED_IDS = [f"{target}-{name}" for target, name, _ in RECORDED]
PROGRAMS = [
    x for x in RECORDED if x[1] not in {"dense", "ros2"} and bridges()[x[0]].words is not None
]
PROGRAM_IDS = [f"{target}-{name}" for target, name, _ in PROGRAMS]


@pytest.mark.parametrize(("target", "name", "method"), RECORDED, ids=RECORDED_IDS)
def test_recorded_texts(target: str, name: str, method: str) -> None:
    """The whole file, which was run in the target where that was to be had."""
    bridge = bridges()[target]
    compare(TEXTS / f"{target}-{name}{bridge.suffix}.txt", written(target, method))


@pytest.mark.parametrize(("target", "name", "method"), PROGRAMS, ids=PROGRAM_IDS)
def test_recorded_programs(target: str, name: str, method: str) -> None:
    """The whole program of ``--test``, and its problem, which others have too."""
    files = bridges()[target].tested(payload_of(method), f"table{bridges()[target].suffix}")
    (ending, program), _ = files.items()
    compare(TEXTS / f"{target}-{name}{ending}.txt", program)


def compare(path: Path, text: str) -> None:
    """A text is the recorded one; it is recorded where that is asked for."""
    if os.environ.get("GARK_UPDATE_SNAPSHOTS"):
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")
    assert text == path.read_text(encoding="utf-8")


def test_no_recorded_text_is_left_over() -> None:
    """Each file of the folder is compared with something."""
    kept = {f"{target}-{name}{bridges()[target].suffix}.txt" for target, name, _ in RECORDED}
    for target, name, _ in PROGRAMS:
        ending = {".hpp": ".cpp"}.get(bridges()[target].suffix, bridges()[target].suffix)
        kept.add(f"{target}-{name}_test{ending}.txt")
    assert {path.name for path in TEXTS.iterdir()} == kept


@pytest.mark.parametrize("target", sorted(bridges()))
def test_a_target_is_recorded_documented_and_read_back(target: str) -> None:
    """A target that is added without its texts, its row or its reader is found here: its table and
    its program are recorded, docs/export.md has it, and what is read back is read back in tests.
    """
    bridge = bridges()[target]
    assert target in {x for x, _, _ in RECORDED}
    if bridge.words is not None:
        assert target in {x for x, _, _ in PROGRAMS}
    assert any(f"`{target}`" in targets for _, targets in TARGETS)
    assert bridge.reads_back == (target in READERS)


KIND_WORDS = {"row": "Rosenbrock", "nystrom": "Nyström"}


@pytest.mark.parametrize("target", sorted(set(bridges()) - {"json", "certificate"}))
def test_the_page_names_the_kinds(target: str) -> None:
    """The rows of docs/export.md name the kinds beside Runge-Kutta methods that the target has, and
    say that it has all those where it refuses none.
    """
    bridge = bridges()[target]
    row = "; ".join(methods for methods, targets in TARGETS if f"`{target}`" in targets)
    for kind, word in KIND_WORDS.items():
        assert (kind in bridge.kinds) == (word in row)
    is_for_all = set(EVERYTHING) <= set(bridge.kinds) and bridge.stages == "any"
    assert "all Runge–Kutta and GARK" not in row or is_for_all


def test_the_page_names_no_other_target() -> None:
    """The second column of the table of docs/export.md is the list of targets."""
    named = re.findall("`([^`]+)`", " ".join(targets for _, targets in TARGETS))
    assert {*named} == {*bridges()}


EXPLICIT = (
    "amrex",
    "boost",
    "climatimesteppers",
    "desolve",
    "mfem",
    "ordinarydiffeq",
    "torchdiffeq",
    "torchode",
)


@pytest.mark.parametrize("target", EXPLICIT)
def test_implicit_methods_are_refused(target: str) -> None:
    """By those that have explicit ones alone, with the reason and where to go."""
    with pytest.raises(CannotExport) as refusal:
        written(target, SDIRK)
    assert "explicit methods only" in refusal.value.message
    assert "diffrax" in refusal.value.help


@pytest.mark.parametrize("target", ["diffrax", "tempus"])
def test_stages_solved_together_are_refused(target: str) -> None:
    """A stage of a Gauss method sees a later one."""
    with pytest.raises(CannotExport, match="sees a later one"):
        written(target, GAUSS)


def test_pairs_without_an_explicit_table_are_refused() -> None:
    """Of an implicit-explicit pair one table is explicit, and there are two."""
    text = "ark: {A: [[[1/2]], [[1/2]]], b: [1]}\n"
    with pytest.raises(CannotExport, match=r"both of .* are implicit"):
        written("diffrax", text)
    with pytest.raises(CannotExport, match="adds two vector fields"):
        written("tempus", "ark: {A: [[[0]], [[0]], [[0]]], b: [1]}\n")


def test_the_explicit_table_comes_first_wherever_it_is() -> None:
    """Diffrax and Tempus take it first; in the file it is the second one."""
    turned = "name: midpoints\nark: {A: [[[0, 0], [0, 1/2]], [[0, 0], [1/2, 0]]], b: [0, 1]}\n"
    for target in ("diffrax", "tempus"):
        assert written(target, turned) == written(target, MIDPOINTS)


def test_nodes_that_diffrax_compares() -> None:
    """Diffrax stops where a node is no row sum; so does the export, before."""
    text = "A: [[0, 0], [1/2, 0]]\nb: [0, 1]\nc: [0, 1/3]\n"
    with pytest.raises(CannotExport, match=r"node 2 of .* is not"):
        written("diffrax", text)


def test_compositions_alone_are_splittings() -> None:
    """Lobatto IIIA-IIIB is partitioned, and no composition of flows."""
    path = ROOT / "methods/prk-lobatto-iiia-iiib.gark.yaml"
    with pytest.raises(CannotExport, match="no such composition"):
        written("geometricintegrators", path.read_text("utf-8"))


def test_desolve_always_has_variable_steps() -> None:
    """With fixed ones it reads the entries right below the diagonal alone; b2 is what is taken."""
    text = written("desolve", RALSTON)
    assert "varstep = TRUE" in text
    assert "varstep = FALSE" not in text
    assert "b1 = c(1, 0)" in text
    assert "b2 = c(0.25, 0.75)" in text
    alone = written("desolve", RALSTON.replace("embedded: [1, 0]\n", ""))
    assert "b1 = c(0.25, 0.75)" in alone
    assert "every error estimate is 0" in " ".join(alone.split("\n# "))


@pytest.mark.parametrize("target", ["torchdiffeq", "torchode", "diffrax"])
def test_a_last_stage_is_put_in(target: str) -> None:
    """Slopes at the end of a step are those of the last stage: there is one, with weight 0."""
    text = written(target, RALSTON)
    assert "0.25, 0.75, 0" in text
    assert "2/3, 1" in text


@pytest.mark.parametrize("target", ["torchdiffeq", "torchode", "diffrax"])
def test_no_stage_is_put_in_where_there_is_one(target: str) -> None:
    """The pair of Bogacki and Shampine keeps its four stages."""
    assert "2/9, 1/3, 4/9, 0, 0" not in written(target, BOGACKI)


@pytest.mark.parametrize("make", [with_first_stage, with_last_stage])
def test_a_stage_more_is_the_same_method(make) -> None:  # type: ignore[no-untyped-def]
    """The order conditions hold as before, and the step is that of the smaller table."""
    found = make(table(payload_of(BOGACKI)))
    rows = [[str(x) for x in row] for row in found.A]
    listed = ", ".join(map(str, found.b))
    text = f"A: {rows}\nb: [{listed}]\n".replace("'", "")
    assert find_order(loads(text).tableau).order == 3


def test_the_middle_makes_the_quartic_the_cubic() -> None:
    """Torchdiffeq's quartic, by its own formula, has no fourth power: 16 y(1/2) = …"""
    payload = payload_of(RALSTON)
    found = with_last_stage(table(payload))
    mid = python_solvers.middle(payload, found)
    ends = [fmpq(0)] * found.stages
    ends[0], ends[-1] = fmpq(-2), fmpq(2)
    # 2 dt (f1 − f0) − 8 (y1 + y0) + 16 y_mid, the y0 of which cancel
    rows = zip(ends, found.b, mid, strict=True)
    assert [e - 8 * b + 16 * m for e, b, m in rows] == [0, 0, 0]


def test_the_middle_is_that_of_dense_output() -> None:
    """b(1/2) of the polynomials, where the method has them."""
    dense = "dense: {degree: 2, weights: [[1, -3/4], [0, 3/4]]}\n"
    payload = payload_of(RALSTON + dense)
    found = with_last_stage(table(payload))
    assert payload.dense is not None
    middle = python_solvers.middle(payload, found)
    assert middle == (fmpq(5, 16), fmpq(3, 16), 0)


def test_errors_are_differences() -> None:
    """diffrax, torchdiffeq, torchode and Boost take b minus the embedded weights, the classes of
    SciPy have the other sign; others these.
    """
    for target in ("diffrax", "torchdiffeq", "torchode", "boost"):
        assert "-0.75, 0.75" in written(target, RALSTON)
    text = written("scipy", RALSTON)
    assert "E = np.array([0.75, -0.75, 0]" in text
    table = find_tables(text, "x.py", [reader_named("python")])[0]
    assert table.embedded is not None
    assert [float(fmpq_of(x)) for x in table.embedded[0]] == [1, 0]
    assert 'name="bstar" type="string" value="1.0 0.0"' in written("tempus", RALSTON)
    assert "extended_weights = 1.0 0.0" in written("amrex", RALSTON)
    assert "αEEst = bhat" in written("ordinarydiffeq", RALSTON)


def test_guesses_of_diffrax_sum_to_one() -> None:
    """Each row of its predictor is a weighted mean of the stages before."""
    text = written("diffrax", SDIRK)
    _, _, rest = text.partition("a_predictor=(")
    rows = re.findall(r"np\.array\(\[([^]]*)\]", rest.partition("    ),")[0])
    assert [sum(map(int, row.split(", "))) for row in rows] == [1]


def test_single_stages_of_diffrax() -> None:
    """Its tables have two stages at least: the midpoint rule gets one more, with weight 0."""
    text = written("diffrax", "A: [[1/2]]\nb: [1]\n")
    assert "b_sol=np.array([0, 1], dtype=float)" in text
    assert "a_diagonal=np.array([0, 0.5], dtype=float)" in text


def test_adaptive_steps_without_an_estimate_are_refused() -> None:
    """Diffrax is told that there is none, instead of one that is 0."""
    alone = RALSTON.replace("embedded: [1, 0]\n", "")
    assert "return y1, None, *others" in written("diffrax", alone)
    assert "return y1, None, *others" not in written("diffrax", RALSTON)


def test_amrex_has_the_diagonal() -> None:
    """Rows of the lower triangle with their zero diagonal, s(s + 1)/2 numbers, and type 0."""
    text = written("amrex", BOGACKI)
    (line,) = [x for x in text.splitlines() if x.startswith("integration.rk.tab")]
    numbers = line.partition("=")[2].split()
    assert len(numbers) == 10
    assert [numbers[k] for k in (0, 2, 5, 9)] == ["0.0"] * 4
    assert "integration.rk.type = 0\n" in text


def test_no_fraction_reaches_tempus() -> None:
    """It reads 1/3 as 1; and embedded weights of one stage, 1.0, as none."""
    text = written("tempus", BOGACKI)
    assert not re.search(r"\d/\d", text.partition("-->")[2])
    single = "A: [[0]]\nb: [1]\nembedded: [1]\n"
    assert "bstar" not in written("tempus", single)


def test_weights_of_dedalus_are_last_rows() -> None:
    """Midpoints end at 1/2: a stage at the end is put in, whose rows are the weights."""
    text = written("dedalus", MIDPOINTS)
    rows = re.findall(r"^        \[(.*)\],$", text, re.MULTILINE)
    assert [rows[2], rows[5]] == ["0, 1, 0", "0, 1, 0"]
    assert "c = np.array([0, 0.5, 1]" in text
    assert "stages = 2\n" in text
    ends = "ark: {A: [[[0, 0], [1, 0]], [[0, 0], [0, 1]]], b: [[1, 0], [0, 1]]}\n"
    assert "stages = 1\n" in written("dedalus", ends)


def test_julia_is_exact() -> None:
    """Fractions with //, square roots of BigFloat, whole numbers beyond Int64 as BigInt."""
    text = written("julia", SDIRK)
    assert "big(1)-(big(1)//2)*sqrt(big(2))" in text
    big = 2**64 + 1
    text = written("julia", f"A: [[0]]\nb: [1]\nc: [1/{big}]\n")
    assert f'big"1"//big"{big}"' in text


def test_columns_of_julia_are_matrices() -> None:
    """A column in brackets would be a vector, and so would a single number."""
    assert "reshape([1//2], 1, 1)" in written("julia", "A: [[1/2]]\nb: [1]\n")
    assert "reshape([0//1, 1//1], 2, 1)" in written("julia", VERLET)


def test_the_type_in_the_tabs_is_one_word() -> None:
    """RungeKutta.jl evaluates the third word of the first line: it is Float64, whatever the name."""
    text = written("rungekutta-jl", RALSTON.replace("Ralston-Euler", "x y z"))
    assert text.splitlines()[0] == "# 2 2 Float64"
    rows = [line.split("\t") for line in text.splitlines()[1:]]
    assert [len(row) for row in rows] == [3, 3, 3]
    assert [float(row[0]) for row in rows] == [0, 2 / 3, 0]


def test_mathematica_is_exact() -> None:
    """N makes as many digits as it is asked for of fractions and roots, not of decimals."""
    assert "Sqrt[2]" in written("mathematica", SDIRK)
    text = written("mathematica", RALSTON)
    assert '"bhat"] - ' not in text
    assert 'ralstonEuler["b"] - ralstonEuler["bhat"]' in text
    assert 'Rest[ralstonEuler["c"]]' in text
    rounded = "A: [[0, 0], [0.6666666667, 0]]\nb: [1/4, 3/4]\ntolerance: 1e-8\n"
    assert str(Fraction("0.6666666667")) in written("mathematica", rounded)


def test_irrational_numbers_of_mathematica() -> None:
    """Cube roots of negative numbers are real, and roots of polynomials are numbered from 1."""
    text = written("mathematica", "A: [[0]]\nb: [1]\nc: ['cbrt(-2)']\n")
    assert "Surd[" in text or "-Surd[2, 3]" in text


def test_names_of_functions_are_those_of_files() -> None:
    """MATLAB calls a function by its file: names that are none are refused for a test."""
    tested = bridges()["matlab"].tested
    with pytest.raises(CannotExport, match="name of its file"):
        tested(payload_of(RALSTON), "2-stages.m")
    assert [*tested(payload_of(RALSTON), "ralston.m")] == ["_test.m", "_problem.yaml"]


DRIVEN = ("boost", "desolve", "diffrax", "matlab", "mfem", "torchdiffeq")


@pytest.mark.parametrize("target", DRIVEN)
def test_programs_say_which_errors_are_the_same(target: str) -> None:
    """Each has the command, and the problem file beside it; names stay in comments."""
    hostile = RALSTON.replace("Ralston-Euler", '"x */ y ?? -- %} (* #="')
    bridge = bridges()[target]
    files = bridge.tested(payload_of(hostile), f"x{bridge.suffix}")
    program, problem = files.values()
    assert "gark converge FILE" in " ".join(program.split())
    assert problem.startswith("name: one right-hand side")
    assert program.isascii()
