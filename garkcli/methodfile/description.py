"""What a method file says, before any mathematics: plain data with positions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

from flint import fmpq
from yaml.nodes import Node

from garkcli.frozen import Frozen, FrozenBut
from garkcli.methodfile.numbers import Entry, Row, Rows
from garkcli.methodfile.source import Source
from garkcli.reference import ZANNA, Reference, Work
from garkcli.tableau.embedded import Further
from garkcli.tableau.tableau import Method, Tableau

if TYPE_CHECKING:
    from garkcli.families.family import Recipe
    from garkcli.methodfile.tolerance import Rounding
    from garkcli.methodfile.values import Values

Structure: TypeAlias = Literal["general", "semi-separable", "separable", "nystrom"]
STRUCTURES: tuple[Structure, ...] = ("general", "semi-separable", "separable", "nystrom")
Construction: TypeAlias = Literal["compose", "adjoint", "extrapolate", "splitting", "multirate"]
CONSTRUCTIONS: tuple[Construction, ...] = get_args(Construction)
"""The forms that make a method from others."""
OwnForm: TypeAlias = Literal[
    "methods",
    "tableau",
    "ark",
    "prk",
    "shu-osher",
    "low-storage",
    "rosenbrock",
    "nystrom",
    "nprk",
    "derivatives",
]
Form: TypeAlias = OwnForm | Construction
FORMS: tuple[Form, ...] = (*get_args(OwnForm), *CONSTRUCTIONS)
PLAIN = ("A", "b", "c")
"""The keys of a Butcher tableau that is at the top of a file."""
BESIDE = ("embedded", "dense")
"""Further weights, which are beside b."""


MAX_COLOURS = 200
"""Most colours of a method; there are as many blocks as pairs of them."""
MAX_ENTRIES = 1_000_000
"""Most entries of all blocks that transfer rules make."""


def block_name(l: int, m: int) -> str:
    """What messages call a block; colours are counted from 0.

    >>> block_name(0, 1)
    'A^{1,2}'
    """
    return f"A^{{{l + 1},{m + 1}}}"


def of_colour(letter: str, l: int) -> str:
    """What messages call the weights, nodes or matrix of one colour, counted from 0.

    >>> of_colour("b", 0)
    'b^{1}'
    """
    return f"{letter}^{{{l + 1}}}"


class FurtherText(Frozen):
    """Further weights of one colour, each None where the file has none.

    Attributes:
        embedded: one per stage.
        dense: of dense output, the coefficients of θ, θ², … a stage.
        node: where the first of them is.
    """

    embedded: Row | None = None
    dense: Rows | None = None
    node: Node | None = None


NOTHING_FURTHER = FurtherText()


class FamilyText(Frozen):
    """A member of a family.

    Attributes:
        node: the place in the file.
        name: of the family.
        chosen: its size and what else it is chosen by, as it is written; with the name they say
            which member it is.
        recipe: how it is made.
        numbers: what it is made of besides rational numbers.
        further: what is beside it.
    """

    node: Node
    name: str
    chosen: tuple[tuple[str, str], ...]
    recipe: Recipe
    numbers: Row = ()
    further: FurtherText = NOTHING_FURTHER

    @property
    def stages(self) -> int:
        """How many stages it has."""
        return self.recipe.stages


class ButcherText(Frozen):
    """A spelled-out method: A with a row per stage, b, and c where the file gives it."""

    node: Node
    name: str
    A: Rows
    b: Row
    c: Row | None
    further: FurtherText = NOTHING_FURTHER


class RuleText(Frozen):
    """A block made by rules: ``(rule, weight)``, the weight None for a rule on its own; the degree
    of that, where the file gives it.
    """

    node: Node
    terms: tuple[tuple[str, Entry | None], ...]
    degree: int | None = None


class MatrixText(Frozen):
    """A block spelled out."""

    node: Node
    rows: Rows


BlockText: TypeAlias = RuleText | MatrixText
BlockTexts: TypeAlias = dict[tuple[int, int], BlockText]
"""Blocks by their colours l and m, counted from 0."""


class TransferText(Frozen):
    """A rule for all off-diagonal blocks, with exceptions; colours count from 0."""

    default: RuleText | None
    blocks: BlockTexts


class MethodsText(Frozen):
    """The paper's construction."""

    methods: tuple[FamilyText | ButcherText, ...]
    transfer: TransferText


class TableauText(Frozen):
    """Every block spelled out; None for an absent one. ``further`` has one per colour."""

    A: tuple[tuple[Rows | None, ...], ...]
    b: tuple[Row, ...]
    c: tuple[Row | None, ...]
    linear: tuple[int, ...]
    further: tuple[FurtherText, ...]


