"""Shared stages, and compositions of kicks and drifts: the method stays the same."""

from __future__ import annotations

from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.names import class_name
from garkcli.bridges.payload import Payload
from garkcli.bridges.preparing import prepared
from garkcli.bridges.registry import bridges
from garkcli.bridges.structure import composition, shared, table, vanishes
from garkcli.bridges.targets.sundials_mri import infinitesimal_order, slow_part
from garkcli.exact.field import ONE, ZERO
from garkcli.methodfile.load import load, loads
from garkcli.order.certificate import find_order
from garkcli.tableau.forms import additive
from tests.cli.harness import ROOT
from tests.whole import at_most, in_whole

COEFFICIENTS = st.lists(st.fractions(-2, 2, max_denominator=9), min_size=2, max_size=4)
GENERAL = [
    "methods/collocation.gark.yaml",
    "methods/interpolation.gark.yaml",
    "methods/ark-ars222.gark.yaml",
    "methods/found/imex4-order3.gark.yaml",
]


def payload_of(text: str) -> Payload:
    """A method as writers get it."""
    return prepared(loads(text))


@pytest.mark.parametrize("path", GENERAL)
def test_shared_stages_have_the_same_order(path: str) -> None:
    """The method with all stages shared is another tableau of the same order, and its stages come
    after those that they need.
    """
    method = load(str(ROOT / path))
    tables = shared(prepared(method))
    first = tables[0]
    found = additive([x.A for x in tables], [x.b for x in tables], first.c)
    assert find_order(found, 7).order == find_order(method.tableau, 7).order
    assert {x.stages for x in tables} == {first.stages}


def test_stages_of_two_colours_become_one() -> None:
    """An IMEX method in blocks, its equal stage values on both sides, has three stages and not
    six, and its explicit half is lower.
    """
    explicit = "[[0, 0, 0], [1, 0, 0], [1/4, 1/4, 0]]"
    implicit = "[[0, 0, 0], [0, 1, 0], [0, 1/4, 1/4]]"
    text = f"""
tableau:
  c: [[0, 1, 1/2], [0, 1, 1/2]]
  A:
    - [{explicit}, {implicit}]
    - [{explicit}, {implicit}]
  b: [[1/6, 1/6, 2/3], [1/6, 1/6, 2/3]]
  embedded: [[1, 0, 0], [0, 1, 0]]
"""
    tables = shared(payload_of(text))
    assert [x.stages for x in tables] == [3, 3]
    assert [x.is_explicit for x in tables] == [True, False]
    assert tables[1].is_diagonally_implicit
    assert tables[1].embedded == (ZERO, ONE, ZERO)


def composed(kicks: list[fmpq], drifts: list[fmpq]) -> str:
    """A method file of kick 1, drift 1, kick 2, …: positions before kicks, momenta before drifts."""
    forces = [[x if j < i else 0 for j, x in enumerate(drifts)] for i in range(len(kicks))]
    momenta = [[x if i <= j else 0 for i, x in enumerate(kicks)] for j in range(len(drifts))]
    return (
        "structure: separable\nprk:\n"
        f"  q: {{A: {_listed(forces)}, b: {_listed(drifts)}}}\n"
        f"  p: {{A: {_listed(momenta)}, b: {_listed(kicks)}}}\n"
    )


def _listed(x: object) -> str:
    """Nested lists of numbers as YAML."""
    if isinstance(x, list):
        return f"[{', '.join(map(_listed, x))}]"
    return str(x)


@settings(max_examples=at_most(10, 30))
@given(COEFFICIENTS, COEFFICIENTS)
def test_compositions_are_found_again(kicks: list[object], drifts: list[object]) -> None:
    """From the two matrices come the kicks and drifts that they were made of, whichever vanish."""
    size = min(len(kicks), len(drifts))
    k = [fmpq(str(x)) if "/" not in str(x) else _fraction(str(x)) for x in kicks[:size]]
    d = [fmpq(str(x)) if "/" not in str(x) else _fraction(str(x)) for x in drifts[:size]]
    if not any(k) or not any(d):
        return
    found = composition(payload_of(composed(k, d)))
    assert found is not None
    assert _steps(found.kicks, found.drifts) == _steps(k, d)
    first, second = found.drift_first
    assert _steps((ZERO, *second), (*first, ZERO)) == _steps(k, d)


