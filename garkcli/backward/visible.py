"""The trees that a problem sees: others have elementary differentials that vanish."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from garkcli.backward.free_trees import hamiltonian_structure
from garkcli.order.conditions import elementary_weight
from garkcli.stepping.fields import visible_tableau
from garkcli.tableau.tableau import Tableau
from garkcli.trees.tree import Tree

if TYPE_CHECKING:
    from garkcli.stepping.integrator import Binding
    from garkcli.trees.free import Structure


@dataclass(frozen=True)
class VisibleTrees:
    """A tableau whose trees are those that a problem sees, at least.

    Attributes:
        tableau: the tableau. Colours of one term have become those of two where H^{l} = T(p) +
            U(q): derivatives of H^{l} by momenta alone are those of T.
        energies: H^{l} of its terms, sympy expressions; where one has become two, each of them has
            the whole.
        structure: of the Hamiltonians of its colours; None where roots cannot move.
    """

    tableau: Tableau
    energies: tuple[Any, ...]
    structure: Structure | None


def visible(bound: Binding) -> VisibleTrees:
    """What a problem sees of a method: the fewest trees for which roots can move still."""
    energies = bound.problem.terms
    if bound.fields and _is_consistent(bound.tableau):
        few = visible_tableau(bound.tableau, bound.fields)
        origins = _terms_apart(few)
        distinct = list(dict.fromkeys(origins))
        colours = []
        for colour, origin in zip(few.colours, origins, strict=True):
            colours.append(replace(colour, term=distinct.index(origin)))
        few = replace(few, colours=tuple(colours))
        structure = hamiltonian_structure(few)
        if structure is not None:
            apart = tuple(energies[term] for term, _ in distinct)
            return VisibleTrees(few, apart, structure)
    more = _with_linear_fields(bound)
    return VisibleTrees(more, energies, hamiltonian_structure(more))


def _is_consistent(tableau: Tableau) -> bool:
    """Whether all weights sum to 1."""
    roots = range(tableau.size)
    return all(elementary_weight(tableau, Tree(l)) == 1 for l in roots)


def _terms_apart(tableau: Tableau) -> list[tuple[int, str]]:
    """For each colour its term, with its part where V^l and F^l do not see what they drive: then
    ∂²H^{l}/∂q∂p = 0.
    """
    terms: list[tuple[int, str]] = []
    for l, colour in enumerate(tableau.colours):
        same_part = [m for m, x in enumerate(tableau.colours) if x.part == colour.part]
        sees_own = any(tableau.block(l, m) is not None for m in same_part)
        terms.append((colour.term, "" if sees_own else colour.part))
    return terms


def _with_linear_fields(bound: Binding) -> Tableau:
    """The tableau without the trees that vanish because some H^{l} is quadratic."""
    tableau = bound.tableau
    quadratic = {x.term for x in tableau.colours}
    for (l, _), field in bound.fields.items():
        if not field.is_linear:
            quadratic.discard(tableau.colours[l].term)
    colours = []
    for colour in tableau.colours:
        is_linear = colour.is_linear or colour.term in quadratic
        colours.append(replace(colour, is_linear=is_linear))
    return replace(tableau, colours=tuple(colours))
