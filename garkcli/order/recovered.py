"""Recovered methods of the catalogue, stored as starting points of a search.

A search checks the conditions that the file claims of the shifted numbers like its own.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from flint import fmpq

from garkcli.frozen import Frozen
from garkcli.ntrees.notation import format_tree, parse_tree
from garkcli.ntrees.tree import Tree
from garkcli.order.rows import Label, System, of_tree
from garkcli.tableau.box import Box

FILE = Path(__file__).with_name("recovered.json")


class Recovered(Frozen):
    """A method that meets the conditions of ``shape`` and the order conditions of ``system``.
    ``shifts`` are those of the numbers of the box, in units of their radii.
    """

    shifts: tuple[fmpq, ...]
    shape: System
    system: System


def key_of(box: Box) -> str:
    text = "\n".join(f"{x} {t}" for x, t in zip(box.numbers, box.radii, strict=True))
    return hashlib.sha256(text.encode("utf-8")).hexdigest()[:16]


def recovered_of(box: Box, known: Callable[[Tree], Tree]) -> Recovered | None:
    """The stored method of a box; ``known`` gives the vertices of a tree their kinds."""
    data = _all().get(key_of(box)) if box.numbers else None
    return _read(data, known) if data and "shifts" in data else None


def as_data(shifts: Sequence[fmpq], shape: System, system: System) -> dict[str, Any]:
    # the denominators of shifts are powers of 2
    bits = max((int(x.q).bit_length() - 1 for x in shifts), default=0)
    return {
        "bits": bits,
        "shifts": " ".join(f"{int((x * fmpq(1 << bits)).p):x}" for x in shifts),
        "shape": [
            [x.kind, x.l, x.m, x.k, list(x.path), _text(x), which]
            for x, which in shape.get("method", {}).items()
        ],
        "trees": [[name, x.k, _text(x)] for name, chosen in system.items() for x in chosen],
    }


def _text(label: Label) -> str:
    return "" if label.tree is None else format_tree(label.tree)


def kept() -> dict[str, dict[str, Any]]:
    if not FILE.exists():
        return {}
    methods: dict[str, dict[str, Any]] = json.loads(FILE.read_text(encoding="ascii"))
    return methods


@cache
def _all() -> dict[str, dict[str, Any]]:
    return kept()


def _read(data: Mapping[str, Any], known: Callable[[Tree], Tree]) -> Recovered:
    def tree_of(text: str) -> Tree:
        return known(parse_tree(text))

    unit = 1 << data["bits"]
    shape = {
        Label(kind, l, m, k, tree_of(text) if text else None, tuple(path)): list(which)
        for kind, l, m, k, path, text, which in data["shape"]
    }
    system: dict[str, dict[Label, list[int]]] = {}
    for name, k, text in data["trees"]:
        system.setdefault(name, {})[of_tree(tree_of(text), k)] = [0]
    shifts = tuple(fmpq(int(x, 16), unit) for x in data["shifts"].split())
    return Recovered(shifts, {"method": shape} if shape else {}, system)
