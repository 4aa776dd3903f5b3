"""Texts made harmless: controls, commands to terminals and to the runners of jobs, formulas."""

from __future__ import annotations

import re

_COMMAND = r"^([^\S\n]*):(?=:)"
"""A workflow command of GitHub Actions begins with two colons."""
_OLD_COMMAND = r"##(?=\[)"
"""The older form, anywhere in a line."""
_FORMULA = ("=", "+", "-", "@", "\t", "\r")
"""Characters that start a formula in spreadsheets."""


def inert(text: str) -> str:
    r"""Returns text with the lines escaped that GitHub Actions would take for commands."""
    return re.sub(_OLD_COMMAND, r"#\\x23", re.sub(_COMMAND, r"\1\\x3a", text, flags=re.MULTILINE))


def csv_cell(text: str) -> str:
    """Returns a name as a CSV cell that is never a formula; numbers are unchanged."""
    if not text.startswith(_FORMULA):
        return text
    try:
        float(text)
    except ValueError:
        return f"'{text}"
    return text


JSON = frozenset({"json", "ndjson", "sarif"})
YAML = frozenset({"yaml"})
XML = frozenset({"junit", "html"})
TABBED = frozenset({"rungekutta-jl"})
"""Tables with columns separated by tabs."""
_COLOUR = r"\x1b\[(?:[012]|3[1-6])(?:;(?:[12]|3[1-6]))*m"
_LINK = (
    r"\x1b\]8;;(?P<site>https?://[!-~]*)\x1b\\"
    rf"(?P<shown>(?:{_COLOUR}|[!-~])*)\x1b\]8;;\x1b\\"
)
"""A link to a site, as terminals read it."""


def written_out(text: str, format: str = "text", coloured: bool = False) -> str:
    r"""Returns a report with nonprintable characters escaped.

    Control characters could command a terminal, bidirectional ones disguise the text; lone
    surrogates cannot be encoded. ``coloured`` keeps colours, and links that show a part of their
    site.

    >>> print(written_out("a\x1b[2Jb \u202ec\n"), end="")
    a\x1b[2Jb \u202ec
    """
    if text.replace("\n", "").isprintable():
        return text
    if not coloured:
        return _written_out(text, format)
    return _kept(rf"{_COLOUR}|{_LINK}", text, format)


def colours_alone(text: str) -> str:
    r"""Returns a text with nonprintable characters escaped except its colours.

    >>> colours_alone("\x1b[1m\x1b[2J\x1b[0m").replace("\x1b", "ESC")
    'ESC[1m\\x1b[2JESC[0m'
    """
    return _kept(_COLOUR, text, "text") if "\x1b" in text else written_out(text)


def _kept(pattern: str, text: str, format: str) -> str:
    made: list[str] = []
    end = 0
    for found in re.finditer(pattern, text):
        link = found.groupdict()
        is_kept = not link.get("site") or re.sub(_COLOUR, "", link["shown"]) in link["site"]
        made.append(_written_out(text[end : found.start()], format))
        made.append(found[0] if is_kept else _written_out(found[0], format))
        end = found.end()
    return "".join([*made, _written_out(text[end:], format)])


def _written_out(text: str, format: str) -> str:
    if text.replace("\n", "").isprintable():
        return text
    blank = "\n\t" if format in TABBED else "\n"
    signs = []
    for sign in text:
        is_harmless = sign in blank or sign.isprintable()
        signs.append(sign if is_harmless else escaped(sign, format))
    return "".join(signs)


def escaped(sign: str, format: str = "text") -> str:
    r"""Returns a character escaped for a format.

    >>> escaped("\x1b"), escaped("\x1b", "json"), escaped("𝟙", "json"), escaped("ö", "junit")
    ('\\x1b', '\\u001b', '\\ud835\\udfd9', '&#246;')
    """
    if format in JSON:
        units = sign.encode("utf-16-be", "surrogatepass")
        pairs = [units[i : i + 2] for i in range(0, len(units), 2)]
        return "".join(f"\\u{pair.hex()}" for pair in pairs)
    is_half = "\ud800" <= sign <= "\udfff"
    if format in XML and not sign.isascii() and not is_half:
        return f"&#{ord(sign)};"
    if format in YAML:
        return f"\\U{ord(sign):08x}"
    if sign.isprintable():
        return f"\\x{ord(sign):02x}"
    return repr(sign)[1:-1]


def without_commands(text: str, format: str = "text") -> str:
    r"""Returns a text without lines that GitHub Actions takes for commands.

    >>> print(without_commands("  ::error::no\nsee ##[group]"))
      \x3a:error::no
    see #\x23[group]
    """
    if format in JSON:  # where strings have no lines of their own
        hash_sign = escaped("#", format)
        return text.replace("##[", f"#{hash_sign}[")
    return inert(text)
