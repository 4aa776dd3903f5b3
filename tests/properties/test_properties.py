"""Shape, symmetry, last stages, reduction: the known methods, and properties that must hold."""

from __future__ import annotations

from fractions import Fraction
from itertools import permutations

import pytest
from flint import fmpq, fmpq_mat, fmpq_poly
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli import find_property
from garkcli.check.analysis import analyse
from garkcli.exact.field import ONE
from garkcli.exact.matrix import Matrix, identity, is_singular
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import roots_below
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.methodfile.load import load, loads
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import simplifying
from garkcli.properties.algebra_shape import shape_of_families
from garkcli.properties.last_stage import first_same_as_last, is_stiffly_accurate
from garkcli.properties.pattern import Shape, shape_of, stage_graph
from garkcli.properties.reduction import is_plainly_irreducible, reduced
from garkcli.properties.subject import Subject
from garkcli.properties.symmetry import symmetry
from garkcli.stability.algebraic import negative_pivot
from garkcli.stability.linear import stability_function
from garkcli.tableau.forms import gark
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau, butcher
from tests.oracles.draws import fractions
from tests.whole import at_most

Rows = list[list[Fraction]]
ENTRY = fractions(-2, 2, 4)


@st.composite
def methods(draw: st.DrawFn) -> tuple[Rows, list[Fraction]]:
    """A random method of one colour as (A, b)."""
    s = draw(st.integers(1, 3))
    row = st.lists(ENTRY, min_size=s, max_size=s)
    return [draw(row) for _ in range(s)], draw(row)


def tableau_of(A: Rows, b: list[Fraction]) -> Tableau:
    """The method with one colour."""
    text = [[str(x) for x in row] for row in A]
    return loads(f"methods: [{{A: {text}, b: {[str(x) for x in b]}}}]").tableau


def family(name: str, stages: int | None) -> Tableau:
    """A method of one colour."""
    return gark([diagonal_method(name, stages)], {})


def followed_by_adjoint(A: Rows, b: list[Fraction]) -> tuple[Rows, list[Fraction]]:
    """Half a step of the method, then half a step of its adjoint."""
    s = len(b)
    half = Fraction(1, 2)
    adjoint = [[b[s - 1 - j] - A[s - 1 - i][s - 1 - j] for j in range(s)] for i in range(s)]
    weights = b[::-1]
    first = [[half * x for x in row] + [Fraction(0)] * s for row in A]
    second = [[half * x for x in b] + [half * x for x in row] for row in adjoint]
    return first + second, [half * x for x in b] + [half * x for x in weights]


def is_symmetric(tableau: Tableau) -> bool | None:
    """Whether a method is its own adjoint."""
    return symmetry(tableau).holds


def is_first_same_as_last(tableau: Tableau) -> bool:
    """Whether a method is FSAL."""
    return first_same_as_last(tableau).holds


def shape(tableau: Tableau, colour: int | None = None) -> Shape:
    """The shape of the whole tableau, or of the diagonal method of one colour."""
    return shape_of(stage_graph(tableau, None if colour is None else [colour]))


@given(methods())
def test_a_step_and_its_adjoint_are_symmetric(method: tuple[Rows, list[Fraction]]) -> None:
    """Φ*_{h/2} ∘ Φ_{h/2} is symmetric, and so R(z) R(−z) = 1, found without stages."""
    tableau = tableau_of(*followed_by_adjoint(*method))
    assert is_symmetric(tableau)
    R = stability_function(tableau)
    minus = Polynomial([0, -1])
    P, Q = R.numerator, R.denominator
    assert P * P.substituted(minus) == Q * Q.substituted(minus)


@given(methods())
def test_symmetry_is_seen_by_the_stability_function(method: tuple[Rows, list[Fraction]]) -> None:
    """What is symmetric has R(z) R(−z) = 1, and an even order."""
    tableau = tableau_of(*method)
    if is_symmetric(tableau):
        R = stability_function(tableau)
        minus = Polynomial([0, -1])
        assert R.numerator * R.numerator.substituted(minus) == (
            R.denominator * R.denominator.substituted(minus)
        )
        found = find_order(tableau)
        assert found.order % 2 == 0 or found.is_lower_bound


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("gauss", True),
        ("lobatto-iiia", True),
        ("lobatto-iiib", True),
        ("lobatto-iiic", False),
        ("lobatto-iiid", True),
        ("radau-iia", False),
    ],
)
@pytest.mark.parametrize("stages", [2, 3, 4, 7])
def test_families(name: str, stages: int, expected: bool) -> None:
    """Hairer, Lubich, Wanner, section V.2; decided in stage algebras, with seven stages too."""
    assert is_symmetric(family(name, stages)) == expected


