"""``gark import`` and ``audit`` of couplings as SUNDIALS has them: read, and judged with the fast
problems solved exactly.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from flint import fmpq

from garkcli.bridges.audit import Audited, audited
from garkcli.bridges.collecting import collected
from garkcli.methodfile.load import load, loads
from tests.cli.harness import gark


def read(tmp_path: Path, text: str, **others: str) -> dict[str, Audited]:
    """The tables of a source, beside others, by their names."""
    paths = []
    for name, content in {"tables": text, **others}.items():
        path = tmp_path / f"{name}.def"
        path.write_text(content, encoding="utf-8")
        paths.append(str(path))
    found = list(audited(paths))
    return {x.table.name: x for x in found if x.table.source == paths[0]}


@pytest.mark.parametrize(
    "name",
    [
        *("mri-gark-erk33a", "mri-gark-irk21a", "imex-mri-gark-midpoint"),
        *("merk21", "merk32", "imex-mri-sr21"),
    ],
)
def test_what_is_exported_is_read_back(tmp_path: Path, name: str) -> None:
    """The same method with its embedded rows and its orders; its audit finds nothing."""
    method = load(name)
    path = tmp_path / "method.c"
    gark("export", name, "--to", "sundials-mri", "-o", str(path))
    (found,) = collected([str(path)])
    assert found.method is not None
    made = found.method.method
    assert (made.tableau, made.embedded) == (method.tableau, method.embedded)
    assert found.method.findings == ()
    assert gark("audit", str(path)).code == 0


HEAD = "ARK_MRI_TABLE({}, {{ MRIStepCoupling C = MRIStepCoupling_Alloc({}); C->q = {}; C->p = {};"
ENTRIES = {
    "merk21": (
        "2, 3, MRISTEP_MERK",
        (2, 1),
        "C->c[1] = 0.5; C->c[2] = 1.0; C->W[0][1][0] = 1.0; C->W[0][2][0] = 1.0;"
        "C->W[1][2][0] = -2.0; C->W[1][2][1] = 2.0; C->W[0][3][0] = 1.0;",
    ),
    "imex-mri-sr21": (
        "1, 4, MRISTEP_SR",
        (2, 1),
        "C->c[1] = 0.6; C->c[2] = 4.0/15; C->c[3] = 1.0; C->W[0][1][0] = 0.6;"
        "C->W[0][2][0] = 14.0/165; C->W[0][2][1] = 2.0/11; C->W[0][3][0] = -13.0/54;"
        "C->W[0][3][1] = 137.0/270; C->W[0][3][2] = 11.0/15; C->W[0][4][0] = -0.25;"
        "C->W[0][4][1] = 0.5; C->W[0][4][2] = 0.75; C->G[0][1][0] = -11.0/23;"
        "C->G[0][1][1] = 11.0/23; C->G[0][2][0] = -6692.0/52371; C->G[0][2][1] = -18355.0/52371;"
        "C->G[0][2][2] = 11.0/23; C->G[0][3][0] = 11621.0/90666; C->G[0][3][1] = -215249.0/226665;"
        "C->G[0][3][2] = 17287.0/50370; C->G[0][3][3] = 11.0/23; C->G[0][4][0] = -31.0/12;"
        "C->G[0][4][1] = -1.0/6; C->G[0][4][2] = 2.75;",
    ),
}


def entry(name: str) -> str:
    """A coupling, entry by entry."""
    size, orders, body = ENTRIES[name]
    return HEAD.format(name, size, *orders) + body + "return C; })\n"


@pytest.mark.parametrize("name", ENTRIES)
def test_forms_with_restarts(tmp_path: Path, name: str) -> None:
    """The methods of the catalogue, whose files were written by hand."""
    found = read(tmp_path, entry(name))[name]
    assert found.method is not None
    assert found.order is not None
    assert found.embedded_order is not None
    assert found.method.tableau == load(name).tableau
    assert (found.order.order, found.embedded_order.order, found.findings) == (2, 1, ())


def test_an_embedded_row_of_one_part(tmp_path: Path) -> None:
    """The implicit part may add nothing to the embedded value: the explicit row has the sum 1, and
    1/2 · 3/5 + 3/4 · 4/15 = 1/2.
    """
    text = re.sub(r"C->G\[0\]\[4\]\S+ = [^;]+;", "", entry("imex-mri-sr21"))
    found = read(tmp_path, text)["imex-mri-sr21"]
    assert found.embedded_order is not None
    assert found.embedded_order.order == 2


@pytest.mark.parametrize(
    ("old", "new", "code"),
    [
        ("C->W[1][2][1] = 2.0", "C->W[1][2][1] = 2.5", "order"),
        ("C->c[1] = 0.5", "C->c[1] = 0.4", "order"),
        ("C->W[0][3][0] = 1.0", "C->W[0][3][0] = 1.5", "embedded-order"),
        ("C->p = 1", "C->p = 2", "embedded-order"),
    ],
)
def test_errors_are_found(tmp_path: Path, old: str, new: str, code: str) -> None:
    """One wrong number of a coupling."""
    text = entry("merk21")
    assert text.count(old) == 1
    found = read(tmp_path, text.replace(old, new))["merk21"]
    assert [(x.code, x.level) for x in found.findings] == [(code, "error")]


def test_the_tolerance_of_a_file_is_that_of_its_digits(tmp_path: Path) -> None:
    """A node of forty digits makes it no larger than these."""
    text = entry("merk21").replace("2.0", "3.0").replace("c[1] = 0.5", f"c[1] = 0.{'3' * 40}")
    path = tmp_path / "tables.def"
    path.write_text(text, encoding="utf-8")
    (found,) = collected([str(path)])
    assert found.method is not None
    assert found.method.order.order == 2
    assert found.method.tolerance == fmpq(1, 10**40)


SLOW = """
ARK_MRI_TABLE(HERE, {
  ARKodeButcherTable B = ARKodeButcherTable_Alloc(2, SUNTRUE); B->q = 2; B->p = 1;
  B->c[1] = 1.0; B->A[1][0] = 1.0; B->b[0] = 0.5; B->b[1] = 0.5; B->d[0] = 1.0;
  MRIStepCoupling C = MRIStepCoupling_MIStoMRI(B, B->q, B->p); return C; })
