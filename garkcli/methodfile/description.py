"""What a method file says, before any mathematics: plain data with positions."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from flint import fmpq
from yaml.nodes import Node

from garkcli.methodfile.bibliography import Reference
from garkcli.methodfile.numbers import Entry, Row, Rows

Structure: TypeAlias = Literal[
    "general", "semi-separable", "separable", "nystrom"
]
STRUCTURES: tuple[Structure, ...] = (
    "general",
    "semi-separable",
    "separable",
    "nystrom",
)
Form: TypeAlias = Literal["methods", "tableau", "ark", "prk"]
FORMS: tuple[Form, ...] = ("methods", "tableau", "ark", "prk")
PLAIN = ("A", "b", "c")
"""The keys of a Butcher tableau that stands at the top of a file."""


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


@dataclass(frozen=True)
class FamilyText:
    """A member of a family."""

    node: Node
    name: str
    stages: int


@dataclass(frozen=True)
class ButcherText:
    """A spelled-out method: A with a row a stage, b, and c where the file gives it."""

    node: Node
    name: str
    A: Rows
    b: Row
    c: Row | None


@dataclass(frozen=True)
class RuleText:
    """A block made by rules: ``(rule, weight)``, the weight None for a rule on its own."""

    node: Node
    terms: tuple[tuple[str, Entry | None], ...]


@dataclass(frozen=True)
class MatrixText:
    """A block spelled out."""

    node: Node
    rows: Rows


BlockText: TypeAlias = RuleText | MatrixText
BlockTexts: TypeAlias = dict[tuple[int, int], BlockText]
"""Blocks by their colours l and m, counted from 0."""


@dataclass(frozen=True)
class TransferText:
    """A rule for all off-diagonal blocks, with exceptions; colours count from 0."""

    default: RuleText | None
    blocks: BlockTexts


@dataclass(frozen=True)
class MethodsText:
    """The paper's construction."""

    methods: tuple[FamilyText | ButcherText, ...]
    transfer: TransferText


@dataclass(frozen=True)
class TableauText:
    """Every block spelled out; None for an absent one."""

    A: tuple[tuple[Rows | None, ...], ...]
    b: tuple[Row, ...]
    c: tuple[Row | None, ...]
    linear: tuple[int, ...]


@dataclass(frozen=True)
class ArkText:
    """Shared stages, one matrix a colour."""

    A: tuple[Rows, ...]
    b: tuple[Row, ...]
    c: Row | None


@dataclass(frozen=True)
class PrkText:
    """A partitioned method: the parts q and p."""

    q: ButcherText
    p: ButcherText


@dataclass(frozen=True)
class ClaimText:
    """One claim of ``expect``: its key, its value as plain data, and where it stands."""

    node: Node
    key: str
    value: object


@dataclass(frozen=True)
class Description:
    """A whole file."""

    form: Form
    content: MethodsText | TableauText | ArkText | PrkText
    node: Node
    structure: Structure = "general"
    is_conjugate: bool = False
    name: str = ""
    description: str = ""
    reference: str = ""
    aliases: tuple[str, ...] = ()
    bibliography: Reference | None = None
    tolerance: fmpq | None = None
    claims: tuple[ClaimText, ...] = field(default=())
