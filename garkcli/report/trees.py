"""``gark trees``: the rows of lists and of counts of rooted trees."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import NamedTuple, Protocol, TypeAlias, TypeVar

from garkcli.errors import counted
from garkcli.frozen import Frozen, Mutable
from garkcli.ntrees.drawing import draw_text
from garkcli.ntrees.notation import parse_tree
from garkcli.ntrees.tree import Tree
from garkcli.page.schema import TEXT, array, counts_of
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Json, Kind, Level, Row, Rows, Section, Words, itself, optional
from garkcli.tell.kinds import COUNT, INDEX, POSITION, TRUTH
from garkcli.tell.parts import rows_of, sentence, stream, told
from garkcli.tell.report import Report

Counts: TypeAlias = Sequence[tuple[int, tuple[int, ...]]]
"""For each order, the numbers of trees by root colour."""
DRAWN_ORDER = 4
"""Up to this order a terminal shows the drawn trees too, with -v all."""
DETAIL, DATA = Level.DETAIL, Level.DATA
T = TypeVar("T")


class Query(Frozen):
    """The request: colours count from 1 in ``root`` and from 0 in ``used``."""

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
    """One tree: its text, root colour from 0, order, symmetry σ and density γ."""

    tree: str
    root: int
    order: int
    sigma: int
    gamma: int


class TreeList(Mutable):
    """Trees, and their numbers if these are known before; no rows if they are only counted."""

    query: Query
    rows: Iterable[TreeRow] | None
    known: Counts | None

    @property
    def counts(self) -> Counts:
        """The numbers of trees; of those listed if nothing else tells them."""
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
    """The tree in LaTeX."""
    return itself("picture", told(lambda x, d: d.sketch(tree(x))), DETAIL, label="")


def drawn(tree: Callable[[T], Tree]) -> Row[T]:
    """The tree on a terminal, if it is small."""

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
"""Trees in brackets."""


def counts(what: str) -> Kind[dict[str, int]]:
    return Kind(Json(counts_of(what)))


class HasTree(Protocol):
    """A row about a tree."""

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
