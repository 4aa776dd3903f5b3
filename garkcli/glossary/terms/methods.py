"""Methods and their parts."""

from __future__ import annotations

from garkcli.glossary.term import Term, paper

_GARK = "section 2, GARK methods"
TERMS = (
    Term(
        "Runge-Kutta method",
        "A method that steps from y_0 to y_1 by slopes at s stages: A says at which values of y"
        " they are taken, b how they are added up, c at which times.",
        "Y_i = y_0 + h Σ_j a_ij f(Y_j),  y_1 = y_0 + h Σ_i b_i f(Y_i)",
        "E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, section II.1",
        ("RK", "tableau", "Butcher tableau"),
        ("stage", "weight", "node", "GARK method"),
    ),
    Term(
        "GARK method",
        "A generalized additive Runge-Kutta method: the right-hand side is a sum of N terms, each"
        " with stages of its own. The block A^{l,m} says how the stages of term l use the slopes of"
        " term m.",
        "Y_i^{l} = y_0 + h Σ_m Σ_j a_ij^{l,m} f^{m}(Y_j^{m}),"
        "  y_1 = y_0 + h Σ_m Σ_j b_j^{m} f^{m}(Y_j^{m})",
        paper(_GARK),
        ("GARK",),
        ("colour", "block", "ARK method", "PRK method"),
    ),
    Term(
        "ARK method",
        "An additive Runge-Kutta method: a GARK method of which all colours have the same stage"
        " values, as implicit-explicit pairs have. Its file is written with ark.",
        "A^{l,m} is the same for all l",
        paper("section 2.1, The equivalence of ARK and GARK"),
        ("ARK", "IMEX"),
        ("GARK method",),
    ),
    Term(
        "PRK method",
        "A partitioned Runge-Kutta method: positions and momenta are driven by two tableaus. Its"
        " file is written with prk.",
        "",
        paper("section 2.2, Partitioned Runge-Kutta methods are GARK methods"),
        ("PRK", "partitioned method"),
        ("symplectic", "structure"),
    ),
    Term(
        "colour",
        "A term of the right-hand side with the stages, weights and nodes that belong to it; the"
        " vertices of trees have the colour of the term that they stand for. Colours are counted"
        " from 1.",
        "y' = Σ_l f^{l}(y),  l = 1, …, N",
        paper("section 5, Order conditions for GARK methods"),
        ("colours", "by colour"),
        ("tree", "GARK method"),
    ),
    Term(
        "stage",
        "A value at which the right-hand side is taken inside a step. Explicit stages follow from"
        " those before them, diagonally implicit ones are solved for one by one, fully implicit"
        " ones together.",
        "Y_i^{l} = y_0 + h Σ_m Σ_j a_ij^{l,m} f^{m}(Y_j^{m})",
        paper(_GARK),
        ("stages",),
        ("node", "weight", "stage order"),
    ),
    Term(
        "weight",
        "How much the slope at a stage counts in the step. Without a zero weight a method has a"
        " symplectic conjugate.",
        "y_1 = y_0 + h Σ_l Σ_i b_i^{l} f^{l}(Y_i^{l})",
        paper(_GARK),
        ("b", "weights"),
        ("stage", "conjugate"),
    ),
    Term(
        "node",
        "The time of a stage within a step: t_0 + c_i h. Most methods have the row sums of A as"
        " nodes; others have another order where f depends on t.",
        "c_i = Σ_j a_ij",
        paper(_GARK),
        ("c", "nodes", "nodes in [0, 1]"),
        ("consistent", "non-autonomous order"),
    ),
    Term(
        "block",
        "The matrix A^{l,m}: how the stages of colour l use the slopes of colour m. Those with l ="
        " m are the diagonal methods, the others transfer.",
        "",
        paper(_GARK),
        ("blocks",),
        ("diagonal method", "transfer"),
    ),
    Term(
        "diagonal method",
        "The Runge-Kutta method of one colour alone, with the matrix A^{l,l}.",
        "",
        paper("section 6, Some techniques to construct the transfer matrices"),
        (),
        ("block", "transfer"),
    ),
    Term(
        "transfer",
        "How the off-diagonal blocks between diagonal methods are made: by collocation, by"
        " interpolation, by combinations of these, or so that the whole is symplectic.",
        "",
        paper("section 6, Some techniques to construct the transfer matrices"),
        (),
        ("collocation", "interpolation", "block"),
    ),
    Term(
        "collocation",
        "The block that integrates the polynomial through the slopes at the nodes of colour m up to"
        " the nodes of colour l.",
        "a_ij^{l,m} = ∫_0^{c_i^{l}} ℓ_j^{m}(x) dx",
        paper("section 6.1, Collocation"),
        (),
        ("transfer", "interpolation"),
    ),
    Term(
        "interpolation",
        "The block that takes the polynomial through the stage values of colour m at the nodes of"
        " colour l.",
        "A^{l,m} = (ℓ_j^{m}(c_i^{l})) A^{m,m}",
        paper("section 6.2, Interpolation"),
        (),
        ("transfer", "collocation"),
    ),
    Term(
        "structure",
        "Which vector fields a problem has: general ones in every colour, or a Hamiltonian H = T(p)"
        " + V(q) of which some colours have only a velocity or only a force. Fewer trees have"
        " conditions then.",
        "",
        paper("section 7, Special cases for N = 2"),
        ("separable", "semi-separable", "nystrom"),
        ("PRK method", "tree"),
    ),
    Term(
        "stage algebra",
        "Stage values as polynomials modulo the node polynomial M: the values at the nodes are what"
        " a printed tableau has. So Gauss methods of many stages are computed with in rational"
        " numbers, whatever their nodes are.",
        "K[x]/(M)",
        "this project, docs/exact-order.md, section 3",
        (),
        ("node",),
    ),
    Term(
        "explicit",
        "Every stage follows from those before it, nothing is solved for.",
        "a_ij = 0 for j ≥ i",
        "E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, section II.1",
        ("ERK",),
        ("stage",),
    ),
    Term(
        "embedded weights",
        "Second weights for the same stages. The difference of both results estimates the error of"
        " a step, from which the step size is chosen.",
        "ŷ_1 = y_0 + h Σ_i b̂_i f(Y_i)",
        "E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, section II.4",
        ("embedded", "embedded order", "embedded method", "b̂", "b-hat"),
        ("weight", "order"),
    ),
    Term(
        "dense output",
        "Weights that are polynomials in θ: the solution at t_0 + θ h without further slopes.",
        "y(t_0 + θ h) ≈ y_0 + h Σ_i b_i(θ) f(Y_i)",
        "E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, section II.6",
        ("dense", "dense order"),
        ("order",),
    ),
)
