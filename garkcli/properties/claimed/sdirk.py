"""Singly diagonally implicit methods."""

from garkcli.properties.property import Property, Verdict
from garkcli.properties.solving import decide_singly
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    return decide_singly(subject, "SDIRK")


PROPERTY = Property(
    key="sdirk",
    text=(
        "Every stage value depends on itself directly, all with the same coefficient γ, and no two"
        " depend on each other. The claim `gamma` says which γ it is."
    ),
    source="E. Hairer, G. Wanner, Solving ODEs II, section IV.6",
    kind="truth",
    decide=_decide,
)
