"""Explicit methods."""

from garkcli.properties.property import Property, Verdict
from garkcli.properties.solving import UNDECIDED, what_is_solved_for
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    if subject.shape.kind is None:
        return Verdict.undecided(UNDECIDED)
    return Verdict.unless(what_is_solved_for(subject))


PROPERTY = Property(
    key="explicit",
    text=(
        "No stage value depends on itself, neither directly nor through others: all stages of all"
        " methods can be put in an order in which each follows from those before."
    ),
    source="E. Hairer, S. P. Nørsett, G. Wanner, Solving ODEs I, section II.1",
    kind="truth",
    decide=_decide,
)
