"""The polynomials that ``gark design`` shows: their zeros are the solutions, no more and no fewer.

The second way is sympy: its own Gröbner bases of conditions that are written down from B(p) and the
products of A and b, without trees.
"""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest
import sympy
from flint import fmpq, fmpq_mpoly

from garkcli import find_order, loads
from garkcli.design.design import find_parameters
from garkcli.design.groebner import leading
from garkcli.design.ideal import Ideal
from garkcli.design.steps import NoValue
from garkcli.exact.parametric import Parameters
from garkcli.methodfile.family import loads_family
from garkcli.problems.draw import Draw
from tests.cli.harness import gark
from tests.whole import in_whole

ATTACKED = """parameters: {x: free, y: free, z: free, w: free}
A: [[0, 0, 0], ["x**2 + 1/y", 0, 0], [0, "z", 0]]
b: [w, z, y]
"""
FAMILIES = {
    "a denominator beside a square": (
        ATTACKED,
        [[0, 0, 0], ["x**2 + 1/y", 0, 0], [0, "z", 0]],
        ["w", "z", "y"],
    ),
    "two denominators": (
        'parameters: {x: free, y: free}\nA: [[0, 0], ["1/x + 1/(y - 1)", 0]]\nb: ["1 - y", y]\n',
        [[0, 0], ["1/x + 1/(y - 1)", 0]],
        ["1 - y", "y"],
    ),
    "a denominator that cancels": (
        'parameters: {x: free, y: free}\nA: [[0, 0], ["x*y/(2*x)", 0]]\nb: ["1 - x", x]\n',
        [[0, 0], ["y/2", 0]],
        ["1 - x", "x"],
    ),
    "a denominator of degree two": (
        'parameters: {x: free, y: free}\nA: [[0, 0], ["y/(x**2 - 2)", 0]]\nb: ["1 - x*y", "x*y"]\n',
        [[0, 0], ["y/(x**2 - 2)", 0]],
        ["1 - x*y", "x*y"],
    ),
}


def _conditions(A: list[list[object]], b: list[str], order: int) -> list[sympy.Expr]:
    """The order conditions up to 3, as rational functions."""
    matrix = sympy.Matrix([[sympy.sympify(x) for x in row] for row in A])
    weights = sympy.Matrix([[sympy.sympify(x) for x in b]])
    one = sympy.ones(len(b), 1)
    c = matrix * one
    squares = sympy.Matrix([x**2 for x in c])
    found = [
        (weights * one)[0] - 1,
        (weights * c)[0] - sympy.Rational(1, 2),
        (weights * squares)[0] - sympy.Rational(1, 3),
        (weights * matrix * c)[0] - sympy.Rational(1, 6),
    ]
    return found[: {1: 1, 2: 2, 3: 4}[order]]


def _is_empty(polynomials: list[sympy.Expr], unknowns: list[sympy.Symbol]) -> bool:
    """Whether polynomials have no common zero, not even a complex one."""
    return sympy.groebner(polynomials, *unknowns, order="grevlex").exprs == [1]


@pytest.mark.parametrize("name", FAMILIES)
@pytest.mark.parametrize("order", [1, 2, 3])
def test_polynomials_have_the_zeros_of_the_conditions(name: str, order: int) -> None:
    """Each polynomial is zero wherever the conditions hold and no denominator vanishes, and the
    conditions hold at every zero of them that is not excluded.
    """
    text, A, b = FAMILIES[name]
    family = loads_family(text)
    step = find_parameters(family, order).steps[-1]
    if step.order < order:
        pytest.skip("no value has the order below")
    unknowns = list(map(sympy.Symbol, family.parameters))
    u = sympy.Symbol("u")
    product = sympy.Integer(1)
    for entry in (*(x for row in A for x in row), *b):
        _, denominator = sympy.fraction(sympy.together(sympy.sympify(entry)))
        product = sympy.lcm(product, denominator)
    for polynomial in family.nonzero:
        product = sympy.lcm(product, sympy.sympify(str(polynomial)))
    conditions = []
    for condition in _conditions(A, b, order):
        numerator, _ = sympy.fraction(sympy.together(condition))
        conditions.append(numerator)
    shown = [sympy.sympify(str(p).replace("^", "**")) for p in step.polynomials]
    excluded = [sympy.sympify(str(p).replace("^", "**")) for p in step.nonzero]
    outside = sympy.Mul(*excluded)
    for p in shown:
        assert _is_empty([*conditions, u * product * p - 1], [u, *unknowns])
    for condition in conditions:
        assert _is_empty([*shown, u * outside * condition - 1], [u, *unknowns])
    # what is said to be not zero is so at a method, and nothing else is
    for factor in excluded:
        assert sympy.rem(product, factor, *unknowns) == 0
    assert _is_empty([*shown, *conditions, u * outside - 1, product], [u, *unknowns])
    for p in shown:
        assert sympy.factor_list(p)[1] == [(f, 1) for f, _ in sympy.factor_list(p)[1]]


