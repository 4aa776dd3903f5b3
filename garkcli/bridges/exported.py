"""Methods of further kinds in JSON of gark: the keys of their files, and the verdict on them."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any, TypeAlias, TypeGuard

from garkcli.bridges.importing import place_of, written
from garkcli.bridges.judging import Judged
from garkcli.bridges.orders import find_orders
from garkcli.bridges.payload import SCHEMA, Kind
from garkcli.bridges.subject import TableSubject
from garkcli.frozen import replace
from garkcli.methodfile.load import loads
from garkcli.sources.found import FoundTable

_KEYS: Mapping[Kind, tuple[str, ...]] = {
    "row": ("alpha", "gamma", "b", "c", "d", "embedded", "dense"),
    "nystrom": ("Abar", "A", "c", "bbar", "b", "embedded", "dense"),
    "nprk": ("a", "b", "embedded"),
    "derivatives": ("A", "b", "c", "embedded"),
    "mri": ("c", "alpha", "beta", "omega", "gamma", "embedded"),
}
_DEEPEST = 5
_TOLERANCE = re.compile(r"[0-9.]+(e-?[0-9]+)?", re.IGNORECASE)
_RESTARTS = ("merk", "sr")
Arrays: TypeAlias = dict[str, Any]


def exported_table(text: str, source: str, format: str) -> FoundTable | None:
    """Returns the table; None if gark did not write the text, or its kind has its own reader."""
    if SCHEMA not in text:
        return None
    try:
        document = json.loads(text, parse_float=str, parse_int=str)
    except (ValueError, RecursionError):
        return None
    if not isinstance(document, dict) or document.get("schema") != SCHEMA:
        return None
    kind = next((x for x in _KEYS if x == document.get("kind")), None)
    if kind is None:
        return None
    form = _FORMS.get(kind, _by_kind)(kind, document)
    name, nodes = document.get("name"), document.get("c", [])
    return FoundTable(
        source,
        1,
        format,
        name if isinstance(name, str) else "",
        (),
        (),
        (),
        order=_count(document.get("order")),
        embedded_order=_count(document.get("embedded_order")),
        form={**form, **_tolerance(document)},
        form_stages=len(nodes) if _is_array(nodes) else 0,
    )


def _count(value: object) -> int | None:
    return int(value) if isinstance(value, str) and value.isdecimal() and len(value) < 4 else None


def _arrays(kind: Kind, document: Mapping[str, Any]) -> Arrays:
    return {key: document[key] for key in _KEYS[kind] if _is_array(document.get(key))}


def _is_array(value: object, depth: int = 0) -> TypeGuard[list[Any]]:
    """Whether a value is a row of texts, or of such rows and nothing."""
    if not isinstance(value, list) or depth > _DEEPEST:
        return False
    is_row = all(isinstance(x, str) for x in value)
    return is_row or all((x is None and depth) or _is_array(x, depth + 1) for x in value)


def _by_kind(kind: Kind, document: Mapping[str, Any]) -> Arrays:
    return {kind: _arrays(kind, document)}


def _rosenbrock(kind: Kind, document: Mapping[str, Any]) -> Arrays:
    arrays = _arrays(kind, document)
    b = arrays.get("b") or [""]
    if isinstance(b[0], list):
        return {"rosenbrock": {"blocks": arrays}}
    return {"rosenbrock": _with_dense(arrays)}


def _with_dense(arrays: Arrays) -> Arrays:
    dense = arrays.pop("dense", None)
    if dense:
        arrays["dense"] = {"degree": str(max(map(len, dense))), "weights": dense}
    return arrays


def _nystrom(kind: Kind, document: Mapping[str, Any]) -> Arrays:
    """The arrays with both rows of embedded weights together."""
    arrays = _arrays(kind, document)
    embedded = arrays.pop("embedded", None)
    bbar = document.get("embedded_bbar")
    if embedded and _is_array(bbar):
        arrays["embedded"] = {"bbar": bbar, "b": embedded}
    dense, of_q = arrays.pop("dense", None), document.get("dense_bbar")
    if dense and of_q and _is_array(of_q):
        arrays["dense"] = {"degree": str(max(map(len, of_q))), "bbar": of_q, "b": dense}
    return {"nystrom": arrays}


def _multirate(kind: Kind, document: Mapping[str, Any]) -> Arrays:
    coupling_document = document.get("multirate")
    multirate: Arrays = {"fast": "exact"}
    for key in ("mri", "mis"):
        coupling = coupling_document.get(key) if isinstance(coupling_document, dict) else None
        if isinstance(coupling, dict):
            arrays = _arrays(kind, coupling)
            restart, embedded = coupling.get("restart"), coupling.get("embedded")
            if isinstance(embedded, dict):
                arrays["embedded"] = _arrays(kind, embedded)
            known = {"restart": restart} if restart in _RESTARTS else {}
            multirate[key] = {**known, **arrays}
    return {"multirate": multirate}


_FORMS = {"row": _rosenbrock, "nystrom": _nystrom, "mri": _multirate}


def _tolerance(document: Mapping[str, Any]) -> Arrays:
    keys = {"others": "tolerance", "embedded": "embedded_tolerance", "dense": "dense_tolerance"}
    tolerances = {
        name: text
        for name, key in keys.items()
        if isinstance(text := document.get(key), str) and _TOLERANCE.fullmatch(text)
    }
    if not tolerances:
        return {}
    if "others" in tolerances and len(set(tolerances.values())) == 1:
        return {"tolerance": tolerances["others"]}
    return {"tolerance": tolerances}


def judged_export(table: FoundTable, name: str = "", is_as_found: bool = False) -> TableSubject:
    """Returns the method with its orders; MethodFileError if the document has none."""
    from garkcli.bridges.rosenbrock import RowSubject, row_findings  # few sources have them

    method = loads(written(table, name, None, {}), place_of(table))
    orders = find_orders(method.tableau, method.embedded, method.tolerance)
    order = Judged(orders.order, is_limited=orders.is_lower_bound)
    embedded = None if orders.embedded is None else Judged(orders.embedded)
    subject = RowSubject(table, method, order, embedded)
    subject = replace(subject, findings=tuple(row_findings(subject)))
    claims = {"order": order.claim}
    if embedded is not None and embedded.order:
        claims["embedded-order"] = embedded.claim
    if not is_as_found:
        claims |= {key: claim for x in subject.findings for key, claim in (x.claims or {}).items()}
    text = written(table, name, None, claims)
    return replace(subject, method=loads(text, place_of(table)), text=text)
