"""The columns of a sweep: what is told of each method, and which values are better.

One more column is one more entry of this list; properties of ``garkcli.properties`` are columns by
themselves.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cache, partial
from math import isfinite
from typing import TypeAlias

from garkcli.errors import GarkError
from garkcli.exact.display import to_ball
from garkcli.exact.polynomial_text import ball_decimal, root_decimal
from garkcli.order.constants import ErrorConstants
from garkcli.order.simplifying import Simplifying
from garkcli.properties.property import Size
from garkcli.properties.registry import KEYS, find
from garkcli.sweep.judged import Judged
from garkcli.tableau.conjugate import is_symplectic

Value: TypeAlias = "bool | int | float | str | None"
"""``infinity`` is the one text; None where there is no value."""
INFINITY = "infinity"
DIGITS = 12
"""Digits of real numbers, rounded from enclosures of exact ones."""


@dataclass(frozen=True)
class Column:
    """A criterion.

    Attributes:
        name: in spec files and rows.
        value: of a method.
        text: what it is.
        more_is_better: whether larger values come first.
    """

    name: str
    value: Callable[[Judged], Value]
    text: str
    more_is_better: bool = True


def is_value(value: object) -> bool:
    """Whether a column may have it."""
    if isinstance(value, float):
        return isfinite(value)
    return value is None or isinstance(value, (bool, int)) or value == INFINITY


def _error(constants: ErrorConstants | None, is_largest: bool) -> float | None:
    """A norm of the principal error, from exact coefficients."""
    if constants is None:
        return None
    norms = constants.all
    if is_largest:
        if norms.worst_value is None:
            return 0.0
        return abs(_rounded(ball_decimal(to_ball(norms.worst_value, 20), DIGITS)))
    if norms.two_squared is None:
        return None
    return _rounded(ball_decimal(to_ball(norms.two_squared, 30).sqrt(), DIGITS))


def _rounded(text: str) -> float:
    """A decimal as a float.

    Raises:
        GarkError: it is beyond them: the float would be infinite, or 0 where the number is not.
    """
    value = float(text)
    mantissa, _, _ = text.lower().partition("e")
    is_lost = not value and mantissa.strip("-0.") != ""
    if is_lost or not isfinite(value):
        raise GarkError(f"{text} is beyond the numbers of a column", code="wrong-value")
    return value


def _property(key: str, judged: Judged) -> Value:
    value = judged.subject.verdict(key).value
    if not isinstance(value, Size):
        return value
    if value.root is None:
        return INFINITY
    return _rounded(root_decimal(value.root, DIGITS))


def _phase_order(judged: Judged) -> Value:
    phase = judged.phase
    if phase is None:
        return None
    return INFINITY if phase.order is None else phase.order


def _phase_constant(judged: Judged) -> Value:
    phase = judged.phase
    if phase is None or phase.constant is None:
        return None
    return abs(_rounded(ball_decimal(to_ball(phase.constant, 20), DIGITS)))


def _order(found: object) -> int | None:
    order = getattr(found, "order", None)
    return order if isinstance(order, int) else None


def _bound(found: Simplifying | None, is_sharp: bool) -> int | None:
    if found is None:
        return None
    return found.sharp_bound if is_sharp else found.bound


_PLAIN = (
    Column("order", lambda m: m.order.order, "the exact order"),
    Column(
        "conjugate-order", lambda m: _order(m.conjugate_order), "that of the symplectic conjugate"
    ),
    Column("pair-order", lambda m: _order(m.pair_order), "that of the symplectic pair"),
    Column("symplectic", lambda m: is_symplectic(m.tableau), "is it its own conjugate"),
    Column("bound", lambda m: _bound(m.simplifying, False), "the paper's lower bound"),
    Column("sharp-bound", lambda m: _bound(m.simplifying, True), "the sharper bound"),
    Column(
        "pair-bound", lambda m: _bound(m.pair_simplifying, False), "the lower bound of the pair"
    ),
    Column(
        "pair-sharp-bound",
        lambda m: _bound(m.pair_simplifying, True),
        "the sharper bound of the pair",
    ),
    Column(
        "error",
        lambda m: _error(m.constants, False),
        "the principal error: the 2-norm of its coefficients",
        False,
    ),
    Column("error-largest", lambda m: _error(m.constants, True), "its largest coefficient", False),
    Column(
        "pair-error",
        lambda m: _error(m.pair_constants, False),
        "the principal error of the pair",
        False,
    ),
    Column("phase-order", _phase_order, "the order of the phase error on the oscillator"),
    Column("phase-constant", _phase_constant, "the constant of it", False),
    Column(
        "stages",
        lambda m: sum(space.stages for space in m.tableau.spaces),
        "stages of all stage spaces",
        False,
    ),
    Column("colours", lambda m: m.tableau.size, "parts of the vector field", False),
)
_LESS_IS_BETTER = {"implicit-stages", "fully-implicit", "reducible", "gamma"}


@cache
def columns() -> Mapping[str, Column]:
    """Every column by its name."""
    found = {column.name: column for column in _PLAIN}
    for key in KEYS:
        text = f"gark check --explain {key}"
        value = partial(_property, key)
        found[key] = Column(key, value, text, key not in _LESS_IS_BETTER)
    return found


def property_kind(name: str) -> str:
    """Of a column: ``truth``, ``count`` or ``number``."""
    if name in KEYS:
        return find(name).kind
    if name == "symplectic":
        return "truth"
    is_real = name.removeprefix("pair-").startswith("error") or name == "phase-constant"
    return "number" if is_real else "count"
