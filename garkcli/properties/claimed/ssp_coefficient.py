"""The SSP coefficient."""

from flint import fmpq

from garkcli.exact.field import ZERO
from garkcli.exact.roots import RealRoot
from garkcli.exact.signs import sign
from garkcli.properties.linear import no_meaning
from garkcli.properties.naming import entry_name, number_text, weight_name
from garkcli.properties.property import Property, Size, Verdict
from garkcli.properties.subject import Subject
from garkcli.tableau.tableau import Tableau


def _decide(subject: Subject) -> Verdict:
    from garkcli.stability.ssp import ssp_coefficient

    if not subject.is_complete:
        return no_meaning()
    if subject.points is None:
        return Verdict.undecided("the nodes have no simple radicals")
    negative = _negative(subject.points, subject.tolerance)
    if subject.tolerance and not negative:
        return Verdict.undecided("the coefficients are rounded")
    if negative:
        return Verdict(Size(RealRoot.rational(ZERO)), negative)
    found = ssp_coefficient(subject.points)
    assert found is not None
    return Verdict(Size(found.value))


def _negative(tableau: Tableau, tolerance: fmpq) -> str:
    """The first negative coefficient, with which there is no absolute monotonicity."""
    for (k, m), block in tableau.blocks.items():
        for i, row in enumerate(block):
            for j, a in enumerate(row):
                if a and sign(a + tolerance) < 0:
                    name = entry_name(tableau, k, m, i, j)
                    return f"{name} is {number_text(a)}"
    for m, colour in enumerate(tableau.colours):
        for j, b in enumerate(colour.b):
            if b and sign(b + tolerance) < 0:
                return f"{weight_name(tableau, m, j)} is {number_text(b)}"
    return ""


PROPERTY = Property(
    key="ssp-coefficient",
    text=(
        "The radius of absolute monotonicity: the largest r for which, with K = (A 0; bᵀ 0), no"
        " entry of (I + rK)⁻¹ K and (I + rK)⁻¹ 𝟙 is negative. Up to r times the step size with"
        " which explicit Euler keeps a convex bound, the method keeps it (strong stability"
        " preserving). For several colours the same r for each."
    ),
    source=(
        "J. F. B. M. Kraaijevanger, BIT 31 (1991); additive methods: I. Higueras, SIAM J. Numer."
        " Anal. 44 (2006)"
    ),
    kind="number",
    decide=_decide,
    meaning="methods whose stages all see all vector fields",
    is_cheap=False,
)
