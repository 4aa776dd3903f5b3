"""``gark check``: what is found of a method, declared once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from operator import attrgetter
from typing import TYPE_CHECKING, Any, NamedTuple

from garkcli.check.findings import (
    BOUND,
    SHARP_BOUND,
    bound_numbers,
    dense_witness_text,
    order_of,
    sum_text,
)
from garkcli.check.findings import CLAIM as CLAIM_CURE
from garkcli.check.pair_reasons import pair_reason, rule_reasons
from garkcli.errors import counted
from garkcli.exact.display import decimal, plain_decimal, to_float
from garkcli.frozen import replace
from garkcli.ntrees.drawing import draw_text
from garkcli.ntrees.notation import format_tree
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ROOT_OF, root_data
from garkcli.page.paint import folded
from garkcli.properties.property import Size
from garkcli.properties.registry import KEYS, find
from garkcli.reason import NO_REASON, Place, Reason, joined
from garkcli.report.failure import FAULT
from garkcli.tell import kinds
from garkcli.tell.facts import Answer, Kind, Level, Row, Section, Status, maybe, optional, via
from garkcli.tell.parts import part, parts, picture, rows_of, told

if TYPE_CHECKING:
    from garkcli.check.every_family import EveryFamily
    from garkcli.ntrees.tree import Tree
    from garkcli.order.dense import DenseOrder
    from garkcli.properties.pattern import Shape
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


# the method


def stages_text(tableau: Any) -> str:
    """``4 stages``; ``2 colours, 2 + 3 stages``; of many colours their sum.

    The stages of a colour are those at which its vector field is evaluated: those of q drive q.
    """
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


def _shape_words(shape: Shape, tolerance: Any, d: Plain) -> str:
    """``ESDIRK within 1e-9``: equal entries that are not zero are so within the rounding."""
    return d.known(shape.name, Status(tolerance if shape.singly else None))


def _method_phrase(_: str, answer: Answer, d: Plain) -> str:
    """``explicit, 4 stages``."""
    outcome = answer.value
    structure = "" if outcome.structure == "general" else f"for {outcome.structure} problems, "
    kind = ""
    if outcome.every is None:
        a = outcome.analysis
        kind = f"{_shape_words(a.subject.shape, a.tolerance, d)}, "
    return f"{structure}{kind}{stages_text(outcome.found.tableau)}"


def _method_words(outcome: Any, d: Plain) -> str:
    text = _method_phrase("", Answer(outcome), d)
    return text if outcome.every is not None else with_arithmetic(text, outcome.analysis)


def with_arithmetic(text: str, a: Any) -> str:
    """A method in words, with the numbers that its orders are decided in."""
    if a.tolerance is not None:
        return f"{text}; coefficients rounded"
    degree = a.tableau.degree
    field = "rational arithmetic" if degree == 1 else f"a number field of degree {degree}"
    return f"{text}; decided in {field}"


def viewed_order(key: str, level: Any = Level.USUAL, label: str = "") -> Row:
    """An order of an analysis with a ``view`` for each claim."""
    claim = key.replace("_", "-")

    def get(a: Any) -> Answer:
        view = a.view(claim)
        if view is None:
            return Answer(None)
        order, tableau = view
        names = [x.name for x in tableau.colours] if tableau.size > 1 else []
        return replace(kinds.order_answer(order), names=names)

    return Row(key, kinds.ORDER, get, level, has_null=key != "order", label=label or None)


def failing(*claims: str) -> Callable[[Any], list[tuple[Any, Any]]]:
    """The trees at which the orders of some claims end, each with its tableau."""

    def get(a: Any) -> list[tuple[Any, Any]]:
        views = filter(None, map(a.view, claims))
        found: list[tuple[Any, Any]] = []
        for order, tableau in views:
            if order.witness and order.witness not in [x for x, _ in found]:
                found.append((order.witness, tableau))
        return found

    return get


METHOD = Row("method", told(_method_words, _method_phrase), ".", line="method")


def title(outcome: Any, d: Plain) -> str:
    """What a report is about."""
    name = d.prose(outcome.file or outcome.name)
    if outcome.every is None:
        return name
    return f"{name}, {every_value(outcome.every.family, d)}"


def every_value(family: EveryFamily, d: Plain) -> str:
    """Which values are meant by every value: those where there is a method, and which the file
    admits.
    """
    from garkcli.report.design_values import conditions, where  # of families alone

    of = d.prose(_some(family.family.parameters))
    return f"every value of {of}{where(conditions(family.family, family.poles), d)}"


def _some(names: Sequence[str], most: int = 8) -> str:
    more = f" and {len(names) - most} more" if len(names) > most else ""
    return ", ".join(names[:most]) + more


# orders


def order(key: str, of: Callable[[Any], Any], level: Any = USUAL) -> Row:
    """An order of a method."""
    return Row(
        key, kinds.ORDER, lambda a: kinds.order_answer(of(a)), level, has_null=key != "order"
    )


def of_several(key: str) -> Row:
    """The order of the conjugate or the pair: usual where a method has several colours."""

    def get(a: Any) -> Answer:
        answer = kinds.order_answer(getattr(a, key))
        is_told = a.tableau.size > 1 and (answer.value or key == "conjugate_order")
        level = USUAL if is_told else DETAIL  # there is no pair where there is no conjugate
        return replace(
            answer, reason=a.obstacle if answer.value is None else NO_REASON, level=level
        )

    return maybe(key, kinds.ORDER, get)


def _pair_in_brief(a: Any) -> Answer:
    """For one colour that is not symplectic, in a part of a sentence."""
    is_told = a.tableau.size == 1 and a.pair_order is not None and not a.symplectic
    return replace(kinds.order_answer(a.pair_order), level=USUAL if is_told else DATA)


def with_time(key: str, of: Callable[[Any], Any]) -> Row:
    """The order on problems with time, told where the nodes are not the row sums."""

    def get(a: Any) -> Answer:
        level = USUAL if a.inconsistent else DETAIL
        return replace(kinds.order_answer(of(a)), level=level)

    return maybe(key, kinds.ORDER, get)


def witnesses(a: Any) -> list[tuple[Any, Any]]:
    """The conditions at which orders end, each once, with the tableau that misses it."""
    found: list[tuple[Any, Any]] = []
    for claim in ("order", "conjugate-order", "pair-order", "embedded-order"):
        order, tableau = order_of(a, claim)
        if order and order.witness and order.witness not in [x for x, _ in found]:
            found.append((order.witness, tableau))
    return found


def drawn(found: Any, d: Plain) -> list[str]:
    """Trees with the values of their conditions."""
    lines = []
    room = d.width - 2
    for witness, tableau in found:
        names = [colour.name for colour in tableau.colours]
        is_named = not tableau.has_fields_alone
        tree = format_tree(witness.tree, names if is_named else len(names) > 1)
        value, required = d.number(witness.value), d.number(witness.required)
        lines += folded(f"{tree}: {value} instead of {required}", room, "  ")
        if names != [str(l + 1) for l in range(len(names))]:
            lines.append(d.prose(named_colours(witness.tree, names)))
        lines += d.drawing(draw_text(witness.tree, len(names) > 1, room))
    return lines


def named_colours(tree: Tree, names: Sequence[str]) -> str:
    """``colour 1 is f, 3 is g``, of a drawing with numbers."""
    return f"colour {', '.join(f'{l + 1} is {names[l]}' for l in sorted(tree.colours))}"


# B, C, D and the bounds


def tables(letter: str) -> Row:
    """B, C or D of all blocks."""
    kind = kinds.ROW_OF_COUNTS if letter == "B" else kinds.TABLE
    return Row(
        letter,
        kind,
        lambda a: Answer(
            kinds.Table(getattr(a.simplifying, letter), a.simplifying.limit), Status(a.tolerance)
        ),
        DETAIL,
    )


def bound(number: str, simple: str, formula: str) -> Callable[[Any], Any]:
    """A bound of the order, from what it is made."""

    def get(a: Any) -> Any:
        whose = a.pair_simplifying if number.startswith("pair") else a.simplifying
        value = getattr(a, number)
        if value is None or whose is None:
            return None
        computed = getattr(whose, simple)
        doubt = f"; {computed} is not decided within the tolerance" if computed != value else ""
        return Answer(
            value,
            Status(a.tolerance, whose.is_open(computed)),
            Reason(f"{formula} with {bound_numbers(whose)}{doubt}"),
        )

    return get


def pair_criterion(a: Any) -> Any:
    """Why the pair has its order, by B, C, D and the even condition."""
    found = pair_reason(a)
    if found is None:
        return None
    return Answer(found.order, Status(a.tolerance, not found.is_sharp), Reason(found.text))


def pair_criterion_why(a: Any) -> list[str]:
    """The same for programs."""
    found = pair_reason(a)
    return [] if found is None else [*found.parts]


def _simplifying_phrase(_: str, answer: Answer, d: Plain) -> str:
    """``B(4), C(1), D(1) give at least order 3``."""
    a, found = answer.value, answer.value.simplifying
    numbers = (("B", found.r), ("C", found.eta), ("D", found.zeta))
    said = ", ".join(f"{letter}({d.capped(x, found.limit)})" for letter, x in numbers)
    return d.known(f"{said} give at least order {a.bound}", Status(a.tolerance))


SIMPLIFYING = Section(
    *map(tables, "BCD"),
    *(Row(x, kinds.COUNT, f"simplifying.{x}", DATA) for x in ("r", "eta", "zeta", "xi", "chi")),
    Row("bound", kinds.COUNT, bound("bound", "bound", BOUND), DETAIL),
    optional(
        "limit",
        kinds.COUNT,
        lambda a: a.simplifying.limit if a.simplifying.is_open(a.simplifying.limit) else None,
        DATA,
    ),
)


# properties


MOST_ROWS = 3
"""More that do not sum to their nodes are counted."""


def wrong(found: Sequence[Any], letter: str, within: Any) -> Answer:
    """Whether the nodes are the row sums."""

    def words(found: Any, d: Plain) -> str:
        return d.few([d.block(letter, edge) + d.prose("𝟙") for edge in found])

    blocks = Kind({}, words=words)
    verb = "differs" if len(found) == 1 else "differ"
    return Answer(
        not found,
        Status(within),
        Reason(f"{{}} {verb} from c", blocks(found)) if found else NO_REASON,
    )


def consistent(a: Any) -> Answer:
    """The same of the method, told where they are not."""
    answer = wrong(a.inconsistent, "A", a.tolerance)
    if rows := a.wrong_rows:
        names = [colour.name for colour in a.tableau.colours]
        more = f"; and {len(rows) - MOST_ROWS} more" if len(rows) > MOST_ROWS else ""
        told = joined("; ", [sum_text(x, names) for x in rows[:MOST_ROWS]])
        answer = replace(answer, reason=Reason(f"{{}}: {{}}{more}", answer.reason, told))
    return replace(answer, level=USUAL if a.inconsistent else DETAIL)


def conjugate_consistent(a: Any) -> Any:
    """The same of the conjugate of several colours."""
    if a.conjugate is None:
        return None
    is_told = a.conjugate_inconsistent and a.tableau.size > 1
    found = wrong(a.conjugate_inconsistent, "Â", a.tolerance)
    return replace(found, level=USUAL if is_told else DETAIL)


OF_EQUATIONS = {
    *("sdirk", "esdirk", "stiffly-accurate", "fsal", "symmetric", "symplectic"),
    *("gamma", "stage-order", "weak-stage-order"),
}
"""Properties that rounded coefficients have within their tolerance; others hold for all methods
there, or are undecided.
"""


def within(a: Any, key: str) -> Any:
    """The rounding within which a method has a property; None for exactly, or for none."""
    return rounding(key, a.subject.verdict(key).value, a.tolerance)


def rounding(key: str, value: object, tolerance: Any) -> Any:
    """The same of the value of a property."""
    return tolerance if value and key in OF_EQUATIONS else None


def verdict_answer(a: Any, key: str) -> Answer:
    """What is decided of a property."""
    v = a.subject.verdict(key)
    status = Status(within(a, key), v.is_at_least, v.reason if v.is_undecided else NO_REASON)
    is_told = v.value is not True and not v.is_undecided
    return Answer(v.value, status, v.reason if is_told else NO_REASON)


WORTH_A_WORD = {
    "stiffly-accurate": (True, "stiffly accurate"),
    "fsal": (True, "first same as last"),
    "symmetric": (True, "symmetric"),
    "algebraically-stable": (True, "algebraically stable"),
    "reducible": (True, "reducible, see gark convert --to reduced"),
    "positive-weights": (False, "not all weights positive"),
    "nodes-in-unit-interval": (False, "nodes outside [0, 1]"),
}
"""Properties that are usually told where they have this value."""


def truth(key: str) -> Row:
    """A property that every check decides."""
    worthy, words = WORTH_A_WORD.get(key, (None, ""))

    def phrase(label: str, answer: Answer, d: Plain) -> str:
        return d.known(d.prose(words or label), answer.status)

    def get(a: Any) -> Answer:
        answer = verdict_answer(a, key)
        is_told = worthy is not None and (answer.value is worthy or bool(answer.status.open))
        return replace(answer, level=USUAL if is_told else DETAIL)

    return maybe(find(key).field, replace(kinds.TRUTH, phrase=phrase), get)


def _names(tableau: Any, space: int) -> list[str]:
    return [colour.name for colour in tableau.colours if colour.space == space]


def together(a: Any) -> list[Any]:
    """The stages that are solved together, system by system, space by space."""
    found = []
    for system in a.subject.shape.systems:
        by_space: dict[int, list[int]] = {}
        for space, stage in system:
            by_space.setdefault(space, []).append(stage + 1)
        found.append([{"colours": _names(a.tableau, s), "stages": x} for s, x in by_space.items()])
    return found


def _systems_words(found: Any, d: Plain) -> str:
    def whose(x: Any) -> str:
        return f" of {d.prose(', '.join(x['colours']))}" if len(d.colours) > 1 else ""

    return "; ".join(
        " with ".join(", ".join(map(str, x["stages"])) + whose(x) for x in system)
        for system in found
    )


def renumbering(a: Any) -> list[Any] | None:
    """How the stages of a symmetric method are renumbered, space by space."""
    return [
        {
            "colours": _names(a.tableau, space),
            "stages": "1 - x" if images is None else [i + 1 for i in images],
        }
        for space, images in enumerate(a.subject.symmetry.images)
    ] or None


def _renumbering_words(found: Any, d: Plain) -> str:
    def one(x: Any) -> str:
        whose = f"{d.prose(', '.join(x['colours']))}: " if len(d.colours) > 1 else ""
        if x["stages"] == "1 - x":
            return whose + d.prose("x → 1 − x")
        moved = [f"{i}↔{j}" for i, j in enumerate(x["stages"], start=1) if i < j]
        return whose + d.prose(f"stages {', '.join(moved)}" if moved else "each stage its own")

    return "; ".join(map(one, found))


STAGES = kinds.record(colours=S.array(S.TEXT), stages=S.array(S.POSITION))
RENUMBERED = kinds.record(
    colours=S.array(S.TEXT), stages=S.one_of(S.array(S.POSITION), {"const": "1 - x"})
)


class OfColour(NamedTuple):
    """What a colour is like."""

    name: str
    shape: Shape | None
    stage_order: int
    limit: int
    within: Any

    @property
    def is_open(self) -> bool:
        """Whether its stage order may be larger."""
        return self.stage_order >= self.limit


def by_colour(a: Any) -> list[OfColour]:
    """All colours."""
    names = [colour.name for colour in a.tableau.colours]
    found = zip(names, a.subject.shapes, a.subject.simplifying.stage_orders, strict=True)
    return [OfColour(*x, a.subject.limit, a.tolerance) for x in found]


COLOUR = Section(
    Row("name", kinds.TEXT, level=DATA),
    Row(
        "kind",
        kinds.choice("explicit", "diagonally implicit", "fully implicit", None),
        "shape.kind",
    ),
    maybe(
        "gamma",
        kinds.EXACT,
        lambda x: None if x.shape is None else Answer(x.shape.gamma, Status(x.within)),
    ),
    Row("stage_order", kinds.COUNT, lambda x: Answer(x.stage_order, Status(x.within, x.is_open))),
    optional("stage_order_is_lower_bound", kinds.TRUE, lambda x: x.is_open or None, DATA),
    title=lambda x, d: f"colour {d.prose(x.name)}",
)


def whole_number(key: str) -> Callable[[Any], Answer]:
    """A property that is a whole number, and may be a lower bound."""
    return lambda a: replace(verdict_answer(a, key), reason=NO_REASON)


def count_rows(key: str) -> tuple[Row, ...]:
    """Its number, and in JSON whether that is a lower bound."""
    field, is_open = find(key).field, lambda a: a.subject.verdict(key).is_at_least or None
    return (
        Row(field, kinds.COUNT, whole_number(key), DETAIL),
        optional(f"{field}_is_lower_bound", kinds.TRUE, is_open, DATA),
    )


def colours_apart(a: Any) -> list[OfColour] | None:
    """The colours, where they are not alike."""
    found = by_colour(a)
    kinds_of = {(x.shape and x.shape.kind, x.stage_order) for x in found}
    return found if len(kinds_of) > 1 else None


def _colours_words(found: Sequence[OfColour], d: Plain) -> str:
    texts = []
    for x in found:
        said = [] if x.shape is None else [_shape_words(x.shape, x.within, d)]
        if x.shape is not None and x.shape.gamma is not None:
            said.append(f"γ = {d.known(d.number(x.shape.gamma), Status(x.within))}")
        stage_order = d.known(d.capped(x.stage_order, x.limit), Status(x.within))
        said.append(f"stage order {stage_order}")
        texts.append(f"{d.prose(x.name)} {', '.join(said)}")
    return "; ".join(texts)


SYSTEMS = Kind(S.array(S.array(STAGES)), words=_systems_words)
OWN_ROWS = {
    "gamma": (
        maybe(
            "gamma",
            kinds.EXACT,
            lambda a: Answer(a.subject.shape.gamma, Status(within(a, "gamma"))),
        ),
    ),
    "implicit-stages": (
        maybe("implicit_stages", kinds.COUNT, "subject.shape.implicit_stages", DETAIL),
        Row("solved_together", SYSTEMS, together, DETAIL),
    ),
    "symmetric": (
        truth("symmetric"),
        maybe(
            "renumbering", Kind(S.array(RENUMBERED), words=_renumbering_words), renumbering, DETAIL
        ),
        Row("symplectic", kinds.TRUTH, level=DATA),
    ),
    "stage-order": count_rows("stage-order"),
    "weak-stage-order": count_rows("weak-stage-order"),
}
"""Properties that are no truths, or that are reported with more than their truth."""


def property_rows() -> Iterator[Row]:
    """Those that every check decides; what linear stability needs is decided where it is asked."""
    for key, file in KEYS.items():
        if file != "stability":
            yield from OWN_ROWS.get(key) or (truth(key),)


PROPERTIES = Section(
    *property_rows(),
    Row("by_colour", parts(COLOUR), by_colour, lambda x: DETAIL if len(x.value) > 1 else DATA),
    Row(
        "undecided",
        kinds.TEXTS,
        lambda a: [k for k in KEYS if find(k).is_cheap and a.subject.verdict(k).is_undecided],
        DATA,
    ),
)


# hints


def _block(*colours: int | None) -> list[int]:
    return [x + 1 for x in colours if x is not None]


def _of_matrix(r: Any) -> bool:
    return r.m is not None and r.i is not None


PLACED = Kind(kinds.BLOCK)
REPAIR = Section(
    optional("b", PLACED, lambda r: None if _of_matrix(r) or r.is_embedded else _block(r.l, r.m)),
    optional("embedded", PLACED, lambda r: _block(r.l) if r.is_embedded else None),
    optional("A", PLACED, lambda r: _block(r.l, r.m) if _of_matrix(r) else None),
    maybe("row", Kind(S.INTEGER), lambda r: None if r.i is None else r.i + 1),
    Row("entry", kinds.INDEX, "j"),
    Row("old", kinds.EXACT),
    Row("new", kinds.EXACT),
)
BLAME = Section(
    Row("of", kinds.choice("order", "conjugate-order", "pair-order", "embedded-order")),
    Row("order", kinds.POSITION),
    Row("failing", kinds.COUNT),
    Row("conditions", kinds.COUNT, "total"),
    Row("only_coupling", kinds.TRUTH),
    maybe("culprit", PLACED, lambda b: None if b.culprit is None else _block(*b.culprit)),
    Row("in_every", kinds.BLOCKS),
    Row("in_none", kinds.BLOCKS),
    Row("repairs", parts(REPAIR)),
    Row("restores", kinds.TEXTS),
    maybe("restored", kinds.POSITION),
)
WRONG_SUM = Section(
    optional("b", PLACED, lambda x: _block(x.l) if x.m is None and not x.is_embedded else None),
    optional("embedded", PLACED, lambda x: _block(x.l) if x.is_embedded else None),
    optional("A", PLACED, lambda x: None if x.m is None else _block(x.l, x.m)),
    maybe("row", kinds.POSITION, lambda x: None if x.i is None else x.i + 1),
    Row("sum", kinds.EXACT, "total"),
    Row("required", kinds.EXACT, "wanted"),
)
REMARK = Section(
    Row("of", kinds.choice("order", "embedded-order")),
    Row("order", kinds.COUNT),
    optional("line", Kind(S.TEXT), lambda r: r.line or None),
    Row("repairs", parts(REPAIR)),
)


def _entry_words(found: Any, d: Plain) -> str:
    """``a[3,2]``; of several colours ``a{1,2}[3,2]``."""
    x, tableau = found
    colours = [x.l] if x.m is None else [x.l, x.m]
    names = [tableau.colours[l].name for l in colours] if tableau.size > 1 else []
    return d.place(Place(x.letter, tuple(names), (x.j,) if x.i is None else (x.i, x.j)))


def _recovered_words(found: Any, d: Plain) -> str:
    """``0.98 t from the print, at a[3,2]``."""
    near, tableau, order = found
    text = f"{plain_decimal(near.distance)} t from the print"
    if near.entry is not None:
        text += f", at {_entry_words((near.entry, tableau), d)}"
    if near.suspect is not None:
        entry = _entry_words((near.suspect, tableau), d)
        text += f"; {entry} alone is far off: a misprint?"
    if near.is_proved:
        text += f"; a method of order {order} within t is proved to exist"
    return text if near.is_full else f"{text}; its conditions are met to second order"


def _recovered(a: Any) -> Any:
    return None if a.nearness is None else (a.nearness, a.tableau, a.order.order)


def _entry(which: str) -> Callable[[Any], Any]:
    def get(found: Any) -> Any:
        near, tableau, _ = found
        entry = getattr(near, which)
        return None if entry is None else (entry, tableau)

    return get


ENTRY = Section(
    Row("letter", kinds.choice("a", "b", "c", "embedded", "dense"), "0.letter"),
    Row("colours", PLACED, lambda x: _block(x[0].l, x[0].m)),
    Row("indices", PLACED, lambda x: _block(x[0].i, x[0].j)),
)
RECOVERED = Section(
    Row("distance", kinds.FLOAT, lambda x: to_float(x[0].distance)),
    maybe("entry", part(ENTRY), _entry("entry")),
    maybe("suspect", part(ENTRY), _entry("suspect")),
    Row("met_fully", kinds.TRUTH, "0.is_full"),
    Row("proved_to_exist", kinds.TRUTH, "0.is_proved"),
)


def hints(o: Any) -> list[Reason]:
    """What failing conditions tell, a sentence or two each."""
    a = o.analysis
    sums = a.wrong_weights
    if o.remark is None and o.blame is None and not sums:
        return []
    from garkcli.report.hints import blame_text, remark_text  # few files

    names = [colour.name for colour in a.tableau.colours]
    # the entry that is wrong
    is_told = a.tolerance is not None and o.remark is not None and bool(o.remark.repairs)
    blame = NO_REASON if o.blame is None or is_told else blame_text(o.blame, names)
    return [
        *(sum_text(x, names) for x in sums),
        *([] if o.remark is None else [remark_text(o.remark, names, a.tolerance)]),
        *([blame] if blame else []),
    ]


HINTS = Row("hints", rows_of(lambda xs, d: [(d.note("hint"), d.reason(x)) for x in xs]), hints)


# error constants, further weights


def _norms_words(n: Any, d: Plain) -> str:
    text = f"2-norm {n.two:.6g}, largest {n.largest:.6g}"
    return (
        text if n.worst is None else f"{text} at {d.tree(n.worst)}, of {counted(n.trees, 'tree')}"
    )


VALUE_TEXT = Kind(S.TEXT, kinds.EXACT.data, kinds.EXACT.words)
NORMS = Section(
    Row("trees", kinds.COUNT),
    maybe("two_norm_squared", VALUE_TEXT, "two_squared"),
    Row("two_norm", kinds.FLOAT, "two"),
    Row("inf_norm", kinds.FLOAT, "largest"),
    maybe("worst", kinds.TREE),
    maybe("worst_value", VALUE_TEXT),
    title=lambda n, d: f"norms over {counted(n.trees, 'tree')}",
)


def constants_words(c: Any, d: Plain) -> str:
    how = "" if c.is_exact else " in floats"
    text = f"of order {c.order}{how}: {_norms_words(c.all, d)}"
    if len(d.colours) > 1 and of_fields(c):
        text += f"; of coupling trees {_norms_words(c.coupling, d)}"
    return text


def of_fields(c: Any) -> bool:
    """Whether all colours are vector fields of their own, which may be coupled."""
    return c.all.worst is None or c.all.worst.is_of_fields


CONSTANTS = Section(
    Row("order", kinds.POSITION),
    Row("exact", kinds.TRUTH, "is_exact", DATA),
    Row("all", part(NORMS)),
    Row("coupling", part(NORMS), lambda c: c.coupling if of_fields(c) else None, has_null=True),
)


def estimate_words(e: Any, d: Plain) -> str:
    text = estimate_phrase(e, d)
    return text if e.is_zero else f"{text}, sum of b − embedded {kinds.EXACTS(e.sums).words(d)}"


def estimate_phrase(e: Any, _: Plain) -> str:
    """``of order 3``."""
    if e.is_zero:
        return "zero: the embedded weights are b"
    return "leading term not found" if e.order is None else f"of order {e.order}"


ESTIMATE = Section(
    maybe("order", kinds.POSITION),
    Row("zero", kinds.TRUTH, "is_zero"),
    Row("sums", kinds.EXACTS),
    maybe("leading_term", part(CONSTANTS, constants_words), "constants"),
)
DENSE_WITNESS = Section(
    Row("order", kinds.POSITION, "witness.tree.order"),
    Row("tree", kinds.TREE, "witness.tree"),
    Row("power", kinds.POSITION),
    Row("value", kinds.EXACT, "witness.value"),
    Row("required", kinds.EXACT, "witness.required"),
    Row("residual", kinds.EXACT, "witness.residual"),
)


def dense_words(x: Any, d: Plain) -> str:
    """How the pieces of single steps fit together."""
    if not x.ends_at_step:
        return "does not end where the step does: b(1) is not b"
    slope = {True: "its slope too", False: "its slope is not", None: "its slope is not decided"}
    return f"of degree {x.degree}, continuous, b(1) = b; {slope[x.slopes.are_continuous]}"


def dense_order(a: Any) -> Any:
    """The order of dense output for every θ."""
    return None if a.dense is None else dense_answer(a.dense.order, a.tableau.size > 1)


def dense_answer(found: DenseOrder, colours: bool | Sequence[str]) -> Answer:
    """An order of dense output as a value with its status.

    Args:
        found: the order.
        colours: whether trees have colours, or the names of these.
    """
    is_open = Reason(found.undecided) if found.undecided else NO_REASON
    status = Status(found.tolerance, found.is_lower_bound, is_open)
    if found.witness is None:
        return Answer(found.order, status)
    reason = dense_witness_text(found.witness, colours)
    return Answer(found.order, status, reason, more=found.witness.witness)


DENSE = Section(
    Row("degree", kinds.POSITION),
    maybe("witness", part(DENSE_WITNESS), "order.witness"),
    Row("continuous", kinds.TRUTH, "ends_at_step"),
    maybe("smooth", kinds.TRUTH, "is_smooth"),
    maybe("slope_at_start", kinds.TRUTH, "slopes.at_start"),
    maybe("slope_at_end", kinds.TRUTH, "slopes.at_end"),
    optional("order_is_lower_bound", kinds.TRUE, lambda x: x.order.is_lower_bound or None, DATA),
    optional("order_undecided", kinds.TRUE, lambda x: bool(x.order.undecided) or None, DATA),
)
COLOURS = Section(
    Row("name", kinds.TEXT, "1.name"),
    Row("stages", kinds.POSITION, lambda x: x[0].spaces[x[1].space].stages),
)


def colours_of(tableau: Any) -> list[Any]:
    """The colours with their tableau."""
    return [(tableau, colour) for colour in tableau.colours]


# what is found of a method

ANALYSIS = [
    Row("exact", kinds.TRUTH, lambda a: a.tolerance is None, DATA),
    maybe("tolerance", kinds.TOLERANCE, level=DATA),
    Row("recovered_in_words", told(_recovered_words), _recovered, DETAIL, label="recovered"),
    optional("recovered", part(RECOVERED), _recovered, DATA),
    Row("colours", parts(COLOURS), lambda a: colours_of(a.tableau), DATA),
    order("order", lambda a: a.order, HEADLINE),
    Row(
        "stage_order",
        told(lambda x, d: str(x)),
        whole_number("stage-order"),
        line="method",
        is_short=True,
    ),
    Row("simplifying", replace(part(SIMPLIFYING), phrase=_simplifying_phrase), ".", line="method"),
    of_several("conjugate_order"),
    of_several("pair_order"),
    with_time("nonautonomous_order", lambda a: a.nonautonomous_order),
    order("embedded_order", lambda a: a.embedded and a.embedded.order),
    with_time(
        "embedded_nonautonomous_order", lambda a: a.embedded and a.embedded.nonautonomous_order
    ),
    maybe("error_estimate", part(ESTIMATE, estimate_words), "embedded.estimator"),
    maybe("dense_order", kinds.COUNT, dense_order),
    maybe("dense", part(DENSE, dense_words), label="dense output"),
    maybe("pair_criterion", kinds.COUNT, pair_criterion, DETAIL),
    Row("pair_criterion_why", kinds.TEXTS, pair_criterion_why, DATA),
    maybe("pair_bound", kinds.COUNT, bound("pair_bound", "bound", BOUND), DETAIL),
    Row("sharp_bound", kinds.COUNT, bound("sharp_bound", "sharp_bound", SHARP_BOUND), DETAIL),
    maybe(
        "pair_sharp_bound",
        kinds.COUNT,
        bound("pair_sharp_bound", "sharp_bound", SHARP_BOUND),
        DETAIL,
    ),
    Row("consistent", kinds.TRUTH, consistent),
    Row("inconsistent_blocks", kinds.BLOCKS, "inconsistent", DATA),
    Row("wrong_sums", parts(WRONG_SUM), lambda a: [*a.wrong_weights, *a.wrong_rows], DATA),
    Row(
        "bound_in_brief",
        told(lambda x, d: str(x)),
        lambda a: Answer(a.bound, Status(a.tolerance)),
        DATA,
        label="bound",
    ),
    maybe("conjugate_consistent", kinds.TRUTH, conjugate_consistent),
    Row(
        "symplectic",
        kinds.TRUTH,
        lambda a: Answer(a.symplectic, Status(a.tolerance) if a.symplectic else Status()),
        line="symplectic",
    ),
    Row(
        "pair",
        told(
            lambda x, d: str(x.order),
            lambda _, a, d: f"the symplectic pair has order {kinds.order_cell(a.value, d)}",
        ),
        _pair_in_brief,
        line="symplectic",
        is_short=True,
    ),
    Row("properties", part(PROPERTIES), ".", line="symplectic"),
    Row("by_colour", told(_colours_words), colours_apart, label="colours", is_short=True),
    Row("trees_that_fail", picture(drawn), witnesses, DETAIL),
]


# claims

MOST_CLAIMS = 6
"""More that hold are counted."""
CLAIM = Section(
    Row("claim", kinds.TEXT),
    Row("expected", kinds.TEXT),
    Row("found", kinds.TEXT),
    Row("holds", kinds.TRUTH, has_null=True),
    Row("line", kinds.POSITION),
    optional("why", kinds.TEXT, lambda c: c.why or None),
)


def claim_rows(outcome: Any, d: Plain) -> list[tuple[str, str]]:
    """The claims that fail or are undecided, with their places; those that hold, together."""
    rows = []
    for c in (*outcome.failed_claims, *outcome.undecided_claims):
        said = f"{c.claim}: expected {c.expected}, found {c.found}"
        why = f"; {d.reason(c.reason)}" if c.reason else ""
        place = f" ({outcome.file}:{c.line}:{c.column})"
        rows.append((kinds.claim_word(c.holds, d), d.prose(said) + why + d.prose(place)))
    missing = [CLAIM_CURE] if outcome.makes_no_claim else [*outcome.lacks, CLAIM_CURE]
    if outcome.lacks:
        rows += [(d.bad("NO CLAIM"), d.prose(message)) for message in missing]
    held = [f"{c.claim}: {c.expected}" for c in outcome.claims if c.holds]
    if held:
        label = "claim holds" if len(held) == 1 else "claims hold"
        is_long = d.is_brief and len(held) > MOST_CLAIMS
        rows.append((d.good(label), str(len(held)) if is_long else d.prose(", ".join(held))))
    return rows


def _claims_cell(o: Any, d: Plain) -> str:
    if not o.is_read:
        return "cannot be read"
    unmet = (o.failed_claims, "fail"), (o.undecided_claims, "undecided")
    told = ", ".join(f"{len(x)} of {len(o.claims)} {word}" for x, word in unmet if x)
    if told:
        return d.strong(told)
    held = "1 holds" if len(o.claims) == 1 else f"{len(o.claims)} hold"
    return held if o.claims else "none"


IN_BRIEF = Row("claims_in_brief", told(_claims_cell), ".", DATA, label="claims")
CLAIMS = (
    IN_BRIEF,
    Row("claims", parts(CLAIM), level=DATA),
    Row("claims_in_words", rows_of(claim_rows), lambda o: o if o.claims or o.lacks else None),
)
VALUE = S.one_of({"type": ["boolean", "integer", "string", "null"]}, ROOT_OF)


def verdict_data(v: Any, _: Plain) -> Any:
    """A value for programs; null where there is none."""
    from garkcli.properties.property import Size

    if not isinstance(v.value, Size):
        return v.value
    return "infinity" if v.value.root is None else root_data(v.value.root)


def verdict_words(v: Any) -> Reason:
    """A property in a word or a number."""
    if v.value is None:
        return Reason("not decided" if v.is_undecided else "no meaning")
    if isinstance(v.value, bool):
        return Reason("yes" if v.value else "no")
    number = v.value if isinstance(v.value, Size) else str(v.value)
    return Reason("at least {}" if v.is_at_least else "{}", number)


VERDICT = Section(
    Row("property", Kind({"enum": list(KEYS)}), "0"),
    Row("value", Kind(VALUE, verdict_data), "1"),
    Row("undecided", kinds.TRUTH, "1.is_undecided"),
    Row("why", kinds.TEXT, "1.why"),
)


def every_property(o: Any) -> Any:
    """All properties with what decides them, where they were requested."""
    if not o.wants_properties:
        return None
    a = o.analysis
    return [(key, a.subject.verdict(key), within(a, key)) for key in KEYS]


def property_rows_of(found: Any, d: Plain) -> list[tuple[str, str]]:
    """Properties with their verdicts, and what decides them."""
    rows = []
    for key, v, tolerance in found:
        why = f": {d.reason(v.reason)}" if v.reason and v.value is not True else ""
        rows.append((key, d.known(d.reason(verdict_words(v)), Status(tolerance)) + why))
    return rows


OK = (
    Row("ok", kinds.TRUTH, level=DATA),
    Row("structure", kinds.choice("general", "semi-separable", "separable", "nystrom"), level=DATA),
    METHOD,
)


def transfer(outcome: Any) -> Any:
    """Which rules keep the order of the pair; told where the file takes a degree that does not."""
    found = [*rule_reasons(outcome.analysis, outcome.rules)]
    is_told = any(x.startswith("legendre") and " loses " in x for x in found)
    return Answer(found, level=USUAL if is_told else DETAIL) if found else None


TRANSFER = optional(
    "transfer", replace(kinds.TEXTS, words=lambda x, d: "; ".join(map(d.prose, x))), transfer
)
SAME_AS = Section(
    Row("method", kinds.TEXT), maybe("within", kinds.TOLERANCE), Row("step_only", kinds.TRUTH)
)


DIFFERS_FROM = Section(
    Row("method", kinds.TEXT),
    Row("at_most", kinds.TOLERANCE, "within"),
    Row("step_only", kinds.TRUTH),
)


def _known(is_same: bool) -> Any:
    """The method of the catalogue that was checked, or one that it differs from by little."""

    def known(o: Any) -> Any:
        # most files are in no catalogue, and quiet reports do not ask
        from garkcli.catalogue.known import find_known

        found = find_known(o.analysis, o.text)
        return found if found and found.is_same is is_same else None

    return known


def _known_words(known: Any, d: Plain) -> str:
    by = ""
    if known.within:
        by = f" {'within' if known.is_same else 'by at most'} {decimal(known.within)}"
    return f"{d.prose(known.method)}{by}{', but for embedded weights' if known.step_only else ''}"


LEFT_BEHIND = optional(
    "left_behind",
    Kind(S.array(S.TEXT), lambda x, _: list(x), lambda x, d: f"{' and '.join(x)} of its parts"),
    lambda o: o.left_behind or None,
)
COLUMNS = (
    *("file", "order", "embedded_order", "conjugate_order", "pair_order"),
    *("bound_in_brief", "symplectic", "claims_in_brief"),
)
CHECKED = Section(
    *kinds.FILE_AND_NAME,
    *OK,
    *via(lambda o: o.analysis, ANALYSIS),
    TRANSFER,
    LEFT_BEHIND,
    optional("every_property", parts(VERDICT), every_property, DATA),
    optional("blame", part(BLAME), level=DATA),
    optional("error_constants", part(CONSTANTS, constants_words), "constants"),
    optional("remark", part(REMARK), level=DATA),
    optional("same_as", part(SAME_AS, _known_words), _known(is_same=True)),
    optional("differs_from", part(DIFFERS_FROM, _known_words), _known(is_same=False)),
    *CLAIMS,
    HINTS,
    Row("properties_in_words", rows_of(property_rows_of), every_property),
    title=title,
    columns=COLUMNS,
)


AT_LEAST_ONE = Kind({}, section=FAULT, is_list=True, is_never_empty=True)
UNREADABLE = Section(
    *kinds.FILE_AND_NAME,
    Row("ok", Kind({"const": False}), level=DATA),
    Row("errors", AT_LEAST_ONE, "faults"),
    IN_BRIEF,
    title=lambda o, d: f"{d.prose(o.file)}: {d.bad('cannot be read as a method')}",
    columns=COLUMNS,
)
SUMMARY = Section(
    Row("files", kinds.COUNT, len),
    Row("failed", kinds.COUNT, lambda xs: sum(not (x.ok or x.is_open) for x in xs)),
    Row("undecided", kinds.COUNT, lambda xs: sum(x.is_open for x in xs)),
    Row("without_claims", kinds.COUNT, lambda xs: sum(x.makes_no_claim for x in xs)),
)


OF_OTHER_KINDS = [
    Row("exact", kinds.TRUTH, lambda a: a.tolerance is None, DATA),
    maybe("tolerance", kinds.TOLERANCE, level=DATA),
    Row("colours", parts(COLOURS), lambda a: colours_of(a.tableau), DATA),
]
"""Rows of the analysis of methods that are no GARK methods, before their orders."""


def of_other_kind(
    attribute: str, flag: str, words: Callable[[Any, Plain], str], analysis: Sequence[Row]
) -> Section:
    """The rows of a method that is no GARK method.

    Args:
        attribute: where its outcome has the analysis.
        flag: the field of JSON that says of which kind it is.
        words: what the method is, of an outcome.
        analysis: the rows of its analysis after those of all kinds.
    """
    return Section(
        *kinds.FILE_AND_NAME,
        Row("ok", kinds.TRUTH, level=DATA),
        Row(flag, kinds.TRUE, lambda _: True, DATA),
        Row("method", told(words), "."),
        *(row.of(attrgetter(attribute)) for row in (*OF_OTHER_KINDS, *analysis)),
        LEFT_BEHIND,
        optional("error_constants", part(CONSTANTS, constants_words), "constants"),
        *CLAIMS,
        title=title,
        columns=COLUMNS,
    )
