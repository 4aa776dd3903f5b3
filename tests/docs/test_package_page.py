"""The page that a package index shows: docs/package-page.md."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from tests.cli.harness import ROOT, gark

PAGE = ROOT / "docs" / "package-page.md"


def test_it_has_no_links_that_lead_nowhere() -> None:
    """It is the page of the package, and an index has none of the files beside it."""
    project = tomllib.loads(
        (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    )["project"]
    assert ROOT / project["readme"] == PAGE
    assert not re.search(r"\]\(|<img|\]:", PAGE.read_text(encoding="utf-8"))


def test_its_run_is_as_shown(tmp_path: Path) -> None:
    """Its method file, typed in, has the report that it shows the beginning of."""
    text = PAGE.read_text(encoding="utf-8")
    (name,) = re.findall(r"^The file `(.*)`:$", text, re.MULTILINE)
    (method,) = re.findall(r"```yaml\n(.*?)```", text, re.DOTALL)
    (run,) = re.findall(r"```console\n(.*?)\.\.\.\n```", text, re.DOTALL)
    command, shown = run.split("\n", 1)
    (tmp_path / name).write_text(method, encoding="utf-8")
    found = gark(*command.split()[2:], cwd=tmp_path)
    assert found.code == 0
    assert found.out.startswith(shown)
