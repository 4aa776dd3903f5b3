"""Compositions, adjoints and splittings: against the substeps taken one by one, and the orders of
the books.
"""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.api.methods import find_order, is_symplectic
from garkcli.constructions.composition import Substep, adjoint, composed, drift_and_kick
from garkcli.constructions.schemes import SCHEMES, SPLITTINGS
from garkcli.convergence.convergence import converge
from garkcli.errors import MethodError
from garkcli.exact.matrix import Matrix, Vector, identity, scale, solve, subtract
from garkcli.families.registry import diagonal_method
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import loads
from garkcli.problems.builtin import hamiltonian
from garkcli.properties.reduction import reduced
from garkcli.properties.symmetry import symmetry
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Method, Tableau, butcher
from tests.oracles.brute import brute_order
from tests.oracles.series import series_order
from tests.whole import at_most, in_whole

MIDPOINT = "{family: gauss, stages: 1}"
VERLET = "{splitting: {scheme: strang}}"
State = tuple[fmpq, ...]
small = st.builds(fmpq, st.integers(-4, 4), st.integers(1, 3))


def alone(name: str, stages: int | None = None) -> Tableau:
    """A family as a tableau of one colour."""
    return gark([diagonal_method(name, stages)], {})


def field(y: State) -> State:
    """A vector field without any structure."""
    return y[1] * y[1] + 1, y[0] - y[0] * y[1] + fmpq(1, 2)


def explicit_step(A: Matrix, b: Vector, y: State, h: fmpq) -> State:
    """One step of an explicit method in rational arithmetic, stage by stage."""
    slopes: list[State] = []
    for row in A:
        terms = zip(row, slopes, strict=False)
        slopes.append(field(_moved(y, h, list(terms))))
    return _moved(y, h, list(zip(b, slopes, strict=True)))


def _moved(y: State, h: fmpq, terms: Sequence[tuple[object, State]]) -> State:
    moved = list(y)
    for weight, slope in terms:
        assert isinstance(weight, fmpq)
        for i, x in enumerate(slope):
            moved[i] += h * weight * x
    return tuple(moved)


@st.composite
def explicit_methods(draw: st.DrawFn) -> Method:
    """An explicit method of one or two stages, with no order in particular."""
    s = draw(st.integers(1, 2))
    rows = []
    for i in range(s):
        below = [draw(small) for _ in range(i)]
        rows.append((*below, *[fmpq(0)] * (s - i)))
    return butcher(tuple(rows), tuple(draw(small) for _ in range(s)))


@settings(max_examples=at_most(8, 160), deadline=None)
@given(st.lists(st.tuples(explicit_methods(), small), min_size=1, max_size=3))
def test_a_composition_takes_its_substeps(substeps: list[tuple[Method, fmpq]]) -> None:
    """One step of the composition is that of its methods one after the other, exactly."""
    made = composed([Substep(gark([x], {}), g) for x, g in substeps])
    A, b = made.blocks[0, 0], made.colours[0].b
    start, h = (fmpq(1, 2), fmpq(-1, 3)), fmpq(1, 5)
    y: State = start
    for method, g in substeps:
        y = explicit_step(method.A, method.b, y, g * h)
    assert explicit_step(A, b, start, h) == y


def kicks(flows: Sequence[tuple[int, fmpq]], q: fmpq, p: fmpq) -> State:
    """Drifts q̇ = p² + p and kicks ṗ = q − q³, taken one by one with h = 1."""
    for part, g in flows:
        if part == 0:
            q += g * (p * p + p)
        else:
            p += g * (q - q**3)
    return q, p


