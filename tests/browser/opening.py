"""A page in the browser that tells what it says and what it asks for."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from playwright.sync_api import Page, Route

from tests.browser.machine import BUILT


@dataclass
class Opened:
    """A page in the browser.

    Attributes:
        page: it.
        said: errors and warnings of the console, errors of scripts, dialogs.
        asked: the addresses that it asked for, but for its own.
    """

    page: Page
    said: list[str] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)

    def shot(self, name: str) -> None:
        """Write a screenshot of the whole page."""
        self.page.screenshot(path=BUILT / f"{name}.png", full_page=True)


Open: TypeAlias = Callable[..., AbstractContextManager[Opened]]
"""Opens a file at a width, in a colour scheme, with scripts or without."""


def listen(page: Page, found: Opened, path: Path) -> None:
    """Write down what the page says and asks for; nothing leaves the machine."""

    def passed(route: Route) -> None:
        address = route.request.url
        if address.partition("#")[0] != path.as_uri():
            found.asked.append(address)
        if address.startswith("file:"):
            route.continue_()
        else:
            route.abort()

    def said(message: Any) -> None:
        if message.type in ("error", "warning"):
            found.said.append(f"{message.type}: {message.text}")

    def refused(dialog: Any) -> None:
        found.said.append(f"dialog: {dialog.message}")
        dialog.dismiss()

    page.route("**/*", passed)
    page.on("console", said)
    page.on("pageerror", lambda error: found.said.append(str(error)))
    page.on("dialog", refused)
