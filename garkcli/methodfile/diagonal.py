"""YAML nodes to the form ``methods``: members of families, and methods that are spelled out."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from yaml.nodes import MappingNode, Node, ScalarNode, SequenceNode

from garkcli.errors import UnknownFamily, nearest
from garkcli.families.family import MAX_STAGES, Family, Given, Option, Recipe
from garkcli.families.registry import FAMILIES, recipe_of
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
from garkcli.methodfile.grammar import Key, Kind, OfSchema, Schema, count, entries_in, mapping, word
from garkcli.methodfile.nodes import keys_of
from garkcli.methodfile.numbers import Entry, Numbers, Row
from garkcli.methodfile.parameters import NUMBER
from garkcli.methodfile.source import Entries, Source
from garkcli.methodfile.spelled_out import BUTCHER, SpelledOutReader, are_too_many

_FORM_OF_MEMBER = "write for instance {family: gauss, stages: 2}"
_BESIDE = [key for key in BUTCHER.inside() if key.name not in {"A", "b", "c"}]


def _kind_of(option: Option) -> Kind:
    """What an option may be set to."""
    if option.words:
        return word(lambda: option.words)
    if option.smallest is None:
        return NUMBER
    return count(option.smallest, MAX_STAGES if option.name == "stages" else None)


OPTIONS = {option.name: option for family in FAMILIES.values() for option in family.chosen}
_CHOSEN = [
    Key(f"{x.name}: {x.example}", _kind_of(x), x.text, x.default or None) for x in OPTIONS.values()
]


def _member(family: Family) -> Schema:
    """What a member of one family needs, and what it does not have."""
    needed = [] if family.is_single else [family.size]
    needed += [option.name for option in family.options if not option.default]
    barred = dict.fromkeys(sorted(OPTIONS.keys() - set(family.keys)), False)
    then: Schema = {"required": needed, "properties": barred}
    return {"if": {"properties": {"family": {"const": family.name}}}, "then": then}


FAMILY = mapping(
    Key(
        "family: radau-iia",
        word(FAMILIES.keys),
        "The name of a family of methods, as gark list shows them.",
        is_needed=True,
    ),
    *_CHOSEN,
    *_BESIDE,
    form=_FORM_OF_MEMBER,
    rules=[OfSchema(_member(family)) for family in FAMILIES.values()],
)
"""A member of a family."""
_KEYS = {key.name: key for key in FAMILY.inside()}


class FamilyReader:
    """Reads the members of families of one file."""

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers

    def read(self, node: Node, where: str) -> tuple[FamilyText, Entries] | None:
        """A member of a family, which exists, with its keys; None where a fault was noted."""
        before = len(self.source.faults)
        family = _family_named(node)
        barred = set() if family is None else OPTIONS.keys() - set(family.keys)
        keys = {name: key for name, key in _KEYS.items() if name not in barred}
        entries = entries_in(self.source, node, where, keys, form=_FORM_OF_MEMBER)
        if "family" not in entries or len(self.source.faults) > before:
            return None
        name = self.source.scalar(entries["family"], f"{where}, family")
        if name is None:
            return None
        if family is None:
            return self._member(node, name, entries, None, {})
        size, options = self._chosen(entries, family, where)
        if len(self.source.faults) > before:
            return None
        return self._member(node, name, entries, size, options)

    def _chosen(
        self, entries: Entries, family: Family, where: str
    ) -> tuple[int | None, dict[str, Given]]:
        """The size of a member and what else it is chosen by."""
        size = None
        if family.size in entries:
            place = f"{where}, {family.size}"
            node = entries[family.size]
            size = self.source.whole(node, place, smallest=1)
        options: dict[str, Given] = {}
        for option in family.options:
            if option.name in entries:
                place = f"{where}, {option.name}"
                value = _kind_of(option).read(self, entries[option.name], place)
                if value is not None:
                    is_entry = isinstance(value, Entry)
                    options[option.name] = value.expression if is_entry else value
        return size, options

    def _member(
        self, node: Node, name: str, entries: Entries, size: int | None, options: dict[str, Given]
    ) -> tuple[FamilyText, Entries] | None:
        try:
            recipe = recipe_of(name, size, options)
        except UnknownFamily as error:
            place = entries["family"]
            if name in FAMILIES:  # it lacks members of such a size
                place = entries.get(FAMILIES[name].size, place)
            self.source.fault(place, error.message, error.help, code=error.code)
            return None
        numbers = self._entries(recipe, node, name)
        chosen = _text_of(entries, FAMILIES[name])
        return FamilyText(node, name, chosen, recipe, numbers), entries

    def _entries(self, recipe: Recipe, node: Node, name: str) -> Row:
        """What a member is made of as coefficients of the file; those that stand there are so
        already.
        """
        read = {id(entry.expression): entry for entry in self.numbers.entries}
        row: list[Entry] = []
        for i, expression in enumerate(recipe.numbers, start=1):
            entry = read.get(id(expression))
            if entry is None:
                entry = Entry(expression, node, f"{name}, number {i}")
                self.numbers.entries.append(entry)
            row.append(entry)
        return tuple(row)


def _family_named(node: Node) -> Family | None:
    """The family that a mapping names, where it names one."""
    if not isinstance(node, MappingNode):
        return None
    for key, value in node.value:
        is_name = isinstance(key, ScalarNode) and key.value == "family"
        if is_name and isinstance(value, ScalarNode):
            return FAMILIES.get(value.value)
    return None


def _text_of(entries: Entries, family: Family) -> tuple[tuple[str, str], ...]:
    """What a member is chosen by, as it stands."""
    texts = []
    for key in family.keys:
        node = entries.get(key)
        if isinstance(node, ScalarNode):
            texts.append((key, str(node.value)))
    return tuple(texts)


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
