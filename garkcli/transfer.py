"""Off-diagonal blocks from diagonal methods, "Some techniques to construct the transfer matrices".
A stage vector of m is lifted to its polynomial of degree < s_m and reduced to the stages of l.
Rules return A^{l,m}, shape (s_l, s_m); CoincidingNodes for nodes of m, BlockTooLarge beyond
``MAX_WORK``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import partial, reduce
from typing import TypeAlias

from garkcli.errors import BlockTooLarge, counted
from garkcli.exact.display import LOG10_2
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix, add, multiply, outer, scale, transpose
from garkcli.frozen import Frozen
from garkcli.order.meant import AnyTableau
from garkcli.tableau.conjugate import conjugate_block
from garkcli.tableau.forms import gark
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Edge, Method

MAX_WORK = 100_000_000
"""Most bits in a block by interpolation, each entry as long as their common denominator."""

Rule: TypeAlias = Callable[[Method, Method], Matrix]


def collocation(l: Method, m: Method) -> Matrix:
    """a_{ij} = ∫_0^{c_i^l} L_j^m, eq. (coll)."""
    from garkcli.tableau.polynomial_space import antiderivative

    _refuse_large(l, m)
    columns = [
        l.space.of_polynomial(antiderivative(basis)) for basis in m.space.basis_polynomials()
    ]
    return transpose(tuple(columns))


def interpolation(l: Method, m: Method) -> Matrix:
    """A^{l,m} = L^m(c^l) A^{m,m}, eq. (interp)."""
    _refuse_large(l, m)
    columns = [l.space.of_polynomial(basis) for basis in m.space.basis_polynomials()]
    return multiply(transpose(tuple(columns)), m.A)


MAX_DEGREE = 100


def legendre(l: Method, m: Method, degree: int | None = None) -> Matrix:
    """Returns A^{l,m} g = Σ (2j + 1) b_m(P_j g) ∫_0^x P_j over j ≤ K = ``degree``, with the
    Legendre polynomials P_j of [0, 1] and without P_{K+1} in the last integral; docs/pair-order.md.
    A^{m,l} is then the symplectic conjugate. Nodes may coincide, and weights may be zero.
    """
    if degree is None:
        degree = legendre_degree([gark([l], {}), gark([m], {})])
    from garkcli.families.collocation import legendre as legendre_polynomial

    P = [legendre_polynomial(j) for j in range(degree + 1)]
    blocks = []
    for j, P_j in enumerate(P):
        # (2j + 1) ∫_0^x P_j is (P_{j+1} − P_{j−1})/2, and (P_1 + P_0)/2 for j = 0
        integral = P[j - 1] / -2 if j else P[0] / 2
        if j < degree:
            integral += P[j + 1] / 2
        functional = m.space.times(m.b, m.space.of_polynomial(P_j.coeffs()))
        blocks.append(outer(l.space.of_polynomial(integral.coeffs()), functional))
    return reduce(add, blocks)


def legendre_degree(methods: Iterable[AnyTableau]) -> int:
    """K = ⌊p/2⌋, with p the least order that the criterion proves for the pairs of the diagonal
    methods: among all transfers whose pair keeps the order p this one has the least error.
    """
    from garkcli.order.pair_order import pair_criterion  # few transfers ask for it

    return min(pair_criterion(method).order for method in methods) // 2


def legendre_rule(methods: Iterable[AnyTableau], degree: int | None) -> Rule:
    """The rule ``legendre`` for blocks between ``methods``, with one degree for all."""
    return partial(legendre, degree=legendre_degree(methods) if degree is None else degree)


def _refuse_large(l: Method, m: Method) -> None:
    """Refuses a block that would be too large, by an estimate of its size."""
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
    """Returns the rule for Â^{l,m}, the conjugate of A^{m,l} by ``rule``; raises ZeroWeight."""

    def conjugated(l: Method, m: Method) -> Matrix:
        return conjugate_block(rule(m, l), l.space, l.b, m.space, m.b)

    return conjugated


class _Entry(Frozen):
    """Makes a block, or the first of two, the other being its symplectic conjugate."""

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
    "legendre": _Entry(
        legendre, "Legendre polynomials up to a degree: the symplectic pair keeps the order always"
    ),
    "symplectic-collocation": _Entry(collocation, _OF_PAIR.format("collocation"), makes_both=True),
    "symplectic-interpolation": _Entry(
        interpolation, _OF_PAIR.format("interpolation"), makes_both=True
    ),
}

RULES: Mapping[str, Rule] = {
    name: entry.rule for name, entry in _ENTRIES.items() if not entry.makes_both
}
"""Rules that make one block from two methods."""

PAIR_RULES: Mapping[str, Rule] = {
    name: entry.rule for name, entry in _ENTRIES.items() if entry.makes_both
}
"""Rules that make both blocks of a pair of colours, each with the rule for the first."""

SUMMARIES: Mapping[str, str] = {name: entry.summary for name, entry in _ENTRIES.items()}


def combination(terms: Sequence[tuple[Number, Rule]], l: Method, m: Method) -> Matrix:
    """Σ τ_k A_k^{l,m} over the rules; consistent if Σ τ_k = 1, eq. (lincomb)."""
    return reduce(add, [scale(weight, rule(l, m)) for weight, rule in terms])


def build_on(methods: Sequence[Method], orders: Sequence[int], l: int, m: int) -> int:
    """The colour of smaller order, of fewer stages, or the first."""

    def size(k: int) -> tuple[int, int, int]:
        return orders[k], methods[k].stages, k

    return min(l, m, key=size)


def symplectic_blocks(
    rule: Rule, methods: Sequence[Method], base: int, other: int
) -> dict[Edge, Matrix]:
    """Returns A^{other,base} by ``rule``, and its conjugate A^{base,other}; raises ZeroWeight."""
    l, m = methods[other], methods[base]
    block = rule(l, m)
    return {(other, base): block, (base, other): conjugate_block(block, m.space, m.b, l.space, l.b)}
