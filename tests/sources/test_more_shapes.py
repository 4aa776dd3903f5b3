"""Tables as further programs store them, and what is told of numbers that make none."""

from __future__ import annotations

from fractions import Fraction
from time import monotonic
from types import ModuleType

import pytest

from garkcli.bridges.audit import Audited, audit
from garkcli.sources.found import Find, TooLarge
from garkcli.sources.languages import c, fortran, go, java, julia, matlab, python, rust, typescript

SHU_OSHER = """
function SSPRK33ConstantCache(::Type{T}, ::Type{T2}) where {T, T2}
    α20 = T(3 // 4); α21 = T(1 // 4); α30 = T(1 // 3); α32 = T(2 // 3)
    β10 = T(1); β21 = T(1 // 4); β32 = T(2 // 3)
    c1 = T2(1); c2 = T2(1 // 2)
    return SSPRK33ConstantCache(α20, α21, α30, α32, β10, β21, β32, c1, c2)
end
"""
GREEK = """
function RK3ConstantCache(T1, T2)
    α21 = T1(1 // 2); α31 = T1(-1); α32 = T1(2)
    β1 = T1(1 // 6); β2 = T1(2 // 3); β3 = T1(1 // 6)
    c1 = T2(1 // 2); c2 = T2(1)
    return RK3ConstantCache(α21, α31, α32, β1, β2, β3, c1, c2)
end
"""
STATIC = """
namespace Solvers {
const scalar
    RK23::c2 = 1.0/2.0, RK23::c3 = 3.0/4.0, RK23::c4 = 1.0,
    RK23::a21 = 1.0/2.0, RK23::a32 = 3.0/4.0,
    RK23::a41 = 2.0/9.0, RK23::a42 = 1.0/3.0, RK23::a43 = 4.0/9.0,
    RK23::b1 = 2.0/9.0, RK23::b2 = 1.0/3.0, RK23::b3 = 4.0/9.0,
    RK23::e1 = RK23::b1 - 7.0/24.0, RK23::e2 = RK23::b2 - 1.0/4.0,
    RK23::e3 = RK23::b3 - 1.0/3.0, RK23::e4 = -1.0/8.0;
}
"""
CALLED = """
void initialize( RungeKuttaCoefficients& heun )
{
    heun.lowerOrder = 1;
    heun.higherOrder = 2;
    heun.aCoefficients = Eigen::MatrixXd::Zero( 2, 2 );
    heun.aCoefficients( 1, 0 ) = 1.0;
    heun.cCoefficients = Eigen::VectorXd::Zero( 2 );
    heun.cCoefficients( 1 ) = 1.0;
    heun.bCoefficients = Eigen::MatrixXd::Zero( 2, 2 );
    heun.bCoefficients( 0, 0 ) = 1.0;
    heun.bCoefficients( 1, 0 ) = 1.0 / 2.0;
    heun.bCoefficients( 1, 1 ) = 1.0 / 2.0;
}
"""
PACKED = """
template <>
struct ButcherTableau<3, 3> {
  static constexpr int order = 4;
  static constexpr int nstages = 4;
  Kokkos::Array<double, (nstages * nstages + nstages) / 2> a{{0, 0.5, 0, 0, 0.5, 0, 0, 0, 1, 0}};
  Kokkos::Array<double, nstages> b{{1. / 6, 1. / 3, 1. / 3, 1. / 6}};
  Kokkos::Array<double, nstages> c{{0.0, 0.5, 0.5, 1.0}};
};
"""
NESTED = """
struct Heun {
  std::array<std::array<double, 2>, 2> a = {{ {{0.0, 0.0}}, {{1.0, 0.0}} }};
  std::array<double, 2> b{{0.5, 0.5}}, c{0.0, 1.0};
};
"""
TWO_ROWS = """
const bt_rk21 = TableauRKExplicit(:heun_euler, (2, 1), Rational{Int64},
                                  [0     0
                                   1     0],
                                  [1//2  1//2
                                   1     0],
                                  [0,    1])
"""
BLOCK = """
class Heun3(Solver):
    order = 3

    def _step_func(self, func, t0, y0):
        butcher_tableau = [
            [0.0, 0.0, 0.0, 0.0],
            [1/3, 1/3, 0.0, 0.0],
            [2/3, 0.0, 2/3, 0.0],
            [0.0, 1/4, 0.0, 3/4],
        ]
        return step(func, t0, y0, butcher_tableau)
"""
WRITTEN = {
    "the form of Shu and Osher": (julia.find, SHU_OSHER, 3, None),
    "Greek letters": (julia.find, GREEK, 3, None),
    "static members": (c.find, STATIC, 3, 2),
    "arrays that are called": (c.find, CALLED, 1, 2),
    "a triangle in an array of templates": (c.find, PACKED, 4, None),
    "arrays of arrays": (c.find, NESTED, 2, None),
    "two rows of weights": (julia.find, TWO_ROWS, 2, 1),
    "a block with an empty corner": (python.find, BLOCK, 3, None),
}


DICTIONARY = """
tables = {}
tables['RK2 Heun'] = (
[[sp.sympify(0)],
[sp.sympify(1), sp.sympify(1)],
["", sp.Rational(1,2), sp.Rational(1,2)]]
, 2)
tables['RK3'] = (
[[sp.sympify(0)],
[sp.Rational(1,2), sp.Rational(1,2)],
[sp.sympify(1), sp.sympify(-1), sp.sympify(2)],
["", sp.Rational(1,6), sp.Rational(2,3), sp.Rational(1,6)]]
, 3)

class LobattoIIIA(RungeKutta):
    tableaux = {
        2: array([[0., 0., 0.], [1., .5, .5], [1, .5, .5]]),
        3: array([[0, 0., 0., 0.], [1/2, 5/24, 1/3, -1/24], [1, 1/6, 2/3, 1/6],
                  [1, 1/6, 2/3, 1/6]]),
    }
"""
EMBEDDED = """
double rk_AHE[4][3] = {{0.0,0.0,0.0},{1.0,1.0,0.0},{2.0,1.0/2.0,1.0/2.0},{2.0,1.0,0.0}};
double rk_RK3[4][4] = {{0.0,0.0,0.0,0.0},{1.0/2.0,1.0/2.0,0.0,0.0},{1.0,-1.0,2.0,0.0},
                       {3.0,1.0/6.0,2.0/3.0,1.0/6.0}};
double rotation[3][3] = {{1.0,0.0,0.0},{0.0,0.0,-1.0},{0.0,1.0,0.0}};
double mass[3][3] = {{2.0,1.0,0.0},{1.0,4.0,1.0},{0.0,1.0,2.0}};
"""


