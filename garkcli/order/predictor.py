"""The orders of a predictor Y_i ≈ y + h Σ_j p_ij(r) k_j + h Σ_j q_ij(r) K_j, with h = r h_old.

The slopes k_j of the last step and K_j of this one are those of the 2s stages of a method for both
steps, with blocks A, 1 bᵀ and r A in units of h_old. The stage is y + h Σ_j a_ij K_j, so that the
prediction is off by O(h^(q+1)) on every problem if the weights (p_i, q_i − a_i) vanish at all trees
of at most q vertices: its order is the largest q. At a tree u they give a polynomial in r of degree
d + |u| − 1 at most, d the degree of the weights: as many ratios and one more decide it.

I. Higueras, T. Roldán, *Starting algorithms for some DIRK methods*, Numerical Algorithms 23, 2000;
M. P. Laburta, *Starting algorithms for IRK methods*, J. Comput. Appl. Math. 83, 1997.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

from flint import fmpq

from garkcli.errors import MethodError
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Matrix, Vector, subtract
from garkcli.frozen import Frozen, replace
from garkcli.order.certificate import StageSpans, Witness
from garkcli.order.functionals import Functional, first_failure
from garkcli.tableau.embedded import Predictor
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau


class Missed(Frozen):
    """A tree at which a prediction is not the stage, at one ratio of step sizes."""

    ratio: fmpq
    witness: Witness


class StageOrder(Frozen):
    """The order of a prediction for every ratio of step sizes, and for equal steps. The conditions
    that fail are one order above; None if the search stopped.
    """

    stage: int
    order: int
    equal_steps: int
    missed: Missed | None
    missed_equal: Missed | None


class PredictorOrders(Frozen):
    stages: tuple[StageOrder, ...]

    @property
    def order(self) -> int:
        return min(x.order for x in self.stages)

    @property
    def equal_steps(self) -> int:
        return min(x.equal_steps for x in self.stages)

    def first_missed(self, *, equal_steps: bool) -> tuple[int, Missed] | None:
        for x in self.stages:
            missed = x.missed_equal if equal_steps else x.missed
            order = x.equal_steps if equal_steps else x.order
            if missed is not None and order == (self.equal_steps if equal_steps else self.order):
                return x.stage, missed
        return None


def implicit_stages(tableau: Tableau) -> list[int]:
    """The stages, from 0, that see themselves or later ones."""
    return [i for i, row in enumerate(tableau.blocks[0, 0]) if any(row[i:])]


def check_predictor(tableau: Tableau, predictor: Predictor) -> None:
    """Raises MethodError if no stage has to be predicted, or slopes are used too early."""
    implicit = implicit_stages(tableau)
    if not implicit:
        message = "predictor: every stage is explicit, so none has to be predicted"
        raise MethodError(message, "leave it out", code="cannot-construct")
    needed = _needed(tableau.blocks[0, 0])
    for matrix in predictor.new:
        for i in implicit:
            for j, weight in enumerate(matrix[i]):
                if weight and i in needed[j]:
                    message = f"predictor, new: stage {j + 1} is not known where stage {i + 1} is "
                    message += "predicted"
                    cure = "a row of new has the stages that are solved before its own"
                    raise MethodError(message, cure, code="cannot-construct")


def _needed(A: Matrix) -> list[set[int]]:
    """For each stage the stages that have to be known with it, itself among them."""
    needed = [{i, *(j for j, a in enumerate(row) if a)} for i, row in enumerate(A)]
    for _ in A:
        needed = [set().union(*(needed[j] for j in found)) for found in needed]
    return needed


def two_steps(tableau: Tableau, ratio: Number) -> Tableau:
    """The stages of a step of size 1, then those of the next one, of size r, without weights."""
    colour, (A,) = tableau.colours[0], tableau.blocks.values()
    zeros = (ZERO,) * len(A)
    first = tuple((*row, *zeros) for row in A)
    second = tuple((*colour.b, *(ratio * a for a in row)) for row in A)
    nodes = (*colour.c, *(1 + ratio * c for c in colour.c))
    changed = replace(colour, b=(*zeros, *zeros), c=nodes)
    return Tableau((PointSpace(nodes),), (changed,), {(0, 0): (*first, *second)})


def misses(tableau: Tableau, predictor: Predictor, stage: int, ratio: Number) -> Vector:
    """The prediction of a stage minus the stage, as weights of the stages of both steps."""
    old, new = predictor.at(ratio)
    return (*old[stage], *subtract(new, tableau.blocks[0, 0])[stage])


def ratios(predictor: Predictor, order: int) -> Sequence[fmpq]:
    """Ratios at which the conditions of an order hold if they hold for every ratio; 1 first."""
    return [fmpq(r) for r in range(1, predictor.degree + order + 1)]


def predictor_orders(tableau: Tableau, predictor: Predictor, limit: int) -> PredictorOrders:
    """The order of the prediction of each implicit stage of an exact tableau of one colour.

    >>> from garkcli.tableau.forms import gark
    >>> from garkcli.tableau.tableau import butcher
    >>> one, zero = fmpq(1), fmpq(0)
    >>> euler = gark([butcher(((one,),), (one,))], {})
    >>> found = predictor_orders(euler, Predictor((((one,),),), (((zero,),),)), 9)
    >>> found.order, found.equal_steps
    (1, 1)
    """
    spans = cache(lambda ratio: StageSpans(two_steps(tableau, ratio)))

    def missed(stage: int, order: int, ratio: fmpq) -> Missed | None:
        functional = Functional((misses(tableau, predictor, stage, ratio),))
        known = spans(ratio)
        failure = first_failure(known.tableau, [functional], [order], known)
        return None if failure is None else Missed(ratio, failure.witness)

    def found(stage: int, is_any: bool) -> tuple[int, Missed | None]:
        for order in range(1, limit + 1):
            for ratio in ratios(predictor, order) if is_any else [fmpq(1)]:
                failure = missed(stage, order, ratio)
                if failure is not None:
                    return order - 1, failure
        return limit, None

    orders = []
    for stage in implicit_stages(tableau):
        order, failure = found(stage, is_any=True)
        equal, failure_of_equal = found(stage, is_any=False)
        orders.append(StageOrder(stage, order, equal, failure, failure_of_equal))
    return PredictorOrders(tuple(orders))
