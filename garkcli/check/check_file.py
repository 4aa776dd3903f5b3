"""Load, analyse, verify: from a path to an outcome, with nothing printed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.check.analysis import Analysis
from garkcli.check.claims import verify
from garkcli.check.deciding import analyse
from garkcli.check.outcome import Claim, Outcome
from garkcli.errors import HasFreeParameters, MethodFileError
from garkcli.frozen import replace
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.expectations import highest_order
from garkcli.methodfile.load import NO_SETTINGS, load
from garkcli.order.certificate import DEFAULT_LIMIT, Order
from garkcli.order.deciding import AnyOrder
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from collections.abc import Mapping

    from flint import fmpq

    from garkcli.exact.field import Number
    from garkcli.order.blame import Blame

WITHOUT_NODES = {"order", "conjugate-order", "pair-order", "symplectic"}
"""The claims that do not depend on nodes: without ``c`` in the file these follow the entries."""
NEAR = 10
"""An entry is a repair when it brings residuals within so many tolerances: the entry that is
solved for carries the rounding of all others.
"""


def check_file(
    path: str,
    limit: int = DEFAULT_LIMIT,
    want_constants: bool = False,
    settings: Mapping[str, str] = NO_SETTINGS,
) -> Outcome:
    """Check one method file; a file that cannot be read gives an outcome with its faults.

    Args:
        path: a file, or ``-`` for standard input.
        limit: where the search for orders stops, unless a claim of the file reaches further.
        want_constants: compute the error constants too.
        settings: values of its parameters, by name, in place of those in the file.
    """
    try:
        method = load(path, settings)
    except HasFreeParameters as error:
        from garkcli.check.every_value import check_every

        return check_every(error, limit, want_constants, settings)
    except MethodFileError as error:
        return Outcome(error.source, error.source, faults=error.faults, text=error.text)
    return check_method(method, limit, want_constants)


def check_method(
    method: MethodFile, limit: int = DEFAULT_LIMIT, want_constants: bool = False
) -> Outcome:
    """Check a method that was read.

    Args:
        method: with its claims.
        limit: where the search for orders stops, unless a claim reaches further.
        want_constants: compute the error constants too.
    """

    def units() -> Mapping[Number, fmpq]:
        # few methods are asked
        from garkcli.methodfile.printed import printed_units

        return printed_units(method.printed)

    reach = max(limit, highest_order(method.claims) + 1)
    analysis = analyse(method.tableau, reach, method.tolerance, units, method.further)
    first_failing = None if analysis.order.is_lower_bound else analysis.order.order + 1
    constants = None
    if want_constants and first_failing is not None:
        from garkcli.order.constants import error_constants

        constants = error_constants(method.tableau, first_failing)
    claims = verify(method.claims, analysis)
    return Outcome(
        file=method.source,
        name=method.name,
        structure=method.structure,
        analysis=analysis,
        claims=claims,
        text=method.text,
        blame=_with_consequences(method, claims, _blame(method, analysis), reach),
        constants=constants,
        left_behind=method.left_behind,
        rules=method.rules,
    )


def _blame(method: MethodFile, analysis: Analysis) -> Blame | None:
    """What is to blame for the first order that is smaller than the file claims.

    Nobody is where the next order is not known to fail, or where rounding explains that it does.
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
        return _blame_for(method.tableau, found, claimed, key, which)
    return _blame_of_embedded(method, analysis)


def _blame_for(
    tableau: Tableau,
    found: AnyOrder,
    claimed: int,
    key: str,
    which: str = "",
    is_embedded: bool = False,
) -> Blame | None:
    """What is to blame for an order that is smaller than claimed."""
    from garkcli.order.blame import (
        Missed,
        blame_of,  # paid for by failures alone
    )

    missed = Missed(found.order + 1, claimed, key, which, is_embedded=is_embedded)
    if not isinstance(found, Order):
        missed = replace(missed, tolerance=found.tolerance, near=NEAR * found.tolerance)
    return blame_of(tableau, missed)


def _blame_of_embedded(method: MethodFile, analysis: Analysis) -> Blame | None:
    """What is to blame for embedded weights of a smaller order: one of them, as the method itself
    has the order that the file claims.
    """
    key = "embedded-order"
    claimed = highest_order(method.claims, [key])
    facts = analysis.embedded
    if facts is None or facts.order.order >= claimed:
        return None
    if facts.order.is_lower_bound:
        return None
    found = _blame_for(facts.tableau, facts.order, claimed, key, is_embedded=True)
    return found and replace(found, culprit=None, in_every=(), in_none=())


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
