"""Order conditions of compositions of flows: as many as a free Lie algebra has dimensions.

Trees give more. A symplectic diagonally implicit method is a composition of implicit midpoint
rules, the flows of b A₁ + b³ A₃ + b⁵ A₅ + … with fields A_n that the problem determines and b the
substep times h; a splitting method is one of flows of its parts. The composition is a series of
words of fields,

    Σ c_w A_{w_1} ⋯ A_{w_r},   of one flow c_w = b^{|w|}/r!,   |w| the sum of the letters' orders.

The c_w are a character of the shuffle algebra, which Lyndon words generate: if those of orders up
to p are as in the series of the exact flow, all are. If the composition is palindromic its
logarithm is odd in h, and Lyndon words of odd orders suffice.

A. Murua, J. Sanz-Serna, *Order conditions for numerical integrators obtained by composing simpler
integrators*, Philosophical Transactions of the Royal Society A 357, 1999.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import factorial

from flint import fmpq

from garkcli.exact.field import Number
from garkcli.frozen import Frozen
from garkcli.ntrees.kind import VertexKind
from garkcli.tableau.tableau import Tableau

Word = tuple[int, ...]


class ExactFlow(Frozen):
    """The flow of Σ length^{order of n} A_n over the letters n, of a length in steps."""

    letters: range
    length: Number


class FlowProduct(Frozen):
    """A composition of flows; field A_n comes with the power orders[n] of a length."""

    flows: tuple[ExactFlow, ...]
    orders: tuple[int, ...]

    @property
    def is_palindromic(self) -> bool:
        flows = [flow for flow in self.flows if flow.length]
        return flows == flows[::-1]

    def conditions(self, order: int) -> list[Number]:
        """Functions that vanish if and only if the composition has an order for all fields."""
        steps = range(1, order + 1, 2 if self.is_palindromic else 1)
        words = [w for w in lyndon_words(self.orders, order) if self._order(w) in steps]
        prefixes = sorted({w[:k] for w in words for k in range(len(w) + 1)}, key=len)
        known: dict[Word, Number] = {w: fmpq(not w) for w in prefixes}
        for flow in self.flows:
            known = {
                w: sum(
                    (known[w[:k]] * self._of_flow(flow, w[k:]) for k in range(len(w) + 1)), fmpq(0)
                )
                for w in prefixes
            }
        return [known[w] - self._exact(w) for w in words]

    def _exact(self, word: Word) -> fmpq:
        """The coefficient in the flow of the sum of all fields of order 1."""
        is_whole = all(self.orders[n] == 1 for n in word)
        return fmpq(1, factorial(len(word))) if is_whole else fmpq(0)

    def _of_flow(self, flow: ExactFlow, word: Word) -> Number:
        if not all(n in flow.letters for n in word):
            return fmpq(0)
        power = flow.length ** self._order(word) if word else fmpq(1)
        return power * fmpq(1, factorial(len(word)))

    def _order(self, word: Word) -> int:
        return sum(self.orders[n] for n in word)


def lyndon_words(orders: Sequence[int], most: int) -> Iterator[Word]:
    """Words that are smaller than their proper suffixes, of letters 0, 1, … with given orders. K.
    Cattell, F. Ruskey, J. Sawada, M. Serra, C. Miers, *Fast algorithms to generate necklaces,
    unlabeled necklaces, and irreducible polynomials over GF(2)*, Journal of Algorithms 37, 2000.
    """

    def longer(word: Word, period: int, left: int) -> Iterator[Word]:
        if word and period == len(word):
            yield word
        again = word[-period] if word else 0
        for n in range(again, len(orders)):
            if orders[n] <= left:
                same = period if word and n == again else len(word) + 1
                yield from longer((*word, n), same, left - orders[n])

    return longer((), 0, most)


def flows_of(tableau: Tableau, order: int) -> FlowProduct | None:
    """The flows that a method composes, with fields up to an order; None if it is not seen to."""
    colours = tableau.colours
    if any(x.late or x.kind != VertexKind() or x.space != l for l, x in enumerate(colours)):
        return None
    if len(colours) == 1 and tableau.blocks.keys() == {(0, 0)}:
        b = colours[0].b
        if not _is_sequential(tableau.blocks[0, 0], b, fmpq(1, 2)):
            return None
        orders = tuple(range(1, order + 1, 2))
        return FlowProduct(tuple(ExactFlow(range(len(orders)), x) for x in b), orders)
    if len(colours) == 2 and tableau.blocks.keys() == {(0, 1), (1, 0)}:
        for first, second in ((0, 1), (1, 0)):
            b, d = colours[first].b, colours[second].b
            if len(b) == len(d) and (
                _is_sequential(tableau.blocks[second, first], b, fmpq(1))
                and _is_sequential(tableau.blocks[first, second], d, fmpq(0))
            ):
                pairs = zip(b, d, strict=True)
                flows = [
                    ExactFlow(range(n, n + 1), x) for pair in pairs for n, x in enumerate(pair)
                ]
                return FlowProduct(tuple(flows), (1, 1))
    return None


def _is_sequential(block: Sequence[Sequence[Number]], b: Sequence[Number], share: fmpq) -> bool:
    """Whether stage i follows whole substeps before i, and a share of substep i."""
    return all(
        x == (b[j] if j < i else share * b[j] if j == i else fmpq(0))
        for i, row in enumerate(block)
        for j, x in enumerate(row)
    )
