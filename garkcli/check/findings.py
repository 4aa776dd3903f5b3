"""The findings in checked files, as text and as values for machine formats."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import PurePath
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.check.claims import Claim
from garkcli.check.outcome import Outcome
from garkcli.check.pair_reasons import is_lost
from garkcli.errors import Remark
from garkcli.exact.display import shortest, to_ball, to_decimal, to_text
from garkcli.exact.field import Number
from garkcli.frozen import Frozen, replace
from garkcli.glossary.faults import cure_of
from garkcli.ntrees.notation import format_tree
from garkcli.order.certificate import Witness
from garkcli.reason import NO_REASON, Code, Formula, Place, Reason
from garkcli.tableau.forms import with_time

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.order.deciding import AnyOrder
    from garkcli.order.dense import DenseWitness
    from garkcli.order.predictor import PredictorOrders
    from garkcli.order.repair import Repair
    from garkcli.order.simplifying import Simplifying
    from garkcli.order.sums import WrongSum
    from garkcli.tableau.tableau import Tableau

BOUND = "min{r, 2η+2, ξ+1, η+ζ+1}"
"""The bound of ``Simplifying.bound``."""
SHARP_BOUND = "min{r, 2η+2, ξ+1, χ+2, η+ζ+3}"
"""The bound of ``Simplifying.sharp_bound``."""
NEAR = 1e-3
"""Row sums and nodes that differ by less are taken to be meant equal."""
_SHORT = 20
"""Length beyond which an exact entry is shown in decimals."""
_LONG = 60
"""Length of value and residual beyond which a witness is shown in decimals."""


def witness_text(witness: Witness, colours: bool | Sequence[str]) -> Reason:
    """Returns the condition that fails and its residual."""
    return _told(witness, Code(format_tree(witness.tree, colours)))


DENSE_ORDERS = {
    "dense-order": "order",
    "dense-position-order": "position_order",
    "dense-velocity-order": "velocity_order",
}
"""Claims on orders of dense output, and the attributes for them."""


PREDICTOR_ORDERS = ("predictor-order", "predictor-order-equal-steps")
"""Claims on a predictor."""


def dense_witness_text(dense: DenseWitness, colours: bool | Sequence[str]) -> Reason:
    """Returns the tree and the power of θ whose condition fails, and the residual."""
    tree = Code(format_tree(dense.witness.tree, colours))
    power = Formula(f"θ^{dense.power}", rf"\theta^{{{dense.power}}}")
    return _told(dense.witness, Reason("{}, at {}", tree, power))


def predictor_witness_text(orders: PredictorOrders, *, equal_steps: bool) -> Reason:
    """The condition that the first stage of least order misses; empty if nothing fails."""
    missed = orders.first_missed(equal_steps=equal_steps)
    if missed is None:
        return NO_REASON
    stage, where = missed
    tree = Code(format_tree(where.witness.tree, colours=False))
    ratio = "" if equal_steps else f", r = {where.ratio}"
    return _told(where.witness, Reason(f"{{}} of stage {stage + 1}{ratio}", tree))


def _told(witness: Witness, condition: Code | Reason) -> Reason:
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
    """Returns the numbers that the bounds of the order are made of."""
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
    """Returns the reason against a claim: the witness of an order, the numbers of a bound, the
    reason for a property.

    Empty if there is none.
    """
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
    """Returns the order that a claim is about, and its tableau."""
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
    """Returns what would make a failed claim on an order true, or the claim that fails with it;
    empty if unknown.
    """
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
        return Reason("the claimed order would hold with {}", first)
    wrong = [x for x in analysis.wrong_weights if x.is_embedded is (claim == "embedded-order")]
    return sum_text(wrong[0], names) if wrong else NO_REASON


def repair_text(repair: Repair, names: Sequence[str]) -> Reason:
    """Returns an entry with its new and its old value."""
    colours = [repair.l] if repair.i is None or repair.m is None else [repair.l, repair.m]
    letter = "b" if len(colours) == 1 else "a"
    indices = (repair.j,) if repair.i is None or repair.m is None else (repair.i, repair.j)
    place = Place(letter, names_of(colours, names), indices)
    kind = "embedded " if repair.is_embedded and letter == "b" else ""
    new, old = value_text(repair.new), value_text(repair.old)
    return Reason(f"{kind}{{}} = {{}} instead of {{}}", place, new, old)


def sum_text(wrong: WrongSum, names: Sequence[str]) -> Reason:
    """Returns a sum of weights or of a row with its actual and its expected value."""
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
    """Returns the names of colours, or none if there is only one colour."""
    return tuple(names[l] for l in colours) if len(names) > 1 else ()


def value_text(number: Number, digits: int = 17) -> Formula | str:
    """Returns an entry: exactly if short, decimals in full, others to ``digits`` digits."""
    text = shortest(number)
    if isinstance(number, fmpq) and "." in text and len(text) <= _LONG:
        return text
    return Formula(text) if len(text) <= _SHORT else to_decimal(number, digits)


class Finding(Frozen):
    """A remark on a file, as formats for machines have it.

    ``rule`` is the code of a kind of finding in ``glossary/data/findings.toml``. ``remark`` is on
    line 1 and column 1 if the place is unknown. ``file`` is the path as given, with forward
    slashes. ``fingerprint`` does not depend on the place in the file.
    """

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


def _warning(code: str, message: str) -> Remark:
    return Remark(message, cure_of("check", code), code=code, level="warning")


def cure_of_lacks(outcome: Outcome) -> str:
    """Returns the command that writes the missing claims; without keys it keeps to those made."""
    keys = (f" --key {key}" for key in outcome.keys_lacking)
    return cure_of("check", "no-claim") + "".join(keys)


def _remarks(outcome: Outcome) -> Iterator[tuple[str, Remark, str]]:
    """Yields rules and remarks, with keys that do not depend on the place in the file."""
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
    for remark in warnings(outcome):
        yield remark.code, remark, remark.message


def warnings(outcome: Outcome) -> Iterator[Remark]:
    """Yields the remarks on a method that are about no claim; they fail nothing."""
    for text in filter(is_lost, outcome.about_rules):
        yield _warning("loses-pair-order", text)


def remarks(outcome: Outcome) -> list[Remark]:
    """Returns the remarks on a file, kind by kind in the order of the file."""
    return [remark for _, remark, _ in _remarks(outcome)]


def findings(outcome: Outcome) -> Iterator[Finding]:
    """Yields the remarks on a file as formats for machines have them."""
    file = PurePath(outcome.file).as_posix()
    for rule, remark, key in _remarks(outcome):
        placed = replace(remark, line=remark.line or 1, column=remark.column or 1)
        yield Finding(placed, rule, file, fingerprint(f"{file}\0{rule}\0{key}"))


def fingerprint(key: str) -> str:
    from hashlib import sha256

    return sha256(key.encode("utf-8", "surrogatepass")).hexdigest()[:32]