def test_equal_nodes_are_renumbered_too() -> None:
    """Stages in another order, and twins of one node, do not hide the symmetry."""
    text = "methods: [{A: [[1/2, 0], [1/2, 1/2]], b: [1, 1]}]"  # implicit midpoint of weights 1, 1
    assert is_symmetric(loads(text).tableau) is (stability_symmetric(loads(text).tableau))
    verlet = load("methods/stoermer-verlet.gark.yaml").tableau
    assert is_symmetric(verlet)


def stability_symmetric(tableau: Tableau) -> bool:
    """Whether R(z) R(−z) = 1."""
    R = stability_function(tableau)
    minus = Polynomial([0, -1])
    return bool(
        R.numerator * R.numerator.substituted(minus)
        == R.denominator * R.denominator.substituted(minus)
    )


@given(methods(), st.data())
def test_a_stage_written_twice_is_found(
    method: tuple[Rows, list[Fraction]], data: st.DataObject
) -> None:
    """With one stage split in two, and one more that nobody looks at, the method reduces to no more stages."""
    A, b = method
    s = len(b)
    i = data.draw(st.integers(0, s - 1))
    share = data.draw(ENTRY)
    wide = [[*row, row[i] - share] for row in A]
    for row in wide:
        row[i] = share
    wide.append(list(wide[i]))
    weights = [*b, b[i] - share]
    weights[i] = share
    idle = [[*row, Fraction(0)] for row in wide] + [[Fraction(1)] * (s + 2)]
    double = tableau_of(idle, [*weights, Fraction(0)])
    smaller = reduced(double)
    assert smaller is not None
    assert smaller.spaces[0].stages <= s
    assert reduced(smaller) == smaller
    assert find_order(smaller, 8).order == find_order(tableau_of(A, b), 8).order
    assert stability_function(smaller) == stability_function(tableau_of(A, b))


def test_a_colour_that_no_step_depends_on_keeps_one_stage_of_zeros() -> None:
    """Rows, node and weight, whatever its stages were."""
    A = "[[[[0, 0], [1, 0]], [[0, 0], [0, 0]]], [[[1, 0], [2, 0]], [[1/3, 0], [1/2, 1/4]]]]"
    smaller = reduced(loads(f"tableau: {{A: {A}, b: [[1/2, 1/2], [0, 0]]}}").tableau)
    assert smaller is not None
    zero = fmpq(0)
    assert smaller.spaces == (PointSpace((zero, fmpq(1))), PointSpace((zero,)))
    idle = smaller.colours[1]
    assert (idle.b, idle.c) == ((zero,), (zero,))
    assert (smaller.block(1, 0), smaller.block(1, 1)) == (((zero, zero),), ((zero,),))


@pytest.mark.parametrize(
    ("A", "b"),
    [
        ([[0, 0], ["1/2", 0]], [0, 1]),
        ([[0, 0, 0], ["1/3", 0, 0], [0, "2/3", 0]], ["1/4", 0, "3/4"]),
        ([[0, 0, 0], ["1/2", 0, 0], [0, "1/3", 0]], [0, 0, 1]),
        ([["1/2", 0, 0], ["1/3", "1/4", 0], [0, "1/5", "1/6"]], [0, 0, 1]),
    ],
)
def test_stages_matter_through_others(A: list[list[object]], b: list[object]) -> None:
    """A stage without a weight stays if a stage with one sees it, directly or not; a stage that
    sees these and is not seen goes.
    """

    def method(rows: list[list[object]], weights: list[object]) -> Tableau:
        return loads(f"methods: [{{A: {rows}, b: {weights}}}]".replace("'", "")).tableau

    alone = method(A, b)
    assert reduced(alone) is alone
    watching = method([[*row, 0] for row in A] + [[1] * (len(b) + 1)], [*b, 0])
    fewer = reduced(watching)
    assert fewer is not None
    assert fewer.block(0, 0) == alone.block(0, 0)