@settings(max_examples=at_most(8, 160), deadline=None)
@given(st.lists(st.tuples(st.integers(0, 1), small), min_size=2, max_size=4))
def test_a_splitting_takes_its_flows(flows: list[tuple[int, fmpq]]) -> None:
    """Every splitting of a separable problem is drifts and kicks in turn, exactly, whether its
    flows alternate or not; both parts flow.
    """
    flows = [*flows, (0, fmpq(1)), (1, fmpq(1))]
    made = drift_and_kick(flows)
    q, p = fmpq(1, 3), fmpq(1, 2)
    wanted = kicks(flows, q, p)
    velocities, forces = made.colours
    A_p, A_q = made.blocks[0, 1], made.blocks[1, 0]
    v: list[fmpq] = []
    f: list[fmpq] = []
    # the stages that see what is known, until all are
    while len(v) < len(velocities.b) or len(f) < len(forces.b):
        if len(v) < len(velocities.b) and not any(A_p[len(v)][len(f) :]):
            at = _value(p, A_p[len(v)], f)
            v.append(at * at + at)
        else:
            at = _value(q, A_q[len(f)], v)
            f.append(at - at**3)
    assert wanted == (_value(q, velocities.b, v), _value(p, forces.b, f))


def _value(start: fmpq, row: Vector, slopes: Sequence[fmpq]) -> fmpq:
    total = start
    for weight, slope in zip(row, slopes, strict=False):
        assert isinstance(weight, fmpq)
        total += weight * slope
    return total


ADJOINTS = {
    "explicit-euler": ("radau-iia", 1),
    "lobatto-iiic 4": ("lobatto-iiic*", 4),
    "lobatto-iiib 3": ("lobatto-iiib", 3),
    "gauss 5": ("gauss", 5),
}
"""Methods and the adjoints that the books say they have."""


@pytest.mark.parametrize("name", ADJOINTS)
def test_adjoints_of_families(name: str) -> None:
    """Euler's methods are adjoint, and IIIC and IIIC*; Gauss and IIIB are their own adjoints; twice
    the adjoint is the method, in a stage algebra and at points.
    """
    word, _, stages = name.partition(" ")
    method = alone(word, int(stages) if stages else None)
    other = alone(*ADJOINTS[name])
    turned = adjoint(method)
    if word == "explicit-euler":
        assert (turned.blocks[0, 0], turned.colours[0].b) == (((1,),), (1,))
        assert turned.colours[0].c == (1,)
    else:
        assert turned == other
    assert adjoint(turned) == method


@settings(max_examples=at_most(15, 120), deadline=None)
@given(explicit_methods(), explicit_methods())
def test_the_adjoint_of_the_adjoint(one: Method, two: Method) -> None:
    """So it is for methods of several colours, whatever their blocks; and adjoint and method
    compose to a symmetric one.
    """
    block = tuple((fmpq(1, 3),) * two.stages for _ in range(one.stages))
    back = tuple((fmpq(2),) * one.stages for _ in range(two.stages))
    method = gark([one, two], {(0, 1): block, (1, 0): back})
    turned = adjoint(method)
    assert adjoint(turned) == method
    half = fmpq(1, 2)
    both = composed([Substep(method, half), Substep(turned, half)])
    assert symmetry(both).holds


@pytest.mark.parametrize("z", [fmpq(1, 2), fmpq(-3)])
def test_the_adjoint_is_the_inverse(z: fmpq) -> None:
    """R*(z) R(−z) = 1 for the stability functions of a method and its adjoint."""
    method = alone("rk4")
    turned = adjoint(method)
    assert _growth(turned, z) * _growth(method, -z) == 1


def _growth(tableau: Tableau, z: fmpq) -> fmpq:
    """R(z) = 1 + z b (1 − z A)^{-1} 𝟙."""
    A, b = tableau.blocks[0, 0], tableau.colours[0].b
    system = subtract(identity(len(b)), scale(z, A))
    stages = solve(system, tuple((fmpq(1),) for _ in b))
    return 1 + z * sum((w * y[0] for w, y in zip(b, stages, strict=True)), fmpq(0))


