"""Methods made from diagonal methods by the rules of the paper."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from garkcli.api.anymethod import AnyMethod, method_of
from garkcli.api.arrays import from_arrays
from garkcli.api.numbers import Whole, whole
from garkcli.conversion.sheet import in_one_field, sheet_of
from garkcli.errors import MethodError, did_you_mean
from garkcli.families import registry
from garkcli.order.meant import as_meant
from garkcli.tableau import forms
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Method
from garkcli.transfer import RULES, legendre_rule

Blocks: TypeAlias = "Mapping[tuple[int, int], Any]"
"""Matrices by pairs (l, m) of colours, counted from 1."""


def diagonal_method(name: str, stages: Whole | None = None) -> GarkMethod:
    """The member of a family, with its entries as printed.

    Args:
        name: the name of the family, as in ``gark list families``.
        stages: may be left out for a family of one method.

    Raises:
        UnknownFamily: there is no such family, or no member with that many stages.

    >>> diagonal_method("lobatto-iiia", 2).A
    ((0, 0), (1/2, 1/2))
    """
    many = None if stages is None else whole(stages, "stages")
    return method_of(registry.diagonal_method(name, many))


def gark(
    methods: Sequence[AnyMethod | Method],
    transfer: str | Blocks = "collocation",
    degree: Whole | None = None,
) -> GarkMethod:
    """The method with diagonal ``methods`` and the blocks between them, eq. (GARK).

    Args:
        methods: methods of one colour each, whatever ``method_of`` takes.
        transfer: a rule, as in ``gark list transfer``; or blocks of shape (s_l, s_m) by pairs (l,
            m) of colours counted from 1. A block that is left out is absent.
        degree: the degree of the rule ``legendre``; by default it is chosen.

    Raises:
        MethodError: the rule, its degree, a block or the number of colours of a method is wrong.

    >>> gark(["gauss-2", "lobatto-iiia-3"])
    <GarkMethod 2 colours, stages 2, 3>
    >>> gark([([["1/2"]], [1]), ([[0]], [1])], {(1, 2): [[1]]}).A
    {(1, 1): ((1/2,),), (1, 2): ((1,),), (2, 1): None, (2, 2): ((0,),)}
    """
    if isinstance(methods, str) or not methods:
        message = "gark takes a list of methods"
        raise MethodError(message, "give one per colour: ['gauss-2', …]", code="arrays")
    given = [method_of(method) for method in methods]
    diagonal = _diagonal_methods(given)
    if not isinstance(transfer, str):
        return _with_blocks(given, transfer)
    if transfer not in RULES:
        message = f"no transfer rule {transfer!r}"
        raise MethodError(message, did_you_mean(transfer, RULES), code="unknown-word")
    if degree is not None and transfer != "legendre":
        message = f"{transfer} has no degree"
        raise MethodError(message, "leave it out, or take legendre", code="not-together")
    rule = RULES[transfer]
    if transfer == "legendre":
        K = None if degree is None else whole(degree, "degree")
        rule = legendre_rule([as_meant(method) for method in given], K)
    numbered = list(enumerate(diagonal))
    blocks = {(l, m): rule(here, other) for l, here in numbered for m, other in numbered if l != m}
    return method_of(forms.gark(diagonal, blocks))


def _with_blocks(methods: Sequence[GarkMethod], blocks: Blocks) -> GarkMethod:
    size = range(1, len(methods) + 1)
    for key in blocks:
        if key not in {(l, m) for l in size for m in size if l != m}:
            message = f"transfer: {key!r} is not a block between two of the methods"
            cure = f"give pairs of different colours from 1 to {len(methods)}"
            raise MethodError(message, cure, code="wrong-value")
    A = {**blocks}
    for l, method in enumerate(methods, start=1):
        A[l, l] = method.A
    return from_arrays(A, [method.b for method in methods], [method.c for method in methods])


def _diagonal_methods(methods: Sequence[GarkMethod]) -> list[Method]:
    """Returns the colour of each method with numbers from one field; CannotConvert without one."""
    tableaus = [method.tableau for method in methods]
    if len({id(x.field) for x in tableaus if x.field is not None}) > 1:
        tableaus = [sheet.tableau for sheet in in_one_field([*map(sheet_of, methods)])]
    return [
        forms.one_field(tableau, f"{method!r} is not a diagonal method", method.name)
        for method, tableau in zip(methods, tableaus, strict=True)
    ]