@pytest.mark.parametrize("name", ["rk4", "kutta", "heun", "explicit-euler", "explicit-midpoint"])
def test_explicit_methods(name: str) -> None:
    """No stage is solved for; the matrix is nilpotent."""
    found = shape(family(name, None))
    assert (found.name, found.implicit_stages) == ("explicit", 0)


@given(methods())
def test_explicit_means_nilpotent(method: tuple[Rows, list[Fraction]]) -> None:
    """An explicit method has a polynomial as its stability function."""
    tableau = tableau_of(*method)
    found = shape(tableau)
    if found.kind == "explicit":
        assert stability_function(tableau).denominator == Polynomial([1])
    strictly_lower = all(x == 0 for i, row in enumerate(method[0]) for x in row[i:])
    if strictly_lower:
        assert found.kind == "explicit"


def test_diagonally_implicit_methods() -> None:
    """SDIRK with its γ, ESDIRK, and one with two different entries."""
    two = loads(
        "parameters: {g: 1 - sqrt(2)/2}\nmethods: [{A: [[g, 0], [1 - g, g]], b: [1 - g, g]}]"
    )
    found = shape(two.tableau)
    assert (found.name, found.implicit_stages) == ("SDIRK", 2)
    assert str(found.gamma) == "1 - sqrt(2)/2"
    trapezoidal = shape(loads("methods: [{A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}]").tableau)
    assert (trapezoidal.name, trapezoidal.gamma) == ("ESDIRK", fmpq(1, 2))
    other = shape(loads("methods: [{A: [[1/3, 0], [1/2, 1/4]], b: [1/2, 1/2]}]").tableau)
    assert (other.name, other.gamma) == ("diagonally implicit", None)
    # a second explicit stage, and a first stage that sees the second one: no ESDIRK methods
    for rows in ("[0, 0, 0], [1, 0, 0], [1/4, 1/4, 1/2]", "[0, 1, 0], [0, 1/2, 0], [0, 1/4, 1/2]"):
        single = shape(loads(f"methods: [{{A: [{rows}], b: [0, 0, 1]}}]").tableau)
        assert (single.name, single.gamma) == ("diagonally implicit", fmpq(1, 2))


def test_a_colour_that_does_not_see_itself_has_no_shape() -> None:
    """The next one has."""
    text = "tableau: {A: [[null, [[1/2]]], [[[1]], [[1/3]]]], b: [[1], [1]]}"
    tableau = loads(text).tableau
    subject = Subject(tableau, 1, simplifying(tableau, 2), 2, fmpq(0))
    first, second = subject.shapes
    assert first is None
    assert second is not None
    assert (second.name, second.gamma) == ("SDIRK", fmpq(1, 3))


def test_an_imex_pair_by_colour_and_as_a_whole() -> None:
    """ARS(2,2,2): explicit, ESDIRK, together diagonally implicit with two implicit stages."""
    tableau = load("methods/ark-ars222.gark.yaml").tableau
    assert [shape(tableau, l).name for l in (0, 1)] == ["explicit", "ESDIRK"]
    whole = shape(tableau)
    assert (whole.kind, whole.implicit_stages) == ("diagonally implicit", 2)
    assert str(whole.gamma) == "1 - sqrt(2)/2"


def test_stages_that_are_solved_together() -> None:
    """Two implicit stages, then one explicit one."""
    text = "methods: [{A: [[1/4, 1/4, 0], [1/4, 1/2, 0], [1/3, 1/3, 0]], b: [0, 1/2, 1/2]}]"
    found = shape(loads(text).tableau)
    assert found.kind == "fully implicit"
    assert found.systems == (((0, 0), (0, 1)),)
    assert found.implicit_stages == 2


@pytest.mark.parametrize(
    ("name", "stages", "stiff", "fsal"),
    [
        ("radau-iia", 2, True, False),
        ("lobatto-iiia", 3, True, True),
        ("lobatto-iiic", 2, True, False),
        ("gauss", 2, False, False),
        ("rk4", None, False, False),
    ],
)
def test_last_stages(name: str, stages: int | None, stiff: bool, fsal: bool) -> None:
    """Stiffly accurate, and first same as last."""
    tableau = family(name, stages)
    assert is_stiffly_accurate(tableau) is stiff
    assert is_first_same_as_last(tableau) is fsal


