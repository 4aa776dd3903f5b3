"""A real root as an element of the number field that it generates."""

from __future__ import annotations

from garkcli.exact.domain import Domain
from garkcli.exact.field import Number
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.exact.roots import RealRoot


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
