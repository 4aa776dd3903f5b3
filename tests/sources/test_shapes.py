"""Tables as programs store them: weights beside each other, rows without the first, parts apart."""

from __future__ import annotations

import pytest

from garkcli.bridges.audit import Audited, audit
from garkcli.sources.found import FoundTable
from garkcli.sources.languages import c, julia, python
from tests.whole import in_whole

TWO_WEIGHTS = """
inline void fill_emb(std::vector<std::vector<double>> &a, std::vector<double> &b1,
                     std::vector<double> &b2, std::vector<double> &c) {
  a  = {{}, {0.5}, {0.0, 0.75}, {2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0}};
  c  = {0.0, 0.5, 0.75, 1.0};
  b1 = {2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0, 0.0};
  b2 = {7.0 / 24.0, 0.25, 1.0 / 3.0, 0.125};
}
"""
SMALLER = """
A = np.array([[0.5, 0, 0], [0, 0.5, 0], [0, 0, 1.0]])
b = np.array([1/6, 1/3, 1/3, 1/6])
"""
SMALLER_IN_A_ROW = """
const double RK4_A[9] = {0.5, 0, 0,  0, 0.5, 0,  0, 0, 1};
const double RK4_B[4] = {1.0/6.0, 1.0/3.0, 1.0/3.0, 1.0/6.0};
"""
WITH_EIGENVALUES = """
void radau(TABLEAU* tableau)
{
  tableau->nStages = 2;
  tableau->order_b = 2*tableau->nStages - 1;
  tableau->order_bt = 1;
  const double c[] = {0, 2.0/3.0};
  const double A[] = {0.25, -0.25, 0.25, 5.0/12.0};
  const double b[] = {0.25, 0.75};
  const double bt[] = {1, 0};
  setButcherTableau(tableau, c, A, b, bt);
  const double *gamma = NULL;
  const double alpha[] = { 2.0 };
  const double beta[] = { -1.41421356237309504880168872420969807857 };
}
"""
LAST_ROW = """
inline void fill(std::vector<std::vector<double>> &a, std::vector<double> &b,
                 std::vector<double> &c) {
  a = {{}, {0.5}, {0.0, 0.75}, {2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0}};
  c = {0.0, 0.5, 0.75, 1.0};
  b = a.back();
  b.push_back(0.0);
}
"""
ONE_ROW = """
inline void fill_ls(std::vector<std::vector<double>> &a, std::vector<double> &b) {
  a = {{0.755726351946097, 0.386954477304099}};
  b = {0.245170287303492, 0.184896052186740, 0.569933660509768};
}
"""
FROM_THE_SECOND = """
def step(func, y0, f0, t0, dt):
  alpha = jnp.array([1 / 2, 3 / 4, 1., 0], dtype=dt.dtype)
  beta = jnp.array([[1 / 2, 0, 0, 0], [0, 3 / 4, 0, 0], [2 / 9, 1 / 3, 4 / 9, 0]], dtype=f0.dtype)
  c_sol = jnp.array([2 / 9, 1 / 3, 4 / 9, 0], dtype=f0.dtype)
  c_error = jnp.array([2 / 9 - 7 / 24, 1 / 3 - 1 / 4, 4 / 9 - 1 / 3, -1 / 8], dtype=f0.dtype)
"""
EACH = """
A = [1 / 2, 3 / 4, 1.]
B = [[1 / 2], [0, 3 / 4], [2 / 9, 1 / 3, 4 / 9]]
B = [torch.tensor(B_, dtype=torch.float64) for B_ in B]
C_sol = [2 / 9, 1 / 3, 4 / 9, 0]
_TABLE = _ButcherTableau(alpha=A, beta=B, c_sol=torch.tensor(C_sol), c_error=None)
"""
KICKS = """
function Ruth3ConstantCache(::Type{T}, ::Type{T2}) where {T, T2}
    a1 = convert(T, 2 // 3)
    a2 = -convert(T, 2 // 3)
    a3 = convert(T, 1)
    b1 = convert(T, 7 // 24)
    b2 = convert(T, 3 // 4)
    b3 = convert(T, -1 // 24)
    return SymplecticTableau((a1, a2, a3), (b1, b2, b3))
end
"""
TWO_PARTS = """
function ARS111Tableau(T, T2)
    Ai = zeros(T, 2, 2)
    Ai[2, 2] = one(T)
    bi = T[zero(T), one(T)]
    Ae = zeros(T, 2, 2)
    Ae[2, 1] = one(T)
    be = T[one(T), zero(T)]
    c = T2[zero(T2), one(T2)]
    return ESDIRKIMEXTableau(Ai, bi, Ae, be, c, T[], T[], 0, 1, 2, false, [0, 0], one(T2); ce = c)
end
"""
FURTHER = """
function BS3ConstantCache(T)
    c1 = convert(T, 1 // 2); c2 = convert(T, 3 // 4)
    a21 = convert(T, 1 // 2); a32 = convert(T, 3 // 4)
    a41 = convert(T, 2 // 9); a42 = convert(T, 1 // 3); a43 = convert(T, 4 // 9)
    c5, a51, a52, a53, a54 = Interp(T)
    return BS3ConstantCache(c1, c2, a21, a32, a41, a42, a43, c5, a51, a52, a53, a54)
end
"""
NO_STAGE = """
function MidpointsTableau(T)
    γ = convert(T, 1 // 6)
    a21 = convert(T, 1 // 3)
    a31 = convert(T, 1 // 3); a32 = convert(T, 1 // 3)
    a41 = convert(T, 1 // 3); a42 = convert(T, 1 // 3); a43 = convert(T, 1 // 3)
    c2 = convert(T, 1 // 2); c3 = convert(T, 5 // 6)
    return MidpointsTableau(γ, a21, a31, a32, a41, a42, a43, c2, c3)
end
"""
LAST_DIAGONAL = """
function Hairer4Tableau(T)
    γ = convert(T, 1 // 4)
    c2 = convert(T, 3 // 4); c3 = convert(T, 11 // 20); c4 = convert(T, 1 // 2)
    a11 = convert(T, 1 // 4)
    a21 = convert(T, 1 // 2); a22 = convert(T, 1 // 4)
    a31 = convert(T, 17 // 50); a32 = convert(T, -1 // 25); a33 = convert(T, 1 // 4)
    a41 = convert(T, 371 // 1360); a42 = convert(T, -137 // 2720); a43 = convert(T, 15 // 544)
    a44 = convert(T, 1 // 4)
    a51 = convert(T, 25 // 24); a52 = convert(T, -49 // 48); a53 = convert(T, 125 // 16)
    a54 = convert(T, -85 // 12)
    return Hairer4Tableau(γ, c2, c3, c4, a11, a21, a22, a31, a32, a33, a41, a42, a43, a44, a51,
        a52, a53, a54)
end
"""
OF_CLASSES = """
struct heun_a1 : std::array<double, 1> { heun_a1() { (*this)[0] = 1. / 3; } };
struct heun_a2 : std::array<double, 2> { heun_a2() { (*this)[0] = 0; (*this)[1] = 2. / 3; } };
struct heun_b : std::array<double, 3> {
  heun_b() { (*this)[0] = .25; (*this)[1] = 0; (*this)[2] = .75; } };
struct heun_c : std::array<double, 3> {
  heun_c() { (*this)[0] = 0; (*this)[1] = 1. / 3; (*this)[2] = 2. / 3; } };
"""
HATS = """
gamma = (3 + np.sqrt(3))/6
ars233A = np.array([[gamma, 0], [1 - 2*gamma, gamma]])
ars233A_hat = np.array([[gamma, 0], [gamma - 1, 2*(1 - gamma)]])
ars233b = np.array([0.5, 0.5])
ars233b_hat = np.array([0, 0.5, 0.5])
ars233c = np.array([gamma, 1 - gamma])
ars233c_hat = np.array([0, gamma, 1 - gamma])
"""
FILLED = """
static ARKodeSPRKTable arkodeSymplecticRuth3(void) {
  ARKodeSPRKTable t = ARKodeSPRKTable_Alloc(3);
  if (!t) { return NULL; }
  t->q = 3; t->stages = 3;
  t->a[0] = 2.0 / 3.0; t->a[1] = -2.0 / 3.0; t->a[2] = 1.0;
  t->ahat[0] = 7.0 / 24.0; t->ahat[1] = 3.0 / 4.0; t->ahat[2] = -1.0 / 24.0;
  return t;
}
"""
WRITTEN = {
    "b1 and b2": (c.find, TWO_WEIGHTS, 3, 2),
    "the last row": (c.find, LAST_ROW, 3, None),
    "one row": (c.find, ONE_ROW, 3, None),
    "from the second stage on": (python.find, FROM_THE_SECOND, 3, 2),
    "a list of each": (python.find, EACH, 3, None),
    "kicks and drifts": (julia.find, KICKS, 3, None),
    "two parts": (julia.find, TWO_PARTS, 1, None),
    "arrays that are classes": (c.find, OF_CLASSES, 3, None),
    "a part with a hat": (python.find, HATS, 3, None),
    "kicks and drifts that are filled in": (c.find, FILLED, 3, None),
    "further stages": (julia.find, FURTHER, 3, None),
    "weights that are no stage": (julia.find, NO_STAGE, 2, None),
    "the last entry of the diagonal": (julia.find, LAST_DIAGONAL, 4, None),
}


