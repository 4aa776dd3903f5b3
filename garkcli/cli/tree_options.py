"""The options that ``gark trees`` and ``gark conditions`` share: colours, and free trees."""

from __future__ import annotations

from typing import cast

from garkcli.errors import UsageProblem
from garkcli.trees.symplectic import Kind


def kind_asked(symplectic: bool, kind: str | None, members: bool, format: str) -> Kind | None:
    """The kind of symplectic methods; None where all trees are meant.

    Raises:
        UsageProblem: options of ``--symplectic`` without it, or members in a LaTeX table.
    """
    if members and format == "latex":
        message = "--members do not fit into a LaTeX table"
        raise UsageProblem(message, "choose another --format", code="options-clash")
    if symplectic:
        return cast("Kind", kind or "pair")
    if kind is not None or members:
        option = "--members" if kind is None else "--kind"
        raise UsageProblem(f"{option} is about free trees", "add --symplectic", code="option-alone")
    return None
