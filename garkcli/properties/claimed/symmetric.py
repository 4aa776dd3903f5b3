"""Symmetric methods."""

from garkcli.properties.property import Property, Verdict
from garkcli.properties.subject import Subject
from garkcli.properties.symmetry import MOST_RENUMBERINGS


def _decide(subject: Subject) -> Verdict:
    found = subject.symmetry
    if found.holds is None and subject.tolerance:
        return Verdict.undecided("rounding leaves the nodes open")
    if found.holds is None:
        return Verdict.undecided(
            f"there are more than {MOST_RENUMBERINGS} renumberings"
        )
    return Verdict.unless(
        "" if found.holds else "no renumbering of the stages gives the adjoint method"
    )


PROPERTY = Property(
    key="symmetric",
    text=(
        "The method is its own adjoint, the inverse of the step with −h: renumbering the stages of"
        " each method, the same for all blocks, turns A^{l,m} into 𝟙 (b^{m})ᵀ − A^{l,m} and keeps"
        " the weights. In the stage algebra of a family the renumbering is x → 1 − x."
    ),
    source="E. Hairer, C. Lubich, G. Wanner, Geometric Numerical Integration, section V.2",
    kind="truth",
    decide=_decide,
)