def only(find: Find, text: str) -> Audited:
    """What an audit finds of the only table of a source."""
    (table,) = find(text, "x")
    found = audit(table)
    assert found is not None
    assert not table.trouble
    return found


@pytest.mark.parametrize("name", WRITTEN)
def test_the_order_is_that_of_the_method(name: str) -> None:
    """As published, no lower and no higher, and nothing is wrong with the table."""
    find, text, order, low = WRITTEN[name]
    found = only(find, text)
    assert found.order is not None
    assert found.order.order == order
    assert (found.embedded_order and found.embedded_order.order) == low
    assert {x.code for x in found.findings} <= {"stored"}


@pytest.mark.parametrize(
    ("name", "was", "wrong"),
    [
        ("the form of Shu and Osher", "β32 = T(2 // 3)", "β32 = T(1 // 3)"),
        ("static members", "RK23::b2 = 1.0/3.0", "RK23::b2 = 2.0/3.0"),
        ("arrays that are called", "( 1, 1 ) = 1.0 / 2.0", "( 1, 1 ) = 1.0 / 3.0"),
        ("two rows of weights", "1     0],\n                                  [0,", "1 1],\n[0,"),
        ("a block with an empty corner", "[0.0, 1/4, 0.0", "[0.0, 1/3, 0.0"),
    ],
)
def test_a_wrong_number_is_found(name: str, was: str, wrong: str) -> None:
    """One number of each is changed: an error, a warning, or a table that is not read."""
    find, text, *_ = WRITTEN[name]
    assert text.count(was) == 1
    (table,) = find(text.replace(was, wrong), "x")
    found = audit(table)
    assert found is not None
    assert found.findings


def test_an_entry_that_is_left_out_is_a_zero_at_the_end() -> None:
    """As C++ fills an array: 0 behind 1 moves, and the order is lost."""
    text = PACKED.replace("{{0, 0.5, 0, 0, 0.5", "{{0, 0.5, 0, 0.5")
    (error,) = [x for x in only(c.find, text).findings if x.code == "order"]
    assert error.message.startswith("order 2, declared 4")


@pytest.mark.parametrize(
    ("find", "text", "wanted"),
    [
        (
            python.find,
            DICTIONARY,
            [
                ("RK2 Heun", 3, 2, None),
                ("RK3", 8, 3, None),
                ("LobattoIIIA 2", 16, 2, None),
                ("LobattoIIIA 3", 16, 4, None),
            ],
        ),
        (c.find, EMBEDDED, [("rk_AHE", 2, 2, 1), ("rk_RK3", 3, 3, None)]),
    ],
)
def test_blocks_without_names(find: Find, text: str, wanted: list[object]) -> None:
    """A matrix [c A; q b] is one where its rows have the sums c and b has the sum 1, whatever it is
    called, but for its key; other matrices are none.
    """
    judged = [audit(x) for x in find(text, "x")]
    found = [
        (
            x.table.name,
            x.table.line,
            x.order and x.order.order,
            x.embedded_order and x.embedded_order.order,
        )
        for x in judged
        if x is not None
    ]
    assert found == wanted
    assert not any(x and x.findings for x in judged)


RECORD = "[0 0 0; 1 0 0; 1//4 1//4 0], [1//6, 1//6, 2//3], [0, 1, 1//2], 3"
SSP_3 = (
    (julia, f"struct Tableau\n  A\n  b\n  c\n  order\nend\nssp() = Tableau({RECORD})"),
    (
        julia,
        "struct Tableau{T}\n  A::Matrix{T}\n  b::Vector{T}\n  c::Vector{T}\n  order\n"
        "  function Tableau{T}(A, b, c, order) where {T}\n    new{T}(A, b, c, order)\n  end\nend\n"
        f"ssp() = Tableau({RECORD})",
    ),
    (
        julia,
        "T3(T) = (A = SMatrix{3, 3, T}(0, 1, 1//4, 0, 0, 1//4, 0, 0, 0), b = [1//6, 1//6, 2//3])",
    ),
    (
        julia,
        "Base.@kwdef struct T3\n  A = [0 0 0; 1 0 0; 1//4 1//4 0]\n  b = [1//6, 1//6, 2//3]\n  c = [0, 1, 1//2]\nend",
    ),
    (
        julia,
        "function t()\n  A = zeros(3, 3)\n  for i in 2:3, j in 1:i-1\n    A[i, j] = 5//2 - 3//4*i\n  end\n"
        "  b = [1//6, 1//6, 2//3]\n  c = [0, 1, 1//2]\n  RK(A, b, c)\nend",
    ),
    (
        python,
        "class T(NamedTuple):\n    order: int\n    A: list\n    b: list\n    name: str = ''\n"
        "x = T(3, [[], [1], [1/4, 1/4]], [1/6, 1/6, 2/3])",
    ),
    (
        python,
        "class T:\n    @property\n    def A(self):\n        return [[], [1], [1/4, 1/4]]\n"
        "    b = [1/6, 1/6, 2/3]\n    c = [0, 1, 1/2]\n",
    ),
    (
        python,
        "class T:\n    def __init__(self):\n        self.b = [1/6, 1/6, 2/3]\n        self.c = [0, 1, 1/2]\n"
        '        self.register_buffer("A", torch.tensor([[0, 0, 0], [1, 0, 0], [1/4, 1/4, 0]]))',
    ),
    (
        c,
        "typedef struct { int order; double A[3][3]; double b[3], c[3]; } table;\n"
        "table t = {3, {{0}, {1}, {.25, .25}}, {1./6, 1./6, 2./3}, {0, 1, .5}};",
    ),
    (
        c,
        "struct T { T() { A << 0, 0, 0, 1, 0, 0, .25, .25, 0; b << 1./6, 1./6, 2./3; c << 0, 1, .5; } };",
    ),
    (
        c,
        "struct T { Matrix A = Matrix::Zero(3, 3); T() { A.row(1) << 1, 0, 0; A.row(2) << .25, .25, 0;"
        " b << 1./6, 1./6, 2./3; c << 0, 1, .5; } };",
    ),
    (
        c,
        "struct T { double b[3]; std::vector<double> A[3]; int order; };\n"
        "T all[] = {{{1./6, 1./6, 2./3}, {{0}, {1}, {.25, .25}}, 3}};",
    ),
    (
        c,
        "__constant__ double d_A[3][3] = {{0}, {1}, {.25, .25}};\n__device__ double d_b[3] = {1./6, 1./6,"
        " 2./3};\n__constant__ double d_c[3] = {0, 1, .5};",
    ),
    (
        c,
        "struct T { double A[4][4], b[4], c[4]; };\nT ssp = {{{0, 0, 0, 0}, {1, 0, 0, 0}, {.25, .25, 0, 0}},"
        " {1./6, 1./6, 2./3}, {0, 1, .5}};",
    ),
    (
        c,
        "#define A21 1.0\n#define A31 0.25\n#define A32 0.25\n#define B1 (1.0/6)\n#define B2 (1.0/6)\n"
        "#define B3 (2.0/3)\n#define C2 1.0\n#define C3 0.5\n",
    ),
    (
        fortran,
        "real(8) :: a(3,3), b(3), c(3)\ndata a /0d0, 1d0, 0.25d0, 2*0d0, 0.25d0, 3*0d0/\n"
        "b = [1d0/6, 1d0/6, 2d0/3]\nc = [0d0, 1d0, 0.5d0]\n",
    ),
    (
        fortran,
        "allocate(t%A(3,3), t%b(3))\nt%A = 0d0\nt%A(2,1) = 1d0\nt%A(3,1) = 0.25d0\nt%A(3,2) = 0.25d0\n"
        "t%b = [1d0/6, 1d0/6, 2d0/3]\nt%c = [0d0, 1d0, 0.5d0]\n",
    ),
    (
        fortran,
        "type :: rk\n  real(8) :: a(3,3), b(3), c(3)\nend type\ntype(rk) :: t = rk(reshape([0d0, 0d0, 0d0, 1d0,"
        " 0d0, 0d0, 0.25d0, 0.25d0, 0d0], [3,3], order=[2,1]), [1d0/6, 1d0/6, 2d0/3], [0d0, 1d0, 0.5d0])\n",
    ),
    (
        fortran,
        "real(8), dimension(0:2, 0:2) :: a = 0d0\nreal(8) :: b(3), c(-1:1)\n"
        "data b, a21 / 2*0.1666666666666667d0, 0.6666666666666667d0, 1d0 /\n"
        "c = [0d0, 1d0, 0.5d0]\na(1,0) = a21\na(2,0:1) = 0.25d0\n",
    ),
    (
        fortran,
        "real(8) :: a21, a31, a32, b1, b2, b3, c2, c3\ndata a21, a31, a32 /1d0, 2*0.25d0/, b1, b2, b3, c2, c3"
        " / 2*0.1666666666666667d0, 0.6666666666666667d0, 1d0, 0.5d0 /\n",
    ),
    (matlab, "A = zeros(3); A(2,1) = 1; A(3,1:2) = [1 1]/4; b = [1 1 4]/6; c = [0 1 1/2];"),
)


