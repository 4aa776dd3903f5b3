"""Error estimates E of sources that do not say whether they are b − b̂ or b̂ − b."""

from __future__ import annotations

from garkcli.bridges.subject import TableSubject, orders_of, read
from garkcli.frozen import replace
from garkcli.methodfile.build import MethodFile
from garkcli.sources.found import FoundTable


def with_orders(table: FoundTable, method: MethodFile, limit: int | None = None) -> TableSubject:
    """Orders up to ``limit``; MethodFileError if numbers of the other sign give no method.

    For an estimate E the embedded weights are b − E or b + E: those with the declared order, else
    those with the higher order, else those of a published pair. Conditions are linear in the
    weights: if E fails one that b meets, both b − E and b + E fail it. So their orders differ only
    if b̂ has the higher order, or if rounding spoils one of them.
    """
    minus = TableSubject(table, method, *orders_of(method, table, limit))
    if table.turned is None or minus.embedded_order is None:
        return minus
    plus = _turned(minus, limit)
    signs = {minus: "b - E", plus: "b + E"}
    fits = {each: _fit(each) for each in signs}
    if fits[minus] != fits[plus]:
        worse, better = sorted(signs, key=fits.__getitem__)
        sign = f"{_order(better)} with the embedded weights {signs[better]}, as they are read"
        return replace(better, sign=f"{sign}, and {_order(worse)} with {signs[worse]}")
    name, chosen = _published(plus), plus
    if not name:
        name, chosen = _published(minus), minus
    other = plus if chosen is minus else minus
    sign = f"the embedded weights are read as {signs[chosen]}"
    sign += f", as in {name} of the catalogue" if name else ", as no sign is known"
    sign += f"; {signs[other]} has the same order, and the estimate the same size"
    return replace(chosen, sign=sign, is_sign_open=not name)


def _turned(minus: TableSubject, limit: int | None) -> TableSubject:
    table = replace(minus.table, embedded=minus.table.turned, turned=None)
    plus = TableSubject(table, read(table, minus.method.name), minus.order, minus.embedded_order)
    embedded, declared = minus.embedded_order, table.embedded_order
    assert embedded is not None
    if 0 < embedded.order < minus.order.order and declared in (None, embedded.order):
        return plus
    return replace(plus, embedded_order=orders_of(plus.method, table, limit)[1])


def _fit(found: TableSubject) -> tuple[bool, int]:
    order = _number(found)
    return order == found.table.embedded_order, order


def _number(found: TableSubject) -> int:
    return 0 if found.embedded_order is None else found.embedded_order.order


def _order(found: TableSubject) -> str:
    return f"order {_number(found)}"


def _published(found: TableSubject) -> str:
    """The published pair of a method with its embedded weights; empty if there is none."""
    from garkcli.catalogue.known import known_of

    known = known_of(found.method)
    return "" if known is None or known.step_only else known.method
