"""Plain text as LaTeX and BibTeX have it: letters with accents, signs that mean something there."""

from __future__ import annotations

import unicodedata

_SIGNS = {
    "\\": r"\textbackslash{}",
    "{": r"\{",
    "}": r"\}",
    "&": r"\&",
    "%": r"\%",
    "$": r"\$",
    "#": r"\#",
    "_": r"\_",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "ß": r"{\ss}",
    "ø": r"{\o}",
    "Ø": r"{\O}",
    "æ": r"{\ae}",
    "Æ": r"{\AE}",
    "œ": r"{\oe}",
    "Œ": r"{\OE}",
    "ł": r"{\l}",
    "Ł": r"{\L}",
    "đ": r"{\dj}",
    "ı": r"{\i}",
    "–": "--",
    "—": "---",
    "−": "$-$",
    "’": "'",
    "‘": "`",
    "“": "``",
    "”": "''",
    "×": r"$\times$",
    "\N{NO-BREAK SPACE}": "~",
}
_ACCENTS = {
    "\N{COMBINING GRAVE ACCENT}": "`",
    "\N{COMBINING ACUTE ACCENT}": "'",
    "\N{COMBINING CIRCUMFLEX ACCENT}": "^",
    "\N{COMBINING TILDE}": "~",
    "\N{COMBINING DIAERESIS}": '"',
    "\N{COMBINING MACRON}": "=",
    "\N{COMBINING DOT ABOVE}": ".",
    "\N{COMBINING BREVE}": "u ",
    "\N{COMBINING CARON}": "v ",
    "\N{COMBINING CEDILLA}": "c ",
    "\N{COMBINING OGONEK}": "k ",
    "\N{COMBINING RING ABOVE}": "r ",
    "\N{COMBINING DOUBLE ACUTE ACCENT}": "H ",
}
_DOTLESS = {"i": r"\i", "j": r"\j"}
_BASE = {"ß": "ss", "ø": "o", "æ": "ae", "œ": "oe", "ł": "l", "đ": "d"}


def letters(text: str) -> str:
    r"""A text in the letters of ASCII, signs of LaTeX as text.

    What has no such form, as a letter of another script, stays as it is.

    >>> print(letters("Störmer & Runge–Kutta, γ = 50 %"))
    St{\"o}rmer \& Runge--Kutta, $\gamma$ = 50 \%
    """
    return "".join(map(_letter, unicodedata.normalize("NFC", text)))


def _letter(sign: str) -> str:
    if sign in _SIGNS:
        return _SIGNS[sign]
    if sign.isascii():
        return sign
    base, *marks = list(unicodedata.normalize("NFD", sign))
    if len(marks) == 1 and base.isascii() and marks[0] in _ACCENTS:
        accent = _ACCENTS[marks[0]]
        above = accent not in {"c ", "k "}
        return rf"{{\{accent}{_DOTLESS.get(base, base) if above else base}}}"
    return _greek(sign)


def _greek(sign: str) -> str:
    """A Greek letter as LaTeX names it; any other sign as it is."""
    words = unicodedata.name(sign, "").split()
    if words[:1] != ["GREEK"] or "LETTER" not in words or len(words) != 4:
        return sign
    name = words[3].lower().replace("lamda", "lambda")
    command = name.capitalize() if words[1] == "CAPITAL" else name
    return rf"$\{command}$"


def ascii_letters(text: str) -> str:
    """The letters and digits of a text without their accents.

    >>> ascii_letters("Nørsett"), ascii_letters("van der Houwen"), ascii_letters("Kværnø")
    ('Norsett', 'vanderHouwen', 'Kvaerno')
    """
    spelt = "".join(map(_spelt, text))
    signs = unicodedata.normalize("NFD", spelt)
    return "".join(x for x in signs if x.isascii() and x.isalnum())


def _spelt(sign: str) -> str:
    """A letter that is no accented one, as it is spelt without it."""
    base = _BASE.get(sign.lower(), sign)
    return base.capitalize() if sign.isupper() else base
