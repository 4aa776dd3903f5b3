"""Reducible methods."""

from garkcli.properties.property import Property, Verdict
from garkcli.properties.reduction import is_plainly_irreducible, reduced, sizes
from garkcli.properties.subject import Subject


def _decide(subject: Subject) -> Verdict:
    tableau = subject.tableau
    if is_plainly_irreducible(tableau, subject.tolerance):
        return Verdict(False, "every stage has a weight, and row sums of its own")
    smaller = reduced(tableau)
    if smaller is None:
        return Verdict.undecided("stages at irrational nodes are not compared")
    if sizes(smaller) != sizes(tableau):
        stages = ", ".join(str(space.stages) for space in smaller.spaces)
        return Verdict(True, f"{stages} stages do the same")
    if subject.tolerance:
        return Verdict.undecided("rounding may hide equal stages")
    return Verdict(False, "every stage matters, and no two are equal")


PROPERTY = Property(
    key="reducible",
    text=(
        "Fewer stages do the same. A stage that no weight and no stage that matters looks at can be"
        " left out (DJ-reducible), the last one of an FSAL method too. Stages that are equal on"
        " every problem can be one. `gark reduce` writes the smaller method."
    ),
    source=(
        "G. Dahlquist, R. Jeltsch, TRITA-NA-7904 (1979); W. H. Hundsdorfer, M. N. Spijker,"
        " BIT 21 (1981)"
    ),
    kind="truth",
    decide=_decide,
)
