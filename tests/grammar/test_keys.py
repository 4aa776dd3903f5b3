"""A grammar of files that have nothing to do with methods: read, refused, described, edited."""

from types import SimpleNamespace
from typing import Any

import pytest

from garkcli.errors import MethodFileError
from garkcli.glossary.key import FileKind
from garkcli.grammar import keys as g
from garkcli.grammar.editing import with_values
from garkcli.grammar.nodes import compose, node_at
from garkcli.grammar.source import Source

RECIPES = FileKind("recipe", "recipes", "docs/none.md", ("dish",), "it has a dish", "name a dish")
OVEN = g.mapping(
    g.Key("degrees: 200", g.count(1, 300), "How hot it is.", is_needed=True),
    g.Key("fan: true", g.FLAG, "Whether a fan is on.", False),
    form="write oven: {degrees: 200}",
)
RECIPE = g.mapping(
    g.Key("dish: soup", g.TEXT, "What it makes.", is_needed=True, also=("meal",)),
    g.Key("spices: [salt]", g.one_or_more(g.word(lambda: ("salt", "pepper"))), "Few of them."),
    g.Key("oven: {degrees: 200}", OVEN, "Its heat."),
    g.Key("pan: deep", g.TEXT, "What it is fried in."),
    rules=[g.Ways("the heat is", ("oven", "pan"))],
)


def read(text: str) -> g.ReadMapping:
    """The values of a recipe; raises its faults."""
    source = Source("recipe.yaml", text, RECIPES)
    root = source.compose()
    assert root is not None
    values: g.ReadMapping = RECIPE.read(SimpleNamespace(source=source), root, g.FILE)
    source.close()
    return values


def test_values_are_read() -> None:
    """Single words as lists, spellings of truth, and mappings inside."""
    values = read("{dish: soup, spices: salt, oven: {degrees: 180, fan: yes}}")
    assert (values["dish"], values["spices"]) == ("soup", ["salt"])
    assert dict(values["oven"]) == {"degrees": 180, "fan": True}


@pytest.mark.parametrize(
    ("text", "faults"),
    [
        ("meal: soup", [(1, 1, "unknown-key", "did you mean 'dish'?")]),
        ("dish: soup\nspice: salt", [(2, 1, "unknown-key", "did you mean 'spices'?")]),
        ("dish: soup\noven: {fan: no}", [(2, 7, "missing-key", "write oven: {degrees: 200}")]),
        ("dish: soup\noven: {degrees: 400}", [(2, 17, "wrong-value", None)]),
        (
            "spices: [salt, sugar]\noven: {degrees: 9}\npan: flat",
            [
                (1, 1, "missing-key", ""),
                (1, 16, "unknown-word", None),
                (3, 6, "given-twice", "keep one of oven, pan"),
            ],
        ),
    ],
)
def test_all_faults_are_told_at_once(text: str, faults: list[tuple[Any, ...]]) -> None:
    """Each with its position, its kind and its cure."""
    with pytest.raises(MethodFileError) as caught:
        read(text)
    told = [(x.line, x.column, x.code, x.help) for x in caught.value.faults]
    assert len(told) == len(faults)
    for one, (*wanted, cure) in zip(told, faults, strict=True):
        assert [*one[:3]] == wanted
        assert cure is None or one[3] == cure


def test_schema_and_entries_are_those_of_the_declarations() -> None:
    """One declaration reads the key, describes it to editors and explains it."""
    schema = g.file_schema("recipe", "A recipe.", RECIPE)
    assert schema["required"] == ["dish"]
    oven = schema["properties"]["oven"]
    assert (oven["properties"]["degrees"]["maximum"], oven["required"]) == (300, ["degrees"])
    paths = [entry.path for entry in g.told(RECIPE.inside(), RECIPES.page)]
    assert paths == ["dish", "spices", "oven", "oven.degrees", "oven.fan", "pan"]


def test_a_file_is_edited_in_place() -> None:
    """Comments stay, values change, new keys come last; braces have no place for a new mapping."""
    text = "dish: soup  # hot\noven:\n  degrees: 180  # enough\n"
    root = compose(text)
    edited = with_values(text, root, "oven", {"degrees": "200", "fan": "true"})
    assert edited == "dish: soup  # hot\noven:\n  degrees: 200  # enough\n  fan: true\n"
    assert read(edited)["oven"] == {"degrees": 200, "fan": True}
    short = "{dish: soup}"
    assert with_values(short, compose(short), "oven", {"degrees": "1"}) is None


def test_made_values_are_read_at_a_place_of_the_file() -> None:
    """What stands for a word of the file has its position in faults."""
    root = compose("dish: soup\noven: hot")
    source = Source("recipe.yaml", "dish: soup\noven: hot", RECIPES)
    place = root.value[1][1]
    OVEN.read(SimpleNamespace(source=source), node_at({"degrees": "999"}, place), "oven")
    assert [(x.line, x.column, x.code) for x in source.faults] == [(2, 7, "wrong-value")]
