"""Gröbner bases over ℚ by python-flint, small ones at once, large ones within a time; by msolve
where that time is not enough.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from multiprocessing import get_context
from multiprocessing.connection import Connection
from time import monotonic
from typing import Any, TypeAlias, TypeVar

from flint import Ordering, fmpz, fmpz_mpoly, fmpz_mpoly_ctx, fmpz_mpoly_vec

from garkcli.design.msolve import basis_by_msolve, find_msolve, is_basis
from garkcli.errors import GarkError

T = TypeVar("T")
Exponents: TypeAlias = tuple[int, ...]
SMALL = (200, 1000, 20_000)
"""Most polynomials, terms of one, bits of a coefficient, for which no process is started."""
Terms: TypeAlias = dict[Exponents, int]
"""A polynomial between processes: coefficients by exponents."""


class NotDecided(GarkError):
    """A Gröbner basis takes too long."""

    def __init__(self) -> None:
        super().__init__(
            "not decided in the time there is", "give it more seconds, or give parameters values"
        )


def groebner_basis(
    polynomials: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx, deadline: float | None
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
        return reduced_basis(list(found), context)
    if deadline is None:
        basis = generators.buchberger_naive()
        return reduced_basis(list(basis), context)
    if deadline <= monotonic():
        raise NotDecided
    texts = [_terms(p) for p in generators]
    found = _within_time(_basis, (texts, tuple(context.names())), deadline)
    return [_polynomial(p, context) for p in found]


def reduced_basis(basis: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx) -> list[fmpz_mpoly]:
    """The reduced Gröbner basis of an ideal, primitive, the smallest leading monomials first.

    Each is reduced by those that are done, whose leading monomials are smaller: python-flint's
    ``autoreduction`` takes a hundred times as long where there are many.

    Args:
        basis: any Gröbner basis of it in degree reverse lexicographic order.
        context: of theirs.
    """
    done: list[fmpz_mpoly] = []
    known: list[Exponents] = []
    for p in sorted(basis, key=lambda p: _degrevlex(leading(p))):
        first = leading(p)
        if any(divides(smaller, first) for smaller in known):
            continue
        _, rest = p.primitive()
        if done:
            dividend: Any = rest  # the types of python-flint lack the method
            lower = fmpz_mpoly_vec(done, context)
            rest = dividend.reduction_primitive_part(lower)
        done.append(rest if rest.leading_coefficient() > 0 else -rest)
        known.append(first)
    return done


def leading(p: fmpz_mpoly) -> Exponents:
    """The exponents of the leading monomial."""
    return tuple(int(x) for x in p.monoms()[0])


def _degrevlex(exponents: Exponents) -> tuple[int, ...]:
    """A key that is larger for larger monomials."""
    return sum(exponents), *(-e for e in reversed(exponents))


def divides(a: Exponents, b: Exponents) -> bool:
    """Whether a monomial divides another."""
    return all(x <= y for x, y in zip(a, b, strict=True))


def groebner_basis_apart(
    polynomials: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx, deadline: float
) -> list[fmpz_mpoly]:
    """The same without a step in this process: reducing polynomials of many terms with one another
    may take long by itself.

    Raises:
        NotDecided: the time was not enough.
    """
    texts = [_terms(p) for p in polynomials]
    found = _within_time(_basis, (texts, tuple(context.names())), deadline)
    return [_polynomial(p, context) for p in found]


def unproved_basis(
    polynomials: Sequence[fmpz_mpoly], context: fmpz_mpoly_ctx, deadline: float | None
) -> list[fmpz_mpoly]:
    """The Gröbner basis by msolve, verified to be one of an ideal that contains the polynomials.

    Raises:
        NotDecided: there is no msolve, no answer in time, or not one that stands the test.
    """
    program = find_msolve()
    if program is None:
        raise NotDecided
    given = [p for p in polynomials if p]
    basis = basis_by_msolve(program, given, context, deadline)
    if basis is None:
        raise NotDecided
    lists = [_terms(p) for p in basis], [_terms(p) for p in given]
    if not _within_time(_is_verified, (*lists, tuple(context.names())), deadline):
        raise NotDecided
    return basis


def _within_time(work: Callable[..., T], arguments: tuple[Any, ...], deadline: float | None) -> T:
    """What a function returns in a process of its own, which can be stopped in the middle of it."""
    # fork copies the threads' locks of whoever calls; spawn is the same everywhere
    processes = get_context("spawn")
    here, there = processes.Pipe(duplex=False)
    worker = processes.Process(target=_serve, args=(there, work, arguments), daemon=True)
    worker.start()
    there.close()
    try:
        seconds = None if deadline is None else max(0.0, deadline - monotonic())
        if not here.poll(seconds):
            raise NotDecided
        result: T = here.recv()
    except EOFError:  # it ended without a result: no memory, or killed
        raise NotDecided from None
    finally:
        worker.kill()
        worker.join()
        here.close()
    return result


def _serve(pipe: Connection, work: Callable[..., object], arguments: tuple[Any, ...]) -> None:
    """What the process does."""
    pipe.send(work(*arguments))


def _basis(generators: list[Terms], names: tuple[str, ...]) -> list[Terms]:
    context = fmpz_mpoly_ctx.get(names, Ordering.degrevlex)
    polynomials = [_polynomial(p, context) for p in generators]
    vector: Any = fmpz_mpoly_vec(polynomials, context)
    basis = reduced_basis(list(vector.buchberger_naive()), context)
    return [_terms(p) for p in basis]


def _is_verified(basis: list[Terms], given: list[Terms], names: tuple[str, ...]) -> bool:
    context = fmpz_mpoly_ctx.get(names, Ordering.degrevlex)
    polynomials = [_polynomial(p, context) for p in given]
    return is_basis([_polynomial(p, context) for p in basis], polynomials, context)


def _terms(p: fmpz_mpoly) -> Terms:
    return {tuple(map(int, e)): int(a) for e, a in p.to_dict().items()}


def _polynomial(terms: Terms, context: fmpz_mpoly_ctx) -> fmpz_mpoly:
    return context.from_dict({e: fmpz(a) for e, a in terms.items()})
