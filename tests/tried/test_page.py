"""The page of `make page` in Chromium, on a desktop and on a phone, in the light and in the dark."""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, Route, expect

from tests.browser.checks import sideways, violations
from tests.browser.machine import BUILT, ROOT

sys.path.append(str(ROOT / "tryit"))
import answers

SIZES = {"desktop": (1280, "light"), "phone": (360, "dark")}
PATIENCE = 120_000
PAIR = "methods: [gauss-2, lobatto-iiia-3]\ntransfer: collocation\nexpect: {order: 4}\n"
HOSTILE = "name: <img src=x onerror=alert(1)><script>alert(2)</script>\nA: [[0]]\nb: [1]\n"
SLOW = "methods: [gauss-12, lobatto-iiia-12]\ntransfer: collocation\n"


@dataclass
class Seen:
    """The page, what it said on the console, and the addresses beyond it that it asked for."""

    page: Page
    said: list[str] = field(default_factory=list)
    asked: list[str] = field(default_factory=list)


@contextmanager
def opened(chromium: Browser, address: str, size: str, fragment: str = "") -> Iterator[Seen]:
    """The page, once gark has started in it."""
    width, scheme = SIZES[size]
    context = chromium.new_context(
        viewport={"width": width, "height": 900}, color_scheme=scheme, accept_downloads=True
    )
    page = context.new_page()
    seen = Seen(page)

    def passed(route: Route) -> None:
        if route.request.url.startswith((address, "blob:", "data:")):
            route.continue_()
        else:
            seen.asked.append(route.request.url)
            route.abort()

    def said(message: object) -> None:
        seen.said.append(str(message))

    page.route("**/*", passed)
    page.on("console", said)
    page.on("pageerror", said)
    page.on("dialog", lambda dialog: (said(dialog.message), dialog.dismiss()))
    page.goto(f"{address}index.html{fragment}")
    settled(page)
    yield seen
    context.close()


def settled(page: Page) -> None:
    """Wait until gark has answered everything."""
    expect(page.locator("#said")).not_to_be_empty(timeout=PATIENCE)
    expect(page.locator("body[data-busy]")).to_have_count(0, timeout=PATIENCE)


@pytest.fixture(scope="module", params=SIZES)
def seen(request: pytest.FixtureRequest, chromium: Browser, address: str) -> Iterator[Seen]:
    """One page of each size for several tests."""
    with opened(chromium, address, request.param) as found:
        yield found


def size_of(seen: Seen) -> str:
    """Its name in SIZES."""
    return next(
        name for name, (width, _) in SIZES.items() if seen.page.viewport_size["width"] == width
    )


def test_the_first_look(seen: Seen) -> None:
    """A wrong entry, its tree, the region and the report; quiet, by itself, not wider than the
    window, and readable for all.
    """
    page = seen.page
    said = page.locator("#said")
    expect(said).to_contain_text("order 2 fails at [[]]")
    expect(said).to_contain_text("a[3,2] = 1/2")
    expect(page.locator("#state")).to_have_class("fails")
    expect(page.locator("#tree svg.tree")).to_be_visible()
    expect(page.locator("#region svg.plot")).to_be_visible()
    report = page.frame_locator("#report")
    expect(report.locator("h1")).to_have_text("method.yaml")
    expect(report.locator("form.filters")).to_be_visible()
    page.screenshot(path=BUILT / f"page-{size_of(seen)}.png", full_page=True)
    assert sideways(page) == ""
    assert violations(page, "body > *:not(iframe)") == ""
    assert seen.said == []
    assert seen.asked == []


def test_what_is_typed_is_answered_as_by_the_command(
    seen: Seen, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The answer to a new file is what gark says elsewhere, letter by letter."""
    monkeypatch.chdir(tmp_path)
    page = seen.page
    for text in (PAIR, "A: [[0, 1]\nb: [1]\n", HOSTILE):
        page.locator("#text").fill(text)
        page.wait_for_timeout(600)
        settled(page)
        said = page.locator("#said").inner_text()
        one_line = " ".join(said.split())
        assert one_line == " ".join(json.loads(answers.checked(text, 80))["said"].split())
        assert max(map(len, said.splitlines())) <= 100
        assert sideways(page) == ""
    assert seen.said == []
    assert page.frame_locator("#report").locator("article img, article script").count() == 0


def test_choices_write_files(seen: Seen) -> None:
    """From families and a rule, and from the catalogue."""
    page = seen.page
    page.locator("#made summary").click()
    page.locator("#more").click()
    page.locator("#fewer").click()
    page.get_by_label("Family of colour 1").select_option("radau-iia")
    page.get_by_label("Transfer rule").select_option("interpolation")
    page.get_by_role("button", name="Write the file").click()
    assert page.locator("#text").input_value() == (
        "methods:\n  - {family: radau-iia, stages: 2}\n  - {family: lobatto-iiia, stages: 3}\n"
        "transfer: interpolation\n"
    )
    expect(page.locator("#said")).to_contain_text("2 colours", timeout=PATIENCE)
    settled(page)
    page.get_by_label("From the catalogue").fill("kutta-3")
    page.get_by_role("button", name="Load", exact=True).click()
    expect(page.locator("#text")).to_have_value(answers.load("kutta-3").text, timeout=PATIENCE)
    settled(page)
    expect(page.locator("#state")).to_have_class("holds")


def test_a_link_holds_the_file(chromium: Browser, address: str) -> None:
    """Who opens the link has the file, and no server has seen it; the download has it too."""
    with opened(chromium, address, "desktop") as first:
        page = first.page
        page.locator("#text").fill(PAIR + "# ℝ ≤ 1\n")
        page.get_by_role("button", name="Copy a link").click()
        expect(page.locator("#done")).to_contain_text("file")
        link = page.url
        with page.expect_download() as download:
            page.get_by_role("button", name="Download").click()
        assert download.value.path().read_text(encoding="utf-8") == PAIR + "# ℝ ≤ 1\n"
        assert download.value.suggested_filename == "method.gark.yaml"
    with opened(chromium, address, "phone", "#" + link.partition("#")[2]) as second:
        expect(second.page.locator("#text")).to_have_value(PAIR + "# ℝ ≤ 1\n")
        expect(second.page.locator("#said")).to_contain_text("claim holds")
    with opened(chromium, address, "phone", "#file=nonsense") as third:
        expect(third.page.locator("#done")).to_have_text("The link holds no file.")


def test_long_work_ends_and_gark_starts_anew(chromium: Browser, address: str) -> None:
    """At the deadline the worker is gone; the next file is answered by another one."""
    with opened(chromium, address, "desktop") as found:
        page = found.page
        page.clock.install()
        page.locator("#text").fill(SLOW)
        page.clock.run_for(500)
        expect(page.locator("body[data-busy]")).to_have_count(1)
        page.clock.fast_forward(61_000)
        expect(page.locator("#state")).to_contain_text("No answer after 60 seconds")
        page.locator("#text").fill(PAIR)
        page.clock.run_for(500)
        expect(page.locator("#said")).to_contain_text("claim holds", timeout=PATIENCE)
        assert found.said == []
