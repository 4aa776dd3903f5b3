"""Affine hulls for the proof assistant: ψ of every tree is in one, and they hold no more."""

from __future__ import annotations

import re
from itertools import chain

import pytest
from flint import fmpq

from garkcli import certificate, load, loads, trees
from garkcli.errors import MethodError
from garkcli.exact.field import coordinates
from garkcli.exact.matrix import Vector, apply
from garkcli.ntrees.tree import Tree
from garkcli.order.hulls import Hull, hulls
from garkcli.tableau.tableau import Tableau
from tests.whole import in_whole

METHODS = ["rk4", "gauss-2", "stoermer-verlet", "ars-222", "symplectic-gauss-lobatto4"]


def psi(tableau: Tableau, tree: Tree) -> Vector | None:
    """ψ of a tree by its definition; None where a block is missing."""
    space = tableau.space(tree.root)
    found = space.one
    for branch in tree.branches:
        below, block = psi(tableau, branch), tableau.block(tree.root, branch.root)
        if below is None or block is None:
            return None
        found = space.product(found, apply(block, [branch.order * x for x in below]))
    return found


def has(hull: Hull, point: list[fmpq]) -> bool:
    moved = list(hull.base)
    for pivot, row in hull.directions:
        moved = [x + point[pivot] * y for x, y in zip(moved, row, strict=True)]
    return moved == point


@pytest.mark.parametrize("name", METHODS)
def test_every_tree_is_in_its_hull(name: str) -> None:
    tableau = load(name).tableau
    order = 4
    found = hulls(tableau, order).trees
    seen: dict[tuple[int, int], list[list[fmpq]]] = {}
    sizes = range(1, order + 1)
    for tree in chain.from_iterable(trees(n, tableau.size) for n in sizes):
        value = psi(tableau, tree)
        if value is not None:
            point = list(chain.from_iterable(coordinates(x, tableau.degree) for x in value))
            seen.setdefault((tree.order - 1, tree.root), []).append(point)
    for k in range(order):
        for l in range(tableau.size):
            hull, points = found[k][l], seen.get((k, l), [])
            assert (hull is None) == (not points)
            if hull is not None:
                assert all(has(hull, point) for point in points)
                assert Hull.of(points) == hull


def test_points_span_their_hull() -> None:
    points = [[fmpq(1), fmpq(0), fmpq(2)], [fmpq(2), fmpq(1), fmpq(2)], [fmpq(3), fmpq(2), fmpq(2)]]
    hull = Hull.of(points)
    assert len(hull.directions) == 1
    assert all(has(hull, point) for point in points)
    assert not has(hull, [fmpq(1), fmpq(0), fmpq(3)])
    assert Hull.of(hull.points) == hull


LINEAR = "A: [[0, 0], [1/2, 1/2]]\nb: [0, 1]\nlinear: [1]\n"


def test_the_file_states_what_coq_has_to_prove() -> None:
    text = certificate(load("rk4"), format="coq")
    assert len(re.findall(r"^Theorem ", text, re.MULTILINE)) == 7
    assert "has_order the_method 4." in text
    assert "~ has_order the_pair 5." in text
    partitioned = certificate(load("stoermer-verlet"), format="coq")
    assert "is_conjugate" not in partitioned


@in_whole
def test_the_polynomial_of_theta_has_integer_coefficients_for_coq() -> None:
    """McLachlan and Atela's θ has denominators up to 6^24: the file takes 6θ."""
    text = certificate(load("mclachlan-atela-3"), format="coq")
    field = re.search(r"field := (\[.*\]);", text)
    assert field is not None
    assert "#" not in field[1]
    assert field[1].endswith("; (-468); 0]")  # 36 · 13, from −13 θ^22


def test_what_the_theory_does_not_know() -> None:
    with pytest.raises(MethodError, match="linear vector field"):
        certificate(loads(LINEAR), format="coq")
    with pytest.raises(MethodError, match="rounded"):
        certificate(loads("A: [[0.5]]\nb: [1]\ntolerance: 1e-3\n"), format="coq")
