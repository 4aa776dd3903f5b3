"""Low-storage, Shu–Osher and Nyström coefficients in sources: the methods that they are."""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli.bridges.audit import audit
from garkcli.bridges.claiming import imported
from garkcli.frozen import replace
from garkcli.methodfile.load import load
from garkcli.sources.found import FoundTable
from garkcli.sources.languages import c, fortran, julia, matlab, python
from garkcli.sources.registers import converted
from tests.cli.harness import gark

ROOT = Path(__file__).parents[2]
CARPENTER_KENNEDY = """
rk4a = [0, -567301805773/1357537059087, -2404267990393/2016746695238, ...
  -3550918686646/2091501179385, -1275806237668/842570457699];
rk4b = [1432997174477/9575080441755, 5161836677717/13612068292357, ...
  1720146321549/2090206949498, 3134564353537/4481467310338, 2277821191437/14882151754819];
rk4c = [0, 1432997174477/9575080441755, 2526269341429/6820363962896, ...
  2006345519317/3224310063776, 2802321613138/2924317926251];
"""
WILLIAMSON = """
static const double a[3] = {0., -5./9, -153./128}, b[3] = {1./3, 15./16, 8./15};
static const double c[3] = {0., 1./3, 3./4};
"""
KENNEDY = """
struct CKL54 <: Method
    a::SVector{5, Float64}
    function CKL54()
        a = SVector(0.0, 970286171893 / 4311952581923, 6584761158862 / 12103376702013,
                    2251764453980 / 15575788980749, 26877169314380 / 34165994151039)
        b = SVector(1153189308089 / 22510343858157, 1772645290293 / 4653164025191,
                    -1672844663538 / 4480602732383, 2114624349019 / 3568978502595,
                    5198255086312 / 14908931495163)
        c = SVector(0.0, a[2], b[1] + a[3], b[1] + b[2] + a[4], b[1] + b[2] + b[3] + a[5])
        return new(a, b, c)
    end
end
"""
RANOCHA = """
function RDPK3Sp35ConstantCache(::Type{T}) where {T}
    gamma1 = T[0, 2.587669070352079020144955303389306026e-01,
        -1.324366873994502973977035353758550057e-01, 5.055601231460399101814291350373559483e-02,
        5.670552807902877312521811889846000976e-01]
    gamma2 = T[1, 5.528418745102160639901976698795928733e-01,
        6.731844400389673824374042790213570079e-01, 2.803103804507635075215805236096803381e-01,
        5.521508873507393276457754945308880998e-01]
    gamma3 = T[0, 0, 0, 2.752585813446636957256614568573008811e-01,
        -8.950548709279785077579454232514633376e-01]
    delta = T[1, 3.407687209321455242558804921815861422e-01,
        3.414399280584625023244387687873774697e-01, 7.229302732875589702087936723400941329e-01, 0]
    beta = T[2.300285062878154351930669430512780706e-01,
        3.021457892454169700189445968126242994e-01, 8.025601039472704213300183888573974531e-01,
        4.362158997637629844305216319994356355e-01, 1.129268494470295369172265188216779157e-01]
    return gamma1, gamma2, gamma3, delta, beta
end
"""
NYSTROM = """
function DPRKN4Tableau(::Type{T}, ::Type{T2}) where {T, T2}
    a = zeros(T, 4, 4)
    a[2, 1] = convert(T, 1 // 32)
    a[3, 1] = convert(T, 7 // 1000); a[3, 2] = convert(T, 119 // 500)
    a[4, 1] = convert(T, 1 // 14); a[4, 2] = convert(T, 8 // 27); a[4, 3] = convert(T, 25 // 189)
    b = [convert(T, 1 // 14), convert(T, 8 // 27), convert(T, 25 // 189), zero(T)]
    bp = [convert(T, 1 // 14), convert(T, 32 // 81), convert(T, 250 // 567), convert(T, 5 // 54)]
    btilde = [1 // 14 + 7 // 150, 8 // 27 - 67 // 150, 25 // 189 - 3 // 20, 1 // 20]
    bptilde = [1 // 14 - 13 // 21, 32 // 81 + 20 // 27, 250 // 567 - 275 // 189, 5 // 54 + 1 // 3]
    c = T2[convert(T2, 1 // 4), convert(T2, 7 // 10), one(T2)]
    return NystromVITableau(a, b, bp, btilde, bptilde, c, false, 2)
end
"""
FORTRAN = """
module nystrom
  real, parameter :: abar(3,3) = reshape([0., 1./8, 0., 0., 0., 1./2, 0., 0., 0.], [3, 3])
  real, parameter :: bbar(3) = [1./6, 1./3, 0.], b(3) = [1./6, 2./3, 1./6], c(3) = [0., .5, 1.]
end module
"""
SHU_OSHER = """
alpha = [[1], [3/4, 1/4], [1/3, 0, 2/3]]
beta = [[1], [0, 1/4], [0, 0, 2/3]]
"""
ZEROS_FIRST = """
alpha = np.array([[0, 0], [1., 0], [0.261583187659478, 0.738416812340522]])
beta = np.array([[0, 0], [0.822875655532364, 0], [-0.215250437021539, 0.607625218510713]])
RK["SSP22star"] = ExplicitRungeKuttaMethod(alpha=alpha, beta=beta, name="SSPRK22star")
"""
FOUND = {
    "2N, Carpenter and Kennedy": (matlab.find, CARPENTER_KENNEDY, 4, None),
    "2N, Williamson": (c.find, WILLIAMSON, 3, None),
    "van der Houwen": (julia.find, KENNEDY, 4, None),
    "3S*": (julia.find, RANOCHA, 3, None),
    "Nyström": (julia.find, NYSTROM, 4, 3),
    "Nyström by names": (fortran.find, FORTRAN, 4, None),
    "Shu–Osher": (python.find, SHU_OSHER, 3, None),
    "Shu–Osher, a row of zeros first": (python.find, ZEROS_FIRST, 2, None),
}