HALVES = """
_b = np.array([0.0, 1.0])
_explicit = ButcherTableau(a_lower=(np.array([0.5]),), b_sol=_b, c=np.array([0.5]))
_implicit = ButcherTableau(
    a_lower=(np.array([0.0]),), b_sol=_b, c=np.array([0.5]), a_diagonal=np.array([0, 0.5])
)

class Imex(Solver):
    tableau: ClassVar = MultiButcherTableau(_explicit, _implicit)

    def order(self, terms):
        return 2
"""
WITHOUT_FIRST_ROWS = """
step = imex(ImExButcherTableau(
    a_ex=[[1/3], [1/6, 1/2], [1/2, -1/2, 1]],
    a_im=[[1/6, 1/6], [1/3, 0, 1/3], [3/8, 0, 3/8, 1/4]],
    b_ex=[1/2, -1/2, 1, 0],
    b_im=[3/8, 0, 3/8, 1/4],
))
"""
GIVEN = """
function step!(cache, u)
    a = SVector(0.0, 5 / 9, 153 / 128)
    b = SVector(1 / 3, 15 / 16, 8 / 15)
    c = SVector(0.0, 1 / 3, 3 / 4)
    advance!(cache, u, a, b, c)
end
"""
LAST_ROW = """
void Solver::Stepper(const double y[], double out[]) {
    const double b21 = 0.5, b31 = 0.0, b32 = 0.75, b41 = 2.0/9.0, b42 = 1.0/3.0, b43 = 4.0/9.0,
        dc1 = b41 - 7.0/24.0, dc2 = b42 - 0.25, dc3 = b43 - 1.0/3.0, dc4 = -0.125;
}
"""
FIRST_NODE = """
T = ButcherTableau(a_lower=(np.array([0.5]),), b_sol=np.array([0.5, 0.5]), c1=0.25,
    c=np.array([0.75]), a_diagonal=np.array([0.25, 0.25]))
"""
WRITTEN |= {
    "a first node that is apart": (python.find, FIRST_NODE, 2, None),
    "a matrix beside another one in Greek": (c.find, WITH_EIGENVALUES, 3, 1),
    "rows and columns that are not zero": (python.find, SMALLER, 4, None),
    "these in a row": (c.find, SMALLER_IN_A_ROW, 4, None),
    "weights that are the last row, by the error": (c.find, LAST_ROW, 3, 2),
    "two tables in one": (python.find, HALVES, 2, None),
    "parts without their first rows": (python.find, WITHOUT_FIRST_ROWS, 2, None),
    "arrays that another function is given": (julia.find, GIVEN, 3, None),
}


