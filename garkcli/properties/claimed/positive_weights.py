"""Positive weights."""

from garkcli.exact.signs import sign
from garkcli.properties.naming import number_text, weight_name
from garkcli.properties.property import Property, Verdict
from garkcli.properties.reduction import are_positive
from garkcli.properties.subject import Subject
from garkcli.tableau.point_space import PointSpace


def _decide(subject: Subject) -> Verdict:
    tableau, tolerance = subject.tableau, subject.tolerance
    is_open = False
    for m, colour in enumerate(tableau.colours):
        space = tableau.space(m)
        if not isinstance(space, PointSpace):
            if not are_positive(space, colour.b):
                return Verdict(False, f"b{{{colour.name}}} has an entry that is not positive")
            is_open = is_open or bool(tolerance)
            continue
        for j, b in enumerate(colour.b):
            if not b or sign(b + tolerance) < 0:
                why = f"{weight_name(tableau, m, j)} is {number_text(b)}"
                return Verdict(False, why)
            is_open = is_open or sign(b - tolerance) <= 0
    if is_open:
        return Verdict.undecided("a weight is not larger than the tolerance")
    return Verdict(True)


PROPERTY = Property(
    key="positive-weights",
    text=(
        "All weights b_i^{l} are larger than 0. In the stage algebra of a family that says that the"
        " quadratic form f ↦ b^{l}(f²) is positive definite."
    ),
    source="E. Hairer, G. Wanner, Solving ODEs II, section IV.12",
    kind="truth",
    decide=_decide,
)
