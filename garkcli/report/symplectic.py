"""``gark trees --symplectic``: the rows of free trees, one a class of equivalent conditions."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

from garkcli.frozen import Frozen
from garkcli.ntrees.symplectic import KINDS, ConditionClass
from garkcli.ntrees.tree import Tree
from garkcli.page.schema import Schema, one_of, published
from garkcli.report import trees
from garkcli.report.symplectic_subject import SUBJECT, SymplecticSubject
from garkcli.report.trees import BRACKETS, DATA, SIZES, TREES, counts, drawn, picture
from garkcli.tell.facts import Row, Rows, Section, optional, via
from garkcli.tell.kinds import COUNT, POSITION, TRUTH, choice
from garkcli.tell.parts import rows_of, sentence, stream
from garkcli.tell.report import Report


class FreeList(Frozen):
    """Free trees, a class of conditions each; None if they are only counted."""

    subject: SymplecticSubject
    classes: Iterable[ConditionClass] | None
    with_members: bool = False


class ListedClass(NamedTuple):
    """A class among those of a subject."""

    subject: SymplecticSubject
    found: ConditionClass

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
    """The classes of each order if there are several orders."""
    counts = x.subject.counts
    return {str(n): few for n, few, _ in counts} if len(counts) > 1 else None


def _subject(x: FreeList) -> SymplecticSubject:
    return x.subject


HEAD: Rows[FreeList] = (
    Row("order", POSITION, lambda x: x.subject.orders[-1], DATA),
    Row("upto", TRUTH, lambda x: len(x.subject.orders) > 1, DATA),
    *via(_subject, SUBJECT.rows),
)
END: Row[FreeList] = sentence(lambda x: x.subject.summary)


def _listing(*members: Row[ListedClass]) -> Section[FreeList]:
    """A class in a line, with its members if they are requested."""
    part: Section[ListedClass] = Section(
        picture(lambda x: x.tree),
        Row("kind", choice(*KINDS), lambda x: x.subject.kind, DATA),
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
    return Section(HEAD, sentence(lambda x: x.subject.legend), classes, END)


LISTED = _listing()
WITH_MEMBERS = _listing(optional("members", TREES, lambda x: x.subject.members(x.found)))
COUNTS: Section[FreeList] = Section(
    HEAD,
    optional("by_order", counts("order"), _by_order, DATA),
    Row(
        "counts",
        rows_of(lambda x, _: [(f"order {n}", f"{k} instead of {m}") for n, k, m in x]),
        lambda x: x.subject.counts,
    ),
    END,
)
COUNTED: Section[ClassCount] = Section(
    Row("kind", choice(*KINDS), lambda x: x.kind),
    Row("order", COUNT, lambda x: x.order),
    Row("count", COUNT, lambda x: x.count),
    Row("instead_of", COUNT, lambda x: x.instead_of),
)


def _form(x: FreeList) -> Section[FreeList]:
    if x.classes is None:
        return COUNTS
    return WITH_MEMBERS if x.with_members else LISTED


REPORT: Report[FreeList] = Report(
    "gark/symplectic-trees/1",
    "report of gark trees --symplectic",
    lambda: [WITH_MEMBERS, COUNTS],
    _form,
    lambda x: {"colours": x.subject.names, "is_inserted": True},
    key="",
    lines=lambda x: (COUNTED, [ClassCount(x.subject.kind, *counts) for counts in x.subject.counts]),
)


def trees_report_schema() -> Schema:
    """The JSON Schema of ``gark trees``: rooted trees or free ones, listed or counted."""
    return published("report of gark trees", one_of(*trees.REPORT.documents, *REPORT.documents))
