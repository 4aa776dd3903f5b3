"""The imaginary stability interval."""

from garkcli.exact.cells import first_end
from garkcli.exact.root_number import square_root
from garkcli.properties.linear import no_meaning
from garkcli.properties.property import Property, Size, Verdict
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    from garkcli.stability.linear import imaginary_set

    if subject.linear is None:
        return no_meaning()
    if subject.tolerance:
        return Verdict.undecided("the coefficients are rounded")
    squared = first_end(imaginary_set(subject.linear))
    return Verdict(Size(None if squared is None else square_root(squared)))


PROPERTY = Property(
    key="imaginary-stability",
    text=(
        "The length of the imaginary stability interval: the largest y for which |R(z)| ≤ 1 on"
        " [−iy, iy]."
    ),
    source="P. J. van der Houwen, Construction of Integration Formulas (1977), section 2.3",
    kind="number",
    decide=_decide,
    meaning="methods whose stages all see all vector fields",
    is_cheap=False,
)