def _fraction(text: str) -> fmpq:
    p, q = text.split("/")
    return fmpq(int(p), int(q))


def _steps(kicks: object, drifts: object) -> list[tuple[str, fmpq]]:
    """The steps in order, those of zero left out and neighbours of one kind added."""
    found: list[tuple[str, fmpq]] = []
    for kick, drift in zip(kicks, drifts, strict=True):
        for kind, x in (("kick", kick), ("drift", drift)):
            if not x:
                continue
            if found and found[-1][0] == kind:
                x += found.pop()[1]
            if x:
                found.append((kind, x))
    return found


def test_what_is_no_composition_has_none() -> None:
    """The pair Lobatto IIIA-IIIB of three stages solves its stages together."""
    payload = prepared(load(str(ROOT / "methods/prk-lobatto-iiia-iiib.gark.yaml")))
    assert composition(payload) is None
    for name in ("sundials", "petsc"):
        with pytest.raises(CannotExport, match="no such composition"):
            bridges()[name].written(payload)


REFUSED = [
    ("scipy", "{A: [[1/2]], b: [1]}", "explicit methods only"),
    ("scipy", "{A: [[0, 0], [1, 0]], b: [1/2, 1/2], c: [1/2, 1]}", "first node is 1/2"),
    ("sundials", "{A: [[0, 0], [1, 0]], b: [1/2, 1/2], c: [1/2, 1]}", "first node is 1/2"),
    ("sundials", "{methods: [{family: gauss, stages: 2}]}", "sees a later one"),
    ("petsc", "{methods: [{family: gauss, stages: 2}]}", "sees a later one"),
    ("scipy", "{ark: {A: [[[0]], [[0]]], b: [[1], [1]]}}", "scipy has no"),
    ("sundials-mri", "{A: [[1]], b: [1]}", "explicit methods only"),
    (
        "sundials-mri",
        "{A: [[0, 0, 0], [1, 0, 0], [1/4, 1/4, 0]], b: [1/6, 1/6, 2/3]}",
        "do not ascend",
    ),
    # beyond floats
    ("sundials-mri", "{A: [[0, 0], [1e400, 0]], b: [1, 0]}", "do not ascend"),
    ("mfem", "{A: [[0, 0], [1e400/3, 0]], b: [1, 0]}", "beyond the numbers of the target"),
    ("sundials", "{ark: {A: [[[1]], [[1]]], b: [[1], [1]]}}", "both"),
    (
        "petsc",
        "{ark: {A: [[[0]], [[0]], [[0]]], b: [[1], [1], [1]]}}",
        "f1(t, y) + f2(t, y) + f3(t, y)",
    ),
]


@pytest.mark.parametrize(("name", "text", "reason"), REFUSED)
def test_refusals_have_reason_and_cure(name: str, text: str, reason: str) -> None:
    """What a target cannot hold is refused in one line each."""
    with pytest.raises(CannotExport) as refusal:
        bridges()[name].written(payload_of(text))
    assert reason in refusal.value.message
    assert refusal.value.help


def test_a_file_is_named_without_its_folder(tmp_path: Path) -> None:
    """Where a method has no name its file has one, the same wherever it lies."""
    path = tmp_path / "my method.gark.yaml"
    path.write_text("A: [[0]]\nb: [1]\n")
    payload = prepared(load(str(path)))
    assert payload.name == "my method"
    assert payload.stem == "my_method"
    assert class_name(payload.name) == "MyMethod"


def test_tables_know_their_last_stage() -> None:
    """First same as last: the last row is the weights, and the node is 1."""
    fsal = "{A: [[0, 0, 0], [1/2, 0, 0], [0, 1, 0]], b: [0, 1, 0]}"
    assert table(payload_of(fsal)).is_fsal
    assert not table(payload_of("{A: [[0]], b: [1]}")).is_fsal
    assert vanishes(ZERO)
    assert not vanishes(ONE)


