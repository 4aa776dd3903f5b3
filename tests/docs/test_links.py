"""The links between the pages: README.md, CONTRIBUTING.md and those of docs."""

from __future__ import annotations

import re
from pathlib import Path
from urllib.parse import urlsplit

import pytest

ROOT = Path(__file__).resolve().parents[2]
README = ROOT / "README.md"
PACKAGE_PAGE = ROOT / "docs" / "package-page.md"
PAGES = [README, ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]


def without_code(text: str) -> str:
    """The text of a page without its blocks of code."""
    return re.sub(r"^```.*?^```$", "", text, flags=re.DOTALL | re.MULTILINE)


def prose(page: Path) -> str:
    """What a page says."""
    return without_code(page.read_text(encoding="utf-8"))


def links(page: Path) -> list[str]:
    """The targets of the links of a page."""
    return links_of(page.read_text(encoding="utf-8"))


def links_of(page: str) -> list[str]:
    """The targets of links and pictures, those to other machines left out."""
    text = re.sub(r"`[^`\n]*`(?!\])", "", without_code(page))
    targets = re.findall(r"\]\(([^)\s]+)\)", text)
    return [target for target in targets if "://" not in target]


def anchors(page: Path) -> set[str]:
    """What its headings are called in links: small letters, hyphens for spaces, no signs."""
    headings = re.findall(r"^#+ (.*)$", prose(page), re.MULTILINE)
    plain = [re.sub(r"[^\w\- ]", "", heading.lower()) for heading in headings]
    return {heading.replace(" ", "-") for heading in plain}


def outside(page: str) -> list[str]:
    """The targets of links to other machines."""
    targets = re.findall(r"\]\(([^)\s]+)\)", without_code(page))
    return [target for target in targets if "://" in target]


def is_well_formed(link: str) -> bool:
    """Whether a link has a scheme that is safe, a host with a domain, and no sign of the sentence
    around it at its end.
    """
    parts = urlsplit(link)
    is_plain = link.isascii() and not set(link) & set('<>"`\\^{|} ')
    has_domain = re.fullmatch(r"[\w-]+(\.[\w-]+)+", parts.netloc) is not None
    return (
        parts.scheme == "https"
        and has_domain
        and is_plain
        and link[-1] not in ".,;:"
        and "//" not in parts.path
    )


def missing(page: Path) -> list[str]:
    """The links of a page that lead nowhere."""
    found = []
    for link in links(page):
        name, _, anchor = link.partition("#")
        target = (page.parent / name) if name else page
        is_there = target.exists() and (not anchor or anchor in anchors(target))
        if not is_there:
            found.append(link)
    return found


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_every_link_leads_somewhere(page: Path) -> None:
    """A file that is there, and a heading that it has."""
    assert missing(page) == []


def test_pages_of_the_site_lead_to_pages_of_the_site() -> None:
    """One page outside of docs is a page of the site too: conf.py copies CONTRIBUTING.md."""
    docs = ROOT / "docs"
    targets = {
        (page.parent / link.partition("#")[0]).resolve()
        for page in docs.rglob("*.md")
        if page != PACKAGE_PAGE
        for link in links(page)
    }
    outside_docs = {x for x in targets if x.suffix == ".md" and not x.is_relative_to(docs)}
    assert outside_docs == {ROOT / "CONTRIBUTING.md"}


def test_links_to_other_sites_are_well_formed() -> None:
    """Whether they lead somewhere is for ``make links``, which needs a network."""
    found = [link for page in PAGES for link in outside(page.read_text(encoding="utf-8"))]
    assert found
    assert [link for link in found if not is_well_formed(link)] == []
    for link in (
        "http://example.org/a",
        "https://example/a",
        "https://example.org/a.",
        "https://example.org//a",
        "https://example.org/{a}",
    ):
        assert not is_well_formed(link)


def test_every_page_is_found_from_the_readme() -> None:
    """Following links from the README one comes to all pages but the one of the package index."""
    seen: set[Path] = set()
    ahead = [README]
    while ahead:
        page = ahead.pop()
        seen.add(page)
        targets = {(page.parent / link.partition("#")[0]).resolve() for link in links(page)}
        ahead += [x for x in targets if x.suffix == ".md" and x not in seen]
    assert set(PAGES) - seen == {PACKAGE_PAGE}


def test_a_wrong_link_is_found(tmp_path: Path) -> None:
    """Files and headings that are not there are told, those that are there are not."""
    page = tmp_path / "a.md"
    page.write_text(
        "# One `two`, three\n[x](#one-two-three) [x](a.md) [x](b.md) [`x`](#two)\n"
        "```\n# four\n```\n[x](a.md#four) [x](https://example.org/c)\n",
        encoding="utf-8",
    )
    assert missing(page) == ["b.md", "#two", "a.md#four"]
