"""``gark conditions``: the rows of order conditions, of all methods or with the values of one."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cache

from flint import fmpq

from garkcli.constructions.derivatives import is_derivatives
from garkcli.constructions.nprk import is_nprk
from garkcli.constructions.nystrom import is_nystrom
from garkcli.constructions.rosenbrock import is_rosenbrock
from garkcli.errors import counted
from garkcli.exact.display import decimal, shortest, to_decimal, to_latex
from garkcli.exact.parametric import Parametric
from garkcli.exact.rewriting import decimal_latex
from garkcli.frozen import Frozen, Mutable
from garkcli.ntrees.notation import condition_latex, condition_text, format_tree, vertex_letters
from garkcli.ntrees.tree import Tree
from garkcli.order.conditions import Condition
from garkcli.order.meant import AnyTableau, printed, tolerance_of
from garkcli.page import schema as S  # noqa: N812 -- its names are those of kinds too
from garkcli.page.lines import numbered
from garkcli.report.other_methods import OF_NPRK_TREES, OF_NYSTROM_TREES
from garkcli.report.trees import DATA, DETAIL, SIZES, SUBJECT, TREES, SymplecticSubject, picture
from garkcli.tableau.tableau import Tableau
from garkcli.tell import facts, kinds
from garkcli.tell.dialect import LONG, Plain
from garkcli.tell.parts import part, sentence, stream, told
from garkcli.tell.report import Report

MOST_DECIMALS = 20


class ConditionRow(Frozen):
    """A condition; if ``is_shape`` of all colourings of a tree, with ``members`` of its class."""

    tree: Tree
    is_shape: bool
    condition: Condition | None = None
    stands_for: int = 0
    members: tuple[Tree, ...] = ()

    def text(self, has_colours: bool = True) -> str:
        return condition_text(self.tree, self.letters, has_colours or self.is_shape)

    def latex(self, has_colours: bool = True) -> str:
        return condition_latex(self.tree, self.letters, has_colours or self.is_shape)

    @property
    def letters(self) -> tuple[str, ...] | None:
        """A letter for the colour of each vertex, if the row is for all colours."""
        return vertex_letters(self.tree) if self.is_shape else None


class Valued(Frozen):
    """Conditions with values; those that hold are counted but not shown if ``only_failing``."""

    method: AnyTableau
    only_failing: bool = False
    parameters: tuple[str, ...] = ()
    derivation: str = ""

    @property
    def tableau(self) -> Tableau:
        return printed(self.method)

    @property
    def tolerance(self) -> fmpq | None:
        return tolerance_of(self.method)

    @property
    def names(self) -> list[str]:
        return [colour.name for colour in self.tableau.colours]

    def shows(self, row: ConditionRow) -> bool:
        fails = row.condition is not None and not row.condition.holds
        return fails or row.condition is None or not self.only_failing


class ConditionTable(Mutable):
    """``coloured`` is the number of colours, 0 for all colourings, a subject or a method; rows are
    the independent conditions of a ``subject``; ``count`` rows so far, ``failed`` ones included.
    """

    rows: Iterable[ConditionRow]
    coloured: int = 0
    subject: SymplecticSubject | None = None
    valued: Valued | None = None
    with_members: bool = False
    digits: int | None = None
    count: int = 0
    failed: int = 0

    @property
    def colours(self) -> Sequence[str]:
        about = self.subject or self.valued
        return about.names if about else [str(l + 1) for l in range(self.coloured or 1)]

    @property
    def form(self) -> facts.Section[ConditionTable]:
        is_shapes = not (self.subject or self.valued or self.coloured)
        left_out = {"for_all": not is_shapes, "multiplicity": self.subject is not None}
        left_out |= {"stands_for": self.subject is None, "members": not self.with_members}
        return _form(self.valued is not None, frozenset(k for k, out in left_out.items() if out))

    def shown(self) -> Iterator[ConditionRow]:
        for row in self.rows:
            self.count += 1
            self.failed += row.condition is not None and not row.condition.holds
            if self.valued is None or self.valued.shows(row):
                yield row

    @property
    def legend(self) -> str:
        if self.subject is not None:
            return self.subject.legend
        if self.valued is not None:
            return legend_of(self.valued.tableau)
        legend = numbered(self.colours)
        return f"colours: {legend}" if legend else ""

    @property
    def summary(self) -> str:
        verdict = (
            "" if self.valued is None or not self.count else _verdict(self.failed, self.valued)
        )
        if self.subject is None:
            return ", ".join(filter(None, [counted(self.count, "condition"), verdict]))
        return "; ".join(filter(None, [self.subject.summary, verdict]))


def legend_of(tableau: Tableau) -> str:
    """Returns the names of colours, with meanings for other methods than GARK methods. Empty if
    names are numbers.
    """
    about = numbered([colour.name for colour in tableau.colours]), *_about_colours(tableau)
    told = "; ".join(filter(None, about))
    return f"colours: {told}" if told else ""


def _about_colours(tableau: Tableau) -> Iterator[str]:
    if is_rosenbrock(tableau):
        if tableau.size == 2:
            yield "A{1,1} = A{1,2} is α, A{2,1} = A{2,2} is β = α + γ"
        else:
            yield "blocks of f are α, those of f' are β = α + γ"
    elif is_nprk(tableau):
        yield OF_NPRK_TREES
        yield "a stage is a pair (j, k); A{1,1} has the rows a_j, A{1,2} the rows a_k"
    elif is_derivatives(tableau):
        yield "A and b are of stages on the exact solutions whose derivatives are used"
    elif is_nystrom(tableau):
        yield OF_NYSTROM_TREES
        blocks = "A{1,1} = A{2,1} is Ā", "A{1,2} = A{2,2} is A", "A{1,3} = A{2,3} is c"
        has_A = (0, 1) in tableau.blocks
        yield ", ".join(blocks if has_A else blocks[::2])


def _verdict(failed: int, valued: Valued) -> str:
    if valued.parameters:
        verb = "does" if failed == 1 else "do"
        return f"{failed} {verb} not hold for every value" if failed else "all hold for every value"
    if failed:
        return "1 fails" if failed == 1 else f"{failed} fail"
    if valued.tolerance is None:
        return "all hold"
    return f"all hold within {decimal(valued.tolerance)}"


def is_parametric(number: object) -> bool:
    return isinstance(number, Parametric)


def _number(condition: Condition, key: str, d: Plain) -> str:
    """Returns a number, in decimals if it or the residual beside it is long, or on request."""
    x = getattr(condition, key)
    if d.places is not None:
        return kinds.NUMERAL(x).words(d)
    texts = [shortest(y) for y in (x, condition.residual)]
    is_long = any(len(text) > (MOST_DECIMALS if "." in text else LONG) for text in texts)
    if key == "required" or not x or not is_long or is_parametric(x):
        return d.expression(shortest(x), lambda: to_latex(x))
    if key == "residual":
        text = to_decimal(x, 4)
        return d.formula(decimal_latex(text), text)
    text = to_decimal(x, 8)
    return d.formula(rf"\approx {decimal_latex(text)}", f"about {text}")


def _numeral(key: str, level: facts.Level) -> facts.Row[Condition]:
    kind: facts.Kind[Condition] = facts.Kind(
        facts.Json(S.NUMERAL, lambda x, d: kinds.numeral_text(getattr(x, key), d)),
        facts.Words(lambda x, d: _number(x, key, d)),
    )
    return facts.Row(key, kind, lambda x: x, level)


def _state(condition: Condition, d: Plain) -> str:
    if is_parametric(condition.residual):
        return d.note("varies")
    if not condition.holds:
        return d.bad("FAILS")
    return d.good("holds" if condition.is_exact else "within")


def _formula(row: ConditionRow, d: Plain) -> str:
    has_colours = len(d.colours) > 1
    return d.expression(row.text(has_colours), lambda: row.latex(has_colours))


def _in_words(row: ConditionRow, d: Plain) -> str:
    lines = [f"{row.text(len(d.colours) > 1)}   {_multiplicity(row)}".rstrip()]
    condition = row.condition
    if condition is not None and not (condition.is_exact and d.is_brief):
        kind = _kind(condition)
        kind = f"  ({_seen(condition, d)}{kind} condition)" if kind and len(d.colours) > 1 else ""
        off = "" if condition.is_exact else f", off by {_number(condition, 'residual', d)}"
        lines.append(f"is {_number(condition, 'value', d)}{off}{kind}")
    if row.members:
        lines.append("  ".join(map(d.tree, row.members)))
    return "\n".join(lines)


def _seen(condition: Condition, d: Plain) -> str:
    """The tree of one colour that makes a condition a diagonal one, unless it is shown."""
    alone = [tree for tree in condition.trees if len(tree.colours) == 1]
    if not alone or condition.tree in alone:
        return ""
    return f"also of {d.tree(alone[0])}: "


def _kind(condition: Condition) -> str | None:
    if not condition.tree.is_of_fields:
        return None
    return "coupling" if condition.is_coupling else "diagonal"


def _multiplicity(row: ConditionRow) -> str:
    if row.stands_for:
        return f"stands for {row.stands_for}"
    if row.condition is not None and row.condition.twins:
        return f"(for {len(row.condition.trees)} trees)"
    return f"∀ {','.join(row.letters)}" if row.letters else ""


def _for_all(letters: Sequence[str], d: Plain) -> str:
    text = ",".join(letters)
    return d.formula(rf"\forall\, {text}", text)


TREE: facts.Kind[ConditionRow] = facts.Kind(
    facts.Json(S.TEXT, lambda x, _: format_tree(x.tree, not x.is_shape)),
    facts.Words(lambda x, d: d.tree(x.tree)),
)
FORMULA: facts.Kind[ConditionRow] = facts.Kind(
    facts.Json(S.TEXT, lambda x, _: x.text()), facts.Words(_formula)
)
FOR_ALL: facts.Kind[Sequence[str]] = facts.Kind(
    facts.Json(S.array(S.TEXT), lambda x, _: list(x), csv=lambda _: {}), facts.Words(_for_all)
)
HOLDS: facts.Kind[Condition] = facts.Kind(
    facts.Json(S.FLAG, lambda x, _: x.holds), facts.Words(_state)
)
_TREE: facts.Rows[ConditionRow] = (
    picture(lambda x: x.tree),
    facts.itself("tree", TREE),
    facts.maybe("root", kinds.INDEX, lambda x: None if x.is_shape else x.tree.root, DATA),
    *SIZES[1:],
    facts.itself("condition", FORMULA, DETAIL),
    facts.optional("for_all", FOR_ALL, lambda x: x.letters, DETAIL),
)
_OF_CONDITION: facts.Rows[Condition] = (
    _numeral("value", DETAIL),
    _numeral("required", DATA),
    _numeral("residual", DETAIL),
    facts.itself("holds", HOLDS),
    facts.maybe("kind", kinds.choice("coupling", "diagonal"), _kind, DATA),
    facts.optional("multiplicity", kinds.POSITION, lambda x: len(x.trees), DATA),
)
_VALUES: facts.Rows[ConditionRow] = facts.via(lambda x: x.condition, _OF_CONDITION)
_CLASS: facts.Rows[ConditionRow] = (
    facts.optional("stands_for", kinds.POSITION, lambda x: x.stands_for or None, DETAIL),
    facts.optional("members", TREES, lambda x: [format_tree(u) for u in x.members] or None, DATA),
    facts.itself("condition", told(_in_words), is_short=True),
)
_OF_METHOD: facts.Rows[Valued] = (
    facts.Row("derivation", kinds.DERIVATION, lambda x: x.derivation, DATA),
    facts.Row("colours", kinds.TEXTS, lambda x: x.names, DATA),
    facts.maybe("tolerance", kinds.TOLERANCE, lambda x: x.tolerance, DATA),
)


@cache
def row_of(has_values: bool, left_out: frozenset[str] = frozenset()) -> facts.Section[ConditionRow]:
    rows = (*_TREE, *(_VALUES if has_values else ()), *_CLASS)
    return facts.Section(row for row in rows if row.key not in left_out)


@cache
def _form(
    has_values: bool, left_out: frozenset[str] = frozenset()
) -> facts.Section[ConditionTable]:
    return facts.Section(
        facts.via(lambda x: x.valued, _OF_METHOD if has_values else ()),
        sentence(lambda x: x.legend),
        facts.optional("symplectic", part(SUBJECT), lambda x: x.subject, DATA),
        facts.Row(
            "conditions",
            stream(row_of(has_values, left_out), lambda x, _: f"order {x.tree.order}"),
            lambda x: x.shown(),
        ),
        sentence(lambda x: x.summary),
    )


REPORT: Report[ConditionTable] = Report(
    "gark/conditions/1",
    "report of gark conditions",
    lambda: [_form(False), _form(True)],
    lambda x: x.form,
    lambda x: {"colours": x.colours, "places": x.digits, "is_inserted": True},
    key="",
)
