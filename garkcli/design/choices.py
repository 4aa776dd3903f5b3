"""Down a family step by step: values for unknowns, and what each of them leaves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from flint import fmpq

from garkcli.design.design import Design
from garkcli.errors import MethodError


@dataclass(frozen=True)
class Choice:
    """A value for one unknown.

    Attributes:
        name: of the unknown.
        value: as it was written.
        order: of the methods that are counted.
        before, after: the dimension of the methods of that order without the choice and with it;
            −1 where there are none, not even with complex values.
    """

    name: str
    value: str
    order: int
    before: int
    after: int


def walk_down(design: Design, values: Mapping[str, tuple[str, fmpq]]) -> list[Choice]:
    """What each of several choices leaves of the methods of the highest order with any.

    Args:
        design: of the family before them.
        values: of unknowns, as text and as numbers, in the order in which they are chosen.

    Raises:
        MethodError: no order was decided that methods of the family have.
        NotDecided: a Gröbner basis takes too long.
    """
    decided = [x for x in design.steps if x.ideal is not None and x.may_have_methods]
    if not decided:
        raise MethodError(
            "--choose: no order is known that methods of the file have",
            "choose with --set, which makes the system smaller",
            code="not-found",
        )
    ideal = decided[-1].ideal
    assert ideal is not None
    ring = design.family.ring
    choices = []
    for name, (text, value) in values.items():
        unknown = ring.context.gen(ring.names.index(name))
        smaller = ideal.with_zeros([unknown - value])
        order = decided[-1].order
        choices.append(Choice(name, text, order, ideal.dimension, smaller.dimension))
        ideal = smaller
    return choices
