"""``gark modified``: the modified equation of a method, and its orders."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from garkcli.backward.formulas import ModifiedFormula, PowerTerm
from garkcli.backward.summary import BackwardAnalysis, Reached
from garkcli.errors import counted
from garkcli.exact.display import to_decimal
from garkcli.exact.field import Number
from garkcli.frozen import Frozen
from garkcli.ntrees.tree import Tree
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.lines import numbered
from garkcli.reason import NO_REASON, Reason
from garkcli.report.problem import describe
from garkcli.tell import facts, kinds
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.parts import SAID, part, parts, rows_of, table, told
from garkcli.tell.report import Report

HEADLINE, USUAL, DETAIL, DATA = facts.Level
MOST_TERMS = 10
_FORMLESS = Reason("no Hamiltonian problem has its form")


class ModifiedReport(Frozen):
    """With ``with_equation`` rooted trees are shown although there is a Hamiltonian."""

    file: str
    name: str
    found: BackwardAnalysis
    derivation: str = ""
    digits: int | None = None
    with_equation: bool = False
    formula: ModifiedFormula | None = None

    @property
    def names(self) -> tuple[str, ...]:
        return tuple(x.name for x in self.found.equation.tableau.colours)


class ModifiedTerm(NamedTuple):
    """A term of the modified equation or Hamiltonian: b(u)/σ(u), or over |Aut T| of a free tree."""

    tree: Tree
    symmetry: int
    coefficient: Number


def _size(factor: Number, d: Plain) -> str:
    """Returns the decimals of a factor; none in documents, whose tables have no room for them."""
    return "" if d.breadth == "page" else to_decimal(factor, 4)


TERM: facts.Section[ModifiedTerm] = facts.Section(
    facts.Row(
        "power", told(lambda x, d: d.formula(f"h^{{{x}}}", f"h^{x}")), lambda x: x.tree.order - 1
    ),
    facts.Row("picture", told(lambda x, d: d.sketch(x)), lambda x: x.tree, label=""),
    facts.Row("tree", kinds.TREE, lambda x: x.tree),
    facts.Row("root", kinds.INDEX, lambda x: x.tree.root, DATA),
    facts.Row("order", kinds.POSITION, lambda x: x.tree.order, DATA),
    facts.Row("symmetry", kinds.POSITION, lambda x: x.symmetry),
    facts.Row("coefficient", kinds.NUMERAL, lambda x: x.coefficient),
    facts.Row("factor", kinds.NUMERAL, lambda x: x.coefficient / x.symmetry),
    facts.Row("value", told(_size), lambda x: x.coefficient / x.symmetry, facts.Level.DETAIL),
)
"""A term of Σ h^(ρ−1) b(u)/σ F(u), or of Σ h^(ρ−1) b(u)/|Aut| H(u) over free trees."""


def _equation(report: ModifiedReport) -> facts.Answer[list[ModifiedTerm]]:
    """Returns the terms; of a rounded method without those that are zero within the tolerance."""
    found = report.found
    zero = range(2, found.order.order + 1) if found.tolerance is not None else ()
    terms = [
        ModifiedTerm(tree, tree.symmetry, coefficient)
        for n in range(1, found.equation.max_order + 1)
        if n not in zero
        for tree, coefficient in found.equation.terms(n)
    ]
    is_told = report.formula is None and (found.hamiltonian is None or report.with_equation)
    return facts.Answer(terms, level=USUAL if is_told else DATA)


def _hamiltonian(report: ModifiedReport) -> facts.Answer[list[ModifiedTerm]]:
    found = report.found.hamiltonian
    terms = (
        None
        if found is None
        else [ModifiedTerm(x.tree.representative, x.tree.symmetry, x.coefficient) for x in found]
    )
    return facts.Answer(terms, level=USUAL if report.formula is None else DATA)


def unknowns_of(formula: ModifiedFormula) -> list[str]:
    positions = list(formula.problem.variables)
    return [*positions, *(f"p{name}" for name in positions)]


def _text(formula: object) -> str:
    return str(formula).replace("**", "^")


def _latex(formula: object) -> str:
    import sympy

    return str(sympy.latex(formula))


def _formula_rows(formula: ModifiedFormula, d: Plain) -> Iterator[tuple[str, str]]:
    """The terms of each power of h; of an equation for each unknown."""
    is_hamiltonian = formula.of == "hamiltonian"
    unknowns = ["H"] if is_hamiltonian else [f"{x}'" for x in unknowns_of(formula)]
    highest = d.formula(f"h^{{{formula.max_order - 1}}}", f"h^{formula.max_order - 1}")
    yield "problem", d.prose(describe(formula.problem))
    yield "modified Hamiltonian" if is_hamiltonian else "modified equation", f"up to {highest}"
    for term in formula.terms:
        power = d.formula(f"h^{{{term.power}}}", f"h^{term.power}") if term.power else ""
        for unknown, x in zip(unknowns, term.formulas, strict=True):
            label = f"{d.prose(unknown)} {power}".strip()
            yield label, d.expression(_text(x), lambda x=x: _latex(x))  # type: ignore[misc]


def formula_latex(formula: ModifiedFormula) -> str:
    """The modified Hamiltonian or equation, multiplied out, as an ``align*``."""
    terms = formula.expanded().terms
    left_sides = [r"\tilde H"]
    if formula.of != "hamiltonian":
        left_sides = [rf"\dot{{{unknown}}}" for unknown in unknowns_of(formula)]
    rows = (_row(left, terms, k) for k, left in enumerate(left_sides))
    return "\\begin{{align*}}\n{}\n\\end{{align*}}\n".format(" \\\\\n".join(rows))


def _row(left: str, terms: Sequence[PowerTerm], component: int) -> str:
    sides = ((term.power, _latex(term.formulas[component])) for term in terms)
    parts_of = [rf"h^{{{n}}} \Bigl({x}\Bigr)" if n else x for n, x in sides if x != "0"]
    joined = " \\\\\n    &\\quad + ".join(parts_of) or "0"
    return f"  {left} &= {joined}"


POWER: facts.Section[PowerTerm] = facts.Section(
    facts.Row("power", kinds.COUNT, lambda x: x.power),
    facts.Row("formulas", kinds.TEXTS, lambda x: [_text(y) for y in x.formulas]),
)
FORMULA: facts.Section[ModifiedFormula] = facts.Section(
    facts.Row("problem", kinds.TEXT, lambda x: x.problem.name),
    facts.Row("of", kinds.choice("hamiltonian", "equation"), lambda x: x.of),
    facts.Row("unknowns", kinds.TEXTS, unknowns_of),
    facts.Row("max_power", kinds.COUNT, lambda x: x.max_order - 1),
    facts.Row("terms", parts(POWER), lambda x: x.terms),
)


REACHED: facts.Kind[int] = facts.Kind(
    facts.Json(
        S.COUNT,
        beside=(
            facts.FieldBeside(
                "*order_is_lower_bound",
                S.nullable(S.FLAG),
                lambda a, _: a.status.at_least,
                is_optional=False,
            ),
        ),
    ),
    facts.Words(lambda x, _: str(x)),
)


def _order(
    key: str, get: Callable[[BackwardAnalysis], Reached | None], level: facts.Level = HEADLINE
) -> facts.Row[BackwardAnalysis]:
    def answer(x: BackwardAnalysis) -> facts.Answer[int]:
        reached = get(x)
        if reached is None:
            return facts.Answer(None, reason=_FORMLESS)
        return facts.Answer(reached.order, Status(x.tolerance, reached.is_lower_bound))

    return facts.maybe(key, REACHED, answer, level)


def _symplectic(x: BackwardAnalysis) -> facts.Answer[bool]:
    is_formless = x.structure is None and x.tolerance is None
    status = Status(x.tolerance if x.is_symplectic else None)
    return facts.Answer(x.is_symplectic, status, _FORMLESS if is_formless else NO_REASON)


def _vertices(report: ModifiedReport) -> str:
    count = report.found.equation.max_order
    vertices = "1 vertex" if count == 1 else f"{count} vertices"
    return f"of up to {vertices}, in {counted(len(report.names), 'colour')}"


def _note(report: ModifiedReport) -> str:
    is_rounded = report.found.tolerance is not None
    return "coefficients of one method within the rounding" if is_rounded else ""


OF_ANALYSIS: facts.Rows[BackwardAnalysis] = (
    _order("order", lambda x: x.order),
    facts.Row("symplectic", kinds.TRUTH, _symplectic, HEADLINE),
    _order("symplectic_order", lambda x: x.symplectic, USUAL),
    _order("energy_order", lambda x: x.energy),
    _order("effective_order", lambda x: x.effective),
)
MODIFIED: facts.Section[ModifiedReport] = facts.Section(
    facts.Row("file", kinds.TEXT, lambda x: x.file, DATA),
    facts.Row("name", kinds.TEXT, lambda x: x.name, DATA),
    facts.Row("derivation", kinds.DERIVATION, lambda x: x.derivation, DATA),
    facts.maybe("tolerance", kinds.TOLERANCE, lambda x: x.found.tolerance, DATA),
    facts.via(lambda x: x.found, OF_ANALYSIS),
    facts.Row("trees", SAID, _vertices),
    facts.Row("colours_in_words", SAID, lambda x: numbered(x.names), label="colours"),
    facts.Row("colours", kinds.TEXTS, lambda x: x.names, DATA),
    facts.Row("max_order", kinds.POSITION, lambda x: x.found.equation.max_order, DATA),
    facts.Row("note", SAID, _note),
    facts.Row("formula_in_words", rows_of(_formula_rows), lambda x: x.formula),
    facts.maybe(
        "hamiltonian",
        table(TERM, MOST_TERMS),
        _hamiltonian,
        label="modified Hamiltonian: Σ h^(ρ−1) b(u)/|Aut| H(u)",
    ),
    facts.Row(
        "equation",
        table(TERM, MOST_TERMS),
        _equation,
        label="modified equation: Σ h^(ρ−1) b(u)/σ F(u)",
    ),
    facts.maybe("formula", part(FORMULA), lambda x: x.formula, DATA),
    title=lambda x, d: d.prose(x.name or x.file),
)
REPORT: Report[ModifiedReport] = Report.only(
    "gark/modified/1",
    "report of gark modified",
    MODIFIED,
    lambda x: {"places": x.digits, "colours": x.names},
)


def whole(found: BackwardAnalysis, name: str) -> ModifiedReport:
    return ModifiedReport(name, name, found)
