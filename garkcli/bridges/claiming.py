"""The method file of a table, with the claims that its source declares, true or not."""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.bridges.audit import findings_of
from garkcli.bridges.estimates import with_orders
from garkcli.bridges.importing import fmpq_of, place_of, written
from garkcli.bridges.judging import Judged, at_least
from garkcli.bridges.subject import TableSubject, read
from garkcli.frozen import replace
from garkcli.methodfile.load import loads
from garkcli.properties.last_stage import FirstSameAsLast, first_same_as_last
from garkcli.sources.found import FoundTable

_OF_TABLE = {"order", "nonautonomous-order", "stage-order"}
"""Claims that a wrong entry or node makes false: its cure may change every order."""


def imported(table: FoundTable, name: str, is_as_found: bool = False) -> TableSubject:
    """Returns the method of a table; MethodFileError if its numbers give none."""
    subject = with_orders(table, read(table, name))
    subject = replace(subject, findings=findings_of(subject))
    tolerances = [fmpq_of(table.tolerance)] if table.tolerance else []
    orders = (subject.order, subject.embedded_order)
    tolerances += [x.tolerance for x in orders if x is not None and x.tolerance is not None]
    claims = true_claims(subject) if is_as_found else declared_claims(subject)
    text = written(subject.table, name, max(tolerances, default=None), claims)
    return replace(subject, method=loads(text, place_of(table)), text=text)


def true_claims(found: TableSubject) -> Mapping[str, str]:
    return {key: x.claim for key, x, _ in _orders(found) if x.order}


def declared_claims(found: TableSubject) -> Mapping[str, str]:
    """The declared orders, or the true ones if the source declares nothing.

    A declared order that is too low becomes a bound; one that the digits leave open is not claimed.
    """
    false = {key: claim for x in found.findings for key, claim in (x.claims or {}).items()}
    is_spoilt = bool(_OF_TABLE & false.keys())
    true, claims = true_claims(found), {}
    for key, order, declared in _orders(found):
        if key in false:
            claims[key] = false[key]
        elif declared and order.order > declared:
            claims[key] = at_least(declared)
        elif declared and is_spoilt:
            claims[key] = str(declared)
        elif key in true and not is_spoilt:
            claims[key] = true[key]
    if found.table.flags.get("fsal") and _is_fsal(found):
        claims["fsal"] = "true"
    return {**claims, **false}


def _is_fsal(found: TableSubject) -> bool:
    return first_same_as_last(found.tableau) == FirstSameAsLast()


def _orders(found: TableSubject) -> list[tuple[str, Judged, int | None]]:
    table, embedded = found.table, found.embedded_order
    orders = [("order", found.order, table.order)]
    if embedded is not None:
        orders.append(("embedded-order", embedded, table.embedded_order))
    return orders
