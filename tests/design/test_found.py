"""The gallery of finds: what its files claim beyond what ``gark check`` proves of them."""

from __future__ import annotations

from pathlib import Path

import pytest
from flint import Ordering, ctx, fmpq, fmpq_mpoly_ctx

from garkcli import Tree, find_parameters, load, load_family, loads, loads_family, minimise, trees
from garkcli.design.ideal import Ideal
from garkcli.exact.display import to_ball
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import root_text
from garkcli.methodfile.family import FamilyFile
from garkcli.order.certificate import find_order
from garkcli.order.constants import error_constants
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.stability.oscillator import oscillator_stability
from garkcli.tableau.forms import pair
from garkcli.tableau.pointwise import numeric_entries
from garkcli.tableau.tableau import Tableau
from tests.catalogue.catalogue import entries, tableau
from tests.cli.harness import gark
from tests.whole import in_whole

FOUND = Path(__file__).resolve().parents[2] / "methods" / "found"
ASKS = FOUND / "asks"


def tableau_of(name: str) -> Tableau:
    """The tableau of a find."""
    return load(FOUND / f"{name}.gark.yaml").tableau


CHAIN = "parameters: {k: free}\nA: [[], [6*k], [0, 1/3], [0, 0, 1/2]]\nb: [0, 0, 0, 1]\n"


def times_powers(tableau: Tableau, power: int) -> float:
    """bᵀ A^power 𝟙 of the first part, in floats."""
    matrix = [[float(to_ball(x, 80)) for x in row] for row in tableau.blocks[0, 0]]
    v = [1.0] * len(matrix)
    for _ in range(power):
        v = [sum(a * x for a, x in zip(row, v, strict=True)) for row in matrix]
    weights = tableau.colours[0].b
    return sum(float(to_ball(b, 80)) * x for b, x in zip(weights, v, strict=True))


def gauss_lobatto(stages: int, transfer: str) -> Tableau:
    """Gauss s and Lobatto IIIA s + 1."""
    return loads(
        f"methods: [{{family: gauss, stages: {stages}}},"
        f" {{family: lobatto-iiia, stages: {stages + 1}}}]\n"
        f"transfer: {transfer}"
    ).tableau


@pytest.mark.parametrize(
    "name",
    [
        "p-stable-gauss2-lobatto3",
        "p-stable-gauss3-lobatto4",
        "p-stable-least-error-gauss2-lobatto3",
        "p-stable-least-error-gauss2-lobatto4",
    ],
)
def test_the_pairs_are_p_stable(name: str) -> None:
    """The claim of the file is on the method; here it is decided for its symplectic pair."""
    tableau = pair(tableau_of(name))
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    assert oscillator_stability(tableau, problem).is_p_stable


def test_p_stable_with_a_negative_weight() -> None:
    """Where Theorem E of docs/pair-order.md has w = −1/4: tr R = 2 − x/(1 + x/2) = 4/(2 + x)."""
    second = "{A: [[0, 0, 0], [1/4, 1/2, -1/4], [0, 1, 0]], b: [-1/2, 2, -1/2]}"
    transfer = '{blocks: {"2,1": [[0], [1/2], [1]], "1,2": [[-1/4, 1, -1/4]]}}'
    tableau = pair(
        loads(f"methods: [{{A: [[1/2]], b: [1]}}, {second}]\ntransfer: {transfer}").tableau
    )
    assert find_order(tableau).order == 2
    found = oscillator_stability(tableau, Oscillator.default(terms_of(tableau), fmpq(1)))
    x = Polynomial([0, 1])
    assert found.trace.numerator * (x + 2) == found.trace.denominator * 4
    assert found.is_p_stable


@pytest.mark.parametrize("s", [1, 2, 3, 4])
def test_interpolation_is_made_of_collocation_and_its_conjugate(s: int) -> None:
    """A^{2,1} by −s and s + 1, A^{1,2} by s + 1 and −s, exactly."""
    interpolation = gauss_lobatto(s, "interpolation").blocks
    one = f"{{collocation: -{s}, conjugate-collocation: {s + 1}}}"
    other = f"{{collocation: {s + 1}, conjugate-collocation: -{s}}}"
    assert gauss_lobatto(s, one).blocks[1, 0] == interpolation[1, 0]
    assert gauss_lobatto(s, other).blocks[0, 1] == interpolation[0, 1]
    assert gauss_lobatto(s, one).blocks[0, 1] != interpolation[0, 1]


