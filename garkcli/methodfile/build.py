"""The method of a description: the only module where files meet mathematics."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from itertools import chain, permutations
from typing import TYPE_CHECKING, Generic, TypeAlias, TypeVar

from flint import fmpq

from garkcli import transfer as transfer_rules
from garkcli.errors import GarkError, MethodError, MethodFileError, ShapeMismatch
from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.matrix import Matrix, Vector
from garkcli.exact.nodes import Expression
from garkcli.exact.parametric import Parametric
from garkcli.grammar.nodes import Node
from garkcli.grammar.source import Source
from garkcli.methodfile import description as d
from garkcli.methodfile.numbers import Coefficient, Numbers, Row
from garkcli.methodfile.values import Values
from garkcli.order.certificate import find_order
from garkcli.order.meant import AnyTableau, meant
from garkcli.reference import Reference
from garkcli.tableau import forms
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.embedded import DenseOutput, Further, Predictor, padded
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.stages import StageSpace
from garkcli.tableau.tableau import Method, Tableau, butcher

if TYPE_CHECKING:
    pass


Blocks: TypeAlias = dict[tuple[int, int], Matrix]


class BlockBuilder:
    """Makes off-diagonal blocks. Errors of the mathematics become faults of ``source``."""

    def __init__(
        self,
        source: Source,
        values: Values,
        text: d.MethodsText,
        methods: list[Method],
        tolerance: fmpq | None,
    ) -> None:
        self.source = source
        self.values = values
        self.text = text
        self.methods = methods
        self.tolerance = tolerance

    def built(self, is_general: bool) -> Blocks:
        """All blocks, or that where colour 2 sees colour 1; MethodFileError if one fails."""
        blocks: Blocks = {}
        said = set()  # one fault of a rule for several blocks is noted once
        for l, m in permutations(range(len(self.methods)), 2) if is_general else [(1, 0)]:
            text = self._text_of(l, m)
            try:
                blocks[l, m] = self._block(text, l, m)
            except GarkError as error:
                place = self.text.methods[0] if text is None else text
                if (id(place), error.message) in said:
                    continue
                said.add((id(place), error.message))
                message = f"{d.block_name(l, m)}: {error.message}"
                self.source.fault(place.node, message, error.help, code=error.code)
        self.source.close()
        return blocks

    def _text_of(self, l: int, m: int) -> d.MatrixText | d.RuleText | None:
        """The text for a block: its own, that of the opposite block, or the default."""
        transfer = self.text.transfer
        own, opposite = transfer.blocks.get((l, m)), transfer.blocks.get((m, l))
        if (
            own is None
            and isinstance(opposite, d.RuleText)
            and opposite.terms[0][0] in transfer_rules.PAIR_RULES
        ):
            return opposite
        return own or transfer.default

    def _block(self, text: d.MatrixText | d.RuleText | None, l: int, m: int) -> Matrix:
        if text is None:
            cure = "give it one, or a default, under transfer"
            raise MethodError("it has no rule", cure, code="missing-key")
        if isinstance(text, d.MatrixText):
            wanted = self.methods[l].stages, self.methods[m].stages
            shape = len(text.rows), len(text.rows[0])
            if shape != wanted:
                message = "a matrix of {} by {} should be {} by {}".format(*shape, *wanted)
                cure = (
                    f"a row for each stage of method {l + 1}, a column for each of method {m + 1}"
                )
                raise ShapeMismatch(message, cure)
            return self.values.matrix(text.rows)
        rule, weight = text.terms[0]
        if weight is not None:
            return self._combined(text, l, m)
        if rule in transfer_rules.PAIR_RULES:
            base = transfer_rules.build_on(self.methods, self._orders, l, m)
            other = l if base == m else m
            return transfer_rules.symplectic_blocks(
                transfer_rules.PAIR_RULES[rule], self.methods, base, other
            )[l, m]
        return self._rule(rule, text.degree)(self.methods[l], self.methods[m])

    def _combined(self, text: d.RuleText, l: int, m: int) -> Matrix:
        """A combination of rules; MethodError if its weights do not sum to 1."""
        terms = [
            (self.values.number(x), self._rule(rule)) for rule, x in text.terms if x is not None
        ]
        total = sum((tau for tau, _ in terms), start=ZERO)
        if not self.values.once(("sum", id(text)), lambda: total == ONE):
            message = f"the weights of the combination sum to {total}, not to 1"
            cure = "weights that sum to 1 keep the block consistent"
            raise MethodError(message, cure, code="weights-of-combination")
        return transfer_rules.combination(terms, self.methods[l], self.methods[m])

    def _rule(self, name: str, degree: int | None = None) -> transfer_rules.Rule:
        return (
            transfer_rules.RULES[name]
            if name != "legendre"
            else transfer_rules.legendre_rule(self._diagonal_methods, degree)
        )

    @cached_property
    def _diagonal_methods(self) -> list[AnyTableau]:
        return self.values.once(
            ("alone", id(self.text)),
            lambda: [meant(self.values.alone(method), self.tolerance) for method in self.methods],
        )

    @cached_property
    def _orders(self) -> list[int]:
        """The orders of the diagonal methods; MethodError if these have unknowns or radicals."""
        numbers = chain.from_iterable((*chain(*x.A), *x.b) for x in self.methods)
        if any(isinstance(x, Parametric) for x in numbers):
            message = "a symplectic- rule compares orders of numbers, and the file has unknowns"
            cure = "give values, or write the rule without symplectic- for the symplectic pair"
            raise MethodError(message, cure, code="free-parameters")
        return self.values.once(
            ("orders", id(self.text)),
            lambda: [find_order(self.values.alone(method)).order for method in self.methods],
        )


T = TypeVar("T")


class MethodFile(GarkMethod, kw_only=True):
    """A method read from a file, with its claims and its bibliography.

    Attributes:
        source: the path as given, or ``<stdin>``.
        text: the file as it was read.
        form: which of the four forms the coefficients have.
        structure: which vector fields the problem has.
        is_conjugate: whether the file describes the conjugate of what it spells out.
        claims: what ``expect`` says.
        reference: where it was published, in one line.
        description: in whole sentences.
        aliases: what else it is called.
        bibliography: the fields of the reference; None for plain text.
        printed: the coefficients as they are written.
        left_behind: further weights of methods inside of a construction, which it has not.
        rules: what made blocks between diagonal methods, with its degree where the file has one.

    >>> from garkcli import load
    >>> method = load("rk4")
    >>> method.source, [claim.key for claim in method.claims]
    ('rk4', ['order', 'symplectic'])
    """

    besides = frozenset({"printed"})

    source: str
    text: str
    form: d.Form
    structure: d.Structure
    is_conjugate: bool
    claims: tuple[d.ClaimText, ...]
    reference: str = ""
    description: str = ""
    aliases: tuple[str, ...] = ()
    bibliography: Reference | None = None
    printed: Sequence[tuple[Expression, Number]] = ()
    left_behind: tuple[str, ...] = ()
    rules: tuple[d.BlockRule, ...] = ()


V = TypeVar("V", bound=Values)


class Builder(Generic[V]):
    def __init__(self, text: d.PartText, values: V) -> None:
        self.source = text.source
        self.text = text
        self.values = values
        self._parts: dict[int, Tableau] = {}
        self._own: d.Made | None = None
        description = text.description
        self.tableau = self._tableau(description.content, description)
        if description.is_conjugate:
            self.tableau = self._at(description.node, lambda: conjugate(self.tableau))
            self._own = None

    def _tableau(self, content: d.Content, description: d.Description) -> Tableau:
        matrix, vector = self.values.matrix, self.values.vector
        match content:
            case d.MethodsText():
                return self._methods(content, description)
            case d.TableauText(A=A, b=b, c=c, linear=linear):
                return forms.spelled_out(
                    [[None if block is None else matrix(block) for block in row] for row in A],
                    [*map(vector, b)],
                    [None if row is None else vector(row) for row in c],
                    linear,
                )
            case d.ArkText(A=A, b=b, c=c):
                nodes = None if c is None else vector(c)
                return forms.additive([*map(matrix, A)], [*map(vector, b)], nodes)
            case d.PrkText():
                q, p = self._plain(content.q), self._plain(content.p)
                if description.structure == "general":
                    return forms.partitioned(butcher(*q), butcher(*p))
                tableau = forms.separable_prk(q, p)
                is_nystrom = description.structure == "nystrom"
                return forms.with_linear(tableau, ["q"]) if is_nystrom else tableau
            case d.OwnContent():
                rounding = description.rounding
                own = self._at(content.node, lambda: content.made(self.values, rounding))
                self._own = own
                return own.tableau
            case d.ConstructionText():
                for part in content.parts:  # all are built
                    self.part(part)
                made = self._at(content.node, lambda: content.make(self.part, self.values))
                if isinstance(made, Tableau):
                    return made
                tableau, further = made
                self._own = d.Made(tableau, lambda: further)
                return tableau
        raise TypeError(f"no content: {content!r}")

    def part(self, part: d.PartText) -> Tableau:
        if id(part) not in self._parts:
            tableau = Builder(part, self.values).tableau
            self._at(part.description.node, lambda: tableau.demand_fields("a construction"))
            self._parts[id(part)] = tableau
        return self._parts[id(part)]

    @cached_property
    def further(self) -> Further:
        """The further weights; in a pair V^{l} and F^{l} share stages, and so have the same."""
        description, own = self.text.description, self._own
        if own is not None and own.further is not None:
            return self._at(description.node, own.further)
        texts = description.content.beside
        if texts == (d.NOTHING_FURTHER,) * len(texts) and not (own and own.finish):
            return Further()
        given = [texts[colour.term] for colour in self.tableau.colours]
        embedded = [self.values.vector(x.embedded) for x in given if x.embedded is not None]
        blocks = [self.values.matrix(x.dense) for x in given if x.dense is not None]
        dense = None
        if blocks:
            degree = max(len(block[0]) for block in blocks)
            dense = DenseOutput(tuple(padded(x, degree) for x in blocks))
        predictor = self._predictor(texts[0].predictor)
        further = Further(tuple(embedded) or None, dense, predictor)
        return further if own is None or own.finish is None else own.finish(further)

    def _predictor(self, text: d.PredictorText | None) -> Predictor | None:
        if text is None:
            return None
        from garkcli.order.predictor import check_predictor

        if self.text.description.rounding is not None:
            message = "predictor needs exact coefficients, and the file has a tolerance"
            cure = "write exact coefficients, or leave predictor out"
            self.source.fault(text.node, message, cure, code="rounded")
            raise self.source.error()
        powers = max(len(text.old), len(text.new))
        stages = len((text.old or text.new)[0])
        nothing = ((ZERO,) * stages,) * stages
        old, new = (
            (*map(self.values.matrix, x), *(nothing,) * (powers - len(x)))
            for x in (text.old, text.new)
        )
        made = Predictor(old, new)
        self._at(text.node, lambda: check_predictor(self.tableau, made))
        return made

    def _at(self, node: Node, make: Callable[[], T]) -> T:
        try:
            return make()
        except MethodFileError:
            raise
        except GarkError as error:
            self.source.fault(node, error.message, error.help, code=error.code)
            raise self.source.error() from None

    def _plain(self, text: d.ButcherText) -> tuple[Matrix, Vector, Vector | None]:
        c = None if text.c is None else self.values.vector(text.c)
        return self.values.matrix(text.A), self.values.vector(text.b), c

    def _methods(self, text: d.MethodsText, description: d.Description) -> Tableau:
        methods = [self._diagonal(l, method) for l, method in enumerate(text.methods)]
        structure = description.structure
        is_general = structure == "general"
        blocks = BlockBuilder(self.source, self.values, text, methods, description.rounding)
        tableau = forms.gark(methods, blocks.built(is_general))
        if is_general:
            return tableau
        forces = [0, 1] if structure == "semi-separable" else [1]
        both = self._at(text.methods[0].node, lambda: forms.symplectic_pair(tableau, [0], forces))
        return forms.with_linear(both, ["V1"]) if structure == "nystrom" else both

    def _diagonal(self, l: int, text: d.FamilyText | d.ButcherText) -> Method:
        if isinstance(text, d.ButcherText):
            return butcher(*self._plain(text), text.name)
        if l not in self.text.families:
            return text.recipe.make(self.values.vector(text.numbers))
        method = self.text.families[l]
        if l not in self.text.nodes:
            return method
        from garkcli.tableau.pointwise import method_in_points

        return method_in_points(method, self.values.vector(self.text.nodes[l]))


def part_of(
    source: Source, numbers: Numbers, description: d.Description, why: str = ""
) -> d.PartText:
    """A description with its members of families.

    The entries of spelled-out blocks, and weights beside a member, refer to single stages, so all
    methods need one coordinate for each stage; ``why`` says so, or is empty.
    """
    content = description.content
    if not isinstance(content, d.MethodsText):
        return d.PartText(source, description, {}, {})
    made: dict[object, Method] = {}
    families: dict[int, Method] = {}
    for l, text in enumerate(content.methods):
        if isinstance(text, d.FamilyText) and not text.numbers:
            key = text.name, text.chosen
            if key not in made:
                made[key] = text.recipe.make(())
            families[l] = made[key]
    blocks = content.transfer.blocks.items()
    beside = [k for place, block in blocks if isinstance(block, d.MatrixText) for k in place]
    beside += [l for l, x in enumerate(content.methods) if x.further.node is not None or why]
    rows: dict[int, Row] = {}
    for k in dict.fromkeys(beside):
        text = content.methods[k]
        if not isinstance(text, d.FamilyText) or k not in families:
            continue
        nodes = _family_nodes(text, families[k].space, numbers, why)
        if nodes is not None:
            rows[k] = nodes
            numbers.entries += nodes
    return d.PartText(source, description, families, rows)


def _family_nodes(text: d.FamilyText, space: StageSpace, numbers: Numbers, why: str) -> Row | None:
    """The nodes as coefficients, or a fault if they have no radicals; None if none are needed."""
    from garkcli.tableau.polynomial_space import PolynomialSpace, simple_nodes  # few files need it

    if not isinstance(space, PolynomialSpace):
        return None
    nodes = simple_nodes(space)
    if nodes is None:
        message = f"a block next to {text.name} is spelled out, whose nodes have no simple radicals"
        cure = "make the block by a rule, or spell the method out"
        if text.further.node is not None:
            message = f"{text.name} has nodes without simple radicals"
            message += ", so weights at its stages are not read"
            cure = "spell the method out, or leave them away"
        if why:
            message = f"{text.name} with {text.stages} stages has nodes without simple radicals"
            message += f", so {why}"
            cure = "take fewer stages, or spell the method out"
        numbers.source.fault(text.node, message, cure, code="no-radicals")
        return None
    numbered = enumerate(nodes, start=1)
    return tuple(Coefficient(x, text.node, f"node {i} of {text.name}") for i, x in numbered)
