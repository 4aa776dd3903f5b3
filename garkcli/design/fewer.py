"""The fewest linear forms of the parameters on which the step of a family depends.

The step M = N/D on a linear problem is constant along a direction v of the parameters if and only
if D ∂_v N = N ∂_v D. These equations are linear in v: they give all such directions, and the other
directions give the linear forms.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain
from typing import Any

from flint import fmpq, fmpq_mat, fmpq_mpoly

from garkcli.deadline import check_time
from garkcli.design.member import restricted
from garkcli.design.stability_functions import joined
from garkcli.exact.display import to_text
from garkcli.exact.matrix import Matrix, characteristic_coefficients
from garkcli.exact.parametric import Parameters, common_denominator
from garkcli.exact.span import leading_columns
from garkcli.frozen import Frozen
from garkcli.stepping.linear import stage_system
from garkcli.tableau.family import Family, reducing
from garkcli.tableau.tableau import Tableau


class LinearForm(Frozen):
    """Σ a_i t_i of parameters with nonzero a_i; the first is 1."""

    terms: tuple[tuple[str, fmpq], ...]

    def __str__(self) -> str:
        (first, _), *others = self.terms
        return first + _sum_text(others)

    def solved(self, value: str) -> tuple[str, str]:
        (first, _), *others = self.terms
        return first, value + _sum_text([(name, -a) for name, a in others])


def _sum_text(terms: Sequence[tuple[str, fmpq]]) -> str:
    parts = []
    for name, a in terms:
        factor = "" if abs(a) == 1 else f"{to_text(abs(a))}*"
        parts.append(f" {'-' if a < 0 else '+'} {factor}{name}")
    return "".join(parts)


def fewest(
    family: Family, tableau: Tableau, fields: Sequence[Matrix]
) -> tuple[Family, list[LinearForm]]:
    """The family with the fewest parameters, at least one, as forms in the old ones. Its
    coefficients are polynomials in parameters and roots. The step of ``tableau``, which is made of
    the family, counts; ``fields`` are the maps y ↦ L^m y of each colour, rational.
    """
    names = family.parameters
    pivots, directions = _directions(tableau, family, fields)
    pivots, directions = pivots[: len(names) - 1], directions[: len(names) - 1]
    kept = [k for k in range(len(names)) if k not in pivots]
    forms = []
    for k in kept:
        others = [(names[p], -v[k]) for p, v in zip(pivots, directions, strict=True)]
        forms.append(LinearForm(((names[k], fmpq(1)), *(x for x in reversed(others) if x[1]))))
    if not pivots:
        return family, forms
    parameters = tuple(names[k] for k in kept)
    ring = Parameters([*parameters, *(x.name for x in family.radicals)])
    values: dict[str, Any] = {name: fmpq(0) for name in names}
    values |= {name: ring.parameter(name) for name in ring.names}
    return restricted(family, ring, values, parameters, family.radicals), forms


def step_polynomials(
    tableau: Tableau, ring: Parameters, fields: Sequence[Matrix]
) -> tuple[fmpq_mpoly, list[fmpq_mpoly]]:
    """D and the entries of N of the step N/D, in z and the parameters."""
    system = stage_system(tableau, fields)
    d = len(fields[0])
    D = characteristic_coefficients(system.W)
    functions = [D]
    for i in range(d):
        for j in range(d):
            # det(I − z (W − e_j b_i)) = D (1 + z b_i (I − zW)⁻¹ e_j)
            rows = (
                tuple(w - row_E[j] * b for w, b in zip(row, system.B[i], strict=True))
                for row, row_E in zip(system.W, system.E, strict=True)
            )
            entry = characteristic_coefficients(tuple(rows))
            functions.append([a if i == j else a - b for a, b in zip(entry, D, strict=True)])
    common = common_denominator(list(chain.from_iterable(functions)), ring)
    denominator, *numerators = (joined(x, common, ring) for x in functions)
    return denominator, numerators


def _directions(
    tableau: Tableau, family: Family, fields: Sequence[Matrix]
) -> tuple[list[int], list[list[fmpq]]]:
    denominator, numerators = step_polynomials(tableau, family.ring, fields)
    number = len(family.parameters)
    modulo = reducing(["_z", *family.ring.names], family.radicals)
    slopes = []
    for numerator in numerators:
        check_time()
        changes = [
            denominator * numerator.derivative(k) - numerator * denominator.derivative(k)
            for k in range(1, number + 1)
        ]
        tables = [modulo.reduced(p).to_dict() for p in changes]
        rows = [[fmpq(table.get(e, 0)) for table in tables] for e in dict.fromkeys(chain(*tables))]
        slopes += rows
    if not slopes:
        slopes = [[fmpq(0)] * number]
    # late parameters are solved for, so their columns come first in the echelon form of the kernel
    matrix = fmpq_mat([row[::-1] for row in slopes])
    reduced, _ = matrix.rref()
    leading = leading_columns(reduced)
    free = [k for k in range(number) if k not in leading]
    kernel = []
    for k in free:
        v = [fmpq(0)] * number
        v[k] = fmpq(1)
        for row, pivot in enumerate(leading):
            v[pivot] = -reduced[row, k]
        kernel.append(v)
    if not kernel:
        return [], []
    echelon, _ = fmpq_mat(kernel).rref()
    pivots = [number - 1 - k for k in leading_columns(echelon)]
    return pivots, [row[::-1] for row in echelon.tolist()]
