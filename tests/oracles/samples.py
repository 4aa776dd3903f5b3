"""Tableaus to try things on: named ones of every form, random ones, and random changes of known
ones.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from random import Random

from flint import fmpq

from garkcli.exact.matrix import Matrix, Vector
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.tableau.forms import (
    additive,
    gark,
    pair,
    partitioned,
    separable_prk,
    spelled_out,
    symplectic_pair,
    with_linear,
)
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Method, Tableau
from garkcli.transfer import (
    RULES,
    Rule,
    collocation,
    combination,
    conjugate_rule,
    interpolation,
    symplectic_blocks,
)
from tests.oracles.points import numbers


def method(name: str) -> Method:
    """A diagonal method by its family and, after a blank, its number of stages."""
    family, _, stages = name.partition(" ")
    return diagonal_method(family, int(stages) if stages else None)


def everywhere(rule: Rule, *names: str) -> Tableau:
    """The GARK tableau of some methods with one rule for all off-diagonal blocks."""
    methods = [method(name) for name in names]
    edges = [(l, m) for l in range(len(methods)) for m in range(len(methods)) if l != m]
    return gark(methods, {(l, m): rule(methods[l], methods[m]) for l, m in edges})


def mixture(*weights: str) -> Rule:
    """The combination of collocation, interpolation and their conjugates with the given weights."""
    (row,) = numbers(",".join(weights))
    rules = (collocation, interpolation, conjugate_rule(collocation), conjugate_rule(interpolation))
    return lambda l, m: combination(list(zip(row, rules, strict=True)), l, m)


def by_conjugates(rule: Rule, base: str, other: str) -> Tableau:
    """Two methods with off-diagonal blocks conjugate to each other, the first built on ``base``."""
    methods = [method(base), method(other)]
    return gark(methods, symplectic_blocks(rule, methods, 0, 1))


def rectangular() -> Tableau:
    """The paper's eq. (rectangular), spelled out."""
    (*A_q, b_q, c_q), (*A_p, b_p, c_p) = _split(
        numbers(
            "0, 0",
            "1/4 + sqrt(3)/8, 1/4 - sqrt(3)/8",
            "1/2, 1/2",
            "1/2, 1/2",
            "0, 1/2, 1",
            "1/6, 1/3 - sqrt(3)/6, 0",
            "1/6, 1/3 + sqrt(3)/6, 0",
            "1/6, 2/3, 1/6",
            "1/2 - sqrt(3)/6, 1/2 + sqrt(3)/6",
        ),
        5,
    )
    return separable_prk((tuple(A_q), b_q, c_q), (tuple(A_p), b_p, c_p))


def _split(rows: tuple[Vector, ...], at: int) -> tuple[tuple[Vector, ...], tuple[Vector, ...]]:
    return rows[:at], rows[at:]


def runge_kutta(*rows: str) -> Tableau:
    """One colour: the rows of A, then b."""
    *A, b = numbers(*rows)
    return spelled_out([[tuple(A)]], [b], [None])


def implicit_explicit() -> Tableau:
    """ARS(2,2,2) of Ascher, Ruuth and Spiteri, over ℚ(√2)."""
    rows = numbers(
        "0, 0, 0",
        "1 - sqrt(2)/2, 0, 0",
        "-sqrt(2)/2, 1 + sqrt(2)/2, 0",
        "-sqrt(2)/2, 1 + sqrt(2)/2, 0",
        "0, 0, 0",
        "0, 1 - sqrt(2)/2, 0",
        "0, sqrt(2)/2, 1 - sqrt(2)/2",
        "0, sqrt(2)/2, 1 - sqrt(2)/2",
    )
    return additive([rows[0:3], rows[4:7]], [rows[3], rows[7]], None)


def one_way(first: str, second: str) -> Tableau:
    """Two methods of which the second does not see the first."""
    methods = [method(first), method(second)]
    return gark(methods, {(0, 1): collocation(*methods)})


