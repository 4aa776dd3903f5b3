"""What a word means: a term, a claim, a key of a file, a family, the code of an error."""

from __future__ import annotations

import re
from functools import lru_cache

from garkcli.check.senses import (
    Meaning,
    Sense,
    claim_meaning,
    every_sense,
    fault_meaning,
    field_meanings,
    term_meaning,
)
from garkcli.errors import UNKNOWN, UsageProblem, did_you_mean
from garkcli.glossary.faults import code_of
from garkcli.glossary.fields import field_entries
from garkcli.glossary.labels import key_of
from garkcli.glossary.term import plain

__all__ = ["Meaning", "claim_meaning", "explain", "known_words", "term_meaning"]
_FIRST_VALUE = re.compile(r":? +(?=[-\d\[(≥∞])")
"""Where the label of a line ends: a number or a tree follows."""
_SURELY = 8
"""Letters that a pasted message has in common with one of the program."""


def explain(word: str) -> list[Meaning]:
    """What a word means, in every sense that it has: ``gark explain``.

    Args:
        word: a term, a label of a report, a claim, a key of a file with or without those above it,
            a family, a transfer rule, a scheme, a shape, a problem, the code of an error or of a
            finding, the message of an error, or a field of JSON reports; in any case, with hyphens
            or blanks.

    Raises:
        UsageProblem: nobody knows it.

    >>> from garkcli import explain
    >>> explain("density")[0].formula
    'γ(u) = ρ(u) Π γ(u_i), over the branches u_i'
    """
    exactly, nearly = [], []
    for sense, name in _known(plain(word)):
        if name == word:
            exactly.append(sense.mean(name))
        else:
            nearly.append(sense.mean(name))
    if not exactly and not nearly:
        return field_meanings(word) or field_meanings(key_of(word)) or [_of_message(word)]
    # b is a weight, and B a condition: letters alone are taken at their word
    is_letter = len(plain(word)) == 1
    return exactly if is_letter and exactly else _once(exactly + nearly)


def _known(word: str) -> list[tuple[Sense, str]]:
    """What a word leads to; of a line of a report what stands before a number or a tree."""
    every = _by_plain()
    if word not in every:
        label = _FIRST_VALUE.split(word)[0]
        return every.get(label, []) if len(label) > 1 else []
    return every[word]


def _once(found: list[Meaning]) -> list[Meaning]:
    """Meanings without those that another word has led to already."""
    return list(dict.fromkeys(found))


def _of_message(text: str) -> Meaning:
    """What a message of an error means.

    Raises:
        UsageProblem: it is none.
    """
    code = code_of(text, _SURELY)
    if code == UNKNOWN:
        raise UsageProblem(f"no word {text!r}", _near(text), code="unknown-word")
    return fault_meaning(code)


def _near(text: str) -> str:
    """The words that a misspelt one may be, or where all of them are found."""
    words = known_words()
    cure = did_you_mean(text, words)
    if not cure.startswith("one of"):
        return cure
    letters = plain(text)
    longer = [word for word in words if letters in plain(word).split()]
    if longer and letters:
        return did_you_mean(letters, longer)
    return "gark explain lists the terms"


@lru_cache(maxsize=1)
def _by_plain() -> dict[str, list[tuple[Sense, str]]]:
    """Every spelling with what it leads to."""
    found: dict[str, list[tuple[Sense, str]]] = {}
    for sense in every_sense():
        for name, spellings in sense.names.items():
            for spelling in {plain(x) for x in (name, *spellings)}:
                found.setdefault(spelling, []).append((sense, name))
    return found


def known_words() -> list[str]:
    """Every word that has a meaning, in order."""
    words = {name for sense in every_sense() for name in sense.names}
    return sorted(words | set(field_entries()))
