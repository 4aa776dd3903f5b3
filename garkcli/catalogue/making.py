"""The index of the package, made from its method files: the same bytes on every machine."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from garkcli.catalogue.facts import VERSION, Entry, NoMethod, blank, digest, entry_of
from garkcli.methodfile.file_kind import METHOD_FILE
from garkcli.methodfile.folders import SUFFIX
from garkcli.methodfile.reading import read_text
from garkcli.methodfile.shelves import key_of

Tell = Callable[[str], None]
"""What is told of each file that is judged."""


def method_files(data: Path) -> list[tuple[str, Path]]:
    """The method files below a folder, by their names.

    Raises:
        NoMethod: two have one name, or a name is not as names are.
    """
    found: dict[str, Path] = {}
    for path in data.rglob(f"*{SUFFIX}"):
        name = path.name.removesuffix(SUFFIX)
        if name != key_of(name):
            cure = f"{key_of(name)}{SUFFIX} would be its name"
            raise NoMethod(f"{path} is not named as methods are", cure, code="name-taken")
        if name in found:
            message = f"{found[name]} and {path} have one name"
            raise NoMethod(message, "keep one of them, or rename it", code="name-in-doubt")
        found[name] = path
    return sorted(found.items())


def made(data: Path, before: str, tell: Tell) -> str:
    """The text of the index.

    Args:
        data: the folder of the method files.
        before: the text of an index of theirs, perhaps older, out of which entries are kept whose
            files are as they were; empty for none.
        tell: is called with the name of each method that is judged.

    Raises:
        NoMethod: a file is no method, or a claim of it fails.
    """
    known = _known(before)
    entries = []
    for name, path in method_files(data):
        text, _ = read_text(str(path), METHOD_FILE)
        file = path.relative_to(data).as_posix()
        entry = known.get((file, digest(text)))
        if entry is None:
            tell(name)
            entry = entry_of(str(path), name, file, text)
        entries.append(entry)
    return "".join(_text(entries))


def _known(before: str) -> dict[tuple[str, str], Entry]:
    """The entries of an index by their files and the texts that they were made from; those without
    a property that there is now are left out.
    """
    index: dict[str, Any] = json.loads(before) if before else {}
    if index.get("facts") != VERSION:
        return {}
    fields = blank().keys()
    return {(x["file"], x["digest"]): x for x in index["methods"] if x.keys() >= fields}


def _text(entries: list[Entry]) -> Iterator[str]:
    """JSON with an entry a line, so that a change of one method is a change of one line."""
    yield f'{{"facts": {VERSION}, "methods": ['
    for number, entry in enumerate(entries):
        yield ",\n" if number else "\n"
        yield json.dumps(entry, ensure_ascii=True)
    yield "\n]}\n"


def update_copies(data: Path, copies: Path) -> Iterator[Path]:
    """Make the copies that a folder has of methods of the catalogue what these are.

    Args:
        data: the folder of the catalogue.
        copies: a folder with copies of some of its files.

    Yields:
        each copy that was changed.
    """
    originals = dict(method_files(data))
    for copy in sorted(copies.rglob(f"*{SUFFIX}")):
        original = originals.get(copy.name.removesuffix(SUFFIX))
        if original is None:
            continue
        content = original.read_bytes()
        if copy.read_bytes() != content:
            copy.write_bytes(content)
            yield copy
