"""``gark trees``: a stream of rows in every format, so that the first lines appear at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import NamedTuple, TypeAlias

from garkcli.page.json_text import to_json
from garkcli.page.latex import fragment
from garkcli.page.paint import Paint, counted, folded
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import COUNT, FLAG, POSITION, TEXT, Schema, counts_of
from garkcli.trees.drawing import draw_text, tikz
from garkcli.trees.notation import format_latex, parse_tree
from garkcli.trees.tree import Tree

SCHEMA = "gark/trees/1"
Counts: TypeAlias = Sequence[tuple[int, tuple[int, ...]]]
"""For each order, the numbers of trees by root colour."""
WIDTH = 80
"""Columns of a terminal that nobody has made wider."""
DRAWN_ORDER = 4
"""Up to this order the text shows the drawn trees too."""
DRAWING = 54
"""The column of the drawings, with room for sigma and gamma in letters."""


@dataclass(frozen=True)
class Query:
    """What was asked for: colours count from 1 in ``root`` and from 0 in ``used``."""

    colours: int
    order: int
    upto: bool
    root: int | None
    used: tuple[int, ...] = ()


class TreeRow(NamedTuple):
    """One tree: its text, root colour from 0, order, symmetry σ and density γ."""

    tree: str
    root: int
    order: int
    sigma: int
    gamma: int


def render(
    query: Query,
    rows: Iterable[TreeRow],
    counts: Counts | None,
    format: str,
    paint: Paint,
    is_document: bool = False,
) -> Iterator[str]:
    """The rows as pieces of text, each a whole line or more."""
    if format == "json":
        yield from _json(query, rows, counts)
    elif format == "ndjson":
        for row in rows:
            line = _json_line(row)
            yield f"{line}\n"
    elif format == "csv":
        yield "tree,root,order,sigma,gamma\n"
        for row in rows:
            root = row.root + 1
            sizes = f"{row.order},{row.sigma},{row.gamma}"
            yield f'"{row.tree}",{root},{sizes}\n'
    elif format == "latex":
        yield from fragment(_latex(rows, query.colours > 1), is_document)
    else:
        yield from _text(query, rows, counts, paint)


def render_counts(query: Query, counts: Counts, format: str, paint: Paint) -> Iterator[str]:
    """The counts alone."""
    if format in {"json", "ndjson"}:
        head = _COUNTED.data(_Found(query, counts))
        indent = None if format == "ndjson" else 2
        yield to_json(head, indent=indent, ascii_only=True) + "\n"
        return
    if format == "csv":
        yield "order,root,count\n"
        for n, by_root in counts:
            for root, count in _roots(query, by_root):
                yield f"{n},{root},{count}\n"
        return
    for n, by_root in counts:
        total = sum(kept(query, by_root))
        if format == "latex":
            yield f"{n} & {total} \\\\\n"
            continue
        painted = paint("strong", str(total))
        yield f"order {n}: {painted}\n"
        if query.colours > 1:
            for root, count in _roots(query, by_root):
                yield f"  root colour {root}: {count}\n"


def _roots(query: Query, by_root: Sequence[int]) -> list[tuple[int, int]]:
    numbered = enumerate(by_root, start=1)
    return [(l, count) for l, count in numbered if query.root in {None, l}]


def kept(query: Query, by_root: Sequence[int]) -> list[int]:
    """The numbers of the root colours that were asked for."""
    return [count for _, count in _roots(query, by_root)]


class _Found(NamedTuple):
    """What was asked for, and how many trees there are."""

    query: Query
    counts: Counts

    @property
    def by_root(self) -> dict[str, int]:
        """The trees of each root colour."""
        total: dict[str, int] = {}
        for _, row in self.counts:
            for root, count in _roots(self.query, row):
                key = str(root)
                total[key] = total.get(key, 0) + count
        return total

    @property
    def by_order(self) -> dict[str, int] | None:
        """The trees of each order, where there are several."""
        if not self.query.upto:
            return None
        totals = {}
        for n, row in self.counts:
            totals[str(n)] = sum(kept(self.query, row))
        return totals

    @property
    def total(self) -> int:
        """All trees."""
        return sum(self.by_root.values())


_ROW: Record[TreeRow] = Record(
    Field("tree", TEXT, lambda x: x.tree),
    Field("root", POSITION, lambda x: x.root + 1),
    Field("order", POSITION, lambda x: x.order),
    Field("sigma", POSITION, lambda x: x.sigma),
    Field("gamma", POSITION, lambda x: x.gamma),
)
_HEAD: Record[_Found] = Record(
    schema_named(SCHEMA),
    Field("colours", POSITION, lambda x: x.query.colours),
    Field("order", POSITION, lambda x: x.query.order),
    Field("upto", FLAG, lambda x: x.query.upto),
    Field("count", COUNT, lambda x: x.total),
    Field("by_root", counts_of("root colour"), lambda x: x.by_root),
)
_BY_ORDER: Field[_Found] = Field(
    "by_order", counts_of("order"), lambda x: x.by_order, is_optional=True
)
_COUNTED: Record[_Found] = Record(*_HEAD.fields, _BY_ORDER)


def rooted_schemas() -> list[Schema]:
    """The JSON Schemas of lists and of counts of rooted trees."""
    return [_HEAD.with_rows("trees", _ROW), _COUNTED.schema]


def _json(query: Query, rows: Iterable[TreeRow], counts: Counts | None) -> Iterator[str]:
    if counts is None:
        rows = list(rows)
        counts = _counted(query, rows)
    found = _HEAD.data(_Found(query, counts))
    head = to_json(found, indent=None, ascii_only=True)
    unclosed = head.removesuffix("}")
    yield f'{unclosed}, "trees": ['
    separator = "\n"
    for row in rows:
        yield separator + _json_line(row)
        separator = ",\n"
    yield "\n]}\n"


def _json_line(row: TreeRow) -> str:
    data = _ROW.data(row)
    return to_json(data, indent=None, ascii_only=True)


def _counted(query: Query, rows: Sequence[TreeRow]) -> Counts:
    first = 1 if query.upto else query.order
    orders = range(first, query.order + 1)
    found = {n: [0] * query.colours for n in orders}
    for row in rows:
        found[row.order][row.root] += 1
    return [(n, tuple(by_root)) for n, by_root in found.items()]


def _text(
    query: Query, rows: Iterable[TreeRow], counts: Counts | None, paint: Paint
) -> Iterator[str]:
    many = query.colours > 1
    groups = groupby(rows, key=lambda row: (row.order, row.root))
    for (n, root), group in groups:
        heading = f"order {n}"
        if many:
            heading += f", root colour {root + 1}"
        painted = paint("strong", heading)
        yield f"{painted}\n"
        for row in group:
            yield from map(paint.dots, _entry(row, many))
    if counts is not None:
        total = 0
        for _, by_root in counts:
            total += sum(kept(query, by_root))
        trees = counted(total, "tree")
        yield f"{trees}\n"


def _entry(row: TreeRow, many: bool) -> Iterator[str]:
    text = f"  {row.tree:<28} σ = {row.sigma:<4} γ = {row.gamma}"
    if row.order > DRAWN_ORDER:
        lines = [text]
        if len(text.rstrip()) > WIDTH:
            sizes = text[len(row.tree) + 2 :]
            lines = folded(f"  {row.tree}", WIDTH, "    ")
            lines.append(f"     {sizes}")
        for line in lines:
            yield line.rstrip() + "\n"
        return
    first, *rest = draw_text(parse_tree(row.tree), many)
    line = f"{text:<{DRAWING}}{first}"
    yield line.rstrip() + "\n"
    for line in rest:
        yield f"{'':<{DRAWING}}{line}\n"


def _latex(rows: Iterable[TreeRow], many: bool) -> Iterator[str]:
    yield "\\begin{longtable}{clccc}\n  \\hline\n"
    yield "  & $u$ & $\\rho(u)$ & $\\sigma(u)$ & $\\gamma(u)$ \\\\ \\hline\n"
    for row in rows:
        tree = parse_tree(row.tree)
        formula = format_latex(tree, many)
        sizes = f"{row.order} & {row.sigma} & {row.gamma}"
        yield f"  {picture(tree)} &\n"
        yield f"  ${formula}$ & {sizes} \\\\\n"
    yield "  \\hline\n\\end{longtable}\n"


def picture(tree: Tree, colours: bool = True) -> str:
    """A drawing for a cell of a LaTeX table whose rows are indented by two."""
    return tikz(tree, colours=colours).strip().replace("\n", "\n  ")
