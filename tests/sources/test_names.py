"""A method has the name that people call it by: its key, its type, its class."""

from __future__ import annotations

import pytest

from garkcli.bridges.audit import audit
from garkcli.bridges.claiming import imported
from garkcli.sources.languages import julia, matlab, python

HEUN = "A=[[0, 0], [1, 0]], b=[0.5, 0.5], c=[0, 1]"
PYTHON = {
    "the class that uses it": (
        f"_heun_tableau = ButcherTableau({HEUN})\nclass Heun(Solver):\n    tableau = _heun_tableau\n",
        "Heun",
    ),
    "itself, where several do": (
        f"_heun = ButcherTableau({HEUN})\nclass A(S):\n    t = _heun\nclass B(S):\n    t = _heun\n",
        "_heun",
    ),
    "its own, where that is public": (
        f"HEUN = ButcherTableau({HEUN})\nclass Heun(Solver):\n    tableau = HEUN\n",
        "HEUN",
    ),
    "its class": (
        "class Heun(Tableau):\n    def __init__(self):\n        A = [[0, 0], [1, 0]]\n"
        "        b = [0.5, 0.5]\n        super().__init__(A, b)\n",
        "Heun",
    ),
    "its key": (f"RK = {{}}\nRK['Heun'] = Method({HEUN})\n", "Heun"),
    "the text of its key": (f"RK = {{}}\nname = 'Heun'\nRK[name] = Method({HEUN})\n", "Heun"),
}


@pytest.mark.parametrize("name", PYTHON)
def test_python(name: str) -> None:
    """A private name is that of nobody; a class, a key or a public constant is."""
    text, wanted = PYTHON[name]
    (table,) = python.find(text, "x.py")
    assert (table.trouble, table.name) == ("", wanted)


SSP222 = """
struct SSP222 <: Name end
function IMEXTableau(::SSP222)
    γ = 1 - √2 / 2
    return IMEXTableau(; a_exp = @SArray([0 0; 1 0]), b_exp = @SArray([1 / 2, 1 / 2]),
        a_imp = @SArray([γ 0; (1 - 2γ) γ]), b_imp = @SArray([1 / 2, 1 / 2]))
end
function IMEXTableau(::ARS111)
    return IMEXTableau(; a_exp = @SArray([0 0; 1 0]), a_imp = @SArray([0 0; 0 1]))
end
"""


def test_julia() -> None:
    """The type that a method is dispatched on; weights that are left out are last rows, nodes the
    sums of each colour's own rows.
    """
    first, second = julia.find(SSP222, "x.jl")
    assert (first.name, first.c, len(first.A)) == ("SSP222", (None, None), 2)
    assert (second.name, second.b, len(second.A)) == ("ARS111", (("1", "0"), ("0", "1")), 1)
    assert (imported(first, "x").order.order, imported(second, "x").order.order) == (2, 1)


@pytest.mark.parametrize(
    ("A", "b", "low"),
    [
        ("aLower", "bSol", "bHat"),
        ("AMAT", "B", "B_HAT"),
        ("A", "B", "BHAT"),
        ("Amat", "Weights", "BStar"),
        ("A", "B_HIGH", "B_LOW"),
        ("a", "b", "bTilde"),
    ],
)
def test_words_in_the_spelling_of_a_language(A: str, b: str, low: str) -> None:
    """Constants have capitals, fields of Java and C# have them for underscores."""
    text = f"{A} = [[0, 0], [1, 0]]\n{b} = [1/2, 1/2]\n{low} = [1, 0]\n# Runge-Kutta"
    (table,) = python.find(text, "x.py")
    assert (table.b, table.embedded) == ((("1/2", "1/2"),), (("1", "0"),))


HATS = """
def ars_233():
    g = (3 + sqrt(3))/6
    ahat = [[0, 0, 0], [g, 0, 0], [g - 1, 2*(1 - g), 0]]
    bhat = [0, 0.5, 0.5]
    a = [[0, 0, 0], [0, g, 0], [0, 1 - 2*g, g]]
    b = [0, 0.5, 0.5]
    order = 3
    return ahat, bhat, a, b
"""
"""Of Ascher, Ruuth and Spiteri (1997)."""


def test_a_hat_on_both_is_the_explicit_part() -> None:
    """Weights with a hat are embedded ones only beside one matrix."""
    (table,) = python.find(HATS, "x.py")
    assert (table.colours, table.embedded) == (2, None)
    found = audit(table)
    assert found is not None
    assert found.order is not None
    assert (found.order.order, found.findings) == (3, ())


@pytest.mark.parametrize(
    ("text", "order"),
    [
        ("class BackwardEuler:\n    A = [[1.0]]\n    b = [1.0]\n", 1),
        ("class ImplicitMidpoint:\n    A = [[0.5]]\n    w = [1]\n", 2),
        ("class Shift:\n    A = [[1.0]]\n    b = [1.0]\n", None),
        ("class Shift:\n    A = [[0.5]]\n    b = [1.0]\n    c = [0.5]\n", None),
    ],
)
def test_one_stage_needs_words(text: str, order: int | None) -> None:
    """Its numbers say nothing."""
    (table,) = python.find(text, "x.py")
    found = audit(table)
    assert (found and found.order and found.order.order) == order


def test_numbers_of_matlab_are_matrices() -> None:
    """So is the method of one stage in a structure, where its class speaks of it."""
    text = (
        "classdef {} < Solver\n  methods\n    function this = {}()\n      t.A = 1;\n"
        "      t.b = 1;\n      t.c = 1;\n      this@Solver(t);\n    end\n  end\nend\n"
    )
    (table,) = matlab.find(text.replace("{}", "ImplicitEuler"), "x.m")
    found = audit(table)
    assert found is not None
    assert found.order is not None
    assert found.order.order == 1
    (other,) = matlab.find(text.replace("{}", "Shift"), "x.m")
    assert audit(other) is None


def test_weights_far_from_1_need_nodes() -> None:
    """A declared order alone does not make a table of multistep coefficients."""
    text = "def ssp():\n    a = [3/4, 0, 1/4]\n    b = [{}, 0, 0]\n    order = 2\n"
    (table,) = python.find(text.format("3/2"), "x.py")
    found = audit(table)
    assert found is not None
    assert (found.is_read, [x.level for x in found.findings]) == (False, ["note"])
