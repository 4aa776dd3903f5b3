"""How many stages are solved for."""

from garkcli.properties.property import Property, Verdict
from garkcli.properties.solving import UNDECIDED, what_is_solved_for
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    count = subject.shape.implicit_stages
    if count is None:
        return Verdict.undecided(UNDECIDED)
    return Verdict(count, what_is_solved_for(subject))


PROPERTY = Property(
    key="implicit-stages",
    text=(
        "The number of stage values that depend on themselves, directly or through others. Stages"
        " that several vector fields share count once."
    ),
    source="E. Hairer, G. Wanner, Solving ODEs II, section IV.6",
    kind="count",
    decide=_decide,
)
