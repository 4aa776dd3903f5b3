"""Changed sources as a patch: a unified diff for ``patch -p1`` and ``git apply``."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Iterator, Sequence
from difflib import SequenceMatcher
from pathlib import Path

from garkcli.bridges.audit import Audited
from garkcli.bridges.fixing import Mended, mended_sources
from garkcli.page.safety import inert

AROUND = 3
_BLANK = "\t\r\n\f"
_NO_END = "\n\\ No newline at end of file\n"


def patches(found: Iterable[Audited], paths: Iterable[str]) -> Iterator[tuple[Mended, str]]:
    for mended in mended_sources(found, paths):
        yield mended, patch_of(mended.source, mended.before, mended.after)


def patch_of(source: str, before: str, after: str) -> str:
    """Returns a patch; empty if nothing changes, the path is not below the current folder, or signs
    are unsafe.
    """
    name = _name_of(source)
    if not name or before == after:
        return ""
    old, new = (_lines(text) for text in (before, after))
    pieces = [f"--- a/{name}\n", f"+++ b/{name}\n"]
    for group in SequenceMatcher(None, old, new, autojunk=False).get_grouped_opcodes(AROUND):
        first, last = group[0], group[-1]
        pieces.append(f"@@ -{_range(first[1], last[2])} +{_range(first[3], last[4])} @@\n")
        for tag, i, j, k, l in group:
            signs = ((" ", old[i:j]),) if tag == "equal" else (("-", old[i:j]), ("+", new[k:l]))
            for sign, lines in signs:
                pieces += [sign + x + ("" if x[-1] == "\n" else _NO_END) for x in lines]
    text = "".join(pieces)
    is_plain = all(x.isprintable() or x in _BLANK for x in text)
    return text if is_plain and inert(text) == text else ""


def _name_of(source: str) -> str:
    try:
        name = Path(os.path.relpath(source)).as_posix()
    except ValueError:  # on another drive
        return ""
    if name.startswith("../") or not name.isprintable() or set(name) & {'"', "\\"}:
        return ""
    # git ends such a path with a tab
    return f"{name}\t" if " " in name else name


def _lines(text: str) -> Sequence[str]:
    """Lines with their ends; a form feed ends none."""
    return re.findall(r"[^\n]*\n|[^\n]+", text)


def _range(start: int, stop: int) -> str:
    """A range of lines in the head of a hunk, from 1."""
    return f"{start + 1}" if stop - start == 1 else f"{start + 1},{stop - start}"
