"""gark audit: tables in places where solvers keep them, and what only looks like a table."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from tests.cli.harness import gark
from tests.whole import in_whole, sample

NESTED = """
from fractions import Fraction as F
TABLES = {
    "heun": {"A": [[0, 0], [1, 0]], "b": [F(1, 2)] * 2, "c": [0, 1], "order": 2},
    "more": [
        {"name": "a digit", "A": [[0, 0], [1, 0]], "b": [0.5, 0.6], "c": [0, 1], "order": 2},
        dict(name="a node", A=[[0, 0], [1, 0]], b=[0.5, 0.5], c=[0, 0.5], order=2),
    ],
}
SYSTEMS = [{"A": [[4, 1], [1, 3]], "b": [1, 2]}]

def third(x):
    return {"A": [[0, 0], [1, 0]], "b": ["1/2", "1/2"], "c": [0, 1], "order": 3, "at": x}
"""
WITH = """
RalstonCoefficients[2, p_] := N[{{{2/3}}, {1/4, 3/4}, {2/3}}, p];
GoodCoefficients[4, p_] := With[{amat = {{1/2}, {0, 1/2}, {0, 0, 1}},
  bvec = {1/6, 1/3, 1/3, 1/6}, cvec = {1/2, 1/2, 1}}, N[{amat, bvec, cvec}, p]];
BadCoefficients[4, p_] := With[{amat = {{1/2}, {0, 1/2}, {0, 0, 1}},
  bvec = {1/6, 1/3, 1/3, 1/6}, cvec = {1/2, 1/3, 1}}, N[{amat, bvec, cvec}, p]];
"""
DECLARED = """
PETSC_EXTERN PetscErrorCode TSRKRegister(TSRKType, PetscInt, PetscInt, const PetscReal[],
  const PetscReal[], const PetscReal[], const PetscReal[], PetscInt, const PetscReal[]);
ARKodeButcherTable ARKodeButcherTable_Create(int s, int q, int p, sunrealtype* c,
                                             sunrealtype* A, sunrealtype* b, sunrealtype* d)
{
  return NULL;
}
"""
CALLED = """
static PetscErrorCode all(void)
{
  const PetscReal A[4] = {0, 0, 1, 0}, b[2] = {0.5, 0.5};
  PetscCall(TSRKRegister(TSRK2B, 2, 2, A, b, NULL, NULL, 0, NULL));
  return TSRKRegister("third", 3, 2, A, b, NULL, NULL, 0, NULL);
}
"""


def told(name: str, text: str, folder: Path) -> dict[str, list[str]]:
    """The codes of the findings of each table of a source, by name."""
    (folder / name).write_text(text, encoding="utf-8")
    run = gark("audit", str(folder), "--format", "json")
    assert run.code in {0, 1}, run.err
    return {
        table["name"]: [finding["code"] for finding in table["findings"]]
        for table in json.loads(run.out)["tables"]
    }


def test_dictionaries_in_dictionaries_and_lists(tmp_path: Path) -> None:
    """Python keeps tables so: by name in a dictionary, in lists, returned; systems are none."""
    assert told("tables.py", NESTED, tmp_path) == {
        "heun": [],
        "a digit": ["order"],
        "a node": ["nodes"],
        "third": ["order"],
    }


def test_lists_of_a_with_beside_a_plain_function(tmp_path: Path) -> None:
    """NDSolve's coefficients in With are read too, where another function has them in place."""
    found = told("methods.wl", WITH, tmp_path)
    assert found["RalstonCoefficients"] == []
    (tmp_path / "methods.wl").unlink()
    run = gark("audit", "-", "--format", "json", stdin=WITH)
    codes = [
        [finding["code"] for finding in table["findings"]]
        for table in json.loads(run.out)["tables"]
    ]
    assert codes == [[], [], ["nodes"]]


@pytest.mark.parametrize("name", ["petscts.h", "rk.c"])
def test_a_declaration_is_no_table(name: str, tmp_path: Path) -> None:
    """A header that declares constructors has no tables, and a constructor is none itself."""
    (tmp_path / name).write_text(DECLARED, encoding="utf-8")
    assert gark("audit", str(tmp_path)).code == 2


def test_a_method_has_the_name_of_its_constant(tmp_path: Path) -> None:
    """PETSc's own methods are registered under constants, not under texts."""
    found = told("rk.c", CALLED, tmp_path)
    assert found == {"TSRK2B": [], "third": ["order"]}


def test_files_that_cannot_be_read_stop_no_audit(tmp_path: Path) -> None:
    """A link that leads nowhere, a pipe and a file of five million bytes are told, and passed by."""
    (tmp_path / "a.c").symlink_to("nowhere.c")
    os.mkfifo(tmp_path / "b.c")
    (tmp_path / "c.json").write_text(" " * 5_000_000)
    (tmp_path / "d.c").write_text(CALLED, encoding="utf-8")
    for command in ("audit", "import"):
        run = gark(command, ".", cwd=tmp_path)
        assert run.code == 1
        told = run.err.splitlines()[:3]
        assert [line.partition(" ")[0] for line in told] == ["./a.c", "./b.c", "./c.json"]
    assert gark("audit", "c.json", cwd=tmp_path).code == 2


