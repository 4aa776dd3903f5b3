"""Five answers for one order of a family: every value, finitely many, a family, none, undecided."""

from __future__ import annotations

from typing import ClassVar, Literal, TypeAlias

from flint import fmpq_mpoly, fmpz_mpoly

from garkcli.design.ideal import Ideal
from garkcli.design.parts import Pieces
from garkcli.design.solutions import Solution
from garkcli.design.stable_values import StableValues
from garkcli.exact.field import Number
from garkcli.frozen import Frozen
from garkcli.ntrees.tree import Tree
from garkcli.order.certificate import Order
from garkcli.order.dense import DenseOrder
from garkcli.order.predictor import PredictorOrders

Kind: TypeAlias = Literal["every-value", "solutions", "family", "none", "undecided"]


class Found(Frozen):
    """A solution with its orders by the certificate.

    Attributes:
        solution: the values of the parameters, with their conjugates over ℚ.
        order: the exact order; None if a zero weight or denominator leaves no method.
        accepted: indices of real roots within the ranges of the file and with the wanted stability.
        unstable: indices of roots that lack only the stability.
        open: indices of those whose stability is undecided, as their field is too large.
        embedded: the order of the embedded weights, and Σ ê(u)² over the trees of the next order.
        dense: the order of the dense output.
        predictor: the orders of the predictor.
    """

    solution: Solution
    order: Order | None
    accepted: tuple[int, ...]
    unstable: tuple[int, ...] = ()
    open: tuple[int, ...] = ()
    embedded: tuple[Order, Number] | None = None
    dense: DenseOrder | None = None
    predictor: PredictorOrders | None = None


class Zeros(Frozen):
    """The zeros of an ideal. ``polynomials`` vanish there; together with those that the report has
    already, nowhere else.
    """

    ideal: Ideal
    polynomials: tuple[fmpq_mpoly | fmpz_mpoly, ...]


class Knowledge(Frozen):
    """Knowledge of the real values of a family.

    Attributes:
        is_real: whether a real value is a method of the file; None if undecided.
        within: zeros that contain all real values, if those satisfy further equations.
        found: the real ones, if finitely many.
        stable: for each wanted kind of stability the values of the one unknown on which it depends.
        of_stable: zeros whose real ones are the P-stable transfers of a pair, if decided.
    """

    is_real: bool | None = None
    within: Zeros | None = None
    found: tuple[Found, ...] = ()
    stable: tuple[StableValues, ...] = ()
    of_stable: Zeros | None = None


class Step(Frozen):
    """The answer for one order: the values that reach it.

    Attributes:
        order: the order.
        ideal: the ideal of its conditions and all lower ones, or its zeros in parts; None if
            neither was found. Unproved ones are by msolve: others may have the order too.
        kind: the kind of the answer.
    """

    order: int
    ideal: Ideal | Pieces | None
    kind: ClassVar[Kind]

    @property
    def has_methods(self) -> bool | None:
        return None

    @property
    def may_have_methods(self) -> bool:
        """Whether a higher order may be examined for these values."""
        return self.kind != "undecided" and self.has_methods is not False

    @property
    def found(self) -> tuple[Found, ...]:
        """The solutions if there are finitely many; the known real ones of a family."""
        return ()

    @property
    def known(self) -> Knowledge:
        """Knowledge of the real values of a family; empty for other answers."""
        return Knowledge()

    @property
    def is_all(self) -> bool:
        """Whether provably no others have the order; by a criterion for reals, no other reals."""
        return self.ideal is not None and self.ideal.is_proved

    def __repr__(self) -> str:
        return f"<Step order {self.order}: {self.kind}>"


class Undecided(Step):
    """The order is undecided.

    Attributes:
        is_late: whether the time limit had passed.
    """

    kind = "undecided"
    is_late: bool = True


class Decided(Step):
    """The zeros of an ideal have the order.

    Attributes:
        polynomials: vanish at these values and, except at zeros of ``nonzero``, nowhere else.
        nonzero: polynomials that vanish at no method, except where ``polynomials`` imply it.
    """

    ideal: Ideal | Pieces
    polynomials: tuple[fmpq_mpoly | fmpz_mpoly, ...] = ()
    nonzero: tuple[fmpq_mpoly, ...] = ()


class NoValue(Decided):
    """No value has the order.

    Attributes:
        witness: the first tree whose condition contradicts those before it; None if other wants do.
    """

    kind = "none"
    witness: Tree | None = None

    @property
    def has_methods(self) -> bool:
        return False


class Solutions(Decided):
    """Finitely many values have the order.

    Attributes:
        found: these values.
    """

    kind = "solutions"
    found: tuple[Found, ...] = ()

    @property
    def has_methods(self) -> bool | None:
        if any(x.accepted and x.order is not None for x in self.found):
            return True
        return None if any(x.open for x in self.found) or not self.is_all else False


class Many(Decided):
    """Infinitely many values have the order, complex ones included: all, or a family.

    Attributes:
        known: knowledge of the real values.
    """

    known: Knowledge = Knowledge()

    @property
    def has_methods(self) -> bool | None:
        return self.known.is_real

    @property
    def found(self) -> tuple[Found, ...]:
        return self.known.found


class AllValues(Many):
    """All values have the order."""

    kind = "every-value"


class Variety(Many):
    """The values with the order are a family themselves."""

    kind = "family"
