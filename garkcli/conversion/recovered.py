"""Recovers the method that a rounded file means, to any number of digits."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from operator import ge
from typing import TYPE_CHECKING, Any

from flint import arb, ctx, fmpq

from garkcli.check.analysis import Analysis, analyse
from garkcli.conversion.sheet import CannotConvert, Sheet
from garkcli.design.search.proposing import PRECISION, exact_form
from garkcli.exact.affine import Affine
from garkcli.exact.display import BITS_OF_A_DIGIT, plain_decimal
from garkcli.exact.enclosing import midpoint
from garkcli.exact.field import ONE, Number
from garkcli.frozen import Frozen, replace
from garkcli.methodfile.writer import Written
from garkcli.order.meant import as_meant, with_further
from garkcli.order.polishing import SPARE_DIGITS, polished
from garkcli.tableau.embedded import from_colours
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.stages import PointSpace

if TYPE_CHECKING:
    from garkcli.order.deciding import AnyOrder
    from garkcli.order.dense import DenseOrder
    from garkcli.tableau.tableau import Tableau

DIGITS = 50
"""Digits after the point, unless the file has more."""
DIGITS_OF_A_ROOT = 20
"""Digits that distinguish a root of a polynomial from the others."""
FEWEST_TO_RECOGNISE = 40
"""Fewest digits with which an exact number is proposed."""


class RecoveredMethod(Frozen, eq=False):
    """The method that a rounded one is taken to mean.

    Attributes:
        sheet: exact entries unchanged, others with the requested digits.
        tolerance: a unit of the last digit; with half a unit the method would be at an end of many
            radii, where no search finds it again.
        exact: texts of numbers that are not decimals, by value.
        proposals: texts of exact numbers suggested by the digits, by value; the shortest first.
        orders: of the method, its conjugate, its pair, its embedded weights and dense output.
        is_exact: whether only further weights are rounded.
    """

    sheet: Sheet
    tolerance: fmpq
    exact: Mapping[Number, str]
    proposals: Mapping[Number, str]
    orders: tuple[int, ...]
    is_exact: bool

    def text_with(self, proposals: Mapping[Number, str]) -> Callable[[Number], str]:
        known = {**self.exact, **proposals}

        def text(number: Number) -> str:
            assert isinstance(number, fmpq)
            return known.get(number) or plain_decimal(number)

        return text

    def tolerance_with(self, proposals: Mapping[Number, str]) -> Written | None:
        """The tolerance of a file with these exact numbers; None without decimals."""
        known = {fmpq(0), *self.exact, *proposals}
        further = self.sheet.further
        dense = [row for power in further.powers for row in power]
        rows = {"embedded": further.embedded or (), "dense": dense}
        rounded = [key for key, x in rows.items() if any(y not in known for z in x for y in z)]
        if self.is_exact:
            return dict.fromkeys(rounded, self.tolerance) or None
        return None if all(x in known for x in _numbers(self.sheet)) else self.tolerance


def recovered(
    method: GarkMethod, digits: int | None = None, is_recognising: bool = False
) -> RecoveredMethod:
    """CannotConvert for an exact method, MethodError if no more digits are known."""
    meant = with_further(as_meant(method))
    if meant is None:
        message = "the coefficients are exact: there is nothing to recover"
        cure = "a line such as tolerance: 1e-10 says that they are rounded"
        raise CannotConvert(message, cure)
    if digits is None:
        digits = max(DIGITS, len(str((1 / min(meant.search.box.radii, default=ONE)).floor())))
    # as gark check has it: with the orders of the conjugate and the pair as well
    analysis = analyse(method.tableau, tolerance=method.tolerance, further=method.further)
    search = meant.search
    many = max(digits, FEWEST_TO_RECOGNISE) if is_recognising else digits
    place = polished(search, many)
    with ctx.workprec(int((many + 2 * SPARE_DIGITS) * BITS_OF_A_DIGIT)):
        made = search.box.around(place.shifts).made
    unit = fmpq(10) ** -digits
    exact: dict[Number, str] = {}
    found: dict[Number, str] = {}

    def entry(value: Any, form: Any) -> Number:
        if isinstance(value, fmpq) and not isinstance(form, Affine):
            exact[value] = str(value)
            return value
        middle = midpoint(value) if isinstance(value, arb) else value
        near = nearest(middle, unit)
        if is_recognising and near not in found:
            text = _recognised(middle, many)
            if text is not None:
                found[near] = text
        return near

    with ctx.workprec(place.search.bits):
        values = search.box.at(place.shifts)
    whole = _entry_by_entry(values, made, entry)
    sheet = Sheet(*from_colours(whole, search.printed_further))
    is_exact = method.tolerance is None
    shortest = dict(sorted(found.items(), key=lambda x: len(x[1])))
    return RecoveredMethod(sheet, unit, exact, shortest, tuple(_orders(analysis)), is_exact)


def nearest(x: fmpq, unit: fmpq) -> fmpq:
    return unit * (x / unit + fmpq(1, 2)).floor()


def _recognised(x: fmpq, digits: int) -> str | None:
    """An exact number suggested by ``digits`` digits, which agrees with all known ones; or None."""
    near = plain_decimal(nearest(x, fmpq(10) ** -DIGITS_OF_A_ROOT))
    found = exact_form(x, digits, near)
    if found is None:
        return None
    text, exact = found
    with ctx.workprec(PRECISION):
        agrees = abs(arb(exact) - arb(x)) < arb(10) ** -(digits + SPARE_DIGITS - 2)
    return text if agrees else None


def _entry_by_entry(
    values: Tableau, forms: Tableau, entry: Callable[[Any, Any], Number]
) -> Tableau:
    def row(some: Sequence[Any], others: Sequence[Any]) -> tuple[Number, ...]:
        return tuple(map(entry, some, others))

    colours = tuple(
        replace(x, b=row(x.b, y.b), c=row(x.c, y.c))
        for x, y in zip(values.colours, forms.colours, strict=True)
    )
    blocks = {
        key: tuple(map(row, block, forms.blocks[key])) for key, block in values.blocks.items()
    }
    spaces = tuple(
        PointSpace(next(x.c for x in colours if x.space == k)) for k in range(len(values.spaces))
    )
    return replace(values, spaces=spaces, colours=colours, blocks=blocks)


def _numbers(sheet: Sheet) -> Iterator[Number]:
    for row in sheet.tableau.rows:
        yield from row
    for weights in sheet.further.rows:
        for row in weights:
            yield from row


def is_as_good(made: GarkMethod, found: RecoveredMethod) -> bool:
    return all(map(ge, orders_of(made), found.orders))


def orders_of(method: GarkMethod) -> list[int]:
    return _orders(analyse(method.tableau, tolerance=method.tolerance, further=method.further))


def _orders(a: Analysis) -> list[int]:
    found: list[AnyOrder | DenseOrder | None] = [a.order, a.conjugate_order, a.pair_order]
    found.append(None if a.embedded is None else a.embedded.order)
    found.append(None if a.dense is None else a.dense.order)
    return [0 if x is None else x.order for x in found]
