"""``gark list``: what method files and commands can name."""

from __future__ import annotations

from collections.abc import Mapping
from textwrap import wrap
from typing import NamedTuple

from garkcli.families.registry import Family
from garkcli.page.paint import Paint, indented
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import TEXT, Schema, published

SCHEMA = "gark/list/1"
_WIDTH = 80


def render(
    families: Mapping[str, Family],
    rules: Mapping[str, str],
    problems: Mapping[str, str],
    format: str,
    paint: Paint,
) -> str:
    """The lists as text or JSON."""
    if format == "json":
        return _REPORT.text(_Lists(families, rules, problems))
    lines = _families(families, paint)
    for title, entries in (("transfer rules", rules), ("problems", problems)):
        lines += ["", paint("strong", title)]
        lines += _entries(entries)
    lines += [
        "",
        "A problem of your own is a file: --problem FILE.yaml, see docs/problem-file.md.",
    ]
    return "\n".join(lines) + "\n"


def _families(families: Mapping[str, Family], paint: Paint) -> list[str]:
    """A line for each family, below their heads."""
    head = f"{'families':<20} {'stages':<8} order"
    lines = [paint("strong", head)]
    for family in families.values():
        stages = _stages(family)
        about = f"{family.order:<7} {family.summary}"
        lines.append(f"  {family.name:<18} {stages:<8} {about}")
    return lines


def _entries(entries: Mapping[str, str]) -> list[str]:
    """Names with their summaries beside them."""
    width = max(map(len, entries)) + 4
    margin = " " * width
    lines = []
    for name, summary in entries.items():
        first, *rest = wrap(summary, _WIDTH - width)
        label = f"  {name}".ljust(width)
        lines.append(label + first)
        lines += indented(rest, margin)
    return lines


class _Lists(NamedTuple):
    """Families by their names, and summaries of the others by theirs."""

    families: Mapping[str, Family]
    rules: Mapping[str, str]
    problems: Mapping[str, str]


def _stages(family: Family) -> str:
    smallest = str(family.smallest)
    if family.largest == family.smallest:
        return smallest
    return f">= {smallest}"


_FAMILY: Record[Family] = Record(
    Field("name", TEXT, lambda x: x.name),
    Field("stages", TEXT, _stages),
    Field("order", TEXT, lambda x: x.order),
    Field("summary", TEXT, lambda x: x.summary),
)
_NAMED: Record[tuple[str, str]] = Record(
    Field("name", TEXT, lambda x: x[0]),
    Field("summary", TEXT, lambda x: x[1]),
)
_REPORT: Record[_Lists] = Record(
    schema_named(SCHEMA),
    _FAMILY.every("families", lambda x: x.families.values()),
    _NAMED.every("transfer", lambda x: x.rules.items()),
    _NAMED.every("problems", lambda x: x.problems.items()),
)


def list_report_schema() -> Schema:
    """The JSON Schema of ``gark list``."""
    return published("report of gark list", _REPORT.schema)
