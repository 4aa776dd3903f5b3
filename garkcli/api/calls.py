"""The true claims of a method, its stability, and the proofs of its orders."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.api.anymethod import AnyMethod, method_of, with_tolerance
from garkcli.api.numbers import Number, Point, Whole, colour_of, points, rational, rationals, whole
from garkcli.check import analysis
from garkcli.check.analysis import MethodProof, analyse_any
from garkcli.check.true_claims import TrueClaims, true_claims, usual_keys
from garkcli.constructions.nystrom import is_nystrom, partitioned
from garkcli.constructions.same_stability import on_test_equation, with_same_function
from garkcli.deadline import SECONDS
from garkcli.errors import MethodError, UsageProblem, did_you_mean
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.carried import write_claims
from garkcli.methodfile.expectations import CLAIMS, highest_order
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.meant import AnyTableau, as_embedded, meant, printed
from garkcli.stability.summary import Stability, stability, stability_of_rounded
from garkcli.stability.two_frequencies import (
    SlowInterval,
    TwoFrequencies,
    slow_interval,
    springs,
    two_frequencies,
)
from garkcli.tableau.garkmethod import GarkMethod

if TYPE_CHECKING:
    from garkcli.check.existing import ExistenceProof


def claims_of(method: AnyMethod, keys: str | Iterable[str] = ()) -> dict[str, str]:
    """The true claims of a method, as its file would make them: ``gark claims``.

    Args:
        method: whatever ``method_of`` takes.
        keys: the claims, or one of them; by default those that ``gark claims`` writes.

    Returns:
        The values in YAML; claims that do not apply to the method or are undecided are left out.

    >>> claims_of("rk4", ["order", "symplectic"])
    {'order': '4', 'symplectic': 'false'}
    """
    wanted = [keys] if isinstance(keys, str) else list(keys)
    refuse_unknown(wanted)
    return dict(true_claims_of(method_of(method, is_any_kind=True), wanted).claims)


def refuse_unknown(keys: Iterable[str]) -> None:
    for key in keys:
        if key not in CLAIMS:
            raise UsageProblem(f"no claim {key!r}", did_you_mean(key, CLAIMS), code="unknown-word")


def true_claims_of(method: GarkMethod, keys: Sequence[str]) -> TrueClaims:
    """Returns the true ones among some claims, or among the usual ones."""
    claims = method.claims if isinstance(method, MethodFile) else ()
    found = analyse_any(method, max(DEFAULT_LIMIT, highest_order(claims) + 1))
    wanted = keys or usual_keys(found)
    true = true_claims(found, wanted)
    source = method.source if isinstance(method, MethodFile) else method.name
    return TrueClaims(source, true, tuple(key for key in wanted if key not in true), found)


def with_claims(method: AnyMethod, keys: str | Iterable[str] = ()) -> str:
    """The text of a method file with its true claims, as ``gark claims --write`` writes it.

    Args:
        method: from a file, a text or arrays, or a path or a name of the catalogue.
        keys: as in ``claims_of``.

    Raises:
        MethodError: the method was not read from a text.

    >>> print(with_claims(([[0]], [1]), ["order", "symplectic"]), end="")
    A: [[0]]
    b: [1]
    expect:
      order: 1
      symplectic: false
    """
    found = method_of(method, is_any_kind=True)
    if not isinstance(found, MethodFile):
        message = f"{found!r} has no text"
        raise MethodError(message, "give what load, loads or from_arrays return", code="other-file")
    return write_claims(found.source, found.text, claims_of(found, keys))


def find_stability(
    method: AnyMethod,
    tolerance: Number | None = None,
    ratios: Sequence[Number] = (),
    seconds: float | None = SECONDS,
    at: Sequence[Point] = (),
) -> Stability:
    """The stability of a method: ``gark stability``.

    Args:
        method: whatever ``method_of`` takes.
        tolerance: the rounding of the coefficients; by default that of the method, 0 for none.
        ratios: the ratios r_2/r_1 of further additive SSP radii of a method of two colours with
            exact coefficients.
        seconds: of processor time, after which the rest stays undecided; None for no limit.
        at: points z = x + iy, such as ``"0.01+2i"``, at which R(z) and |R(z)| are computed.

    Raises:
        MethodError: ratios do not apply or are not positive, or there is no R(z) for a point.
        NotDecided: the time is not enough for R.

    >>> find_stability("gauss-3")
    <Stability A-stable, not L-stable>
    >>> find_stability("rk4", at=["1/2+i"]).linear[0].points[0].value
    (337/384, 67/48)
    """
    places = points(at, "at")
    method, near = with_tolerance(method, tolerance, is_any_kind=True)
    further = rationals(ratios, "ratios")
    if further and (near is not None or method.tableau.size != 2):
        message = "ratios are for exact methods of two colours"
        raise MethodError(message, "leave them out", code="pasted-tableau")
    if any(ratio <= 0 for ratio in further):
        raise MethodError("ratios are positive", "the axes are always there", code="option-value")
    linear = on_test_equation(method.tableau, near)
    tableau = linear or method.tableau
    if is_nystrom(tableau):
        tableau = partitioned(tableau, near)
    embedded: AnyTableau | None = None
    if method.embedded is not None and not is_nystrom(method.tableau):
        whole = meant(method.tableau, near, method.further)
        embedded = as_embedded(whole, method.embedded)
        embedded = with_same_function(embedded) or embedded
    if near is None:
        found = stability(
            tableau, further, seconds, None if embedded is None else printed(embedded)
        )
    else:
        found = stability_of_rounded(tableau, near, embedded)
    if places and not found.linear:
        message = "R(z) is not defined: some stages do not depend on every vector field"
        raise MethodError(message, "leave the points out", code="wanted-without-meaning")
    found = found.at(places)
    return found.of_linear_problems if linear else found


def two_springs(
    method: AnyMethod, slow: Number | tuple[Number, Number], fast: Whole = 1
) -> TwoFrequencies | SlowInterval:
    """The step sizes at which a method is stable on two springs: ``gark stability --slow --fast``.

    Args:
        method: whatever ``method_of`` takes; its coefficients are exact.
        slow: a = (hω_s)², at least 0; or the ends of an interval of them.
        fast: the colour of the fast spring, counted from 1.

    Returns:
        ``stable`` are the x = (hω_f)² with all powers of the step matrix bounded, for every a.

    Raises:
        MethodError: the coefficients are rounded, a number is negative, or there is no such colour.
        UsageProblem: the method has no two terms for the springs.

    >>> two_springs("collocation", "1/4")
    <TwoFrequencies slow 1/4: stable in 2 intervals>
    """
    method = method_of(method)
    if method.tolerance is not None:
        message = "with rounded coefficients nothing is decided about two springs"
        raise MethodError(message, "give exact coefficients, without tolerance", code="rounded")
    tableau = method.tableau
    split = springs(tableau, tableau.colours[colour_of(fast, "fast", tableau.size)].term)
    if not isinstance(slow, tuple):
        return two_frequencies(tableau, split, _square(slow))
    low, high = map(_square, slow)
    if low >= high:
        message = "slow: the ends are not in ascending order"
        raise MethodError(message, "give (low, high)", code="option-value")
    return slow_interval(tableau, split, low, high)


def _square(given: Number) -> fmpq:
    number = rational(given, "slow")
    if number < 0:
        message = f"slow: {number}: a square is not negative"
        raise MethodError(message, "give 0 or more", code="option-value")
    return number


def prove_method(method: AnyMethod, limit: Whole = DEFAULT_LIMIT) -> MethodProof:
    """The orders of a method, its conjugate and its pair, with spanning trees and witnesses.

    Args:
        method: whatever ``method_of`` takes; its coefficients are exact.
        limit: the order at which to stop.

    Raises:
        MethodError: the coefficients are rounded; use ``prove_method_exists``.

    >>> prove_method("rk4")
    <MethodProof order 4, conjugate 4, pair 4>
    """
    return analysis.prove_method(method_of(method, is_any_kind=True), whole(limit, "limit", 1))


def prove_method_exists(method: AnyMethod, limit: Whole = DEFAULT_LIMIT) -> ExistenceProof:
    """A proof that some method within the rounding of a printed one has its order, and none more.

    Args:
        method: whatever ``method_of`` takes; its coefficients are rounded.
        limit: the order at which to stop.

    Raises:
        MethodError: the coefficients are exact, or there is no proof.

    >>> prove_method_exists("kvaerno-3")
    <ExistenceProof of order 3>
    """
    from garkcli.check import existing  # numpy is paid for here

    return existing.prove_method_exists(
        method_of(method, is_any_kind=True), whole(limit, "limit", 1)
    )
