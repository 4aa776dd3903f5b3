"""The list of Python names on the site is whole, and so are docstrings of public names."""

from __future__ import annotations

import ast
import builtins
import doctest
import inspect
import re

import pytest

import garkcli
from garkcli.errors import GarkError
from garkcli.frozen import Frozen, fields
from tests.docs.python_reference import VALUES, Docstring, home, items, of_class, page, returned

NAMES = {name: getattr(garkcli, name) for name in garkcli.__all__}
FUNCTIONS = [x for x in NAMES if inspect.isfunction(NAMES[x])]
CLASSES = dict(map(home, VALUES)) | {
    name: thing for name, thing in NAMES.items() if inspect.isclass(thing)
}


def test_every_name_has_its_row() -> None:
    """Once each, and so has what a call says that it returns."""
    types, _, rest = page().partition("\n## A method\n")
    rows = re.findall(r"^\* `(\w+)", rest, re.MULTILINE)
    assert len(rows) == len(set(rows))
    assert {*garkcli.__all__} <= {*rows}
    assert returned() <= {*rows, "Iterator", "Any"}
    assert "* `AnyMethod`: " in types


def test_examples_can_be_copied() -> None:
    """Behind ``from garkcli import *`` an example uses no name that it does not bring."""
    given = {*garkcli.__all__, *dir(builtins)}
    told = [Docstring.of(NAMES[name]).examples for name in [*FUNCTIONS, "Tree", "Oscillator"]]
    blocks = ["\n".join(examples) for examples in told if examples]
    assert len(blocks) > 60
    for block in blocks:
        examples = doctest.DocTestParser().get_examples(block)
        tree = ast.parse("".join(x.source for x in examples))
        nodes = list(ast.walk(tree))
        names = [x for x in nodes if isinstance(x, ast.Name)]
        used = {x.id for x in names if isinstance(x.ctx, ast.Load)}
        made = {x.id for x in names if isinstance(x.ctx, ast.Store)}
        made |= {x.arg for x in nodes if isinstance(x, ast.arg)}
        brought = {
            (x.asname or x.name).partition(".")[0] for x in nodes if isinstance(x, ast.alias)
        }
        assert used <= given | made | brought, block


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_function_is_told_whole(name: str) -> None:
    """Each argument, what goes wrong, and an example, which the doctests run."""
    doc = Docstring.of(NAMES[name])
    arguments = dict(items(doc.sections.get("Args", "")))
    assert {*arguments} == {*inspect.signature(NAMES[name]).parameters}
    assert all(arguments.values())
    assert doc.examples
    assert all(why for _, why in items(doc.sections.get("Raises", "")))


@pytest.mark.parametrize("name", CLASSES)
def test_a_value_is_told_whole(name: str) -> None:
    """Each attribute that has a name."""
    kind = CLASSES[name]
    told = dict(items(of_class(kind).sections.get("Attributes", "")))
    assert all(told.values())
    if issubclass(kind, Frozen):
        for field in fields(kind):
            is_base = field not in vars(kind)["__annotations__"]
            is_told = field in told or field.startswith("_")
            assert is_told or (name == "MethodFile" and is_base), field
    elif issubclass(kind, GarkError):
        assert inspect.getdoc(kind)
