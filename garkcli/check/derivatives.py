"""The analysis of a method that uses derivatives of f."""

from __future__ import annotations

from functools import cached_property

from garkcli.check.order_facts import LinearSubject, OrderFacts
from garkcli.constructions.same_stability import with_same_function
from garkcli.order.meant import meant
from garkcli.properties.registry import OF_TEST_EQUATION
from garkcli.reason import Reason


class DerivativesAnalysis(OrderFacts):
    """The orders of a multiderivative method.

    Its tableau has stages along the exact solutions whose derivatives it uses.
    """

    kind = "a multiderivative method"
    no_property = Reason("a property of Runge–Kutta methods, and derivatives of f are used")

    @cached_property
    def subject(self) -> LinearSubject:
        """The method whose properties are decided: all of them follow from R(z)."""
        method = with_same_function(meant(self.tableau, self.tolerance))
        assert method is not None
        order = self.order.order
        return LinearSubject.of(method, order, self.limit, OF_TEST_EQUATION, self.no_property)
