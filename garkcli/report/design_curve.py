"""``gark design --search`` with ``--front`` or ``--along``: optima along a curve."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, get_args

from garkcli.design.member import Whose
from garkcli.design.search.curve import Knot, OptimaCurve
from garkcli.design.search.search import Search
from garkcli.errors import counted
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.plots.curves import curve_scene
from garkcli.report.search import ENDINGS, SECONDS, solved
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Section, itself
from garkcli.tell.kinds import COUNT, POSITION, TEXT, TEXTS, TRUTH, choice
from garkcli.tell.parts import answer, parts, plot, rows_of
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level
DIGITS = 7


class CurveReport(NamedTuple):
    file: str
    search: Search
    curve: OptimaCurve

    @property
    def knots(self) -> list[tuple[Knot, CurveReport]]:
        return [(knot, self) for knot in self.curve.knots]


def _answer(x: CurveReport, d: Plain) -> str:
    curve, search = x.curve, x.search
    order = f"order {search.order}" + f" of the {search.whose}" * (search.whose != "method")
    starts = counted(curve.starts, "start")
    end = "" if curve.ending is None else f", then {ENDINGS[curve.ending]}"
    success = solved(curve.successes, curve.starts) + end
    if not curve.knots:
        return d.prose(
            f"no method of {order} found, which does not say that there is none; {success}"
        )
    points = counted(len(curve.knots), "point")
    what = f"{points} of the front of {curve.across} and {curve.up}"
    if not curve.is_front:
        what = f"the best {curve.up} for {points} of {curve.across}"
    return d.prose(f"{order}; {what}, in floats, the best of {starts}; {success}")


def _number(x: float) -> str:
    return f"{x:.{DIGITS}g}"


def _rows(x: CurveReport, d: Plain) -> list[tuple[str, str]]:
    curve = x.curve
    if not curve.knots:
        return []
    rows = [(d.prose(curve.across), d.prose(curve.up))]
    return rows + [(_number(knot.across), _number(knot.up)) for knot in curve.knots]


def _coordinates(item: tuple[Knot, CurveReport]) -> dict[str, float]:
    knot, x = item
    return {x.curve.across: knot.across, x.curve.up: knot.up}


def _values(item: tuple[Knot, CurveReport]) -> dict[str, float]:
    knot, x = item
    return dict(zip(x.search.family.ring.names, knot.point, strict=True))


def _cells(numbers: Mapping[str, float]) -> dict[str, str]:
    return {name: repr(number) for name, number in numbers.items()}


_NUMBERS: Kind[dict[str, float]] = Kind(
    Json({"type": "object", "additionalProperties": S.NUMBER}, csv=_cells)
)
KNOT: Section[tuple[Knot, CurveReport]] = Section(
    Row("coordinates", _NUMBERS, _coordinates), Row("values", _NUMBERS, _values)
)
WHOLE: Section[CurveReport] = Section(
    Row("file", TEXT, lambda x: x.file, DATA),
    Row("name", TEXT, lambda x: x.search.family.name, DETAIL),
    Row("of", choice(*get_args(Whose)), lambda x: x.search.whose, DATA),
    answer(_answer),
    Row("unknowns", TEXTS, lambda x: list(x.search.family.parameters), DETAIL),
    Row("order", POSITION, lambda x: x.search.order, DATA),
    itself("knots_in_words", rows_of(_rows)),
    Row("front", TRUTH, lambda x: x.curve.is_front, DATA),
    Row("starts", COUNT, lambda x: x.curve.starts, DATA),
    Row("successes", COUNT, lambda x: x.curve.successes, DATA),
    Row("interrupted", TRUTH, lambda x: x.curve.ending is not None, DATA),
    Row("seconds", SECONDS, lambda x: round(x.curve.seconds, 3), DATA),
    Row("knots", parts(KNOT), lambda x: x.knots, DATA),
    plot(lambda x: curve_scene(x.curve, x.search.family.name), lambda x: len(x.curve.knots) > 1),
    title=lambda x, d: d.prose(x.file),
)
REPORT: Report[CurveReport] = Report.only(
    "gark/design-curve/1",
    "report of gark design --search with --front or --along: a curve",
    WHOLE,
    lines=lambda x: (KNOT, x.knots),
)
