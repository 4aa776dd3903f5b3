"""``gark design`` of rounded coefficients: values of the unknowns within the tolerance."""

from __future__ import annotations

from typing import NamedTuple, get_args

from flint import fmpq

from garkcli.design.member import Whose
from garkcli.design.within import STARTS, DesignWithin, StepWithin, ValuesWithin
from garkcli.errors import counted
from garkcli.exact.display import decimal
from garkcli.exact.rounding import in_decimals
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Section, itself, maybe
from garkcli.tell.kinds import COUNT, INTEGER, POSITION, TEXT, TEXTS, TOLERANCE, TREE, TRUTH, choice
from garkcli.tell.parts import answer, parts, rows_of
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = Level


class WithinReport(NamedTuple):
    file: str
    design: DesignWithin


class _Found(NamedTuple):
    digits: int
    values: ValuesWithin

    @property
    def texts(self) -> dict[str, str]:
        return {name: self.values.text(name, self.digits) for name in self.values.values}

    @property
    def directions(self) -> list[tuple[str, dict[str, str]]]:
        slopes = self.values.directions.items()
        return [
            (free, {name: self.text(x[free]) for name, x in slopes if free in x})
            for free in self.values.free
        ]

    def text(self, x: fmpq) -> str:
        return in_decimals(x, self.digits)


def _of(design: DesignWithin, step: StepWithin) -> list[_Found]:
    return [_Found(design.digits, x) for x in step.found]


def _briefly(step: StepWithin) -> str:
    """``2 solutions``; ``a family of dimension 1``."""
    [first, *_] = step.found
    if first.dimension:
        return f"a family of dimension {first.dimension}"
    count = counted(len(step.found), "solution")
    return count if step.is_linear else f"{count} found"


def _answer(x: WithinReport, d: Plain) -> str:
    design, best, last = x.design, x.design.best, x.design.steps[-1]
    whose = "" if design.whose == "method" else f" of the {design.whose}"
    within = f"within {decimal(design.tolerance)}"
    texts = []
    if best is not None:
        texts.append(f"order {best.order}{whose} {within} for {_briefly(best)}")
    if best is not last:
        known = "for no value" if last.has_methods is False else "is not decided"
        order = f"order {last.order}{'' if best else whose}"
        texts.append(f"{order} {known}{'' if best else f' {within}'}")
    return d.prose("; ".join(texts))


def _printed(step: StepWithin) -> str:
    if step.printed is None:
        return ""
    if step.printed < 0:
        return "the printed digits contradict each other and leave no value"
    left = f"dimension {step.printed}" if step.printed else "one value"
    return f"the printed digits leave {left}"


def _open(x: DesignWithin, step: StepWithin, d: Plain) -> str:
    if x.family.impossible:
        return d.prose(x.family.impossible[0])
    if step.witness is not None:
        within = f"no method within {decimal(x.tolerance)} meets it"
        tree = d.tree(step.witness)
        return f"no value: the condition of {tree} concerns known numbers alone, and {within}"
    if step.found:
        return "the values found are out of a range, or have a sign that is not wanted"
    texts = ["not decided: no method within the tolerance was found with it"]
    if step.left is not None and step.is_linear:
        texts.append(f"as printed, the conditions leave {step.left:.2g} of one of them")
    if not step.is_linear:
        texts.append(f"the conditions are not linear, and {STARTS} starts of Newton's method fail")
    return d.prose("; ".join(texts))


def _terms(found: _Found, name: str, d: Plain) -> str:
    """An unknown, by those that are free: ``1.5 - 0.5*bh3``."""
    directions = found.values.directions.get(name, {})
    text = found.text(_at_zero(found.values, name))
    for free, slope in directions.items():
        sign = "-" if slope < 0 else "+"
        text += f" {sign} {found.text(abs(slope))}*{free}"
    return f"{d.expression(name)} = {d.expression(text)}"


def _at_zero(values: ValuesWithin, name: str) -> fmpq:
    """The value of an unknown that depends on free ones linearly, at 0."""
    off = values.directions.get(name, {})
    return values.values[name] - sum((s * values.values[k] for k, s in off.items()), fmpq(0))


def _solution(found: _Found, d: Plain) -> str:
    values = found.values
    texts = [f"{d.expression(k)} = {d.expression(x)}" for k, x in found.texts.items()]
    said = [] if values.embedded is None else [f"embedded order {values.embedded}"]
    if not values.is_admitted:
        said.append("out of a range, or with a sign that is not wanted")
    return ", ".join(texts) + d.prose("".join(f"; {x}" for x in said))


