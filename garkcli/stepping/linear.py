"""The stages of a method on a linear problem as one system, and its step, exactly.

With the vector field y ↦ L^m y of colour m, L^m ∈ K^{d×d}, the stage values obey

    Y^k = 𝟙 ⊗ y₀ + h Σ_m (A^{k,m} ⊗ L^m) Y^{space(m)},    y₁ = y₀ + h Σ_m (b_m ⊗ L^m) Y^{space(m)}.

With only the components X of each Y^k that some vector field uses, these are

    X = E y₀ + h W X,    y₁ = y₀ + h B X,    hence    y₁ = R(h) y₀,
    R(h) = I + h B (I − hW)⁻¹ E = I + Σ_k h^k B W^{k−1} E.

A number of K = ℚ(θ) is its multiplication matrix over ℚ, so that all is rational arithmetic.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TypeAlias

from flint import arb, arb_mat, fmpq, fmpq_mat

from garkcli.errors import UsageProblem
from garkcli.exact.display import to_ball
from garkcli.exact.field import ONE, ZERO, Number, NumberField, coordinates
from garkcli.exact.matrix import Matrix, identity, multiply, scale, subtract, transpose
from garkcli.frozen import Frozen
from garkcli.problems.oscillator import Oscillator, check_structure
from garkcli.tableau.tableau import Tableau

_Rows: TypeAlias = list[list[Number]]


class StageSystem(Frozen):
    """W, E and B of the module, of shapes (n, n), (n, d), (d, n) with n stage values in use."""

    W: Matrix
    E: Matrix
    B: Matrix


class _Term(Frozen):
    """An entry of a field: ``factor`` times ``seen`` is added to ``driven``."""

    colour: int
    driven: int
    seen: int
    factor: Number


def stage_system(
    tableau: Tableau, fields: Sequence[Matrix], pattern: Sequence[Matrix] | None = None
) -> StageSystem:
    """Returns the linear system of the stages for the L^m, shape (d, d). ``pattern`` is nonzero
    where some parameters make L^m so, so that the unknowns agree for all. Raises MethodError for
    other methods.
    """
    tableau.demand_fields("a step on a linear problem")
    d = len(fields[0])
    if pattern is None:
        pattern = fields
    terms = list(_terms(fields, pattern))
    first, n = _first_unknowns(tableau, terms)
    W = _zeros(n, n)
    E = _zeros(n, d)
    B = _zeros(d, n)
    for term in terms:
        colour = tableau.colours[term.colour]
        column = first[colour.space, term.seen]
        _add(B, term.driven, column, term.factor, (colour.b,))
        for (space, component), row in first.items():
            if component != term.driven:
                continue
            block = tableau.blocks.get((space, term.colour))
            if block is not None:
                _add(W, row, column, term.factor, block)
    for (space, component), row in first.items():
        _add(E, row, component, ONE, tuple((x,) for x in tableau.spaces[space].one))
    return StageSystem(_frozen(W), _frozen(E), _frozen(B))


def _terms(fields: Sequence[Matrix], pattern: Sequence[Matrix]) -> Iterator[_Term]:
    for m, (L, kept) in enumerate(zip(fields, pattern, strict=True)):
        for i, row in enumerate(kept):
            for j, is_kept in enumerate(row):
                if is_kept:
                    yield _Term(m, i, j, L[i][j])


def _first_unknowns(
    tableau: Tableau, terms: Sequence[_Term]
) -> tuple[dict[tuple[int, int], int], int]:
    """The first unknown of each (stage space, component of y), and their number."""
    first: dict[tuple[int, int], int] = {}
    n = 0
    for term in terms:
        place = tableau.colours[term.colour].space, term.seen
        if place not in first:
            first[place] = n
            n += tableau.space(term.colour).stages
    return first, n


def _zeros(rows: int, columns: int) -> _Rows:
    return [[ZERO] * columns for _ in range(rows)]


def _frozen(rows: _Rows) -> Matrix:
    return tuple(tuple(row) for row in rows)


def _add(matrix: _Rows, row: int, column: int, factor: Number, block: Matrix) -> None:
    for i, entries in enumerate(block, start=row):
        for j, x in enumerate(entries, start=column):
            matrix[i][j] = matrix[i][j] + factor * x


MAX_STEPS = 10**15


class LinearStep(Frozen):
    """The system over ℚ: with d the degree of ``field``, W is (dn, dn), E (dn, 2), B (2d, dn)."""

    problem: Oscillator
    field: NumberField | None
    W: fmpq_mat
    E: fmpq_mat
    B: fmpq_mat

    def at(self, h: fmpq) -> Matrix:
        """R(h), exact, shape (2, 2); UsageProblem if the stage equations are singular."""
        n = self.W.nrows()
        unit = fmpq_mat(n, n)
        for i in range(n):
            unit[i, i] = ONE
        system = unit - self.W * h
        try:
            X = system.solve(self.E)
        except ZeroDivisionError:
            message = f"the stage equations have no unique solution for h = {h}"
            raise UsageProblem(message, "choose another step size", code="step-fails") from None
        (a, b), (c, d) = self._numbers(self.B * X * h)
        return (ONE + a, b), (c, ONE + d)

    def series(self) -> Iterator[Matrix]:
        """The coefficients R_1, R_2, … of R(h) = I + Σ R_k h^k, exact, without end."""
        X = self.E
        while True:
            yield self._numbers(self.B * X)
            X = self.W * X

    def _numbers(self, flat: fmpq_mat) -> Matrix:
        if self.field is None:
            return tuple(tuple(row) for row in flat.tolist())
        d = self.field.degree
        columns = flat.transpose().tolist()
        rows = []
        for i in range(0, 2 * d, d):
            coordinates_of_row = [column[i : i + d] for column in columns]
            row = [self.field.from_coordinates(x) for x in coordinates_of_row]
            rows.append(tuple(row))
        return tuple(rows)


def linear_step(tableau: Tableau, problem: Oscillator) -> LinearStep:
    """Raises UsageProblem if the split does not suit the structure of the tableau."""
    check_structure(tableau, problem)
    system = stage_system(tableau, [problem.matrix(colour) for colour in tableau.colours])
    field = tableau.field
    return LinearStep(
        problem,
        field,
        _over_rationals(system.W, field),
        _columns(system.E, field),
        _over_rationals(system.B, field),
    )


def _over_rationals(rows: Matrix, field: NumberField | None) -> fmpq_mat:
    """Replaces each number by its multiplication matrix over ℚ."""
    if field is None:
        return fmpq_mat([[x for x in row if isinstance(x, fmpq)] for row in rows])
    d = field.degree
    # 1, θ, … θ^{d−1}
    powers = [field.from_coordinates([fmpq(i == k) for i in range(d)]) for k in range(d)]
    columns = []
    for entries in zip(*rows, strict=True):
        for power in powers:
            column: list[fmpq] = []
            for x in entries:
                column += coordinates(x * power, d)
            columns.append(column)
    return fmpq_mat(columns).transpose()


def _columns(rows: Matrix, field: NumberField | None) -> fmpq_mat:
    """Replaces each number by its column of coordinates over ℚ."""
    d = field.degree if field else 1
    flat = []
    for entries in rows:
        of_entries = zip(*(coordinates(x, d) for x in entries), strict=True)
        flat += [list(row) for row in of_entries]
    return fmpq_mat(flat)


def enclosure(matrix: Matrix, bits: int) -> arb_mat:
    digits = bits * 3 // 10 + 1
    return arb_mat([[to_ball(x, digits) for x in row] for row in matrix])


def conserves_energy(R: Matrix, omega: fmpq) -> bool:
    """Whether Rᵀ G R = G with G = diag(ω², 1), that is, a step keeps ½(p² + ω²q²); exact."""
    G: Matrix = ((omega * omega, ZERO), (ZERO, ONE))
    form = multiply(transpose(R), multiply(G, R))
    return not any(x for row in subtract(form, G) for x in row)


def deviations(step: LinearStep) -> Iterator[arb]:
    """The distances of the coefficients of h, h², … in R(h) from those of exp(hL), without end:
    each the largest of four entries, in units with ω = 1; zero if and only if all are.
    """
    omega = step.problem.omega
    L: Matrix = ((ZERO, ONE), (-omega * omega, ZERO))
    units: Matrix = ((ONE, omega), (ONE / omega, ONE))
    exact = identity(2)
    for k, R_k in enumerate(step.series(), start=1):
        exact = scale(fmpq(1, k), multiply(L, exact))
        difference = subtract(R_k, exact)
        largest = arb(0)
        power = omega**k
        for i in (0, 1):
            for j in (0, 1):
                scaled = units[i][j] * difference[i][j] / power
                largest = largest.max(abs(to_ball(scaled)))
        yield largest


def visible_order(step: LinearStep, tolerance: fmpq | None = None) -> int:
    """Returns the largest r with R(h) = exp(hL) + O(h^{r+1}): the order that this problem sees, by
    unbranched trees along which the split is nonzero. The search ends because R is rational in h
    and cos ωh is not, or, with a ``tolerance`` for the ``deviations``, when 1/r! is as small.
    """
    limit = fmpq(0) if tolerance is None else tolerance
    coefficient = ONE
    for r, deviation in enumerate(deviations(step)):
        coefficient /= r + 1
        if deviation > limit or coefficient <= limit:
            return r
    raise AssertionError("the series of a rational function has no end")


def whole_steps(t_end: fmpq, h: fmpq) -> int:
    """Returns n = t_end / h; UsageProblem if it is not a positive integer, or too large."""
    if h <= 0 or t_end <= 0:
        message = f"step {h} and end time {t_end} are not both positive"
        raise UsageProblem(message, "give positive numbers", code="step-size")
    n = t_end / h
    if n.q != 1:
        near = h * max(int(n.floor()), 1)
        message = f"the end time {t_end} is not a whole number of steps {h}"
        raise UsageProblem(message, f"end at {near}", code="step-size")
    if n.p > MAX_STEPS:
        message = f"{n} steps (limit {MAX_STEPS})"
        raise UsageProblem(message, "choose a shorter time or larger steps", code="too-many")
    return int(n.p)