@pytest.mark.parametrize(("language", "text"), SSP_3)
def test_the_same_method_however_it_is_stored(language: ModuleType, text: str) -> None:
    """SSP 3, in records by position, with fields that have values, by columns, as properties, with
    the comma of Eigen, in data statements, with indices from 0: one table each, of order 3.
    """
    if language is fortran:
        text = f"program p\n{text}end program\n"
    (table,) = language.find(text, "x.h")
    judged = audit(table)
    assert judged is not None
    assert judged.order is not None
    assert (judged.order.order, {x.code for x in judged.findings} - {"stored"}) == (3, set())


def test_loops_of_data_statements_make_no_zeros() -> None:
    """Which entries ``data`` fills by loops with unknown ends is not followed: the table is told as
    unread.
    """
    data = "data ((a(i, j), j = 1, i-1), i = 2, n), b /1d0, 2*0.25d0, 2*0.1666666666666667d0, 0.6666666666666667d0/"
    text = f"program p\nreal(8) :: A(3,3) = 0d0, b(3), c(3)\n{data}\nc = [0d0, 1d0, 0.5d0]\nend program\n"
    (table,) = fortran.find(text, "x.f90")
    assert (table.trouble, table.b) == ("an entry at an unknown place, line 3, is not known", ())


@pytest.mark.parametrize(
    "many",
    [
        "(a(2,j), j=1,999999999)",
        "a(1:99999999999999999999999,1)",
        "(((b(k), i=2,1), j=1,200), k=1,200)",
    ],
)
def test_data_statements_without_end(many: str) -> None:
    """More entries than a method has, or loops that fill none: not followed, and soon."""
    text = (
        f"program p\nreal(8) :: A(2,2) = 0d0, b(2)\ndata {many} / 1d0 /\nb = 0.5d0\nend program\n"
    )
    assert not any(x.b for x in fortran.find(text, "x.f90"))


ENTRIES = {
    "sets for single entries": "a(2,1) / 1d0 /, a(3, 1) / 0.25d0 /, a(3,2)/0.25d0/",
    "a set for several entries": "a(2,1), a(3,1), a(3,2) / 1d0, 2*0.25d0 /",
    "loops": "(a(2,j), j = 1, 2) / 1d0, 0d0 /, (a(3,j), j=1,2) / 2*0.25d0 /",
    "nested loops": "((a(i, j), j = 1, i-1), i = 2, 3) / 1d0, 2*0.25d0 /",
    "loops backwards": "((a(i, j), j = i-1, 1, -1), i = 3, 2, -1) / 2*0.25d0, 1d0 /",
    "several entries in a loop": "(a(i,1), a(i,2), i = 2, 3) / 1d0, 0d0, 0.25d0, 0.25d0 /",
    "rows": "a(2,:) / 1d0, 2*0d0 /, a(3,:2) / 2*0.25d0 /",
    "a block": "a(2:3, 1:2) / 1d0, 0.25d0, 0d0, 0.25d0 /",
}


@pytest.mark.parametrize("how", ENTRIES)
def test_entries_of_data_statements(how: str) -> None:
    """SSP 3: entries by their indices, by loops, by slices."""
    text = (
        f"program p\nreal(8) :: A(3,3) = 0d0, b(3), c(3)\ndata {ENTRIES[how]}\n"
        "b = [1d0/6, 1d0/6, 2d0/3]\nc = [0d0, 1d0, 0.5d0]\nend program\n"
    )
    (table,) = fortran.find(text, "x.f90")
    ((A,),) = table.A
    assert A is not None
    assert [[float(Fraction(x)) for x in row] for row in A] == [[0] * 3, [1, 0, 0], [0.25, 0.25, 0]]
    judged = audit(table)
    assert judged is not None
    assert judged.order is not None
    assert judged.order.order == 3


