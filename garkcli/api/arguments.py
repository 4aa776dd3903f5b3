"""Functions of tableaus as functions of methods: a loaded method stands for its tableau, and its
tolerance is that of the function. Functions of exact numbers as functions of numbers of any kind.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import wraps
from inspect import signature
from typing import Any, Concatenate, ParamSpec, TypeAlias, TypeVar, cast

from flint import fmpq

from garkcli.errors import MethodError
from garkcli.exact.given import EXACTLY, number_text, rational_of
from garkcli.tableau.forms import gark
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.method import Method
from garkcli.tableau.tableau import Tableau

P = ParamSpec("P")
R = TypeVar("R")
AnyMethod: TypeAlias = Tableau | GarkMethod | Method
"""Whatever has an order: a tableau, a loaded method, or a diagonal method."""


def tableau_of(method: AnyMethod) -> Tableau:
    """The tableau of a method.

    Raises:
        MethodError: it is none.
    """
    if isinstance(method, Tableau):
        return method
    if isinstance(method, GarkMethod):
        return method.tableau
    if isinstance(method, Method):
        return gark([method], {})
    raise MethodError(
        f"a method is expected, not {type(method).__name__}",
        "load a file with load(path), or make one with from_arrays(A, b)",
    )


def tolerance_of(method: AnyMethod, given: object = None) -> fmpq | None:
    """The tolerance that was given, or else that of the method's file.

    Raises:
        MethodError: what was given is no number between 0 and 1.
    """
    if given is None:
        return method.tolerance if isinstance(method, GarkMethod) else None
    value = rational_of(given, "tolerance", is_rounded=True)
    if not 0 <= value < 1:
        raise MethodError(
            "a tolerance lies between 0 and 1", "for instance '1e-13'"
        )
    return value or None


def of_methods(
    function: Callable[Concatenate[Tableau, P], R],
) -> Callable[Concatenate[AnyMethod, P], R]:
    """A function whose first argument is a tableau, for anything that has one.

    Where the function has a ``tolerance`` that is not given, it is that of the method.
    """
    parameters = signature(function).parameters
    first = next(iter(parameters))
    default = (
        parameters["tolerance"].default if "tolerance" in parameters else None
    )

    @wraps(function)
    def wrapped(*arguments: Any, **named: Any) -> R:
        if arguments:
            method, rest = arguments[0], arguments[1:]
        elif first in named:
            method, rest = named.pop(first), ()
        else:
            return cast("Callable[..., R]", function)(**named)
        position = (
            list(parameters).index("tolerance")
            if "tolerance" in parameters
            else -1
        )
        is_given = "tolerance" in named or (0 < position < len(arguments))
        own = tolerance_of(method)
        if position > 0 and not is_given and own is not None:
            named["tolerance"] = (
                float(own.p) / float(own.q)
                if isinstance(default, float)
                else own
            )
        return cast("Callable[..., R]", function)(
            tableau_of(method), *rest, **named
        )

    return cast("Callable[Concatenate[AnyMethod, P], R]", wrapped)


def of_numbers(function: Callable[P, R]) -> Callable[P, R]:
    """A function of exact numbers, for numbers of every kind.

    What is converted says its annotation: ``fmpq`` where a rational number is taken, a sequence of
    them, or a mapping of texts that are coefficients.
    """
    shape = signature(function)
    makers = {
        name: _MAKERS[str(parameter.annotation)]
        for name, parameter in shape.parameters.items()
        if str(parameter.annotation) in _MAKERS
    }
    if not makers:
        return function

    @wraps(function)
    def wrapped(*arguments: P.args, **named: P.kwargs) -> R:
        try:
            bound = shape.bind(*arguments, **named)
        except TypeError:
            return function(*arguments, **named)  # says what is wrong
        for name, make in makers.items():
            given = bound.arguments.get(name)
            if given is not None:
                bound.arguments[name] = make(given, name)
        return function(*bound.args, **bound.kwargs)

    return wrapped


def _rational(given: Any, where: str) -> fmpq:
    return rational_of(given, where, is_rounded=where == "tolerance")


def _rationals(given: Any, where: str) -> list[fmpq]:
    return [rational_of(x, f"{where}[{i}]") for i, x in enumerate(given)]


def _texts(given: Mapping[str, Any], where: str) -> dict[str, str]:
    return {
        name: number_text(x, f"{where}[{name!r}]", False, EXACTLY)
        for name, x in given.items()
    }


_MAKERS: dict[str, Callable[[Any, str], Any]] = {
    "fmpq": _rational,
    "fmpq | None": _rational,
    "Sequence[fmpq] | None": _rationals,
    "Mapping[str, str]": _texts,
}
"""By its annotation how an argument is made of what is given."""
