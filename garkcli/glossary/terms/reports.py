"""What reports say of what was found, and of how sure it is."""

from __future__ import annotations

from garkcli.glossary.term import Term

_CHECK = "this project, docs/method-file.md"
_CONVERGENCE = "this project, docs/convergence.md"
_ENERGY = "this project, docs/energy.md"
_DIFF = "this project, docs/conversion.md"
_PROPERTIES = "this project, docs/properties.md"
_ERROR = "E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I"
TERMS = (
    Term(
        "claim",
        "What a method file says under expect of its method. Each is decided: it holds, or it fails"
        " with what was found instead, and the exit code is 1.",
        "",
        _CHECK,
        ("claim holds", "claims hold", "CLAIM FAILS", "claims", "FAIL", "all hold"),
        ("tolerance",),
    ),
    Term(
        "missing claim",
        "A file does not claim what the project or --require-claims asks for. gark claims FILE"
        " --write puts there what is true.",
        "",
        "this project, docs/ci.md",
        ("NO CLAIM",),
        ("claim",),
    ),
    Term(
        "hint",
        "Where a claimed order fails: how many conditions of it do, and the entry that restores the"
        " order when it alone is changed. An entry is a likely misprint, not a proved one.",
        "",
        "this project, docs/exact-order.md",
        ("blame", "misprint", "the claimed order would hold with"),
        ("witness", "claim"),
    ),
    Term(
        "diagonal condition",
        "An order condition of a tree with vertices of one colour: it is one of the diagonal method"
        " alone.",
        "",
        "this project, docs/exact-order.md",
        ("diagonal",),
        ("coupling condition", "order condition"),
    ),
    Term(
        "coupling condition",
        "An order condition of a tree with vertices of several colours: the blocks between the"
        " methods have to meet it.",
        "",
        "this project, docs/exact-order.md",
        ("coupling",),
        ("diagonal condition", "order condition"),
    ),
    Term(
        "arithmetic",
        "Where the numbers of a method lie: in the rational numbers, or in a number field that is"
        " made by its radicals. Everything is decided there, without rounding.",
        "",
        "this project, docs/exact-order.md",
        ("decided in rational arithmetic", "decided in a number field"),
        ("stage algebra", "exact"),
    ),
    Term(
        "lower bound",
        "The order is at least so large: the search ended at its limit, or rounding leaves the next"
        " order open.",
        "",
        _CHECK,
        ("at least",),
        ("order", "tolerance"),
    ),
    Term(
        "first same as last",
        "The last stage of a step is the first one of the next, so that it is evaluated once.",
        "",
        f"{_ERROR}, section II.5",
        ("FSAL",),
        ("stage", "explicit"),
    ),
    Term(
        "reducible method",
        "Some stages are equal to others, or have no influence on the result: a smaller method does"
        " the same. gark convert --to reduced writes it.",
        "",
        _PROPERTIES,
        ("equal stages", "stages without influence"),
        ("stage",),
    ),
    Term(
        "properties",
        "What a method is like besides its orders: explicit or implicit, stiffly accurate,"
        " symmetric, with positive weights and so on. Each may be claimed.",
        "",
        _PROPERTIES,
        ("property", "decided of one alone", "is", "it is", "it is not"),
        ("explicit", "symmetric", "A-stable"),
    ),
    Term(
        "no meaning",
        "A property or an order is not defined for the method, such as A-stability where stages do"
        " not see all vector fields. That is neither yes nor no.",
        "",
        _PROPERTIES,
        (),
        ("properties", "not decided"),
    ),
    Term(
        "error estimate",
        "What the difference of both weights, h Σ (b_i − b̂_i) k_i, is like: the power of h that it"
        " begins with, and the norm of the coefficients of its first trees.",
        "h Σ_i (b_i − b̂_i) k_i",
        f"{_ERROR}, section II.4",
        ("principal norm",),
        ("embedded weights", "error constant"),
    ),
    Term(
        "embedded order with time",
        "The order of the embedded weights on problems y' = f(t, y), with the nodes as printed.",
        "",
        f"{_ERROR}, section II.2",
        ("embedded, time", "order with time"),
        ("non-autonomous order", "embedded weights"),
    ),
    Term(
        "observed order",
        "The slope of the error over the step size, from the steps that show one. It is a number"
        " that was measured: it agrees with the exact order or speaks against it, it proves none.",
        "",
        _CONVERGENCE,
        ("slope", "observed"),
        ("predicted order", "order"),
    ),
    Term(
        "predicted order",
        "The order that the problem can show of the method: that of the trees which the problem"
        " has. It may be larger than the order for every problem.",
        "",
        _CONVERGENCE,
        ("visible order", "on this problem", "of the method"),
        ("observed order", "order"),
    ),
    Term(
        "agreement",
        "Whether the observed order is the predicted one, within what the steps can tell.",
        "",
        _CONVERGENCE,
        ("agree", "they agree", "THEY DISAGREE", "disagree", "FAILED"),
        ("observed order", "stiffness"),
    ),
    Term(
        "energy error",
        "By how much the energy at the end, or at its worst over a run, differs from that at the"
        " start.",
        "|H(q_n, p_n) − H(q_0, p_0)|",
        _ENERGY,
        (
            *("max error", "at the start"),
            "root mean square of H(t) - H(0), and with the modified terms of H",
        ),
        ("oscillation", "drift"),
    ),
    Term(
        "work",
        "What a run costs: evaluations of vector fields, iterations of Newton's method, Jacobians,"
        " and seconds of the processor, which depend on the machine.",
        "",
        _CONVERGENCE,
        ("evaluations", "iterations", "Jacobians", "seconds", "newton iterations"),
        ("observed order",),
    ),
    Term(
        "digits",
        "How many significant digits numbers are carried or shown with: as many as the smallest"
        " error needs.",
        "",
        _CONVERGENCE,
        (),
        ("round-off",),
    ),
    Term(
        "round-off",
        "An error is no larger than what the digits that are carried explain. It has an upper bound"
        " for a value, which is the same on every machine.",
        "",
        _ENERGY,
        ("below round-off", "above round-off"),
        ("digits", "drift"),
    ),
    Term(
        "bounded",
        "An error oscillates and has no drift that the run can tell from zero; on the oscillator"
        " it is decided exactly for all time.",
        "",
        _ENERGY,
        ("elliptic",),
        ("drift", "oscillation", "P-stable"),
    ),
    Term(
        "unstable run",
        "The solution leaves every bound: at the step size a step enlarges it.",
        "",
        _ENERGY,
        ("unstable", "blew up", "escaped"),
        ("bounded", "P-stable"),
    ),
    Term(
        "contractive",
        "Each step on the oscillator makes the energy smaller, so that the motion dies out; where"
        " the matrix of a step is on the border it is marginal.",
        "",
        _ENERGY,
        ("marginal",),
        ("bounded", "drift"),
    ),
    Term(
        "trend",
        "How an error goes on over time: not at all, along a line, along a curve, or by a step.",
        "",
        _ENERGY,
        ("line", "curve"),
        ("drift",),
    ),
    Term(
        "power of h",
        "The step size h with its exponent: rows of a modified equation or Hamiltonian belong each"
        " to one power of it, columns to what is cut off after it.",
        "h^k",
        "this project, docs/modified-equation.md",
        ("h", "H", "h^2", "h^4", "to h^2", "to h^4"),
        ("modified equation", "modified Hamiltonian"),
    ),
    Term(
        "invariant",
        "A quantity that the exact solution keeps, besides the energy: angular momentum, or what a"
        " problem file names.",
        "I(q(t), p(t)) = I(q_0, p_0)",
        "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, chapter IV",
        ("invariants", "angular momentum", "first integral"),
        ("oscillation", "drift"),
    ),
    Term(
        "relation of methods",
        "How two methods are related: identical entry by entry, the same up to the numbering of"
        " stages, to stages without influence or to the form, the same within their rounding, or"
        " different.",
        "",
        _DIFF,
        ("identical", "the same method", "different", "within-rounding", "first", "second", "same"),
        ("reducible method",),
    ),
    Term(
        "Pareto front",
        "Of the methods of a sweep those that no other surpasses in every criterion.",
        "",
        "this project, docs/sweep.md",
        ("best by",),
        ("error constant",),
    ),
    Term(
        "answer of gark design",
        "For which values a method has an order: every value, solutions that are listed, a family"
        " that depends on free numbers, none, or undecided within the time.",
        "",
        "this project, docs/design.md",
        ("solutions", "none"),
        ("family of dimension d", "not decided"),
    ),
    Term(
        "critical point",
        "Values of parameters at which an objective has no slope along the methods of an order."
        " The least of all methods is one, or lies at the end of a range.",
        "",
        "this project, docs/design.md",
        ("critical-points", "minimiser", "nearly", "all", "found"),
        ("family of dimension d", "exact"),
    ),
    Term(
        "multiplicity",
        "How often a solution of polynomial equations counts, or how many trees share a condition.",
        "",
        "this project, docs/design.md",
        (),
        ("family of dimension d",),
    ),
    Term(
        "source",
        "Where a definition or a method is from: the section of a paper or of a book, or a page of"
        " these.",
        "",
        "this project",
        ("see", "publication"),
        (),
    ),
    Term(
        "order p",
        "The line of one order: whether its conditions hold, for which values, or which tree of it"
        " one of two methods meets.",
        "",
        "this project, docs/design.md",
        ("no value", "order 1"),
        ("order", "free parameter"),
    ),
)
