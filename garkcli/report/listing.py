"""``gark list``: what method files and commands can name."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from textwrap import wrap
from typing import NamedTuple

from garkcli.constructions.schemes.flows import Splitting
from garkcli.constructions.schemes.scheme import Scheme
from garkcli.families.family import Family, Option
from garkcli.page.paint import Paint, indented
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import TEXT, Schema, published

SCHEMA = "gark/list/1"
_WIDTH = 80
_NAME = 21  # columns for the name of a family


class Lists(NamedTuple):
    """Families, schemes and splittings by their names, and summaries of the others by theirs."""

    families: Mapping[str, Family]
    rules: Mapping[str, str]
    schemes: Mapping[str, Scheme]
    splittings: Mapping[str, Splitting]
    problems: Mapping[str, str]


def render(lists: Lists, format: str, paint: Paint) -> str:
    """The lists as text or JSON."""
    if format == "json":
        return _REPORT.text(lists)
    lines = _families(lists.families, paint)
    for title, entries in (
        ("transfer rules", lists.rules),
        ("schemes of compose", _with_orders(lists.schemes)),
        ("schemes of splitting", _with_orders(lists.splittings)),
        ("problems", lists.problems),
    ):
        lines += ["", paint("strong", title)]
        lines += _entries(entries)
    lines += ["", "A problem of your own is a file: --problem FILE.yaml, see docs/problem-file.md."]
    return "\n".join(lines) + "\n"


def _with_orders(schemes: Mapping[str, Scheme] | Mapping[str, Splitting]) -> dict[str, str]:
    """The summaries of schemes, with their orders."""
    return {name: f"order {scheme.order}: {scheme.summary}" for name, scheme in schemes.items()}


def _families(families: Mapping[str, Family], paint: Paint) -> list[str]:
    """A line for each family, below their heads; what else it is chosen by below it."""
    head = f"{'families':<20} {'stages':<8} order"
    lines = [paint("strong", head)]
    for family in families.values():
        name = f"  {family.name:<18} "
        if len(name) > _NAME:  # it has a line of its own
            lines.append(name.rstrip())
            name = " " * _NAME
        about = f"{family.order:<7} {family.summary}"
        lines.append(f"{name}{_stages(family):<8} {about}")
        for key, values in _chosen_by(family):
            lines.append(" " * _NAME + f"{key}: {values}")
    return lines


def _stages(family: Family) -> str:
    """How many stages its members have; empty where they are counted by something else."""
    return _sizes(family) if family.size == "stages" else ""


def _sizes(family: Family) -> str:
    smallest = str(family.smallest)
    return smallest if family.is_single else f">= {smallest}"


def _chosen_by(family: Family) -> Iterator[tuple[str, str]]:
    """The keys of a family besides its stages, with what they may be."""
    if family.size != "stages":
        yield family.size, _sizes(family)
    for option in family.options:
        yield option.name, _values(option)


def _values(option: Option) -> str:
    if option.words:
        return ", ".join(option.words)
    if option.smallest is not None:
        return f">= {option.smallest}"
    return "a coefficient"


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


_OPTION: Record[tuple[str, str]] = Record(
    Field("key", TEXT, lambda x: x[0]), Field("values", TEXT, lambda x: x[1])
)


_FAMILY: Record[Family] = Record(
    Field("name", TEXT, lambda x: x.name),
    Field("stages", TEXT, _stages),
    _OPTION.every("options", _chosen_by),
    Field("order", TEXT, lambda x: x.order),
    Field("summary", TEXT, lambda x: x.summary),
)
_NAMED: Record[tuple[str, str]] = Record(
    Field("name", TEXT, lambda x: x[0]), Field("summary", TEXT, lambda x: x[1])
)
_SCHEME: Record[Scheme | Splitting] = Record(
    Field("name", TEXT, lambda x: x.name),
    Field("order", TEXT, lambda x: x.order),
    Field("summary", TEXT, lambda x: x.summary),
    Field("reference", TEXT, lambda x: x.reference),
)
_REPORT: Record[Lists] = Record(
    schema_named(SCHEMA),
    _FAMILY.every("families", lambda x: x.families.values()),
    _NAMED.every("transfer", lambda x: x.rules.items()),
    _SCHEME.every("schemes", lambda x: x.schemes.values()),
    _SCHEME.every("splittings", lambda x: x.splittings.values()),
    _NAMED.every("problems", lambda x: x.problems.items()),
)


def list_report_schema() -> Schema:
    """The JSON Schema of ``gark list``."""
    return published("report of gark list", _REPORT.schema)
