"""Directed graphs: strongly connected components."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping
from typing import TypeAlias, TypeVar

T = TypeVar("T", bound=Hashable)
Edges: TypeAlias = Mapping[T, Iterable[T]]
"""The successors of each vertex."""


def components(after: Edges[T]) -> list[list[T]]:
    """The strongly connected components of a graph, each before those that can be reached from it
    (Kosaraju).

    >>> components({1: [2], 2: [3, 1], 3: []})
    [[1, 2], [3]]
    """
    finished: list[T] = []
    seen: set[T] = set()
    for root in after:
        _visit(root, after, seen, finished.append)
    before: dict[T, list[T]] = {v: [] for v in after}
    for v, successors in after.items():
        for w in successors:
            before[w].append(v)
    found: list[list[T]] = []
    seen.clear()
    for root in reversed(finished):
        if root not in seen:
            component: list[T] = []
            _visit(root, before, seen, component.append)
            component.reverse()
            found.append(component)
    return found


def _visit(root: T, after: Edges[T], seen: set[T], finish: Callable[[T], None]) -> None:
    """Depth first from ``root``, without recursion; ``finish`` is called with each vertex after its
    successors.
    """
    if root in seen:
        return
    seen.add(root)
    path = [(root, iter(after[root]))]
    while path:
        vertex, successors = path[-1]
        for w in successors:
            if w not in seen:
                seen.add(w)
                path.append((w, iter(after[w])))
                break
        else:
            path.pop()
            finish(vertex)
