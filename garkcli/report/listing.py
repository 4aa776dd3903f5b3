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
    lines = [paint("strong", f"{'families':<20} {'stages':<8} order")]
    lines += [
        f"  {x.name:<18} {_stages(x):<8} {x.order:<7} {x.summary}"
        for x in families.values()
    ]
    for title, entries in (("transfer rules", rules), ("problems", problems)):
        width = max(len(name) for name in entries) + 4
        lines += ["", paint("strong", title)]
        for name, summary in entries.items():
            first, *rest = wrap(summary, _WIDTH - width)
            lines.append(f"  {name}".ljust(width) + first)
            lines += indented(rest, " " * width)
    lines += [
        "",
        "A problem of your own is a file: --problem FILE.yaml, see docs/problem-file.md.",
    ]
    return "\n".join(lines) + "\n"


class _Lists(NamedTuple):
    """Families by their names, and summaries of the others by theirs."""

    families: Mapping[str, Family]
    rules: Mapping[str, str]
    problems: Mapping[str, str]


def _stages(family: Family) -> str:
    return (
        str(family.smallest)
        if family.largest == family.smallest
        else f">= {family.smallest}"
    )


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
