"""What ``gark modified`` reports of one file, and its JSON with its schema."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from garkcli.backward.formulas import ModifiedFormula, PowerTerm
from garkcli.backward.hamiltonian import HamiltonianTerm
from garkcli.backward.summary import BackwardAnalysis, Reached
from garkcli.exact.display import decimal, to_decimal, to_text
from garkcli.exact.field import Number
from garkcli.page.record import Field, Record, schema_named
from garkcli.page.schema import (
    COUNT,
    DERIVATION,
    FLAG,
    NUMERAL,
    POSITION,
    TEXT,
    Schema,
    array,
    nullable,
    published,
)
from garkcli.trees.notation import format_tree
from garkcli.trees.tree import Tree

SCHEMA = "gark/modified/1"


@dataclass(frozen=True)
class TreeTerm:
    """One term of the modified equation or Hamiltonian.

    Attributes:
        tree: the rooted tree u, or the representative of a free tree.
        symmetry: σ(u), or |Aut T|.
        coefficient: b(u).
    """

    tree: Tree
    symmetry: int
    coefficient: Number

    @property
    def factor(self) -> Number:
        """What multiplies F(u) or H(u)."""
        return self.coefficient / self.symmetry


@dataclass(frozen=True)
class ModifiedReport:
    """What is printed of one file.

    Attributes:
        file: its path as given.
        name: the name of the method.
        found: its modified equation.
        derivation: "pair" or "conjugate" where it was made of the file; else empty.
        digits: of decimals; None for exact numbers.
        with_equation: whether rooted trees are shown where there is a Hamiltonian.
        formula: on a problem, where one was asked for; multiplied out.
    """

    file: str
    name: str
    found: BackwardAnalysis
    derivation: str = ""
    digits: int | None = None
    with_equation: bool = False
    formula: ModifiedFormula | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the colours."""
        return tuple(x.name for x in self.found.equation.tableau.colours)

    def number(self, value: Number) -> str:
        """A coefficient as text."""
        return to_text(value) if self.digits is None else to_decimal(value, self.digits)

    @property
    def equation(self) -> Iterator[TreeTerm]:
        """The coefficients b(u) that are not zero.

        Of rounded coefficients those of the orders that the method has are left out but for order
        1: they are zero within the tolerance.
        """
        equation = self.found.equation
        is_rounded = self.found.tolerance is not None
        for n in range(1, equation.max_order + 1):
            if is_rounded and 1 < n <= self.found.order.order:
                continue
            for tree, coefficient in equation.terms(n):
                yield TreeTerm(tree, tree.symmetry, coefficient)

    @property
    def hamiltonian(self) -> list[TreeTerm] | None:
        """The terms of the modified Hamiltonian; None where there is none."""
        if self.found.hamiltonian is None:
            return None
        return [_of_free_tree(term) for term in self.found.hamiltonian]


def _of_free_tree(term: HamiltonianTerm) -> TreeTerm:
    return TreeTerm(term.tree.representative, term.tree.symmetry, term.coefficient)


def unknowns_of(formula: ModifiedFormula) -> list[str]:
    """The names of positions and momenta."""
    positions = list(formula.problem.variables)
    return [*positions, *(f"p{name}" for name in positions)]


def as_data(report: ModifiedReport) -> dict[str, Any]:
    """The report as plain data."""
    return _REPORT.data(report)


def render_json(report: ModifiedReport) -> str:
    """The report as JSON text."""
    return _REPORT.text(report)


def modified_report_schema() -> Schema:
    """The JSON Schema of these reports, as plain data."""
    return published("report of gark modified", _REPORT.schema)


def _order_fields(
    name: str, part: Callable[[BackwardAnalysis], Reached | None]
) -> tuple[Field[ModifiedReport], Field[ModifiedReport]]:
    """An order, and whether it is a lower bound; both null where it is not decided."""

    def order(report: ModifiedReport) -> int | None:
        reached = part(report.found)
        return None if reached is None else reached.order

    def is_lower_bound(report: ModifiedReport) -> bool | None:
        reached = part(report.found)
        return None if reached is None else reached.is_lower_bound

    return (
        Field(name, nullable(COUNT), order),
        Field(f"{name}_is_lower_bound", nullable(FLAG), is_lower_bound),
    )


def _tolerance(report: ModifiedReport) -> str | None:
    tolerance = report.found.tolerance
    return None if tolerance is None else decimal(tolerance)


def _formulas(term: PowerTerm) -> list[str]:
    return [formula_text(x) for x in term.formulas]


def formula_text(formula: Any) -> str:
    """A formula as problem files write it."""
    return str(formula).replace("**", "^")


def _equation(report: ModifiedReport) -> list[tuple[ModifiedReport, TreeTerm]]:
    return [(report, term) for term in report.equation]


def _hamiltonian(report: ModifiedReport) -> list[dict[str, Any]] | None:
    terms = report.hamiltonian
    if terms is None:
        return None
    return [_TERM.data((report, term)) for term in terms]


_TERM: Record[tuple[ModifiedReport, TreeTerm]] = Record(
    Field("tree", TEXT, lambda x: format_tree(x[1].tree)),
    Field("root", POSITION, lambda x: x[1].tree.root + 1),
    Field("order", POSITION, lambda x: x[1].tree.order),
    Field("symmetry", POSITION, lambda x: x[1].symmetry),
    Field("coefficient", NUMERAL, lambda x: x[0].number(x[1].coefficient)),
    Field("factor", NUMERAL, lambda x: x[0].number(x[1].factor)),
)
_POWER: Record[PowerTerm] = Record(
    Field("power", COUNT, lambda x: x.power), Field("formulas", array(TEXT), _formulas)
)
_FORMULA: Record[ModifiedFormula] = Record(
    Field("problem", TEXT, lambda x: x.problem.name),
    Field("of", {"enum": ["hamiltonian", "equation"]}, lambda x: x.of),
    Field("unknowns", array(TEXT), unknowns_of),
    Field("max_power", COUNT, lambda x: x.max_order - 1),
    _POWER.every("terms", lambda x: x.terms),
)
_REPORT: Record[ModifiedReport] = Record(
    schema_named(SCHEMA),
    Field("file", TEXT, lambda x: x.file),
    Field("name", TEXT, lambda x: x.name),
    Field("derivation", DERIVATION, lambda x: x.derivation),
    Field("tolerance", nullable(TEXT), _tolerance),
    Field("colours", array(TEXT), lambda x: list(x.names)),
    Field("max_order", POSITION, lambda x: x.found.equation.max_order),
    *_order_fields("order", lambda x: x.order),
    Field("symplectic", FLAG, lambda x: x.found.is_symplectic),
    *_order_fields("symplectic_order", lambda x: x.symplectic),
    *_order_fields("energy_order", lambda x: x.energy),
    *_order_fields("effective_order", lambda x: x.effective),
    _TERM.every("equation", _equation),
    Field("hamiltonian", nullable(array(_TERM.schema)), _hamiltonian),
    _FORMULA.or_null("formula", lambda x: x.formula),
)
