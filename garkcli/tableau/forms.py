"""Every kind of method as one tableau, and time as a colour."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TypeAlias

from garkcli.errors import MethodError
from garkcli.exact.field import ONE, ZERO
from garkcli.exact.matrix import Matrix, Vector, apply
from garkcli.frozen import replace
from garkcli.ntrees.kind import LEAF, LINEAR, NOT_ONE, ONE_BRANCH, PLAIN
from garkcli.tableau.conjugate import conjugate_of
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Colour, Edge, Method, Part, Tableau, butcher

Blocks: TypeAlias = Mapping[Edge, Matrix]
Coefficients: TypeAlias = tuple[Matrix, Vector, Vector | None]
"""(A, b, c); c None means the row sums of A."""
_NewBlocks: TypeAlias = dict[Edge, Matrix]


def gark(methods: Sequence[Method], transfer: Blocks) -> Tableau:
    """Returns the tableau of diagonal ``methods`` and blocks ``transfer[l, m]``, eq. (GARK)."""
    spaces = []
    colours = []
    blocks: _NewBlocks = {}
    for l, method in enumerate(methods):
        colour = Colour(str(l + 1), l, method.b, method.c, l)
        spaces.append(method.space)
        colours.append(colour)
        blocks[l, l] = method.A
    blocks.update(transfer)
    return Tableau(tuple(spaces), tuple(colours), blocks)


def one_field(tableau: Tableau, message: str, name: str = "") -> Method:
    """The single colour of a method, in its own stage space; MethodError for several colours."""
    block = tableau.block(0, 0)
    if tableau.size != 1 or block is None:
        raise MethodError(message, "give a method of one colour", code="wrong-size")
    return Method(name, tableau.space(0), block, tableau.colours[0].b)


def spelled_out(
    A: Sequence[Sequence[Matrix | None]],
    b: Sequence[Vector],
    c: Sequence[Vector | None],
    linear: Iterable[int] = (),
) -> Tableau:
    """Returns a GARK tableau by blocks; missing nodes are row sums."""
    linear = frozenset(linear)
    spaces = []
    colours = []
    for l, weights in enumerate(b):
        nodes = c[l]
        if nodes is None:
            nodes = _row_sums(l, A[l], len(weights))
        kind = LINEAR if l in linear else PLAIN
        colour = Colour(str(l + 1), l, weights, nodes, l, kind=kind)
        spaces.append(PointSpace(nodes))
        colours.append(colour)
    blocks: _NewBlocks = {}
    for l, row in enumerate(A):
        for m, block in enumerate(row):
            if block is not None:
                blocks[l, m] = block
    return Tableau(tuple(spaces), tuple(colours), blocks)


def _row_sums(l: int, row: Sequence[Matrix | None], stages: int) -> Vector:
    block = row[l]
    if block is None:
        block = next((x for x in row if x is not None), None)
    if block is None:
        return (ZERO,) * stages
    return apply(block, PointSpace(block[0]).one)


def additive(A: Sequence[Matrix], b: Sequence[Vector], c: Vector | None) -> Tableau:
    """Returns a method with one set of stages, and a matrix and weights for each colour."""
    nodes = c
    if nodes is None:
        nodes = _row_sums(0, A, len(A[0]))
    colours = [Colour(str(l + 1), 0, weights, nodes, l) for l, weights in enumerate(b)]
    blocks: _NewBlocks = {(0, m): block for m, block in enumerate(A)}
    return Tableau((PointSpace(nodes),), tuple(colours), blocks)


def partitioned(q: Method, p: Method) -> Tableau:
    """Returns a method for q̇ = v(q, p), ṗ = f(q, p), both with the same stages."""
    velocity = Colour("q", 0, q.b, q.c, 0, "q")
    force = Colour("p", 0, p.b, p.c, 1, "p")
    return Tableau((q.space,), (velocity, force), {(0, 0): q.A, (0, 1): p.A})


def separable_prk(q: Coefficients, p: Coefficients) -> Tableau:
    """A partitioned method for q̇ = V(p), ṗ = F(q); blocks may be rectangular.

    The rows of q.A are the positions at which forces are evaluated, so q.c are the nodes of the
    force colour; likewise p.A and p.c belong to the velocity colour.
    """
    A_q, b_q, c_q = q
    A_p, b_p, c_p = p
    at_momenta = c_p
    at_positions = c_q
    if at_momenta is None:
        at_momenta = _row_sums(0, [A_p], len(b_q))
    if at_positions is None:
        at_positions = _row_sums(0, [A_q], len(b_p))
    spaces = (PointSpace(at_momenta), PointSpace(at_positions))
    velocity = Colour("q", 0, b_q, at_momenta, 0, "q")
    force = Colour("p", 1, b_p, at_positions, 1, "p")
    return Tableau(spaces, (velocity, force), {(0, 1): A_p, (1, 0): A_q})


def with_linear(tableau: Tableau, names: Iterable[str]) -> Tableau:
    names = frozenset(names)
    colours = []
    for colour in tableau.colours:
        if colour.name in names:
            colour = replace(colour, kind=LINEAR)
        colours.append(colour)
    return replace(tableau, colours=tuple(colours))


def symplectic_pair(tableau: Tableau, velocities: Sequence[int], forces: Sequence[int]) -> Tableau:
    """The pair (Q, P) of a GARK tableau Q and its conjugate P, for the vector fields of the
    problem.

    Colours V^l for l in ``velocities`` and F^l for l in ``forces``; V^l and F^l have the same
    stages. An l in only one of the two is a Hamiltonian of p or of q alone, whose stages need only
    the other part:

    ========================  =====================  ======================================
    velocities, forces        structure              blocks
    ========================  =====================  ======================================
    all, all                  general, eq. (varGARK) A^{l,m}, Â^{l,m}
    {1}, {1, 2}               semi-separable         A^{1,1}, A^{2,1}, Â^{1,1}, Â^{1,2}
    {1}, {2}                  separable              A^{2,1}, Â^{1,2}
    ========================  =====================  ======================================

    Raises ZeroWeight if a conjugate would divide by zero; MethodError if the tableau is already
    partitioned, or no GARK method.
    """
    tableau.demand_fields("the symplectic pair")
    if tableau.is_partitioned:
        message = "the method is partitioned already"
        raise MethodError(message, "give the tableau of the positions", code="cannot-construct")
    driven = {*velocities, *forces}
    used = [l for l in range(tableau.size) if l in driven]
    spaces = tuple(tableau.space(l) for l in used)
    row = {l: k for k, l in enumerate(used)}
    colours = tableau.colours
    V = [_driving(colours[l], "V", row[l], "q") for l in velocities]
    F = [_driving(colours[l], "F", row[l], "p") for l in forces]
    blocks: _NewBlocks = {}
    for l in forces:
        for k, m in enumerate(velocities):
            block = tableau.block(l, m)
            if block is not None:
                blocks[row[l], k] = block
    for l in velocities:
        for k, m in enumerate(forces, start=len(V)):
            if tableau.block(m, l) is not None:
                blocks[row[l], k] = conjugate_of(tableau, l, m)
    return Tableau(spaces, (*V, *F), blocks)


def _driving(colour: Colour, letter: str, space: int, part: Part) -> Colour:
    return replace(colour, name=letter + colour.name, space=space, part=part)


def pair(tableau: Tableau) -> Tableau:
    """Eq. (varGARK): 2N colours V¹…Vᴺ, F¹…Fᴺ. Of a partitioned tableau the position blocks stay,
    and the momentum blocks become their conjugates. Raises ZeroWeight.
    """
    if not tableau.is_partitioned:
        everything = range(tableau.size)
        return symplectic_pair(tableau, everything, everything)
    is_q = [colour.part == "q" for colour in tableau.colours]
    blocks: _NewBlocks = {(k, m): block for (k, m), block in tableau.blocks.items() if is_q[m]}
    for m, l in tableau.edges():
        if is_q[l] and not is_q[m]:
            k = tableau.colours[l].space
            blocks[k, m] = conjugate_of(tableau, l, m)
    return replace(tableau, blocks=blocks)


def on_linear_problems(tableau: Tableau) -> Tableau:
    """Returns the GARK method with the same step on linear problems. For a Rosenbrock method it has
    A = β = α + γ, as vertices of linear problems have one branch.
    """
    kinds = {colour.kind for colour in tableau.colours}
    if kinds != {NOT_ONE, ONE_BRANCH}:
        return tableau
    kept = [m for m, colour in enumerate(tableau.colours) if colour.kind == ONE_BRANCH]
    places = {
        (l, m): tableau.blocks[tableau.colours[k].space, j]
        for l, k in enumerate(kept)
        for m, j in enumerate(kept)
    }
    methods = [butcher(places[l, l], tableau.colours[k].b) for l, k in enumerate(kept)]
    return gark(methods, places)


TIME = "t"


def with_time(tableau: Tableau) -> Tableau | None:
    """The tableau with time as its last colour, for ẏ = f(t, y) with its printed nodes.

    With ṫ = 1 the problem is autonomous. A method evaluates f at t + c_i h, so the block of time is
    c; its vector field is constant, so its vertices have no branches. If A^{l,m} 𝟙 = c^{l} for
    every block, a vertex of time has the same weight as any other leaf, and nothing changes.

    None if a vector field is linear, or colours share stages but not nodes; MethodError if the
    tableau is no GARK method.

    >>> from flint import fmpq
    >>> from garkcli.tableau.forms import gark
    >>> from garkcli.tableau.tableau import butcher
    >>> from garkcli.order.certificate import find_order
    >>> midpoint = gark([butcher(((fmpq(1, 2),),), (fmpq(1),), (fmpq(0),))], {})
    >>> find_order(midpoint).order, find_order(with_time(midpoint)).order
    (2, 1)
    """
    tableau.demand_fields("time beside the stages", with_flow=True)
    nodes: dict[int, Vector] = {}
    for colour in tableau.colours:
        first = nodes.setdefault(colour.space, colour.c)
        if colour.is_linear or first != colour.c:
            return None
    return beside_clock(tableau, tableau.size)


def beside_clock(tableau: Tableau, term: int) -> Tableau:
    """Returns the tableau with time, term ``term``, as last colour, which stages see as nodes.
    Colours that share stages have to share nodes.
    """
    time = tableau.size
    columns = {(x.space, time): tuple((c_i,) for c_i in x.c) for x in tableau.colours}
    clock = Colour(TIME, len(tableau.spaces), (ONE,), (ZERO,), term=term, kind=LEAF)
    spaces = (*tableau.spaces, PointSpace((ZERO,)))
    return Tableau(spaces, (*tableau.colours, clock), {**tableau.blocks, **columns})
