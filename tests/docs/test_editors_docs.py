"""The settings of docs/editors.md start the command that there is."""

from __future__ import annotations

import json
import re

from garkcli.cli.table import COMMANDS
from tests.docs.blocks import ROOT, blocks

PAGE = ROOT / "docs" / "editors.md"
COMMAND = ["gark", "lsp"]


def test_each_editor_starts_the_server() -> None:
    """The settings are well-formed, and have its words, for files of YAML."""
    assert COMMAND[1] in COMMANDS
    texts = {block.language: block.text for block in blocks(PAGE)}
    (server,) = json.loads(texts["json"])["LanguageServerManager"]["language_servers"].values()
    assert (server["argv"], server["languages"]) == (COMMAND, ["yaml"])
    assert re.search(r"cmd = \{(.*?)\}", texts["lua"])[1].split() == ['"gark",', '"lsp"']
    assert '(yaml-mode . ("gark" "lsp"))' in texts["elisp"]
    for text in texts.values():
        assert "yaml" in text
        for opening, closing in ("()", "{}", "[]"):
            assert text.count(opening) == text.count(closing)
