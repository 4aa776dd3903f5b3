"""``compose``: substeps of methods, one by one or by the name of a scheme."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import prod
from typing import Any, TypeAlias

from garkcli.constructions.composition import Substep, adjoint, composed
from garkcli.constructions.schemes import MAX_ORDER, OTHER_NAMES, SCHEMES, Scheme
from garkcli.exact.domain import MAX_DEGREE
from garkcli.exact.expression import read_decimal
from garkcli.grammar import keys as g
from garkcli.grammar.nodes import Node
from garkcli.methodfile.constructed.parts import METHOD, PartReader
from garkcli.methodfile.description import ConstructionText, Make, PartText
from garkcli.methodfile.numbers import Coefficient
from garkcli.methodfile.parameters import NUMBER
from garkcli.methodfile.values import Values
from garkcli.tableau.tableau import Tableau


def _adjoint(at: PartReader, node: Node, where: str) -> ConstructionText | None:
    """The method may have stages without simple nodes."""
    part = at.method(node, where, why="")
    return None if part is None else at.made(node, lambda tableau_of, _: adjoint(tableau_of(part)))


ADJOINT = g.ValueKind(g.defined("part").schema, _adjoint)


_FORM = "write for instance {of: {family: heun}, steps: [1/2, 1/2]}"
_NAME_IT = "give of: METHOD, here or for all of them"
MAX_SUBSTEPS = 400
_Step: TypeAlias = tuple[PartText, Coefficient, bool]
"""The method of a substep, its fraction of the step, and whether the adjoint is taken."""


def _scheme(at: PartReader, node: Node, where: str) -> Scheme | None:
    name = at.source.scalar(node, where)
    other = OTHER_NAMES.get(name or "")
    if other:
        message = f"{where}: {name} is called {other} here"
        at.source.fault(node, message, "write it so", code="unknown-key")
        return None
    return SCHEMES.get(at.source.choice(node, where, SCHEMES) or "")


def _order(at: PartReader, node: Node, where: str) -> int | None:
    order = at.source.whole(node, where, 2, MAX_ORDER)
    if order is not None and order % 2:
        message = f"{where}: a symmetric method has an even order"
        at.source.fault(node, message, f"for instance {order + 1}", code="not-together")
    return order


_ORDER = g.ValueKind(g.count(2, MAX_ORDER).schema, _order)
_STEP = g.mapping(
    g.Key("step: 1/2", NUMBER, "The fraction of the step that this substep takes.", is_needed=True),
    g.Key("of: explicit-euler", METHOD, "The method of this substep."),
    g.Key(
        "adjoint: true", g.FLAG, "Whether this substep is with the adjoint of the method.", False
    ),
    form="write 1/2, or {step: 1/2, adjoint: true}",
)
_KEYS = g.mapping(
    g.Key(
        "of: {family: gauss, stages: 1}",
        METHOD,
        "The method of all substeps that name none of their own.",
    ),
    g.Key(
        "steps: [1/2, 1/2]",
        g.list_of(
            g.either(NUMBER, at_mapping=_STEP), "substeps", MAX_SUBSTEPS, "compose, step {}", _FORM
        ),
        "The fractions of the step, or mappings with step, of and adjoint. They may be negative, "
        "names of parameters, and free.",
    ),
    g.Key(
        "scheme: kahan-li-8",
        g.ValueKind(g.word(lambda: SCHEMES.keys()).schema, _scheme),
        "The substeps by the name of a published scheme, as gark list shows them.",
    ),
    g.Key(
        "order: 6",
        _ORDER,
        "With triple-jump and suzuki: the order of the result, two more with each round.",
    ),
    g.Key(
        "from: 4",
        _ORDER,
        "With triple-jump and suzuki: the order of the method that is composed.",
        2,
    ),
    g.Key(
        "processor: {family: gauss, stages: 1}",
        METHOD,
        "A method π: the step is π, then the substeps, then the inverse of π.",
    ),
    form=_FORM,
    rules=[
        g.Ways("the substeps are", ("scheme", "steps")),
        g.Ways(
            "",
            ("steps", "scheme", "processor"),
            "no substeps",
            "give steps: [1/2, 1/2] or scheme: triple-jump",
            is_one=False,
        ),
        g.KeyRelation(
            "scheme", "of missing beside scheme", _FORM, needs=("of",), code="missing-key"
        ),
        *(
            g.KeyRelation(key, f"{key} goes with scheme", needs=("scheme",), code="option-alone")
            for key in ("order", "from")
        ),
    ],
)


def _read(at: PartReader, entries: g.ReadMapping, where: str) -> ConstructionText | None:
    before, node = len(at.source.faults), entries.node
    steps = [*_steps(at, entries, where)]
    if "processor" in entries:
        # π after, and its inverse before: the adjoint with the step −1
        one, back = (at.numbers.written(x, node, where) for x in ("1", "-1"))
        steps = [(entries["processor"], back, True), *steps, (entries["processor"], one, False)]
    if len(at.source.faults) > before:
        return None
    scheme = entries.get("scheme")
    rounding = scheme and scheme.tolerance and read_decimal(scheme.tolerance)
    return at.made(node, _maker(steps), rounding or None)


def _steps(at: PartReader, entries: g.ReadMapping, where: str) -> Iterator[_Step]:
    whole: Any = entries.get("of")
    if "scheme" in entries:
        place = entries.nodes["scheme"]
        scheme = entries["scheme"]
        for text, is_adjoint in scheme.parts(*_orders(at, entries, scheme)):
            yield whole, at.numbers.written(text, place, scheme.name), is_adjoint
    elif "steps" not in entries and whole is not None:
        yield whole, at.numbers.written("1", entries.node, where), False
    places = entries.nodes["steps"].value if "steps" in entries else ()
    for number, (place, step) in enumerate(zip(places, entries.get("steps", ()), strict=True), 1):
        is_number = isinstance(step, Coefficient)
        part = whole if is_number else step.get("of", whole)
        if part is None:
            message = f"compose, step {number}: the step of no method"
            at.source.fault(place, message, _NAME_IT, code="missing-key")
        elif is_number:
            yield part, step, False
        else:
            yield part, step["step"], step.get("adjoint", False)


def _orders(at: PartReader, entries: g.ReadMapping, scheme: Scheme) -> tuple[int, int]:
    """Substeps that raise a symmetric method of order p contain a root of degree p + 1."""
    if not scheme.has_orders:
        for key in entries.nodes.keys() & {"order", "from"}:
            message = f"{scheme.name} has one order, {scheme.order}"
            at.source.fault(entries.nodes[key], message, "leave it out", code="not-together")
        return 0, 0
    base = entries.get("from", 2)
    wanted = base + 2
    if "order" in entries:
        wanted = at.source.whole(entries.nodes["order"], "compose, order", wanted) or base
    degree = prod(order + 1 for order in range(base, wanted, 2))
    if degree > MAX_DEGREE:
        message = f"{scheme.name} from order {base} to {wanted} has radicals of"
        message += f" degree {degree} together (limit {MAX_DEGREE})"
        cure = "take fewer repetitions, or a rounded scheme, such as yoshida-8"
        at.source.fault(entries.nodes["order"], message, cure, code="no-radicals")
        return base, base
    return base, wanted


def _maker(steps: Sequence[_Step]) -> Make:
    def made(tableau_of: Callable[[PartText], Tableau], values: Values) -> Tableau:
        turned: dict[int, Tableau] = {}
        substeps = []
        for part, entry, is_adjoint in steps:
            tableau = tableau_of(part)
            if is_adjoint:
                if id(part) not in turned:
                    turned[id(part)] = adjoint(tableau)
                tableau = turned[id(part)]
            substeps.append(Substep(tableau, values.number(entry)))
        return composed(substeps)

    return made


KIND = _KEYS.then(_read)
