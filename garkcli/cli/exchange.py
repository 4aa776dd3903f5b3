"""``gark export``, ``import`` and ``audit``: methods in other formats, and proofs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from garkcli.cli import options as opt
from garkcli.cli.command import declared
from garkcli.cli.endings import CURES, ENDINGS, ending_of, settled
from garkcli.cli.output import Output
from garkcli.cli.streams import say
from garkcli.errors import MethodFileError, UsageProblem, counted, printable
from garkcli.files import is_stream
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from garkcli.bridges.audit import Audited
    from garkcli.bridges.collecting import TableResult
    from garkcli.bridges.registry import Bridge
    from garkcli.sources.found import FoundTable


CERTIFICATE = "certificate"
PROOFS = ("json", *(x for x in FORMATS if x != "json"), "coq")


def targets() -> list[str]:
    from garkcli.bridges.registry import bridges

    return [*bridges(), CERTIFICATE]


WRITTEN = {
    "output": opt.option(
        "-o --output", opt.file(), "Write to FILE, whose ending is that of TARGET."
    ),
    "quiet": opt.QUIET,
    "verbose": opt.VERBOSE,
    "color": opt.COLOR,
}


class Export(opt.Derivable):
    file: str = opt.argument("FILE", opt.METHOD)
    to: str = opt.required(
        "--to",
        opt.completed("TARGET", "cli.exchange:targets"),
        "The target; gark list exports shows them; certificate is a proof of the orders.",
        of="export.target",
        heading="Target",
    )
    digits: int | None = opt.option("--digits", opt.DECIMALS, of="export.digits")
    format: str | None = opt.option(
        "--format", opt.words(*PROOFS), "The format of a certificate, json by default."
    )
    test: bool = opt.flag(
        "--test",
        "With -o: also write a program that runs the method in TARGET, and a problem file with "
        "which gark converge prints the same errors.",
    )
    being_certificate = opt.being(to, CERTIFICATE)
    rules = (
        opt.needs(
            test,
            WRITTEN["output"],
            "--test writes further files beside the first",
            "name it: -o FILE",
        ),
        opt.needs(
            format,
            being_certificate,
            "--format is for certificates",
            "leave it out: TARGET says what is written",
        ),
        opt.excludes(
            (opt.CONJUGATE, opt.PAIR, digits, test),
            being_certificate,
            "a certificate has no OPTION: it proves the orders of the method, conjugate and pair",
            "leave it out",
        ),
    )


@declared("export", Export, output=WRITTEN)
def export(given: Export, output: Output) -> None:
    """A method for other codes: SciPy, SUNDIALS, PETSc, C, JSON and others.

    The head of the file says which orders gark proved. Decimals are correctly rounded. gark refuses
    a method that the target cannot represent, with the reason.

    --to certificate writes a proof of the orders that can be checked without gark: the exact
    tableau, its conjugate and pair, trees that span all trees of each order, and a tree that fails;
    for rounded coefficients a proof that a method within the tolerance has the order.
    tools/referee.py of the source distribution, one short file of plain Python, decides the orders
    again from it; --format coq is for the proof assistant Coq, and for exact methods.
    """
    if given.to == CERTIFICATE:
        _write_certificate(given, output)
        return
    from garkcli.api.anymethod import refuse_rounded
    from garkcli.bridges.own_arrays import own_kind
    from garkcli.bridges.preparing import prepared
    from garkcli.bridges.registry import bridge_named
    from garkcli.constructions.rosenbrock import is_rosenbrock

    bridge = bridge_named(given.to, CERTIFICATE)
    if output.path is not None:
        _refuse_other_ending(output.path, bridge)
    if given.test and bridge.words is None:
        message = f"{bridge.name} is data, not a program"
        raise UsageProblem(message, "leave out --test", code="cannot-export")
    method = given.method(given.file, is_any_kind=True)
    if not (is_rosenbrock(method.tableau) or own_kind(method.tableau)):
        method.tableau.demand_fields("this command", with_flow="mri" in bridge.kinds)
    refuse_rounded(method)
    payload = prepared(method, given.digits)
    table = bridge.written(payload)
    path = Path(output.path or "")
    beside = bridge.tested(payload, path.name) if given.test else {}
    output.write(table, bridge.name)
    for ending, text in beside.items():
        Output(path=str(path.with_name(path.stem + ending))).write(text)


def _write_certificate(given: Export, output: Output) -> None:
    from garkcli.api.calls import prove_method, prove_method_exists
    from garkcli.report.certificate import REPORT

    named = settled(output.path, PROOFS, given.format) if output.path else None
    output.format = named or given.format or PROOFS[0]
    method = given.method(given.file, is_any_kind=True)
    if output.format == "coq":
        from garkcli.report.certificate import coq_proof

        output.write(coq_proof(prove_method(method)))
    else:
        proved = prove_method if method.tolerance is None else prove_method_exists
        output.tell(REPORT, proved(method))


def _refuse_other_ending(path: str, bridge: Bridge) -> None:
    """UsageProblem for a file whose ending belongs to another target."""
    ending, held = ending_of(path), ENDINGS.get(bridge.suffix.lower(), ())
    if not ending or {*held} & {*ENDINGS[ending]}:
        return
    from garkcli.bridges.registry import bridges

    others = [x.name for x in bridges().values() if x.suffix.lower() == ending]
    cures = [f"choose the ending {bridge.suffix}"]
    if others:
        cures.append(f"--to {' or '.join(others)} writes {ending} files")
    elif ENDINGS[ending] == ("yaml",):
        cures.append(CURES["yaml"])
    message = f"-o {path}: {bridge.name} is not for a {ending} file"
    raise UsageProblem(message, "; ".join(cures), code="wrong-ending")


class Import(opt.Options):
    sources: tuple[str, ...] = opt.arguments_of("SOURCE...", opt.INPUT)
    source_format: str | None = opt.option(
        "--from",
        opt.text("FORMAT"),
        "The format of SOURCE; by default gark goes by its name or content.",
        of="import_methods.format",
        heading="Methods",
    )
    recognise: bool = opt.flag(
        "--recognise",
        "Replace decimals by exact numbers if the order does not fall.",
        of="import_methods.is_recognising",
    )
    as_found: bool = opt.flag(
        "--as-found",
        "Claim the true orders, not those that SOURCE declares.",
        of="import_methods.is_as_found",
    )
    folder: str | None = opt.OUTPUT_DIR


IMPORTED = {
    **opt.REPORTED,
    "format": opt.always("--format", opt.Kind({}), "The report, or the method files themselves."),
    "verbose": opt.flag("-v --verbose", "Show the method files."),
}


@declared("import", Import, (*FORMATS, "yaml"), output=IMPORTED)
def import_(given: Import, output: Output) -> int:
    """Methods from other sources: C, Python, MATLAB, Julia, LaTeX, JSON and others.

    SOURCE is a file, a folder (all files in it of the formats that gark reads), or - for standard
    input; gark executes nothing in it. Each table becomes a method file that claims the orders
    declared by its source, true or not, or its true orders without a declaration or with
    --as-found. Decimals of many digits count as rounded, and the file has their tolerance.

    Exit code: 0 methods were found, 1 the declared order of one is wrong, so that gark check fails
    its file (not with --as-found), 2 no method was found.
    """
    from garkcli.bridges.collecting import collected
    from garkcli.bridges.sources import source_files
    from garkcli.report.imported import REPORT, all_found, yaml_text

    if given.folder is not None:
        from garkcli.cli.designing import make_folder

        make_folder(given.folder)
    paths = list(source_files(given.sources, output.note))
    left_out: list[FoundTable] = []
    results = list(collected(paths, **given.of("import_methods"), left_out=left_out.append))
    if not any(result.method is not None for result in results):
        raise _nothing(given.sources, len(paths), results, left_out)
    if output.path is not None and output.format == "yaml":
        _refuse_several(results, f"-o {output.path}", "--output-dir")
    for table in left_out:
        # of a folder one expects other arrays of such names
        if table.source in given.sources:
            output.note("; ".join(_other(table)))
    files = {} if given.folder is None else _written(results, given.folder)
    if files:
        output.note(f"wrote {counted(len(files), 'method file')} into {given.folder}")
    if output.format == "yaml":
        output.write(yaml_text(results))
    else:
        output.tell(REPORT, all_found(results, files))
    _tell_unread([x for x in results if x.method is None], output)
    wrong = [x for x in results if x.errors]
    if output.format == "yaml":
        _tell_signs(results, output)
        _tell_wrong(wrong)
    if not wrong or given.as_found:
        return 0
    verb = "is" if len(wrong) == 1 else "are"
    message = f"{counted(len(wrong), 'method')} {verb} not what the source declares"
    output.note(f"{message}: gark check fails there, --as-found claims what is true")
    return 1


def _tell_signs(results: Sequence[TableResult], output: Output) -> None:
    for result in results:
        if result.method is not None and result.method.sign:
            output.note(f"{_place(result)}: {result.method.sign}")


def _place(result: TableResult) -> str:
    table = result.table
    return f"{printable(table.source)}:{table.line} {printable(table.name)}".rstrip()


def _tell_wrong(results: Sequence[TableResult]) -> None:
    for result in results:
        for finding in result.errors:
            say(f"{_place(result)}: {finding.message}")
            if finding.help:
                say(f"help: {finding.help}")


def _refuse_several(results: Sequence[TableResult], place: str, option: str) -> None:
    """UsageProblem for several methods in the file ``place``; ``option`` names a folder."""
    names = [x.table.name or x.stem for x in results if x.method is not None]
    if len(names) > 1 and ending_of(place):
        more = f" and {len(names) - 8} more" if len(names) > 8 else ""
        listed = ", ".join(map(printable, names[:8])) + more
        message = f"{place} is one method file, and {len(names)} methods are found: {listed}"
        cure = f"{option} DIR writes a file for each"
        raise UsageProblem(message, cure, code="wrong-ending")


def _tell_unread(unread: Sequence[TableResult], output: Output) -> None:
    """Notes sources that were not read, and the number of other tables, with -v their names."""
    for result in unread:
        if result.table.is_source:
            output.note(f"{printable(result.table.source)} {result.trouble}")
    unread = [x for x in unread if not x.table.is_source]
    if output.verbosity > 0:
        for result in unread:
            place = f"{printable(result.table.source)}:{result.table.line}"
            output.note(f"{place}: {result.table.name or 'a table'} is not read: {result.trouble}")
    elif unread:
        verbs = "looks like a table and was" if len(unread) == 1 else "look like tables and were"
        output.note(f"{len(unread)} more {verbs} not read: -v lists them")


def _other(table: FoundTable) -> tuple[str, str]:
    place = f"{printable(table.source)}:{table.line}"
    cure = f"--from {table.format} takes them for one"
    if table.c[0] is None:
        return f"{place}: A and b without nodes may be no method", cure
    return f"{place}: A, b and c are not a method, by their sums", cure


def _nothing(
    sources: Sequence[str],
    files: int,
    results: Sequence[TableResult],
    left_out: Sequence[FoundTable],
) -> UsageProblem:
    from garkcli.bridges.readers.registry import all_readers

    for result in results:
        place, name = f"{result.table.source}:{result.table.line}", result.table.name
        message = f"{place}: no method: {result.trouble}"
        if result.table.is_source:
            message = f"{result.table.source} {result.trouble}"
            return UsageProblem(message, "give the part with the tables", code="cannot-import")
        if name:
            message = f"{place}: {name} is not a method: {result.trouble}"
        return UsageProblem(message, "see docs/import.md for what is read", code="cannot-import")
    for table in left_out:
        message, cure = _other(table)
        return UsageProblem(message, cure, code="cannot-import")
    for source in sources:
        if _is_method_file(source):
            message = f"{source} is a method file already"
            cure = f"gark check {source} reads it, gark export and convert write other forms"
            return UsageProblem(message, cure, code="cannot-import")
    known = ", ".join(all_readers())
    message = _no_table(sources, files)
    return UsageProblem(message, f"--from FORMAT names its format: {known}", code="cannot-import")


def _is_method_file(source: str) -> bool:
    from garkcli.grammar.nodes import MappingNode, composed, keys_of
    from garkcli.methodfile.load import read_method_text

    if is_stream(source) or not source.endswith((".yaml", ".yml")):
        return False
    with suppress(MethodFileError):
        root = composed(read_method_text(source)[0])
        keys = keys_of(root) if isinstance(root, MappingNode) else set()
        return bool(keys & {"gark", "expect", "methods", "tableau"}) or {"A", "b"} <= keys
    return False


def _no_table(sources: Sequence[str], files: int) -> str:
    return f"no table found in {', '.join(sources[:3])} ({counted(files, 'file')})"


def _written(results: Sequence[TableResult], folder: str) -> Mapping[int, str]:
    from garkcli.page.writing import write_whole

    files = {}
    for number, result in enumerate(results):
        if result.method is not None:
            files[number] = str(Path(folder, result.file_name))
            write_whole(files[number], [result.method.text])
    return files


class AuditOptions(opt.Options):
    paths: tuple[str, ...] = opt.arguments_of("PATH...", opt.INPUT)
    strict: bool = opt.flag(
        "--strict", "Fail if gark could not read a possible table.", heading="Audit"
    )
    jobs: int | None = opt.option("-j --jobs", opt.workers(60), opt.JOBS_HELP, of="audit.jobs")
    fix: bool = opt.flag(
        "--fix",
        "Write a patch of what is sure instead: a wrong sign, digit or entry. It changes no file.",
        heading="Output",
    )
    claim: str | None = opt.option(
        "--claim",
        opt.file(metavar="PLACE"),
        "Also write method files that claim what the sources declare: into a folder, or one into "
        "PLACE.gark.yaml.",
    )


@declared("audit", AuditOptions, ("auto", *FORMATS, "github", "sarif"))
def audit(given: AuditOptions, output: Output) -> int:
    """The tables in a solver's source tree compared with their declared orders.

    PATH is a folder (all files in it of the formats that gark import reads), a file, or - for
    standard input; gark executes nothing in it. For every table: does it have the declared order
    and embedded order; are its nodes the row sums, and if not, which order is lost; do its weights
    sum to 1? The format auto is github in GitHub Actions and text elsewhere.

    Exit code: 0 nothing is wrong, 1 a finding is an error, or with --strict a likely table was not
    read, 2 no table was found or could be read.
    """
    from garkcli.bridges.audit import audited
    from garkcli.bridges.sources import source_files
    from garkcli.report.audited import FORMATS as RENDERERS

    if given.fix and output.format != "auto":
        message = f"--fix writes a patch, not {output.format}"
        raise UsageProblem(message, "leave out --format; end FILE in .patch", code="options-clash")
    if given.claim is not None and ending_of(given.claim):
        settled(given.claim, ["yaml"], option="--claim")
    files = list(source_files(given.paths, output.note))
    unlike: list[str] = []
    found = list(audited(files, given.jobs or 1, unlike.append))
    if not found:
        message = "; ".join([_no_table(given.paths, len(files)), *unlike[:1]])
        raise UsageProblem(message, "docs/import.md says what is read", code="cannot-import")
    if given.fix:
        _write_patch(found, files, output)
    else:
        output.suit()
        output.write(RENDERERS[output.format](found, output.look, output.verbosity, output.width))
    if given.claim is not None:
        _claim(files, given.claim, output)
    if any(x.has_errors for x in found) or (given.strict and any(x.looks_like for x in found)):
        return 1
    return 0 if any(x.is_read for x in found) else 2


NOT_MENDED = "the others have no single sign, digit or number that is certain to mend them"


def _write_patch(found: Sequence[Audited], files: Sequence[str], output: Output) -> None:
    from garkcli.bridges.patching import patches

    if any(map(is_stream, files)):
        message = "standard input is not a file, which a patch needs"
        raise UsageProblem(message, "name files or folders", code="cannot-write")
    pieces, mended, left_out = [], 0, 0
    for source, piece in patches(found, files):
        pieces.append(piece)
        mended += source.mended if piece else 0
        why = ""
        if not source.before:
            why = "it is not UTF-8, or begins with a byte order mark"
        elif source.mended and not piece:
            why = "it is not below this folder, or its lines have signs that do not print"
        if why:
            left_out += 1
            output.note(f"{printable(source.source)} is left out of the patch: {why}")
    output.write_exactly("".join(pieces))
    wrong = sum(x.has_errors for x in found)
    if wrong:
        left = f": {NOT_MENDED}" if mended < wrong and not left_out else ""
        output.note(f"the patch mends {mended} of {counted(wrong, 'wrong table')}{left}")


def _claim(files: Sequence[str], place: str, output: Output) -> None:
    from garkcli.bridges.collecting import collected
    from garkcli.cli.designing import make_folder

    results = [x for x in collected(files) if x.method is not None]
    if ending_of(place):
        _refuse_several(results, f"--claim {place}", "--claim")
        output.save(place, [x.method.text for x in results if x.method is not None])
        return
    make_folder(place)
    names = _written(results, place)
    output.note(f"wrote {counted(len(names), 'method file')} into {printable(place)}")
