"""The texts of files within limits."""

from __future__ import annotations

import os
import re
from itertools import islice

from garkcli.errors import MethodFileError, Remark, nearest, printable
from garkcli.files import STDIN, NotAFile, is_elsewhere, is_stream, read_bytes
from garkcli.glossary.key import FileKind
from garkcli.grammar.source import MAX_BYTES

MOST_COMPARED = 1_000
MOST_SHOWN = 4


def read_text(path: str, kind: FileKind) -> tuple[str, str]:
    """The text and name of a file, or of standard input for ``-``; MethodFileError without text."""
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
    if is_elsewhere(path):
        message = f"a link to a file elsewhere, which has no key of a {kind.name}"
        return Remark(message, "name the file that is meant", code="elsewhere")
    message = f"no key of a {kind.name} is in this file, and its name has no ending"
    return Remark(message, f"{kind.start} or call it something.yaml", code="elsewhere")


def _may_be_quoted(path: str, text: str, kind: FileKind) -> bool:
    """A quoted file has a key of its kind, or an ending and no link to elsewhere: a path chosen by
    someone else must not reveal secrets.
    """
    if not is_elsewhere(path) and os.path.splitext(path)[1]:
        return True
    keys = "|".join(kind.keys)
    pattern = rf"^(?:\{{[ \t]*)?(?:(?:{keys})|'(?:{keys})'|[ \t]*\"(?:{keys})\")[ \t]*:"
    return re.search(pattern, text, re.MULTILINE) is not None


def _cure_of_missing(path: str) -> str:
    """The file of nearly the same name in the folder."""
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
    """Returns a text; MethodFileError if it is too long or not UTF-8."""
    if len(data) > MAX_BYTES:
        message = f"a file of more than {MAX_BYTES} bytes"
        raise MethodFileError(name, [Remark(message, "split it", 1, 1, code="file-too-large")])
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        fault = Remark("not UTF-8 text", "save the file as UTF-8", line, 1, code="not-utf8")
        raise MethodFileError(name, [fault]) from None
