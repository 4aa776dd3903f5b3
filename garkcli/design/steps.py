"""Five answers to the question for which values of its parameters a family has an order."""

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
    """A solution with what the ordinary certificate says of it.

    Attributes:
        solution: the values of the parameters, with their conjugates over ℚ.
        order: the exact order of the method that they make; None where a weight or a denominator is
            zero, and then there is no such method.
        accepted: which of the real roots of the solution are within the ranges of the file, and as
            stable as is wanted.
        unstable: which of them would be, but are not stable.
        open: which of them are not decided to be stable, as their field is too large.
        embedded: the order of the embedded weights, and Σ ê(u)² over the trees of the next order;
            None where there are none.
        dense: the order of the dense output; None where there is none.
        predictor: the orders of the predictor; None likewise.
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
    """Those of an ideal.

    Attributes:
        ideal: the ideal.
        polynomials: that are zero there and nowhere else, or as many of them as are not known.
    """

    ideal: Ideal
    polynomials: tuple[fmpq_mpoly | fmpz_mpoly, ...]


class Known(Frozen):
    """Knowledge of the real values of a family.

    Attributes:
        is_real: whether a real value is a method of the file; None where that is not decided.
        within: where real values satisfy more: the zeros among which they are.
        found: the real ones, where they are finitely many.
        stable: where stability is wanted and depends on one unknown: the values of that, for each
            kind.
        of_stable: where P-stability is wanted of all transfers of a pair and decided: the zeros
            whose real ones are the stable methods, by polynomials that others do not satisfy.
    """

    is_real: bool | None = None
    within: Zeros | None = None
    found: tuple[Found, ...] = ()
    stable: tuple[StableValues, ...] = ()
    of_stable: Zeros | None = None


class Step(Frozen):
    """An answer to the question for which values an order is reached.

    Attributes:
        order: the order.
        ideal: the ideal of its conditions and of all lower ones, or its zeros in parts where its
            basis is large; None where neither was found. Where it is not proved it is msolve's:
            each zero has the order, that there are no others is not proved.
        kind: for which values the order is reached.
    """

    order: int
    ideal: Ideal | Pieces | None
    kind: ClassVar[Kind]

    @property
    def has_methods(self) -> bool | None:
        """Whether methods of the file have the order; None where that is not decided."""
        return None

    @property
    def may_have_methods(self) -> bool:
        """Whether there may be values to go on with."""
        return self.kind != "undecided" and self.has_methods is not False

    @property
    def found(self) -> tuple[Found, ...]:
        """The solutions, where there are finitely many; of a family the real ones."""
        return ()

    @property
    def known(self) -> Known:
        """Knowledge of the real values of a family; none of other answers."""
        return Known()

    @property
    def is_all(self) -> bool:
        """Whether there are no other values, not even complex ones unless a criterion for real
        ones was taken: that is proved.
        """
        return self.ideal is not None and self.ideal.is_proved

    def __repr__(self) -> str:
        return f"<Step order {self.order}: {self.kind}>"


class Undecided(Step):
    """It was not worked out.

    Attributes:
        is_late: whether that ended with its time.
    """

    kind = "undecided"
    is_late: bool = True


class Decided(Step):
    """The zeros of an ideal have the order.

    Attributes:
        polynomials: that are zero at these values and, but for zeros of ``nonzero``, nowhere else.
        nonzero: polynomials of which none is zero at a method, as far as ``polynomials`` do not say
            it already.
    """

    ideal: Ideal | Pieces
    polynomials: tuple[fmpq_mpoly | fmpz_mpoly, ...] = ()
    nonzero: tuple[fmpq_mpoly, ...] = ()


class NoValue(Decided):
    """No value has the order.

    Attributes:
        witness: the first tree whose condition no value meets together with those before it; None
            where what is wanted besides the order cannot be met.
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
        known: knowledge of the real ones.
    """

    known: Known = Known()

    @property
    def has_methods(self) -> bool | None:
        return self.known.is_real

    @property
    def found(self) -> tuple[Found, ...]:
        return self.known.found


class EveryValue(Many):
    """All values have the order."""

    kind = "every-value"


class Variety(Many):
    """The values with the order are a family themselves."""

    kind = "family"
