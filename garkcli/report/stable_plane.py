"""``gark design --a-stable`` with two parameters: for which values of both a method is stable."""

from __future__ import annotations

from typing import NamedTuple

from flint import fmpq

from garkcli.design.stable_plane import Branch, End, StablePlane, Strip, StripPart
from garkcli.exact.cells import Interval
from garkcli.exact.parametric import Parameters
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text
from garkcli.exact.roots import RealRoot, sign
from garkcli.frozen import replace
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ALGEBRAIC, root_data
from garkcli.plots.curves import stable_plane_scene
from garkcli.tableau.family import RequiredStability
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Rows, Section, itself, maybe, via
from garkcli.tell.kinds import INDEX, INTERVAL, ROOTS, TEXT, TEXTS, choice, record
from garkcli.tell.parts import answer, plot, rows_of
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level


class PlaneReport(NamedTuple):
    """A set of values, with its file and the digits of algebraic numbers."""

    file: str
    values: StablePlane
    digits: int = 12


def curve_text(branch: Branch, names: tuple[str, ...]) -> str:
    """The polynomial of a curve, in the names of the parameters."""
    first, second = names
    ring = Parameters([first, second])
    terms: dict[tuple[int, ...], fmpq] = {
        (int(k), int(j)): a for (j, k), a in branch.curve.to_dict().items()
    }
    return ring.text(ring.context.from_dict(terms))


def function_text(branch: Branch, name: str) -> str | None:
    """A branch that is a rational function; None for another."""
    parts = branch.formula()
    if parts is None:
        return None
    above, below = parts
    content = below.leading if below.degree == 0 else fmpq(sign(below.leading))
    above, below = (Polynomial([a / content for a in p.coefficients]) for p in (above, below))
    text = polynomial_text(above, name)
    return text if below.degree == 0 else f"({text})/({polynomial_text(below, name)})"


def end_words(end: End, names: tuple[str, ...], d: Plain) -> str:
    """An end of a set of the second parameter."""
    if isinstance(end, RealRoot):
        return d.root(end)
    assert end is not None
    text = function_text(end, names[0])
    if text is not None:
        return d.expression(text)
    return d.prose(f"root {end.number + 1} in {names[1]} of ") + d.expression(
        curve_text(end, names)
    )


def _part_words(part: StripPart, names: tuple[str, ...], d: Plain) -> str:
    if part.start is not None and part.start == part.end:
        return f"{d.expression(names[1])} = {end_words(part.start, names, d)}"
    if part.start is None and part.end is None:
        return d.prose(f"every {names[1]}")
    text = d.expression(names[1])
    if part.start is not None:
        text = f"{end_words(part.start, names, d)} {d.prose('≤' if part.has_start else '<')} {text}"
    if part.end is not None:
        text = f"{text} {d.prose('≤' if part.has_end else '<')} {end_words(part.end, names, d)}"
    return text


def strips(values: StablePlane, d: Plain) -> list[tuple[str, str]]:
    """Each strip with its parts, and what is undecided."""
    names = values.family.ring.names
    brief = replace(d, is_brief=True)
    rows = [
        (
            brief.interval(strip.base, names[0]),
            d.prose(" or ").join(_part_words(part, names, brief) for part in strip.parts),
        )
        for strip in values.strips
    ]
    if values.undecided:
        texts = ", ".join(f"{names[0]} = {brief.root(x)}" for x in values.undecided)
        rows.append(("not decided", texts))
    return rows


def _answer(values: StablePlane, d: Plain) -> str:
    names = " and ".join(map(d.expression, values.family.ring.names))
    text = d.prose(RequiredStability("a-stable", values.colour).in_words(values.family.tableau))
    if not values.strips:
        found = "no value that is decided" if values.undecided else "no value"
        return f"the method is {text} for {found} of {names}"
    return f"the method is {text} for {'' if values.undecided else 'exactly '}these {names}"


def _end_data(end: End, names: tuple[str, ...], d: Plain) -> object:
    if end is None:
        return None
    if isinstance(end, RealRoot):
        return {"value": root_data(end, d.digits)}
    return {
        "function": function_text(end, names[0]),
        "curve": curve_text(end, names),
        "branch": end.number + 1,
    }


def _strip_data(strip: Strip, names: tuple[str, ...], d: Plain) -> dict[str, object]:
    base: Interval = strip.base
    parts = [
        {
            "from": _end_data(part.start, names, d),
            "to": _end_data(part.end, names, d),
            "from_included": part.has_start,
            "to_included": part.has_end,
        }
        for part in strip.parts
    ]
    return {"base": INTERVAL.data(base, d), "parts": parts}


_END = S.nullable(
    S.one_of(
        record(value=ALGEBRAIC),
        record(function=S.nullable(S.TEXT), curve=S.TEXT, branch=S.POSITION),
    )
)
_PART = record(**{"from": _END, "to": _END}, from_included=S.FLAG, to_included=S.FLAG)
STRIPS: Kind[StablePlane] = Kind(
    Json(
        S.array(record(base=INTERVAL.schema, parts=S.array(_PART))),
        lambda x, d: [_strip_data(strip, x.family.ring.names, d) for strip in x.strips],
    )
)


OF_VALUES: Rows[StablePlane] = (
    Row("unknowns", TEXTS, lambda x: list(x.family.ring.names), DATA),
    Row("wanted", choice("a-stable"), lambda _: "a-stable", DATA),
    maybe("colour", INDEX, lambda x: x.colour, DATA),
    answer(_answer),
    itself("ends", rows_of(strips)),
    itself("strips", STRIPS, DATA),
    Row("undecided", ROOTS, lambda x: x.undecided, DATA),
    plot(lambda x: stable_plane_scene(x, x.family.name)),
)
WHOLE: Section[PlaneReport] = Section(
    Row("file", TEXT, lambda x: x.file, DATA),
    Row("name", TEXT, lambda x: x.values.family.name, DETAIL),
    via(lambda x: x.values, OF_VALUES),
    title=lambda x, d: d.prose(x.file),
)
REPORT: Report[PlaneReport] = Report.only(
    "gark/design-plane/1",
    "report of gark design with --a-stable and two parameters: the plane",
    WHOLE,
    lambda x: {"digits": x.digits},
)


def whole(found: StablePlane, name: str) -> PlaneReport:
    """Values under the name of their family if there is no other."""
    return PlaneReport(name or found.family.name, found)
