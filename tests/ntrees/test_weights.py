"""Elementary weights of all trees in floating point."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from garkcli.ntrees import stage_vectors as module
from garkcli.ntrees.stage_vectors import elementary_weights
from garkcli.ntrees.table import TreeTable
from garkcli.ntrees.tree import Tree

if TYPE_CHECKING:
    from typing import TypeAlias

    from garkcli.arrays import Floats

    Blocks: TypeAlias = dict[tuple[int, int], Floats]


def stages(u: Tree, rows: list[int], blocks: Blocks, sizes: list[int]) -> Floats:
    """𝒜^[u] by its definition."""
    product = np.ones(sizes[u.root])
    for v in u.branches:
        product = product * (blocks[rows[u.root], v.root] @ stages(v, rows, blocks, sizes))
    return product


def method(seed: int, rows: list[int], sizes: list[int]) -> tuple[Blocks, list[Floats]]:
    """Random blocks and weights."""
    rng = np.random.default_rng(seed)
    size_of = dict(zip(rows, sizes, strict=True))
    blocks = {
        (space, m): rng.uniform(-1, 1, (size_of[space], sizes[m]))
        for space in set(rows)
        for m in range(len(rows))
    }
    return blocks, [rng.uniform(-1, 1, size) for size in sizes]


@given(st.integers(0, 2**32 - 1))
def test_weights_are_the_definition(seed: int) -> None:
    """Three colours, two of them with the same stages, rectangular blocks: every tree up to order
    5.
    """
    rows, sizes = [0, 1, 0], [2, 3, 2]
    blocks, b = method(seed, rows, sizes)
    table = TreeTable.upto(3, 4)
    expected = [
        b[u.root] @ stages(u, rows, blocks, sizes) for u in map(table.tree, range(len(table)))
    ]
    np.testing.assert_allclose(
        elementary_weights(table, rows, blocks, b), expected, rtol=1e-12, atol=1e-13
    )


def test_weights_of_admissible_trees(monkeypatch: pytest.MonkeyPatch) -> None:
    """With absent edges their blocks are not asked for; small chunks give the same values."""
    edges = [[False, True], [True, True]]
    blocks, b = method(1, [0, 1], [2, 3])
    table = TreeTable.upto(2, 7, edges, linear=[0])
    expected = [
        b[u.root] @ stages(u, [0, 1], blocks, [2, 3]) for u in map(table.tree, range(len(table)))
    ]
    del blocks[0, 0]
    monkeypatch.setattr(module, "CHUNK", 5)
    np.testing.assert_allclose(
        elementary_weights(table, [0, 1], blocks, b), expected, rtol=1e-12, atol=1e-14
    )


def test_the_order_of_gauss_2() -> None:
    """The two-stage Gauss method satisfies b^T 𝒜^[u] = 1/γ(u) up to order 4 and not for order 5."""
    root = np.sqrt(3) / 6
    a = np.array([[1 / 4, 1 / 4 - root], [1 / 4 + root, 1 / 4]])
    table = TreeTable.upto(1, 5)
    residual = elementary_weights(table, [0], {(0, 0): a}, [np.array([0.5, 0.5])]) - 1 / table.gamma
    assert abs(residual[table.order <= 4]).max() < 1e-15
    assert abs(residual[table.order == 5]).max() > 1e-4


@pytest.mark.parametrize(
    ("blocks", "b", "message"),
    [
        ({}, [np.ones(1)], "no block"),
        ({(0, 0): np.ones((1, 2))}, [np.ones(1)], "shape"),
        ({(0, 0): np.ones((1, 1))}, [], "as many"),
        ({(0, 0): np.ones((1, 1))}, [np.ones((1, 1))], "do not fit"),
    ],
)
def test_what_does_not_fit_is_refused(blocks: Blocks, b: list[Floats], message: str) -> None:
    """A missing block, a block or weights of the wrong shape are named."""
    with pytest.raises(ValueError, match=message):
        elementary_weights(TreeTable.upto(1, 3), [0], blocks, b)
