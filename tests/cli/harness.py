"""One run of the command line inside the test's own process."""

import io
import os
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from unittest.mock import patch

from garkcli.cli.main import main
from garkcli.cli.table import COMMANDS, FORMER

ROOT = Path(__file__).parents[2]
NAMES = {*COMMANDS, *FORMER}
"""What can be typed after ``gark``: the commands, and their former names."""


@dataclass(frozen=True)
class Run:
    """What a run left behind."""

    code: object
    out: str
    err: str


class _Input(io.TextIOWrapper):
    """Standard input with the given text, or with what is none."""

    def __init__(self, given: str | bytes) -> None:
        content = given.encode() if isinstance(given, str) else given
        super().__init__(io.BytesIO(content), encoding="utf-8")


ASKING = ("NO_COLOR", "FORCE_COLOR", "GITHUB_ACTIONS")
"""Variables of the environment that change what is written."""


def gark(
    *arguments: str, stdin: str | bytes = "", cwd: Path = ROOT, encoding: str = "", **variables: str
) -> Run:
    """Run ``gark`` with ``arguments`` in ``cwd``, 80 columns wide, with no colour asked for.

    Args:
        arguments: of the command line.
        stdin: what standard input has.
        cwd: the folder to run in.
        encoding: of standard output and error; text is kept as it is without one.
        variables: of the environment.
    """
    out, err = _stream(encoding), _stream(encoding)
    code: object = None
    before = Path.cwd()
    with (
        patch.dict(os.environ, {"COLUMNS": "80", "LINES": "24"}),
        patch("sys.stdin", _Input(stdin)),
    ):
        for name in ASKING:
            os.environ.pop(name, None)
        os.environ.update(variables)
        os.chdir(cwd)
        try:
            with redirect_stdout(out), redirect_stderr(err):
                main(arguments)
        except SystemExit as end:
            code = end.code
        finally:
            os.chdir(before)
    return Run(code, _written(out), _written(err))


@cache
def gark_once(*arguments: str) -> Run:
    """A run on files that stay as they are: one for all tests of it."""
    return gark(*arguments)


def _stream(encoding: str) -> io.TextIOWrapper | io.StringIO:
    return io.TextIOWrapper(io.BytesIO(), encoding=encoding) if encoding else io.StringIO()


def _written(stream: io.TextIOWrapper | io.StringIO) -> str:
    if isinstance(stream, io.StringIO):
        return stream.getvalue()
    stream.flush()
    stream.seek(0)
    return stream.read()
