"""The rows of a sweep on disk, a line of JSON each, with unique keys. After a killed process an
incomplete last line is cut off. Where the system has locks, only one process can write.
"""

from __future__ import annotations

import json
import os
import stat
from contextlib import suppress
from types import TracebackType

from garkcli.errors import UsageProblem
from garkcli.files import note_input
from garkcli.sweep.row import Row, is_row

_BLOCK = 1 << 16


class RowStore:
    """A file of rows with one writer, or UsageProblem; it gets further ones if ``is_resumed``."""

    def __init__(self, path: str, is_resumed: bool) -> None:
        self.path = path
        self.is_resumed = is_resumed
        self.rows: dict[str, Row] = {}
        try:
            self._file = os.open(path, os.O_RDWR | os.O_CREAT | _FLAGS, 0o666)
        except OSError as error:
            message = f"{path} cannot be written: {error.strerror}"
            raise UsageProblem(message, "choose another --rows", code="cannot-write") from None
        note_input(path)
        try:
            if self._is_file():
                self._lock()
                self._read(is_resumed)
        except BlockingIOError:
            os.close(self._file)
            raise self._no_file() from None
        except BaseException:
            os.close(self._file)
            raise

    def __enter__(self) -> RowStore:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        os.close(self._file)

    @property
    def refusal(self) -> UsageProblem:
        message = f"{self.path} exists"
        cure = "--resume adds the missing rows; or choose another --rows"
        return UsageProblem(message, cure, code="cannot-write")

    def _is_file(self) -> bool:
        """Returns whether the file is regular; False for the null device, which keeps nothing."""
        status = os.fstat(self._file)
        if stat.S_ISREG(status.st_mode):
            return True
        with suppress(OSError):
            if os.path.samestat(status, os.stat(os.devnull)):
                return False
        raise self._no_file()

    def _no_file(self) -> UsageProblem:
        message = f"{self.path} is not a regular file"
        return UsageProblem(message, "choose another --rows", code="cannot-read")

    def _lock(self) -> None:
        with suppress(ImportError):
            import fcntl

            try:
                # of this process alone: workers that outlive it do not keep the lock
                fcntl.lockf(self._file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except (BlockingIOError, PermissionError):
                message = f"another sweep writes to {self.path}"
                raise UsageProblem(message, "wait for it", code="cannot-write") from None
            except OSError:
                return  # a file system without locks

    def _read(self, is_resumed: bool) -> None:
        data = bytearray()
        while block := os.read(self._file, _BLOCK):
            data += block
        whole = data.rfind(b"\n") + 1
        for number, line in enumerate(bytes(data[:whole]).splitlines(), start=1):
            row = self._row(line, number)
            self.rows.setdefault(str(row["key"]), row)
        if whole < len(data):
            if not is_resumed:
                raise self.refusal
            os.ftruncate(self._file, whole)
        os.lseek(self._file, whole, os.SEEK_SET)

    def _row(self, line: bytes, number: int) -> Row:
        try:
            row = json.loads(line)
        except (ValueError, RecursionError):
            row = None
        if is_row(row):
            return row
        message = f"{self.path}, line {number}: this is not a row of a sweep"
        raise UsageProblem(message, "choose another --rows, or remove the line", code="other-file")

    def add(self, row: Row) -> None:
        """Appends a row, unless its key is present already."""
        key = str(row["key"])
        if key in self.rows:
            return
        line = memoryview(f"{json.dumps(row, ensure_ascii=False)}\n".encode())
        while line:
            line = line[os.write(self._file, line) :]
        self.rows[key] = row


_FLAGS = getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0)
"""Binary mode, and no waiting for a file without data."""
