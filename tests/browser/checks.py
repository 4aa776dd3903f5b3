"""What every page is tested for."""

from __future__ import annotations

from typing import Any

from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page

_RULES = {
    "resultTypes": ["violations"],
    "runOnly": {
        "type": "tag",
        "values": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "best-practice"],
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
    lines = []
    for violation in found.response["violations"]:
        nodes = [x for x in violation["nodes"] if not _is_formula(violation, x)]
        if nodes:
            lines.append(_described(violation["id"], nodes))
    return "\n".join(lines)


def _is_formula(violation: dict[str, Any], node: dict[str, Any]) -> bool:
    """Whether axe takes a head for empty because of a formula in it: it reads no MathML, which
    screen readers do.
    """
    is_empty = violation["id"] == "empty-table-header"
    return is_empty and "<math" in node["html"]


def _described(rule: str, nodes: list[dict[str, Any]]) -> str:
    first = nodes[0]
    where = first["html"][:160]
    why = first["failureSummary"].replace("\n", " ")[:240]
    return f"{rule}, {len(nodes)} times: {where}: {why}"


def sideways(page: Page) -> str:
    """What makes the page scroll sideways; empty where it does not."""
    wide, inner = page.evaluate(_WIDTHS)
    if wide <= inner:
        return ""
    return f"{wide} > {inner}: {page.evaluate(_TOO_WIDE)}"
