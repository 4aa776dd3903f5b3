"""Publications, as in method files and bibliographies."""

from __future__ import annotations

from typing import TypeAlias

from garkcli.frozen import Frozen

ARXIV = "https://arxiv.org/abs/"
WORKS = ("article", "book", "chapter", "report", "software", "thesis", "web")


class Reference(Frozen, kw_only=True):
    """A publication, with the fields of method files; ``type`` is empty if the others determine it.

    Attributes:
        authors: each as printed, such as ``J. C. Butcher``.
        year: four digits, perhaps with a letter.
        number: of the issue or report.
        book: the title of the book of a chapter, or of proceedings.
        where: the place in the work, such as ``table 2``.
        coefficients: the source of the digits of the file.
    """

    authors: tuple[str, ...] = ()
    title: str = ""
    year: str = ""
    type: str = ""
    journal: str = ""
    volume: str = ""
    number: str = ""
    pages: str = ""
    book: str = ""
    editors: tuple[str, ...] = ()
    edition: str = ""
    publisher: str = ""
    institution: str = ""
    where: str = ""
    doi: str = ""
    url: str = ""
    note: str = ""
    coefficients: str = ""

    def __str__(self) -> str:
        parts = [", ".join(self.authors), self.title]
        parts += [f"in {self.book}"] if self.book else []
        parts.append(self._issue())
        parts += [self.pages, self.where]
        return ", ".join(part for part in parts if part)

    def _issue(self) -> str:
        home = self.journal or self.publisher or self.institution
        number = f"({self.number})" if self.number and self.volume else ""
        volume = f"{self.volume}{number}" or self.number
        known = " ".join(part for part in (home, volume) if part)
        if not self.year:
            return known
        return f"{known} ({self.year})" if known else self.year


Work: TypeAlias = "tuple[str, Reference | None]"
"""A publication in one line, with its fields if known."""

ZANNA = Reference(
    authors=("A. Zanna",),
    title="Discrete Variational Methods and Symplectic Generalized Additive Runge-Kutta Methods",
    year="2020",
    url=f"{ARXIV}2001.07185",
)
