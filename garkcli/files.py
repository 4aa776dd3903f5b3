"""Files: read within limits, distinguished from streams, resolved through links."""

from __future__ import annotations

import os
import re
import stat
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar

from garkcli.doing import hush
from garkcli.terminal import is_terminal

STDIN = "-"
_OWN_STREAM = r"/dev/(?:fd/)?(\d{1,9}|stdin|stdout|stderr)|/proc/self/fd/(\d{1,9})"
_NAMED = {"stdin": 0, "stdout": 1, "stderr": 2}
_inputs: ContextVar[set[tuple[int, int]] | None] = ContextVar("inputs", default=None)


class NotAFile(OSError):
    """A folder, a named pipe, a device, a socket."""

    def __init__(self) -> None:
        super().__init__(0, "not a regular file")


def own_stream(path: str) -> int | None:
    """Returns the descriptor of this process that a path means, or None.

    >>> own_stream("/dev/fd/63"), own_stream("/dev/stdin"), own_stream("m.yaml")
    (63, 0, None)
    """
    whole = os.path.normpath(path).replace(os.sep, "/")
    found = re.fullmatch(_OWN_STREAM, whole) if whole.startswith("/") else None
    if found is None:
        return None
    word = found[1] or found[2]
    return _NAMED[word] if word in _NAMED else int(word)


def is_stream(path: str) -> bool:
    return path == STDIN or own_stream(path) is not None


def read_bytes(path: str, most: int) -> bytes:
    """Returns at most ``most`` bytes and one more.

    Raises NotAFile for other devices and pipes, which may never end or begin; OSError if it cannot
    be read, ValueError if no file has such a name.
    """
    note_input(path)
    if path == STDIN:
        if sys.stdin is None:
            raise OSError(0, "standard input is closed")
        if is_terminal(sys.stdin):
            hush()  # somebody types
        return sys.stdin.buffer.read(most + 1)
    return begin_of(path, most + 1)


def begin_of(path: str, most: int) -> bytes:
    """Returns the first bytes as ``read_bytes`` does, without noting an input."""
    is_named = own_stream(path) is not None
    if not is_named and not stat.S_ISREG(os.stat(path).st_mode):
        raise NotAFile
    descriptor = os.open(path, os.O_RDONLY | _BINARY | (0 if is_named else _AT_ONCE))
    try:
        status = os.fstat(descriptor)  # another one may have come since
        if not is_named and not stat.S_ISREG(status.st_mode):
            raise NotAFile
        # no more than there is: to clear a megabyte takes longer than to read most files
        size = min(status.st_size, most) if stat.S_ISREG(status.st_mode) else most
        data = _read(descriptor, min(size + 1, most))
        # it may have grown, or be one whose size no system knows
        return data + _read(descriptor, most - len(data)) if len(data) > size else data
    except BlockingIOError:  # such as /proc/kmsg, which passes for a file
        raise NotAFile from None
    finally:
        os.close(descriptor)


_BINARY = getattr(os, "O_BINARY", 0)
_AT_ONCE = getattr(os, "O_NONBLOCK", 0)
"""A file without data yet fails at once; systems without the flag have no such files."""
_BLOCK = 2**20


def _read(descriptor: int, most: int) -> bytes:
    blocks = []
    while block := os.read(descriptor, min(most, _BLOCK)):
        blocks.append(block)
        most -= len(block)
    return b"".join(blocks)


@contextmanager
def noting_inputs() -> Iterator[None]:
    """Notes files that are read inside, so that none is overwritten."""
    before = _inputs.set(set())
    try:
        yield
    finally:
        _inputs.reset(before)


def note_input(path: str) -> None:
    known = _inputs.get()
    if known is None:
        return
    with suppress(OSError, ValueError, AttributeError):  # it may be missing, or no stream at all
        status = os.fstat(sys.stdin.fileno()) if path == STDIN else os.stat(path)
        if stat.S_ISREG(status.st_mode):
            known.add((status.st_dev, status.st_ino))


def is_input(status: os.stat_result) -> bool:
    known = _inputs.get()
    return known is not None and (status.st_dev, status.st_ino) in known


def is_inside(path: str, folder: str) -> bool:
    place, root = os.path.realpath(path), os.path.realpath(folder)
    try:
        return os.path.commonpath([place, root]) == root
    except ValueError:  # on other drives
        return False


def leads_away(path: str, folder: str) -> bool:
    """Whether a file below a folder is a link out of it, and out of the current folder."""
    return not is_inside(path, folder) and not is_inside(path, os.curdir)


def is_elsewhere(path: str) -> bool:
    """Whether a link leads a file out of the current folder, or of that in its path."""
    is_here = os.path.abspath(path).startswith(os.path.join(os.path.abspath(os.curdir), ""))
    return leads_away(path, os.curdir if is_here else os.path.dirname(path))
