"""Pages of `gark report` in a browser, on a phone, on a screen, in the dark, on paper."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from playwright.sync_api import Locator, Page

from tests.browser.checks import sideways, violations
from tests.browser.machine import BUILT, ROOT
from tests.browser.opening import Open

HERE = Path(__file__).parent
HOSTILE = HERE / "hostile.gark.yaml"
FREE = HERE / "free.gark.yaml"
PAGES = {
    "rk4": ["rk4", "-v"],
    "usual": ["dormand-prince-5"],
    "pair": ["methods/collocation.gark.yaml", "--order", "3", "-v"],
    "several": ["rk4", "ark-ars222", "gauss-2", "methods/rectangular.gark.yaml", "--order", "3"],
    "free": [str(FREE)],
    "hostile": [str(HOSTILE)],
    "big": ["methods/gauss6-lobatto7.gark.yaml"],
    "long-numbers": ["methods/found/imex4-order3.gark.yaml"],
}
READ = ["rk4", "usual", "pair", "several", "free", "hostile"]
"""Those that axe looks at, for which a big page takes it minutes."""
WITH_FILTERS = ["rk4", "pair", "several"]
SIZES = {"phone": 360, "desktop": 1280}
SCHEMES = ["light", "dark"]


@pytest.fixture(scope="session")
def reports() -> dict[str, Path]:
    """The pages, written by the command."""
    BUILT.mkdir(parents=True, exist_ok=True)
    return {name: _report(name, files) for name, files in PAGES.items()}


def _report(name: str, arguments: list[str]) -> Path:
    path = BUILT / f"{name}.html"
    command = [sys.executable, "-m", "garkcli", "report", *arguments]
    done = subprocess.run(
        [*command, "-o", str(path)], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode in (0, 1), done.stderr
    return path


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_quiet_and_whole(
    reports: dict[str, Path], opened: Open, name: str, size: str
) -> None:
    """Nothing on the console, nothing fetched, no scrolling sideways."""
    with opened(reports[name], SIZES[size]) as found:
        found.shot(f"{name}-{size}-light")
        assert sideways(found.page) == ""
        assert found.said == []
        assert found.asked == []


@pytest.mark.parametrize("size", SIZES)
def test_only_boxes_that_scroll_stop_the_keyboard(
    reports: dict[str, Path], opened: Open, size: str
) -> None:
    """A stop for each box that is wider or higher than what is seen of it, and for no other; only a
    box that is meant to be high scrolls up and down.
    """
    fits = "x => x.classList.contains('tall') || x.scrollHeight <= x.clientHeight"
    scrolls = "x => x.scrollWidth > x.clientWidth || x.scrollHeight > x.clientHeight"
    with opened(reports["rk4"], SIZES[size]) as found:
        kinds = set()
        for box in found.page.locator(".box").all():
            is_scrolled = box.evaluate(scrolls)
            assert (box.get_attribute("tabindex") == "0") == is_scrolled
            assert box.evaluate(fits)
            kinds.add(is_scrolled)
        assert kinds == {True, False}


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("name", READ)
def test_a_page_is_readable(reports: dict[str, Path], opened: Open, name: str, scheme: str) -> None:
    """Axe finds no rule broken, contrast in the light and in the dark among them."""
    with opened(reports[name], scheme=scheme) as found:
        found.shot(f"{name}-desktop-{scheme}")
        assert violations(found.page) == ""


@pytest.mark.parametrize("name", PAGES)
def test_a_page_is_printed_black_on_white(
    reports: dict[str, Path], opened: Open, name: str
) -> None:
    """On paper the filters are gone, rows that they hide are there, and the dark is light."""
    with opened(reports[name], scheme="dark") as found:
        page = found.page
        for form in page.locator("form.filters").all():
            form.locator("input[name=text]").fill("no such thing")
        page.emulate_media(media="print", color_scheme="dark")
        found.shot(f"{name}-print")
        page.pdf(path=BUILT / f"{name}.pdf", prefer_css_page_size=True)
        style = "x => [getComputedStyle(x).backgroundColor, getComputedStyle(x).color]"
        assert page.locator("body").evaluate(style) == ["rgb(255, 255, 255)", "rgb(0, 0, 0)"]
        for form in page.locator("form.filters").all():
            assert not form.is_visible()
        for table in page.locator("table.conditions").all():
            count = table.locator("tbody tr").count()
            assert shown_rows(table) == list(range(count))
        assert found.said == []


@pytest.mark.parametrize("name", WITH_FILTERS)
def test_without_scripts_everything_is_there(
    reports: dict[str, Path], opened: Open, name: str
) -> None:
    """A page without scripts shows all rows, and no filters that would do nothing."""
    with opened(reports[name], scripts=False) as found:
        forms = found.page.locator("form.filters")
        rows = found.page.locator("table.conditions tbody tr")
        assert forms.count() > 0
        assert not forms.first.is_visible()
        assert rows.count() > 0
        assert rows.last.is_visible()


@pytest.mark.parametrize("name", WITH_FILTERS)
def test_filters_narrow_the_rows(reports: dict[str, Path], opened: Open, name: str) -> None:
    """Each choice of each filter shows the rows that have it, and counts them."""
    with opened(reports[name]) as found:
        for form in found.page.locator("form.filters").all():
            _try_choices(found.page, form)
            _try_text(found.page, form)
        assert found.said == []


def shown_rows(table: Locator) -> list[int]:
    """The numbers of the rows of a table that have a height."""
    script = """table => [...table.tBodies[0].rows]
      .map((row, k) => row.getBoundingClientRect().height > 0 ? k : -1)
      .filter(k => k >= 0)"""
    found: list[int] = table.evaluate(script)
    return found


def _table(page: Page, form: Locator) -> Locator:
    name = form.get_attribute("data-table")
    return page.locator(f"#{name}")


def _values(table: Locator, key: str) -> list[str]:
    """What the rows have of a key."""
    script = "(table, key) => [...table.tBodies[0].rows].map(row => row.dataset[key])"
    found: list[str] = table.evaluate(script, key)
    return found


def _counted(form: Locator) -> list[int]:
    """The numbers that the form says: of rows shown, and of all."""
    words = form.locator("output").inner_text().split()
    return [int(word) for word in words if word.isdigit()]


def _try_choices(page: Page, form: Locator) -> None:
    table = _table(page, form)
    count = table.locator("tbody tr").count()
    assert _counted(form) == [count, count]
    for select in form.locator("select").all():
        values = _values(table, str(select.get_attribute("name")))
        choices = select.locator("option").evaluate_all("options => options.map(x => x.value)")
        # every row has one value of each key, and each choice has a row
        assert choices[0] == ""
        assert set(choices[1:]) == set(values)
        for choice in choices[1:]:
            select.select_option(choice)
            fitting = [k for k, x in enumerate(values) if x == choice]
            assert shown_rows(table) == fitting
            assert _counted(form) == [len(fitting), count]
        select.select_option("")
    assert _counted(form) == [count, count]


def _try_text(page: Page, form: Locator) -> None:
    table = _table(page, form)
    rows = table.locator("tbody tr")
    count = rows.count()
    box = form.locator("input[name=text]")
    tree = rows.last.locator("code").inner_text()
    box.fill(tree.upper())
    shown = shown_rows(table)
    assert 0 < len(shown) < count
    assert all(tree in rows.nth(k).inner_text() for k in shown)
    box.fill("no such thing")
    assert _counted(form) == [0, count]
    form.locator("button[type=reset]").click()
    page.wait_for_timeout(50)
    assert _counted(form) == [count, count]


def test_filters_work_from_the_keyboard(reports: dict[str, Path], opened: Open) -> None:
    """Without a mouse: from the first filter, an arrow chooses, Tab goes on, letters narrow, and
    what has the focus is seen.
    """
    with opened(reports["rk4"]) as found:
        page = found.page
        form = page.locator("form.filters").first
        _, count = _counted(form)
        form.locator("select").first.focus()
        page.keyboard.press("ArrowDown")
        one_order, _ = _counted(form)
        assert 0 < one_order < count
        outline = "() => getComputedStyle(document.activeElement).outlineStyle"
        for _ in range(form.locator("select").count()):
            page.keyboard.press("Tab")
            assert page.evaluate(outline) != "none"
        name = page.evaluate("() => document.activeElement.name")
        assert name == "text"
        page.keyboard.type("no such thing")
        assert _counted(form) == [0, count]
        page.keyboard.press("Tab")
        page.keyboard.press("Enter")
        page.wait_for_timeout(50)
        assert _counted(form) == [count, count]


def test_the_keyboard_reaches_the_report(reports: dict[str, Path], opened: Open) -> None:
    """The first Tab offers to skip what comes before the report."""
    with opened(reports["several"]) as found:
        page = found.page
        page.keyboard.press("Tab")
        page.keyboard.press("Enter")
        assert page.evaluate("() => location.hash") == "#main"


def test_links_on_a_page_lead_somewhere(reports: dict[str, Path], opened: Open) -> None:
    """Each link to a place on the page has that place, and no two places have one name."""
    script = """() => [...document.querySelectorAll("a[href^='#']")]
      .map(x => x.getAttribute("href").slice(1))
      .filter(x => document.getElementById(x) === null)"""
    doubled = """() => { const ids = [...document.querySelectorAll("[id]")].map(x => x.id);
      return ids.filter((x, k) => ids.indexOf(x) !== k); }"""
    for path in reports.values():
        with opened(path) as found:
            assert found.page.evaluate(script) == []
            assert found.page.evaluate(doubled) == []


def test_pictures_fit_and_are_named(reports: dict[str, Path], opened: Open) -> None:
    """On a phone each picture is as wide as the column, its letters can be read, and a screen
    reader has a name for it.
    """
    with opened(reports["several"], width=360) as found:
        pictures = found.page.get_by_role("img")
        plots = found.page.locator("svg.plot")
        assert plots.count() >= 10
        assert pictures.count() >= plots.count()
        for plot in plots.all():
            box = plot.bounding_box()
            assert box is not None
            assert box["x"] + box["width"] <= 360
            assert box["width"] >= 290
            assert plot.locator("> title").text_content()


def test_hostile_texts_stay_texts(reports: dict[str, Path], opened: Open) -> None:
    """What a file says is shown as it stands: no element of it comes to life, nothing runs."""
    with opened(reports["hostile"]) as found:
        page = found.page
        text = page.locator("body").inner_text()
        assert '<script>alert("name")</script>{{ 7 * 7 }}' in text
        for name in ("iframe", "body img", "h1[onclick]", "svg[onload]"):
            assert page.locator(name).count() == 0
        handlers = page.locator("[onmouseover], [onerror], [onclick]")
        assert handlers.count() == 0
        schemes = "() => [...document.links].map(x => x.protocol)"
        assert "javascript:" not in page.evaluate(schemes)
        assert found.said == []
        assert found.asked == []
