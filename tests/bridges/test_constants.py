"""Constants of other sources in a tree."""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli.bridges.constants import tables_with_constants
from tests.cli.harness import gark

CONSTANTS = {
    "f90": "module numbers\n  real(rk), parameter :: two_thr = two/3._rk, two = 2._rk\n"
    "  real(rk), parameter :: two = 2._rk\nend module\n",
    "h": "#define TWO_THR (2.0 / 3.0) // a fraction\n",
    "rs": "pub const TWO_THR: f64 = 2.0 / 3.0;\n",
    "py": "TWO_THR = 2 / 3\n",
}
TABLES = {
    "f90": "subroutine ralston(a, b)\n  use numbers, only: two_thr\n  real(rk) :: a(2,2), b(2)\n  a = 0._rk\n  a(2,1) = two_thr\n"
    "  b = [0.25_rk, 0.75_rk]\nend subroutine\n",
    "h": '#include "numbers.h"\nconst double A[2][2] = {{0, 0}, {TWO_THR, 0}};\n'
    "const double b[2] = {0.25, 0.75};\n",
    "rs": "use numbers::TWO_THR;\nconst A: [[f64; 2]; 2] = [[0.0, 0.0], [TWO_THR, 0.0]];\n"
    "const B: [f64; 2] = [0.25, 0.75];\n",
    "py": "from numbers import TWO_THR\nA = [[0, 0], [TWO_THR, 0]]\nb = [0.25, 0.75]\n",
}


@pytest.mark.parametrize("suffix", TABLES)
def test_constants_of_another_source(suffix: str, tmp_path: Path) -> None:
    """Ralston's method has 2/3, which another source has; two values in a tree are none."""
    first, second = tmp_path / f"numbers.{suffix}", tmp_path / f"other.{suffix}"
    first.write_text(CONSTANTS[suffix], encoding="utf-8")
    second.write_text(CONSTANTS[suffix].replace("3", "4"), encoding="utf-8")
    text, source = TABLES[suffix], f"tables.{suffix}"
    alone = tables_with_constants(text, source, ())
    assert not any(x.b for x in alone)
    found = [x for x in tables_with_constants(text, source, [str(first)]) if x.b]
    assert [x.A[0][0][1][0].replace(" ", "") for x in found] == ["2/3"]
    both = tables_with_constants(text, source, [str(first), str(second)])
    assert not any(x.b for x in both)


@pytest.mark.parametrize(
    ("suffix", "constants"),
    [
        ("h", "#define Two_Thr (2.0 / 3.0)\n"),
        ("h", "// const double TWO_THR = 2.0 / 3.0;\n"),
        ("h", "/* was\n * const double TWO_THR = 2.0 / 3.0; */\n"),
        ("py", "two_thr = 2 / 3\n"),
        ("py", "# const TWO_THR = 2 / 3\n"),
        ("f90", "! real(rk), parameter :: two_thr = 2._rk/3._rk\n"),
    ],
)
def test_other_names_and_comments_are_no_constants(
    suffix: str, constants: str, tmp_path: Path
) -> None:
    """Case tells names apart but in Fortran; what is in a comment is not used."""
    other = tmp_path / f"numbers.{suffix}"
    other.write_text(constants, encoding="utf-8")
    found = tables_with_constants(TABLES[suffix], f"tables.{suffix}", [str(other)])
    assert not any(x.b for x in found)


def test_names_of_fortran_have_no_case(tmp_path: Path) -> None:
    other = tmp_path / "numbers.f90"
    other.write_text("real(rk), PARAMETER :: Two_Thr = 2._rk/3._rk\n", encoding="utf-8")
    found = tables_with_constants(TABLES["f90"], "tables.f90", [str(other)])
    assert any(x.b for x in found)


def test_a_table_with_a_constant_of_its_own_keeps_it(tmp_path: Path) -> None:
    """One function has its own value; the table beside it takes that of another source."""
    other = tmp_path / "numbers.f90"
    other.write_text("real(rk), parameter :: gama = 0.3_rk\n", encoding="utf-8")
    table = "  a(1,1) = gama\n  a(2,1) = 1 - 2*gama\n  a(2,2) = gama\n  b = [0.5_rk, 0.5_rk]\n"
    text = "".join(
        f"subroutine {name}(a, b)\n  real(rk) :: a(2,2), b(2){own}\n  a = 0._rk\n{table}end subroutine\n"
        for name, own in (("own", ", gama\n  gama = 0.25_rk"), ("taken", ""))
    )
    found = tables_with_constants(text, "tables.f90", [str(other)])
    assert [x.A[0][0][0][0] for x in found] == ["1/4", "3/10"]


def test_an_error_beside_a_constant_of_another_source_is_in_doubt(tmp_path: Path) -> None:
    """The constant may be of something else: 7/5 is the heat capacity ratio of air."""
    (tmp_path / "gas.h").write_text("const double gama = 7.0 / 5.0;\n", encoding="utf-8")
    table = "const double A[2][2] = {{0, 0}, {gama, 0}};\nconst double b[2] = {0.25, 0.75};\n"
    table += "const double c[2] = {0, 2.0 / 3.0};\nconst int order = 2;\n"
    (tmp_path / "ralston.h").write_text(table, encoding="utf-8")
    wrong = gark("audit", str(tmp_path))
    assert (wrong.code, "in doubt, as constants in it are of other sources" in wrong.out) == (
        0,
        True,
    )
    (tmp_path / "ralston.h").write_text(table.replace("gama", "1.4"), encoding="utf-8")
    assert gark("audit", str(tmp_path)).code == 1