def test_a_point_that_was_said_to_have_the_order() -> None:
    """X = y = z = 1, w = −1 has order 1 alone, and is no zero; random zeros have order 2."""
    point = {"x": "1", "y": "1", "z": "1", "w": "-1"}
    assert find_order(loads(ATTACKED, settings=point)).order == 1
    step = find_parameters(loads_family(ATTACKED), 2).last
    (plane, other) = (sympy.sympify(str(p).replace("^", "**")) for p in step.polynomials)
    assert plane.subs(point) == 0
    assert other.subs(point) != 0
    draw = Draw(1)
    count = 0
    while count < 5:
        y, z = (Fraction(draw.between(-12, 12), draw.between(1, 6)) for _ in range(2))
        if not y or not z:
            continue
        w = 1 - y - z
        # z x² + z/y + y z = 1/2, from b·c by hand, for x
        square = (Fraction(1, 2) - z / y - y * z) / z
        if square < 0:
            continue
        values = {"x": f"sqrt({square})", "y": str(y), "z": str(z), "w": str(w)}
        assert find_order(loads(ATTACKED, settings=values)).order >= 2
        assert sympy.simplify(other.subs({k: sympy.sympify(v) for k, v in values.items()})) == 0
        count += 1


def test_json_has_the_same(tmp_path: Path) -> None:
    """The ideal and what is not zero; text says both, and never that nothing is zero."""
    path = tmp_path / "family.yaml"
    path.write_text(ATTACKED, encoding="utf-8")
    data = json.loads(gark("design", str(path), "--order", "2", "--format", "json").out)
    assert len(data["ideal"]) == 2
    assert (data["dimension"], data["restrictions"], data["reached"]) == (2, ["y ≠ 0"], True)
    text = gark("design", str(path), "--order", "2").out
    assert text.count("where y ≠ 0") == 2
    zeros = " ".join(text.split()).split("complex, of ")[1:]
    assert zeros
    assert all(polynomials[0].isalnum() for polynomials in zeros)


RING = Parameters(["x", "y"])
X, Y = RING.context.gens()


@pytest.mark.parametrize(
    ("polynomials", "nonzero", "expected"),
    [
        ([X**2], [], [X]),
        ([X**2 * Y**3], [], [X * Y]),
        ([X**2, Y**2 - Y**3], [], [Y**2 - Y, X]),
        ([(X - Y) ** 2], [], [X - Y]),
        ([X * Y - Y], [Y], [X - 1]),
        ([X * Y**2 - Y], [Y], [X * Y - 1]),
        ([X * Y], [Y, X - Y], [X]),
    ],
)
def test_powers_and_what_is_not_zero(
    polynomials: list[fmpq_mpoly], nonzero: list[fmpq_mpoly], expected: list[fmpq_mpoly]
) -> None:
    """Square-free, saturated, and of finitely many zeros the radical."""
    found = Ideal(RING, nonzero).with_zeros(polynomials).polynomials
    assert {str(p) for p in found} == {str(p) for p in expected}


def test_elimination_by_weights() -> None:
    """Where polynomials without UNIT in front have it behind, a larger weight is taken: the closure
    is an ideal of the parameters, and each of its polynomials is in the ideal.
    """
    ring = Parameters(["x", "y", "z"])
    x, y, z = ring.context.gens()
    ideal = Ideal(ring, [y]).with_zeros([x**2 * y + 1 - z * y, z**3 - x * y])
    assert any(not leading(p)[-1] and p.degrees()[-1] for p in ideal.basis)
    assert all(len(leading(p)) == 3 for p in ideal.closure.basis)
    for p in ideal.closure.basis:
        terms = {tuple(map(int, e)): fmpq(a) for e, a in p.to_dict().items()}
        assert ideal.contains(ring.context.from_dict(terms))
    assert ideal.closure.dimension == ideal.dimension == 1