def squares(s: fmpq, t: fmpq) -> fmpq:
    """The sum of squares that the page prints, for rational s and t."""
    u, v = s - 1, 3 * (t - 1) / 2
    return (
        fmpq(13, 69984) * (u**4 + v**4)
        + fmpq(5, 13122) * u**2 * v**2
        + fmpq(89, 12960) * (u**2 + v**2)
        - u * v / 1458
        + fmpq(7, 810) * (u + v)
        + fmpq(153379, 4665600)
    )


@in_whole
def test_the_least_principal_error() -> None:
    """The sum of squares is the printed polynomial; the finds have the values that the page has.

    Between the polynomial at rational numbers near the algebraic s and t and the exact constants
    there is no difference of first order, where it has its minimum.
    """
    s, t = fmpq(-3), fmpq(1, 2)
    text = (
        f'{{blocks: {{"1,2": {{interpolation: {s}, collocation: {1 - s}}},'
        f' "2,1": {{interpolation: {t}, collocation: {1 - t}}}}}}}'
    )
    constants = error_constants(pair(gauss_lobatto(2, text)), 5)
    assert constants is not None
    assert constants.all.two_squared == squares(s, t)
    near = {
        "least-error-gauss2-lobatto3": (fmpq(366973, 1000000), fmpq(577982, 1000000)),
        "p-stable-least-error-gauss2-lobatto3": (fmpq(383465, 1000000), fmpq(1)),
    }
    for name, (a, b) in near.items():
        found = error_constants(pair(tableau_of(name)), 5)
        assert found is not None
        assert found.all.two_squared is not None
        with ctx.workprec(200):
            excess = squares(a, b) - to_ball(found.all.two_squared)
        assert 0 < excess < 1e-13
        h = fmpq(1, 1000)
        assert squares(a, b) < min(squares(a - h, b), squares(a + h, b))


@pytest.mark.parametrize(
    ("name", "published", "order"),
    [
        ("imex6-order4", ["sundials_ARK436L2SA", "LIRK4_Calvo"], 5),
        ("imex4-order3", ["sundials_ARK324L2SA", "sciml_ARS343"], 4),
    ],
)
def test_the_error_is_less_than_that_of_published_pairs(
    name: str, published: list[str], order: int
) -> None:
    """The norm over all trees, of as many stages and the same order."""
    known = entries()
    found = error_constants(tableau_of(name), order)
    assert found is not None
    assert found.all.two_squared is not None
    for other in published:
        constants = error_constants(tableau(known[other]), order)
        assert constants is not None
        assert found.all.two < constants.all.two
        assert found.all.largest < constants.all.largest


@pytest.mark.parametrize(
    ("name", "norm", "largest"),
    [
        ("methods/found/splitting6-order4.gark.yaml", 3.639e-4, None),
        ("blanes-moan-s-6", 4.282e-4, None),
        ("mclachlan-ss-5", 7.751e-3, None),
        ("methods/found/esdirk6-order4.gark.yaml", 1.450e-3, 8.46e-4),
        ("esdirk-436", 1.830e-3, 1.056e-3),
        ("esdirk-43i6", 2.254e-3, 1.039e-3),
        ("methods/found/low-storage5-order4-imaginary.gark.yaml", 9.399e-3, None),
        ("carpenter-kennedy-4", 5.733e-3, None),
    ],
)
def test_errors_of_methods_of_order_4(name: str, norm: float, largest: float | None) -> None:
    """The norms of docs/found.md, over all trees; the methods have order 4 and no more."""
    constants = error_constants(load(name).tableau, 5)
    assert constants is not None
    assert float(constants.all.two) == pytest.approx(norm, rel=4e-4)
    if largest is not None:
        assert float(constants.all.largest) == pytest.approx(largest, rel=6e-4)
    below = error_constants(load(name).tableau, 4)
    assert below is not None
    assert float(below.all.two) < 1e-14


