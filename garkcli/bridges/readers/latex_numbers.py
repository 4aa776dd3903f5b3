r"""Numbers in LaTeX of method files: ``\frac{1}{2} - \frac{\sqrt{3}}{6}``."""

from __future__ import annotations

import re

from garkcli.sources.found import Unreadable

MAX_CELL = 40_000
MAX_COMMANDS = 2_000
_IGNORED = re.compile(
    r"[$~ \t\r\n]|\\(?:quad|qquad|displaystyle|textstyle|left|right"
    r"|bigl?|bigr?|Bigl?|Bigr?|mathstrut)(?![A-Za-z])|\\[,;:!> ]"
)
_ROOT_OF = re.compile(r"\\operatorname\{root\}\(([-+0-9x^{}/]{1,4000}),x\\approx(-?[0-9.]{1,60})\)")
_LETTER = r"\\(?:gamma|xi|eta|zeta)(?![A-Za-z])"
_DEFINED = re.compile(rf"= 0, \\quad ({_LETTER}) \\approx (-?[0-9.]{{1,60}})")
"""The words after a polynomial in a letter: it is zero, and a decimal near the letter."""
MAX_POLYNOMIAL = 400
_ONE = r"(?:\{([^{}]*)\}|([0-9]))"
_COMMANDS = (
    (re.compile(rf"\\(?:[tdcs]|nice)?frac{_ONE}{_ONE}"), r"((\1\2)/(\3\4))"),
    (re.compile(rf"\\sqrt\[([0-9]+)\]{_ONE}"), r"root(\2\3,\1)"),
    (re.compile(rf"\\sqrt{_ONE}"), r"sqrt(\1\2)"),
    (re.compile(r"(?<![a-z\]}])\{([^{}]*)\}(?!\{)"), r"(\1)"),
)
"""Braces without commands inside are replaced first."""
_PLAIN = re.compile(r"(?:sqrt|root_of\([-+*/^().0-9x]*,|root|[-+*/^().,0-9])*")


def without_letters(text: str) -> str:
    r"""The text with roots in place of the letters that it defines.

    >>> text = r"\[ \xi ^{3}-2 = 0, \quad \xi \approx 1.26 \]; \frac{1}{\xi }"
    >>> print(without_letters(text).split("; ")[1])
    \frac{1}{\operatorname{root}(x^{3}-2,x\approx1.26)}
    """
    roots: dict[str, str] = {}
    for found in _DEFINED.finditer(text):
        letter, near = found.groups()
        before = text[max(found.start() - MAX_POLYNOMIAL, 0) : found.start()]
        polynomial = before.rpartition(r"\[")[2].replace(letter, "x").replace(" ", "")
        if re.fullmatch(r"[-+0-9x^{}]+", polynomial):
            roots[letter] = rf"\operatorname{{root}}({polynomial},x\approx{near})"
    for letter, root in roots.items():
        text = re.sub(rf"\{letter}(?![A-Za-z]) ?", root.replace("\\", r"\\"), text)
    return text


def number_of(text: str) -> str:
    r"""The text of a coefficient; Unreadable if the text is no number.

    >>> number_of(r"\frac12-\frac{\sqrt{3}}{6}"), number_of(r"1.5 \cdot 10^{-16}")
    ('((1)/(2))-((sqrt(3))/(6))', '1.5*10^(-16)')
    """
    if len(text) > MAX_CELL or text.count("\\") > MAX_COMMANDS:
        raise Unreadable("a cell that is too long")
    plain = _IGNORED.sub("", text).replace("\u2212", "-")
    plain = re.sub(r"\\(?:cdot|times)(?![A-Za-z])", "*", plain)
    plain = _ROOT_OF.sub(r"root_of(\1,\2)", plain)
    count = 1
    while count:
        count = 0
        for pattern, written in _COMMANDS:
            plain, found = pattern.subn(written, plain)
            count += found
    if not _PLAIN.fullmatch(plain):
        raise Unreadable("a sign that no number has")
    return plain
