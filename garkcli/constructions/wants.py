"""Requirements on Rosenbrock methods in ``gark design``, and the tableau that each other
requirement is about.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import cast

from garkcli.constructions.rosenbrock import DAE_VIEWS, VIEWS, Rosenbrock, is_rosenbrock, seen
from garkcli.design.want import Asked, Meaning, Want
from garkcli.design.wants import WANTS, as_embedded, order_meaning
from garkcli.errors import MethodError
from garkcli.exact.field import ONE
from garkcli.exact.matrix import SingularMatrixError
from garkcli.frozen import replace
from garkcli.tableau.forms import on_linear_problems
from garkcli.tableau.tableau import Tableau

_SUMMARIES = {
    "w-order": "with any matrix in place of the Jacobian",
    "old-jacobian-order": "with a matrix that differs by O(h)",
    "nonautonomous-order": "on f(t, y), with the c and d of the file",
    "index-1-order": "on DAEs of index 1",
    "index-1-y-order": "in y on DAEs of index 1",
    "index-1-z-order": "in z on DAEs of index 1",
}
EMBEDDED = "embedded-"


def _order(key: str, asked: Asked) -> Meaning:
    """The conditions of the order of a view, with b or the embedded weights."""
    tableau = as_embedded(asked, key) if key.startswith(EMBEDDED) else asked.tableau
    try:
        found = seen(tableau, {**VIEWS, **DAE_VIEWS}[key.removeprefix(EMBEDDED)])
    except SingularMatrixError:
        message = "design: alpha + gamma is singular for every value, so DAEs have no solution"
        cure = "give gamma a diagonal that is not zero"
        raise MethodError(message, cure, code="wanted-without-meaning") from None
    assert isinstance(found, Tableau)
    order = cast("int", asked.value)
    return replace(order_meaning(found, asked), claims=((key, f'">= {order}"'),))


def _stiffly_accurate(asked: Asked) -> Meaning:
    """The last row of β = α + γ is b, and the last node 1.

    E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, VI.4.
    """
    linear = on_linear_problems(asked.tableau)
    row, b = linear.blocks[0, 0][-1], linear.colours[0].b
    node = asked.tableau.colours[0].c[-1]
    return Meaning((*(x - y for x, y in zip(row, b, strict=True)), node - ONE))


def _wants() -> Iterator[Want]:
    """Each order, of the method and with its embedded weights."""
    for key, text in _SUMMARIES.items():
        yield Want(key, "count", f"the order {text}", partial(_order, key))
    for key, text in _SUMMARIES.items():
        name, summary = EMBEDDED + key, f"the order {text}, of the embedded weights"
        yield Want(name, "count", summary, partial(_order, name))


OF_ROSENBROCK = {want.key: want for want in _wants()}
"""Requirements for Rosenbrock methods only, by key."""
EVERY = {**WANTS, **OF_ROSENBROCK}
"""All requirements, by key."""


def _itself(tableau: Tableau) -> Tableau:
    return tableau


_MEANT: dict[str, Callable[[Tableau], Tableau]] = {
    **dict.fromkeys(("embedded-order", "dense-order", *OF_ROSENBROCK), _itself),
    **dict.fromkeys(("positive-weights", "R-infinity"), on_linear_problems),
    **dict.fromkeys(("a-stable", "l-stable", "p-stable", "i-stable"), on_linear_problems),
    **dict.fromkeys(
        ("nodes-in-unit-interval", "nodes-ascending"),
        lambda tableau: Rosenbrock.of(tableau).arrays[0],
    ),
    "stiffly-accurate": _itself,
}
"""The tableau of a Rosenbrock method that a requirement is about."""


def meant_of(want: Want, tableau: Tableau) -> tuple[Want, Tableau]:
    """A requirement and the tableau that it is about.

    Raises:
        MethodError: it is not defined for methods of this kind.
    """
    is_own = is_rosenbrock(tableau)
    if want.key in OF_ROSENBROCK and not is_own:
        message = f"design: {want.key} applies to Rosenbrock methods only"
        raise MethodError(message, "leave it out", code="wanted-without-meaning")
    if not is_own:
        return want, tableau
    if want.key not in _MEANT:
        message = f"design: {want.key} does not apply to Rosenbrock methods"
        raise MethodError(message, "leave it out", code="wanted-without-meaning")
    if want.key == "stiffly-accurate":
        want = Want(want.key, want.kind, want.summary, _stiffly_accurate)
    return want, _MEANT[want.key](tableau)
