"""From a path to the text of a file, within limits."""

from __future__ import annotations

import os
import stat
import sys
from itertools import islice

from garkcli.doing import hush
from garkcli.errors import Fault, MethodFileError, nearest, printable
from garkcli.methodfile.file_kind import FileKind
from garkcli.methodfile.folders import STDIN
from garkcli.methodfile.source import MAX_BYTES

MOST_COMPARED = 1_000
"""Files of a folder that a missing name is compared with."""
MOST_SHOWN = 4
"""Files of a folder that are named in place of a missing one."""


def read_text(path: str, kind: FileKind) -> tuple[str, str]:
    """The text of a file, or of standard input for ``-``, and what to call it.

    Raises:
        MethodFileError: there is no such file, or no such text in it.
    """
    if path == STDIN:
        if sys.stdin is None:
            raise MethodFileError("<stdin>", [Fault("standard input is closed", "name a file")])
        if sys.stdin.isatty():
            hush()  # somebody types
        return decoded("<stdin>", sys.stdin.buffer.read(MAX_BYTES + 1)), "<stdin>"
    try:
        status = os.stat(path)
    except FileNotFoundError:
        fault = Fault("no such file", _cure_of_missing(path))
        raise MethodFileError(path, [fault]) from None
    except ValueError:
        fault = Fault("no file has such a name", "leave out what is no text")
        raise MethodFileError(path, [fault]) from None
    except OSError as error:  # among them names that are too long, and links in a circle
        fault = Fault(f"cannot be read: {error.strerror}")
        raise MethodFileError(path, [fault]) from None
    if not stat.S_ISREG(status.st_mode):
        fault = Fault("not a regular file", f"give a {kind.name}")
        raise MethodFileError(path, [fault])
    try:
        with open(path, "rb") as stream:
            # no more than there is: to clear a megabyte takes longer than to read most files
            size = min(status.st_size, MAX_BYTES)
            data = stream.read(size + 1)
            # it may have grown, or be one whose size no system knows
            if len(data) > size:
                data += stream.read(MAX_BYTES - size)
    except OSError as error:
        fault = Fault(f"cannot be read: {error.strerror}")
        raise MethodFileError(path, [fault]) from None
    return decoded(path, data), path


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
        raise MethodFileError(
            name, [Fault(f"a file of more than {MAX_BYTES} bytes", "split it", 1, 1)]
        )
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data[: error.start].count(b"\n") + 1
        raise MethodFileError(
            name, [Fault("not UTF-8 text", "save the file as UTF-8", line, 1)]
        ) from None
