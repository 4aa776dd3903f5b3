"""The claims of a file with free parameters: each is decided for every value of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from garkcli.check.agreement import agrees, capped, claim_of, claimed_text
from garkcli.check.every_facts import Fact
from garkcli.check.every_orders import EveryOrder
from garkcli.check.every_value import EveryValue
from garkcli.check.every_words import fact_text
from garkcli.check.outcome import Claim
from garkcli.methodfile.description import ClaimText
from garkcli.methodfile.expectations import OF_ORDERS, AtLeast
from garkcli.order.simplifying import Simplifying
from garkcli.properties.registry import KEYS

_OF_TABLES: dict[str, Callable[[Simplifying], Any]] = {
    "B": lambda x: list(x.B),
    "C": lambda x: [list(row) for row in x.C],
    "D": lambda x: [list(row) for row in x.D],
    "bound": lambda x: x.bound,
    "sharp-bound": lambda x: x.sharp_bound,
}
"""Claims on what B, C and D are."""
GROWING = OF_ORDERS
"""Claims on how many conditions hold."""


def verify_every(claims: Sequence[ClaimText], found: EveryValue) -> tuple[Claim, ...]:
    """Hold each claim against what is true for every value."""
    return tuple(_held_against(claim, found) for claim in claims)


def _held_against(claim: ClaimText, found: EveryValue) -> Claim:
    fact = _fact(claim.key, found)
    name = next(iter(found.parameters), "")
    text = fact_text(fact, name, claimed_text)
    return claim_of(claim, text, _holds(claim, fact, found.limit))


def _fact(key: str, found: EveryValue) -> Fact:
    """What is true of the subject of a claim."""
    if key in _OF_TABLES:
        return found.simplifying.of(_OF_TABLES[key])
    if key.startswith("pair-") and key != "pair-order":
        part = _OF_TABLES[key.removeprefix("pair-")]
        return found.pair_simplifying().of(part)
    if key == "symplectic":
        return found.symplectic
    if key in KEYS:
        return found.verdict(key)
    return _of_order(_order(key, found))


def _order(key: str, found: EveryValue) -> EveryOrder | None:
    """The order that a claim is on."""
    # few files claim those with time, which are found when they are asked for
    if key == "nonautonomous-order":
        return found.nonautonomous
    if key == "embedded-nonautonomous-order":
        return found.embedded_nonautonomous
    return {
        "order": found.order,
        "conjugate-order": found.conjugate,
        "pair-order": found.pair,
        "embedded-order": found.embedded,
    }[key]


def _of_order(order: EveryOrder | None) -> Fact:
    if order is None:
        return Fact(None)
    return order.fact


def _holds(claim: ClaimText, fact: Fact, limit: int) -> bool:
    """Whether a claim is true for every value."""
    wanted = claim.value
    if fact.is_undecided or fact.where is not None or fact.unknown:
        return False
    others = (*fact.special, *fact.elsewhere)
    values = [fact.value, *(value for _, value in others)]
    if not all(agrees(wanted, capped(value, limit)) for value in values):
        return False
    if not fact.open and not fact.zeros:
        return True
    # where polynomials are zero more conditions hold, never less
    return claim.key in GROWING and _is_bound(wanted)


def _is_bound(wanted: object) -> bool:
    """Whether a claim says no more than how large numbers are at least."""
    if isinstance(wanted, list):
        return all(x is None or _is_bound(x) for x in wanted)
    return isinstance(wanted, AtLeast)
