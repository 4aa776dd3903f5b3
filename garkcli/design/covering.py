"""The least number of elements that meets every set of some."""

from __future__ import annotations

from collections.abc import Collection

from garkcli.deadline import check_time


def least_meeting(sets: Collection[frozenset[int]]) -> int:
    """The size of a smallest set that has an element of each of these.

    By branch and bound: some element of the smallest set is taken, those before it are not; sets
    that have no element in common take one each. None of the sets is empty.

    Raises:
        NotDecided: the time is not enough.

    >>> least_meeting([frozenset({1, 2}), frozenset({2, 3}), frozenset({4})])
    2
    """
    every = frozenset().union(*sets)
    return _least(_smallest(sets), 0, len(every))


def _least(left: list[frozenset[int]], taken: int, known: int) -> int:
    """The least size by taking more elements, or a ``known`` one that is not more."""
    check_time()
    if taken + _apart(left) >= known:
        return known
    if not left:
        return taken
    for element in sorted(left[0]):
        unmet = [one for one in left if element not in one]
        known = _least(unmet, taken + 1, known)
        without = [one - {element} for one in left]
        if not all(without):  # of that set it was the last one
            break
        left = _smallest(without)
    return known


def _apart(sets: list[frozenset[int]]) -> int:
    """How many sets without a common element are found, the smallest first."""
    seen: set[int] = set()
    count = 0
    for one in sets:
        if seen.isdisjoint(one):
            seen |= one
            count += 1
    return count


def _smallest(sets: Collection[frozenset[int]]) -> list[frozenset[int]]:
    """The sets that have no other one within, the smaller first."""
    kept: list[frozenset[int]] = []
    for one in sorted(set(sets), key=lambda x: (len(x), sorted(x))):
        if not any(other <= one for other in kept):
            kept.append(one)
    return kept
