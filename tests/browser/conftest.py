"""One Chromium for all tests; a page that tells what it says and what it asks for."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest
from playwright.sync_api import Browser, sync_playwright

from tests.browser.machine import BUILT, SWITCHES, NoBrowser, find_browser
from tests.browser.opening import Open, Opened, listen

HEIGHT = 900


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    """The Chromium of the machine, headless."""
    try:
        path = find_browser()
    except NoBrowser as error:
        pytest.exit(str(error), returncode=3)
    BUILT.mkdir(parents=True, exist_ok=True)
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=list(SWITCHES))
        yield browser
        browser.close()


@pytest.fixture
def opened(chromium: Browser) -> Open:
    """Opens a file at a width, in a colour scheme, with scripts or without."""

    @contextmanager
    def open_file(
        path: Path, width: int = 1280, scheme: str = "light", scripts: bool = True
    ) -> Iterator[Opened]:
        context = chromium.new_context(
            viewport={"width": width, "height": HEIGHT},
            color_scheme=scheme,
            java_script_enabled=scripts,
            reduced_motion="reduce",
        )
        page = context.new_page()
        found = Opened(page)
        listen(page, found, path)
        page.goto(path.as_uri())
        yield found
        context.close()

    return open_file
