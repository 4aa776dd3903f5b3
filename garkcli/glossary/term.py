"""The terms of the field, from data/terms-*.toml."""

from __future__ import annotations

import re
from functools import lru_cache

from garkcli.frozen import Frozen
from garkcli.glossary import read

PAPER = (
    "A. Zanna, Discrete Variational Methods and Symplectic Generalized Additive Runge–Kutta Methods"
)


class Term(Frozen):
    """A term and its meaning; ``labels`` are its other names, also in reports."""

    name: str
    text: str
    formula: str = ""
    source: str = ""
    labels: tuple[str, ...] = ()
    see: tuple[str, ...] = ()


TOPICS = {
    "methods": "Methods and their parts",
    "orders": "Trees, conditions and orders",
    "geometry": "Symplectic methods over a long time",
    "stability": "Stability",
    "design": "Methods with unknowns",
    "reports": "What reports say",
}


@lru_cache(maxsize=len(TOPICS))
def terms_of(topic: str) -> tuple[Term, ...]:
    """Returns the terms of a topic; ``short`` in its file has abbreviations of sources."""
    entries = read(f"terms-{topic}")
    short = {"paper": PAPER, **entries.pop("short", {})}

    def full(source: str) -> str:
        first, *rest = re.split("(?=[,;])", source, maxsplit=1)
        return "".join([full(short[first]), *rest]) if first in short else source

    return tuple(
        Term(
            name,
            " ".join(entry["text"].split()),
            entry.get("formula", ""),
            full(entry.get("source", "")),
            tuple(entry.get("labels", ())),
            tuple(entry.get("see", ())),
        )
        for name, entry in entries.items()
    )


def plain(word: str) -> str:
    """Returns a word for comparison, in lower case without hyphens."""
    return " ".join(word.lower().replace("-", " ").replace("_", " ").removesuffix(":").split())


@lru_cache(maxsize=1)
def by_word() -> dict[str, Term]:
    every = [term for topic in TOPICS for term in terms_of(topic)]
    return {word: term for term in every for word in (term.name, *term.labels)}
