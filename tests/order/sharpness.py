"""How often the bounds by simplifying assumptions are the exact order, counted on methods that are
drawn at random.

``python -m tests.order.sharpness`` prints the table of docs/sharper-bound.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from flint import fmpq

from garkcli.errors import ZeroWeight
from garkcli.exact.matrix import Matrix
from garkcli.families.registry import BY_STAGES
from garkcli.order.certificate import find_order
from garkcli.order.simplifying import simplifying
from garkcli.problems.draw import Draw
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.tableau import Method, Tableau
from garkcli.transfer import RULES, combination
from tests.oracles.samples import method

METHODS = 200
"""How many methods of each kind are drawn."""
LIMIT = 10
"""Where the search for orders stops; all orders that occur are smaller."""
_FAMILIES = (
    "gauss",
    "radau-ia",
    "radau-iia",
    "lobatto-iiia",
    "lobatto-iiib",
    "lobatto-iiic",
    "lobatto-iiic*",
    "lobatto-iiid",
    "explicit-euler",
    "explicit-midpoint",
    "heun",
    "kutta",
    "rk4",
    "ssp2",
)
_RULES = ("collocation", "interpolation", "conjugate-collocation", "conjugate-interpolation")
"""Those that methods are drawn from; with another one all draws would be others."""
_MOST_STAGES = 3
_Item = TypeVar("_Item")


@dataclass(frozen=True)
class Count:
    """Of so many methods the order was the printed bound, and the sharper one."""

    methods: int
    printed: int
    sharp: int


def drawn(combine: bool, count: int = METHODS, seed: int = 0) -> list[Tableau]:
    """GARK methods of two or three colours, each of a family, with off-diagonal blocks by rules; only
    those without zero weights, which have a symplectic pair.

    Args:
        combine: whether a block is a combination of two rules.
        count: how many.
        seed: which ones.
    """
    draw = Draw(seed)
    found: list[Tableau] = []
    while len(found) < count:
        try:
            tableau = _tableau(draw, combine)
            pair(tableau)
        except ZeroWeight:
            continue
        found.append(tableau)
    return found


def counted(tableaus: list[Tableau]) -> Count:
    """How often the bounds are the order; neither is ever larger.

    Raises:
        AssertionError: a bound is larger than the order, or the printed one than the sharper one.
    """
    printed = sharp = 0
    for tableau in tableaus:
        bounds = simplifying(tableau, LIMIT)
        order = find_order(tableau, LIMIT).order
        assert bounds.bound <= bounds.sharp_bound <= order < LIMIT
        printed += bounds.bound == order
        sharp += bounds.sharp_bound == order
    return Count(len(tableaus), printed, sharp)


def _tableau(draw: Draw, combine: bool) -> Tableau:
    methods = [method(_family(draw)) for _ in range(draw.between(2, 3))]
    blocks = {}
    for l, own in enumerate(methods):
        for m, other in enumerate(methods):
            if l != m:
                blocks[l, m] = _block(draw, combine, own, other)
    return gark(methods, blocks)


def _family(draw: Draw) -> str:
    names = []
    for name in _FAMILIES:
        family = BY_STAGES[name]
        for stages in range(family.smallest, _MOST_STAGES + 1):
            names.append(f"{name} {stages}")
            if stages == family.largest:
                break
    return _one_of(draw, names)


def _block(draw: Draw, combine: bool, own: Method, other: Method) -> Matrix:
    """The block A^{l,m} by a rule, or halfway between two rules."""
    rules = [RULES[name] for name in _RULES]
    first = _one_of(draw, rules)
    if not combine:
        return first(own, other)
    second = _one_of(draw, rules)
    half = fmpq(1, 2)
    return combination([(half, first), (half, second)], own, other)


def _one_of(draw: Draw, items: list[_Item]) -> _Item:
    return items[draw.between(0, len(items) - 1)]


def table() -> list[str]:
    """The rows of the table in docs/sharper-bound.md."""
    by_rules, by_halves = drawn(combine=False), drawn(combine=True)
    rows = []
    for label, tableaus in (
        ("methods, each block by a rule", by_rules),
        ("their symplectic pairs", _pairs(by_rules)),
        ("methods, each block halfway between two rules", by_halves),
        ("their symplectic pairs", _pairs(by_halves)),
    ):
        count = counted(tableaus)
        numbers = f"{count.methods} | {count.printed} | {count.sharp}"
        rows.append(f"| {label} | {numbers} |")
    return rows


def _pairs(tableaus: list[Tableau]) -> list[Tableau]:
    return [pair(tableau) for tableau in tableaus]


if __name__ == "__main__":
    print("\n".join(table()))
