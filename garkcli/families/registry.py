"""The one list of families: name, stages, maker, a line for people."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

from garkcli.errors import UnknownFamily, counted, did_you_mean
from garkcli.families import explicit, gauss, lobatto, radau
from garkcli.tableau.method import Method

MAX_STAGES = 200
"""Most stages of a family."""


@dataclass(frozen=True)
class Family:
    """A family of diagonal methods.

    Attributes:
        name: as in method files.
        make: the method with a given number of stages.
        smallest: the fewest stages it has.
        largest: the most stages it has; equal to ``smallest`` for a single method.
        order: its order in terms of s, for people.
        summary: one line.
    """

    name: str
    make: Callable[[int], Method]
    smallest: int
    largest: int
    order: str
    summary: str


def _named(name: str, order: str, summary: str) -> Family:
    stages = explicit.STAGES[name]
    return Family(
        name, lambda _: explicit.named(name), stages, stages, order, summary
    )


_any = partial(Family, largest=MAX_STAGES)
FAMILIES: Mapping[str, Family] = {
    family.name: family
    for family in (
        _any(
            "gauss",
            gauss.gauss,
            1,
            order="2s",
            summary="collocation at the Gauss nodes; symplectic",
        ),
        _any(
            "radau-ia",
            radau.radau_ia,
            1,
            order="2s - 1",
            summary="first node 0, D(s)",
        ),
        _any(
            "radau-iia",
            radau.radau_iia,
            1,
            order="2s - 1",
            summary="collocation, last node 1",
        ),
        _any(
            "lobatto-iiia",
            lobatto.lobatto_iiia,
            2,
            order="2s - 2",
            summary="collocation, nodes 0 and 1",
        ),
        _any(
            "lobatto-iiib",
            lobatto.lobatto_iiib,
            2,
            order="2s - 2",
            summary="symplectic conjugate of IIIA",
        ),
        _any(
            "lobatto-iiic",
            lobatto.lobatto_iiic,
            2,
            order="2s - 2",
            summary="a_i1 = b_1, stiffly accurate",
        ),
        _any(
            "lobatto-iiic*",
            lobatto.lobatto_iiic_star,
            2,
            order="2s - 2",
            summary="conjugate of IIIC",
        ),
        _any(
            "lobatto-iiid",
            lobatto.lobatto_iiid,
            2,
            order="2s - 2",
            summary="mean of IIIC and IIIC*; symplectic",
        ),
        _named("explicit-euler", "1", "one explicit stage"),
        _named("explicit-midpoint", "2", "Runge's method"),
        _named("heun", "2", "the explicit trapezoidal rule"),
        _named("kutta", "3", "Kutta's method of order 3"),
        _named("rk4", "4", "the classical Runge-Kutta method"),
        _any(
            "ssp2",
            explicit.ssp2,
            2,
            order="2",
            summary="explicit, strong-stability-preserving",
        ),
    )
}
"""Every family by name."""


OTHER_NAMES: Mapping[str, str] = {
    "euler": "explicit-euler",
    "forward-euler": "explicit-euler",
    "backward-euler": "radau-iia with 1 stage",
    "implicit-euler": "radau-iia with 1 stage",
    "midpoint": "explicit-midpoint, or gauss with 1 stage for the implicit one",
    "implicit-midpoint": "gauss with 1 stage",
    "trapezoidal": "lobatto-iiia with 2 stages",
    "crank-nicolson": "lobatto-iiia with 2 stages",
    "gauss-legendre": "gauss",
    "radau5": "radau-iia with 3 stages",
    "runge-kutta": "rk4",
    "classical": "rk4",
    "rk": "rk4",
    "erk4": "rk4",
    "rk2": "explicit-midpoint or heun",
    "rk3": "kutta",
    "ssprk2": "ssp2",
}
"""What people call members of the families, and how the program does."""


def require_member(name: str, stages: int | None = None) -> int:
    """The stages of the member of a family, which is not made.

    Raises:
        UnknownFamily: no such family, or not with that many stages.
    """
    family = FAMILIES.get(name)
    if family is None:
        other = OTHER_NAMES.get(
            name.lower().replace("_", "-").replace(" ", "-")
        )
        cure = (
            f"it is called {other} here"
            if other
            else did_you_mean(name, FAMILIES)
        )
        raise UnknownFamily(f"no family {name[:MAX_NAME]!r}", cure)
    is_single = family.smallest == family.largest
    s = family.smallest if stages is None and is_single else stages
    if s is None:
        example = f"write for instance stages: {max(2, family.smallest)}"
        raise UnknownFamily(
            f"the family {name} needs its number of stages", example
        )
    if not family.smallest <= s <= family.largest:
        have = (
            str(family.smallest) if is_single else f"{family.smallest} or more"
        )
        if s > family.largest:
            have += f", at most {family.largest}"
        message = f"{name} with {counted(s, 'stage')} does not exist"
        raise UnknownFamily(message, f"it has {have}")
    return s


MAX_NAME = 60
"""Most characters of an unknown name that are shown."""


def diagonal_method(name: str, stages: int | None = None) -> Method:
    """The member of a family.

    Args:
        name: a key of ``FAMILIES``.
        stages: how many; may be left out for a family of one method.

    Raises:
        UnknownFamily: no such family, or not with that many stages.

    >>> diagonal_method("gauss", 2).space.modulus
    x^2 + (-1)*x + 1/6
    """
    s = require_member(name, stages)
    return FAMILIES[name].make(s)
