"""The site of the documentation in a browser; `make browser` builds it before."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.browser.checks import sideways, violations
from tests.browser.machine import SITE
from tests.browser.opening import Open

SHOWN = ["index", "tutorial-student", "gallery", "glossary", "command-line"]
"""Of which there are screenshots, and whose text axe looks at."""


def pages() -> list[str]:
    """All pages of the site but those that Sphinx makes for itself."""
    made = {"genindex", "search", "py-modindex"}
    found = []
    for path in sorted(SITE.rglob("*.html")):
        name = path.relative_to(SITE).with_suffix("").as_posix()
        if name not in made and not name.startswith("_"):
            found.append(name)
    return found


def path_of(name: str) -> Path:
    """The file of a page."""
    return SITE / f"{name}.html"


def test_the_site_is_built() -> None:
    """There are pages to look at."""
    assert len(pages()) > 30
    assert set(SHOWN) <= set(pages())


@pytest.mark.parametrize("width", [360, 1280])
def test_pages_are_quiet_and_whole(opened: Open, width: int) -> None:
    """On every page: nothing on the console, nothing from the network, no scrolling sideways."""
    faults = []
    for name in pages():
        with opened(path_of(name), width) as found:
            outside = [x for x in found.asked if not x.startswith("file:")]
            wide = sideways(found.page)
            if found.said or outside or wide:
                faults.append((name, found.said, outside, wide))
    assert faults == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", SHOWN)
def test_our_part_of_a_page_is_readable(opened: Open, name: str, scheme: str) -> None:
    """What we write, the article, breaks no rule of axe; the frame around it is the theme's."""
    for size, width in (("phone", 360), ("desktop", 1280)):
        with opened(path_of(name), width, scheme) as found:
            found.shot(f"site-{name}-{size}-{scheme}")
            assert violations(found.page, "article") == ""
