"""All results of backward error analysis of one method."""

from __future__ import annotations

from flint import arb, fmpq

from garkcli.backward import hamiltonian as hamiltonians
from garkcli.backward.effective import effective_order
from garkcli.backward.modified import ModifiedEquation, modified_equation
from garkcli.doing import doing
from garkcli.exact.enclosing import midpoint
from garkcli.exact.field import Number
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.free import Structure
from garkcli.order.deciding import order_of
from garkcli.order.meant import AnyTableau, meant
from garkcli.order.simplifying import is_symplectic
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown

EXTRA = 3
"""Digits of coefficients of rounded methods beyond the printed ones."""


class Reached(Frozen):
    """An order of a modified equation.

    Attributes:
        order: the order.
        is_lower_bound: whether the next one is unknown.
    """

    order: int
    is_lower_bound: bool = False


class BackwardAnalysis(Shown, Frozen):
    """The modified equation of a method and the orders that follow from it.

    Attributes:
        equation: the coefficients.
        order: the order of the method.
        structure: of its Hamiltonian problems, or None.
        is_symplectic: whether the coefficients are symplectic, exactly or within the tolerance.
        symplectic: the order of symplecticity; None without a structure.
        energy: the order to which steps conserve energy; None without a structure.
        effective: the order up to a change of coordinates.
        hamiltonian: the terms of the modified Hamiltonian; None if there is none.
        tolerance: of the coefficients; then the three orders are lower bounds.

    >>> from garkcli import backward_analysis
    >>> found = backward_analysis("implicit-midpoint", 4)
    >>> found.order.order, found.is_symplectic, found.effective.order
    (2, True, 2)
    """

    equation: ModifiedEquation
    order: Reached
    structure: Structure | None
    is_symplectic: bool
    symplectic: Reached | None
    energy: Reached | None
    effective: Reached
    hamiltonian: tuple[hamiltonians.HamiltonianTerm, ...] | None = None
    tolerance: fmpq | None = None

    def __repr__(self) -> str:
        is_so = ", symplectic" if self.is_symplectic else ""
        least = "at least " if self.order.is_lower_bound else ""
        return f"<BackwardAnalysis order {least}{self.order.order}{is_so}>"


@doing("modified equation")
def backward_analysis(
    tableau: Tableau, max_order: int, tolerance: fmpq | None = None
) -> BackwardAnalysis:
    """The backward analysis with trees of up to ``max_order`` vertices; with a ``tolerance`` of the
    method that the digits mean. Raises UsageProblem for too many trees.

    >>> from garkcli import loads
    >>> found = backward_analysis(loads("methods: [{family: rk4}]").tableau, 6)
    >>> found.symplectic.order, found.energy.order
    (4, 4)
    """
    structure = hamiltonians.hamiltonian_structure(tableau)
    if tolerance:
        return _of_rounded(meant(tableau, tolerance), max_order, structure)
    equation = modified_equation(tableau, max_order)
    shift = effective_order(equation)
    effective = Reached(shift.order, not shift.is_proved)
    order = _reached(equation.order, max_order)
    if structure is None:
        return BackwardAnalysis(equation, order, None, False, None, None, effective)
    proved = is_symplectic(tableau)
    symplectic = hamiltonians.symplectic_order(equation, structure)
    terms = None
    if proved:
        terms = tuple(hamiltonians.modified_hamiltonian(equation, structure))
    return BackwardAnalysis(
        equation,
        order,
        structure,
        proved,
        _reached(symplectic, max_order),
        _reached(hamiltonians.energy_order(equation, structure), max_order),
        effective,
        terms,
    )


def _of_rounded(
    rounded: AnyTableau, max_order: int, structure: Structure | None
) -> BackwardAnalysis:
    assert not isinstance(rounded, Tableau)
    found = order_of(rounded, max_order)
    order = Reached(found.order, found.is_lower_bound)
    proved = is_symplectic(rounded)
    near = rounded.near.changed(lambda x: midpoint(x) if isinstance(x, arb) else x)
    equation, zero = modified_equation(near, max_order), rounded.grain
    unit = fmpq(10) ** -(len(str((1 / rounded.tolerance).floor())) + EXTRA)

    def rounded_to_unit(x: Number) -> fmpq:
        assert isinstance(x, fmpq)
        return unit * (x / unit + fmpq(1, 2)).floor()

    symplectic = energy = terms = None
    if structure is not None:
        known = max_order if proved else hamiltonians.symplectic_order(equation, structure, zero)
        symplectic = Reached(known, True)
        energy = Reached(hamiltonians.energy_order(equation, structure, zero), True)
    if structure is not None and proved:
        terms = tuple(
            replace(term, coefficient=rounded_to_unit(term.coefficient))
            for term in hamiltonians.modified_hamiltonian(equation, structure, zero)
        )
    return BackwardAnalysis(
        equation=replace(equation, coefficients=tuple(map(rounded_to_unit, equation.coefficients))),
        order=order,
        structure=structure,
        is_symplectic=proved,
        symplectic=symplectic,
        energy=energy,
        effective=Reached(order.order, True),
        hamiltonian=terms,
        tolerance=rounded.tolerance,
    )


def _reached(order: int, largest: int) -> Reached:
    return Reached(order, order == largest)
