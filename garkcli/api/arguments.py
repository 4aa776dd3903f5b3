"""Functions of tableaus as functions of methods: a loaded method stands for its tableau, and its
tolerance is that of the function.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from inspect import signature
from typing import Any, Concatenate, ParamSpec, TypeAlias, TypeVar, cast

from flint import fmpq

from garkcli.errors import MethodError
from garkcli.exact.expression import read_decimal
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
    value: Any = given
    if isinstance(given, (str, float)):
        value = read_decimal(str(given).lower())
    value = fmpq(value)
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
