"""Nodes within a step."""

from flint import fmpq_poly

from garkcli.exact.field import ONE, ZERO, Number
from garkcli.exact.signs import roots_below, sign
from garkcli.properties.naming import number_text, place_name
from garkcli.properties.property import Property, Verdict
from garkcli.properties.subject import Subject
from garkcli.tableau.polynomial_space import PolynomialSpace
from garkcli.tableau.tableau import Tableau


def _decide(subject: Subject) -> Verdict:
    for l, colour in enumerate(subject.tableau.colours):
        space = subject.tableau.space(l)
        if isinstance(space, PolynomialSpace) and tuple(colour.c) == tuple(space.nodes):
            reflected = space.modulus(fmpq_poly([1, -1]))
            if roots_below(space.modulus, ZERO) or roots_below(reflected, ZERO):
                return Verdict(False, f"a node of colour {colour.name} is outside")
            continue
        found = subject.points
        if found is None:
            return Verdict.undecided("the nodes have no simple radicals")
        for i, c in enumerate(found.colours[l].c):
            if sign(_beyond(c) - subject.tolerance) > 0:
                return Verdict(False, _outside(found, l, i))
    return Verdict(True)


def _beyond(c: Number) -> Number:
    """How far a node is outside of [0, 1]; not positive for one inside."""
    return -c if sign(c) < 0 else c - ONE


def _outside(tableau: Tableau, l: int, i: int) -> str:
    colour = tableau.colours[l]
    return f"{place_name('c', tableau, [colour.name], i)} is {number_text(colour.c[i])}"


PROPERTY = Property(
    key="nodes-in-unit-interval",
    text="All nodes c_i^{l} lie in [0, 1]: nothing is evaluated outside of the step.",
    source="J. C. Butcher, Numerical Methods for ODEs, section 23",
    kind="truth",
    decide=_decide,
)
