"""Numbers and tableaus as they are set in books, on pages and in LaTeX: as plain text."""

from __future__ import annotations

import re
import unicodedata

_MINUS = dict.fromkeys("\N{MINUS SIGN}\N{EN DASH}", "-")
_BLANKS = dict.fromkeys(
    "\N{NO-BREAK SPACE}\N{THIN SPACE}\N{NARROW NO-BREAK SPACE}\N{EM SPACE}", " "
)
_SIGNS = str.maketrans({**_MINUS, **_BLANKS, "\N{FRACTION SLASH}": "/", "\N{DIVISION SLASH}": "/"})
_ROOT = "\N{SQUARE ROOT}"
_OF_LATEX = (
    (r"\\(?:begin|end)\{\w+\*?\}(?:\{[^{}]*\})?", "\n"),
    (r"\\(?:hline|[ct]?midrule|toprule|bottomrule)\b|\\cline\{[^{}]*\}", "\n"),
    (r"\\\\(?:\[[^\]]*\])?", "\n"),
    (r"\\[dt]?frac\s*([0-9])\s*([0-9])", r"\1/\2"),
    (r"\\[dt]?frac\s*\{([0-9]+)\}\s*\{([0-9]+)\}", r"\1/\2"),
    (r"\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}", r"(\1)/(\2)"),
    (r"\\sqrt\s*\{([^{}]*)\}|\\sqrt\s*([0-9])", r"sqrt(\1\2)"),
    (r"\\left|\\right|\\displaystyle|\\phantom\{[^{}]*\}|\$|\\[,;!:]", ""),
)
"""What LaTeX writes, and what it stands for; the inner ones first, again and again."""


def plain(text: str) -> str:
    r"""The text with the signs of a keyboard.

    >>> plain("½ − √3/6"), plain(r"$\frac{1}{2}$ & \frac12 \\ \hline")
    ('1/2 - sqrt(3)/6', '1/2 & 1/2 \n \n')
    """
    text = "".join(map(_fraction, _neighbours(text))).translate(_SIGNS)
    text = re.sub(rf"{_ROOT}\s*([0-9]+)", r"sqrt(\1)", text)
    text = re.sub(rf"{_ROOT}\s*\(", "sqrt(", text)
    if "\\" not in text and "$" not in text:
        return text
    before = ""
    while text != before:
        before = text
        # a root may stand in a fraction, and a fraction in a root
        for pattern, instead in _OF_LATEX:
            text = re.sub(pattern, instead, text)
    return text


def _neighbours(text: str) -> list[tuple[str, str]]:
    """Each sign with the one before it."""
    return list(zip(" " + text, text, strict=False))


def _fraction(pair: tuple[str, str]) -> str:
    """A fraction that is one sign, written out; not behind a digit, where it would be a sum."""
    before, sign = pair
    written = unicodedata.normalize("NFKC", sign)
    is_fraction = "\N{FRACTION SLASH}" in written and sign != written
    return written if is_fraction and not before.isdigit() else sign
