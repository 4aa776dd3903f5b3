"""YAML nodes to the right-hand sides of a problem file, as its formulas stand there."""

from __future__ import annotations

from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.methodfile.problem_text import Side, Sides
from garkcli.methodfile.source import Source


def read_sides(source: Source, node: Node, names: tuple[str, ...], most: int) -> Sides:
    """The right-hand sides of each term: variables, formulas, and what these are called.

    Args:
        source: where faults are noted.
        node: what ``rhs`` has.
        names: of the variables; none where they have faults, and are not judged.
        most: terms.
    """
    if not isinstance(node, SequenceNode):
        return (_side(source, node, "rhs", names),)
    items = source.items(node, "rhs")
    if not items:
        cure = "give right-hand sides for each term"
        source.fault(node, "rhs is empty", cure)
    if len(items) > most:
        message = f"rhs: {len(items)} terms (limit {most})"
        source.fault(node, message, "use fewer")
        return ()
    sides: list[Side] = []
    for l, item in enumerate(items, start=1):
        where = f"f{{{l}}}"
        sides.append(_side(source, item, where, names))
    return tuple(sides)


def _side(source: Source, node: Node, where: str, names: tuple[str, ...]) -> Side:
    """Of one term; a formula alone is that of the only variable."""
    if isinstance(node, ScalarNode) and len(names) == 1:
        return ((names[0], node, where),)
    if not isinstance(node, MappingNode):
        shown = [f"{name}: …" for name in names[:2]]
        example = ", ".join(shown)
        wanted = "right-hand sides by the names of variables are expected"
        message = f"{where}: {wanted}"
        source.fault(node, message, f"write {{{example}}}")
        return ()
    side: list[tuple[str, Node, str]] = []
    for name, formula in source.mapping(node, where, names).items():
        side.append((name, formula, f"{where} of {name}"))
    return tuple(side)
