"""Many files side by side, with the same outcome as one after the other."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import partial

from garkcli.check.check_file import check_file
from garkcli.check.outcome import Outcome


@contextmanager
def _without_interrupts() -> Iterator[None]:
    """Hold interrupts back, where the system can; they arrive at the end."""
    import signal

    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})


def _prepare() -> None:
    """Ready a worker: an interrupt is for the process that has the terminal, which ends the
    workers.
    """
    import signal

    from garkcli.exact.pickling import register

    signal.signal(signal.SIGINT, signal.SIG_IGN)
    register()


def check_files(
    paths: Sequence[str], limit: int, want_constants: bool, jobs: int
) -> Iterator[Outcome]:
    """Check ``paths`` in their order, ``jobs`` of them at a time."""
    work: Callable[[str], Outcome] = partial(check_file, limit=limit, want_constants=want_constants)
    jobs = min(jobs, len(paths))
    if jobs < 2 or "-" in paths:
        yield from map(work, paths)
        return
    import multiprocessing

    from garkcli.exact.pickling import register

    register()
    # fork keeps the modules that are loaded already, where the system has it
    method = "fork" if "fork" in multiprocessing.get_all_start_methods() else None
    context = multiprocessing.get_context(method)
    with (
        _without_interrupts()
    ):  # a worker that is interrupted before it is ready leaves a lock behind
        pool = context.Pool(jobs, initializer=_prepare)
    with pool:
        yield from pool.imap(work, paths, chunksize=max(1, min(8, len(paths) // (4 * jobs))))
