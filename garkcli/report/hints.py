"""Hints of failing conditions in words: the likely culprit, a possible repair, a tolerance."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.check.findings import names_of, repair_text
from garkcli.check.remark import RoundingHint
from garkcli.errors import counted
from garkcli.exact.display import decimal
from garkcli.order.blame import Blame
from garkcli.order.repair import Repair
from garkcli.reason import NO_REASON, Place, Reason, joined

MOST_REPAIRS = 3


def blame_text(blame: Blame, own: Sequence[str]) -> Reason:
    """The conditions that fail, the block in all of them, and repairs, with names of colours."""
    is_known = blame.order == 1 or blame.restored is not None or blame.within is not None
    texts = [] if is_known else _conditions(blame, own)
    if blame.repairs:
        also = f", and so would {', '.join(blame.restores)}" if blame.restores else ""
        order = "the claimed order"
        if blame.restored is not None:
            order = f"{blame.of.replace('-', ' ')} {blame.restored}"
        if blame.within is not None:
            order = f"within {decimal(blame.within)} {order}"
        mended = _repairs(blame.repairs, own)
        texts.append(Reason(f"{order} would hold with {{}}{also}", mended))
    return joined("; ", texts) if texts else NO_REASON


def _conditions(blame: Blame, own: Sequence[str]) -> list[Reason]:
    """The conditions that fail, and their blocks; the sum of weights needs no more."""
    names = blame.names or own
    letter = "Â" if blame.of == "conjugate-order" else "A"
    verb = "fails" if blame.failing == 1 else "fail"
    fail = f"{blame.failing} of the {blame.total} conditions of order {blame.order} {verb}"
    if blame.total == 1:
        fail = f"the one condition of order {blame.order} fails"
    if blame.of != "order":
        fail = f"{blame.of}: {fail}"
    is_one = blame.failing == 1
    if blame.only_coupling and len(names) > 1:
        fail += ", a coupling condition" if is_one else ", all of them coupling conditions"
    texts = [Reason(fail)]
    every = "it involves" if is_one else "all of them involve"
    if blame.culprit is not None and len(names) > 1:
        culprit = Place(letter, names_of(blame.culprit, names))
        texts.append(Reason(f"{every} {{}}: look there first", culprit))
    elif len(blame.in_every) > 1:
        texts.append(_involved(letter, blame.in_every, names, every))
    if blame.in_none:
        none = "it does not involve" if is_one else "none of them involves"
        texts.append(_involved(letter, blame.in_none, names, none))
    return texts


def _involved(
    letter: str, blocks: Sequence[tuple[int, int]], names: Sequence[str], verb: str
) -> Reason:
    places = joined(", ", [Place(letter, names_of(block, names)) for block in blocks])
    return Reason(f"{verb} {{}}", places)


def _repairs(repairs: Sequence[Repair], names: Sequence[str]) -> Reason:
    return joined(", or ", [repair_text(x, names) for x in repairs[:MOST_REPAIRS]])


def remark_text(found: RoundingHint, names: Sequence[str], tolerance: fmpq | None) -> Reason:
    """The digits of the numbers, the order with these, and the entry that is off."""
    order = f"{found.of.replace('-', ' ')} {found.order}"
    if found.repairs:
        mended = _repairs(found.repairs, names)
        return Reason(
            f"an entry looks misprinted: within the digits of the others {order} holds with {{}}",
            mended,
        )
    assert found.exponent is not None
    places = counted(-found.exponent, "decimal place")
    looks = f"the coefficients look rounded to {places}"
    if tolerance is not None:
        looks = f"the tolerance {decimal(tolerance)} is too tight: {looks}"
    return Reason(f"{looks}; with the line {{}} {order} holds", found.line)