@pytest.mark.parametrize("part", ["A.bottomRows(1)", "A.row(2).head(2)", "A.coeffRef(2, 0) ="])
def test_a_part_that_is_not_followed_makes_no_zeros(part: str) -> None:
    """What is assigned to parts of a matrix of Eigen in other ways: the table is told as unread."""
    sign = "" if part.endswith("=") else "<<"
    body = f"A << 0, 0, 0, 1, 0, 0, 0, 0, 0; {part} {sign} 0.25; {part} {sign} 0.5; b << 1./6, 1./6, 2./3;"
    (table,) = c.find(f"struct T {{ T() {{ {body} c << 0, 1, .5; log() << 1; }} }};", "x.h")
    assert (table.trouble, table.b) == ("an entry at an unknown place, line 1, is not known", ())


def test_calls_that_are_known_keep_their_meaning() -> None:
    """A record of kicks and drifts, whatever its fields are called, is no A and b."""
    made = "SymplecticTableau([1, 0], [1//2, 1//2])"
    text = f"struct SymplecticTableau\n  a\n  b\nend\nleapfrog(T) = {made}\n"
    (table,) = julia.find(text, "x.jl")
    judged = audit(table)
    assert judged is not None
    assert judged.order is not None
    assert (table.colours, judged.order.order, judged.findings) == (2, 2, ())


def test_tables_one_after_the_other_are_not_mixed() -> None:
    """Arrays of the same names, assigned anew: no matrix is with the weights of another table."""
    first, second = "A = [0 0; 1 0]; b = [1/2 1/2];", "A = [0 0; 1/2 0]; b = [0 1];"
    for text in (f"{first}\n{second}", f"{first}\n{second}\n{first}".replace("; b", "\nb")):
        found = {(x.A[0][0][1][0], x.b[0]) for x in matlab.find(text, "x.m")}
        assert found == {("1", ("1/2", "1/2")), ("1/2", ("0", "1"))}
    *_, mixed = matlab.find(f"{first}\nA = [0 0; 1/2 0];", "x.m")
    assert (mixed.trouble, mixed.b) == ("A is assigned anew without b, or b without A", ())


def test_arguments_that_are_a_table_are_one() -> None:
    """Kutta's third order, for a class whose parameters are not known; a linear system is none."""
    arguments = "[[0, 0, 0], [1/2, 0, 0], [-1, 2, 0]], [1/6, 2/3, 1/6], [0, 1/2, 1]"
    found = only(python.find, f"k = Tab({arguments})")
    assert found.order is not None
    assert found.order.order == 3
    assert python.find("solve([[0, 0], [1, 0]], [1/2, 1/2], [1, 1])", "x.py") == []


@pytest.mark.parametrize("name", ["butcher_tableau", "rk_table", "a_stable", "p_stable_by_c"])
def test_a_matrix_with_a_name_is_no_block(name: str) -> None:
    """Lobatto IIIA 3: its last row has the sum 1, and more rows have nearly their first entry for
    sum. A is A, whatever is before it.
    """
    entries = "{{0, 0, 0}, {5.0/24, 1.0/3, -1.0/24}, {1.0/6, 2.0/3, 1.0/6}}"
    text = (
        f"double {name}_A[3][3] = {entries};\ndouble {name}_b[3] = {{1.0/6, 2.0/3, 1.0/6}};\n"
        f"double {name}_c[3] = {{0, 0.5, 1}};\n"
    )
    (table,) = c.find(text, "x.c")
    judged = audit(table)
    assert judged is not None
    assert judged.order is not None
    assert (judged.order.order, judged.findings) == (4, ())


def test_general_linear_methods_are_none_of_runge_kutta() -> None:
    """A, B and U: the second row of B is no embedded method."""
    text = "A = [[0, 0], [1, 0]]\nB = [[1/2, 1/2], [0, 1]]\nU = [[1, 0], [1, 1]]\n"
    (table,) = python.find(text, "x.py")
    assert table.kind == "general linear"


def test_whole_numbers_alone_are_no_block() -> None:
    """Bounds of integrals: a row after two has the sum 1 behind a 1, as an order before weights."""
    assert python.find("b = [[1, 1, 1], [0, 0, 0], [1, 0, 1], [0, 1, 0]]\n", "x.py") == []
    (table,) = python.find("b = [[0, 0, 0], [1/2, 1/2, 0], [2, 0, 1]]\n", "x.py")
    assert table.order == 2


def test_numbers_with_names_of_coefficients_are_told() -> None:
    """Methods with parallel stages are not read; that they are there is told."""
    text = """
    function KuttaPRK2p5ConstantCache(::Type{T}, ::Type{T2}) where {T, T2}
        α21 = T(1 // 3); α31 = T(4 // 25); α32 = T(6 // 25)
        β1 = T(23 // 192); β3 = T(125 // 192); β5 = T(-81 // 192); β6 = T(125 // 192)
        c2 = T2(1 // 3); c3 = T2(2 // 5)
        return KuttaPRK2p5ConstantCache(α21, α31, α32, β1, β3, β5, β6, c2, c3)
    end
    """
    (table,) = julia.find(text, "x.jl")
    assert table.name == "KuttaPRK2p5ConstantCache"
    found = audit(table)
    assert found is not None
    assert found.looks_like


