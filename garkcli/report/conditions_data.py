"""``gark conditions``: what its table shows, declared once; its JSON in pieces, a row each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any, NamedTuple

from flint import fmpq

from garkcli.exact.display import to_decimal, to_text
from garkcli.exact.field import Number
from garkcli.order.conditions import Condition
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.json_text import to_json
from garkcli.report.symplectic_subject import SUBJECT, Subject
from garkcli.tableau.meant import AnyTableau, printed, tolerance_of
from garkcli.tableau.tableau import Tableau
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Kind, Row, Section
from garkcli.tell.kinds import POSITION, TEXT, TEXTS, TOLERANCE, TRUTH, choice, constant
from garkcli.trees.notation import condition_latex, condition_text, format_tree, vertex_letters
from garkcli.trees.tree import Tree


@dataclass(frozen=True)
class ConditionRow:
    """One line of the table.

    Attributes:
        tree: the tree; its colours mean nothing where ``is_shape``.
        is_shape: whether the row stands for all colourings of the tree.
        condition: its value for a method, where there is one.
        stands_for: how many conditions are equivalent to it in a symplectic method; 0 where nobody
            asked.
        members: the trees of these conditions, where asked for.
        digits: of values in decimals; None for exact ones.
    """

    tree: Tree
    is_shape: bool
    condition: Condition | None = None
    stands_for: int = 0
    members: tuple[Tree, ...] = ()
    digits: int | None = None

    @property
    def formula(self) -> str:
        """The condition in the paper's notation, in plain text."""
        return condition_text(self.tree, self._letters)

    @property
    def latex(self) -> str:
        """The condition in the paper's notation, in LaTeX."""
        return condition_latex(self.tree, self._letters)

    @property
    def _letters(self) -> tuple[str, ...] | None:
        """A letter for the colour of each vertex, where the row is for all colours."""
        return vertex_letters(self.tree) if self.is_shape else None


@dataclass(frozen=True)
class Valued:
    """What a table with values is about.

    Attributes:
        method: its tableau, with its rounding where it is rounded.
        only_failing: whether conditions that hold are counted but not shown.
        parameters: the free ones, of which values are rational functions.
        derivation: whether the method is the conjugate or the pair of what a file gives.
    """

    method: AnyTableau
    only_failing: bool = False
    parameters: tuple[str, ...] = ()
    derivation: str = ""

    @property
    def tableau(self) -> Tableau:
        """As it is printed."""
        return printed(self.method)

    @property
    def tolerance(self) -> fmpq | None:
        """The rounding of its coefficients; None where they are exact."""
        return tolerance_of(self.method)

    @property
    def names(self) -> list[str]:
        """The names of the colours."""
        return [colour.name for colour in self.tableau.colours]

    def shows(self, row: ConditionRow) -> bool:
        """Whether a row is in the table."""
        fails = row.condition is not None and not row.condition.holds
        return fails or row.condition is None or not self.only_failing


def shown(value: Number, digits: int | None) -> str:
    """A number as text, exactly or with so many digits."""
    return to_text(value) if digits is None else to_decimal(value, digits)


class Scope(NamedTuple):
    """What the table is about."""

    subject: Subject | None
    valued: Valued | None


SCHEMA = "gark/conditions/1"
_NUMERAL = Kind(S.NUMERAL, words=lambda text, d: d.expression(text))


def _value(key: str) -> Row:
    return Row(key, _NUMERAL, lambda x: shown(getattr(x.condition, key), x.digits))


def _multiplicity(row: ConditionRow) -> int | None:
    """How many identical conditions the row is; None where equivalent ones are counted."""
    if row.condition is None or row.stands_for:
        return None
    return len(row.condition.trees)


_TREE = (
    Row("tree", TEXT, lambda x: format_tree(x.tree, not x.is_shape)),
    Row("root", POSITION, lambda x: None if x.is_shape else x.tree.root + 1, has_null=True),
    Row("order", POSITION, lambda x: x.tree.order),
    Row("sigma", POSITION, lambda x: x.tree.symmetry, label="σ"),
    Row("gamma", POSITION, lambda x: x.tree.density),
    Row("condition", TEXT, lambda x: x.formula),
    Row(
        "for_all",
        TEXTS,
        lambda x: list(vertex_letters(x.tree)) if x.is_shape else None,
        is_optional=True,
    ),
)
_VALUES = (
    *map(_value, ("value", "required", "residual")),
    Row("holds", TRUTH, lambda x: x.condition.holds),
    Row(
        "kind",
        choice("coupling", "diagonal"),
        lambda x: "coupling" if x.condition.is_coupling else "diagonal",
    ),
    Row("multiplicity", POSITION, _multiplicity, is_optional=True),
)
_CLASS = (
    Row("stands_for", POSITION, lambda x: x.stands_for or None, is_optional=True),
    Row("members", TEXTS, lambda x: [format_tree(u) for u in x.members] or None, is_optional=True),
)
_OF_METHOD = (
    Row("derivation", Kind(S.DERIVATION), lambda x: x.valued.derivation),
    Row("colours", TEXTS, lambda x: x.valued.names),
    Row("tolerance", TOLERANCE, lambda x: x.valued.tolerance, has_null=True),
)
_NAME = Row("schema", constant(SCHEMA), lambda _: SCHEMA)
_INDEPENDENT = Row(
    "symplectic",
    Kind(SUBJECT.schema, lambda x, _: SUBJECT.data(x)),
    lambda x: x.subject,
    is_optional=True,
)
_HEADS = (Section(_NAME, _INDEPENDENT), Section(_NAME, *_OF_METHOD, _INDEPENDENT))
_ROWS = (Section(*_TREE, *_CLASS), Section(*_TREE, *_VALUES, *_CLASS))
"""Both without values, and with those of a method."""


def section_of(row: ConditionRow) -> Section:
    """What tells a row."""
    return _ROWS[row.condition is not None]


def row_data(row: ConditionRow) -> dict[str, Any]:
    """One row as plain data."""
    return section_of(row).data(row, Plain())


def json_of(
    rows: Iterable[ConditionRow], subject: Subject | None, valued: Valued | None
) -> Iterator[str]:
    """The table as pieces of JSON.

    Args:
        rows: its rows.
        subject: where the rows are the independent conditions alone, what they are independent for.
        valued: where the rows have values, of what.
    """
    head = _HEADS[valued is not None].data(Scope(subject, valued), Plain())
    about = (f'"{key}": {to_json(x, indent=None, ascii_only=True)}, ' for key, x in head.items())
    yield "{" + "".join(about) + '"conditions": ['
    separator = "\n"
    for row in rows:
        yield separator + to_json(row_data(row), indent=None)
        separator = ",\n"
    yield "\n]}\n"


def conditions_report_schema() -> S.Schema:
    """The JSON Schema of these reports: of all methods, or with the values of one."""
    forms = []
    for head, row in zip(_HEADS, _ROWS, strict=True):
        form = head.schema
        properties = {**form["properties"], "conditions": S.array(row.schema)}
        forms.append(
            {**form, "required": [*form["required"], "conditions"], "properties": properties}
        )
    return S.published("report of gark conditions", S.one_of(*forms))
