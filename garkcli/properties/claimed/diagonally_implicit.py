"""Diagonally implicit methods."""

from garkcli.properties.property import Property, Verdict
from garkcli.properties.solving import UNDECIDED, what_is_solved_together
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    kind = subject.shape.kind
    if kind is None:
        return Verdict.undecided(UNDECIDED)
    if kind == "explicit":
        return Verdict(False, "it is explicit")
    return Verdict.unless(what_is_solved_together(subject))


PROPERTY = Property(
    key="diagonally-implicit",
    text=(
        "At least one stage value depends on itself, and no two depend on each other: implicit"
        " stages are solved for one after the other. Explicit methods are not called so."
    ),
    source="R. Alexander, SIAM J. Numer. Anal. 14 (1977)",
    kind="truth",
    decide=_decide,
)
