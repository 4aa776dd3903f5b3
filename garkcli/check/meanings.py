"""What a word means: a term, a claim, a key of method files, a family, a finding."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from garkcli.check.findings import KINDS
from garkcli.errors import UsageProblem, did_you_mean
from garkcli.glossary.registry import by_word, plain
from garkcli.glossary.term import Term

if TYPE_CHECKING:
    from garkcli.constructions.schemes.flows import Splitting
    from garkcli.constructions.schemes.scheme import Scheme


@dataclass(frozen=True)
class Meaning:
    """What a word means in one of its senses.

    Attributes:
        kind: what it is: a term, a claim, a key, …
        name: as it is written.
        text: in whole sentences.
        formula: the definition in signs; empty where there is none.
        values: of a claim, how it is written.
        scope: of a claim, for which methods it has a meaning; empty for all.
        source: where it comes from.
        see: words near it.
    """

    kind: str
    name: str
    text: str
    formula: str = ""
    values: str = ""
    scope: str = ""
    source: str = ""
    see: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<Meaning {self.name}: {self.kind}>"


def meanings(word: str) -> list[Meaning]:
    """What a word means, in every sense that it has: ``gark explain``.

    Args:
        word: a term, a label of a report, a claim, a key of method files, a family, a transfer
            rule, a scheme, a shape, or the code of a finding; in any case, with hyphens or blanks.

    Raises:
        UsageProblem: nobody knows it.

    >>> meanings("density")[0].formula
    'γ(u) = ρ(u) Π γ(u_i), over the branches u_i'
    """
    wanted = plain(word)
    exactly, nearly = [], []
    for make, names in _senses():
        for name in names:
            if name == word:
                exactly.append(make(name))
            elif plain(name) == wanted:
                nearly.append(make(name))
    if not exactly and not nearly:
        cure = did_you_mean(word, known_words())
        raise UsageProblem(f"no word {word!r}", cure)
    # b is a weight, and B a condition: letters alone are taken at their word
    return exactly if len(wanted) == 1 and exactly else exactly + nearly


Sense = tuple[Callable[[str], Meaning], "list[str]"]


def _senses() -> Iterator[Sense]:
    """Every kind of word: what makes its meaning, and which there are."""
    yield _term, list(by_word())
    yield claim_meaning, list(_claims())
    yield _key, list(_keys())
    yield _design_key, list(_keys("design"))
    yield _family, list(_families())
    yield _rule, list(_rules())
    yield _scheme, list(_schemes())
    yield _splitting, list(_splittings())
    yield _finding, list(KINDS)


def known_words() -> list[str]:
    """Every word that has a meaning, in order."""
    return sorted({name for _, names in _senses() for name in names})


def _term(word: str) -> Meaning:
    return term_meaning(by_word()[word])


def term_meaning(term: Term) -> Meaning:
    """A term of the glossary as the meaning of a word."""
    return Meaning(
        "term",
        term.name,
        term.text,
        formula=term.formula,
        source=term.source,
        see=term.see,
    )


def _claims() -> tuple[str, ...]:
    from garkcli.methodfile.expectations import CLAIMS

    return CLAIMS


def claim_meaning(key: str) -> Meaning:
    """What a claim of a method file means.

    Raises:
        UsageProblem: there is no such claim.
    """
    from garkcli.properties.definitions import definition

    found = definition(key)
    return Meaning(
        "claim under expect",
        key,
        found.text,
        values=found.values.replace("`", ""),
        scope=found.meaning,
        source=found.source,
    )


def _keys(inside: str = "") -> Mapping[str, Any]:
    """The keys of method files with their schemas."""
    from garkcli.methodfile.schema import method_file_schema

    schema: Any = method_file_schema()
    keys: dict[str, Any] = schema["properties"]
    if not inside:
        return keys
    within: dict[str, Any] = keys[inside]["properties"]
    return within


def _key(key: str) -> Meaning:
    text = _described(_keys()[key])
    source = "docs/method-file.md"
    return Meaning("key of method files", key, text, source=source)


def _described(entry: Mapping[str, Any]) -> str:
    """What the schema of a key says of it, or the definition that it refers to."""
    if "description" in entry:
        return str(entry["description"])
    from garkcli.methodfile.schema import method_file_schema

    schema: Any = method_file_schema()
    _, _, name = entry["$ref"].rpartition("/")
    return str(schema["definitions"][name]["description"])


def _design_key(key: str) -> Meaning:
    text = _sentence(_described(_keys("design")[key]))
    return Meaning("key under design", key, text, source="docs/design.md")


def _families() -> Mapping[str, Any]:
    from garkcli.families.registry import FAMILIES

    return FAMILIES


def _family(name: str) -> Meaning:
    family = _families()[name]
    text = f"{_sentence(family.summary)} Order {family.order}."
    return Meaning("family of methods", name, text, source="gark list")


def _rules() -> Mapping[str, str]:
    from garkcli.transfer import SUMMARIES

    return SUMMARIES


def _rule(name: str) -> Meaning:
    return Meaning(
        "transfer rule", name, _sentence(_rules()[name]), source="gark list"
    )


def _schemes() -> Mapping[str, Scheme]:
    from garkcli.constructions.schemes.registry import SCHEMES

    return SCHEMES


def _scheme(name: str) -> Meaning:
    found = _schemes()[name]
    text = f"{_sentence(found.summary)} Order {found.order}."
    return Meaning("scheme of compose", name, text, source=found.reference)


def _splittings() -> Mapping[str, Splitting]:
    from garkcli.constructions.schemes.flows import SPLITTINGS

    return SPLITTINGS


def _splitting(name: str) -> Meaning:
    found = _splittings()[name]
    text = f"{_sentence(found.summary)} Order {found.order}."
    source = found.reference or "gark list"
    return Meaning("scheme of splitting", name, text, source=source)


def _finding(code: str) -> Meaning:
    text = _sentence(KINDS[code].text)
    return Meaning("finding of gark check", code, text, source="docs/ci.md")


def _sentence(text: str) -> str:
    """A remark as a sentence."""
    begun = text[:1].upper() + text[1:]
    return begun if begun.endswith(".") else f"{begun}."
