"""Every message that the program has for what it is given: read out of its source."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "garkcli"
ERRORS = {
    *("Remark", "GarkError", "MethodError", "UsageProblem", "ShapeMismatch"),
    *("CoincidingNodes", "BlockTooLarge", "ZeroWeight", "UnknownFamily"),
    *("VanishingDenominator", "NoLegendreTransform", "ExpressionError"),
    *("LimitExceeded", "UndefinedValue", "CannotExport", "CannotConvert"),
    *("NoUniqueStep", "NoMethod", "NoSuchMethod", "TableTooLarge"),
    *("WorkerLost", "NotationError", "TreeError", "NoSuchColour"),
    *("NotDecided", "TooManyTerms"),
}
"""Errors whose first argument is the message."""
READERS = (PACKAGE / "bridges" / "readers", PACKAGE / "sources")
FINDINGS = {
    *(PACKAGE / "check" / "findings.py", PACKAGE / "bridges" / "audit.py"),
    PACKAGE / "bridges" / "rosenbrock.py",
}
"""Files whose remarks are findings, which ``findings.toml`` explains by their codes."""
METHODS = {"fault": 1, "error": 0, "__init__": 0}
"""Methods that make faults, with the place of the message among their arguments."""
DECLARED = {"Beside": (1, "not-together"), "Ways": (2, "missing-key")}
"""Rules about keys: where their message stands among their arguments, and its kind."""
HOLE = "{}"


@dataclass(frozen=True)
class Site:
    """A place where a message is made, with ``{}`` for what it is filled with, and its code: empty
    where none is said there, ``{}`` where it is that of another error.
    """

    place: str
    message: str
    code: str


class _File:
    """A file of the package: its calls and assignments, each with the function around it."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.tree = _tree(path)
        self.around: dict[ast.AST, ast.AST] = {}
        self.calls: dict[str, list[ast.Call]] = {}
        self.assigned: dict[tuple[ast.AST, str], list[ast.expr]] = {}
        self.owner: dict[ast.AST, str] = {}
        self._walk(self.tree, self.tree)

    def _walk(self, node: ast.AST, function: ast.AST) -> None:
        for child in ast.iter_child_nodes(node):
            if isinstance(child, ast.Call):
                self.around[child] = function
                self.calls.setdefault(_name(child.func), []).append(child)
            elif isinstance(child, ast.Assign):
                for target in child.targets:
                    self._assign(target, child.value, function)
            is_function = isinstance(child, ast.FunctionDef)
            if is_function and isinstance(node, ast.ClassDef):
                self.owner[child] = node.name
            self._walk(child, child if is_function else function)

    def _assign(self, target: ast.expr, value: ast.expr, function: ast.AST) -> None:
        if isinstance(target, ast.Name):
            place = (function, target.id)
            self.assigned.setdefault(place, []).append(value)
        elif isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
            for part, given in zip(target.elts, value.elts, strict=True):
                self._assign(part, given, function)


@cache
def _tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def _files() -> tuple[_File, ...]:
    """The files that make errors."""
    words = (
        *(f"{name}(" for name in (*ERRORS, *DECLARED)),
        ".fault(",
        ".error(",
        "super().__init__(f",
    )
    found = []
    for path in _paths():
        text = path.read_text(encoding="utf-8")
        if any(word in text for word in words):
            found.append(_File(path))
    return tuple(found)


_JOINT = re.compile(r'"\s+f?"')
"""Between two pieces of a text that goes on in the next line."""


def source() -> str:
    """The package as one text, in which what is written in pieces is whole."""
    texts = [path.read_text(encoding="utf-8") for path in _paths()]
    return _JOINT.sub("", "\n".join(texts))


def _paths() -> list[Path]:
    return sorted(PACKAGE.rglob("*.py"))


@cache
def sites() -> list[Site]:
    """Every message with the place it is made at, those of helpers at each of their callers.

    What readers of other people's sources cannot read is told inside of other messages.
    """
    found = []
    for file in _files():
        if set(READERS) & set(file.path.parents) and file.path.name != "registry.py":
            continue
        for node in file.around:
            assert isinstance(node, ast.Call)
            place = _message_place(node)
            name = _name(node.func)
            is_finding = file.path in FINDINGS and name == "Remark"
            is_of_others = name == "__init__" and not _is_error(
                file.owner.get(file.around[node], "")
            )
            if place is None or is_finding or is_of_others:
                continue
            message = _argument(node, place, "message")
            if message is None:
                continue
            where = f"{file.path.relative_to(ROOT)}:{node.lineno}"
            code = _code(node, file)
            found += [Site(where, text, code) for text in _texts(message, file, node, depth=3)]
    return found


