"""Letters for the roots in the numbers of a tableau."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import chain
from typing import TypeAlias, TypeGuard

from garkcli.exact.field import Algebraic
from garkcli.exact.letters import NOTHING, Letters, lettered
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.exact.rewriting import roots_in
from garkcli.tableau.tableau import Tableau

Defined: TypeAlias = Mapping[AlgebraicRoot, str]


@contextmanager
def with_letters(
    tableau: Tableau | None, written: Mapping[str, str] = NOTHING, taken: str = ""
) -> Iterator[Defined]:
    """Gives roots of degree 3 or more letters in texts made inside; yields those in use so far."""
    letters = Letters(_diagonal(tableau), written, taken) if _has_roots(tableau) else None
    with lettered(letters):
        yield {} if letters is None else letters.of


def _has_roots(tableau: Tableau | None) -> TypeGuard[Tableau]:
    if tableau is None or tableau.field is None:
        return False
    roots = chain.from_iterable(roots_in(radical) for radical, _ in tableau.field.radicals)
    return any(isinstance(root, AlgebraicRoot) for root in roots)


def _diagonal(tableau: Tableau) -> AlgebraicRoot | None:
    entries = set()
    for l in range(tableau.size):
        block = tableau.block(l, l) or ()
        entries |= {row[i] for i, row in enumerate(block) if i < len(row) and row[i]}
    if len(entries) != 1:
        return None
    (entry,) = entries
    if not isinstance(entry, Algebraic):
        return None
    for radical, element in entry.field.radicals:
        if isinstance(radical, AlgebraicRoot) and element == entry.poly:
            return radical
    return None
