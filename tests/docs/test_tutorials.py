"""What the tutorials say beside their sessions, which ``test_transcripts`` runs."""

from __future__ import annotations

import re
from pathlib import Path

from garkcli import load
from tests.cli.harness import ROOT, gark

STUDENT = ROOT / "docs" / "tutorial-student.md"


def test_the_tableau_of_the_student_is_the_one_typed_in(tmp_path: Path) -> None:
    """The block that shows it gives the same file as the line of the command does."""
    text = STUDENT.read_text(encoding="utf-8")
    (block,) = re.findall(r"```text\n(.*?)```", text, re.DOTALL)
    (line,) = re.findall(r"--tableau '(.*)'$", text, re.MULTILINE)
    methods = []
    for name, tableau in (("shown.yaml", block), ("typed.yaml", line)):
        run = gark("new", name, "--tableau", tableau, cwd=tmp_path)
        assert run.code == 0, run.err
        methods.append(load(str(tmp_path / name)).tableau)
    assert methods[0] == methods[1]
