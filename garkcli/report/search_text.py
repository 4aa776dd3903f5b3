"""``gark design --search`` for people."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from textwrap import wrap

from garkcli.design.search.run import Ending, Result
from garkcli.design.search.search import Search
from garkcli.design.search.told import Method
from garkcli.errors import counted
from garkcli.page.plain import printable

_ROOT = re.compile(r"root_of\([^()]*\)")
INDENT = " " * 9
SHOWN = 24
"""Decimals of numbers that are not exact; files have all."""


def render(
    source: str, search: Search, result: Result, files: Sequence[str | None], width: int
) -> str:
    """The result as text.

    Args:
        source: the file.
        search: what was looked for.
        result: what was found.
        files: where each method was written, if it was.
        width: columns to fill.
    """
    family = search.family
    lines = [printable(source), f"  {printable(family.name)}"]
    names = ", ".join(family.parameters)
    unknowns = f"unknown {names}; order {search.order} of the {search.whose}"
    lines += wrap(unknowns, width, initial_indent="  ", subsequent_indent="  ")
    lines += ["", f"  {_summary(result)}"]
    if result.degenerate:
        solutions = counted(result.degenerate, "solution")
        lines.append(f"  {solutions} in floats with no method near")
    if not result.methods:
        lines.append("  no method found, which does not say that there is none")
    for number, (method, path) in enumerate(zip(result.methods, files, strict=True), start=1):
        lines.append("")
        lines += _method(number, method, path, width)
    return "\n".join(lines) + "\n"


_ENDINGS: dict[Ending, str] = {
    "interrupt": "interrupted",
    "time": "the time of --seconds was over",
    "worker": "a process was lost",
}


def _summary(result: Result) -> str:
    starts = counted(result.starts, "start")
    end = "" if result.ending is None else f", then {_ENDINGS[result.ending]}"
    return f"{result.successes} of {starts} solve the conditions in floats{end}"


def _method(number: int, method: Method, path: str | None, width: int) -> Iterator[str]:
    where = f", written to {printable(path)}" if path is not None else ""
    head = f"{number:>5}  {_verdict(method)}; start {method.start}{where}"
    yield from wrap(
        head, width, initial_indent="  ", subsequent_indent=INDENT, break_on_hyphens=False
    )
    for line in _values(method):
        yield from wrap(
            line,
            width,
            initial_indent=INDENT,
            subsequent_indent=INDENT + "  ",
            break_on_hyphens=False,
        )


def _values(method: Method) -> Iterator[str]:
    """A line a parameter; a long root that is in them has a name of its own."""
    if not method.is_exact:
        yield from (f"{name} = {_short(x)}…" for name, x in method.values.items())
        return
    roots = {root for x in method.values.values() for root in _ROOT.findall(x)}
    name_of = {}
    if len(roots) == 1 and "r" not in method.values:
        (root,) = roots
        name_of[root] = "r"
        yield f"r = {root}"
    for name, value in method.values.items():
        for root, short in name_of.items():
            value = value.replace(root, short)
        yield f"{name} = {value}"


def _short(value: str) -> str:
    whole, _, decimals = value.partition(".")
    return f"{whole}.{decimals[:SHOWN]}"


def _verdict(method: Method) -> str:
    match method.proof:
        case "exact":
            return f"exact: order {method.order}, by the certificate"
        case "exists":
            return f"proved to exist: order at least {method.order}, by Krawczyk's test"
        case "numerical":
            return f"numerical: residuals below {method.residual} up to order {method.order}"
