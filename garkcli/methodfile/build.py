"""A description to a method: the one place where files meet mathematics."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from yaml.nodes import Node

from garkcli.errors import (
    GarkError,
    MethodError,
    MethodFileError,
    ShapeMismatch,
)
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix
from garkcli.families.registry import diagonal_method
from garkcli.methodfile.description import (
    ArkText,
    ButcherText,
    ClaimText,
    Description,
    FamilyText,
    Form,
    MatrixText,
    MethodsText,
    PrkText,
    RuleText,
    Structure,
    TableauText,
    block_name,
)
from garkcli.methodfile.numbers import Entry, Numbers, Row
from garkcli.methodfile.source import Source
from garkcli.methodfile.values import Values
from garkcli.order.certificate import find_order
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import (
    additive,
    gark,
    partitioned,
    separable_prk,
    spelled_out,
    symplectic_pair,
    with_linear,
)
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.method import Method, butcher
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import (
    PAIR_RULES,
    RULES,
    Rule,
    build_on,
    combination,
    symplectic_blocks,
)

if TYPE_CHECKING:
    from garkcli.methodfile.printed import Printed

T = TypeVar("T")
Blocks: TypeAlias = dict[tuple[int, int], Matrix]


@dataclass(frozen=True, repr=False, kw_only=True)
class MethodFile(GarkMethod):
    """One method file, read: the method that it describes, and what else it says.

    Attributes:
        source: the path as given, or ``<stdin>``.
        text: the file as it was read.
        form: which of the four forms the coefficients have.
        structure: which vector fields the problem has.
        is_conjugate: whether the file describes the conjugate of what it spells out.
        claims: what ``expect`` says.
        printed: the coefficients as they are written.
    """

    source: str
    text: str
    form: Form
    structure: Structure
    is_conjugate: bool
    claims: tuple[ClaimText, ...]
    reference: str = ""
    description: str = ""
    printed: Printed = field(default=(), repr=False, compare=False)


class Builder:
    """Builds the tableau of one description; what the mathematics refuses becomes a fault at its
    place.
    """

    def __init__(
        self,
        source: Source,
        values: Values,
        families: Mapping[int, Method],
        nodes: Mapping[int, Row],
    ) -> None:
        self.source = source
        self.values = values
        self.families = families
        self.nodes = nodes

    def tableau(self, description: Description) -> Tableau:
        """The tableau that the file describes.

        Raises:
            MethodFileError: the numbers do not make a method.
        """
        content = description.content
        match content:
            case MethodsText():
                tableau = self._methods(content, description.structure)
            case TableauText():
                tableau = self._spelled_out(content)
            case ArkText():
                A = [self.values.matrix(rows) for rows in content.A]
                b = [self.values.vector(row) for row in content.b]
                tableau = additive(
                    A, b, self.values.vector(content.c) if content.c else None
                )
            case PrkText():
                tableau = self._prk(content, description.structure)
        if description.is_conjugate:
            tableau = self._at(description.node, lambda: conjugate(tableau))
        return tableau

    def _at(self, node: Node, make: Callable[[], T]) -> T:
        """The result of ``make``; what it refuses becomes a fault at ``node``."""
        try:
            return make()
        except MethodFileError:
            raise
        except GarkError as error:
            self.source.fault(node, error.message, error.help)
            raise self.source.error() from None

    def _spelled_out(self, text: TableauText) -> Tableau:
        A = [
            [
                None if rows is None else self.values.matrix(rows)
                for rows in row
            ]
            for row in text.A
        ]
        b = [self.values.vector(row) for row in text.b]
        c = [
            None if row is None else self.values.vector(row) for row in text.c
        ]
        return spelled_out(A, b, c, text.linear)

    def _prk(self, text: PrkText, structure: Structure) -> Tableau:
        q, p = (
            (
                self.values.matrix(part.A),
                self.values.vector(part.b),
                self.values.vector(part.c) if part.c else None,
            )
            for part in (text.q, text.p)
        )
        if structure == "general":
            return partitioned(
                butcher(q[0], q[1], q[2]), butcher(p[0], p[1], p[2])
            )
        tableau = separable_prk(q, p)
        return (
            with_linear(tableau, ["q"]) if structure == "nystrom" else tableau
        )

    # -- methods and transfer
    # -------------------------------------------------------------------------------

    def _methods(self, text: MethodsText, structure: Structure) -> Tableau:
        methods = [
            self._diagonal(l, method) for l, method in enumerate(text.methods)
        ]
        tableau = gark(methods, self._transfer(text, methods, structure))
        if structure == "general":
            return tableau
        velocities, forces = [0], [1]
        if structure == "semi-separable":
            forces = [0, 1]
        both = self._at(
            text.methods[0].node,
            lambda: symplectic_pair(tableau, velocities, forces),
        )
        return with_linear(both, ["V1"]) if structure == "nystrom" else both

    def _diagonal(self, l: int, text: FamilyText | ButcherText) -> Method:
        if isinstance(text, FamilyText):
            method = self.families[l]
            if l not in self.nodes:
                return method
            from garkcli.tableau.pointwise import method_in_points

            return method_in_points(method, self.values.vector(self.nodes[l]))
        c = self.values.vector(text.c) if text.c is not None else None
        return butcher(
            self.values.matrix(text.A),
            self.values.vector(text.b),
            c,
            text.name,
        )

    def _transfer(
        self, text: MethodsText, methods: list[Method], structure: Structure
    ) -> Blocks:
        """The off-diagonal blocks that the structure needs."""
        needed = [
            (l, m)
            for l in range(len(methods))
            for m in range(len(methods))
            if l != m
        ]
        if structure != "general":
            needed = [(1, 0)]
        orders = _Orders(methods)
        blocks: Blocks = {}
        for l, m in needed:
            block = (
                text.transfer.blocks.get((l, m))
                or _pair_rule(text, m, l)
                or text.transfer.default
            )
            try:
                if block is None:
                    raise MethodError(
                        "it has no rule",
                        "give it one, or a default, under transfer",
                    )
                if isinstance(block, MatrixText):
                    blocks[l, m] = self._matrix(block, methods, l, m)
                else:
                    blocks[l, m] = self._by_rule(block, methods, orders, l, m)
            except GarkError as error:
                node = (
                    block.node if block is not None else text.methods[0].node
                )
                message = f"{block_name(l, m)}: {error.message}"
                self.source.fault(node, message, error.help)
        self.source.close()
        return blocks

    def _matrix(
        self, block: MatrixText, methods: list[Method], l: int, m: int
    ) -> Matrix:
        rows, columns = methods[l].stages, methods[m].stages
        found_rows, found_columns = len(block.rows), len(block.rows[0])
        if (found_rows, found_columns) != (rows, columns):
            found = f"a matrix of {found_rows} by {found_columns}"
            message = f"{found} should be {rows} by {columns}"
            cure = f"a row for each stage of method {l + 1},"
            cure += f" a column for each of method {m + 1}"
            raise ShapeMismatch(message, cure)
        return self.values.matrix(block.rows)

    def _by_rule(
        self,
        text: RuleText,
        methods: list[Method],
        orders: _Orders,
        l: int,
        m: int,
    ) -> Matrix:
        rule, weight = text.terms[0]
        if weight is None and rule in PAIR_RULES:
            base = build_on(
                methods, [orders[k] for k in range(len(methods))], l, m
            )
            other = l if base == m else m
            return symplectic_blocks(PAIR_RULES[rule], methods, base, other)[
                l, m
            ]
        if weight is None:
            return RULES[rule](methods[l], methods[m])
        terms: list[tuple[Number, Rule]] = [
            (self.values.number(tau), RULES[name])
            for name, tau in text.terms
            if tau is not None
        ]
        total = sum((tau for tau, _ in terms), start=ZERO)
        if total != ONE:
            raise MethodError(
                f"the weights of the combination sum to {total}, not to 1",
                "weights that sum to 1 keep the block consistent",
            )
        return combination(terms, methods[l], methods[m])


class _Orders:
    """The orders of the diagonal methods, found when first asked for."""

    def __init__(self, methods: list[Method]) -> None:
        self.methods = methods
        self._found: dict[int, int] = {}

    def __getitem__(self, l: int) -> int:
        if l not in self._found:
            self._found[l] = find_order(gark([self.methods[l]], {})).order
        return self._found[l]


def _pair_rule(text: MethodsText, l: int, m: int) -> RuleText | None:
    """The rule given for the block (l, m), when it makes the opposite block too."""
    block = text.transfer.blocks.get((l, m))
    is_pair = isinstance(block, RuleText) and block.terms[0][0] in PAIR_RULES
    return block if is_pair and isinstance(block, RuleText) else None


def families_of(description: Description) -> dict[int, Method]:
    """The methods of a file that are members of families, by number from 0, each made once."""
    content = description.content
    if not isinstance(content, MethodsText):
        return {}
    made: dict[tuple[str, int], Method] = {}
    found: dict[int, Method] = {}
    for l, text in enumerate(content.methods):
        if isinstance(text, FamilyText):
            key = text.name, text.stages
            if key not in made:
                made[key] = diagonal_method(*key)
            found[l] = made[key]
    return found


def nodes_to_spell_out(
    description: Description, families: Mapping[int, Method], numbers: Numbers
) -> dict[int, Row]:
    """For each family that meets a spelled-out block, its nodes as coefficients of the file.

    The entries of such a block refer to single stages, so its methods need one coordinate a stage.
    """
    content = description.content
    if not isinstance(content, MethodsText):
        return {}
    blocks = content.transfer.blocks
    beside = [
        key for key, block in blocks.items() if isinstance(block, MatrixText)
    ]
    rows: dict[int, Row] = {}
    for k in dict.fromkeys(k for key in beside for k in key):
        text = content.methods[k]
        if not isinstance(text, FamilyText):
            continue
        nodes = _family_nodes(text, families[k].space, numbers)
        if nodes is not None:
            rows[k] = nodes
            numbers.entries += nodes
    return rows


def _family_nodes(
    text: FamilyText, space: StageSpace, numbers: Numbers
) -> Row | None:
    """The nodes of a family as coefficients; None where there is nothing to spell out, or a fault
    where it cannot be.
    """
    if not isinstance(space, PolynomialSpace):
        return None
    from garkcli.tableau.pointwise import simple_nodes  # few files need it

    nodes = simple_nodes(space)
    if nodes is None:
        message = f"a block next to {text.name} is spelled out, whose nodes have no simple radicals"
        cure = "make the block by a rule, or spell the method out"
        numbers.source.fault(text.node, message, cure)
        return None
    return tuple(
        Entry(node, text.node, f"node {i} of {text.name}")
        for i, node in enumerate(nodes, start=1)
    )
