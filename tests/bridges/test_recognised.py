"""Numbers recognise a table, whatever its arrays are called; and nothing is an error while they are
a method in another way.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli.bridges.audit import Audited, audit, audited
from garkcli.bridges.collecting import collected
from garkcli.sources.languages import c, julia

WITHOUT_NAMES = """
x1 = [[0, 0, 0, 0], [1/3, 0, 0, 0], [-1/3, 1, 0, 0], [1, -1, 1, 0]]
x2 = [1/8, 3/8, 3/8, 1/8]
x3 = [0, 1/3, 2/3, 1]
"""
COLUMNS = """
A = [[0, 5/24, 1/6], [0, 1/3, 2/3], [0, -1/24, 1/6]]
b = [1/6, 2/3, 1/6]
c = [0, 1/2, 1]
order = 4
"""
LAST_ROW = """
def ssp():
    butcher_matrix = [[1/2, 0, 0], [1/2, 1/2, 0], [1/3, 1/3, 1/3]]
"""
NYSTROM = """
class Quad(Method):
    order = 4
    C = [0, 1/2, 1]
    A = [[0, 0, 0], [1/8, 0, 0], [0, 1/2, 0]]
    B = [1/6, 1/3, 0]
    Bp = [1/6, 4/6, 1/6]
"""
QUADRATURES = """
x2 = [-sqrt(1/12), sqrt(1/12)]
w2 = [1/2, 1/2]
w4 = [(18 - sqrt(30))/72, (18 + sqrt(30))/72, (18 + sqrt(30))/72, (18 - sqrt(30))/72]
"""
FLAT = """
data = [1/4, 1/4, 0, 0, 0, 11/28, 1/7, 1/4, 0, 0, 1/3, 61/144, -49/144, 1/4, 0,
    1, 0, 0, 3/4, 1/4, 3, 0, 0, 3/4, 1/4, 2, -61/600, 49/600, 79/100, 23/100]
"""
BEHIND_NODES = """
def tableau():
    return [[0, []], [1/2, [1/2]], [1, [-1, 2]]], [1/6, 2/3, 1/6]
"""
BLOCK = """
tableau = {'Rule': [[0, 0, 0, 0, 0], [1/3, 1/3, 0, 0, 0], [2/3, -1/3, 1, 0, 0], [1, 1, -1, 1, 0],
    [4, 1/8, 3/8, 3/8, 1/8]]}
