"""``gark import`` and ``audit`` of Rosenbrock methods: PETSc's calls, OrdinaryDiffEq's tableaus and
KPP's arrays are read and judged.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli.bridges.audit import audit
from garkcli.bridges.collecting import collected
from garkcli.bridges.importing import fmpq_of
from garkcli.bridges.readers.registry import find_tables, reader_named
from garkcli.bridges.registry import bridges
from garkcli.bridges.rosenbrock import with_row_orders
from garkcli.exact.display import to_ball, to_decimal
from garkcli.frozen import replace
from garkcli.methodfile.load import load, loads
from garkcli.sources.found import FoundTable
from tests.bridges.test_rosenbrock import payload
from tests.cli.harness import gark
from tests.whole import in_whole

FORMATS = {"petsc": "petsc", "ordinarydiffeq": "julia", "kpp": "fortran"}
NAMES = ["rodas3", "ros2-small", "ros3p"]


def tables(text: str, format: str) -> list[FoundTable]:
    """The tables of a source."""
    return find_tables(text, "source", [reader_named("c" if format == "petsc" else format)])


@pytest.mark.parametrize("target", FORMATS)
@pytest.mark.parametrize("name", NAMES)
def test_what_is_exported_is_read_back(tmp_path: Path, target: str, name: str) -> None:
    """The same method, its embedded weights too, as far as the digits of the target go; and its
    audit finds nothing.
    """
    method, bridge = load(name), bridges()[target]
    path = tmp_path / f"method{bridge.suffix}"
    path.write_text(bridge.written(payload(name)), encoding="utf-8")
    (found,) = collected([str(path)])
    assert found.method is not None
    made = found.method.method
    assert made.embedded is not None
    assert method.embedded is not None
    rows = zip(method.tableau.rows, made.tableau.rows, strict=True)
    further = zip(method.embedded, made.embedded, strict=True)
    for ours, theirs in [*rows, *further]:
        for x, y in zip(ours, theirs, strict=True):
            assert abs(to_ball(x, 40) - to_ball(y, 40)) < 1e-30
    assert gark("audit", str(path)).code == 0


KPP = """
SUBROUTINE Rodas3
    ros_Name = 'RODAS-3'
    ros_S = 4
    ros_A(1) = 0.0_dp
    ros_A(2) = 2.0_dp
    ros_A(3) = 0.0_dp
    ros_A(4) = 2.0_dp
    ros_A(5) = 0.0_dp
    ros_A(6) = 1.0_dp
    ros_C(1) = 4.0_dp
    ros_C(2) = 1.0_dp
    ros_C(3) =-1.0_dp
    ros_C(4) = 1.0_dp
    ros_C(5) =-1.0_dp
    ros_C(6) =-(8.0_dp/3.0_dp)
    ros_M(1) = 2.0_dp
    ros_M(2) = 0.0_dp
    ros_M(3) = 1.0_dp
    ros_M(4) = 1.0_dp
    ros_E(1) = 0.0_dp
    ros_E(2) = 0.0_dp
    ros_E(3) = 0.0_dp
    ros_E(4) = 1.0_dp
    ros_ELO  = 3.0_dp
    ros_Alpha(1) = 0.0_dp
    ros_Alpha(2) = 0.0_dp
    ros_Alpha(3) = 1.0_dp
    ros_Alpha(4) = 1.0_dp
    ros_Gamma(1) = 0.5_dp
    ros_Gamma(2) = 1.5_dp
    ros_Gamma(3) = 0.0_dp
    ros_Gamma(4) = 0.0_dp
