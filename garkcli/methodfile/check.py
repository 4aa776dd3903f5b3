"""Load, analyse, verify: from a path to an outcome, with nothing printed."""

from __future__ import annotations

from garkcli.errors import MethodFileError
from garkcli.methodfile.expectations import highest_order, verify
from garkcli.methodfile.load import load
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.check import analyse
from garkcli.order.outcome import Outcome


def check_file(path: str, limit: int = DEFAULT_LIMIT) -> Outcome:
    """Check one method file; a file that cannot be read gives an outcome with its faults.

    Args:
        path: a file, or ``-`` for standard input.
        limit: where the search for orders stops, unless a claim of the file reaches further.
    """
    try:
        method = load(path)
    except MethodFileError as error:
        return Outcome(error.source, error.source, faults=error.faults, text=error.text)
    analysis = analyse(method.tableau, max(limit, highest_order(method.claims) + 1))
    return Outcome(
        file=method.source,
        name=method.name,
        structure=method.structure,
        analysis=analysis,
        claims=verify(method.claims, analysis),
        text=method.text,
        tolerance=method.tolerance,
    )
