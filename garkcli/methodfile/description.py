"""The content of a method file as data with positions, before any mathematics."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

from flint import fmpq

from garkcli.frozen import Frozen, FrozenBut
from garkcli.grammar.nodes import Node
from garkcli.grammar.source import Source
from garkcli.methodfile.numbers import Coefficient, Row, Rows
from garkcli.reference import ZANNA, Reference, Work
from garkcli.tableau.embedded import Further
from garkcli.tableau.tableau import Method, Tableau

if TYPE_CHECKING:
    from garkcli.families.family import Recipe
    from garkcli.methodfile.tolerance import Tolerance
    from garkcli.methodfile.values import Values

Structure: TypeAlias = Literal["general", "semi-separable", "separable", "nystrom"]
STRUCTURES: tuple[Structure, ...] = ("general", "semi-separable", "separable", "nystrom")
Construction: TypeAlias = Literal["compose", "adjoint", "extrapolate", "splitting", "multirate"]
CONSTRUCTIONS: tuple[Construction, ...] = get_args(Construction)
"""The forms that construct a method from others."""
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
"""The keys of a Butcher tableau at the top of a file."""
BESIDE = ("embedded", "dense")
"""Further weights beside b."""


MAX_COLOURS = 200
"""The largest number of colours; the number of blocks is its square."""
MAX_ENTRIES = 1_000_000
"""The largest number of entries in all blocks made by transfer rules."""


def block_name(l: int, m: int) -> str:
    """Returns the name of a block in messages; colours are counted from 0.

    >>> block_name(0, 1)
    'A^{1,2}'
    """
    return f"A^{{{l + 1},{m + 1}}}"


def of_colour(letter: str, l: int) -> str:
    """Returns the name of the weights, nodes or matrix of a colour, counted from 0, in messages.

    >>> of_colour("b", 0)
    'b^{1}'
    """
    return f"{letter}^{{{l + 1}}}"


class PredictorText(Frozen):
    """Weights that predict stages.

    ``old`` and ``new`` have the matrices of 1, r, r², … for the slopes of the last step and of this
    one; zeros follow the shorter of both.
    """

    node: Node
    old: tuple[Rows, ...]
    new: tuple[Rows, ...]


class FurtherText(Frozen):
    """Further weights of one colour, or None: embedded ones, one for each stage, and for dense
    output the coefficients of θ, θ², … for each stage; ``predictor`` predicts the stages.

    ``node`` is that of the first of them.
    """

    embedded: Row | None = None
    dense: Rows | None = None
    node: Node | None = None
    predictor: PredictorText | None = None


NOTHING_FURTHER = FurtherText()


class FamilyText(Frozen):
    """A member of a family.

    ``chosen`` has its size and the other options as written, which with the name determine the
    member; ``numbers`` are its irrational numbers.
    """

    node: Node
    name: str
    chosen: tuple[tuple[str, str], ...]
    recipe: Recipe
    numbers: Row = ()
    further: FurtherText = NOTHING_FURTHER

    @property
    def stages(self) -> int:
        return self.recipe.stages


class ButcherText(Frozen):
    """A spelled-out method."""

    node: Node
    name: str
    A: Rows
    b: Row
    c: Row | None
    further: FurtherText = NOTHING_FURTHER


class RuleText(Frozen):
    """A block made by rules with weights, None for a single rule, which may have a degree."""

    node: Node
    terms: tuple[tuple[str, Coefficient | None], ...]
    degree: int | None = None


class MatrixText(Frozen):
    """A spelled-out block."""

    node: Node
    rows: Rows


BlockText: TypeAlias = RuleText | MatrixText
BlockTexts: TypeAlias = dict[tuple[int, int], BlockText]
"""Blocks by their colours l and m, counted from 0."""


class TransferText(Frozen):
    """A rule for all off-diagonal blocks, with exceptions; colours are counted from 0."""

    default: RuleText | None
    blocks: BlockTexts


class MethodsText(Frozen):
    """The construction of the paper."""

    methods: tuple[FamilyText | ButcherText, ...]
    transfer: TransferText


class TableauText(Frozen):
    """A tableau with every block spelled out, None for absent ones."""

    A: tuple[tuple[Rows | None, ...], ...]
    b: tuple[Row, ...]
    c: tuple[Row | None, ...]
    linear: tuple[int, ...]
    further: tuple[FurtherText, ...]


class ArkText(Frozen):
    """A method with shared stages and one matrix for each colour."""

    A: tuple[Rows, ...]
    b: tuple[Row, ...]
    c: Row | None
    further: tuple[FurtherText, ...]


class PrkText(Frozen):
    """A partitioned method with parts q and p."""

    q: ButcherText
    p: ButcherText


class RegistersText(Frozen):
    """A method in the form used by codes with few registers.

    ``scheme`` is ``shu-osher``, or the form of ``low-storage``; ``numbers`` are its rows and
    matrices, in the order of the scheme.
    """

    node: Node
    scheme: str
    numbers: tuple[Row | Rows, ...]
    c: Row | None = None
    further: tuple[FurtherText, ...] = (NOTHING_FURTHER,)


class RosenbrockText(Frozen):
    """A Rosenbrock or W-method as in papers, or transformed as in programs; the latter has one
    colour.
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

    ``A`` is None if g depends on q only, ``c`` if it has the row sums of A. ``embedded`` has the
    embedded weights in q and in q′, each None if they are those of the method; ``dense`` the
    polynomials in q and in q′, the latter None if they are the slopes of the former.
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
        """The further weights of each component."""
        if self.embedded is None and self.dense is None:
            return ()
        embedded, dense = self.embedded, self.dense or (None, None)
        return tuple(
            FurtherText(None if embedded is None else embedded[k] or own, dense[k])
            for k, own in enumerate((self.bbar, self.b))
        )


