"""Small changes that the mathematical rooms could have suffered: where, which, and a sample."""

from __future__ import annotations

import ast
import difflib
import hashlib
import re
import tomllib
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
ROOMS = ("exact", "ntrees", "order", "tableau", "properties", "stability", "design", "backward")
KNOWN = Path(__file__).parent / "known.toml"
"""Survivors that no test need kill, with a reason each."""
SLIPS = (
    *("Add_Sub", "Sub_Add", "Mul_Add", "Div_Mul", "FloorDiv_Mul", "Mod_FloorDiv", "Pow_Mul"),
    *("BitOr_BitAnd", "BitAnd_BitOr", "RShift_LShift", "LShift_RShift"),
)
"""A sign for another one, as a slip of the pen has it: most others fail whatever they are given."""
BOUNDS = (
    *("Lt_LtE", "LtE_Lt", "Gt_GtE", "GtE_Gt", "Lt_GtE", "GtE_Lt", "Gt_LtE", "LtE_Gt"),
    *("Eq_NotEq", "NotEq_Eq", "Is_IsNot", "IsNot_Is"),
)
"""A bound that is or is not met, and the contrary."""
OPERATORS = (
    *(f"ReplaceBinaryOperator_{pair}" for pair in SLIPS),
    *(f"ReplaceComparisonOperator_{pair}" for pair in BOUNDS),
    *("ReplaceUnaryOperator_Delete_USub", "ReplaceUnaryOperator_Delete_Not", "AddNot"),
    *("ReplaceTrueWithFalse", "ReplaceFalseWithTrue", "ReplaceAndWithOr", "ReplaceOrWithAnd"),
    *("ReplaceBreakWithContinue", "ReplaceContinueWithBreak", "ZeroIterationForLoop"),
    *("NumberReplacer", "ExceptionReplacer"),
)
"""Those of cosmic-ray that are taken."""

Position = tuple[int, int]
"""A line, counted from 1, and a column."""


@dataclass(frozen=True)
class Mutation:
    """One change of one file.

    Attributes:
        path: the file, from the root of the repository.
        at: where the change begins.
        operator: what cosmic-ray calls it.
        occurrence: at which of the places in the file where it could be made.
    """

    path: str
    at: Position
    operator: str
    occurrence: int

    @property
    def text(self) -> str:
        """The file with the change."""
        return changed(self)

    @cached_property
    def difference(self) -> tuple[str, str]:
        """The lines that change, as they are and as they become, without indentation."""
        lines = difflib.ndiff(source(self.path).splitlines(), self.text.splitlines())
        was, becomes = [], []
        for line in lines:
            if line.startswith("- "):
                was.append(line[2:].strip())
            elif line.startswith("+ "):
                becomes.append(line[2:].strip())
        return "\n".join(was), "\n".join(becomes)


@lru_cache(maxsize=8)
def changed(mutation: Mutation) -> str:
    """The file with a change."""
    # the tests of this room do without cosmic-ray
    from cosmic_ray.mutating import mutate_code
    from cosmic_ray.plugins import get_operator

    operator = get_operator(f"core/{mutation.operator}")()
    return str(mutate_code(source(mutation.path), operator, mutation.occurrence))


@cache
def source(path: str) -> str:
    """The text of a file of gark."""
    return (ROOT / path).read_text(encoding="utf-8")


def sample(count: int, seed: int, rooms: Sequence[str] = ROOMS) -> list[Mutation]:
    """So many mutations at different places, all places alike.

    What is drawn hangs on the seed and on the lines, not on where they are in a file: a sample
    stays what it is when other lines change.
    """
    places = [place for room in rooms for place in places_of(room)]

    def rank(place: tuple[str, Sequence[Mutation]]) -> str:
        return digest(seed, place[0])

    found = []
    for name, mutations in sorted(places, key=rank):
        if len(found) == count:
            break
        drawn = min(mutations, key=lambda x: digest(seed, name, x.operator, x.occurrence))
        if is_python(drawn.text):
            found.append(drawn)
    return found


def digest(*parts: object) -> str:
    """The same on every machine."""
    return hashlib.sha256(repr(parts).encode()).hexdigest()


def is_python(text: str) -> bool:
    """Whether a text compiles: a star in a list of arguments is no product."""
    try:
        ast.parse(text)
    except SyntaxError:
        return False
    return True


def places_of(room: str) -> Iterator[tuple[str, list[Mutation]]]:
    """The places of a room where something can change, by names that other lines do not change."""
    for file in sorted((ROOT / "garkcli" / room).rglob("*.py")):
        path = file.relative_to(ROOT).as_posix()
        by_place: dict[Position, list[Mutation]] = {}
        for mutation in all_mutations(path):
            by_place.setdefault(mutation.at, []).append(mutation)
        lines = source(path).splitlines()
        seen: Counter[str] = Counter()
        for at, mutations in sorted(by_place.items()):
            line = lines[at[0] - 1]
            name = f"{path} {line.strip()} {at[1] - len(line) + len(line.lstrip())}"
            seen[name] += 1
            yield f"{name} {seen[name]}", mutations


