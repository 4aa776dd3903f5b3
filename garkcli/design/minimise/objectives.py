"""The objectives by their names: one entry of ``OBJECTIVES`` each."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import Any

from flint import fmpq, fmpq_mat, fmpq_mpoly

from garkcli.design.family_step import Flat, family_step
from garkcli.design.minimise import objective as aims
from garkcli.design.minimise.measures import MEASURES
from garkcli.design.minimise.sector import Angle, angle_of
from garkcli.design.minimise.squared_error import (
    Quotient,
    squared_coupling_error,
    squared_dense_error,
    squared_error,
)
from garkcli.design.stability_kinds import oscillator_curves, squared_modulus
from garkcli.errors import UsageProblem
from garkcli.exact.cells import first_end
from garkcli.exact.field import ONE
from garkcli.exact.matrix import Matrix, identity
from garkcli.exact.parametric import Parameters, fraction
from garkcli.exact.projection import PLANE
from garkcli.problems.oscillator import Oscillator, check_structure, terms_of
from garkcli.stability.linear import imaginary_set, real_set, stability_function
from garkcli.stability.oscillator import oscillator_stability
from garkcli.stability.ssp import conditions_at, ssp_coefficient
from garkcli.tableau.forms import on_linear_problems
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.stages import PointSpace, StageSpace
from garkcli.tableau.tableau import Tableau


def is_linear(tableau: Tableau) -> bool:
    """Whether the linear test equation is applicable."""
    spaces = range(len(tableau.spaces))
    colours = range(tableau.size)
    is_complete = all((k, m) in tableau.blocks for k in spaces for m in colours)
    return is_complete and not tableau.is_partitioned


def fraction_in_plane(tableau: Tableau, ring: Parameters) -> tuple[fmpq_mpoly, fmpq_mpoly]:
    """R = P/Q on the linear test equation, with y in place of z, and t; raises UsageProblem."""
    refuse_partitioned(tableau)
    tableau = on_linear_problems(tableau)
    fields: list[Matrix] = [((ONE,),)] * tableau.size
    plane = family_step(Flat(tableau, ring), fields)
    return plane.numerators[0][0], plane.denominator


def refuse_partitioned(tableau: Tableau) -> None:
    """Raises UsageProblem if some stages do not depend on every vector field."""
    if not is_linear(tableau):
        raise UsageProblem(
            "the linear test equation does not apply: some stages do not depend on every"
            " vector field",
            "minimise -oscillator-interval",
            code="wanted-without-meaning",
        )


def refuse_one_colour(tableau: Tableau) -> None:
    """Raises UsageProblem without coupling errors."""
    if on_linear_problems(tableau).size == 1:
        message = "error-coupling: the method has one colour, and no tree has two"
        raise UsageProblem(message, "minimise error", code="wanted-without-meaning")


def _coupling_error(subject: aims.ObjectiveSubject, ring: Parameters | None) -> Quotient:
    refuse_one_colour(subject.tableau)
    return squared_coupling_error(subject.tableau, subject.order + 1, ring)


def _dense_error(subject: aims.ObjectiveSubject, ring: Parameters | None) -> Quotient:
    dense, order = subject.further.dense, subject.dense_order
    if dense is None or order is None:
        message = "dense-error needs dense output of some order, and the file wants none"
        cure = "write dense beside b, and dense-order: 3 under design"
        raise UsageProblem(message, cure, code="wanted-without-meaning")
    return squared_dense_error(subject.tableau, dense, order + 1, ring)


def _squared_coefficients(subject: aims.ObjectiveSubject, ring: Parameters | None) -> Quotient:
    """Σ a_ij² = tr(A T_m⁻¹ Aᵀ T_k), Σ b_j² = b T⁻¹ bᵀ with T_ij = Σ e_i e_j over the nodes. On
    point stages T is the identity; in a polynomial space it makes the sum rational even for
    irrational nodes.
    """
    tableau = subject.tableau
    tableau.demand_fields("Σ a² + Σ b²")
    total: Any = fmpq(0)
    inverses = [_inverse(_traces(space)) for space in tableau.spaces]
    for colour in tableau.colours:
        total = total + _product(colour.b, inverses[colour.space], colour.b)
    for (k, m), block in tableau.blocks.items():
        T = _traces(tableau.spaces[k])
        inverse = inverses[tableau.colours[m].space]
        for i, row in enumerate(block):
            for j, other in enumerate(block):
                if T[i][j]:
                    total = total + _product(row, inverse, other) * T[i][j]
    if ring is None:
        return Quotient(total, ONE)
    return Quotient(*fraction(total, ring))


def _traces(space: StageSpace) -> Matrix:
    s = space.stages
    if not isinstance(space, PolynomialSpace):
        return identity(s)
    # the sum of f over the nodes is the trace of multiplication by f
    powers = list(zip(*space.reductions(3 * s - 2), strict=True))
    sums = [sum(powers[k + i][i] for i in range(s)) for k in range(2 * s - 1)]
    return tuple(tuple(sums[i : i + s]) for i in range(s))


def _inverse(T: Matrix) -> Matrix:
    s = len(T)
    entries: list[Any] = list(chain.from_iterable(T))
    return tuple(map(tuple, fmpq_mat(s, s, entries).inv().tolist()))


def _product(left: Any, matrix: Matrix, right: Any) -> Any:
    total: Any = fmpq(0)
    for x, line in zip(left, matrix, strict=True):
        for a, y in zip(line, right, strict=True):
            if a and x and y:
                total = total + x * y * a
    return total


def _ssp(tableau: Tableau) -> aims.Size:
    tableau.demand_fields("the SSP coefficient")
    coefficient = ssp_coefficient(tableau)
    if coefficient is None:
        message = "-ssp: some blocks are missing, or the nodes have no simple radicals"
        raise UsageProblem(message, "spell the tableau out", code="no-radicals")
    return coefficient.value


def _ssp_signs(tableau: Tableau, ring: Parameters) -> aims.LevelSigns:
    """det(I + rK) and det(I + rK) (I + rK)⁻¹ v are of degree one in each row of K."""
    tableau.demand_fields("the SSP coefficient")
    if not all(isinstance(x, PointSpace) for x in tableau.spaces):
        message = "-ssp: families by name have no rational entries"
        raise UsageProblem(message, "spell the tableau out, stage by stage", code="no-radicals")
    size = 2 + sum(space.stages for space in tableau.spaces)
    return aims.LevelSigns([p for p in Flat(tableau, ring).polynomials(size, conditions_at) if p])


def _real(tableau: Tableau) -> aims.Size:
    refuse_partitioned(tableau)
    return first_end(real_set(stability_function(on_linear_problems(tableau))))


def _real_signs(tableau: Tableau, ring: Parameters) -> aims.LevelSigns:
    """Q² − P² at −y; it is negative at a pole."""
    P, Q = fraction_in_plane(tableau, ring)
    y, t = PLANE.gens()
    P, Q = P.compose(-y, t), Q.compose(-y, t)
    return aims.LevelSigns([(Q - P) * (Q + P)])


def _imaginary(tableau: Tableau) -> aims.Size:
    refuse_partitioned(tableau)
    return first_end(imaginary_set(stability_function(on_linear_problems(tableau))))


def _imaginary_signs(tableau: Tableau, ring: Parameters) -> aims.LevelSigns:
    """|Q|² − |P|² in the square of the imaginary part; it is negative at a pole."""
    P, Q = fraction_in_plane(tableau, ring)
    return aims.LevelSigns([squared_modulus(Q) - squared_modulus(P)])


def _sector(tableau: Tableau) -> aims.Size:
    refuse_partitioned(tableau)
    return angle_of(stability_function(on_linear_problems(tableau)))


def oscillator_of(tableau: Tableau) -> Oscillator:
    tableau.demand_fields("the oscillator")
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    check_structure(tableau, problem)
    return problem


def _oscillator(tableau: Tableau) -> aims.Size:
    return first_end(oscillator_stability(tableau, oscillator_of(tableau)).stable)


def _oscillator_signs(tableau: Tableau, ring: Parameters) -> aims.LevelSigns:
    """The denominator, the conditions on the eigenvalues, and the entries off the diagonal."""
    problem = oscillator_of(tableau)
    fields = [problem.matrix(colour) for colour in tableau.colours]
    conditions, others = oscillator_curves(family_step(Flat(tableau, ring), fields))
    poles, _, _, upper, lower = others
    return aims.LevelSigns(
        [poles, *conditions, upper, lower], _is_bounded, is_closed=False, common=others
    )


def _is_bounded(signs: Sequence[int]) -> bool:
    pole, area, right, left, upper, lower = signs
    if not pole or min(area, right, left) < 0:
        return False
    is_double = area == 0 and 0 in (right, left)
    return not is_double or upper == lower == 0


OSCILLATOR_INTERVAL = aims.LevelObjective(
    "-oscillator-interval",
    "the z such that all powers of the step are bounded on the oscillator for hω ≤ z",
    _oscillator,
    _oscillator_signs,
    is_square=True,
)
"""E. Hairer, C. Lubich, G. Wanner, *Geometric Numerical Integration*, section I.5.2."""
REAL_INTERVAL = aims.LevelObjective(
    "-real-interval",
    "the x with |R| ≤ 1 on [−x, 0], the vector fields all equal",
    _real,
    _real_signs,
    claim="real-stability",
)
"""E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, section IV.2."""

OBJECTIVES: dict[str, aims.Objective | aims.LevelObjective | aims.SearchMeasure | aims.Either] = {
    objective.key: objective
    for objective in (
        # E. Hairer, S. Nørsett, G. Wanner, *Solving Ordinary Differential Equations I*, II.3
        aims.Objective(
            "error",
            "Σ e(u)² over the trees of order {next}, e(u) = (b·𝒜[u] − 1/γ(u)) / σ(u)",
            lambda x, ring: squared_error(x.tableau, x.order + 1, ring),
        ),
        aims.Objective(
            "error-coupling",
            "Σ e(u)² over the trees of order {next} with more than one colour,"
            " e(u) = (b·𝒜[u] − 1/γ(u)) / σ(u)",
            _coupling_error,
        ),
        aims.Objective(
            "dense-error",
            "∫ Σ e_θ(u)² dθ over the trees of order q + 1 and θ from 0 to 1, q the dense order, e_θ"
            " the errors of the dense output",
            _dense_error,
        ),
        aims.Objective(
            "coefficients",
            "Σ a² + Σ b² over all coefficients of all blocks and weights",
            _squared_coefficients,
            lambda tableau: tableau.entries,
        ),
        # J. F. B. M. Kraaijevanger, *Contractivity of Runge–Kutta methods*, BIT 31, 1991
        aims.LevelObjective(
            "-ssp", "the SSP coefficient", _ssp, _ssp_signs, claim="ssp-coefficient"
        ),
        aims.Either(
            "-stability-interval",
            lambda tableau: REAL_INTERVAL if is_linear(tableau) else OSCILLATOR_INTERVAL,
        ),
        REAL_INTERVAL,
        # E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, section IV.2
        aims.LevelObjective(
            "-imaginary-interval",
            "the y with |R| ≤ 1 on [−iy, iy], the vector fields all equal",
            _imaginary,
            _imaginary_signs,
            is_square=True,
            claim="imaginary-stability",
        ),
        # E. Hairer, G. Wanner, *Solving Ordinary Differential Equations II*, section V.2
        Angle(
            "-sector",
            "the angle α, in degrees, with |R| ≤ 1 where |arg(−z)| ≤ α, the vector fields all"
            " equal",
            _sector,
        ),
        OSCILLATOR_INTERVAL,
        *MEASURES,
    )
}
