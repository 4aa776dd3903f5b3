"""``gark design --search``: the search, its report, and the files that it writes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from garkcli.cli.design_options import CLAIMS
from garkcli.cli.signals import INTERRUPTED
from garkcli.cli.streams import say_problem
from garkcli.design.search.run import MOST, Crew, Result, Timed, results
from garkcli.design.search.run import prove as prove_in
from garkcli.design.search.run import solve as solve_in
from garkcli.design.search.search import Search
from garkcli.design.search.told import TOLERANCE, Method
from garkcli.errors import UsageProblem
from garkcli.methodfile.family import FamilyFile, loads_family, with_values
from garkcli.page.progress import watching
from garkcli.page.writing import refuse_unwritable, write_whole
from garkcli.report import search_data, search_text

if TYPE_CHECKING:
    from concurrent.futures import ProcessPoolExecutor

    from garkcli.cli.design_options import Wanted
    from garkcli.cli.options import Output
    from garkcli.design.design import Whose

HEADS = {
    "exact": "exact",
    "exists": "proved to exist, with these decimals",
    "numerical": "numerical, nothing is proved",
}


def search(
    family: FamilyFile, wanted: Wanted, starts: int, output: Output
) -> int:
    """Search for methods, report them and write their files.

    Args:
        family: of methods.
        wanted: what the options ask for.
        starts: how many.
        output: where the report goes.
    """
    if wanted.order is None:
        message = "a search is for an order"
        raise UsageProblem(message, "say which by --order P")
    _check_places(wanted)
    looking = Search(family, wanted.order, wanted.whose)
    result, ended = _searched(family, looking, wanted, starts, output)
    files = _written(family, looking, result, wanted)
    as_json = output.format == "json"
    render = search_data.render if as_json else search_text.render
    output.write(render(family.source, looking, result, files, output.width))
    if ended is not None:
        return ended
    # that nothing was found says nothing of what there is
    return 0 if result.methods else 3


def _check_places(wanted: Wanted) -> None:
    """Refuse places that cannot be written to, before the work."""
    if wanted.emit is not None:
        refuse_unwritable(wanted.emit)
    if wanted.emit_all is not None:
        folder = Path(wanted.emit_all)
        try:
            folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            message = f"cannot make the folder {folder}: {error.strerror}"
            raise UsageProblem(message, "choose another place") from None


def _searched(
    family: FamilyFile,
    looking: Search,
    wanted: Wanted,
    starts: int,
    output: Output,
) -> tuple[Result, int | None]:
    """The result, and the exit code where an interrupt or a lost worker ends the search."""
    seed, most = wanted.seed or 0, wanted.most or MOST
    result, ended = Result(), None
    with watching(output.may_show_progress) as show:
        try:
            with _crew(family, looking, wanted.jobs or 1) as crew:
                for result in results(looking, starts, seed, most, crew):
                    what = f"starts, {len(result.methods)} methods found"
                    show(what, result.starts, starts)
        except KeyboardInterrupt:
            ended = INTERRUPTED
        except WorkerLost as error:
            say_problem(error)
            ended = 3
    result.is_interrupted = ended is not None
    return result, ended


@contextmanager
def _crew(
    family: FamilyFile, looking: Search, jobs: int
) -> Iterator[Crew | None]:
    """Workers where there are several; none is left behind."""
    if jobs < 2:
        yield None
        return
    import multiprocessing
    from concurrent.futures import ProcessPoolExecutor
    from concurrent.futures.process import BrokenProcessPool

    given = family.text, family.source, dict(family.settings)
    setting = given, looking.order, looking.whose
    pool = ProcessPoolExecutor(jobs, initializer=_begin, initargs=setting)
    try:
        yield _Several(pool, jobs)
    except BrokenProcessPool:
        raise WorkerLost(
            "a process of the search was ended from outside",
            "where memory is short use fewer --jobs",
        ) from None
    finally:
        pool.shutdown(wait=False, cancel_futures=True)
        for child in multiprocessing.active_children():
            child.kill()


class WorkerLost(UsageProblem):
    """A worker was ended by a signal; what it was at is not known."""


class _Several:
    """Workers that have read the file for themselves."""

    def __init__(self, pool: ProcessPoolExecutor, size: int) -> None:
        self.pool = pool
        self.size = size

    def solve(self, batches: Sequence[list[list[float]]]) -> list[Timed]:
        return list(self.pool.map(_solve, batches))

    def prove(
        self, solutions: Sequence[tuple[int, list[float]]]
    ) -> list[Timed]:
        return list(self.pool.map(_prove, solutions))


_WORKING: list[Search] = []
"""What a worker searches for."""


def _begin(given: tuple[Any, ...], order: int, whose: Whose) -> None:
    """A worker reads the file; an interrupt is for the process that has the terminal."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    for name in ("SIGTERM", "SIGHUP"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)
    _WORKING[:] = [Search(loads_family(*given), order, whose)]


def _solve(batch: list[list[float]]) -> Timed:
    return solve_in(_WORKING[0], batch)


def _prove(solution: tuple[int, list[float]]) -> Timed:
    return prove_in(_WORKING[0], solution)


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


def _places(
    family: FamilyFile, count: int, wanted: Wanted
) -> list[str | None]:
    """Where the file of each method goes; all into the folder where there is one."""
    if wanted.emit_all is not None:
        folder = Path(wanted.emit_all)
        stem = Path(family.source).name.split(".")[0] or "method"
        names = (f"{stem}-{k}.gark.yaml" for k in range(1, count + 1))
        return [str(folder / name) for name in names]
    if wanted.emit is not None and count:
        return [wanted.emit, *[None] * (count - 1)]
    return [None] * count


def _file_text(
    family: FamilyFile, looking: Search, method: Method, seed: int
) -> str:
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
