"""The independent conditions of symplectic methods: the reports on their trees."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import groupby, zip_longest
from textwrap import wrap
from typing import Any, NamedTuple

from garkcli.page.json_text import to_json
from garkcli.page.latex import fragment
from garkcli.page.paint import Paint, counted
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import FLAG, POSITION, TEXT, Schema, array, counts_of, one_of, published
from garkcli.report.symplectic_subject import SUBJECT, Subject
from garkcli.report.trees import DRAWN_ORDER, picture, rooted_schemas
from garkcli.trees.drawing import draw_text
from garkcli.trees.notation import format_latex
from garkcli.trees.symplectic import KINDS, ConditionClass
from garkcli.trees.tree import Tree

SCHEMA = "gark/symplectic-trees/1"
WIDTH = 80
_DRAWING = 60
"""The column at which the drawn trees begin."""


def render_classes(
    subject: Subject,
    classes: Iterable[ConditionClass],
    format: str,
    paint: Paint,
    with_members: bool = False,
    is_document: bool = False,
) -> Iterator[str]:
    """The classes as pieces of text, each a whole line or more."""
    if format == "json":
        yield _json_line(_HEAD.data(subject))[:-1] + ', "classes": ['
        separator = "\n"
        for tree in classes:
            data = _data(subject, tree, with_members)
            yield separator + _json_line(data)
            separator = ",\n"
        yield "\n]}\n"
    elif format == "ndjson":
        for tree in classes:
            data = _data(subject, tree, with_members)
            yield _json_line(data) + "\n"
    elif format == "csv":
        yield from _csv(subject, classes, with_members)
    elif format == "latex":
        yield from fragment(_latex(subject, classes), is_document)
    else:
        yield from _text(subject, classes, paint, with_members)


def _json_line(data: dict[str, Any]) -> str:
    return to_json(data, indent=None, ascii_only=True)


def _csv(subject: Subject, classes: Iterable[ConditionClass], with_members: bool) -> Iterator[str]:
    ending = ",members" if with_members else ""
    yield f"kind,representative,root,order,sigma,gamma,stands_for{ending}\n"
    for tree in classes:
        data = _data(subject, tree, with_members)
        data["representative"] = f'"{data["representative"]}"'
        if with_members:
            members = " ".join(data["members"])
            data["members"] = f'"{members}"'
        yield ",".join(map(str, data.values())) + "\n"


def render_class_counts(subject: Subject, format: str, paint: Paint) -> Iterator[str]:
    """The numbers of classes alone."""
    if format in {"json", "ndjson"}:
        head = _COUNTED.data(subject)
        indent = None if format == "ndjson" else 2
        yield to_json(head, indent=indent, ascii_only=True) + "\n"
        return
    if format == "csv":
        yield "kind,order,count,instead_of\n"
        for n, few, many in subject.counts:
            yield f"{subject.kind},{n},{few},{many}\n"
    elif format == "latex":
        for n, few, many in subject.counts:
            yield f"{n} & {few} & {many} \\\\\n"
    else:
        for n, few, many in subject.counts:
            count = paint("strong", str(few))
            yield f"order {n}: {count} instead of {many}\n"
        yield from summary_lines(subject)


def summary_lines(subject: Subject, ending: str = "", width: int = WIDTH) -> Iterator[str]:
    """The summary, in lines of at most ``width``."""
    for line in _wrapped(subject.summary + ending, width):
        yield line + "\n"


def legend_lines(subject: Subject, width: int = WIDTH) -> Iterator[str]:
    """The meaning of the colours, in lines of at most ``width``."""
    for line in _wrapped(subject.legend, width, " " * 9):
        yield line + "\n"


def _wrapped(text: str, width: int, indent: str = "") -> list[str]:
    """Lines of whole words; numbers of hundreds of digits stay whole too."""
    return wrap(
        text, width, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False
    )


def member_lines(members: Iterable[str], width: int = WIDTH) -> list[str]:
    """Trees of a class below its representative."""
    lines: list[str] = []
    for tree in members:
        longer = ""
        if lines:
            longer = f"{lines[-1]}  {tree}"
        if longer and len(longer) <= width:
            lines[-1] = longer
        else:
            lines.append(f"      {tree}")
    return lines


def _by_order(subject: Subject) -> dict[str, int] | None:
    """The classes of each order, where there are several."""
    if len(subject.orders) == 1:
        return None
    return {str(n): few for n, few, _ in subject.counts}


_HEAD: Record[Subject] = Record(
    schema_named(SCHEMA),
    Field("order", POSITION, lambda x: x.orders[-1]),
    Field("upto", FLAG, lambda x: len(x.orders) > 1),
    *SUBJECT.fields,
)
_COUNTED: Record[Subject] = Record(
    *_HEAD.fields, Field("by_order", counts_of("order"), _by_order, is_optional=True)
)


class _Class(NamedTuple):
    """One row: a class of trees, and whether its members are listed."""

    subject: Subject
    found: ConditionClass
    with_members: bool

    @property
    def tree(self) -> Tree:
        """The representative."""
        return self.found.representative

    @property
    def members(self) -> list[str] | None:
        """The trees of the class, where they are listed."""
        return self.subject.members(self.found) if self.with_members else None


_ROW: Record[_Class] = Record(
    Field("kind", {"enum": [*KINDS]}, lambda x: x.subject.kind),
    Field("representative", TEXT, lambda x: x.subject.text(x.found)),
    Field("root", POSITION, lambda x: x.tree.root + 1),
    Field("order", POSITION, lambda x: x.tree.order),
    Field("sigma", POSITION, lambda x: x.tree.symmetry),
    Field("gamma", POSITION, lambda x: x.tree.density),
    Field("stands_for", POSITION, lambda x: len(x.found.members)),
    Field("members", array(TEXT), lambda x: x.members, is_optional=True),
)


def _data(subject: Subject, tree: ConditionClass, with_members: bool) -> dict[str, Any]:
    return _ROW.data(_Class(subject, tree, with_members))


def trees_report_schema() -> Schema:
    """The JSON Schema of ``gark trees``: rooted trees or free ones, listed or counted."""
    free = [_HEAD.with_rows("classes", _ROW), _COUNTED.schema]
    return published("report of gark trees", one_of(*rooted_schemas(), *free))


def _text(
    subject: Subject, classes: Iterable[ConditionClass], paint: Paint, with_members: bool
) -> Iterator[str]:
    yield from legend_lines(subject)
    for order, group in groupby(classes, key=lambda tree: tree.order):
        yield paint("strong", f"order {order}") + "\n"
        for tree in group:
            yield from map(paint.dots, _entry(subject, tree, with_members))
    yield from summary_lines(subject)


def _entry(subject: Subject, tree: ConditionClass, with_members: bool) -> Iterator[str]:
    here = tree.representative
    sizes = f"σ = {here.symmetry:<4} γ = {here.density:<5}"
    trees = counted(len(tree.members), "tree")
    lines = [f"  {subject.text(tree):<28} {sizes} {trees}"]
    width, drawing = WIDTH, []
    if tree.order <= DRAWN_ORDER:
        width = _DRAWING - 2
        drawing = draw_text(here, subject.has_colours)
    if with_members:
        lines += member_lines(subject.members(tree), width)
    for left, right in zip_longest(lines, drawing, fillvalue=""):
        line = left.ljust(_DRAWING) + right
        yield line.rstrip() + "\n"


def _latex(subject: Subject, classes: Iterable[ConditionClass]) -> Iterator[str]:
    for line in legend_lines(subject):
        yield f"% {line}"
    yield "\\begin{longtable}{clcccc}\n  \\hline\n"
    yield "  & $u$ & $\\rho(u)$ & $\\sigma(u)$ & $\\gamma(u)$ & stands for \\\\ \\hline\n"
    for tree in classes:
        u = tree.representative
        formula = format_latex(u, subject.has_colours)
        sizes = f"{u.order} & {u.symmetry} & {u.density} & {len(tree.members)}"
        yield f"  {picture(u)} &\n  ${formula}$ & {sizes} \\\\\n"
    yield "  \\hline\n\\end{longtable}\n"
