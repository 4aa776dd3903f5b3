"""``gark design`` and ``gark sweep``: the search for methods."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cached_property
from itertools import count, islice
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any, TypeVar

from garkcli.cli import options as opt
from garkcli.cli.arguments import rational, square
from garkcli.cli.command import declared
from garkcli.cli.output import Output
from garkcli.cli.streams import INTERRUPTED, say_problem
from garkcli.crew.work import WorkerLost, Workers
from garkcli.deadline import seconds_left, until, within
from garkcli.doing import doing
from garkcli.ending import undone
from garkcli.errors import MethodError, NotDecided, UsageProblem, counted, did_you_mean
from garkcli.files import STDIN
from garkcli.frozen import replace
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.api.design import FoundFile
    from garkcli.design.choices import Choice
    from garkcli.design.design import Design
    from garkcli.design.member import Whose
    from garkcli.design.minimise.result import Minimum
    from garkcli.design.search.curve import OptimaCurve
    from garkcli.design.search.run import SearchResult, SearchTask, Timed
    from garkcli.design.stable_values import StableValues, Wanted
    from garkcli.design.within import DesignWithin
    from garkcli.methodfile.family import FamilyFile
    from garkcli.methodfile.search_file import FileSearch
    from garkcli.tableau.family import RequiredStability

AnyResult = TypeVar("AnyResult", "SearchResult", "OptimaCurve")
_STANDARD_INPUT = {STDIN, "<stdin>"}
_PLOT = "--plot draws the stable values of two parameters"
PROOFS = ("exact", "exists", "numerical")
"""The most certain first."""


SECONDS = 60.0
_STABLE = "stable_values.wanted"


class DesignOptions(opt.Derivable):
    file: str = opt.argument("FILE", opt.METHOD)
    order: int | None = opt.option(
        "--order", opt.number("P", 1, 60), of="find_parameters.order", heading="Wanted"
    )
    minimise: str | None = opt.option("--minimise", opt.text("WHAT"), of="minimise.objective")
    choose: Mapping[str, str] = opt.always(
        "--choose", opt.SETTINGS, "Like --set, and show the values that remain; repeatable."
    )
    seconds: float | None = opt.option(
        "--seconds",
        opt.SECONDS,
        "Seconds after which the rest stays undecided, or a search ends; "
        f"{SECONDS:.0f} by default, of a search none.",
        of="find_parameters.seconds",
    )
    stability: Wanted | None = opt.either(
        opt.flag_of(
            "p-stable",
            "The exact set of values of the parameters for which the method is P-stable.",
            of=_STABLE,
        ),
        opt.flag_of("i-stable", "The same for I-stability.", of=_STABLE),
        opt.flag_of("a-stable", "The same for A-stability.", of=_STABLE),
        opt.flag_of("l-stable", "The same for L-stability.", of=_STABLE),
        heading="Stable values",
    )
    colour: int | None = opt.option(
        "--colour",
        opt.number("N", 1),
        "With --a-stable or --l-stable: for colour N alone, instead of one λ for all.",
        of="stable_values.colour",
    )
    slow: fmpq | None = opt.option(
        "--slow",
        opt.read("A", square),
        "With --p-stable or --i-stable: a slow and a fast spring, the slow one of (hω)² = A.",
        of="stable_values.slow",
    )
    fast: str | None = opt.FAST
    up_to: fmpq | None = opt.option(
        "--up-to",
        opt.read("X", square),
        "With --slow: fast springs of (hω)² up to X only.",
        of="stable_values.up_to",
    )
    search: int | None = opt.option(
        "--search",
        opt.hidden_default(opt.number("N", 1, 10_000_000)),
        "Search from N random starts instead, and prove the finds; with --minimise the best one.",
        of="search_methods.starts",
        heading="Search",
    )
    most: int | None = opt.option(
        "--most",
        opt.hidden_default(opt.number("K", 1, 100_000)),
        "With --search: the most methods to find; by default 5, with --minimise the best one.",
        of="search_methods.most",
    )
    front: tuple[str, str] | None = opt.option(
        "--front",
        opt.TWO,
        "With --search: the front of two objectives, the best A for bounds on B, in place of "
        "methods.",
    )
    along: str | None = opt.option(
        "--along",
        opt.text("NAME"),
        "With --search and --minimise: the optimum for values of an unknown, in place of methods.",
    )
    start: str | None = opt.option(
        "--start",
        opt.text("METHOD"),
        "With --search: begin at a method of the same sizes; the other starts are random.",
    )
    seed: int | None = opt.option(
        "--seed",
        opt.hidden_default(opt.number("N", 0)),
        "With --search: the seed of the starts; 0 by default.",
        of="search_methods.seed",
    )
    jobs: int | None = opt.option(
        "-j --jobs",
        opt.workers(1000),
        "With --search: the number of processes; 0 is one per processor.",
    )
    scheduler: str | None = opt.option(
        "--scheduler",
        opt.text("ADDRESS"),
        "With --search: work on the Dask cluster there; needs garkcli[cluster].",
    )
    digits: int = opt.preset(
        "--digits", opt.DECIMALS, 12, "Digits of numbers without simple radicals.", heading="Output"
    )
    emit: str | None = opt.option(
        "--emit", opt.file("yaml"), "Write the first method into a file, with its claim."
    )
    folder: str | None = opt.OUTPUT_DIR
    plot: str | None = opt.option("--plot", opt.PICTURE, opt.PLOT_HELP)
    being_springs = opt.being(stability, "p-stable"), opt.being(stability, "i-stable")
    rules = (
        opt.needs(
            (start, seed, most, jobs, scheduler, front, along),
            search,
            "OPTION goes with --search",
            "add --search N",
        ),
        opt.needs(along, minimise, "--along goes with --minimise", "add --minimise WHAT"),
        opt.excludes(
            (front, along),
            (emit, folder, most, start),
            "OPTION has no methods but optima in floats",
            "--set an unknown and --minimise prove one of them",
        ),
        opt.needs(
            opt.being(opt.FORMAT, "csv"),
            (front, along),
            "CSV has a line a point of a curve",
            "add --front or --along",
        ),
        opt.excludes(
            front,
            (minimise, along),
            "--front names two objectives",
            "leave --minimise and --along out",
        ),
        *opt.of_springs(slow),
        opt.needs(
            up_to,
            slow,
            "--up-to is a bound for the fast one of two springs",
            "give --slow and --fast too",
        ),
        opt.needs(slow, being_springs, "--slow and --fast say on which springs", "add --p-stable"),
        opt.excludes(
            slow, order, "two springs give a set of values, --order does not", "ask for one"
        ),
        opt.needs(
            colour,
            (opt.being(stability, "a-stable"), opt.being(stability, "l-stable")),
            "--colour goes with --a-stable and --l-stable",
            "add one of them",
        ),
    )

    @property
    def whose(self) -> Whose:
        return self.which or "method"

    @cached_property
    def moment(self) -> float | None:
        """The clock when the time is over, counted from the first look at it."""
        seconds = SECONDS if self.seconds is None and self.search is None else self.seconds
        return None if seconds is None else monotonic() + seconds

    def order_of(self, family: FamilyFile) -> int | None:
        return self.order or family.order


@declared("design", DesignOptions, [*FORMATS, "csv"])
def design(given: DesignOptions, output: Output) -> int:
    """The values of the free parameters for which a method has an order, exactly.

    parameters: {tau: free} makes a parameter free. The answer is every value, finitely many, a
    family of some dimension, or none, with the tree whose condition cannot be met. Each value
    passes the certificate of gark check.

    --search looks for methods from random starts by least squares. A method found is exact with its
    order proved, proved to exist, or numerical and not proved. The same seed gives the same methods
    everywhere.

    Exit code: 1 no value has the wanted order or stability, 3 a search found nothing, which
    proves nothing.
    """
    from garkcli.design.member import refuse_levels
    from garkcli.design.minimise.sums import refuse
    from garkcli.methodfile.family import load_family

    moment = given.moment  # the time begins
    is_free = given.minimise is None or given.search is not None
    if given.folder is not None and not is_free:
        message = "--minimise finds one method, --output-dir writes several"
        raise UsageProblem(message, "--emit FILE writes the one", code="options-clash")
    if given.minimise is not None:
        refuse(given.minimise, is_search=given.search is not None)  # before any work
    for one in given.front or ():
        refuse(one, is_search=True)
    family = load_family(given.file, given.settings, moment, is_free)
    is_of_springs = given.slow is not None
    _refuse_rounded(family, given)
    if given.search is None:
        refuse_levels(family)
    asked = _required_stability(family, given)
    if asked is not None and (given.order_of(family) is None or is_of_springs):
        _check_stability(given)
        _refuse_unsettled(family)
        _refuse_other_wishes(family, asked, is_of_springs)
        return _stable_values(family, given, output)
    is_curve = given.front is not None or given.along is not None
    if given.plot is not None and not is_curve:
        raise UsageProblem(_PLOT, "ask for --a-stable alone", code="option-alone")
    family = _as_stable(family, asked)
    output.check_place(given.emit)
    if given.folder is not None:
        make_folder(given.folder)
    if family.tolerance is not None:
        return _within(family, given, output)
    if given.search is not None:
        _refuse_unsettled(family)
        return (_curve if is_curve else _search)(family, given.search, given, output)
    chosen: list[Choice] = []
    if given.choose:
        with _half(given):
            chosen = _walk(_design(family, given), given.choose)
        settings = {**given.settings, **given.choose}
        family = load_family(given.file, settings, moment, is_free)
        family = _as_stable(family, asked)
    return _run(family, chosen, given, output)


def _refuse_rounded(family: FamilyFile, given: DesignOptions) -> None:
    """UsageProblem if an option needs exact coefficients that the file does not have."""
    if family.tolerance is None:
        return
    asked = {
        f"--{given.stability}": given.stability,
        "--search": given.search,
        "--minimise": given.minimise,
        "--choose": given.choose,
    }
    for option in (name for name, value in asked.items() if value):
        message = f"{option} needs exact coefficients, and those of the file are rounded"
        cure = "write radicals and fractions; gark design alone finds values within the tolerance"
        raise UsageProblem(message, cure, code="rounded")


def _within(family: FamilyFile, given: DesignOptions, output: Output) -> int:
    from garkcli.api.design import find_parameters
    from garkcli.design.within import DesignWithin
    from garkcli.methodfile.naming import called
    from garkcli.report.design_within import REPORT, WithinReport

    with until(given.moment):
        found = find_parameters(family, given.order_of(family), given.whose)
    assert isinstance(found, DesignWithin)
    output.tell(REPORT, WithinReport(called(given.file), found))
    is_reached = found.reaches(given.order_of(family) or 1)
    if found.best is not None:
        _emit(found, family, given, output)
    return EXIT_CODES[None if is_reached and family.stable else is_reached]


def _check_stability(given: DesignOptions) -> None:
    """UsageProblem for options that a set of values excludes: files or a search."""
    others = (given.emit, given.folder, given.search, given.minimise)
    if all(option is None for option in others):
        return
    message = (
        f"--{given.stability} gives a set of values; --emit, --search and --minimise give methods"
    )
    cure = "use one; --order limits it to the solutions of that order"
    raise UsageProblem(message, cure, code="options-clash")


@contextmanager
def _half(given: DesignOptions) -> Iterator[None]:
    """Limits the time to half of what is left, as more work follows."""
    with until(given.moment):
        left = seconds_left()
        with within(None if left is None else left / 2):
            yield


def _wishes(given: DesignOptions) -> str:
    colour = "" if given.colour is None else f" --colour {given.colour}"
    return "" if given.stability is None else f" --{given.stability}{colour}"


def _required_stability(family: FamilyFile, given: DesignOptions) -> RequiredStability | None:
    from garkcli.tableau.family import RequiredStability

    if given.stability is None:
        return None
    if given.colour is None:
        return RequiredStability(given.stability)
    size = family.on_linear_problems.tableau.size
    if given.colour > size:
        message = f"--colour: no colour {given.colour}"
        raise UsageProblem(message, f"the method has {counted(size, 'colour')}", code="wrong-value")
    return RequiredStability(given.stability, given.colour - 1)


def _refuse_unsettled(family: FamilyFile) -> None:
    """UsageProblem if a demand of the file was not worked out in time."""
    for key in family.unsettled:
        message = f"the demand {key} under design was not worked out within --seconds"
        raise UsageProblem(message, "give it more time, or demand less", code="not-found")


def make_folder(path: str) -> None:
    if not path:
        raise UsageProblem("the name of the folder is empty", "name a folder", code="cannot-write")
    try:
        Path(path).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        message = f"cannot make the folder {path}: {error.strerror}"
        raise UsageProblem(message, "choose another place", code="cannot-write") from None


def _refuse_other_wishes(family: FamilyFile, asked: RequiredStability, is_of_springs: bool) -> None:
    """UsageProblem for demands of the file that a set of stable values ignores."""
    wishes = [str(x) for x in family.stable if is_of_springs or x != asked]
    if family.order is not None:
        wishes.insert(0, f"order {family.order}")
    if not wishes:
        return
    message = f"under design the file wants {wishes[0]}, "
    if is_of_springs:
        message += "which is ignored on two springs"
        raise UsageProblem(message, "leave it out of the file", code="options-clash")
    message += f"and --{asked.kind} gives the values of one kind"
    cure = "add --order P: solutions of an order have all that is wanted"
    raise UsageProblem(message, cure, code="options-clash")


def _as_stable(family: FamilyFile, asked: RequiredStability | None) -> FamilyFile:
    if asked is None or asked in family.stable:
        return family
    return replace(family, stable=(*family.stable, asked))


def _run(family: FamilyFile, chosen: list[Choice], given: DesignOptions, output: Output) -> int:
    from garkcli.methodfile.naming import called
    from garkcli.report.design import REPORT, DesignReport

    with _half(given) if given.minimise is not None else until(given.moment):
        found = _design(family, given)
    sets = _sets(found, given)
    stable = [None] if sets is None else [x.has_values for x in sets]
    answers = [found.reaches(given.order_of(family) or 1), *stable]
    is_reached = False if False in answers else None if None in answers else True
    minimum = None
    has_rest = given.order_of(family) is None or found.last.kind != "undecided"
    is_compared = given.minimise is not None and is_reached is not False and has_rest
    if given.minimise is not None and is_compared:
        minimum = _least(found, given.minimise, given)
    report = DesignReport(called(given.file), found, given.digits, chosen, minimum, sets or ())
    output.tell(REPORT, report)
    if is_compared and minimum is None:
        return EXIT_CODES[None]
    _emit(found if minimum is None else minimum, family, given, output)
    return EXIT_CODES[None if found.last.kind == "undecided" else is_reached]


def _design(family: FamilyFile, given: DesignOptions) -> Design:
    from garkcli.design.design import find_parameters

    return find_parameters(family, given.order_of(family), given.whose)


def _least(found: Design, objective: str, given: DesignOptions) -> Minimum | None:
    from garkcli.api.design import minimise

    try:
        with until(given.moment):
            return minimise(found, objective)
    except NotDecided as error:
        about, cure = "the solution set is too large or curved", ""
        if error.is_late:
            about, cure = "in the time of --seconds", "give it more, or "
        message = f"--minimise {objective}: not decided, {about}"
        cure += "choose values for some unknowns with --choose"
        say_problem(UsageProblem(message, cure, code="not-found"))
        return None


def _sets(found: Design, given: DesignOptions) -> tuple[StableValues, ...] | None:
    from garkcli.design.design import stable_sets

    try:
        with until(given.moment):
            return stable_sets(found)
    except NotDecided as error:
        say_problem(error)
        return None


def _walk(known: Design, choices: Mapping[str, str]) -> list[Choice]:
    """UsageProblem if a choice is not valid, leaves no unknown, or is not decided in time."""
    from garkcli.design.choices import walk_down

    unknowns = known.family.parameters
    values = {}
    for name, text in choices.items():
        if name not in unknowns:
            cure = did_you_mean(name, list(unknowns))
            raise UsageProblem(f"--choose: no unknown {name!r}", cure, code="option-value")
        values[name] = text, rational(f"--choose {name}", text, "--set takes radicals")
    if len(values) == len(unknowns):
        message = "--choose leaves no unknown"
        cure = "gark check with --set judges one method"
        raise UsageProblem(message, cure, code="options-clash")
    try:
        return walk_down(known, values)
    except NotDecided as error:
        message = f"--choose: the rest is {error.message}"
        raise UsageProblem(message, "choose with --set", code="not-found") from None


def _stable_values(family: FamilyFile, given: DesignOptions, output: Output) -> int:
    from garkcli.api.design import stable_values
    from garkcli.cli.stability import colour_named
    from garkcli.design.member import TABLEAUS
    from garkcli.report.stable_values import REPORT, StableReport

    asked = given.of("stable_values")
    if given.fast is not None:
        asked["fast"] = colour_named(TABLEAUS[given.whose](family.tableau), given.fast)
    try:
        with until(given.moment):
            found = stable_values(family, whose=given.whose, **asked)
    except NotDecided as error:
        say_problem(error)
        return EXIT_CODES[None]
    if given.plot is not None:
        from garkcli.plots.curves import stable_plane_scene

        if not found.is_plane:
            raise UsageProblem(_PLOT, "free a second parameter", code="option-alone")
        output.save_plot(stable_plane_scene(found, family.name), given.plot)
    output.tell(REPORT, StableReport(family.source, found, given.digits))
    return EXIT_CODES[found.has_values]


def _emit(
    found: Design | DesignWithin | Minimum, family: FamilyFile, given: DesignOptions, output: Output
) -> None:
    """UsageProblem if there is no method, MethodError if a file cannot hold its values."""
    if given.emit is None and given.folder is None:
        return
    from garkcli.api.design import found_files
    from garkcli.design.minimise.result import Minimum

    files = list(found_files(found, family, _wishes(given)))
    if not files and isinstance(found, Minimum):
        message = f"--emit: no method has the infimum of {given.minimise}"
        cure = "a range for the parameter, closed at its ends, has a minimum"
        raise UsageProblem(message, cure, code="not-found")
    if not files:
        message = "there is no single method to be written: no order has finitely many"
        cure = "choose values with --set, or ask for a higher order"
        if given.emit is not None and given.minimise is None and family.tolerance is None:
            cure += "; or let --minimise error choose one"
        raise UsageProblem(message, cure, code="not-found")
    if given.emit is not None:
        output.save(given.emit, [files[0].text])
    if given.folder is not None:
        names = file_names(given.folder, family.source)
        for number, file in enumerate(files, start=1):
            path = next(names)
            try:
                text = file.text
            except MethodError as error:
                output.note(f"solution {number} is not written: {error.message}")
                continue
            output.save(path, [text])


def file_names(folder: str, source: str) -> Iterator[str]:
    stem = "" if source in _STANDARD_INPUT else Path(source).name.split(".")[0]
    return (str(Path(folder, f"{stem or 'method'}-{k}.gark.yaml")) for k in count(1))


EXIT_CODES = {True: 0, False: 1, None: 3}
"""An undecided question is not an error of the file."""


def _search(family: FamilyFile, starts: int, given: DesignOptions, output: Output) -> int:
    from garkcli.methodfile.search_file import FileSearch
    from garkcli.report.search import REPORT, SearchReport

    asked = FileSearch.of(family, _order(family, given), given.whose, given.minimise)
    result, ended = _searched(asked, starts, given)
    files = _written(family, result, given, output)
    output.tell(REPORT, SearchReport(family.source, asked.search, result, files, given.start))
    if ended is not None:
        return ended
    # that nothing was found says nothing of what there is
    return 0 if result.methods else 3


def _curve(family: FamilyFile, starts: int, given: DesignOptions, output: Output) -> int:
    from garkcli.design.search.curve import OptimaCurve, along, front
    from garkcli.methodfile.search_file import FileSearch
    from garkcli.report.design_curve import REPORT, CurveReport

    order = _order(family, given)
    first, second = given.front or (given.minimise or "", "")
    asked = FileSearch.of(family, order, given.whose, first)
    curve = OptimaCurve(first, second, given.front is not None, order, given.seed or 0)

    def steps(workers: Workers[SearchTask, Timed]) -> Iterator[OptimaCurve]:
        rest = starts, given.seed or 0, workers
        if given.along is not None:
            return along(asked.search, given.along, *rest)
        return front(asked.search, second, *rest)

    with doing("starts", starts) as work:

        def show(found: OptimaCurve) -> None:
            work.what = f"{len(found.knots)} points, starts"
            work.reach(found.starts)

        curve, ended = _worked(asked, given, steps, curve, show)
    report = CurveReport(family.source, asked.search, curve)
    if given.plot is not None and curve.knots:
        from garkcli.plots.curves import curve_scene

        output.save_plot(curve_scene(curve, family.name), given.plot)
    output.tell(REPORT, report)
    if ended is not None:
        return ended
    return 0 if curve.knots else 3


def _order(family: FamilyFile, given: DesignOptions) -> int:
    order = given.order_of(family)
    if order is None:
        cure = "give --order P, or design: {order: P} in the file"
        raise UsageProblem("a search is for an order", cure, code="option-alone")
    return order


def _searched(
    asked: FileSearch, starts: int, given: DesignOptions
) -> tuple[SearchResult, int | None]:
    """The exit code is of an interrupt or a lost worker, not of the end of the time."""
    from garkcli.design.search.run import MOST, SearchResult, results

    most = given.most or (MOST if given.minimise is None else 1)
    first = None if given.start is None else _first(asked, given.start)

    def steps(workers: Workers[SearchTask, Timed]) -> Iterator[SearchResult]:
        return results(asked.search, starts, given.seed or 0, most, workers, first)

    with doing("starts", starts) as work:

        def show(found: SearchResult) -> None:
            work.what = f"{len(found.methods)} methods found, starts"
            work.reach(found.starts)

        return _worked(asked, given, steps, SearchResult(), show)


def _first(asked: FileSearch, name: str) -> list[float]:
    from garkcli.design.search.nearest import nearest_member
    from garkcli.methodfile.load import load

    method = load(name)
    return nearest_member(asked.family, method.tableau, method.further)


def _worked(
    asked: FileSearch,
    given: DesignOptions,
    steps: Callable[[Workers[SearchTask, Timed]], Iterator[AnyResult]],
    found: AnyResult,
    show: Callable[[AnyResult], None],
) -> tuple[AnyResult, int | None]:
    from garkcli.crew.hiring import hired

    with undone():
        try:
            place = given.jobs or 1, given.scheduler or ""
            with until(given.moment), hired(asked.do, _lost, *place) as workers:
                for found in steps(workers):
                    show(found)
        except KeyboardInterrupt:
            found.ending = "interrupt"
            return found, INTERRUPTED
        except NotDecided:
            found.ending = "time"
        except WorkerLost as error:
            say_problem(error)
            found.ending = "worker"
            return found, 3
    return found, None


def _lost(_task: SearchTask, why: str) -> Timed:
    message = f"a process of the search was ended {why}"
    raise WorkerLost(message, "where memory is short use fewer --jobs")


def _written(
    family: FamilyFile, result: SearchResult, given: DesignOptions, output: Output
) -> Sequence[str | None]:
    from garkcli.api.design import found_files

    found = list(found_files(result, family, _wishes(given)))
    files: list[str | None] = [None] * len(found)
    if given.folder is not None:
        files = list(islice(file_names(given.folder, family.source), len(found)))
    best = min(found, key=_proof, default=None)
    for place, method in enumerate(found):
        for path in (files[place], given.emit if method is best else None):
            if path is not None:
                output.save(path, [method.text])
                files[place] = files[place] or path
    return files


def _proof(found: FoundFile) -> int:
    member: Any = found.member
    return PROOFS.index(member.proof)


class Sweep(opt.Options):
    spec: str = opt.argument("SPEC", opt.INPUT)
    rows: str | None = opt.option(
        "--rows",
        opt.file("jsonl"),
        "The file of rows, a line of JSON each; by default SPEC with .jsonl.",
        of="run_sweep.rows",
        heading="Run",
    )
    resume: bool = opt.flag(
        "--resume", "Continue: add the missing rows.", of="run_sweep.is_resumed"
    )
    jobs: int | None = opt.option("-j --jobs", opt.workers(60), opt.JOBS_HELP, of="run_sweep.jobs")
    scheduler: str | None = opt.option("--scheduler", opt.text("ADDRESS"), of="run_sweep.scheduler")
    top: int = opt.preset(
        "--top",
        opt.number("N", 1),
        10,
        "Show the N best, or first if the file names no best; CSV and JSON lines have all.",
        heading="Output",
    )
    parquet: str | None = opt.option(
        "--parquet",
        opt.file("parquet"),
        "Write the kept methods as Parquet too; needs garkcli[parquet].",
    )
    plot: str | None = opt.option("--plot", opt.PICTURE, opt.PLOT_HELP)


@declared("sweep", Sweep, [*FORMATS, "jsonl", "csv"], has_catalogue=True)
def sweep(given: Sweep, output: Output) -> None:
    """Many methods side by side: families, stages, transfer rules, values of parameters.

    SPEC names the methods, the criteria, which methods to keep and which are better; see
    docs/sweep.md. Each criterion is decided exactly. Rows are written one by one, and --resume
    continues an interrupted sweep.
    """
    from garkcli.report.calls import swept
    from garkcli.report.sweep import REPORT, json_lines, refuse_parquet, write_parquet
    from garkcli.sweep.file import load_plan

    plan = load_plan(given.spec)
    if given.plot is not None and len(plan.pareto) < 2:
        message = "--plot needs two columns"
        cure = "write pareto: [error, stages] into the spec"
        raise UsageProblem(message, cure, code="option-alone")
    if given.parquet is not None:
        refuse_parquet(given.parquet)
    asked = {"rows": str(Path(given.spec).with_suffix(".jsonl")), **given.of("run_sweep")}
    report, last = swept(plan, given.spec, **asked)
    report = replace(report, top=given.top)
    before = f", {last.before} were there" if last.before else ""
    output.note(f"{last.done} rows added to {asked['rows']}{before}")
    if output.verbosity > 0:
        output.note(f"processor time of the methods: {last.seconds:.2f} s")
    output.verbosity = max(output.verbosity, 0)  # what -q leaves out is on stderr
    if output.format == "jsonl":
        output.write(json_lines(report))
    else:
        output.tell(REPORT, report)
    if given.parquet is not None:
        write_parquet(report, given.parquet)
        output.note(f"wrote {given.parquet}")
    if given.plot is not None:
        from garkcli.plots.curves import sweep_scene

        output.save_plot(sweep_scene(report), given.plot)
