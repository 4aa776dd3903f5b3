"""Which methods are put to work for a picture."""

from __future__ import annotations

from garkcli.tableau.garkmethod import GarkMethod

MOST_STAGES = 40
"""Of a method that is put to work for a picture."""
MOST_ROUNDED_STAGES = 20
"""Of one with rounded coefficients, whose order takes longer."""


def is_large(method: GarkMethod) -> bool:
    """Whether steps would take longer than a picture is worth."""
    is_rounded = method.tolerance is not None
    most = MOST_ROUNDED_STAGES if is_rounded else MOST_STAGES
    return sum(method.stages) > most
