"""SDIRK methods with an explicit first stage."""

from garkcli.properties.property import Property, Verdict
from garkcli.properties.solving import decide_singly
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    return decide_singly(subject, "ESDIRK")


PROPERTY = Property(
    key="esdirk",
    text=(
        "The first stage value is the old value; every other one depends on itself directly, all"
        " with the same coefficient γ, and no two depend on each other. For several methods this is"
        " meant of each. The claim `gamma` says which γ it is."
    ),
    source="C. A. Kennedy, M. H. Carpenter, NASA/TM-2016-219173",
    kind="truth",
    decide=_decide,
)
