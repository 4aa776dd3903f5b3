"""P-stable methods."""

from garkcli.design.wants.want import Asked, Meaning, Want
from garkcli.errors import MethodError
from garkcli.tableau.family import Stability


def _meaning(asked: Asked) -> Meaning:
    """Decided at each solution, in its number field."""
    if len(asked.colours) < asked.tableau.size:
        raise MethodError("design: p-stable is meant of the whole method", "write p-stable: true")
    return Meaning(stable=(Stability("p-stable"),))


WANT = Want("p-stable", "flag", "bounded on the oscillator for every step size", _meaning)
