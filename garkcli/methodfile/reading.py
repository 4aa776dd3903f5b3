"""From a path to the text of a file, within limits; the method files below a folder."""

from __future__ import annotations

import os
import re
from collections.abc import Callable
from itertools import islice

from garkcli.errors import MethodFileError, Remark, nearest, printable
from garkcli.files import STDIN, NotAFile, is_elsewhere, is_stream, leads_away, read_bytes
from garkcli.methodfile.source import MAX_BYTES, FileKind

MOST_COMPARED = 1_000
"""Files of a folder that a missing name is compared with."""
MOST_SHOWN = 4
"""Files of a folder that are named in place of a missing one."""


def read_text(path: str, kind: FileKind) -> tuple[str, str]:
    """The text of a file, or of standard input for ``-``, and what to call it.

    Raises:
        MethodFileError: there is no such file, or no such text in it.
    """
    name = "<stdin>" if path == STDIN else path
    try:
        data = read_bytes(path, MAX_BYTES)
    except FileNotFoundError:
        fault = Remark("no such file", _cure_of_missing(path), code="no-such-file")
        raise MethodFileError(path, [fault]) from None
    except ValueError:
        fault = Remark("no file has such a name", "leave out what is no text", code="no-such-file")
        raise MethodFileError(path, [fault]) from None
    except NotAFile:
        cure = f"give a {kind.name}, or - for standard input"
        fault = Remark("not a regular file", cure, code="cannot-read")
        raise MethodFileError(path, [fault]) from None
    except OSError as error:  # among them names that are too long, and links in a circle
        message, cure = f"cannot be read: {error.strerror}", "give another file, or its text by -"
        fault = Remark(message, cure, code="cannot-read")
        raise MethodFileError(name, [fault]) from None
    text = decoded(name, data)
    if not is_stream(path) and not _may_be_quoted(path, text, kind):
        raise MethodFileError(path, [_not_quoted(path, kind)])
    return text, name


def _not_quoted(path: str, kind: FileKind) -> Remark:
    """The message for a file that may hold anything."""
    if is_elsewhere(path):
        message = f"a link to a file elsewhere, which has no key of a {kind.name}"
        return Remark(message, "name the file that is meant", code="elsewhere")
    message = f"no key of a {kind.name} is in this file, and its name has no ending"
    return Remark(message, f"{kind.start} or call it something.yaml", code="elsewhere")


def _may_be_quoted(path: str, text: str, kind: FileKind) -> bool:
    """Whether errors may quote a file: it has a key of its kind, or is where it seems to be and its
    name has an ending. Whoever leads us to a file with secrets is not told what is in it.
    """
    if not is_elsewhere(path) and os.path.splitext(path)[1]:
        return True
    keys = "|".join(kind.keys)
    pattern = rf"^(?:\{{[ \t]*)?(?:(?:{keys})|'(?:{keys})'|[ \t]*\"(?:{keys})\")[ \t]*:"
    return re.search(pattern, text, re.MULTILINE) is not None


def _cure_of_missing(path: str) -> str:
    """The file that was meant, where one of its folder is called nearly so."""
    folder, name = os.path.split(path)
    try:
        with os.scandir(folder or os.curdir) as entries:
            some = (x.name for x in islice(entries, MOST_COMPARED))
            names = [name for name in some if not name.startswith(".")]
    except OSError:
        return f"there is no folder {printable(folder)}" if folder else ""
    # an ending that all have would make all names alike
    stems = {_stem(x): x for x in sorted(names)}
    near = stems.get(nearest(_stem(name), stems), "")
    if near:
        return f"did you mean {printable(os.path.join(folder, near))!r}?"
    there = sorted(x for x in names if x.endswith(".yaml"))
    if not there:
        return "no file of this folder ends in .yaml"
    shown = ", ".join(map(printable, there[:MOST_SHOWN]))
    more = ", …" if len(there) > MOST_SHOWN else ""
    return f"there are: {shown}{more}"


def _stem(name: str) -> str:
    return name.removesuffix(".yaml").removesuffix(".gark")


def decoded(name: str, data: bytes) -> str:
    """The text of a file.

    Args:
        name: what errors call it.
        data: what it holds.

    Raises:
        MethodFileError: there is too much of it, or it is no text.
    """
    if len(data) > MAX_BYTES:
        message = f"a file of more than {MAX_BYTES} bytes"
        raise MethodFileError(name, [Remark(message, "split it", 1, 1, code="file-too-large")])
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        fault = Remark("not UTF-8 text", "save the file as UTF-8", line, 1, code="not-utf8")
        raise MethodFileError(name, [fault]) from None


SUFFIX = ".gark.yaml"
"""How method files end."""


def no_one(told: object) -> None:
    """Who hears where nobody asks."""
    del told


def files_below(folder: str, told: Callable[[str], None] = no_one) -> list[str]:
    """All method files below a folder, and the folders that cannot be read, in order.

    Args:
        folder: to look in; links to folders are not followed.
        told: who hears of links that lead out of it, and are left out.
    """
    found: list[str] = []

    def keep(error: OSError) -> None:
        found.append(error.filename)

    for place, _, names in os.walk(folder, onerror=keep):
        found += [os.path.join(place, name) for name in names if name.endswith(SUFFIX)]
    # slow to import, and of no use to a check of one file
    from pathlib import Path

    # as pathlib writes them: without ./ before
    return within(sorted(str(Path(path)) for path in found), folder, told)


def within(paths: list[str], folder: str, told: Callable[[str], None]) -> list[str]:
    """Those of some paths that are no links out of a folder; who asks hears of the others."""
    kept = []
    for path in paths:
        if os.path.lexists(path) and leads_away(path, folder):
            told(f"{printable(path)} is left out: it is a link out of {printable(folder or '.')}")
        else:
            kept.append(path)
    return kept
