"""``gark trees``: the trees of an order, and the free trees of symplectic methods."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cached_property
from typing import NamedTuple, Protocol, TypeAlias, TypeVar

from garkcli.errors import UsageProblem, counted
from garkcli.frozen import Frozen, Mutable
from garkcli.ntrees import symplectic
from garkcli.ntrees.count import Admissible, counts_upto
from garkcli.ntrees.drawing import draw_text
from garkcli.ntrees.free import Structure
from garkcli.ntrees.notation import format_tree, parse_tree
from garkcli.ntrees.symplectic import Kind as Symplectic
from garkcli.ntrees.tree import Tree
from garkcli.order.meant import AnyTableau, derived, printed
from garkcli.page.schema import TEXT, Schema, array, counts_of, one_of, published
from garkcli.tableau.tableau import Tableau
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Rows, Section, Words, itself, optional, via
from garkcli.tell.kinds import COUNT, INDEX, POSITION, TEXTS, TRUTH, choice
from garkcli.tell.parts import rows_of, sentence, stream, told
from garkcli.tell.report import Report

Counts: TypeAlias = Sequence[tuple[int, tuple[int, ...]]]
DRAWN_ORDER = 4
"""Largest order whose drawn trees a terminal shows, with -v all."""
DETAIL, DATA = Level.DETAIL, Level.DATA
T = TypeVar("T")


class Query(Frozen):
    """Colours count from 1 in ``root`` and from 0 in ``used``."""

    colours: int
    order: int
    upto: bool
    root: int | None
    used: tuple[int, ...] = ()

    def roots(self, by_root: Sequence[int]) -> list[tuple[int, int]]:
        """The root colours in question, from 1, with their numbers of trees."""
        return [(l, count) for l, count in enumerate(by_root, start=1) if self.root in {None, l}]

    def total(self, by_root: Sequence[int]) -> int:
        return sum(count for _, count in self.roots(by_root))


class TreeRow(NamedTuple):
    """A tree; ``root`` counts from 0, and its σ and γ."""

    tree: str
    root: int
    order: int
    sigma: int
    gamma: int


class TreeList(Mutable):
    """No rows if the trees are only counted."""

    query: Query
    rows: Iterable[TreeRow] | None
    known: Counts | None

    @property
    def counts(self) -> Counts:
        """Rows are counted if the numbers are unknown."""
        if self.known is None:
            assert self.rows is not None
            self.rows = [*self.rows]
            first = 1 if self.query.upto else self.query.order
            found = {n: [0] * self.query.colours for n in range(first, self.query.order + 1)}
            for row in self.rows:
                found[row.order][row.root] += 1
            self.known = [(n, tuple(by_root)) for n, by_root in found.items()]
        return self.known

    @property
    def by_root(self) -> dict[str, int]:
        total: dict[str, int] = {}
        for _, by_root in self.counts:
            for root, count in self.query.roots(by_root):
                total[str(root)] = total.get(str(root), 0) + count
        return total

    @property
    def by_order(self) -> dict[str, int]:
        return {str(n): self.query.total(by_root) for n, by_root in self.counts}

    @property
    def total(self) -> int:
        return sum(self.by_order.values())


def picture(tree: Callable[[T], Tree]) -> Row[T]:
    return itself("picture", told(lambda x, d: d.sketch(tree(x))), DETAIL, label="")


def drawn(tree: Callable[[T], Tree]) -> Row[T]:
    def small(x: T, d: Plain) -> str:
        found = tree(x)
        if found.order > DRAWN_ORDER and d.is_brief:
            return ""
        return "\n".join(d.drawing(draw_text(found, d.has_colours(found), d.width // 2)))

    return itself("drawn", told(small), label="", is_short=True)


BRACKETS: Kind[Tree | str] = Kind(
    Json(TEXT, lambda tree, d: d.tree(tree)), Words(lambda tree, d: d.tree(tree))
)
TREES: Kind[Sequence[Tree | str]] = Kind(
    Json(array(TEXT), csv=lambda trees: " ".join(map(str, trees))),
    Words(lambda trees, d: "  ".join(map(d.tree, trees))),
)


def counts(what: str) -> Kind[dict[str, int]]:
    return Kind(Json(counts_of(what)))


class HasTree(Protocol):
    @property
    def tree(self) -> Tree: ...


SIZES: Rows[HasTree] = (
    Row("root", INDEX, lambda x: x.tree.root, DATA),
    Row("order", POSITION, lambda x: x.tree.order, DETAIL),
    Row("sigma", POSITION, lambda x: x.tree.symmetry),
    Row("gamma", POSITION, lambda x: x.tree.density),
)


def _heading(row: TreeRow, d: Plain) -> str:
    heading = f"order {row.order}"
    return f"{heading}, root colour {row.root + 1}" if len(d.colours) > 1 else heading


def _count_rows(found: TreeList, _: Plain) -> Iterator[tuple[str, str]]:
    for n, by_root in found.counts:
        text = str(found.query.total(by_root))
        if found.query.colours > 1:
            roots = (f"{count} of root colour {l}" for l, count in found.query.roots(by_root))
            text += f": {', '.join(roots)}"
        yield f"order {n}", text


TREE: Section[TreeRow] = Section(
    picture(lambda x: parse_tree(x.tree)),
    Row("tree", BRACKETS, lambda x: x.tree),
    Row("root", INDEX, lambda x: x.root, DATA),
    Row("order", POSITION, lambda x: x.order, DETAIL),
    Row("sigma", POSITION, lambda x: x.sigma),
    Row("gamma", POSITION, lambda x: x.gamma),
    drawn(lambda x: parse_tree(x.tree)),
)
HEAD: Rows[TreeList] = (
    Row("colours", POSITION, lambda x: x.query.colours, DATA),
    Row("order", POSITION, lambda x: x.query.order, DATA),
    Row("upto", TRUTH, lambda x: x.query.upto, DATA),
    Row("count", COUNT, lambda x: x.total, DATA),
    Row("by_root", counts("root colour"), lambda x: x.by_root, DATA),
)
LISTED: Section[TreeList] = Section(
    HEAD,
    Row("trees", stream(TREE, _heading), lambda x: x.rows),
    sentence(lambda x: counted(x.total, "tree") if x.known else ""),
)
COUNTS: Section[TreeList] = Section(
    HEAD,
    optional("by_order", counts("order"), lambda x: x.by_order if x.query.upto else None, DATA),
    itself("counts", rows_of(_count_rows)),
)


class TreeCount(Frozen):
    order: int
    root: int
    count: int


COUNTED: Section[TreeCount] = Section(
    Row("order", COUNT, lambda x: x.order),
    Row("root", COUNT, lambda x: x.root),
    Row("count", COUNT, lambda x: x.count),
)


def _count_lines(found: TreeList) -> tuple[Section[TreeCount], Iterator[TreeCount]]:
    query = found.query
    lines = (TreeCount(n, *pair) for n, by_root in found.counts for pair in query.roots(by_root))
    return COUNTED, lines


REPORT: Report[TreeList] = Report(
    "gark/trees/1",
    "report of gark trees",
    lambda: [LISTED, COUNTS],
    lambda x: COUNTS if x.rows is None else LISTED,
    lambda x: {"colours": [str(l + 1) for l in range(x.query.colours)], "is_inserted": True},
    key="",
    lines=_count_lines,
)


_LETTERS = {"q": "V", "p": "F", "y": "f"}
_PROBLEMS = {
    "semi-separable": "H = H1(q, p) + H2(q)",
    "separable": "H = H1(p) + H2(q)",
    "nystrom": "H = H1(p) + H2(q) with H1 quadratic",
}


class SymplecticSubject(Frozen):
    """``kind`` is ``pair`` for structures without name; in a ``structure`` roots change colour."""

    kind: Symplectic
    structure: Structure
    names: tuple[str, ...]
    orders: range
    method: AnyTableau | None = None

    @cached_property
    def counts(self) -> tuple[tuple[int, int, int], ...]:
        admissible = self._admissible
        lacks_blocks = admissible != self.structure.admissible
        every = counts_upto(admissible, self.orders[-1])
        found = []
        for n in self.orders:
            if lacks_blocks:
                independent = sum(1 for _ in self._of_order(n))
            else:
                independent = symplectic.count_classes(self.structure, n)
            found.append((n, independent, sum(every[n - 1])))
        return tuple(found)

    @property
    def _admissible(self) -> Admissible:
        if self.method is None:
            return self.structure.admissible
        from garkcli.order.admissible import coupling_graph

        tableau = printed(self.method)
        return coupling_graph(tableau)

    def classes(self) -> Iterator[symplectic.ConditionClass]:
        for n in self.orders:
            yield from self._of_order(n)

    def _of_order(self, order: int) -> Iterator[symplectic.ConditionClass]:
        classes = symplectic.independent_classes(self.structure, order)
        if self.method is None:
            return classes
        from garkcli.order.admissible import is_admissible

        tableau = printed(self.method)
        return (c for c in classes if is_admissible(tableau, c.representative))

    @property
    def independent(self) -> int:
        return sum(k for _, k, _ in self.counts)

    @property
    def has_colours(self) -> bool:
        return len(self.names) > 1

    def members(self, tree: symplectic.ConditionClass) -> list[str]:
        return [format_tree(u, self.has_colours) for u in tree.members]

    @property
    def legend(self) -> str:
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
    Row("kind", choice(*symplectic.KINDS), lambda x: x.kind, Level.DATA),
    Row("terms", POSITION, lambda x: len(x.structure.leaders), Level.DATA),
    Row("colours", TEXTS, lambda x: x.names, Level.DATA),
    Row("count", COUNT, lambda x: x.independent, Level.DATA),
    Row("instead_of", COUNT, lambda x: x.all_conditions, Level.DATA),
)


def subject_of_kind(kind: Symplectic, terms: int | None, orders: range) -> SymplecticSubject:
    """UsageProblem if the kind does not exist with so many terms."""
    if terms is None:
        terms = 2 if kind in _PROBLEMS else 1
    try:
        structure = symplectic.structure_of(kind, terms)
    except ValueError as error:
        cure = "leave out --colours, or choose another --kind"
        raise UsageProblem(f"--colours {terms}: {error}", cure, code="option-value") from None
    names = []
    for term, part in structure.colours:
        names.append(f"{_LETTERS[part]}{term + 1}")
    return SymplecticSubject(kind, structure, tuple(names), orders)


def subject_of_method(method: AnyTableau, orders: range) -> SymplecticSubject:
    """A partitioned method or its own conjugate as it is, of any other the symplectic pair.
    UsageProblem for a partitioned one that is not symplectic, or linear in one part; ZeroWeight
    without pair.
    """
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


def _kind(structure: Structure) -> Symplectic:
    if not structure.is_directed:
        return "self-conjugate"
    for kind in symplectic.KINDS:
        if kind in _PROBLEMS and symplectic.structure_of(kind) == structure:
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


class FreeList(Frozen):
    subject: SymplecticSubject
    classes: Iterable[symplectic.ConditionClass] | None
    with_members: bool = False


class ListedClass(NamedTuple):
    subject: SymplecticSubject
    found: symplectic.ConditionClass

    @property
    def tree(self) -> Tree:
        return self.found.representative

    @property
    def order(self) -> int:
        return self.found.order


class ClassCount(Frozen):
    kind: str
    order: int
    count: int
    instead_of: int


def _by_order(x: FreeList) -> dict[str, int] | None:
    counts = x.subject.counts
    return {str(n): few for n, few, _ in counts} if len(counts) > 1 else None


def _subject(x: FreeList) -> SymplecticSubject:
    return x.subject


FREE_HEAD: Rows[FreeList] = (
    Row("order", POSITION, lambda x: x.subject.orders[-1], DATA),
    Row("upto", TRUTH, lambda x: len(x.subject.orders) > 1, DATA),
    *via(_subject, SUBJECT.rows),
)
END: Row[FreeList] = sentence(lambda x: x.subject.summary)


def _listing(*members: Row[ListedClass]) -> Section[FreeList]:
    part: Section[ListedClass] = Section(
        picture(lambda x: x.tree),
        Row("kind", choice(*symplectic.KINDS), lambda x: x.subject.kind, DATA),
        Row("representative", BRACKETS, lambda x: x.tree, label="tree"),
        SIZES,
        Row("stands_for", POSITION, lambda x: len(x.found.members)),
        drawn(lambda x: x.tree),
        members,
    )
    classes: Row[FreeList] = Row(
        "classes",
        stream(part, lambda x, _: f"order {x.tree.order}"),
        lambda x: (ListedClass(x.subject, found) for found in x.classes or ()),
    )
    return Section(FREE_HEAD, sentence(lambda x: x.subject.legend), classes, END)


LISTED_CLASSES = _listing()
WITH_MEMBERS = _listing(optional("members", TREES, lambda x: x.subject.members(x.found)))
FREE_COUNTS: Section[FreeList] = Section(
    FREE_HEAD,
    optional("by_order", counts("order"), _by_order, DATA),
    Row(
        "counts",
        rows_of(lambda x, _: [(f"order {n}", f"{k} instead of {m}") for n, k, m in x]),
        lambda x: x.subject.counts,
    ),
    END,
)
FREE_COUNTED: Section[ClassCount] = Section(
    Row("kind", choice(*symplectic.KINDS), lambda x: x.kind),
    Row("order", COUNT, lambda x: x.order),
    Row("count", COUNT, lambda x: x.count),
    Row("instead_of", COUNT, lambda x: x.instead_of),
)


def _form(x: FreeList) -> Section[FreeList]:
    if x.classes is None:
        return FREE_COUNTS
    return WITH_MEMBERS if x.with_members else LISTED_CLASSES


FREE_TREES: Report[FreeList] = Report(
    "gark/symplectic-trees/1",
    "report of gark trees --symplectic",
    lambda: [WITH_MEMBERS, FREE_COUNTS],
    _form,
    lambda x: {"colours": x.subject.names, "is_inserted": True},
    key="",
    lines=lambda x: (
        FREE_COUNTED,
        [ClassCount(x.subject.kind, *counts) for counts in x.subject.counts],
    ),
)


def trees_report_schema() -> Schema:
    return published("report of gark trees", one_of(*REPORT.documents, *FREE_TREES.documents))
