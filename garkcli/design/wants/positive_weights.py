"""Positive weights."""

from garkcli.design.wants.want import Asked, Meaning, Want


def _meaning(asked: Asked) -> Meaning:
    weights = [x for l in asked.colours for x in asked.tableau.colours[l].b]
    return Meaning(positive=tuple(weights))


WANT = Want("positive-weights", "flag", "every weight is positive", _meaning)