@pytest.fixture(scope="module")
def dormand_prince() -> str:
    """A class of SciPy with fractions of many digits."""
    return gark("export", "dormand-prince-5", "--to", "scipy").out


@pytest.mark.parametrize(
    ("before", "after", "code"),
    [
        ("19372/6561", "19371/6561", "order"),
        ("-5103/18656", "-5104/18656", "order"),
        ("-71/1920", "-71/1921", "embedded-weights"),
        ("71/16695", "71/16696", "embedded-weights"),
    ],
)
def test_a_digit_of_a_long_fraction_is_no_rounding(
    before: str, after: str, code: str, dormand_prince: str, tmp_path: Path
) -> None:
    """Whole numbers of any length are what they are, in sums with others too."""
    assert before in dormand_prince
    assert told("right.py", dormand_prince, tmp_path) == {"DormandPrince54": []}
    (tmp_path / "right.py").unlink()
    wrong = dormand_prince.replace(before, after)
    assert code in told("wrong.py", wrong, tmp_path)["DormandPrince54"]


@in_whole
def test_an_exact_method_is_imported_as_exact() -> None:
    """Fractions of eighty digits, of which the conditions of order 9 are missed by little."""
    text = gark("export", "tsitouras-papakostas-8", "--to", "json").out
    run = gark("import", "-", "--format", "yaml", stdin=text)
    assert "tolerance" not in run.out
    assert run.out.endswith("expect: {order: 8, embedded-order: 7}\n")


@pytest.mark.parametrize(
    "name", ["ssp-53-nodepy", "ssp-53", pytest.param("tsitouras-5", marks=in_whole)]
)
def test_decimals_that_became_fractions(name: str) -> None:
    """JSON has the decimals of a rounded method as fractions, which are as rounded as before."""
    text = gark("export", name, "--to", "json").out
    order = json.loads(text)["order"]
    run = gark("import", "-", "--format", "yaml", stdin=text)
    assert f"expect: {{order: {order}" in run.out


@in_whole
@pytest.mark.parametrize("name", sample(["esdirk-436", "ark-324", "qesdirk-436"], 3))
def test_approximants_are_no_misprints(name: str, tmp_path: Path) -> None:
    """Quotients of thirteen digits, as Kennedy and Carpenter print them, beside longer decimals; a
    last digit that is wrong is found.
    """
    text = gark("export", name, "--to", "sundials").out
    assert not any(told("right.c", text, tmp_path).values())
    (tmp_path / "right.c").unlink()
    place = text.index(".0) / SUN_RCONST(", text.index("b[") if "b[" in text else 0)
    digit = text[place - 1]
    other = str((int(digit) + 1) % 10)
    wrong = text[: place - 1] + other + text[place:]
    assert any(told("wrong.c", wrong, tmp_path).values())


@pytest.mark.parametrize("name", ["sdirk-2", "implicit-midpoint"])
def test_implicit_methods_of_petsc(name: str, tmp_path: Path) -> None:
    """They are registered as pairs whose explicit part is zero, which is no wrong method."""
    text = gark("export", name, "--to", "petsc").out
    assert "TSARKIMEXRegister" in text
    assert list(told("right.c", text, tmp_path).values()) == [[]]


PARTS = {
    "classes.py": """
class RK111(RungeKuttaIMEX):
    stages = 1
    c = np.array([0, 1])
    A = np.array([[0, 0], [1, 0]])
    H = np.array([[0, 0], [0, 1]])
    order = 2
""",
    "tableau.jl": """
tableau(::ARS111) = IMEXTableau(; a_exp = @SArray([0 0; 1 0]), a_imp = @SArray([0 0; 0 2]))
alg_order(::ARS111) = 1
""",
    "rows.py": """
class IMEX_Euler(IMEXRungeKutta):
    def __init__(self, domain):
        butcher_imp = np.array([[0., 0.], [0., 1.], [0., 1.]])
        butcher_exp = np.array([[0., 0.], [1., 0.], [1., 0.]])
        super().__init__(domain, butcher_imp, butcher_exp)
""",
}


def test_two_parts_are_one_method(tmp_path: Path) -> None:
    """An explicit and an implicit matrix are judged together; missing weights are last rows."""
    for name, text in PARTS.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    run = gark("audit", str(tmp_path), "--format", "json")
    found = {x["name"]: (x["order"], x["declared_order"]) for x in json.loads(run.out)["tables"]}
    assert found == {"RK111": (1, 2), "ARS111": (0, 1), "IMEX_Euler": (1, None)}


