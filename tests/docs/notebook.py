"""Notebooks as text: their cells are run in one session, and compared with what stands below."""

from __future__ import annotations

import ast
import re
from contextlib import redirect_stdout
from dataclasses import dataclass
from io import StringIO
from typing import Any

CELL = re.compile(
    r"^```\{code-cell\} python\n(?P<code>.*?)^```\n(?:\n```text\n(?P<shown>.*?)^```\n)?",
    re.DOTALL | re.MULTILINE,
)


@dataclass(frozen=True)
class Cell:
    """A cell with what the page says that it shows.

    Attributes:
        code: the statements.
        shown: the text below it; empty where there is none.
    """

    code: str
    shown: str


def cells(text: str) -> list[Cell]:
    """The cells of a page in order."""
    return [Cell(x["code"], x["shown"] or "") for x in CELL.finditer(text)]


def run(cell: Cell, session: dict[str, Any]) -> str:
    """What a cell prints, and the value of its last expression, as a session shows it.

    Args:
        cell: to run.
        session: the names of the cells before, to which its own are added.
    """
    *before, last = ast.parse(cell.code).body
    printed = StringIO()
    with redirect_stdout(printed):
        if not isinstance(last, ast.Expr):
            before.append(last)
        _execute(ast.Module(before, []), session)
        if isinstance(last, ast.Expr):
            code = compile(ast.Expression(last.value), "<cell>", "eval")
            value = eval(code, session)
            if value is not None:
                print(repr(value))
    return printed.getvalue()


def _execute(module: ast.Module, session: dict[str, Any]) -> None:
    exec(compile(module, "<cell>", "exec"), session)


def brought_up_to_date(text: str, results: list[str]) -> str:
    """The page with what its cells show now."""
    shown = iter(results)

    def with_result(match: re.Match[str]) -> str:
        cell = "```{code-cell} python\n" + match["code"] + "```\n"
        result = next(shown)
        return f"{cell}\n```text\n{result}```\n" if result else cell

    return CELL.sub(with_result, text)
