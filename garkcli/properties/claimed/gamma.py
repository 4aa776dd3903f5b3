"""The coefficient γ of singly diagonally implicit methods."""

from garkcli.exact.polynomial import Polynomial
from garkcli.exact.roots import real_roots
from garkcli.properties.property import Property, Size, Verdict
from garkcli.properties.solving import UNDECIDED, what_is_not_singly
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    shape = subject.shape
    if shape.kind is None:
        return Verdict.undecided(UNDECIDED)
    if shape.gamma is None:
        return Verdict.meaningless(what_is_not_singly(subject))
    ((root, _),) = real_roots(Polynomial([-shape.gamma, 1]))
    return Verdict(Size(root))


PROPERTY = Property(
    key="gamma",
    text=(
        "The coefficient by which every implicit stage value depends on itself directly. Each of"
        " the systems that are solved has the matrix I − hγJ."
    ),
    source="E. Hairer, G. Wanner, Solving ODEs II, section IV.6",
    kind="number",
    decide=_decide,
    meaning="diagonally implicit methods whose implicit stages share one coefficient",
)
