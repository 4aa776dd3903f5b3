"""Properties: definitions, and decisions for a method."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache, cached_property
from importlib import import_module
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.deadline import SECONDS, check_time, processor_time, spending
from garkcli.doing import doing
from garkcli.errors import NotDecided
from garkcli.exact.field import ONE, ZERO
from garkcli.frozen import Frozen
from garkcli.order.defects import Defects, RoundedDefects
from garkcli.order.simplifying import Simplifying
from garkcli.properties.pattern import Shape, StageGraph, shape_of, stage_graph
from garkcli.properties.reduction import at_points, reduced
from garkcli.properties.registry import KEYS
from garkcli.properties.symmetry import Symmetry, symmetry
from garkcli.properties.verdict import Asks, Kind, Verdict
from garkcli.reason import Reason
from garkcli.tableau.embedded import NOTHING, Further
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.order.meant import AnyTableau
    from garkcli.stability.linear import StabilityFunction
    from garkcli.stability.within import StabilityWithin

MISSING_BLOCKS = Reason("some stages do not depend on every vector field")


MAY_HOLD = "the method that the file is taken to mean has it not, another within t may"


class Subject(Frozen):
    """A method with known results; its ``order`` may be a lower bound.

    Smaller numbers than ``tolerance`` count as zero. Of a rounded method it is the one that is
    meant, and ``printed`` the printed one, with the largest error of a coefficient as tolerance;
    ``rounding`` is that of the file.
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
        """The subject of a method; if it is rounded, of the method that it is taken to mean."""
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
        return (
            RoundedDefects(self.tableau, self.tolerance)
            if self.tolerance
            else Defects(self.tableau)
        )

    def verdict(self, key: str) -> Verdict:
        """The verdict on a property, decided once; undecided if the time is over."""
        if key not in self._verdicts:
            with doing(key.replace("-", " ")):
                self._verdicts[key] = self._decided(key)
        return self._verdicts[key]

    def _decided(self, key: str) -> Verdict:
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
        return self.printed is not None and find(key).decide(self.printed).value is False

    @cached_property
    def _spent(self) -> list[float]:
        return []

    @cached_property
    def _verdicts(self) -> dict[str, Verdict]:
        return {}

    @cached_property
    def is_complete(self) -> bool:
        colours, spaces = (range(self.tableau.size), range(len(self.tableau.spaces)))
        return all((k, m) in self.tableau.blocks for k in spaces for m in colours)

    @cached_property
    def graph(self) -> StageGraph:
        return stage_graph(self.points or self.tableau, None, self.tolerance)

    @cached_property
    def shape(self) -> Shape:
        return self._of_families(range(self.tableau.size)) or shape_of(self.graph, self.tolerance)

    def _of_families(self, colours: Sequence[int]) -> Shape | None:
        if self.tolerance or any(isinstance(x, PointSpace) for x in self.tableau.spaces):
            return None
        from garkcli.properties.algebra_shape import shape_of_families

        return shape_of_families(self.tableau, colours)

    @cached_property
    def shapes(self) -> tuple[Shape | None, ...]:
        """The shapes of the diagonal methods; None if a colour does not see itself."""
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
        graph = stage_graph(self.points or self.tableau, [l], self.tolerance)
        return shape_of(graph, self.tolerance)

    @cached_property
    def points(self) -> Tableau | None:
        return at_points(self.tableau)

    @cached_property
    def reduced(self) -> Tableau | None:
        return reduced(self.tableau, self.tolerance)

    @cached_property
    def symmetry(self) -> Symmetry:
        return symmetry(self.tableau, self.tolerance)

    @property
    def is_linear(self) -> bool:
        """Whether R(z) with all vector fields equal is defined: no block is missing."""
        return self.is_complete and not self.tableau.is_partitioned

    @cached_property
    def linear(self) -> StabilityFunction:
        from garkcli.stability.linear import stability_function

        return stability_function(self.tableau)

    @cached_property
    def intervals(self) -> StabilityWithin:
        from garkcli.stability.within import stability_within

        shares = [ONE] * self.tableau.size
        return stability_within(self.tableau, shares, self.tolerance)

    @cached_property
    def linear_within(self) -> tuple[bool | None, bool | None]:
        """Whether a rounded method is A-stable and L-stable; None: undecided."""
        from garkcli.stability.within import stiff_stability_within

        shares = [ONE] * self.tableau.size
        return stiff_stability_within(self.tableau, shares, self.tolerance)


class Property(Frozen):
    """A property that a method file may claim.

    Attributes:
        meaning: the methods for which it is defined; empty for all.
        is_cheap: whether every ``gark check`` decides it; others only if claimed or requested.
        noted: the value that every ``gark check`` says in words, and these.
    """

    key: str
    text: str
    source: str
    kind: Kind
    decide: Callable[[Subject], Verdict]
    asks: Asks
    meaning: str = ""
    is_cheap: bool = True
    noted: tuple[bool, str] | None = None

    @property
    def field(self) -> str:
        return self.key.replace("-", "_")


SEES_ALL = "methods whose stages all see all vector fields"


def claimed(
    source: str,
    *,
    asks: Asks,
    kind: Kind = "truth",
    meaning: str = "",
    is_cheap: bool = True,
    noted: tuple[bool, str] | None = None,
) -> Callable[[Callable[[Subject], Verdict]], Property]:
    """Makes a property from the function that decides it; its docstring is the definition."""

    def made(decide: Callable[[Subject], Verdict]) -> Property:
        key, text = decide.__name__.replace("_", "-"), " ".join((decide.__doc__ or "").split())
        return Property(key, text, source, kind, decide, asks, meaning, is_cheap, noted)

    return made


@cache
def find(key: str) -> Property:
    found = getattr(import_module(f"garkcli.properties.claimed.{KEYS[key]}"), key.replace("-", "_"))
    assert isinstance(found, Property)
    return found


def every_property() -> list[Property]:
    return [find(key) for key in KEYS]