def all_mutations(path: str) -> Iterator[Mutation]:
    """What cosmic-ray can change in a file, but for what does not matter."""
    from cosmic_ray.ast import ast_nodes, get_ast
    from cosmic_ray.plugins import get_operator

    text = source(path)
    spared = [span(node, text) for node in without_meaning(ast.parse(text))]
    nodes = list(ast_nodes(get_ast(text)))
    for name in OPERATORS:
        operator = get_operator(f"core/{name}")()
        starts = [start for node in nodes for start, _ in operator.mutation_positions(node)]
        for occurrence, at in enumerate(starts):
            if not any(start <= at < end for start, end in spared):
                yield Mutation(path, at, name, occurrence)


def without_meaning(tree: ast.AST) -> Iterator[ast.AST]:
    """Parts of a file that no result hangs on.

    Types, decorators, texts of errors, assertions for the type checker, ``__repr__``, and
    ``strict=`` of ``zip``. A condition of an error matters.
    """
    for node in ast.walk(tree):
        match node:
            case ast.Raise() | ast.Assert():
                yield node
            case ast.FunctionDef(name="__repr__") | ast.If(test=ast.Name(id="TYPE_CHECKING")):
                yield node
            case ast.FunctionDef(returns=returns, decorator_list=decorators):
                yield from decorators
                if returns:
                    yield returns
            case ast.ClassDef(bases=bases, decorator_list=decorators):
                yield from (*bases, *decorators)
            case ast.arg(annotation=ast.expr() as annotation):
                yield annotation
            case ast.AnnAssign(annotation=ast.Name(id="TypeAlias")):
                yield node
            case ast.AnnAssign(annotation=annotation):
                yield annotation
            case ast.Call(func=ast.Name(id="cast"), args=[first, *_]):
                yield first
            case ast.Call(func=ast.Name(id="TypeVar")):
                yield node
            case ast.keyword(arg="strict"):
                yield node.value


def span(node: ast.AST, text: str) -> tuple[Position, Position]:
    """Where a node begins and ends; its columns count characters, where those of ast are bytes."""
    lines = text.splitlines()

    def column(line: int, offset: int) -> int:
        return len(lines[line - 1].encode()[:offset].decode())

    start = node.lineno, column(node.lineno, node.col_offset)
    return start, (node.end_lineno, column(node.end_lineno, node.end_col_offset))


def lines_of_statement(text: str, line: int) -> range | None:
    """The lines of the innermost statement around a line, without the block under it.

    Returns:
        None for what is done when the file is imported.
    """
    found: ast.AST = ast.parse(text)
    is_inside = False
    while True:
        around = [
            x
            for x in ast.walk(found)
            if isinstance(x, ast.stmt | ast.ExceptHandler | ast.match_case)
            and x is not found
            and first_line(x) <= line <= last_line(x)
        ]
        if not around:
            break
        is_inside = is_inside or isinstance(found, ast.FunctionDef)
        found = around[0]
    if not is_inside:
        return None
    body = getattr(found, "cases", None) or getattr(found, "body", None)
    head = range(first_line(found), first_line(body[0]) if body else last_line(found) + 1)
    return head if line in head else range(line, line + 1)


def first_line(node: ast.AST) -> int:
    """Where a statement or a case of ``match`` begins."""
    return node.pattern.lineno if isinstance(node, ast.match_case) else node.lineno


def last_line(node: ast.AST) -> int:
    """Where it ends."""
    return node.body[-1].end_lineno if isinstance(node, ast.match_case) else node.end_lineno


def known(key: str = "survivor") -> list[dict[str, Any]]:
    """Survivors with a reason: file, was, why, and where it matters becomes and after; kinds of
    lines: pattern, why, and where it matters apart; or proposals: file, why, and names where these
    are not all of the file.
    """
    entries: list[dict[str, Any]] = tomllib.loads(KNOWN.read_text("utf-8"))[key]
    return entries


def reason_of_proposal(path: str, line: int) -> str | None:
    """Why a survivor there changes no verdict: what the code proposes is decided elsewhere."""
    around = {
        node.name
        for node in ast.walk(ast.parse(source(path)))
        if isinstance(node, ast.FunctionDef | ast.ClassDef)
        and node.lineno <= line <= last_line(node)
    }
    for entry in known("proposal"):
        names = entry.get("names")
        if entry["file"] == path and (names is None or around.intersection(names)):
            return str(entry["why"])
    return None


def reason_of_kind(was: str, becomes: str) -> str | None:
    """Why a change of such a line need not be killed; None for lines of no kind.

    A kind with ``apart`` has changes of what that pattern matches alone.
    """
    for kind in known("kind"):
        apart = kind.get("apart")
        is_such = apart is None or re.sub(apart, "", was) == re.sub(apart, "", becomes)
        if re.match(kind["pattern"], was) and is_such:
            return str(kind["why"])
    return None


def reason(mutation: Mutation) -> str | None:
    """Why a mutation need not be killed."""
    was, becomes = mutation.difference
    why = reason_of_kind(was, becomes)
    if why:
        return why
    line, _ = mutation.at
    before = [x.strip() for x in source(mutation.path).splitlines()[: line - 1]]
    for entry in known():
        change = mutation.path, was, becomes, before[-1:]
        after = [entry["after"]] if "after" in entry else before[-1:]
        if (entry["file"], entry["was"], entry.get("becomes", becomes), after) == change:
            return str(entry["why"])
    return None
