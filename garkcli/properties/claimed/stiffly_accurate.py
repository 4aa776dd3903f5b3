"""Stiffly accurate methods."""

from garkcli.properties.last_stage import is_stiffly_accurate, missed_entries, new_value
from garkcli.properties.naming import entry_name, number_text, weight_name
from garkcli.properties.property import Property, Verdict
from garkcli.properties.subject import MISSING_BLOCKS, Subject
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.tableau import Tableau


def _decide(subject: Subject) -> Verdict:
    tableau = subject.tableau
    if not subject.is_complete:
        return Verdict.meaningless(MISSING_BLOCKS)
    if is_stiffly_accurate(tableau, subject.tolerance):
        return Verdict(True)
    return Verdict(False, _missed(tableau))


def _missed(tableau: Tableau) -> str:
    """Where the last stage differs from the weights."""
    space = tableau.spaces[-1]
    if not isinstance(space, PointSpace):
        return "at no node the stage has the weights as its rows"
    k = len(tableau.spaces) - 1
    i = space.stages - 1
    (m, j), *_ = missed_entries(tableau, k, i, new_value(tableau))
    block = tableau.blocks[k, m]
    entry = number_text(block[i][j])
    weight = number_text(tableau.colours[m].b[j])
    name = entry_name(tableau, k, m, i, j)
    name_of_weight = weight_name(tableau, m, j)
    return f"{name} is {entry}, {name_of_weight} is {weight}"


PROPERTY = Property(
    key="stiffly-accurate",
    text=(
        "A stage value is the new value: for one stage i of one method l, a_ij^{l,m} = b_j^{m} for"
        " every vector field m and all j."
    ),
    source=(
        "A. Prothero, A. Robinson, Math. Comp. 28 (1974); globally, for GARK methods: A. Sandu,"
        " M. Günther, SIAM J. Numer. Anal. 53 (2015)"
    ),
    kind="truth",
    decide=_decide,
    meaning="methods whose stages all see all vector fields",
)
