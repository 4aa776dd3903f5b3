"""A-stable methods."""

from garkcli.design.wants.want import Asked, Meaning, Want, stability


def _meaning(asked: Asked) -> Meaning:
    """Decided at each solution, in its number field."""
    return stability(asked, "a-stable")


WANT = Want("a-stable", "flag", "|R(z)| ≤ 1 in the left half plane", _meaning)
