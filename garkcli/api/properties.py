"""What a method is like, and the smallest method that does the same."""

from __future__ import annotations

from garkcli.api.anymethod import AnyMethod, meant_of, method_of
from garkcli.api.methods import find_order
from garkcli.api.numbers import Number
from garkcli.errors import UsageProblem, did_you_mean
from garkcli.exact.field import ZERO
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.simplifying import simplifying
from garkcli.properties.property import Verdict
from garkcli.properties.reduction import smallest
from garkcli.properties.registry import KEYS
from garkcli.properties.subject import Subject
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.meant import tolerance_of


def find_property(method: AnyMethod, key: str, tolerance: Number | None = None) -> Verdict:
    """What is true of a property, such as ``"l-stable"``, and what decides it.

    Args:
        method: whatever ``method_of`` takes.
        key: the name of the property, as method files claim it.
        tolerance: the rounding of the coefficients; that of the method where it is not given, 0 for
            none.

    Raises:
        UsageProblem: there is no such property.

    >>> find_property("gauss-2", "l-stable").why
    'R(∞) = 1'
    """
    if key not in KEYS:
        raise UsageProblem(f"no property {key!r}", did_you_mean(key, KEYS), code="unknown-word")
    is_own = tolerance is None
    method, known_as = meant_of(method, tolerance)
    near = tolerance_of(known_as)
    order = find_order(method, tolerance=None if is_own else near or 0).order
    conditions = simplifying(known_as)
    subject = Subject(method.tableau, order, conditions, DEFAULT_LIMIT, near or ZERO)
    return subject.verdict(key)


def reduced(method: AnyMethod) -> GarkMethod | None:
    """The smallest method that does the same, itself where that is the method: ``gark reduce``.
    None where stages are at irrational nodes and more than row sums would have to be compared.

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
    )