BESIDE = """
case Types::Heun:
    nodes = {0.0, 1.0};
    tableau = {{0.0}, {1.0, 0.0}};
    weights = {0.5, 0.5};
    break;
case Types::RK4:
    nodes = {0.0, 0.5, 0.5, 1.0};
    tableau = {{0.0}, {0.5, 0.0}, {0.0, 0.5, 0.0}, {0.0, 0.0, 1.0, 0.0}};
    weights = {1./6., 1./3., 1./3., 1./6.};
    break;
"""
KICKS = """
struct coef_a_type : public std::array<Value, 2>
{ coef_a_type(void) { (*this)[0] = 0.5; (*this)[1] = (*this)[0]; } };
struct coef_b_type : public std::array<Value, 2>
{ coef_b_type(void) { (*this)[0] = 1.0; (*this)[1] = 0.0; } };
"""
LETTERS = """
class RK3(Coefficients):
    def __init__(self):
        self._alpha: NDArray[np.double] = np.asarray([1/2, -1.0, 2.0])
        self._gamma: NDArray[np.double] = np.asarray([0.0, 1/2, 1.0])
        self._beta: NDArray[np.double] = np.asarray([1/6, 2/3, 1/6])
        self._beta_star: NDArray[np.double] = np.asarray([0.0, 1.0, 0.0])
"""
PARTS = """
class IMEX(RungeKuttaIMEX):
    nodes = np.array([0, 1])
    weights = np.array([0, 1])
    weights_explicit = np.array([1, 0])
    matrix = np.array([[0, 0], [0, 1]])
    matrix_explicit = np.array([[0, 0], [1, 0]])
"""
BARS = """
class RKN(RungeKuttaNystrom):
    nodes = np.array([0.0, 0.5, 0.5, 1])
    weights = np.array([1.0, 2.0, 2.0, 1.0]) / 6.0
    matrix = np.array([[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]])
    weights_bar = np.array([1.0, 1.0, 1.0, 0]) / 6.0
    matrix_bar = np.array([[0, 0, 0, 0], [1/8, 0, 0, 0], [1/8, 0, 0, 0], [0, 0, 1/2, 0]])
"""
OF_STAGES = """
heun_tableau_matrix = [[0, 0, 0], [1/3, 1/3, 0], [2/3, 0, 2/3]]
heun_b = [1/4, 0, 3/4]
heun_c = [0, 1/3, 2/3]
"""


@pytest.mark.parametrize(
    ("find", "text", "wanted"),
    [
        (c.find, f"void f() {{ switch (t) {{ {BESIDE} }} }}", [(2, 1, None), (4, 1, None)]),
        (c.find, KICKS, [(2, 2, None)]),
        (python.find, LETTERS, [(3, 1, 2)]),
        (python.find, PARTS, [(1, 2, None)]),
        (python.find, BARS, [(4, 2, None)]),
        (python.find, OF_STAGES, [(1, 1, None)]),
    ],
)
def test_matrices_beside_weights_and_parts(find: Find, text: str, wanted: list[object]) -> None:
    """Tableaus with weights of their own are A; both parts of a pair are read; α, β, γ in rows."""
    found = [audit(table) for table in find(text, "x")]
    told = [
        (x.order and x.order.order, x.table.colours, x.embedded_order and x.embedded_order.order)
        for x in found
        if x is not None
    ]
    assert told == wanted


def test_weights_of_a_block_matrix_may_be_wrong() -> None:
    """[c A; q b] without a name: the rows are those of an explicit method, 1/7 should be 1/6."""
    text = "x = [[0, 0, 0, 0, 0], [1/2, 1/2, 0, 0, 0], [1/2, 0, 1/2, 0, 0], [1, 0, 0, 1, 0]"
    (table,) = python.find(f"{text}, [0, 1/6, 1/3, 1/3, 1/7]]", "x")
    found = audit(table)
    assert found is not None
    assert [x.code for x in found.findings] == ["weights"]


def test_functions_that_make_tables_are_told() -> None:
    """By their names, with numbers that have no roles: of another kind, or not read."""
    numbers = ", ".join(f"{i}.5" for i in range(9))
    for name, kind in (("ROCK2ConstantCache", "stabilized"), ("constructXY", "")):
        (table,) = julia.find(f"function {name}(T)\n    q = [{numbers}]\n    q\nend\n", "x")
        assert (table.kind, bool(table.trouble)) == (kind, not kind)
    assert julia.find(f"function other(T)\n    q = [{numbers}]\n    q\nend\n", "x") == []


FURTHER = """
module tables
real(wp), parameter :: rk_c(2:*) = [1.0_wp/2.0_wp, 1.0_wp, 1.0_wp]
real(wp), parameter :: rk_b(*) = [1.0_wp/6.0_wp, 2.0_wp/3.0_wp, 1.0_wp/6.0_wp]
real(wp), parameter :: rk_bh(*) = [0.0_wp, 1.0_wp, 0.0_wp]
real(wp), parameter :: rk_a(1:*) = [1.0_wp/2.0_wp, -1.0_wp, 2.0_wp, &
  1.0_wp/6.0_wp, 2.0_wp/3.0_wp, 1.0_wp/6.0_wp]
end module
"""
NEW = """
Gauss4::Gauss4(int n) {
    int nk = 2;
    a = new double*[nk];
    for (int i = 0; i < nk; i++) a[i] = new double[nk];
    b = new double[nk];
    double r = sqrt(3.0)/6;
    a[0][0] = 1.0/4; a[0][1] = 1.0/4 - r;
    a[1][0] = 1.0/4 + r; a[1][1] = 1.0/4;
    b[0] = 1.0/2; b[1] = 1.0/2;
}
"""
SHIFTED = """
alpha = np.diag(np.ones(3), -1)
alpha[3, 0] = 1/3
alpha[2, 0] = 3/4
alpha[2, 1] = 1/4
alpha[3, 2] = 2/3
alpha = alpha[:, :3]
beta = np.zeros([4, 3])
beta[1, 0] = 1
beta[2, 1] = 1/4
beta[3, 2] = 2/3
"""


@pytest.mark.parametrize(
    ("find", "text", "order", "low"),
    [(fortran.find, FURTHER, 3, 2), (c.find, NEW, 4, None), (python.find, SHIFTED, 3, None)],
)
def test_further_stages_new_arrays_diagonals(
    find: Find, text: str, order: int, low: int | None
) -> None:
    """A flat triangle with stages of dense output beside fewer weights; a matrix without nodes that
    meets order 2; a diagonal below the main one.
    """
    (table,) = find(text, "x")
    found = audit(table)
    assert found is not None
    assert found.order is not None
    assert found.order.order == order
    assert {x.level for x in found.findings} <= {"note"}
    assert (found.embedded_order and found.embedded_order.order) == low


@pytest.mark.parametrize(
    ("name", "last", "b", "is_told"),
    [
        ("rk", "0, 1, 0]", "[0.0, 0.6, 0.5]", True),
        ("rk", "1, 2, 3]", "[3.0, 4.0, 5.0]", True),
        ("my", "1, 2, 3]", "[3.0, 4.0, 5.0]", False),
    ],
)
def test_what_fits_no_reading_is_told(name: str, last: str, b: str, is_told: bool) -> None:
    """Where its name is that of a method: elsewhere it is a linear system."""
    rows = f"[[0, 0, 0], [0.5, 0, 0], [{last}]"
    (table,) = python.find(f"{name}_A = {rows}\n{name}_b = {b}\n", "x")
    found = audit(table)
    assert (found is not None and found.looks_like) == is_told


