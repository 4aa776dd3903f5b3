"""What a spec file of a sweep says."""

from __future__ import annotations

from dataclasses import dataclass, field

from yaml.nodes import Node, SequenceNode


@dataclass(frozen=True)
class TemplateText:
    """A method file of a sweep, made or read, and the parameters that are given values in it."""

    name: str
    text: str
    parameters: tuple[str, ...]


@dataclass
class SweepText:
    """What a spec file says.

    Attributes:
        name: of the sweep.
        templates: the method files.
        grids: the values of each parameter, as text.
        columns: the criteria.
        conditions: column, relation and bound.
        best: columns to sort by.
        pareto: columns of the front.
    """

    name: str = ""
    templates: list[TemplateText] = field(default_factory=list)
    grids: dict[str, tuple[str, ...]] = field(default_factory=dict)
    columns: list[str] = field(default_factory=list)
    conditions: list[tuple[str, str, bool | float]] = field(
        default_factory=list
    )
    best: list[str] = field(default_factory=list)
    pareto: list[str] = field(default_factory=list)


def one_or_more(node: Node) -> list[Node]:
    """The items of a list, or the one value."""
    return list(node.value) if isinstance(node, SequenceNode) else [node]