@given(methods())
def test_a_stiffly_accurate_regular_method_is_damped(method: tuple[Rows, list[Fraction]]) -> None:
    """With the weights as its last row and a regular matrix, R(∞) = 0."""
    A, _ = method
    tableau = tableau_of(A, A[-1])
    assert is_stiffly_accurate(tableau)
    R = stability_function(tableau)
    if R.denominator.degree == len(A):
        assert R.at_infinity() == 0


@pytest.mark.parametrize(
    ("name", "implicit", "stiff", "fsal"),
    [
        ("gauss", 7, False, False),
        ("radau-ia", 7, False, False),
        ("radau-iia", 7, True, False),
        ("lobatto-iiia", 6, True, True),
        ("lobatto-iiib", 6, False, False),
        ("lobatto-iiic", 7, True, False),
    ],
)
def test_what_has_no_simple_nodes_is_decided_too(
    name: str, implicit: int, stiff: bool, fsal: bool
) -> None:
    """Families of seven stages: a row or a column of zeros at a rational node is proved."""
    tableau = family(name, 7)
    assert is_stiffly_accurate(tableau) is stiff
    assert is_first_same_as_last(tableau) is fsal
    assert is_plainly_irreducible(tableau)
    found = shape(tableau)
    assert (found.kind, found.implicit_stages) == ("fully implicit", implicit)


@pytest.mark.parametrize("name", ["gauss", "radau-iia", "lobatto-iiia", "lobatto-iiib"])
def test_stage_algebras_agree_with_points(name: str) -> None:
    """Without the nodes, and with them, the same is found."""
    algebra = family(name, 3)
    points = in_points(algebra)
    assert points is not None
    for decide in (is_stiffly_accurate, is_first_same_as_last, is_symmetric):
        assert decide(algebra) == decide(points)
    assert shape(algebra).implicit_stages == shape(points).implicit_stages
    assert is_plainly_irreducible(algebra)
    assert is_plainly_irreducible(points)


@given(methods())
def test_what_is_plainly_irreducible_is_not_reduced(method: tuple[Rows, list[Fraction]]) -> None:
    """The short way and the long one do not contradict each other."""
    tableau = tableau_of(*method)
    if is_plainly_irreducible(tableau):
        assert reduced(tableau) is tableau


@st.composite
def renumbered_into_their_adjoint(draw: st.DrawFn) -> tuple[Rows, list[Fraction]]:
    """A method of few different entries, so that many of its stages look alike; half of the time
    some involution makes it its own adjoint, and once in a while one entry is off.
    """
    s = draw(st.integers(2, 4))
    few = st.sampled_from([Fraction(0), Fraction(1), Fraction(1, 2)])
    order = draw(st.permutations(range(s)))
    images = list(range(s))
    for i, j in zip(order[::2], order[1::2], strict=False):
        if draw(st.booleans()):
            images[i], images[j] = j, i
    b = [Fraction(0)] * s
    for i in range(s):
        b[i] = b[images[i]] if images[i] < i else draw(few)
    A = [[draw(few) for _ in range(s)] for _ in range(s)]
    if draw(st.booleans()):
        for i in range(s):
            for j in range(s):
                A[images[i]][images[j]] = b[j] - A[i][j]
                if (images[i], images[j]) == (i, j):
                    A[i][j] = b[j] / 2
        if draw(st.integers(0, 3)) == 0:
            A[0][s - 1] += 1
    return A, b


def is_symmetric_by_force(A: Rows, b: list[Fraction]) -> bool:
    """Whether one of all renumberings turns A into 𝟙 bᵀ − A and keeps b."""
    stages = range(len(b))
    return any(
        all(A[p[i]][p[j]] == b[j] - A[i][j] and b[p[j]] == b[j] for i in stages for j in stages)
        for p in permutations(stages)
    )


@given(renumbered_into_their_adjoint())
@settings(max_examples=at_most(25, 400))
def test_all_renumberings_say_the_same(method: tuple[Rows, list[Fraction]]) -> None:
    """By brute force, also within a tolerance that no entry makes use of: an involution is found
    exactly where one of all permutations does it, unless equal stages are in its way.
    """
    A, b = method
    tableau = tableau_of(A, b)
    by_force = is_symmetric_by_force(A, b)
    found = symmetry(tableau)
    assert symmetry(tableau, fmpq(1, 10**9)).holds == found.holds
    if found.holds:
        (images,) = found.images
        assert images is not None
        assert all(images[images[i]] == i for i in range(len(b)))
        assert by_force
    if by_force:
        assert symmetric_verdict(tableau) is True
    smaller = reduced(tableau)
    assert smaller is not None
    if smaller is tableau:
        assert found.holds == by_force


