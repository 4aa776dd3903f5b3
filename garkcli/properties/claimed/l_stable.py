"""L-stability."""

from garkcli.properties.linear import decide_within, no_meaning, obstacle_to_a_stability
from garkcli.properties.naming import number_text
from garkcli.properties.property import Property, Verdict
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    R = subject.linear
    if R is None:
        return no_meaning()
    if subject.tolerance:
        return decide_within(subject.linear_within.l_stable)
    limit = R.at_infinity()
    if limit:
        return Verdict(False, f"R(∞) = {number_text(limit)}")
    return Verdict.unless(obstacle_to_a_stability(R))


PROPERTY = Property(
    key="l-stable",
    text="A-stable with R(∞) = 0: what is infinitely stiff is damped in one step.",
    source="B. L. Ehle, thesis, Waterloo (1969)",
    kind="truth",
    decide=_decide,
    meaning="methods whose stages all see all vector fields",
    is_cheap=False,
)
