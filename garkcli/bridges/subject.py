"""The method of a table: its orders, its rounding, and values shared by checks of an audit."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property

from flint import fmpq

from garkcli.bridges.importing import fmpq_of, fraction_of, numbers_of, parsed, place_of, written
from garkcli.bridges.judging import Digits, Judged, judged
from garkcli.check.findings import NEAR, sum_text
from garkcli.errors import Remark
from garkcli.exact.display import to_ball
from garkcli.exact.expression import parse
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix
from garkcli.frozen import Frozen
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import loads
from garkcli.methodfile.printed import FEW_PLACES, FEWEST_DIGITS, SEVERAL, SEVERAL_PLACES
from garkcli.order.certificate import StageSpans
from garkcli.order.rounded import RoundedTableau, find_order_within
from garkcli.order.sums import wrong_rows
from garkcli.sources.found import FoundTable
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.forms import with_time
from garkcli.tableau.tableau import Tableau

HIGH = 10
"""The highest order tried: a wrong digit shows at a lower one."""


class TableSubject(Frozen, eq=False):
    """``sign`` is that of an error estimate with the reason, empty if the source fixes it;
    ``is_sign_open`` if nothing decides it.
    """

    table: FoundTable
    method: MethodFile
    order: Judged
    embedded_order: Judged | None
    text: str = ""
    sign: str = ""
    is_sign_open: bool = False
    findings: tuple[Remark, ...] = ()

    @property
    def tolerance(self) -> fmpq | None:
        return self.method.tolerance

    @property
    def tableau(self) -> Tableau:
        return self.method.tableau

    @property
    def block(self) -> Matrix:
        """The only matrix; empty if there is none, or more than one."""
        return (self.tableau.size == 1 and self.tableau.block(0, 0)) or ()

    @cached_property
    def digits(self) -> Digits:
        return digits_of(self.method, self.table)

    @cached_property
    def rounded(self) -> RoundedTableau:
        return self.digits.of(self.tableau)

    @cached_property
    def wrong_rows(self) -> tuple[str, ...]:
        """Texts on the nodes that are not row sums, beyond what rounding explains."""
        return tuple(self._off(self.rounded))

    @property
    def careless_rows(self) -> tuple[str, ...]:
        """Texts on the nodes that differ from row sums by over one unit of the last place."""
        return tuple(self._off(self.digits.of(self.tableau, slack=1)))

    @cached_property
    def misprinted_rows(self) -> Mapping[str, Number]:
        """Texts on the nodes that careless rounding does not explain, with the differences."""
        return self._off(self.digits.careless(self.tableau))

    @property
    def is_misprinted(self) -> bool:
        """Whether a row sum is near its node beyond rounding: intended differences are larger."""
        return any(abs(to_ball(x)) < NEAR for x in self.misprinted_rows.values())

    @property
    def is_slightly_off(self) -> bool:
        """Whether the sum of a row or of the weights is wrong, or a condition fails by little."""
        witness = self.order.witness
        is_near = witness is not None and bool(abs(to_ball(witness.residual)) < NEAR)
        return not self.order.order or is_near or bool(self.wrong_rows)

    def _off(self, rounded: RoundedTableau) -> dict[str, Number]:
        """Texts on the nodes that are not row sums within a rounding, with the differences."""
        # parts on shared stages with their own times have their own row sums as nodes
        has_own_times = len(self.table.A) > 1 and len(set(self.table.A)) == 1
        edges = [(l, m) for l, m in self.tableau.edges() if not has_own_times or l == m]
        rows = wrong_rows(rounded.defects, edges)
        names = [colour.name for colour in self.tableau.colours]
        return {str(sum_text(row, names)): row.off for row in rows}

    @cached_property
    def nonautonomous(self) -> Judged | None:
        timed = with_time(self.tableau)
        if timed is None:
            return None
        if not self.wrong_rows:
            return self.order
        return judged(self.digits, timed, self.table.order, max(self.order.order, 1))

    @cached_property
    def misses_order(self) -> bool:
        """Whether the order is lower than declared, beyond careless rounding."""
        declared, found = self.table.order, self.order
        if declared is None or found.is_limited or found.is_open or found.order >= declared:
            return False
        return not self.is_careless(self.tableau, declared)

    def is_careless(self, tableau: Tableau, wanted: int) -> bool:
        """Whether careless rounding may explain why a tableau of these numbers lacks an order."""
        rounded, wanted = self.digits.careless(tableau), min(wanted, HIGH)
        return bool(rounded.tolerance) and find_order_within(rounded, wanted).order >= wanted


def read(table: FoundTable, name: str = "") -> MethodFile:
    """Reads a table as a method without tolerance; MethodFileError if its numbers give none."""
    return loads(written(table, name, None, {}), place_of(table))


def orders_of(
    method: MethodFile, table: FoundTable, limit: int | None = None
) -> tuple[Judged, Judged | None]:
    """Returns the orders of a method and its embedded weights within their digits."""
    admitted = fmpq_of(table.tolerance) if table.tolerance else None
    digits, spans = digits_of(method, table), StageSpans(method.tableau)
    order = judged(digits, method.tableau, table.order, limit, admitted, spans)
    if method.embedded is None:
        return order, None
    other = with_weights(method.tableau, method.embedded)
    return order, judged(digits, other, table.embedded_order, limit, admitted, spans)


def digits_of(method: MethodFile, table: FoundTable) -> Digits:
    """The precision of the coefficients, also if the method file has them as fractions."""
    texts = {x for x in numbers_of(table) if len(x) > FEWEST_DIGITS and "." in x}
    short = [(parse(x), fmpq_of(x)) for x in sorted(texts) if fraction_of(x)]
    units: dict[Number, fmpq] = {fmpq_of(text): unit for text, unit in table.units}
    return Digits((*method.printed, *short), units, {} if units else _short_units(table))


def _short_units(table: FoundTable) -> Mapping[Number, fmpq]:
    """Returns one unit of the last place of decimals of four or five places, if several and no
    longer ones.
    """
    values = [x for text in numbers_of(table) for x in [parsed(text)] if x]
    places = [_places(x) for x in values]
    short = range(SEVERAL_PLACES, FEW_PLACES.stop)
    if sum(n in short for n in places) < SEVERAL or max(places) not in short:
        return {}
    pairs = zip(values, places, strict=True)
    return {x: fmpq(1, 10**n) if n in short else fmpq(0) for x, n in pairs}


def _places(value: Number) -> int:
    """The places behind the point of a decimal, or its digits if these are few behind zeros; more
    than a few for other numbers.
    """
    most = FEW_PLACES.stop
    if not isinstance(value, fmpq):
        return most
    places = next((n for n in range(2 * most) if not 10**n % int(value.q)), 2 * most)
    has_few_digits = places < 2 * most and abs(value) * 10**places < 10 ** (most - 1)
    return min(places, most - has_few_digits)
