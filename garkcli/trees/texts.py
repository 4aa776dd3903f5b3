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
        return [
            self._closed(inside[0], root)
            for inside, root in zip(insides, trees.root.tolist(), strict=True)
        ]

    def _remember(self, ids: Column) -> None:
        """Make the insides of these trees and of all their ancestors, the smaller first."""
        columns = self.columns
        wanted = generation = np.unique(ids)
        while len(generation):
            parents = np.concatenate(
                [columns.stem[generation], columns.branch[generation]]
            )
            generation = np.unique(parents[parents >= 0])
            wanted = np.union1d(wanted, generation)
        missing = np.array(
            [u for u in wanted.tolist() if u not in self._insides], np.int64
        )
        for order in np.unique(columns.order[missing]):
            ids = missing[columns.order[missing] == order]
            self._insides.update(
                zip(ids.tolist(), self._of_children(columns.part(ids)), strict=True)
            )

    def _of_children(self, trees: Columns) -> list[Inside]:
        insides, root, order = self._insides, self.columns.root, self.columns.order
        made = []
        for stem, branch in zip(
            trees.stem.tolist(), trees.branch.tolist(), strict=True
        ):
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
