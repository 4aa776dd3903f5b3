"""Families with options: their orders by two ways that share nothing, and what characterises them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import pytest
from flint import ctx, fmpq, fmpq_poly

from garkcli import backward_analysis, trees
from garkcli.errors import MethodFileError, UnknownFamily
from garkcli.families.collocation import legendre
from garkcli.families.extrapolated import extrapolation_weights, sequence
from garkcli.families.registry import FAMILIES, diagonal_method
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import loads
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import elementary_weight
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import is_symplectic
from garkcli.problems.files.load import loads_problem
from garkcli.properties.symmetry import symmetry
from garkcli.stability.ssp import ssp_coefficient
from garkcli.stepping.integrator import Stepper, bind
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Method, Tableau
from tests.oracles.series import series_order

MEMBERS: list[tuple[str, int | None, dict[str, object], int, int]] = [
    ("sdirk2", None, {"gamma": "1/4"}, 2, 2),
    ("sdirk2", None, {"gamma": "1 - sqrt(2)/2"}, 2, 2),
    ("sdirk2", None, {"gamma": "(3 - sqrt(3))/6"}, 2, 3),
    ("lobatto-iiis", 3, {"sigma": "0"}, 3, 4),
    ("lobatto-iiis", 3, {"sigma": "sqrt(2)"}, 3, 4),
    ("hbvm", 1, {"degree": 1}, 1, 2),
    ("hbvm", 4, {"degree": 1}, 4, 2),
    ("hbvm", 5, {"degree": 2}, 5, 4),
    ("hbvm", 5, {"degree": 3}, 5, 6),
    ("extrapolated-euler", 1, {}, 1, 1),
    ("extrapolated-euler", 3, {}, 4, 3),
    ("extrapolated-euler", 4, {"sequence": "romberg"}, 12, 4),
    ("extrapolated-euler", 5, {"sequence": "bulirsch"}, 12, 5),
    ("extrapolated-implicit-euler", 3, {}, 6, 3),
    ("extrapolated-midpoint", 2, {}, 2, 2),
    ("extrapolated-midpoint", 4, {}, 5, 4),
    ("extrapolated-midpoint", 6, {"sequence": "romberg"}, 12, 6),
    ("sdc", 2, {"sweeps": 2}, 4, 2),
    ("sdc", 2, {"sweeps": 5}, 10, 3),
    ("sdc", 3, {"sweeps": 3, "nodes": "lobatto"}, 6, 3),
    ("sdc", 3, {"sweeps": 4, "nodes": "lobatto", "sweep": "implicit"}, 9, 4),
    ("sdc", 3, {"sweeps": 3, "sweep": "implicit"}, 9, 3),
    ("sdc", 2, {"sweeps": 2, "nodes": "gauss"}, 5, 3),
    ("sdc", 2, {"sweeps": 9, "nodes": "radau-ia"}, 10, 3),
    ("sdc", 4, {"sweeps": 9, "nodes": "equidistant"}, 27, 4),
]
"""A family, its size, its options; the stages and the order that theory gives.

Deferred corrections: a sweep gains an order up to that of the quadrature, and the quadrature at the
end, where the last node is not 1, one more. Equidistant nodes have the order of their quadrature.
"""


def alone(method: Method) -> Tableau:
    """The method as a tableau of one colour."""
    return gark([method], {})


@pytest.mark.parametrize(("name", "size", "options", "stages", "order"), MEMBERS)
def test_orders_by_two_ways(
    name: str, size: int | None, options: dict[str, object], stages: int, order: int
) -> None:
    """The certificate finds the order of theory, not one more; so does the power series of a step,
    which knows no trees.
    """
    method = diagonal_method(name, size, **options)
    tableau = alone(method)
    assert method.stages == stages
    assert find_order(tableau).order == order
    if order <= 4:
        assert series_order(tableau, order + 1) == order


def test_every_family_with_options_is_tested() -> None:
    """No family with options is left out of the list."""
    with_options = {name for name, x in FAMILIES.items() if x.options}
    assert with_options == {name for name, *_ in MEMBERS}


def test_order_twelve() -> None:
    """High orders are as sure as low ones: Gragg's rule to order 10, Euler to order 8."""
    assert find_order(alone(diagonal_method("extrapolated-midpoint", 10))).order == 10
    assert find_order(alone(diagonal_method("extrapolated-euler", 8))).order == 8


