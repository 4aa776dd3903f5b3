"""``gark design --p-stable`` and the like: the stable values of parameters."""

from __future__ import annotations

from typing import Any, NamedTuple, get_args

from flint import fmpq

from garkcli.design.member import Whose
from garkcli.design.stability_kinds import TwoSprings
from garkcli.design.stable_values import Branch, End, StableValues, Strip, StripPart, Wanted
from garkcli.exact.cells import Interval
from garkcli.exact.parametric import Parameters
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_decimal, root_text
from garkcli.exact.roots import RealRoot, sign
from garkcli.frozen import replace
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ALGEBRAIC, root_data
from garkcli.plots.curves import stable_plane_scene
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Rows, Section, itself, maybe, optional, via
from garkcli.tell.kinds import INDEX, INTERVAL, ROOTS, TEXT, TEXTS, TRUTH, choice, record
from garkcli.tell.parts import answer, part, plot, rows_of
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level
Names = tuple[str, ...]


class StableReport(NamedTuple):
    file: str
    values: StableValues
    digits: int = 12


def number(root: RealRoot, d: Plain) -> str:
    """Writes a root in radicals with decimals, or as the root of a polynomial."""
    return replace(d, is_brief=False).root(root)


def stability(values: StableValues, d: Plain) -> str:
    """``A-stable for exactly 1/4 ≤ g``."""
    wanted = values.stability.in_words(values.family.tableau)
    text = d.prose("stable" if values.two_springs else wanted)
    names = values.names if values.is_plane else values.family.parameters
    name = (d.prose(" and ") if values.is_plane else ", ").join(map(d.expression, names))
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
    which = f"these {name}" if values.is_plane else found
    return f"{text} for {'' if values.undecided else 'exactly '}{which}"


def _part(values: StableValues, x: Interval, d: Plain) -> str:
    """A value of a linear form is that of its first parameter."""
    if values.forms and x.is_point and x.start is not None:
        value = root_text(x.start) or f"{root_decimal(x.start, d.digits)}…"
        return " = ".join(map(d.expression, values.forms[0].solved(value)))
    return d.interval(x, values.names[0])


def ends(values: StableValues, d: Plain) -> list[tuple[str, str]]:
    brief = replace(d, is_brief=True)
    rows = _strips(values, brief) if values.is_plane else _irrational(values, brief)
    texts = ", ".join(f"{d.expression(values.names[0])} = {number(x, d)}" for x in values.undecided)
    open_values = [("not decided", f"{texts}: fields are too large")] if texts else []
    return [*rows, *open_values]


def _irrational(values: StableValues, d: Plain) -> list[tuple[str, str]]:
    roots = [x for interval in values.found for x in (interval.start, interval.end)]
    rows = {
        d.root(x): d.prose(f"{root_decimal(x, d.digits)}…")
        if root_text(x)
        else f"a root of {d.minimal(x)}"
        for x in roots
        if x is not None and x.exact is None
    }
    return list(rows.items())


def _strips(values: StableValues, d: Plain) -> list[tuple[str, str]]:
    names = values.names
    if values.is_everything:
        return []
    return [
        (
            d.interval(strip, names[0]),
            d.prose(" or ").join(_part_words(part, names, d) for part in strip.parts),
        )
        for strip in values.strips
    ]


def _part_words(part: StripPart, names: Names, d: Plain) -> str:
    if part.start is not None and part.start == part.end:
        return f"{d.expression(names[1])} = {_end_words(part.start, names, d)}"
    if part.start is None and part.end is None:
        return d.prose(f"every {names[1]}")
    text = d.expression(names[1])
    if part.start is not None:
        text = (
            f"{_end_words(part.start, names, d)} {d.prose('≤' if part.has_start else '<')} {text}"
        )
    if part.end is not None:
        text = f"{text} {d.prose('≤' if part.has_end else '<')} {_end_words(part.end, names, d)}"
    return text


def _end_words(end: End, names: Names, d: Plain) -> str:
    if isinstance(end, RealRoot):
        return d.root(end)
    assert end is not None
    text = _function_text(end, names[0])
    if text is not None:
        return d.expression(text)
    return d.prose(f"root {end.number + 1} in {names[1]} of ") + d.expression(
        _curve_text(end, names)
    )


