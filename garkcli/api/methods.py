"""The most frequent questions about a method: its order, its conjugate, its pair, its analysis,
within the tolerance of its file unless another is given.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, Protocol, cast, overload

from garkcli.api.anymethod import AnyMethod, meant_of, method_of, tableau_of, with_tolerance
from garkcli.api.numbers import Number, Whole, colours_of, whole
from garkcli.check import analysis
from garkcli.check.analysis import AnyAnalysis
from garkcli.errors import MethodError, UsageProblem, did_you_mean
from garkcli.exact.field import ZERO
from garkcli.order import simplifying as conditions
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.deciding import AnyOrder, order_of
from garkcli.order.meant import as_meant, meant, remember_base, tolerance_of
from garkcli.order.simplifying import Simplifying
from garkcli.properties.reduction import smallest
from garkcli.properties.registry import KEYS
from garkcli.properties.subject import Subject
from garkcli.properties.verdict import Verdict
from garkcli.tableau import conjugate as conjugation
from garkcli.tableau import forms
from garkcli.tableau.garkmethod import Derivation, GarkMethod, derived_name
from garkcli.tableau.tableau import Method, Tableau


def find_order(
    method: AnyMethod, limit: Whole = DEFAULT_LIMIT, tolerance: Number | None = None
) -> AnyOrder:
    """The order of a method: exactly, or within its tolerance. The conjugate and the pair of a
    rounded method have the orders in ``analyse``: their coefficients inherit the rounding.

    Args:
        method: whatever ``method_of`` takes.
        limit: the order at which to stop, at least 1.
        tolerance: the rounding of the coefficients; by default that of the method, 0 for none.

    Returns:
        An ``Order``, or a ``RoundedOrder`` within a tolerance; both have ``order``, ``witness`` and
        ``is_lower_bound``.

    >>> find_order("rk4"), find_order("rk4").witness
    (<Order 4>, <Witness [[[[[]]]]]: 0 instead of 1/120>)
    """
    limit = whole(limit, "limit", 1)
    is_own = tolerance is None
    method, near = with_tolerance(method, tolerance, is_any_kind=True)
    if is_own and near is not None and method.base is not None:
        found = analysis.analyse(method.base.tableau, limit, near)
        order = found.pair_order if method.derivation == "pair" else found.conjugate_order
        if order is not None:
            return order
    return order_of(as_meant(method) if is_own else meant(method.tableau, near), limit)


def analyse(
    method: AnyMethod, limit: Whole = DEFAULT_LIMIT, tolerance: Number | None = None
) -> AnyAnalysis:
    """Decide all that ``gark check`` reports, with orders up to ``limit``.

    Args:
        method: whatever ``method_of`` takes.
        limit: where the search for orders stops, at least 1.
        tolerance: the rounding of the coefficients; by default that of the method, 0 for none.

    Returns:
        An ``Analysis`` for a GARK method. That of a Rosenbrock method has ``order``, ``w_order``,
        ``old_jacobian_order``, ``nonautonomous_order``, ``index_1_order``, ``index_1_y_order``,
        ``index_1_z_order``, ``at_infinity``; that of a multirate method with ``fast: exact``
        ``order``, ``slow_order``, ``nonautonomous_order``. Each has ``embedded`` too.

    >>> analyse("gauss-2"), analyse("mri-gark-erk33a")
    (<Analysis order 4, conjugate 4, pair 4>, <InfinitesimalAnalysis order 3, slow 3>)
    >>> found = analyse("ros3p")
    >>> found, found.w_order, found.index_1_order
    (<RosenbrockAnalysis order 3, W-order 1>, <Order 1>, <Order 3>)
    """
    limit = whole(limit, "limit", 1)
    method, near = with_tolerance(method, tolerance, is_any_kind=True)
    return analysis.analyse_any_tableau(method.tableau, limit, near, method.further)


def simplifying(
    method: AnyMethod, limit: Whole = DEFAULT_LIMIT, tolerance: Number | None = None
) -> Simplifying:
    """The simplifying assumptions B(r), C(η) and D(ζ) of each colour and each block.

    Args:
        method: whatever ``method_of`` takes.
        limit: where each search stops, at least 1.
        tolerance: the rounding of the coefficients; by default that of the method, 0 for none.

    Returns:
        ``B`` has a number for each colour, ``C`` and ``D`` one for each block, in rows, None for
        absent blocks; ``bound`` and ``sharp_bound`` are lower bounds of the order.

    >>> simplifying("gauss-2")
    Simplifying(B=(4,), C=((2,),), D=((2,),), limit=60)
    """
    limit = whole(limit, "limit", 1)
    _, known_as = meant_of(method, tolerance)
    return conditions.simplifying(known_as, limit)


def is_symplectic(method: AnyMethod, tolerance: Number | None = None) -> bool:
    """Whether a method is its own conjugate, or the parts of a partitioned one are.

    Args:
        method: whatever ``method_of`` takes.
        tolerance: as in ``find_order``.

    >>> is_symplectic("gauss-2"), is_symplectic("rk4")
    (True, False)
    """
    method, near = with_tolerance(method, tolerance)
    if near is None:
        return conditions.is_symplectic(method.tableau)
    return analysis.analyse(method.tableau, 1, near).symplectic


class _OfSameKind(Protocol):
    """Returns a tableau for a tableau, and a method for any other argument."""

    @overload
    def __call__(self, method: Tableau) -> Tableau: ...
    @overload
    def __call__(
        self, method: GarkMethod | Method | str | PathLike[str] | Sequence[Any] | Mapping[str, Any]
    ) -> GarkMethod: ...


def _of_same_kind(make: Callable[[AnyMethod], Tableau | GarkMethod]) -> _OfSameKind:
    return cast(_OfSameKind, make)


@_of_same_kind
def conjugate(method: AnyMethod) -> Tableau | GarkMethod:
    """The symplectic conjugate of a method, or of a tableau as a tableau.

    Args:
        method: whatever ``method_of`` takes.

    Raises:
        ZeroWeight: a conjugate would divide by zero.

    >>> conjugate("rk4").A[0]
    (1/6, -2/3, 1/3, 1/6)
    """
    if isinstance(method, Tableau):
        return conjugation.conjugate(method)
    method = method_of(method)
    is_conjugate = method.derivation == "conjugate"
    if is_conjugate and method.base is not None:
        return method.base
    return _derived(method, conjugation.conjugate(method.tableau), "conjugate")


@_of_same_kind
def pair(method: AnyMethod) -> Tableau | GarkMethod:
    """The symplectic pair (Q, P) of a method and its conjugate: 2N colours V¹…Vᴺ, F¹…Fᴺ.

    Args:
        method: whatever ``method_of`` takes; of a tableau the result is a tableau.

    Raises:
        ZeroWeight: a conjugate would divide by zero.

    >>> pair("heun").stages, pair("heun").order
    ((2, 2), 2)
    """
    if isinstance(method, Tableau):
        return forms.pair(method)
    method = method_of(method)
    return _derived(method, forms.pair(method.tableau), "pair")


def _derived(method: GarkMethod, tableau: Tableau, derivation: Derivation) -> GarkMethod:
    remember_base(tableau, method, derivation)
    return GarkMethod(
        tableau=tableau,
        name=derived_name(derivation, method.name),
        tolerance=method.tolerance,
        derivation=derivation,
        base=method,
    )


def symplectic_pair(
    method: AnyMethod, velocities: Iterable[Whole], forces: Iterable[Whole]
) -> GarkMethod:
    """The pair (Q, P) for the vector fields V^l, l in ``velocities``, and F^l, l in ``forces``,
    which share their stages: {1} and {1, 2} for semi-separable problems, {1} and {2} for separable
    ones, eqs. (varGARK).

    Args:
        method: whatever ``method_of`` takes.
        velocities: colours, counted from 1.
        forces: colours, counted from 1.

    Raises:
        MethodError: there is no such colour, or the method is partitioned already.
        ZeroWeight: a conjugate would divide by zero.

    >>> symplectic_pair("collocation", [1], [2])
    <GarkMethod 2 colours, stages 2, 3>
    """
    tableau = tableau_of(method)
    count = tableau.size
    V = colours_of(velocities, "velocities", count)
    F = colours_of(forces, "forces", count)
    if not V and not F:
        message = "a pair of no colour"
        raise MethodError(message, "give colours of velocities and of forces", code="arrays")
    return method_of(forms.symplectic_pair(tableau, V, F))


def find_property(method: AnyMethod, key: str, tolerance: Number | None = None) -> Verdict:
    """Decide a property, such as ``"l-stable"``, and give the reason.

    Args:
        method: whatever ``method_of`` takes.
        key: the name of the property, as method files claim it.
        tolerance: the rounding of the coefficients; by default that of the method, 0 for none.

    >>> find_property("gauss-2", "l-stable").why
    'R(∞) = 1'
    """
    if key not in KEYS:
        raise UsageProblem(f"no property {key!r}", did_you_mean(key, KEYS), code="unknown-word")
    is_own = tolerance is None
    method, known_as = meant_of(method, tolerance)
    near = tolerance_of(known_as)
    order = find_order(method, tolerance=None if is_own else near or 0).order
    assumed = conditions.simplifying(known_as)
    near = near or ZERO
    subject = Subject(method.tableau, order, assumed, DEFAULT_LIMIT, near, method.further)
    return subject.verdict(key)


def reduced(method: AnyMethod) -> GarkMethod | None:
    """The smallest equivalent method, perhaps itself: ``gark convert --to reduced``.

    Args:
        method: whatever ``method_of`` takes.

    >>> reduced(([[0, 0], [0, 0]], [1, 0])).stages
    (1,)
    """
    method = method_of(method)
    found = smallest(method.tableau, method.further)
    if found is None:
        return None
    tableau, further = found
    if tableau is method.tableau:
        return method
    is_named = method.name and method.name != getattr(method, "source", "")
    return GarkMethod(
        tableau=tableau,
        name=f"{method.name}, reduced" if is_named else "a reduced method",
        tolerance=method.tolerance,
        embedded=further.embedded,
        dense=further.dense,
        embedded_tolerance=method.embedded_tolerance,
        dense_tolerance=method.dense_tolerance,
    )
