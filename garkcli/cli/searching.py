"""``gark design --search``: the search, its report, and the files that it writes."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

from garkcli.cli.emitting import file_names
from garkcli.cli.signals import INTERRUPTED
from garkcli.cli.streams import say_problem
from garkcli.crew.hiring import hired
from garkcli.crew.work import WorkerLost
from garkcli.deadline import until
from garkcli.design.design import CLAIMS
from garkcli.design.search.run import MOST, TOLERANCE, Method, Result, Task, Timed, results
from garkcli.design.search.search import Proof, Search
from garkcli.doing import doing
from garkcli.errors import NotDecided, UsageProblem
from garkcli.methodfile.family import FamilyFile, with_values
from garkcli.methodfile.search_file import FileSearch
from garkcli.page.writing import write_whole
from garkcli.report.search import REPORT, SearchReport

if TYPE_CHECKING:
    from garkcli.cli.design_options import Wanted
    from garkcli.cli.options import Output

PROOFS: tuple[Proof, ...] = ("exact", "exists", "numerical")
"""What is known of a method, the most first."""
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
        raise UsageProblem("a search is for an order", cure, code="option-alone")
    asked = FileSearch.of(family, order, wanted.whose)
    looking = asked.search
    result, ended = _searched(asked, wanted, starts)
    files = _written(family, looking, result, wanted)
    output.tell(REPORT, [SearchReport(family.source, looking, result, files)])
    if ended is not None:
        return ended
    # that nothing was found says nothing of what there is
    return 0 if result.methods else 3


def _searched(asked: FileSearch, wanted: Wanted, starts: int) -> tuple[Result, int | None]:
    """The result, and the exit code where an interrupt or a lost worker ends the search; where the
    time does, it is that of what was found.
    """
    seed, most = wanted.seed or 0, wanted.most or MOST
    place = wanted.jobs or 1, wanted.scheduler or ""
    looking = asked.search
    result, ended = Result(), None
    with doing("starts", starts) as work:
        try:
            with until(wanted.moment), hired(asked.do, _lost, *place) as workers:
                for result in results(looking, starts, seed, most, workers):
                    work.what = f"{len(result.methods)} methods found, starts"
                    work.reach(result.starts)
        except KeyboardInterrupt:
            result.ending, ended = "interrupt", INTERRUPTED
        except NotDecided:
            result.ending = "time"
        except WorkerLost as error:
            say_problem(error)
            result.ending, ended = "worker", 3
    return result, ended


def _lost(_task: Task, why: str) -> Timed:
    """A piece of a search that ended its process; the others' are kept."""
    raise WorkerLost(
        f"a process of the search was ended {why}", "where memory is short use fewer --jobs"
    )


def _written(
    family: FamilyFile, looking: Search, result: Result, wanted: Wanted
) -> list[str | None]:
    """Write the files that are asked for, of one the first method of which most is proved; where
    each method is.
    """
    methods, seed = result.methods, wanted.seed or 0
    files: list[str | None] = [None] * len(methods)
    if wanted.emit_all is not None:
        files = list(islice(file_names(wanted.emit_all, family.source), len(methods)))
    best = min(methods, key=lambda x: PROOFS.index(x.proof), default=None)
    for place, method in enumerate(methods):
        paths = [files[place], wanted.emit if method is best else None]
        for path in paths:
            if path is not None:
                write_whole(path, [_file_text(family, looking, method, seed)])
                files[place] = files[place] or path
    return files


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
