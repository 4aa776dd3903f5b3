"""The exact order, with a witness, in time polynomial in the order.

The affine spans of the normalised stage vectors

    ψ(u) = γ(u)/ρ(u) · 𝒜^[u],      ψ(τ) = 𝟙,      ψ(u) = ⊙_i A^{l,ν_i} (ρ(u_i) ψ(u_i)),

decide it: the order condition of u reads b_lᵀ ψ(u) = 1/ρ(u), with a right-hand side that depends on
the order alone, and ψ is affine in each branch. So all conditions of one order hold if and only if
they hold for trees whose ψ span, and at most s + 1 per colour are needed. If there are trees that
the exact solution does not have, the spans are those of (ε(u), ψ(u)), with ε(u) = 0 for these and 1
for the others. ``docs/exact-order.md`` has the proof.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from flint import fmpq

from garkcli.doing import doing
from garkcli.exact.field import Number, flat
from garkcli.exact.matrix import LinearMap, dot
from garkcli.exact.span import Span
from garkcli.frozen import Frozen
from garkcli.ntrees.tree import Tree
from garkcli.order.recursion import Forests, ForestVector, Spans
from garkcli.order.tolerance import unnatural, within
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

DEFAULT_LIMIT = 60


class Witness(Shown, Frozen):
    """A tree whose order condition fails.

    Attributes:
        tree: the tree u.
        value: b_lᵀ 𝒜^[u], exact.
        required: 1/γ(u), or 0 if the exact solution has no such tree.
        is_joint: whether a method within the rounding meets the condition, and none all of those
            up to its order.

    >>> from garkcli import find_order
    >>> witness = find_order("heun").witness
    >>> witness
    <Witness [[[]]]: 0 instead of 1/6>
    >>> witness.residual
    -1/6
    """

    tree: Tree
    value: Number
    required: fmpq
    is_joint: bool = False

    @property
    def residual(self) -> Number:
        """Value − required, nonzero where the condition fails by itself."""
        return self.value - self.required

    def __repr__(self) -> str:
        from garkcli.exact.display import to_decimal, to_text

        value = to_text(self.value)
        if len(value) > 30:
            value = to_decimal(self.value, 8)
        tree = str(self.tree)
        if len(tree) > 30:
            tree = f"of order {self.tree.order}"
        return f"<Witness {tree}: {value} instead of {self.required}>"


class Order(Shown, Frozen):
    """An exact order: every condition up to ``order`` holds.

    Attributes:
        order: the order, or a lower bound if the search stopped at its limit.
        witness: a tree of the next order whose condition fails; None if the search stopped.

    >>> from garkcli import find_order
    >>> order = find_order("rk4")
    >>> order.order, str(order.witness.tree)
    (4, '[[[[[]]]]]')
    """

    order: int
    witness: Witness | None

    @property
    def is_lower_bound(self) -> bool:
        """Whether the search stopped at its limit."""
        return self.witness is None

    def __repr__(self) -> str:
        least = "at least " if self.is_lower_bound else ""
        return f"<Order {least}{self.order}>"


@doing("order")
def find_order(
    tableau: Tableau, limit: int = DEFAULT_LIMIT, spans: StageSpans | None = None
) -> Order:
    """The exact order, at most ``limit``, by affine spans; ``spans`` are known stage vectors."""
    spans = spans or StageSpans(tableau)
    limit = min(limit, tableau.exact_to or limit)
    for order in range(1, limit + 1):
        witness = _failing(tableau, spans, order)
        if witness is not None:
            return Order(order - 1, witness)
    return Order(limit, None)


def _failing(tableau: Tableau, spans: StageSpans, order: int) -> Witness | None:
    """The first condition of an order that fails; if rounding may explain it, the largest. All
    residuals are combinations of those of the spanning trees.
    """
    largest: Witness | None = None
    # the blocks of a family have no coefficients that could be rounded, nor has a root that a
    # design stands for by its polynomial alone
    is_symbol = tableau.field is not None and not tableau.field.radicals
    can_be_rounded = not is_symbol and any(isinstance(x, PointSpace) for x in tableau.spaces)
    for l, forest in spans.members(order, tableau.roots):
        colour = tableau.colours[l]
        value = dot(colour.b, forest.vector)
        if value == forest.required(colour.kind, order - (colour.late or 0)):
            continue
        witness = witness_of(tableau.tree(l, forest.branches), value)
        if largest is None and not (can_be_rounded and within(witness.residual, unnatural(order))):
            return witness
        if largest is None or _size(witness) > _size(largest):
            largest = witness
    return largest


def _size(witness: Witness) -> float:
    from garkcli.exact.display import to_ball  # few residuals are small

    return float(abs(to_ball(witness.residual)))


def witness_of(tree: Tree, normalised: Number, share: int = 1) -> Witness:
    """The witness of a tree with b_lᵀ ψ(u) = ``normalised`` instead of share/ρ(u)."""
    value = normalised * fmpq(tree.kind.integrated(tree.order), tree.density)
    return Witness(tree, value, required_of(tree, share))


def required_of(tree: Tree, share: int = 1) -> fmpq:
    """The elementary weight of the exact solution: share/γ(u), or 0 if it has no such tree."""
    return fmpq(share * tree.is_exact, tree.density)


class StageSpans(Spans):
    """Spanning members of Θ (branches) and Φ (forests) for each stage space, computed on demand."""

    def __init__(self, tableau: Tableau) -> None:
        maps = {key: LinearMap(block, tableau.field) for key, block in tableau.blocks.items()}
        super().__init__(tableau, (ForestVector(space.one) for space in tableau.spaces), maps)
        self.degree = tableau.degree

    def _joined(self, k: int, parts: Iterable[Forests]) -> Forests:
        span = Span(1 + self.tableau.spaces[k].stages * self.degree)
        members: list[ForestVector] = []
        for part in parts:
            rows = [(fmpq(x.exact), *flat(x.vector, self.degree)) for x in part]
            members += [part[i] for i in span.insert(rows)]
            if span.is_full:
                break
        return members


def all_spanning_trees(
    tableau: Tableau, orders: Iterable[int]
) -> Iterator[tuple[tuple[Tree, ...], ...]]:
    """Yields by orders, for each root colour, trees whose ψ span those of all with that root."""
    spans = StageSpans(tableau)
    for order in orders:
        yield tuple(
            tuple(tableau.tree(l, forest.branches) for forest in spans.of_trees(l, order))
            for l in range(tableau.size)
        )


class Proof(Frozen):
    """The order of a tableau with the trees that decide it.

    Attributes:
        tableau: the tableau.
        order: the order, with a failing tree of the next order.
        spanning: ``spanning[k − 1][l]`` are trees of order k with root colour l whose ψ span those
            of all such trees, for k up to the order.
    """

    tableau: Tableau
    order: Order
    spanning: tuple[tuple[tuple[Tree, ...], ...], ...]

    def __repr__(self) -> str:
        return f"<Proof of {self.order!r}>"


def prove(tableau: Tableau, limit: int = DEFAULT_LIMIT) -> Proof:
    order = find_order(tableau, limit)
    return Proof(tableau, order, tuple(all_spanning_trees(tableau, range(1, order.order + 1))))
