"""``gark design --p-stable`` and the like: for which values of a parameter a method is stable."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple, get_args

from garkcli.design.member import Whose
from garkcli.design.stability_kinds import TwoSprings
from garkcli.design.stable_values import StableValues, Wanted
from garkcli.exact.cells import Interval
from garkcli.exact.polynomial_text import root_decimal, root_text
from garkcli.exact.roots import RealRoot
from garkcli.frozen import replace
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ALGEBRAIC, root_data
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Rows, Section, itself, maybe, optional, via
from garkcli.tell.kinds import INDEX, INTERVAL, ROOTS, TEXT, TEXTS, TRUTH, choice, record
from garkcli.tell.parts import answer, part, rows_of
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level


class StableReport(NamedTuple):
    """A set of values, with its file and the digits of algebraic numbers."""

    file: str
    values: StableValues
    digits: int = 12


def number(root: RealRoot, d: Plain) -> str:
    """An algebraic number, whole: in radicals with decimals, or as the root of a polynomial."""
    return replace(d, is_brief=False).root(root)


def stability(values: StableValues, d: Plain) -> str:
    """For which values a method is stable: ``A-stable for exactly 1/4 ≤ g``."""
    wanted = values.stability.in_words(values.family.tableau)
    text = d.prose("stable" if values.two_springs else wanted)
    name = ", ".join(map(d.expression, values.family.parameters))
    if values.has_wishes:
        text += ", and as the file wants it,"
    if values.is_apart:
        text += ", apart from what else is wanted,"
    if not values.found:
        return (
            f"{text} for {'no value that is decided' if values.undecided else 'no value'} of {name}"
        )
    if values.is_everything:
        return f"{text} for every value of {name}"
    brief = replace(d, is_brief=True)
    found = " or ".join(_part(values, x, brief) for x in values.found)
    return f"{text} for {'' if values.undecided else 'exactly '}{found}"


def _part(values: StableValues, x: Interval, d: Plain) -> str:
    """A part of the set; a value of a linear form is that of its first parameter."""
    if values.form is not None and x.is_point and x.start is not None:
        value = root_text(x.start) or f"{root_decimal(x.start, d.digits)}…"
        return " = ".join(map(d.expression, values.form.solved(value)))
    return d.interval(x, values.parameter)


def ends(values: StableValues, d: Plain) -> list[tuple[str, str]]:
    """The irrational ends of intervals, and the values that are undecided."""
    brief = replace(d, is_brief=True)
    roots = [x for interval in values.found for x in (interval.start, interval.end)]
    rows = {
        brief.root(x): d.prose(f"{root_decimal(x, d.digits)}…")
        if root_text(x)
        else f"a root of {brief.minimal(x)}"
        for x in roots
        if x is not None and x.exact is None
    }
    texts = ", ".join(
        f"{d.expression(values.parameter)} = {number(x, d)}" for x in values.undecided
    )
    open_values = [("not decided", f"{texts}: fields are too large")] if texts else []
    return [*rows.items(), *open_values]


def _springs_words(springs: TwoSprings, d: Plain) -> str:
    end = "" if springs.greatest is None else f" up to {springs.greatest}"
    return d.prose(f"(hω_slow)² = {springs.slow}, every (hω_fast)²{end}")


def _interval(x: Interval, d: Plain) -> dict[str, object]:
    if x.is_point and x.start is not None:
        return {"point": root_data(x.start, d.digits)}
    return INTERVAL.data(x, d)


SET: Kind[Sequence[Interval]] = Kind(
    Json(
        S.array(S.one_of(record(point=ALGEBRAIC), INTERVAL.schema)),
        lambda found, d: [_interval(x, d) for x in found],
    )
)
SPRINGS: Section[TwoSprings] = Section(
    Row("slow", TEXT, lambda x: str(x.slow)),
    Row("fast", INDEX, lambda x: x.fast),
    maybe("up_to", TEXT, lambda x: None if x.greatest is None else str(x.greatest)),
)
WANTED: Row[StableValues] = Row("wanted", choice(*get_args(Wanted)), lambda x: x.wanted, DATA)
COLOUR: Row[StableValues] = maybe("colour", INDEX, lambda x: x.colour, DATA)
EMBEDDED: Row[StableValues] = optional("embedded", TRUTH, lambda x: x.is_embedded or None, DATA)
FOUND: Rows[StableValues] = [
    Row("set", SET, lambda x: x.found, DATA),
    Row("undecided", ROOTS, lambda x: x.undecided, DATA),
]
APART: Row[StableValues] = optional("apart", TRUTH, lambda x: x.is_apart or None, DATA)
VALUES = Section(WANTED, COLOUR, EMBEDDED, FOUND, APART)
"""The values as a part of the report of an order."""


def _answer(x: StableValues, d: Plain) -> str:
    return f"the {x.whose} is {stability(x, d)}"


OF_VALUES: Rows[StableValues] = (
    Row("of", choice(*get_args(Whose)), lambda x: x.whose, DATA),
    Row("unknowns", TEXTS, lambda x: list(x.family.parameters), DATA),
    optional("linear_form", TEXT, lambda x: None if x.form is None else str(x.form), DATA),
    WANTED,
    COLOUR,
    maybe("springs", part(SPRINGS, _springs_words), lambda x: x.two_springs, label="two springs"),
    answer(_answer),
    itself("ends", rows_of(ends)),
    *FOUND,
)
WHOLE: Section[StableReport] = Section(
    Row("file", TEXT, lambda x: x.file, DATA),
    Row("name", TEXT, lambda x: x.values.family.name, DETAIL),
    via(lambda x: x.values, OF_VALUES),
    title=lambda x, d: d.prose(x.file),
)
REPORT: Report[StableReport] = Report.only(
    "gark/design-stability/1",
    "report of gark design with --a-stable and the like: stability",
    WHOLE,
    lambda x: {"digits": x.digits},
)


def whole(found: StableValues, name: str) -> StableReport:
    """Values under the name of their family if there is no other."""
    return StableReport(name or found.family.name, found)
