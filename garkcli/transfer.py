"""Off-diagonal blocks made from the diagonal methods, section "Some techniques to construct the
transfer matrices".

All of it happens in stage spaces: a stage vector of m is lifted to the polynomial of degree < s_m
it stands for, and reduced to the stages of l. Every function returns a block A^{l,m} of shape (s_l,
s_m).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import reduce
from typing import TypeAlias

from flint import fmpq

from garkcli.errors import BlockTooLarge, counted
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, add, multiply, scale, transpose
from garkcli.frozen import Frozen
from garkcli.tableau.conjugate import conjugate_block
from garkcli.tableau.polynomial_space import antiderivative
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge, Method

LOG10_2 = fmpq(30103, 100000)
"""Decimal digits of a bit."""
MAX_WORK = 100_000_000
"""Most bits in a block by interpolation, each entry as long as their common denominator.

So many bits are decided on, with all simplifying conditions, in about a minute.
"""

Rule: TypeAlias = Callable[[Method, Method], Matrix]


def collocation(l: Method, m: Method) -> Matrix:
    """a_{ij} = ∫_0^{c_i^l} L_j^m, eq. (coll).

    Raises:
        CoincidingNodes: two nodes of ``m`` are equal.
        BlockTooLarge: the entries would be too long.
    """
    _refuse_large(l, m)
    columns = [
        l.space.of_polynomial(antiderivative(basis)) for basis in m.space.basis_polynomials()
    ]
    return transpose(tuple(columns))


def interpolation(l: Method, m: Method) -> Matrix:
    """A^{l,m} = L^m(c^l) A^{m,m}, eq. (interp).

    Raises:
        CoincidingNodes: two nodes of ``m`` are equal.
        BlockTooLarge: the entries would be too long.
    """
    _refuse_large(l, m)
    columns = [l.space.of_polynomial(basis) for basis in m.space.basis_polynomials()]
    return multiply(transpose(tuple(columns)), m.A)


def _refuse_large(l: Method, m: Method) -> None:
    """Refuse a block before gigabytes are spent on it, by an estimate of its size."""
    if not isinstance(m.space, PointSpace):
        return
    entries = l.stages * m.stages
    bits = m.space.interpolation_bits(enough=MAX_WORK // entries)
    if entries * bits <= MAX_WORK:
        return
    digits = int(bits * LOG10_2)
    unit = 10 ** (len(str(digits)) - 1)
    about = digits // unit * unit  # one digit of it
    nodes = counted(m.stages, "node")
    raise BlockTooLarge(
        f"interpolation through {nodes} makes {l.stages} by {m.stages} entries with a"
        f" common denominator of about {about} digits: too large to be exact",
        "choose nodes that share small denominators, or fewer; or spell the block out",
    )


def conjugate_rule(rule: Rule) -> Rule:
    """The rule whose block is Â^{l,m}, the conjugate of the block A^{m,l} that ``rule`` makes.

    The new rule raises ``ZeroWeight`` where the conjugate would divide by zero.
    """

    def conjugated(l: Method, m: Method) -> Matrix:
        return conjugate_block(rule(m, l), l.space, l.b, m.space, m.b)

    return conjugated


class _Entry(Frozen):
    """A rule of the method file.

    Attributes:
        rule: what makes a block; where both blocks of a pair are made, the first of them.
        summary: one line for people.
        makes_both: whether the opposite block is made with it, as its symplectic conjugate.
    """

    rule: Rule
    summary: str
    makes_both: bool = False


_OF_CONJUGATE = "the block of the symplectic conjugate of the {} construction"
_OF_PAIR = "{} on the lower-order method; the opposite block its conjugate"
_ENTRIES: Mapping[str, _Entry] = {
    "collocation": _Entry(
        collocation, "a_ij = ∫_0^{c_i} L_j, with the Lagrange polynomials of the nodes of m"
    ),
    "interpolation": _Entry(
        interpolation, "the stages of method m, interpolated at the nodes of l"
    ),
    "conjugate-collocation": _Entry(
        conjugate_rule(collocation), _OF_CONJUGATE.format("collocation")
    ),
    "conjugate-interpolation": _Entry(
        conjugate_rule(interpolation), _OF_CONJUGATE.format("interpolation")
    ),
    "symplectic-collocation": _Entry(collocation, _OF_PAIR.format("collocation"), makes_both=True),
    "symplectic-interpolation": _Entry(
        interpolation, _OF_PAIR.format("interpolation"), makes_both=True
    ),
}

RULES: Mapping[str, Rule] = {
    name: entry.rule for name, entry in _ENTRIES.items() if not entry.makes_both
}
"""The rules that make one block from two methods."""

PAIR_RULES: Mapping[str, Rule] = {
    name: entry.rule for name, entry in _ENTRIES.items() if entry.makes_both
}
"""The rules that make both blocks of a pair of colours, each with the rule for the first of
them.
"""

SUMMARIES: Mapping[str, str] = {name: entry.summary for name, entry in _ENTRIES.items()}
"""One line a rule, for people."""


def combination(terms: Sequence[tuple[Number, Rule]], l: Method, m: Method) -> Matrix:
    """Σ τ_k A_k^{l,m} over the rules; consistent where the weights τ_k sum to 1, eq. (lincomb)."""
    blocks = [scale(weight, rule(l, m)) for weight, rule in terms]
    return reduce(add, blocks)


def build_on(methods: Sequence[Method], orders: Sequence[int], l: int, m: int) -> int:
    """Which of two colours a ``symplectic-`` rule builds on: smaller order, fewer stages, lower
    number.
    """

    def size(k: int) -> tuple[int, int, int]:
        return orders[k], methods[k].stages, k

    return min(l, m, key=size)


def symplectic_blocks(
    rule: Rule, methods: Sequence[Method], base: int, other: int
) -> dict[Edge, Matrix]:
    """A^{other,base} by ``rule``, and A^{base,other} as its symplectic conjugate.

    The off-diagonal blocks are then conjugate to each other, so Â^{l,m} = A^{l,m} for l ≠ m.

    Raises:
        ZeroWeight: ``base`` has a zero weight.
    """
    l, m = methods[other], methods[base]
    block = rule(l, m)
    return {(other, base): block, (base, other): conjugate_block(block, m.space, m.b, l.space, l.b)}
