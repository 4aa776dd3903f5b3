"""The columns of a sweep: a list here, and the properties; and which values are better."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, cached_property, partial
from math import isfinite
from typing import TypeAlias

from flint import fmpq

from garkcli.constructions.rosenbrock import DAE_VIEWS, OF_BETA, VIEWS, Which, is_rosenbrock, seen
from garkcli.errors import GarkError, MethodError, UsageProblem, ZeroWeight
from garkcli.exact.display import to_ball
from garkcli.exact.matrix import SingularMatrixError
from garkcli.exact.polynomial_text import ball_decimal, root_decimal
from garkcli.frozen import Frozen
from garkcli.order.certificate import DEFAULT_LIMIT, Order, find_order
from garkcli.order.constants import ErrorConstants, error_constants
from garkcli.order.meant import printed
from garkcli.order.simplifying import Simplifying, is_symplectic, simplifying
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.properties.registry import KEYS
from garkcli.properties.subject import Subject, find
from garkcli.properties.verdict import Size
from garkcli.stability.oscillator import PhaseError, oscillator_stability
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import on_linear_problems, pair, with_time
from garkcli.tableau.tableau import Tableau


class SweptMethod(Frozen):
    """A method, taken as exact, and its properties, each computed once."""

    tableau: Tableau

    @cached_property
    def order(self) -> Order:
        return find_order(self.tableau)

    @cached_property
    def conjugate_order(self) -> Order | None:
        try:
            return find_order(conjugate(self.tableau))
        except ZeroWeight:
            return None

    @cached_property
    def pair(self) -> Tableau | None:
        try:
            return pair(self.tableau)
        except ZeroWeight:
            return None

    @cached_property
    def pair_order(self) -> Order | None:
        return None if self.pair is None else find_order(self.pair)

    @cached_property
    def simplifying(self) -> Simplifying:
        return simplifying(self.tableau, DEFAULT_LIMIT)

    @cached_property
    def pair_simplifying(self) -> Simplifying | None:
        return None if self.pair is None else simplifying(self.pair, DEFAULT_LIMIT)

    @cached_property
    def constants(self) -> ErrorConstants | None:
        return _constants(self.tableau, self.order)

    @cached_property
    def pair_constants(self) -> ErrorConstants | None:
        if self.pair is None or self.pair_order is None:
            return None
        return _constants(self.pair, self.pair_order)

    @cached_property
    def subject(self) -> Subject:
        linear = on_linear_problems(self.tableau)
        known = self.simplifying if linear is self.tableau else simplifying(linear, DEFAULT_LIMIT)
        return Subject(linear, self.order.order, known, DEFAULT_LIMIT)

    @cached_property
    def phase(self) -> PhaseError | None:
        problem = Oscillator.default(terms_of(self.tableau), fmpq(1))
        try:
            return oscillator_stability(self.tableau, problem).phase
        except UsageProblem:
            return None


def _constants(tableau: Tableau, order: Order) -> ErrorConstants | None:
    """Returns None if the order is a lower bound or there are too many trees."""
    if order.is_lower_bound:
        return None
    constants = error_constants(tableau, order.order + 1)
    return constants if constants is not None and constants.is_exact else None


Value: TypeAlias = "bool | int | float | str | None"
"""``infinity`` is the only text, None means no value."""
INFINITY = "infinity"
DIGITS = 12


class Column(Frozen):
    name: str
    value: Callable[[SweptMethod], Value]
    text: str
    more_is_better: bool = True


def is_value(value: object) -> bool:
    if isinstance(value, float):
        return isfinite(value)
    return value is None or isinstance(value, (bool, int)) or value == INFINITY


def _error(constants: ErrorConstants | None, is_largest: bool) -> float | None:
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
    """Raises GarkError if a decimal overflows or underflows."""
    value = float(text)
    mantissa, _, _ = text.lower().partition("e")
    is_lost = not value and mantissa.strip("-0.") != ""
    if is_lost or not isfinite(value):
        message = f"{text} is beyond the numbers of a column"
        raise GarkError(message, "compare with a number from 1e-300 to 1e300", code="wrong-value")
    return value


def _property(key: str, judged: SweptMethod) -> Value:
    value = judged.subject.verdict(key).value
    if not isinstance(value, Size):
        return value
    if value.root is None:
        return INFINITY
    return _rounded(root_decimal(value.root, DIGITS))


def _phase_order(judged: SweptMethod) -> Value:
    phase = judged.phase
    if phase is None:
        return None
    return INFINITY if phase.order is None else phase.order


def _phase_constant(judged: SweptMethod) -> Value:
    phase = judged.phase
    if phase is None or phase.constant is None:
        return None
    return abs(_rounded(ball_decimal(to_ball(phase.constant, 20), DIGITS)))


def _order(result: object) -> int | None:
    order = getattr(result, "order", None)
    return order if isinstance(order, int) else None


def _view(which: Which, judged: SweptMethod) -> int | None:
    """Returns the order of a Rosenbrock method in another view; None on DAEs for singular α + γ."""
    if not is_rosenbrock(judged.tableau):
        timed = with_time(judged.tableau) if which == "with_time" else None
        return None if timed is None else find_order(timed).order
    try:
        view = seen(judged.tableau, which)
    except SingularMatrixError:
        return None
    return find_order(printed(view)).order


def _bound(conditions: Simplifying | None, is_sharp: bool) -> int | None:
    if conditions is None:
        return None
    return conditions.sharp_bound if is_sharp else conditions.bound


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
        "pair-bound",
        lambda m: _bound(m.pair_simplifying, False),
        "the lower bound of the symplectic pair",
    ),
    Column(
        "pair-sharp-bound",
        lambda m: _bound(m.pair_simplifying, True),
        "the sharper bound of the symplectic pair",
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
        "the principal error of the symplectic pair",
        False,
    ),
    Column(
        "pair-p-stable",
        lambda m: None if m.pair is None else _property("p-stable", SweptMethod(m.pair)),
        "whether the symplectic pair is P-stable",
    ),
    Column("phase-order", _phase_order, "the order of the phase lag on the oscillator"),
    Column("phase-constant", _phase_constant, "the size of its constant", False),
    Column(
        "stages",
        lambda m: sum(space.stages for space in on_linear_problems(m.tableau).spaces),
        "stages of all stage spaces",
        False,
    ),
    Column(
        "colours", lambda m: on_linear_problems(m.tableau).size, "parts of the vector field", False
    ),
    *(
        Column(key, partial(_view, which), f"gark explain {key}")
        for key, which in {**VIEWS, **DAE_VIEWS}.items()
    ),
)
_OF_ROSENBROCK = {"order", "error", "error-largest", "stages", "colours"} | OF_BETA
_OF_ROSENBROCK |= {*VIEWS, *DAE_VIEWS}
_LESS_IS_BETTER = {"implicit-stages", "fully-implicit", "reducible", "gamma"}


@cache
def columns() -> Mapping[str, Column]:
    by_name = {column.name: column for column in _PLAIN}
    for key in KEYS:
        text = f"gark explain {key}"
        by_name[key] = Column(key, partial(_property, key), text, key not in _LESS_IS_BETTER)
    return by_name


def value_of(name: str, judged: SweptMethod) -> Value:
    """Raises MethodError if a column does not apply to the method."""
    if is_rosenbrock(judged.tableau) and name not in _OF_ROSENBROCK:
        message = f"{name} applies to Runge–Kutta methods only"
        raise MethodError(message, "leave the column out", code="wanted-without-meaning")
    return columns()[name].value(judged)


def kind_of(name: str) -> str:
    """Returns ``truth``, ``count`` or ``number``."""
    if name in KEYS:
        return find(name).kind
    if name in ("symplectic", "pair-p-stable"):
        return "truth"
    is_real = name.removeprefix("pair-").startswith("error") or name == "phase-constant"
    return "number" if is_real else "count"
