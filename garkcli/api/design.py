"""Methods from families: parameters for an order, minima, searches."""

from __future__ import annotations

import os
import shlex
from collections.abc import Iterator
from typing import TypeAlias

from garkcli.api.files import loads, path_of
from garkcli.api.numbers import Number, Whole, colour_of, rational, rational_or_none, whole
from garkcli.deadline import within
from garkcli.design import design as designing
from garkcli.design.choices import Chosen, accepted_methods, chosen
from garkcli.design.design import CLAIMS, Design
from garkcli.design.member import TABLEAUS, Whose, refuse_levels
from garkcli.design.minimise import minimise as minimising
from garkcli.design.minimise.objective import LevelObjective
from garkcli.design.minimise.result import Minimum
from garkcli.design.minimise.sums import refuse
from garkcli.design.search import run as searching
from garkcli.design.search.nearest import nearest_member
from garkcli.design.search.run import TOLERANCE, FoundMethod, SearchResult
from garkcli.design.stability_kinds import TwoSprings
from garkcli.design.stable_set import stable_set
from garkcli.design.stable_values import StableValues, Wanted
from garkcli.design.within import DesignWithin, find_within
from garkcli.errors import MethodError, UsageProblem, did_you_mean
from garkcli.exact.display import decimal
from garkcli.exact.polynomial_text import root_decimal, root_text
from garkcli.frozen import Frozen, replace
from garkcli.methodfile import family as families
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.family import FamilyFile, with_values
from garkcli.tableau.family import Family
from garkcli.tableau.garkmethod import GarkMethod

AnyFamily: TypeAlias = "Family | str | os.PathLike[str]"
"""The result of ``load_family`` and ``loads_family``, or the path of a file."""

DIGITS = 15
HEADS = {
    "exact": "exact",
    "exists": "proved to exist, with these decimals",
    "numerical": "numerical, nothing is proved",
}
STABILITIES: tuple[Wanted, ...] = ("a-stable", "l-stable", "p-stable", "i-stable")


def family_of(given: AnyFamily, is_free: bool = True) -> Family:
    """Returns the family; MethodFileError for faults, MethodError without any free parameter."""
    if isinstance(given, (str, os.PathLike)):
        return families.load_family(path_of(given), is_free=is_free)
    if isinstance(given, Family):
        return given
    raise MethodError(
        f"a family is expected, not {type(given).__name__}",
        "load a file with load_family(path)",
        code="arrays",
    )


def exact_family_of(given: AnyFamily, what: str, is_free: bool = True) -> Family:
    """Returns the family of an argument; MethodError for rounded coefficients, naming ``what``."""
    family = family_of(given, is_free)
    if is_rounded(family):
        message = f"{what} needs exact coefficients, and those of the file are rounded"
        cure = "write radicals and fractions; gark design alone finds values within the tolerance"
        raise MethodError(message, cure, code="rounded")
    return family


def is_rounded(family: Family) -> bool:
    return isinstance(family, FamilyFile) and family.tolerance is not None


def find_parameters(
    family: AnyFamily,
    order: Whole | None = None,
    whose: Whose = "method",
    seconds: float | None = None,
) -> Design | DesignWithin:
    r"""The parameters for which members of a family have an order: ``gark design``. For rounded
    coefficients these are values for which a method within the tolerance has it.

    Args:
        family: as ``load_family`` and ``loads_family`` return it, or the path of a file.
        order: the wanted order; by default the highest that some value reaches.
        whose: ``"method"``, ``"conjugate"`` or ``"pair"``.
        seconds: the time after which the rest stays undecided; None for no limit.

    Raises:
        ZeroWeight: a weight is zero for every value, and there is no conjugate.

    >>> from garkcli import loads_family
    >>> family = loads_family("parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]")
    >>> [step.kind for step in find_parameters(family).steps]
    ['every-value', 'solutions', 'none']
    """
    most = None if order is None else whole(order, "order", 1)
    read = family_of(family)
    refuse_levels(read)
    if is_rounded(read) and isinstance(read, FamilyFile):
        from garkcli.methodfile.rounded_family import RoundedFamily  # it imports numpy

        return find_within(RoundedFamily(read), most, whose, seconds)
    return designing.find_parameters(read, most, whose, seconds)


def minimise(design: Design | AnyFamily, objective: str, seconds: float | None = None) -> Minimum:
    r"""The methods of the highest order that minimise an objective: ``gark design --minimise``.

    Args:
        design: the result of ``find_parameters``, or a family as for it; the path may be that of a
            method without free parameters, whose value is the answer.
        objective: the quantity to be minimised: error, error-coupling, dense-error or coefficients;
            or maximised, with a minus sign: -ssp, -stability-interval, -real-interval,
            -imaginary-interval, -oscillator-interval; a search alone minimises A, B, C, D, E,
            embedded-A, largest, largest-error, nonzero, infinity, embedded-infinity, -sector and
            sums such as '2*A - ssp/10'.
        seconds: the time after which it stops; None for never.

    Raises:
        UsageProblem: the objective or a wanted stability does not apply, or nothing was decided.
        NotDecided: a Gröbner basis or a trial takes too long.

    >>> from garkcli import loads_family
    >>> text = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - 1/(2*t), 1/(2*t)]"
    >>> found = minimise(loads_family(text), "error")
    >>> found, str(found.value.exact), found.candidates
    (<Minimum of error>, '1/36', 1)
    """
    refuse(objective)  # before any work
    if not isinstance(design, Design):
        read = exact_family_of(design, "minimise", is_free=False)
        refuse_levels(read)
        design = designing.find_parameters(read, seconds=seconds)
    return minimising.minimise(design, objective, seconds)


