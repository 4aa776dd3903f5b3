"""``gark design --search``: the search, its report, and the files that it writes."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

from garkcli.cli.emitting import file_names
from garkcli.cli.signals import INTERRUPTED
from garkcli.cli.streams import say_problem
from garkcli.crew.hiring import hired
from garkcli.crew.work import WorkerLost
from garkcli.design.design import CLAIMS
from garkcli.design.search.run import MOST, Result, Task, Timed, results
from garkcli.design.search.search import Search
from garkcli.design.search.told import TOLERANCE, Method
from garkcli.doing import doing
from garkcli.errors import UsageProblem
from garkcli.methodfile.family import FamilyFile, with_values
from garkcli.methodfile.search_file import FileSearch
from garkcli.page.writing import write_whole
from garkcli.report import search_data, search_text

if TYPE_CHECKING:
    from garkcli.cli.design_options import Wanted
    from garkcli.cli.options import Output

HEADS = {
    "exact": "exact",
    "exists": "proved to exist, with these decimals",
    "numerical": "numerical, nothing is proved",
}


def search(family: FamilyFile, wanted: Wanted, starts: int, output: Output) -> int:
    """Search for methods, report them and write their files.

    Args:
        family: of methods.
        wanted: what the options ask for.
        starts: how many.
        output: where the report goes.
    """
    order = wanted.order or family.order
    if order is None:
        cure = "say which by --order P, or in the file by design: {order: P}"
        raise UsageProblem("a search is for an order", cure)
    asked = FileSearch.of(family, order, wanted.whose)
    looking = asked.search
    result, ended = _searched(asked, wanted, starts)
    files = _written(family, looking, result, wanted)
    as_json = output.format == "json"
    render = search_data.render if as_json else search_text.render
    output.write(render(family.source, looking, result, files, output.width))
    if ended is not None:
        return ended
    # that nothing was found says nothing of what there is
    return 0 if result.methods else 3


def _searched(asked: FileSearch, wanted: Wanted, starts: int) -> tuple[Result, int | None]:
    """The result, and the exit code where an interrupt or a lost worker ends the search."""
    seed, most = wanted.seed or 0, wanted.most or MOST
    place = wanted.jobs or 1, wanted.scheduler or ""
    looking = asked.search
    result, ended = Result(), None
    with doing("starts", starts) as work:
        try:
            with hired(asked.do, _lost, *place) as workers:
                for result in results(looking, starts, seed, most, workers):
                    work.what = f"{len(result.methods)} methods found, starts"
                    work.reach(result.starts)
        except KeyboardInterrupt:
            ended = INTERRUPTED
        except WorkerLost as error:
            say_problem(error)
            ended = 3
    result.is_interrupted = ended is not None
    return result, ended


def _lost(_task: Task, why: str) -> Timed:
    """A piece of a search that ended its process; the others' are kept."""
    raise WorkerLost(
        f"a process of the search was ended {why}", "where memory is short use fewer --jobs"
    )


def _written(
    family: FamilyFile, looking: Search, result: Result, wanted: Wanted
) -> list[str | None]:
    """Write the files that are asked for; where each method is."""
    methods, seed = result.methods, wanted.seed or 0
    files = _places(family, len(methods), wanted)
    for path, method in zip(files, methods, strict=True):
        if path is not None:
            write_whole(path, [_file_text(family, looking, method, seed)])
    if methods and wanted.emit is not None and wanted.emit != files[0]:
        # the first method is in the folder, and in a file of its own
        text = _file_text(family, looking, methods[0], seed)
        write_whole(wanted.emit, [text])
    return files


def _places(family: FamilyFile, count: int, wanted: Wanted) -> list[str | None]:
    """Where the file of each method goes; all into the folder where there is one."""
    if wanted.emit_all is not None:
        return list(islice(file_names(wanted.emit_all, family.source), count))
    if wanted.emit is not None and count:
        return [wanted.emit, *[None] * (count - 1)]
    return [None] * count


def _file_text(family: FamilyFile, looking: Search, method: Method, seed: int) -> str:
    """A method file with its claim and how it was found."""
    claim = f"{CLAIMS[looking.whose]}: {method.order}"
    source = f"gark design {family.source} --order {looking.order}"
    start = f"start {method.start} of seed {seed}"
    head = f"found by {source}, {start}\n{HEADS[method.proof]}: {claim}"
    if not method.is_exact:
        head += f", residuals below {method.residual} before rounding"
    text = with_values(family, method.values, head, claim)
    if not method.is_exact and "tolerance:" not in text:
        text += f"tolerance: {TOLERANCE}\n"
    return text