@pytest.mark.parametrize(
    ("diagonal", "b", "holds"),
    [
        ("0.251", "0.4995", True),  # 2·0.251 − 0.4995 = 0.0025
        ("0.2512", "0.4995", True),
        ("0.2513", "0.4995", False),  # 0.0031
    ],
)
def test_three_coefficients_have_three_times_the_tolerance(
    diagonal: str, b: str, holds: bool
) -> None:
    """Stages 1 and 2 are images of each other where a₁₁ + a₂₂ − b₁ is at most 0.003."""
    text = f"{{A: [[{diagonal}, -0.039], [0.539, {diagonal}]], b: [{b}, {b}]}}"
    assert symmetry(loads(text).tableau, fmpq(1, 1000)).holds is holds


@pytest.mark.parametrize(("far", "holds"), [("1/2", True), ("1/3", False)])
def test_algebras_beside_stages(far: str, holds: bool) -> None:
    """Gauss's nodes as an algebra and the trapezoidal rule as two stages, which change places."""
    second = f"{{A: [[0, 0], [{far}, {far}]], b: [{far}, 1 - {far}]}}"
    text = f"{{methods: [{{family: gauss, stages: 2}}, {second}], transfer: interpolation}}"
    tableau = loads(text).tableau
    assert [type(x).__name__ for x in tableau.spaces] == ["PolynomialSpace", "PointSpace"]
    assert symmetry(tableau).holds is holds
    if holds:
        assert symmetry(tableau).images == (None, (1, 0))


def test_many_equal_stages_are_compared_once_each(monkeypatch: pytest.MonkeyPatch) -> None:
    """Small steps of a multirate method have pairs of stages that look alike: 2¹⁰ renumberings.
    The search tries no image in vain, and multiplies no matrices.
    """
    method = loads("multirate: {slow: kutta, fast: kutta, steps: 20}")
    monkeypatch.setattr("garkcli.properties.symmetry.MOST_TRIALS", 0)
    monkeypatch.setattr("garkcli.properties.symmetry.multiply", None)
    assert symmetric_verdict(method.tableau) is False
    both = loads("compose: {of: {multirate: {slow: kutta, fast: kutta, steps: 6}}, steps: [1/2]}")
    assert symmetric_verdict(both.tableau) is False
    steps = loads(f"compose: {{of: gauss-2, steps: {['1/40'] * 40}}}".replace("'", ""))
    assert symmetric_verdict(steps.tableau) is True


def test_a_search_that_ends_is_not_decided(monkeypatch: pytest.MonkeyPatch) -> None:
    """Six stages alike in their sums within a tolerance, and no involution does it: that takes an
    image in vain at least, and nothing is said where these are too many.
    """
    row = [Fraction(k * k % 7 + k % 3) for k in range(6)]
    A = [row[-i:] + row[:-i] for i in range(6)]
    tableau = tableau_of(A, [2 * sum(row) / 6] * 6)
    assert symmetry(tableau, fmpq(1, 10**9)).holds is False
    monkeypatch.setattr("garkcli.properties.symmetry.MOST_TRIALS", 0)
    assert symmetry(tableau, fmpq(1, 10**9)).holds is None


def test_the_renumbering_of_a_symmetric_method() -> None:
    """Lobatto IIIA 3 with its stages in another order: the reflection is shown in that order."""
    text = "A: [[1/3, -1/24, 5/24], [2/3, 1/6, 1/6], [0, 0, 0]]\nb: [2/3, 1/6, 1/6]"
    found = symmetry(loads(text).tableau)
    assert found.images[0] == (0, 2, 1)
    assert symmetry(family("gauss", 3)).images[0] is None
    assert symmetry(family("rk4", None)).images == ()


def test_symmetry_within_a_tolerance() -> None:
    """Gauss 2 rounded: its own adjoint as far as rounding by t explains, not by a tenth of that."""
    text = """
A: [[0.25, -0.038675], [0.538675, 0.2500004]]
b: [1/2, 1/2]
"""
    tableau = loads(text).tableau
    assert symmetry(tableau).holds is False
    assert symmetry(tableau, fmpq(1, 10**6)).holds is True
    assert symmetry(tableau, fmpq(1, 10**8)).holds is False


