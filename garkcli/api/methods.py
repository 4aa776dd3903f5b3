"""What is asked of a method most: its order, its conjugate, its pair, everything at once.

Each takes a tableau, a loaded method or a diagonal one, and decides within the tolerance of the
method's file unless another is given.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, cast, overload

from garkcli.api.arguments import AnyMethod, tableau_of, tolerance_of
from garkcli.check import deciding
from garkcli.check.analysis import Analysis, AnyOrder
from garkcli.order import certificate
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.tableau import conjugate as conjugation
from garkcli.tableau import forms
from garkcli.tableau.embedded import NOTHING
from garkcli.tableau.garkmethod import Derivation, GarkMethod
from garkcli.tableau.method import Method
from garkcli.tableau.tableau import Tableau


def find_order(
    method: AnyMethod, limit: int = DEFAULT_LIMIT, tolerance: object = None
) -> AnyOrder:
    r"""The order of a method: exactly, or within its tolerance.

    The conjugate and the pair of a rounded method have the orders that ``analyse`` says: its
    rounding goes on into their coefficients.

    Args:
        method: a loaded method, a diagonal one, or a tableau.
        limit: the order at which to stop.
        tolerance: the rounding of the coefficients; that of the method where it is not given, 0 for
            none.

    Returns:
        An ``Order``, or a ``RoundedOrder`` within a tolerance; both have ``order``, ``witness`` and
        ``is_lower_bound``.

    >>> from garkcli.methodfile.load import loads
    >>> find_order(loads("A: [[0, 0], [1/2, 0]]\nb: [0, 1]")).order
    2
    """
    near = tolerance_of(method, tolerance)
    if near is None:
        return certificate.find_order(tableau_of(method), limit)
    if (
        tolerance is None
        and isinstance(method, GarkMethod)
        and method.base is not None
    ):
        found = deciding.analyse(method.base.tableau, limit, near)
        order = (
            found.pair_order
            if method.derivation == "pair"
            else found.conjugate_order
        )
        if order is not None:
            return order
    from garkcli.order.rounded import find_order_within

    return find_order_within(tableau_of(method), near, limit)


def analyse(
    method: AnyMethod, limit: int = DEFAULT_LIMIT, tolerance: object = None
) -> Analysis:
    """Decide everything that ``gark check`` reports; no order beyond ``limit`` is looked for.

    Args:
        method: a loaded method, a diagonal one, or a tableau.
        limit: where the search for orders stops.
        tolerance: the rounding of the coefficients; that of the method where it is not given, 0 for
            none.
    """
    further = method.further if isinstance(method, GarkMethod) else NOTHING
    near = tolerance_of(method, tolerance)
    return deciding.analyse(tableau_of(method), limit, near, further=further)


def is_symplectic(method: AnyMethod, tolerance: object = None) -> bool:
    """Whether a method is its own conjugate; for a partitioned one, whether its parts are each
    other's. Within the tolerance of the method where it has one.
    """
    near = tolerance_of(method, tolerance)
    if near is None:
        return conjugation.is_symplectic(tableau_of(method))
    return deciding.analyse(tableau_of(method), 1, near).symplectic


class _OfSameKind(Protocol):
    """A function that makes a tableau of a tableau, and a loaded method of any other method."""

    @overload
    def __call__(self, method: Tableau) -> Tableau: ...
    @overload
    def __call__(self, method: GarkMethod | Method) -> GarkMethod: ...


def _of_same_kind(
    make: Callable[[AnyMethod], Tableau | GarkMethod],
) -> _OfSameKind:
    """The function itself; its type says what it returns for what."""
    return cast(_OfSameKind, make)


@_of_same_kind
def conjugate(method: AnyMethod) -> Tableau | GarkMethod:
    """The symplectic conjugate; that of a loaded method keeps its name and tolerance.

    Raises:
        ZeroWeight: a conjugate would divide by zero.
    """
    if isinstance(method, Tableau):
        return conjugation.conjugate(method)
    if isinstance(method, GarkMethod):
        is_conjugate = method.derivation == "conjugate"
        # the conjugate twice is the method itself
        if is_conjugate and method.base is not None:
            return method.base
    made = conjugation.conjugate(tableau_of(method))
    return _derived(method, made, "conjugate")


@_of_same_kind
def pair(method: AnyMethod) -> Tableau | GarkMethod:
    """The symplectic pair (Q, P) of a method and its conjugate: 2N colours V¹…Vᴺ, F¹…Fᴺ.

    Raises:
        ZeroWeight: a conjugate would divide by zero.
    """
    if isinstance(method, Tableau):
        return forms.pair(method)
    return _derived(method, forms.pair(tableau_of(method)), "pair")


def _derived(
    method: GarkMethod | Method, tableau: Tableau, derivation: Derivation
) -> GarkMethod:
    base = method if isinstance(method, GarkMethod) else method_of(method)
    name = f"{derivation} of {base.name}" if base.name else ""
    return GarkMethod(
        tableau=tableau,
        name=name,
        tolerance=base.tolerance,
        derivation=derivation,
        base=base,
    )


def method_of(method: AnyMethod) -> GarkMethod:
    """A tableau or a diagonal method with its entries as they are printed.

    >>> from garkcli.families.registry import diagonal_method
    >>> method_of(diagonal_method("gauss", 2)).A[0]
    (1/4, 1/4 - sqrt(3)/6)
    """
    if isinstance(method, GarkMethod):
        return method
    name = method.name if isinstance(method, Method) else ""
    return GarkMethod(tableau=tableau_of(method), name=name)