ELSEWHERE = {
    "alg_utils.jl": "alg_order(::Union{Kutta, Other}) = 4\nalg_order(alg::Midpoint) = 2\n",
    "kutta.jl": """
function KuttaConstantCache(T, T2)
    a21 = convert(T, 1 // 2)
    a31 = convert(T, -1)
    a32 = convert(T, 2)
    b1 = convert(T, 1 // 6)
    b2 = convert(T, 2 // 3)
    b3 = convert(T, 1 // 6)
    c2 = convert(T2, 1 // 2)
    c3 = convert(T2, 1)
    return KuttaConstantCache(a21, a31, a32, b1, b2, b3, c2, c3)
end
function MidpointTableau(T)
    A = [0 0; 1//2 0]
    b = [0, 1]
    c = [0, 1//2]
    return MidpointTableau(A, b, c)
end
""",
    "tables.py": "EULER = dict(A=[[0, 0], [1, 0]], b=[0.5, 0.5], c=[0, 1])\n",
    "solvers.py": "class Solver(Base):\n    tableau = EULER\n    order = 1\n",
    "own.py": """
class Third:
    tableau = ButcherTableau(A=[[0, 0], [1, 0]], b=[0.5, 0.5], c=[0, 1])
    def order(self, terms):
        del terms
        return 3
""",
}


def test_orders_are_declared_elsewhere(tmp_path: Path) -> None:
    """For an algorithm or a class, in another file; by a method of the class."""
    for name, text in ELSEWHERE.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    run = gark("audit", str(tmp_path), "--format", "json")
    found = {
        x["name"]: (x["declared_order"], [y["level"] for y in x["findings"]])
        for x in json.loads(run.out)["tables"]
    }
    assert found == {
        "KuttaConstantCache": (4, ["warning"]),
        "MidpointTableau": (2, []),
        "EULER": (1, ["warning"]),
        "Third": (3, ["error"]),
    }


OTHERS = {
    "test.py": "def test_shapes():\n    bad_t = [[0, 1], [2, 3]]\n    call(bad_t)\n",
    "radau.py": """
class Radau:
    def load(self):
        A = np.array([[5/12, -1/12], [3/4, 1/4]])
        b = [3/4, 1/4]
        c = [1/3, 1]
        E = [-10.0484, 1.38208]
""",
    "weights.jl": "function f(y, T)\n    A_imp = T[-3 0; 0 0]\n    A_exp = T[0 1; 1 -1]\nend\n",
}


def test_what_only_has_such_names(tmp_path: Path) -> None:
    """A matrix whose name begins with b is no block of RKLab, error constants are no weights, and
    parts of a right-hand side no tableaus.
    """
    for name, text in OTHERS.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    run = gark("audit", str(tmp_path), "--format", "json")
    tables = json.loads(run.out)["tables"]
    assert [(x["order"], x["embedded_order"]) for x in tables] == [(3, None)]
    (finding,) = tables[0]["findings"]
    assert (finding["level"], finding["message"]) == (
        "note",
        "error weights are not read: the sum is -8.67",
    )


SCALARS = """
submodule (rk) steps
contains
module procedure named
    real(wp), parameter :: a2 = 1.0_wp / 4.0_wp, a3 = 1.0_wp / 2.0_wp
    real(wp), parameter :: b31 = 1.0_wp / 4.0_wp, b32 = 1.0_wp / 4.0_wp
    real(wp), parameter :: c1 = 0.0_wp, c3 = 1.0_wp
end procedure named
module procedure scaled
    real(wp), parameter :: a1 = 1.0_wp / 100.0_wp, a2 = 3.0_wp / 5.0_wp
    real(wp), parameter :: b20 = -4278.0_wp, b21 = 4425.0_wp, b30 = 524746.0_wp
    real(wp), parameter :: b31 = -532125.0_wp, b32 = 16170.0_wp
    real(wp), parameter :: c0 = -179124.0_wp, c1 = 200000.0_wp
end procedure scaled
end submodule
"""


def test_single_numbers_are_read_or_named(tmp_path: Path) -> None:
    """An entry that is but its node is taken from it; what does not fit is named, not lost."""
    assert told("steps.f90", SCALARS, tmp_path) == {"named": [], "scaled": ["unread"]}


def test_a_node_that_is_not_written_is_the_whole_sum(tmp_path: Path) -> None:
    """The sum of long and short numbers is not cut to the digits of the short ones."""
    long = "12345" * 16
    names = {f"a{i}": "0.5" for i in range(2, 8)} | {f"b{i}1": "0.5" for i in range(2, 8)}
    names |= {"b81": "0.123456789"} | {f"b8{j}": f"0.{j}{long}" for j in range(2, 8)}
    names |= {"c1": "0.0", "c2": "1.0"}
    lines = [f"    real(wp), parameter :: {name} = {x}_wp" for name, x in names.items()]
    text = "\n".join(["subroutine step()", *lines, "end subroutine\n"])
    (tmp_path / "steps.f90").write_text(text, encoding="utf-8")
    assert told("steps.f90", text, tmp_path) == {"step": []}


def test_rows_of_signed_fractions_in_lists(tmp_path: Path) -> None:
    """Rows in brackets of their own, with blanks between their entries."""
    text = """
function Radau(T = Float64)
    a = [
        [ 5//12   (- 1)/12 ]
        [ 3//4     1//4    ]
    ]
    return Tableau{T}(:RadauIIA2, 3, a, [3//4, 1//4], [1//3, 1//1])
end
"""
    assert told("radau.jl", text, tmp_path) == {"RadauIIA2": []}
