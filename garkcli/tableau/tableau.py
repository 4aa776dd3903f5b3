"""The tableau: colours, the graph of who sees whom, the blocks on its edges; diagonal methods."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cached_property
from itertools import chain
from typing import Any, Literal, TypeAlias

from garkcli.errors import MethodError, ShapeMismatch, counted
from garkcli.exact.field import Algebraic, Number, NumberField
from garkcli.exact.matrix import Matrix, Vector, apply
from garkcli.exact.parametric import Parametric
from garkcli.frozen import Frozen, replace
from garkcli.ntrees.kind import FIELDS, LINEAR, PLAIN, VertexKind
from garkcli.ntrees.tree import Tree
from garkcli.tableau.stages import OF_OTHERS, Flow, Jets, PointSpace, StageSpace

Part: TypeAlias = Literal["y", "q", "p"]
"""The part of the unknowns that a colour's vector field drives: all, positions or momenta."""
Edge: TypeAlias = tuple[int, int]
"""Two colours (l, m), l seeing m; or (k, m), the stages of space k seeing colour m."""


class Colour(Frozen):
    """One vector field and the stages at which the method evaluates it.

    Attributes:
        name: for people, ``1`` or ``V1``.
        space: index of the stage space of its stages; colours may share one.
        b: its weights, a functional on that space.
        c: its nodes, an element of that space. They enter B, C, D and consistency only.
        term: the index of the term H^{l} or f^{l} of the split, from 0.
        late: the number of orders that a tree with such a root counts more than its own; None if
            the step has no such weights, so no conditions.
    """

    name: str
    space: int
    b: Vector
    c: Vector
    term: int = 0
    part: Part = "y"
    kind: VertexKind = PLAIN
    late: int | None = 0

    @property
    def is_linear(self) -> bool:
        return self.kind == LINEAR