def rows(x: WithinReport, d: Plain) -> list[tuple[str, str]]:
    design = x.design
    told: list[tuple[str, str]] = []
    for step in design.steps:
        label = f"order {step.order}"
        if not step.has_methods:
            told.append((label, _open(design, step, d)))
            continue
        first = _of(design, step)[0]
        texts = [_briefly(step), d.prose(_printed(step))]
        told.append((label, "; ".join(filter(None, texts))))
        if first.values.dimension and step.is_linear:
            bound = [k for k in design.family.parameters if k not in first.values.free]
            told += [("values", _terms(first, name, d)) for name in bound[:1]]
            told += [("", _terms(first, name, d)) for name in bound[1:]]
        elif first.values.dimension:
            told.append(("free", ", ".join(map(d.expression, first.values.free))))
        such = "example" if first.values.dimension else "values"
        found = _of(design, step)
        told += [(such if not k else "", _solution(y, d)) for k, y in enumerate(found)]
        off = d.prose(f"{first.values.distance:.2g} t")
        told.append(
            (
                "recovered",
                f"one method whose numbers differ from the printed ones by {off} at most, t ="
                f" {decimal(design.tolerance)}; it meets the conditions to {first.values.digits}"
                " digits: numerical",
            )
        )
        if not step.is_linear:
            told.append(("", d.prose(f"by Newton's method from {STARTS} starts; others may exist")))
    kinds = ", ".join(map(str, design.family.stable))
    if kinds and design.best is not None:
        text = f"{kinds}: not examined here: gark check of the file that --emit writes decides it"
        told.append(("stable", d.prose(text)))
    return told


TEXTS_BY_NAME: Kind[dict[str, str]] = Kind(
    Json({"type": "object", "additionalProperties": S.TEXT}, lambda x, _: dict(x))
)
DISTANCE: Kind[float] = Kind(Json({"type": "number", "minimum": 0}, lambda x, _: round(x, 6)))
DIRECTION: Section[tuple[str, dict[str, str]]] = Section(
    Row("free", TEXT, lambda x: x[0]), Row("values", TEXTS_BY_NAME, lambda x: x[1])
)
SOLUTION: Section[_Found] = Section(
    Row("values", TEXTS_BY_NAME, lambda x: x.texts),
    Row("directions", parts(DIRECTION), lambda x: x.directions),
    Row("dimension", COUNT, lambda x: x.values.dimension),
    Row("distance", DISTANCE, lambda x: x.values.distance),
    Row("admissible", TRUTH, lambda x: x.values.is_admitted),
    maybe("embedded_order", COUNT, lambda x: x.values.embedded),
)


class _Order(NamedTuple):
    design: DesignWithin
    step: StepWithin


STEP: Section[_Order] = Section(
    Row("order", POSITION, lambda x: x.step.order),
    maybe("reached", TRUTH, lambda x: x.step.has_methods),
    Row("linear", TRUTH, lambda x: x.step.is_linear),
    maybe("printed_dimension", INTEGER, lambda x: x.step.printed),
    maybe("witness", TREE, lambda x: x.step.witness),
    Row("solutions", parts(SOLUTION), lambda x: _of(x.design, x.step)),
)
WHOLE: Section[WithinReport] = Section(
    Row("file", TEXT, lambda x: x.file, DATA),
    Row("name", TEXT, lambda x: x.design.family.name, DETAIL),
    Row("of", choice(*get_args(Whose)), lambda x: x.design.whose, DATA),
    answer(_answer),
    Row("unknowns", TEXTS, lambda x: list(x.design.family.parameters)),
    Row("tolerance", TOLERANCE, lambda x: x.design.tolerance, DATA),
    Row("orders", parts(STEP), lambda x: [_Order(x.design, step) for step in x.design.steps], DATA),
    itself("orders_in_words", rows_of(rows)),
    title=lambda x, d: d.prose(x.file),
)
REPORT: Report[WithinReport] = Report.only(
    "gark/design-within/1",
    "report of gark design within a tolerance",
    WHOLE,
    lambda x: {"colours": [c.name for c in x.design.family.tableau.colours]},
)


def whole(found: DesignWithin, name: str) -> WithinReport:
    return WithinReport(name or found.family.name, found)