END SUBROUTINE Rodas3
"""


MEMBERS = """
Parameters Parameters::Rodas3()
{
  Parameters p; Real g = std::numbers::sqrt2; p.stages_ = 4;
  p.a_.fill(0); p.a_[1] = g * g; p.a_[3] = 2; p.a_[5] = 1;
  p.c_.fill(0); p.c_[0] = 4; p.c_[1] = 1; p.c_[2] = -1; p.c_[3] = 1; p.c_[4] = -1;
  p.c_[5] = -(8.0 / 3.0); p.m_.fill(0); p.m_[0] = 2; p.m_[2] = 1; p.m_[3] = 1;
  p.e_.fill(0); p.e_[3] = 1; p.estimator_of_local_order_ = 3;
  p.alpha_.fill(0); p.alpha_[2] = 1; p.alpha_[3] = 1;
  p.gamma_.fill(0); p.gamma_[0] = 0.5; p.gamma_[1] = 1.5;
  strcpy(p.name_, "RODAS-3"); return p;
}
"""


def test_arrays_of_a_structure() -> None:
    """RODAS3 in the form of KPP, with its arrays in a structure, which are filled first."""
    (members,), (arrays,) = tables(MEMBERS, "petsc"), tables(KPP, "fortran")
    found, wanted = map(with_row_orders, (members, arrays))
    assert found.method.tableau == wanted.method.tableau
    assert found.method.embedded == wanted.method.embedded
    assert (members.name, members.embedded_order) == ("RODAS-3", 2)
    # two numbers of four
    assert not any(x.b for x in tables(MEMBERS.replace("p.gamma_.fill(0);", ""), "petsc"))


@pytest.mark.parametrize(
    ("old", "new", "code", "message"),
    [
        ("ros_ELO  = 3.0", "ros_ELO  = 4.0", "embedded-order", "embedded order 2, declared 3"),
        ("ros_ELO  = 3.0", "ros_ELO  = 2.0", "embedded-order-higher", "order 2, declared 1"),
        ("ros_Alpha(3) = 1.0", "ros_Alpha(3) = 0.9", "nodes", "order 1 where f depends on t"),
        ("ros_Gamma(2) = 1.5", "ros_Gamma(2) = 1.4", "nodes", "where f depends on t"),
        ("ros_M(1) = 2.0", "ros_M(1) = 2.1", "embedded-order", "embedded order 0, declared 2"),
    ],
)
def test_errors_are_found(old: str, new: str, code: str, message: str) -> None:
    """One wrong number of RODAS3 in KPP's form; without it nothing is found. An order that is
    declared too low is no error.
    """
    (table,) = tables(KPP, "fortran")
    right = audit(table)
    assert right is not None
    assert right.order is not None
    assert (right.order.order, right.table.name, right.findings) == (3, "RODAS-3", ())
    (table,) = tables(KPP.replace(old, new), "fortran")
    found = audit(table)
    assert found is not None
    assert [x.code for x in found.findings if x.code == code] == [code]
    assert any(message in x.message for x in found.findings)
    assert found.has_errors == (not code.endswith("higher"))


def test_orders_of_algorithms_are_those_of_their_tableaus(tmp_path: Path) -> None:
    """``alg_order`` of SciML is held against the tableau of that name."""
    text = bridges()["ordinarydiffeq"].written(payload("ros2-small"))
    start, _, rest = text.partition("function ")
    name = rest.partition("(")[0]
    source = tmp_path / "tableaus.jl"
    source.write_text(f"{start}function My2RodasTableau{rest[len(name) :]}", encoding="utf-8")
    told = tmp_path / "alg_utils.jl"
    told.write_text("alg_order(alg::My2) = 3\n", encoding="utf-8")
    run = gark("audit", str(tmp_path), "-v")
    assert run.code == 1
    assert "order 2, declared 3" in " ".join(run.out.split())


def test_the_file_claims_what_the_source_declares(tmp_path: Path) -> None:
    """The method file of a wrong table fails its check, that of a right one holds."""
    path = tmp_path / "methods.f90"
    path.write_text(KPP.replace("ros_ELO  = 3.0", "ros_ELO  = 4.0"), encoding="utf-8")
    made = tmp_path / "made.gark.yaml"
    assert gark("import", str(path), "-o", str(made)).code == 1
    assert gark("check", str(made)).code == 1
    assert gark("import", str(path), "--as-found", "-o", str(made)).code == 0
    assert gark("check", str(made)).code == 0
    text = made.read_text("utf-8")
    assert "transformed:" in text
    assert loads(text).tableau == load("rodas3").tableau


@pytest.mark.parametrize(("digit", "level"), [(13, "note"), (10, "error"), (4, "error")])
def test_a_misprint_is_never_passed_in_silence(digit: int, level: str) -> None:
    """A digit of a weight of Rodas4, which has fifteen, that is wrong by one: a note where careless
    rounding may be why, with the order of the digits as they are printed, else an error. The table
    as it is gives nothing.
    """
    (table,) = tables(bridges()["ordinarydiffeq"].written(payload("rodas4")), "julia")
    table = replace(table, order=4, error=None)
    right = audit(table)
    assert right is not None
    assert right.findings == ()
    first, *rest = table.b[0]
    first = to_decimal(fmpq_of(first), 16)
    assert first == "1.221224509226641"
    place = first.index(".") + digit
    wrong = f"{first[:place]}{(int(first[place]) + 1) % 10}{first[place + 1 :]}"
    found = audit(replace(table, b=((wrong, *rest),)))
    assert found is not None
    assert {x.level for x in found.findings} == {level}
    assert found.findings[0].message.startswith(
        "order 4 if decimals are off by" if level == "note" else "order 0, declared 4"
    )


@in_whole
def test_many_rounded_numbers_are_judged_one_by_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """The orders are those of the search for one method that meets all conditions."""
    (table,) = tables(bridges()["ordinarydiffeq"].written(payload("rodas4")), "julia")
    together = with_row_orders(table)
    monkeypatch.setattr("garkcli.bridges.rosenbrock.MANY", 1)
    alone = with_row_orders(table)
    assert alone.table.notes != together.table.notes
    orders = [[x and x.order for x in each.judged_orders] for each in (together, alone)]
    assert orders == [[4, 4, 3]] * 2
    assert all(x is not None and x.witness is not None for x in alone.judged_orders[:1])


SQUARE = """
subroutine two_stages(s, up, shift, ros_m, ros_e, ros_alpha, ros_gamma, ros_elo)
  integer, intent(in) :: s
  real(8) :: up(s,s), shift(s,s), other(s,s), ros_m(s), ros_e(s), ros_alpha(s), ros_gamma(s)
  g = 1 + 1/sqrt(2d0)
  other(2,1) = 1
  up(2,1) = 1/g
  shift(2,1) = -2/g
  ros_m(1) = 3/(2*g)
  ros_m(2) = 1/(2*g)
  ros_e(1) = 1/(2*g)
  ros_e(2) = 1/(2*g)
  ros_elo = 2
  ros_alpha(1) = 0
  ros_alpha(2) = 1
  ros_gamma(1) = g
  ros_gamma(2) = -g
