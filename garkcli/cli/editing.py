"""``gark lsp``: method files in editors."""

from __future__ import annotations

import os
import sys
from importlib.util import find_spec

from garkcli.cli import options as opt
from garkcli.cli.command import declared
from garkcli.cli.output import Output
from garkcli.cli.streams import say
from garkcli.doing import hush
from garkcli.errors import UsageProblem
from garkcli.terminal import is_terminal


class LspOptions(opt.Options):
    once: str | None = opt.option(
        "--once", opt.input_file("FILE"), "What an editor shows of FILE; no server is started."
    )
    name: str | None = opt.option(
        "--name", opt.text("PATH"), "With --once -: the path of the file that is typed."
    )
    rules = (opt.needs(name, once, "--name is the path of a file that is typed", "add --once -"),)


@declared("lsp", LspOptions, ["json"])
def lsp(given: LspOptions, output: Output) -> int:
    """A language server for method files, which editors start and speak to by standard input.

    It shows remarks at their places, the orders above the tableau, the meaning of keys, families
    and rules under the cursor, what may come next, and entries that would mend a claim.

    Exit code with --once: 0 every claim holds, or nothing is claimed, 1 a claim fails, 2 FILE
    cannot be read as a method, 3 a claim is undecided, or is one about free numbers.
    """
    if given.once is not None:
        from msgspec import json

        from garkcli.editor.judging import judged
        from garkcli.files import is_stream
        from garkcli.methodfile.load import read_method_text

        text, source = read_method_text(given.once)
        if given.name is not None and is_stream(given.once):
            source = given.name
        found = judged(text, source)
        output.write(json.format(json.encode(found)).decode() + "\n")
        return found.exit_code
    if find_spec("pygls") is None:
        cure = 'type pip install "garkcli[lsp]", or in a checkout pip install ".[lsp]"'
        raise UsageProblem("gark lsp needs pygls", cure, code="missing-package")
    from garkcli.editor.server import make_server

    if is_terminal(sys.stdin):
        say("gark lsp waits for the messages of an editor; gark lsp --once FILE needs none")
        hush()
    # copies, which the server closes at its end
    make_server().start_io(os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb"))
    return 0