def _curve_text(branch: Branch, names: Names) -> str:
    ring = Parameters(list(map(_as_factor, names)))
    terms: dict[tuple[int, ...], fmpq] = {
        (int(k), int(j)): a for (j, k), a in branch.curve.to_dict().items()
    }
    return ring.text(ring.context.from_dict(terms))


def _as_factor(name: str) -> str:
    return name if name.isidentifier() else f"({name})"


def _function_text(branch: Branch, name: str) -> str | None:
    parts = branch.formula()
    if parts is None:
        return None
    above, below = parts
    content = below.leading if below.degree == 0 else fmpq(sign(below.leading))
    above, below = (Polynomial([a / content for a in p.coefficients]) for p in (above, below))
    text = polynomial_text(above, _as_factor(name))
    if below.degree == 0:
        return text
    return f"({text})/({polynomial_text(below, _as_factor(name))})"


def _springs_words(springs: TwoSprings, d: Plain) -> str:
    end = "" if springs.greatest is None else f" up to {springs.greatest}"
    return d.prose(f"(hω_slow)² = {springs.slow}, every (hω_fast)²{end}")


def _interval(x: Interval, names: Names, d: Plain) -> dict[str, Any]:
    data: dict[str, Any] = INTERVAL.data(x, d)
    if x.is_point and x.start is not None:
        data = {"point": root_data(x.start, d.digits)}
    if isinstance(x, Strip):
        data["parts"] = [
            {
                "from": _end_data(part.start, names, d),
                "to": _end_data(part.end, names, d),
                "from_included": part.has_start,
                "to_included": part.has_end,
            }
            for part in x.parts
        ]
    return data


def _end_data(end: End, names: Names, d: Plain) -> object:
    if end is None:
        return None
    if isinstance(end, RealRoot):
        return {"value": root_data(end, d.digits)}
    return {
        "function": _function_text(end, names[0]),
        "curve": _curve_text(end, names),
        "branch": end.number + 1,
    }


_END = S.nullable(
    S.one_of(
        record(value=ALGEBRAIC),
        record(function=S.nullable(S.TEXT), curve=S.TEXT, branch=S.POSITION),
    )
)
_PART = record(**{"from": _END, "to": _END}, from_included=S.FLAG, to_included=S.FLAG)


def _with_parts(cell: S.Schema) -> S.Schema:
    return {**cell, "properties": {**cell["properties"], "parts": S.array(_PART)}}


SET: Kind[StableValues] = Kind(
    Json(
        S.array(S.one_of(_with_parts(record(point=ALGEBRAIC)), _with_parts(INTERVAL.schema))),
        lambda x, d: [_interval(cell, x.names, d) for cell in x.found],
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
    itself("set", SET, DATA),
    Row("undecided", ROOTS, lambda x: x.undecided, DATA),
]
APART: Row[StableValues] = optional("apart", TRUTH, lambda x: x.is_apart or None, DATA)
VALUES = Section(WANTED, COLOUR, EMBEDDED, FOUND, APART)


def _answer(x: StableValues, d: Plain) -> str:
    return f"the {x.whose} is {stability(x, d)}"


def _forms(x: StableValues) -> list[str] | None:
    return [*map(str, x.forms)] if len(x.forms) > 1 else None


OF_VALUES: Rows[StableValues] = (
    Row("of", choice(*get_args(Whose)), lambda x: x.whose, DATA),
    Row("unknowns", TEXTS, lambda x: list(x.family.parameters), DATA),
    optional("linear_form", TEXT, lambda x: str(x.forms[0]) if len(x.forms) == 1 else None, DATA),
    optional("linear_forms", TEXTS, _forms, DATA),
    WANTED,
    COLOUR,
    maybe("springs", part(SPRINGS, _springs_words), lambda x: x.two_springs, label="two springs"),
    answer(_answer),
    itself("ends", rows_of(ends)),
    *FOUND,
    plot(lambda x: stable_plane_scene(x, x.family.name), lambda x: x.is_plane),
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
    return StableReport(name or found.family.name, found)
