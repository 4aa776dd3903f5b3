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
_VERTEX: Inside = ("", 0, 0)


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
        roots = trees.root.tolist()
        texts = []
        for made, root in zip(insides, roots, strict=True):
            inside, _, _ = made
            text = self._closed(inside, root)
            texts.append(text)
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
        known = self._insides
        unknown = [u for u in wanted.tolist() if u not in known]
        missing = np.array(unknown, np.int64)
        orders = columns.order[missing]
        for order in np.unique(orders):
            ids = missing[orders == order]
            made = self._of_children(columns.part(ids))
            named = zip(ids.tolist(), made, strict=True)
            self._insides.update(named)

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
                made.append(_VERTEX)
                continue
            inside, _, _ = insides[branch]
            text = self._closed(inside, int(root[branch]))
            size = int(order[branch])
            made.append(_inserted(insides[stem], text, size))
        return made

    def _closed(self, inside: str, root: int) -> str:
        if not self.colours:
            return f"[{inside}]"
        return f"[{inside}]_{root + 1}"


def _inserted(stem: Inside, text: str, order: int) -> Inside:
    """Put a branch where it is written: before all smaller ones, after those of its own order.

    A last branch is never smaller than the others, so that there are these two cases only.
    """
    inside, end, largest = stem
    length = len(text)
    if not inside:
        return text, length, order
    if order > largest:
        return f"{text},{inside}", length, order
    larger = inside[:end]
    smaller = inside[end:]
    joined = f"{larger},{text}{smaller}"
    return joined, end + 1 + length, largest
