"""A-stability."""

from garkcli.properties.linear import decide_within, no_meaning, obstacle_to_a_stability
from garkcli.properties.property import Property, Verdict
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    if subject.linear is None:
        return no_meaning()
    if subject.tolerance:
        return decide_within(subject.linear_within.a_stable)
    return Verdict.unless(obstacle_to_a_stability(subject.linear))


PROPERTY = Property(
    key="a-stable",
    text=(
        "|R(z)| ≤ 1 for all z with Re z ≤ 0, where R is the stability function, y_1 = R(hλ) y_0"
        " for ẏ = λy with all vector fields equal. Decided by the poles of R and the polynomial"
        " E = |Q(iy)|² − |P(iy)|² for R = P/Q."
    ),
    source="G. Dahlquist, BIT 3 (1963); E. Hairer, G. Wanner, Solving ODEs II, section IV.3",
    kind="truth",
    decide=_decide,
    meaning="methods whose stages all see all vector fields",
    is_cheap=False,
)