end subroutine
"""


def test_the_matrices_of_kpp_by_their_row_sums() -> None:
    """Square matrices, whatever they are called, are those whose row sums are the nodes; none are
    with another sign.
    """
    (table,) = tables(SQUARE, "fortran")
    found = audit(table)
    assert found is not None
    assert found.order is not None
    assert (found.order.order, found.findings) == (2, ())
    assert not any(x.is_read for x in tables(SQUARE.replace("-2/g", "2/g"), "fortran"))


ROS3P = """
class {name}:
    order = 3
    gamma = 7.886751345948129e-01
    A = [[0, 0, 0], [1.267949192431123, 0, 0], [1.267949192431123, 0, 0]]
    C = [[0, 0, 0], [-1.607695154586736, 0, 0], [-3.464101615137755, -1.732050807568877, 0]]
    m = [2.0, 5.773502691896258e-01, 4.226497308103742e-01]
"""
"""The stored form of ROS3P."""
ROS2 = """
class {name}:
    order = 2
    g = 1.707106781186547524
    alpha = [[0, 0], [1, 0]]
    gamma = [[g, 0], [-3.414213562373095049, g]]
    b = [1 / 2, 1 / 2]
"""
MISPRINTED = {
    "digits of C change places": (ROS3P, "1.607695154586736", "1.670695154586736"),
    "a weight ten times too large": (ROS3P, "5.773502691896258e-01", "5.773502691896258"),
    "a digit of γ in α and Γ": (ROS2, "-3.414213562373095049", "-3.514213562373095049"),
}


@pytest.mark.parametrize("title", ["ROS3", "Solver"])
@pytest.mark.parametrize("what", MISPRINTED)
def test_a_misprint_hides_no_method(what: str, title: str) -> None:
    """The names and a declared order tell a method, and the number that would mend it is named."""
    source, right, wrong = MISPRINTED[what]
    text = source.format(name=title)
    (table,) = tables(text, "python")
    assert audit(table).findings == ()  # type: ignore[union-attr]
    (table,) = tables(text.replace(right, wrong), "python")
    found = audit(table)
    assert found is not None
    (finding,) = (x for x in found.findings if x.code == "order")
    assert (finding.level, found.has_errors) == ("error", True)
    declared = 3 if source is ROS3P else 2
    assert f"order {declared} would hold with " in finding.help
    assert wrong[:8] in finding.help


def test_mathematics_has_a_veto() -> None:
    """Two wrong signs, which no number mends: an error of a class called ROS3, and no table of
    another one; without a declared order nothing is known to be wrong.
    """
    wrong = ROS3P.replace("-1.6", "1.6").replace("-1.7", "1.7")
    (table,) = tables(wrong.format(name="ROS3"), "python")
    found = audit(table)
    assert found is not None
    assert [(x.code, x.help) for x in found.findings] == [("order", "")]
    (table,) = tables(wrong.format(name="Solver"), "python")
    found = audit(table)
    assert found is not None
    assert [(x.code, x.level) for x in found.findings] == [("unread", "note")]
    (table,) = tables(wrong.format(name="ROS3").replace("order = 3", ""), "python")
    assert not table.is_read


@pytest.mark.parametrize("name", ["e", "err"])
def test_the_estimate_of_a_stored_form(name: str) -> None:
    """The difference of the weights of ROS3P and its embedded ones of order 2; a row with another
    sum is no such difference.
    """
    text = ROS3P.format(name="Solver")
    row = f"    {name} = [-0.113248654051871, -0.4226497308103742, 0.0]\n"
    found = audit(tables(text + row, "python")[0])
    assert found is not None
    assert found.embedded_order is not None
    assert (found.embedded_order.order, found.has_errors) == (2, False)
    found = audit(tables(text + row.replace("-0.1", "-9.1"), "python")[0])
    assert found is not None
    assert (found.embedded_order, found.has_errors) == (None, False)
