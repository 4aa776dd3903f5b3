"""Facts of one report that theorems join: which of them contradict each other."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from garkcli.check.analysis import Analysis
from garkcli.order.meant import meant
from garkcli.order.pair_order import pair_criterion


def contradictions(found: Analysis) -> list[str]:
    """What cannot be true at once, in words; none where all agree."""
    return [text for text, agrees in _joined(found) if not agrees]


def _joined(found: Analysis) -> Iterator[tuple[str, bool]]:
    s, order = found.simplifying, found.order.order
    limit = found.limit
    rows_are_nodes = not found.inconsistent
    if rows_are_nodes:
        yield "order ≥ bound", order >= min(s.bound, limit)
        yield "order ≥ sharp bound", order >= min(s.sharp_bound, limit)
        if not any(colour.is_linear for colour in found.tableau.colours):
            yield "B(order)", s.r >= min(order, limit)
    of_conjugate = None if found.conjugate_order is None else found.conjugate_order.order
    of_pair = None if found.pair_order is None else found.pair_order.order
    if of_conjugate is not None:
        yield "conjugate order ≥ min(order, 2)", of_conjugate >= min(order, 2)
        yield "order ≥ min(conjugate order, 2)", order >= min(of_conjugate, 2)
    if of_pair is not None and of_conjugate is not None:
        yield "pair order ≤ order", of_pair <= order
        yield "pair order ≤ conjugate order", of_pair <= of_conjugate
        if found.symplectic:
            yield "symplectic: conjugate order = order", of_conjugate == order
            yield "symplectic: pair order = order", of_pair == order
        p = found.pair_simplifying
        if p is not None and rows_are_nodes and not found.conjugate_inconsistent:
            yield "pair order ≥ its bound", of_pair >= min(p.bound, limit)
            yield "pair order ≥ its sharp bound", of_pair >= min(p.sharp_bound, limit)
            yield "criterion ≤ pair order", _criterion(found) <= of_pair
            if _says(found, "positive-weights") is True:
                yield "positive weights: criterion = pair order", _criterion(found) == of_pair
    yield from _of_properties(found)
    if found.embedded is not None and found.nonautonomous_order is not None and rows_are_nodes:
        yield "row sums: non-autonomous order", found.nonautonomous_order.order == order
    if found.dense is not None and found.dense.ends_at_step:
        yield "b(1) = b: dense order ≤ order", found.dense.order.order <= order


def _of_properties(found: Analysis) -> Iterator[tuple[str, bool]]:
    s = found.simplifying
    says = {key: _says(found, key) for key in _IMPLIED}
    for key, others in _IMPLIED.items():
        for other in others:
            if says[key] is True and says[other] is not None:
                yield f"{key}: {other}", says[other] is True
    weak, stage = _says(found, "weak-stage-order"), _says(found, "stage-order")
    if weak is not None and stage is not None:
        yield "weak stage order ≥ stage order", weak >= stage
    if stage is not None:
        yield "stage order of the properties", stage == s.stage_order
    if says["symmetric"] is True and found.order.witness is not None:
        yield "symmetric: even order", found.order.order % 2 == 0
    if says["explicit"] is True:
        yield "explicit: no implicit stages", _says(found, "implicit-stages") in (0, None)


_IMPLIED: dict[str, tuple[str, ...]] = {
    "l-stable": ("a-stable",),
    "a-stable": (),
    "algebraically-stable": ("a-stable",),
    "fsal": ("stiffly-accurate",),
    "stiffly-accurate": (),
    "explicit": (),
    "sdirk": ("diagonally-implicit",),
    "esdirk": ("diagonally-implicit",),
    "diagonally-implicit": (),
    "symmetric": (),
}
"""Properties, and what they imply."""


def _says(found: Analysis, key: str) -> Any:
    """A property; None where it has no meaning or is undecided."""
    return found.subject.verdict(key).value


def _criterion(found: Analysis) -> int:
    method = meant(found.tableau, found.tolerance, found.further)
    return pair_criterion(method, found.limit).order
