"""Nodes that can be written down: rational ones, and those with one square root each."""

from __future__ import annotations

from flint import fmpq_poly

from garkcli.exact.enclosing import enclose
from garkcli.exact.nodes import Chain, Expression, Literal, Root
from garkcli.exact.radicands import square_free
from garkcli.tableau.polynomial_space import PolynomialSpace


def simple_nodes(space: PolynomialSpace) -> tuple[Expression, ...] | None:
    """The nodes in ascending order, as expressions with at most a square root each; None if they
    need more.

    >>> from garkcli.families.registry import diagonal_method
    >>> from garkcli.exact.rewriting import format_expression
    >>> [format_expression(c) for c in simple_nodes(diagonal_method("gauss", 2).space)]
    ['1/2-((1/6)*sqrt(3))', '1/2+(1/6)*sqrt(3)']
    """
    nodes: list[Expression] = []
    _, factors = space.modulus.factor()
    for factor, _ in factors:
        if factor.degree() > 2:
            return None
        nodes += _roots(fmpq_poly(factor))
    return tuple(sorted(nodes, key=_position))


def _roots(factor: fmpq_poly) -> list[Expression]:
    """The roots of a linear factor, or of a quadratic one as m ± r√d with rational m, r and d."""
    if factor.degree() == 1:
        return [Literal(-factor[0] / factor[1])]
    constant, linear, leading = factor.coeffs()
    middle = -linear / (2 * leading)
    radicand = middle * middle - constant / leading
    d = square_free(radicand)
    scale = Literal((radicand / d).sqrt())
    root = Root(Literal(d), 2)
    half_width = Chain("**", (scale, root))
    operands = (Literal(middle), half_width)
    return [Chain("+-", operands), Chain("++", operands)]


def _position(node: Expression) -> float:
    return float(enclose(node))
