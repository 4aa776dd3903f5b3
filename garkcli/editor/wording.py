"""The meaning of the word at the cursor, and the words that may come there."""

from __future__ import annotations

import re
from collections.abc import Iterator

from garkcli import catalogue
from garkcli.check.meanings import claim_meaning, explain
from garkcli.errors import UsageProblem
from garkcli.families.registry import BY_STAGES, FAMILIES
from garkcli.frozen import Frozen
from garkcli.glossary.key import keys_of
from garkcli.methodfile.expectations import CLAIMS
from garkcli.transfer import SUMMARIES

_WORD = re.compile(r"[\w*-]+")
_KEY = re.compile(r"^(\s*(?:- )?)([\w-]+):")
_OPEN = re.compile(r"([\w-]+):\s*(?:\[\s*)?\{[^{}]*$")
_VALUE = re.compile(r"([\w-]+):\s*(?:\[[^\]]*)?[\w*-]*$")


class Suggestion(Frozen):
    word: str
    text: str
    written: str


def meaning_at(lines: list[str], line: int, column: int) -> str:
    text = lines[line] if line < len(lines) else ""
    found = next((x for x in _WORD.finditer(text) if x.start() <= column <= x.end()), None)
    if found is None:
        return ""
    word = found[0]
    if text[found.end() :].lstrip().startswith(":"):
        above = _above(lines, line, text[: found.start()])
        keys = keys_of("method")
        key = keys.get(".".join([*above, word])) or keys.get(word)
        if above == ["expect"] and word in CLAIMS:
            return f"**{word}**: {claim_meaning(word).text}"
        if key is not None:
            default = "" if key.default is None else f"\n\nBy default {key.default}."
            return f"**{key.path}**: {key.text}{default}\n\n```yaml\n{key.example}\n```"
    if word in SUMMARIES:
        return f"**{word}**: {SUMMARIES[word]}"
    family = FAMILIES.get(word.rstrip("0123456789").rstrip("-")) or FAMILIES.get(word)
    if family is not None:
        return f"**{family.name}**: {family.summary}"
    if word[0].isdigit():
        return ""
    try:
        meaning = explain(word)[0]
    except UsageProblem:
        return ""
    formula = f"\n\n`{meaning.formula}`" if meaning.formula else ""
    return f"**{meaning.name}** ({meaning.kind}): {meaning.text}{formula}"


def choices_at(lines: list[str], line: int, column: int) -> list[Suggestion]:
    before = (lines[line] if line < len(lines) else "")[:column]
    value = _VALUE.search(before)
    if value is not None and not _OPEN.search(before):
        return [*_values(value[1])]
    inside = re.search(r"([\w-]+):\s*[\w*-]*$", before)
    if inside is not None:
        return [*_values(inside[1])]
    above = _above(lines, line, before)
    return [*_keys(above)]


def _values(key: str) -> Iterator[Suggestion]:
    if key == "family":
        yield from (Suggestion(x, family.summary, x) for x, family in FAMILIES.items())
    if key in ("transfer", "rule", "default", "blocks"):
        yield from (Suggestion(x, text, x) for x, text in SUMMARIES.items())
    if key in ("methods", "method", "adjoint", "extrapolate", "of"):
        for name, family in BY_STAGES.items():
            member = name if family.is_single else f"{name}-{max(2, family.smallest)}"
            yield Suggestion(member, family.summary, member)
        yield from (
            Suggestion(name, "a method of the catalogue", name) for name in sorted(catalogue)
        )


def _keys(above: list[str]) -> Iterator[Suggestion]:
    # those of expect are the claims
    if above == ["expect"]:
        yield from (Suggestion(x, claim_meaning(x).text, f"{x}: ") for x in CLAIMS)
    prefix = "".join(f"{key}." for key in above)
    for path, key in keys_of("method").items():
        name = path.removeprefix(prefix)
        if path.startswith(prefix) and name and "." not in name:
            yield Suggestion(name, key.text, f"{name}: ")


def _above(lines: list[str], line: int, before: str) -> list[str]:
    """The keys around a place: those less indented, and the one whose braces are open."""
    inside = _OPEN.search(before)
    own = _KEY.match(before)
    indent = len(own[1]) if own and inside else len(before) - len(before.lstrip(" -"))
    found: list[str] = []
    for text in reversed(lines[:line]):
        key = _KEY.match(text)
        if key is not None and len(key[1]) < indent:
            indent = len(key[1])
            found.insert(0, key[2])
        if not indent:
            break
    if inside is not None:
        first = [own[2]] if own is not None and own[2] != inside[1] else []
        found += [*first, inside[1]]
    return found
