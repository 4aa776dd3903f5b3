"""P-stable methods."""

from garkcli.design.wants.want import Asked, Meaning, Want, refuse_colours


def _meaning(asked: Asked) -> Meaning:
    """Decided at each solution, in its number field."""
    refuse_colours(asked, "p-stable")
    return Meaning(stable=("p-stable",))


WANT = Want(
    "p-stable",
    "flag",
    "bounded on the oscillator for every step size",
    _meaning,
)
