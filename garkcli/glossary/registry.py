"""The one list of terms, made of the files in ``terms``."""

from __future__ import annotations

from functools import lru_cache
from importlib import import_module

from garkcli.glossary.term import Term

TOPICS = {
    "methods": "Methods and their parts",
    "orders": "Trees, conditions and orders",
    "geometry": "Symplectic methods over a long time",
    "stability": "Stability",
    "design": "Methods with unknowns",
    "reports": "What reports say",
}
"""The files of ``terms`` in the order of the documentation, with what they are about."""


def terms_of(topic: str) -> tuple[Term, ...]:
    """The terms of a topic."""
    module = import_module(f"garkcli.glossary.terms.{topic}")
    found: tuple[Term, ...] = module.TERMS
    return found


def plain(word: str) -> str:
    """A word as it is compared: small letters, blanks for hyphens and underlines.

    >>> plain("Stiffly-Accurate")
    'stiffly accurate'
    """
    return " ".join(word.lower().replace("-", " ").replace("_", " ").split())


@lru_cache(maxsize=1)
def by_word() -> dict[str, Term]:
    """Every name and label with its term."""
    every = [term for topic in TOPICS for term in terms_of(topic)]
    return {word: term for term in every for word in (term.name, *term.labels)}
