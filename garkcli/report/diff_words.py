"""Two methods held against each other, in words: what every format of ``gark diff`` says."""

from __future__ import annotations

from collections.abc import Sequence

from flint import arb

from garkcli.check.explained import value_text
from garkcli.comparison.comparison import Comparison
from garkcli.comparison.differences import BlockGap, EntryGap
from garkcli.comparison.sameness import Sameness
from garkcli.exact.display import decimal
from garkcli.properties.property import Verdict
from garkcli.tableau.pointwise import Cell

FORMS = {
    "rk": "a Runge-Kutta method",
    "ark": "an additive method",
    "gark": "a GARK method",
    "prk": "a partitioned method",
    "pair": "a symplectic pair",
}
"""The forms of methods, as people call them."""
_DIGITS = 12


def relation_lines(found: Comparison) -> list[str]:
    """What the methods are to each other."""
    if found.relation == "identical":
        return ["identical: every entry is the same"]
    if found.relation == "undecided":
        return [f"not decided: {found.obstacle}"]
    same = found.sameness
    if same is None:
        return [": ".join(filter(None, ["different methods", found.remark]))]
    how = _how(found, same)
    if same.step_only:
        head = f"different: {found.remark}"
    elif same.allowed:
        rounding = decimal(same.allowed)
        head = f"the same method within the rounding of the files, {rounding}"
    else:
        head = "the same method"
    return [head, *how]


def tolerance_lines(found: Comparison) -> list[str]:
    """The tolerances of the files where they are not the same."""
    one, other = found.one.tolerance, found.other.tolerance
    if one == other:
        return []
    first, second = ("none" if x is None else decimal(x) for x in (one, other))
    return [f"their tolerances are not the same: {first} against {second}"]


def _how(found: Comparison, same: Sameness) -> list[str]:
    """What turns one into the other, a line each."""
    lines = []
    first, second = found.forms
    if first != second:
        lines.append(f"in another form: {FORMS[first]}, {FORMS[second]}")
    if same.is_reduced:
        lines.append("once both are reduced: see gark reduce")
    if not same.keeps_colours:
        numbers = _numbers(same.colours)
        lines.append(f"colours 1, 2, … of the first are {numbers} there")
    if same.keeps_stages:
        return lines
    if len(set(same.stages)) == 1:
        numbers = _numbers(same.stages[0])
        lines.append(f"stages 1, 2, … of the first are {numbers} there")
        return lines
    for l, images in enumerate(same.stages, start=1):
        if images != tuple(range(len(images))):
            numbers = _numbers(images)
            lines.append(f"its stages of colour {l} are {numbers} there")
    return lines


def _numbers(images: Sequence[int]) -> str:
    return ", ".join(str(i + 1) for i in images)


def gap_name(gap: BlockGap, colours: int) -> str:
    """A block or a row, such as A{1,2}; without its colours where there is one."""
    name = gap.kind
    if gap.power:
        name += f" of θ^{gap.power}"
    if colours == 1:
        return name
    seen = "" if gap.seen is None else f",{gap.seen + 1}"
    return f"{gap.kind}{{{gap.colour + 1}{seen}}}{name[len(gap.kind) :]}"


def place_name(gap: EntryGap) -> str:
    """Where an entry stands, counted from 1."""
    entry = f"entry {gap.entry + 1}"
    if gap.row is None:
        return entry
    return f"row {gap.row + 1}, {entry}"


def cell_name(cell: Cell) -> str:
    """An entry: exact where it is short."""
    if isinstance(cell, arb):
        return str(cell.str(_DIGITS, radius=False))
    return value_text(cell, _DIGITS)


def verdict_name(verdict: Verdict) -> str:
    """The value of a property."""
    if verdict.value is None:
        return "not decided" if verdict.is_undecided else "no meaning"
    if isinstance(verdict.value, bool):
        return "yes" if verdict.value else "no"
    text = str(verdict.value)
    return f"at least {text}" if verdict.is_at_least else text