@pytest.mark.parametrize(
    ("A", "b", "order"),
    [
        ("[[0, 0, 0], [1/3, 0, 0], [-3/16, 15/16, 0]]", "[1/6, 3/10, 8/15]", 3),
        ("[[0, 0, 0], [1/3, 0, 0], [0, 2/3, 0]]", "[1/4, 0, 3/4]", 2),
        ("[[0, 0], [2/3, 0]]", "[1/4, 3/4]", 2),
        ("[[0]]", "[1]", 1),
    ],
)
def test_the_order_of_multirate_infinitesimal_steps(A: str, b: str, order: int) -> None:
    """The method of Knoth and Wolke keeps its order 3, that of Heun has 2."""
    payload = payload_of(f"{{A: {A}, b: {b}}}")
    found = table(payload)
    assert infinitesimal_order(found, payload.orders.order) == order
    assert f"C->q = {order};" in bridges()["sundials-mri"].written(payload)


def test_latex_is_exact() -> None:
    """Fractions and roots as LaTeX has them, embedded weights below the others, roots of cubics
    among them; decimals where they are asked for.
    """
    text = "A: [[0, 0], [1 - sqrt(2)/2, 0]]\nb: [1/4, 3/4]\nembedded: [1, 0]\n"
    written = bridges()["latex"].written(payload_of(text))
    assert r"1-\frac{\sqrt{2}}{2} & 1-\frac{\sqrt{2}}{2} & 0" in written
    assert "  & \\frac{1}{4} & \\frac{3}{4} \\\\\n  & 1 & 0\n" in written
    cubic = load(str(ROOT / "methods/found/imex4-order3.gark.yaml"))
    assert r"9\gamma -1 = 0, \quad \gamma \approx 0.43" in bridges()["latex"].written(
        prepared(cubic)
    )
    rounded = bridges()["latex"].written(prepared(loads(text), 5))
    assert "0.29289 & 0.29289 & 0" in rounded


SANDU = """
name: ERK33a
multirate:
  mri:
    c: [0, 1/3, 2/3, 1]
    gamma:
      - [[1/3], [-1/3, 2/3], [0, -2/3, 1]]
      - [[0], [0, 0], [1/2, 0, -1/2]]
  fast: kutta
  steps: 1
"""


def test_the_coupling_of_a_file_is_exported() -> None:
    """Matrices of a file are those of MRIStep with a first row of zeros; a method of constant
    coupling has the rows that the slow method alone has.
    """
    payload = payload_of(SANDU)
    slow = slow_part(payload)
    assert slow.nodes == (ZERO, fmpq(1, 3), fmpq(2, 3), ONE)
    first, second = slow.matrices["W"]
    assert first[0] == (ZERO,) * 4
    assert second[3] == (fmpq(1, 2), ZERO, fmpq(-1, 2), ZERO)
    text = bridges()["sundials-mri"].written(payload)
    assert "MRIStepCoupling_Alloc(2, 4, MRISTEP_EXPLICIT)" in text
    base = "{A: [[0, 0, 0], [1/3, 0, 0], [-3/16, 15/16, 0]], b: [1/6, 3/10, 8/15]}"
    mis = f"multirate: {{mis: {base}, fast: kutta, steps: 1}}\n"
    matrices = slow_part(payload_of(mis)).matrices
    assert matrices["W"][0] == slow_part(payload_of(base)).matrices["W"][0]


@in_whole
def test_embedded_rows_of_a_coupling_are_exported() -> None:
    """With the exact fast solution the orders are those of the paper, and the embedded rows are
    beside them; methods whose fast problems begin between stages are refused.
    """
    slow = slow_part(prepared(load("mri-gark-erk45a")))
    assert slow.order == 4
    assert slow.embedding is not None
    rows, order = slow.embedding
    assert order == 3
    assert [row[0] for row in rows["W"]] == [fmpq(-88227, 47470), fmpq(6213, 1880)]
    text = bridges()["sundials-mri"].written(prepared(load("mri-gark-erk45a")))
    assert "C->W[1][6][j] = dW[6 + j];" in text
    assert "with the fast equation solved exactly" in text
    with pytest.raises(CannotExport, match="begin between stages"):
        slow_part(prepared(load("mis2")))


DECOUPLED = """
multirate:
  mri: {c: [0, 1, 1, 1], gamma: [[[1], [-1/2, 0, 1/2], []]]}
  fast: exact
"""


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("[1], ", "[1, 0, 1], ", "uses a later one"),
        ("[1], ", "[1/2, 1/2], ", "is implicit, and has a fast problem"),
        ("[0, 1, 1, 1]", "[0, 2, 1, 1]", "nodes of .* do not ascend"),
    ],
)
def test_what_mristep_refuses_is_not_exported(old: str, new: str, message: str) -> None:
    """``mriStep_CheckCoupling`` refuses later stages, a solve coupled with a fast problem, and
    nodes that descend.
    """
    with pytest.raises(CannotExport, match=message):
        slow_part(payload_of(DECOUPLED.replace(old, new)))


