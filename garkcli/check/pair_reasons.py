"""The reason for the order of a pair, and whether rules preserve it, by docs/pair-order.md."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.exact.matrix import Matrix, apply, dot, is_singular, multiply
from garkcli.frozen import Frozen
from garkcli.order.meant import derived, meant
from garkcli.order.pair_order import SimplifyingCondition, added, missing_of_block, pair_criterion
from garkcli.order.simplifying import simplifying
from garkcli.tableau.forms import gark
from garkcli.tableau.tableau import Method, Tableau

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.exact.field import Number
    from garkcli.methodfile.description import BlockRule


class PairReason(Frozen):
    order: int | None
    parts: tuple[str, ...]
    is_sharp: bool = True

    @property
    def text(self) -> str:
        return "; ".join(self.parts)


def pair_reason(analysis: Analysis) -> PairReason | None:
    """Returns the reason for the order of the pair, or why the theorem does not apply."""
    if analysis.pair is None or analysis.pair_order is None:
        return None
    tableau = analysis.pair if analysis.tableau.is_partitioned else analysis.tableau
    doubt = _no_statement(analysis, tableau)
    if doubt:
        return PairReason(None, (doubt,))
    method = meant(analysis.tableau, analysis.tolerance)
    if analysis.tableau.is_partitioned:
        method = derived(method, "pair")
    criterion = pair_criterion(method, analysis.limit)
    parts = [_conditions_met(criterion.order, tableau.size > 1)]
    if criterion.missing:
        names = [colour.name for colour in tableau.colours]
        missing = _missing(criterion.missing, names, sum(1 for _ in tableau.edges()))
        parts.append(f"order {criterion.order + 1} needs {missing}")
    is_sharp, why = _is_sharp(analysis)
    if not is_sharp:
        parts.append(f"a larger order is not excluded: {why}")
    return PairReason(criterion.order, tuple(parts), is_sharp)


def _no_statement(analysis: Analysis, tableau: Tableau) -> str:
    """Returns the hypothesis of the criterion that fails; empty if none fails."""
    for l, colour in enumerate(tableau.colours):
        row = [m for m in range(tableau.size) if tableau.block(l, m) is not None]
        if not row:
            return f"colour {colour.name} sees no colour"
        if all((l, m) in analysis.inconsistent for m in row):
            return f"the nodes of colour {colour.name} are not row sums"
        if not tableau.is_partitioned:
            for m in row:
                if tableau.block(m, l) is None:
                    other = tableau.colours[m].name
                    return f"colour {colour.name} sees colour {other}, which does not see it"
    return ""


def _is_sharp(analysis: Analysis) -> tuple[bool, str]:
    """Returns whether the criterion is necessary too, and otherwise why not."""
    for colour in analysis.tableau.colours:
        if colour.is_linear:
            return False, f"colour {colour.name} is linear"
    positive = analysis.subject.verdict("positive-weights")
    if positive.is_undecided:
        return False, "rounding leaves the signs of weights open"
    if not positive.value:
        return False, "not all weights are positive"
    return True, ""


def _conditions_met(order: int, has_blocks: bool) -> str:
    k = (order - 1) // 2
    parts = [f"B({order})"] if order else ["nothing"]
    if k > 0:
        parts += [f"C({k})", f"D({k})"]
    said = ", ".join(parts) + (" on every block" if k > 0 and has_blocks else "")
    return said + (" and the even condition" if order and order % 2 == 0 else "")


_MOST_BLOCKS = 4


def _missing(missing: Sequence[SimplifyingCondition], names: Sequence[str], blocks: int) -> str:
    parts = []
    for letter, number in added(_order_of(missing[0])):
        there = [x for x in missing if x.letter == letter]
        if not there:
            continue
        what = "the even condition" if letter == "even" else f"{letter}({number})"
        if letter == "B":
            places = [names[x.l] for x in there]
            every = len(names)
            noun = "colour"
        else:
            places = [f"({names[x.l]},{names[x.m]})" for x in there]
            every = blocks
            noun = "block"
        if len(names) > 1:
            what += f" {_on(places, every, noun)}"
        parts.append(what)
    return ", ".join(parts)


def _order_of(condition: SimplifyingCondition) -> int:
    if condition.letter == "B":
        return condition.number
    return 2 * condition.number + (2 if condition.letter == "even" else 1)


def _on(places: Sequence[str], every: int, noun: str) -> str:
    if len(places) == every:
        return f"on every {noun}"
    shown = ", ".join(places[:_MOST_BLOCKS])
    more = len(places) - _MOST_BLOCKS
    tail = f" and {more} more" if more > 0 else ""
    return f"on {noun}{'s' if len(places) > 1 else ''} {shown}{tail}"


MOST_RULES = 150
"""Most blocks by rules that are examined."""


def rule_reasons(analysis: Analysis, rules: Sequence[BlockRule]) -> Iterator[str]:
    tableau = analysis.tableau
    if len(rules) > MOST_RULES:
        yield f"{len(rules)} blocks were not examined for the order (limit {MOST_RULES})"
        return
    if not rules or analysis.tolerance or tableau.is_partitioned or not _is_sharp(analysis)[0]:
        return
    if _no_statement(analysis, tableau):
        return
    methods = []
    for l, colour in enumerate(tableau.colours):
        block = tableau.block(l, l)
        if block is None:
            return
        methods.append(Method(colour.name, tableau.space(l), block, colour.b))
    p = min(pair_criterion(gark([method], {})).order for method in methods)
    by_text: dict[tuple[str, str], list[str]] = {}
    for x in rules:
        found_fit = fit(x, methods, p)
        if found_fit is not None:
            if found_fit.keeps is None:
                found_fit = _by_block(found_fit, missing_of_block(tableau, (x.l, x.m), p))
            words = "keeps" if found_fit.keeps else "loses"
            text = f"{found_fit.numbers}, {words} symplectic pair order {p}"
            by_text.setdefault((x.rule, text), []).append(f"({x.l + 1},{x.m + 1})")
    for (rule, text), places in by_text.items():
        yield f"{rule} on {', '.join(places)}: {text}"


def is_lost(reason: str) -> bool:
    return reason.startswith("legendre") and " loses " in reason


class Fit(Frozen):
    """Whether a rule preserves the least pair order; None if that depends on the entries."""

    keeps: bool | None
    numbers: str


def _by_block(by_numbers: Fit, missing: Sequence[SimplifyingCondition]) -> Fit:
    names = [
        "the even condition" if x.letter == "even" else f"{x.letter}({x.number})" for x in missing
    ]
    if not names:
        return Fit(True, f"{by_numbers.numbers}, but its conditions hold")
    *others, last = names
    said = f"{', '.join(others)} and {last} fail" if others else f"{last} fails"
    return Fit(False, f"{by_numbers.numbers}, {said}")


def fit(x: BlockRule, methods: Sequence[Method], p: int) -> Fit | None:
    """Returns whether a rule preserves pair order p; None if the theorems do not cover it."""
    match x.rule:
        case "legendre":
            return _legendre(x.degree, methods, p)
        case "collocation":
            return _collocation(methods[x.l], methods[x.m], p)
        case "interpolation":
            return _interpolation(methods[x.l], methods[x.m], p)
    return None


def _legendre(degree: int | None, methods: Sequence[Method], p: int) -> Fit:
    k, r = (p - 1) // 2, min(map(_quadrature_order, methods))
    K = p // 2 if degree is None else degree
    if k > K:
        return Fit(None, f"K = {K} < k = {k}")
    if r - k >= K:
        return Fit(True, f"k = {k} ≤ K = {K} ≤ r − k = {r - k}")
    return Fit(None, f"K = {K} > r − k = {r - k}")


def _quadrature_order(method: Method) -> int:
    return simplifying(gark([method], {})).r


def _quadrature_error(method: Method, exponent: int) -> Number:
    return fmpq(1, exponent + 1) - dot(method.b, method.space.power(method.c, exponent))


def _collocation(l: Method, m: Method, p: int) -> Fit | None:
    k, s = (p - 1) // 2, m.stages
    r_l, r_m = _quadrature_order(l), _quadrature_order(m)
    if p < 3:
        return Fit(True, "p ≤ 2")
    if r_m < s:
        return None
    r = min(r_l, r_m)
    if s <= r - k:
        return Fit(True, f"s = {s} ≤ r − k = {r - k}")
    if s == r - k + 1 and r_l == r_m:
        sum_of_errors = k * _quadrature_error(l, r) + s * _quadrature_error(m, r)
        if not sum_of_errors:
            return Fit(True, f"s = {s} = r − k + 1 and k E_l + s E_m = 0")
    return Fit(False, f"s = {s} > r − k = {r - k}")


def _interpolation(l: Method, m: Method, p: int) -> Fit | None:
    k = (p - 1) // 2
    if p < 3:
        return Fit(True, "p ≤ 2") if m.stages > 1 or p < 2 else None
    lifted = multiply(m.space.lifts(), m.A)
    delta = _degree(lifted)
    of_power = _degree(tuple((x,) for x in apply(lifted, m.space.power(m.c, k))))
    rho = _agreement(l, m)
    if rho is None:
        return Fit(True, f"degree {delta}, the same weights")
    numbers = f"degree {delta}, ρ − k = {rho - k}"
    if delta <= rho - k and (p % 2 or of_power <= rho - k - 1):
        return Fit(True, numbers)
    if delta > rho and is_singular(m.A):
        return Fit(None, numbers)
    return Fit(False, numbers)


def _degree(columns: Matrix) -> int:
    return max((i for i, row in enumerate(columns) if any(row)), default=0)


def _agreement(l: Method, m: Method) -> int | None:
    """Returns ρ, the number of moments in which the weights agree; None for all."""
    mine, other = l.space.one, m.space.one
    for rho in range(l.stages + m.stages):
        if dot(l.b, mine) != dot(m.b, other):
            return rho
        mine, other = l.space.product(mine, l.c), m.space.product(other, m.c)
    return None
