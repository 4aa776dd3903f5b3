"""The files that arguments stand for: folders, patterns, names.

Places that cannot be searched are kept and reported.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from fnmatch import fnmatchcase

from garkcli.files import STDIN, leads_away
from garkcli.methodfile.folders import files_below, no_one, within
from garkcli.methodfile.naming import PREFIX, expanded, is_both

_MAGIC = frozenset("*?[")


def find_files(paths: Iterable[str], told: Callable[[str], None] = no_one) -> Iterator[str]:
    """Yields the files that ``paths`` stand for, in order.

    A folder stands for all method files below it, a pattern such as ``**/*.yaml`` for its matches,
    ``catalogue:`` for all methods of the catalogue and ``catalogue:FOLDER`` for a folder of it;
    names stay as they are. An argument without files stays too, to be reported as missing, as does
    a folder that cannot be searched. Links to folders are not followed, because they may lead back.
    Links to files elsewhere are left out; ``told`` is called with a message about them.
    """
    for path in paths:
        if path == STDIN:
            yield path
        elif os.path.isdir(path):
            # a folder that is called as a method is reported where it is read
            yield from [path] if is_both(path) else files_below(path, told) or [path]
        elif path.startswith(PREFIX):
            yield from expanded(path) or [path]
        elif _MAGIC & set(path) and not os.path.lexists(path):
            yield from _matching(path, told) or [path]
        else:
            yield path


def _matching(pattern: str, told: Callable[[str], None]) -> list[str]:
    """Returns the matches of a pattern, in which ``**`` stands for folders of any depth; a folder
    that matches stands for the files below it.
    """
    from pathlib import Path

    path = Path(pattern)
    start = path.anchor
    whole = path.parts[1:] if start else path.parts
    # in a row they say no more than one
    parts = [x for x, then in zip(whole, (*whole[1:], ""), strict=True) if not x == then == "**"]
    found: set[str] = set()
    root = fixed_part(pattern)
    for match in _expanded(start, parts, root):
        if os.path.isdir(match) and not leads_away(match, root):
            found.update(files_below(match, told))
        else:
            found.add(match)
    return within(sorted(found), root, told)


def fixed_part(pattern: str) -> str:
    """Returns the folder with which a pattern begins; a path without wildcards is returned whole.

    >>> fixed_part("methods/**/*.yaml"), fixed_part("methods/rk4.yaml"), fixed_part("*.yaml")
    ('methods', 'methods/rk4.yaml', '')
    """
    fixed = pattern
    while _MAGIC & set(fixed):
        fixed = os.path.dirname(fixed)
    return fixed


def _expanded(place: str, parts: Sequence[str], root: str) -> Iterator[str]:
    """Yields all matches below a place. A link out of ``root`` is a match itself and is not
    followed.
    """
    if not parts or (os.path.islink(place) and leads_away(place, root)):
        if os.path.lexists(place):
            yield place
        return
    part, rest = parts[0], parts[1:]
    if part == "**":
        for folder in _folders(place):
            yield from _expanded(folder, rest or ("*",), root)
    elif _MAGIC & set(part):
        for name in _names(place):
            # a hidden one has to be requested
            is_shown = part.startswith(".") or not name.startswith(".")
            if is_shown and fnmatchcase(name, part):
                yield from _expanded(os.path.join(place, name), rest, root)
    else:
        yield from _expanded(os.path.join(place, part), rest, root)


def _folders(place: str) -> Iterator[str]:
    """Yields a folder and all folders below it except hidden ones; empty for the current one."""
    for folder, below, _ in os.walk(place or "."):
        # os.walk goes on with what is left in the list
        below[:] = [name for name in below if not name.startswith(".")]
        inside = folder if place else os.path.relpath(folder)
        yield "" if inside == "." else inside


def _names(folder: str) -> list[str]:
    try:
        return os.listdir(folder or ".")
    except OSError:
        return []
