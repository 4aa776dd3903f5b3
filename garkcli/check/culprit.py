"""What is to blame for an order that is smaller than the file claims, or, where it claims none,
that one wrong entry seems to cost.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.check.claims import verify
from garkcli.check.deciding import analyse
from garkcli.exact.field import ZERO
from garkcli.frozen import replace
from garkcli.methodfile.expectations import highest_order
from garkcli.order.certificate import Order
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import derived, meant
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.check.analysis import Analysis
    from garkcli.check.outcome import Claim
    from garkcli.methodfile.build import MethodFile
    from garkcli.order.blame import Blame, Missed

WITHOUT_NODES = {"order", "conjugate-order", "pair-order", "symplectic"}
"""The claims that do not depend on nodes: without ``c`` in the file these follow the entries."""
NEAR = 10
"""An entry is a repair when it brings residuals within so many tolerances: the entry that is
solved for carries the rounding of all others.
"""


def culprit(
    method: MethodFile, analysis: Analysis, claims: tuple[Claim, ...], limit: int
) -> Blame | None:
    """What is to blame for the first order that is smaller than the file claims, or for that of a
    method of which it claims none.

    Args:
        method: as it was read.
        analysis: the truth about it.
        claims: what became of its claims.
        limit: where the search for orders stops.
    """
    blame = _of_claims(method, analysis)
    return _with_consequences(method, claims, blame or _unclaimed(method, analysis), limit)


def _of_claims(method: MethodFile, analysis: Analysis) -> Blame | None:
    """Nobody is to blame where the next order is not known to fail, or where rounding explains that
    it does.
    """
    parts = (
        ("order", analysis.order, ""),
        ("conjugate-order", analysis.conjugate_order, "conjugate"),
        ("pair-order", analysis.pair_order, "pair"),
    )
    for key, found, which in parts:
        claimed = highest_order(method.claims, [key])
        if found is None or found.order >= claimed:
            continue
        is_explained = method.tolerance is not None and analysis.suggestion is not None
        if found.is_lower_bound or is_explained:
            return None
        return _missing(method, analysis, method.tableau, found, claimed, key, which)
    key, facts = "embedded-order", analysis.embedded
    claimed = highest_order(method.claims, [key])
    if facts is None or facts.order.order >= claimed or facts.order.is_lower_bound:
        return None
    # the method itself has the order that the file claims: one of the weights is wrong
    blame = _missing(method, analysis, facts.tableau, facts.order, claimed, key)
    return blame and replace(blame, culprit=None, in_every=(), in_none=())


def _missing(
    method: MethodFile,
    analysis: Analysis,
    tableau: Tableau,
    found: AnyOrder,
    claimed: int,
    key: str,
    which: str = "",
) -> Blame | None:
    """What is to blame for an order that is smaller than claimed."""
    from garkcli.order.blame import Missed, blame_of  # paid for by failures alone

    missed = Missed(found.order + 1, claimed, key, which, is_embedded=key == "embedded-order")

    def blame(missed: Missed, judged: AnyOrder) -> Blame | None:
        return blame_of(tableau, replace(missed, order=judged.order + 1))

    return _by_any_way(method, analysis, tableau, found, missed, blame)


def _unclaimed(method: MethodFile, analysis: Analysis) -> Blame | None:
    """The entry that seems wrong in a method, or in its embedded weights, of which the file claims
    no order.
    """
    claimed = {claim.key for claim in method.claims}
    facts = analysis.embedded
    asked = [("order", method.tableau, analysis.order)]
    if facts is not None:
        asked.append(("embedded-order", facts.tableau, facts.order))
    for key, tableau, found in asked:
        if key in claimed:
            continue
        from garkcli.order.blame import Missed, slip_of  # CI makes claims

        missed = Missed(0, 0, key, is_embedded=key == "embedded-order")

        def blame(missed: Missed, judged: AnyOrder, tableau: Tableau = tableau) -> Blame | None:
            return slip_of(tableau, missed, judged)

        if slip := _by_any_way(method, analysis, tableau, found, missed, blame):
            return slip
    return None


def _by_any_way(
    method: MethodFile,
    analysis: Analysis,
    tableau: Tableau,
    found: AnyOrder,
    missed: Missed,
    blame: Callable[[Missed, AnyOrder], Blame | None],
) -> Blame | None:
    """The first answer that has repairs; the first answer where none has.

    Conditions are judged exactly or within the tolerance of the file; where decimals of many digits
    are meant exactly by its word, then as if they were rounded.
    """
    first = None
    for judged, tolerance in _judgements(method, analysis, tableau, found, missed):
        seen = replace(missed, tolerance=tolerance, near=NEAR * tolerance)
        answer = blame(seen, judged)
        if answer is not None and answer.repairs:
            return answer
        first = first or answer
    return first


def _judgements(
    method: MethodFile, analysis: Analysis, tableau: Tableau, found: AnyOrder, missed: Missed
) -> Iterator[tuple[AnyOrder, fmpq]]:
    """The order of a tableau with the rounding within which it is so."""
    if not isinstance(found, Order):
        yield found, found.tolerance
        return
    yield found, ZERO
    if analysis.suggestion is not None or analysis.misprint is not None:
        return  # they say how the coefficients are rounded
    from garkcli.methodfile.printed import approximant_units
    from garkcli.order.blame import FEW_ROUNDED, count_entries
    from garkcli.order.suggestion import SLACK

    tolerance = SLACK * max(approximant_units(method.printed).values(), default=ZERO)
    if not tolerance or count_entries(tableau, missed) > FEW_ROUNDED:
        return
    judged = order_of(derived(meant(tableau, tolerance), missed.which))
    is_missed = not missed.claimed or judged.order < missed.claimed
    if judged.witness is not None and is_missed:
        yield judged, tolerance


def _with_consequences(
    method: MethodFile, claims: tuple[Claim, ...], blame: Blame | None, limit: int
) -> Blame | None:
    """The same, with the other claims that fail for the reason that its first repair removes."""
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
