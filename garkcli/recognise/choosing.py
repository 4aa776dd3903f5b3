"""The readings of a source: of each scope the best ones, none of an array that another has."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence, Set
from typing import TypeAlias

from garkcli.frozen import replace
from garkcli.recognise.forms import of_velocities, other_readings
from garkcli.recognise.given import VALUE, DeclaredOrder, Given, Group
from garkcli.recognise.readings import (
    ENOUGH,
    ENOUGH_FOR_DOUBT,
    WORDS,
    Reading,
    by_names,
    rk_readings,
    with_beside,
)

Fellows: TypeAlias = Mapping[int, Set[int]]
NO_FELLOWS: Fellows = {}
MOST_ARRAYS = 120
"""The most arrays of a scope that are searched."""
FEWEST_FRACTIONS = 2
"""Weights of order 2 or the matrix beside them have fractions."""
MOST_LEFT = 60
"""The most arrays without a reading that are tried with those of the scope around them."""
ALONE = 8.0
"""Bits of three arrays of a scope that are a method, where nothing else is."""
NEAR = 100
"""Equal numbers within so many lines are one method."""


def readings_of(groups: Sequence[Group], fellows: Fellows = NO_FELLOWS) -> Iterator[Reading]:
    """Every reading for which something speaks, scope by scope; inner ones come first.

    Args:
        groups: each behind those that are in it.
        fellows: of each array of tables that are read, all arrays of these, by their ``id``.
    """
    left: dict[int, list[Given]] = {}
    seen: dict[object, Group] = {}
    lines: dict[object, int] = {}
    inside: dict[int, set[int]] = {}
    for group in groups:
        own, around = group.scope
        within = inside.setdefault(own, set()) | {own}
        if around is not None:
            inside.setdefault(around, set()).update(within)
        arrays = _unlike([*group.arrays, *left.pop(own, ())])
        used: set[int] = set()
        for each in _of_group(replace(group, arrays=arrays), used, fellows):
            rows = (x[..., VALUE].tobytes() for x in each.rows.values())
            # single numbers of another scope are those of another function
            key = each.used[0].is_made and group.line, each.form, *rows
            before = seen.get(key, group)
            is_other = before.title != group.title and before.scope[0] not in within
            if is_other or abs(lines.get(key, -NEAR) - each.line) >= NEAR:
                seen[key], lines[key] = group, each.line
                yield each
        if around is not None:
            rest = [x for x in arrays if id(x) not in used]
            left.setdefault(around, []).extend(rest[:MOST_LEFT])


def _unlike(arrays: Sequence[Given]) -> list[Given]:
    """Arrays, the same in a record once."""
    found: dict[object, Given] = {}
    for x in arrays:
        found.setdefault((x.key, x.owner), x)
    return list(found.values())


def _of_group(group: Group, used: set[int], fellows: Fellows) -> Iterator[Reading]:
    """The readings of a scope: those of its records first, then of all that is left."""
    records: dict[str, list[Given]] = {}
    for x in group.arrays:
        records.setdefault(x.owner, []).append(x)
    for owner, arrays in records.items():
        if owner and 2 <= len(arrays) < len(group.arrays):
            yield from _best(group, arrays, used, fellows)
    rest = [x for x in group.arrays if id(x) not in used]
    if rest:
        yield from _best(group, rest, used, fellows)


def _best(
    group: Group, arrays: Sequence[Given], used: set[int], fellows: Fellows
) -> Iterator[Reading]:
    """The readings of some arrays, best first; each array is the matrix of one alone."""
    arrays = arrays[:MOST_ARRAYS]
    if sum(x.fractions for x in arrays) < FEWEST_FRACTIONS:
        return
    rk, tried = rk_readings(arrays, group.unknown)
    others, more = other_readings(arrays)
    cost = math.log2(max(1, tried + more)) - WORDS * group.speaks

    def rank(x: Reading) -> tuple[bool, float]:
        # velocities have a matrix, too
        return x.form != "nystrom" or x.bits - cost < ENOUGH, -x.bits

    found = sorted([*rk, *others], key=rank)
    alike: dict[object, list[Reading]] = {}
    for x in rk:
        alike.setdefault(x.matrix, []).append(x)
    taken: set[int] = set()
    for reading in found:
        each = by_names(reading, alike[reading.matrix]) if reading.form == "rk" else reading
        is_matrix = each.form in ("rk", "nystrom")
        own = each.used[:1] if is_matrix else each.used
        bits = each.bits - cost + ALONE * _is_all(group, arrays, each)
        if bits < ENOUGH_FOR_DOUBT or any(id(x) in taken for x in own):
            continue
        each = replace(each, bits=bits, group=group, declared=_declared(group, each))
        if each.form == "rk":
            own_ids = frozenset(map(id, each.used))
            beside = [x for x in arrays if not own_ids.isdisjoint(fellows.get(id(x), own_ids))]
            each = with_beside(each, beside)
        ids = {id(x) for x in (*each.used, *of_velocities(each, arrays))}
        taken |= ids
        used |= ids
        yield each


def _is_all(group: Group, arrays: Sequence[Given], reading: Reading) -> bool:
    """Whether a scope that speaks of methods has one matrix, and weights and nodes for it alone,
    that meet what is tried.
    """
    is_whole = len(arrays) == len(reading.used) == 3 and sum(x.is_matrix for x in arrays) == 1
    return group.speaks and is_whole and reading.is_plain and reading.order > 1


def _declared(group: Group, reading: Reading) -> DeclaredOrder | None:
    """The order that is declared beside a reading: in its record, or in its scope, unless its name
    begins like those of other arrays.
    """
    owner = reading.used[0].owner
    for wanted in dict.fromkeys([owner, ""]):
        declared = [x for x in group.orders if x.owner == wanted]
        declared = [x for x in declared if not _is_of_others(x.prefix, group, reading)]
        if len({x.order for x in declared}) == 1:
            return declared[0]
    return None


def _is_of_others(prefix: str, group: Group, reading: Reading) -> bool:
    """Whether other arrays of the scope have a prefix, and none of the reading."""

    def have_it(arrays: Sequence[Given]) -> bool:
        return any(x.name.rpartition(".")[2].lower().startswith(prefix) for x in arrays)

    return bool(prefix) and have_it(group.arrays) and not have_it(reading.used)
