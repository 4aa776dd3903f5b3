"""Sources and their texts: files, folders, standard input."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from pathlib import PurePath

from garkcli.bridges.readers.registry import suffixes
from garkcli.errors import UsageProblem, printable
from garkcli.files import STDIN, NotAFile, leads_away, read_bytes
from garkcli.methodfile.folders import no_one
from garkcli.sources.found import MAX_CHARACTERS

STDIN_NAME = "<stdin>"
MAX_FILES = 100_000


def source_files(paths: Iterable[str], told: Callable[[str], None] = no_one) -> Iterator[str]:
    """The files of ``paths``: of a folder all that some reader reads, in order.

    Hidden files and folders are left out, and links to folders are not followed. Files of a folder
    that cannot be read, and links out of it, are skipped, with the reason for ``told``.
    """
    for path in paths:
        if path == STDIN or not os.path.isdir(path):
            yield path
            continue
        for count, file in enumerate(_below(path)):
            if count == MAX_FILES:
                told(f"{printable(path)} has more than {MAX_FILES} files: the rest is left out")
                break
            reason = _why_not(file, path)
            if reason:
                told(f"{printable(file)} is left out: {reason}")
            else:
                yield file


def _why_not(path: str, folder: str) -> str:
    try:
        size = os.stat(path).st_size
    except OSError as error:
        return str(error.strerror)
    if not os.path.isfile(path):
        return "it is no ordinary file"
    if not os.access(path, os.R_OK):
        return "it is protected"
    if leads_away(path, folder):
        return f"it is a link out of {printable(folder)}"
    if size > MAX_CHARACTERS:
        return f"it has more than {MAX_CHARACTERS} bytes"
    return ""


def _below(folder: str) -> Iterator[str]:
    known = suffixes()
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(x for x in folders if not x.startswith("."))
        for name in sorted(files):
            if not name.startswith(".") and PurePath(name).suffix.lower() in known:
                yield os.path.join(place, name)


def source_text(path: str) -> tuple[str, str]:
    """Returns a source and its name; bytes other than UTF-8 are replaced. Raises UsageProblem if it
    is unreadable or too long.
    """
    name = STDIN_NAME if path == STDIN else path
    try:
        data = read_bytes(path, MAX_CHARACTERS)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "no file has such a name"
        message = f"{name} cannot be read: {reason}"
        more = ", or - for standard input" if isinstance(error, NotAFile) else ""
        raise UsageProblem(message, f"name a file or a folder{more}", code="cannot-read") from None
    if len(data) > MAX_CHARACTERS:
        message = f"{name} has more than {MAX_CHARACTERS} bytes"
        raise UsageProblem(message, "give the part with the tables", code="file-too-large")
    return data.decode("utf-8-sig", errors="replace"), name