KUTTA = "[0 0 0; 1/2 0 0; -1 2 0]"
HEUN = "A = [[0, 0], [1, 0]]\nb = [1/2, 1/2]\n"
OF_TYPE = """
template <typename T, typename = void> struct Kutta {
  static constexpr T a[2][2] = {{T(0), T(0)}, {T(1) / T(2), T(0)}}, b[2] = {T(0), T(1)};
};
"""


@pytest.mark.parametrize(
    ("find", "text", "orders", "told"),
    [
        (matlab.find, "r.A = [0 0; 1 0]; r.b = [.5 .5]; r.A = [0 0; .5 0]; r.b = [0 1];", "22", ""),
        (matlab.find, "A_1 = [0 0; 1 0]; b_1 = [.5 .5];", "-", "A and b have numbers"),
        (matlab.find, f"A = {KUTTA}; b = [1 4 1] / 6; c = sum(A, 2);", "3", ""),
        (julia.find, f"const K = (; A = SA{KUTTA}, b = SA[1/6, 2/3, 1/6])", "3", ""),
        (c.find, OF_TYPE, "2", ""),
        (python.find, f"{HEUN}if x:\n    b = [1/4, 3/4]\n    A[1][0] = 2/3", "2-", "anew"),
        (python.find, f"{HEUN}c = [0, f(1)]", "2", "nodes are not read: the call f"),
        (python.find, f"{HEUN}c = f(1)", "2", "nodes are not read: the call f"),
    ],
)
def test_what_is_not_read_is_told(find: Find, text: str, orders: str, told: str) -> None:
    """Structures and arrays that are assigned anew, types of templates, unknown nodes."""
    tables = find(text, "x")
    found = [audit(x) for x in tables]
    shown = [str(x.order.order) if x is not None and x.order else "-" for x in found]
    assert "".join(shown) == orders
    texts = "".join(y for x in tables for y in (*x.notes, x.trouble))
    assert told in texts
    assert bool(told) == bool(texts)


ELSEWHERE = """
module kutta
  real, allocatable :: W(:), M(:,:)
contains
  subroutine set(n)
    call allocate_them(n)
    select case (n)
    case (3)
      M(2,1) = 0.5
      M(3,1:2) = [-1.0, 2.0]
      W(1:3) = [1.0/6.0, 2.0/3.0, 1.0/6.0]
    case (4)
      M(2,1) = 1.0/3.0
      M(3,1:2) = [-1.0/3.0, 1.0]
      M(4,1:3) = [1.0, -1.0, 1.0]
      W(1:4) = [0.125, 0.375, 0.375, 0.125]
    end select
  end subroutine
end module
"""


def test_arrays_that_are_allocated_elsewhere() -> None:
    """Each case has a table of its own; entries that it does not assign are zeros where that makes
    a method, and otherwise unknown.
    """
    tables = fortran.find(ELSEWHERE, "x.f90")
    found = [audit(x) for x in tables]
    assert [x.order.order for x in found if x is not None and x.order] == [3, 4]
    # what is behind their letters tells which arrays belong together
    pair = ELSEWHERE.replace("M(", "A_ex(").replace("W(", "w_ex(")
    assert [x.name for x in fortran.find(pair, "x.f90") if x.is_read] == ["ex", "ex"]
    wrong = ELSEWHERE.replace("2.0]", "9.0]").replace("-1.0, 1.0]", "-1.0, 9.0]")
    for text in (wrong, wrong.replace("M(", "A(").replace("W(", "b(")):
        assert not any(x.is_read for x in fortran.find(text, "x.f90"))


@pytest.mark.parametrize(
    ("find", "text"),
    [
        (rust.find, "fn f() { let a = [1.0, 2.0]; let b = a.map(|x, y| x); }"),
        (python.find, "x.A = [[0, 0], [1, 0]]\ny = x.A()\n"),
        (fortran.find, "program p\nreal :: a(2)\na = [1.0, 2.0]\na() = 3.0\nend program\n"),
    ],
)
def test_an_entry_without_an_index_is_no_fault(find: Find, text: str) -> None:
    """Neither as a call nor as what is assigned to."""
    assert [x for x in find(text, "x") if not x.trouble] == []


@pytest.mark.parametrize("text", ["A = [0]\n" + "A = [A]\n" * 3000, "b = 1\n" + "b = [b]\n" * 150])
def test_values_that_hold_one_another_have_a_limit(text: str) -> None:
    """No recursion of Python ends the program."""
    with pytest.raises(TooLarge, match="nested too deep"):
        python.find(text, "x")


NUMBERED = """
const double pair::c2 = 1.0/3.0, pair::c3 = 2.0/3.0;
const double pair::a21 = 1.0/3.0, pair::a31 = 0.0, pair::a32 = 2.0/3.0;
const double pair::b11 = 1.0/4.0, pair::b12 = 0.0, pair::b13 = 3.0/4.0;
const double pair::b21 = -1.0/2.0, pair::b22 = 3.0/2.0, pair::b23 = 0.0;
"""


def test_weights_in_two_rows_of_numbers() -> None:
    """b11 to b23 are two rows of weights: Heun's method of order 3, and one of order 2."""
    (found,) = (audit(x) for x in c.find(NUMBERED, "x.cpp"))
    assert found is not None
    assert found.order is not None
    assert found.embedded_order is not None
    assert (found.order.order, found.embedded_order.order) == (3, 2)
    wrong = [audit(x) for x in c.find(NUMBERED.replace("b13 = 3.0", "b13 = 1.0"), "x.cpp")]
    assert not any(x is not None and x.order and x.order.order == 3 for x in wrong)


OCTAVE = """
function [t] = step (x)
  persistent a = [0 0 0; 1/2 0 0; 0 3/4 0];   # "stages"
  persistent b = [0, 1/2, 3/4, 1];
  if (! isempty (x) && x != 1)
    y = 1;
  endif
  persistent c = [2/9, 1/3, 4/9];
endfunction
"""


def test_words_of_octave() -> None:
    """Values that stay, other comments, negations and ends: the method of Bogacki and Shampine."""
    (found,) = (audit(x) for x in matlab.find(OCTAVE, "runge_kutta_23.m"))
    assert found is not None
    assert found.order is not None
    assert (found.order.order, found.table.b) == (3, (("2/9", "1/3", "4/9"),))


