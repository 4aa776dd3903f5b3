"""The shape of a method: the simplifying and similar conditions that its digits suggest."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from garkcli import numpy_on_use as np
from garkcli.exact.display import to_float
from garkcli.ntrees.kind import ONE_BRANCH
from garkcli.ntrees.tree import Tree
from garkcli.order.bounded import compromise, scaled
from garkcli.order.place import BoxPlace, arithmetic
from garkcli.order.rows import Chosen, FormDefects, Label, may_vanish, of_tree
from garkcli.tableau.conjugate import are_opposite
from garkcli.tableau.tableau import Edge, Tableau

NATURAL = 1e-3
"""Conditions that rounding can change by more are ignored: many hold by chance."""
NOISE = 1e-3
"""Slopes of at most so many radii of their numbers are rounding errors of zeros."""
WEIGHTS = {"B": 100.0, "stiff": 10.0}
"""Weights in a compromise: orders need B, and a last row equal to b is seldom chance."""
SYMMETRIC = ("symmetric", "palindrome")
WHOLE = {"symplectic": ("symplectic",), **dict.fromkeys(SYMMETRIC, SYMMETRIC)}
"""Kinds of conditions that only make sense together."""


def candidates(origin: BoxPlace) -> Chosen:
    """The conditions that hold within the radii one by one, and not by chance."""
    defects = origin.defects("method")
    made = defects.tableau.made
    edges = list(made.edges())
    if not made.has_fields_alone:  # on linear problems they are Runge–Kutta methods
        edges = [(l, l) for l, colour in enumerate(made.colours) if colour.kind == ONE_BRANCH]
    chosen: Chosen = {}
    noise = NOISE * np.array([to_float(t) for t in origin.search.box.radii])

    def take(label: Label, alive: set[int]) -> set[int]:
        """The places that still hold; those that are significant are chosen."""
        forms = defects.of(label)
        holds = [i for i in sorted(alive) if may_vanish(forms, i)]
        is_natural = label.kind in WHOLE or (label.kind in "BC" and label.k == 1)
        says = [
            i
            for i in holds
            if is_natural or forms.reach[i] < NATURAL or not float(abs(forms.centres[i]))
        ]
        telling = [
            i
            for i in says
            if (abs(forms.slopes[i]) > noise).any() and np.isfinite(forms.remainders[i])
        ]
        if telling:
            chosen[label] = telling
        return set(says)

    with arithmetic(origin.search.bits):
        series: list[tuple[Label, int]] = []
        if made.has_fields_alone:
            series += [(Label("B", l), 1) for l in range(made.size)]
            series += [(Label("C", l, m), len(defects.tableau.b[l])) for l, m in edges]
            series += [(Label("D", l, m), len(defects.tableau.b[m])) for l, m in edges]
        for first, count in series:
            alive, k = set(range(count)), 0
            # of so many numbers quadrature of no more has all conditions
            sees = len(defects.tableau.b[first.m if first.kind == "C" else first.l])
            most = max(sees, count) if first.kind == "D" else 2 * sees
            while alive and k < most:
                k += 1
                alive = take(Label(first.kind, first.l, first.m, k), alive)
        labels = [
            label
            for label in _equalities(origin, edges)
            if all(may_vanish(defects.of(label), i) for i in _of_diagonal(label, defects))
        ]
        labels += [Label("damping", l, k=defects.degree(l)) for l, m in edges if l == m]
        if made.has_fields_alone:
            labels += [Label("node", l, k=k) for l in range(made.size) for k in (0, 1)]
        else:
            labels += [of_tree(u) for l, _ in edges for u in _tall(made, l)]
        for label in labels:
            take(label, set(range(len(defects.of(label)))))
        if not made.has_fields_alone:
            return chosen
        for whole in (_symplectic(defects), _symmetric(defects)):
            if all(
                may_vanish(forms, i) for forms in map(defects.of, whole) for i in range(len(forms))
            ):
                for label in whole:
                    take(label, set(range(len(defects.of(label)))))
    return chosen


def _equalities(origin: BoxPlace, edges: Sequence[Edge]) -> Iterator[Label]:
    printed = origin.exact("method")
    for l, m in edges:
        for i in range(len(printed.block(l, m) or ())):
            yield Label("stiff", l, m, i)
    for l in [l for l, m in edges if l == m]:
        block = printed.block(l, l)
        diagonal = [row[i] for i, row in enumerate(block or ())]
        first = next((i for i, x in enumerate(diagonal) if x), None)
        if first is not None and all(diagonal[first:]):
            yield Label("diagonal", l, l, first)


def _of_diagonal(label: Label, defects: FormDefects) -> range:
    """The places of an equality that have to hold: for a diagonal those of implicit stages."""
    return range(label.k if label.kind == "diagonal" else 0, len(defects.of(label)))


def _symplectic(defects: FormDefects) -> list[Label]:
    """Symplecticity row by row; empty if a block has no opposite."""
    made = defects.tableau.made
    labels = []
    for l, m in made.edges():
        if not are_opposite(made.colours[l], made.colours[m]):
            continue
        if made.block(m, l) is None:
            return []
        if l <= m:
            labels += [Label("symplectic", l, m, i) for i in range(len(defects.tableau.b[l]))]
    return labels


def _symmetric(defects: FormDefects) -> list[Label]:
    b = defects.tableau.b
    labels = [Label("palindrome", l) for l in range(len(b))]
    for l, m in defects.tableau.made.edges():
        labels += [Label("symmetric", l, m, i) for i in range((len(b[l]) + 1) // 2)]
    return labels


def _tall(tableau: Tableau, l: int) -> Iterator[Tree]:
    """The trees of linear problems: a leaf, and below it vertices of colour l with one branch."""
    term = tableau.colours[l].term
    tree = tableau.tree(next(m for m, x in enumerate(tableau.colours) if x.term == term))
    for _ in range(tableau.spaces[tableau.colours[l].space].stages):
        tree = tableau.tree(l, [tree])
        yield tree


def less(origin: BoxPlace, chosen: Chosen) -> Chosen:
    """The rows without the worst in a compromise, to first order, and those that build on it."""
    rows = origin.rows({"method": chosen})
    c, G, _ = scaled(rows)
    places = [(label, i) for label, which in chosen.items() for i in which]
    weights = np.array([WEIGHTS.get(label.kind, 1.0) for label, _ in places])
    miss = compromise(weights[:, None] * G, weights * c) / weights
    most = np.abs(miss).max()
    worst, place = places[int(np.argmax(np.abs(miss)))]
    label = min(
        (
            x
            for (x, i), off in zip(places, np.abs(miss), strict=True)
            if (x.kind, x.l, x.m, i) == (worst.kind, worst.l, worst.m, place) and off >= most / 10
        ),
        key=lambda x: x.k,
    )
    less: Chosen = {}
    for other, which in chosen.items():
        is_same = (other.kind, other.l, other.m) == (label.kind, label.l, label.m)
        kept = which
        if other.kind in WHOLE and label.kind in WHOLE[other.kind]:
            kept = []
        elif is_same and other.k >= label.k:
            kept = [i for i in which if i != place]
        if kept:
            less[other] = kept
    return less


def weak_rows(place: BoxPlace, k: int) -> list[Label]:
    """The conditions of weak stage order k, for words b A ⋯ A of each last colour. As many words as
    stages suffice: longer ones are combinations (Cayley-Hamilton).
    """
    made = place.defects("method").tableau.made
    edges = list(made.edges())
    stages = sum(space.stages for space in made.spaces)
    counts = dict.fromkeys(range(made.size), 0)
    waiting: list[tuple[int, ...]] = [(l,) for l in range(made.size)]
    labels: list[Label] = []
    for path in waiting:  # it grows
        l = path[-1]
        if counts[l] == stages:
            continue
        counts[l] += 1
        labels += [Label("weak", l, m, k, path=path) for p, m in edges if p == l]
        waiting += [(*path, m) for p, m in edges if p == l]
    return labels
