"""``gark design``: the demands of each order on the parameters, and the best methods."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import chain, groupby
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias, cast, get_args

from garkcli.design import steps
from garkcli.design.choices import Choice as Choices
from garkcli.design.design import Design, estimates_nothing
from garkcli.design.member import Whose
from garkcli.design.minimise.objective import LevelObjective as LevelObjective
from garkcli.design.minimise.result import Candidate, Extent, Minimum, ObjectiveLimit, Proof
from garkcli.design.minimise.smallest import DECIMALS
from garkcli.design.solutions import value_at
from garkcli.design.stable_values import StableValues
from garkcli.design.steps import Kind as Verdict
from garkcli.errors import counted
from garkcli.exact.parametric import Parameters, fraction, unknowns_of
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import integral, polynomial_text, root_decimal, root_text
from garkcli.exact.roots import RealRoot
from garkcli.ntrees.tree import Tree
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.exactly import ALGEBRAIC, root_data
from garkcli.reason import Reason
from garkcli.report.design_values import conditions, equation, where, zeros
from garkcli.report.stable_values import VALUES, ends, number, stability
from garkcli.tell import facts
from garkcli.tell.dialect import Plain
from garkcli.tell.kinds import COUNT, INTEGER, POSITION, TEXT, TEXTS, TREE, TRUTH, choice, constant
from garkcli.tell.parts import answer, part, parts, rows_of, told
from garkcli.tell.report import Report

if TYPE_CHECKING:
    from garkcli.order.deciding import AnyOrder

HEADLINE, USUAL, DETAIL, DATA = facts.Level
Texts: TypeAlias = list[tuple[str, str]]
ROOM = 400
"""Signs of polynomials in usual reports."""
OF_POLYNOMIALS = 200
MOST = 4
LONG = 2000
"""A longer polynomial is for programs alone."""


class DesignReport(NamedTuple):
    """``choices`` remain with --choose; ``sets`` are stable, if all values have the order."""

    file: str
    design: Design
    digits: int = 12
    choices: Sequence[Choices] = ()
    minimum: Minimum | None = None
    sets: Sequence[StableValues] = ()


class OrderDemand(NamedTuple):
    design: Design
    step: steps.Step

    @property
    def zeros(self) -> list[str]:
        step = self.step
        return (
            zeros(self.design.family, step.polynomials) if isinstance(step, steps.Decided) else []
        )

    @property
    def conditions(self) -> list[Reason]:
        nonzero = self.step.nonzero if isinstance(self.step, steps.Decided) else ()
        return conditions(self.design.family, nonzero)

    @property
    def solutions(self) -> list[ShownSolution]:
        """The real roots of each solution, then its other roots as one."""
        found = []
        for x in self.step.found:
            found += [ShownSolution(self.design, x, k) for k in range(len(x.solution.real))]
            if x.solution.degree > len(x.solution.real):
                found.append(ShownSolution(self.design, x, None))
        return found

    @property
    def likeness(self) -> tuple[object, ...]:
        return self.step.kind, self.step.known.is_real, self.zeros, self.conditions


class ShownSolution(NamedTuple):
    """A real solution by its number, or those that are not real."""

    design: Design
    found: steps.Found
    number: int | None

    @property
    def values(self) -> dict[str, RealRoot] | None:
        if self.number is None:
            return None
        values = self.found.solution.real_values[self.number]
        return {name: values[name] for name in self.design.family.parameters}

    @property
    def others(self) -> int:
        return self.found.solution.degree - len(self.found.solution.real)


def joined(values: dict[str, RealRoot], d: Plain) -> str:
    """Usually decimals stand for values of long polynomials."""
    texts = [f"{d.expression(name)} = {number(x, d)}" for name, x in values.items()]
    if d.is_brief and sum(map(len, texts)) > ROOM:
        texts = [f"{d.expression(name)} = {d.root(x)}" for name, x in values.items()]
    return ("; " if any(", " in x for x in texts) else ", ").join(texts)


def _polynomials(texts: Sequence[str], d: Plain, which: str = "real and complex") -> str:
    return f"the zeros, {which}, of {_listed(texts, d, 'polynomial')}"


def _listed(texts: Sequence[str], d: Plain, noun: str) -> str:
    shown: list[str] = []
    room = OF_POLYNOMIALS if d.is_brief else len(texts) * LONG
    for text in texts:
        room -= len(text)
        if shown and room < 0:
            break
        is_long = len(text) > LONG
        sides = " = ".join(map(d.expression, text.split(" = ")))
        shown.append(f"a polynomial of {len(text)} signs" if is_long else sides)
    found = "; ".join(shown)
    if more := len(texts) - len(shown):
        return f"{found} and {counted(more, noun)} more with -v"
    return f"{found}, see --format json" if any(len(x) > LONG for x in texts) else found


CRITERION = "B, C, D and the even condition"
UNDECIDED = (
    "fewer unknowns make it decidable: values for some by --set or design: fix, a shape with"
    " fewer such as palindromic; --search N looks for methods and decides nothing"
)
LATE = "give it more; "


def _undecided(design: Design, step: steps.Undecided) -> Iterator[str]:
    """Why an order is not decided, and what helps."""
    limits = "in the time of --seconds" if step.is_late else "within the limits of gark"
    yield f"not decided {limits}"
    ideal, keys = step.ideal, design.family.unsettled
    if ideal is not None and ideal.is_everything:
        yield "msolve finds that no value has it, which is no proof"
    elif ideal is not None:
        yield "which values have it is not worked out"
    if keys:
        yield (
            f"the conditions of {', '.join(keys)} under design take longer than that; ask for"
            " a lower order of the symplectic pair, or fix unknowns by --set or design: fix"
        )
    else:
        yield f"{LATE if step.is_late else ''}{UNDECIDED}"


def _real(found: OrderDemand, d: Plain) -> Iterator[str]:
    known = found.step.known
    if known.within is not None and known.within.ideal.is_everything:
        yield "none of them is real"
    elif known.within is not None:
        texts = zeros(found.design.family, known.within.polynomials)
        yield f"the real ones are among {_polynomials(texts, d)}"
    elif known.is_real is False:
        yield "no real value of them is a method that the file admits"
    if known.is_real is None:
        yield "whether a real value of them is a method that the file admits is not decided"


def _values(found: OrderDemand, d: Plain, is_whole: bool) -> Iterator[str]:
    """The values with which an order is reached; ``is_whole``: with their polynomials."""
    design, step = found.design, found.step
    is_of_real, criterion = design.is_of_real_values(step), design.criterion_of(step)
    match step:
        case steps.NoValue():
            which = "no real value" if is_of_real else "no value"
            if design.family.impossible:
                yield d.prose(design.family.impossible[0])
                return
            if criterion is not None:
                why = criterion.obstacle(step.order)
                yield d.prose(f"{which}: {why}") if why else f"{which}, by {CRITERION}"
                return
            wish, how = "the other requirements", f", by {CRITERION}"
            if step.witness is not None:
                tree = _tree(design, step.witness, d)
                wish, how = f"with the conditions before it, that of {tree}", ""
            if not is_of_real:
                how = ", not even by complex values"
            yield f"{which}: {wish} cannot be met{how}"
        case steps.Undecided():
            yield from map(d.prose, _undecided(design, step))
        case steps.AllValues():
            yield f"every value{where(found.conditions, d)}"
            yield from _real(found, d)
        case steps.Decided():
            what = counted(sum(x.solution.degree for x in step.found), "solution")
            if isinstance(step, steps.Variety):
                what = f"a family of dimension {step.ideal.dimension}{where(found.conditions, d)}"
            which = f"real ones by {CRITERION}" if is_of_real else "real and complex"
            yield f"{what}: {_polynomials(found.zeros, d, which)}" if is_whole else what
            if isinstance(step, steps.Variety):
                yield from _real(found, d)
    if isinstance(step, steps.Decided) and not step.is_all:
        yield "found by msolve: each is proved, that there are no others is not"


def certified(order: AnyOrder, whose: str) -> str:
    of = "symplectic pair" if whose == "pair" else whose
    return f"order {'at least ' * order.is_lower_bound}{order.order} of the {of}"


def _further(found: steps.Found, root: RealRoot, d: Plain) -> list[str]:
    said = []
    if found.embedded is not None:
        order, error = found.embedded
        known = "order at least" if order.is_lower_bound else "order"
        at_next = _number(value_at(error, root), d)
        said.append(f"embedded {known} {order.order} with error {at_next}")
    if found.dense is not None:
        said.append(f"dense order {found.dense.order}")
    if found.predictor is not None:
        least, equal = found.predictor.order, found.predictor.equal_steps
        more = f", {equal} with equal steps" if equal > least else ""
        said.append(f"predictor order {least}{more}")
    return said


def _verdict(x: ShownSolution, d: Plain) -> str:
    design, found, index = x.design, x.found, x.number
    if found.order is None:
        return "no method: a weight or a denominator is zero there"
    order = certified(found.order, design.whose)
    kinds = [d.prose(kind.in_words(design.tableau)) for kind in design.family.stable]
    if index in found.unstable:
        return f"{order}; not {' and '.join(kinds)}, which is wanted"
    if index in found.open:
        return f"{order}; stability not decided: its field is too large, or the time too short"
    if index not in found.accepted:
        return "not of this file: out of a range, a sign not wanted, or another root"
    beside = _further(found, found.solution.real[index], d)
    return ", ".join([f"{order}, proved", *beside, *kinds])


TIMES = {1: "", 2: ", a double solution", 3: ", a triple solution"}


def _solution(x: ShownSolution, d: Plain) -> str:
    times = x.found.solution.multiplicity
    often = TIMES.get(times, f", {times} times")
    if x.values is None:
        return f"{counted(x.others, 'solution')} not real{often}"
    return f"{joined(x.values, d)}: {_verdict(x, d)}{often}"


def groups(design: Design) -> list[list[OrderDemand]]:
    found = (OrderDemand(design, step) for step in design.steps)
    return [list(group) for _, group in groupby(found, key=lambda x: x.likeness)]


def order_rows(x: DesignReport, d: Plain) -> Texts:
    """The demands of each order, with polynomials for the highest that is reached."""
    if not x.design.family.parameters:
        return single_rows(x.design, d)
    rows: Texts = []
    best = _best(x.design)
    for group in groups(x.design):
        first, last = group[0].step.order, group[-1]
        label = f"order {first}" if len(group) == 1 else f"order {first} to {last.step.order}"
        is_whole = not d.is_brief or best is None or best.order <= last.step.order
        rows.append((label, "; ".join(filter(None, _values(last, d, is_whole)))))
        rows += [("", _solution(solution, d)) for solution in last.solutions]
    return rows


def single_rows(design: Design, d: Plain) -> Texts:
    """The condition that stops a method without unknowns."""
    last = design.last
    if not isinstance(last, steps.NoValue) or last.witness is None:
        return []
    tree = _tree(design, last.witness, d)
    return [(f"order {last.order}", f"no: the condition of {tree} fails")]


def _tree(design: Design, tree: Tree, d: Plain) -> str:
    if design.tableau.has_fields_alone:
        return d.tree(tree)
    return d.naming([colour.name for colour in design.tableau.colours]).tree(tree)


def choice_rows(choices: Sequence[Choices], d: Plain) -> Texts:
    rows = []
    for x in choices:
        left = "no method" if x.after < 0 else f"dimension {x.after}"
        text = f"leaves {left} of order {x.order}, dimension {x.before}"
        if x.before < 0:
            text = f"no method of order {x.order} is left to choose from"
        rows.append((f"{d.expression(x.name)} = {d.expression(x.value)}", text))
    return rows


def _best(design: Design) -> steps.Step | None:
    reached = [step for step in design.steps if step.may_have_methods]
    return reached[-1] if reached else None


def _answer(x: DesignReport, d: Plain) -> str:
    """The highest order with its values, then why the next one is not reached."""
    design, last, best = x.design, x.design.last, _best(x.design)
    if not design.family.parameters:
        return _of_single(design, best)
    whose = "" if design.whose == "method" else f" of the {design.whose}"
    texts = []
    if best is not None:
        texts.append(f"order {best.order}{whose} for {_briefly(best)}")
    if best is not last:
        none = "for no real value" if design.is_of_real_values(last) else "for no value"
        no = {"undecided": "is not decided", "none": none}
        text = f"order {last.order}{'' if best else whose}"
        text = f"{text} {no.get(last.kind, 'for no method of the file')}"
        is_impossible = last.kind == "none" and design.family.impossible
        texts.append(d.prose(design.family.impossible[0]) if is_impossible else text)
    texts += [f"{'' if best else whose}{stability(values, d)}" for values in x.sets]
    of_stable = None if best is None else best.known.of_stable
    if of_stable is not None:
        which = "every value of it"
        if of_stable.polynomials:
            # real zeros may have a smaller one
            part = f"a part of dimension {of_stable.ideal.dimension}"
            which = f"exactly the real values of {part}"
        texts.append(f"P-stable for {which}")
    return "; ".join(texts)


def _of_single(design: Design, best: steps.Step | None) -> str:
    last = design.last
    if best is not None and (best is last or last.kind == "none"):
        return f"order {best.order} of the {design.whose}"
    if last.kind == "undecided":
        return f"order {last.order} of the {design.whose} is not decided"
    if last.kind == "none":
        return f"no order {last.order} of the {design.whose}"
    return "the method does not meet the other requirements"


def _briefly(step: steps.Step) -> str:
    """``a family of dimension 2``; ``3 of 4 solutions``."""
    if isinstance(step, steps.AllValues):
        return "every value"
    if isinstance(step, steps.Variety):
        return f"a family of dimension {step.ideal.dimension}"
    count = sum(found.solution.degree for found in step.found)
    real = sum(len(found.accepted) for found in step.found if found.order is not None)
    return counted(count, "solution") if real == count else f"{real} of {count} solutions"


def further_rows(x: DesignReport, d: Plain) -> Texts:
    """Warnings about embedded weights without an error, or without conditions."""
    best, family = _best(x.design), x.design.family
    if not isinstance(best, steps.Decided):
        return []
    if estimates_nothing(x.design, best):
        text = (
            "the embedded weights are b at every value, and estimate no error: a lower"
            " embedded-order under design, or more stages, may leave others"
        )
        return [("embedded", d.prose(text))]
    further, ring = family.further, family.ring
    used = _unknowns(family.tableau.entries, ring)
    used |= {ring.names[i] for p in best.polynomials for i in unknowns_of(cast("Any", p))}
    rows = []
    for label, weights in (("embedded", further.embedded or ()), ("dense", chain(*further.powers))):
        names = _unknowns(chain(*weights), ring)
        if names and not names & used:
            text = f"no condition is on its unknowns: {label}-order under design asks for some"
            rows.append((label, d.prose(text)))
    return rows


def _unknowns(numbers: Iterable[object], ring: Parameters) -> set[str]:
    parts = (p for x in numbers for p in fraction(x, ring))
    return {ring.names[i] for p in parts for i in unknowns_of(p)}


def stable_rows(x: DesignReport, d: Plain) -> Texts:
    """The ends of the stable values, or the way to decide stability."""
    family, best = x.design.family, _best(x.design)
    kinds = ", ".join(map(str, family.stable))
    if not family.parameters:
        return []
    if best is not None and best.known.of_stable is not None:
        texts = [equation(family, p) for p in sorted(best.known.of_stable.polynomials, key=len)]
        found = f"P-stable for exactly {_listed(texts, d, 'equation')}"
        return [("stable", found)] if texts else []
    last = x.design.last
    if kinds and not x.sets and isinstance(last, steps.Many):
        if last.found:  # all real ones, each with its verdict
            return []
        text = f"{kinds}: not decided for all methods of the family: fix unknowns by --set"
        if x.minimum is not None and x.minimum.minimisers:
            text = f"the best method is {kinds}; {text.partition(': ')[2]}"
        if last.has_methods is False:
            text = f"{kinds}: no real value of order {last.order} that the file admits"
        return [("stable", d.prose(text))]
    return [row for values in x.sets for row in ends(values, d)]


def _least(minimum: Minimum, d: Plain) -> str:
    """``least error 1/2``."""
    is_level = isinstance(minimum.objective, LevelObjective)
    what = d.prose(minimum.objective.key.removeprefix("-"))
    if minimum.value is None and not minimum.is_infinite:
        if minimum.step.has_methods:
            return f"{what} of the methods of order {minimum.step.order}: not decided"
        return f"no method of order {minimum.step.order} was found"
    value = d.infinity if minimum.value is None else _number(minimum.value, d)
    if not minimum.design.family.parameters:
        return f"{what} {value}"
    found = " found" if minimum.extent in {"critical-points", "found"} else ""
    if minimum.minimisers:
        return f"{'greatest' if is_level else 'least'} {what}{found} {value}"
    of = f" of what was{found}" if found else ""
    return f"no {'maximum' if is_level else 'minimum'} of {what}{of}: it comes near {value}"


def _number(value: RealRoot, d: Plain) -> str:
    simple, decimals = root_text(value), root_decimal(value, d.digits)
    if simple is None or len(simple) > 40:
        return d.prose(f"{decimals}…")
    if simple == decimals:
        return d.expression(simple)
    is_whole = value.exact is not None and Fraction(decimals) == Fraction(simple)
    return f"{d.expression(simple)} = {decimals}{'' if is_whole else d.prose('…')}"


def _among(minimum: Minimum) -> str:
    order = minimum.step.order
    stable = " and ".join(dict.fromkeys(map(str, minimum.design.family.stable)))
    match minimum.extent:
        case "all":
            return f"of all methods of order {order}{f' that are {stable}' if stable else ''}"
        case "nearly":
            which = f"method of order {order}{f' that is {stable}' if stable else ''}"
            return f"no {which} has less, up to a relative 1e-9"
        case "critical-points":
            points = counted(minimum.candidates, "critical point")
            least = "the only critical point"
            if minimum.candidates != 1:
                least = f"the least of {points}, which are all there are"
            return (
                f"{least}; whether it is less towards infinity or where denominators vanish is open"
            )
        case "found":
            return "the best of what was found"


def _parameters(minimum: Minimum, candidate: Candidate) -> dict[str, RealRoot]:
    solution = candidate.found.solution
    root = solution.real[candidate.index]
    names = minimum.design.family.parameters
    return {name: value_at(solution.values[name], root) for name in names}


def _candidate(minimum: Minimum, candidate: Candidate, d: Plain) -> str:
    said = []
    if candidate.proof == "exists":
        said.append(f"within 1e-{DECIMALS} of a critical point that exists, by Krawczyk's test")
    if candidate.proof == "numerical":
        said.append("better than what was tried around it")
    if candidate.is_constant:
        said.append("and others: the value is the same at all methods near it")
    if candidate.found.order is not None:
        said.append(f"{certified(candidate.found.order, minimum.design.whose)}, proved")
    said += _further(candidate.found, candidate.found.solution.real[candidate.index], d)
    return f"{joined(_parameters(minimum, candidate), d)}: {'; '.join(said)}"


def _toward(limit: ObjectiveLimit, d: Plain) -> str:
    toward, name = limit.toward, d.expression(limit.parameter)
    if toward.end is not None:
        return f"{name} {d.prose('→')} {number(toward.end, d)}"
    return f"{name} {d.prose('→')} {'' if toward.is_right else '-'}{d.infinity}"


def best_rows(minimum: Minimum, d: Plain) -> Texts:
    what = minimum.objective.summary.format(next=minimum.step.order + 1)
    if not minimum.design.family.parameters:
        return [(d.prose(minimum.objective.key.removeprefix("-")), d.prose(what))]
    said = f": {_among(minimum)}" if minimum.minimisers else ""
    rows = [("best", f"{_least(minimum, d)}{said}"), ("", d.prose(what))]
    most = MOST if d.is_brief else len(minimum.minimisers)
    rows += [("", _candidate(minimum, x, d)) for x in minimum.minimisers[:most]]
    if (more := len(minimum.minimisers) - most) > 0:
        rows.append(("", f"{counted(more, 'method')} more with -v"))
    if not minimum.minimisers:
        rows += [("", f"as {_toward(x, d)}") for x in minimum.limits]
    return rows


VALUES_OF: facts.Kind[dict[str, RealRoot]] = facts.Kind(
    facts.Json(
        {"type": "object", "additionalProperties": ALGEBRAIC},
        lambda values, d: {name: root_data(x, d.digits) for name, x in values.items()},
    ),
    facts.Words(joined),
)
NO_VALUES: facts.Kind[object] = facts.Kind(facts.Json(S.NULL))
END: facts.Kind[RealRoot | str] = facts.Kind(
    facts.Json(ALGEBRAIC, lambda x, d: x if isinstance(x, str) else root_data(x, d.digits))
)


def _accepted(x: ShownSolution) -> bool | None:
    """Whether a solution is as stable as wanted; None if nothing is wanted or decided."""
    if not x.design.family.stable:
        return None
    if x.number in x.found.unstable:
        return False
    return True if x.number in x.found.accepted else None


def _embedded_order(found: steps.Found) -> int | None:
    return None if found.embedded is None else found.embedded[0].order


def _dense_order(found: steps.Found) -> int | None:
    return None if found.dense is None else found.dense.order


def _predictor_order(found: steps.Found) -> int | None:
    return None if found.predictor is None else found.predictor.order


def _embedded_error(found: steps.Found, index: int | None) -> RealRoot | None:
    if found.embedded is None or index is None:
        return None
    return value_at(found.embedded[1], found.solution.real[index])


OF_FOUND: facts.Rows[steps.Found] = (
    facts.Row("multiplicity", POSITION, lambda x: x.solution.multiplicity),
    facts.maybe("order", COUNT, lambda x: None if x.order is None else x.order.order),
)
FURTHER: facts.Rows[steps.Found] = (
    facts.optional("embedded_order", COUNT, _embedded_order),
    facts.optional("dense_order", COUNT, _dense_order),
    facts.optional("predictor_order", COUNT, _predictor_order),
)
REAL: facts.Section[ShownSolution] = facts.Section(
    facts.Row("values", VALUES_OF, lambda x: x.values),
    facts.Row("real", constant(value=True), lambda _: True),
    facts.Row("admissible", TRUTH, lambda x: x.number in x.found.accepted),
    facts.maybe("stable", TRUTH, _accepted).but(is_optional=True),
    facts.via(lambda x: x.found, FURTHER[:1]),
    facts.optional("embedded_error", END, lambda x: _embedded_error(x.found, x.number)),
    facts.via(lambda x: x.found, FURTHER[1:]),
    facts.via(lambda x: x.found, OF_FOUND),
)
NOT_REAL: facts.Section[ShownSolution] = facts.Section(
    facts.Row("values", NO_VALUES, lambda x: x.values),
    facts.Row("real", constant(value=False), lambda _: False),
    facts.Row("count", POSITION, lambda x: x.others),
    facts.via(lambda x: x.found, OF_FOUND),
)
SOLUTION: facts.Section[ShownSolution] = facts.SectionChoice(
    lambda x: NOT_REAL if x.number is None else REAL, REAL, NOT_REAL
)
CONDITIONS: facts.Kind[Sequence[Reason]] = facts.Kind(
    facts.Json(S.array(S.TEXT), lambda xs, _: list(map(str, xs)))
)


def _zeros(x: OrderDemand, found: steps.Zeros | None) -> list[str] | None:
    return None if found is None else zeros(x.design.family, found.polynomials)


def _dimension(x: OrderDemand) -> int | None:
    return x.step.ideal.dimension if isinstance(x.step, steps.Decided) else None


STEP: facts.Rows[OrderDemand] = [
    facts.Row("order", POSITION, lambda x: x.step.order, DATA),
    facts.Row("verdict", choice(*get_args(Verdict)), lambda x: x.step.kind, DATA),
    facts.maybe("reached", TRUTH, lambda x: x.step.has_methods, DATA),
    facts.optional(
        "ideal", TEXTS, lambda x: x.zeros if isinstance(x.step, steps.Decided) else None, DATA
    ),
    facts.Row("restrictions", CONDITIONS, lambda x: x.conditions, DATA),
    facts.optional("real_ideal", TEXTS, lambda x: _zeros(x, x.step.known.within), DATA),
    facts.optional("stable_ideal", TEXTS, lambda x: _zeros(x, x.step.known.of_stable), DATA),
    facts.optional("dimension", INTEGER, _dimension, DATA),
    facts.optional(
        "complete", TRUTH, lambda x: None if x.step.ideal is None else x.step.is_all, DATA
    ),
    facts.Row("solutions", parts(SOLUTION), lambda x: x.solutions, DATA),
    facts.maybe(
        "witness",
        TREE,
        lambda x: x.step.witness if isinstance(x.step, steps.NoValue) else None,
        DATA,
    ),
]
CHOICE: facts.Section[Choices] = facts.Section(
    facts.Row("name", TEXT, lambda x: x.name),
    facts.Row("value", TEXT, lambda x: x.value),
    facts.Row("order", POSITION, lambda x: x.order),
    facts.Row("dimension_before", INTEGER, lambda x: x.before),
    facts.Row("dimension", INTEGER, lambda x: x.after),
)
DECIMAL: facts.Kind[RealRoot | str] = facts.Kind(
    facts.Json(S.TEXT, lambda x, d: x if isinstance(x, str) else root_decimal(x, d.digits))
)


def _value(minimum: Minimum) -> RealRoot | str | None:
    return minimum.value or ("infinity" if minimum.is_infinite else None)


def _gradient(minimum: Minimum) -> str | None:
    gradient, name = minimum.gradient, minimum.parameter
    if gradient is None or name is None:
        return None
    [primitive] = integral([gradient]) if gradient else [Polynomial([])]
    return polynomial_text(primitive, name)


def _end(limit: ObjectiveLimit) -> RealRoot | str:
    end = limit.toward.end
    return end if end is not None else "infinity" if limit.toward.is_right else "-infinity"


class Minimiser(NamedTuple):
    minimum: Minimum
    candidate: Candidate


MINIMISER: facts.Section[Minimiser] = facts.Section(
    facts.Row("values", VALUES_OF, lambda x: _parameters(x.minimum, x.candidate)),
    facts.via(lambda x: x.candidate.found, OF_FOUND[1:]),
    facts.Row("proof", choice(*get_args(Proof)), lambda x: x.candidate.proof),
    facts.Row("constant", TRUTH, lambda x: x.candidate.is_constant),
    facts.via(lambda x: x.candidate.found, FURTHER[:1]),
    facts.optional(
        "embedded_error", END, lambda x: _embedded_error(x.candidate.found, x.candidate.index)
    ),
    facts.via(lambda x: x.candidate.found, FURTHER[1:]),
)
LIMIT: facts.Section[ObjectiveLimit] = facts.Section(
    facts.Row("parameter", TEXT, lambda x: x.parameter), facts.Row("toward", END, _end)
)
OBJECTIVE: facts.Section[Minimum] = facts.Section(
    facts.Row("name", TEXT, lambda x: x.objective.key),
    facts.Row("order", POSITION, lambda x: x.step.order),
    facts.maybe("value", DECIMAL, _value),
    facts.maybe("exact", END, _value),
    facts.Row("among", choice(*get_args(Extent)), lambda x: x.extent),
    facts.Row("compared", COUNT, lambda x: x.candidates),
    facts.optional("gradient", TEXT, _gradient),
    facts.Row(
        "minimisers", parts(MINIMISER), lambda x: [Minimiser(x, one) for one in x.minimisers]
    ),
    facts.Row("limits", parts(LIMIT), lambda x: x.limits),
)
WHOLE: facts.Section[DesignReport] = facts.Section(
    facts.Row("file", TEXT, lambda x: x.file, DATA),
    facts.Row("name", TEXT, lambda x: x.design.family.name, DETAIL),
    facts.Row("of", choice(*get_args(Whose)), lambda x: x.design.whose, DATA),
    answer(_answer),
    facts.Row("least", told(_least), lambda x: x.minimum, HEADLINE, label=""),
    facts.Row("unknowns", TEXTS, lambda x: list(x.design.family.parameters)),
    facts.Row("choices", parts(CHOICE), lambda x: x.choices, DATA),
    facts.Row("choices_in_words", rows_of(choice_rows), lambda x: x.choices),
    facts.via(lambda x: OrderDemand(x.design, x.design.last), STEP),
    facts.Row(
        "orders",
        parts(facts.Section(STEP)),
        lambda x: [OrderDemand(x.design, step) for step in x.design.steps],
        DATA,
    ),
    facts.itself("orders_in_words", rows_of(order_rows)),
    facts.itself("further_in_words", rows_of(further_rows)),
    facts.optional("objective", part(OBJECTIVE), lambda x: x.minimum, DATA),
    facts.Row("best_in_words", rows_of(best_rows), lambda x: x.minimum),
    facts.optional("stable", parts(VALUES), lambda x: x.sets or None, DATA),
    facts.itself("stable_in_words", rows_of(stable_rows)),
    title=lambda x, d: d.prose(x.file),
)
REPORT: Report[DesignReport] = Report.only(
    "gark/design/1",
    "report of gark design",
    WHOLE,
    lambda x: {"digits": x.digits, "colours": [c.name for c in x.design.tableau.colours]},
)


def whole(found: Design | Minimum, name: str) -> DesignReport:
    if isinstance(found, Minimum):
        return DesignReport(name or found.design.family.name, found.design, minimum=found)
    return DesignReport(name or found.family.name, found)
