"""What a method is like, and the smallest method that does the same."""

from __future__ import annotations

from garkcli.api.arguments import AnyMethod, tableau_of, tolerance_of
from garkcli.api.methods import find_order
from garkcli.errors import UsageProblem, did_you_mean
from garkcli.exact.field import ZERO
from garkcli.order.certificate import DEFAULT_LIMIT
from garkcli.order.simplifying import simplifying
from garkcli.properties.keys import KEYS
from garkcli.properties.property import Verdict
from garkcli.properties.smallest import smallest
from garkcli.properties.subject import Subject
from garkcli.tableau.embedded import NOTHING
from garkcli.tableau.garkmethod import GarkMethod


def find_property(
    method: AnyMethod, key: str, tolerance: object = None
) -> Verdict:
    """What is true of a property, such as ``"l-stable"``, and what decides it.

    Args:
        method: a loaded method, a diagonal one, or a tableau.
        key: the name of the property, as method files claim it.
        tolerance: the rounding of the coefficients; that of the method where it is not given, 0 for
            none.

    Raises:
        UsageProblem: there is no such property.

    >>> from garkcli.api.construction import diagonal_method
    >>> find_property(diagonal_method("gauss", 2), "l-stable").why
    'R(∞) = 1'
    """
    if key not in KEYS:
        raise UsageProblem(f"no property {key!r}", did_you_mean(key, KEYS))
    tableau = tableau_of(method)
    near = tolerance_of(method, tolerance) or ZERO
    order = find_order(method, tolerance=tolerance).order
    conditions = simplifying(tableau, DEFAULT_LIMIT, near)
    return Subject(tableau, order, conditions, DEFAULT_LIMIT, near).verdict(
        key
    )


def reduced(method: AnyMethod) -> GarkMethod | None:
    """The smallest method that does the same; None where stages are at irrational nodes and more
    than row sums would have to be compared.

    >>> from garkcli.api.arrays import from_arrays
    >>> reduced(from_arrays([[0, 0], [0, 0]], [1, 0])).stages
    (1,)
    """
    further = method.further if isinstance(method, GarkMethod) else NOTHING
    found = smallest(tableau_of(method), further)
    if found is None:
        return None
    tableau, further = found
    return GarkMethod(
        tableau=tableau,
        name=method.name if isinstance(method, GarkMethod) else "",
        tolerance=tolerance_of(method, None),
        embedded=further.embedded,
        dense=further.dense,
    )
