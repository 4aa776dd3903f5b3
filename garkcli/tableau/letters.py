"""Letters for the roots in the numbers of a tableau."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import chain

from garkcli.exact.field import Algebraic
from garkcli.exact.letters import NOTHING, Letters
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.exact.rewriting import roots_in
from garkcli.tableau.tableau import Tableau


def letters_of(tableau: Tableau, written: Mapping[str, str] = NOTHING) -> Letters | None:
    """The letters for the numbers of a method; None if no root of degree 3 or more is in them.

    ``written`` has what stands for letters where they cannot be written.
    """
    field = tableau.field
    if field is None:
        return None
    roots = chain.from_iterable(roots_in(radical) for radical, _ in field.radicals)
    if not any(isinstance(root, AlgebraicRoot) for root in roots):
        return None
    return Letters(_diagonal(tableau), written)


def _diagonal(tableau: Tableau) -> AlgebraicRoot | None:
    """The root that all nonzero diagonal entries of the blocks are; None if there is none."""
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
