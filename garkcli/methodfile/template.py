"""New method files, with comments that explain them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

from garkcli.families.registry import FAMILIES
from garkcli.frozen import Frozen
from garkcli.grammar.editing import quoted
from garkcli.methodfile.file_keys import KEYS
from garkcli.methodfile.pasted import Pasted

HEAD = (
    "# gark check FILE proves the claims under expect; gark claims FILE --write",
    "# renews them; gark explain WORD says what a key means.",
)
_MEANS = re.compile("[;:.]")


class Member(Frozen):
    family: str
    size: int | None

    def __str__(self) -> str:
        if self.size is None:
            return f"{{family: {self.family}}}"
        known = FAMILIES.get(self.family)
        return f"{{family: {self.family}, {known.size if known else 'stages'}: {self.size}}}"


Values: TypeAlias = Mapping[str, str | Sequence[str]]
"""The values of keys: a text in its line, or the items of a list below it."""


def new_file(values: Values) -> str:
    return "\n".join([*HEAD, *_lines(values), ""])


def _lines(values: Values) -> Iterator[str]:
    for key in (key for name, key in KEYS.items() if name in values):
        value, meaning = values[key.name], _MEANS.split(key.text, maxsplit=1)[0]
        comment = f"# {meaning[0].lower()}{meaning[1:]}"
        if isinstance(value, str):
            yield f"{key.name}: {value}" + (f"  {comment}" if key.name != "name" else "")
        else:
            yield from (comment, f"{key.name}:", *(f"  - {item}" for item in value))


def of_tableau(name: str, pasted: Pasted) -> str:
    rows = {"b": pasted.b, "c": pasted.c, "embedded": pasted.embedded}
    given = {key: _row(row) for key, row in rows.items() if row is not None}
    return new_file({"name": quoted(name), "A": [_row(row) for row in pasted.A], **given})


def of_families(name: str, members: Sequence[Member], transfer: str) -> str:
    between = {"transfer": transfer} if len(members) > 1 else {}
    return new_file({"name": quoted(name), "methods": [*map(str, members)], **between})


def _row(numbers: Sequence[str]) -> str:
    """Quoted if YAML would split them."""
    return f"[{', '.join(map(_entry, numbers))}]"


def _entry(text: str) -> str:
    is_plain = all(x.isalnum() or x in "/.+-*^() _" for x in text)
    return text if is_plain else quoted(text)