class Tableau(Frozen):
    """A GARK tableau as a directed graph of colours.

    Colours and stage spaces are indices into ``colours`` and ``spaces``, from 0; those of
    ``GarkMethod.A`` count from 1.

    Attributes:
        spaces: the stage spaces.
        colours: the vector fields, in the order of the file.
        blocks: ``blocks[k, m]`` maps stage values of colour m to increments in space k, shape
            (stages of space k, stages of colour m). No entry: the stages of space k do not see
            colour m.

    Errors:
        ShapeMismatch: a block or a row of weights of the wrong size.

    >>> from garkcli import load
    >>> load("stoermer-verlet").tableau
    <Tableau 2 colours, stages 1, 2>
    """

    spaces: tuple[StageSpace, ...]
    colours: tuple[Colour, ...]
    blocks: Mapping[Edge, Matrix]

    def __post_init__(self) -> None:
        for number, colour in enumerate(self.colours, start=1):
            stages = self.spaces[colour.space].stages
            for letter, row in (("b", colour.b), ("c", colour.c)):
                if len(row) != stages:
                    name = f"{letter}^{{{number}}}"
                    given = counted(len(row), "entry", "entries")
                    due = counted(stages, "entry", "entries")
                    of_stages = counted(stages, "stage")
                    message = f"{name} has {given} for {of_stages}"
                    raise ShapeMismatch(message, f"give {due}")
        for (k, m), block in self.blocks.items():
            rows = self.spaces[k].stages
            columns = self.space(m).stages
            if len(block) == rows and {*map(len, block)} <= {columns}:
                continue
            seen = counted(columns, "stage")
            seeing = counted(rows, "stage")
            space = k + 1
            colour_seen = m + 1
            message = f"the block {space},{colour_seen} is not {rows} by {columns}"
            raise ShapeMismatch(message, f"it maps {seen} of colour {colour_seen} to {seeing}")

    def __hash__(self) -> int:
        return hash((self.spaces, self.colours))

    def __repr__(self) -> str:
        stages = ", ".join([str(self.space(l).stages) for l in range(self.size)])
        colours = counted(self.size, "colour")
        return f"<Tableau {colours}, stages {stages}>"

    @property
    def size(self) -> int:
        """N, the number of colours."""
        return len(self.colours)

    @property
    def roots(self) -> dict[int, int]:
        """The colours, from 0, whose trees have conditions, with their ``late``."""
        lates = ((l, colour.late) for l, colour in enumerate(self.colours))
        return {l: late for l, late in lates if late is not None}

    def space(self, colour: int) -> StageSpace:
        return self.spaces[self.colours[colour].space]

    def block(self, l: int, m: int) -> Matrix | None:
        """A^{l,m}, l and m from 0, or None if the stages of colour l do not see colour m."""
        return self.blocks.get((self.colours[l].space, m))

    def edges(self) -> Iterator[Edge]:
        """All (l, m), from 0, for which A^{l,m} exists."""
        for l in range(self.size):
            for m in range(self.size):
                if self.block(l, m) is not None:
                    yield l, m

    def __reduce__(self) -> tuple[Any, ...]:
        # where its numbers are from goes along; what it has computed is computed again
        kept = {key: x for key, x in self.__dict__.items() if not hasattr(Tableau, key)}
        return Tableau, (self.spaces, self.colours, self.blocks), kept or None

    def __setstate__(self, kept: dict[str, Any]) -> None:
        self.__dict__.update(kept)

    def tree(self, l: int, branches: Iterable[Tree] = ()) -> Tree:
        return Tree(l, branches, self.colours[l].kind)

    def known(self, tree: Tree) -> Tree:
        """A tree from any source, such as text, with the kinds of vertices of the colours."""
        if self.has_fields_alone:
            return tree
        return self.tree(tree.root, map(self.known, tree.branches))

    @cached_property
    def has_fields_alone(self) -> bool:
        """Whether every colour is a vector field that the stages evaluate, as in a GARK method."""
        return all(colour.kind in FIELDS for colour in self.colours)

    @cached_property
    def is_listed(self) -> bool:
        """Whether every vertex counts an order; other trees are not listed."""
        return all(colour.kind.weight for colour in self.colours)

    @cached_property
    def exact_to(self) -> int | None:
        """The order of trees up to which conditions are those of a method with exact solutions;
        None without stages that represent such solutions.
        """
        return min((x.order for x in self.spaces if isinstance(x, Flow)), default=None)

    @property
    def uses_derivatives(self) -> bool:
        """Whether the method uses derivatives of f along the solution."""
        return any(isinstance(x, Jets) for x in self.spaces)

    @property
    def is_gark(self) -> bool:
        """Whether all commands apply: its colours are fields, and no stage represents an exact
        solution.
        """
        return self.has_fields_alone and self.exact_to is None

    def demand_fields(self, what: str, *, with_flow: bool = False) -> None:
        """Raises MethodError for an operation that is defined for GARK methods only.

        ``what`` names it in messages; ``with_flow`` says that it is also defined if stages
        represent exact solutions.
        """
        flow = next((x for x in self.spaces if isinstance(x, Flow)), None)
        if flow is not None and not with_flow:
            message = f"{what} is for GARK methods: {flow.why}"
            raise MethodError(message, flow.cure, code="cannot-construct")
        if not self.has_fields_alone:
            message = f"{what} is for GARK methods, which this method is not"
            raise MethodError(message, OF_OTHERS, code="cannot-construct")

    @property
    def is_partitioned(self) -> bool:
        """Whether the colours drive positions or momenta, as in the symplectic pair."""
        return any(colour.part != "y" for colour in self.colours)

    @cached_property
    def field(self) -> NumberField | None:
        for row in self.rows:
            for x in row:
                if isinstance(x, Algebraic):
                    return x.field
        return None

    @cached_property
    def has_parameters(self) -> bool:
        """Whether a coefficient is a rational function of free parameters."""
        return any(isinstance(x, Parametric) for x in chain.from_iterable(self.rows))

    def changed(self, change: Callable[[Any], Any]) -> Tableau:
        """The tableau with ``change`` applied to every number; other than point stages stay."""

        def row(numbers: Vector) -> Vector:
            return tuple(map(change, numbers))

        spaces = [
            replace(space, points=row(space.points)) if isinstance(space, PointSpace) else space
            for space in self.spaces
        ]
        colours = tuple(replace(x, b=row(x.b), c=row(x.c)) for x in self.colours)
        blocks = {key: tuple(map(row, block)) for key, block in self.blocks.items()}
        return Tableau(tuple(spaces), colours, blocks)

    @property
    def rows(self) -> Iterator[Vector]:
        """All coefficients: weights, nodes, and the rows of blocks."""
        for colour in self.colours:
            yield colour.b
            yield colour.c
        for block in self.blocks.values():
            yield from block

    @property
    def entries(self) -> list[Number]:
        """The coefficients of weights and blocks."""
        rows = [colour.b for colour in self.colours]
        return list(chain(*rows, *chain.from_iterable(self.blocks.values())))

    @property
    def degree(self) -> int:
        """The dimension over ℚ of the domain of the coefficients."""
        return self.field.degree if self.field else 1


class Method(Frozen):
    """A Runge–Kutta method on a stage space, at whose nodes transfer rules interpolate. ``A`` has
    the shape (s, s); ``b`` is a functional of length s.
    """

    name: str
    space: StageSpace
    A: Matrix
    b: Vector

    @property
    def stages(self) -> int:
        return self.space.stages

    @property
    def c(self) -> Vector:
        return self.space.nodes


def butcher(A: Matrix, b: Vector, c: Vector | None = None, name: str = "") -> Method:
    """Returns the method of a Butcher tableau; ``c`` defaults to the row sums of ``A``."""
    nodes = c
    if nodes is None:
        nodes = apply(A, PointSpace(b).one)
    return Method(name, PointSpace(nodes), A, b)
