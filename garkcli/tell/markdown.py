"""The signs of Markdown."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import TYPE_CHECKING

from garkcli.errors import printable
from garkcli.tell.dialect import WHOLE, Cells, GridLayout, Plain

if TYPE_CHECKING:
    from garkcli.tableau.pointwise import Entries
    from garkcli.tableau.tableau import Tableau


class Markdown(Plain):
    breadth = "any"

    def prose(self, text: str) -> str:
        for sign in "\\|*_`[]<":
            text = text.replace(sign, f"\\{sign}" if sign != "<" else "&lt;")
        return printable(text)

    def expression(self, text: str, latex: Callable[[], str] | None = None) -> str:
        return self.prose(text)

    def good(self, text: str) -> str:
        return text

    bad = note = good

    def strong(self, text: str) -> str:
        return f"**{text}**"

    def code(self, text: str) -> str:
        return f"`{text}`"

    def headline(self, text: str) -> list[str]:
        return [self.strong(text), ""]

    def title(self, text: str, depth: int) -> list[str]:
        return [f"{'#' * (depth + 2)} {text}", ""]

    def sentence(self, text: str, depth: int = 1) -> list[str]:
        return [f"{text.removesuffix('.')}.", ""]

    def rows(self, rows: Sequence[tuple[str, str]], depth: int = 1) -> list[str]:
        return ["| | |", "|---|---|", *(f"| {label} | {text} |" for label, text in rows), ""]

    def grid(self, head: Cells, rows: Iterable[Cells], how: GridLayout = WHOLE) -> Iterator[str]:
        yield f"| {' | '.join(head)} |"
        yield "|---" * len(head) + "|"
        for row in rows:
            yield f"| {' | '.join(row)} |"
        yield ""

    def more(self, count: int, depth: int) -> list[str]:
        return [*super().more(count, 0), ""]

    def tableau(self, tableau: Tableau, entries: Entries) -> list[str]:
        return self.picture(super().tableau(tableau, entries)[1:], 0)

    def picture(self, lines: Sequence[str], depth: int) -> list[str]:
        return ["```text", *lines, "```", ""]

    def page(self, lines: Iterable[str]) -> Iterator[str]:
        return (f"{line}\n" for line in lines)
