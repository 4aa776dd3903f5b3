"""``gark tableau``, ``convert`` and ``diff``: methods as tableaus and as files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from garkcli.cli import options as opt
from garkcli.cli.command import declared
from garkcli.cli.output import Output
from garkcli.errors import HasFreeParameters, MethodError, UsageProblem, did_you_mean
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.check.every_family import EveryFamily
    from garkcli.constructions.infinitesimal import Coupling
    from garkcli.exact.roots import RealRoot
    from garkcli.methodfile.build import MethodFile
    from garkcli.methodfile.family import FamilyFile
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau

DEFAULT_DIGITS = 17
EXIT_CODES = {
    "identical": 0,
    "same": 0,
    "within-rounding": 0,
    "same-step": 0,
    "different": 1,
    "undecided": 3,
}


REDUCED = "reduced"


def forms() -> list[str]:
    from garkcli.conversion.targets import TARGETS

    return [*TARGETS, REDUCED]


TRANSFORMATION = opt.flag(
    "--transformation",
    "Add the eigenvalues of the inverse of A, and T with its real block form.",
    heading="Report",
)


class TableauOptions(opt.Derivable):
    file: str = opt.argument("FILE", opt.METHOD)
    digits: int | None = opt.DIGITS
    transformation: bool = TRANSFORMATION
    document: bool = opt.DOCUMENT
    rules = (
        opt.DOCUMENT_RULE,
        opt.excludes(
            TRANSFORMATION,
            opt.being(opt.FORMAT, "yaml"),
            "a method file has no place for the transformation",
            "ask for another format",
        ),
        opt.excludes(
            TRANSFORMATION,
            opt.being(opt.FORMAT, "latex"),
            "LaTeX has no transformation",
            "ask for another format",
        ),
    )


@declared("tableau", TableauOptions, (*FORMATS, "yaml"))
def tableau(given: TableauOptions, output: Output) -> None:
    """The assembled tableau, all blocks, of a method, its symplectic conjugate or pair.

    Entries are exact where the nodes are rational or quadratic numbers, else decimals; rational
    functions if parameters are free. LaTeX shows a method for positions and momenta as two arrays,
    Q and P.

    --format yaml writes a method file. The conjugate of the conjugate is the original, exactly; if
    its nodes have no simple radicals, the file has `conjugate: true` instead of entries.
    """
    try:
        method = given.method(given.file, is_any_kind=True)
    except HasFreeParameters as error:
        _write_family(error, given, output)
        return
    if method.base is not None and method.base.further:
        output.note(
            f"the embedded weights and the dense output are left out: the {given.which} has none"
        )
    if output.format != "yaml":
        write_tableau(method, output, given.digits, given.document, given.transformation)
    elif given.digits is None and method.derivation:
        output.write(_derived_file(method, output))
    else:
        output.write(_method_file(method, given.digits))


def write_tableau(
    method: GarkMethod,
    output: Output,
    digits: int | None = None,
    is_document: bool = False,
    with_transformation: bool = False,
) -> None:
    """``digits`` are those of all entries, None for exact ones if nodes have simple radicals."""
    from garkcli.report.tableau import REPORT, of_method

    shown = of_method(method, digits, with_transformation, coupling_of_slow_stages(method))
    output.stream(REPORT, shown, is_document or None)


def coupling_of_slow_stages(method: GarkMethod) -> Coupling | None:
    from garkcli.methodfile.build import MethodFile

    if not isinstance(method, MethodFile) or method.form != "multirate" or method.derivation:
        return None
    from garkcli.methodfile.constructed.multirate import coupling_of

    return coupling_of(method)


def _method_file(method: GarkMethod, digits: int | None) -> str:
    """UsageProblem if the method cannot be spelled out."""
    from garkcli.methodfile.writer import tolerance_of_file, write_rounded, write_tableau_file
    from garkcli.tableau.pointwise import in_points

    _refuse_partitioned(method.tableau)
    if digits is not None:
        from garkcli.report.tableau import of_method

        entries = of_method(method, digits).entries
        return write_rounded(method.tableau, entries, method.name, method.further)
    exact = in_points(method.tableau)
    if exact is None:
        message = "the nodes have no simple radicals, so the tableau cannot be spelled out exactly"
        cure = f"--digits {DEFAULT_DIGITS} writes decimals"
        raise UsageProblem(message, cure, code="no-radicals")
    tolerance = tolerance_of_file(method, method.further)
    return write_tableau_file(exact, method.name, tolerance, further=method.further)


def _derived_file(made: GarkMethod, output: Output) -> str:
    """UsageProblem if the nodes of a pair have no simple radicals."""
    from garkcli.methodfile.carried import write_conjugate_of
    from garkcli.methodfile.writer import can_spell_out, write_tableau_file
    from garkcli.tableau.pointwise import in_points

    is_pair = made.derivation == "pair"
    exact = in_points(made.tableau)
    if exact is not None and (is_pair or can_spell_out(exact)):
        return write_tableau_file(exact, made.name, made.tolerance)
    if is_pair:
        whole = "the symplectic pair"
        message = f"the nodes have no simple radicals, so {whole} cannot be spelled out exactly"
        cure = "gark check reports on the symplectic pair; --format json gives decimals"
        raise UsageProblem(message, cure, code="no-radicals")
    output.note("the conjugate is described by the key conjugate: true, exactly, not spelled out")
    base: Any = made.base
    return write_conjugate_of(base, made.name)


def _refuse_partitioned(tableau: Tableau) -> None:
    from garkcli.methodfile.writer import can_spell_out

    if not can_spell_out(tableau):
        raise UsageProblem(
            "a method file spells out a GARK tableau or one pair (q, p), not this partitioned one",
            "--format json has all of its blocks",
            code="cannot-convert",
        )


def read_family(
    error: HasFreeParameters,
    settings: Mapping[str, str],
    needs: Mapping[str, object],
    is_judged: bool = True,
) -> tuple[FamilyFile, EveryFamily]:
    """``needs`` has options that require numbers; decisions follow if ``is_judged``, and need exact
    coefficients. UsageProblem if one of these is violated.
    """
    from garkcli.check.every_family import every_family
    from garkcli.methodfile.family import family_of, refuse_rounded

    file = family_of(error, settings)
    try:
        if is_judged:
            refuse_rounded(file)
        found = every_family(file)
    except MethodError as refusal:
        raise UsageProblem(refusal.message, refusal.help, code=refusal.code) from None
    name = found.family.parameters[0]
    for option, value in needs.items():
        if value:
            message = f"{option} needs numbers, and {name} is free"
            raise UsageProblem(message, f"choose a value: --set {name}=1/2", code="free-parameters")
    return file, found


def _write_family(error: HasFreeParameters, given: TableauOptions, output: Output) -> None:
    """UsageProblem if the nodes have no simple radicals, or decimals are requested."""
    from garkcli.order.meant import derived, printed
    from garkcli.tableau.garkmethod import GarkMethod, derived_name

    file, family = read_family(error, given.settings, {"--digits": given.digits}, is_judged=False)
    shown = family.printed(printed(derived(family.tableau, given.which or "")))
    cure = f"--set {file.parameters[0]}=1/2"
    if shown is None:
        message = "the nodes have no simple radicals beside free parameters"
        raise UsageProblem(message, f"choose a value: {cure}", code="no-radicals")
    if file.further:
        output.note(
            f"the embedded weights and the dense output are left out; with values there are: {cure}"
        )
    name = derived_name(given.which, file.name) if given.which else file.name
    if output.format == "yaml":
        output.write(_family_text(shown, name, family))
        return
    method = GarkMethod(tableau=shown, name=name, derivation=given.which or "")
    write_tableau(method, output, None, given.document)


def _family_text(tableau: Tableau, name: str, family: EveryFamily) -> str:
    from garkcli.methodfile.writer import write_tableau_file

    _refuse_partitioned(tableau)

    def text(number: object) -> str:
        return str(number).replace("^", "**")

    free = []
    for parameter in family.family.parameters:
        ends: Sequence[object] = family.family.ranges[parameter]
        if family.bounds:
            ends = [_end_text(parameter, x) for x in family.ends]
        if None in ends:
            free.append(f"{parameter}: free")
        else:
            low, high = ends
            free.append(f"{parameter}: {{free: true, range: [{low}, {high}]}}")
    return write_tableau_file(tableau, name, text=text, parameters=free)


def _end_text(parameter: str, end: RealRoot | None) -> str:
    """An end of a range as in a file; UsageProblem if it has no simple radicals."""
    from garkcli.exact.polynomial_text import root_text

    text = None if end is None else root_text(end)
    if text is None:
        message = f"an end of the range of {parameter} has no simple radicals"
        cure = f"choose a value: --set {parameter}=1/2"
        raise UsageProblem(message, cure, code="no-radicals")
    return f'"{text}"'


def _reduce(given: Convert, output: Output) -> None:
    from garkcli.api.methods import reduced
    from garkcli.methodfile.load import load
    from garkcli.methodfile.naming import called
    from garkcli.methodfile.writer import can_spell_out, tolerance_of_file, write_method

    method = load(given.file, given.settings)
    method.tableau.demand_fields("this command")
    file = called(given.file)
    made = reduced(method)
    if made is None:
        message = f"{file}: the nodes have no simple radicals, so equal stages are not sought"
        raise UsageProblem(message, "spell the method out", code="no-radicals")
    if made is method:
        output.note(f"{file}: nothing to reduce")
    else:
        before, after = _stages(method.tableau), _stages(made.tableau)
        output.note(f"{file}: stages {before} become {after}")
    if output.format != "yaml":
        write_tableau(made, output)
    elif made is method:
        output.write(method.text)
    elif can_spell_out(made.tableau):
        tolerance = tolerance_of_file(method, made.further)
        text = write_method(made.tableau, made.name, tolerance, made.further)
        output.write(_against(method, made, output) + text)
    else:
        message = f"{file}: a method of this structure cannot be spelled out in a file"
        cure = "--format json has the entries of the smaller method"
        raise UsageProblem(message, cure, code="cannot-convert")


def _stages(tableau: Tableau) -> str:
    return ", ".join(str(space.stages) for space in tableau.spaces)


class Convert(opt.WithSettings):
    file: str = opt.argument("FILE", opt.METHOD)
    to: str | None = opt.option(
        "--to",
        opt.words_of("cli.tableaux:forms", "FORM"),
        "The form of the result: spelled-out, gark, ark, prk, pair, canonical, recovered, reduced, "
        "2N, 2R, 3R, 4R, 5R or shu-osher; of a Rosenbrock method printed or transformed.",
        of="convert.to",
        heading="Form",
    )
    stages: int | None = opt.option("--stages", opt.number("N", 1, 1000), of="convert.stages")
    digits: int | None = opt.option("--digits", opt.DECIMALS, of="convert.digits")
    recognise: bool = opt.flag("--recognise", of="convert.is_recognising")
    rules = (
        opt.needs(
            (digits, recognise),
            opt.being(to, "recovered"),
            "OPTION goes with --to recovered",
            "add --to recovered",
        ),
        opt.excludes(
            stages,
            opt.being(to, REDUCED),
            "--stages adds stages, --to reduced leaves some out",
            "use one of them",
        ),
    )


@declared("convert", Convert, ("yaml", *FORMATS))
def convert(given: Convert, output: Output) -> None:
    """A method in another form, as a method file.

    Name, reference, tolerance, embedded weights and dense output stay. So do the claims that hold
    for the result; a note names the others. The file of the pair has the claims of FILE about the
    pair. --to reduced writes the smallest equivalent method: stages that do not influence the
    step are removed, and equal ones merged. If any are, the file makes no claims.
    """
    if given.to == REDUCED:
        _reduce(given, output)
        return
    from garkcli.conversion.convert import convert
    from garkcli.methodfile.load import load
    from garkcli.methodfile.naming import called

    method = load(given.file, given.settings)
    made = convert(method, **given.of("convert"))
    file = called(given.file)
    if made.left_out:
        output.note(f"{file}: claims that are left out: {', '.join(made.left_out)}")
    if made.loses_further:
        lost = [x for x in method.further.kinds if x not in made.method.further.kinds]
        output.note(f"{file}: left out: {', '.join(lost)}")
    if output.format != "yaml":
        write_tableau(made.method, output)
    else:
        output.write(_against(method, made.method, output) + made.method.text)


def _against(first: MethodFile, second: GarkMethod, output: Output) -> str:
    """Returns, with details, the comparison with the method in the file as a comment."""
    if output.verbosity <= 0 or not first.tableau.has_fields_alone:
        return ""
    from garkcli.comparison.comparison import compare
    from garkcli.methodfile.naming import called
    from garkcli.report.diff import REPORT, ComparedPair

    names = called(first.source), "the method below"
    lines = REPORT.render([ComparedPair(compare(first, second), names)], verbosity=-1).splitlines()
    return "".join(f"# {line}\n" for line in lines)


class Diff(opt.WithSettings):
    first: str = opt.argument("FIRST", opt.METHOD)
    second: str = opt.argument("SECOND", opt.METHOD)
    strict: bool = opt.flag(
        "--strict", "Exit with 1 unless every entry is identical.", heading="Comparison"
    )


@declared("diff", Diff, FORMATS)
def diff(given: Diff, output: Output) -> int:
    """The differences of two methods in entries, orders, conditions and properties; whether they
    are the same method in another numbering or form.

    Exit code: 0 the steps are the same, and so are the further weights that both have, up to
    renumbering, stages without influence and the rounding that both files admit; 1 they are not; 3
    not decided.
    """
    from garkcli.comparison.comparison import compare
    from garkcli.methodfile.naming import called
    from garkcli.report.diff import REPORT, ComparedPair

    first, second = _loaded((given.first, given.second), given.settings)
    found = compare(first, second)
    names = called(given.first), called(given.second)
    typed = _as_typed(given.first, names[0]), _as_typed(given.second, names[1])
    output.tell(REPORT, ComparedPair(found, names, typed))
    if given.strict and found.relation in {"same", "within-rounding", "same-step"}:
        return 1
    return EXIT_CODES[found.relation]


def _as_typed(argument: str, name: str) -> str:
    """RK4 is rk4, an alias stays."""
    from garkcli.methodfile.shelves import key_of

    return name if key_of(argument) == name else argument


def _loaded(files: tuple[str, str], settings: Mapping[str, str]) -> list[MethodFile]:
    from garkcli.methodfile.carried import parameter_names
    from garkcli.methodfile.load import loads, noted, read_method_text

    methods = []
    known: set[str] = set()
    for path in files:
        text, source = read_method_text(path)
        names = parameter_names(text, source)
        known.update(names)
        own = {name: x for name, x in settings.items() if name in names}
        methods.append(noted(loads(text, source, own)))
    for name in settings:
        if name not in known:
            message = f"--set {name}: neither file has such a parameter"
            raise UsageProblem(message, did_you_mean(name, sorted(known)), code="option-value")
    return methods
