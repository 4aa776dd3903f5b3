"""``--conjugate`` and ``--pair``: the symplectic conjugate of a method, or the pair of both."""

from __future__ import annotations

from typing import TYPE_CHECKING, overload

if TYPE_CHECKING:
    from garkcli.tableau.garkmethod import GarkMethod
    from garkcli.tableau.tableau import Tableau


@overload
def companion(method: Tableau, which: str | None) -> Tableau: ...
@overload
def companion(method: GarkMethod, which: str | None) -> GarkMethod: ...
def companion(method: Tableau | GarkMethod, which: str | None) -> Tableau | GarkMethod:
    """The method that ``which`` asks for.

    Raises:
        ZeroWeight: a conjugate would divide by zero.
    """
    if which is None:
        return method
    from garkcli.api.methods import conjugate, pair

    return pair(method) if which == "pair" else conjugate(method)


def exact_companion(method: GarkMethod, which: str | None) -> GarkMethod:
    """The same, where what is said of it is proved.

    Raises:
        MethodError: the pair or the conjugate of rounded coefficients.
        ZeroWeight: a conjugate would divide by zero.
    """
    from garkcli.api.anymethod import refuse_rounded

    refuse_rounded(method, which or "")
    return companion(method, which)