ARK_MRI_TABLE(ELSEWHERE, {
  ARKodeButcherTable B = ARKodeButcherTable_LoadERK(HEUN_EULER);
  return MRIStepCoupling_MIStoMRI(B, B->q, B->p); })
"""
HEUN = """
ARK_BUTCHER_TABLE(HEUN_EULER, {
  ARKodeButcherTable B = ARKodeButcherTable_Alloc(2, SUNTRUE); B->q = 2; B->p = 1;
  B->c[1] = 1.0; B->A[1][0] = 1.0; B->b[0] = 0.5; B->b[1] = 0.5; B->d[0] = 1.0; return B; })
"""


def test_couplings_of_slow_methods(tmp_path: Path) -> None:
    """One of a table beside it, which is no table of its own, and one of a table that another
    source has; without that source it is told.
    """
    wanted = loads(
        "gark: 1\nmultirate: {mis: {A: [[], [1]], b: [1/2, 1/2], c: [0, 1], embedded: [1, 0]},"
        " fast: exact}",
        "x",
    )
    found = read(tmp_path, SLOW, lists=HEUN)
    assert found.keys() == {"HERE", "ELSEWHERE"}
    for each in found.values():
        assert each.method is not None
        assert each.order is not None
        assert (each.method.tableau, each.method.embedded) == (wanted.tableau, wanted.embedded)
        assert (each.order.order, each.table.order, each.table.embedded_order) == (2, 2, 1)
        assert each.findings == ()
    alone = read(tmp_path, SLOW)["ELSEWHERE"]
    assert [x.message for x in alone.findings] == [
        "it is made of HEUN_EULER, which is in none of these sources"
    ]


def test_a_coupling_in_flat_arrays(tmp_path: Path) -> None:
    """``MRIStepCoupling_Create`` takes the matrices row after row."""
    text = """
MRIStepCoupling euler(void)
{ double c[2] = {0, 1}, W[4] = {0, 0, 1, 0};
  return MRIStepCoupling_Create(1, 2, 1, 0, W, NULL, c); }
"""
    (found,) = read(tmp_path, text).values()
    assert found.method is not None
    assert (
        found.method.tableau
        == loads("gark: 1\nmultirate: {mri: {c: [0, 1], gamma: [[[1]]]}, fast: exact}", "x").tableau
    )
    assert found.findings == ()