def only(find: object, text: str) -> tuple[FoundTable, Audited]:
    """The only table of a source, and what an audit finds of it."""
    (table,) = find(text, "x")  # type: ignore[operator]
    found = audit(table)
    assert found is not None
    return table, found


@pytest.mark.parametrize("name", WRITTEN)
def test_the_order_is_that_of_the_method(name: str) -> None:
    """As published, no lower and no higher, and nothing is wrong with the table."""
    find, text, order, low = WRITTEN[name]
    table, found = only(find, text)
    assert table.trouble == ""
    assert found.order is not None
    assert found.order.order == order
    assert (found.embedded_order and found.embedded_order.order) == low
    assert {x.code for x in found.findings} <= {"stored"}


def test_two_tables_in_one_have_its_name_and_order() -> None:
    """They are two parts of one method, not methods; what is no number in one of them is told."""
    table, _ = only(python.find, HALVES)
    assert (table.name, table.order, table.colours, table.c) == ("Imex", 2, 2, (("0", "1/2"),))
    (table,) = python.find(HALVES.replace("[0.5]),), b", "[x]),), b", 1), "x")
    assert (table.name, table.trouble) == ("Imex", "the name x, line 3, is not known")


@pytest.mark.parametrize("more", ["f(x)", "h, h"])
def test_what_is_no_pair_of_tables_is_told(more: str) -> None:
    """The table in it is read for itself."""
    text = f"h = dict(A=[[0, 0], [1, 0]], b=[0.5, 0.5], c=[0, 1])\nMultiButcherTableau(h, {more})\n"
    half, whole = python.find(text, "x")
    assert (half.line, half.b) == (1, (("1/2", "1/2"),))
    assert whole.trouble == "MultiButcherTableau takes two tables that are written out"


