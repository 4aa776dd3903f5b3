"""Stability on linear, oscillating and stiff problems."""

from __future__ import annotations

from garkcli.glossary.term import Term

_STIFF = "E. Hairer, G. Wanner, Solving Ordinary Differential Equations II"
_OURS = "this project, docs/stability.md"
TERMS = (
    Term(
        "stability function",
        "What a step multiplies y by on the linear test equation y' = λy, with z = hλ; for several"
        " colours y' = Σ λ_l y and a function of all z_l.",
        "R(z) = 1 + z bᵀ (I − zA)⁻¹ 𝟙",
        f"{_STIFF}, section IV.2",
        ("R(z)", "R", "R(z1, z2)", "R(z1, z2, …)", "R(∞)", "R(infinity)"),
        ("A-stable", "L-stable"),
    ),
    Term(
        "A-stable",
        "Solutions that decay do so for every step size: R is bounded by 1 in the left half plane.",
        "|R(z)| ≤ 1 for Re z ≤ 0",
        f"{_STIFF}, section IV.3",
        (),
        ("stability function", "A(α)-stable", "L-stable"),
    ),
    Term(
        "A(α)-stable",
        "R is bounded by 1 in the sector of half-angle α about the negative axis.",
        "|R(z)| ≤ 1 for |arg(−z)| ≤ α",
        f"{_STIFF}, section IV.3",
        ("A(alpha)-stable", "A-alpha"),
        ("A-stable",),
    ),
    Term(
        "L-stable",
        "A-stable, and what decays infinitely fast is gone after one step.",
        "R(∞) = 0",
        f"{_STIFF}, section IV.3",
        (),
        ("A-stable", "stiffness"),
    ),
    Term(
        "P-stable",
        "Solutions of the harmonic oscillator stay bounded for every step size.",
        "the powers of R(x) are bounded for all x = (hω)²; where det R = 1: |tr R| < 2 or R = ±I",
        "J. Lambert, I. Watson, Symmetric multistep methods for periodic initial value problems"
        " (1976)",
        (),
        ("trace", "phase lag"),
    ),
    Term(
        "trace",
        "Half of it is the cosine of the angle by which a step of size h turns the oscillator,"
        " where its determinant is 1.",
        "tr R(x), det R(x), x = (hω)²",
        _OURS,
        ("determinant", "stable", "oscillator stable, x = (hω)²", "two springs, x = (hω_fast)²"),
        ("P-stable", "phase lag"),
    ),
    Term(
        "phase lag",
        "By how much the angle of a step on the oscillator differs from hω: order q and constant k"
        " where the first term of it has the power q + 1.",
        "arccos(tr R / (2 √det R)) − hω = k (hω)^(q+1) + …",
        "P. van der Houwen, B. Sommeijer, Explicit Runge-Kutta(-Nyström) methods with reduced phase"
        " errors for computing oscillating solutions (1987)",
        ("phase order", "phase constant"),
        ("trace",),
    ),
    Term(
        "real axis",
        "How far along the negative real axis R stays bounded by 1.",
        "|R(−x)| ≤ 1 for 0 ≤ x ≤ the end",
        f"{_STIFF}, section IV.2",
        ("real interval", "real-stability"),
        ("imaginary axis",),
    ),
    Term(
        "imaginary axis",
        "How far along the imaginary axis R stays bounded by 1.",
        "|R(iy)| ≤ 1 for |y| ≤ the end",
        f"{_STIFF}, section IV.2",
        ("imaginary interval", "imaginary-stability", "E(x), x = y²"),
        ("real axis",),
    ),
    Term(
        "SSP coefficient",
        "How much larger than for Euler's method a step may be so that norms that Euler's method"
        " does not increase are not increased.",
        "the largest r with rK(I + rK)⁻¹ ≥ 0 and rK(I + rK)⁻¹𝟙 ≤ 𝟙, K = (A 0; bᵀ 0)",
        "D. Ketcheson, C. Macdonald, S. Gottlieb, Optimal implicit strong stability preserving"
        " Runge-Kutta methods (2009)",
        ("SSP", "additive SSP radii", "intervals, SSP"),
        ("algebraically stable",),
    ),
    Term(
        "algebraically stable",
        "Two solutions of a contractive problem do not move apart, for every step size.",
        "b ≥ 0 and M = BA + AᵀB − bbᵀ positive semidefinite, B = diag(b)",
        f"{_STIFF}, section IV.12",
        ("algebraic stability",),
        ("A-stable", "symplectic"),
    ),
    Term(
        "stiffness",
        "Parts of a solution that decay much faster than the step is long. Methods show an order"
        " between their stage order and their order then.",
        "",
        f"{_STIFF}, section IV.15",
        ("stiff", "order reduction", "reduced"),
        ("stage order", "L-stable"),
    ),
    Term(
        "resonance",
        "A step size at which a step on an oscillator with a slow and a fast spring is unstable,"
        " though it is stable on each spring alone.",
        "4D² − N² changes its sign",
        _OURS,
        ("resonances", "slow", "fast", "factors", "factors of 4D² − N²"),
        ("P-stable",),
    ),
)
