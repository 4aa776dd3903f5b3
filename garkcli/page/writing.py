"""Files that are written whole or not at all."""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from garkcli.ending import undone
from garkcli.errors import UsageProblem
from garkcli.files import is_input, note_input, own_stream

_MOST_LINKS = 40
"""Most links in a path, as on Linux."""


def write_whole(path: str, pieces: Iterable[str | bytes], is_renewed: bool = False) -> bool:
    """Writes a file beside its place, then renames it into place; False for devices and streams.

    A link stays a link; an existing file keeps its permissions, owner and group. Devices, streams,
    and files with several names or another owner are written in place. With ``is_renewed`` it may
    be a file that was read. Raises UsageProblem, with nothing changed, if it cannot be written or
    is an input.
    """
    with _writing(path), undone():
        target = _without_links(path)
        stream = own_stream(str(target))
        before = None if stream is not None else _status(target)
        if before is not None and not is_renewed:
            _refuse_input(path, before)
        if stream is not None:
            sys.stdout.flush()
            with os.fdopen(os.dup(stream), "wb") as opened:
                opened.writelines(_encoded(pieces))
        elif before is None:
            _replace(target, _encoded(pieces), 0o666 & ~_umask())
        elif stat.S_ISREG(before.st_mode) and before.st_nlink == 1 and _can_replace(target, before):
            _refuse_protected(target)
            _replace(target, _encoded(pieces), stat.S_IMODE(before.st_mode))
        else:
            _write_through(target, pieces, stat.S_ISREG(before.st_mode))
        if not is_renewed:
            note_input(str(target))  # another report of the command has no place there either
    return stream is None and (before is None or stat.S_ISREG(before.st_mode))


def refuse_unwritable(path: str) -> None:
    """Raises UsageProblem, before any work, for a file that cannot be written or is an input."""
    if not path:
        message = "the name of the file to be written is empty"
        raise UsageProblem(message, "name a file", code="cannot-write")
    with _writing(path):
        target = _without_links(path)
        if own_stream(str(target)) is not None:
            return
        if target.is_dir():
            raise IsADirectoryError(0, "it is a folder")
        before = _status(target)
        if before is not None:
            _refuse_input(path, before)
            _refuse_protected(target)
            return
        if not target.parent.is_dir():
            raise FileNotFoundError(0, "there is no such folder")
        if not os.access(target.parent, os.W_OK):
            raise PermissionError(0, "the folder is protected")


@contextmanager
def _writing(path: str) -> Iterator[None]:
    try:
        yield
    except BrokenPipeError:
        raise
    except OSError as error:
        why = error.strerror or str(error)
        message = f"cannot write {path}: {why}"
        raise UsageProblem(message, "choose another place", code="cannot-write") from None


def _refuse_input(path: str, status: os.stat_result) -> None:
    """Raises UsageProblem for a file that was read or has just been written, by any name."""
    if is_input(status):
        message = f"cannot write {path}: the command reads it, or has just written it"
        raise UsageProblem(message, "choose another place", code="cannot-write")


def _without_links(path: str) -> Path:
    """Returns the target of a path; streams of this process, which are links, are unchanged."""
    target = Path(path)
    for _ in range(_MOST_LINKS):
        if own_stream(str(target)) is not None or not target.is_symlink():
            return target
        target = target.parent / target.readlink()
    raise OSError(0, "too many links")


def _status(target: Path) -> os.stat_result | None:
    try:
        return target.stat()
    except FileNotFoundError:
        return None


def _refuse_protected(target: Path) -> None:
    if not os.access(target, os.W_OK):
        raise PermissionError(0, "the file is protected")


def _can_replace(target: Path, before: os.stat_result) -> bool:
    """Returns whether a new file in the folder gets the owner and the group of the existing one."""
    if not hasattr(os, "geteuid"):
        return True
    folder = target.parent.stat()
    # in such a folder a new file has the group of the folder
    group = folder.st_gid if folder.st_mode & stat.S_ISGID else os.getegid()
    return (before.st_uid, before.st_gid) == (os.geteuid(), group)


def _umask() -> int:
    umask = os.umask(0)
    os.umask(umask)
    return umask


def _encoded(pieces: Iterable[str | bytes]) -> Iterator[bytes]:
    for piece in pieces:
        yield piece.encode("utf-8") if isinstance(piece, str) else piece


def _write_through(target: Path, pieces: Iterable[str | bytes], is_file: bool) -> None:
    data = _encoded(pieces)
    if is_file:
        data = iter([b"".join(data)])
    # nothing is made: systems refuse that, in folders that all may write to, beside files of others
    flags = os.O_WRONLY | os.O_TRUNC | getattr(os, "O_BINARY", 0)
    with os.fdopen(os.open(target, flags), "wb") as opened:
        opened.writelines(data)


def _replace(target: Path, pieces: Iterable[bytes], mode: int) -> None:
    with _temporary(target) as (stream, temporary):
        stream.writelines(pieces)
        stream.close()
        temporary.chmod(mode)
        temporary.replace(target)


@contextmanager
def _temporary(target: Path) -> Iterator[tuple[BinaryIO, Path]]:
    """Opens a file in the folder of ``target`` that is removed at the end in any case."""
    import tempfile

    # the name of the target may fill what a name may have
    handle, name = tempfile.mkstemp(prefix=".gark-", dir=target.parent)
    stream = os.fdopen(handle, "wb")
    try:
        yield stream, Path(name)
    finally:
        # after a failed write the rest cannot be written either
        with suppress(OSError):
            stream.close()
        with suppress(OSError):
            Path(name).unlink()
