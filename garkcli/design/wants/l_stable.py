"""L-stable methods."""

from garkcli.design.wants.want import Asked, Meaning, Want, stability


def _meaning(asked: Asked) -> Meaning:
    """Decided at each solution, in its number field."""
    return stability(asked, "l-stable")


WANT = Want("l-stable", "flag", "A-stable with R(∞) = 0", _meaning)