def test_rounding_adds_up_over_what_a_stage_sees() -> None:
    """A midpoint stage that sees eight others: each entry is rounded up by t, each weight down."""
    t, w = fmpq(1, 10**6), fmpq(1, 8)

    def texts(x: fmpq, stages: int = 8) -> list[str]:
        return [str(x)] * stages

    A = [[[["1/2"]], [texts(w / 2 + t)]], [[["1/2"]] * 8, [texts(w / 2)] * 8]]
    tableau = loads(f"tableau: {{A: {A}, b: [['1'], {texts(w - t)}]}}").tableau
    assert symmetry(tableau, t).holds is True
    assert symmetry(tableau, t / 2).holds is False


@pytest.mark.parametrize("transfer", ["collocation", "interpolation"])
def test_symmetry_within_a_tolerance_beside_a_family(transfer: str) -> None:
    """Rows that see the stages of a family are compared as they are, not by sums of coordinates."""
    methods = "[{family: gauss, stages: 2}, {A: [[1/2]], b: [1]}]"
    tableau = loads(f"{{methods: {methods}, transfer: {transfer}}}").tableau
    assert symmetry(tableau, fmpq(1, 10**9)) == symmetry(tableau)
    assert symmetry(tableau).holds is True


@pytest.mark.parametrize(
    ("edge", "block"), [((1, 0), ((fmpq(1, 3), fmpq(1, 8)),)), ((0, 1), ((fmpq(0),), (fmpq(2),)))]
)
def test_a_stage_beside_a_family_that_has_no_image(edge: tuple[int, int], block: Matrix) -> None:
    """The midpoint rule and Gauss 2, each symmetric, are no symmetric method where one block between
    them is another: by the stage algebra as with the nodes.
    """
    methods = "[{family: gauss, stages: 2}, {A: [[1/2]], b: [1]}]"
    tableau = loads(f"{{methods: {methods}, transfer: collocation}}").tableau
    changed = replace(tableau, blocks={**tableau.blocks, edge: block})
    assert symmetry(tableau).holds is symmetry(in_points(tableau)).holds is True
    assert symmetry(changed).holds is symmetry(in_points(changed)).holds is False


# -- families without their nodes

FAMILIES = ("gauss", "radau-ia", "radau-iia", "lobatto-iiia", "lobatto-iiib", "lobatto-iiic")


@pytest.mark.parametrize("stages", [2, 3, 5])
@pytest.mark.parametrize("name", FAMILIES)
def test_systems_of_families_are_those_of_their_entries(name: str, stages: int) -> None:
    """Common divisors and a stage modulo a prime find the same systems as the entries, looked at
    one by one in enclosures.
    """
    tableau = family(name, stages)
    found = shape_of_families(tableau, [0])
    wanted = shape(tableau)
    if found is None:
        assert wanted.kind != "fully implicit"
    else:
        assert found == wanted


def test_systems_of_coupled_families() -> None:
    """Lobatto IIIA 4 and Gauss 3 by collocation, together and apart."""
    text = "methods: [{family: lobatto-iiia, stages: 4}, {family: gauss, stages: 3}]"
    tableau = loads(f"{text}\ntransfer: collocation").tableau
    assert shape_of_families(tableau, [0, 1]) == shape(tableau)
    assert shape_of_families(tableau, [0]) == shape(tableau, 0)
    assert shape_of_families(tableau, [1]) == shape(tableau, 1)


def test_a_zero_between_irrational_nodes_is_no_proof() -> None:
    """Gauss 4 with its block replaced by multiplication by 1 + x: every column has zeros, and
    nothing is proved.
    """
    tableau = family("gauss", 4)
    space = tableau.spaces[0]
    columns = [space.product(space.of_polynomial((ONE, ONE)), e) for e in identity(4)]
    block = tuple(zip(*columns, strict=True))
    diagonal = replace(tableau, blocks={(0, 0): block})
    assert shape_of_families(diagonal, [0]) is None