def without_cycles() -> Tableau:
    """Colour 1 sees colour 2, which sees nothing: no admissible tree has more than one level of
    branches.
    """
    upper, lower = method("gauss 3"), method("gauss 2")
    full = gark([upper, lower], {(0, 1): collocation(upper, lower)})
    return replace(full, blocks={(0, 1): full.blocks[0, 1]})


def _named() -> Iterator[tuple[str, Callable[[], Tableau]]]:
    for name in ("rk4", "kutta", "heun", "explicit-euler", "ssp2 4"):
        yield name, lambda name=name: gark([method(name)], {})  # type: ignore[misc]
    for name in (
        "gauss 3",
        "radau-ia 3",
        "radau-iia 3",
        "lobatto-iiia 4",
        "lobatto-iiib 4",
        "lobatto-iiic* 3",
    ):
        yield name, lambda name=name: gark([method(name)], {})  # type: ignore[misc]
    for rule in RULES:
        for names in (
            ("gauss 2", "lobatto-iiia 3"),
            ("radau-iia 2", "gauss 2"),
            ("lobatto-iiic 3", "radau-ia 2"),
        ):
            yield (
                f"{rule} of {', '.join(names)}",
                lambda rule=rule, names=names: everywhere(RULES[rule], *names),
            )  # type: ignore[misc]
    yield (
        "a mixture",
        lambda: everywhere(mixture("1/3", "1/2", "-1/5", "11/30"), "gauss 2", "lobatto-iiia 3"),
    )
    yield (
        "a mixture over Q(sqrt(5))",
        lambda: everywhere(mixture("sqrt(5)", "1 - sqrt(5)", "0", "0"), "gauss 2", "radau-iia 2"),
    )
    yield (
        "an inconsistent mixture",
        lambda: everywhere(mixture("1", "1", "0", "0"), "gauss 2", "lobatto-iiia 3"),
    )
    yield (
        "three methods",
        lambda: everywhere(collocation, "gauss 2", "lobatto-iiia 2", "radau-iia 2"),
    )
    yield ("pair, collocation", lambda: pair(everywhere(collocation, "gauss 2", "lobatto-iiia 3")))
    yield (
        "pair, interpolation",
        lambda: pair(everywhere(interpolation, "gauss 2", "lobatto-iiia 3")),
    )
    yield (
        "pair of lower order",
        lambda: pair(everywhere(collocation, "gauss 2", "lobatto-iiia 4")),
    )
    yield (
        "pair by conjugates",
        lambda: pair(by_conjugates(collocation, "gauss 2", "lobatto-iiia 4")),
    )
    yield "pair of Radau", lambda: pair(gark([method("radau-iia 2")], {}))
    yield (
        "pair of three",
        lambda: pair(everywhere(collocation, "gauss 1", "lobatto-iiia 2", "gauss 2")),
    )
    for name, velocities, forces in (
        ("semi-separable", [0], [0, 1]),
        ("separable", [0], [1]),
        ("separable, exchanged", [1], [0]),
    ):
        yield (
            name,
            lambda velocities=velocities, forces=forces: symplectic_pair(  # type: ignore[misc]
                everywhere(collocation, "gauss 2", "lobatto-iiia 4"), velocities, forces
            ),
        )
    yield (
        "nystrom",
        lambda: with_linear(
            symplectic_pair(everywhere(collocation, "gauss 2", "lobatto-iiia 3"), [0], [1]), ["V1"]
        ),
    )
    yield ("linear", lambda: with_linear(gark([method("radau-iia 2")], {}), ["1"]))
    yield (
        "one linear of two",
        lambda: with_linear(everywhere(interpolation, "gauss 2", "radau-iia 2"), ["2"]),
    )
    yield "rectangular", rectangular
    yield (
        "partitioned Lobatto",
        lambda: partitioned(method("lobatto-iiia 3"), method("lobatto-iiib 3")),
    )
    yield "IMEX over Q(sqrt(2))", implicit_explicit
    yield "one way", lambda: one_way("gauss 2", "radau-iia 2")
    yield "order 0", lambda: runge_kutta("0, 0", "1, 0", "1/2, 1/3")
    yield "order 1", lambda: runge_kutta("0, 0", "1, 0", "1/3, 2/3")
    yield ("over Q(cbrt(2))", lambda: runge_kutta("0, 0", "cbrt(2), 0", "1 - cbrt(4)/4, cbrt(4)/4"))


