"""The smallest method that does the same, its embedded weights and dense output included."""

from __future__ import annotations

from garkcli.doing import doing
from garkcli.properties.reduction import is_plainly_irreducible, reduced
from garkcli.tableau.embedded import NOTHING, Further, as_colours, from_colours
from garkcli.tableau.tableau import Tableau


@doing("smallest method")
def smallest(tableau: Tableau, further: Further = NOTHING) -> tuple[Tableau, Further] | None:
    """The smallest method with further weights: a stage that any row of weights needs stays.

    Returns:
        The same tableau object where there is nothing to leave out; None where stages are at
        irrational nodes and more than row sums would have to be compared.

    >>> from garkcli.methodfile.load import loads
    >>> method = loads("{A: [[0, 0], [1, 0]], b: [1, 0], embedded: [1/2, 1/2]}")
    >>> smallest(method.tableau, method.further)[0] is method.tableau
    True
    >>> smallest(method.tableau)[0].spaces[0].stages
    1
    """
    if is_plainly_irreducible(tableau):
        return tableau, further
    whole = as_colours(tableau, further) if further else tableau
    smaller = reduced(whole)
    if smaller is None:
        return None
    if smaller is whole:
        return tableau, further
    if not further:
        return smaller, further
    return from_colours(smaller, further)
