"""No page says the same as another: what is said once is linked to from elsewhere."""

from __future__ import annotations

import re
from collections.abc import Iterator

from tests.cli.harness import ROOT
from tests.docs.blocks import pages
from tests.docs.test_links import without_code

LENGTH = 9
"""Words in a row that two pages may not share; those of one or two letters do not count, so that
formulas are left out.
"""

MADE = re.compile(r"<!-- (\w+) -->.*?(?:<!-- end of \1 -->|\Z)", re.DOTALL)
"""What the program makes of a page, which has it from one place."""

TITLES = (
    "discrete variational methods and symplectic generalized additive runge kutta methods",
    "symplectic methods based on decompositions",
)
"""Works that several pages cite."""

ELSEWHERE = {"index.md", "package-page.md", "glossary.md", "style.md"}
"""The landing page, which begins as the README does; the page of a package index; a page that is
made; the page of style, which quotes.
"""


def words(text: str) -> list[str]:
    """What people read of a page: no code, no targets of links, no signs, ``§`` for titles."""
    by_hand = MADE.sub("", text)
    shown = re.sub(r"\]\([^)]*\)", "]", without_code(by_hand))
    plain = " ".join(re.findall(r"[^\W_]+", shown.lower()))
    for title in TITLES:
        plain = plain.replace(title, "§§§")
    return [word for word in plain.split() if len(word) > 2]


def runs(text: str) -> Iterator[tuple[str, ...]]:
    """Every ``LENGTH`` words in a row without a title among them."""
    found = words(text)
    for start in range(len(found) - LENGTH + 1):
        run = tuple(found[start : start + LENGTH])
        if "§§§" not in run:
            yield run


def shared(texts: dict[str, str]) -> list[str]:
    """What two pages have in common, with their names."""
    first: dict[tuple[str, ...], str] = {}
    found = []
    for page, text in texts.items():
        for run in runs(text):
            other = first.setdefault(run, page)
            if other != page:
                found.append(f"{other}, {page}: {' '.join(run)}")
    return found


def texts() -> dict[str, str]:
    """The pages by their names."""
    by_hand = [page for page in pages() if page.name not in ELSEWHERE]
    return {str(page.relative_to(ROOT)): page.read_text(encoding="utf-8") for page in by_hand}


def test_no_sentence_stands_on_two_pages() -> None:
    """Not even a long part of one; references apart."""
    assert shared(texts()) == []


def test_a_sentence_on_two_pages_is_found() -> None:
    """Across lines and links; code and what is made do not count."""
    said = "one two three four five six seven eight nine"
    linked = said.replace(" three ", " [three](b.md#c)\n").title()
    assert len(shared({"a": f"# A\n\n{said}\n", "b": linked})) == 1
    assert not shared({"a": said, "b": f"```text\n{said}\n```\n"})
    made = f"x\n\n<!-- made -->\n\n{said}\n"
    assert not shared({"a": said, "b": made})
    assert shared({"a": said, "b": f"{made}<!-- end of made -->\n{said}\n"})