NAMED: Mapping[str, Callable[[], Tableau]] = dict(_named())
"""Makers of tableaus with an order that ends."""


def small(dice: Random) -> fmpq:
    """A small rational number."""
    return fmpq(dice.randint(-4, 4), dice.choice([1, 2, 3, 4, 6]))


def random_graph(dice: Random) -> Tableau:
    """Colours with one to three stages, absent edges, linear colours; the weights of each sum to 1.

    In half of them all rows have the sums that order 2 asks for, so that interesting orders occur.
    """
    colours = dice.randint(1, 3)
    stages = [dice.randint(1, 3) for _ in range(colours)]
    is_good = dice.random() < 0.5
    nodes = [[small(dice) for _ in range(s)] for s in stages]
    b = [_normalised([small(dice) for _ in range(s)], fmpq(1)) for s in stages]
    if is_good:
        for l, s in enumerate(stages):
            *_, last = nodes[l]
            shortfall = fmpq(1, 2) - sum(
                (x * y for x, y in zip(b[l], nodes[l], strict=True)), fmpq(0)
            )
            nodes[l][-1] = last + shortfall / b[l][-1] if b[l][-1] else last
            assert len(nodes[l]) == s

    def block(l: int, m: int) -> Matrix | None:
        if dice.random() < 0.25:
            return None
        rows = [[small(dice) for _ in range(stages[m])] for _ in range(stages[l])]
        if is_good:
            rows = [_normalised(row, c) for row, c in zip(rows, nodes[l], strict=True)]
        return tuple(tuple(row) for row in rows)

    A = [[block(l, m) for m in range(colours)] for l in range(colours)]
    linear = [l for l in range(colours) if dice.random() < 0.2]
    return spelled_out(A, [tuple(row) for row in b], [tuple(row) for row in nodes], linear)


def _normalised(row: Sequence[fmpq], total: fmpq) -> list[fmpq]:
    """The row with its last entry changed so that it sums to ``total``."""
    return [*row[:-1], total - sum(row[:-1], fmpq(0))]


def random_additive(dice: Random) -> Tableau:
    """Two matrices over one set of stages, the first explicit, with equal row sums and weights of
    order 2.
    """
    s = 3
    c = [fmpq(0), fmpq(1, 2) + small(dice) / 7, fmpq(1)]
    b_1 = small(dice)
    b_2 = (fmpq(1, 2) - (1 - b_1)) / (c[1] - 1)
    b = (b_1, b_2, 1 - b_1 - b_2)
    E = tuple(
        tuple(row) + (fmpq(0),) * (s - len(row))
        for row in ([], [c[1]], _normalised([small(dice), fmpq(0)], c[2]))
    )
    M = tuple(tuple(_normalised([small(dice) for _ in range(s)], c[i])) for i in range(s))
    return additive([E, M], [b, b], tuple(c))


def random_partitioned(dice: Random) -> Tableau:
    """A partitioned method for q̇ = V(p), ṗ = F(q) with rectangular blocks."""
    s_v, s_f = dice.randint(1, 3), dice.randint(1, 3)
    b_q = tuple(_normalised([small(dice) for _ in range(s_v)], fmpq(1)))
    b_p = tuple(_normalised([small(dice) for _ in range(s_f)], fmpq(dice.choice([1, 1, 2]))))
    A_q = [[small(dice) for _ in range(s_v)] for _ in range(s_f)]
    A_p = [[small(dice) for _ in range(s_f)] for _ in range(s_v)]
    for b, A in ((b_p, A_q), (b_q, A_p)):
        if b[-1]:  # the last row such that order 2 holds
            others = sum(
                (x * sum(row, fmpq(0)) for x, row in zip(b[:-1], A[:-1], strict=True)), fmpq(0)
            )
            A[-1] = _normalised(A[-1], (fmpq(1, 2) - others) / b[-1])
    return separable_prk((tuple(map(tuple, A_q)), b_q, None), (tuple(map(tuple, A_p)), b_p, None))


