"""Many files side by side, with the same outcome as one after the other, whatever becomes of a
worker.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial

from garkcli.check.check_file import check_file
from garkcli.check.outcome import Outcome
from garkcli.crew.hiring import hired
from garkcli.crew.work import in_order
from garkcli.doing import doing
from garkcli.errors import Fault
from garkcli.files import is_stream
from garkcli.methodfile.load import NO_SETTINGS

Work = Callable[[str], Outcome]


def check_files(
    paths: Sequence[str],
    limit: int,
    want_constants: bool,
    jobs: int,
    settings: Mapping[str, str] = NO_SETTINGS,
) -> Iterator[Outcome]:
    """Check ``paths`` in their order, ``jobs`` of them at a time.

    A file that ends its worker, by a lack of memory or a signal, has an outcome that says so, and
    the others are checked as if nothing had been.
    """
    check = partial(check_file, limit=limit, want_constants=want_constants, settings=settings)
    work: Work = partial(_checked, check)
    # standard input is this process's, and so are other streams
    jobs = 1 if any(map(is_stream, paths)) else min(jobs, len(paths))
    with hired(work, _ended, jobs) as workers:
        yield from in_order(workers, paths)


def _checked(check: Work, path: str) -> Outcome:
    """The outcome of one file, also where the program has a fault."""
    try:
        with doing(path):
            return check(path)
    except Exception as error:
        if "--debug" in sys.argv:
            raise
        what = f"{type(error).__name__}: {error}".splitlines()[0][:200]
        return _crashed(
            path, f"internal fault: {what}", "please report it, with the file", "internal-fault"
        )


def _crashed(path: str, what: str, cure: str, code: str) -> Outcome:
    return Outcome(path, path, faults=(Fault(what, cure, code=code),), is_crash=True)


def _ended(path: str, why: str) -> Outcome:
    """The outcome of a file that ended its worker."""
    cure = "check it alone; where memory is short use fewer --jobs"
    return _crashed(path, f"its check was ended {why}", cure, "worker-lost")
