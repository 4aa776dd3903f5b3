"""A method as its properties are decided: what several of them need is found once."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.deadline import SECONDS, check_time, processor_time, spending
from garkcli.doing import doing
from garkcli.errors import NotDecided
from garkcli.exact.field import ONE, ZERO
from garkcli.frozen import Frozen
from garkcli.order.simplifying import Defects, RoundedDefects, Simplifying
from garkcli.properties.pattern import Shape, StageGraph, shape_of, stage_graph
from garkcli.properties.reduction import at_points, reduced
from garkcli.properties.registry import find
from garkcli.properties.symmetry import Symmetry, symmetry
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.order.meant import AnyTableau
    from garkcli.properties.property import Verdict
    from garkcli.stability.linear import StabilityFunction
    from garkcli.stability.within import StabilityWithin

MISSING_BLOCKS = Reason("some stages do not see every vector field")
"""Why what is about all vector fields together has no meaning where blocks are missing."""


MAY_HOLD = "the method that the file is taken to mean has it not, another within t may"
"""Why what the digits do not exclude is not refuted."""


class Subject(Frozen):
    """A method with what is known of it.

    Attributes:
        tableau: the method.
        order: its order, or a lower bound of that.
        simplifying: its B, C and D.
        limit: where the search for these stopped.
        tolerance: smaller numbers count as zero, as the method is known so well; 0 where it is
            exact.
        further: its embedded weights and its dense output.
        rounding: by how much the printed coefficients may be off.
        printed: the method as it is printed, where it is rounded, with what its coefficients are
            off at most for ``tolerance``.
    """

    tableau: Tableau
    order: int
    simplifying: Simplifying
    limit: int
    tolerance: fmpq = ZERO
    further: Further = NOTHING
    rounding: fmpq = ZERO
    printed: Subject | None = None

    @staticmethod
    def read(
        method: AnyTableau, order: int, simplifying: Simplifying, limit: int, further: Further
    ) -> Subject:
        """The subject of a method; of a rounded one the method that it is taken to be."""
        if isinstance(method, Tableau):
            return Subject(method, order, simplifying, limit, ZERO, further)
        grain, t = method.grain, method.tolerance
        widest = method.widest
        wide = None
        if widest is not None:
            wide = Subject(method.tableau, order, simplifying, limit, widest, further)
        return Subject(method.near, order, simplifying, limit, grain, method.further, t, wide)

    @cached_property
    def defects(self) -> Defects:
        """By how much it misses conditions."""
        return (
            RoundedDefects(self.tableau, self.tolerance)
            if self.tolerance
            else Defects(self.tableau)
        )

    def verdict(self, key: str) -> Verdict:
        """What is true of a property; each is decided once, or is not in the time for all."""
        if key not in self._verdicts:
            with doing(key.replace("-", " ")):
                self._verdicts[key] = self._decided(key)
        return self._verdicts[key]

    def _decided(self, key: str) -> Verdict:
        from garkcli.properties.property import Verdict

        before = processor_time()
        try:
            with spending(SECONDS - sum(self._spent)):
                found = find(key).decide(self)
                if found.value is False and self.rounding and not self._excludes(key):
                    return Verdict.undecided(MAY_HOLD)
                return found
        except NotDecided as error:
            if not error.is_late:
                raise
            check_time()  # the time around all of it may be over
            return Verdict.undecided(f"it takes longer than {SECONDS:.0f} s of processor time")
        finally:
            self._spent.append(processor_time() - before)

    def _excludes(self, key: str) -> bool:
        """Whether no method within the rounding has a property."""
        return self.printed is not None and find(key).decide(self.printed).value is False

    @cached_property
    def _spent(self) -> list[float]:
        """The processor time that properties took so far."""
        return []

    @cached_property
    def _verdicts(self) -> dict[str, Verdict]:
        return {}

    @cached_property
    def is_complete(self) -> bool:
        """Whether every stage sees every vector field."""
        colours, spaces = (range(self.tableau.size), range(len(self.tableau.spaces)))
        return all((k, m) in self.tableau.blocks for k in spaces for m in colours)

    @cached_property
    def graph(self) -> StageGraph:
        """Which stage values depend on which."""
        return stage_graph(self.points or self.tableau, None, self.tolerance)

    @cached_property
    def shape(self) -> Shape:
        """The shape of the whole method."""
        return self._of_families(range(self.tableau.size)) or shape_of(self.graph, self.tolerance)

    def _of_families(self, colours: Sequence[int]) -> Shape | None:
        """The shape of some colours where no node is needed for it."""
        if self.tolerance or any(isinstance(x, PointSpace) for x in self.tableau.spaces):
            return None
        from garkcli.properties.algebra_shape import shape_of_families

        return shape_of_families(self.tableau, colours)

    @cached_property
    def shapes(self) -> tuple[Shape | None, ...]:
        """The shapes of the diagonal methods, one per colour; None where a colour does not see
        itself.
        """
        if self.tableau.size == 1:
            return (self.shape,)
        found: list[Shape | None] = []
        for l in range(self.tableau.size):
            if self.tableau.block(l, l) is None:
                found.append(None)
                continue
            found.append(self._of_families([l]) or self._of_points(l))
        return tuple(found)

    def _of_points(self, l: int) -> Shape:
        """The shape of a colour by its entries."""
        graph = stage_graph(self.points or self.tableau, [l], self.tolerance)
        return shape_of(graph, self.tolerance)

    @cached_property
    def points(self) -> Tableau | None:
        """The method with one coordinate a stage; None where nodes have no simple radicals."""
        return at_points(self.tableau)

    @cached_property
    def reduced(self) -> Tableau | None:
        """The smallest method of the same step; None where nodes have no simple radicals."""
        return reduced(self.tableau, self.tolerance)

    @cached_property
    def symmetry(self) -> Symmetry:
        """Whether it is its own adjoint."""
        return symmetry(self.tableau, self.tolerance)

    @property
    def is_linear(self) -> bool:
        """Whether there is an R(z) with all vector fields equal: no block is missing."""
        return self.is_complete and not self.tableau.is_partitioned

    @cached_property
    def linear(self) -> StabilityFunction:
        """R(z) with all vector fields equal."""
        from garkcli.stability.linear import stability_function

        return stability_function(self.tableau)

    @cached_property
    def intervals(self) -> StabilityWithin:
        """What is known of the intervals of a method known to many bits."""
        from garkcli.stability.within import stability_within

        shares = [ONE] * self.tableau.size
        return stability_within(self.tableau, shares, self.tolerance)

    @cached_property
    def linear_within(self) -> tuple[bool | None, bool | None]:
        """Whether a method known to many bits is A-stable, L-stable; None: not decided."""
        from garkcli.stability.within import stiff_stability_within

        shares = [ONE] * self.tableau.size
        return stiff_stability_within(self.tableau, shares, self.tolerance)
