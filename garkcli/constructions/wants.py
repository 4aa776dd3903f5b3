"""Requirements on methods of other kinds in ``gark design``."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import cast

from garkcli.constructions import nystrom
from garkcli.constructions.infinitesimal import slow_part
from garkcli.constructions.nystrom import Nystrom, is_nystrom
from garkcli.constructions.rosenbrock import DAE_VIEWS, VIEWS, Rosenbrock, is_rosenbrock, seen
from garkcli.design.want import Asked, Want, WantConditions
from garkcli.design.wants import WANTS, as_embedded, order_meaning
from garkcli.errors import MethodError
from garkcli.exact.field import ONE, Number
from garkcli.exact.matrix import SingularMatrixError
from garkcli.frozen import Frozen, replace
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


def _order(key: str, asked: Asked) -> WantConditions:
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


def _stiffly_accurate(asked: Asked) -> WantConditions:
    """The last row of β = α + γ is b, and the last node 1.

    E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, VI.4.
    """
    linear = on_linear_problems(asked.tableau)
    row, b = linear.blocks[0, 0][-1], linear.colours[0].b
    node = asked.tableau.colours[0].c[-1]
    return WantConditions((*(x - y for x, y in zip(row, b, strict=True)), node - ONE))


def _wants() -> Iterator[Want]:
    for key, text in _SUMMARIES.items():
        yield Want(key, "count", f"the order {text}", partial(_order, key))
    for key, text in _SUMMARIES.items():
        name, summary = EMBEDDED + key, f"the order {text}, of the embedded weights"
        yield Want(name, "count", summary, partial(_order, name))


def _order_of_step(key: str, asked: Asked) -> WantConditions:
    """The conditions of one step of a Nyström method, with b̄ and b or the embedded weights."""
    tableau = as_embedded(asked, key) if key.startswith(EMBEDDED) else asked.tableau
    found = nystrom.seen(tableau, _STEPS[key.removeprefix(EMBEDDED)])
    assert isinstance(found, Tableau)
    order = cast("int", asked.value)
    return replace(order_meaning(found, asked), claims=((key, f'">= {order}"'),))


_STEPS: dict[str, nystrom.Which] = {
    "position-order": "in_positions",
    "velocity-order": "in_velocities",
}


def _of_steps() -> Iterator[Want]:
    for key, letter in zip(_STEPS, ("q", "q′"), strict=True):
        yield Want(key, "count", f"the order of the step in {letter}", partial(_order_of_step, key))
    for key, letter in zip(_STEPS, ("q", "q′"), strict=True):
        name, summary = EMBEDDED + key, f"the order of the step in {letter}, of embedded weights"
        yield Want(name, "count", summary, partial(_order_of_step, name))


def _slow_part(tableau: Tableau) -> Tableau:
    found = slow_part(tableau)
    assert isinstance(found, Tableau)
    return found


def _slow_order(asked: Asked) -> WantConditions:
    order = cast("int", asked.value)
    meaning = order_meaning(_slow_part(asked.tableau), asked)
    return replace(meaning, claims=(("slow-order", f'">= {order}"'),))


def _last_stage_is_step(asked: Asked) -> WantConditions:
    """The last row of Ā is b̄ and that of A b, and the last node 1."""
    method = Nystrom.of(asked.tableau)
    rows = [(method.Abar[-1], method.bbar)]
    rows += [] if method.A is None else [(method.A[-1], method.b)]
    zeros = [x - y for row, b in rows for x, y in zip(row, b, strict=True)]
    return WantConditions((*zeros, method.c[-1] - ONE))


def _row_sums(asked: Asked) -> WantConditions:
    """Σ_j ā_ij = c_i²/2, and Σ_j a_ij = c_i: each stage is right up to order 2.

    E. Hairer, S. P. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, II.14.
    """
    method = Nystrom.of(asked.tableau)
    zeros: list[Number] = []
    for i, c in enumerate(method.c):
        zeros.append(sum(method.Abar[i], -c * c / 2))
        zeros += [] if method.A is None else [sum(method.A[i], -c)]
    return WantConditions(tuple(zeros))


def _itself(tableau: Tableau) -> Tableau:
    return tableau


def _nodes(tableau: Tableau) -> Tableau:
    kind = Rosenbrock if is_rosenbrock(tableau) else Nystrom
    return kind.of(tableau).arrays[0]


Meant = Callable[[Tableau], Tableau]


class OfKind(Frozen):
    """Requirements on one kind of methods, all by key.

    Attributes:
        own: requirements for these methods only.
        meant: makes the tableau that another requirement is about.
        instead: meanings that replace the usual ones.
    """

    name: str
    has: Callable[[Tableau], bool]
    own: Mapping[str, Want]
    meant: Mapping[str, Meant]
    instead: Mapping[str, Callable[[Asked], WantConditions]]


KINDS = (
    OfKind(
        "Rosenbrock",
        is_rosenbrock,
        {want.key: want for want in _wants()},
        {
            **dict.fromkeys(("embedded-order", "dense-order", "stiffly-accurate"), _itself),
            **dict.fromkeys(("embedded-a-stable", "embedded-l-stable"), _itself),
            **dict.fromkeys(("positive-weights", "R-infinity"), on_linear_problems),
            **dict.fromkeys(("a-stable", "l-stable", "p-stable", "i-stable"), on_linear_problems),
            **dict.fromkeys(("nodes-in-unit-interval", "nodes-ascending"), _nodes),
        },
        {"stiffly-accurate": _stiffly_accurate},
    ),
    OfKind(
        "Nyström",
        is_nystrom,
        {want.key: want for want in _of_steps()},
        {
            **dict.fromkeys(("embedded-order", "dense-order", "dense-continuity"), _itself),
            **dict.fromkeys(("stiffly-accurate", "consistent"), _itself),
            **dict.fromkeys(("nodes-in-unit-interval", "nodes-ascending"), _nodes),
        },
        {"stiffly-accurate": _last_stage_is_step, "consistent": _row_sums},
    ),
    OfKind(
        "multirate infinitesimal",
        lambda tableau: tableau.exact_to is not None,
        {
            "slow-order": Want(
                "slow-order", "count", "the order of the slow method alone", _slow_order
            )
        },
        {
            "embedded-order": _itself,
            **dict.fromkeys(("nodes-in-unit-interval", "nodes-ascending"), _slow_part),
        },
        {},
    ),
)
EVERY = {**WANTS, **{key: want for kind in KINDS for key, want in kind.own.items()}}


def meant_of(want: Want, tableau: Tableau) -> tuple[Want, Tableau]:
    """Returns the tableau that a requirement is about; MethodError if it has none for this kind."""
    own = next((kind for kind in KINDS if kind.has(tableau)), None)
    owner = next((kind for kind in KINDS if want.key in kind.own), None)
    if owner is not None and owner is not own:
        message = f"design: {want.key} is for {owner.name} methods"
        raise MethodError(message, "leave it out", code="wanted-without-meaning")
    if own is None or want.key in own.own:
        return want, tableau
    if want.key not in own.meant:
        message = f"design: {want.key} is not for {own.name} methods"
        raise MethodError(message, "leave it out", code="wanted-without-meaning")
    meaning = own.instead.get(want.key, want.meaning)
    return replace(want, meaning=meaning), own.meant[want.key](tableau)