def test_lobatto_iiis() -> None:
    """IIIS is IIIE for σ = 1/2, IIID for σ = 1, and symplectic and symmetric for any other."""
    by_sigma = {
        text: diagonal_method("lobatto-iiis", 4, sigma=text) for text in ("1/2", "1", "-7/3")
    }
    assert by_sigma["1/2"].A == diagonal_method("lobatto-iiie", 4).A
    assert by_sigma["1"].A == diagonal_method("lobatto-iiid", 4).A
    for method in by_sigma.values():
        assert is_symplectic(alone(method))
        assert symmetry(alone(method)).holds


@pytest.mark.parametrize("name", ["radau-ib", "radau-iib"])
def test_radau_b_is_symplectic(name: str) -> None:
    """Radau IB and IIB are symplectic, which IA and IIA are not."""
    assert is_symplectic(alone(diagonal_method(name, 3)))
    assert not is_symplectic(alone(diagonal_method(name[:-1] + "a", 3)))


@pytest.mark.parametrize("n", [2, 3, 4])
def test_ssp3_has_the_optimal_coefficient(n: int) -> None:
    """SSPRK(n², 3) has order 3 and the coefficient n² − n of Ketcheson's paper."""
    tableau = alone(diagonal_method("ssp3", n * n))
    assert find_order(tableau).order == 3
    found = ssp_coefficient(tableau)
    assert found is not None
    assert found.value is not None
    assert found.value.exact == n * n - n


def test_one_implicit_sweep_is_euler() -> None:
    """One sweep over one node at 1 is Euler's method, explicit or implicit."""
    explicit = diagonal_method("sdc", 1, sweeps=1)
    implicit = diagonal_method("sdc", 1, sweeps=1, sweep="implicit")
    assert (explicit.A, explicit.b) == (((0,),), (1,))
    assert (implicit.A, implicit.b) == (((1,),), (1,))


def test_many_sweeps_come_to_collocation() -> None:
    """On ẏ = λy with small λ the sweeps converge to the collocation method: ten of them agree with
    Radau IIA in the powers of z up to 10 of R(z), where one does not.
    """
    radau = diagonal_method("radau-iia", 2)
    wanted = _powers(radau, 11)
    assert _powers(diagonal_method("sdc", 2, sweeps=10), 11) == wanted
    assert _powers(diagonal_method("sdc", 2, sweeps=9), 11) != wanted


def _powers(method: Method, count: int) -> list[object]:
    """The coefficients b A^k 𝟙 of R(z)."""
    powers = []
    vector = method.space.one
    for _ in range(count - 1):
        powers.append(sum((x * y for x, y in zip(method.b, vector, strict=True)), fmpq(0)))
        vector = tuple(
            sum((x * y for x, y in zip(row, vector, strict=True)), fmpq(0)) for row in method.A
        )
    return powers


def test_sequences_and_weights() -> None:
    """The sequences of the books; the weights extrapolate 1 + h + h² exactly."""
    assert sequence("harmonic", 4) == (1, 2, 3, 4)
    assert sequence("romberg", 4) == (1, 2, 4, 8)
    assert sequence("bulirsch", 6) == (1, 2, 3, 4, 6, 8)
    weights = extrapolation_weights((1, 2, 5), (1, 2))
    values = [1 + fmpq(1, n) + fmpq(1, n * n) for n in (1, 2, 5)]
    assert sum((w * x for w, x in zip(weights, values, strict=True)), fmpq(0)) == 1


