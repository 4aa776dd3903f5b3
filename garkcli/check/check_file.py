"""Load, analyse, verify: from a path to an outcome, with nothing printed."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.check.analysis import analyse
from garkcli.check.claims import verify
from garkcli.check.outcome import Outcome
from garkcli.errors import MethodFileError
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.expectations import highest_order
from garkcli.methodfile.load import load
from garkcli.order.certificate import DEFAULT_LIMIT

if TYPE_CHECKING:
    from garkcli.order.blame import Blame


def check_file(path: str, limit: int = DEFAULT_LIMIT, want_constants: bool = False) -> Outcome:
    """Check one method file; a file that cannot be read gives an outcome with its faults.

    Args:
        path: a file, or ``-`` for standard input.
        limit: where the search for orders stops, unless a claim of the file reaches further.
        want_constants: compute the error constants too.
    """
    try:
        method = load(path)
    except MethodFileError as error:
        return Outcome(error.source, error.source, faults=error.faults, text=error.text)
    analysis = analyse(
        method.tableau, max(limit, highest_order(method.claims) + 1), method.tolerance
    )
    first_failing = None if analysis.order.is_lower_bound else analysis.order.order + 1
    constants = None
    if want_constants and first_failing is not None:
        from garkcli.order.constants import error_constants

        constants = error_constants(method.tableau, first_failing)
    return Outcome(
        file=method.source,
        name=method.name,
        structure=method.structure,
        analysis=analysis,
        claims=verify(method.claims, analysis),
        text=method.text,
        blame=_blame(method, first_failing),
        constants=constants,
    )


def _blame(method: MethodFile, first_failing: int | None) -> Blame | None:
    """What is to blame for an order smaller than the file claims."""
    claimed = highest_order(tuple(claim for claim in method.claims if claim.key == "order"))
    if first_failing is None or first_failing > claimed or method.tolerance is not None:
        return None
    from garkcli.order.blame import find_blame  # paid for by failures alone

    return find_blame(method.tableau, first_failing, claimed)