"""


def found_in(folder: Path, text: str) -> list[Audited]:
    """The tables of a source in Python."""
    path = folder / "x.py"
    path.write_text(text, encoding="utf-8")
    return list(audited([str(path)]))


@pytest.mark.parametrize(
    ("text", "order", "how"),
    [
        (WITHOUT_NAMES, 4, "A, b and c by rows"),
        (COLUMNS, 4, "columns are stages"),
        (LAST_ROW, 2, "rows 2 to s, and the weights below them"),
        (NYSTROM, 4, "for second-order equations"),
        (BEHIND_NODES, 3, "columns of zeros are left out"),
        (FLAT, 3, "a tableau with its nodes and weights in one matrix, row by row"),
    ],
)
def test_a_table_is_read_as_its_numbers_say(
    tmp_path: Path, text: str, order: int, how: str
) -> None:
    """Its order is the one of the paper, and the only finding says how it is stored; the method
    file claims that order.
    """
    (found,) = found_in(tmp_path, text)
    assert found.order is not None
    assert found.order.order == order
    assert [(x.code, x.level) for x in found.findings] == [("stored", "note")]
    assert found.findings[0].message.endswith(how)
    (method,) = collected([str(tmp_path / "x.py")])
    assert method.method is not None
    assert method.method.order.order == order
    assert method.errors == []


def test_weights_are_no_matrix(tmp_path: Path) -> None:
    """Four weights and two equal ones meet order 2, whatever they are."""
    assert found_in(tmp_path, QUADRATURES) == []


def test_a_misprint_of_told_arrays_is_an_error(tmp_path: Path) -> None:
    """Another reading of the same arrays has the same wrong entry: a wrong weight, a wrong entry, a
    wrong node are errors with names, and columns do not excuse them.
    """
    for old, new in (("4/6", "5/6"), ("1/8]", "1/7]"), ("2/3, 1/6]\n", "2/3, 1/7]\n")):
        for text in (NYSTROM, WITHOUT_NAMES, COLUMNS):
            if old in text:
                named = text.replace("x1", "A").replace("x2", "b").replace("x3", "c")
                (found,) = found_in(tmp_path, named.replace(old, new, 1))
                assert found.has_errors


def test_a_misprint_without_names(tmp_path: Path) -> None:
    """All rows but one fit: the one that does not is told, as an error where it is one of several."""
    rows = [
        *("[0, 0, 0, 0, 0, 0]", "[1/4, 0, 0, 0, 0, 0]", "[1/8, 1/8, 0, 0, 0, 0]"),
        *("[0, -1/2, 1, 0, 0, 0]", "[3/16, 0, 0, 9/16, 0, 0]", "[-3/7, 2/7, 12/7, -12/7, 8/7, 0]"),
    ]
    text = f"x1 = [{', '.join(rows)}]\nx2 = [7/90, 0, 32/90, 12/90, 32/90, 7/90]\n"
    text += "x3 = [0, 1/4, 1/4, 1/2, 3/4, 1]\n"
    (right,) = found_in(tmp_path, text)
    assert right.order is not None
    assert (right.order.order, right.has_errors) == (5, False)
    (wrong,) = found_in(tmp_path, text.replace("12/7, -12/7", "12/7, -13/7"))
    assert [(x.code, x.level) for x in wrong.findings][:1] == [("nodes", "error")]


def test_known_calls_have_their_layout(tmp_path: Path) -> None:
    """A transposed matrix of ARKODE is wrong, though its columns fit."""
    path = tmp_path / "x.c"
    path.write_text(
        "static ARKodeButcherTable lobatto(void) {\n"
        "  double c[3] = {0, 0.5, 1}, b[3] = {1./6, 2./3, 1./6};\n"
        "  double A[9] = {0, 5./24, 1./6, 0, 1./3, 2./3, 0, -1./24, 1./6};\n"
        "  return ARKodeButcherTable_Create(3, 4, 0, c, A, b, NULL);\n}\n",
        encoding="utf-8",
    )
    (found,) = audited([str(path)])
    assert [x.code for x in found.findings] == ["transposed"]


def test_columns_that_fit_all_nodes_are_meant(tmp_path: Path) -> None:
    """Lobatto IIIA 2 by columns: no single misprint makes all columns fit, however few bits agree.
    One that is wrong as well is an error.
    """
    text = "A = [[0, 1/2], [0, 1/2]]\nb = [1/2, 1/2]\nc = [0, 1]\n"
    (found,) = found_in(tmp_path, text)
    assert found.order is not None
    assert (found.order.order, [x.code for x in found.findings]) == (2, ["stored"])
    (found,) = found_in(tmp_path, "order = 2\n" + text.replace("[0, 1/2]]", "[0, 1/3]]"))
    assert found.has_errors
    path = tmp_path / "x.c"
    path.write_text(
        "double A[3][3] = {{0, 0.5, -1}, {0, 0, 2}}, b[3] = {1./6, 2./3, 1./6};\n"
        "double c[3] = {0, 0.5, 1};\nint order = 3;\n",
        encoding="utf-8",
    )
    (found,) = audited([str(path)])
    assert [x.code for x in found.findings] == ["stored"]


def test_a_reading_of_another_form_bears_no_table_out(tmp_path: Path) -> None:
    """Weights of positions of a Nyström pair beside its matrix: no method of Runge and Kutta."""
    rows = "[0, 0, 0, 0], [1/32, 0, 0, 0], [7/1000, 119/500, 0, 0], [1/14, 8/27, 25/189, 0]"
    text = f"a = [{rows}]\nc = [0, 1/4, 7/10, 1]\nb = [-7/150, 67/150, 3/20, -1/20]\n"
    text += "bp = [13/21, -20/27, 275/189, -1/3]\nbhat = [1/14, 8/27, 25/189, 0]\n"
    text += "bhatp = [1/14, 32/81, 250/567, 5/54]\n"
    assert not any(x.has_errors for x in found_in(tmp_path, text))


def test_single_embedded_weights_far_from_1_are_told() -> None:
    """Error weights of the wrong sign have no sum near 1 or 0: a doubt."""
    text = """
    function RK4ConstantCache(::Type{T}) where {T}
        a21 = T(1 // 2); a32 = T(1 // 2); a43 = T(1)
        b1 = T(1 // 6); b2 = T(1 // 3); b3 = T(1 // 3); b4 = T(1 // 6)
        btilde1 = T(5 // 2); btilde2 = T(9 // 4); btilde3 = T(1 // 3); btilde4 = T(7 // 6)
        c2 = T(1 // 2); c3 = T(1 // 2); c4 = T(1)
        return RK4ConstantCache(a21, a32, a43, b1, b2, b3, b4, btilde1, btilde2, btilde3, btilde4)
    end
    """
    (table,) = julia.find(text, "x.jl")
    found = audit(table)
    assert found is not None
    assert ("embedded-weights", "warning") in [(x.code, x.level) for x in found.findings]


def test_one_matrix_is_called_after_its_key(tmp_path: Path) -> None:
    """[c A; q b] under a key, whatever the dictionary is called."""
    (found,) = found_in(tmp_path, BLOCK)
    assert found.order is not None
    assert (found.table.name, found.order.order) == ("Rule", 4)


def test_what_is_idle_is_told(tmp_path: Path) -> None:
    """Weights b with a misprint beside others that fit: a doubt, never silence."""
    text = WITHOUT_NAMES + "b = [1/8, 3/8, 3/8, 2/8]\n"
    (found,) = found_in(tmp_path, text)
    assert [(x.code, x.level) for x in found.findings] == [("stored", "note"), ("idle", "warning")]


def test_nodes_of_another_table_are_not_idle(tmp_path: Path) -> None:
    """Registers beside a table that names tell, whose nodes are not theirs."""
    text = "x_A = [[0, 0, 0], [1, 0, 0], [1/4, 1/4, 0]]\nx_b = [1/6, 1/6, 2/3]\nx_c = [0, 1, 1/2]\n"
    found = found_in(tmp_path, text + "w_a = [0, -5/9, -153/128]\nw_b = [1/3, 15/16, 8/15]\n")
    assert [[x.code for x in each.findings] for each in found] == [[], ["stored"]]


@pytest.mark.parametrize("declared", [3, 4])
def test_an_order_beside_registers_is_declared(tmp_path: Path, declared: int) -> None:
    """Williamson's method of order 3: the declared order is compared."""
    text = f"w_order = {declared}\nw_a = [0, -5/9, -153/128]\nw_b = [1/3, 15/16, 8/15]\n"
    (found,) = found_in(tmp_path, text)
    assert found.table.order == declared
    assert ("order" in [x.code for x in found.findings]) == (declared > 3)


def test_a_first_stage_at_another_time_is_meant(tmp_path: Path) -> None:
    """Oliver's method of order 5 begins at the node 2/3, which costs nothing: a note."""
    rows = [
        *("[0, 0, 0, 0, 0, 0]", "[1/6, 0, 0, 0, 0, 0]", "[-15/8, 21/8, 0, 0, 0, 0]"),
        *("[-9, 75/7, -5/7, 0, 0, 0]", "[-3, 34257/8750, -114/875, 19/1250, 0, 0]"),
        "[0, 123/380, 5/2, 3/20, -75/38, 0]",
    ]
    text = f"order = 5\nA = [{', '.join(rows)}]\nc = [2/3, 1/6, 3/4, 1, 4/5, 1]\n"
    (found,) = found_in(tmp_path, text + "b = [0, 54/133, 32/21, 1/18, -125/114, 1/9]\n")
    assert [(x.code, x.level) for x in found.findings] == [("nodes", "note")]


def test_nodes_beside_registers_that_do_not_fit_are_told(tmp_path: Path) -> None:
    """Williamson's method with the nodes of another one: its order, and a doubt."""
    text = "class Bad:\n    _A = [0, -5/9, -153/128]\n    _B = [1/3, 15/16, 8/15]\n"
    (found,) = found_in(tmp_path, text + "    _C = [0, 4/9, 15/32]\n")
    assert found.order is not None
    assert (found.order.order, [x.code for x in found.findings]) == (3, ["stored", "idle"])
    (found,) = found_in(tmp_path, text + "    _C = [0, 1/3, 3/4]\n")
    assert [x for x in found.findings if x.level != "note"] == []


KUTTA = """
static const double rkf_a21 = 1.0/2.0;
static const double rkf_a31 = -1.0, rkf_a32 = 2.0;
static const double rkf_b[3] = {1.0/6, 2.0/3, 1.0/6}, rkf_c[3] = {0, 0.5, 1};
"""
"""Kutta's method of order 3, its matrix in single numbers; no order is declared."""
CLASSIC = """
static const double A[4][4] = {{0}, {0.5}, {0, 0.5}, {0, 0, 1}};
static const double b[4] = {1.0/6, 1.0/3, 1.0/3, 1.0/6}, c[4] = {0, 0.5, 0.5, 1};
static const int order = 4;
"""
PREFIXED = CLASSIC.replace("A[", "k_A[").replace("b[", "k_b[").replace(" c[", " k_c[")
SINGLE = """
static const double k_a21 = 0.5, k_a31 = 0, k_a32 = 0.5, k_a41 = 0, k_a42 = 0, k_a43 = 1;
static const double k_b[4] = {1.0/6, 1.0/3, 1.0/3, 1.0/6}, k_c[4] = {0, 0.5, 0.5, 1};
static const int k_order = 4;
"""
OF_ANOTHER = {
    "its arrays have the prefix": PREFIXED.replace("int order", "int k_order"),
    "its single numbers have the prefix": SINGLE,
    "all names are without prefix": CLASSIC,
}


@pytest.mark.parametrize("which", OF_ANOTHER)
def test_an_order_is_of_one_table(which: str, tmp_path: Path) -> None:
    """The order of another table in the scope: neither a finding nor a claim of this one."""
    path = tmp_path / "methods.c"
    path.write_text(KUTTA + OF_ANOTHER[which], encoding="utf-8")
    orders = {x.order.order: x.table.order for x in audited([str(path)]) if x.order}
    assert orders == {3: None, 4: 4}
    files = [x.method.text for x in collected([str(path)]) if x.method]
    assert [x.count("order: 3") for x in files] == [1, 0]


def test_embedded_weights_of_another_method(tmp_path: Path) -> None:
    """A column of another matrix and its weights have the sum 1, and are of another table."""
    heun = (
        "static const double heun_A[2][2] = {{0}, {1}};\n"
        "static const double heun_b[2] = {0.5, 0.5}, heun_c[2] = {0, 1};\n"
    )
    midpoint = (
        "static const double mid_A[2][2] = {{0}, {0.5}};\n"
        "static const double mid_b[2] = {0, 1}, mid_c[2] = {0, 0.5};\n"
    )
    low = "static const double rkf_bhat[3] = {0, 1, 0};\n"
    for text, wanted in ((heun + KUTTA + midpoint, None), (heun + KUTTA + low + midpoint, 2)):
        path = tmp_path / "methods.c"
        path.write_text(text, encoding="utf-8")
        found = list(audited([str(path)]))
        assert [x.order.order for x in found if x.order] == [2, 3, 2]
        (embedded,) = (x.embedded_order for x in found if x.order and x.order.order == 3)
        assert (embedded and embedded.order) == wanted


LONGER = """
struct Tableau {{ arma::mat A, B; arma::colvec c; }};
const Tableau DP = {{
  arma::mat({{{{0, 0, 0, 0}}, {{0.5, 0, 0, 0}}, {{0, 0.5, 0, 0}}, {{0, 0, 1, 0}}}}),
  arma::mat({{{{1/6.0, 1/3.0, 1/3.0, 1/6.0}}}}),
  arma::colvec({{{}}})
}};
"""


@pytest.mark.parametrize(
    ("nodes", "codes"),
    [
        ("0.0, 0.2, 0.3, 0.8, 8/9.0, 1, 1", ["stored", "idle"]),
        ("0.0, 0.5, 0.5, 1.0, 0.25, 0.75", ["stored"]),
    ],
)
def test_nodes_of_another_method(nodes: str, codes: list[str]) -> None:
    """More nodes than stages are told unless they begin with those of the method."""
    (found,) = filter(None, map(audit, c.find(LONGER.format(nodes), "x.hpp")))
    assert [x.code for x in found.findings] == codes
