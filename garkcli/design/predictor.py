"""Wants on a predictor: its order for every ratio of step sizes, and for steps of one size.

At one ratio the conditions of order q say that weights vanish at all trees of at most q vertices of
the method that takes two steps (``garkcli.order.predictor``). They are linear in the weights and
polynomials in the ratio: as many ratios as their degree asks for decide all.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, cast

from flint import fmpq, fmpq_mpoly

from garkcli.design.conditions import FamilyConditions
from garkcli.design.want import Asked, Want, WantConditions
from garkcli.errors import MethodError
from garkcli.exact.field import ONE
from garkcli.exact.matrix import dot
from garkcli.order.predictor import implicit_stages, misses, ratios, two_steps


def _order(asked: Asked) -> WantConditions:
    predictor = asked.further.predictor
    every = [] if predictor is None else ratios(predictor, cast("int", asked.value))
    return _meaning("predictor-order", asked, every)


def _order_of_equal_steps(asked: Asked) -> WantConditions:
    return _meaning("predictor-order-equal-steps", asked, [ONE])


def _meaning(key: str, asked: Asked, every: Sequence[fmpq]) -> WantConditions:
    """The conditions of all trees at given ratios; MethodError without a predictor."""
    predictor, order = asked.further.predictor, cast("int", asked.value)
    if predictor is None:
        message = f"design: {key} needs a predictor"
        cure = 'write predictor: {old: [["?", "?"], ["?", "?"]]} beside b'
        raise MethodError(message, cure, code="wanted-without-meaning")
    ring, one = asked.ring, asked.ring.constant(fmpq(1))
    zeros: list[object] = []
    denominators: tuple[fmpq_mpoly, ...] = ()
    for ratio in every:
        conditions = FamilyConditions(two_steps(asked.tableau, ratio), ring)
        denominators = conditions.denominators
        rows = [misses(asked.tableau, predictor, i, ratio) for i in implicit_stages(asked.tableau)]
        for n in range(1, order + 1):
            for _, forest in conditions.members(n, asked.tableau.roots):
                vector: Any = [ring.quotient(x * one, one) for x in forest.vector]
                zeros += [dot(row, vector) for row in rows]
    return WantConditions(tuple(zeros), denominators, claims=((key, f'">= {order}"'),))


PREDICTOR = (
    Want("predictor-order", "count", "the order of the predictor for all ratios of steps", _order),
    Want(
        "predictor-order-equal-steps",
        "count",
        "the order of the predictor for steps of one size",
        _order_of_equal_steps,
    ),
)
