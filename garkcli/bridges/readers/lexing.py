"""Sources of Mathematica as tokens: numbers, names, texts and signs with their lines."""

from __future__ import annotations

import re
from functools import cache

from garkcli.frozen import Frozen
from garkcli.sources.found import TooLarge

MAX_TOKENS = 1_000_000
"""Most tokens of a source."""


class Token(Frozen):
    """A piece of a source.

    Attributes:
        kind: ``number``, ``name``, ``text``, ``sign``, ``line`` (an end of line), ``comment`` or
            ``end``.
        text: as it is written; of a text what is between its quotes.
        line: from 1.
        is_spaced: whether blanks stand before it.
    """

    kind: str
    text: str
    line: int
    is_spaced: bool = False


class Language(Frozen):
    """How a language is cut into tokens.

    Attributes:
        comments: patterns of comments.
        texts: patterns of texts in quotes.
        names: the pattern of names.
        suffix: what may stand behind the digits of a number and says nothing.
        joined: the pattern of an end of line that ends nothing.
    """

    comments: tuple[str, ...]
    texts: tuple[str, ...]
    names: str = r"[^\W\d]\w*"
    suffix: str = ""
    joined: str = r"\\\r?\n"


MATHEMATICA = Language(
    comments=(r"\(\*[\s\S]*?(?:\*\)|\Z)",),
    texts=(r'"(?:[^"\\]|\\[\s\S])*+"?+',),
    names=r"[^\W\d_][^\W_]*",
    suffix=r"(?:`{1,2}[0-9.]*)?(?:\*\^[+-]?[0-9]{1,4})?",
)

_NUMBER = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eEdD][+-]?[0-9]+)?"
_SIGNS = r"->|//|\*\*|\./|\.\*|\.\^|::|==|!=|<=|>=|&&|\|\||:=|[^\s\w]|_"


@cache
def _pattern(language: Language) -> re.Pattern[str]:
    """One pattern for the tokens of a language; no alternative of it is ever tried twice at a
    place.
    """
    comments = "|".join(language.comments)
    texts = "|".join(language.texts)
    parts = (
        rf"(?P<blank>[ \t\f\v\r]+|{language.joined})",
        r"(?P<line>\n)",
        rf"(?P<comment>{comments})",
        rf"(?P<text>{texts})",
        rf"(?P<number>{_NUMBER}){language.suffix}",
        rf"(?P<name>{language.names})",
        rf"(?P<sign>{_SIGNS})",
        r"(?P<other>[\s\S])",
    )
    return re.compile("|".join(parts))


def tokens_of(text: str, language: Language) -> list[Token]:
    """The tokens of a source, with one of kind ``end`` behind them.

    Raises:
        TooLarge: it has too many.

    >>> [x.text for x in tokens_of("b = {1.0`20, .5}; (* half *)", MATHEMATICA)][:6]
    ['b', '=', '{', '1.0', ',', '0.5']
    """
    found: list[Token] = []
    line = 1
    is_spaced = False
    for match in _pattern(language).finditer(text):
        kind = match.lastgroup or "other"
        whole = match.group()
        if kind in {"blank", "other"}:
            is_spaced = True
        else:
            shown = match.group(kind)
            if kind == "text":
                shown = shown.strip(shown[0])
            if kind == "number":
                shown = _plain_number(whole, shown)
            found.append(Token(kind, shown, line, is_spaced))
            is_spaced = False
        line += whole.count("\n")
        if len(found) >= MAX_TOKENS:
            raise TooLarge(f"the source has more than {MAX_TOKENS} words and signs", line)
    found.append(Token("end", "", line))
    return found


def _plain_number(whole: str, digits: str) -> str:
    """A number as method files write it: exponents with e, without what says its kind."""
    _, power, exponent = whole.partition("*^")
    plain = digits.lower().replace("d", "e")
    if plain.startswith("."):
        plain = f"0{plain}"
    if power and "e" not in plain:
        return f"{plain}e{int(exponent)}"
    return plain


def without(tokens: list[Token], *kinds: str) -> list[Token]:
    """The tokens that are of no such kind; where one is left out the next is set apart."""
    kept: list[Token] = []
    is_parted = False
    for token in tokens:
        if token.kind in kinds:
            is_parted = True
            continue
        if is_parted and not token.is_spaced:
            token = Token(token.kind, token.text, token.line, is_spaced=True)
        kept.append(token)
        is_parted = False
    return kept
