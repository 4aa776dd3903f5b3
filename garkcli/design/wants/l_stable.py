"""L-stable methods."""

from garkcli.design.wants.want import Asked, Meaning, Want, refuse_colours


def _meaning(asked: Asked) -> Meaning:
    """Decided at each solution, in its number field."""
    refuse_colours(asked, "l-stable")
    return Meaning(stable=("l-stable",))


WANT = Want("l-stable", "flag", "A-stable with R(∞) = 0", _meaning)
