"""Schemes whose numbers are exact."""

from __future__ import annotations

from garkcli.constructions.schemes.scheme import Part, Parts, Scheme, repeated


def _triple_jump(order: int) -> tuple[str, ...]:
    root = f"root(2, {order + 1})"
    outer = f"1/(2 - {root})"
    return outer, f"-{root}/(2 - {root})", outer


def _suzuki(order: int) -> tuple[str, ...]:
    root = f"root(4, {order + 1})"
    outer = f"1/(4 - {root})"
    return outer, outer, f"-{root}/(4 - {root})", outer, outer


def _with_adjoint(_: int, __: int) -> Parts:
    return ("1/2", False), ("1/2", True)


_BETA = (
    "(14 - sqrt(19))/108",
    "(-23 - 20*sqrt(19))/270",
    "1/5",
    "(-2 + 10*sqrt(19))/135",
    "(146 + 5*sqrt(19))/540",
)


def _mclachlan(_: int, __: int) -> Parts:
    """The adjoint takes β_1, the method α_1, and so on; α is β backwards."""
    parts: list[Part] = []
    for beta, alpha in zip(_BETA, reversed(_BETA), strict=True):
        parts += [(beta, True), (alpha, False)]
    return tuple(parts)


SCHEMES = (
    Scheme(
        "strang",
        "2",
        "the method and its adjoint, half of the step each",
        _with_adjoint,
        reference="G. Strang, SIAM J. Numer. Anal. 5 (1968)",
    ),
    Scheme(
        "triple-jump",
        "4, 6, …",
        "three substeps of a symmetric method, repeated for higher orders",
        repeated(_triple_jump),
        has_orders=True,
        reference="M. Creutz, A. Gocksch (1989), E. Forest, H. Yoshida (1990)",
    ),
    Scheme(
        "suzuki",
        "4, 6, …",
        "five substeps of a symmetric method, repeated for higher orders",
        repeated(_suzuki),
        has_orders=True,
        reference="M. Suzuki, Phys. Lett. A 146 (1990)",
    ),
    Scheme(
        "mclachlan-4",
        "4",
        "ten substeps of any method of order 1 and its adjoint",
        _mclachlan,
        reference="R. McLachlan, SIAM J. Sci. Comput. 16 (1995)",
    ),
)
