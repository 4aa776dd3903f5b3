"""The interval of stability: on the oscillator where the method is for that, else on the negative
real axis.
"""

from garkcli.design.minimise.intervals import is_linear
from garkcli.design.minimise.objective import Either, Level
from garkcli.design.minimise.objectives.oscillator_interval import OBJECTIVE as ON_OSCILLATOR
from garkcli.design.minimise.objectives.real_interval import OBJECTIVE as ON_REAL_AXIS
from garkcli.tableau.tableau import Tableau


def _meant(tableau: Tableau) -> Level:
    return ON_REAL_AXIS if is_linear(tableau) else ON_OSCILLATOR


OBJECTIVE = Either("-stability-interval", _meant)
