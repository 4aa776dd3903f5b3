"""Methods whose last stage is the new value."""

from garkcli.design.wants.want import Asked, Meaning, Want


def _meaning(asked: Asked) -> Meaning:
    """The last row of A^{l,l} is b^l."""
    zeros = []
    for l in asked.colours:
        A, b = asked.diagonal(l, "stiffly-accurate")
        zeros += [x - y for x, y in zip(A[-1], b, strict=True)]
    return Meaning(tuple(zeros))


WANT = Want("stiffly-accurate", "flag", "the last row of A is b", _meaning)
