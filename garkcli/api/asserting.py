"""The orders of a method, and assertions about them for test suites, with explanations."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from numbers import Integral
from typing import Any, TypeAlias

from garkcli.api.anymethod import method_of
from garkcli.api.methods import conjugate, find_order, pair
from garkcli.check.claims import agrees
from garkcli.check.findings import repair_text, witness_text
from garkcli.constructions.rosenbrock import Which, is_rosenbrock, seen
from garkcli.errors import MethodError, ZeroWeight
from garkcli.exact.matrix import SingularMatrixError
from garkcli.frozen import Frozen
from garkcli.methodfile.expectations import AtLeast
from garkcli.order import meant as methods
from garkcli.order.blame import MissedOrder, blame_of
from garkcli.order.certificate import DEFAULT_LIMIT, Order
from garkcli.order.deciding import AnyOrder
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Tableau

Wanted: TypeAlias = "int | str | None"
"""An order, or ``">= 4"``."""
_AT_LEAST = re.compile(r"\s*>=\s*([0-9]{1,4})\s*")
_MAX_ORDER = 1000


def assert_order(
    method: Any,
    order: Wanted = None,
    *,
    embedded: Wanted = None,
    conjugate: Wanted = None,
    pair: Wanted = None,
    w: Wanted = None,
    index_1: Wanted = None,
    tolerance: Any = None,
) -> None:
    """Fail unless a method has an order; the failure explains why not.

    Orders are written as in the claims of a file: 4 is neither 3 nor 5, and ``">= 4"`` is a lower
    bound. They are decided exactly, or within the tolerance of the method.

    Args:
        method: whatever ``method_of`` takes.
        order: the order of the method.
        embedded: the order of its embedded weights.
        conjugate: the order of its symplectic conjugate.
        pair: the order of the symplectic pair.
        w: the order of a Rosenbrock method with any matrix for the Jacobian.
        index_1: its order on differential-algebraic equations of index 1.
        tolerance: the rounding of the coefficients; by default that of the method, 0 for none.

    Raises:
        AssertionError: with the tree whose condition fails, and the entry that would restore the
            order.
        MethodError: no order is given, or the method has no embedded weights.

    >>> assert_order("ros3p", 3, embedded=2, w=1, index_1=3)
    >>> assert_order(([[0, 0], [1, 0]], ["1/2", "1/2"]), 3)
    Traceback (most recent call last):
    ...
    AssertionError: the method has order 2, not 3
      fails at order 3: [[[]]]: 0 instead of 1/6, off by -1/6
    """
    __tracebackhide__ = True
    found = method_of(method, tolerance, is_any_kind=True)
    wanted = {"order": order, "embedded": embedded, "conjugate": conjugate, "pair": pair}
    wanted |= {"w": w, "index_1": index_1}
    asked = {key: value for key, value in wanted.items() if value is not None}
    if not asked:
        raise MethodError("no order is given", "assert_order(method, 4)", code="arrays")
    failures: list[str] = []
    for key, value in asked.items():
        failures += _failure(found, _PARTS[key], value, tolerance)
    if failures:
        raise AssertionError("\n".join(failures))


def find_orders(method: Any, limit: int = DEFAULT_LIMIT) -> dict[str, int | str]:
    """The orders of a method and its embedded weights, conjugate and pair, as for ``assert_order``.

    Args:
        method: whatever ``method_of`` takes.
        limit: the order at which to stop; an order is then ``">= 60"``.

    >>> find_orders("rk4")
    {'order': 4, 'conjugate': 4, 'pair': 4}
    """
    asked = method_of(method, is_any_kind=True)
    orders: dict[str, int | str] = {}
    for key, part in _PARTS.items():
        if not part.exists(asked):
            continue
        try:
            found = find_order(part.of(asked), limit)
        except (ZeroWeight, SingularMatrixError):
            continue
        orders[key] = found.order
        if found.is_lower_bound:
            orders[key] = f">= {found.order}"
    return orders


class _OrderPart(Frozen):
    """A part with an order of its own; its entries may be those of ``which``, a derived method."""

    words: str
    of: Callable[[GarkMethod], GarkMethod]
    exists: Callable[[GarkMethod], bool]
    which: str = ""


def _embedded(method: GarkMethod) -> GarkMethod:
    """Raises MethodError without embedded weights."""
    if method.embedded is None:
        message = f"{_called(method)} has no embedded weights"
        cure = "from_arrays(A, b, c, embedded), or embedded: […] in its file"
        raise MethodError(message, cure, code="arrays")
    return _made(method, methods.as_embedded(methods.as_meant(method), method.embedded))


def _made(method: GarkMethod, changed: methods.AnyTableau) -> GarkMethod:
    if not isinstance(changed, Tableau):
        methods.keep(changed)
    tolerance = methods.tolerance_of(changed)
    return GarkMethod(tableau=methods.printed(changed), name=method.name, tolerance=tolerance)


def _seen(which: Which) -> Callable[[GarkMethod], GarkMethod]:
    def of(method: GarkMethod) -> GarkMethod:
        if not _is_rosenbrock(method):
            message = f"{_called(method)} is not a Rosenbrock method"
            raise MethodError(message, "leave out w and index_1", code="arrays")
        return _made(method, seen(methods.as_meant(method), which))

    return of


def _is_rosenbrock(method: GarkMethod) -> bool:
    return is_rosenbrock(method.tableau)


def _is_plain(method: GarkMethod) -> bool:
    return method.tableau.has_fields_alone and method.tableau.exact_to is None


_PARTS = {
    "order": _OrderPart("", lambda method: method, lambda _: True),
    "embedded": _OrderPart(
        " with its embedded weights", _embedded, lambda method: method.embedded is not None
    ),
    "conjugate": _OrderPart(", conjugated,", conjugate, _is_plain, "conjugate"),
    "pair": _OrderPart(" as a symplectic pair", pair, _is_plain, "pair"),
    "w": _OrderPart(" with any matrix", _seen("with_any_matrix"), _is_rosenbrock),
    "index_1": _OrderPart(" on DAEs of index 1", _seen("on_dae"), _is_rosenbrock),
}


def _called(method: GarkMethod) -> str:
    if not method.name or method.name.startswith("<"):
        return "the method"
    return method.name


def _failure(method: GarkMethod, part: _OrderPart, value: Any, tolerance: Any) -> Iterator[str]:
    wanted = _read(value)
    least = wanted.least if isinstance(wanted, AtLeast) else wanted
    name = f"{_called(method)}{part.words}"
    try:
        derived = part.of(method)
    except ZeroWeight as error:
        yield f"{name} has no order: {error.message}"
        return
    except SingularMatrixError:
        yield f"{name} has no order: alpha + gamma is singular"
        return
    found = find_order(derived, max(DEFAULT_LIMIT, least + 1), tolerance)
    reached = AtLeast(found.order) if found.is_lower_bound else found.order
    if agrees(wanted, reached):
        return
    text = str(reached).replace(">=", "at least")
    yield f"{name} has order {text}, not {value}"
    if found.order >= least or found.witness is None:
        return
    tableau = derived.tableau
    if not _is_plain(derived):
        names = [colour.name for colour in tableau.colours]
        yield f"  {witness_text(found.witness, names)}"
        return
    yield f"  {witness_text(found.witness, tableau.size > 1)}"
    # embedded weights are the weights of the derived tableau
    own = method.tableau if part.which else tableau
    for line in _blamed(own, part, found, least):
        yield f"  {line}"


def _read(value: Any) -> int | AtLeast:
    """Reads a wanted order; raises MethodError."""
    if isinstance(value, str):
        match = _AT_LEAST.fullmatch(value)
        if match is not None:
            return AtLeast(int(match[1]))
    is_whole = isinstance(value, Integral) and not isinstance(value, bool)
    if is_whole and 0 <= value <= _MAX_ORDER:
        return int(value)
    raise MethodError(f"{value!r} is not an order", 'write 4 or ">= 4"', code="wrong-value")


def _blamed(tableau: Tableau, part: _OrderPart, found: AnyOrder, claimed: int) -> Iterator[str]:
    missed = MissedOrder(found.order + 1, claimed, part.which or "order")
    method = tableau if isinstance(found, Order) else methods.meant(tableau, found.tolerance)
    blame = blame_of(method, missed)
    if blame is None or not blame.repairs:
        return
    names = [colour.name for colour in tableau.colours]
    repairs = list(blame.repairs)
    if part.of is _embedded:
        # the entries of A are those of the method too
        repairs.sort(key=lambda repair: repair.m is not None)
    shown = str(repair_text(repairs[0], names))
    if part.of is _embedded and repairs[0].m is None:
        shown = f"embedded {shown}"
    yield f"order {claimed} would hold with {shown}"
    others = len(repairs) - 1
    if others == 1:
        yield "or with one other entry changed"
    elif others:
        yield f"or with one of {others} other entries changed"
