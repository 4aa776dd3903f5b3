"""The independent conditions of symplectic methods: which they are, and how many."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from garkcli.errors import UsageProblem, counted
from garkcli.frozen import Frozen
from garkcli.ntrees.count import Admissible, counts_upto
from garkcli.ntrees.free import Structure
from garkcli.ntrees.notation import format_tree
from garkcli.ntrees.symplectic import (
    KINDS,
    ConditionClass,
    Kind,
    count_classes,
    independent_classes,
    structure_of,
)
from garkcli.order.meant import AnyTableau, printed
from garkcli.tableau.tableau import Tableau
from garkcli.tell.facts import Level, Row, Section
from garkcli.tell.kinds import COUNT, POSITION, TEXTS, choice

_LETTERS = {"q": "V", "p": "F", "y": "f"}
_PROBLEMS = {
    "semi-separable": "H = H1(q, p) + H2(q)",
    "separable": "H = H1(p) + H2(q)",
    "nystrom": "H = H1(p) + H2(q) with H1 quadratic",
}


class SymplecticSubject(Frozen):
    """Symplectic methods of a kind, or one of them.

    Attributes:
        kind: the kind; ``pair`` also where a method's structure has no name.
        structure: its colours, and how roots move among them.
        names: the names of the colours.
        orders: the orders asked for.
        method: its tableau, with its rounding where it is rounded; None without one.
    """

    kind: Kind
    structure: Structure
    names: tuple[str, ...]
    orders: range
    method: AnyTableau | None = None

    @cached_property
    def counts(self) -> tuple[tuple[int, int, int], ...]:
        """For each order the independent conditions and all conditions."""
        admissible = self._admissible
        lacks_blocks = admissible != self.structure.admissible
        every = counts_upto(admissible, self.orders[-1])
        found = []
        for n in self.orders:
            if lacks_blocks:
                independent = sum(1 for _ in self._of_order(n))
            else:
                independent = count_classes(self.structure, n)
            found.append((n, independent, sum(every[n - 1])))
        return tuple(found)

    @property
    def _admissible(self) -> Admissible:
        """The trees that have a condition."""
        if self.method is None:
            return self.structure.admissible
        from garkcli.order.conditions import coupling_graph

        tableau = printed(self.method)
        return coupling_graph(tableau)

    def classes(self) -> Iterator[ConditionClass]:
        for n in self.orders:
            yield from self._of_order(n)

    def _of_order(self, order: int) -> Iterator[ConditionClass]:
        classes = independent_classes(self.structure, order)
        if self.method is None:
            return classes
        from garkcli.order.conditions import is_admissible

        tableau = printed(self.method)
        return (c for c in classes if is_admissible(tableau, c.representative))

    @property
    def independent(self) -> int:
        return sum(k for _, k, _ in self.counts)

    @property
    def has_colours(self) -> bool:
        """Whether trees are written with their colours."""
        return len(self.names) > 1

    def members(self, tree: ConditionClass) -> list[str]:
        return [format_tree(u, self.has_colours) for u in tree.members]

    @property
    def legend(self) -> str:
        """The names of the colours; empty if there is one."""
        if not self.has_colours:
            return ""
        pairs = [f"{l} {name}" for l, name in enumerate(self.names, start=1)]
        return f"colours: {', '.join(pairs)}"

    @property
    def summary(self) -> str:
        """``7 independent conditions of order 4 for …``."""
        few, many = self.independent, self.all_conditions
        conditions = counted(few, "independent condition")
        which = "of order" if len(self.orders) == 1 else "up to order"
        instead = "" if few == many else f", instead of {many}"
        return f"{conditions} {which} {self.orders[-1]} for {self._problem}{instead}"

    @property
    def all_conditions(self) -> int:
        """The conditions of all orders if the method were not symplectic."""
        return sum(k for _, _, k in self.counts)

    @property
    def _problem(self) -> str:
        terms = len(self.structure.leaders)
        if self.kind == "pair":
            return f"a symplectic pair of {counted(terms, 'Hamiltonian')}"
        if self.kind == "self-conjugate":
            return f"a self-conjugate method of {counted(terms, 'vector field')}"
        return _PROBLEMS[self.kind]


SUBJECT: Section[SymplecticSubject] = Section(
    Row("kind", choice(*KINDS), lambda x: x.kind, Level.DATA),
    Row("terms", POSITION, lambda x: len(x.structure.leaders), Level.DATA),
    Row("colours", TEXTS, lambda x: x.names, Level.DATA),
    Row("count", COUNT, lambda x: x.independent, Level.DATA),
    Row("instead_of", COUNT, lambda x: x.all_conditions, Level.DATA),
)


def subject_of_kind(kind: Kind, terms: int | None, orders: range) -> SymplecticSubject:
    """The symplectic methods of a kind.

    Raises:
        UsageProblem: the kind does not exist with so many terms.
    """
    if terms is None:
        terms = 2 if kind in _PROBLEMS else 1
    try:
        structure = structure_of(kind, terms)
    except ValueError as error:
        cure = "leave out --colours, or choose another --kind"
        raise UsageProblem(f"--colours {terms}: {error}", cure, code="option-value") from None
    names = []
    for term, part in structure.colours:
        names.append(f"{_LETTERS[part]}{term + 1}")
    return SymplecticSubject(kind, structure, tuple(names), orders)


def subject_of_method(method: AnyTableau, orders: range) -> SymplecticSubject:
    """One method: a partitioned one or its own conjugate as it is, of any other the symplectic
    pair.

    Raises:
        UsageProblem: a partitioned method that is not symplectic, or linear in positions or in
            momenta only.
        ZeroWeight: the pair would divide by zero.
    """
    from garkcli.order.meant import derived
    from garkcli.order.simplifying import is_symplectic

    if not is_symplectic(method):
        if printed(method).is_partitioned:
            raise _not_symplectic(printed(method))
        method = derived(method, "pair")
    tableau = printed(method)
    terms = list(range(tableau.size))
    if tableau.is_partitioned:
        terms = [x.space for x in tableau.colours]
    natures = list(zip(terms, tableau.colours, strict=True))
    quadratic = frozenset(term for term, x in natures if x.is_linear)
    for term, x in natures:
        if term in quadratic and not x.is_linear:
            message = f"colour {x.name} is not linear, as the other colour of its stages is"
            cure = "such a term of the Hamiltonian has no classes; make both linear or none"
            raise UsageProblem(message, cure, code="tree-not-admissible")
    structure = Structure(tuple((term, x.part) for term, x in natures), quadratic)
    names = tuple(x.name for x in tableau.colours)
    return SymplecticSubject(_kind(structure), structure, names, orders, method)


def _kind(structure: Structure) -> Kind:
    if not structure.is_directed:
        return "self-conjugate"
    for kind in KINDS:
        if kind in _PROBLEMS and structure_of(kind) == structure:
            return kind
    return "pair"


def _not_symplectic(tableau: Tableau) -> UsageProblem:
    weights = {(x.space, x.b) for x in tableau.colours}
    spaces = {space for space, _ in weights}
    if len(weights) > len(spaces):
        reason = "positions and momenta have different weights at the same stages"
        cure = "give both the same weights"
    else:
        reason = "its momentum blocks are not the conjugates of its position blocks"
        cure = "with --pair they become the conjugates"
    return UsageProblem(f"the method is not symplectic: {reason}", cure, code="not-symplectic")