@pytest.mark.parametrize(
    ("name", "groups"),
    [
        ("merk21", [[1, 3], [2]]),
        ("merk32", [[1], [2, 4], [3]]),
        ("merk43", [[1], [3, 2], [5, 4, 7], [6]]),
    ],
)
def test_stages_of_merk_are_grouped(name: str, groups: list[list[int]]) -> None:
    """As MRIStep's own tables are: one fast problem for stages with one forcing, by ascending
    nodes, the embedded value last in the last but one.
    """
    slow = slow_part(prepared(load(name)))
    assert slow.groups == groups
    text = bridges()["sundials-mri"].written(prepared(load(name)))
    assert f"({len(slow.matrices['W'])}, {len(slow.nodes)}, MRISTEP_MERK)" in text
    assert f"C->group[{len(groups) - 1}][0] = {groups[-1][0]};" in text


MERK = """
multirate:
  mri: {restart: merk, c: [0, 1/2, 1], omega: [[[1], [1]], [[0], [-2, 2]]]}
  fast: exact
"""
SR = """
multirate:
  mri:
    restart: sr
    c: [0, 1/2, 1]
    omega: [[[1/2], [0, 1]]]
    gamma: [[[-1/2, 1/2], [-1/2, 0, 1/2]]]
  fast: exact
"""


def test_couplings_with_restarts_are_exported() -> None:
    """Their matrices are those of the file; without embedded rows MERK has a group for them."""
    merk = slow_part(payload_of(MERK))
    assert merk.groups == [[1], [3], [2]]
    assert [matrix[2] for matrix in merk.matrices["W"]] == [(ONE, ZERO, ZERO), (-2, 2, ZERO)]
    slow = slow_part(payload_of(SR))
    assert slow.type == "MRISTEP_SR"
    assert slow.matrices["W"][0][1:] == ((fmpq(1, 2), ZERO, ZERO), (ZERO, ONE, ZERO))
    assert slow.matrices["G"][0][2] == (fmpq(-1, 2), ZERO, fmpq(1, 2))
    alone = slow_part(payload_of(SR.replace("    gamma: [[[-1/2, 1/2], [-1/2, 0, 1/2]]]\n", "")))
    assert (list(alone.matrices), alone.type) == (["W"], "MRISTEP_SR")


@pytest.mark.parametrize(
    ("text", "old", "new", "message"),
    [
        (MERK, "[0, 1/2, 1]", "[0, 0, 1]", "has no length"),
        (MERK, "[[1], ", "[[1, 1], ", "uses a later one"),
        (SR, "[-1/2, 1/2]", "[-1/2, 0, 1/2]", "uses a later one"),
    ],
)
def test_restarts_that_mristep_refuses(text: str, old: str, new: str, message: str) -> None:
    """A fast problem without length, a forcing by the stage itself, a later stage in gamma."""
    assert old in text
    with pytest.raises(CannotExport, match=message):
        slow_part(payload_of(text.replace(old, new, 1)))


def test_embedded_rows_of_more_powers_have_room() -> None:
    """A matrix of zeros is beside an embedded row of a power that the method does not have."""
    text = DECOUPLED.replace("[]]]}", "[]]], embedded: [[-1/2, 1/2], [1, -1]]}")
    written = bridges()["sundials-mri"].written(payload_of(text))
    assert "MRIStepCoupling_Alloc(2, 4, MRISTEP_IMPLICIT)" in written
    assert "C->G[1][4][j] = dG[4 + j];" in written


def test_an_implicit_coupling_is_told_from_an_explicit_one() -> None:
    """A row that uses the stage it leads to is implicit, and so are the letters of its matrices."""
    text = bridges()["sundials-mri"].written(payload_of(DECOUPLED))
    assert "C->G[0][i][j] = G[4 * i + j];" in text
    assert "MRISTEP_IMPLICIT" in text
    assert "f1 fast and solved exactly; 2 vector\n * fields, stages 2." in text
    with pytest.raises(CannotExport, match="no multirate infinitesimal step"):
        slow_part(prepared(load(str(ROOT / GENERAL[0]))))