@pytest.mark.parametrize("seed", range(12))
def test_points_without_the_unit(seed: int) -> None:
    """Of finitely many points the polynomials without UNIT are those of sympy's elimination by a
    lexicographic order.
    """
    draw = Draw(seed)
    x, y = sympy.symbols("x y")
    unit = sympy.Symbol("u")

    def number() -> int:
        return draw.word() % 7 - 3

    f = sum(number() * x**i * y**j for i in range(3) for j in range(3)) + x**3
    g = sum(number() * x**i * y**j for i in range(3) for j in range(2)) + y**2
    product = (x - 1) * (y + number())
    ring = Parameters(["x", "y"])

    def of_ring(p: sympy.Expr) -> fmpq_mpoly:
        terms = sympy.Poly(p, x, y).terms()
        return ring.context.from_dict({e: fmpq(int(a)) for e, a in terms})

    ideal = Ideal(ring, [of_ring(product)]).with_zeros([of_ring(f), of_ring(g)])
    assert ideal.dimension <= 0
    basis = sympy.groebner([f, g, unit * product - 1], unit, x, y, order="lex")
    free = [p for p in basis.exprs if not p.has(unit)]
    theirs = sympy.groebner(free, x, y, order="grevlex")
    ours = {sympy.Poly(str(p).replace("^", "**"), x, y).monic() for p in ideal.closure.basis}
    assert ours == {sympy.Poly(p, x, y).monic() for p in theirs.exprs}


def test_many_points_of_two_unknowns() -> None:
    """Order 3 of three stages whose entries have denominators: 21 solutions, three of them real;
    elimination by weights did not end in a minute. None of them has order 4, which the solutions
    say, each by its certificate.
    """
    text = """
parameters: {g: free, h: free}
A:
  - [2*h - 1/2, 0, 0]
  - [(g*(g + 5) + 3)/h, h*(-h - 1) + 2, 0]
  - ["(-8*g*(g*(g + 5) + h^2*(-h - 1) + 2*h + 3) - h*(1 - 2*g)*(4*h - 1) + 2*h)/(4*h*(1 - 2*g))",
     -1/4, h]
b: [0, 2*g, 1 - 2*g]
"""
    *_, third, fourth = find_parameters(loads_family(text)).steps
    (found,) = third.found
    assert (found.solution.degree, len(found.accepted)) == (21, 3)
    assert found.order is not None
    assert found.order.order == 3
    assert found.order.witness is not None
    assert isinstance(fourth, NoValue)
    assert fourth.witness == found.order.witness.tree


@in_whole
def test_a_large_set_is_said_with_what_is_not_zero() -> None:
    """Where elimination is large, the polynomials are cleared of the denominator: an implicit-explicit
    family of four stages with R(∞) = 0, γ ≠ 0; the method of the gallery is a zero of all.
    """
    family = loads_family(
        "unknown: {stages: 4, shape: [imex, stiffly-accurate]}\ndesign: {R-infinity: {2: 0}}\n"
    )
    step = find_parameters(family, 3).last
    assert [str(p) for p in step.nonzero] == ["gamma"]
    assert step.has_methods is True
    assert len(step.polynomials) > 8


@in_whole
def test_denominators_that_are_numbers_are_not_said() -> None:
    """√5 and 5 ± √5 divide coefficients of Lobatto IIIA with four stages. They are not zero, and
    nothing but 3 = √3² and 5 = √5² is said of numbers alone.
    """
    family = loads_family('methods: [gauss-2, lobatto-iiia-4]\ntransfer: "?"\n')
    step = find_parameters(family, 3).last
    assert step.nonzero == ()
    count = len(family.parameters)
    of_numbers = [p for p in step.polynomials if not any(p.degrees()[:count])]
    assert len(of_numbers) == len(family.radicals) == 2
    assert all(p.total_degree() == 2 for p in of_numbers)
