"""Symplectic methods, and what happens over a long time."""

from __future__ import annotations

from garkcli.glossary.term import Term, paper

_VARIATIONAL = "section 3, Variational derivation of Partitioned Symplectic GARK methods"
_GNI = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration"
TERMS = (
    Term(
        "symplectic",
        "Every step keeps the symplectic form of phase space, so energy errors stay bounded for"
        " very long times. By the coefficients: the method is its own conjugate, or its two parts"
        " are conjugates of each other.",
        "b_i^{l} a_ij^{l,m} + b_j^{m} a_ji^{m,l} = b_i^{l} b_j^{m}",
        paper(_VARIATIONAL),
        ("symplecticity",),
        ("conjugate", "pair"),
    ),
    Term(
        "conjugate",
        "The method that drives momenta where the given one drives positions, so that both together"
        " are symplectic. It exists where no weight is zero.",
        "Â^{l,m} = (𝟙𝟙ᵀ − (B^{l})⁻¹ (A^{m,l})ᵀ) B^{m}",
        paper(_VARIATIONAL + ", definition of symplectic conjugate GARK methods"),
        ("symplectic conjugate", "conjugate order", "Â", "A-hat"),
        ("pair", "weight"),
    ),
    Term(
        "pair",
        "The symplectic method of 2N colours that a method and its conjugate form: V^l drives"
        " positions, F^l momenta. Its order may be less than that of both.",
        "",
        paper("section 4, General format of the methods"),
        ("pair order", "symplectic pair"),
        ("conjugate", "symplectic"),
    ),
    Term(
        "symmetric",
        "A step with −h undoes a step with h: the method is its own adjoint.",
        "",
        f"{_GNI}, section V.2",
        ("adjoint", "self-adjoint"),
        ("symplectic",),
    ),
    Term(
        "modified equation",
        "The differential equation that a method solves exactly, as a series in h: what it does"
        " over a long time is seen from it.",
        "",
        f"{_GNI}, chapter IX",
        ("u", "modified"),
        ("modified Hamiltonian", "energy order"),
    ),
    Term(
        "modified Hamiltonian",
        "The energy that a symplectic method keeps, up to exponentially small terms: H plus powers"
        " of h.",
        "H̃ = H + h^p H_{p+1} + …",
        f"{_GNI}, section IX.3",
        (),
        ("modified equation", "energy order"),
    ),
    Term(
        "energy order",
        "The largest p for which a step changes the energy by O(h^(p+1)) on every Hamiltonian"
        " problem.",
        "",
        "E. Faou, E. Hairer, T.-L. Pham, Energy conservation with non-symplectic methods: examples"
        " and counter-examples (2004)",
        (),
        ("order", "symplectic order"),
    ),
    Term(
        "symplectic order",
        "The largest p for which a step is symplectic up to O(h^(p+1)).",
        "",
        "A. Aubry, P. Chartier, Pseudo-symplectic Runge-Kutta methods (1998)",
        ("pseudo-symplectic",),
        ("symplectic", "energy order"),
    ),
    Term(
        "drift",
        "The part of an error of the energy that grows steadily. A fit in a smooth window separates"
        " it from the oscillation; gark claims a drift where it exceeds its uncertainty.",
        "",
        "this project, docs/energy.md",
        ("DRIFTS", "verdict", "over"),
        ("oscillation",),
    ),
    Term(
        "oscillation",
        "The part of an error of the energy that comes and goes. The errors of a symplectic method"
        " with small steps are of this kind, for exponentially long times.",
        "",
        "this project, docs/energy.md",
        ("largest error", "energy"),
        ("drift",),
    ),
    Term(
        "conserved form",
        "The quadratic form in position and momentum that every step keeps on the oscillator.",
        "α (ωq)² + β (ωq) p + δ p²",
        "this project, docs/stability.md",
        ("conserved",),
        ("phase lag", "P-stable"),
    ),
)
