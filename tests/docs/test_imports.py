"""The graph of imports of the package, those inside functions included, has no circle; class names
mean one thing.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path

import garkcli
from garkcli.graph import components

ROOT = Path(__file__).resolve().parents[2]


def module_files() -> dict[str, Path]:
    """Every module of the package by its dotted name."""
    found = {}
    for path in sorted((ROOT / "garkcli").rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        name = ".".join(parts).removesuffix(".__init__")
        found[name] = path
    return found


@cache
def tree_of(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


def is_for_types_only(node: ast.AST) -> bool:
    """Whether a statement is ``if TYPE_CHECKING:``, whose imports are never executed."""
    return (
        isinstance(node, ast.If)
        and isinstance(node.test, ast.Name)
        and node.test.id == "TYPE_CHECKING"
    )


def executed(node: ast.AST) -> Iterator[ast.AST]:
    """All nodes below ``node`` but for what only type checkers read."""
    pending = [node]
    while pending:
        for child in ast.iter_child_nodes(pending.pop()):
            is_statement = not isinstance(child, ast.expr)  # which imports nothing
            if is_statement and not is_for_types_only(child):
                yield child
                pending.append(child)


def imported_modules(
    tree: ast.Module, modules: Mapping[str, Path], for_types: bool = False
) -> set[str]:
    """The modules of the package that a file imports, at its top or in a function."""
    found = set()
    for node in ast.walk(tree) if for_types else executed(tree):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            for alias in node.names:
                submodule = f"{node.module}.{alias.name}"
                found.add(submodule if submodule in modules else node.module)
    return found & set(modules)


def test_no_circle_of_imports() -> None:
    """Each module can be read after those it imports: components of the graph are single modules."""
    modules = module_files()
    graph = {
        name: sorted(imported_modules(tree_of(path), modules)) for name, path in modules.items()
    }
    assert len(graph) > 100
    assert not any(name in imported for name, imported in graph.items())
    circles = [component for component in components(graph) if len(component) > 1]
    assert circles == []


IN_CIRCLES_FOR_TYPES = {"bridges", "design", "order", "properties", "sources"}
"""Rooms in which files name each other in annotations; the list only shrinks."""


def test_no_circle_of_annotations() -> None:
    """In the other rooms each file can be understood after those that it imports, for types too."""
    modules = module_files()
    graph = {
        name: sorted(imported_modules(tree_of(path), modules, for_types=True))
        for name, path in modules.items()
    }
    circles = [component for component in components(graph) if len(component) > 1]
    rooms = {name.split(".")[1] for component in circles for name in component}
    assert rooms <= IN_CIRCLES_FOR_TYPES


def test_imports_in_functions_are_seen_and_those_for_types_are_not() -> None:
    """What the graph is made of: any import that runs at some time."""
    modules = dict.fromkeys(["garkcli.a", "garkcli.b", "garkcli.c", "garkcli.d"], Path())
    text = (
        "from typing import TYPE_CHECKING\nimport garkcli.a\n"
        "if TYPE_CHECKING:\n    from garkcli.b import x\n"
        "def f():\n    from garkcli.c import y\n    from garkcli import d\n"
    )
    assert imported_modules(ast.parse(text), modules) == {"garkcli.a", "garkcli.c", "garkcli.d"}


def test_no_room_hides_a_public_name() -> None:
    """A room that has been imported is an attribute of the package: only the catalogue is both."""
    rooms = {name.partition(".")[2] for name in module_files()}
    assert rooms & set(garkcli.__all__) == {"catalogue"}


GIVE_MEANING = {"garkcli.cli.options", "garkcli.sources.ir"}
"""Modules whose classes are named with the module, ``opt.Kind`` and ``ir.Call``."""


def test_a_class_name_means_one_thing() -> None:
    """Each is used once in the package, except in modules that are imported as modules."""
    trees = {name: tree_of(path) for name, path in module_files().items()}
    homes: dict[str, list[str]] = {}
    for name, tree in trees.items():
        for node in ast.walk(tree):
            if isinstance(node, ast.ClassDef) and name not in GIVE_MEANING:
                homes.setdefault(node.name, []).append(name)
    assert len(homes) > 500
    assert {name: modules for name, modules in homes.items() if len(modules) > 1} == {}
    named_alone = {
        (node.module, alias.name)
        for tree in trees.values()
        for node in ast.walk(tree)
        if isinstance(node, ast.ImportFrom) and node.module in GIVE_MEANING
        for alias in node.names
    }
    assert [f"{module}: {name}" for module, name in named_alone if name in homes] == []
