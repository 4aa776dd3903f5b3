"""Directed graphs: strongly connected components, one after the other."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable, Hashable, Iterable, Mapping
from heapq import heapify, heappop, heappush
from typing import TypeAlias, TypeVar

T = TypeVar("T", bound=Hashable)
Edges: TypeAlias = Mapping[T, Iterable[T]]
"""The successors of each vertex."""


def components(after: Edges[T]) -> list[list[T]]:
    """The strongly connected components of a graph, each before those reachable from it (Kosaraju).

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


def solving_order(needs: Edges[T], places: Mapping[T, int]) -> list[T]:
    """Every vertex after those that it needs; strongly connected ones stay together. Of ready
    vertices the smallest place comes first, equal ones in the given order.

    >>> needs = {"a": ["c"], "b": [], "c": ["d"], "d": ["c"]}
    >>> solving_order(needs, {vertex: number for number, vertex in enumerate(needs)})
    ['b', 'c', 'd', 'a']
    """
    rank = {vertex: (places[vertex], k) for k, vertex in enumerate(needs)}
    systems = [sorted(x, key=rank.__getitem__) for x in components(needs)]
    number = {vertex: k for k, system in enumerate(systems) for vertex in system}
    waits_for = [{number[w] for v in x for w in needs[v]} - {k} for k, x in enumerate(systems)]
    wanted_by = defaultdict(list)
    for k, others in enumerate(waits_for):
        for other in others:
            wanted_by[other].append(k)
    ready = [(places[x[0]], k) for k, x in enumerate(systems) if not waits_for[k]]
    heapify(ready)
    ordered: list[T] = []
    while ready:
        _, done = heappop(ready)
        ordered += systems[done]
        for k in wanted_by[done]:
            waits_for[k].remove(done)
            if not waits_for[k]:
                heappush(ready, (places[systems[k][0]], k))
    return ordered


def _visit(root: T, after: Edges[T], seen: set[T], finish: Callable[[T], None]) -> None:
    """Visits depth first, without recursion; ``finish`` is called after all successors."""
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
