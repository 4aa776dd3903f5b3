"""Information: ``gark list``, ``show``, ``explain``, ``report``, ``schema``."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from garkcli.cli import options as opt
from garkcli.cli.command import GroupedOption, declared
from garkcli.cli.output import Output
from garkcli.cli.streams import say_faults
from garkcli.doing import counting
from garkcli.errors import HasFreeParameters, MethodFileError, UsageProblem, did_you_mean
from garkcli.files import NotAFile, begin_of, is_stream
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.catalogue.facts import Entry
    from garkcli.tableau.garkmethod import GarkMethod

_COUNTS = {
    "order": "The order; a RANGE is 4, '>=4' or 2..4.",
    "embedded-order": "The order of embedded weights.",
    "conjugate-order": "The order of the symplectic conjugate.",
    "pair-order": "The order of the symplectic pair.",
    "nonautonomous-order": "The order for y' = f(t, y), with the printed nodes.",
    "w-order": "The order with any matrix for the Jacobian.",
    "index-1-order": "The order on index-1 DAEs.",
    "stages": "The stages; with several colours the largest number.",
    "colours": "The vector fields.",
}
_TRUTHS = {
    "symplectic": "Symplectic methods.",
    "embedded": "Methods with embedded weights.",
    "dense": "Methods with dense output.",
    "exact": "Methods whose coefficients are not rounded.",
}
LISTS = ("families", "transfer", "schemes", "splittings", "problems")


class Explain(opt.Options):
    words: tuple[str, ...] = opt.arguments_of(
        "[WORD...]", opt.completed("WORD", "check.meanings:known_words")
    )


@declared("explain", Explain, FORMATS)
def explain(given: Explain, output: Output) -> None:
    """The meaning of a word in a report or a file: definition, formula, source.

    WORD is a term such as density or "stage order", a line of a report, a claim, a key of a file
    such as compose.steps, a family, a transfer rule, a problem, or the code or message of an error.
    Without WORD gark lists the terms.
    """
    from garkcli.report.meaning import REPORT, every_term, list_text

    if given.words:
        tell_meaning(" ".join(given.words), output)
    elif output.format == "text":
        output.write(list_text(output.width))
    else:
        output.tell(REPORT, *every_term())


def tell_meaning(word: str, output: Output) -> None:
    from garkcli.check.meanings import explain
    from garkcli.report.meaning import REPORT, told

    output.tell(REPORT, *told(word, explain(word)))


class RangeType(click.ParamType):  # type: ignore[type-arg]
    name = "range"

    def convert(
        self, value: object, param: click.Parameter | None, ctx: click.Context | None
    ) -> object:
        from garkcli.catalogue.entries import read_range

        try:
            return read_range(value) if isinstance(value, str) else value
        except UsageProblem as error:
            self.fail(f"{error.message}\nhelp: {error.help}", param, ctx)


def _filters() -> list[click.Option]:
    from garkcli.catalogue.entries import ORDERS
    from garkcli.properties.subject import every_property
    from garkcli.report.methods import BY_KIND, KEYS_OF_KINDS

    counts, truths = {**_COUNTS}, {**_TRUTHS}
    for x in every_property():
        if x.kind in ("count", "truth"):
            (counts if x.kind == "count" else truths).setdefault(x.key, "")
    kinds = ", ".join(f"{word} ({kind})" for kind, word in BY_KIND.items())
    of_kind = click.Choice([*BY_KIND, *KEYS_OF_KINDS])
    told = f"{kinds}, or the key of their files."
    return [
        _filter("--kind", _METHODS, told, type=of_kind, metavar="KIND", callback=_kind),
        _filter("--structure", _METHODS, _STRUCTURE, metavar="WORD"),
        _filter("--folder", _METHODS, _FOLDER, metavar="NAME"),
        _filter("--judge", _METHODS, _JUDGING, is_flag=True, default=None),
        *(_filter(f"--{key}", _ORDERS, help, type=RangeType()) for key, help in counts.items()),
        *(_filter(f"--{x}/--no-{x}", _PROPERTIES, y, default=None) for x, y in truths.items()),
        _filter("--sort", "Output", _SORT, type=click.Choice(ORDERS)),
    ]


def _kind(_: click.Context, __: click.Parameter, word: str | None) -> str | None:
    from garkcli.report.methods import KEYS_OF_KINDS

    return None if word is None else KEYS_OF_KINDS.get(word, word)


def _filter(flag: str, heading: str, help: str, **settings: Any) -> GroupedOption:
    return GroupedOption([flag], heading, help=help or None, **settings)


_METHODS, _ORDERS, _PROPERTIES = "Methods", "Orders and sizes", "Properties"
_STRUCTURE = "Which vector fields the problem has: general, separable, nystrom ..."
_FOLDER = "A folder of the catalogue, such as erk."
_JUDGING = "Judge your own methods as gark check does, instead of taking their claims."
_SORT = "The column by which the list is sorted; by default the order."


class ListOptions(opt.Options):
    what: str | None = opt.maybe_argument(
        "WHAT", opt.Kind({"type": click.Choice(["methods", *LISTS, "exports"])})
    )
    words: tuple[str, ...] = opt.arguments_of("[WORD...]", opt.Kind({}))
    filters: Mapping[str, Any] = opt.bundle(_filters)


@declared("list", ListOptions, (*FORMATS, "csv"), has_catalogue=True)
def list_(given: ListOptions, output: Output) -> None:
    """Families of diagonal methods, transfer rules, schemes of compositions, problems; or WHAT:
    one of these lists; methods, those of the catalogue; or exports, the targets of gark export.

    Without options gark counts the methods by kind. It lists a method if every option holds and its
    name, an alias, its title or its reference has every WORD; --no-... selects methods without the
    property, if that is known.
    """
    from garkcli.report import listing, methods

    filters = {**given.filters, "words": given.words}
    wanted = {key: value for key, value in filters.items() if value not in (None, ())}
    if given.what == "methods":
        found = _listed(filters)
        if wanted or output.format != "text" or output.verbosity:
            output.tell(methods.REPORT, found)
        else:
            output.write("\n".join([*methods.by_kind(found, output.width), ""]))
        return
    for key in wanted:
        name = "WORD" if key == "words" else f"--{key.replace('_', '-')}"
        message = f"{name} is for methods"
        raise UsageProblem(message, "write gark list methods", code="options-clash")
    if output.format == "csv":
        message = "--format csv is for methods"
        raise UsageProblem(message, "write gark list methods", code="options-clash")
    if given.what == "exports":
        output.tell(listing.EXPORTS, listing.all_targets())
    else:
        one = listing.only(given.what) if given.what else listing.REPORT
        output.tell(one, listing.all_lists())


def _listed(given: Mapping[str, Any]) -> list[Entry]:
    from garkcli.catalogue.entries import MethodFilter, all_entries, sorted_by

    others = ("judge", "sort", "folder", "words")
    values = {key: x for key, x in given.items() if key not in others and x not in (None, "")}
    wanted = MethodFilter(values, given["folder"] or "", given["words"])
    entries = list(all_entries(bool(given["judge"])))
    for key in ("folder", "structure"):
        known = sorted({x[key] for x in entries if x[key]})
        if given[key] and given[key] not in known:
            message = f"--{key} {given[key]}: no method of the catalogue has it"
            raise UsageProblem(message, did_you_mean(given[key], known), code="option-value")
    return sorted_by([x for x in entries if wanted.takes(x)], given["sort"] or "order")


BIBTEX = "bibtex"


class Show(opt.WithSettings):
    files: tuple[str, ...] = opt.arguments_of("FILE...", opt.METHOD)
    reference: bool = opt.flag(
        "--reference", "The publications alone, as BibTeX, or in the format of --format."
    )


@declared("show", Show, (*FORMATS, BIBTEX))
def show(given: Show, output: Output) -> None:
    """A method: its tableau, orders, properties, where it was published.

    For a method of the package gark reads its index; it judges every other one as gark check does.

    --reference and --format bibtex write the publications of methods, each as one entry of a
    bibliography. The word catalogue: means all of the catalogue, gark this program. A file without
    `reference` is cited by its families and rules. A `reference` that is plain text becomes a note;
    gark names files without any.
    """
    if given.reference or output.format == BIBTEX:
        _cite(given, output)
        return
    from garkcli.catalogue.entries import entry_of_method, entry_on
    from garkcli.cli.tableaux import coupling_of_slow_stages
    from garkcli.methodfile.load import load
    from garkcli.methodfile.naming import FAMILY, find_named, shelf_of
    from garkcli.report.methods import SHOWN as REPORT
    from garkcli.report.methods import ShownMethod

    files = output.files_meant(given.files, given.settings)
    if len(files) > 1 and output.format == "json":
        message = "--format json shows one method"
        cure = "give the files one by one; --reference takes several"
        raise UsageProblem(message, cure, code="options-clash")
    shown = []
    for file in files:
        method = load(file, given.settings)
        named = find_named(file)
        if named is not None and named.shelf != FAMILY and not given.settings:
            entry = entry_on(shelf_of(named), named, judges=True)
        else:
            entry = entry_of_method(method, file)
        tableau, description = method.tableau, method.description
        beside = method.bibliography, coupling_of_slow_stages(method)
        shown.append(ShownMethod(entry, tableau, method.entries, description, *beside))
    output.tell(REPORT, *shown)


def _cite(given: Show, output: Output) -> None:
    from garkcli.report.calls import references
    from garkcli.report.citation import REPORT, bibliography

    found = references(output.files_meant(given.files))
    if output.is_default or output.format == BIBTEX:
        output.write(bibliography(found, output.verbosity <= 0), BIBTEX)
    else:
        output.tell(REPORT, found)
    bare = [one.methods[0] for one in found if not one.text]
    if bare:
        shown = bare[0] if len(bare) == 1 else f"{len(bare)} methods"
        output.note(f"note: no reference in the file of {shown}")


class Page(opt.Derivable):
    files: tuple[str, ...] = opt.arguments_of("FILE...", opt.METHOD)
    order: int | None = opt.option(
        "--order -n", opt.number("n", 1, 100), of="report_page.order", heading="Page"
    )
    pictures: bool | None = opt.switch("--pictures/--no-pictures", of="report_page.pictures")
    open: bool = opt.OPEN


_PLACE = opt.option(
    "-o --output",
    opt.file(),
    "Write the page to FILE; by default to METHOD.html, of several methods to report.html.",
)


_DETAILS = opt.flag(
    "-v --verbose", "Everything: reasons of properties, B, C and D, more results and conditions."
)


@declared("report", Page, ["html"], output={**opt.REPORTED, "output": _PLACE, "verbose": _DETAILS})
def report(given: Page, output: Output) -> int:
    """Methods as one HTML page, to look at, print and pass on.

    gark report rk4 writes rk4.html; -o FILE writes elsewhere, -o - to standard output. The page
    needs no network: tableau, stability picture, claims, orders with their witness trees,
    stability, properties, errors, reference, order conditions with filters; a table compares
    several methods. -v adds the reasons of all properties, B, C and D and more results. Claims of a
    file are about its method: with --pair or --conjugate the page has none.

    Exit code: 0 every claim holds, 1 a claim fails, 2 a file cannot be read as a method, 3 a claim
    is undecided; the page is written in each case, and says so.
    """
    from garkcli.webpage.page import render
    from garkcli.webpage.reported import reported

    if given.open:
        output.demand_file()
    paths = output.files_meant(given.files, given.settings)
    if output.path is None and not output.is_streamed:
        output.path = _page_name(paths, given.which)
        output.check_place()
        # a page that has its name from its method is written over pages alone
        if _is_no_page(output.path):
            message = f"{output.path} exists already, and is not a page"
            raise UsageProblem(message, f"-o {output.path} writes over it", code="cannot-write")
    asked = given.order, given.pictures is not False, given.settings
    found = (reported(_file_or_derived(path, given), *asked) for path in paths)
    methods = list(counting("methods", found, len(paths)))
    output.write(render(methods, output.verbosity > 0))
    if given.open and output.path is not None:
        output.show(output.path)
    for method in methods:
        outcome = method.outcome
        if not outcome.is_read:
            say_faults(outcome)
        elif not outcome.ok:
            how = "is undecided" if outcome.is_open else "fails"
            output.note(f"{outcome.file}: a claim {how}, see the page")
    return max(method.outcome.exit_code for method in methods)


def _is_no_page(path: str) -> bool:
    """Whether a file is there that is not a page of gark."""
    try:
        return b"gark report" not in begin_of(path, 20_000).lower()
    except NotAFile:
        return True
    except OSError:
        return False


def _page_name(paths: list[str], which: str | None) -> str:
    if len(paths) > 1 or is_stream(paths[0]):
        return "report.html"
    from garkcli.methodfile.naming import called

    path = called(paths[0])
    name = path if path.startswith("{") else path.replace("\\", "/").rpartition("/")[2]
    for suffix in (".yml", ".yaml", ".gark"):
        name = name.removesuffix(suffix)
    name = re.sub(r"[^\w.()+-]+", "-", name.replace("*", "-star")).strip("-")
    return f"{name}-{which}.html" if which else f"{name}.html"


def _file_or_derived(path: str, given: Page) -> str | GarkMethod:
    """A file, or the conjugate or the pair of its method; UsageProblem for free parameters."""
    if given.which is None:
        return path
    try:
        return given.method(path)
    except HasFreeParameters as error:
        from garkcli.cli.tableaux import read_family

        read_family(error, given.settings, {f"--{given.which}": given.which})
        raise
    except MethodFileError:
        return path  # the page says what is wrong with it


_REPORT: opt.Kind[str] = opt.alone(opt.completed("[COMMAND]", "report.schemas:REPORTS"), "check")


class SchemaOptions(opt.Options):
    problem: bool = opt.flag("--problem", "The schema of problem files.", heading="Schema")
    sweep: bool = opt.flag("--sweep", "The schema of spec files of gark sweep.")
    project: bool = opt.flag("--project", "The schema of .gark.toml.")
    report: str | None = opt.option(
        "--report",
        _REPORT,
        "The schema of the JSON report of COMMAND; by default gark check.",
        of="report_schema.command",
    )


@declared("schema", SchemaOptions, ["json"], {"format": opt.FORMAT, "output": opt.OUTPUT})
def schema(given: SchemaOptions, output: Output) -> None:
    """The JSON Schema (draft-07) of method files, for editors; of other files; of reports.

    With the YAML extension of an editor, name it in the first line of a method file:
    # yaml-language-server: $schema=gark.schema.json
    """
    from garkcli.cli.project import project_schema
    from garkcli.methodfile.file_keys import method_file_schema
    from garkcli.problems.files.keys import problem_file_schema
    from garkcli.report.schemas import report_schema
    from garkcli.sweep.file import sweep_schema

    makers: dict[str, Callable[[], dict[str, Any]]] = {}
    if given.problem:
        makers["--problem"] = problem_file_schema
    if given.sweep:
        makers["--sweep"] = sweep_schema
    if given.project:
        makers["--project"] = project_schema
    if given.report is not None:
        makers["--report"] = partial(report_schema, given.report)
    if len(makers) > 1:
        message = f"{' and '.join(makers)} are {len(makers)} schemas"
        raise UsageProblem(message, "ask for one at a time", code="options-clash")
    make = next(iter(makers.values()), method_file_schema)
    output.write(json.dumps(make(), indent=2, ensure_ascii=False) + "\n")
