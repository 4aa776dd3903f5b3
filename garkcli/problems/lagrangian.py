"""The Legendre transform of a Lagrangian L(q, q̇), in closed form: H(q, p) = p·v − L(q, v) with p =
∂L/∂q̇(q, v).

In the paper each term of a split Lagrangian has a velocity of its own: the stages Q̇^{l} belong to
P^{l} = ∂L^{l}/∂q̇(Q^{l}, Q̇^{l}), and q̇ = Σ_l V^{l}. So the terms are transformed one by one,
H^{l} being that of L^{l}; a term without velocities is −H^{l}, and has no momenta (the
semi-separable and separable cases).
"""

from __future__ import annotations

from garkcli.doing import doing
from garkcli.errors import NoLegendreTransform
from garkcli.problems.expr import Expr, Place
from garkcli.problems.inversion import by_solving
from garkcli.problems.mass import Lagrangian, coupled, differentiated, inverse_of, velocities
from garkcli.problems.vectorfield import symbols


@doing("Legendre transform")
def legendre_transform(L: Expr, variables: tuple[str, ...], start: Place) -> Expr:
    """The Hamiltonian of a Lagrangian, sympy expressions both.

    Lagrangians that are quadratic in the velocities are transformed exactly: with L = ½ v·Mv + b·v
    + c, H = ½ (p − b)·M⁻¹(p − b) − c, where M, b and c may depend on the positions. In others,
    velocities are solved for one by one, or together where they occur in one quadratic form only,
    as in √(1 − v·v); such solutions are tested at the start and at random places near it, with 90
    digits.

    Args:
        L: in the symbols of the positions and of the ``velocities``.
        variables: d names.
        start: q(0), and velocities or momenta at the start where they are known: they tell which of
            several solutions is meant.

    Raises:
        NoLegendreTransform: the mass matrix is singular, or no solution was found.

    >>> from flint import arb
    >>> from sympy import cos
    >>> (x,), (v,) = symbols(("x",), "q"), velocities(("x",))
    >>> legendre_transform(v**2 / 2 - cos(x), ("x",), {x: arb(0)})
    px**2/2 + cos(x)
    """
    v = velocities(variables)
    present = [x for x in v if x in L.free_symbols]
    if not present:
        return -L
    if len(present) < len(v):
        missing = ", ".join(str(x) for x in v if x not in present)
        others = ", ".join(map(str, present))
        raise NoLegendreTransform(
            f"the mass matrix is singular: {missing} does not occur beside {others}",
            f"each term has all velocities or none; move {missing} into this term, "
            f"or write the Hamiltonian",
        )
    lagrangian = differentiated(L, variables, start)
    if lagrangian.is_quadratic:
        return _of_quadratic(lagrangian)
    return by_solving(lagrangian)


def _of_quadratic(lagrangian: Lagrangian) -> Expr:
    """H = ½ (p − b)·M⁻¹(p − b) − c, block by block of M."""
    import sympy

    M, variables = lagrangian.M, lagrangian.variables
    v, p = velocities(variables), symbols(variables, "p")
    at_rest = dict.fromkeys(v, 0)
    shifted = []  # p - b
    for x, slope in zip(p, lagrangian.gradient, strict=True):
        shifted.append(x - slope.xreplace(at_rest))
    H = [-lagrangian.L.xreplace(at_rest)]
    for block in coupled(M):
        own = [[M[i][j] for j in block] for i in block]
        names = [v[i] for i in block]
        inverse, divisor = inverse_of(own, names, lagrangian.start)
        products = []
        for row, i in zip(inverse, block, strict=True):
            for entry, j in zip(row, block, strict=True):
                products.append(entry * shifted[i] * shifted[j])
        H.append(sympy.Add(*products) / (2 * divisor))
    return sympy.Add(*H)
