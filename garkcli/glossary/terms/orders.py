"""Trees, order conditions, and what bounds the order."""

from __future__ import annotations

from garkcli.glossary.term import Term, paper

_ORDER = "section 5, Order conditions for GARK methods"
_TREES = "E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section III.1"
TERMS = (
    Term(
        "tree",
        "A rooted tree whose vertices have colours: the derivatives of the solution and of the"
        " method are sums over such trees. In text the brackets of a vertex hold its branches, and"
        " _l is its colour: [[]_2,[]_1]_1.",
        "",
        paper(_ORDER),
        ("N-tree", "trees", "rooted tree"),
        ("colour", "density", "symmetry", "order condition"),
    ),
    Term(
        "order of a tree",
        "The number of its vertices.",
        "ρ(u)",
        _TREES,
        ("rho",),
        ("tree", "order"),
    ),
    Term(
        "density",
        "The product, over all vertices, of the number of vertices of the subtree that begins"
        " there. The order condition of a tree requires its reciprocal.",
        "γ(u) = ρ(u) Π γ(u_i), over the branches u_i",
        _TREES,
        ("gamma of a tree", "required"),
        ("tree", "elementary weight"),
    ),
    Term(
        "symmetry",
        "The number of ways to exchange equal branches of a tree.",
        "σ(u) = Π σ(u_i) · μ_1! μ_2! …, with multiplicities μ of equal branches",
        _TREES,
        ("sigma",),
        ("tree", "error constant"),
    ),
    Term(
        "elementary weight",
        "What a method makes of a tree: for every vertex a stage, for every edge an entry of A, for"
        " the root a weight, summed over all stages.",
        "b^{l}ᵀ 𝒜^[u],  𝒜^[u] = ⊙_i A^{l,m_i} 𝒜^[u_i]",
        paper(_ORDER),
        ("value",),
        ("density", "order condition"),
    ),
    Term(
        "order condition",
        "That the elementary weight of a tree is the reciprocal of its density. A method has order"
        " p where those of all trees with up to p vertices hold.",
        "b^{l}ᵀ 𝒜^[u] = 1/γ(u)",
        paper(_ORDER + ", theorem on the order of GARK methods"),
        ("condition", "holds", "FAILS", "all trees", "coupling trees"),
        ("tree", "elementary weight", "residual", "order"),
    ),
    Term(
        "residual",
        "By how much an order condition fails.",
        "b^{l}ᵀ 𝒜^[u] − 1/γ(u)",
        _TREES,
        ("off by",),
        ("order condition", "witness"),
    ),
    Term(
        "witness",
        "A tree whose condition fails: the proof that the order is not higher.",
        "",
        "this project, docs/exact-order.md, section 2",
        ("fails at order",),
        ("order condition", "certificate"),
    ),
    Term(
        "certificate",
        "The proof of an order: trees that span those of each order, whose conditions hold, and a"
        " witness of the next. tools/referee.py decides it again without gark.",
        "",
        "this project, docs/certificate.md",
        (),
        ("witness", "order"),
    ),
    Term(
        "order",
        "The largest p for which all order conditions up to order p hold: one step differs from the"
        " exact solution by O(h^(p+1)).",
        "",
        paper(_ORDER),
        ("order of a method",),
        ("order condition", "pair", "non-autonomous order"),
    ),
    Term(
        "non-autonomous order",
        "The order on problems y' = f(t, y) with the nodes as they are printed. It differs from the"
        " order where a node is not the row sum of A.",
        "c_i ≠ Σ_j a_ij",
        "this project; E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I,"
        " section II.2",
        ("non-autonomous", "nonautonomous", "embedded non-autonomous order"),
        ("node", "consistent"),
    ),
    Term(
        "error constant",
        "The size of the first conditions that fail: the norm of (value − required)/σ over the"
        " trees of order p + 1.",
        "",
        "E. Hairer, S. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, section II.3",
        ("error coefficients", "error constants", "principal error"),
        ("residual", "symmetry"),
    ),
    Term(
        "B(r)",
        "The weights of every colour integrate polynomials of degree below r.",
        "Σ_i b_i^{l} (c_i^{l})^(k−1) = 1/k,  k = 1, …, r",
        paper(_ORDER + ", definition of the simplifying conditions"),
        ("B", "B(p)", "B(k)"),
        ("C(η)", "D(ζ)", "bound"),
    ),
    Term(
        "C(η)",
        "The stages of a block are exact where the solution is a polynomial of degree up to η.",
        "A^{l,m} (c^{m})^(k−1) = (c^{l})^k / k,  k = 1, …, η",
        paper(_ORDER + ", definition of the simplifying conditions"),
        ("C", "C(eta)", "C(q)", "C(k)"),
        ("B(r)", "D(ζ)", "stage order"),
    ),
    Term(
        "D(ζ)",
        "The weights pass through a block from the left: the condition of a tree whose root has"
        " k − 1 leaves and one branch more follows from simpler ones.",
        "(A^{l,m})ᵀ B^{l} (c^{l})^(k−1) = B^{m} (𝟙 − (c^{m})^k) / k,  k = 1, …, ζ",
        paper(_ORDER + ", definition of the simplifying conditions"),
        ("D", "D(zeta)", "D(s)", "D(k)"),
        ("B(r)", "C(η)", "bound"),
    ),
    Term(
        "bound",
        "The order that B, C and D guarantee, by the Simplifying Assumption Theorem; ξ is the least"
        " η^{l,m} + ζ^{l,m} of a block. The order may be larger.",
        "min{r, 2η+2, ξ+1, η+ζ+1}",
        paper(_ORDER + ", Simplifying Assumption Theorem"),
        ("pair bound", "simplifying assumption", "B, C, D"),
        ("B(r)", "C(η)", "D(ζ)", "sharper bound"),
    ),
    Term(
        "sharper bound",
        "A bound by the same numbers that is never smaller than the paper's; χ is the least"
        " ζ^{l,m} + η^{m,n} of a block and one that follows it.",
        "min{r, 2η+2, ξ+1, χ+2, η+ζ+3}",
        "this project, docs/sharper-bound.md",
        ("pair, sharper", "sharp bound"),
        ("bound",),
    ),
    Term(
        "stage order",
        "The largest q for which B(q) and C(q) hold: the weights and all stage values have that"
        " order. Stiff problems show it where the order of the method is larger.",
        "B(q) and C(q)",
        "E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, section IV.15",
        ("stage orders",),
        ("C(η)", "weak stage order", "stiffness"),
    ),
    Term(
        "weak stage order",
        "The largest q up to which what the stages miss never reaches the new value. Stiff linear"
        " problems then show order q also where the stage order is smaller.",
        "bᵀ A^j (A c^(k−1) − c^k/k) = 0 for k = 1, …, q and all j",
        "D. I. Ketcheson, B. Seibold, D. Shirokoff, D. Zhou, DIRK schemes with high weak stage"
        " order (2020)",
        ("WSO",),
        ("stage order", "stiffness"),
    ),
    Term(
        "consistent",
        "The nodes are the row sums of every block. Then all colours are taken at the same times.",
        "A^{l,m} 𝟙 = c^{l}",
        paper("section 6.3, Consistency and simplifying conditions for transfer matrices"),
        ("conjugate nodes", "consistency"),
        ("node", "non-autonomous order"),
    ),
    Term(
        "effective order",
        "The order that a method has up to a change of coordinates before the first and after the"
        " last step.",
        "",
        "J. Butcher, The effective order of Runge-Kutta methods, in Conference on"
        " the Numerical Solution of Differential Equations (1969)",
        (),
        ("order", "modified equation"),
    ),
    Term(
        "tolerance",
        "How far each coefficient of a file may be off; zeros are exact. A condition is met within"
        " t when rounding by t explains its residual, and fails when it does not.",
        "",
        "this project, docs/exact-order.md",
        ("within",),
        ("residual",),
    ),
)
