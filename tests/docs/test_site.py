"""docs/all-pages.md and docs/conf.py: the pages of the documentation, in their order."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

from tests.docs.test_links import links, links_of

DOCS = Path(__file__).resolve().parents[2] / "docs"
LIST = DOCS / "all-pages.md"
INDEX = LIST.read_text(encoding="utf-8")
ELSEWHERE = {"index.md", "all-pages.md", "package-page.md"}
"""The landing page, the list itself, and the page of the package index, which has no links."""


def pages() -> list[str]:
    """What the list has to name."""
    found = {x.relative_to(DOCS).as_posix() for x in DOCS.rglob("*.md")}
    return sorted(found - ELSEWHERE)


def test_the_list_has_every_page_once() -> None:
    """A page is in one of its parts, and in no other."""
    assert sorted(links(LIST)) == pages()


def test_the_margin_has_what_the_list_has() -> None:
    """The contents made for Sphinx: each part with its pages, in order; conf.py needs no Sphinx."""
    made = runpy.run_path(str(DOCS / "conf.py"))["contents"](INDEX)
    captions = re.findall(r"^:caption: (.+)$", made, re.MULTILINE)
    assert captions == re.findall(r"^## (.+)$", INDEX, re.MULTILINE)
    assert made.count("```{toctree}") == len(captions) >= 5
    named = re.findall(r"^([\w/-]+)$", made, re.MULTILINE)
    assert [f"{name}.md" for name in named] == [*links(LIST), "all-pages.md"]


def test_contributing_is_on_the_site() -> None:
    """Its page on the site is CONTRIBUTING.md, whose links lead somewhere from there."""
    made = runpy.run_path(str(DOCS / "conf.py"))["contributing"]()
    assert made.startswith("# Contributing\n")
    folder = DOCS / "contributing"
    found = links_of(made)
    assert len(found) >= 4
    for link in found:
        assert (folder / link.partition("#")[0]).is_file(), link


def test_the_site_has_what_programs_print() -> None:
    """Every field of JSON, every option, every name, below pages that are there."""
    conf = runpy.run_path(str(DOCS / "conf.py"))
    assert {f"{name}.md" for name in conf["MADE"]} <= set(pages())
    assert "\n### check\n" in conf["made"]("json-fields")
    assert "\n### gark check\n" in conf["made"]("command-line")
    assert "\n* `find_order(method, " in conf["made"]("python-reference")
    assert conf["made"]("gallery") == ""


def test_no_page_is_hidden_by_one_of_sphinx() -> None:
    """Sphinx has pages of its own for these names, and the margin would lead to them."""
    taken = {"search.md", "genindex.md", "modindex.md"}
    assert not taken & set(pages())


def test_what_scrolls_can_have_the_focus() -> None:
    """Transcripts and tables of the site are moved by arrow keys too; the rest stays as it is."""
    made = runpy.run_path(str(DOCS / "conf.py"))["scrollable"]
    html = '<p>a</p><pre>b</pre><div class="table-wrapper x"><table>'
    assert made(html) == (
        '<p>a</p><pre tabindex="0">b</pre><div tabindex="0" class="table-wrapper x"><table>'
    )


def test_links_have_titles_on_the_site() -> None:
    """Where a page shows the name of a file; other links stay, and so does what stands behind."""
    made = runpy.run_path(str(DOCS / "conf.py"))["titled"]
    text = "[gallery.md](gallery.md#a), [docs/gallery.md](gallery.md) and [this](gallery.md)"
    shown = "[Gallery](gallery.md#a), [Gallery](gallery.md) and [this](gallery.md)"
    assert made(text, DOCS) == shown
    above = made("[gallery.md](../gallery.md)", DOCS / "contributing")
    assert above == "[Gallery](../gallery.md)"


def test_indices_are_typeset_on_the_site() -> None:
    """Letters with indices or powers; code, names, links and formulas stay."""
    made = runpy.run_path(str(DOCS / "conf.py"))["typeset"]
    text = "A^{l,m}, H^{l} and b_ij, ω_s², h^(p+1)"
    shown = r"$A^{l,m}$, $H^{\{l\}}$ and $b_{ij}$, $ω_s^2$, $h^{p+1}$"
    assert made(text) == shown
    kept = "from_arrays, 1_000, `b_i`, $b_i$, [x](a_b.md)\n\n```text\nb_i\n```\n\n# b_i\n"
    assert made(kept) == kept


def test_long_names_have_places_to_break() -> None:
    """After a slash and a low line within code, and nowhere else."""
    made = runpy.run_path(str(DOCS / "conf.py"))["breakable"]
    html = '<a href="a_b/c">a_b</a><span class="pre">a/b_c/</span>'
    shown = '<a href="a_b/c">a_b</a><span class="pre">a/<wbr>b_<wbr>c/</span>'
    assert made(html) == shown


def test_columns_of_tables_have_names() -> None:
    """Whoever hears a table read aloud hears what its columns are: no head is empty."""
    head = re.compile(r"^\|(.*)\|\n\|[-:| ]+\|$", re.MULTILINE)
    for name in pages():
        text = (DOCS / name).read_text(encoding="utf-8")
        for found in head.finditer(text):
            cells = found.group(1).replace(r"\|", "").split("|")
            assert all(cell.strip() for cell in cells), (name, found.group(1))
