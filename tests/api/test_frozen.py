"""What the classes of values promise: equality, order of fields, pickles, no change."""

from __future__ import annotations

import pickle
from functools import cached_property

import pytest

from garkcli.exact.nodes import Literal, Name
from garkcli.frozen import Frozen, FrozenBut, fields, replace


class Point(Frozen):
    x: int
    y: int = 0

    @cached_property
    def square(self) -> int:
        return self.x**2 + self.y**2


class Marked(FrozenBut):
    besides = frozenset({"mark"})

    x: int
    mark: str = ""


def test_a_value_does_not_change_and_keeps_what_it_computed() -> None:
    point = Point(3, 4)
    assert point.square == 25
    assert "square" in vars(point)
    with pytest.raises(AttributeError):
        point.x = 1  # type: ignore[misc]
    assert replace(point, y=0).square == 9


def test_values_are_compared_by_their_fields() -> None:
    assert Point(1) == Point(1, 0) != Point(1, 1)
    assert len({Point(1), Point(1, 0), Point(2)}) == 2
    assert fields(Point) == ("x", "y")
    assert repr(Point(1)) == "Point(x=1, y=0)"
    assert pickle.loads(pickle.dumps(Point(1, 2))) == Point(1, 2)


def test_fields_besides_do_not_count() -> None:
    assert Marked(1, "a") == Marked(1, "b")
    assert not Marked(1, "a") != Marked(1, "b")  # noqa: SIM202 both operators are asked
    assert Marked(1) != Marked(2)
    assert len({Marked(1, "a"), Marked(1, "b")}) == 1
    assert Name("x", start=1) == Name("x", start=5) != Literal(1)


class Positive(Frozen):
    x: int

    def __post_init__(self) -> None:
        if self.x <= 0:
            raise ValueError("not positive")


def test_a_replaced_value_is_checked_again() -> None:
    with pytest.raises(ValueError, match="not positive"):
        replace(Positive(1), x=0)
