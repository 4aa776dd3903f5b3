"""The independent conditions of symplectic methods: which they are, how many, and the reports on
their trees.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import groupby, zip_longest
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from garkcli.errors import UsageProblem
from garkcli.report.json_text import to_json
from garkcli.report.latex import fragment
from garkcli.report.paint import Paint, counted
from garkcli.report.trees import DRAWN_ORDER, picture
from garkcli.trees.count import Admissible, counts_upto
from garkcli.trees.drawing import draw_text
from garkcli.trees.free import Structure
from garkcli.trees.notation import format_latex, format_tree
from garkcli.trees.symplectic import (
    KINDS,
    ConditionClass,
    Kind,
    count_classes,
    independent_classes,
    structure_of,
)

if TYPE_CHECKING:
    from garkcli.tableau.tableau import Tableau

WIDTH = 80
_DRAWING = 60
"""The column at which the drawn trees begin."""
_LETTERS = {"q": "V", "p": "F", "y": "f"}
_PROBLEMS = {
    "semi-separable": "H = H1(q, p) + H2(q)",
    "separable": "H = H1(p) + H2(q)",
    "nystrom": "H = H1(p) + H2(q) with H1 quadratic",
}


@dataclass(frozen=True)
class Subject:
    """What the report is about: the symplectic methods of a kind, or one of them.

    Attributes:
        kind: the kind; ``pair`` also where a method's structure has no name.
        structure: its colours, and how roots move among them.
        names: the names of the colours.
        orders: the orders asked for.
        tableau: the method, where there is one.
    """

    kind: Kind
    structure: Structure
    names: tuple[str, ...]
    orders: range
    tableau: Tableau | None = None

    @cached_property
    def counts(self) -> tuple[tuple[int, int, int], ...]:
        """For each order the independent conditions and all conditions."""
        admissible = self._admissible
        every = counts_upto(admissible, self.orders[-1])
        if admissible == self.structure.admissible:
            independent = [count_classes(self.structure, n) for n in self.orders]
        else:  # a tableau that lacks blocks
            independent = [sum(1 for _ in self._of_order(n)) for n in self.orders]
        totals = [sum(every[n - 1]) for n in self.orders]
        return tuple(zip(self.orders, independent, totals, strict=True))

    @property
    def _admissible(self) -> Admissible:
        """The trees that have a condition."""
        if self.tableau is None:
            return self.structure.admissible
        from garkcli.order.conditions import coupling_graph

        return Admissible.of(self.tableau.size, *coupling_graph(self.tableau))

    def classes(self) -> Iterator[ConditionClass]:
        """The classes of all orders."""
        for n in self.orders:
            yield from self._of_order(n)

    def _of_order(self, order: int) -> Iterator[ConditionClass]:
        classes = independent_classes(self.structure, order)
        if self.tableau is None:
            return classes
        from garkcli.order.conditions import is_admissible

        tableau = self.tableau
        return (c for c in classes if is_admissible(tableau, c.representative))

    @property
    def independent(self) -> int:
        """The independent conditions of all orders."""
        return sum(k for _, k, _ in self.counts)

    @property
    def has_colours(self) -> bool:
        """Whether trees are written with their colours."""
        return len(self.names) > 1

    def text(self, tree: ConditionClass) -> str:
        """The representative of a class in bracket text."""
        return format_tree(tree.representative, self.has_colours)

    def members(self, tree: ConditionClass) -> list[str]:
        """The rooted trees of a class in bracket text."""
        return [format_tree(u, self.has_colours) for u in tree.members]

    @property
    def legend(self) -> str:
        """What the numbers of the colours mean; empty where there is one colour."""
        if not self.has_colours:
            return ""
        pairs = [f"{l} {name}" for l, name in enumerate(self.names, 1)]
        return f"colours: {', '.join(pairs)}"

    @property
    def summary(self) -> str:
        """How many conditions are left, in words."""
        few, many = self.independent, self._all_conditions
        conditions = counted(few, "independent condition")
        which = "of order" if len(self.orders) == 1 else "up to order"
        instead = "" if few == many else f", instead of {many}"
        return f"{conditions} {which} {self.orders[-1]} for {self._problem}{instead}"

    @property
    def _all_conditions(self) -> int:
        """The conditions of all orders, were the method not symplectic."""
        return sum(k for _, _, k in self.counts)

    @property
    def _problem(self) -> str:
        terms = len(self.structure.leaders)
        if self.kind == "pair":
            return f"a symplectic pair of {counted(terms, 'Hamiltonian')}"
        if self.kind == "self-conjugate":
            return f"a self-conjugate method of {counted(terms, 'vector field')}"
        return _PROBLEMS[self.kind]

    def data(self) -> dict[str, Any]:
        """The same for JSON."""
        return {
            "kind": self.kind,
            "terms": len(self.structure.leaders),
            "colours": list(self.names),
            "count": self.independent,
            "instead_of": self._all_conditions,
        }


def subject_of_kind(kind: Kind, terms: int | None, orders: range) -> Subject:
    """The symplectic methods of a kind.

    Raises:
        UsageProblem: the kind does not exist with so many terms.
    """
    if terms is None:
        terms = 2 if kind in _PROBLEMS else 1
    try:
        structure = structure_of(kind, terms)
    except ValueError as error:
        raise UsageProblem(
            f"--colours {terms}: {error}",
            "leave out --colours, or choose another --kind",
        ) from None
    names = tuple(f"{_LETTERS[part]}{term + 1}" for term, part in structure.colours)
    return Subject(kind, structure, names, orders)


def subject_of_method(tableau: Tableau, orders: range) -> Subject:
    """One method: a partitioned one or its own conjugate as it stands, of any other the symplectic
    pair.

    Raises:
        UsageProblem: a partitioned method that is not symplectic, or linear in positions or in
            momenta only.
        ZeroWeight: the pair would divide by zero.
    """
    from garkcli.tableau.conjugate import is_symplectic
    from garkcli.tableau.forms import pair

    if not is_symplectic(tableau):
        if tableau.is_partitioned:
            raise _not_symplectic(tableau)
        tableau = pair(tableau)
    split = tableau.is_partitioned
    colours = tuple(
        (x.space if split else l, x.part) for l, x in enumerate(tableau.colours)
    )
    natures = list(zip(colours, tableau.colours, strict=True))
    quadratic = frozenset(term for (term, _), x in natures if x.is_linear)
    for (term, _), x in natures:
        if term in quadratic and not x.is_linear:
            raise UsageProblem(
                f"colour {x.name} is not linear, as the other colour of its stages is",
                "such a term of the Hamiltonian has no classes; make both linear or none",
            )
    structure = Structure(colours, quadratic)
    names = tuple(x.name for x in tableau.colours)
    return Subject(_kind(structure), structure, names, orders, tableau)


def _kind(structure: Structure) -> Kind:
    if not structure.is_directed:
        return "self-conjugate"
    for kind in KINDS:
        if kind in _PROBLEMS and structure_of(kind) == structure:
            return kind
    return "pair"


def _not_symplectic(tableau: Tableau) -> UsageProblem:
    weights = {(x.space, x.b) for x in tableau.colours}
    if len(weights) > len({rows for rows, _ in weights}):
        reason = "positions and momenta have different weights at the same stages"
        return UsageProblem(
            f"the method is not symplectic: {reason}", "give both the same weights"
        )
    reason = "its momentum blocks are not the conjugates of its position blocks"
    return UsageProblem(
        f"the method is not symplectic: {reason}",
        "with --pair they become the conjugates",
    )


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
        yield (
            to_json(_head(subject), indent=None, ascii_only=True)[:-1]
            + ', "classes": ['
        )
        for k, tree in enumerate(classes):
            separator = ",\n" if k else "\n"
            yield separator + to_json(
                _data(subject, tree, with_members), indent=None, ascii_only=True
            )
        yield "\n]}\n"
    elif format == "ndjson":
        for tree in classes:
            yield (
                to_json(
                    _data(subject, tree, with_members), indent=None, ascii_only=True
                )
                + "\n"
            )
    elif format == "csv":
        yield from _csv(subject, classes, with_members)
    elif format == "latex":
        yield from fragment(_latex(subject, classes), is_document)
    else:
        yield from _text(subject, classes, paint, with_members)


def _csv(
    subject: Subject, classes: Iterable[ConditionClass], with_members: bool
) -> Iterator[str]:
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
        head = _head(subject)
        if len(subject.orders) > 1:
            head["by_order"] = {str(n): few for n, few, _ in subject.counts}
        yield (
            to_json(head, indent=None if format == "ndjson" else 2, ascii_only=True)
            + "\n"
        )
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
            yield f"order {n}: {paint('strong', str(few))} instead of {many}\n"
        yield from summary_lines(subject)


def summary_lines(
    subject: Subject, ending: str = "", width: int = WIDTH
) -> Iterator[str]:
    """The summary, in lines of at most ``width``."""
    yield from (line + "\n" for line in _wrapped(subject.summary + ending, width))


def legend_lines(subject: Subject, width: int = WIDTH) -> Iterator[str]:
    """The meaning of the colours, in lines of at most ``width``."""
    yield from (line + "\n" for line in _wrapped(subject.legend, width, " " * 9))


def _wrapped(text: str, width: int, indent: str = "") -> list[str]:
    """Lines of whole words; numbers of hundreds of digits stay whole too."""
    return wrap(
        text,
        width,
        subsequent_indent=indent,
        break_long_words=False,
        break_on_hyphens=False,
    )


def member_lines(members: Iterable[str], width: int = WIDTH) -> list[str]:
    """Trees of a class below its representative."""
    lines: list[str] = []
    for tree in members:
        if lines and len(lines[-1]) + 2 + len(tree) <= width:
            lines[-1] += f"  {tree}"
        else:
            lines.append(f"      {tree}")
    return lines


def _head(subject: Subject) -> dict[str, Any]:
    orders = subject.orders
    scope = {"order": orders[-1], "upto": len(orders) > 1}
    return {"schema": "gark/symplectic-trees/1", **scope, **subject.data()}


def _data(subject: Subject, tree: ConditionClass, with_members: bool) -> dict[str, Any]:
    here = tree.representative
    data: dict[str, Any] = {
        "kind": subject.kind,
        "representative": subject.text(tree),
        "root": here.root + 1,
        "order": here.order,
        "sigma": here.symmetry,
        "gamma": here.density,
        "stands_for": len(tree.members),
    }
    if with_members:
        data["members"] = subject.members(tree)
    return data


def _text(
    subject: Subject,
    classes: Iterable[ConditionClass],
    paint: Paint,
    with_members: bool,
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
    yield from (f"% {line}" for line in legend_lines(subject))
    yield "\\begin{longtable}{clcccc}\n  \\hline\n"
    yield "  & $u$ & $\\rho(u)$ & $\\sigma(u)$ & $\\gamma(u)$ & stands for \\\\ \\hline\n"
    for tree in classes:
        u = tree.representative
        formula = format_latex(u, subject.has_colours)
        sizes = f"{u.order} & {u.symmetry} & {u.density} & {len(tree.members)}"
        yield f"  {picture(u)} &\n  ${formula}$ & {sizes} \\\\\n"
    yield "  \\hline\n\\end{longtable}\n"