class ArkText(Frozen):
    """Shared stages, one matrix per colour; ``further`` has one per colour."""

    A: tuple[Rows, ...]
    b: tuple[Row, ...]
    c: Row | None
    further: tuple[FurtherText, ...]


class PrkText(Frozen):
    """A partitioned method: the parts q and p."""

    q: ButcherText
    p: ButcherText


class RegistersText(Frozen):
    """A method as codes with few registers print it.

    Attributes:
        node: the place in the file.
        scheme: ``shu-osher``, or the form of ``low-storage``.
        numbers: its rows and matrices, in the order of the scheme.
        c: the nodes, where the file gives them.
        further: what is beside the weights.
    """

    node: Node
    scheme: str
    numbers: tuple[Row | Rows, ...]
    c: Row | None = None
    further: tuple[FurtherText, ...] = (NOTHING_FURTHER,)


class RosenbrockText(Frozen):
    """A Rosenbrock or W-method, as papers print it, or transformed, as programs store it; that has
    one colour.

    Attributes:
        node: the place in the file.
        alpha: the α^{l,m}; A of a transformed one.
        gamma: the γ^{l,m} with their diagonals; C of a transformed one.
        b: the weights of each colour; m of a transformed one.
        c: where each f^{l} is evaluated; None where the row sums of α^{l,l} say it.
        d: the weights of ∂f^{l}/∂t; None where the row sums of γ^{l,l} say it.
        diagonal: the γ_ii of a transformed one, one for all or one per stage; else None.
        error: b − b̂ of a transformed one, as far as it is given.
        further: what is beside the weights of each colour.
    """

    node: Node
    alpha: tuple[tuple[Rows, ...], ...]
    gamma: tuple[tuple[Rows, ...], ...]
    b: Rows
    c: Rows | None = None
    d: Rows | None = None
    diagonal: Row | None = None
    error: Row | None = None
    further: tuple[FurtherText, ...] = (NOTHING_FURTHER,)


class NystromText(Frozen):
    """A Nyström method.

    Attributes:
        node: the place in the file.
        Abar: Ā.
        A: None where g depends on q alone.
        c: None where the row sums of A say it.
        bbar: the weights of the step in q.
        b: those of the step in q′.
        embedded: the embedded ones of both, each None where they are those of the method; None
            where there are none.
        dense: the polynomials of both steps, those of q′ None where they are the slopes of the
            others; None where there are none.
    """

    node: Node
    Abar: Rows
    A: Rows | None
    c: Row | None
    bbar: Row
    b: Row
    embedded: tuple[Row | None, Row | None] | None = None
    dense: tuple[Rows, Rows | None] | None = None

    @property
    def further(self) -> tuple[FurtherText, ...]:
        """What is beside the weights of each step."""
        if self.embedded is None and self.dense is None:
            return ()
        embedded, dense = self.embedded, self.dense or (None, None)
        return tuple(
            FurtherText(None if embedded is None else embedded[k] or own, dense[k])
            for k, own in enumerate((self.bbar, self.b))
        )


class NprkText(Frozen):
    """A nonlinearly partitioned method; rows and matrices may end early, zeros follow.

    Attributes:
        node: the place in the file.
        a: a matrix for each stage.
        b: the weights.
        embedded: embedded ones; None where there are none.
    """

    node: Node
    a: tuple[Rows, ...]
    b: Rows
    embedded: Rows | None = None

    @property
    def further(self) -> tuple[FurtherText, ...]:
        """What is beside the weights, which the tableau is made with."""
        return ()


class DerivativesText(Frozen):
    """A method that uses derivatives of f along the solution.

    Attributes:
        node: the place in the file.
        A: a matrix for f, one for f′f, and so on.
        b: the weights of each.
        c: where time is; None where the row sums of the first matrix say it.
        embedded: embedded weights; None where there are none.
    """

    node: Node
    A: tuple[Rows, ...]
    b: Rows
    c: Row | None = None
    embedded: Rows | None = None

    @property
    def further(self) -> tuple[FurtherText, ...]:
        """What is beside the weights, which the tableau is made with."""
        return ()


class PartText(Frozen):
    """A method that a construction is made from.

    Attributes:
        source: the file that it is in: this one, or one of the catalogue.
        description: what it says.
        families: its methods that are members of families, by number from 0.
        nodes: the nodes of the families taken at points, as coefficients.
    """

    source: Source
    description: Description
    families: Mapping[int, Method]
    nodes: Mapping[int, Row]

    @property
    def tolerance(self) -> fmpq | None:
        """The rounding of its coefficients."""
        content, rounding = self.description.content, self.description.rounding
        made = content.tolerance if isinstance(content, ConstructionText) else None
        return made if rounding is None else rounding.largest