def test_negations_in_a_line_of_octave() -> None:
    """Any number of them take the time of the line; those in texts and comments stay."""
    text = f"x = {' + '.join(['!a'] * 6_000)}  # !b\nendif\ny = 'c!d' + !e\n"
    began = monotonic()
    made = matlab.as_matlab(text)
    assert monotonic() - began < 2
    assert made == text.replace("!a", "~a").replace("endif", "end  ").replace("#", "%")


def test_a_matrix_of_zeros_has_no_nodes() -> None:
    """Slopes at other times make no method, whatever order is declared; zeros alone are Euler's."""
    text = "class RungeKutta:\n    order = 2\n    A = [[0, 0], [0, 0]]\n    b = [1/2, 1/2]\n"
    (found,) = (audit(x) for x in python.find(f"{text}    c = [-1, 1]\n", "x"))
    assert found is not None
    assert [x.level for x in found.findings] == ["note"]
    (euler,) = (audit(x) for x in python.find(f"{text}    c = [0, 0]\n", "x"))
    assert euler is not None
    assert euler.has_errors


LATER = """
class RungeKutta4:
    A = zeros((6, 6))
    A[1, 0] = A[2, 1] = 1/2
    A[3, 2] = 1
    A[4, :4] = [1/6, 1/3, 1/3, 1/6]
    A[5, 0] = 1/4
    b = A[4, :4]
    c = [0, 1/2, 1/2, 1, 1, 1/4]
"""


def test_stages_of_dense_output_are_left_out() -> None:
    """The first of them begins at the end of the step; otherwise the arrays do not fit."""
    (found,) = (audit(x) for x in python.find(LATER, "x.py"))
    assert found is not None
    assert found.order is not None
    assert (found.order.order, found.table.stages, found.has_errors) == (4, 4, False)
    old, new = "A[5, 0] = 1/4", "A[5, 0] = A[1, 5] = 1/4"
    assert any(x.trouble for x in python.find(LATER.replace(old, new), "x.py"))
    (found,) = (audit(x) for x in python.find(LATER.replace("A[3, 2] = 1", "A[3, 2] = 2"), "x.py"))
    assert found is not None
    assert [x.code for x in found.findings if x.level == "error"] == ["nodes"]
    wrong = LATER.replace("b = A[4, :4]", "b = [1/6, 1/3, 1/3, 1/3]")
    assert any(x.trouble for x in python.find(wrong, "x.py"))


NYSTROM_COLUMNS = """
function [c, A, B, Bp, Bhat, Bphat] = coefficients()
  % of Nyström, order 4, with weights of lower order beside them
  c = [0
       1/2
       1];
  A = zeros(3);
  A(2,1:1) = 1/8;
  A(3,1:2) = [0
              1/2];
  A = A.';
  Bhat = [1/6
          1/3
          0];
  Bphat = [1/6
           2/3
           1/6];
  B = [1/6
       0
       1/3];
end
"""


def test_columns_of_matlab_are_rows_of_a_nystrom_method() -> None:
    """A column in a slice of a row has its entries; weights called B are those of lower order."""
    found = [x for x in map(audit, matlab.find(NYSTROM_COLUMNS, "x.m")) if x and x.order]
    assert [(x.order.order, x.table.structure) for x in found if x.order] == [(4, "nystrom")]
    assert not any(x.has_errors for x in found)


def test_columns_of_matlab_have_their_names() -> None:
    text = "A = zeros(3);\nA(2,1) = 0.5;\nA(3,1:2) = [-1\n 2];\nb = [1/6; 2/3; 1/6];\nc = [0; 0.5; 1];\n"
    (table,) = matlab.find(text, "kutta.m")
    assert (table.b, table.c) == ((("1/6", "2/3", "1/6"),), (("0", "1/2", "1"),))
    assert (table.A[0][0], table.how) == (
        (("0", "0", "0"), ("1/2", "0", "0"), ("-1", "2", "0")),
        "",
    )


BEHIND = """
c = [0, 1/2, 1/2, 1, 1/4]
a = [[0, 0, 0, 0, 0], [1/2, 0, 0, 0, 0], [0, 1/2, 0, 0, 0], [0, 0, 1, 0, 0], [1/8, 1/16, 1/16, 0, 0]]
b = [1/6, 1/3, 1/3, 1/6]
"""


def test_stages_behind_those_of_a_method() -> None:
    """They are left out if the others are a method; a wrong row of these is told."""
    (table,) = python.find(BEHIND, "x.py")
    assert (table.b, table.c) == ((("1/6", "1/3", "1/3", "1/6"),), (("0", "1/2", "1/2", "1"),))
    (found,) = map(audit, python.find(BEHIND.replace("[0, 0, 1, 0, 0]", "[0, 0, 2, 0, 0]"), "x.py"))
    assert found is not None
    assert [x.code for x in found.findings] == ["nodes", "stored"]


def test_eulers_method_has_no_rows() -> None:
    text = "class Euler extends Rk {{ double[] getC() {{ return new double[0]; }}\n  double[][] getA() {{ return new double[0][]; }}\n  double[] getB() {{ return new double[] {{ {} }}; }} }}"
    (table,) = java.find(text.format("1"), "Euler.java")
    assert (table.A[0][0], table.b[0]) == ((("0",),), ("1",))
    assert not any(x.b for x in java.find(text.format("0.5, 0.5"), "Euler.java"))


SINGLE = """
const bs = {
  c2: 1 / 2, c3: 3 / 4, a21: 1 / 2, a32: 3 / 4, a41: 2 / 9, a42: 1 / 3, a43: 4 / 9,
  b1: 2 / 9, b2: 1 / 3, b3: 4 / 9, e1: E1, e2: E2, e3: E3, e4: E4,
};
"""


@pytest.mark.parametrize(
    "numbers", [("7/24", "1/4", "1/3", "1/8"), ("-5/72", "1/12", "1/9", "-1/8")]
)
def test_numbers_called_e_are_weights_or_their_differences(numbers: tuple[str, ...]) -> None:
    """Their sum says which."""
    text = SINGLE
    for i, x in enumerate(numbers):
        text = text.replace(f"E{i + 1}", x)
    (found,) = filter(None, map(audit, typescript.find(text, "x.js")))
    assert found.embedded_order is not None
    assert found.embedded_order.order == 2
    assert not any(x.level == "warning" for x in found.findings)


FLAGS = """package p
func f(kind string) *T {
	o := new(T)
	switch kind {
	case "heun":
		o.Embedded, o.P, o.Q = true, 2, 1
		o.A = [][]float64{{0, 0}, {1, 0}}
		o.B, LOW = []float64{0.5, 0.5}, []float64{1, 0}
	}
	return o
}
"""