def renumbered(tableau: Tableau, permutation: Sequence[int]) -> Tableau:
    """The colours in another order; colour k is what ``permutation[k]`` was."""
    colours = tuple(tableau.colours[k] for k in permutation)
    place = {old: new for new, old in enumerate(permutation)}
    return Tableau(
        tableau.spaces, colours, {(k, place[m]): block for (k, m), block in tableau.blocks.items()}
    )


def with_permuted_stages(tableau: Tableau, dice: Random) -> Tableau:
    """The stages of each space in another order; spaces must be of points."""
    orders = [dice.sample(range(space.stages), space.stages) for space in tableau.spaces]

    def moved(v: Vector, k: int) -> Vector:
        return tuple(v[i] for i in orders[k])

    rows = [colour.space for colour in tableau.colours]
    blocks = {
        (k, m): tuple(moved(block[i], rows[m]) for i in orders[k])
        for (k, m), block in tableau.blocks.items()
    }
    colours = tuple(
        replace(x, b=moved(x.b, x.space), c=moved(x.c, x.space)) for x in tableau.colours
    )
    spaces = tuple(PointSpace(moved(space.nodes, k)) for k, space in enumerate(tableau.spaces))
    return Tableau(spaces, colours, blocks)


def perturbed(tableau: Tableau, dice: Random) -> Tableau:
    """One entry of a block or of the weights changed."""
    if dice.random() < 0.2:
        change = _small_change(dice)
        l = dice.randrange(tableau.size)
        colour: Colour = tableau.colours[l]
        j = dice.randrange(len(colour.b))
        b = tuple(x + change * int(k == j) for k, x in enumerate(colour.b))
        colours = (*tableau.colours[:l], replace(colour, b=b), *tableau.colours[l + 1 :])
        return replace(tableau, colours=colours)
    return with_perturbed_block(tableau, dice)


def with_perturbed_block(tableau: Tableau, dice: Random) -> Tableau:
    """One entry of a block changed."""
    change = _small_change(dice)
    edge = dice.choice(sorted(tableau.blocks))
    block = tableau.blocks[edge]
    i, j = dice.randrange(len(block)), dice.randrange(len(block[0]))
    new = tuple(
        tuple(x + change * int((r, k) == (i, j)) for k, x in enumerate(row))
        for r, row in enumerate(block)
    )
    return replace(tableau, blocks={**tableau.blocks, edge: new})


def _small_change(dice: Random) -> fmpq:
    return fmpq(dice.choice([-1, 1]), dice.randint(2, 9))


def with_an_edge_less(tableau: Tableau, dice: Random) -> Tableau:
    """One block taken away: fewer trees are admissible."""
    gone = dice.choice(sorted(tableau.blocks))
    return replace(
        tableau, blocks={edge: block for edge, block in tableau.blocks.items() if edge != gone}
    )


def with_linear_colour(tableau: Tableau, dice: Random) -> Tableau:
    """One colour made linear."""
    return with_linear(tableau, [dice.choice(tableau.colours).name])


def changed(dice: Random) -> Tableau:
    """A named tableau of one or two methods with random weights of the rules, and a few random
    changes of it.
    """
    names = dice.choice(
        [
            ("gauss 2", "lobatto-iiia 3"),
            ("gauss 2", "radau-iia 2"),
            ("lobatto-iiia 2", "gauss 1"),
            ("gauss 2",),
        ]
    )
    weights = [small(dice) for _ in range(3)]
    rule = mixture(*(str(x) for x in (*weights, 1 - sum(weights, fmpq(0)))))
    tableau = everywhere(rule, *names)
    if dice.random() < 0.3 and len(names) == 1:
        tableau = pair(tableau)
    tableau = renumbered(tableau, dice.sample(range(tableau.size), tableau.size))
    for change in (perturbed, with_an_edge_less, with_linear_colour):
        if tableau.blocks and dice.random() < 0.4:
            tableau = change(tableau, dice)
    return tableau
