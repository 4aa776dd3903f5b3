"""The form ``methods``: members of families, and methods that are spelled out."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.errors import UnknownFamily, did_you_mean, nearest
from garkcli.families.collocation import MOST_OF_GAUSS
from garkcli.families.family import Given, MethodFamily, Option, Recipe
from garkcli.families.registry import FAMILIES, member_named, recipe_of
from garkcli.frozen import replace
from garkcli.grammar.keys import Key, OfSchema, Schema, ValueKind, count, entries_in, mapping, word
from garkcli.grammar.nodes import MappingNode, Node, ScalarNode, SequenceNode, keys_of, shortened
from garkcli.grammar.source import Entries
from garkcli.methodfile import description as d
from garkcli.methodfile import spelled_out
from garkcli.methodfile.numbers import Coefficient, NumbersReader, Row
from garkcli.methodfile.parameters import NUMBER

_FORM = "write a list: [{family: gauss, stages: 2}, …]"
_FORM_OF_MEMBER = "write for instance {family: gauss, stages: 2}"
_TAG = "tag:yaml.org,2002:"
_BESIDE = [key for key in spelled_out.BUTCHER.inside() if key.name not in {"A", "b", "c"}]


def _kind_of(option: Option) -> ValueKind:
    if option.words:
        return word(lambda: option.words)
    if option.smallest is None:
        return NUMBER
    return count(option.smallest, MOST_OF_GAUSS if option.name == "stages" else None)


OPTIONS = {option.name: option for family in FAMILIES.values() for option in family.chosen}
_CHOSEN = [
    Key(f"{x.name}: {x.example}", _kind_of(x), x.text, x.default or None) for x in OPTIONS.values()
]


def _member(family: MethodFamily) -> Schema:
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
_KEYS = {key.name: key for key in FAMILY.inside()}


def methods(
    at: NumbersReader, node: Node, structure: d.Structure, transfer: Node | None
) -> d.MethodsText | None:
    if keys_of(node) & {"A", "b", "family", "stages"} or _in_a_word(node) is not None:
        items = [node]  # one method needs no brackets around it
    else:
        items = at.source.items(node, "methods", _FORM)
    if spelled_out.are_too_many(at, items, node):
        return None
    every = [_method(at, item, l) for l, item in enumerate(items, start=1)]
    texts = [x for x in every if x is not None]
    if not items and isinstance(node, SequenceNode):
        at.source.fault(node, "methods is empty", "list at least one diagonal method", code="empty")
    if structure != "general" and len(items) != 2:
        message = f"structure: {structure} is for two colours, not {len(items)}"
        at.source.fault(node, message, "list two methods, or leave it out", code="not-together")
    rules = d.TransferText(None, {})
    if transfer is not None:
        from garkcli.methodfile.transfers import rules_of  # one method has none

        rules = rules_of(at, transfer, [1 if x is None else _stages(x) for x in every])
    if not texts or len(texts) < len(items) or _is_too_large(at, texts, node):
        return None
    names = [f"method {l}" for l in range(1, len(texts) + 1)]
    spelled_out.refuse_partial(at, [x.further for x in texts], names, node)
    return d.MethodsText(tuple(texts), rules)


def _stages(text: d.FamilyText | d.ButcherText) -> int:
    return text.stages if isinstance(text, d.FamilyText) else len(text.b)


def _is_too_large(
    at: NumbersReader, texts: Sequence[d.FamilyText | d.ButcherText], node: Node
) -> bool:
    stages = list(map(_stages, texts))
    entries = sum(stages) ** 2 - sum(s * s for s in stages)
    if entries > d.MAX_ENTRIES:
        message = f"{entries} entries in the blocks between the methods (limit {d.MAX_ENTRIES})"
        at.source.fault(node, message, "use fewer methods, or fewer stages", code="too-many")
    return entries > d.MAX_ENTRIES


def _method(at: NumbersReader, node: Node, l: int) -> d.FamilyText | d.ButcherText | None:
    node = _in_a_word(node) or node
    keys, where = keys_of(node), f"method {l}"
    if isinstance(node, ScalarNode):
        named = member_named(node.value, is_known=False)
        if named is None:
            message = f"{where}: a mapping is expected here"
            at.source.fault(node, message, _written_out(node), code="mapping-expected")
        else:
            message = f"{where}: no family {shortened(named[0])}"
            name, size = named
            cure, near = did_you_mean(name, FAMILIES), nearest(name, FAMILIES)
            meant = near if size is None or not near else f"{near}-{size}"
            at.source.fault(node, message, cure, code="unknown-word", meant=meant)
        return None
    # of anything but a mapping there are no keys
    if "stages" in keys and not keys & {"family", "A", "b"}:
        cure = "write for instance family: gauss"
        at.source.fault(node, f"{where}: family missing", cure, code="missing-key")
        return None
    b = d.of_colour("b", l - 1)
    if "family" not in keys and isinstance(node, MappingNode):
        return spelled_out.butcher(
            at, node, where, (d.block_name(l - 1, l - 1), b, d.of_colour("c", l - 1))
        )
    family_text = _family(at, node, where)
    if family_text is None:
        return None
    family, entries = family_text
    return replace(
        family,
        further=spelled_out.further_of_method(
            at, entries, family.stages, spelled_out.names_beside(b)
        ),
    )


def _in_a_word(node: Node) -> MappingNode | None:
    """``{family: gauss, stages: 2}`` for ``gauss-2``; None for any other node."""
    member = member_named(node.value) if isinstance(node, ScalarNode) else None
    if member is None:
        return None
    name, size = member
    marks = node.start_mark, node.end_mark
    written = [("family", name, "str")]
    if size is not None:
        written.append((FAMILIES[name].size, str(size), "int"))
    made = [
        (ScalarNode(f"{_TAG}str", key, *marks), ScalarNode(f"{_TAG}{kind}", value, *marks))
        for key, value, kind in written
    ]
    return MappingNode(f"{_TAG}map", made, *marks)


def _written_out(node: ScalarNode) -> str:
    name = nearest(str(node.value), FAMILIES) or "gauss"
    family = FAMILIES[name]
    if family.is_single:
        return f"write {{family: {name}}}"
    size = max(2, family.smallest)
    return f"write for instance {{family: {name}, {family.size}: {size}}}"


def _family(at: NumbersReader, node: Node, where: str) -> tuple[d.FamilyText, Entries] | None:
    before = len(at.source.faults)
    family = _family_named(node)
    barred = set() if family is None else OPTIONS.keys() - set(family.keys)
    keys = {name: key for name, key in _KEYS.items() if name not in barred}
    entries = entries_in(at.source, node, where, keys, form=_FORM_OF_MEMBER)
    if "family" not in entries or len(at.source.faults) > before:
        return None
    name = at.source.scalar(entries["family"], f"{where}, family")
    if name is None:
        return None
    size, options = (None, {}) if family is None else _chosen(at, entries, family, where)
    if len(at.source.faults) > before:
        return None
    try:
        recipe = recipe_of(name, size, options)
    except UnknownFamily as error:
        place = entries["family"]
        if family is not None:  # it lacks members of such a size
            place = entries.get(family.size, place)
        at.source.fault(place, error.message, error.help, code=error.code, meant=error.meant)
        return None
    # what a member is chosen by, as it is
    nodes = ((key, entries.get(key)) for key in FAMILIES[name].keys)
    chosen = tuple((key, str(x.value)) for key, x in nodes if isinstance(x, ScalarNode))
    return d.FamilyText(node, name, chosen, recipe, _entries(at, recipe, node, name)), entries


def _chosen(
    at: NumbersReader, entries: Entries, family: MethodFamily, where: str
) -> tuple[int | None, dict[str, Given]]:
    size = None
    if family.size in entries:
        size = at.source.whole(entries[family.size], f"{where}, {family.size}", smallest=1)
    options: dict[str, Given] = {}
    for option in family.options:
        if option.name in entries:
            value = _kind_of(option).read(at, entries[option.name], f"{where}, {option.name}")
            if value is not None:
                options[option.name] = value.expression if isinstance(value, Coefficient) else value
    return size, options


def _entries(at: NumbersReader, recipe: Recipe, node: Node, name: str) -> Row:
    read = {id(entry.expression): entry for entry in at.numbers.entries}
    row: list[Coefficient] = []
    for i, expression in enumerate(recipe.numbers, start=1):
        entry = read.get(id(expression))
        if entry is None:
            entry = Coefficient(expression, node, f"{name}, number {i}")
            at.numbers.entries.append(entry)
        row.append(entry)
    return tuple(row)


def _family_named(node: Node) -> MethodFamily | None:
    for key, value in node.value if isinstance(node, MappingNode) else ():
        is_name = isinstance(key, ScalarNode) and key.value == "family"
        if is_name and isinstance(value, ScalarNode):
            return FAMILIES.get(value.value)
    return None
