"""The symplectic conjugate: an involution that exchanges C and D, whatever the stage spaces."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

import pytest
from flint import fmpq, fmpq_poly
from hypothesis import given
from hypothesis import strategies as st

from garkcli.errors import MethodError, ZeroWeight
from garkcli.exact.matrix import dot, identity, transpose
from garkcli.frozen import replace
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import is_symplectic, simplifying
from garkcli.tableau.conjugate import conjugate, conjugate_block
from garkcli.tableau.forms import additive, gark, pair, separable_prk, spelled_out, symplectic_pair
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import RULES, collocation
from tests.oracles import samples
from tests.oracles.points import numbers
from tests.whole import in_whole

FAMILIES = st.sampled_from(
    [
        "gauss 1",
        "gauss 2",
        "gauss 3",
        "radau-ia 2",
        "radau-iia 3",
        "lobatto-iiia 3",
        "lobatto-iiic 3",
        "kutta",
    ]
)
SPELLED: dict[str, Callable[[int], Tableau]] = {
    "rk4": lambda _: samples.NAMED["rk4"](),
    "rectangular": lambda _: samples.rectangular(),
    "IMEX": lambda _: samples.implicit_explicit(),
    "additive": lambda seed: samples.random_additive(Random(seed)),
}
seeds = st.integers(0, 10**6)


def full_graph(seed: int) -> Tableau:
    """A random GARK tableau of points with all blocks and no zero weight."""
    dice = Random(seed)
    stages = [dice.randint(1, 3) for _ in range(dice.randint(1, 3))]

    def nonzero() -> fmpq:
        return fmpq(dice.choice([-3, -2, -1, 1, 2, 3]), dice.randint(1, 4))

    A = [
        [tuple(tuple(samples.small(dice) for _ in range(s)) for _ in range(r)) for s in stages]
        for r in stages
    ]
    b = [tuple(nonzero() for _ in range(s)) for s in stages]
    c = [tuple(samples.small(dice) for _ in range(s)) for s in stages]
    return spelled_out(A, b, c)


def mixed(names: tuple[str, str], seed: int) -> Tableau:
    """Two families with random weights of the four rules in each off-diagonal block."""
    dice = Random(seed)
    weights = [samples.small(dice) for _ in range(4)]
    return samples.everywhere(samples.mixture(*map(str, weights)), *names)


@given(seeds)
def test_twice_is_the_identity_at_points(seed: int) -> None:
    """Conjugated twice, a random tableau is the one it was, block by block."""
    tableau = full_graph(seed)
    assert conjugate(conjugate(tableau)) == tableau
    assert set(tableau.blocks) == {(l, m) for l in range(tableau.size) for m in range(tableau.size)}


@given(st.tuples(FAMILIES, FAMILIES), seeds)
def test_twice_is_the_identity_in_polynomials(names: tuple[str, str], seed: int) -> None:
    """The same in ℚ[x]/(M), and between such a space and a space of points."""
    tableau = mixed(names, seed)
    assert conjugate(conjugate(tableau)) == tableau


@given(seeds)
def test_twice_is_the_identity_for_partitioned_methods(seed: int) -> None:
    """A pair of unrelated position and momentum blocks comes back after two conjugations."""
    dice = Random(seed)
    tableau = pair(full_graph(seed))
    blocks = {edge: _random_like(block, dice) for edge, block in tableau.blocks.items()}
    unrelated = replace(tableau, blocks=blocks)
    assert conjugate(conjugate(unrelated)) == unrelated
    assert conjugate(tableau) == tableau


def _random_like(
    block: tuple[tuple[object, ...], ...], dice: Random
) -> tuple[tuple[fmpq, ...], ...]:
    return tuple(tuple(samples.small(dice) for _ in row) for row in block)


@given(seeds)
def test_the_printed_condition(seed: int) -> None:
    """b_i b_j = b_i â_ij + b_j a_ji for all stages and colours."""
    Q = full_graph(seed)
    P = conjugate(Q)
    for l, m in Q.edges():
        b, other = Q.colours[l].b, Q.colours[m].b
        a_hat, a = P.block(l, m), Q.block(m, l)
        assert a_hat is not None
        assert a is not None
        for i, x in enumerate(b):
            for j, y in enumerate(other):
                assert x * y == x * a_hat[i][j] + y * a[j][i]


@given(seeds)
def test_is_symplectic_is_being_ones_own_conjugate(seed: int) -> None:
    """A random tableau is not symplectic; the mean with its conjugate is; the pair always is."""
    Q = full_graph(seed)
    P = conjugate(Q)
    assert is_symplectic(Q) == (P == Q)
    half = fmpq(1, 2)
    mean = {
        edge: tuple(
            tuple(half * (x + y) for x, y in zip(r, s, strict=True))
            for r, s in zip(A, P.blocks[edge], strict=True)
        )
        for edge, A in Q.blocks.items()
    }
    assert is_symplectic(replace(Q, blocks=mean))
    assert is_symplectic(pair(Q))


def assert_exchanged(Q: Tableau) -> None:
    """C(Â^{l,m}) = D(A^{m,l}) and D(Â^{l,m}) = C(A^{m,l}), where B holds as far."""
    P = conjugate(Q)
    one, other = simplifying(Q, 12), simplifying(P, 12)
    for l in range(Q.size):
        for m in range(Q.size):
            reach = min(one.B[l], one.B[m])
            C_hat, D_hat, C, D = (other.C[l][m], other.D[l][m], one.C[m][l], one.D[m][l])
            assert C_hat is not None
            assert D_hat is not None
            assert C is not None
            assert D is not None
            assert min(C_hat, reach) == min(D, reach)
            assert min(D_hat, reach) == min(C, reach)


@given(st.tuples(FAMILIES, FAMILIES), st.sampled_from(sorted(RULES)))
def test_conjugation_exchanges_stage_order_and_d(names: tuple[str, str], rule: str) -> None:
    """C and D change places under conjugation, for every pair of families and every rule."""
    assert_exchanged(samples.everywhere(RULES[rule], *names))


@given(st.tuples(FAMILIES, FAMILIES), seeds)
def test_conjugation_exchanges_stage_order_and_d_of_mixtures(
    names: tuple[str, str], seed: int
) -> None:
    """The same for random combinations of the rules."""
    dice = Random(seed)
    weights = [samples.small(dice) for _ in range(3)]
    rule = samples.mixture(*(str(x) for x in (*weights, 1 - sum(weights, fmpq(0)))))
    assert_exchanged(samples.everywhere(rule, *names))


@in_whole
@given(seeds)
def test_renumbering_commutes_with_everything(seed: int) -> None:
    """Renumbering the colours before or after conjugating, pairing or finding the order makes no
    difference.
    """
    dice = Random(seed)
    tableau = samples.everywhere(collocation, "gauss 2", "lobatto-iiia 3", "radau-iia 2")
    tableau = samples.with_perturbed_block(tableau, dice)
    permutation = dice.sample(range(3), 3)
    other = samples.renumbered(tableau, permutation)
    assert find_order(other).order == find_order(tableau).order
    assert find_order(pair(other)).order == find_order(pair(tableau)).order
    for l in range(3):
        for m in range(3):
            k, n = permutation[l], permutation[m]
            assert other.block(l, m) == tableau.block(k, n)
            assert conjugate(other).block(l, m) == conjugate(tableau).block(k, n)
            assert pair(other).block(l, m + 3) == pair(tableau).block(k, n + 3)
    C, found = simplifying(tableau, 5).C, simplifying(other, 5).C
    assert found == tuple(tuple(C[k][n] for n in permutation) for k in permutation)


@given(seeds, st.sampled_from([full_graph, *SPELLED.values()]))
def test_numbering_of_stages_does_not_matter(seed: int, make: Callable[[int], Tableau]) -> None:
    """Stages in another order: the same order, B, C and D, and the same order of the pair where it
    exists.
    """
    tableau = make(seed)
    other = samples.with_permuted_stages(tableau, Random(seed))
    assert find_order(other, 6).order == find_order(tableau, 6).order
    assert simplifying(other, 6) == simplifying(tableau, 6)
    assert is_symplectic(other) == is_symplectic(tableau)
    if all(all(colour.b) for colour in tableau.colours):
        assert find_order(pair(other), 6).order == find_order(pair(tableau), 6).order


def test_a_zero_weight_is_named() -> None:
    """No conjugate exists where a weight is zero; the error says which weight, and of several
    colours whose.
    """
    method = samples.method("explicit-midpoint")
    for derived in (conjugate, pair):
        with pytest.raises(ZeroWeight, match=r"^the symplectic conjugate divides .* b_1 = 0"):
            derived(gark([method], {}))
    both = gark(
        [method, method], {(l, m): collocation(method, method) for l, m in ((0, 1), (1, 0))}
    )
    with pytest.raises(ZeroWeight, match=r"^colour 1: .*b_1 = 0"):
        conjugate(both)


def test_symplecticity_divides_by_no_weight() -> None:
    """A tableau with a zero weight can be told to be symplectic or not."""
    assert not is_symplectic(gark([samples.method("explicit-midpoint")], {}))
    used = ((fmpq(1, 2), fmpq(1)), (fmpq(7), fmpq(3)))
    assert not is_symplectic(spelled_out([[used]], [(fmpq(1), fmpq(0))], [None]))
    unused = ((fmpq(1, 2), fmpq(0)), (fmpq(7), fmpq(3)))
    assert is_symplectic(spelled_out([[unused]], [(fmpq(1), fmpq(0))], [None]))


def test_a_structure_divides_by_fewer_weights() -> None:
    """Separable: only the weights of the velocities need to be nonzero."""
    methods = [samples.method("gauss 2"), samples.method("explicit-midpoint")]
    Q = gark(methods, {(0, 1): collocation(*methods), (1, 0): collocation(methods[1], methods[0])})
    assert is_symplectic(symplectic_pair(Q, [0], [1]))
    with pytest.raises(ZeroWeight, match="colour 2"):
        symplectic_pair(Q, [1], [0])


def test_a_pair_of_a_pair_is_refused() -> None:
    """A partitioned tableau has no velocities and forces to choose from."""
    with pytest.raises(MethodError, match="partitioned already"):
        symplectic_pair(pair(gark([samples.method("gauss 1")], {})), [0], [1])


def test_pair_of_a_partitioned_method_keeps_its_positions() -> None:
    """The pair of a partitioned method has its position blocks, and their conjugates for the
    momenta.
    """
    stormer = separable_prk(
        (((fmpq(0),), (fmpq(1),)), (fmpq(1),), None),
        (((fmpq(1, 2), fmpq(0)),), (fmpq(1, 2), fmpq(1, 2)), (fmpq(1, 2),)),
    )
    assert is_symplectic(stormer)
    assert pair(stormer) == stormer
    broken = replace(stormer, blocks={**stormer.blocks, (0, 1): ((fmpq(1, 3), fmpq(1, 6)),)})
    assert not is_symplectic(broken)
    assert pair(broken) == stormer
    assert find_order(stormer).order == 2


def test_shared_stages_are_told_apart_by_their_conjugates() -> None:
    """An additive method has one set of stages, its conjugate one for each colour; twice gives
    copies of it.
    """
    A_1 = ((fmpq(0), fmpq(0)), (fmpq(1), fmpq(0)))
    A_2 = ((fmpq(0), fmpq(0)), (fmpq(1, 2), fmpq(1, 2)))
    b = (fmpq(1, 2), fmpq(1, 2))
    shared = additive([A_1, A_2], [b, b], None)
    twice = conjugate(conjugate(shared))
    assert [shared.block(l, m) for l in (0, 1) for m in (0, 1)] == [A_1, A_2] * 2
    assert [twice.block(l, m) for l in (0, 1) for m in (0, 1)] == [A_1, A_2] * 2
    assert find_order(twice).order == find_order(shared).order == 2


def test_one_block_by_hand() -> None:
    """Â = 1 − a b_m / b_l for one stage each."""
    here, other = PointSpace((fmpq(1, 2),)), PointSpace((fmpq(1, 3),))
    block = conjugate_block(((fmpq(1, 5),),), here, (fmpq(2),), other, (fmpq(3),))
    assert block == ((3 - fmpq(1, 5) * 3 / 2,),)


@pytest.mark.parametrize(
    "make", [lambda: samples.without_cycles(), lambda: samples.one_way("gauss 2", "radau-iia 2")]
)
def test_edges_turn_round(make: Callable[[], Tableau]) -> None:
    """Colour l of the conjugate sees colour m where m saw l."""
    tableau = make()
    assert set(conjugate(tableau).edges()) == {(m, l) for l, m in tableau.edges()}
    assert conjugate(conjugate(tableau)) == tableau


@given(FAMILIES, FAMILIES, seeds)
def test_the_form_of_a_block_is_the_weights_of_products(here: str, there: str, seed: int) -> None:
    """In every stage space the entries of ``form`` are b(e_i ⊙ A e_j)."""
    tableau = mixed((here, there), seed)
    for l, m in tableau.edges():
        space, b, block = (tableau.space(l), tableau.colours[l].b, tableau.block(l, m))
        assert block is not None
        images = transpose(block)
        assert space.form(b, block) == tuple(
            tuple(dot(b, space.product(e, image)) for image in images)
            for e in identity(space.stages)
        )


@pytest.mark.parametrize(
    ("weights", "words"),
    [
        (("1/2", "0", "1/2"), "which is 0 at the node 1/2"),
        (("1", "0", "-1"), "which is 0 at the node 1/2"),
        (("0", "1", "0"), "which are 0 at the nodes where x^2 + (-1)*x = 0"),
        (("0", "0", "0"), "which are 0 at the nodes where x^3 + (-3/2)*x^2 + 1/2*x = 0"),
        (("0", "sqrt(2)", "1"), "one of which is 0"),
    ],
)
def test_zero_weights_in_a_polynomial_space(weights: tuple[str, ...], words: str) -> None:
    """The nodes 0, 1/2, 1 without weight are named, though no coordinate of the functional is
    theirs.
    """
    (values,) = numbers(", ".join(weights))
    space = PolynomialSpace(fmpq_poly([0, fmpq(1, 2), fmpq(-3, 2), 1]))
    nodes = (fmpq(0), fmpq(1, 2), fmpq(1))
    b = tuple(dot(values, tuple(c**k for c in nodes)) for k in range(3))
    with pytest.raises(ZeroWeight) as caught:
        conjugate_block(identity(3), space, b, space, b)
    assert caught.value.message == f"the symplectic conjugate divides by the weights b, {words}"


def test_zero_weights_at_points() -> None:
    """They are named one by one, as long as they are few."""
    space = PointSpace((fmpq(0),) * 6)
    two = space.zero_weights((fmpq(1), fmpq(0), fmpq(1), fmpq(0), fmpq(1), fmpq(1)))
    assert str(two) == "b_2 = b_4 = 0"
    assert str(space.zero_weights((fmpq(0),) * 6)) == "b_1 = b_2 = b_3 = … = 0"
