"""YAML nodes to the form ``methods``: diagonal methods and the rules between them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.errors import nearest
from garkcli.families.registry import FAMILIES
from garkcli.methodfile.description import (
    MAX_ENTRIES,
    ButcherText,
    FamilyText,
    MethodsText,
    Structure,
    TransferText,
    block_name,
    of_colour,
)
from garkcli.methodfile.further import names_beside
from garkcli.methodfile.members import FamilyReader
from garkcli.methodfile.nodes import keys_of
from garkcli.methodfile.numbers import Numbers
from garkcli.methodfile.source import Source
from garkcli.methodfile.spelled_out import SpelledOutReader, are_too_many

_FORM = "write a list: [{family: gauss, stages: 2}, …]"


class DiagonalReader:
    """Reads the diagonal methods of one file."""

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers
        self._spelled_out = SpelledOutReader(source, numbers)

    def read(self, node: Node, structure: Structure, transfer: Node | None) -> MethodsText | None:
        """The form ``methods``; None where it does not make a method."""
        source = self.source
        if keys_of(node) & {"A", "b", "family", "stages"}:
            items = [node]  # one method needs no brackets around it
        else:
            items = source.items(node, "methods", _FORM)
        if are_too_many(source, items, node):
            return None
        methods: list[FamilyText | ButcherText] = []
        for l, item in enumerate(items, start=1):
            method = self._method(item, l)
            if method is not None:
                methods.append(method)
        if not items and isinstance(node, SequenceNode):
            cure = "list at least one diagonal method"
            source.fault(node, "methods is empty", cure, code="empty")
        if structure != "general" and len(items) != 2:
            wanted = f"structure: {structure} is for two colours"
            source.fault(node, f"{wanted}, not {len(items)}", code="not-together")
        rules = self._rules(len(items), transfer)
        if not methods or len(methods) < len(items):
            return None
        if self._is_too_large(methods, node):
            return None
        names = [f"method {l}" for l in range(1, len(methods) + 1)]
        further = [method.further for method in methods]
        self._spelled_out.further.refuse_partial(further, names, node)
        return MethodsText(tuple(methods), rules)

    def _rules(self, colours: int, transfer: Node | None) -> TransferText:
        """How the blocks between the methods are made."""
        if transfer is None:
            return TransferText(None, {})
        from garkcli.methodfile.transfers import TransferReader

        reader = TransferReader(self.source, self.numbers)
        return reader.read(transfer, colours)

    def _is_too_large(self, methods: Sequence[FamilyText | ButcherText], node: Node) -> bool:
        """Note blocks between the methods that together have too many entries to be made."""
        stages = [_stages(method) for method in methods]
        inside = sum(s * s for s in stages)
        entries = sum(stages) ** 2 - inside
        if entries <= MAX_ENTRIES:
            return False
        where = "in the blocks between the methods"
        message = f"{entries} entries {where} (limit {MAX_ENTRIES})"
        self.source.fault(node, message, "use fewer methods, or fewer stages", code="too-many")
        return True

    def _method(self, node: Node, l: int) -> FamilyText | ButcherText | None:
        """The method of colour ``l``, counted from 1."""
        keys, where = keys_of(node), f"method {l}"
        if isinstance(node, ScalarNode):
            message = f"{where}: a mapping is expected here"
            self.source.fault(node, message, _written_out(node), code="mapping-expected")
            return None
        # of anything but a mapping there are no keys
        if "stages" in keys and not keys & {"family", "A", "b"}:
            cure = "write for instance family: gauss"
            self.source.fault(node, f"{where}: family missing", cure, code="missing-key")
            return None
        if "family" not in keys and isinstance(node, MappingNode):
            k = l - 1
            names = (block_name(k, k), of_colour("b", k), of_colour("c", k))
            return self._spelled_out.butcher(node, where, names)
        reader = FamilyReader(self.source, self.numbers)
        found = reader.read(node, where)
        if found is None:
            return None
        family, entries = found
        called = names_beside(of_colour("b", l - 1))
        further = self._spelled_out.further
        beside = further.of_method(entries, family.stages, called)
        return replace(family, further=beside)


def _stages(method: FamilyText | ButcherText) -> int:
    if isinstance(method, FamilyText):
        return method.stages
    return len(method.b)


def _written_out(node: ScalarNode) -> str:
    """The cure for a method that is a mere word."""
    word = nearest(str(node.value), FAMILIES) or "gauss"
    family = FAMILIES[word]
    if family.is_single:
        return f"write {{family: {word}}}"
    size = max(2, family.smallest)
    return f"write for instance {{family: {word}, {family.size}: {size}}}"