class NprkText(Frozen):
    """A nonlinearly partitioned method; rows and matrices may end early, followed by zeros.

    ``a`` has a matrix for each stage.
    """

    node: Node
    a: tuple[Rows, ...]
    b: Rows
    embedded: Rows | None = None

    @property
    def further(self) -> tuple[FurtherText, ...]:
        """Empty: the tableau includes them."""
        return ()


class DerivativesText(Frozen):
    """A method that uses derivatives of f along the solution.

    ``A`` has a matrix for f, one for f′f, and so on; ``c`` is None if it has the row sums of the
    first matrix.
    """

    node: Node
    A: tuple[Rows, ...]
    b: Rows
    c: Row | None = None
    embedded: Rows | None = None

    @property
    def further(self) -> tuple[FurtherText, ...]:
        """Empty: the tableau includes them."""
        return ()


class PartText(Frozen):
    """A method within a construction, from this file or one of the catalogue.

    ``families`` has its members of families by number, from 0, ``nodes`` the nodes of members as
    coefficients.
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
        return made if rounding is None else rounding


Make: TypeAlias = (
    "Callable[[Callable[[PartText], Tableau], Values], Tableau | tuple[Tableau, Further]]"
)
"""Makes a method, and its further weights if any, from the tableaus of its parts and the values of
its coefficients.
"""


class ConstructionText(Frozen):
    """A method constructed from others.

    ``make`` makes it from the tableaus of the parts and the values of its coefficients;
    ``tolerance`` is the rounding of the parts, ``kept`` are those whose embedded weights are used.
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
    """Returns the further weights of each colour of the file; for a prk those of q, then of p."""
    match content:
        case MethodsText():
            return tuple(method.further for method in content.methods)
        case PrkText():
            return content.q.further, content.p.further
        case ConstructionText():
            return ()
    return content.further


class BlockRule(Frozen):
    """The rule for the block A^{l,m}, and its degree if given; colours are counted from 0."""

    l: int
    m: int
    rule: str
    degree: int | None


def rules_of_blocks(description: Description) -> tuple[BlockRule, ...]:
    """Returns the rules for single blocks of a method of the form ``methods``."""
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
    """Returns the further weights of its parts that a construction drops, as text; most often none.

    They belong to the steps of the parts: embedded weights of an adjoint, for instance, would be at
    other stages.
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
    """Returns the references of a method; without one those of its parts and rules."""
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
    """A claim under ``expect``."""

    besides = frozenset({"node"})

    node: Node
    key: str
    value: object

    def __hash__(self) -> int:
        return hash(self.key)


class Description(Frozen):
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
    tolerance: Tolerance | None = None
    rounding: fmpq | None = None
    claims: tuple[ClaimText, ...] = ()
