"""Nodes between 0 and 1."""

from garkcli.design.wants.want import Asked, Meaning, Want


def _meaning(asked: Asked) -> Meaning:
    nodes = [x for l in asked.colours for x in asked.tableau.colours[l].c]
    return Meaning(not_negative=(*nodes, *(1 - x for x in nodes)))


WANT = Want("nodes-in-unit-interval", "flag", "every node is in [0, 1]", _meaning)
