"""What values show and answer by the rooms above theirs.

``method.order`` is an attribute of data at the bottom, the search for orders lies above it. No room
names one above: the package hands down what answers, once, when it is imported; its table is
``ANSWERS`` in ``garkcli/__init__.py``.
"""

from __future__ import annotations

TYPE_CHECKING = False  # the package imports this file, and nothing that is not needed
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, TypeAlias

    Answering: TypeAlias = Callable[[str, str], Callable[..., Any] | None]

_handed_down: list[Answering] = []


def hand_down(answering: Answering) -> None:
    """Let values of all rooms answer by this from now on.

    Args:
        answering: from the names of a class and of a question to what answers; None where nothing
            does.
    """
    _handed_down[:] = [answering]


def answered(value: object, question: str, **options: Any) -> Any:
    """What is answered of a value, with some options; None where nothing is.

    >>> from garkcli.ntrees.tree import Tree
    >>> answered(Tree(0, [Tree(0)]), "text")
    '[[]_1]_1'
    """
    (answering,) = _handed_down
    for kind in type(value).__mro__:
        answer = answering(kind.__name__, question)
        if answer is not None:
            return answer(value, **options)
    return None


class Shown:
    """A value that notebooks show, as HTML, as LaTeX or as a picture."""

    __slots__ = ()

    def _repr_html_(self) -> Any:
        return answered(self, "html")

    def _repr_latex_(self) -> Any:
        return answered(self, "latex")

    def _repr_svg_(self) -> Any:
        return answered(self, "svg")
