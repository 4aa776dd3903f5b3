"""Text for streams without Greek: an ASCII form of every character in reports."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from functools import lru_cache

PHRASES = {" · ": " * ", "·10": "*10", "½": "1/2 "}
"""Phrases with a form of their own; they are replaced first."""
SIGNS = {
    # letters and operators; A^ would look like a power
    "Â": "Ahat", "Ā": "Abar", "ℚ": "Q", "𝟙": " 1", "ᵀ": "^T", "∀": "for all", "∂": "d", "∫": "int ",
    "⌊": "floor(", "⌋": ")", "√": "sqrt", "⊙": ".*", "⊗": "(x)", "×": "x", "·": ".", "±": "+-",
    "½": "1/2", "⅓": "1/3", "¼": "1/4", "⁄": "/", "∕": "/", "÷": "/", "°": "deg", "−": "-",
    "≤": "<=", "≥": ">=", "≠": "!=", "≈": "~", "∈": "in", "∞": "inf", "∎": "[]", "∑": "sum ",
    "∏": "prod ", "∇": "grad ", "‖": "||", "∪": "u", "∩": "n", "⇒": "=>", "←": "<-", "↔": "<->",
    "⟨": "<", "⟩": ">", "∧": "and", "∨": "or", "¬": "not ", "→": "->", "↦": "|->",
    "\N{COMBINING DIAERESIS}": "''", "\N{COMBINING DOT ABOVE}": "'",
    "\N{COMBINING CIRCUMFLEX ACCENT}": "^", "\N{COMBINING TILDE}": "~",
    "\N{COMBINING MACRON}": "bar",
    # derivatives by time
    "ẋ": "x'", "ẏ": "y'", "ż": "z'", "ṗ": "p'",
    # a letter that is no accented one
    "ø": "o", "æ": "ae", "ß": "ss",
    # punctuation
    "–": "-", "\N{HYPHEN}": "-", "\N{HORIZONTAL BAR}": "--", "—": "--", "…": "...", "⋯": "...",
    "•": "*", "“": '"', "”": '"', "‘": "'", "’": "'", "\N{NO-BREAK SPACE}": " ",
    "\N{PRIME}": "'", "\N{DOUBLE PRIME}": "''",
    "\N{REPLACEMENT CHARACTER}": "?",
    # trees and plots, one column each
    "●": "o", "○": "o", "─": "-", "│": "|", "█": "#", "▒": "%", "░": "=", "└": "`", "┘": "'",
    "┌": ".", "┐": ".", "├": "+", "┤": "+", "┬": "+", "┴": "+", "┼": "+", "╯": "'", "╰": "`",
}  # fmt: skip
DRAWN = frozenset("●○─│└┘┌┐├┤┬┴┼╯╰")
"""The characters of drawings, which are aligned vertically."""
EVERYTHING = "¹⁴γ𝟙●"
"""An encoding with these characters is one of Unicode."""
_GREEK = r"GREEK (SMALL|CAPITAL) LETTER (FINAL )?(?P<name>[A-Z]+)( |$)"
_BLANKS = re.compile(" +")
_COLOURS = r"\x1b\[[0-9;]*m"
HANGING = 4
"""The indentation of the rest of a broken line."""
_SCRIPT = r"(SUPERSCRIPT|SUBSCRIPT) "


@lru_cache(4096)
def ascii_form(sign: str) -> str:
    r"""Returns a character in ASCII; other scripts are written as code points.

    >>> [ascii_form(x) for x in "γΩ²öẏ中"]
    ['gamma', 'Omega', '^2', 'o', "y'", '\\u4e2d']
    """
    if sign.isascii():
        return sign
    if sign in SIGNS:
        return SIGNS[sign]
    name = unicodedata.name(sign, "")
    greek = re.match(_GREEK, name)
    if greek is not None:
        letter = greek["name"].lower().replace("lamda", "lambda")
        return letter.capitalize() if greek[1] == "CAPITAL" else letter
    plain = unicodedata.normalize("NFKD", sign)
    plain = "".join(x for x in plain if not unicodedata.combining(x)).replace("−", "-")
    if not plain.isascii() or not plain:
        return sign.encode("ascii", "backslashreplace").decode("ascii")
    if re.match(_SCRIPT, name):
        return ("^" if name.startswith("SUPER") else "_") + plain
    return plain


def plain_line(line: str, encoding: str = "ascii") -> str:
    """Returns a line with an ASCII form for every character that ``encoding`` lacks.

    Later gaps of more than two blanks, one in front of a drawing, shrink to keep columns in place.

    >>> plain_line("10¹² trees, σ = 2   in all"), plain_line("z = hω, ω²q")
    ('10^12 trees, sigma = 2  in all', 'z = h omega, omega^2 q')
    """
    if line.isascii():
        return line
    for phrase, form in PHRASES.items():
        if not _has(encoding, phrase):
            line = line.replace(phrase, form)
    made: list[str] = []
    column = 0  # in the line as it is meant
    width = 0  # in the line as it is made
    spare = set(_spare_blanks(line))
    for place, (sign, form) in enumerate(_forms(line, encoding)):
        column += not unicodedata.combining(sign)
        if place in spare and width >= column:
            continue
        made.append(form)
        width += len(form)
    return "".join(made)


def _spare_blanks(line: str) -> Iterator[int]:
    for gap in _BLANKS.finditer(line):
        needed = 1 if line[gap.end() : gap.end() + 1] in DRAWN else 2
        yield from range(gap.start() + needed, gap.end())


def _forms(line: str, encoding: str) -> Iterator[tuple[str, str]]:
    """Yields characters and forms, with spaces between spelled letters and adjacent ones."""
    # the sign of a running exponent or index, which is written once
    raised = ""
    # whether a spelled letter or an exponent ends here: a letter needs a gap
    ended = False
    last = ""
    for sign in line:
        form = sign if _has(encoding, sign) else ascii_form(sign)
        mark = _script_mark(sign, form)
        if mark and mark == raised:
            form = form[1:]
        raised = mark
        is_spelled = form != sign and (re.match(_GREEK, unicodedata.name(sign, "")) is not None)
        needs_gap = ended or (is_spelled and last.isalpha())
        if needs_gap and form[:1].isalpha():
            form = f" {form}"
        ended = is_spelled or bool(mark) or form == "^T"
        yield sign, form
        last = form[-1:]


def _script_mark(sign: str, form: str) -> str:
    """Returns ``^`` or ``_`` for a raised or lowered character; empty for others."""
    is_script = len(form) == 2 and form[0] in "^_" and sign not in SIGNS
    return form[0] if is_script else ""


def plain_text(text: str, encoding: str, width: int | None = None) -> str:
    """Returns a text for a stream; lines that outgrow ``width`` columns thereby are broken."""
    if text.isascii() or _has(encoding, EVERYTHING):
        return text
    made: list[str] = []
    for line in text.split("\n"):
        plain = plain_line(line, encoding)
        has_grown = width is not None and _columns(line) <= width < _columns(plain)
        made += broken(plain, width) if width and has_grown else [plain]
    return "\n".join(made)


def broken(line: str, width: int) -> list[str]:
    r"""Returns a line broken at a gap of two blanks in the right half, at any blank, or whole."""
    indent = len(line) - len(line.lstrip(" "))
    hanging = " " * (indent + HANGING)
    lines: list[str] = []
    while _columns(line) > width:
        place = _last_place(line, width, len(hanging) if lines else indent)
        if place is None:
            break
        lines.append(line[: place.start()])
        line = hanging + line[place.end() :]
    return [*lines, line]


def _last_place(line: str, width: int, start: int) -> re.Match[str] | None:
    blanks = list(_BLANKS.finditer(line, start, len(line.rstrip())))
    fitting = [m for m in blanks if _columns(line[: m.start()]) <= width]
    gaps = [m for m in fitting if len(m[0]) > 1 and m.start() > width // 2]
    return max(gaps or fitting or blanks[:1], key=re.Match.start, default=None)


def _columns(line: str) -> int:
    return len(re.sub(_COLOURS, "", line))


@lru_cache(4096)
def _has(encoding: str, text: str) -> bool:
    """Returns whether a stream accepts a text; with exponents only if it has a raised 4."""
    if re.match(_SCRIPT, unicodedata.name(text, "") if len(text) == 1 else ""):
        text = "⁴"
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        return False
    return True


def handled(error: UnicodeError) -> tuple[str, int]:
    """Replaces text from the first unencodable character to the end of its line."""
    assert isinstance(error, UnicodeEncodeError)
    end = error.object.find("\n", error.start)
    end = len(error.object) if end < 0 else end
    return plain_line(error.object[error.start : end], error.encoding), end