SCHEMES_USED: dict[str, tuple[str, int]] = {
    "strang": ("{of: explicit-euler, scheme: strang}", 2),
    "mclachlan-4": ("{of: explicit-euler, scheme: mclachlan-4}", 4),
    "triple-jump": (f"{{of: {MIDPOINT}, scheme: triple-jump}}", 4),
    "suzuki": (f"{{of: {VERLET}, scheme: suzuki}}", 4),
    "yoshida-6": (f"{{of: {VERLET}, scheme: yoshida-6}}", 6),
    "yoshida-8": (f"{{of: {MIDPOINT}, scheme: yoshida-8}}", 8),
    "kahan-li-6": (f"{{of: {MIDPOINT}, scheme: kahan-li-6}}", 6),
    "kahan-li-8": (f"{{of: {VERLET}, scheme: kahan-li-8}}", 8),
    "suzuki-umeno-8": (f"{{of: {MIDPOINT}, scheme: suzuki-umeno-8}}", 8),
    "sofroniou-10": (f"{{of: {MIDPOINT}, scheme: sofroniou-10}}", 10),
}
"""Every scheme, used, with its order."""


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(
            x,
            marks=[in_whole] * (x in {"sofroniou-10", "kahan-li-8", "suzuki-umeno-8", "yoshida-8"}),
        )
        for x in SCHEMES
    ],
)
def test_schemes_have_their_orders(name: str) -> None:
    """Each scheme has the order of the books and not one more; exact ones by the certificate, by
    all trees and by a power series, rounded ones within the tolerance of their numbers.
    """
    text, order = SCHEMES_USED[name]
    method = loads(f"compose: {text}")
    found = find_order(method, order + 2)
    assert (found.order, found.is_lower_bound) == (order, False)
    assert (method.tolerance is None) == (not SCHEMES[name].tolerance)
    assert SCHEMES[name].order.startswith(str(order))
    if method.tolerance is None:
        assert brute_order(method.tableau, order + 1) == order
        assert series_order(method.tableau, order + 1) == order


@pytest.mark.parametrize(
    "name", [pytest.param(x, marks=[in_whole] * (x == "blanes-moan-6")) for x in SPLITTINGS]
)
def test_splittings_have_their_orders(name: str) -> None:
    """The same for splittings of a separable problem; all of them are symplectic."""
    method = loads(f"splitting: {{scheme: {name}}}")
    order = int(SPLITTINGS[name].order)
    assert find_order(method, order + 2).order == order
    assert is_symplectic(method)
    if method.tolerance is None:
        assert series_order(method.tableau, order + 1) == order


ORDERS = {
    f"compose: {{of: {MIDPOINT}, scheme: triple-jump, order: 6}}": 6,
    "compose: {of: {family: gauss, stages: 2}, scheme: suzuki, from: 4}": 6,
    "compose: {of: {family: lobatto-iiia, stages: 2}, scheme: triple-jump}": 4,
    "compose: {of: rk4, steps: [1/3, 2/3]}": 4,
    "splitting: {scheme: lie, of: rk4, terms: 3}": 1,
    f"splitting: {{scheme: strang, of: {MIDPOINT}, terms: 3}}": 2,
    "splitting: {scheme: strang, of: [rk4, heun]}": 2,
    "splitting: {a: [1/2, 1/2], b: [1]}": 2,
    "splitting: {a: [0, 1], b: [1/2, 1/2]}": 2,
    "splitting: {flows: [{2: 1/2}, {1: 1}, {2: 1/2}]}": 2,
    f"compose: {{of: {{splitting: {{scheme: strang, of: {MIDPOINT}, terms: 3}}}},"
    " scheme: triple-jump}": 4,
}
"""Constructions and their orders."""


@pytest.mark.parametrize("text", ORDERS)
def test_orders_of_constructions(text: str) -> None:
    """The order by the certificate is that of the theory, and that of a power series."""
    method = loads(text)
    order = ORDERS[text]
    assert find_order(method, order + 2).order == order
    if order < 6:
        assert series_order(method.tableau, order + 1) == order


def test_symmetric_and_symplectic() -> None:
    """Palindromic compositions of a symmetric symplectic method are so, too; Lie's splitting is
    symplectic and not symmetric.
    """
    for text in (
        f"compose: {{of: {MIDPOINT}, scheme: triple-jump}}",
        f"compose: {{of: {VERLET}, scheme: suzuki}}",
    ):
        method = loads(text)
        assert is_symplectic(method)
        assert symmetry(method.tableau).holds
    lie = loads("splitting: {scheme: lie}")
    assert is_symplectic(lie)
    assert not symmetry(lie.tableau).holds