def one(name: str) -> FoundTable:
    """The only table of a source."""
    find, text, *_ = FOUND[name]
    (table,) = find(text, "x")
    return table


@pytest.mark.parametrize("name", FOUND)
def test_the_order_is_that_of_the_paper(name: str) -> None:
    """Proved of the tableau, within the rounding of the printed digits, and no higher."""
    table = one(name)
    assert table.trouble == ""
    found = imported(table, "x")
    embedded = found.embedded_order
    assert found.order.order == FOUND[name][2]
    assert (None if embedded is None else embedded.order) == FOUND[name][3]


def test_names_and_forms() -> None:
    """A method has the name of its constructor, and the note says how its numbers were read."""
    told = {name: (one(name).name, one(name).notes) for name in FOUND}
    assert told["van der Houwen"][0] == "CKL54"
    assert told["3S*"] == (
        "RDPK3Sp35ConstantCache",
        ("the coefficients are those of the form 3S*",),
    )
    assert told["2N, Carpenter and Kennedy"][1][-1].endswith("the form 2N")


def test_the_same_method_in_two_forms() -> None:
    """The form of Shu and Osher is the tableau of the catalogue, exactly."""
    found = imported(one("Shu–Osher"), "x").method
    wanted = load(str(ROOT / "garkcli/catalogue/data/erk/ssp-33.gark.yaml"))
    assert (str(found.A), str(found.b)) == (str(wanted.A), str(wanted.b))


def test_numbers_tell_the_form() -> None:
    """Also without nodes; numbers that meet order 2 in no form are none."""
    text = "\n".join(WILLIAMSON.splitlines()[:2])
    (table,) = c.find(text, "x.c")
    assert (table.trouble, table.how) == ("", "the form 2N")
    (wrong,) = c.find(text.replace("15", "14"), "x.c") or [None]
    assert wrong is None


def test_a_wrong_number_is_found(tmp_path: Path) -> None:
    """In velocities' weights of a Nyström method: its sum is not 1."""
    (tmp_path / "n.jl").write_text(
        NYSTROM.replace("5 // 54)]\n    btilde", "5 // 53)]\n    btilde")
    )
    run = gark("audit", str(tmp_path))
    assert run.code == 1
    assert "the weights have the sum" in run.out


def test_a_wrong_start_is_told(tmp_path: Path) -> None:
    """A stage of 3S* that does not begin at the value of the step makes no method."""
    (tmp_path / "m.jl").write_text(RANOCHA.replace("-1.324366", "-1.424366"))
    run = gark("audit", "-v", str(tmp_path))
    assert "stage 4 begins at" in " ".join(run.out.split())


def test_fractions_that_are_exact_stay_so() -> None:
    """A fraction of eight digits is no approximant; one of thirteen is, to 23 digits and more."""
    b = ("7987313/109941300", "1767732205903/4055673282236", "0.5", "0.7886751345948")
    first, second, third, last = converted("2R", ("0",) * 3, b).b
    assert (first, third, last) == ("7987313/109941300", "1/2", "0.7886751345948")
    assert second.startswith("0.435866521508458999416019")  # 1767732205903/4055673282236
    assert len(second) <= 28


