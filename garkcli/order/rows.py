"""Conditions on rounded methods as affine forms of the printed numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TypeAlias

from flint import arb, fmpq

from garkcli import numpy_on_use as np
from garkcli.exact.affine import UNIT, Forms
from garkcli.frozen import Frozen
from garkcli.ntrees.tree import Tree
from garkcli.tableau.box import FormTableau


class Label(Frozen):
    """A group of conditions: one kind, block or colour, and number.

    Attributes:
        kind: B, C, D, symplectic, symmetric, palindrome, node, stiff, diagonal, damping, weak or
            tree.
        m: a colour that ``l`` sees, for kinds of blocks.
        k: the number of a simplifying condition; the value of nodes; the stage of ``symplectic``,
            ``symmetric``, ``stiff`` and ``diagonal``; for ``damping`` the degree of the
            denominator; for a tree its required weight times γ(u), 1 or 0.
        path: the colours of a word b A ⋯ A, the last with the stages of l.
    """

    kind: str
    l: int
    m: int = 0
    k: int = 0
    tree: Tree | None = None
    path: tuple[int, ...] = ()


def of_tree(tree: Tree, share: int = 1) -> Label:
    return Label("tree", tree.root, k=share * tree.is_exact, tree=tree)


Chosen: TypeAlias = "dict[Label, list[int]]"
"""The indices of the rows that are chosen of each label."""
System: TypeAlias = "Mapping[str, Chosen]"
"""Rows by the name of their tableau."""


class FormDefects:
    def __init__(self, tableau: FormTableau) -> None:
        self.tableau = tableau
        self._powers = [[tableau.one(l)] for l in range(len(tableau.b))]
        self._images: dict[tuple[int, Tree], Forms] = {}
        self._known: dict[Label, Forms] = {}
        self._words: dict[tuple[int, ...], Forms] = {}

    def of(self, label: Label) -> Forms:
        if label not in self._known:
            self._known[label] = getattr(self, f"_{label.kind}")(label)
        return self._known[label]

    def rows(self, chosen: Chosen) -> Forms:
        return joined([part(self.of(label), which) for label, which in chosen.items()])

    def _power(self, l: int, k: int) -> Forms:
        powers = self._powers[l]
        while len(powers) <= k:
            powers.append(powers[-1] * self.tableau.c[l])
        return powers[k]

    def _B(self, x: Label) -> Forms:  # noqa: N802 -- the paper's letters
        found = self.tableau.b[x.l].dot(self._power(x.l, x.k - 1))
        return shifted(found, fmpq(1, x.k))

    def _C(self, x: Label) -> Forms:  # noqa: N802
        image = self.tableau.block(x.l, x.m).times(self._power(x.m, x.k - 1))
        return image.minus(self._power(x.l, x.k), fmpq(1, x.k))

    def _D(self, x: Label) -> Forms:  # noqa: N802
        b = self.tableau.b
        left = self.tableau.block(x.l, x.m).before(b[x.l] * self._power(x.l, x.k - 1))
        rest = b[x.m].minus(b[x.m] * self._power(x.m, x.k), fmpq(1))
        return left.minus(rest, fmpq(1, x.k))

    def _symplectic(self, x: Label) -> Forms:
        """b_i a_ij + b_j a_ji − b_i b_j for row i = k of the block (l, m)."""
        b = self.tableau.b
        b_i = repeated(b[x.l], x.k, len(b[x.m]))
        forth = b_i * self.tableau.block(x.l, x.m).row(x.k)
        back = b[x.m] * self.tableau.block(x.m, x.l).column(x.k)
        return forth.minus(b_i * b[x.m], fmpq(1)).minus(back, fmpq(-1))

    def _symmetric(self, x: Label) -> Forms:
        """a_kj + a_{s+1−k, s+1−j} − b_j for row k of the block (l, m)."""
        block = self.tableau.block(x.l, x.m)
        last = reverse(block.row(len(self.tableau.b[x.l]) - 1 - x.k))
        return block.row(x.k).minus(self.tableau.b[x.m], fmpq(1)).minus(last, fmpq(-1))

    def _palindrome(self, x: Label) -> Forms:
        """b_j − b_{s+1−j} for the first half of the weights."""
        b = self.tableau.b[x.l]
        return part(b.minus(reverse(b), fmpq(1)), range(len(b) // 2))

    def _node(self, x: Label) -> Forms:
        """The nodes minus k, which is 0 or 1."""
        return shifted(self.tableau.c[x.l], fmpq(x.k))

    def _stiff(self, x: Label) -> Forms:
        """a_kj^{l,m} − b_j^m."""
        return self.tableau.block(x.l, x.m).row(x.k).minus(self.tableau.b[x.m], fmpq(1))

    def _diagonal(self, x: Label) -> Forms:
        """a_ii^{l,l} minus the first nonzero one, at stage k."""
        block = self.tableau.block(x.l, x.l)
        entries = joined([part(block.row(i), [i]) for i in range(len(self.tableau.b[x.l]))])
        return entries.minus(repeated(entries, x.k, len(entries)), fmpq(1))

    def _weak(self, x: Label) -> Forms:
        """The form b A ⋯ A (A^{l,m} c^(k−1) − c^k / k)."""
        return self.word(x.path).dot(self.of(Label("C", x.l, x.m, x.k)))

    def word(self, path: tuple[int, ...]) -> Forms:
        """The functional b^{l} A^{l,m} ⋯ A^{n,p} of colours l, m, …, p."""
        if path not in self._words:
            if len(path) == 1:
                self._words[path] = self.tableau.b[path[0]]
            else:
                block = self.tableau.block(*path[-2:])
                self._words[path] = block.before(self.word(path[:-1]))
        return self._words[path]

    def _damping(self, x: Label) -> Forms:
        """The coefficients of z^k in the numerator of R of colour l, k at least the degree of the
        denominator: R(∞) = 0 if they vanish. Empty if all stages are explicit.
        """
        denominator, series = self._fraction(x.l)
        if not x.k:
            return part(series, [])
        return joined(
            [
                part(series, range(k + 1)).dot(part(denominator, range(k, -1, -1)))
                for k in range(x.k, len(denominator))
            ]
        )

    def degree(self, l: int) -> int:
        """The degree of the denominator of R of l alone, for all numbers of the box."""
        denominator, _ = self._fraction(l)
        return max(k for k in range(len(denominator)) if not may_vanish(denominator, k))

    def _fraction(self, l: int) -> tuple[Forms, Forms]:
        """Coefficients of det(I − zA) up to z^s, by Newton's identities, and of the series R."""
        block, stages = self.tableau.block(l, l), len(self.tableau.b[l])
        unit = part(self.tableau.one(l), [0])
        columns = [block.column(i) for i in range(stages)]
        vector = self.tableau.one(l)
        series, traces, coefficients = [unit], [], [unit]
        for k in range(1, stages + 1):
            series.append(self.tableau.b[l].dot(vector))
            vector = block.times(vector)
            diagonal = joined([part(column, [i]) for i, column in enumerate(columns)])
            traces.append(diagonal.dot(self.tableau.one(l)))
            columns = [block.times(column) for column in columns]
            total = joined(coefficients[::-1]).dot(joined(traces))
            coefficients.append(total.scaled(fmpq(-1, k)))
        return joined(coefficients), joined(series)

    def _tree(self, x: Label) -> Forms:
        """γ(u) b_lᵀ 𝒜^[u] − k."""
        assert x.tree is not None
        tree = x.tree
        weight = self.tableau.b[x.l].dot(self._vector(tree))
        return shifted(weight.scaled(fmpq(tree.density)), fmpq(x.k))

    def _vector(self, tree: Tree) -> Forms:
        vector = None
        for branch in tree.branches:
            image = self._image(tree.root, branch)
            vector = image if vector is None else vector * image
        return self.tableau.one(tree.root) if vector is None else vector

    def _image(self, l: int, branch: Tree) -> Forms:
        key = self.tableau.made.colours[l].space, branch
        if key not in self._images:
            self._images[key] = self.tableau.A[key[0], branch.root].times(self._vector(branch))
        return self._images[key]


def joined(rows: Sequence[Forms]) -> Forms:
    centres = [x for row in rows for x in row.centres]
    slopes = np.concatenate([row.slopes for row in rows])
    return Forms(centres, slopes, np.concatenate([row.remainders for row in rows]))


def part(forms: Forms, which: Sequence[int]) -> Forms:
    places = list(which)
    centres = [forms.centres[i] for i in places]
    return Forms(centres, forms.slopes[places], forms.remainders[places])


def reverse(forms: Forms) -> Forms:
    return part(forms, range(len(forms) - 1, -1, -1))


def repeated(forms: Forms, i: int, count: int) -> Forms:
    return part(forms, [i] * count)


def shifted(forms: Forms, number: fmpq) -> Forms:
    ball = arb(number)
    return Forms([x - ball for x in forms.centres], forms.slopes, forms.remainders)


def may_vanish(forms: Forms, i: int) -> bool:
    return not abs(forms.centres[i]) > float(forms.reach[i] + forms.remainders[i]) * (1 + UNIT)