def test_equal_stages_are_one() -> None:
    """Where substeps meet in one value there is one stage: the trapezoidal rule twice has three
    stages, Verlet seventeen times eighteen velocities and seventeen forces.
    """
    twice = loads("compose: {of: {family: lobatto-iiia, stages: 2}, steps: [1/2, 1/2]}")
    assert twice.stages == (3,)
    assert twice.c == (0, fmpq(1, 2), 1)
    assert loads(f"compose: {{of: {VERLET}, scheme: kahan-li-8}}").stages == (18, 17)


def test_processing() -> None:
    """The inverse of a processor, the kernel, the processor: a processor that is the kernel changes
    nothing, any other leaves R(z); the implicit midpoint rule is the trapezoidal rule processed by
    half a step of Euler's method (Hairer, Lubich, Wanner, section VI.8).
    """
    same = loads("compose: {of: rk4, processor: rk4}")
    assert find_order(same).order == 4
    made = loads("compose: {of: explicit-euler, processor: explicit-midpoint}")
    assert _growth(made.tableau, fmpq(1, 3)) == 1 + fmpq(1, 3)
    half = "{A: [[0]], b: [1/2]}"
    trapezoidal = "{family: lobatto-iiia, stages: 2}"
    text = f"compose: {{of: {trapezoidal}, processor: {half}}}"
    processed = reduced(loads(text).tableau)
    assert processed.blocks[0, 0] == ((fmpq(1, 2),),)
    assert processed.colours[0].b == (1,)


def test_verlet_is_lie_and_its_adjoint() -> None:
    """The scheme strang of Lie's splitting is Strang's splitting, coefficient for coefficient."""
    one = loads("compose: {of: {splitting: {scheme: lie}}, scheme: strang}")
    assert one.tableau == loads("splitting: {scheme: strang}").tableau


def test_composition_of_gark_methods() -> None:
    """Methods of several colours compose: two half steps of a pair of families have their order;
    methods for different vector fields do not.
    """
    inner = (
        "{methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}],"
        " transfer: collocation}"
    )
    once = loads(inner)
    twice = loads(f"compose: {{of: {inner}, steps: [1/2, 1/2]}}")
    assert find_order(twice).order == find_order(once).order
    with pytest.raises(MethodError, match="other vector fields"):
        composed(
            [
                Substep(loads(x).tableau, fmpq(1))
                for x in (
                    "splitting: {scheme: lie}",
                    "splitting: {scheme: lie}\nstructure: nystrom",
                )
            ]
        )
    with pytest.raises(MethodError, match="2 colours"):
        composed([Substep(alone("heun"), fmpq(1)), Substep(once.tableau, fmpq(1))])


def test_fractions_may_be_unknown() -> None:
    """A composition with free parameters is a family: of three substeps g, 1 − 2g, g of the
    midpoint rule the order 4 needs the cubic of the triple jump.
    """
    text = f"parameters: {{g: free}}\ncompose: {{of: {MIDPOINT}, steps: [g, 1 - 2*g, g]}}"
    family = loads_family(text)
    assert family.parameters == ("g",)
    value = "1/(2 - cbrt(2))"
    assert find_order(loads(text, settings={"g": value})).order == 4
    jump = loads(f"compose: {{of: {MIDPOINT}, scheme: triple-jump}}")
    assert list(map(str, loads(text, settings={"g": value}).b)) == list(map(str, jump.b))


@pytest.mark.parametrize(
    ("text", "order"),
    [
        pytest.param(f"compose: {{of: {VERLET}, scheme: triple-jump}}", 4, marks=in_whole),
        ("extrapolate: {of: {splitting: {scheme: lie, of: heun}}, order: 2}", 2),
    ],
)
def test_observed_orders(text: str, order: int) -> None:
    """The stepping engine sees the order on problems: it reads the tableau, no construction."""
    tableau = loads(text).tableau
    terms = 1 if tableau.is_partitioned else tableau.size
    name = "pendulum" if terms == 1 else "generic"
    steps = [fmpq(1, 2**k) for k in (5, 6)]
    found = converge(tableau, hamiltonian(name, terms, 1), fmpq(1, 2), steps)
    assert found.observed_order == pytest.approx(order, abs=0.05)
