"""The meanings of a word: a term, a claim, a key of a file, a family, a fault."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from functools import lru_cache

from garkcli.errors import UNKNOWN, UsageProblem, did_you_mean
from garkcli.frozen import Frozen
from garkcli.glossary.faults import COMMANDS, by_code, code_of, findings_of
from garkcli.glossary.fields import field_entries
from garkcli.glossary.key import KINDS, keys_of
from garkcli.glossary.labels import key_of
from garkcli.glossary.term import Term, by_word, plain


class Meaning(Frozen):
    """One meaning of a word.

    Attributes:
        kind: a term, a claim, a key, …
        name: the word.
        text: the meaning in full sentences.
        formula: the definition as a formula, if there is one.
        values: the values of a claim.
        scope: the methods to which a claim applies; empty for all.
        default: the default of a key, if there is one.
        example: a line of a file with it, or an example of the fault.
        cure: what to do about a fault or a finding.
        source: the reference or the page.
        see: related words.
    """

    kind: str
    name: str
    text: str
    formula: str = ""
    values: str = ""
    scope: str = ""
    default: str = ""
    example: str = ""
    cure: str = ""
    source: str = ""
    see: tuple[str, ...] = ()

    def __repr__(self) -> str:
        return f"<Meaning {self.name}: {self.kind}>"


class Sense(Frozen):
    names: Mapping[str, tuple[str, ...]]
    mean: Callable[[str], Meaning]


def every_sense() -> Iterator[Sense]:
    yield Sense(_plainly(by_word()), lambda word: term_meaning(by_word()[word]))
    from garkcli.methodfile.expectations import CLAIMS

    claims = {key: (f"expect.{key}", key.replace("-", "_")) for key in CLAIMS}
    yield Sense(claims, claim_meaning)
    for kind in KINDS:
        yield _keys(kind)
    yield from _choices()
    for command in COMMANDS:
        yield _findings(command)
    yield Sense(_plainly(by_code()), fault_meaning)


def _plainly(names: Mapping[str, object]) -> dict[str, tuple[str, ...]]:
    return dict.fromkeys(names, ())


def term_meaning(term: Term) -> Meaning:
    return Meaning(
        "term", term.name, term.text, formula=term.formula, source=term.source, see=term.see
    )


def claim_meaning(key: str) -> Meaning:
    from garkcli.properties.definitions import definition

    meaning = definition(key)
    return Meaning(
        "claim under expect",
        key,
        meaning.text,
        values=meaning.values.replace("`", ""),
        scope=meaning.meaning,
        source=meaning.source,
    )


def _keys(kind: str) -> Sense:
    keys = keys_of(kind)

    def mean(path: str) -> Meaning:
        key = keys[path]
        default = "" if key.default is None else str(key.default)
        if isinstance(key.default, bool):
            default = default.lower()
        return Meaning(
            f"key of {KINDS[kind].files}",
            path,
            key.text,
            default=default,
            example=key.example,
            source=key.page,
        )

    names = {path: (path.rpartition(".")[2],) if x.is_word else () for path, x in keys.items()}
    return Sense(names, mean)


def _choices() -> Iterator[Sense]:
    from garkcli.constructions.schemes import SCHEMES, SPLITTINGS
    from garkcli.families.registry import FAMILIES
    from garkcli.methodfile.shapes import SHAPES
    from garkcli.problems.builtin import PROBLEMS
    from garkcli.transfer import SUMMARIES

    families = {name: f"{sentence(x.summary)} {_order(x.order)}" for name, x in FAMILIES.items()}
    yield _listed("family of methods", families)
    yield _listed("transfer rule", SUMMARIES)
    for kind, schemes in (("compose", SCHEMES), ("splitting", SPLITTINGS)):
        texts = {name: f"{sentence(x.summary)} Order {x.order}." for name, x in schemes.items()}
        sources = {name: x.reference for name, x in schemes.items()}
        yield _listed(f"scheme of {kind}", texts, sources)
    shapes = {name: x.summary for name, x in SHAPES.items()}
    yield _listed("shape of unknown tableaus", shapes, dict.fromkeys(SHAPES, "docs/design.md"))
    yield _listed("problem", {name: x.summary for name, x in PROBLEMS.items()})


def _order(order: str) -> str:
    return f"The key {order} sets the order." if order.isalpha() else f"Order {order}."


def _listed(kind: str, texts: Mapping[str, str], sources: Mapping[str, str] | None = None) -> Sense:
    def mean(name: str) -> Meaning:
        source = (sources or {}).get(name) or "gark list"
        return Meaning(kind, name, sentence(texts[name]), source=source)

    return Sense(_plainly(texts), mean)


def _findings(command: str) -> Sense:
    kinds = findings_of(command)

    def mean(code: str) -> Meaning:
        finding = kinds[code]
        return Meaning(
            f"finding of gark {command}",
            code,
            finding.text,
            cure=finding.cure,
            source=COMMANDS[command],
        )

    return Sense(_plainly(kinds), mean)


def fault_meaning(code: str) -> Meaning:
    kind = by_code()[code]
    return Meaning(
        "error", code, kind.text, example=kind.example, cure=kind.cure, source="docs/bad-input.md"
    )


def field_meanings(word: str) -> list[Meaning]:
    wanted = plain(word)
    meanings = []
    for name, text in field_entries().items():
        if wanted in {plain(name), plain(name.rpartition(".")[2])}:
            kind, page = "field of JSON reports", "docs/json-fields.md"
            meanings.append(Meaning(kind, name, text, source=page))
    return meanings


def sentence(text: str) -> str:
    """Returns a remark as a sentence; a formula at its start keeps its case."""
    begun = text[:1].upper() + text[1:] if re.match(r"[a-z]+\b(?! =)", text) else text
    return begun if begun.endswith(".") else f"{begun}."


__all__ = ["Meaning", "claim_meaning", "explain", "known_words", "term_meaning"]
_FIRST_VALUE = re.compile(r":? +(?=[-\d\[(≥∞])")
"""The end of the label of a line: a number or a tree follows."""
_SURELY = 8
"""Letters that a pasted message shares with one of the program."""


LETTERS = {"γ": ("gamma", "density")}
"""Letters of formulas by their meanings, the usual one first."""
GENERAL = {
    re.compile(r"^b ?\(\d+\)$"): "b(r)",
    re.compile(r"^c ?\(\d+\)$"): "c(η)",
    re.compile(r"^d ?\(\d+\)$"): "d(ζ)",
    re.compile(r"\bstability$"): "stable",
}
"""Words with a number or an ending of their own, and their entries."""


def explain(word: str) -> list[Meaning]:
    """The meanings of a word, as in ``gark explain``.

    Args:
        word: a term, label, claim, key, family, rule, scheme, shape, problem, code, message of an
            error, or JSON field; in any case, with hyphens or blanks.

    Raises:
        UsageProblem: nobody knows it.

    >>> from garkcli import explain
    >>> explain("density")[0].formula
    'γ(u) = ρ(u) Π γ(u_i), over the branches u_i'
    """
    if word in LETTERS:
        first = [explain(x)[0] for x in LETTERS[word]]
        return list(dict.fromkeys([*first, *explain(LETTERS[word][0])]))
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
    return exactly if is_letter and exactly else list(dict.fromkeys(exactly + nearly))


def _known(word: str) -> list[tuple[Sense, str]]:
    every = _by_plain()
    for pattern, general in GENERAL.items():
        word = word if word in every else pattern.sub(general, word)
    if word not in every:
        label = _FIRST_VALUE.split(word)[0]
        return every.get(label, []) if len(label) > 1 else []
    return every[word]


def _of_message(text: str) -> Meaning:
    code = code_of(text.removeprefix("gark: "), _SURELY)
    if code == UNKNOWN:
        raise UsageProblem(f"no word {text!r}", _near(text), code="unknown-word")
    return fault_meaning(code)


def _near(text: str) -> str:
    words = known_words()
    cure = did_you_mean(text, words)
    if not cure.startswith("one of"):
        return cure
    letters = plain(text)
    longer = [word for word in words if letters in plain(word).split()]
    return did_you_mean(letters, longer) if longer and letters else "gark explain lists the terms"


@lru_cache(maxsize=1)
def _by_plain() -> dict[str, list[tuple[Sense, str]]]:
    senses: dict[str, list[tuple[Sense, str]]] = {}
    for sense in every_sense():
        for name, spellings in sense.names.items():
            for spelling in {plain(x) for x in (name, *spellings)}:
                senses.setdefault(spelling, []).append((sense, name))
    return senses


def known_words() -> list[str]:
    words = {name for sense in every_sense() for name in sense.names}
    return sorted(words | set(field_entries()))
