"""``gark design``."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import replace
from typing import TYPE_CHECKING, Any, cast

from garkcli.cli.design_options import Wanted
from garkcli.cli.options import Output, declared
from garkcli.cli.streams import say_problem
from garkcli.deadline import seconds_left, until, within
from garkcli.errors import ExpressionError, NotDecided, UsageProblem, counted, did_you_mean
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.design.choices import Choice
    from garkcli.design.design import Design
    from garkcli.design.minimise.result import Minimum
    from garkcli.design.stability_kinds import TwoSprings
    from garkcli.design.stable_values import StableValues
    from garkcli.design.stable_values import Wanted as Kind
    from garkcli.methodfile.family import FamilyFile
    from garkcli.tableau.family import Stability as Asked


@declared("design", FORMATS)
def command(
    file: str, settings: dict[str, str], choices: dict[str, str], output: Output, **options: Any
) -> int:
    """For which values of its free parameters a method has an order, exactly.

    A parameter is free by parameters: {tau: free}. The answer is every value, these values, a
    family of a dimension, or none, and then the tree whose condition cannot be met. Each value
    found goes through the certificate of gark check. Exit code 1: no value has the order of
    --order, or the stability that is asked for.

    With --search methods of the order are looked for by least squares from random starts. Each find
    is exact, its order proved by the certificate; proved to exist; or numerical, and then it is
    not proved. The same seed has the same finds everywhere. Exit code 3: nothing was found, which
    says nothing of what there is.
    """
    from garkcli.methodfile.family import load_family

    wanted = Wanted(**options)
    wanted.check()
    wanted = wanted.started()
    family = load_family(file, settings, wanted.moment)
    is_of_springs = wanted.slow is not None
    order = wanted.order or family.order
    asked = _asked(family, wanted)
    if asked is not None and (order is None or is_of_springs):
        wanted.check_stability()
        _refuse_unsettled(family)
        _refuse_other_wishes(family, asked, is_of_springs)
        return _stable_values(family, wanted, asked, output)
    family = _as_stable(family, asked)
    wanted.check_one_by_one([x.kind for x in family.stable])
    _prepare_places(wanted)
    if wanted.starts is not None:
        from garkcli.cli.searching import search

        _refuse_unsettled(family)
        return search(family, wanted, wanted.starts, output)
    chosen: list[Choice] = []
    if choices:
        with _half(wanted):
            known = _found(family, wanted)
            chosen = _walk(known, choices)
        family = load_family(file, {**settings, **choices}, wanted.moment)
        family = _as_stable(family, asked)
    return _told(file, family, chosen, wanted, output)


@contextmanager
def _half(wanted: Wanted) -> Iterator[None]:
    """Half of the time that is left, where there is work to come."""
    with until(wanted.moment):
        left = seconds_left()
        with within(None if left is None else left / 2):
            yield


def _asked(family: FamilyFile, wanted: Wanted) -> Asked | None:
    """The stability that an option asks for, if any.

    Raises:
        UsageProblem: there is no such colour.
    """
    from garkcli.tableau.family import Stability

    if wanted.stability is None:
        return None
    if wanted.colour is None:
        return Stability(wanted.stability)
    size = family.tableau.size
    if wanted.colour > size:
        message = f"--colour: no colour {wanted.colour}"
        raise UsageProblem(message, f"the method has {counted(size, 'colour')}", code="wrong-value")
    return Stability(wanted.stability, wanted.colour - 1)


def _refuse_unsettled(family: FamilyFile) -> None:
    """Refuse to look for methods by what was not worked out.

    Raises:
        UsageProblem: something was not.
    """
    for key in family.unsettled:
        message = f"what {key} under design asks was not worked out "
        message += "in the time of --seconds"
        raise UsageProblem(message, "give it more, or want less", code="not-found")


def _prepare_places(wanted: Wanted) -> None:
    """Refuse places that cannot be written to, before the work."""
    if wanted.emit is not None:
        from garkcli.page.writing import refuse_unwritable

        refuse_unwritable(wanted.emit)
    if wanted.emit_all is not None:
        from garkcli.cli.emitting import make_folder

        make_folder(wanted.emit_all)


def _refuse_other_wishes(family: FamilyFile, asked: Asked, is_of_springs: bool) -> None:
    """Refuse what a file wants that a set of values with one kind of stability leaves out.

    Raises:
        UsageProblem: an order, or another kind of stability.
    """
    wishes = [str(x) for x in family.stable if is_of_springs or x != asked]
    if family.order is not None:
        wishes.insert(0, f"order {family.order}")
    if not wishes:
        return
    message = f"under design the file wants {wishes[0]}, "
    if is_of_springs:
        message += "which is not looked at on two springs"
        raise UsageProblem(message, "leave it out of the file", code="options-clash")
    message += f"and --{asked.kind} gives the values of one kind"
    cure = "add --order P: solutions of an order have all that is wanted"
    raise UsageProblem(message, cure, code="options-clash")


def _as_stable(family: FamilyFile, asked: Asked | None) -> FamilyFile:
    """A family of which methods with a kind of stability are wanted, if any."""
    if asked is None or asked in family.stable:
        return family
    return replace(family, stable=(*family.stable, asked))


def _told(
    file: str, family: FamilyFile, chosen: list[Choice], wanted: Wanted, output: Output
) -> int:
    """Find the values, write the report and the files, and return the exit code."""
    from garkcli.methodfile.naming import called
    from garkcli.report.design import REPORT, DesignReport

    with _half(wanted) if wanted.objective is not None else until(wanted.moment):
        found = _found(family, wanted)
    order = wanted.order or family.order
    sets = _sets(found, wanted)
    stable = [None] if sets is None else [x.has_values for x in sets]
    is_reached = _all_of([found.reaches(order or 1), *stable])
    minimum = None
    has_rest = order is None or found.last.kind != "undecided"
    is_compared = wanted.objective is not None and is_reached is not False and has_rest
    if wanted.objective is not None and is_compared:
        from garkcli.cli.minimising import least

        with until(wanted.moment):
            minimum = least(found, wanted.objective)
    report = DesignReport(called(file), found, wanted.digits, chosen, minimum, sets or ())
    output.tell(REPORT, [report])
    if is_compared and minimum is None:
        return _exit_code(None)
    _emit(family, found, minimum, wanted, output)
    return _exit_code(None if found.last.kind == "undecided" else is_reached)


def _found(family: FamilyFile, wanted: Wanted) -> Design:
    """For which values the method has the order."""
    from garkcli.design.design import find_parameters

    return find_parameters(family, wanted.order, wanted.whose)


def _sets(found: Design, wanted: Wanted) -> tuple[StableValues, ...] | None:
    """The values that are as stable as is wanted, where all have the order; None, and it is said,
    where they take too long.
    """
    from garkcli.design.stable_values import stable_sets

    try:
        with until(wanted.moment):
            return stable_sets(found)
    except NotDecided as error:
        say_problem(error)
        return None


def _walk(known: Design, choices: Mapping[str, str]) -> list[Choice]:
    """What each value of --choose leaves.

    Raises:
        UsageProblem: a choice is none, leaves no unknown, or leaves what is not decided in time.
    """
    from garkcli.design.choices import walk_down

    unknowns = known.family.parameters
    values = {}
    for name, text in choices.items():
        if name not in unknowns:
            cure = did_you_mean(name, list(unknowns))
            raise UsageProblem(f"--choose: no unknown {name!r}", cure, code="option-value")
        values[name] = text, _chosen_value(name, text)
    if len(values) == len(unknowns):
        message = "--choose leaves no unknown"
        cure = "gark check with --set judges one method"
        raise UsageProblem(message, cure, code="options-clash")
    try:
        return walk_down(known, values)
    except NotDecided:
        message = "--choose: what is left is not decided "
        message += "in the time of --seconds"
        raise UsageProblem(message, "choose with --set", code="not-found") from None


def _chosen_value(name: str, text: str) -> fmpq:
    """The rational number that --choose gives an unknown."""
    from garkcli.exact.domain import Domain
    from garkcli.exact.expression import parse
    from garkcli.exact.field import Algebraic

    try:
        expression = parse(text)
        value = Domain([expression]).evaluate(expression)
    except ExpressionError as error:
        message = f"--choose {name}: {error.message}"
        raise UsageProblem(message, error.help, code="option-value") from None
    if isinstance(value, Algebraic):
        message = f"--choose {name}: a rational number is expected"
        raise UsageProblem(message, "--set takes radicals", code="option-value")
    return value


def _stable_values(family: FamilyFile, wanted: Wanted, asked: Asked, output: Output) -> int:
    """The set of values with a kind of stability."""
    from garkcli.design.stable_values import stable_values
    from garkcli.report.stable_values import REPORT, StableReport

    two_springs = _two_springs(family, wanted)
    kind = cast("Kind", asked.kind)
    try:
        with until(wanted.moment):
            found = stable_values(family, kind, wanted.whose, two_springs, asked.colour)
    except NotDecided as error:
        say_problem(error)
        return _exit_code(None)
    output.tell(REPORT, [StableReport(family.source, found, wanted.digits)])
    return _exit_code(found.has_values)


def _two_springs(family: FamilyFile, wanted: Wanted) -> TwoSprings | None:
    """The springs that the options mean, if any.

    Raises:
        UsageProblem: a number is none or negative, or there is no such colour.
    """
    if wanted.slow is None or wanted.fast is None:
        return None
    from garkcli.cli.stepping import colour_named, square
    from garkcli.design.design import TABLEAUS
    from garkcli.design.stability_kinds import TwoSprings

    tableau = TABLEAUS[wanted.whose](family.tableau)
    slow = square("--slow", wanted.slow)
    fast = tableau.colours[colour_named(tableau, wanted.fast)].term
    if wanted.up_to is None:
        return TwoSprings(slow, fast)
    return TwoSprings(slow, fast, square("--up-to", wanted.up_to))


def _emit(
    family: FamilyFile, found: Design, minimum: Minimum | None, wanted: Wanted, output: Output
) -> None:
    """Write the best method, or those among the solutions."""
    if wanted.emit is not None and minimum is not None:
        from garkcli.cli.minimising import emit

        emit(family, minimum, wanted.emit)
        return
    from garkcli.cli import emitting

    if wanted.emit is not None:
        emitting.emit(family, found, wanted.emit)
    if wanted.emit_all is not None:
        emitting.emit_all(family, found, wanted.emit_all, output)


def _exit_code(is_reached: bool | None) -> int:
    """What cannot be decided is no fault of the file: 3, as what could not be done."""
    if is_reached is None:
        return 3
    return 0 if is_reached else 1


def _all_of(answers: Iterable[bool | None]) -> bool | None:
    """Whether all is so; None where that is not decided."""
    known = list(answers)
    return False if False in known else None if None in known else True
