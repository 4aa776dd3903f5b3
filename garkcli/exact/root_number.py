"""A real root as an element of the number field that it generates."""

from __future__ import annotations

from garkcli.exact.domain import Domain
from garkcli.exact.field import ZERO, Number
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import RealRoot, real_roots


def number_of(root: RealRoot, most_degree: int) -> Number | None:
    """A root as an exact number; None where its field would be of a larger degree.

    >>> from flint import fmpz_poly
    >>> theta = number_of(RealRoot(fmpz_poly([-2, 0, 1]), 1), 4)
    >>> theta * theta
    2
    """
    if root.exact is not None:
        return root.exact
    if root.polynomial.degree() > most_degree:
        return None
    coefficients = tuple(int(c) for c in root.polynomial.coeffs())
    meant = AlgebraicRoot(coefficients, root.number)
    return Domain([meant]).evaluate(meant)


def square_root(x: RealRoot) -> RealRoot:
    """The square root of a number ≥ 0: squaring keeps the order of positive numbers.

    >>> from flint import fmpq
    >>> square_root(RealRoot.rational(fmpq(9, 4))).exact
    3/2
    """
    origin = RealRoot.rational(ZERO)
    if x == origin:
        return origin
    p = Polynomial.from_flint(x.polynomial)
    smaller = sum(1 for root, _ in real_roots(p) if origin < root < x)
    squares = Polynomial([p[k // 2] if k % 2 == 0 else ZERO for k in range(2 * p.degree + 1)])
    positive = [root for root, _ in real_roots(squares) if root > origin]
    return positive[smaller]
