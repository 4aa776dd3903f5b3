"""The entry or printed number that seems wrong, as another value restores or raises an order."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING, Protocol

from flint import fmpq

from garkcli.check.analysis import Analysis, analyse
from garkcli.check.claims import Claim, verify
from garkcli.frozen import replace
from garkcli.methodfile.description import CONSTRUCTIONS
from garkcli.methodfile.expectations import highest_order
from garkcli.order.certificate import Order, Witness
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import AnyTableau, derived, meant, tolerance_of, within_digits
from garkcli.order.repair import GAIN, HIGHEST_LOW
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.check.remark import RoundingHint
    from garkcli.methodfile.build import MethodFile
    from garkcli.methodfile.printed import Printed
    from garkcli.order.blame import Blame
    from garkcli.order.suspects import SuspectedNumber

WITHOUT_NODES = {"order", "conjugate-order", "pair-order", "symplectic"}
"""Claims that do not depend on nodes, which without ``c`` follow the entries."""
UNASKED = {"order", "embedded-order"}
"""The orders for which a cause is sought without a claim."""
FINE = fmpq(1, 10**30)
SHORT = 10**6


def culprit(
    method: MethodFile,
    analysis: Analysis,
    claims: tuple[Claim, ...],
    limit: int,
    remark: RoundingHint | None = None,
) -> Blame | None:
    blame = _of_claims(method, analysis, remark)
    if blame is None or not blame.repairs:
        claimed = {claim.key for claim in method.claims} - ({blame.of} if blame else set())
        blame = _unclaimed(method, analysis, remark, claimed) or blame
    return _with_consequences(method, claims, blame, limit)


def _of_claims(method: MethodFile, analysis: Analysis, remark: RoundingHint | None) -> Blame | None:
    """Returns the cause of the first order below its claim; None if rounding explains it."""
    for key, tableau, actual in _orders(method, analysis):
        claimed = highest_order(method.claims, [key])
        if actual.order >= claimed:
            continue
        if actual.is_lower_bound or _is_explained(remark, claimed):
            return None
        from garkcli.order.blame import MissedOrder, blame_of  # paid for by failures alone

        first = None
        for judged, order in _ways(method, tableau, actual, key, remark):
            if order.witness is None or order.order >= claimed:
                continue
            missed = MissedOrder(order.order + 1, claimed, key, key == "embedded-order")
            answer = _assuming(remark, judged, blame_of(judged, missed))
            first = first or answer
            if answer is not None and answer.repairs:
                first = answer
                break
        if first is not None and key == "embedded-order":
            # the method itself has the order that the file claims: no block alone is to blame
            first = replace(first, culprit=None, in_every=(), in_none=())
        return first
    return None


def _is_explained(remark: RoundingHint | None, claimed: int) -> bool:
    return remark is not None and bool(remark.line) and remark.order >= claimed


def _orders(method: MethodFile, analysis: Analysis) -> Iterator[tuple[str, Tableau, AnyOrder]]:
    for key, order in (
        ("order", analysis.order),
        ("conjugate-order", analysis.conjugate_order),
        ("pair-order", analysis.pair_order),
    ):
        if order is not None:
            yield key, method.tableau, order
    if analysis.embedded is not None:
        yield "embedded-order", analysis.embedded.tableau, analysis.embedded.order


def _unclaimed(
    method: MethodFile, analysis: Analysis, remark: RoundingHint | None, claimed: Collection[str]
) -> Blame | None:
    is_made = method.form in CONSTRUCTIONS  # no file prints its embedded weights
    for key, tableau, actual in _orders(method, analysis):
        if key in claimed or key not in UNASKED or (is_made and key == "embedded-order"):
            continue
        from garkcli.order.blame import MissedOrder, slip_of  # CI makes claims

        missed = MissedOrder(0, 0, key, is_embedded=key == "embedded-order")
        for judged, order in _ways(method, tableau, actual, key, remark):
            if slip := slip_of(judged, missed, order):
                return _assuming(remark, judged, slip)
    return None


def _ways(
    method: MethodFile, tableau: Tableau, order: AnyOrder, key: str, remark: RoundingHint | None
) -> Iterator[tuple[AnyTableau, AnyOrder]]:
    """Yields the method and its order; for decimals declared exact also as if they were rounded."""
    if not isinstance(order, Order):
        yield meant(method.tableau, method.tolerance, method.further), order
        return
    yield tableau, order
    rounded = _rounded(method, remark)
    if rounded is not None:
        yield rounded, order_of(derived(rounded, key))


def _rounded(method: MethodFile, remark: RoundingHint | None) -> AnyTableau | None:
    if remark is None:
        from garkcli.methodfile.printed import as_typed

        return within_digits(method.tableau, as_typed)
    if remark.exponent is None:
        return None
    return meant(method.tableau, fmpq(10) ** remark.exponent, method.further)


def _assuming(remark: RoundingHint | None, judged: AnyTableau, blame: Blame | None) -> Blame | None:
    """Returns the blame with the tolerance that it assumes, if a remark proposes that."""
    if blame is None or remark is None or not remark.line:
        return blame
    return replace(blame, within=tolerance_of(judged))


def _with_consequences(
    method: MethodFile, claims: tuple[Claim, ...], blame: Blame | None, limit: int
) -> Blame | None:
    if blame is None or not blame.repairs or blame.repairs[0].is_embedded:
        return blame
    others = set()
    for claim in claims:
        if not claim.holds and claim.claim in WITHOUT_NODES and claim.claim != blame.of:
            others.add(claim.claim)
    if not others:
        return blame
    analysis = analyse(blame.repairs[0].carried_out(method.tableau), limit, method.tolerance)
    texts = tuple(claim for claim in method.claims if claim.key in others)
    restored = [claim.claim for claim in verify(texts, analysis) if claim.holds]
    return replace(blame, restores=tuple(restored))


class FoundOrder(Protocol):
    """The order of a method, and a tree whose condition fails if one is known."""

    @property
    def order(self) -> int: ...
    @property
    def witness(self) -> Witness | None: ...


def misprints(
    method: MethodFile,
    order: FoundOrder,
    declared: int | None = None,
    remark: RoundingHint | None = None,
) -> tuple[SuspectedNumber, ...]:
    """Returns numbers with values for the claimed order, or for two more; the highest alone."""
    claimed = declared or highest_order(method.claims, ["order"])
    goal = claimed or order.order + GAIN
    if _is_explained(remark, goal):
        return ()
    is_searched = order.witness is not None and order.order < goal
    if not is_searched or not (claimed or order.order <= HIGHEST_LOW):
        return ()
    # imported here: few methods miss an order
    from garkcli.order.admissible import count_conditions
    from garkcli.order.blame import FEW_CONDITIONS_UNASKED, MAX_CONDITIONS
    from garkcli.order.rounded import RoundedTableau
    from garkcli.order.suspects import suspected_numbers

    most = MAX_CONDITIONS if claimed else FEW_CONDITIONS_UNASKED
    if count_conditions(method.tableau, goal) > most:
        return ()
    rounded = _within_digits(method)
    if not isinstance(rounded, RoundedTableau):
        return ()
    found = [x for x in suspected_numbers(rounded, goal, goal + 1) if x.order >= goal]
    best = max((x.order for x in found), default=0)
    return tuple(_shortened(x) for x in found if x.order == best)


def _within_digits(method: MethodFile) -> AnyTableau | None:
    if method.tolerance:
        return meant(method.tableau, method.tolerance, method.further)
    return within_digits(method.tableau, _digits)


def _digits(printed: Printed) -> Sequence[fmpq]:
    from garkcli.methodfile.printed import left_open

    return [max(radius, FINE) for radius in left_open(printed)]


def _shortened(number: SuspectedNumber) -> SuspectedNumber:
    """Returns the number with a short fraction for its new value, if one is near enough."""
    new = Fraction(int(number.new.p), int(number.new.q))
    short = new.limit_denominator(SHORT)
    near = abs(short - new) <= 10 * Fraction(int(FINE.p), int(FINE.q))
    value = fmpq(short.numerator, short.denominator) if near else number.new
    return replace(number, new=value)
