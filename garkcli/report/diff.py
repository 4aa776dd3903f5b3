"""``gark diff``: two methods held against each other, declared once."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from flint import arb, fmpq

from garkcli.check.findings import value_text
from garkcli.comparison.comparison import WITH_TIME, Comparison, OrderPair, PropertyPair
from garkcli.comparison.differences import BlockGap, EntryGap, Met
from garkcli.comparison.sameness import Sameness
from garkcli.constructions.derivatives import words_of
from garkcli.constructions.nprk import is_nprk
from garkcli.errors import counted
from garkcli.exact.display import decimal, to_text
from garkcli.exact.field import Number
from garkcli.order.conditions import Condition
from garkcli.order.deciding import AnyOrder
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.properties.registry import KEYS
from garkcli.properties.verdict import Size, Verdict
from garkcli.reason import Reason
from garkcli.report.check import rounding, verdict_words
from garkcli.report.other_methods import rosenbrock_words
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.pointwise import Cell
from garkcli.tableau.tableau import Tableau
from garkcli.tell import kinds
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.facts import Answer, Json, Kind, Level, Row, Rows, Section, Words, itself, maybe
from garkcli.tell.parts import SAID, part, parts, shown
from garkcli.tell.parts import told as told_kind
from garkcli.tell.report import DialectSigns, Report

HEADLINE, USUAL, DETAIL, DATA = Level
FORMS = {
    "rk": "a Runge-Kutta method",
    "ark": "an additive method",
    "gark": "a GARK method",
    "prk": "a partitioned method",
    "pair": "a symplectic pair",
    "row": "a Rosenbrock method",
    "rkn": "a Nyström method",
    "nprk": "a nonlinearly partitioned method",
    "mdrk": "a multiderivative method",
    "mri": "a multirate method with the exact fast part",
}
RELATIONS = {
    "identical": "identical: every entry is the same",
    "same": "the same method",
    "within-rounding": "the same method",
    "same-step": "the same step",
    "different": "different methods",
    "undecided": "not decided",
}
STEP_ALONE = "step-alone"
"""Methods with one step, whose further weights differ."""


class ComparedMethod(NamedTuple):
    method: GarkMethod
    file: str
    form: str
    is_titled: bool = True
    """Whether the title has its name, and not an alias."""


class ComparedPair(NamedTuple):
    found: Comparison
    files: tuple[str, str]
    typed: tuple[str, str] = ("", "")

    @property
    def titles(self) -> list[str]:
        return [typed or file for typed, file in zip(self.typed, self.files, strict=True)]

    def method(self, index: int) -> ComparedMethod:
        method = (self.found.one, self.found.other)[index]
        file, typed = self.files[index], self.typed[index]
        return ComparedMethod(method, file, self.found.forms[index], typed in ("", file))


def _relation_words(relation: str, d: Plain) -> str:
    return d.prose(RELATIONS.get(relation, "the same step"))


def _relation_phrase(_: str, relation: str, answer: Answer[str], d: Plain) -> str:
    text = d.known(_relation_words(relation, d), answer.status)
    if answer.reason:
        text += f": {d.reason(answer.reason)}"
    return (d.bad if relation in {"different", "undecided", STEP_ALONE} else d.good)(text)


def _entry_data(x: Cell, _: Plain) -> str:
    return str(x.str(30, radius=False)) if isinstance(x, arb) else to_text(x)


def _entry_words(x: Cell, d: Plain) -> str:
    if isinstance(x, arb):
        return d.prose(str(x.str(12, radius=False)))
    found = value_text(x, 12)
    return d.prose(found) if isinstance(found, str) else d.number(x)


def _known(key: str, verdict: Verdict, tolerance: fmpq | None) -> Answer[Verdict]:
    return Answer(verdict, Status(rounding(key, verdict.value, tolerance)))


def _verdict_cell(verdict: Verdict, d: Plain) -> str:
    value = verdict.value
    if isinstance(value, Size) and value.root is not None and not verdict.is_at_least:
        return d.root(value.root)
    return d.prose(str(verdict_words(verdict)).partition(", a root of ")[0])


RELATION: Kind[str] = Kind(
    Json({"enum": [*RELATIONS]}, lambda x, _: x if x in RELATIONS else "different"),
    Words(_relation_words, phrase=_relation_phrase),
)
ENTRY: Kind[Cell] = Kind(Json(S.NUMERAL, _entry_data), Words(_entry_words))
VALUE: Kind[Number] = Kind(kinds.EXACT.what, Words(_entry_words))
ORDER_ALONE: Kind[AnyOrder] = Kind(Json(S.COUNT, lambda x, _: x.order), Words(kinds.order_cell))
VERDICT: Kind[Verdict] = Kind(
    Json(S.TEXT, lambda x, _: str(verdict_words(x))), Words(_verdict_cell)
)
IMAGES: Kind[Sequence[Sequence[int]]] = Kind(
    Json(S.array(S.array(S.POSITION)), lambda x, _: [[i + 1 for i in row] for row in x])
)
COLOURS: Kind[Sequence[int]] = Kind(Json(S.array(S.POSITION), lambda x, _: [l + 1 for l in x]))
SHAPES: Kind[Sequence[str]] = Kind(Json(S.array(S.TEXT), lambda x, _: list(x)))
STAGES: Kind[Sequence[int]] = Kind(
    Json(S.array(S.POSITION), lambda x, _: list(x)), Words(lambda x, _: ", ".join(map(str, x)))
)


def relation(x: ComparedPair) -> Answer[str]:
    """Whether the methods are the same, within which rounding, and why not."""
    found = x.found
    same = found.sameness
    allowed = same.allowed if same and found.relation == "within-rounding" else None
    word: str = found.relation
    if same is not None and same.step_only and word == "different":
        word = STEP_ALONE
    return Answer(word, Status(allowed), Reason(found.remark or found.obstacle))


def told(x: ComparedPair) -> str:
    return "; ".join(_turns(x.found))


def _turns(found: Comparison) -> Iterator[str]:
    same = found.sameness
    if same is None or found.relation == "identical":
        return
    first, second = found.forms
    if first != second:
        yield f"in another form: {FORMS[first]}, {FORMS[second]}"
    if same.is_reduced:
        yield "once both are reduced: see gark convert --to reduced"
    if not same.keeps_colours:
        yield f"colours 1, 2, … of the first are {_numbers(same.colours)} there"
    if same.keeps_stages:
        return
    if len(set(same.stages)) == 1:
        yield f"stages 1, 2, … of the first are {_numbers(same.stages[0])} there"
        return
    for l, images in enumerate(same.stages, start=1):
        if images != tuple(range(len(images))):
            yield f"its stages of colour {l} are {_numbers(images)} there"


def _numbers(images: Sequence[int]) -> str:
    return ", ".join(str(i + 1) for i in images)


def tolerances(x: ComparedPair) -> str | None:
    one, other = x.found.one.tolerance, x.found.other.tolerance
    if one == other:
        return None
    return " against ".join("none" if t is None else decimal(t) for t in (one, other))


def _orders_words(x: ComparedPair, d: Plain) -> str:
    """Writes each order of both methods, once if both have the same."""
    texts = []
    for pair in x.found.orders:
        if not pair.exists or (pair.name == WITH_TIME and not pair.is_different):
            continue
        ends = ["none" if y is None else kinds.order_cell(y, d) for y in (pair.one, pair.other)]
        name = pair.name.removeprefix("order").strip()
        text = ends[0] if ends[0] == ends[1] else d.bad(" against ".join(ends))
        texts.append(f"{d.prose(name)} {text}".strip())
    return "; ".join(texts)


def _conditions_words(met: Met, _: Plain) -> str:
    if not met.pairs:
        return f"up to order {met.order} both meet the same ones"
    first, second = (len(x) or "none" for x in (met.first_only, met.second_only))
    return f"up to order {met.order} the first alone meets {first}, the second {second}"


class Gap(NamedTuple):
    """``entry`` is None if the shapes differ."""

    block: BlockGap
    entry: EntryGap | None


def largest_gaps(x: ComparedPair) -> list[Gap]:
    return [] if x.found.relation == "same" else [Gap(b, b.largest) for b in x.found.gaps]


def every_gap(x: ComparedPair) -> list[Gap]:
    return [Gap(b, entry) for b in x.found.gaps for entry in b.gaps or (None,)]


NAMES = {"embedded": "embedded weights", "dense": "dense output"}
OF_OTHER_KINDS = {
    "alpha": "α",
    "beta": "β = α + γ",
    "c + d": "c + d",
    "Abar": "Ā",
    "bbar": "b̄",
    "embedded bbar": "embedded b̄",
}


def _block_words(gap: Gap, d: Plain) -> str:
    block = gap.block
    if d.names:  # f and f' have one row
        name = {**NAMES, **OF_OTHER_KINDS}.get(block.kind, block.kind)
        return d.prose(name + (f", θ^{block.power}" if block.power else ""))
    colours = [block.colour] if block.seen is None else [block.colour, block.seen]
    if block.kind not in NAMES:
        return d.block(block.kind, colours)
    colour = f" {{{d.colours[block.colour]}}}" if len(d.colours) > 1 else ""
    return d.prose(NAMES[block.kind] + colour + (f", θ^{block.power}" if block.power else ""))


def _place_words(gap: Gap, _: Plain) -> str:
    if gap.entry is None:
        return "shape"
    row = "" if gap.entry.row is None else f"row {gap.entry.row + 1}, "
    return f"{row}entry {gap.entry.entry + 1}"


def _side(index: int) -> Row[Gap]:
    """The entry of one of the methods; its shape if that differs."""

    def words(gap: Gap, d: Plain) -> str:
        if gap.entry is not None:
            return _entry_words((gap.entry.one, gap.entry.other)[index], d)
        return gap.block.shapes[index] if gap.block.shapes else ""

    return Row(("first", "second")[index], told_kind(words), lambda x: x)


GAP: Rows[Gap] = (
    itself("block", told_kind(_block_words), label=""),
    itself("largest", told_kind(_place_words), label="largest"),
    _side(0),
    _side(1),
    Row("difference", ENTRY, lambda x: None if x.entry is None else x.entry.gap, label="off by"),
)


COUNTED: Row[Gap] = Row(
    "of_entries",
    told_kind(lambda gap, _: f"{len(gap.block.gaps)} of {gap.block.entries}"),
    lambda gap: gap if gap.entry else None,
    label="entries",
)
ENTRIES: Section[EntryGap] = Section(
    maybe("row", kinds.INDEX, lambda x: x.row),
    Row("entry", kinds.INDEX, lambda x: x.entry),
    Row("first", ENTRY, lambda x: x.one),
    Row("second", ENTRY, lambda x: x.other),
    Row("difference", ENTRY, lambda x: x.gap),
    Row("undecided", kinds.TRUTH, lambda x: x.is_open),
)
BLOCK: Section[BlockGap] = Section(
    Row(
        "kind", kinds.choice("A", "b", "c", "embedded", "dense", *OF_OTHER_KINDS), lambda x: x.kind
    ),
    Row("colour", kinds.INDEX, lambda x: x.colour),
    maybe("seen", kinds.INDEX, lambda x: x.seen),
    maybe("power", kinds.POSITION, lambda x: x.power or None),
    maybe("shapes", SHAPES, lambda x: x.shapes),
    Row("of_entries", kinds.COUNT, lambda x: x.entries),
    maybe("largest", part(ENTRIES), lambda x: x.largest),
    Row("entries", parts(ENTRIES), lambda x: x.gaps),
)
SAME: Section[Sameness] = Section(
    Row("colours", COLOURS, lambda x: x.colours),
    Row("stages", IMAGES, lambda x: x.stages),
    Row("reduced", kinds.TRUTH, lambda x: x.is_reduced),
    Row("step_only", kinds.TRUTH, lambda x: x.step_only),
    maybe("within", kinds.TOLERANCE, lambda x: x.allowed or None),
)
ORDERS: Section[OrderPair] = Section(
    Row("of", kinds.TEXT, lambda x: x.name),
    maybe("first", ORDER_ALONE, lambda x: x.one),
    maybe("second", ORDER_ALONE, lambda x: x.other),
)
CONDITION: Section[tuple[Condition, Condition]] = Section(
    Row("tree", kinds.TREE, lambda x: x[0].tree, label=""),
    Row("order", kinds.POSITION, lambda x: x[0].tree.order),
    Row("required", VALUE, lambda x: x[0].required),
    Row("first", VALUE, lambda x: x[0].value),
    Row("second", VALUE, lambda x: x[1].value),
)
MET: Section[Met] = Section(
    Row("order", kinds.COUNT, lambda x: x.order),
    Row("first_only", parts(CONDITION), lambda x: x.first_only),
    Row("second_only", parts(CONDITION), lambda x: x.second_only),
)
PROPERTY: Section[PropertyPair] = Section(
    Row("property", kinds.choice(*KEYS, "symplectic"), lambda x: x.key, label=""),
    Row("first", VERDICT, lambda x: _known(x.key, x.one, x.tolerances[0])),
    Row("second", VERDICT, lambda x: _known(x.key, x.other, x.tolerances[1])),
)
FORM: Kind[str] = Kind(Json({"enum": [*FORMS]}), Words(lambda x, d: d.prose(FORMS[x])))
METHOD: Section[ComparedMethod] = Section(
    Row("file", kinds.TEXT, lambda x: x.file),
    Row("name", kinds.TEXT, lambda x: x.method.name),
    Row("form", FORM, lambda x: x.form),
    Row("stages", STAGES, lambda x: x.method.stages),
    maybe("tolerance", kinds.TOLERANCE, lambda x: x.method.tolerance),
)


def _method_words(x: ComparedMethod, d: Plain) -> str:
    stages = ", ".join(map(str, x.method.stages))
    about = f"{counted(x.method.tableau.size, 'colour')}, stages {stages}"
    if x.form == "row":
        about = rosenbrock_words(x.method.tableau)
    elif x.form == "rkn":
        about = f"Nyström, {counted(x.method.stages[0], 'stage')}"
    elif x.form == "nprk":
        pairs = counted(x.method.stages[0], "pair")
        about = f"nonlinearly partitioned, {pairs} of stages"
    elif x.form == "mdrk":
        about = words_of(x.method.tableau)
    elif x.form == "mri":
        about = f"multirate, {counted(x.method.stages[-1], 'slow stage')}, fast part exact"
    name = x.method.name
    named = [*([] if x.is_titled else [x.file]), *([name] if name not in ("", x.file) else [])]
    return d.prose(": ".join([*filter(None, [", ".join(named)]), about]))


def _properties(x: ComparedPair, is_known: bool) -> list[PropertyPair]:
    return [p for p in x.found.properties if p.is_known is is_known]


REPORT: Report[ComparedPair] = Report.only(
    "gark/diff/1",
    "two methods, by gark diff",
    Section(
        Row("first", part(METHOD, _method_words), lambda x: x.method(0)),
        Row("second", part(METHOD, _method_words), lambda x: x.method(1)),
        Row("relation", RELATION, relation, HEADLINE),
        maybe("obstacle", kinds.TEXT, lambda x: x.found.obstacle or None, DATA),
        maybe("remark", kinds.TEXT, lambda x: x.found.remark or None, DATA),
        Row("same", SAID, told),
        maybe("same", part(SAME), lambda x: x.found.sameness, DATA),
        Row("tolerance", SAID, tolerances),
        itself("orders", told_kind(_orders_words)),
        Row("conditions", told_kind(_conditions_words), lambda x: x.found.met),
        Row("differences", parts(BLOCK), lambda x: x.found.gaps, DATA),
        Row(
            "compared",
            SAID,
            lambda x: (
                "no entry: the numbers of colours differ"
                if x.found.one.tableau.size != x.found.other.tableau.size
                else None
            ),
        ),
        Row(
            "largest",
            shown(Section(GAP[0], COUNTED, GAP[1:]), 4),
            largest_gaps,
            label="differences",
            is_short=True,
        ),
        Row("entries", shown(Section(GAP), 0), every_gap, DETAIL),
        Row("orders", parts(ORDERS), lambda x: x.found.orders, DATA),
        maybe("conditions", part(MET), lambda x: x.found.met, DATA),
        Row(
            "pairs",
            shown(CONDITION, 3),
            lambda x: None if x.found.met is None else x.found.met.pairs,
            label="conditions",
        ),
        Row("properties", parts(PROPERTY), lambda x: x.found.properties, DATA),
        Row(
            "known", shown(PROPERTY, 5), lambda x: _properties(x, is_known=True), label="properties"
        ),
        Row(
            "half_known",
            shown(PROPERTY, 2),
            lambda x: _properties(x, is_known=False),
            label="decided of one alone",
        ),
        title=lambda x, d: " against ".join(map(d.prose, x.titles)),
    ),
    lambda x: _signs(x.found.one.tableau),
)


def _signs(tableau: Tableau) -> DialectSigns:
    names = [colour.name for colour in tableau.colours]
    is_plain = tableau.has_fields_alone or is_nprk(tableau)  # whose names are numbers
    return {"colours": names, "names": [] if is_plain else names}


def whole(found: Comparison, _: str) -> ComparedPair:
    return ComparedPair(found, (found.one.name or "first", found.other.name or "second"))
