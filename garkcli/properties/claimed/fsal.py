"""First same as last."""

from garkcli.properties.last_stage import first_same_as_last
from garkcli.properties.naming import stages_name
from garkcli.properties.property import Property, Verdict
from garkcli.properties.subject import MISSING_BLOCKS, Subject


def _decide(subject: Subject) -> Verdict:
    tableau = subject.tableau
    if not subject.is_complete:
        return Verdict.meaningless(MISSING_BLOCKS)
    found = first_same_as_last(tableau, subject.tolerance)
    if found.not_first is not None:
        stage = stages_name(tableau, [(found.not_first, 0)])
        return Verdict(False, f"{stage} is not the old value")
    if found.not_last is not None:
        last = tableau.spaces[found.not_last].stages - 1
        stage = stages_name(tableau, [(found.not_last, last)])
        return Verdict(False, f"{stage} is not the new value")
    return Verdict(True)


PROPERTY = Property(
    key="fsal",
    text=(
        "First same as last: the first stage value is the old value, its row zero, and the last one"
        " the new value, its row the weights, for all vector fields, in each method. The last"
        " evaluations of a step are the first ones of the next."
    ),
    source="J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980)",
    kind="truth",
    decide=_decide,
    meaning="methods whose stages all see all vector fields",
)