def findings(table: FoundTable) -> list[tuple[str, str]]:
    """What an audit says of a table: the codes and how bad they are."""
    found = audit(table)
    assert found is not None
    return [(x.code, x.level) for x in found.findings]


SHORT = """
function ORK256ConstantCache(T, T2)
    alg_order = 2
    A2 = convert(T, -1.0); A3 = convert(T, -1.55798); A4 = convert(T, -1.0)
    A5 = convert(T, -0.45031)
    A2end = SVector(A2, A3, A4, A5)
    B1 = convert(T, 0.2)
    B2end = SVector(convert(T, 0.83204), convert(T, 0.6), convert(T, 0.35394), convert(T, 0.2))
    c2end = SVector(convert(T2, 0.2), convert(T2, 0.2), convert(T2, 0.8), convert(T2, 0.8))
    return LowStorageRK2NConstantCache(A2end, B1, B2end, c2end)
end
"""


def test_numbers_of_few_digits_stay_rounded() -> None:
    """Order 2 is met within what the six digits of A3 leave open, however few digits the entries
    have that are made of it; a digit of it that is wrong is not explained.
    """
    (table,) = julia.find(SHORT, "x")
    assert imported(table, "x").order.order == 2
    assert findings(replace(table, order=2)) == []
    (wrong,) = julia.find(SHORT.replace("1.55798", "1.45798"), "x")
    assert findings(replace(wrong, order=2)) == [("order", "error")]


DECIMALS = """
static const double m_A[3][3] = {{0, 0, 0}, {0.333333, 0, 0}, {0, 0.666667, 0}};
static const double m_b[3] = {0.25, 0.0, 0.75};
static const double m_c[3] = {0, 0.333333, 0.666667};
static const int m_order = 3;
"""


def test_decimals_of_six_digits_are_rounded() -> None:
    """A method file has them as fractions, and still they may be off by their last digits."""
    (table,) = c.find(DECIMALS, "x")
    assert findings(table) == []
    (wrong,) = c.find(DECIMALS.replace("0.666667, 0}", "0.663667, 0}"), "x")
    assert findings(wrong) == [("order", "error")]


COMBINATIONS = """
  real(rp), parameter :: a(3) = [1.0_rp, 3.0_rp/4.0_rp, 1.0_rp/3.0_rp]
  real(rp), parameter :: b(3) = [0.0_rp, 1.0_rp/4.0_rp, 2.0_rp/3.0_rp]
  real(rp), parameter :: c(3) = [1.0_rp, 1.0_rp/4.0_rp, 2.0_rp/3.0_rp]
  real(rp), parameter :: d(3) = [0.0_rp, 1.0_rp, 0.5_rp]
"""


def test_combinations_of_two_values_and_f() -> None:
    """Each stage has y before the step, the one before, and f: Shu and Osher's method of order 3; d
    has the nodes. With another coefficient there is no such method.
    """
    text = f"module runge_kutta\n{COMBINATIONS}end module\n"
    (found,) = (audit(x) for x in fortran.find(text, "x"))
    assert found is not None
    assert found.order is not None
    assert (found.order.order, found.table.c) == (3, (("0", "1", "1/2"),))
    assert not found.has_errors
    for old, new in (("2.0_rp/3.0_rp]", "1.0_rp/3.0_rp]"), ("3.0_rp/4.0_rp", "1.0_rp/4.0_rp")):
        others = [audit(x) for x in fortran.find(text.replace(old, new), "x")]
        assert not any(x is not None and (x.is_read or x.has_errors) for x in others)


def test_five_rows_of_registers_with_names_of_their_own() -> None:
    """γ₁, γ₂, γ₃, δ and β in any order, in arrays of a case; without γ₃ there is no method."""
    names = {"gamma1": "rkg1", "gamma2": "rkg2", "gamma3": "rkg3", "delta": "rkd", "beta": "rkx"}
    text = RANOCHA
    for name, other in names.items():
        text = text.replace(f"{name} = T", f"{other} = T")
    text = text.split("return")[0].replace("RDPK3Sp35ConstantCache", "runge_kutta") + "end\n"
    (found,) = (audit(x) for x in julia.find(text, "x"))
    assert found is not None
    assert found.order is not None
    assert found.order.order == 3
    wrong = [
        audit(x)
        for x in julia.find(text.replace("rkg3 = T[0, 0, 0, 2.7", "rkg3 = T[0, 0, 0, 1.7"), "x")
    ]
    assert not any(x is not None and (x.is_read or x.has_errors) for x in wrong)
