"""``gark list`` and ``gark list exports``: what files and commands can name, declared once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import NamedTuple

from garkcli.bridges.registry import Bridge
from garkcli.catalogue.mapping import method_names
from garkcli.constructions.schemes import SCHEMES, SPLITTINGS, Scheme, Splitting
from garkcli.errors import counted
from garkcli.families.family import Family, Option
from garkcli.families.registry import FAMILIES
from garkcli.frozen import replace
from garkcli.problems.builtin import PROBLEMS, BuiltIn
from garkcli.tell.facts import Level, Row, Section
from garkcli.tell.kinds import TEXT, TEXTS, TRUTH
from garkcli.tell.parts import BESIDE, parts, sentence, shown, table
from garkcli.tell.report import ListReport, Report
from garkcli.transfer import PAIR_RULES, SUMMARIES

DETAIL, DATA = Level.DETAIL, Level.DATA


class Lists(NamedTuple):
    """Families, schemes and splittings by their names, and summaries of the others by theirs."""

    families: Mapping[str, Family]
    rules: Mapping[str, str]
    schemes: Mapping[str, Scheme]
    splittings: Mapping[str, Splitting]
    problems: Mapping[str, BuiltIn]


def all_lists() -> Lists:
    """What method files and commands can name."""
    return Lists(FAMILIES, SUMMARIES, SCHEMES, SPLITTINGS, PROBLEMS)


def _sizes(family: Family) -> str:
    return str(family.smallest) if family.is_single else f">= {family.smallest}"


def chosen_by(family: Family) -> Iterator[tuple[str, str]]:
    """The keys of a family besides its stages, with what they may be."""
    if family.size != "stages":
        yield family.size, _sizes(family)
    for option in family.options:
        yield option.name, _values(option)


def _values(option: Option) -> str:
    if option.words:
        return ", ".join(option.words)
    return "a coefficient" if option.smallest is None else f">= {option.smallest}"


def _key_words(family: Family) -> str:
    return "; ".join(f"{key} {values}" for key, values in chosen_by(family))


NAME = Row("name", TEXT, "0", label="")
OPTION = Section(Row("key", TEXT, "0"), Row("values", TEXT, "1"))
FAMILY = Section(
    Row("name", TEXT, label=""),
    Row("stages", TEXT, lambda x: _sizes(x) if x.size == "stages" else ""),
    Row("options", parts(OPTION), lambda x: [*chosen_by(x)], DATA),
    Row("order", TEXT),
    Row("summary", TEXT),
    Row("options", BESIDE, _key_words, DETAIL),
    Row("reference", BESIDE, lambda x: str(x.reference), DETAIL),
)
RULE = Section(
    NAME,
    Row("summary", TEXT, "1"),
    Row("blocks", BESIDE, lambda x: "both" if x[0] in PAIR_RULES else "one", DETAIL),
)
PROBLEM = Section(
    Row("name", TEXT, label=""),
    Row("summary", TEXT),
    Row("formula", BESIDE, level=DETAIL),
    Row("trees", BESIDE, "sees", DETAIL),
)
TOPIC = Section(Row("name", TEXT, "0", label=""), Row("count", TEXT, "1"), Row("see", TEXT, "2"))
SCHEME = Section(
    Row("name", TEXT, label=""),
    Row("order", TEXT),
    Row("summary", TEXT),
    Row("reference", TEXT, level=DETAIL),
)


def _topics(lists: Lists) -> list[tuple[str, str, str]]:
    """What can be listed, how much there is of it, and the command."""
    counts = {"methods": len(method_names())}
    counts |= {name: len(x) for x, name in zip(lists, ROWS, strict=True)}
    return [(name, str(count), f"gark list {name}") for name, count in counts.items()]


ROWS = {
    row.key: row
    for row in (
        Row("families", table(FAMILY, 0), lambda x: [*x.families.values()]),
        Row("transfer", table(RULE, 0), lambda x: [*x.rules.items()]),
        Row("schemes", table(SCHEME, 0), lambda x: [*x.schemes.values()]),
        Row("splittings", table(SCHEME, 0), lambda x: [*x.splittings.values()]),
        Row("problems", table(PROBLEM, 0), lambda x: [*x.problems.values()]),
    )
}
"""By what gark list can list alone."""


def _counted(row: Row, lists: Lists) -> str:
    """How many a list has of what, above it."""
    return f"{len(row.value(lists))} {'transfer rules' if row.key == 'transfer' else row.key}"


REPORT: Report[Lists] = Report.only(
    "gark/list/1",
    "report of gark list",
    Section(
        Row("topics", shown(TOPIC, 0), _topics, label="", is_short=True),
        *(
            replace(line, level=DETAIL, is_optional=True)
            for row in ROWS.values()
            for line in (sentence(partial(_counted, row)), row)
        ),
        sentence(lambda _: "your own problem: --problem FILE.yaml (docs/problem-file.md)"),
        title=lambda *_: "what files and commands can name",
    ),
)


def only(what: str) -> Report[Lists]:
    """The report of one of the lists."""
    row = ROWS[what]
    section = Section(row, title=lambda x, _: _counted(row, x))
    return Report.only("gark/list/1", f"report of gark list {what}", section)


TARGET = Section(
    Row("name", TEXT, label=""),
    Row("kinds", TEXTS, lambda x: [*x.kinds]),
    Row("reads_back", TRUTH, level=DETAIL),
    Row("has_test", TRUTH, lambda x: x.words is not None, DETAIL),
    Row("suffix", TEXT, level=DETAIL),
    Row("summary", TEXT),
)


EXPORTS: Report[Mapping[str, Bridge]] = ListReport.only(
    "",
    "list of gark list exports",
    Section(
        Row("name", table(TARGET, 0), lambda found: [*found.values()]),
        title=lambda found, _: counted(len(found), "target"),
    ),
)
