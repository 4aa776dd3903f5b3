"""``gark check``: the findings about a method, declared once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import filterfalse
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, TypedDict, TypeVar

from garkcli.check import findings
from garkcli.check.pair_reasons import is_lost, pair_reason
from garkcli.errors import counted
from garkcli.exact.display import decimal, plain_decimal, to_float, to_text
from garkcli.frozen import replace
from garkcli.glossary.labels import label_of
from garkcli.ntrees.drawing import draw_text
from garkcli.ntrees.notation import format_tree
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ROOT_OF, root_data
from garkcli.page.lines import folded
from garkcli.properties.registry import KEYS
from garkcli.properties.subject import find
from garkcli.properties.verdict import Size, Verdict
from garkcli.reason import NO_REASON, Place, Reason, joined
from garkcli.report.remarks import FAULT, FINDING, fault_rows, remark_rows
from garkcli.tell import facts, kinds
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.parts import part, parts, picture, rows_of, told

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.catalogue.known import Known
    from garkcli.check.analysis import Analysis
    from garkcli.check.claims import Claim
    from garkcli.check.every_family import EveryFamily
    from garkcli.check.order_facts import DenseFacts
    from garkcli.check.outcome import OtherAnalysis, Outcome
    from garkcli.check.remark import RoundingHint
    from garkcli.exact.field import Number
    from garkcli.ntrees.tree import Tree
    from garkcli.order.blame import Blame
    from garkcli.order.certificate import Witness
    from garkcli.order.constants import ErrorConstants, Norms
    from garkcli.order.deciding import AnyOrder
    from garkcli.order.dense import DenseOrder, DenseWitness
    from garkcli.order.functionals import Estimator
    from garkcli.order.nearness import EntryAddress, Nearness
    from garkcli.order.predictor import PredictorOrders, StageOrder
    from garkcli.order.repair import Repair
    from garkcli.order.simplifying import Simplifying
    from garkcli.order.sums import WrongSum
    from garkcli.order.suspects import SuspectedNumber
    from garkcli.properties.pattern import Shape
    from garkcli.tableau.tableau import Colour, Tableau

HEADLINE, USUAL, DETAIL, DATA = facts.Level
V = TypeVar("V", bound="bool | int | Size")
AnyAnalysis: TypeAlias = "Analysis | OtherAnalysis"
Edge: TypeAlias = "tuple[int, int]"
Failing: TypeAlias = "tuple[str, Witness, Tableau]"
"""The claim on an order, the condition at which it ends, and its tableau."""


def stages_text(tableau: Tableau) -> str:
    """``4 stages``; ``2 colours, 2 + 3 stages``; the stages of q drive q."""
    if tableau.is_partitioned:
        parts_of = [
            " + ".join(str(len(colour.b)) for colour in tableau.colours if colour.part == part)
            for part in "qp"
        ]
        return "{} colours, stages q: {}, p: {}".format(tableau.size, *parts_of)
    counts = [tableau.space(l).stages for l in range(tableau.size)]
    shown = counts if len(counts) <= 8 else [sum(counts)]
    stages = " + ".join(map(str, shown)) + (" stage" if counts == [1] else " stages")
    return stages if len(counts) == 1 else f"{len(counts)} colours, {stages}"


def _shape_words(shape: Shape, tolerance: fmpq | None, d: Plain) -> str:
    """``ESDIRK within 1e-9``: zeros are exact, equal entries are so within the rounding."""
    return d.known(shape.name, Status(tolerance if shape.singly else None))


def _method_phrase(_: str, outcome: Outcome, answer: facts.Answer[Outcome], d: Plain) -> str:
    """``explicit, 4 stages``."""
    found = outcome.analysis or outcome.every
    assert found is not None
    structure = "" if outcome.structure == "general" else f"for {outcome.structure} problems, "
    kind = ""
    if outcome.analysis is not None:
        a = outcome.analysis
        kind = f"{_shape_words(a.subject.shape, a.tolerance, d)}, "
    return f"{structure}{kind}{stages_text(found.tableau)}"


def _method_words(outcome: Outcome, d: Plain) -> str:
    text = _method_phrase("", outcome, facts.Answer(outcome), d)
    return text if outcome.analysis is None else with_arithmetic(text, outcome.analysis)


def with_arithmetic(text: str, a: AnyAnalysis) -> str:
    if a.tolerance is not None:
        return f"{text}; coefficients rounded"
    degree = a.tableau.degree
    field = "rational arithmetic" if degree == 1 else f"a number field of degree {degree}"
    return f"{text}; decided in {field}"


def each_once(views: Mapping[str, tuple[AnyOrder | None, Tableau | None] | None]) -> list[Failing]:
    """The failing conditions of some orders by their claims, each once."""
    found: list[Failing] = []
    for claim, view in views.items():
        order, tableau = view or (None, None)
        witness = None if order is None else order.witness
        if witness and tableau and witness not in [x for _, x, _ in found]:
            found.append((claim, witness, tableau))
    return found


METHOD: facts.Row[Outcome] = facts.itself(
    "method", told(_method_words, _method_phrase), line="method"
)


def title(outcome: Outcome, d: Plain) -> str:
    name = d.prose(outcome.file or outcome.name)
    if outcome.every is None:
        return name
    return f"{name}, {every_value(outcome.every.family, d)}"


def every_value(family: EveryFamily, d: Plain) -> str:
    """``every value of a where a ≠ 0``."""
    from garkcli.report.design_values import conditions, where  # of families alone

    of = d.prose(_some(family.family.parameters))
    return f"every value of {of}{where(conditions(family.family, family.poles), d)}"


def _some(names: Sequence[str], most: int = 8) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


def no_order(answer: facts.Answer[Any], obstacle: Reason) -> Reason:
    is_none = answer.value is None and bool(obstacle)
    return Reason("none: {}", obstacle) if is_none else NO_REASON


def of_several(key: str, get: Callable[[Analysis], AnyOrder | None]) -> facts.Row[Analysis]:
    """Usual if a method has several colours."""

    def answer(a: Analysis) -> facts.Answer[AnyOrder]:
        answer = kinds.order_answer(get(a))
        is_told = a.tableau.size > 1 and (answer.value or key == "conjugate_order")
        level = USUAL if is_told else DETAIL  # there is no pair where there is no conjugate
        return replace(answer, reason=no_order(answer, a.obstacle), level=level)

    return facts.maybe(key, kinds.ORDER, answer)


def _pair_in_brief(a: Analysis) -> facts.Answer[AnyOrder]:
    is_told = a.tableau.size == 1 and a.pair_order is not None and not a.symplectic
    return replace(kinds.order_answer(a.pair_order), level=USUAL if is_told else DATA)


def with_time(key: str, get: Callable[[Analysis], AnyOrder | None]) -> facts.Row[Analysis]:
    """Returns the row of an order on problems with time; usual if nodes are not row sums."""

    def answer(a: Analysis) -> facts.Answer[AnyOrder]:
        level = USUAL if a.inconsistent else DETAIL
        return replace(kinds.order_answer(get(a)), level=level)

    return facts.maybe(key, kinds.ORDER, answer)


def witnesses(a: Analysis) -> list[Failing]:
    claims = ("order", "conjugate-order", "pair-order", "embedded-order")
    return each_once({claim: findings.order_of(a, claim) for claim in claims})


def drawn(found: Sequence[Failing], d: Plain) -> list[str]:
    lines = []
    room = d.width - 2
    for claim, witness, tableau in found:
        names = [colour.name for colour in tableau.colours]
        is_named = not tableau.has_fields_alone
        tree = format_tree(witness.tree, names if is_named else len(names) > 1)
        value, required = d.number(witness.value), d.number(witness.required)
        label = d.prose(label_of(claim.replace("-", "_")))
        lines += folded(f"{label} fails at {tree}: {value} instead of {required}", room, "  ")
        if names != [str(l + 1) for l in range(len(names))]:
            lines.append(d.prose(named_colours(witness.tree, names)))
        lines += d.drawing(draw_text(witness.tree, len(names) > 1, room))
    return lines


def named_colours(tree: Tree, names: Sequence[str]) -> str:
    """``colour 1 is f, 3 is g``, of a drawing with numbers."""
    return f"colour {', '.join(f'{l + 1} is {names[l]}' for l in sorted(tree.colours))}"


def table(
    letter: str,
    kind: facts.Kind[kinds.BlockTable],
    rows: Callable[[Simplifying], Sequence[Sequence[int | None]]],
) -> facts.Row[Analysis]:
    def get(a: Analysis) -> facts.Answer[kinds.BlockTable]:
        found = kinds.BlockTable(rows(a.simplifying), a.simplifying.limit)
        return facts.Answer(found, Status(a.tolerance))

    return facts.Row(letter, kind, get, DETAIL)


def bound(a: Analysis, is_sharp: bool, is_of_pair: bool = False) -> facts.Answer[int] | None:
    """A lower bound of the order, with the numbers that determine it."""
    whose = a.pair_simplifying if is_of_pair else a.simplifying
    value = a.pair_bound if is_of_pair else a.bound
    if is_sharp:
        value = a.pair_sharp_bound if is_of_pair else a.sharp_bound
    if value is None or whose is None:
        return None
    computed, formula = whose.bound, findings.BOUND
    if is_sharp:
        computed, formula = whose.sharp_bound, findings.SHARP_BOUND
    doubt = f"; {computed} is not decided within the tolerance" if computed != value else ""
    reason = Reason(f"{formula} with {findings.bound_numbers(whose)}{doubt}")
    return facts.Answer(value, Status(a.tolerance, whose.is_open(computed)), reason)


def pair_criterion(a: Analysis) -> facts.Answer[int] | None:
    found = pair_reason(a)
    if found is None:
        return None
    return facts.Answer(found.order, Status(a.tolerance, not found.is_sharp), Reason(found.text))


def pair_criterion_why(a: Analysis) -> list[str]:
    found = pair_reason(a)
    return [] if found is None else [*found.parts]


def _simplifying_phrase(_: str, a: Analysis, answer: facts.Answer[Analysis], d: Plain) -> str:
    """``B(4), C(1), D(1) give at least order 3``."""
    found = a.simplifying
    numbers = (("B", found.r), ("C", found.eta), ("D", found.zeta))
    said = ", ".join(f"{letter}({d.capped(x, found.limit)})" for letter, x in numbers)
    return d.known(f"{said} give at least order {a.bound}", Status(a.tolerance))


SIMPLIFYING: facts.Section[Analysis] = facts.Section(
    table("B", kinds.ROW_OF_COUNTS, lambda x: [x.B]),
    table("C", kinds.TABLE, lambda x: x.C),
    table("D", kinds.TABLE, lambda x: x.D),
    facts.Row("r", kinds.COUNT, lambda a: a.simplifying.r, DATA),
    facts.Row("eta", kinds.COUNT, lambda a: a.simplifying.eta, DATA),
    facts.Row("zeta", kinds.COUNT, lambda a: a.simplifying.zeta, DATA),
    facts.Row("xi", kinds.COUNT, lambda a: a.simplifying.xi, DATA),
    facts.Row("chi", kinds.COUNT, lambda a: a.simplifying.chi, DATA),
    facts.Row("bound", kinds.COUNT, lambda a: bound(a, is_sharp=False), DETAIL),
    facts.optional(
        "limit",
        kinds.COUNT,
        lambda a: a.simplifying.limit if a.simplifying.is_open(a.simplifying.limit) else None,
        DATA,
    ),
)


MOST_ROWS = 3
"""Further rows that do not sum to their nodes are counted."""


def wrong(found: Sequence[Edge], letter: str, within: fmpq | None) -> facts.Answer[bool]:
    """Whether no block has other row sums than nodes."""

    def words(found: Sequence[Edge], d: Plain) -> str:
        return d.few([d.block(letter, edge) + d.prose("𝟙") for edge in found])

    verb = "differs" if len(found) == 1 else "differ"
    reason = Reason(f"{{}} {verb} from c", told(words)(found)) if found else NO_REASON
    return facts.Answer(not found, Status(within), reason)


def consistent(a: Analysis) -> facts.Answer[bool]:
    """Whether the nodes are the row sums; usual if they are not."""
    answer = wrong(a.inconsistent, "A", a.tolerance)
    if rows := a.wrong_rows:
        names = [colour.name for colour in a.tableau.colours]
        more = f"; and {len(rows) - MOST_ROWS} more" if len(rows) > MOST_ROWS else ""
        sums = joined("; ", [findings.sum_text(x, names) for x in rows[:MOST_ROWS]])
        answer = replace(answer, reason=Reason(f"{{}}: {{}}{more}", answer.reason, sums))
    return replace(answer, level=USUAL if a.inconsistent else DETAIL)


def wrong_row_sums(o: Outcome) -> list[Reason]:
    return [consistent(o.analysis).reason] if o.analysis and o.analysis.inconsistent else []


def conjugate_consistent(a: Analysis) -> facts.Answer[bool] | None:
    """Whether the nodes of the conjugate are its row sums; usual for several colours."""
    if a.conjugate is None:
        return None
    is_told = a.conjugate_inconsistent and a.tableau.size > 1
    found = wrong(a.conjugate_inconsistent, "Â", a.tolerance)
    return replace(found, level=USUAL if is_told else DETAIL)


def within(a: AnyAnalysis, key: str) -> fmpq | None:
    return rounding(key, a.subject.verdict(key).value, a.tolerance)


def rounding(key: str, value: object, tolerance: fmpq | None) -> fmpq | None:
    is_of_equations = key == "symplectic" or find(key).asks == "equations"
    return tolerance if value and is_of_equations else None


def verdict_answer(a: Analysis, key: str, kind: type[V]) -> facts.Answer[V]:
    v = a.subject.verdict(key)
    assert v.value is None or isinstance(v.value, kind)
    status = Status(within(a, key), v.is_at_least, v.reason if v.is_undecided else NO_REASON)
    is_told = v.value is not True and not v.is_undecided
    return facts.Answer(v.value, status, v.reason if is_told else NO_REASON)


def truth(key: str) -> facts.Row[Analysis]:
    worthy, words = find(key).noted or (None, "")

    def phrase(label: str, _: bool, answer: facts.Answer[bool], d: Plain) -> str:
        return d.known(d.prose(words or label), answer.status)

    def get(a: Analysis) -> facts.Answer[bool]:
        answer = verdict_answer(a, key, bool)
        is_told = worthy is not None and (answer.value is worthy or bool(answer.status.open))
        return replace(answer, level=USUAL if is_told else DETAIL)

    kind = facts.Kind(kinds.TRUTH.what, facts.Words(kinds.truth_words, phrase=phrase))
    return facts.maybe(find(key).field, kind, get, USUAL if words else DETAIL)


def _names(tableau: Tableau, space: int) -> list[str]:
    return [colour.name for colour in tableau.colours if colour.space == space]


class Staged(TypedDict):
    colours: list[str]
    stages: list[int] | Literal["1 - x"]


def together(a: Analysis) -> list[list[Staged]]:
    found: list[list[Staged]] = []
    for system in a.subject.shape.systems:
        by_space: dict[int, list[int]] = {}
        for space, stage in system:
            by_space.setdefault(space, []).append(stage + 1)
        found.append([{"colours": _names(a.tableau, s), "stages": x} for s, x in by_space.items()])
    return found


def _systems_words(found: Sequence[Sequence[Staged]], d: Plain) -> str:
    def whose(x: Staged) -> str:
        return f" of {d.prose(', '.join(x['colours']))}" if len(d.colours) > 1 else ""

    return "; ".join(
        " with ".join(", ".join(map(str, x["stages"])) + whose(x) for x in system)
        for system in found
    )


def renumbering(a: Analysis) -> list[Staged] | None:
    return [
        {
            "colours": _names(a.tableau, space),
            "stages": "1 - x" if images is None else [i + 1 for i in images],
        }
        for space, images in enumerate(a.subject.symmetry.images)
    ] or None


def _renumbering_words(found: Sequence[Staged], d: Plain) -> str:
    def one(x: Staged) -> str:
        whose = f"{d.prose(', '.join(x['colours']))}: " if len(d.colours) > 1 else ""
        if isinstance(x["stages"], str):
            return whose + d.prose("x → 1 − x")
        moved = [f"{i}↔{j}" for i, j in enumerate(x["stages"], start=1) if i < j]
        return whose + d.prose(f"stages {', '.join(moved)}" if moved else "each stage its own")

    return "; ".join(map(one, found))


STAGES = kinds.record(colours=S.array(S.TEXT), stages=S.array(S.POSITION))
RENUMBERED = kinds.record(
    colours=S.array(S.TEXT), stages=S.one_of(S.array(S.POSITION), {"const": "1 - x"})
)


class OfColour(NamedTuple):
    name: str
    shape: Shape | None
    stage_order: int
    limit: int
    within: fmpq | None

    @property
    def is_open(self) -> bool:
        return self.stage_order >= self.limit


def by_colour(a: Analysis) -> list[OfColour]:
    names = [colour.name for colour in a.tableau.colours]
    found = zip(names, a.subject.shapes, a.subject.simplifying.stage_orders, strict=True)
    return [OfColour(*x, a.subject.limit, a.tolerance) for x in found]


COLOUR: facts.Section[OfColour] = facts.Section(
    facts.Row("name", kinds.TEXT, lambda x: x.name, DATA),
    facts.Row(
        "kind",
        kinds.choice("explicit", "diagonally implicit", "fully implicit", None),
        lambda x: None if x.shape is None else x.shape.kind,
    ),
    facts.maybe(
        "gamma",
        kinds.GAMMA,
        lambda x: None if x.shape is None else facts.Answer(x.shape.gamma, Status(x.within)),
    ),
    facts.Row(
        "stage_order",
        kinds.COUNT,
        lambda x: facts.Answer(x.stage_order, Status(x.within, x.is_open)),
    ),
    facts.optional("stage_order_is_lower_bound", kinds.TRUE, lambda x: x.is_open or None, DATA),
    title=lambda x, d: f"colour {d.prose(x.name)}",
)


def whole_number(a: Analysis, key: str) -> facts.Answer[int]:
    return replace(verdict_answer(a, key, int), reason=NO_REASON)


def count_rows(key: str) -> facts.Rows[Analysis]:
    """The number, and in JSON whether it is a lower bound."""
    field = find(key).field
    return (
        facts.Row(field, kinds.COUNT, lambda a: whole_number(a, key), DETAIL),
        facts.optional(
            f"{field}_is_lower_bound",
            kinds.TRUE,
            lambda a: a.subject.verdict(key).is_at_least or None,
            DATA,
        ),
    )


def colours_apart(a: Analysis) -> list[OfColour] | None:
    if a.tableau.size == 1:
        return None
    found = by_colour(a)
    kinds_of = {(x.shape and x.shape.kind, x.stage_order) for x in found}
    return found if len(kinds_of) > 1 else None


def _colours_words(found: Sequence[OfColour], d: Plain) -> str:
    texts = []
    for x in found:
        said = [] if x.shape is None else [_shape_words(x.shape, x.within, d)]
        if x.shape is not None and x.shape.gamma is not None:
            gamma = d.known(d.diagonal(x.shape.gamma), Status(x.within))
            said.append(f"γ {gamma}" if gamma.startswith("about") else f"γ = {gamma}")
        stage_order = d.known(d.capped(x.stage_order, x.limit), Status(x.within))
        said.append(f"stage order {stage_order}")
        texts.append(f"{d.prose(x.name)} {', '.join(said)}")
    return "; ".join(texts)


SYSTEMS = facts.Kind(facts.Json(S.array(S.array(STAGES))), facts.Words(_systems_words))
MOVED = facts.Kind(facts.Json(S.array(RENUMBERED)), facts.Words(_renumbering_words))
OWN_ROWS: dict[str, facts.Rows[Analysis]] = {
    "gamma": (
        facts.maybe(
            "gamma",
            kinds.GAMMA,
            lambda a: facts.Answer(
                a.subject.shape.gamma, Status(rounding("gamma", a.subject.shape.gamma, a.tolerance))
            ),
        ),
    ),
    "implicit-stages": (
        facts.maybe(
            "implicit_stages", kinds.COUNT, lambda x: x.subject.shape.implicit_stages, DETAIL
        ),
        facts.Row("solved_together", SYSTEMS, together, DETAIL),
    ),
    "symmetric": (
        truth("symmetric"),
        facts.maybe("renumbering", MOVED, renumbering, DETAIL),
        facts.Row("symplectic", kinds.TRUTH, lambda x: x.symplectic, DATA),
    ),
    "stage-order": count_rows("stage-order"),
    "weak-stage-order": count_rows("weak-stage-order"),
}
"""Properties that are no truths, or that are reported with more."""


def property_rows() -> Iterator[facts.Row[Analysis]]:
    for key, file in KEYS.items():
        if file != "stability":
            yield from OWN_ROWS.get(key) or (truth(key),)


PROPERTIES: facts.Section[Analysis] = facts.Section(
    property_rows(),
    facts.Row(
        "by_colour",
        parts(COLOUR),
        lambda a: facts.Answer(by_colour(a), level=DETAIL if a.tableau.size > 1 else DATA),
        DETAIL,
    ),
    facts.Row(
        "undecided",
        kinds.TEXTS,
        lambda a: [k for k in KEYS if find(k).is_cheap and a.subject.verdict(k).is_undecided],
        DATA,
    ),
)


def _block(*colours: int | None) -> list[int]:
    return [x + 1 for x in colours if x is not None]


def _of_matrix(r: Repair) -> bool:
    return r.m is not None and r.i is not None


PLACED: facts.Kind[list[int]] = facts.Kind(facts.Json(kinds.BLOCK))
REPAIR: facts.Section[Repair] = facts.Section(
    facts.optional(
        "b", PLACED, lambda r: None if _of_matrix(r) or r.is_embedded else _block(r.l, r.m)
    ),
    facts.optional("embedded", PLACED, lambda r: _block(r.l) if r.is_embedded else None),
    facts.optional("A", PLACED, lambda r: _block(r.l, r.m) if _of_matrix(r) else None),
    facts.maybe("row", kinds.INTEGER, lambda r: None if r.i is None else r.i + 1),
    facts.Row("entry", kinds.INDEX, lambda x: x.j),
    facts.Row("old", kinds.EXACT, lambda x: x.old),
    facts.Row("new", kinds.EXACT, lambda x: x.new),
)
MISPRINT: facts.Section[SuspectedNumber] = facts.Section(
    facts.Row("old", kinds.EXACT, lambda x: x.old),
    facts.Row("new", kinds.EXACT, lambda x: x.new),
    facts.Row("order", kinds.POSITION, lambda x: x.order),
)
BLAME: facts.Section[Blame] = facts.Section(
    facts.Row(
        "of",
        kinds.choice("order", "conjugate-order", "pair-order", "embedded-order"),
        lambda x: x.of,
    ),
    facts.Row("order", kinds.POSITION, lambda x: x.order),
    facts.Row("failing", kinds.COUNT, lambda x: x.failing),
    facts.Row("conditions", kinds.COUNT, lambda x: x.total),
    facts.Row("only_coupling", kinds.TRUTH, lambda x: x.only_coupling),
    facts.maybe("culprit", PLACED, lambda b: None if b.culprit is None else _block(*b.culprit)),
    facts.Row("in_every", kinds.BLOCKS, lambda x: x.in_every),
    facts.Row("in_none", kinds.BLOCKS, lambda x: x.in_none),
    facts.Row("repairs", parts(REPAIR), lambda x: x.repairs),
    facts.Row("restores", kinds.TEXTS, lambda x: x.restores),
    facts.maybe("restored", kinds.POSITION, lambda x: x.restored),
    facts.maybe("within", kinds.TOLERANCE, lambda x: x.within),
)
WRONG_SUM: facts.Section[WrongSum] = facts.Section(
    facts.optional(
        "b", PLACED, lambda x: _block(x.l) if x.m is None and not x.is_embedded else None
    ),
    facts.optional("embedded", PLACED, lambda x: _block(x.l) if x.is_embedded else None),
    facts.optional("A", PLACED, lambda x: None if x.m is None else _block(x.l, x.m)),
    facts.maybe("row", kinds.POSITION, lambda x: None if x.i is None else x.i + 1),
    facts.Row("sum", kinds.EXACT, lambda x: x.total),
    facts.Row("required", kinds.EXACT, lambda x: x.wanted),
)
ROUNDING_HINT: facts.Section[RoundingHint] = facts.Section(
    facts.Row("of", kinds.choice("order", "embedded-order"), lambda x: x.of),
    facts.Row("order", kinds.COUNT, lambda x: x.order),
    facts.optional("line", kinds.TEXT, lambda r: r.line or None),
    facts.Row("repairs", parts(REPAIR), lambda x: x.repairs),
)


class EntryPlace(NamedTuple):
    entry: EntryAddress
    tableau: Tableau


class PrintDistance(NamedTuple):
    """The distance of a printed method from the method that it probably means."""

    near: Nearness
    analysis: Analysis

    @property
    def entry(self) -> EntryPlace | None:
        return self._placed(self.near.entry)

    @property
    def suspect(self) -> EntryPlace | None:
        """An entry that may be misprinted."""
        return self._placed(self.near.suspect)

    def _placed(self, entry: EntryAddress | None) -> EntryPlace | None:
        return None if entry is None else EntryPlace(entry, self.analysis.tableau)


def _entry_words(found: EntryPlace, d: Plain) -> str:
    x, tableau = found
    colours = [x.l] if x.m is None else [x.l, x.m]
    names = [tableau.colours[l].name for l in colours] if tableau.size > 1 else []
    return d.place(Place(x.letter, tuple(names), (x.j,) if x.i is None else (x.i, x.j)))


def _recovered_words(found: PrintDistance, d: Plain) -> str:
    """``0.98 t from the print, at a[3,2]``."""
    near = found.near
    text = f"{plain_decimal(near.distance)} t from the print"
    if found.entry is not None:
        text += f", at {_entry_words(found.entry, d)}"
    if found.suspect is not None:
        text += f"; {_entry_words(found.suspect, d)} alone is far off: a misprint?"
    if near.is_proved:
        order = found.analysis.order.order
        text += f"; a method of order {order} within t is proved to exist"
    return text if near.is_full else f"{text}; its conditions are met to second order"


def _recovered(a: Analysis) -> PrintDistance | None:
    return None if a.nearness is None else PrintDistance(a.nearness, a)


ENTRY: facts.Section[EntryPlace] = facts.Section(
    facts.Row("letter", kinds.choice("a", "b", "c", "embedded", "dense"), lambda x: x.entry.letter),
    facts.Row("colours", PLACED, lambda x: _block(x.entry.l, x.entry.m)),
    facts.Row("indices", PLACED, lambda x: _block(x.entry.i, x.entry.j)),
)
RECOVERED: facts.Section[PrintDistance] = facts.Section(
    facts.Row("distance", kinds.FLOAT, lambda x: to_float(x.near.distance)),
    facts.maybe("entry", part(ENTRY), lambda x: x.entry),
    facts.maybe("suspect", part(ENTRY), lambda x: x.suspect),
    facts.Row("met_fully", kinds.TRUTH, lambda x: x.near.is_full),
    facts.Row("proved_to_exist", kinds.TRUTH, lambda x: x.near.is_proved),
)


def _norms_words(n: Norms, d: Plain) -> str:
    text = f"2-norm {n.two:.6g}, largest {n.largest:.6g}"
    return (
        text if n.worst is None else f"{text} at {d.tree(n.worst)}, of {counted(n.trees, 'tree')}"
    )


VALUE_TEXT: facts.Kind[Number] = facts.Kind(
    facts.Json(S.TEXT, lambda x, _: to_text(x)), kinds.EXACT.shown
)
NORMS: facts.Section[Norms] = facts.Section(
    facts.Row("trees", kinds.COUNT, lambda x: x.trees),
    facts.maybe("two_norm_squared", VALUE_TEXT, lambda x: x.two_squared, label="sum of squares"),
    facts.Row("two_norm", kinds.FLOAT, lambda x: x.two, label="2-norm"),
    facts.Row("inf_norm", kinds.FLOAT, lambda x: x.largest, label="largest"),
    facts.maybe("worst", kinds.TREE, lambda x: x.worst, label="at"),
    facts.maybe("worst_value", VALUE_TEXT, lambda x: x.worst_value, label="value there"),
    title=lambda n, d: f"norms over {counted(n.trees, 'tree')}",
)


def constants_words(c: ErrorConstants, d: Plain) -> str:
    how = "" if c.is_exact else " in floats"
    text = f"of order {c.order}{how}: {_norms_words(c.all, d)}"
    if len(d.colours) > 1 and of_fields(c):
        text += f"; of coupling trees {_norms_words(c.coupling, d)}"
    return text


def of_fields(c: ErrorConstants) -> bool:
    return c.all.worst is None or c.all.worst.is_of_fields


CONSTANTS: facts.Section[ErrorConstants] = facts.Section(
    facts.Row("order", kinds.POSITION, lambda x: x.order),
    facts.Row("exact", kinds.TRUTH, lambda x: x.is_exact, DATA),
    facts.Row("all", part(NORMS), lambda x: x.all),
    facts.maybe(
        "coupling", part(NORMS), lambda c: c.coupling if c.coupling.trees and of_fields(c) else None
    ),
)


def estimate_words(e: Estimator, d: Plain) -> str:
    text = estimate_phrase(e, d)
    return text if e.is_zero else f"{text}; b − embedded sums to {kinds.EXACTS.words(e.sums, d)}"


def estimate_phrase(e: Estimator, d: Plain) -> str:
    """``O(h^3)``."""
    if e.is_zero:
        return "zero: the embedded weights are b"
    return (
        "leading term not found"
        if e.order is None
        else d.formula(f"O(h^{{{e.order}}})", f"O(h^{e.order})")
    )


ESTIMATE: facts.Section[Estimator] = facts.Section(
    facts.maybe("order", kinds.POSITION, lambda x: x.order),
    facts.Row("zero", kinds.TRUTH, lambda x: x.is_zero),
    facts.Row("sums", kinds.EXACTS, lambda x: x.sums),
    facts.maybe("leading_term", part(CONSTANTS, constants_words), lambda x: x.constants),
)
DENSE_WITNESS: facts.Section[DenseWitness] = facts.Section(
    facts.Row("order", kinds.POSITION, lambda x: x.witness.tree.order),
    facts.Row("tree", kinds.TREE, lambda x: x.witness.tree),
    facts.Row("power", kinds.POSITION, lambda x: x.power),
    facts.Row("value", kinds.EXACT, lambda x: x.witness.value),
    facts.Row("required", kinds.EXACT, lambda x: x.witness.required),
    facts.Row("residual", kinds.EXACT, lambda x: x.witness.residual),
)


def dense_words(x: DenseFacts, _: Plain) -> str:
    if not x.ends_at_step:
        return "does not end where the step does: b(1) is not b"
    smooth = x.slopes.are_continuous
    text = f"{'C¹' if smooth else 'C⁰'}, of degree {x.degree}"
    return f"{text}; whether its slope jumps is not decided" if smooth is None else text


def dense_order(a: Analysis) -> facts.Answer[int] | None:
    return None if a.dense is None else dense_answer(a.dense.order, a.tableau.size > 1)


def dense_answer(found: DenseOrder, colours: bool | Sequence[str]) -> facts.Answer[int]:
    """Trees have colours, or names of these."""
    is_open = Reason(found.undecided) if found.undecided else NO_REASON
    status = Status(found.tolerance, found.is_lower_bound, is_open)
    if found.witness is None:
        return facts.Answer(found.order, status)
    reason = findings.dense_witness_text(found.witness, colours)
    return facts.Answer(found.order, status, reason, witness=found.witness.witness)


DENSE: facts.Section[DenseFacts] = facts.Section(
    facts.Row("degree", kinds.POSITION, lambda x: x.degree),
    facts.maybe("witness", part(DENSE_WITNESS), lambda x: x.order.witness),
    facts.Row("continuous", kinds.TRUTH, lambda x: x.ends_at_step),
    facts.maybe("smooth", kinds.TRUTH, lambda x: x.is_smooth),
    facts.maybe("slope_at_start", kinds.TRUTH, lambda x: x.slopes.at_start),
    facts.maybe("slope_at_end", kinds.TRUTH, lambda x: x.slopes.at_end),
    facts.optional(
        "order_is_lower_bound", kinds.TRUE, lambda x: x.order.is_lower_bound or None, DATA
    ),
    facts.optional("order_undecided", kinds.TRUE, lambda x: bool(x.order.undecided) or None, DATA),
)


def predictor_order(a: Analysis) -> facts.Answer[int] | None:
    """The least order of a predicted stage for every ratio of step sizes, with what fails."""
    found = a.predictor
    if found is None:
        return None
    missed = found.first_missed(equal_steps=False)
    status = Status(None, missed is None, NO_REASON)
    if missed is None:
        return facts.Answer(found.order, status)
    reason = findings.predictor_witness_text(found, equal_steps=False)
    return facts.Answer(found.order, status, reason, witness=missed[1].witness)


def predictor_words(x: PredictorOrders, _: Plain) -> str:
    """``stage 2: order 1, 2 with equal steps``."""
    said = []
    for stage in x.stages:
        equal = f", {stage.equal_steps} with equal steps"
        is_more = stage.equal_steps > stage.order
        said.append(f"stage {stage.stage + 1}: order {stage.order}{equal if is_more else ''}")
    return "; ".join(said)


PREDICTED_STAGE: facts.Section[StageOrder] = facts.Section(
    facts.Row("stage", kinds.POSITION, lambda x: x.stage + 1),
    facts.Row("order", kinds.COUNT, lambda x: x.order),
    facts.Row("equal_steps", kinds.COUNT, lambda x: x.equal_steps),
    facts.optional("order_is_lower_bound", kinds.TRUE, lambda x: x.missed is None or None, DATA),
)
PREDICTOR: facts.Section[PredictorOrders] = facts.Section(
    facts.Row("equal_steps", kinds.COUNT, lambda x: x.equal_steps),
    facts.Row("stages", parts(PREDICTED_STAGE), lambda x: x.stages),
)


class InTableau(NamedTuple):
    colour: Colour
    tableau: Tableau


COLOURS: facts.Section[InTableau] = facts.Section(
    facts.Row("name", kinds.TEXT, lambda x: x.colour.name),
    facts.Row("stages", kinds.POSITION, lambda x: x.tableau.spaces[x.colour.space].stages),
)


def colours_of(tableau: Tableau) -> list[InTableau]:
    return [InTableau(colour, tableau) for colour in tableau.colours]


def _pair_phrase(_: str, order: AnyOrder, answer: facts.Answer[AnyOrder], d: Plain) -> str:
    return f"the symplectic pair has order {kinds.order_cell(order, d)}"


OF_ALL_KINDS: facts.Rows[AnyAnalysis] = (
    facts.Row("exact", kinds.TRUTH, lambda a: a.tolerance is None, DATA),
    facts.maybe("tolerance", kinds.TOLERANCE, lambda a: a.tolerance, DATA),
)
COLOURS_OF: facts.Row[AnyAnalysis] = facts.Row(
    "colours", parts(COLOURS), lambda a: colours_of(a.tableau), DATA
)
COUNTED: facts.Kind[int] = told(lambda x, _: str(x))
ANALYSIS: facts.Rows[Analysis] = [
    *OF_ALL_KINDS,
    facts.Row("recovered_in_words", told(_recovered_words), _recovered, DETAIL, label="recovered"),
    facts.optional("recovered", part(RECOVERED), _recovered, DATA),
    COLOURS_OF,
    facts.Row("order", kinds.ORDER, lambda a: kinds.order_answer(a.order), HEADLINE),
    facts.Row(
        "stage_order",
        COUNTED,
        lambda a: whole_number(a, "stage-order"),
        line="method",
        is_short=True,
    ),
    facts.itself("simplifying", part(SIMPLIFYING, phrase=_simplifying_phrase), line="method"),
    of_several("conjugate_order", lambda a: a.conjugate_order),
    of_several("pair_order", lambda a: a.pair_order),
    with_time("nonautonomous_order", lambda a: a.nonautonomous_order),
    facts.maybe(
        "embedded_order",
        kinds.ORDER,
        lambda a: None if a.embedded is None else kinds.order_answer(a.embedded.order),
    ),
    with_time(
        "embedded_nonautonomous_order",
        lambda a: None if a.embedded is None else a.embedded.nonautonomous_order,
    ),
    facts.maybe(
        "error_estimate",
        part(ESTIMATE, estimate_words),
        lambda a: None if a.embedded is None else a.embedded.estimator,
    ),
    facts.maybe("dense_order", kinds.COUNT, dense_order),
    facts.maybe("dense", part(DENSE, dense_words), lambda a: a.dense, label="dense output"),
    facts.optional("predictor_order", kinds.COUNT, predictor_order),
    facts.optional("predictor", part(PREDICTOR, predictor_words), lambda a: a.predictor),
    facts.maybe("pair_criterion", kinds.COUNT, pair_criterion, DETAIL),
    facts.Row("pair_criterion_why", kinds.TEXTS, pair_criterion_why, DATA),
    facts.maybe(
        "pair_bound", kinds.COUNT, lambda a: bound(a, is_sharp=False, is_of_pair=True), DETAIL
    ),
    facts.Row("sharp_bound", kinds.COUNT, lambda a: bound(a, is_sharp=True), DETAIL),
    facts.maybe(
        "pair_sharp_bound", kinds.COUNT, lambda a: bound(a, is_sharp=True, is_of_pair=True), DETAIL
    ),
    facts.Row("consistent", kinds.TRUTH, consistent),
    facts.Row("inconsistent_blocks", kinds.BLOCKS, lambda a: a.inconsistent, DATA),
    facts.Row("wrong_sums", parts(WRONG_SUM), lambda a: [*a.wrong_weights, *a.wrong_rows], DATA),
    facts.Row(
        "bound_in_brief",
        COUNTED,
        lambda a: facts.Answer(a.bound, Status(a.tolerance)),
        DATA,
        label="bound",
    ),
    facts.maybe("conjugate_consistent", kinds.TRUTH, conjugate_consistent),
    facts.Row(
        "symplectic",
        kinds.TRUTH,
        lambda a: facts.Answer(a.symplectic, Status(a.tolerance) if a.symplectic else Status()),
        line="symplectic",
    ),
    facts.Row(
        "pair",
        told(lambda x, _: str(x.order), _pair_phrase),
        _pair_in_brief,
        line="symplectic",
        is_short=True,
    ),
    facts.itself("properties", part(PROPERTIES), line="symplectic"),
    facts.Row("by_colour", told(_colours_words), colours_apart, label="colours", is_short=True),
    facts.Row("trees_that_fail", picture(drawn), witnesses, DETAIL),
]


MOST_CLAIMS = 6
"""Further claims that hold are counted."""
CLAIM: facts.Section[Claim] = facts.Section(
    facts.Row("claim", kinds.TEXT, lambda x: x.claim),
    facts.Row("expected", kinds.TEXT, lambda x: x.expected),
    facts.Row("found", kinds.TEXT, lambda x: x.found),
    facts.maybe("holds", kinds.TRUTH, lambda x: x.holds),
    facts.Row("line", kinds.POSITION, lambda x: x.line),
    facts.optional("why", kinds.TEXT, lambda c: c.why or None),
)


def claim_rows(outcome: Outcome, d: Plain) -> list[tuple[str, str]]:
    """The claims that fail or are undecided, with their places; those that hold, together."""
    rows = []
    for c in (*outcome.failed_claims, *outcome.undecided_claims):
        said = f"{c.claim}: expected {c.expected}, found {c.found}"
        why = f"; {d.reason(c.reason)}" if c.reason else ""
        place = f" ({outcome.file}:{c.line}:{c.column})"
        rows.append((kinds.claim_word(c.holds, d), d.prose(said) + why + d.prose(place)))
    if outcome.lacks:
        cure = findings.cure_of_lacks(outcome)
        missing = [cure] if outcome.makes_no_claim else [*outcome.lacks, cure]
        rows += [(d.bad("NO CLAIM"), d.prose(message)) for message in missing]
    held = [f"{c.claim}: {c.expected}" for c in outcome.claims if c.holds]
    if held:
        label = "claim holds" if len(held) == 1 else "claims hold"
        is_long = d.is_brief and len(held) > MOST_CLAIMS
        rows.append((d.good(label), str(len(held)) if is_long else d.prose(", ".join(held))))
    return rows


def _claims_cell(o: Outcome, d: Plain) -> str:
    if not o.is_read:
        return "cannot be read"
    unmet = (o.failed_claims, "fail"), (o.undecided_claims, "undecided")
    told = ", ".join(f"{len(x)} of {len(o.claims)} {word}" for x, word in unmet if x)
    if told:
        return d.strong(told)
    held = "1 holds" if len(o.claims) == 1 else f"{len(o.claims)} hold"
    return held if o.claims else "none"


IN_BRIEF: facts.Row[Outcome] = facts.itself(
    "claims_in_brief", told(_claims_cell), DATA, label="claims"
)
CLAIMS_IN_WORDS: facts.Row[Outcome] = facts.Row(
    "claims_in_words", rows_of(claim_rows), lambda o: o if o.claims or o.lacks else None
)
FINDINGS: facts.Row[Outcome] = facts.Row("findings", parts(FINDING), findings.remarks, DATA)
ASIDES: facts.Row[Outcome] = facts.Row(
    "asides", rows_of(remark_rows), lambda o: findings.asides(o) or None
)
CLAIMS: facts.Rows[Outcome] = (
    IN_BRIEF,
    facts.Row("claims", parts(CLAIM), lambda o: o.claims, DATA),
    CLAIMS_IN_WORDS,
    FINDINGS,
    ASIDES,
)
VALUE = S.one_of({"type": ["boolean", "integer", "string", "null"]}, ROOT_OF)


def verdict_data(v: Verdict, _: Plain) -> object:
    if not isinstance(v.value, Size):
        return v.value
    return "infinity" if v.value.root is None else root_data(v.value.root)


def verdict_words(v: Verdict) -> Reason:
    """``yes``, ``at least 2``."""
    if v.value is None:
        return Reason("not decided" if v.is_undecided else "no meaning")
    if isinstance(v.value, bool):
        return Reason("yes" if v.value else "no")
    number = v.value if isinstance(v.value, Size) else str(v.value)
    return Reason("at least {}" if v.is_at_least else "{}", number)


class PropertyVerdict(NamedTuple):
    key: str
    verdict: Verdict
    tolerance: fmpq | None


VERDICT: facts.Section[PropertyVerdict] = facts.Section(
    facts.Row("property", kinds.choice(*KEYS), lambda x: x.key),
    facts.Row("value", facts.Kind(facts.Json(VALUE, verdict_data)), lambda x: x.verdict),
    facts.Row("undecided", kinds.TRUTH, lambda x: x.verdict.is_undecided),
    facts.Row("why", kinds.TEXT, lambda x: x.verdict.why),
)


def property_verdict(a: AnyAnalysis, key: str) -> PropertyVerdict:
    return PropertyVerdict(key, a.subject.verdict(key), within(a, key))


def every_property(o: Outcome) -> list[PropertyVerdict] | None:
    if not o.wants_properties or o.analysis is None:
        return None
    return [property_verdict(o.analysis, key) for key in KEYS]


def property_rows_of(found: Sequence[PropertyVerdict], d: Plain) -> list[tuple[str, str]]:
    rows = []
    for key, v, tolerance in found:
        why = f": {d.reason(v.reason)}" if v.reason and v.value is not True else ""
        rows.append((key, d.known(d.reason(verdict_words(v)), Status(tolerance)) + why))
    return rows


IS_OK: facts.Row[Outcome] = facts.Row("ok", kinds.TRUTH, lambda o: o.ok, DATA)
STRUCTURES = kinds.choice("general", "semi-separable", "separable", "nystrom")
OK: facts.Rows[Outcome] = (
    IS_OK,
    facts.Row("structure", STRUCTURES, lambda o: o.structure, DATA),
    METHOD,
)


def transfer(o: Outcome) -> facts.Answer[list[str]] | None:
    level = DATA if all(map(is_lost, o.about_rules)) else DETAIL
    return facts.Answer([*o.about_rules], level=level) if o.about_rules else None


REASONS: facts.Kind[Sequence[str]] = facts.Kind(
    kinds.TEXTS.what, facts.Words(lambda x, d: d.prose("; ".join(filterfalse(is_lost, x))))
)


def known(o: Outcome, is_same: bool) -> Known | None:
    """The method of the catalogue that is the same, or that differs by little."""
    # most files are in no catalogue, and quiet reports do not ask
    from garkcli.catalogue.known import find_known

    found = None if o.analysis is None else find_known(o.analysis, o.file, o.text)
    return found if found and found.is_same is is_same else None


def of_catalogue(within: facts.Row[Known]) -> facts.Section[Known]:
    return facts.Section(
        facts.Row("method", kinds.TEXT, lambda x: x.method),
        within,
        facts.Row("step_only", kinds.TRUTH, lambda x: x.step_only),
    )


def _known_words(known: Known, d: Plain) -> str:
    by = ""
    if known.within:
        by = f" {'within' if known.is_same else 'by at most'} {decimal(known.within)}"
    apart = ", apart from its embedded weights" if known.step_only else ""
    return f"{d.prose(known.method)}{by}{apart}"


PARTS: facts.Kind[Sequence[str]] = facts.Kind(
    facts.Json(S.array(S.TEXT), lambda x, _: list(x)),
    facts.Words(lambda x, _: f"{' and '.join(x)} of its parts"),
)
LEFT_BEHIND: facts.Row[Outcome] = facts.optional(
    "left_behind", PARTS, lambda o: o.left_behind or None
)
IN_FULL: facts.Row[Outcome] = facts.optional(
    "error_constants", part(CONSTANTS, constants_words), lambda o: o.constants
)
SAME_AS = of_catalogue(facts.maybe("within", kinds.TOLERANCE, lambda x: x.within))
DIFFERS_FROM = of_catalogue(facts.Row("at_most", kinds.TOLERANCE, lambda x: x.within))
COLUMNS = (
    *("file", "order", "embedded_order", "conjugate_order", "pair_order"),
    *("bound_in_brief", "symplectic", "claims_in_brief"),
)
CHECKED: facts.Section[Outcome] = facts.Section(
    kinds.FILE_AND_NAME,
    OK,
    facts.via(lambda o: o.analysis, ANALYSIS),
    facts.optional("transfer", REASONS, transfer),
    LEFT_BEHIND,
    facts.optional("every_property", parts(VERDICT), every_property, DATA),
    facts.optional("blame", part(BLAME), lambda o: o.blame, DATA),
    IN_FULL,
    facts.optional("remark", part(ROUNDING_HINT), lambda o: o.remark, DATA),
    facts.optional("same_as", part(SAME_AS, _known_words), lambda o: known(o, is_same=True)),
    facts.optional(
        "differs_from", part(DIFFERS_FROM, _known_words), lambda o: known(o, is_same=False)
    ),
    CLAIMS,
    facts.Row("properties_in_words", rows_of(property_rows_of), every_property),
    title=title,
    columns=COLUMNS,
)
UNREADABLE: facts.Section[Outcome] = facts.Section(
    kinds.FILE_AND_NAME,
    facts.Row("ok", kinds.constant(value=False), lambda o: o.ok, DATA),
    facts.Row(
        "errors", facts.Kind(facts.Several(FAULT, is_never_empty=True)), lambda o: o.faults, DATA
    ),
    facts.Row("errors_in_words", rows_of(fault_rows), lambda o: o.faults),
    FINDINGS,
    IN_BRIEF,
    title=lambda o, d: f"{d.prose(o.file)}: {d.bad('cannot be read as a method')}",
    columns=COLUMNS,
)
SUMMARY: facts.Section[Sequence[Outcome]] = facts.Section(
    facts.Row("files", kinds.COUNT, len),
    facts.Row("failed", kinds.COUNT, lambda xs: sum(not (x.ok or x.is_open) for x in xs)),
    facts.Row("undecided", kinds.COUNT, lambda xs: sum(x.is_open for x in xs)),
    facts.Row("without_claims", kinds.COUNT, lambda xs: sum(x.makes_no_claim for x in xs)),
)
