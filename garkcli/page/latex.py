"""LaTeX: letters of any script in its signs, and fragments of documents."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterable, Iterator

_SIGNS = {
    "\\": r"\textbackslash{}", "{": r"\{", "}": r"\}", "&": r"\&", "%": r"\%", "$": r"\$",
    "#": r"\#", "_": r"\_", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
    "<": r"\textless{}", ">": r"\textgreater{}", "LATIN SMALL LETTER SHARP S": r"{\ss}",
    "LATIN SMALL LETTER O WITH STROKE": r"{\o}", "LATIN CAPITAL LETTER O WITH STROKE": r"{\O}",
    "LATIN SMALL LETTER AE": r"{\ae}", "LATIN CAPITAL LETTER AE": r"{\AE}",
    "LATIN SMALL LIGATURE OE": r"{\oe}", "LATIN CAPITAL LIGATURE OE": r"{\OE}",
    "LATIN SMALL LETTER L WITH STROKE": r"{\l}", "LATIN CAPITAL LETTER L WITH STROKE": r"{\L}",
    "LATIN SMALL LETTER D WITH STROKE": r"{\dj}", "LATIN SMALL LETTER DOTLESS I": r"{\i}",
    "EN DASH": "--", "EM DASH": "---", "MINUS SIGN": "$-$", "RIGHT SINGLE QUOTATION MARK": "'",
    "LEFT SINGLE QUOTATION MARK": "`", "LEFT DOUBLE QUOTATION MARK": "``",
    "RIGHT DOUBLE QUOTATION MARK": "''", "MULTIPLICATION SIGN": r"$\times$", "NO-BREAK SPACE": "~",
}  # fmt: skip
"""LaTeX of characters, of others than ASCII by Unicode name."""
_ACCENTS = {
    "COMBINING GRAVE ACCENT": "`", "COMBINING ACUTE ACCENT": "'",
    "COMBINING CIRCUMFLEX ACCENT": "^", "COMBINING TILDE": "~", "COMBINING DIAERESIS": '"',
    "COMBINING MACRON": "=", "COMBINING DOT ABOVE": ".", "COMBINING BREVE": "u ",
    "COMBINING CARON": "v ", "COMBINING CEDILLA": "c ", "COMBINING OGONEK": "k ",
    "COMBINING RING ABOVE": "r ", "COMBINING DOUBLE ACUTE ACCENT": "H ",
}  # fmt: skip
"""LaTeX of accents by Unicode name."""
_DOTLESS = {"i": r"\i", "j": r"\j"}
_BASE = {
    "LATIN SMALL LETTER SHARP S": "ss",
    "LATIN SMALL LETTER O WITH STROKE": "o",
    "LATIN SMALL LETTER AE": "ae",
    "LATIN SMALL LIGATURE OE": "oe",
    "LATIN SMALL LETTER L WITH STROKE": "l",
    "LATIN SMALL LETTER D WITH STROKE": "d",
}


def letters(text: str) -> str:
    r"""Returns a text in ASCII, LaTeX escaped; letters of other scripts are unchanged.

    >>> print(letters("Störmer & Runge–Kutta, γ = 50 %"))
    St{\"o}rmer \& Runge--Kutta, $\gamma$ = 50 \%
    """
    return "".join(map(_letter, unicodedata.normalize("NFC", text)))


def _letter(sign: str) -> str:
    known = _SIGNS.get(sign if sign.isascii() else _name(sign))
    if known is not None or sign.isascii():
        return known or sign
    base, *marks = list(unicodedata.normalize("NFD", sign))
    accent = _ACCENTS.get(_name(marks[0])) if len(marks) == 1 else None
    if accent is not None and base.isascii():
        above = accent not in {"c ", "k "}
        return rf"{{\{accent}{_DOTLESS.get(base, base) if above else base}}}"
    return greek(sign)


def _name(sign: str) -> str:
    return unicodedata.name(sign, "") if len(sign) == 1 else ""


def greek(sign: str) -> str:
    """Returns a Greek letter as a command; other characters are unchanged."""
    words = _name(sign).split()
    if words[:1] != ["GREEK"] or "LETTER" not in words or len(words) != 4:
        return sign
    name = words[3].lower().replace("lamda", "lambda")
    command = name.capitalize() if words[1] == "CAPITAL" else name
    return rf"$\{command}$"


def ascii_letters(text: str) -> str:
    """Returns letters and digits without accents."""
    spelt = "".join(map(_spelt, text))
    return "".join(x for x in unicodedata.normalize("NFD", spelt) if x.isascii() and x.isalnum())


def _spelt(sign: str) -> str:
    base = _BASE.get(_name(sign.lower()), sign)
    return base.capitalize() if sign.isupper() else base


PREAMBLE = (
    r"\usepackage{amsmath,array,longtable,tikz}",
    r"\providecommand{\mathbbm}[1]{\mathbf{#1}} "
    r"% or \usepackage{bbm} for the paper's vector of ones",
)


def fragment(lines: Iterable[str], is_document: bool) -> Iterator[str]:
    """Yields a complete document, or the lines after a comment about the preamble."""
    if is_document:
        yield "\\documentclass{article}\n"
        yield from (line + "\n" for line in PREAMBLE)
        yield "\\usepackage[margin=2cm]{geometry}\n\\begin{document}\n"
        yield from lines
        yield "\\end{document}\n"
        return
    yield "% the preamble needs\n"
    yield from (f"%   {line}\n" for line in PREAMBLE)
    yield from lines
