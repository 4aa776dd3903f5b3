"""Error estimates that may be b − b̂ or b̂ − b: which is read, and what decides it."""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli.bridges.audit import audited
from garkcli.bridges.collecting import TableResult, collected
from tests.cli.harness import gark

SHAMPINE = """
class BS23:
    order = 3
    C = [0, 1/2, 3/4]
    A = [[0, 0, 0], [1/2, 0, 0], [0, 3/4, 0]]
    B = [2/9, 1/3, 4/9]
    E = [{}]
"""
E = "5/72, -1/12, -1/9, 1/8"
MINUS_E = "-5/72, 1/12, 1/9, -1/8"
LOW = ("7/24", "1/4", "1/3", "1/8")
"""The embedded weights that Bogacki and Shampine published."""


def imported(text: str, tmp_path: Path) -> TableResult:
    """The only method of a source in Python."""
    path = tmp_path / "solver.py"
    path.write_text(text, encoding="utf-8")
    (found,) = collected([str(path)])
    return found


def weights(found: TableResult) -> tuple[str, ...]:
    """The embedded weights that were read."""
    assert found.method is not None
    (row,) = found.method.method.embedded or ()
    return tuple(map(str, row))


def test_a_published_pair_decides(tmp_path: Path) -> None:
    """Either sign of E gives the pair as it is published, and the report says which was read."""
    for text, sign in ((E, "b + E"), (MINUS_E, "b - E")):
        found = imported(SHAMPINE.format(text), tmp_path)
        assert weights(found) == LOW
        (note,) = found.notes()
        assert note.startswith(f"the embedded weights are read as {sign}, as in bogacki-shampine-3")
        run = gark("import", "solver.py", "-o", "m.gark.yaml", cwd=tmp_path)
        assert f"solver.py:3 BS23: the embedded weights are read as {sign}" in run.err


def test_nothing_decides(tmp_path: Path) -> None:
    """Half the estimate is no published pair: b − E is written, and import and audit say so."""
    found = imported(SHAMPINE.format("5/144, -1/24, -1/18, 1/16"), tmp_path)
    (note,) = found.notes()
    assert "read as b - E, as no sign is known; b + E has the same order" in note
    (read,) = audited([str(tmp_path / "solver.py")])
    assert [(x.code, x.level, x.message) for x in read.findings] == [("sign", "note", note)]
    assert "as no sign is known" in " ".join(gark("import", "solver.py", cwd=tmp_path).out.split())


def test_tkm_orders_decide(tmp_path: Path) -> None:
    """The midpoint rule beside Euler's, with weights of the higher order for b̂: one sign has order
    2, the other one order 1, which is proved by the conditions of order 2.
    """
    text = "A = [[0, 0], [1/2, 0]]\nb = [1, 0]\nc = [0, 1/2]\nerr = [{}]\norder = 1\n"
    for error, sign, other in (("1, -1", "b - E", "b + E"), ("-1, 1", "b + E", "b - E")):
        found = imported(text.format(error), tmp_path)
        assert weights(found) == ("0", "1")
        assert [*found.notes()] == [
            f"order 2 with the embedded weights {sign}, as they are read, and order 1 with {other}"
        ]
        (read,) = audited([str(tmp_path / "solver.py")])
        assert read.findings == ()


def test_a_library_fixes_tkm_sign(tmp_path: Path) -> None:
    """Nothing is left to say: SciPy has b̂ − b, torchdiffeq b − b̂."""
    scipy = SHAMPINE.format(E).replace("BS23", "BS23(RungeKutta)")
    found = imported(scipy, tmp_path)
    assert (weights(found), [*found.notes()]) == (LOW, [])
    call = "_ButcherTableau(alpha=[1/2, 3/4, 1], beta=[[1/2], [0, 3/4], [2/9, 1/3, 4/9]], {}"
    torch = call.format(f"c_sol=[2/9, 1/3, 4/9, 0], c_error=[{MINUS_E}])")
    found = imported(f"bs23 = {torch}\n", tmp_path)
    assert (weights(found), [*found.notes()]) == (LOW, [])


KUTTA_MIDPOINT = """
static const double km_A[3][3] = {{0}, {0.5}, {-1, 2}};
static const double km_b[3] = {1.0/6, 2.0/3, 1.0/6}, km_c[3] = {0, 0.5, 1};
"""
NAMES = ("km_e", "km_err", "km_d", "km_E", "e_km", "err_km", "km_b_err")


@pytest.mark.parametrize("name", NAMES)
def test_tkm_names_of_estimates(name: str, tmp_path: Path) -> None:
    """Kutta's method with the midpoint rule, whatever the difference of both is called; with a
    misprint the sum is wrong.
    """
    path = tmp_path / "solver.c"
    row = "static const double {}[3] = {{1.0/6, {}, 1.0/6}};\n"
    path.write_text(KUTTA_MIDPOINT + row.format(name, "-1.0/3"), encoding="utf-8")
    (found,) = audited([str(path)])
    assert found.embedded_order is not None
    assert (found.embedded_order.order, found.has_errors) == (2, False)
    path.write_text(KUTTA_MIDPOINT + row.format(name, "-1.0/3 + 0.01"), encoding="utf-8")
    (found,) = audited([str(path)])
    assert [x.code for x in found.findings if x.level == "error"] == ["embedded-weights"]


def test_an_estimate_that_is_not_read_is_told(tmp_path: Path) -> None:
    """Too many numbers, or a sum that no misprint explains: a note, never silence."""
    path = tmp_path / "solver.c"
    for row, why in (("1, 0, 0, 0, -1", "5 entries for 3 stages"), ("1, 2, 3", "the sum is 6")):
        text = f"static const double km_e[] = {{{row}}};\n"
        path.write_text(KUTTA_MIDPOINT + text, encoding="utf-8")
        (found,) = audited([str(path)])
        (finding,) = found.findings
        assert (finding.code, finding.level) == ("unread", "note")
        assert finding.message == f"error weights are not read: {why}"


def test_d_beside_e_is_of_something_else(tmp_path: Path) -> None:
    """Rows called d and e, both with the sum 0: the second one is the estimate."""
    path = tmp_path / "solver.c"
    text = "static const double km_{}[3] = {{{}}};\n"
    rows = text.format("d", "1, 0, -1") + text.format("e", "1.0/6, -1.0/3, 1.0/6")
    path.write_text(KUTTA_MIDPOINT + rows, encoding="utf-8")
    (found,) = audited([str(path)])
    assert found.embedded_order is not None
    assert found.embedded_order.order == 2