@pytest.mark.parametrize(
    ("name", "norm", "largest"),
    [
        ("methods/found/explicit7-order5.gark.yaml", 6.494e-5, 12.764),
        ("tsitouras-5", 1.385e-4, 12.921),
        ("dormand-prince-5", 3.991e-4, 11.596),
    ],
)
def test_errors_of_explicit_pairs_of_order_5(name: str, norm: float, largest: float) -> None:
    """The norms of docs/found.md by the sum over all trees of order 6, with vectors in floats."""
    tableau = load(name).tableau
    entries = numeric_entries(tableau)
    A = [[float(x) for x in row] for row in entries.A[0][0] or ()]
    b = [float(x) for x in entries.b[0]]

    def vector(tree: Tree) -> list[float]:
        product = [1.0] * len(b)
        for branch in tree.branches:
            inner = vector(branch)
            for i, row in enumerate(A):
                product[i] *= sum(a * x for a, x in zip(row, inner, strict=True))
        return product

    errors = []
    for tree in trees(6):
        weight = sum(x * y for x, y in zip(b, vector(tree), strict=True))
        errors.append((weight - 1 / tree.density) / tree.symmetry)
    assert len(errors) == 20
    assert sum(x * x for x in errors) ** 0.5 == pytest.approx(norm, rel=4e-4)
    assert max(abs(x) for row in A for x in row) == pytest.approx(largest, abs=6e-4)


@pytest.mark.parametrize(
    ("name", "reach"),
    [
        ("methods/found/low-storage5-order4-imaginary.gark.yaml", 3.464101),
        ("carpenter-kennedy-4", 3.340718),
    ],
)
def test_imaginary_axes_of_five_stages(name: str, reach: float) -> None:
    """The table of docs/found.md, by gark and in floats: with κ = bᵀA⁴𝟙 and Y = y²,
    |R(iy)|² − 1 = Y³(2κ − 1/72 + (1/576 − κ/3)Y + κ²Y²).
    """
    kappa = times_powers(load(name).tableau, 4)
    first, middle, last = 2 * kappa - 1 / 72, 1 / 576 - kappa / 3, kappa**2
    assert first < 0
    squared = (-middle + (middle**2 - 4 * last * first) ** 0.5) / (2 * last)
    assert squared**0.5 == pytest.approx(reach, abs=6e-7)
    assert f"imaginary axis y² ≤ {squared:.6f}"[:-1] in " ".join(
        gark("stability", name).out.split()
    )


@pytest.mark.parametrize("name", ["imex6-order4", "imex4-order3", "imex4-order3-imaginary"])
def test_the_parts_are_those_of_the_pair(name: str) -> None:
    """What is claimed of a part alone is claimed of the same coefficients."""
    whole = tableau_of(name)
    implicit = tableau_of(f"{name}-implicit")
    # numbers of two fields are compared as they are written
    assert str(implicit.blocks[0, 0]) == str(whole.blocks[0, 1])
    assert str(implicit.colours[0].b) == str(whole.colours[1].b)
    if name != "imex4-order3":
        explicit = tableau_of(f"{name}-explicit")
        assert str(explicit.blocks[0, 0]) == str(whole.blocks[0, 0])
        assert str(explicit.colours[0].b) == str(whole.colours[0].b)


@pytest.mark.parametrize(
    ("name", "norm", "reach"),
    [
        ("methods/found/imex4-order3-imaginary.gark.yaml", 0.1740, 2.828),
        ("methods/found/imex4-order3.gark.yaml", 0.1624, 2.160),
        ("ark324l2sa", 0.1663, 2.484),
    ],
)
def test_imaginary_axes_of_explicit_parts(name: str, norm: float, reach: float) -> None:
    """The table of docs/found.md: |R(iy)|² − 1 = y⁴(2κ − 1/12 + (1/36 − κ)y² + κ²y⁴) in floats,
    κ = bᵀA³𝟙 of the explicit part, and the norm over all trees.
    """
    tableau = load(name).tableau
    constants = error_constants(tableau, 4)
    assert constants is not None
    assert float(constants.all.two) == pytest.approx(norm, abs=6e-5)
    kappa = times_powers(tableau, 3)
    middle, last = 1 / 36 - kappa, kappa**2
    first = min(2 * kappa - 1 / 12, 0.0)  # 0 but for rounding where κ = 1/24
    squared = (-middle + (middle**2 - 4 * last * first) ** 0.5) / (2 * last)
    assert squared**0.5 == pytest.approx(reach, abs=6e-4)


