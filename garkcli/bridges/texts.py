"""The files of targets: the values for their templates, and the types that these may print.

Templates print texts and integers only: the name of a method is an identifier, and remarks about
it are comments already.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from functools import cache
from pathlib import PurePath
from typing import TYPE_CHECKING, Any, TypeAlias

from garkcli.bridges.comments import BANG, HASH, PERCENT, STARRED, XML, C, Comment, head
from garkcli.bridges.names import class_name, identifier
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.trials import STEPS, command_of, trial_of
from garkcli.frozen import Frozen
from garkcli.tableau.pointwise import Row

if TYPE_CHECKING:
    from jinja2 import Environment

Values: TypeAlias = Mapping[str, Any]


class Language(Frozen):
    """The format of files with an ending.

    Attributes:
        names: the reserved words, a key of ``RESERVED``.
        joint: the text between two numbers.
        continuation: the text at the end of a continued line.
    """

    comment: Comment
    names: str
    joint: str = ", "
    continuation: str = ""
    width: int = 88


_PYTHON = Language(HASH, "python")
_C = Language(C, "cpp", width=96)
_CPP = Language(C, "cpp")
LANGUAGES: Mapping[str, Language] = {
    ".R": Language(HASH, "r"),
    ".c": _C,
    ".cpp": _CPP,
    ".f90": Language(BANG, "cpp", continuation=" &", width=98),
    ".h": _C,
    ".hpp": _CPP,
    ".inputs": _PYTHON,
    ".jl": Language(HASH, "julia"),
    ".m": Language(PERCENT, "matlab", " ", " ..."),
    ".py": _PYTHON,
    ".tsv": _PYTHON,
    ".wl": Language(STARRED, "mathematica"),
    ".xml": Language(XML, "python"),
}


_OF_METHOD = (
    "stem",
    "kind",
    "size",
    "stages",
    "A",
    "b",
    "c",
    "embedded",
    "dense",
    "predictor",
    "arrays",
)


def text_of(file: str, payload: Payload, style: Style, values: Values) -> str:
    """The text made by ``templates/FILE.jinja``."""
    template = _environment().get_template(f"{file}.jinja")
    language = LANGUAGES[PurePath(file).suffix]
    left_out = values.get("left_out", ())
    return template.render(_values_for(payload, language, style, left_out), **values)


def program_values(payload: Payload, file: str, ending: str) -> Values:
    mark = LANGUAGES[ending].comment
    stem = PurePath(file).stem
    texts = {"file": file, "stem": stem, "command": command_of(payload, f"{stem}_problem.yaml")}

    def comment(*notes: str) -> str:
        return "\n".join(mark.lines(note.format(**texts) for note in notes))

    return {
        "comment": comment,
        "trial": trial_of(payload),
        "counts": STEPS,
        "file": file,
        "module": ascii(file),
        "quoted": json.dumps(file, ensure_ascii=False),
        "function": stem,
    }


def _values_for(
    payload: Payload, language: Language, style: Style, left_out: Sequence[str]
) -> dict[str, object]:
    def heading(*notes: object) -> str:
        wanted = [str(note) for note in notes if note]
        if left_out:
            wanted.append(f"Left out: {', '.join(left_out)}.")
        return "\n".join(language.comment.lines(head(payload, *wanted)))

    def texts(cells: Row, *before: object) -> list[str]:
        return [*map(str, before), *payload.numbers(cells, style)]

    def listed(begin: str, items: Sequence[str], end: str) -> str:
        return "\n".join(filled(language, begin, items, end))

    def row(begin: str, cells: Row, end: str) -> str:
        return listed(begin, texts(cells), end)

    def matrix(
        begin: str, rows: Sequence[Row], end: str, last: str | None = None, then: str | None = None
    ) -> str:
        """Lines for rows; the last may end differently, those after the first begin differently."""
        begins = [begin, *[begin if then is None else then] * (len(rows) - 1)]
        ends = [*[end] * (len(rows) - 1), end if last is None else last]
        return "\n".join(map(row, begins, rows, ends))

    orders = payload.orders
    return {
        "heading": heading,
        "texts": texts,
        "listed": listed,
        "row": row,
        "matrix": matrix,
        "name": identifier(payload.name, language.names),
        "class_name": class_name(payload.name, language.names),
        "order": orders.order,
        "effective": orders.effective,
        "embedded_order": orders.embedded,
        **{name: getattr(payload, name) for name in _OF_METHOD},
    }


def filled(language: Language, begin: str, items: Sequence[str], end: str) -> list[str]:
    """A list in as few lines as hold it, indented to the first item; long items have their own.

    >>> filled(Language(HASH, "python", width=12), "x = [", ["1", "22", "333"], "]")
    ['x = [1, 22,', '     333]']
    """
    room = language.width - len(language.continuation)
    lines = [begin]
    for place, item in enumerate(items, start=1):
        piece = item + (end if place == len(items) else language.joint)
        if place > 1 and len(lines[-1]) + len(piece.rstrip()) > room:
            lines[-1] = lines[-1].rstrip() + language.continuation
            lines.append(" " * len(begin))
        lines[-1] += piece
    return [*lines[:-1], (lines[-1] if items else begin + end).rstrip()]


@cache
def _environment() -> Environment:
    """The templates; they write source texts, so nothing is escaped."""
    from jinja2 import Environment, PackageLoader, StrictUndefined

    return Environment(
        loader=PackageLoader("garkcli.bridges"),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        finalize=printed,
    )


def printed(value: object) -> object:
    """A text or an integer; TypeError for what a template would print in Python notation."""
    if isinstance(value, bool) or not isinstance(value, (str, int)):
        raise TypeError(f"a template prints {type(value).__name__}")
    return value