def test_method_files_name_members() -> None:
    """Options stand beside the family, coefficients may use parameters, also free ones."""
    loaded = loads(
        "parameters: {g: (3 + sqrt(3))/6}\n"
        "methods:\n  - {family: sdirk2, gamma: g}\n"
        "  - {family: extrapolated-euler, order: 2}\n"
        "transfer: interpolation"
    )
    assert loaded.stages == (2, 2)
    assert loaded.A[1, 1][0][0] == loaded.c[1][0]
    beside = loads(
        "methods:\n  - {family: gauss, stages: 2}\n"
        "  - {family: sdc, points: 2, sweeps: 1, nodes: gauss}\n"
        "transfer: {blocks: {'1,2': [[0, 0, 0], [0, 0, 0]], '2,1': collocation}}"
    )
    assert beside.stages == (2, 3)
    family = loads_family("parameters: {g: free}\nmethods: {family: sdirk2, gamma: g}")
    assert family.parameters == ("g",)
    assert str(family.tableau.block(0, 0)) == "((g, 0), (-2*g + 1, g))"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{family: sdirk2}", "needs its gamma"),
        ("{family: sdirk2, gamma: 1/0}", "division by zero"),
        ("{family: sdirk2, gamma: i/4}", "'i' is not a parameter"),
        ("{family: hbvm, stages: 2, degree: 3}", "with 2 stages and degree 3 does not exist"),
        ("{family: hbvm, stages: 2}", "needs its degree"),
        ("{family: avf, stages: 2}", "no family 'avf'"),
        ("{family: ssp3, stages: 5}", "ssp3 with 5 stages does not exist"),
        ("{family: extrapolated-midpoint, order: 5}", "does not exist"),
        ("{family: extrapolated-euler, order: 30}", "has 436 stages"),
        ("{family: sdc, points: 9, sweeps: 2}", "no simple radicals"),
        ("{family: sdc, points: 2}", "needs its sweeps"),
        ("{family: sdc, points: 2, sweeps: 0}", "at least 1 is expected"),
        ("{family: sdc, points: 1, nodes: lobatto, sweeps: 1}", "no lobatto"),
        ("{family: gauss, stages: 2, gamma: 1}", "unknown key 'gamma'"),
        ("{family: gbs, order: 4}", "no family 'gbs'"),
    ],
)
def test_members_that_there_are_not(text: str, message: str) -> None:
    """What does not exist is told where it stands, as one fault."""
    with pytest.raises(MethodFileError) as caught:
        loads(f"methods: {text}")
    (fault,) = caught.value.faults
    assert message in fault.message
    assert fault.line == 1


@pytest.mark.parametrize(("stages", "degree"), [(2, 1), (3, 1), (4, 2)])
def test_average_vector_fields(stages: int, degree: int) -> None:
    """Up to the order 2s/degree the weights are those of exact integrals, here of polynomials in τ
    that are integrated one by one, and steps conserve energy to that order; of degree 1 to no other.
    """
    tableau = alone(diagonal_method("hbvm", stages, degree=degree))
    order = 2 * stages // degree

    def inside(tree: Tree) -> fmpq_poly:
        """What the branches of a vertex are at τ: the product of what they integrate to."""
        found = fmpq_poly([1])
        for branch in tree.branches:
            below, seen = inside(branch), fmpq_poly([0])
            for j in range(degree):
                part = legendre(j)
                whole = (part * below).integral()
                seen += (2 * j + 1) * whole(fmpq(1)) * part.integral()
            found *= seen
        return found

    def differing(n: int) -> int:
        pairs = ((elementary_weight(tableau, u), inside(u).integral()(fmpq(1))) for u in trees(n))
        return sum(x != y for x, y in pairs)

    assert [differing(n) for n in range(1, order + 1)] == [0] * order
    assert degree > 1 or differing(order + 1)
    found = backward_analysis(
        loads(f"methods: {{family: hbvm, stages: {stages}, degree: {degree}}}"), 5
    )
    assert found.energy is not None
    assert found.energy.order >= min(order, 5)
    assert degree > 1 or found.energy.is_lower_bound == (order >= 5)


def test_energies_of_polynomials() -> None:
    """Two stages of degree 1 conserve H = p²/2 + q⁴/4 in every step, one stage does not; as many
    stages as the degree are those of Gauss.
    """
    errors = []
    for stages in (1, 2):
        tableau = alone(diagonal_method("hbvm", stages, degree=1))
        stepper = Stepper(bind(tableau, QUARTIC).at(30), fmpq(1, 4))
        stepper.advance(8)
        with ctx.workprec(120):
            errors.append(abs(_quartic(stepper.y) - fmpq(3, 8)))
    assert errors[0] > 1e-5
    assert errors[1] < 1e-27
    assert diagonal_method("hbvm", 3, degree=3).A == diagonal_method("gauss", 3).A


QUARTIC = loads_problem(
    "variables: [x]\nhamiltonian: px^2/2 + x^4/4\ninitial: {x: 1, px: 1/2}\nt_end: 2"
)


def _quartic(y: Sequence[Any]) -> Any:
    q, p = y
    return p**2 / 2 + q**4 / 4


def test_python_names_members() -> None:
    """The same from Python, with faults by name."""
    assert diagonal_method("extrapolated-euler", order=3).stages == 4
    for options in ({"gamma": "1//2"}, {"gamma": "1", "delta": 2}, {}):
        with pytest.raises(UnknownFamily):
            diagonal_method("sdirk2", **options)
    with pytest.raises(UnknownFamily, match="too small"):
        diagonal_method("sdc", 2, sweeps=0)
    with pytest.raises(UnknownFamily, match="not known"):
        diagonal_method("sdc", 2, sweeps=1, nodes="gaus")