@pytest.mark.parametrize(
    ("family", "reach", "value"),
    [
        (loads_family(CHAIN), "2*sqrt(2)", {"k": fmpq(1, 24)}),
        (load_family(ASKS / "imaginary-interval-5-stages.yaml"), "2*sqrt(3)", {"t": fmpq(1, 6)}),
    ],
)
def test_no_explicit_part_reaches_farther(
    family: FamilyFile, reach: str, value: dict[str, fmpq]
) -> None:
    """Of all R = 1 + z + z²/2 + z³/6 + κz⁴, and of all with z⁴/24 + κz⁵, decided by gark."""
    found = minimise(family, "-imaginary-interval")
    assert found.extent == "all"
    assert found.value is not None
    assert root_text(found.value) == reach
    [best] = found.minimisers
    assert best.found.solution.values == value


def test_the_polynomials_of_the_family_of_transfers_are_all() -> None:
    """With irrational nodes too the listed polynomials have the dimension that is told, and are in
    the ideal.
    """
    family = load_family(ASKS / "every-transfer-gauss2-lobatto3.yaml")
    ideal = find_parameters(family, 4, "pair").last.ideal
    assert ideal is not None
    assert ideal.dimension == 2
    size = len(family.ring.names)
    context = fmpq_mpoly_ctx.get(family.ring.names, Ordering.degrevlex)
    listed = []
    for p in ideal.polynomials:
        terms = {e[:size]: fmpq(a) for e, a in p.to_dict().items()}
        assert all(not any(e[size:]) for e in p.to_dict())
        listed.append(context.from_dict(terms))
    assert all(ideal.contains(p) for p in listed)
    assert Ideal(family.ring).with_zeros(listed).dimension == 2


@in_whole
def test_the_errors_of_gauss_2_and_lobatto_4() -> None:
    """The table of the page: the least error of all, and that of the P-stable pairs, exactly."""
    least = load(FOUND.parent / "symplectic-gauss-lobatto4.gark.yaml").tableau
    p_stable = tableau_of("p-stable-least-error-gauss2-lobatto4")
    for found, squared in ((least, fmpq(31811, 2332800)), (p_stable, fmpq(793, 46656))):
        assert error_constants(pair(found), 5).all.two_squared == squared


@pytest.mark.parametrize(
    ("ask", "options", "answers"),
    [
        ("p-stable-conjugate-gauss2-lobatto3", ["--p-stable", "--pair"], ["tau = -2"]),
        ("imex6-order4", [], ["order 4 for 1 solution"]),
        ("splitting6-order4", ["--minimise", "error"], ["1.32452909706e-7", "2 solutions"]),
        ("esdirk6-order4", [], ["a53 = 8289175/1464067"]),
        ("nystrom4-order5", ["--minimise", "error"], ["20129/153664000000"]),
        ("imaginary-interval-5-stages", ["--minimise=-imaginary-interval"], ["2*sqrt(3)"]),
        ("low-storage5-order4-imaginary", ["--search", "10"], ["1 method of order 4"]),
        pytest.param(
            "least-error-gauss2-lobatto3",
            ["--pair", "--order", "4", "--minimise", "error"],
            ["0.0272829949071", "790*x^3 - 2370*x^2 + 9219*x - 3103"],
            marks=in_whole,
        ),
        pytest.param(
            "explicit7-order5",
            ["--search", "1", "--minimise", "error", "--start", "tsitouras-5"],
            ["4.02180729741e-9"],
            marks=in_whole,
        ),
    ],
)
def test_what_docs_found_says_of_questions(
    ask: str, options: list[str], answers: list[str]
) -> None:
    """The numbers of docs/found.md are the answers of gark design."""
    shown = " ".join(gark("design", str(ASKS / f"{ask}.yaml"), *options).out.split())
    assert all(x in shown for x in answers), shown
