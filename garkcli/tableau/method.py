"""A diagonal method (A, b, c): what stands on the diagonal of a GARK tableau."""

from __future__ import annotations

from dataclasses import dataclass

from garkcli.exact.matrix import Matrix, Vector, apply
from garkcli.tableau.point_space import PointSpace
from garkcli.tableau.stages import StageSpace


@dataclass(frozen=True)
class Method:
    """A Runge–Kutta method over a stage space with s stages.

    Attributes:
        name: for people.
        space: where its stage values live; its nodes are those that transfer rules interpolate at.
        A: a map of the space into itself, shape (s, s).
        b: the weights functional, length s.
    """

    name: str
    space: StageSpace
    A: Matrix
    b: Vector

    @property
    def stages(self) -> int:
        """The number of stages, s."""
        return self.space.stages

    @property
    def c(self) -> Vector:
        """The nodes, as an element of the stage space."""
        return self.space.nodes


def butcher(A: Matrix, b: Vector, c: Vector | None = None, name: str = "") -> Method:
    """The method with a spelled-out Butcher tableau; ``c`` defaults to the row sums of ``A``."""
    nodes = c
    if nodes is None:
        nodes = apply(A, PointSpace(b).one)
    return Method(name, PointSpace(nodes), A, b)
