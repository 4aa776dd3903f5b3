"""Methods found: parameters for an order, minima, searches."""

from __future__ import annotations

import os
from typing import TypeAlias

from garkcli.api.files import load_family
from garkcli.api.numbers import Whole, whole
from garkcli.design import design as designing
from garkcli.design.design import Design, Whose
from garkcli.design.minimise import minimise as minimising
from garkcli.design.minimise.registry import OBJECTIVES
from garkcli.design.minimise.result import Minimum
from garkcli.design.search import run as searching
from garkcli.design.search.run import Result
from garkcli.errors import UsageProblem, did_you_mean
from garkcli.tableau.family import Family

AnyFamily: TypeAlias = "Family | str | os.PathLike[str]"
"""What ``load_family`` and ``loads_family`` return, or the path of a file."""


def family_of(given: AnyFamily) -> Family:
    """The family that is meant.

    Raises:
        MethodFileError: every fault of a file.
        MethodError: it has no free parameter.
    """
    if isinstance(given, (str, os.PathLike)):
        return load_family(given)
    return given


def find_parameters(
    family: AnyFamily,
    order: Whole | None = None,
    whose: Whose = "method",
    seconds: float | None = None,
) -> Design:
    r"""For which values of its parameters the members of a family have an order: ``gark design``.

    Args:
        family: as ``load_family`` and ``loads_family`` return it, or the path of a file.
        order: the order wanted; where it is not given, as far as some value reaches.
        whose: ``"method"``, ``"conjugate"`` or ``"pair"``: of the method, its symplectic conjugate
            or its symplectic pair.
        seconds: after which what is not decided is left open; None for never.

    Raises:
        ZeroWeight: a weight is zero for every value, and there is no conjugate.

    >>> from garkcli import loads_family
    >>> family = loads_family("parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]")
    >>> found = find_parameters(family)
    >>> found, [step.kind for step in found.steps]
    (<Design <text>: order 2 is reached>, ['every-value', 'solutions', 'none'])
    """
    most = None if order is None else whole(order, "order", 1)
    found = family_of(family)
    return designing.find_parameters(found, most, whose, seconds)


def minimise(
    design: Design | AnyFamily, objective: str, seconds: float | None = None
) -> Minimum:
    r"""The methods of the highest order with the least value of an objective:
    ``gark design --minimise``.

    Args:
        design: what ``find_parameters`` returns, or a family as it takes it.
        objective: what is to be small: error, error-coupling or coefficients; or large, with a
            minus sign: -ssp, -stability-interval, -real-interval, -imaginary-interval,
            -oscillator-interval.
        seconds: after which it is given up; None for never.

    Raises:
        UsageProblem: there is no such objective, it has no meaning for the methods, nothing was
            decided, or the family is to be stable.
        NotDecided: a Gröbner basis or a trial takes too long.

    >>> from garkcli import loads_family
    >>> text = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - 1/(2*t), 1/(2*t)]"
    >>> found = minimise(loads_family(text), "error")
    >>> found, str(found.value.exact), found.candidates
    (<Minimum of error>, '1/36', 1)
    """
    if objective not in OBJECTIVES:
        message = f"no objective {objective!r}"
        raise UsageProblem(message, did_you_mean(objective, OBJECTIVES))
    if not isinstance(design, Design):
        design = find_parameters(design, seconds=seconds)
    return minimising.minimise(design, objective, seconds)


def search_methods(
    family: AnyFamily,
    order: Whole,
    starts: Whole = 100,
    seed: Whole = 0,
    most: Whole = 5,
    whose: Whose = "method",
) -> Result:
    r"""Search a family for methods of an order, from random starts: ``gark design --search``.

    Args:
        family: as ``find_parameters`` takes it.
        order: that is wanted.
        starts: how many.
        seed: of the starts; the same seed has the same finds everywhere.
        most: methods that are looked for at most; other successes are counted.
        whose: as in ``find_parameters``.

    Raises:
        ZeroWeight: a weight is zero for every value, and there is no conjugate.
        UsageProblem: the family is to be stable.

    >>> from garkcli import loads_family
    >>> family = loads_family("parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]")
    >>> found = search_methods(family, 2, starts=3)
    >>> found, found.methods[0].values
    (<Result 1 method of 3 starts>, {'t': '1/2'})
    """
    return searching.search_methods(
        family_of(family),
        whole(order, "order", 1),
        whole(starts, "starts", 1),
        whole(seed, "seed"),
        whole(most, "most", 1),
        whose,
    )