def _code(call: ast.Call, file: _File) -> str:
    """What a call says of the kind of its error, or the class that it makes."""
    said = _argument(call, len(call.args), "code")
    if said is None:
        name = _name(call.func)
        if name in DECLARED:
            return DECLARED[name][1]
        return _code_of_class(file.owner.get(file.around[call], name) if name in METHODS else name)
    return str(said.value) if isinstance(said, ast.Constant) else HOLE


def _is_error(name: str) -> bool:
    """Whether a class of the package is an exception."""
    definition = _classes().get(name)
    if definition is None:
        return name.endswith(("Error", "Exception"))
    return any(_is_error(_name(base)) for base in definition.bases)


def _code_of_class(name: str) -> str:
    """What a class of errors says, or the first of its bases that does."""
    definition = _classes().get(name)
    if definition is None or name == "GarkError":
        return ""
    if "Exception" in map(_name, definition.bases):
        return HOLE  # those of the program are caught where they are made
    for line in definition.body:
        if isinstance(line, ast.Assign) and _name(line.targets[0]) == "code":
            return str(line.value.value) if isinstance(line.value, ast.Constant) else ""
    return next(filter(None, (_code_of_class(_name(base)) for base in definition.bases)), "")


@cache
def _classes() -> dict[str, ast.ClassDef]:
    """The classes of the package by their names."""
    found = {}
    for path in _paths():
        for node in _tree(path).body:
            if isinstance(node, ast.ClassDef):
                found[node.name] = node
    return found


def _message_place(call: ast.Call) -> int | None:
    """Where the message of a call stands that makes a fault; None for other calls."""
    name = _name(call.func)
    if isinstance(call.func, ast.Name) and name in ERRORS:
        return 0
    if isinstance(call.func, ast.Name) and name in DECLARED:
        return DECLARED[name][0]
    if isinstance(call.func, ast.Attribute) and name in METHODS:
        return METHODS[name]
    return None


def _name(node: ast.expr) -> str:
    if isinstance(node, ast.Attribute):
        return node.attr
    return node.id if isinstance(node, ast.Name) else ""


def _argument(call: ast.Call, place: int, name: str) -> ast.expr | None:
    if place < len(call.args):
        return call.args[place]
    for keyword in call.keywords:
        if keyword.arg == name:
            return keyword.value
    return None


def _texts(node: ast.expr, file: _File, at: ast.AST, depth: int) -> Iterator[str]:
    """What an expression may say; nothing where it hands on what another site has said."""
    if isinstance(node, ast.Constant):
        yield str(node.value).replace("{way}", HOLE)
    elif isinstance(node, ast.JoinedStr):
        yield "".join(str(x.value) if isinstance(x, ast.Constant) else HOLE for x in node.values)
    elif isinstance(node, ast.IfExp):
        yield from _texts(node.body, file, at, depth)
        yield from _texts(node.orelse, file, at, depth)
    elif isinstance(node, ast.BinOp):
        for left in _texts(node.left, file, at, depth):
            for right in _texts(node.right, file, at, depth):
                yield left + right
    elif isinstance(node, ast.Attribute):
        if node.attr not in {"message", "help"}:
            yield HOLE
    elif isinstance(node, ast.Name):
        yield from _named(node.id, file, at, depth)
    elif isinstance(node, ast.Call) and _name(node.func) in {"printable", "Reason"}:
        yield from _texts(node.args[0], file, at, depth)
    else:
        yield HOLE


def _named(name: str, file: _File, at: ast.AST, depth: int) -> Iterator[str]:
    """What a name stands for: what is assigned to it, or what callers give."""
    function = file.around[at]
    assigned = file.assigned.get((function, name), [])
    if not assigned and function is not file.tree:
        parameter = _parameter(name, function)
        if parameter is not None and depth:
            yield from _of_callers(function, file, parameter, name, depth - 1)
            return
        assigned = file.assigned.get((file.tree, name), [])
    if not assigned:
        yield HOLE
    for value in assigned:
        yield from _texts(value, file, at, depth)


def _parameter(name: str, function: ast.AST) -> int | None:
    if not isinstance(function, ast.FunctionDef):
        return None
    names = [x.arg for x in function.args.args]
    if name not in names:
        return None
    place = names.index(name)
    return place - (1 if names[0] in {"self", "cls"} else 0)


def _of_callers(function: ast.AST, file: _File, place: int, name: str, depth: int) -> Iterator[str]:
    assert isinstance(function, ast.FunctionDef)
    if function.name in METHODS:
        return  # each of its calls is a site of its own
    is_private = function.name.startswith("_")
    for caller in [file] if is_private else _files():
        for node in caller.calls.get(function.name, []):
            value = _argument(node, place, name)
            if value is not None:
                yield from _texts(value, caller, node, depth)
