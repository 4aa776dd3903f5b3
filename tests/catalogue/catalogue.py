"""Published methods as their sources print them, one JSON file each in ``data/``.

Keys: ``name``; ``kind`` (rk, ark, prk, gark); ``N`` colours; ``stages``; ``problem_class``
(general, separable, rkn); ``claimed_order`` by the source; ``verified_order``, computed from all
trees of the class in 260-bit arithmetic; ``exact``, whether the coefficients are free of rounding;
``rounding``, the tolerance at which the verified order was decided; ``source``; ``notes``;
``blocks`` with ``A[l][m]``, ``b[l]``, ``c[l]``, numbers as text.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any, TypeAlias, cast

from garkcli.exact.domain import Domain
from garkcli.exact.enclosing import enclose
from garkcli.exact.expression import parse
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.tableau.forms import separable_prk, spelled_out, with_linear
from garkcli.tableau.tableau import Tableau

Entry: TypeAlias = dict[str, Any]


def entries() -> dict[str, Entry]:
    """Every method of the catalogue by its name."""
    files = sorted((Path(__file__).parent / "data").glob("*.json"))
    return {file.stem: json.loads(file.read_text(encoding="utf-8")) for file in files}


def tableau(entry: Entry) -> Tableau:
    """The exact tableau of an entry, for the class of problems that it is meant for."""
    expressions = {text: parse(text) for text in sorted(set(_texts(entry["blocks"])))}
    domain = Domain(expressions.values())
    return _made(
        entry, {text: domain.evaluate(expression) for text, expression in expressions.items()}
    )


def in_balls(entry: Entry) -> Tableau:
    """The same with enclosures at the current precision in place of numbers: for the oracles
    alone.
    """
    values = {text: enclose(parse(text)) for text in set(_texts(entry["blocks"]))}
    return _made(entry, cast("dict[str, Number]", values))


def _made(entry: Entry, values: dict[str, Number]) -> Tableau:
    """The tableau with a value for each text.

    ``separable`` and ``rkn`` are q̇ = V(p), ṗ = F(q): of the four blocks printed, A^{1,2} and
    A^{2,1} take part. In ``rkn`` the velocities are linear.
    """

    def vector(row: list[str]) -> Vector:
        return tuple(values[text] for text in row)

    def matrix(rows: list[list[str]]) -> Matrix:
        return tuple(vector(row) for row in rows)

    A = [[matrix(block) for block in row] for row in entry["blocks"]["A"]]
    b, c = ([vector(row) for row in entry["blocks"][key]] for key in ("b", "c"))
    if entry["problem_class"] == "general":
        return spelled_out(A, b, list(c))
    made = separable_prk((A[1][0], b[0], c[1]), (A[0][1], b[1], c[0]))
    return with_linear(made, ["q"]) if entry["problem_class"] == "rkn" else made


def _texts(blocks: Any) -> list[str]:
    if isinstance(blocks, str):
        return [blocks]
    parts = blocks.values() if isinstance(blocks, dict) else blocks
    return [text for part in parts for text in _texts(part)]
