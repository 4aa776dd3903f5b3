"""Notebooks of Jupyter: the cells of code, in the language of their kernel."""

from __future__ import annotations

import json
import re
from bisect import bisect_left
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from garkcli.frozen import replace
from garkcli.sources.found import FoundTable, Reader
from garkcli.sources.languages import c, julia, matlab, python

NAME = "notebook"
_LANGUAGES = {
    "python": python.find,
    "julia": julia.find,
    **dict.fromkeys(("octave", "matlab"), matlab.find),
    **dict.fromkeys(("c", "c++", "cpp"), c.find),
}
_MAGIC = re.compile(r"[ \t]*[%!?]")
"""The beginning of a line for the kernel."""


def find(text: str, source: str) -> list[FoundTable]:
    """The tables in the cells of a notebook; their lines are those of the file."""
    try:
        notebook = json.loads(text)
    except (ValueError, RecursionError):
        return []
    read = _LANGUAGES.get(_language(notebook))
    if read is None:
        return []
    has_magic = read is python.find
    lines = list(_lines(notebook))
    plain = ["" if has_magic and _MAGIC.match(x) else x for x, _ in lines]
    code = "\n".join(_placed(lines, plain, text.split("\n")))
    return [replace(x, format=NAME) for x in read(code, source)]


def _language(notebook: object) -> str:
    """The language of the kernel, in lower case; Python by default."""
    about = _part(notebook, "metadata")
    language = _part(_part(about, "kernelspec"), "language") or _part(
        _part(about, "language_info"), "name"
    )
    return str(language or "python").lower()


def _part(of: object, name: str) -> Any:
    return of.get(name) if isinstance(of, Mapping) else None


def _lines(notebook: object) -> Iterator[tuple[str, str]]:
    """The lines of all cells of code, each with its text in the file."""
    cells = _part(notebook, "cells")
    for cell in cells if isinstance(cells, list) else ():
        source = _part(cell, "source")
        if _part(cell, "cell_type") == "code":
            # a cell is a list of lines, or one text
            for text in source if isinstance(source, list) else [source]:
                first, *more = str(text).splitlines() or [""]
                yield first, str(text)
                yield from ((x, x) for x in more)


def _placed(
    lines: Sequence[tuple[str, str]], plain: Iterable[str], file: Iterable[str]
) -> list[str]:
    """The lines of code at their lines in the file, others behind the one before."""
    places: dict[str, list[int]] = {form: [] for _, x in lines for form in _forms(x)}
    for i, each in enumerate(file):
        form = each.strip().removesuffix(",").removeprefix('"source": ').strip("[]")
        if form in places:
            places[form].append(i)
    placed: list[str] = []
    for (_, text), code in zip(lines, plain, strict=True):
        known = [x for form in _forms(text) for x in _from(places[form], len(placed))]
        placed += [""] * (min(known, default=len(placed)) - len(placed))
        placed.append(code)
    return placed


def _from(places: Sequence[int], first: int) -> Sequence[int]:
    """The first of some places at or after another, in a list."""
    at = bisect_left(places, first)
    return places[at : at + 1]


def _forms(text: str) -> tuple[str, str]:
    """The possible forms of a text in a file."""
    return json.dumps(text), json.dumps(text, ensure_ascii=False)


READER = Reader(
    NAME,
    "notebooks of Jupyter: their code in Python, Julia, Octave or C++",
    (".ipynb",),
    find,
    tuple(sorted({x for read in (python, julia, matlab, c) for x in read.READER.grammars})),
)
