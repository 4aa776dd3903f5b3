"""The trees of one order in blocks, and those with given colours."""

from math import factorial

import numpy as np
import pytest

from garkcli.ntrees.blocks import Block, iter_blocks, select
from garkcli.ntrees.table import Columns, TreeTable
from garkcli.ntrees.tree import Tree
from tests.whole import at_most


def joined(blocks: list[Block]) -> list[list[int]]:
    """The columns of all blocks together, as lists."""
    parts = zip(*[block.columns.all() for block in blocks], strict=True)
    return [np.concatenate(part).tolist() for part in parts]


def columns_of(table: TreeTable, order: int) -> Columns:
    """The columns of one order of a table."""
    ids = table.ids(order)
    return table.columns.part(slice(ids.start, ids.stop))


@pytest.mark.parametrize("size", [1, 2, 7, 100, 10**6])
@pytest.mark.parametrize("linear", [(), (1,)])
def test_blocks_are_the_table(size: int, linear: tuple[int, ...]) -> None:
    """Blocks of any size follow each other to the whole order, column by column, and none is too
    large.
    """
    table = TreeTable.upto(2, at_most(6, 7), linear=linear)
    for order in (1, 2, 5, at_most(6, 7)):
        blocks = list(iter_blocks(2, order, size, linear=linear))
        assert all(0 < len(block) <= size for block in blocks)
        assert joined(blocks) == [column.tolist() for column in columns_of(table, order).all()]


def test_blocks_have_texts_and_trees() -> None:
    """The text and the trees of blocks are those of the table."""
    table = TreeTable.upto(3, 5)
    blocks = list(iter_blocks(3, 5, 50))
    assert [text for block in blocks for text in block.notation()] == table.notation(table.ids(5))
    assert [u for block in blocks for u in block.trees()] == [table.tree(i) for i in table.ids(5)]


def test_totals_without_the_whole_order() -> None:
    """Σ n!/(σ γ) of 4 colours and order 7 adds up block by block; σ and γ have their range."""
    total = 0
    for block in iter_blocks(4, 7, 10_000):
        total += int((factorial(7) // (block.columns.sigma * block.columns.gamma)).sum())
    assert total == 4**7 * factorial(6)


def test_blocks_beyond_64_bits() -> None:
    """The first order whose γ needs more than 64 bits is exact although all lower ones are
    int64.
    """
    edges, linear = [[True, True], [False, False]], [0]
    (block, *_) = iter_blocks(2, 21, edges=edges, linear=linear)
    assert block.lower.gamma.dtype == np.int64
    assert block.columns.gamma.tolist() == [u.density for u in block.trees()]
    assert block.columns.gamma.max() == factorial(21)


@pytest.mark.parametrize("order", [1, 2, 5])
@pytest.mark.parametrize("root", [None, 1])
@pytest.mark.parametrize("only", [None, (0, 1), (2,)])
@pytest.mark.parametrize("using", [(), (1,), (0, 2)])
def test_selection(
    order: int, root: int | None, only: tuple[int, ...] | None, using: tuple[int, ...]
) -> None:
    """Selecting is filtering: by root colour, by the colours allowed, by the colours that must
    occur.
    """
    table = TreeTable.upto(3, order)

    def wanted(u: Tree) -> bool:
        return (
            root in (None, u.root)
            and (only is None or u.colours <= set(only))
            and u.colours >= set(using)
        )

    chosen = select(3, order, root=root, only=only, using=using, block_size=64)
    expected = [u for u in map(table.tree, table.ids(order)) if wanted(u)]
    assert [u for block in chosen for u in block.trees()] == expected


def test_selection_refuses_unknown_colours() -> None:
    """A colour that does not exist is a mistake, not an empty answer."""
    with pytest.raises(ValueError, match="no colour 2"):
        next(select(2, 3, root=2))


def test_blocks_hold_something() -> None:
    """A block of no trees is refused."""
    with pytest.raises(ValueError, match="at least one tree"):
        next(iter_blocks(2, 3, 0))