@pytest.mark.parametrize("is_lower", [True, False])
def test_one_way_between_rational_nodes_is_no_system(is_lower: bool) -> None:
    """Lobatto nodes 0, 1/2, 1, and each stage sees those before it, or behind: one sees all and one
    is seen by all, and none are solved together.
    """
    tableau = family("lobatto-iiia", 3)
    V = fmpq_mat([[fmpq(c) ** j for j in range(3)] for c in (fmpq(0), fmpq(1, 2), fmpq(1))])
    entries = [
        [fmpq(1 + 2 * i + j) * ((i >= j) if is_lower else (i <= j)) for j in range(3)]
        for i in range(3)
    ]
    rows = (V.inv() * fmpq_mat(entries) * V).tolist()
    one_way = replace(tableau, blocks={(0, 0): tuple(map(tuple, rows))})
    points = in_points(one_way)
    assert points is not None
    assert [list(row) for row in points.block(0, 0) or ()] == entries
    assert shape_of_families(one_way, [0]) is None
    assert shape(one_way).kind == "diagonally implicit"


@given(st.lists(ENTRY, min_size=1, max_size=5, unique=True), ENTRY)
def test_counting_real_nodes(nodes: list[Fraction], x: Fraction) -> None:
    """Descartes' rule counts the roots below a number, where all are real."""
    M = fmpq_poly([1])
    for c in nodes:
        M *= fmpq_poly([-fmpq(c.numerator, c.denominator), 1])
    wanted = sum(1 for c in nodes if c < x)
    assert roots_below(M, fmpq(x.numerator, x.denominator)) == wanted


@pytest.mark.parametrize("stages", [2, 3, 6])
@pytest.mark.parametrize("name", FAMILIES)
def test_the_weights_of_families_are_positive(name: str, stages: int) -> None:
    """The form f ↦ b(f²) is positive definite: no pivot is negative and none is 0."""
    tableau = family(name, stages)
    form = tableau.spaces[0].gram(tableau.colours[0].b)
    assert negative_pivot(form) is None
    assert not is_singular(form)


def test_semidefinite_forms() -> None:
    """A zero on the diagonal beside another entry is indefinite; a zero row is not."""
    zero, one = fmpq(0), fmpq(1)
    assert negative_pivot(((zero, one), (one, one))) == 0
    assert negative_pivot(((zero, zero), (zero, one))) is None
    assert negative_pivot(((one, 2 * one), (2 * one, one))) == -3


@given(methods(), st.lists(ENTRY, min_size=4, max_size=4))
@settings(max_examples=at_most(10, 200))
def test_a_stage_without_influence_does_not_hide_the_symmetry(
    method: tuple[Rows, list[Fraction]], row: list[Fraction]
) -> None:
    """A further stage that nothing looks at, whatever its row, leaves the map what it is."""
    A, b = followed_by_adjoint(*method)
    width = len(b)
    padded = [[*entries, Fraction(0)] for entries in A]
    further = (row * (width + 1))[: width + 1]
    longer = tableau_of([*padded, further], [*b, Fraction(0)])
    assert symmetric_verdict(longer) is True


@pytest.mark.parametrize(
    ("A", "b"), [([[1]], [0]), ([[1, 0], [0, 3]], [0, 0]), ([[1, 2], [0, 1]], [0, 0])]
)
def test_a_step_that_does_nothing_is_symmetric(A: list[list[int]], b: list[int]) -> None:
    """Without weights the step is the identity, whatever the rows."""
    rows = [[Fraction(x) for x in row] for row in A]
    assert symmetric_verdict(tableau_of(rows, [Fraction(x) for x in b])) is True


def symmetric_verdict(tableau: Tableau) -> object:
    """What ``gark check`` says of a method."""
    return find_property(tableau, "symmetric").value


@pytest.mark.parametrize(
    ("A", "b", "expected"),
    [
        ("[[1/2, 0], [1, 0]]", "[1, 0]", True),
        ("[[1/2, 0], [1/2, 0]]", "[1/4, 3/4]", True),
        ("[[1/3, 0], [1, 0]]", "[1, 0]", False),
        ("[[0, 0], [1, 0]]", "[1/2, 1/2]", False),
    ],
)
def test_reducible_methods_are_symmetric_as_what_they_do(A: str, b: str, expected: bool) -> None:
    """The implicit midpoint rule with a stage too many, in two ways; others are not symmetric."""
    tableau = loads(f"methods: [{{A: {A}, b: {b}}}]").tableau
    assert symmetric_verdict(tableau) is expected
    smaller = reduced(tableau)
    assert smaller is not None
    assert stability_symmetric(smaller) is expected


