"""The page that a package index shows: docs/package-page.md."""

from __future__ import annotations

import re
import tomllib

from tests.cli.harness import ROOT

PAGE = ROOT / "docs" / "package-page.md"


def test_it_has_no_links_that_lead_nowhere() -> None:
    """It is the page of the package, and an index has none of the files beside it."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert ROOT / project["readme"] == PAGE
    assert not re.search(r"\]\(|<img|\]:", PAGE.read_text(encoding="utf-8"))
