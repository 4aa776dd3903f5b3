"""The real stability interval."""

from garkcli.exact.cells import first_end
from garkcli.properties.linear import no_meaning
from garkcli.properties.property import Property, Size, Verdict
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    from garkcli.stability.linear import real_set

    if subject.linear is None:
        return no_meaning()
    if subject.tolerance:
        return Verdict.undecided("the coefficients are rounded")
    return Verdict(Size(first_end(real_set(subject.linear))))


PROPERTY = Property(
    key="real-stability",
    text=(
        "The length of the real stability interval: the largest x for which |R(z)| ≤ 1 on [−x, 0]."
    ),
    source="E. Hairer, G. Wanner, Solving ODEs II, section IV.2",
    kind="number",
    decide=_decide,
    meaning="methods whose stages all see all vector fields",
    is_cheap=False,
)
