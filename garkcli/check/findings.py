"""The findings in checked files."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.check.claims import Claim
from garkcli.check.outcome import Outcome
from garkcli.check.pair_reasons import is_lost
from garkcli.errors import Remark, Severity, counted
from garkcli.exact.display import decimal, shortest, to_ball, to_decimal, to_text
from garkcli.exact.field import Number
from garkcli.frozen import Frozen, replace
from garkcli.glossary.faults import cure_of
from garkcli.grammar.nodes import Node, below, composed, position
from garkcli.ntrees.notation import format_tree
from garkcli.order.certificate import Witness
from garkcli.reason import NO_REASON, Code, Formula, Place, Reason, joined
from garkcli.tableau.forms import with_time

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.check.remark import RoundingHint
    from garkcli.order.blame import Blame
    from garkcli.order.deciding import AnyOrder
    from garkcli.order.dense import DenseWitness
    from garkcli.order.predictor import PredictorOrders
    from garkcli.order.repair import Repair
    from garkcli.order.simplifying import Simplifying
    from garkcli.order.sums import WrongSum
    from garkcli.order.suspects import SuspectedNumber
    from garkcli.tableau.tableau import Tableau

BOUND = "min{r, 2η+2, ξ+1, η+ζ+1}"
SHARP_BOUND = "min{r, 2η+2, ξ+1, χ+2, η+ζ+3}"
NEAR = 1e-3
"""Row sums and nodes that differ by less are taken to be meant equal."""
_SHORT = 20
"""The longest exact entry that is shown."""
_LONG = 60
"""The longest value and residual of a witness that are shown exactly."""
_MOST = 3


def witness_text(witness: Witness, colours: bool | Sequence[str]) -> Reason:
    return _failure(witness, Code(format_tree(witness.tree, colours)))


DENSE_ORDERS = {
    "dense-order": "order",
    "dense-position-order": "position_order",
    "dense-velocity-order": "velocity_order",
}


PREDICTOR_ORDERS = ("predictor-order", "predictor-order-equal-steps")


def dense_witness_text(dense: DenseWitness, colours: bool | Sequence[str]) -> Reason:
    tree = Code(format_tree(dense.witness.tree, colours))
    power = Formula(f"θ^{dense.power}", rf"\theta^{{{dense.power}}}")
    return _failure(dense.witness, Reason("{}, at {}", tree, power))


def predictor_witness_text(orders: PredictorOrders, *, equal_steps: bool) -> Reason:
    missed = orders.first_missed(equal_steps=equal_steps)
    if missed is None:
        return NO_REASON
    stage, where = missed
    tree = Code(format_tree(where.witness.tree, colours=False))
    ratio = "" if equal_steps else f", r = {where.ratio}"
    return _failure(where.witness, Reason(f"{{}} of stage {stage + 1}{ratio}", tree))


def _failure(witness: Witness, condition: Code | Reason) -> Reason:
    value, residual = to_text(witness.value), to_text(witness.residual)
    is_long = len(value) + len(residual) > _LONG
    return Reason(
        f"fails at order {witness.tree.order}: {{}}: {{}} instead of {{}}, off by {{}}",
        condition,
        f"about {to_decimal(witness.value, 8)}" if is_long else Formula(value),
        Formula(str(witness.required)),
        to_decimal(witness.residual, 4) if is_long else Formula(residual),
    )


def bound_numbers(conditions: Simplifying) -> str:
    numbers = {
        "r": conditions.r,
        "η": conditions.eta,
        "ζ": conditions.zeta,
        "ξ": conditions.xi,
        "χ": conditions.chi,
    }
    return ", ".join(
        f"{name} {'≥' if conditions.is_open(number) else '='} {number}"
        for name, number in numbers.items()
    )


def claim_witness(outcome: Outcome, claim: str) -> Reason:
    for made in outcome.claims:
        if made.claim == claim and made.holds is not True and made.reason:
            return made.reason
    if outcome.of_other_kind is not None:
        view = outcome.of_other_kind.view(claim)
        if view is None or view[0].witness is None:
            return NO_REASON
        return witness_text(view[0].witness, colours=True)
    analysis = outcome.analysis
    if analysis is None:
        return NO_REASON
    if claim.endswith("bound"):
        conditions = analysis.simplifying
        if claim.startswith("pair-"):
            if analysis.pair_simplifying is None:
                return NO_REASON
            conditions = analysis.pair_simplifying
        equation = f"{conditions.bound} = {BOUND}"
        if claim.endswith("sharp-bound"):
            equation = f"{conditions.sharp_bound} = {SHARP_BOUND}"
        return Reason("{} with {}", equation, bound_numbers(conditions))
    if claim in DENSE_ORDERS:
        dense = getattr(analysis.dense, DENSE_ORDERS[claim], None)
        if dense is None or dense.witness is None:
            return NO_REASON
        return dense_witness_text(dense.witness, analysis.tableau.size > 1)
    if claim in PREDICTOR_ORDERS and analysis.predictor is not None:
        equal_steps = claim.endswith("equal-steps")
        return predictor_witness_text(analysis.predictor, equal_steps=equal_steps)
    order, tableau = order_of(analysis, claim)
    if order is None or tableau is None or order.witness is None:
        return NO_REASON
    return witness_text(order.witness, tableau.size > 1)


def order_of(analysis: Analysis, claim: str) -> tuple[AnyOrder | None, Tableau | None]:
    embedded = analysis.embedded
    if embedded is not None and claim == "embedded-order":
        return embedded.order, embedded.tableau
    if embedded is not None and claim == "embedded-nonautonomous-order":
        return embedded.nonautonomous_order, with_time(embedded.tableau)
    if claim == "nonautonomous-order":
        return analysis.nonautonomous_order, with_time(analysis.tableau)
    by_claim = {
        "order": (analysis.order, analysis.tableau),
        "conjugate-order": (analysis.conjugate_order, analysis.conjugate),
        "pair-order": (analysis.pair_order, analysis.pair),
    }
    return by_claim.get(claim, (None, None))


def claim_hint(outcome: Outcome, claim: str) -> Reason:
    """Returns what would make a failed claim on an order true; empty if unknown."""
    analysis, blame = outcome.analysis, outcome.blame
    if analysis is None:
        return NO_REASON
    names = [colour.name for colour in analysis.tableau.colours]
    if blame is not None and claim in blame.restores:
        first = repair_text(blame.repairs[0], names)
        return Reason(f"it fails with {blame.of}, and would hold with {{}}", first)
    if claim in {"consistent", "nonautonomous-order"} and analysis.wrong_rows:
        return sum_text(analysis.wrong_rows[0], names)
    if claim not in {"order", "conjugate-order", "pair-order", "embedded-order"}:
        return NO_REASON
    remark = outcome.remark
    if remark is not None and (remark.of == "embedded-order") <= (claim == "embedded-order"):
        if not remark.repairs:
            order = f"{remark.of.replace('-', ' ')} is {remark.order}"
            return Reason(f"with the line {{}} the {order}", remark.line)
        return Reason("an entry looks misprinted: {}", repair_text(remark.repairs[0], names))
    if blame is not None and blame.of == claim and blame.repairs:
        first = repair_text(blame.repairs[0], names)
        return Reason(f"{_restored(blame)} would hold with {{}}", first)
    wrong = [x for x in analysis.wrong_weights if x.is_embedded is (claim == "embedded-order")]
    return sum_text(wrong[0], names) if wrong else NO_REASON


def repair_text(repair: Repair, names: Sequence[str]) -> Reason:
    colours = [repair.l] if repair.i is None or repair.m is None else [repair.l, repair.m]
    letter = "b" if len(colours) == 1 else "a"
    indices = (repair.j,) if repair.i is None or repair.m is None else (repair.i, repair.j)
    place = Place(letter, names_of(colours, names), indices)
    kind = "embedded " if repair.is_embedded and letter == "b" else ""
    new, old = value_text(repair.new), value_text(repair.old)
    return Reason(f"{kind}{{}} = {{}} instead of {{}}", place, new, old)


def sum_text(wrong: WrongSum, names: Sequence[str]) -> Reason:
    if wrong.m is None or wrong.i is None:
        kind = "embedded weights" if wrong.is_embedded else "weights"
        whose = [Place("b", names_of([wrong.l], names))] if len(names) > 1 else []
        place = Reason(" ".join([f"the {kind}", *("{}" for _ in whose)]), *whose)
        return Reason("{} have the sum {}", place, total_text(wrong.total))
    place = Reason(f"row {wrong.i + 1}")
    if len(names) > 1:
        place = Reason("{} of {}", place, Place("A", names_of([wrong.l, wrong.m], names)))
    total, node, off = _short(wrong.total), _short(wrong.wanted), to_decimal(wrong.off, 2)
    if str(total) == str(node):
        return Reason("{} has the sum {}, off its node by {}", place, total, off)
    text = Reason("{} has the sum {}, its node is {}", place, total, node)
    return Reason("{}, off by {}", text, off) if abs(to_ball(wrong.off)) < NEAR else text


def total_text(total: Number) -> Formula | str:
    """Returns the sum of weights, as the distance from 1 if it is close to 1."""
    if total == 1 or abs(to_ball(total - 1)) >= NEAR:
        return _short(total)
    off = to_decimal(total - 1, 2)
    return f"1 - {off[1:]}" if off.startswith("-") else f"1 + {off}"


def _short(number: Number) -> Formula | str:
    text = to_text(number)
    return Formula(text) if len(text) <= _SHORT else to_decimal(number, 12)


def names_of(colours: Sequence[int], names: Sequence[str]) -> tuple[str, ...]:
    return tuple(names[l] for l in colours) if len(names) > 1 else ()


def value_text(number: Number, digits: int = 17) -> Formula | str:
    """Returns an entry: exactly if short, decimals in full, others to ``digits`` digits."""
    text = shortest(number)
    if isinstance(number, fmpq) and "." in text and len(text) <= _LONG:
        return text
    return Formula(text) if len(text) <= _SHORT else to_decimal(number, digits)


def blame_text(blame: Blame, own: Sequence[str]) -> Reason:
    """Returns the conditions that fail, the block in all of them, and repairs."""
    is_known = blame.order == 1 or blame.restored is not None or blame.within is not None
    texts = [] if is_known else _conditions(blame, own)
    if blame.repairs:
        also = f", and so would {', '.join(blame.restores)}" if blame.restores else ""
        mended = _repairs(blame.repairs, own)
        texts.append(Reason(f"{_restored(blame)} would hold with {{}}{also}", mended))
    return joined("; ", texts) if texts else NO_REASON


def _restored(blame: Blame) -> str:
    order = "the claimed order"
    if blame.restored is not None:
        order = f"{blame.of.replace('-', ' ')} {blame.restored}"
    return order if blame.within is None else f"within {decimal(blame.within)} {order}"


def _conditions(blame: Blame, own: Sequence[str]) -> list[Reason]:
    names = blame.names or own
    letter = "Â" if blame.of == "conjugate-order" else "A"
    verb = "fails" if blame.failing == 1 else "fail"
    fail = f"{blame.failing} of the {blame.total} conditions of order {blame.order} {verb}"
    if blame.total == 1:
        fail = f"the one condition of order {blame.order} fails"
    elif blame.failing == blame.total:
        fail = f"all {blame.total} conditions of order {blame.order} fail"
    if blame.of != "order":
        fail = f"{blame.of}: {fail}"
    is_one = blame.failing == 1
    if blame.only_coupling and len(names) > 1:
        fail += ", a coupling condition" if is_one else ", all of them coupling conditions"
    texts = [Reason(fail)]
    every = "it involves" if is_one else "all of them involve"
    if blame.culprit is not None and len(names) > 1:
        culprit = Place(letter, names_of(blame.culprit, names))
        texts.append(Reason(f"{every} {{}}: look there first", culprit))
    elif len(blame.in_every) > 1:
        texts.append(_involved(letter, blame.in_every, names, every))
    if blame.in_none:
        none = "it does not involve" if is_one else "none of them involves"
        texts.append(_involved(letter, blame.in_none, names, none))
    return texts


def _involved(
    letter: str, blocks: Sequence[tuple[int, int]], names: Sequence[str], verb: str
) -> Reason:
    places = joined(", ", [Place(letter, names_of(block, names)) for block in blocks])
    return Reason(f"{verb} {{}}", places)


def _repairs(repairs: Sequence[Repair], names: Sequence[str]) -> Reason:
    return joined(", or ", [repair_text(x, names) for x in repairs[:_MOST]])


def rounding_text(found: RoundingHint, names: Sequence[str], tolerance: fmpq | None) -> Reason:
    """Returns the digits of the numbers, the order with these, and the entry that is off."""
    order = f"{found.of.replace('-', ' ')} {found.order}"
    if found.repairs:
        mended = _repairs(found.repairs, names)
        return Reason(
            f"an entry looks misprinted: within the digits of the others {order} holds with {{}}",
            mended,
        )
    assert found.exponent is not None
    places = counted(-found.exponent, "decimal place")
    looks = f"the coefficients look rounded to {places}"
    if tolerance is not None:
        looks = f"the tolerance {decimal(tolerance)} is too tight: {looks}"
    return Reason(f"{looks}; with the line {{}} {order} holds", found.line)


def misprint_text(numbers: Sequence[SuspectedNumber]) -> Reason:
    values = [(value_text(x.new), value_text(x.old)) for x in numbers[:_MOST]]
    mended = joined(", or ", [Reason("{} instead of {}", *pair) for pair in values])
    return Reason(f"order {numbers[0].order} would hold with {{}}", mended)


class Aside(Remark):
    """A remark that is about no claim and fails nothing; outputs word its ``reason``."""

    reason: Reason = NO_REASON


class Finding(Frozen):
    """A remark for machine formats; ``fingerprint`` does not depend on the place in the file."""

    remark: Remark
    rule: str
    file: str
    fingerprint: str


def _unmet(outcome: Outcome, claim: Claim) -> Remark:
    message = f"{claim.claim}: expected {claim.expected}, found {claim.found}"
    if witness := claim_witness(outcome, claim.claim):
        message = f"{message}; {witness}"
    hint, place = str(claim_hint(outcome, claim.claim)), (claim.line, claim.column)
    if claim.holds is None:
        return Remark(message, hint, *place, "undecided", "warning")
    return Remark(message, hint, *place, "claim")


def cure_of_lacks(outcome: Outcome) -> str:
    keys = (f" --key {key}" for key in outcome.keys_lacking)
    return cure_of("check", "no-claim") + "".join(keys)


def _remarks(outcome: Outcome) -> Iterator[tuple[str, Remark, str]]:
    seen: Counter[str] = Counter()
    for fault in outcome.faults:
        yield "unreadable", fault, f"{fault.message}\0{seen[fault.message]}"
        seen[fault.message] += 1
    for claim in (*outcome.failed_claims, *outcome.undecided_claims):
        remark = _unmet(outcome, claim)
        yield remark.code, remark, claim.claim
    for message in outcome.lacks:
        is_any = outcome.makes_no_claim and outcome.needs_claims
        lack = Remark(message, cure_of_lacks(outcome), code="no-claim")
        yield lack.code, lack, "" if is_any else message
    for remark in asides(outcome):
        yield remark.code, remark, remark.message


def asides(outcome: Outcome) -> list[Aside]:
    return [*warnings(outcome), *hints(outcome)]


def warnings(outcome: Outcome) -> Iterator[Aside]:
    for text in filter(is_lost, outcome.about_rules):
        yield _aside("loses-pair-order", "warning", Reason("{}", text))


def hints(outcome: Outcome) -> Iterator[Aside]:
    if outcome.misprints:
        yield _aside("misprint", "hint", misprint_text(outcome.misprints))
    analysis, rounding, blame = outcome.analysis, outcome.remark, outcome.blame
    if analysis is None:
        if rounding is not None:
            yield _aside("looks-rounded", "hint", rounding_text(rounding, (), None))
        return
    names = [colour.name for colour in analysis.tableau.colours]
    for wrong in analysis.wrong_weights:
        row = below(composed(outcome.text), "embedded" if wrong.is_embedded else "b")
        yield _aside("weights", "hint", sum_text(wrong, names), row)
    if rounding is not None and rounding.repairs:
        entry = entry_node(outcome.text, rounding.repairs[0])
        yield _aside("misprint", "hint", rounding_text(rounding, names, analysis.tolerance), entry)
        if analysis.tolerance is not None:
            return  # the failing conditions show the same entry
    elif rounding is not None:
        text = rounding_text(rounding, names, analysis.tolerance)
        yield _aside("looks-rounded", "hint", text, below(composed(outcome.text), "tolerance"))
    if blame is None or not (text := blame_text(blame, names)):
        return
    if blame.repairs:
        hint = _aside("misprint", "hint", text, entry_node(outcome.text, blame.repairs[0]))
    else:
        hint = _aside("failing-conditions", "hint", text)
    claims = [x for x in outcome.failed_claims if x.claim == blame.of and not hint.line]
    yield replace(hint, line=claims[0].line, column=claims[0].column) if claims else hint


def _aside(code: str, level: Severity, reason: Reason, place: Node | None = None) -> Aside:
    line, column = (0, 0) if place is None else position(place.start_mark)
    cure = cure_of("check", code)
    return Aside(str(reason), cure, line, column, code, level, reason=reason)


def entry_node(text: str, repair: Repair) -> Node | None:
    """Returns an entry in a file with A and b; None in other files."""
    if repair.l or repair.m:
        return None
    if repair.i is None or repair.m is None:
        return below(composed(text), "embedded" if repair.is_embedded else "b", repair.j)
    return below(composed(text), "A", repair.i, repair.j)


def remarks(outcome: Outcome) -> list[Remark]:
    return [remark for _, remark, _ in _remarks(outcome)]


def findings(outcome: Outcome) -> Iterator[Finding]:
    file = PurePath(outcome.file).as_posix()
    for rule, remark, key in _remarks(outcome):
        known = remark.message, remark.help, remark.line or 1, remark.column or 1
        placed = Remark(*known, remark.code, remark.level, meant=remark.meant)
        yield Finding(placed, rule, file, fingerprint(f"{file}\0{rule}\0{key}"))


def fingerprint(key: str) -> str:
    from hashlib import sha256

    return sha256(key.encode("utf-8", "surrogatepass")).hexdigest()[:32]
