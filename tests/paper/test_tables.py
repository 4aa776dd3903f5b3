"""Each tableau that the paper prints, against what the engine makes of its construction."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from flint import fmpq

from garkcli.exact.matrix import Matrix
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import is_symplectic
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import pair, separable_prk, symplectic_pair
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import Rule, collocation, interpolation
from tests.oracles import samples
from tests.oracles.brute import brute_order
from tests.oracles.points import at_points
from tests.oracles.samples import everywhere
from tests.oracles.series import series_order
from tests.paper import tables

CORRECTED = tables.matrix(tables.COLLOCATION_AS_PRINTED, tables.COLLOCATION_MISPRINTS)
CORRECTED_CONJUGATE = tables.matrix(
    tables.COLLOCATION_CONJUGATE_AS_PRINTED, tables.CONJUGATE_MISPRINTS
)


def constructed(rule: Rule) -> Tableau:
    """Gauss 2 and Lobatto IIIA 3 with transfer matrices by ``rule``."""
    return everywhere(rule, "gauss 2", "lobatto-iiia 3")


def entries(tableau: Tableau) -> Matrix:
    """All blocks side by side, in the order of the colours."""
    rows = []
    for l in range(tableau.size):
        blocks = [tableau.block(l, m) for m in range(tableau.size)]
        for i in range(tableau.space(l).stages):
            row = tuple(x for block in blocks if block is not None for x in block[i])
            rows.append(row)
    return tuple(rows)


def spelled(tableau: Tableau) -> Tableau:
    """The tableau at the nodes of the paper."""
    return at_points(tableau, [tables.c_1, tables.c_2])


@pytest.mark.parametrize(
    ("rule", "printed", "printed_conjugate"),
    [
        (collocation, CORRECTED, CORRECTED_CONJUGATE),
        (
            interpolation,
            tables.matrix(tables.INTERPOLATION),
            tables.matrix(tables.INTERPOLATION_CONJUGATE),
        ),
    ],
    ids=["collocation", "interpolation"],
)
def test_examples_entry_by_entry(rule: Rule, printed: Matrix, printed_conjugate: Matrix) -> None:
    """A, Â, b and c of both examples are, entry by entry, what the paper prints, its misprints put
    right.
    """
    Q = constructed(rule)
    P = conjugate(Q)
    assert entries(spelled(Q)) == printed
    assert entries(spelled(P)) == printed_conjugate
    for tableau in (Q, P):
        assert [colour.b for colour in spelled(tableau).colours] == [tables.b_1, tables.b_2]
        assert [colour.c for colour in spelled(tableau).colours] == [tables.c_1, tables.c_2]


@pytest.mark.parametrize("rule", [collocation, interpolation])
def test_printing_agrees_with_the_definition(rule: Rule) -> None:
    """The engine's own entries are those of the definition (A L_j)(c_i), in its own field ℚ(√3)."""
    Q = constructed(rule)
    found = in_points(Q)
    assert found is not None
    assert [[str(x) for x in line] for line in entries(found)] == [
        [str(x) for x in line] for line in entries(spelled(Q))
    ]


@pytest.mark.parametrize("name", ["CORRECTED", "INTERPOLATION"])
def test_conjugates_of_spelled_out_entries(name: str) -> None:
    """Eq. (wAhat) applied to the printed numbers themselves gives the printed conjugates, and
    back.
    """
    Q, P = {
        "CORRECTED": (CORRECTED, CORRECTED_CONJUGATE),
        "INTERPOLATION": (
            tables.matrix(tables.INTERPOLATION),
            tables.matrix(tables.INTERPOLATION_CONJUGATE),
        ),
    }[name]
    assert entries(conjugate(tables.tableau(Q))) == P
    assert entries(conjugate(tables.tableau(P))) == Q