def test_blocks_that_make_no_square_are_none() -> None:
    """Two matrices below one another are no method of two colours, and no fault of gark."""
    text = "A = [[[[0, 0], [1, 0]]], [[[0, 0], [1, 0]]]]\nb = [[0.5, 0.5], [0.5, 0.5]]\n"
    (table,) = python.find(text, "x")
    assert table.trouble.endswith("do not fit together: the blocks make no square")


def test_an_order_is_that_of_the_table_before_it() -> None:
    """Matrices that are assigned anew without another order have none."""
    first = "A = [[0, 0], [0.5, 0]]\nb = [0, 1]\norder = 2\n"
    second = "A = [[0, 0], [1, 0]]\nb = [0.5, 0.5]\n"
    assert [x.order for x in python.find(first + second, "x")] == [2, None]


def test_an_object_is_no_array_that_is_not_read() -> None:
    """Nodes that a function computes are told, a tableau of another method is not."""
    text = "A = [[0, 0], [1, 0]]\nb = [0.5, 0.5]\nbt = {}\nc = {}\n"
    for call in ("nodes()", "nodes(A)"):
        (table,) = python.find(text.format("GaussLegendre(2)", call), "x")
        assert table.notes == ("nodes are not read: the call nodes",)


def test_q_and_p_beside_arrays_are_no_orders() -> None:
    """They are those of structures alone."""
    (table,) = python.find("q = 3\np = 2\nA = [[0, 0], [1, 0]]\nb = [0.5, 0.5]\n", "x")
    assert (table.order, table.embedded_order) == (None, None)


BESIDE_A_RECORD = {
    "other arrays": ("heun_A = [[0, 0], [1, 0]]\nheun_b = [0.5, 0.5]\n", 2),
    "its own arrays": ("A = [[0, 0], [0.5, 0]]\nb = [0, 1]\n", 1),
    "the same in a class with an order": (
        "class C:\n    A = [[0, 0], [0.5, 0]]\n    b = [0, 1]\n    order = 3\n",
        2,
    ),
}


@pytest.mark.parametrize("name", BESIDE_A_RECORD)
def test_arrays_beside_a_record_are_tables_of_their_own(name: str) -> None:
    """Unless they are those of the record, or are the same and say no more."""
    text, count = BESIDE_A_RECORD[name]
    record = "m = RungeKuttaMethod([[0, 0], [0.5, 0]], [0, 1])\n"
    assert len(python.find(text + record, "x")) == count


def test_a_matrix_that_lacks_a_row_is_none() -> None:
    """Of a matrix with rows like the others a row is missing: nobody knows which."""
    table, _ = only(python.find, "A = [[0, 0, 0], [0.5, 0.5, 0]]\nb = [0.25, 0.25, 0.5]\n")
    assert table.trouble == "2 rows for 3 stages"


