"""``gark import``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from garkcli.cli.options import Output, declared
from garkcli.doing import counting
from garkcli.errors import UsageProblem, counted, printable
from garkcli.tell.report import FORMATS

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from garkcli.bridges.collecting import Result
    from garkcli.sources.found import FoundTable, Reader


@declared("import", (*FORMATS, "yaml"))
def command(
    sources: tuple[str, ...],
    folder: str | None,
    source_format: str | None,
    is_recognising: bool,
    format: str,
    quiet: bool,
    verbose: bool,
    color: str,
) -> int:
    """Methods out of other people's sources: C, Python, MATLAB, Julia, LaTeX, JSON and others.

    SOURCE is a file, a folder (all files in it of the formats that are read), or - for standard
    input. Nothing in it is ever executed. Each table is a method; its order is found, and claimed
    in its file. Decimals of many digits are taken for rounded: the file says within which
    tolerance.

    Exit code: 0 methods were found, 2 there is none.
    """
    from garkcli.bridges.collecting import collected
    from garkcli.bridges.sources import source_files
    from garkcli.report.imported import REPORT, all_found, yaml_text

    output = Output(format, None, verbose - quiet, color)
    if folder is not None:
        from garkcli.cli.emitting import make_folder

        make_folder(folder)
    readers = _readers(source_format)
    paths = list(source_files(sources, output.note))
    left_out: list[FoundTable] = []
    sources_read = counting("sources", paths, len(paths))
    results = list(collected(sources_read, readers, is_recognising, left_out.append))
    if not any(result.method is not None for result in results):
        raise _nothing(sources, paths, results, left_out)
    for table in left_out:
        # of a folder one expects other arrays of such names
        if table.source in sources:
            output.note(f"{_other(table)}; {_take_it(table)}")
    files = {} if folder is None else _written(results, folder)
    if output.format == "yaml":
        output.write(yaml_text(results))
    else:
        output.tell(REPORT, [all_found(results, files)])
    return 0


def _readers(name: str | None) -> Sequence[Reader]:
    if name is None:
        return ()
    from garkcli.bridges.readers.registry import reader_named

    return [reader_named(name)]


def _other(table: FoundTable) -> str:
    """What is told of arrays that may be no method."""
    place = f"{printable(table.source)}:{table.line}"
    if table.c[0] is None:
        return f"{place}: A and b without nodes may be no method"
    return f"{place}: A, b and c are no method, by their sums"


def _take_it(table: FoundTable) -> str:
    return f"--from {table.format} takes them for one"


def _nothing(
    sources: Sequence[str],
    paths: Sequence[str],
    results: Sequence[Result],
    left_out: Sequence[FoundTable],
) -> UsageProblem:
    """Why there is nothing to be written."""
    from garkcli.bridges.readers.registry import all_readers

    for result in results:
        place = f"{result.table.source}:{result.table.line}"
        name = result.table.name
        message = f"{place}: no method: {result.trouble}"
        if name:
            message = f"{place}: {name} is no method: {result.trouble}"
        return UsageProblem(message, "see docs/import.md for what is read", code="cannot-import")
    for table in left_out:
        return UsageProblem(_other(table), _take_it(table), code="cannot-import")
    looked_at = counted(len(paths), "file")
    where = ", ".join(sources[:3])
    known = ", ".join(all_readers())
    message = f"no table is found in {where} ({looked_at})"
    return UsageProblem(message, f"--from FORMAT says what it is: {known}", code="cannot-import")


def _written(results: Sequence[Result], folder: str) -> Mapping[int, str]:
    """Write the method files; their names by the numbers of the results."""
    from pathlib import Path

    from garkcli.page.writing import write_whole

    files = {}
    for number, result in enumerate(results):
        if result.method is None:
            continue
        path = str(Path(folder, result.file_name))
        write_whole(path, [result.method.text])
        files[number] = path
    return files
