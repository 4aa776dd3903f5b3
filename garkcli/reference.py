"""A publication, as method files and bibliographies have it."""

from __future__ import annotations

from typing import TypeAlias

from garkcli.frozen import Frozen

ARXIV = "https://arxiv.org/abs/"
"""Where preprints are."""
WORKS = ("article", "book", "chapter", "report", "software", "thesis", "web")
"""What ``type`` says of a publication."""


class Reference(Frozen, kw_only=True):
    """A publication, in the words of the method file.

    Attributes:
        authors: each as printed, such as ``J. C. Butcher``.
        title: of the work.
        year: four digits, perhaps with a letter.
        type: one of ``WORKS``; empty where the other fields tell.
        journal: in which it appeared.
        volume: of the journal or of the series.
        number: the issue, or that of a report.
        pages: from and to.
        book: the title of the book of a chapter, or of proceedings.
        editors: of that book.
        edition: such as ``2``.
        publisher: of a book.
        institution: of a report or a thesis.
        where: the place in the work, such as ``table 2``.
        doi: without the address before it.
        url: an address of its own.
        note: anything else that a reader of the reference needs.
        coefficients: where the digits of the file come from.
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
        """The reference in one line.

        >>> str(Reference(authors=("C. Runge",), title="On", year="1895", journal="M", volume="46"))
        'C. Runge, On, M 46 (1895)'
        """
        parts = [", ".join(self.authors), self.title]
        parts += [f"in {self.book}"] if self.book else []
        parts.append(self._issue())
        parts += [self.pages, self.where]
        return ", ".join(part for part in parts if part)

    def _issue(self) -> str:
        """The journal with volume, number and year, or who printed it."""
        home = self.journal or self.publisher or self.institution
        number = f"({self.number})" if self.number and self.volume else ""
        volume = f"{self.volume}{number}" or self.number
        known = " ".join(part for part in (home, volume) if part)
        if not self.year:
            return known
        return f"{known} ({self.year})" if known else self.year


Work: TypeAlias = "tuple[str, Reference | None]"
"""A publication in one line, with its fields where it has them."""

ZANNA = Reference(
    authors=("A. Zanna",),
    title="Discrete Variational Methods and Symplectic Generalized Additive Runge-Kutta Methods",
    year="2020",
    url=f"{ARXIV}2001.07185",
)
"""The paper that gark implements."""
