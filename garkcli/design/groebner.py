"""Gröbner bases over ℚ by python-flint, small ones at once, large ones within a time."""

from __future__ import annotations

from collections.abc import Sequence
from multiprocessing import get_context
from multiprocessing.connection import Connection
from time import monotonic
from typing import Any, TypeAlias

from flint import Ordering, fmpz, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

SMALL = (100, 1000, 20_000)
"""Most polynomials, terms of one, bits of a coefficient, for which no process is started."""
Terms: TypeAlias = dict[tuple[int, ...], int]
"""A polynomial between processes: coefficients by exponents."""


class NotDecided(Exception):
    """A Gröbner basis takes too long."""


def groebner_basis(
    polynomials: Sequence[fmpz_mpoly],
    context: fmpz_mpoly_ctx,
    deadline: float | None,
) -> list[fmpz_mpoly]:
    """The reduced Gröbner basis of an ideal.

    Args:
        polynomials: generators, not all zero.
        context: of theirs.
        deadline: the reading of ``time.monotonic`` at which it is given up; None for never.

    Raises:
        NotDecided: the time was not enough.
    """
    vector: Any = fmpz_mpoly_vec(list(polynomials), context)
    generators = vector.autoreduction()
    found, is_whole = generators.buchberger_naive(limits=SMALL)
    if is_whole:
        return list(found.autoreduction(groebner=True))
    if deadline is None:
        basis = generators.buchberger_naive()
        return list(basis.autoreduction(groebner=True))
    return _within_time(list(generators), context, deadline)


def _within_time(
    generators: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx, deadline: float
) -> list[fmpz_mpoly]:
    """The same in a process of its own, which can be stopped in the middle of its work."""
    # fork copies the threads' locks of whoever calls; spawn is the same everywhere
    processes = get_context("spawn")
    here, there = processes.Pipe(duplex=False)
    terms = [_terms(p) for p in generators]
    names = tuple(context.names())
    worker = processes.Process(target=_work, args=(there, terms, names), daemon=True)
    worker.start()
    there.close()
    try:
        if not here.poll(max(0.0, deadline - monotonic())):
            raise NotDecided
        basis: list[Terms] = here.recv()
    except EOFError:  # it ended without a result: no memory, or killed
        raise NotDecided from None
    finally:
        worker.kill()
        worker.join()
        here.close()
    return [_polynomial(p, context) for p in basis]


def _work(pipe: Connection, generators: list[Terms], names: tuple[str, ...]) -> None:
    """What the process does."""
    context = fmpz_mpoly_ctx.get(names, Ordering.degrevlex)
    polynomials = [_polynomial(p, context) for p in generators]
    vector: Any = fmpz_mpoly_vec(polynomials, context)
    basis = vector.buchberger_naive().autoreduction(groebner=True)
    pipe.send([_terms(p) for p in basis])


def _terms(p: fmpz_mpoly) -> Terms:
    return {tuple(map(int, e)): int(a) for e, a in p.to_dict().items()}


def _polynomial(terms: Terms, context: fmpz_mpoly_ctx) -> fmpz_mpoly:
    return context.from_dict({e: fmpz(a) for e, a in terms.items()})
