"""The content of a method file as data with positions, before any mathematics."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple, TypeAlias, get_args

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
BESIDE = ("embedded", "dense")


MAX_COLOURS = 200
"""The number of blocks is its square."""
MAX_ENTRIES = 1_000_000


def block_name(l: int, m: int) -> str:
    """A name for messages.

    >>> block_name(0, 1)
    'A^{1,2}'
    """
    return f"A^{{{l + 1},{m + 1}}}"


def of_colour(letter: str, l: int) -> str:
    """A name for messages.

    >>> of_colour("b", 0)
    'b^{1}'
    """
    return f"{letter}^{{{l + 1}}}"


Place: TypeAlias = tuple[str, "int | None", Coefficient]
"""A number: ``embedded``, ``dense`` or empty; its colour from 0, or None; its entry."""


def places_of(rows: Iterable[Row], l: int, kind: str = "") -> Iterator[Place]:
    for row in rows:
        for entry in row:
            yield kind, l, entry


class PredictorText(Frozen):
    """Matrices of 1, r, r², … for the slopes of the last step and of this one, zeros after them."""

    node: Node
    old: tuple[Rows, ...]
    new: tuple[Rows, ...]


class FurtherText(Frozen):
    """Dense output has coefficients of θ, θ², … for each stage; ``node`` is the first of all."""

    embedded: Row | None = None
    dense: Rows | None = None
    node: Node | None = None
    predictor: PredictorText | None = None

    def places(self, l: int) -> Iterator[Place]:
        yield from places_of([self.embedded or ()], l, "embedded")
        yield from places_of(self.dense or (), l, "dense")


NOTHING_FURTHER = FurtherText()


class FamilyText(Frozen):
    """``chosen`` has its size and other options as written; ``numbers`` are its irrational ones."""

    node: Node
    name: str
    chosen: tuple[tuple[str, str], ...]
    recipe: Recipe
    numbers: Row = ()
    further: FurtherText = NOTHING_FURTHER

    @property
    def stages(self) -> int:
        return self.recipe.stages

    def places(self, l: int) -> Iterator[Place]:
        yield from places_of([self.numbers], l)
        yield from self.further.places(l)


class ButcherText(Frozen):
    node: Node
    name: str
    A: Rows
    b: Row
    c: Row | None
    further: FurtherText = NOTHING_FURTHER

    def places(self, l: int) -> Iterator[Place]:
        yield from places_of([*self.A, self.b, self.c or ()], l)
        yield from self.further.places(l)


class RuleText(Frozen):
    """A block made by rules with weights, None for a single rule."""

    node: Node
    terms: tuple[tuple[str, Coefficient | None], ...]
    degree: int | None = None


class MatrixText(Frozen):
    node: Node
    rows: Rows


BlockText: TypeAlias = RuleText | MatrixText
BlockTexts: TypeAlias = dict[tuple[int, int], BlockText]
"""Blocks by their colours l and m, counted from 0."""


class TransferText(Frozen):
    """Colours are counted from 0."""

    default: RuleText | None
    blocks: BlockTexts


class Content(Frozen):
    @property
    def names(self) -> Sequence[str] | None:
        """The names of the colours; None if ``tolerance`` has no keys for them."""
        return None

    @property
    def beside(self) -> tuple[FurtherText, ...]:
        """The further weights of each colour of the file; for a prk those of q, then of p."""
        return ()

    def places(self) -> Iterator[Place]:
        for l, text in enumerate(self.beside):
            yield from text.places(l)


class MethodsText(Content):
    methods: tuple[FamilyText | ButcherText, ...]
    transfer: TransferText

    @property
    def names(self) -> Sequence[str]:
        return [x.name if isinstance(x, ButcherText) else "" for x in self.methods]

    @property
    def beside(self) -> tuple[FurtherText, ...]:
        return tuple(method.further for method in self.methods)

    def places(self) -> Iterator[Place]:
        for l, method in enumerate(self.methods):
            yield from method.places(l)
        for (l, _), block in self.transfer.blocks.items():
            if isinstance(block, MatrixText):
                yield from places_of(block.rows, l)


class TableauText(Content):
    """Blocks may be absent."""

    A: tuple[tuple[Rows | None, ...], ...]
    b: tuple[Row, ...]
    c: tuple[Row | None, ...]
    linear: tuple[int, ...]
    beside: tuple[FurtherText, ...]

    @property
    def names(self) -> Sequence[str]:
        return [""] * len(self.b)

    def places(self) -> Iterator[Place]:
        for l, blocks in enumerate(self.A):
            for block_rows in blocks:
                yield from places_of(block_rows or (), l)
            yield from places_of([self.b[l], self.c[l] or ()], l)
        yield from super().places()


class ArkText(Content):
    A: tuple[Rows, ...]
    b: tuple[Row, ...]
    c: Row | None
    beside: tuple[FurtherText, ...]

    @property
    def names(self) -> Sequence[str]:
        return [""] * len(self.b)

    def places(self) -> Iterator[Place]:
        for m, rows in enumerate(self.A):
            yield from places_of([*rows, self.b[m]], m)
        yield from super().places()


class PrkText(Content):
    q: ButcherText
    p: ButcherText

    @property
    def names(self) -> Sequence[str]:
        return ("q", "p")

    @property
    def beside(self) -> tuple[FurtherText, ...]:
        return self.q.further, self.p.further

    def places(self) -> Iterator[Place]:
        yield from self.q.places(0)
        yield from self.p.places(1)


class Made(NamedTuple):
    """A tableau; ``further`` returns weights of the form, ``finish`` changes the usual ones."""

    tableau: Tableau
    further: Callable[[], Further] | None = None
    finish: Callable[[Further], Further] | None = None


class OwnContent(Content):
    node: Node

    @property
    def names(self) -> Sequence[str] | None:
        return ()

    @abstractmethod
    def made(self, values: Values, rounding: fmpq | None) -> Made:
        """The tableau; ``rounding`` is the largest error of its numbers, or None."""


class PartText(Frozen):
    """``families`` has the members of families by number, from 0, ``nodes`` their nodes."""

    source: Source
    description: Description
    families: Mapping[int, Method]
    nodes: Mapping[int, Row]

    @property
    def tolerance(self) -> fmpq | None:
        content, rounding = self.description.content, self.description.rounding
        if rounding is None and isinstance(content, ConstructionText):
            return content.tolerance
        return rounding


Make: TypeAlias = (
    "Callable[[Callable[[PartText], Tableau], Values], Tableau | tuple[Tableau, Further]]"
)


class ConstructionText(Content):
    """``tolerance`` is that of the parts; those in ``kept`` give their embedded weights."""

    node: Node
    parts: tuple[PartText, ...]
    make: Make
    tolerance: fmpq | None = None
    kept: tuple[PartText, ...] = ()


class BlockRule(Frozen):
    """Colours are the methods of the file, from 0; a partitioned tableau has others."""

    l: int
    m: int
    rule: str
    degree: int | None


def rules_of_blocks(description: Description) -> tuple[BlockRule, ...]:
    content = description.content
    if description.is_conjugate or not isinstance(content, MethodsText):
        return ()
    size, transfer = len(content.methods), content.transfer
    rules = []
    for l, m in ((l, m) for l in range(size) for m in range(size) if l != m):
        text = transfer.blocks.get((l, m)) or transfer.default
        if isinstance(text, RuleText) and text.terms[0][1] is None:
            rules.append(BlockRule(l, m, text.terms[0][0], text.degree))
    return tuple(rules)


def left_behind(content: Content) -> tuple[str, ...]:
    """Further weights of parts belong to their steps: those of an adjoint have other stages."""
    if not isinstance(content, ConstructionText):
        return ()
    kinds: list[str] = []
    for part in content.parts:
        inside = part.description.content
        kinds += left_behind(inside)
        for text in inside.beside:
            is_left = text.embedded is not None and part not in content.kept
            kinds += ["embedded weights"] if is_left else []
            kinds += ["dense output"] if text.dense is not None else []
    return tuple(dict.fromkeys(kinds))


def works_of(said: Description) -> tuple[Work, ...]:
    """The references of a method; without one those of its parts and rules."""
    if said.reference:
        return ((said.reference, said.bibliography),)
    publications: list[Work] = []
    if isinstance(said.content, ConstructionText):
        publications += [x for part in said.content.parts for x in works_of(part.description)]
    elif isinstance(said.content, MethodsText):
        from garkcli.families.registry import FAMILIES

        families = [x.name for x in said.content.methods if isinstance(x, FamilyText)]
        works = [FAMILIES[name].reference for name in families]
        transfer = said.content.transfer
        texts = [transfer.default, *transfer.blocks.values()]
        rules = {rule for x in texts if isinstance(x, RuleText) for rule, _ in x.terms}
        works += [ZANNA] if len(said.content.methods) > 1 and rules - {"legendre"} else []
        publications += [(str(work), work) for work in works]
    return tuple(dict.fromkeys(publications))


class ClaimText(FrozenBut):
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
