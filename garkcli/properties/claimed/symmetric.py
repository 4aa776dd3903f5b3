"""Symmetric methods."""

from garkcli.properties.property import Property, Verdict
from garkcli.properties.reduction import is_plainly_irreducible, reduced
from garkcli.properties.subject import Subject
from garkcli.properties.symmetry import MOST_RENUMBERINGS, symmetry


def _decide(subject: Subject) -> Verdict:
    found = subject.symmetry
    if found.holds is None and subject.tolerance:
        return Verdict.undecided("rounding leaves the nodes open")
    if found.holds is None:
        return Verdict.undecided(
            f"there are more than {MOST_RENUMBERINGS} renumberings"
        )
    if found.holds:
        return Verdict(True)
    return _reduced_verdict(subject)


def _reduced_verdict(subject: Subject) -> Verdict:
    """Where no renumbering does: stages that do nothing, and equal ones, may be in its way."""
    obstacle = Verdict(False, "no renumbering of the stages gives the adjoint method")
    tableau = subject.tableau
    if is_plainly_irreducible(tableau, subject.tolerance):
        return obstacle
    smaller = reduced(tableau)
    if smaller is None:
        return Verdict.undecided("stages at irrational nodes are not compared")
    if smaller is tableau:
        return obstacle
    holds = symmetry(smaller, subject.tolerance).holds
    if holds is None:
        return Verdict.undecided("there are too many renumberings once it is reduced")
    if holds:
        return Verdict(True, "once it is reduced")
    return obstacle


PROPERTY = Property(
    key="symmetric",
    text=(
        "The method is its own adjoint, the inverse of the step with −h: renumbering the stages of"
        " each method, the same for all blocks, turns A^{l,m} into 𝟙 (b^{m})ᵀ − A^{l,m} and keeps"
        " the weights. In the stage algebra of a family the renumbering is x → 1 − x. Of a"
        " reducible method it is asked of the smaller one that does the same."
    ),
    source="E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section V.2",
    kind="truth",
    decide=_decide,
)
