"""The least number of elements that meets every set of some."""

from __future__ import annotations

from itertools import combinations

from hypothesis import given
from hypothesis import strategies as st

from garkcli.design.ideal import least_meeting

SETS = st.frozensets(st.integers(0, 6), min_size=1, max_size=4)


@given(st.sets(SETS, max_size=8))
def test_it_is_the_least_of_all_subsets(sets: set[frozenset[int]]) -> None:
    """Against every subset of the elements, the smaller first."""
    sizes = [
        size
        for size in range(8)
        for chosen in combinations(range(7), size)
        if all(one.intersection(chosen) for one in sets)
    ]
    assert least_meeting(sets) == sizes[0]


def test_many_elements_are_no_work() -> None:
    """Of 60 elements 2⁶⁰ subsets are not tried: neighbours on a path, and each by itself."""
    path = [frozenset({k, k + 1}) for k in range(59)]
    alone = [frozenset({k}) for k in range(60)]
    assert least_meeting(path) == 30
    assert least_meeting([*path, *alone]) == 60
