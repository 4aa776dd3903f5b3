"""Rosenbrock and multirate infinitesimal methods of sources: orders within digits, and findings."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any, TypeGuard

from flint import fmpq

from garkcli.bridges.finding import EXPLAINED
from garkcli.bridges.importing import place_of, written
from garkcli.bridges.judging import Digits, Judged, judged
from garkcli.bridges.subject import TableSubject, read
from garkcli.check.culprit import misprints
from garkcli.check.findings import misprint_text, witness_text
from garkcli.constructions.rosenbrock import seen
from garkcli.errors import Remark, Severity
from garkcli.exact.display import decimal, to_ball, to_float
from garkcli.frozen import replace
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import loads
from garkcli.methodfile.printed import CARELESS, FLOAT, SLACK, fewest_digits, unit_of
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.meant import AnyTableau, as_embedded, meant, printed, within_digits
from garkcli.order.rounded import RoundedTableau, find_order_within
from garkcli.order.tolerance import rounded_up
from garkcli.sources.found import FoundTable
from garkcli.tableau.forms import with_time
from garkcli.tableau.tableau import Tableau

_LITTLE = 1e-9
"""Smaller residuals are rounding."""
MANY = 60
"""Most rounded numbers whose conditions are judged together, as those of one method."""
MOST = -4
TINY = 1e-300


class _Within(Digits):
    """The freedom of the digits of a source; ``method`` is exact, or within it."""

    printed: Any = ()
    units: Any = ()
    method: Any = None

    def of(self, tableau: Tableau, slack: int = SLACK) -> RoundedTableau:  # noqa: ARG002 -- an override
        if isinstance(self.method, Tableau):
            return RoundedTableau.printed(tableau, {})
        found: RoundedTableau = self.method
        return found


class RowSubject(TableSubject):
    """``timed`` is for f(t, y), with c and d; only careless rounding explains ``careless``."""

    timed: Judged | None = None
    careless: tuple[Remark, ...] = ()

    @property
    def judged_orders(self) -> tuple[Judged | None, ...]:
        return self.order, self.timed, self.embedded_order

    @property
    def nonautonomous(self) -> Judged | None:
        return self.timed


def _radii(numbers: Sequence[tuple[Any, Any]]) -> list[fmpq]:
    """Ten units in the last digit of each long decimal, and zero for others."""
    fewest = fewest_digits(text for text, _ in numbers)
    return [SLACK * unit_of(text, fewest) for text, _ in numbers]


def with_row_orders(table: FoundTable, name: str = "") -> RowSubject:
    """An estimate gets the sign with the higher order; MethodFileError for no method."""
    subject = _subject(table, read(table, name))
    embedded = subject.embedded_order
    # conditions are linear in the weights: both signs fail those that e alone fails
    if table.error is None or embedded is None or embedded.order != subject.order.order:
        return subject
    turned = replace(table, error=tuple(f"-({x})" for x in table.error))
    other = _subject(turned, read(turned, name))
    assert other.embedded_order is not None
    if other.embedded_order.order <= embedded.order:
        return subject
    sign = f"order {other.embedded_order.order} with the embedded weights m + e, as they are read"
    return replace(other, sign=f"{sign}, and {embedded.order} with m - e")


def _careless(numbers: Sequence[tuple[Any, Any]]) -> list[fmpq]:
    """The radii of numbers computed in floats, which lost digits."""
    radii = []
    for radius, (_, x) in zip(_radii(numbers), numbers, strict=True):
        least = CARELESS * FLOAT * (1 + rounded_up(abs(to_ball(x))))
        radii.append(max(radius * (CARELESS // SLACK), least) if radius else radius)
    return radii


def _subject(table: FoundTable, method: MethodFile) -> RowSubject:
    found = _within(table, method, within_digits(method.tableau, _radii))
    if not _misses_by_little(found):
        return found
    again = _within(table, method, within_digits(method.tableau, _careless))
    remarks = tuple(_explained(found, again))
    return replace(again, careless=remarks) if remarks else found


def _explained(found: RowSubject, again: RowSubject) -> Iterator[Remark]:
    """The orders that only careless rounding explains: a wrong digit is possible as well."""
    what = ("order", "order where f depends on t", "embedded order")
    orders = None
    for name, one, other in zip(what, found.judged_orders, again.judged_orders, strict=True):
        if one is None or other is None or not one.order < other.order:
            continue
        if orders == (one.order, other.order):
            continue  # time changes nothing
        orders = one.order, other.order
        off = "" if other.rounded is None else f" by {_digits(other.rounded[1])}"
        message = f"{name} {other.order} if decimals are off{off}, {one.order} as they are printed"
        yield Remark(f"{message}{_why(one)}: {EXPLAINED}", code="open", level="note")


def _digits(off: fmpq) -> str:
    return decimal(rounded_up(to_ball(off)))


def _misses_by_little(found: RowSubject) -> bool:
    orders = found.judged_orders
    witnesses = [x.witness for x in orders if x is not None and x.witness is not None]
    return any(abs(to_ball(x.residual)) < _LITTLE for x in witnesses)


def _within(table: FoundTable, method: MethodFile, rounded: RoundedTableau | None) -> RowSubject:
    within = method.tableau if rounded is None else rounded.of_orders()
    if _are_many(within):
        note = f"each condition is judged by itself, as more than {MANY} numbers are rounded"
        table = replace(table, notes=(*table.notes, note))
    order = _order(within, table.order)
    # higher orders do not matter
    other_times = _with_time(table, within)
    timed = None if other_times is None else _order(other_times, table.order, order.order)
    embedded = None
    if method.embedded is not None:
        other = within.with_embedded() if isinstance(within, RoundedTableau) else None
        embedded = _order(
            as_embedded(printed(within), method.embedded) if other is None else other,
            table.embedded_order,
            order.order + 1,
        )
    return RowSubject(table, method, order, embedded, timed=timed)


def _with_time(table: FoundTable, method: AnyTableau) -> AnyTableau | None:
    if table.gamma is not None:
        return seen(method, "with_time")
    return with_time(method) if isinstance(method, Tableau) else method.with_time()


def _order(method: AnyTableau, declared: int | None, limit: int | None = None) -> Judged:
    if limit is None and declared:
        limit = declared + 1
    if _are_many(method):
        verdict = method.one_by_one(limit or DEFAULT_LIMIT)
        within_rounding = method.tableau, method.tolerance
        return Judged(
            verdict.order, False, verdict.witness, within_rounding, verdict.is_lower_bound
        )
    return judged(_Within(method=method), printed(method), declared, limit)


def _are_many(method: AnyTableau) -> TypeGuard[RoundedTableau]:
    """Whether it takes too long to find one method for all conditions together."""
    return isinstance(method, RoundedTableau) and len(method.search.box.numbers) > MANY


def row_findings(subject: RowSubject) -> Iterator[Remark]:
    yield from subject.careless
    table, order = subject.table, subject.order
    declared = table.order
    if declared is not None and not order.is_limited and order.order != declared:
        finding = _differing("order", order, declared)
        yield replace(finding, help=_mended(subject)) if finding.code == "order" else finding
    elif declared is None:
        yield from _slip(subject)
    timed = subject.timed
    if timed is not None and not timed.is_open and timed.order < order.order:
        by = "by c and d" if table.gamma is not None else "by its nodes"
        message = f"order {timed.order} where f depends on t, {by}, and else {order.order}"
        claims = {"nonautonomous-order": str(order.order)}
        yield Remark(message + _why(timed), code="nodes", claims=claims)
    embedded, local = subject.embedded_order, table.embedded_order
    if embedded is not None and local is not None:
        # without an order of the method KPP declares the smaller one of both
        least = min((order, embedded), key=lambda x: x.order) if declared is None else embedded
        if least.order != local and not least.is_limited:
            yield _differing("embedded order", least, local)
    elif embedded is not None and not embedded.order and not embedded.is_open:
        message = f"the embedded weights have order 0{_why(embedded)}"
        yield Remark(message, code="embedded-weights", claims={"embedded-order": '">= 1"'})


def _slip(subject: RowSubject) -> Iterator[Remark]:
    """A remark if no order is declared and one wrong number lowers it by several."""
    order = subject.order
    found = misprints(subject.method, order) if not order.is_open else ()
    message = f"order {order.order}{_why(order)}"
    if found:
        level: Severity = "error" if len(found) == 1 else "warning"
        claims, cure = {"order": str(found[0].order)}, str(misprint_text(found))
        yield Remark(message, code="order", level=level, claims=claims, help=cure)
    elif not (order.order or order.is_open or order.is_limited):
        yield Remark(message, code="weights", claims={"order": "1"})


def _mended(subject: RowSubject) -> str:
    """The numbers of which one keeps the method from its declared order; empty for none."""
    found = misprints(subject.method, subject.order, subject.table.order)
    return str(misprint_text(found)) if found else ""


def _differing(what: str, found: Judged, declared: int) -> Remark:
    code, message = what.replace(" ", "-"), f"{what} {found.order}, declared {declared}"
    if found.order > declared:
        return Remark(message, code=f"{code}-higher", level="warning")
    if found.is_open:
        message = f"{what} {declared} is declared, {found.order} is proved: rounding may be why"
        return Remark(message, code="open", level="note")
    return Remark(message + _why(found), code=code, claims={code: str(declared)})


def _why(found: Judged) -> str:
    return "" if found.witness is None else f"; {witness_text(found.witness, True)}"


def imported_row(table: FoundTable, name: str, is_as_found: bool) -> RowSubject:
    """Returns the method of a table; MethodFileError if its numbers give none."""
    subject = with_row_orders(table, name)
    subject = replace(subject, findings=tuple(row_findings(subject)))
    claims = {"order": subject.order.claim}
    if subject.timed is not None:
        claims["nonautonomous-order"] = subject.timed.claim
    if subject.embedded_order is not None and subject.embedded_order.order:
        claims["embedded-order"] = subject.embedded_order.claim
    if not is_as_found:
        claims |= {key: claim for x in subject.findings for key, claim in (x.claims or {}).items()}
    text = written(subject.table, name, _tolerance(subject), claims)
    return replace(subject, method=loads(text, place_of(table)), text=text)


def _tolerance(found: RowSubject) -> fmpq | None:
    """The power of ten that a file needs as tolerance for the orders; None if they hold exactly."""
    orders = [x for x in (found.order, found.timed, found.embedded_order) if x is not None]
    if all(x.rounded is None for x in orders):
        return None
    tableau, further = found.method.tableau, found.method.further
    least = min(to_float(x.rounded[1]) for x in orders if x.rounded is not None) or TINY
    for exponent in range(math.floor(math.log10(least)), MOST + 1):
        tolerance = fmpq(10) ** exponent
        method = meant(tableau, tolerance, further)
        assert isinstance(method, RoundedTableau)
        if _are_many(method):
            if all(x.rounded is None or x.rounded[1] <= tolerance for x in orders):
                return tolerance
            continue
        wanted: list[tuple[AnyTableau | None, Judged | None]] = [
            (method, found.order),
            (_with_time(found.table, method), found.timed),
        ]
        if found.embedded_order is not None:
            wanted.append((method.with_embedded(), found.embedded_order))
        if all(_has(each, order) for each, order in wanted):
            return tolerance
    return None


def _has(method: AnyTableau | None, wanted: Judged | None) -> bool:
    if wanted is None or not isinstance(method, RoundedTableau):
        return True
    return find_order_within(method, wanted.order).order >= wanted.order
