"""Multirate infinitesimal methods in sources: the couplings of SUNDIALS."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from garkcli.frozen import replace
from garkcli.sources.found import FoundCoupling, FoundTable, Misshapen, Row, Rows, Unreadable
from garkcli.sources.shaping import Texts, is_zero, weights
from garkcli.sources.values import Value, Word, whole

FORM = "coupling"
"""The signature of a coupling with explicit matrices."""
_RESTARTS = {"MRISTEP_MERK": "merk", "MRISTEP_SR": "sr"}


def coupling_table(
    texts: Mapping[str, Texts], empty: FoundTable, roles: Mapping[str, Value]
) -> FoundTable:
    """The table of a coupling with matrices ``W`` and ``G``, each with a row for every stage and
    one for the embedded value.

    Args:
        texts: its arrays by their roles.
        empty: the table without coefficients.
        roles: the values, for whole numbers.

    Raises:
        Unreadable: an array is missing, or is no array.
        Misshapen: it does not fit the nodes.
    """
    c = weights(texts.get("c"))
    stages = whole(roles.get("stages"))
    if stages != len(c):
        raise Misshapen(f"{len(c)} nodes for {stages} stages")
    is_embedded = empty.embedded_order is not None
    parts: dict[str, tuple[Rows, ...]] = {}
    embedded: dict[str, Rows] = {}
    for key in ("omega", "gamma"):
        powers = _powers(texts.get(key), len(c), is_embedded)
        while powers and all(is_zero(x) for row in powers[-1] for x in row):
            powers.pop()
        if powers:
            parts[key] = tuple(rows[1 : len(c)] for rows in powers)
            last = [row for rows in powers for row in rows[len(c) :]]
            while last and all(map(is_zero, last[-1])):
                last.pop()
            embedded[key] = tuple(last)
    if not parts:
        raise Unreadable("a coupling without coefficients")
    kind = roles.get("type")
    restart = _RESTARTS.get(kind.text, "") if isinstance(kind, Word) else ""
    if restart == "sr" and "gamma" in embedded:
        embedded["gamma"] = embedded["gamma"][:1]
    coupling = FoundCoupling(c, parts, embedded if is_embedded else {}, restart)
    return replace(empty, coupling=coupling, is_sure=True)


def _powers(value: Texts, stages: int, is_embedded: bool) -> list[Rows]:
    """The matrices of τ⁰, τ¹, …, with the row of the embedded value; also from one flat list."""
    if value is None:
        return []
    if not isinstance(value, list):
        raise Unreadable("matrices are expected")
    if value and not any(isinstance(x, list) for x in value):
        flat, size = weights(value), (stages + is_embedded) * stages
        if len(flat) % size:
            raise Misshapen(f"{len(flat)} coefficients for {stages} stages")
        starts = range(0, len(flat), size)
        return [_rows_of_flat(flat[i : i + size], stages) for i in starts]
    return [_rows(x, stages) for x in value]


def _rows_of_flat(flat: Sequence[str], stages: int) -> Rows:
    return tuple(tuple(flat[i : i + stages]) for i in range(0, len(flat), stages))


def _rows(value: Texts, stages: int) -> Rows:
    if not isinstance(value, list):
        raise Unreadable("a matrix is expected")
    rows: tuple[Row, ...] = tuple(weights(x, stages) for x in value)
    if len(rows) not in (stages, stages + 1):
        raise Misshapen(f"{len(rows)} rows for {stages} stages")
    return rows
