"""Methods found: parameters for an order, minima, searches."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping
from typing import TypeAlias

from garkcli.api.files import load_family, loads
from garkcli.api.numbers import Number, Whole, colour_of, rational, rational_or_none, whole
from garkcli.deadline import within
from garkcli.design import design as designing
from garkcli.design import stable_values as stabilities
from garkcli.design.choices import accepted_methods, values_text
from garkcli.design.design import CLAIMS, Design, Whose
from garkcli.design.minimise import minimise as minimising
from garkcli.design.minimise.objectives import OBJECTIVES
from garkcli.design.minimise.result import Minimum
from garkcli.design.search import run as searching
from garkcli.design.search.run import TOLERANCE, Result
from garkcli.design.stability_kinds import TwoSprings
from garkcli.design.stable_values import StableValues, Wanted
from garkcli.errors import MethodError, UsageProblem, did_you_mean
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.family import FamilyFile, with_values
from garkcli.tableau.family import Family

AnyFamily: TypeAlias = "Family | str | os.PathLike[str]"
"""What ``load_family`` and ``loads_family`` return, or the path of a file."""

STABILITIES: tuple[Wanted, ...] = ("a-stable", "l-stable", "p-stable")


def family_of(given: AnyFamily) -> Family:
    """The family that is meant.

    Raises:
        MethodFileError: every fault of a file.
        MethodError: it has no free parameter.
    """
    if isinstance(given, (str, os.PathLike)):
        return load_family(given)
    if isinstance(given, Family):
        return given
    raise MethodError(
        f"a family is expected, not {type(given).__name__}",
        "load a file with load_family(path)",
        code="arrays",
    )


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


def minimise(design: Design | AnyFamily, objective: str, seconds: float | None = None) -> Minimum:
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
        raise UsageProblem(message, did_you_mean(objective, OBJECTIVES), code="unknown-word")
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
    seconds: float | None = None,
) -> Result:
    r"""Search a family for methods of an order, from random starts: ``gark design --search``.

    Args:
        family: as ``find_parameters`` takes it.
        order: that is wanted.
        starts: how many.
        seed: of the starts; the same seed has the same finds everywhere.
        most: methods that are looked for at most; other successes are counted.
        whose: as in ``find_parameters``.
        seconds: after which the search ends with what was found; None for never.

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
        seconds,
    )


def stable_values(
    family: AnyFamily,
    wanted: Wanted,
    whose: Whose = "method",
    slow: Number | None = None,
    fast: Whole = 1,
    up_to: Number | None = None,
    colour: Whole | None = None,
    seconds: float | None = None,
) -> StableValues:
    r"""The values of the one parameter of a family that make it stable: ``gark design --a-stable``.

    Args:
        family: as ``find_parameters`` takes it; with one free parameter.
        wanted: ``"a-stable"``, ``"l-stable"`` or ``"p-stable"``.
        whose: as in ``find_parameters``.
        slow: of P-stability on two springs, (hω_s)²; None for the oscillator.
        fast: the colour of the fast spring, counted from 1.
        up_to: a bound on (hω_f)²; None for none.
        colour: of A- and L-stability, the colour that is meant alone, counted from 1; None for all
            colours with one λ.
        seconds: after which it is given up; None for never.

    Raises:
        MethodError: there is no such colour.
        UsageProblem: the stability has no meaning for the method, there are several parameters, or
            coefficients are irrational.
        ZeroWeight: a weight is zero for every value, and there is no conjugate.
        NotDecided: the time is not enough.

    >>> from garkcli import loads_family
    >>> theta = loads_family("parameters: {t: free}\nA: [[0, 0], [1 - t, t]]\nb: [1 - t, t]")
    >>> found = stable_values(theta, "a-stable")
    >>> found, [(part.start, part.end) for part in found.found]
    (<StableValues a-stable: 1 interval>, [(<RealRoot 1/2>, None)])
    """
    if wanted not in STABILITIES:
        message = f"no stability {wanted!r}"
        raise UsageProblem(message, did_you_mean(wanted, STABILITIES), code="unknown-word")
    read = family_of(family)
    springs = alone = None
    if slow is not None:
        tableau = designing.TABLEAUS[whose](read.tableau)
        fast_one = colour_of(fast, "fast", tableau.size)
        springs = TwoSprings(
            rational(slow, "slow"), tableau.colours[fast_one].term, rational_or_none(up_to, "up_to")
        )
    if colour is not None:
        alone = colour_of(colour, "colour", read.tableau.size)
    with within(seconds):
        return stabilities.stable_values(read, wanted, whose, springs, alone)


def found_methods(
    found: Design | Minimum | Result, family: AnyFamily | None = None, whose: Whose = "method"
) -> list[MethodFile]:
    r"""The methods that were found, each with the text of its file: ``gark design --emit-all``.

    Args:
        found: what ``find_parameters``, ``minimise`` or ``search_methods`` returned. Of a design
            those of the highest order that has finitely many, of a minimum those with the value.
        family: that was searched; a design and a minimum know theirs.
        whose: order a search was for.

    Raises:
        MethodError: a search is given without its family, the family is not from a file or a text,
            or its values cannot be written in a method file.

    >>> from garkcli import loads_family
    >>> text = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - 1/(2*t), 1/(2*t)]"
    >>> (ralston,) = found_methods(minimise(loads_family(text), "error"))
    >>> ralston.A, ralston.b, ralston.order
    (((0, 0), (2/3, 0)), (1/4, 3/4), 2)
    """
    if isinstance(found, Result):
        if family is None:
            raise MethodError(
                "a search does not know its family", "found_methods(result, family)", code="arrays"
            )
        return list(_searched(found, _file_of(family_of(family)), whose))
    if isinstance(found, Minimum):
        return list(_least(found, _file_of(found.design.family)))
    if not isinstance(found, Design):
        raise MethodError(
            f"what was found is expected, not {type(found).__name__}",
            "give what find_parameters, minimise or search_methods returned",
            code="arrays",
        )
    chosen = accepted_methods(found)
    read = _file_of(found.family)
    return [_made(read, x.values, found.whose, x.order) for x in chosen]


def _searched(result: Result, family: FamilyFile, whose: Whose) -> Iterator[MethodFile]:
    for method in result.methods:
        yield _made(family, method.values, whose, method.order, method.is_exact)


def _least(minimum: Minimum, family: FamilyFile) -> Iterator[MethodFile]:
    for candidate in minimum.minimisers:
        solution = candidate.found.solution
        elements = {x: solution.values[x] for x in family.parameters}
        values = values_text(elements, solution.real[candidate.index])
        order = minimum.step.order
        if candidate.found.order is not None:
            order = candidate.found.order.order
        yield _made(family, values, minimum.design.whose, order)


def _file_of(family: Family) -> FamilyFile:
    """A family that has a text.

    Raises:
        MethodError: it has none.
    """
    if isinstance(family, FamilyFile):
        return family
    raise MethodError(
        f"{family!r} has no text", "give what load_family or loads_family return", code="other-file"
    )


def _made(
    family: FamilyFile, values: Mapping[str, str], whose: Whose, order: int, is_exact: bool = True
) -> MethodFile:
    """A method of a family, its parameters as texts."""
    claim = f"{CLAIMS[whose]}: {order}"
    text = with_values(family, values, f"found by gark: {claim}", claim)
    if not is_exact and "tolerance:" not in text:
        text += f"tolerance: {TOLERANCE}\n"
    return loads(text, family.source)
