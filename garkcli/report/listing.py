"""``gark list`` and ``gark list exports``: names for files and commands, declared once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import partial
from typing import NamedTuple

from garkcli.bridges.registry import STEPPED, Bridge, bridges
from garkcli.catalogue.mapping import method_names
from garkcli.constructions.schemes import SCHEMES, SPLITTINGS, Scheme, Splitting
from garkcli.errors import counted
from garkcli.families.family import MethodFamily, Option
from garkcli.families.registry import FAMILIES
from garkcli.problems.builtin import PROBLEMS, BuiltIn
from garkcli.tell.facts import Level, Row, Section
from garkcli.tell.kinds import TEXT, TEXTS, TRUTH
from garkcli.tell.parts import BESIDE, parts, sentence, shown, table
from garkcli.tell.report import ListReport, Report
from garkcli.transfer import PAIR_RULES, SUMMARIES

DETAIL, DATA = Level.DETAIL, Level.DATA


class Lists(NamedTuple):
    families: Mapping[str, MethodFamily]
    rules: Mapping[str, str]
    schemes: Mapping[str, Scheme]
    splittings: Mapping[str, Splitting]
    problems: Mapping[str, BuiltIn]


def all_lists() -> Lists:
    return Lists(FAMILIES, SUMMARIES, SCHEMES, SPLITTINGS, PROBLEMS)


def _sizes(family: MethodFamily) -> str:
    return str(family.smallest) if family.is_single else f">= {family.smallest}"


def chosen_by(family: MethodFamily) -> Iterator[tuple[str, str]]:
    if family.size != "stages":
        yield family.size, _sizes(family)
    for option in family.options:
        yield option.name, _values(option)


def _values(option: Option) -> str:
    if option.words:
        return ", ".join(option.words)
    return "a coefficient" if option.smallest is None else f">= {option.smallest}"


def _key_words(family: MethodFamily) -> str:
    return "; ".join(f"{key} {values}" for key, values in chosen_by(family))


NAME: Row[tuple[str, str]] = Row("name", TEXT, lambda x: x[0], label="")
OPTION: Section[tuple[str, str]] = Section(
    Row("key", TEXT, lambda x: x[0]), Row("values", TEXT, lambda x: x[1])
)
FAMILY: Section[MethodFamily] = Section(
    Row("name", TEXT, lambda x: x.name, label=""),
    Row("stages", TEXT, lambda x: _sizes(x) if x.size == "stages" else ""),
    Row("options", parts(OPTION), lambda x: [*chosen_by(x)], DATA),
    Row("order", TEXT, lambda x: x.order),
    Row("summary", TEXT, lambda x: x.summary),
    Row("options", BESIDE, _key_words, DETAIL),
    Row("reference", BESIDE, lambda x: str(x.reference), DETAIL),
)
RULE: Section[tuple[str, str]] = Section(
    NAME,
    Row("summary", TEXT, lambda x: x[1]),
    Row("blocks", BESIDE, lambda x: "both" if x[0] in PAIR_RULES else "one", DETAIL),
)
PROBLEM: Section[BuiltIn] = Section(
    Row("name", TEXT, lambda x: x.name, label=""),
    Row("summary", TEXT, lambda x: x.summary),
    Row("formula", BESIDE, lambda x: x.formula, DETAIL),
    Row("trees", BESIDE, lambda x: x.sees, DETAIL),
)
TOPIC: Section[tuple[str, str, str]] = Section(
    Row("name", TEXT, lambda x: x[0], label=""),
    Row("count", TEXT, lambda x: x[1]),
    Row("see", TEXT, lambda x: x[2]),
)
SCHEME: Section[Scheme | Splitting] = Section(
    Row("name", TEXT, lambda x: x.name, label=""),
    Row("order", TEXT, lambda x: x.order),
    Row("summary", TEXT, lambda x: x.summary),
    Row("reference", TEXT, lambda x: x.reference, DETAIL),
)


def _topics(lists: Lists) -> list[tuple[str, str, str]]:
    counts = {"methods": len(method_names())}
    counts |= {name: len(x) for x, name in zip(lists, ROWS, strict=True)}
    return [(name, str(count), f"gark list {name}") for name, count in counts.items()]


ROWS: dict[str, Row[Lists]] = {
    "families": Row("families", table(FAMILY, 0), lambda x: [*x.families.values()]),
    "transfer": Row("transfer", table(RULE, 0), lambda x: [*x.rules.items()]),
    "schemes": Row("schemes", table(SCHEME, 0), lambda x: [*x.schemes.values()]),
    "splittings": Row("splittings", table(SCHEME, 0), lambda x: [*x.splittings.values()]),
    "problems": Row("problems", table(PROBLEM, 0), lambda x: [*x.problems.values()]),
}


def _counted(row: Row[Lists], lists: Lists) -> str:
    """``25 families``."""
    return f"{len(row.get(lists))} {'transfer rules' if row.key == 'transfer' else row.key}"


REPORT: Report[Lists] = Report.only(
    "gark/list/1",
    "report of gark list",
    Section(
        Row("topics", shown(TOPIC, 0), _topics, label="", is_short=True),
        (
            line.but(level=DETAIL, is_optional=True)
            for row in ROWS.values()
            for line in (sentence(partial(_counted, row)), row)
        ),
        sentence(lambda _: "your own problem: --problem FILE.yaml (docs/problem-file.md)"),
        title=lambda *_: "what files and commands can name",
    ),
)


def only(what: str) -> Report[Lists]:
    row = ROWS[what]
    section = Section(row, title=lambda x, _: _counted(row, x))
    return Report.only("gark/list/1", f"report of gark list {what}", section)


TARGET: Section[Bridge] = Section(
    Row("name", TEXT, lambda x: x.name, label=""),
    Row("kinds", TEXTS, lambda x: [*x.kinds]),
    Row("reads_back", TRUTH, lambda x: x.reads_back, DETAIL),
    Row("has_test", TRUTH, lambda x: x.words is not None, DETAIL),
    Row("suffix", TEXT, lambda x: x.suffix, DETAIL),
    Row("summary", TEXT, lambda x: x.summary),
)


PROOF = Bridge(
    "certificate",
    "a proof of the orders, which a separate short script checks",
    ".json",
    (*STEPPED, "mri"),
)


def all_targets() -> Mapping[str, Bridge]:
    return dict(sorted({**bridges(), PROOF.name: PROOF}.items()))


EXPORTS: Report[Mapping[str, Bridge]] = ListReport.only(
    "",
    "list of gark list exports",
    Section(
        Row("name", table(TARGET, 0), lambda found: [*found.values()]),
        title=lambda found, _: counted(len(found), "target"),
    ),
)
