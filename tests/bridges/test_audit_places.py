"""gark audit: tables in places where solvers keep them, and what only looks like a table."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from tests.cli.harness import gark

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
        assert run.code == int(command == "audit")
        told = run.err.splitlines()
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


def test_an_exact_method_is_imported_as_exact() -> None:
    """Fractions of eighty digits, of which the conditions of order 9 are missed by little."""
    text = gark("export", "tsitouras-papakostas-8", "--to", "json").out
    run = gark("import", "-", "--format", "yaml", stdin=text)
    assert "tolerance" not in run.out
    assert run.out.endswith("expect: {order: 8, embedded-order: 7}\n")


@pytest.mark.parametrize("name", ["ssp-53-nodepy", "ssp-53", "tsitouras-5"])
def test_decimals_that_became_fractions(name: str) -> None:
    """JSON has the decimals of a rounded method as fractions, which are as rounded as before."""
    text = gark("export", name, "--to", "json").out
    order = json.loads(text)["order"]
    run = gark("import", "-", "--format", "yaml", stdin=text)
    assert f"expect: {{order: {order}" in run.out


@pytest.mark.parametrize("name", ["ark-324", "esdirk-436", "qesdirk-436"])
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