Make: TypeAlias = (
    "Callable[[Callable[[PartText], Tableau], Values], Tableau | tuple[Tableau, Further]]"
)
"""A method, with its further weights where it has any, from what gives the tableaus of its parts
and the values of its coefficients.
"""


class ConstructionText(Frozen):
    """A method made from others.

    Attributes:
        node: the place in the file.
        parts: the methods that it is made from.
        make: the method, from the tableaus of the parts and the values of its own coefficients.
        tolerance: the rounding of what it is made from.
        kept: the parts whose embedded weights it takes over.
    """

    node: Node
    parts: tuple[PartText, ...]
    make: Make
    tolerance: fmpq | None = None
    kept: tuple[PartText, ...] = ()


Content: TypeAlias = (
    "MethodsText | TableauText | ArkText | PrkText | RegistersText | RosenbrockText | NystromText"
    " | NprkText | DerivativesText | ConstructionText"
)


def further_of(content: Content) -> tuple[FurtherText, ...]:
    """The further weights of each colour of the file; of a prk those of q, then those of p."""
    match content:
        case MethodsText():
            return tuple(method.further for method in content.methods)
        case PrkText():
            return content.q.further, content.p.further
        case ConstructionText():
            return ()
    return content.further


class BlockRule(Frozen):
    """The rule that makes the block A^{l,m} by itself, with the degree that the file gives it;
    colours count from 0.
    """

    l: int
    m: int
    rule: str
    degree: int | None


def rules_of_blocks(description: Description) -> tuple[BlockRule, ...]:
    """The rules that make blocks of a method of the form ``methods``, but for combinations."""
    content = description.content
    if description.is_conjugate or not isinstance(content, MethodsText):
        return ()
    size, transfer = len(content.methods), content.transfer
    found = []
    for l, m in ((l, m) for l in range(size) for m in range(size) if l != m):
        text = transfer.blocks.get((l, m)) or transfer.default
        if isinstance(text, RuleText) and text.terms[0][1] is None:
            found.append(BlockRule(l, m, text.terms[0][0], text.degree))
    return tuple(found)


def left_behind(content: Content) -> tuple[str, ...]:
    """What a construction does not take over from its parts: in words, most often nothing.

    Their further weights are for their own step: an adjoint of embedded weights, for instance, is
    at other stages than that of the method.
    """
    if not isinstance(content, ConstructionText):
        return ()
    found: list[str] = []
    for part in content.parts:
        inside = part.description.content
        found += left_behind(inside)
        for text in further_of(inside):
            is_left = text.embedded is not None and part not in content.kept
            found += ["embedded weights"] if is_left else []
            found += ["dense output"] if text.dense is not None else []
    return tuple(dict.fromkeys(found))


def works_of(said: Description) -> tuple[Work, ...]:
    """Where a method was published; without a reference where its parts and rules were."""
    if said.reference:
        return ((said.reference, said.bibliography),)
    found: list[Work] = []
    if isinstance(said.content, ConstructionText):
        found += [x for part in said.content.parts for x in works_of(part.description)]
    elif isinstance(said.content, MethodsText):
        from garkcli.families.registry import FAMILIES

        families = [x.name for x in said.content.methods if isinstance(x, FamilyText)]
        works = [FAMILIES[name].reference for name in families]
        transfer = said.content.transfer
        texts = [transfer.default, *transfer.blocks.values()]
        rules = {rule for x in texts if isinstance(x, RuleText) for rule, _ in x.terms}
        works += [ZANNA] if len(said.content.methods) > 1 and rules - {"legendre"} else []
        found += [(str(work), work) for work in works]
    return tuple(dict.fromkeys(found))


class ClaimText(FrozenBut):
    """One claim of ``expect``: its key, its value as plain data, and where it is."""

    besides = frozenset({"node"})

    node: Node
    key: str
    value: object

    def __hash__(self) -> int:
        return hash(self.key)


class Description(Frozen):
    """A whole file."""

    form: Form
    content: Content
    node: Node
    structure: Structure = "general"
    is_conjugate: bool = False
    name: str = ""
    description: str = ""
    reference: str = ""
    aliases: tuple[str, ...] = ()
    bibliography: Reference | None = None
    rounding: Rounding | None = None
    claims: tuple[ClaimText, ...] = ()
