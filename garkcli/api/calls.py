"""What is true of a method as its file claims it, its stability, and what proves its orders."""

from __future__ import annotations

from collections.abc import Iterable

from garkcli.api.anymethod import AnyMethod, method_of, with_tolerance
from garkcli.api.methods import analyse
from garkcli.api.numbers import Number, Whole, whole
from garkcli.check import proof
from garkcli.check.proof import MethodProof
from garkcli.check.true_claims import true_claims, usual_keys
from garkcli.errors import MethodError
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.claims_writer import write_claims
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.stability.summary import (
    Stability,
    stability,
    stability_of_rounded,
)


def claims_of(method: AnyMethod, keys: Iterable[str] = ()) -> dict[str, str]:
    """What is true of a method, as its file would claim it: ``gark claims``.

    Args:
        method: whatever ``method_of`` takes.
        keys: the claims; by default those that ``gark claims`` writes.

    Returns:
        The value of each as YAML.

    >>> claims_of("rk4", ["order", "symplectic"])
    {'order': '4', 'symplectic': 'false'}
    """
    found = analyse(method_of(method))
    return true_claims(found, list(keys) or usual_keys(found))


def with_claims(method: AnyMethod, keys: Iterable[str] = ()) -> str:
    """The text of a method file that claims what is true of it: ``gark claims --write``, and what
    ``gark new`` writes.

    Args:
        method: from a file, a text or arrays, or a path or a name of the catalogue.
        keys: as in ``claims_of``.

    Raises:
        MethodError: it was not read from a text.

    >>> print(with_claims(([[0]], [1]), ["order", "symplectic"]), end="")
    A: [[0]]
    b: [1]
    expect:
      order: 1
      symplectic: false
    """
    found = method_of(method)
    if not isinstance(found, MethodFile):
        raise MethodError(
            f"{found!r} has no text",
            "give what load, loads or from_arrays return",
        )
    claims = claims_of(found, keys)
    return write_claims(found.source, found.text, claims)


def find_stability(
    method: AnyMethod, tolerance: Number | None = None
) -> Stability:
    """Everything that ``gark stability`` decides of a method.

    Args:
        method: whatever ``method_of`` takes.
        tolerance: the rounding of the coefficients; that of the method where it is not given, 0 for
            none.

    >>> found = find_stability("gauss-3")
    >>> found, found.linear[0].a_stable
    (<Stability A-stable, not L-stable>, True)
    """
    method, near = with_tolerance(method, tolerance)
    if near is None:
        return stability(method.tableau)
    return stability_of_rounded(method.tableau, near)


def prove_method(
    method: AnyMethod, limit: Whole = DEFAULT_LIMIT
) -> MethodProof:
    """The orders of a method, its conjugate and its pair, with spanning trees and witnesses.

    Args:
        method: whatever ``method_of`` takes; its coefficients are exact.
        limit: the order at which to stop.

    Raises:
        MethodError: the coefficients are rounded.

    >>> prove_method("rk4")
    <MethodProof order 4, conjugate 4, pair 4>
    """
    return proof.prove_method(method_of(method), whole(limit, "limit", 1))
