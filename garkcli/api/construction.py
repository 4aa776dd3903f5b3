"""Methods put together from diagonal methods by the paper's rules."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from garkcli.api.methods import method_of
from garkcli.errors import MethodError, did_you_mean
from garkcli.exact.matrix import Matrix
from garkcli.families import registry
from garkcli.tableau import forms
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.method import Method
from garkcli.tableau.tableau import Edge, Tableau
from garkcli.transfer import RULES


def diagonal_method(name: str, stages: int | None = None) -> GarkMethod:
    """The member of a family, with its entries as they are printed.

    Args:
        name: as ``gark list families`` shows it.
        stages: how many; may be left out for a family of one method.

    Raises:
        UnknownFamily: no such family, or not with that many stages.

    >>> diagonal_method("lobatto-iiia", 2).A
    ((0, 0), (1/2, 1/2))
    """
    return method_of(registry.diagonal_method(name, stages))


def gark(
    methods: Sequence[GarkMethod | Method],
    transfer: str | Mapping[Edge, Matrix] = "collocation",
) -> Tableau:
    """The tableau with diagonal ``methods`` and the blocks between them, eq. (GARK).

    Args:
        methods: of one colour each.
        transfer: a rule for all blocks, or the block of every pair (l, m) of colours, counted from
            0, in the stage spaces of the methods.

    Raises:
        MethodError: there is no such rule, or a method has several colours.

    >>> gark([diagonal_method("gauss", 2), diagonal_method("lobatto-iiia", 3)])
    <Tableau 2 colours, stages 2, 3>
    """
    diagonal = [_diagonal(method) for method in methods]
    if not isinstance(transfer, str):
        return forms.gark(diagonal, transfer)
    if transfer not in RULES:
        raise MethodError(
            f"no transfer rule {transfer!r}", did_you_mean(transfer, RULES)
        )
    rule = RULES[transfer]
    numbered = list(enumerate(diagonal))
    blocks = {
        (l, m): rule(here, other)
        for l, here in numbered
        for m, other in numbered
        if l != m
    }
    return forms.gark(diagonal, blocks)


def _diagonal(method: GarkMethod | Method) -> Method:
    """The one colour of a method, in its own stage space."""
    if isinstance(method, Method):
        return method
    tableau = method.tableau
    block = tableau.block(0, 0)
    if tableau.size != 1 or block is None:
        raise MethodError(
            f"{method!r} is no diagonal method", "give methods of one colour"
        )
    return Method(method.name, tableau.space(0), block, tableau.colours[0].b)
