"""Classes of equivalent order conditions of symplectic methods: counted, listed, and equivalent
indeed.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest
from flint import fmpq

from garkcli.exact.matrix import Matrix, add, scale
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.ntrees.count import count_trees
from garkcli.ntrees.free import Structure
from garkcli.ntrees.kind import PLAIN
from garkcli.ntrees.notation import format_tree, parse_tree
from garkcli.ntrees.symplectic import (
    KINDS,
    ConditionClass,
    Kind,
    count_classes,
    independent_classes,
    structure_of,
    superfluous_classes,
)
from garkcli.ntrees.table import TreeTable
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import coupling_graph, elementary_weight
from garkcli.order.conditions import Condition, conditions
from garkcli.order.simplifying import is_symplectic
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import gark, pair, spelled_out, symplectic_pair, with_linear
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation
from tests.whole import in_whole

LISTED: list[tuple[Structure, int]] = [
    (structure_of("pair", 1), 7),
    (structure_of("pair", 2), 5),
    (structure_of("pair", 3), 3),
    (structure_of("self-conjugate", 1), 10),
    (structure_of("self-conjugate", 2), 6),
    (structure_of("self-conjugate", 3), 5),
    (structure_of("semi-separable"), 6),
    (structure_of("separable"), 9),
    (structure_of("nystrom"), 10),
    (Structure.pair([0], [0], quadratic=[0]), 6),
    (Structure.pair([0], [1], quadratic=[0, 1]), 6),
    (Structure.pair([0, 1], [0, 2]), 5),
    (Structure(((3, "p"), (3, "q"), (1, "p")), frozenset([3])), 6),
    (Structure(((0, "y"), (1, "y")), frozenset([1])), 6),
]
"""Structures, named and not, with the order up to which all their classes are listed in a
moment.
"""

listed = pytest.mark.parametrize(("kind", "highest"), LISTED)


def classes(kind: Structure, order: int) -> list[ConditionClass]:
    """All classes of one order, the superfluous ones last."""
    return [*independent_classes(kind, order), *superfluous_classes(kind, order)]


def random_method(kind: Kind, colours: int, seed: int) -> Tableau:
    """A symplectic method with random rational coefficients and 1 to 3 stages for each term."""
    dice = Random(seed)
    s = [dice.randint(1, 3) for _ in range(colours)]

    def number() -> fmpq:
        return fmpq(dice.choice([-3, -2, -1, 1, 2, 3]), dice.randint(1, 4))

    def block(rows: int, columns: int) -> Matrix:
        return tuple(tuple(number() for _ in range(columns)) for _ in range(rows))

    free = spelled_out(
        [[block(r, k) for k in s] for r in s], [block(1, k)[0] for k in s], [None] * colours
    )
    if kind == "pair":
        return pair(free)
    if kind == "self-conjugate":
        other = conjugate(free).blocks
        means = {edge: scale(fmpq(1, 2), add(A, other[edge])) for edge, A in free.blocks.items()}
        return replace(free, blocks=means)
    if kind == "semi-separable":
        return symplectic_pair(free, [0], [0, 1])
    split = symplectic_pair(free, [0], [1])
    return with_linear(split, ["V1"]) if kind == "nystrom" else split


@pytest.mark.parametrize(
    ("kind", "counts"),
    [
        (structure_of("pair", 1), [1, 1, 3, 8, 27, 91, 350, 1376, 5743, 24635]),
        (
            structure_of("separable"),
            [2, 1, 2, 3, 6, 10, 22, 42, 94, 203, 470, 1082, 2602, 6270, 15482],
        ),
        (structure_of("self-conjugate", 1), [1, 0, 1, 1, 3, 4, 11, 19, 47]),
        (structure_of("pair", 2), [2, 4, 20, 104, 662, 4544]),
        (structure_of("self-conjugate", 2), [2, 1, 6, 14, 54, 175]),
        (structure_of("self-conjugate", 3), [3, 3, 18, 66, 342, 1728]),
        (structure_of("semi-separable"), [2, 2, 7, 23, 95, 406]),
        (structure_of("nystrom"), [2, 1, 2, 2, 4, 5, 10, 14, 27, 43]),
    ],
)
def test_counts(kind: Structure, counts: list[int]) -> None:
    """Oriented trees (OEIS A000238), bicoloured trees (A122086), and the numbers of symplectic RK,
    for a start.
    """
    assert [count_classes(kind, n) for n in range(1, len(counts) + 1)] == counts


def test_the_documented_counts() -> None:
    """The table of counts in the documentation is what is counted, with a row for each kind."""
    text = (Path(__file__).parents[2] / "docs" / "symplectic-conditions.md").read_text(
        encoding="utf-8"
    )
    rows = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in text.splitlines()
        if line[:1] == "|"
    ]
    counts = [row for row in rows if row[0] in KINDS and len(row) == 10]
    assert {row[0] for row in counts} == set(KINDS)
    for kind in KINDS:
        for colours, *shown in (map(int, row[1:]) for row in counts if row[0] == kind):
            assert shown == [count_classes(structure_of(kind, colours), n) for n in range(1, 9)]


@listed
def test_counted_is_listed(kind: Structure, highest: int) -> None:
    """Otter's formula and the listing by centroids agree, and the listing is sorted without
    repeats.
    """
    for order in range(1, highest + 1):
        centred = [c.centred for c in independent_classes(kind, order)]
        assert len(centred) == count_classes(kind, order)
        assert centred == sorted(set(centred), key=Tree.sort_key)


def test_counts_of_high_order() -> None:
    """Order 60, exactly: bicoloured free trees are those of one colour twice, less the symmetric
    ones.
    """
    separable, one = (structure_of("separable"), structure_of("self-conjugate", 1))
    for n in range(2, 61):
        symmetric = 0 if n % 2 else count_trees(1, n // 2)
        assert count_classes(separable, n) == 2 * count_classes(one, n) + symmetric


@listed
def test_members_partition_the_trees(kind: Structure, highest: int) -> None:
    """Every tree with a condition is in exactly one class, independent or superfluous, and no other
    tree is.
    """
    table = TreeTable.of(kind.admissible, highest)
    for order in range(1, highest + 1):
        members = [u for c in classes(kind, order) for u in c.members]
        assert sorted(members, key=Tree.sort_key) == [table.tree(i) for i in table.ids(order)]


@listed
def test_class_of_a_tree(kind: Structure, highest: int) -> None:
    """From any member the class is found again, with its representative among the members."""
    for c in classes(kind, min(highest, 5)):
        assert c.representative in c.members
        assert all(kind.centred(u) == c.centred and u.order == c.order for u in c.members)


@listed
def test_superfluous_is_said(kind: Structure, highest: int) -> None:
    """The superfluous classes say so, the independent ones do not, and a pair has no superfluous
    ones.
    """
    for order in range(1, highest + 1):
        assert not any(c.is_superfluous for c in independent_classes(kind, order))
        superfluous = list(superfluous_classes(kind, order))
        assert all(c.is_superfluous for c in superfluous)
        assert not (superfluous and kind.is_directed)


def test_superfluous_by_hand() -> None:
    """With one colour the superfluous trees of order 4 are the two rootings of the path."""
    (path,) = superfluous_classes(structure_of("self-conjugate", 1), 4)
    assert [format_tree(u, colours=False) for u in path.members] == ["[[[]],[]]", "[[[[]]]]"]


def test_a_class_by_hand() -> None:
    """For N = 1, bᵀ(Â𝟙 ⊙ Â𝟙) and bᵀAÂ𝟙 are one condition, with either colour of the root."""
    pair = structure_of("pair", 1)
    c = ConditionClass(pair.centred(parse_tree("[[[]_2]_1]_1")), pair)
    written = [format_tree(u) for u in c.members]
    assert written == ["[[]_2,[]_2]_1", "[[[]_2]_1]_1", "[[]_2,[]_2]_2", "[[[]_2]_1]_2"]
    assert format_tree(c.representative) == "[[]_2,[]_2]_1"


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(3))
def test_the_structure_is_that_of_the_tableau(kind: Kind, seed: int) -> None:
    """The trees that a symplectic tableau admits are those of its structure, which its colours
    tell.
    """
    tableau = random_method(kind, 2, seed)
    admissible = structure_of(kind).admissible
    assert is_symplectic(tableau)
    assert admissible == coupling_graph(tableau)
    quadratic = frozenset(colour.space for colour in tableau.colours if colour.is_linear)
    told = Structure(tuple((colour.space, colour.part) for colour in tableau.colours), quadratic)
    assert told.admissible == admissible
    assert count_classes(told, 6) == count_classes(structure_of(kind), 6)


@pytest.mark.parametrize(
    ("kind", "colours", "order"),
    [
        ("pair", 1, 5),
        ("pair", 2, 3),
        ("self-conjugate", 1, 7),
        ("self-conjugate", 2, 4),
        ("self-conjugate", 3, 3),
        ("semi-separable", 2, 4),
        ("separable", 2, 6),
        ("nystrom", 2, 7),
    ],
)
@pytest.mark.parametrize("seed", range(2))
def test_moving_the_root(kind: Kind, colours: int, order: int, seed: int) -> None:
    """Φ(u∘v) + Φ(v∘u) = Φ(u) Φ(v), exactly, for every edge of every tree and random methods; 1/γ
    does the same.

    A linear vector field is as good as any other here: the identity is one of the coefficients.
    """
    formal = replace(structure_of(kind, colours), quadratic=frozenset())
    method = random_method(kind, colours, seed)
    method = replace(
        method, colours=tuple(replace(colour, kind=PLAIN) for colour in method.colours)
    )
    for tree in (u for n in range(2, order + 1) for c in classes(formal, n) for u in c.members):
        for index, v in enumerate(tree.branches):
            u = Tree(tree.root, tree.branches[:index] + tree.branches[index + 1 :])
            moved = formal.move_root(tree, index)
            values = [elementary_weight(method, x) for x in (tree, moved, u, v)]
            assert values[0] + values[1] == values[2] * values[3]
            assert fmpq(1, tree.density) + fmpq(1, moved.density) == fmpq(1, u.density * v.density)


def lobatto_pair() -> Tableau:
    """Lobatto IIIA and IIIB of three stages, of order 4."""
    return pair(gark([diagonal_method("lobatto-iiia", 3)], {}))


def mixed(velocities: list[int], forces: list[int]) -> Tableau:
    """Gauss 2 and Lobatto IIIA 3 with collocation between them, of order 4."""
    methods = [diagonal_method("gauss", 2), diagonal_method("lobatto-iiia", 3)]
    blocks = {(0, 1): collocation(*methods), (1, 0): collocation(*reversed(methods))}
    return symplectic_pair(gark(methods, blocks), velocities, forces)


@pytest.mark.parametrize(
    ("kind", "colours", "make", "order"),
    [
        ("pair", 1, lobatto_pair, 4),
        pytest.param("pair", 2, lambda: mixed([0, 1], [0, 1]), 4, marks=in_whole),
        ("semi-separable", 2, lambda: mixed([0], [0, 1]), 4),
        ("separable", 2, lambda: mixed([0], [1]), 4),
        ("nystrom", 2, lambda: with_linear(mixed([0], [1]), ["V1"]), 4),
        ("self-conjugate", 1, lambda: gark([diagonal_method("gauss", 2)], {}), 4),
        ("self-conjugate", 1, lambda: gark([diagonal_method("gauss", 1)], {}), 2),
    ],
)
def test_members_fail_together(
    kind: Kind, colours: int, make: Callable[[], Tableau], order: int
) -> None:
    """At the first order that fails, the residuals of a class are equal but for the sign, some are
    not zero.

    There the lower conditions hold, so nothing but the class decides; up to that order all
    residuals are zero.
    """
    method = make()

    def check(c: ConditionClass) -> list[Condition]:
        found = list(conditions(method, c.members))
        assert len({x.residual**2 for x in found}) == 1
        assert c.order > order or all(x.holds for x in found)
        return found

    made = structure_of(kind, colours)
    checked = [check(c) for n in range(1, order + 2) for c in classes(made, n)]
    assert not all(x.holds for found in checked for x in found)


def test_superfluous_conditions_hold() -> None:
    """For u∘u to hold the condition of u is enough: the midpoint rule, of order 2, has that of
    order 4.
    """
    midpoint = gark([diagonal_method("gauss", 1)], {})
    made = structure_of("self-conjugate", 1)
    (path,) = superfluous_classes(made, 4)
    assert Condition(path.centred, elementary_weight(midpoint, path.centred)).holds
    (star,) = independent_classes(made, 4)
    assert not any(x.holds for x in conditions(midpoint, star.members))


@pytest.mark.parametrize(
    "ask",
    [
        lambda: structure_of("pair", 0),
        lambda: structure_of("self-conjugate", 0),
        lambda: structure_of("separable", 3),
        lambda: Structure(((0, "q"), (0, "q"))),
        lambda: Structure(((0, "q"), (1, "y"))),
        lambda: count_classes(structure_of("pair", 1), 0),
        lambda: next(independent_classes(structure_of("pair", 1), 0)),
        lambda: next(superfluous_classes(structure_of("self-conjugate", 1), 0)),
        lambda: structure_of("separable").move_root(Tree(0, [Tree(0)]), 0),
    ],
)
def test_senseless_questions_are_refused(ask: Callable[[], object]) -> None:
    """No terms, mixed parts, order 0, a root that cannot move: each a ValueError."""
    with pytest.raises(ValueError, match=r"."):
        ask()
