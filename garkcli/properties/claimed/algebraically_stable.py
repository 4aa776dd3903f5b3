"""Algebraic stability."""

from garkcli.properties.contractive import obstacle, obstacle_within
from garkcli.properties.property import Property, Verdict
from garkcli.properties.subject import MISSING_BLOCKS, Subject


def _decide(subject: Subject) -> Verdict:
    if not subject.is_complete:
        return Verdict.meaningless(MISSING_BLOCKS)
    if not subject.tolerance:
        return Verdict.unless(obstacle(subject.tableau))
    found = obstacle_within(subject.tableau, subject.tolerance)
    if found is None:
        return Verdict.undecided("rounding leaves the signs open")
    return Verdict.unless(found)


PROPERTY = Property(
    key="algebraically-stable",
    text=(
        "No weight is negative, and the matrix M with the blocks B^{l} A^{l,m} + (A^{m,l})ᵀ B^{m} −"
        " b^{l} (b^{m})ᵀ is positive semidefinite. Then differences of solutions never grow where"
        " every vector field is contractive (B-stability)."
    ),
    source=(
        "K. Burrage, J. C. Butcher, SIAM J. Numer. Anal. 16 (1979); for GARK methods: A. Sandu,"
        " M. Günther, SIAM J. Numer. Anal. 53 (2015)"
    ),
    kind="truth",
    decide=_decide,
    meaning="methods whose stages all see all vector fields",
)