def test_the_misprints_are_all_the_differences() -> None:
    """The printed collocation example differs from its construction in those four and two entries
    only.
    """
    printed = tables.matrix(tables.COLLOCATION_AS_PRINTED)
    printed_conjugate = tables.matrix(tables.COLLOCATION_CONJUGATE_AS_PRINTED)
    Q = constructed(collocation)
    assert _differences(printed, entries(spelled(Q))) == set(tables.COLLOCATION_MISPRINTS)
    assert _differences(printed_conjugate, entries(spelled(conjugate(Q)))) == set(
        tables.CONJUGATE_MISPRINTS
    )


def _differences(one: Matrix, other: Matrix) -> set[tuple[int, int]]:
    places = ((i, j) for i in range(len(one)) for j in range(len(one[0])))
    return {(i + 1, j + 1) for i, j in places if one[i][j] != other[i][j]}


@pytest.mark.parametrize(
    "make",
    [
        pytest.param(lambda: tables.tableau(CORRECTED), id="collocation"),
        pytest.param(
            lambda: tables.tableau(tables.matrix(tables.INTERPOLATION)), id="interpolation"
        ),
        pytest.param(samples.rectangular, id="rectangular"),
    ],
)
def test_printed_methods_have_order_4(make: Callable[[], Tableau]) -> None:
    """The certificate, all trees and the power series say order 4 of the printed numbers, and no
    more.
    """
    tableau = make()
    assert find_order(tableau).order == 4
    assert brute_order(tableau, 5) == 4
    assert series_order(tableau, 5) == 4


@pytest.mark.parametrize("rule", [collocation, interpolation])
def test_conjugates_and_pairs_have_order_4(rule: Rule) -> None:
    """The conjugates of both examples, and the symplectic pairs of eq. (varGARK), have order 4 as
    well.
    """
    Q = constructed(rule)
    for tableau in (Q, conjugate(Q), pair(Q), spelled(Q), spelled(pair(Q))):
        assert find_order(tableau).order == 4
    assert brute_order(pair(Q), 5) == 4


def test_the_misprinted_collocation_example_has_order_2() -> None:
    """As printed, the rows of A^{1,2} do not sum to the nodes and two trees of three vertices
    fail.
    """
    wrong = tables.tableau(tables.matrix(tables.COLLOCATION_AS_PRINTED))
    assert tuple(sum(line[2:], fmpq(0)) for line in entries(wrong)[:2]) != tables.c_1
    assert tuple(sum(line[2:], fmpq(0)) for line in CORRECTED[:2]) == tables.c_1
    assert find_order(wrong).order == brute_order(wrong, 4) == series_order(wrong, 4) == 2
    witness = find_order(wrong).witness
    assert witness is not None
    assert witness.tree == Tree(0, [Tree(0, [Tree(1)])])
    assert (witness.value, witness.required) == (fmpq(35, 108), fmpq(1, 6))


def test_the_misprinted_conjugate_has_order_2() -> None:
    """As printed, the conjugate's last row of Â^{2,1} belongs to no conjugate and the order is
    2.
    """
    wrong = tables.tableau(tables.matrix(tables.COLLOCATION_CONJUGATE_AS_PRINTED))
    assert find_order(wrong).order == brute_order(wrong, 4) == series_order(wrong, 4) == 2
    assert entries(conjugate(tables.tableau(CORRECTED))) != entries(wrong)
    assert entries(conjugate(wrong)) != CORRECTED


def test_the_rectangular_method() -> None:
    """Eq. (rectangular) is A^{2,1} and Â^{1,2} of the collocation example, and symplectic."""
    Q, P = (tables.matrix(tables.RECTANGULAR_Q), tables.matrix(tables.RECTANGULAR_P))
    printed = separable_prk((Q, tables.b_1, tables.c_2), (P, tables.b_2, tables.c_1))
    made = spelled(symplectic_pair(constructed(collocation), [0], [1]))
    assert made.blocks == printed.blocks
    assert [(x.b, x.c) for x in made.colours] == [(x.b, x.c) for x in printed.colours]
    assert is_symplectic(printed)
    upside_down = separable_prk((Q, tables.b_1, tables.c_2), (P[::-1], tables.b_2, tables.c_1))
    assert not is_symplectic(upside_down)
