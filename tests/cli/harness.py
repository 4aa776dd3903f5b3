"""One run of the command line inside the test's own process."""

import io
import os
from contextlib import redirect_stderr, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from unittest.mock import patch

from garkcli.cli.main import main

ROOT = Path(__file__).parents[2]


@dataclass(frozen=True)
class Run:
    """What a run left behind."""

    code: object
    out: str
    err: str


class _Input(io.TextIOWrapper):
    """Standard input with the given text."""

    def __init__(self, text: str) -> None:
        super().__init__(io.BytesIO(text.encode()), encoding="utf-8")


def gark(*arguments: str, stdin: str = "", cwd: Path = ROOT) -> Run:
    """Run ``gark`` with ``arguments`` in ``cwd``, 80 columns wide, with no colour asked for."""
    out, err = io.StringIO(), io.StringIO()
    code: object = None
    before = Path.cwd()
    with (
        patch.dict(os.environ, {"COLUMNS": "80", "LINES": "24"}),
        patch("sys.stdin", _Input(stdin)),
    ):
        for name in ("NO_COLOR", "GITHUB_ACTIONS"):
            os.environ.pop(name, None)
        os.chdir(cwd)
        try:
            with redirect_stdout(out), redirect_stderr(err):
                main(arguments)
        except SystemExit as end:
            code = end.code
        finally:
            os.chdir(before)
    return Run(code, out.getvalue(), err.getvalue())
