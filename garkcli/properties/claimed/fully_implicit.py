"""Methods with stages that are solved together."""

from garkcli.properties.property import Property, Verdict
from garkcli.properties.solving import UNDECIDED
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    kind = subject.shape.kind
    if kind is None:
        return Verdict.undecided(UNDECIDED)
    return Verdict.unless("" if kind == "fully implicit" else f"it is {kind}")


PROPERTY = Property(
    key="fully-implicit",
    text=(
        "At least two stage values, of one method or of several, depend on each other and are"
        " solved for together: the graph of who sees whom has a strongly connected component of"
        " more than one stage."
    ),
    source="E. Hairer, G. Wanner, Solving ODEs II, section IV.5",
    kind="truth",
    decide=_decide,
)