LINEAR_ALGEBRA = {
    "an order of storage": "order = 101\nA = [[2.5, 0], [0.5, 1.5]]\nb = [0.125, 0.25]\n",
    "complex numbers": "A = [[1, 2j], [3, 4]]\nb = [1, 2]\n",
    "one after the other": "A = [[1, 2], [3, 4]]\nb = [5, 6]\nf(A, b)\nA = [[2, 1], [0, 1]]\n",
    "a double integrator": "A = [[0, 1], [0, 0]]\nb = [[0], [1]]\nc = [[2, 0]]\n",
    "two records": "a = array([(5, 42), (10, 1)])\nb = array([(5, 43), (10, 1)])\n",
    "ones": "order = 1\na = [[1, 0], [0, 1]]\nb = [[1, 1], [1, 1]]\n",
    "whole numbers": "a = array([[1, 0], [0, 1]])\nb = array([[0, 1], [1, 0]])\n",
    "one entry": f"Exact = {[[0] * 4] * 3 + [[0, 0, 0, 1]]}\n",
}


@pytest.mark.parametrize("name", LINEAR_ALGEBRA)
def test_a_linear_system_is_no_table(name: str) -> None:
    """It has a matrix and a vector of the same names, and neither is counted as unread."""
    found = [x for x in python.find(LINEAR_ALGEBRA[name], "x") if not x.is_unlike]
    assert [y for x in found if (y := audit(x))] == []


def test_a_wrong_node_among_good_ones_is_told() -> None:
    """One of five nodes is no row sum: the table is read, and the row is named, as a doubt; with two
    it is none.
    """
    rows = {2: "1/5", 3: "3/40 9/40", 4: "3/10 -9/10 6/5", 5: "-11/54 5/2 -70/27 35/27"}
    rows |= {6: "1631/55296 175/512 575/13824 44275/110592 253/4096"}
    named = {f"a{i}{j}": x for i, row in rows.items() for j, x in enumerate(row.split(), start=1)}
    named |= {"c2": "1/5", "c3": "3/10", "c4": "4/5", "c5": "1", "c6": "7/8"}
    named |= {"b1": "37/378", "b3": "250/621", "b4": "125/594", "b6": "512/1771"}
    text = "\n    ".join(["def step():", *(f"{name} = {x}" for name, x in named.items())])
    _, found = only(python.find, text)
    assert found.order is not None
    assert found.order.order == 5
    assert [(x.code, x.level) for x in found.findings] == [("nodes", "warning")]
    assert "row 4 has the sum 3/5, its node is 4/5" in found.findings[0].message
    (table,) = python.find(text.replace("c3 = 3/10", "c3 = 1/10"), "x")
    two = audit(table)
    assert two is not None
    assert not two.is_read


def test_a_wrong_node_beside_ones_that_are_left_out_is_told() -> None:
    """The first node and the last one are row sums; the third one is a misprint of 11/20."""
    _, found = only(julia.find, LAST_DIAGONAL.replace("11 // 20", "12 // 20"))
    assert found.order is not None
    assert found.order.order == 4
    (finding,) = [x for x in found.findings if x.level != "note"]
    assert (finding.code, "row 3 has the sum 11/20" in finding.message) == ("nodes", True)


def test_a_row_with_an_entry_left_out_has_no_node() -> None:
    """Where an entry is not there, the step may have it as a number of its own: no error."""
    text = LAST_DIAGONAL.replace("a42 = convert(T, -137 // 2720); ", "").replace("a42, ", "")
    assert not any(x.has_errors for x in map(audit, julia.find(text, "x")) if x is not None)


@in_whole
def test_kicks_for_second_order_equations() -> None:
    """McLachlan and Atela's method of order 4 has order 3 where q' is not p: a warning. As drifts
    for kicks it has order 3 for these, too: an error.
    """
    a = "0.515352837431122936 -0.085782019412973646 0.441583023616466524 0.128846158365384185"
    b = "0.134496199277431089 -0.224819803079420806 0.756320000515668291 0.334003603286321425"
    entries = [
        f"t->{name}[{i}] = {x};"
        for name, row in (("a", a), ("ahat", b))
        for i, x in enumerate(row.split())
    ]
    head = "ARKodeSPRKTable t = ARKodeSPRKTable_Alloc(4); t->q = 4; t->stages = 4;"
    text = f"static ARKodeSPRKTable four(void) {{ {head} {' '.join(entries)} return t; }}"
    table, found = only(c.find, text)
    assert table.name == "four"
    assert [(x.code, x.level) for x in found.findings] == [("order", "warning")]
    _, found = only(
        c.find, text.replace("t->ahat", "t->x").replace("t->a[", "t->ahat[").replace("t->x", "t->a")
    )
    assert [(x.code, x.level) for x in found.findings] == [("order", "error")]
