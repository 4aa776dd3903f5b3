"""The order of the symplectic pair."""

from typing import cast

from flint import fmpq

from garkcli.design.conditions import FamilyConditions
from garkcli.design.wants.want import Asked, Meaning, Want
from garkcli.tableau.forms import pair


def _meaning(asked: Asked) -> Meaning:
    conditions = FamilyConditions(pair(asked.tableau), asked.ring)
    one = asked.ring.constant(fmpq(1))
    zeros: list[object] = []
    for k in range(1, cast("int", asked.value) + 1):
        polynomials = [condition.polynomial for condition in conditions.of_order(k)]
        zeros += [asked.ring.quotient(p, one) for p in polynomials]
    return Meaning(tuple(zeros), conditions.denominators)


WANT = Want("pair-order", "count", "the symplectic pair has that order", _meaning)
