"""Couplings of multirate infinitesimal methods by the keys of method files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.payload import Payload
from garkcli.constructions.infinitesimal import Coupling
from garkcli.exact.matrix import Vector


def coupling_of(payload: Payload) -> Coupling:
    if payload.coupling is None:
        message = f"{payload.name} is no multirate infinitesimal step"
        cure = "give the slow method alone, or a file with multirate: {mis: ...} or {mri: ...}"
        raise CannotExport(message, cure)
    return payload.coupling


_NAMES = {"": (("gamma",), ("omega", "gamma")), "merk": (("omega",),)}
_NAMES["sr"] = (("omega",), ("omega", "gamma"))


def names_of(coupling: Coupling) -> Sequence[str]:
    assert coupling.matrices is not None
    return _NAMES[coupling.restart][len(coupling.matrices) - 1]


def embedded_rows(coupling: Coupling) -> Mapping[str, Sequence[Vector]]:
    last = coupling.embedded
    if last is None:
        return {}
    rows = last.forcing
    if coupling.restart:
        rows = (last.forcing[0], last.after[-1:])
    return dict(zip(names_of(coupling), rows, strict=False))


def keys_of(coupling: Coupling) -> Mapping[str, Mapping[str, Any]]:
    """The coupling as under ``multirate``: ``mri``, or ``mis`` with α, β and γ."""
    if coupling.matrices is None:
        intervals = coupling.intervals
        beta = tuple(x.forcing[0][0] for x in intervals)
        rows = {"alpha": tuple(x.begin for x in intervals), "beta": beta}
        return {"mis": {**rows, "gamma": tuple(x.drift for x in intervals)}}
    names, embedded = names_of(coupling), embedded_rows(coupling)
    parts = dict(zip(names, coupling.matrices, strict=True))
    keys: dict[str, Any] = {"restart": coupling.restart} if coupling.restart else {}
    keys |= {"c": coupling.nodes, **parts}
    embedded_parts = {key: tuple(rows) for key, rows in embedded.items() if rows}
    if embedded_parts:
        keys["embedded"] = embedded_parts if len(names) > 1 else embedded_parts[names[0]]
    return {"mri": keys}
