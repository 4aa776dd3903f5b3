"""Conditions of compositions of flows by Lyndon words, beside those of all trees."""

from __future__ import annotations

from itertools import chain, product
from typing import Any

import pytest
import sympy
from flint import arb, ctx, fmpq_mpoly

from garkcli import loads_family
from garkcli.design.conditions import FamilyConditions
from garkcli.design.search.flows import flows_of, lyndon_words
from garkcli.design.search.points import Fixings, balls, largest_residual
from garkcli.design.search.residuals import Residuals
from garkcli.design.search.search import Search
from garkcli.exact.parametric import fraction
from garkcli.frozen import replace
from garkcli.ntrees.kind import VertexKind
from tests.design.test_search import finished

TINY = arb(10) ** -20


@pytest.mark.parametrize(("orders", "most"), [((1, 1), 6), ((1, 3, 5), 9), ((1, 2, 3), 7)])
def test_words_are_those_of_the_definition(orders: tuple[int, ...], most: int) -> None:
    words = [
        word
        for length in range(1, most + 1)
        for word in product(range(len(orders)), repeat=length)
        if sum(orders[n] for n in word) <= most and all(word < word[k:] for k in range(1, length))
    ]
    assert sorted(lyndon_words(orders, most)) == sorted(words)


@pytest.mark.parametrize(
    ("shape", "stages", "order", "count"),
    [
        ("symplectic-dirk", 2, 3, 2),
        ("symplectic-dirk", 3, 4, 3),
        ("[symplectic-dirk, palindromic]", 5, 4, 2),
        ("splitting", 3, 3, 5),
        ("[splitting, palindromic]", 5, 4, 4),
    ],
)
def test_ideal_of_all_trees(shape: str, stages: int, order: int, count: int) -> None:
    """The words generate the ideal of all trees, of this order and not of the next."""
    family = loads_family(f"unknown: {{stages: {stages}, shape: {shape}}}\n")
    flows = flows_of(family.tableau, order)
    assert flows is not None
    words = flows.conditions(order)
    assert len(words) == count

    ring, trees = family.ring, FamilyConditions(family.tableau, family.ring)
    conditions = [[x.polynomial for x in trees.of_order(k)] for k in range(1, order + 2)]

    def ideal(polynomials: list[fmpq_mpoly]) -> object:
        texts = [str(p).replace("^", "**") for p in polynomials if p]
        unknowns = [sympy.Symbol(name) for name in ring.names]
        return sympy.groebner(
            [*map(sympy.sympify, texts)], *unknowns, order="grevlex", domain="QQ"
        ).exprs

    generated = ideal([fraction(x, ring)[0] for x in words])
    assert generated == ideal([*chain.from_iterable(conditions[:order])])
    assert generated != ideal([*chain.from_iterable(conditions)])


def test_finds_satisfy_all_trees() -> None:
    """Compositions that are proved to exist have small residuals, and not in the next order."""
    family = loads_family("unknown: {stages: 9, shape: [symplectic-dirk, palindromic]}\n")
    finds = [x for x in finished(Search(family, 6), 12).methods if x.proof == "exists"]
    assert finds
    for find, top in product(finds, (6, 7)):
        residuals = Fixings(Residuals(family.tableau, family.ring, top))
        with ctx.workprec(200):
            point = balls([*find.values.values()])
            is_small = top == 6
            assert bool(largest_residual(residuals, point) < TINY) == is_small


MIDPOINTS = "parameters: {t: free}\nA: [[t/2, 0], [t, 1/2 - t/2]]\nb: [t, 1 - t]\n"


@pytest.mark.parametrize(
    ("old", "new"), [("1/2 - t/2", "1/2 - t/3"), ("t/2, 0", "t/2, t"), ("[[t/2", "[[t/3")]
)
def test_what_is_no_composition(old: str, new: str) -> None:
    """With one entry changed the conditions are those of trees."""
    assert flows_of(loads_family(MIDPOINTS).tableau, 3) is not None
    assert flows_of(loads_family(MIDPOINTS.replace(old, new)).tableau, 3) is None


@pytest.mark.parametrize("other", [{"late": 1}, {"kind": VertexKind(weight=2)}])
def test_other_vertices(other: dict[str, Any]) -> None:
    """Fields that integrate twice, or conditions one order later, are those of trees."""
    tableau = loads_family(MIDPOINTS).tableau
    colours = (replace(tableau.colours[0], **other),)
    assert flows_of(replace(tableau, colours=colours), 3) is None
