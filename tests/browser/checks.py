"""What every page is tested for."""

from __future__ import annotations

from typing import Any

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page

_RULES = {
    "resultTypes": ["violations"],
    "runOnly": {
        "type": "tag",
        "values": [
            "wcag2a",
            "wcag2aa",
            "wcag21a",
            "wcag21aa",
            "best-practice",
        ],
    },
}
_WIDTHS = "() => [document.scrollingElement.scrollWidth, innerWidth]"
_TOO_WIDE = """() => [...document.querySelectorAll("body *")]
  .filter(x => x.getBoundingClientRect().right > innerWidth + 1)
  .slice(0, 8).map(x => x.tagName + "." + x.className)"""


def violations(page: Page, within: str | None = None) -> str:
    """Where axe finds rules of WCAG 2 A and AA, or its own, broken: a line a rule, so none is well.

    Args:
        page: to be looked at.
        within: a selector of the part that is looked at; all of it by default.
    """
    found = Axe().run(page, context=within, options=_RULES)
    return "\n".join(_described(x) for x in found.response["violations"])


def _described(violation: dict[str, Any]) -> str:
    nodes = violation["nodes"]
    first = nodes[0]
    where = first["html"][:160]
    why = first["failureSummary"].replace("\n", " ")[:240]
    return f"{violation['id']}, {len(nodes)} times: {where}: {why}"


def sideways(page: Page) -> str:
    """What makes the page scroll sideways; empty where it does not."""
    wide, inner = page.evaluate(_WIDTHS)
    if wide <= inner:
        return ""
    return f"{wide} > {inner}: {page.evaluate(_TOO_WIDE)}"