def search_methods(
    family: AnyFamily,
    order: Whole,
    starts: Whole = 100,
    seed: Whole = 0,
    most: Whole = 5,
    whose: Whose = "method",
    seconds: float | None = None,
    objective: str | None = None,
    start: GarkMethod | None = None,
) -> SearchResult:
    r"""Search a family for methods of an order, from random starts: ``gark design --search``.

    Args:
        family: as ``find_parameters`` takes it.
        order: the wanted order.
        starts: the number of starts.
        seed: the seed of the starts; the same seed gives the same methods everywhere.
        most: the largest number of methods; further ones are counted.
        whose: as in ``find_parameters``.
        seconds: the time after which the search ends with the methods found; None for never.
        objective: what is minimised from each start, as in ``minimise``; the methods are the best.
        start: a method with as many stages and colours at which the first start is.

    Raises:
        ZeroWeight: a weight is zero for every value, and there is no conjugate.
        UsageProblem: the objective does not apply, SciPy is missing, or ``start`` has other sizes.

    >>> from garkcli import loads_family
    >>> family = loads_family("parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]")
    >>> found = search_methods(family, 2, starts=3)
    >>> found, found.methods[0].values
    (<SearchResult 1 method of 3 starts>, {'t': '1/2'})
    """
    exact = exact_family_of(family, "search_methods")
    return searching.search_methods(
        exact,
        whole(order, "order", 1),
        whole(starts, "starts", 1),
        whole(seed, "seed"),
        whole(most, "most", 1),
        whose,
        seconds,
        objective,
        None if start is None else nearest_member(exact, start.tableau, start.further),
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
    r"""The values of parameters that make a family stable: ``gark design --a-stable``.

    Args:
        family: as ``find_parameters`` takes it; with at most two free parameters, or several on
            which the step depends through at most two linear combinations.
        wanted: ``"a-stable"``, ``"l-stable"``, ``"p-stable"`` or ``"i-stable"``.
        whose: as in ``find_parameters``.
        slow: (hω_s)² for P- or I-stability on two springs; None for the oscillator.
        fast: the colour of the fast spring, counted from 1.
        up_to: a bound on (hω_f)²; None for none.
        colour: for A- and L-stability of one colour, from 1; None for all colours with one λ.
        seconds: the time after which it stops; None for never.

    Raises:
        UsageProblem: the stability does not apply, or there are too many parameters or roots.
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
    read = exact_family_of(family, "stable_values").on_linear_problems
    refuse_levels(read)
    springs = alone = None
    if slow is not None:
        tableau = TABLEAUS[whose](read.tableau)
        fast_one = colour_of(fast, "fast", tableau.size)
        springs = TwoSprings(
            rational(slow, "slow"), tableau.colours[fast_one].term, rational_or_none(up_to, "up_to")
        )
    if colour is not None:
        alone = colour_of(colour, "colour", read.tableau.size)
    with within(seconds):
        return stable_set(read, wanted, whose, springs, alone)


def found_methods(
    found: Design | DesignWithin | Minimum | SearchResult,
    family: AnyFamily | None = None,
    whose: Whose | None = None,
) -> list[MethodFile]:
    r"""The methods that were found, each with the text of its file: ``gark design --output-dir``.

    Args:
        found: of ``find_parameters``, ``minimise`` or ``search_methods``; of a design the methods
            of the highest order with finitely many, of a minimum those with its value.
        family: the family of a search; a design and a minimum have theirs.
        whose: whose order a search was for, if not that of the search.

    Raises:
        MethodError: a search is without its family, or the values cannot be written in a method
            file.

    >>> from garkcli import loads_family
    >>> text = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - 1/(2*t), 1/(2*t)]"
    >>> (ralston,) = found_methods(minimise(loads_family(text), "error"))
    >>> ralston.A, ralston.b, ralston.order
    (((0, 0), (2/3, 0)), (1/4, 3/4), 2)
    """
    if not isinstance(found, (Design, DesignWithin, Minimum, SearchResult)):
        raise MethodError(
            f"found methods are expected, not {type(found).__name__}",
            "give what find_parameters, minimise or search_methods returned",
            code="arrays",
        )
    if isinstance(found, (Design, DesignWithin)):
        read = found.family
    elif isinstance(found, Minimum):
        read = found.design.family
    elif family is None:
        message = "a search does not know its family"
        raise MethodError(message, "found_methods(result, family)", code="arrays")
    else:
        read = family_of(family)
        found = replace(found, whose=whose or found.whose)
    if not isinstance(read, FamilyFile):
        cure = "give what load_family or loads_family return"
        raise MethodError(f"{read!r} has no text", cure, code="other-file")
    return [loads(file.text, read.source) for file in found_files(found, read)]


class FoundFile(Frozen):
    """A method that was found, and the text of its file."""

    family: FamilyFile
    member: Chosen | FoundMethod
    head: str
    claim: str
    is_exact: bool = True

    @property
    def text(self) -> str:
        """Raises MethodError if its values cannot be written in a method file."""
        text = with_values(self.family, self.member.values, self.head, self.claim)
        if not self.is_exact and "tolerance:" not in text:
            text += f"tolerance: {TOLERANCE}\n"
        return text


def found_files(
    found: Design | DesignWithin | Minimum | SearchResult, family: FamilyFile, wishes: str = ""
) -> Iterator[FoundFile]:
    """Yields the files; each head is the command line, with ``wishes``, that finds it again."""
    path = family.source if family.source.startswith("<") else shlex.quote(family.source)
    source = f"found by gark design {path}"
    source += "".join(f" --set {shlex.quote(f'{k}={v}')}" for k, v in family.settings.items())
    source += wishes
    if isinstance(found, DesignWithin):
        yield from _files_within(found, family, source)
        return
    if isinstance(found, Design):
        further = _wanted(found.family, found.whose)
        if found.last.has_methods:  # it ended at the wanted order
            source += _aim(family, found.whose, found.last.order)
        for method in accepted_methods(found):
            claim = f"{_orders(method, found.whose)}{further}"
            yield FoundFile(family, method, f"{source}: {claim}", claim)
    elif isinstance(found, Minimum):
        whose, order = found.design.whose, found.step.order
        options = f"{_aim(family, whose, order)} --minimise {found.objective.key}"
        further = _wanted(found.design.family, whose)
        further += _claim(found) if whose == "method" else ""
        for candidate in found.minimisers:
            own = candidate.found.order
            known = order if own is None else own.order
            best = chosen(candidate.found, candidate.index, family.parameters, known)
            claim = _orders(best, whose)
            yield FoundFile(family, best, f"{source}{options}: {claim}", claim + further)
    else:
        for find in found.methods:
            beside = "" if find.embedded is None else f", embedded-order: {find.embedded}"
            claim = f"{CLAIMS[found.whose]}: {find.order}{beside}{_wanted(family, found.whose)}"
            goal = "" if found.objective is None else f" --minimise {found.objective.key}"
            aim = _aim(family, found.whose, found.order)
            head = f"{source}{aim}{goal}, start {find.start} of seed {found.seed}\n"
            if found.objective is not None:
                head += f"{found.objective.key.removeprefix('-')} {find.objective}\n"
            head += f"{HEADS[find.proof]}: {claim}"
            if not find.is_exact:
                head += f", residuals below {find.residual} before rounding"
            yield FoundFile(family, find, head, claim, find.is_exact)


def _aim(family: Family, whose: Whose, order: int) -> str:
    """Returns the options for an order that the file does not wish for itself."""
    options = "" if whose == "method" else f" --{whose}"
    return options if order == family.order else f"{options} --order {order}"


def _files_within(found: DesignWithin, family: FamilyFile, source: str) -> Iterator[FoundFile]:
    step = found.best
    for values in () if step is None else (x for x in step.found if x.is_admitted):
        texts = {name: values.text(name, found.digits) for name in family.parameters}
        claim = f"{CLAIMS[found.whose]}: {values.order}"
        if values.embedded:
            claim += f", embedded-order: {values.embedded}"
        aim = _aim(family, found.whose, values.order) if found.steps[-1].has_methods else ""
        head = f"{source}{aim}: {claim} within {decimal(found.tolerance)}, numerical"
        member = FoundMethod(1, "numerical", values.order, texts, "0")
        yield FoundFile(family, member, head, claim, is_exact=False)


def _orders(method: Chosen, whose: Whose) -> str:
    beside = "" if method.embedded is None else f", embedded-order: {method.embedded}"
    return f"{CLAIMS[whose]}: {method.order}{beside}"


def _wanted(family: Family, whose: Whose) -> str:
    """Returns the claims about stability and further orders that were wanted."""
    wanted = [f", {key}: {value}" for key, value in family.claims_of_wanted]
    wanted += [f", {x.kind}: true" for x in family.stable if x.colour is None and not x.is_embedded]
    return "".join(wanted) if whose == "method" else ""


def _claim(minimum: Minimum) -> str:
    objective = minimum.objective
    if not isinstance(objective, LevelObjective) or objective.claim is None:
        return ""
    if minimum.is_infinite:
        return f", {objective.claim}: infinity"
    if minimum.value is None:
        return ""
    text = root_text(minimum.value) or root_decimal(minimum.value, DIGITS)
    return f", {objective.claim}: {text}"
