"""YAML nodes to the right-hand sides of a problem file, as its formulas stand there."""

from __future__ import annotations

from collections.abc import Sequence

from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.methodfile.problem_text import Side, Sides
from garkcli.methodfile.source import Source


def read_sides(
    source: Source, node: Node, items: Sequence[Node] | None, names: tuple[str, ...]
) -> Sides:
    """The right-hand sides of each term: variables, formulas, and what these are called.

    Args:
        source: where faults are noted.
        node: what ``rhs`` has.
        items: the terms in it; None where there are none, which is noted.
        names: of the variables; none where they have faults, and are not judged.
    """
    is_one = not isinstance(node, SequenceNode)
    wheres = ["rhs" if is_one else f"f{{{l}}}" for l in range(1, len(items or ()) + 1)]
    pairs = zip(items or (), wheres, strict=True)
    return tuple(_side(source, item, where, names) for item, where in pairs)


def _side(source: Source, node: Node, where: str, names: tuple[str, ...]) -> Side:
    """Of one term; a formula alone is that of the only variable."""
    if isinstance(node, ScalarNode) and len(names) == 1:
        return ((names[0], node, where),)
    if not isinstance(node, MappingNode):
        shown = [f"{name}: …" for name in names[:2]]
        example = ", ".join(shown)
        wanted = "right-hand sides by the names of variables are expected"
        message = f"{where}: {wanted}"
        source.fault(node, message, f"write {{{example}}}", code="mapping-expected")
        return ()
    side: list[tuple[str, Node, str]] = []
    for name, formula in source.mapping(node, where, names).items():
        side.append((name, formula, f"{where} of {name}"))
    return tuple(side)