@pytest.mark.parametrize(("low", "order"), [("o.Be", 1), ("o.E", None)])
def test_flags_are_no_weights_and_letters_are_orders(low: str, order: int | None) -> None:
    """The order of an estimate that combines several rows is not that of embedded weights."""
    (table,) = go.find(FLAGS.replace("LOW", low), "x")
    assert (table.order, table.embedded_order) == (2, order)
    assert not table.notes


def test_entries_that_a_function_gave_are_unknown() -> None:
    """Of an array that a call made, unless its name is that of zeros."""
    text = "A = layout(2)\nA[1][0] = 2/3\nb = [1/4, 3/4]\n"
    (table,) = python.find(text, "x")
    assert "the call layout" in table.trouble


@pytest.mark.parametrize(
    ("find", "text"),
    [
        (matlab.find, "A = zeros(3); A(2,1) = 1/3; A(3,2) = 2/3; {} = 1/4; {} = 3/4;"),
        (julia.find, "A = zeros(3, 3)\nA[2,1] = 1/3\nA[3,2] = 2/3\n{} = 1/4\n{} = 3/4"),
        (python.find, "A = zeros((3, 3))\nA[1,0] = 1/3\nA[2,1] = 2/3\n{} = 1/4\n{} = 3/4"),
    ],
)
@pytest.mark.parametrize("shape", ["3, 1", "1, 3"])
def test_entries_of_a_column_that_are_not_assigned_are_zeros(
    find: Find, text: str, shape: str
) -> None:
    """And those of a row, which has one index where the first one is 1."""
    size, places = {
        matlab.find: (f"zeros({shape})", ("b(1)", "b(3)")),
        julia.find: (f"zeros({shape})", ("b[1]", "b[3]")),
        python.find: ("zeros((3, 1))", ("b[0]", "b[2]")),
    }[find]
    (table,) = find(f"b = {size}\n{text.format(*places)}", "x")
    assert table.b == (("1/4", "0", "3/4"),)
    assert not table.trouble


@pytest.mark.parametrize(
    ("names", "low"), [("AA bb cc", ""), ("A b2 c", "b3"), ("A b7 c", "b8"), ("rows total at", "")]
)
def test_two_stages_by_doubled_letters_numbers_and_alone(names: str, low: str) -> None:
    """Weights may have the orders as numbers; three neutral arrays are enough where nothing else is
    in a function about methods, and in no other one.
    """
    A, b, c = names.split()
    more = f"    {low} = [0, 1]\n" if low else ""
    body = f"    {A} = [[0, 0], [3/4, 0]]\n    {b} = [1/3, 2/3]\n{more}    {c} = [0, 3/4]\n"
    (table,) = python.find(f"def runge_kutta():\n{body}", "x")
    assert (table.b, bool(table.embedded)) == ((("1/3", "2/3"),), bool(low))
    if A == "rows":
        assert python.find(f"def parking():\n{body}", "x") == []


@pytest.mark.parametrize(
    ("b", "e", "order"),
    [
        ("[1/2, 3/4]", "[1/4, 0]", 1),
        ("[1/2, 1/2]", "[1/4, 1/4]", None),
        ("[1/2, 1/2]", "[1, 0]", 1),
    ],
)
def test_an_error_with_another_sum(b: str, e: str, order: int | None) -> None:
    """It is b − b̂ if b̂ has the sum 1 so, though b has another one; a note where nothing fits."""
    (table,) = python.find(f"A = [[0, 0], [1, 0]]\nb = {b}\ne = {e}\nc = [0, 1]\n", "x")
    found = audit(table)
    assert found is not None
    assert (found.embedded_order and found.embedded_order.order) == order
    assert bool(table.notes) == (order is None)
    assert "embedded-weights" not in {x.code for x in found.findings}


LARGE = "make([0, 1/3, 2/3], [1/4, 0, 3/4], [[0, 0, 0], [1/3, 0, 0], [0, 2/3, 0]])"


@pytest.mark.parametrize(
    ("small", "b"),
    [
        ("make([0, 1/2], [0, 1], [[0, 0], [1/2, 0]])", ("0", "1")),
        ("make([1], [1], [[1]])", ("1",)),
        ("make([0, 1/2], [0, 1], [[0, 0, 1], [1/2, 0, 0]])", None),
        ("other([0, 1/2], [0, 1], [[0, 0], [1/2, 0]])", None),
        ("make([0, 1/2], [0, 1])", None),
    ],
)
def test_arguments_of_a_call_are_those_of_another_one(
    small: str, b: tuple[str, ...] | None
) -> None:
    """Nodes, weights and matrix of three stages say what the arguments of two and one are."""
    text = f"# Runge-Kutta\ndef heun3():\n    return {LARGE}\ndef small():\n    return {small}\n"
    rows = [x.b for x in python.find(text, "x") if x.b]
    assert rows == [(("1/4", "0", "3/4"),), *([(b,)] if b else [])]
    assert b is None or not any(
        x.b == (b,) for x in python.find(text.replace(LARGE, "0"), "x") if x.stages == 1
    )


def test_an_order_in_capitals_is_that_of_its_table() -> None:
    text = "RK_ORDER = 3\nRK_A = [[0, 0, 0], [1/3, 0, 0], [0, 2/3, 0]]\n"
    text += "RK_B = [1/4, 0, 3/4]\nRK_C = [0, 1/3, 2/3]\n"
    (table,) = python.find(text, "x")
    assert (table.order, table.b) == (3, (("1/4", "0", "3/4"),))


def test_weights_of_dense_output_are_no_error() -> None:
    """Both have the sum 0; the names say which is which, in any order."""
    text = "function y = fsal(f, t, y, h)\n% Runge-Kutta\na = zeros(4,4);\na(2,1) = 1/2;\n"
    text += "a(3,2) = 3/4;\na(4,1) = 2/9;\na(4,2) = 1/3;\na(4,3) = 4/9;\n{}\n{}\n"
    dense = "d(1) = -3/5;\nd(2) = 2/5;\nd(3) = 1/5;\nd(4) = 0;"
    error = "er(1) = -5/72;\ner(2) = 1/12;\ner(3) = 1/9;\ner(4) = -1/8;"
    tables = [matlab.find(text.format(*x), "x")[0] for x in ((dense, error), (error, dense))]
    lows = [audit(x).embedded_order for x in tables]
    assert [x.order for x in lows if x is not None] == [2, 2]
