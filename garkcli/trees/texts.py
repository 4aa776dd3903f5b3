"""Bracket text of many trees of a table at once: each is its last branch put into the text of its
stem.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from garkcli.trees.columns import Column, Columns

Inside = tuple[str, int, int]
"""The text between a root's brackets, the offset where its largest branches end, and their
order.
"""


class Texts:
    """Makes text of trees and remembers the text of every tree that was a parent.

    ``columns`` are the trees of the table, ``colours`` whether colours are written.
    """

    def __init__(self, columns: Columns, colours: bool) -> None:
        self.columns = columns
        self.colours = colours
        self._insides: dict[int, Inside] = {}

    def of(self, trees: Columns) -> list[str]:
        """The text of trees whose parents are in the table, as ``format_tree`` writes it."""
        parents = np.concatenate([trees.stem, trees.branch])
        self._remember(parents[parents >= 0])
        insides = self._of_children(trees)
        texts = []
        for inside, root in zip(insides, trees.root.tolist(), strict=True):
            texts.append(self._closed(inside[0], root))
        return texts

    def _remember(self, ids: Column) -> None:
        """Make the insides of these trees and of all their ancestors, the smaller first."""
        columns = self.columns
        wanted = generation = np.unique(ids)
        while len(generation):
            stems = columns.stem[generation]
            branches = columns.branch[generation]
            parents = np.concatenate([stems, branches])
            generation = np.unique(parents[parents >= 0])
            wanted = np.union1d(wanted, generation)
        unknown = [u for u in wanted.tolist() if u not in self._insides]
        missing = np.array(unknown, np.int64)
        orders = columns.order[missing]
        for order in np.unique(orders):
            ids = missing[orders == order]
            made = self._of_children(columns.part(ids))
            self._insides.update(zip(ids.tolist(), made, strict=True))

    def _of_children(self, trees: Columns) -> list[Inside]:
        """The insides of trees whose parents' insides are known."""
        insides = self._insides
        root = self.columns.root
        order = self.columns.order
        stems = trees.stem.tolist()
        branches = trees.branch.tolist()
        made = []
        for stem, branch in zip(stems, branches, strict=True):
            if branch < 0:
                made.append(("", 0, 0))
            else:
                text = self._closed(insides[branch][0], int(root[branch]))
                made.append(_inserted(insides[stem], text, int(order[branch])))
        return made

    def _closed(self, inside: str, root: int) -> str:
        return f"[{inside}]_{root + 1}" if self.colours else f"[{inside}]"


def _inserted(stem: Inside, text: str, order: int) -> Inside:
    """Put a branch where it is written: before all smaller ones, after those of its own order.

    A last branch is never smaller than the others, so that there are these two cases only.
    """
    inside, end, largest = stem
    if not inside:
        return text, len(text), order
    if order > largest:
        return f"{text},{inside}", len(text), order
    return f"{inside[:end]},{text}{inside[end:]}", end + 1 + len(text), largest
