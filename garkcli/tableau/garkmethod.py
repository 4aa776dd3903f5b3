"""A tableau with its name and tolerance: the method of the Python interface."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from typing import TYPE_CHECKING, Any, Generic, Literal, TypeAlias, TypeVar

from flint import fmpq

from garkcli.errors import MethodError, counted
from garkcli.frozen import Frozen
from garkcli.tableau.embedded import DenseOutput, Further, Predictor, Weights
from garkcli.tableau.tableau import Tableau
from garkcli.upward import Shown, answered

if TYPE_CHECKING:
    import os

    from garkcli.tableau.pointwise import Entries


K = TypeVar("K", int, tuple[int, int])


class NoSuchColour(MethodError, KeyError):
    __str__ = MethodError.__str__


class ByColour(Mapping[K, Any], Generic[K]):
    """The parts of a method by colour, or by pair of colours; colours count from 1.

    >>> from garkcli.tableau.garkmethod import ByColour
    >>> rows = ByColour({1: (1,), 2: ("1/2", "1/2")})
    >>> rows[2], list(rows), rows.get(3)
    (('1/2', '1/2'), [1, 2], None)
    """

    __slots__ = ("_parts",)

    def __init__(self, parts: Mapping[K, Any]) -> None:
        self._parts: dict[K, Any] = dict(parts)

    def __getitem__(self, key: K) -> Any:
        """The part of a colour, or of a pair (l, m); raises NoSuchColour."""
        try:
            return self._parts[key]
        except (KeyError, TypeError):
            *_, last = self._parts
            what = "pair of colours" if isinstance(last, tuple) else "colour"
            message = f"{key!r} is not a {what} of the method"
            cure = f"they count from 1, the last is {last!r}"
            raise NoSuchColour(message, cure, code="arrays") from None

    def __iter__(self) -> Iterator[K]:
        return iter(self._parts)

    def __len__(self) -> int:
        return len(self._parts)

    def __hash__(self) -> int:
        return hash(tuple(self._parts.items()))

    def __repr__(self) -> str:
        return repr(self._parts)


Derivation: TypeAlias = Literal["", "conjugate", "pair"]
"""The construction of a method from its base; empty for a given method."""


def derived_name(derivation: str, name: str) -> str:
    """The name of the conjugate or pair.

    >>> derived_name("pair", "Heun 2(1)")
    'symplectic pair of Heun 2(1)'
    """
    return f"symplectic {derivation} of {name}" if name else ""


def derivation_of(method: GarkMethod | None) -> Derivation:
    return "" if method is None else method.derivation


def word_for(method: GarkMethod | None) -> str:
    return derivation_of(method) or "method"


class GarkMethod(Shown, Frozen, kw_only=True):
    """A GARK method of one colour or several, with its printed entries.

    Entries are exact numbers, ``flint.fmpq`` or elements of a number field, whose ``str`` is the
    text of a method file; if the nodes have no simple radicals they are enclosures, ``flint.arb``.

    Attributes:
        tableau: the tableau of its order conditions.
        name: its name for people.
        tolerance: the largest rounding of A, b and c; None if they are exact.
        derivation: whether it was made as the conjugate or the pair of ``base``.
        base: the method it was made from.
        embedded: embedded weights of each colour, exact numbers; None if there are none, as for a
            conjugate and a pair.
        dense: dense output, or None.
        predictor: weights that predict stages, or None.
        embedded_tolerance: the rounding of the embedded weights.
        dense_tolerance: the rounding of dense output.

    >>> from garkcli import load
    >>> method = load("rk4")
    >>> method.A[3], method.b, method.order, method.conjugate.order
    ((0, 0, 1, 0), (1/6, 1/3, 1/3, 1/6), 4, 4)
    """

    tableau: Tableau
    name: str = ""
    tolerance: fmpq | None = None
    derivation: Derivation = ""
    base: GarkMethod | None = None
    embedded: Weights | None = None
    dense: DenseOutput | None = None
    embedded_tolerance: fmpq | None = None
    dense_tolerance: fmpq | None = None
    predictor: Predictor | None = None

    @cached_property
    def entries(self) -> Entries:
        """All entries together, with those of embedded weights and dense output."""
        from garkcli.tableau import pointwise  # loaded when entries are requested

        return pointwise.entries(self.tableau).beside(self.further)

    @property
    def A(self) -> Any:  # noqa: N802 -- the name it has everywhere
        """The matrix, row by row, shape (s, s). With several colours ``A[l, m]`` is a block, shape
        (s_l, s_m), or None if colour l does not see colour m; colours count from 1.
        """
        blocks = self.entries.A
        if self.tableau.size == 1:
            return blocks[0][0]
        numbered = enumerate(blocks, start=1)
        return ByColour(
            {(l, m): block for l, row in numbered for m, block in enumerate(row, start=1)}
        )

    @property
    def b(self) -> Any:
        """The weights, length s; with several colours ``b[l]`` has length s_l, colours from 1."""
        return self._by_colour(self.entries.b)

    @property
    def c(self) -> Any:
        """The nodes, length s; with several colours ``c[l]`` has length s_l, colours from 1."""
        return self._by_colour(self.entries.c)

    @property
    def order(self) -> int:
        """The order, exactly or within the tolerance of the method, as by ``find_order``; or a
        lower bound.
        """
        order: int = answered(self, "order").order
        return order

    @property
    def orders(self) -> dict[str, int | str]:
        """The orders of the method, its embedded weights, its conjugate and its pair, as by
        ``find_orders``.
        """
        orders: dict[str, int | str] = answered(self, "orders")
        return orders

    @property
    def conjugate(self) -> GarkMethod:
        """The symplectic conjugate, with the tolerance of the method.

        Raises:
            ZeroWeight: a conjugate would divide by zero.
        """
        made: GarkMethod = answered(self, "conjugate")
        return made

    @property
    def pair(self) -> GarkMethod:
        """The symplectic pair (Q, P) of the method and its conjugate: colours V¹…Vᴺ, F¹…Fᴺ.

        Raises:
            ZeroWeight: a conjugate would divide by zero.
        """
        made: GarkMethod = answered(self, "pair")
        return made

    @property
    def is_symplectic(self) -> bool:
        """Whether the method is its own conjugate, or if partitioned, its parts are each other's;
        within its tolerance if it has one.
        """
        is_so: bool = answered(self, "symplectic")
        return is_so

    def check(self) -> Any:
        """The results of ``gark check``, as by ``analyse``."""
        return answered(self, "check")

    def stability(self) -> Any:
        """The results of ``gark stability``, as by ``find_stability``."""
        return answered(self, "stability")

    def converge(self, problem: Any = None) -> Any:
        """A convergence test, by default on a generic problem, as by ``converge``."""
        return answered(self, "converge", problem=problem)

    def plot(self, path: str | os.PathLike[str] | None = None) -> Any:
        """The stability region as a figure of matplotlib, saved at ``path`` if it is given;
        ``plot`` draws other results.
        """
        return answered(self, "plot", path=path)

    def to_latex(self) -> str:
        """The tableau in LaTeX, as ``gark tableau --format latex`` prints it."""
        text: str = answered(self, "to_latex")
        return text

    @property
    def further(self) -> Further:
        return Further(self.embedded, self.dense, self.predictor)

    def _by_colour(self, rows: Sequence[Any]) -> Any:
        if self.tableau.size == 1:
            return rows[0]
        return ByColour(dict(enumerate(rows, start=1)))

    @property
    def stages(self) -> tuple[int, ...]:
        """The number of stages s_l of each colour."""
        return tuple(self.tableau.space(l).stages for l in range(self.tableau.size))

    def __repr__(self) -> str:
        name = f"{self.name}: " if self.name else ""
        colours = counted(self.tableau.size, "colour")
        stages = ", ".join(map(str, self.stages))
        return f"<{type(self).__name__} {name}{colours}, stages {stages}>"
