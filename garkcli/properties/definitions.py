"""The definitions of all claims of method files, on orders and properties."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from garkcli.errors import UsageProblem, did_you_mean
from garkcli.frozen import Frozen
from garkcli.properties.registry import KEYS
from garkcli.properties.verdict import KINDS, Kind


class Definition(Frozen):
    """The definition of a claim in whole sentences. ``meaning`` says for which methods it is
    defined; empty for all.
    """

    key: str
    text: str
    source: str
    kind: Kind | Literal["row", "table"] = "count"
    meaning: str = ""

    @property
    def values(self) -> str:
        return _VALUES[self.kind]


_VALUES: Mapping[str, str] = {
    **{str(kind): text for kind, text in KINDS.items()},
    "row": f"{KINDS['count']} for each colour, in a list",
    "table": "a list of such numbers by colour; `null` where there is no block",
}


_PAPER = (
    "A. Zanna, Discrete Variational Methods and Symplectic Generalized Additive Runge–Kutta Methods"
)
_HAIRER = "E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, section"
_HAIRER_II_4 = f"{_HAIRER} II.4"
_HAIRER_II_6 = f"{_HAIRER} II.6"
_WITH_EMBEDDED = "methods with embedded weights"
_ROSENBROCK = "Rosenbrock methods"
_ON_DAES = "Rosenbrock methods with α + γ that has an inverse"
_ROCHE = "M. Roche, Numer. Math. 52 (1988)"
_NYSTROM = "Nyström methods"
_HAIRER_II_14 = f"{_HAIRER} II.14"
_WITH_DENSE = "methods with dense output"
_WITH_PREDICTOR = "methods with a predictor"
_HIGUERAS = "I. Higueras, T. Roldán, Numerical Algorithms 23 (2000)"
_ORDERS = (
    Definition(
        "order",
        "The largest p for which all order conditions of the tableau up to order p hold: one step"
        " differs from the exact solution by O(h^(p+1)) on every problem of its structure.",
        "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section III.1",
    ),
    Definition(
        "conjugate-order",
        "The order of the symplectic conjugate Â^{l,m} = (𝟙 − (B^{l})⁻¹ (A^{m,l})ᵀ) B^{m}.",
        _PAPER,
        meaning="methods without zero weights",
    ),
    Definition(
        "pair-order",
        "The order of the symplectic method of 2N colours that the method and its conjugate form.",
        _PAPER,
        meaning="methods without zero weights",
    ),
    Definition(
        "bound",
        "The bound of the order that the simplifying conditions give, min{r, 2η+2, ξ+1, η+ζ+1},"
        " with the letters of sharp-bound.",
        _PAPER,
    ),
    Definition(
        "pair-bound",
        "The bound min{r, 2η+2, ξ+1, η+ζ+1} for the symplectic pair.",
        _PAPER,
        meaning="methods without zero weights",
    ),
    Definition(
        "sharp-bound",
        "The sharper bound of the order that B, C and D give, min{r, 2η+2, ξ+1, χ+2, η+ζ+3}: r is"
        " the least r^{l} with B^{l}(r^{l}), η and ζ are the least η^{l,m} and ζ^{l,m} with"
        " C^{l,m}(η^{l,m}) and D^{l,m}(ζ^{l,m}) over the blocks A^{l,m} that exist, ξ is the least"
        " η^{l,m} + ζ^{l,m}, and χ the least ζ^{l,m} + η^{m,n} of two blocks A^{l,m} and A^{m,n}."
        " The order is never smaller; the proof is in docs/sharper-bound.md.",
        "this project",
    ),
    Definition(
        "pair-sharp-bound",
        "The sharper bound for the symplectic pair.",
        "this project",
        meaning="methods without zero weights",
    ),
    Definition(
        "B",
        "For each colour l the largest r with Σ b_i^{l} (c_i^{l})^(k−1) = 1/k for k = 1, …, r.",
        _PAPER,
        kind="row",
    ),
    Definition(
        "C",
        "For each block the largest η with A^{l,m} (c^{m})^(k−1) = (c^{l})^k / k for k = 1, …, η.",
        _PAPER,
        kind="table",
    ),
    Definition(
        "D",
        "For each block the largest ζ with (A^{l,m})ᵀ B^{l} (c^{l})^(k−1) = B^{m} (𝟙 − (c^{m})^k)"
        " / k for k = 1, …, ζ.",
        _PAPER,
        kind="table",
    ),
    Definition(
        "symplectic",
        "The method is its own symplectic conjugate: b_i^{l} a_ij^{l,m} + b_j^{m} a_ji^{m,l} ="
        " b_i^{l} b_j^{m} for all l, m, i, j. Of a partitioned method: its two parts are conjugates"
        " of each other. Then every step is symplectic; that of a reducible method may be so"
        " without it.",
        "J. M. Sanz-Serna, BIT 28 (1988)",
        kind="truth",
    ),
    Definition(
        "nonautonomous-order",
        "The order on problems ẏ = f(t, y) with the nodes as they are printed: that of the tableau"
        " with time as one more colour, whose block is the column of nodes. It is the order where"
        " the nodes are the row sums of every block.",
        f"{_HAIRER} II.1",
        meaning="methods without linear colours",
    ),
    Definition(
        "w-order",
        "The order of a Rosenbrock method with an arbitrary matrix in place of the Jacobian: that"
        " of the W-method.",
        "T. Steihaug, A. Wolfbrandt, Math. Comp. 33 (1979)",
        meaning=_ROSENBROCK,
    ),
    Definition(
        "old-jacobian-order",
        "The order of a Rosenbrock method with a matrix that differs from the Jacobian by O(h),"
        " such as the Jacobian of an earlier step.",
        "P. Kaps, A. Ostermann, IMA J. Numer. Anal. 9 (1989)",
        meaning=_ROSENBROCK,
    ),
    Definition(
        "index-1-order",
        "The order of a Rosenbrock method on differential-algebraic equations y' = f(y, z), 0 ="
        " g(y, z) of index 1: the largest p such that a step has errors O(h^(p+1)) in y and O(h^p)"
        " in z. If |R(∞)| < 1 the method converges with order p in both.",
        _ROCHE,
        meaning=_ON_DAES,
    ),
    Definition(
        "index-1-y-order",
        "The largest p such that a step on y' = f(y, z), 0 = g(y, z) has an error O(h^(p+1)) in y.",
        _ROCHE,
        meaning=_ON_DAES,
    ),
    Definition(
        "index-1-z-order",
        "The largest p such that a step on y' = f(y, z), 0 = g(y, z) has an error O(h^(p+1)) in z.",
        _ROCHE,
        meaning=_ON_DAES,
    ),
    Definition(
        "position-order",
        "The order of the step in q of a Nyström method: q_1 differs from the exact solution by"
        " O(h^(p+1)). The order is the smaller one of this and the velocity order.",
        _HAIRER_II_14,
        meaning=_NYSTROM,
    ),
    Definition(
        "velocity-order",
        "The order of the step in q′ of a Nyström method: q′_1 differs from the exact solution by"
        " O(h^(p+1)).",
        _HAIRER_II_14,
        meaning=_NYSTROM,
    ),
    Definition(
        "slow-order",
        "The order of a multirate method where the fast part is 0: that of its slow method.",
        "A. Sandu, SIAM J. Numer. Anal. 57 (2019)",
        meaning="multirate methods with fast: exact",
    ),
    Definition(
        "embedded-order",
        "The order of the method with the embedded weights in place of b.",
        _HAIRER_II_4,
        meaning=_WITH_EMBEDDED,
    ),
    Definition(
        "embedded-nonautonomous-order",
        "The order on problems ẏ = f(t, y) of the method with the embedded weights in place of b.",
        _HAIRER_II_4,
        meaning=_WITH_EMBEDDED,
    ),
    Definition(
        "embedded-position-order",
        "The position order with the embedded weights in place of b̄ and b.",
        _HAIRER_II_14,
        meaning="Nyström methods with embedded weights",
    ),
    Definition(
        "embedded-velocity-order",
        "The velocity order with the embedded weights in place of b̄ and b.",
        _HAIRER_II_14,
        meaning="Nyström methods with embedded weights",
    ),
    Definition(
        "embedded-w-order",
        "The w-order with the embedded weights in place of b.",
        "T. Steihaug, A. Wolfbrandt, Math. Comp. 33 (1979)",
        meaning="Rosenbrock methods with embedded weights",
    ),
    Definition(
        "embedded-old-jacobian-order",
        "The old-jacobian-order with the embedded weights in place of b.",
        "P. Kaps, A. Ostermann, IMA J. Numer. Anal. 9 (1989)",
        meaning="Rosenbrock methods with embedded weights",
    ),
    Definition(
        "embedded-index-1-order",
        "The index-1-order with the embedded weights in place of b.",
        _ROCHE,
        meaning=f"{_ON_DAES}, with embedded weights",
    ),
    Definition(
        "dense-order",
        "The largest p for which dense output meets all order conditions up to p for every θ:"
        " Σ b_i(θ) 𝒜^[u]_i = θ^n/γ(u), a polynomial identity, for every tree u of order n ≤ p. The"
        " order is no larger than the degree.",
        _HAIRER_II_6,
        meaning=_WITH_DENSE,
    ),
    Definition(
        "predictor-order",
        "The largest q for which every implicit stage is predicted up to O(h^(q+1)) on every"
        " problem, whatever the ratio r of this step size to the last one: the prediction and the"
        " stage have equal weights at all trees of at most q vertices.",
        _HIGUERAS,
        meaning=_WITH_PREDICTOR,
    ),
    Definition(
        "predictor-order-equal-steps",
        "The predictor-order for steps of one size, r = 1.",
        _HIGUERAS,
        meaning=_WITH_PREDICTOR,
    ),
    Definition(
        "dense-position-order",
        "The order of dense output in q of a Nyström method, for every θ.",
        _HAIRER_II_14,
        meaning="Nyström methods with dense output",
    ),
    Definition(
        "dense-velocity-order",
        "The order of dense output in q′ of a Nyström method, for every θ.",
        _HAIRER_II_14,
        meaning="Nyström methods with dense output",
    ),
    Definition(
        "dense-continuous",
        "Dense output ends where the step does, b(1) = b; it begins where the step does in any"
        " case, as it has no constant terms.",
        _HAIRER_II_6,
        kind="truth",
        meaning=_WITH_DENSE,
    ),
    Definition(
        "dense-smooth",
        "Dense output and its slope are continuous from step to step, whatever the step sizes, on"
        " autonomous problems: b(1) = b, and the slope is that of the vector field at both ends of"
        " a step.",
        _HAIRER_II_6,
        kind="truth",
        meaning=_WITH_DENSE,
    ),
)


ORDERS = {found.key: found for found in _ORDERS}


def _of_property(key: str) -> Definition:
    from garkcli.properties.subject import find  # decisions, which most files do without

    found = find(key)
    return Definition(found.key, found.text, found.source, found.kind, found.meaning)


def every_definition() -> list[Definition]:
    return [*ORDERS.values(), *(_of_property(key) for key in KEYS)]


def definition(key: str) -> Definition:
    """Raises UsageProblem if there is no such claim."""
    if key in KEYS:
        return _of_property(key)
    if key in ORDERS:
        return ORDERS[key]
    message = f"no claim {key!r}"
    raise UsageProblem(message, did_you_mean(key, [*ORDERS, *KEYS]), code="unknown-word")