@pytest.mark.parametrize("between", ["[[1]]", "[[0]]"])
def test_stages_that_no_step_depends_on_leave_the_symmetry(between: str) -> None:
    """The midpoint rule beside two methods without weights, which may see each other."""
    tableau = loads(
        f"""
        methods: [{{A: [[1/2]], b: [1]}}, {{A: [[0]], b: [0]}}, {{A: [[0]], b: [0]}}]
        transfer:
          default: collocation
          blocks:
            {{"1,2": [[0]], "1,3": [[0]], "2,1": [[1/2]], "3,1": [[1/2]],
             "2,3": {between}, "3,2": {between}}}
        """
    ).tableau
    assert symmetric_verdict(tableau) is True


@pytest.mark.parametrize(
    ("A", "pole"), [("[[-1, 0], [0, -1 - 1/10**40]]", "-1"), ("[[-1, 1], [-1, -1]]", "-0.5 ± 0.5i")]
)
def test_the_pole_that_is_told(A: str, pole: str) -> None:
    """Poles that 128 bits do not tell apart are found, and one of a pair is shown."""
    tableau = loads(f"{{A: {A}, b: [1/2, 1/2]}}").tableau
    found = find_property(tableau, "a-stable")
    assert found.value is False
    assert f"a pole at z = {pole}" in found.why


def test_stages_beside_an_algebra_have_exact_zeros() -> None:
    """Nodes of Gauss without radicals are enclosed; the zeros of the other method are exact."""
    tableau = loads(
        "methods: [{family: gauss, stages: 7}, {A: [[0, 0], [1/2, 0]], b: [0, 1]}]\n"
        "transfer: interpolation"
    ).tableau
    subject = Subject(tableau, 1, simplifying(tableau, 2), 2, fmpq(0))
    _, midpoint = subject.shapes
    assert midpoint is not None
    assert (midpoint.kind, midpoint.implicit_stages) == ("explicit", 0)


@pytest.mark.parametrize(
    ("off", "is_one", "small", "kind"),
    [
        ("1.9", True, "0", "diagonally implicit"),
        ("-1.9", True, "1.1", "fully implicit"),
        ("2.1", False, "0", "diagonally implicit"),
        ("-2.1", False, "0", "diagonally implicit"),
        ("0", True, "0.9", None),
    ],
)
def test_shapes_within_a_tolerance(off: str, is_one: bool, small: str, kind: str | None) -> None:
    """Two diagonal entries are one γ if the rounding of both explains their difference; an entry
    above the diagonal counts if it is larger than the rounding, and leaves the kind open if not.
    """
    t = fmpq(1, 10**6)
    gamma = fmpq(1, 4)
    off_by, above = (fmpq(round(float(x) * 10), 10) * t for x in (off, small))
    rows = ((gamma, above), (fmpq(1, 2), gamma + off_by))
    found = shape_of(stage_graph(gark([butcher(rows, (fmpq(1, 2),) * 2)], {}), None, t), t)
    assert found.kind == kind
    if kind == "diagonally implicit":
        assert found.gamma == (gamma if is_one else None)
        assert found.singly == ("SDIRK" if is_one else "")
    if not above:
        assert found.implicit_stages == 2


def test_stages_of_different_fields_are_not_singly() -> None:
    """Störmer and Verlet's method for general problems solves with I − ½hJ_p in its first stage and
    with I − ½hJ_q in its second: one γ, and not one matrix. The same field in both is SDIRK.
    """
    q = "{A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}"
    p = "{A: [[1/2, 0], [1/2, 0]], b: [1/2, 1/2]}"
    subject = analyse(loads(f"prk: {{q: {q}, p: {p}}}\nstructure: general\n").tableau).subject
    assert subject.shape.name == "diagonally implicit"
    found = subject.verdict("sdirk")
    assert found.value is False
    assert "different vector fields" in str(found.why)
    both = loads(
        "ark:\n  A: [[[1/2, 0], [0, 1/2]], [[0, 0], [1, 0]]]\n  b: [[1/2, 1/2], [1/2, 1/2]]\n"
    )
    assert analyse(both.tableau).subject.shape.name == "SDIRK"
