"""Which sources are meant, and their text: files, folders, standard input."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import PurePath

from garkcli.bridges.readers.found import MAX_CHARACTERS
from garkcli.bridges.readers.registry import suffixes
from garkcli.doing import hush
from garkcli.errors import UsageProblem, printable

STDIN = "-"
STDIN_NAME = "<stdin>"
MAX_FILES = 100_000
"""Most files of a source tree that are looked at."""


def _no_one(text: str) -> None:
    del text


def source_files(paths: Iterable[str], told: Callable[[str], None] = _no_one) -> Iterator[str]:
    """The files meant by ``paths``: of a folder all that some reader reads, in order.

    Hidden files and folders are left out, and links to folders are not followed. A file of a folder
    that cannot be read is no reason to read none.

    Args:
        paths: files and folders.
        told: who is told of files of a folder that are left out, and why.
    """
    for path in paths:
        if path == STDIN or not os.path.isdir(path):
            yield path
            continue
        for file in _below(path):
            reason = _why_not(file)
            if reason:
                told(f"{printable(file)} is left out: {reason}")
            else:
                yield file


def _why_not(path: str) -> str:
    """Why a file of a folder is not read; empty where it is."""
    try:
        size = os.stat(path).st_size
    except OSError as error:
        return str(error.strerror)
    if not os.path.isfile(path):
        return "it is no ordinary file"
    if not os.access(path, os.R_OK):
        return "it is protected"
    if size > MAX_CHARACTERS:
        return f"it has more than {MAX_CHARACTERS} bytes"
    return ""


def _below(folder: str) -> Iterator[str]:
    known = suffixes()
    count = 0
    for place, folders, files in os.walk(folder):
        folders[:] = sorted(x for x in folders if not x.startswith("."))
        for name in sorted(files):
            is_known = PurePath(name).suffix.lower() in known
            if name.startswith(".") or not is_known:
                continue
            yield os.path.join(place, name)
            count += 1
            if count >= MAX_FILES:
                return


def source_text(path: str) -> tuple[str, str]:
    """The text of a source and what it is called; bytes that are no UTF-8 do no harm.

    Raises:
        UsageProblem: it cannot be read, or is too long.
    """
    name = STDIN_NAME if path == STDIN else path
    try:
        data = _bytes(path)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "no file has such a name"
        message = f"{name} cannot be read: {reason}"
        raise UsageProblem(message, "name a file or a folder") from None
    if len(data) > MAX_CHARACTERS:
        message = f"{name} has more than {MAX_CHARACTERS} bytes"
        raise UsageProblem(message, "give the part with the tables")
    return data.decode("utf-8-sig", errors="replace"), name


def _bytes(path: str) -> bytes:
    if path != STDIN:
        with open(path, "rb") as stream:
            return stream.read(MAX_CHARACTERS + 1)
    if sys.stdin is None:
        raise UsageProblem("standard input is closed", "name a file")
    if sys.stdin.isatty():
        hush()  # somebody types
    return sys.stdin.buffer.read(MAX_CHARACTERS + 1)
