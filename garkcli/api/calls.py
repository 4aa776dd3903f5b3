"""What is true of a method as its file claims it, and trees by order: calls without a room of their
own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from garkcli.api.anymethod import as_method
from garkcli.api.arguments import AnyMethod, tableau_of, tolerance_of
from garkcli.api.methods import analyse
from garkcli.check.true_claims import true_claims, usual_keys
from garkcli.errors import MethodError
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.claims_writer import write_claims
from garkcli.stability.summary import (
    Stability,
    stability,
    stability_of_rounded,
)
from garkcli.trees.blocks import iter_blocks
from garkcli.trees.notation import parse_tree
from garkcli.trees.tree import Tree


def claims_of(method: Any, keys: Iterable[str] = ()) -> dict[str, str]:
    """What is true of a method, as its file would claim it: ``gark claims``.

    Args:
        method: as ``assert_order`` takes it.
        keys: the claims; by default those that ``gark claims`` writes.

    Returns:
        The value of each as YAML.

    >>> claims_of("rk4", ["order", "symplectic"])
    {'order': '4', 'symplectic': 'false'}
    """
    found = analyse(as_method(method))
    return true_claims(found, list(keys) or usual_keys(found))


def with_claims(method: MethodFile, keys: Iterable[str] = ()) -> str:
    """The text of a method file that claims what is true of it: ``gark claims --write``, and what
    ``gark new`` writes.

    Args:
        method: from a file, a text or arrays.
        keys: as in ``claims_of``.

    Raises:
        MethodError: it was not read from a text.
    """
    if not isinstance(method, MethodFile):
        raise MethodError(
            f"{type(method).__name__} has no text",
            "give what load, loads or from_arrays return",
        )
    claims = claims_of(method, keys)
    return write_claims(method.source, method.text, claims)


def find_stability(method: AnyMethod, tolerance: object = None) -> Stability:
    """Everything that ``gark stability`` decides of a method.

    Args:
        method: a loaded method, a diagonal one, or a tableau.
        tolerance: the rounding of the coefficients; that of the method where it is not given, 0 for
            none.

    >>> find_stability(as_method("gauss-3")).linear[0].a_stable
    True
    """
    near = tolerance_of(method, tolerance)
    if near is None:
        return stability(tableau_of(method))
    return stability_of_rounded(tableau_of(method), near)


def all_trees(order: int, colours: int = 1) -> Iterator[Tree]:
    """The trees of an order, in the order of ``gark trees``.

    >>> from garkcli.trees.notation import format_tree
    >>> [format_tree(u, colours=False) for u in all_trees(3)]
    ['[[],[]]', '[[[]]]']
    """
    for block in iter_blocks(colours, order):
        for text in block.notation():
            yield parse_tree(text)
