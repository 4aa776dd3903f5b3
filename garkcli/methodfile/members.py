"""YAML nodes to members of families."""

from __future__ import annotations

from yaml.nodes import MappingNode, Node, ScalarNode

from garkcli.errors import UnknownFamily
from garkcli.families.family import Family, Given, Option, Recipe
from garkcli.families.registry import FAMILIES, recipe_of
from garkcli.methodfile.description import BESIDE, FamilyText
from garkcli.methodfile.further import CURES
from garkcli.methodfile.numbers import Entry, Numbers, Row
from garkcli.methodfile.source import Entries, Source

_ALL_KEYS = tuple({key for family in FAMILIES.values() for key in family.keys})
_FORM = "write for instance {family: gauss, stages: 2}"


class FamilyReader:
    """Reads the members of families of one file."""

    def __init__(self, source: Source, numbers: Numbers) -> None:
        self.source = source
        self.numbers = numbers

    def read(self, node: Node, where: str) -> tuple[FamilyText, Entries] | None:
        """A member of a family, which exists, with its keys; None where a fault was noted."""
        before = len(self.source.faults)
        family = _family_named(node)
        keys = _ALL_KEYS if family is None else family.keys
        allowed = ("family", *keys, "name", *BESIDE)
        entries = self.source.mapping(node, where, allowed, CURES, _FORM)
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
                value = self._option(entries[option.name], place, option)
                if value is not None:
                    options[option.name] = value
        return size, options

    def _option(self, node: Node, where: str, option: Option) -> Given | None:
        if option.words:
            return self.source.choice(node, where, option.words)
        if option.smallest is not None:
            return self.source.whole(node, where, option.smallest)
        # an entry of the file like any other, noted where it is faulty
        entry = self.numbers.entry(node, where)
        return entry.expression

    def _member(
        self, node: Node, name: str, entries: Entries, size: int | None, options: dict[str, Given]
    ) -> tuple[FamilyText, Entries] | None:
        try:
            recipe = recipe_of(name, size, options)
        except UnknownFamily as error:
            place = entries["family"]
            if name in FAMILIES:  # it lacks members of such a size
                place = entries.get(FAMILIES[name].size, place)
            self.source.fault(place, error.message, error.help)
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
