"""Elements of SVG as text."""

from __future__ import annotations

from collections.abc import Iterable
from html import escape
from typing import TypeAlias

Point: TypeAlias = tuple[float, float]
Value: TypeAlias = str | float | None
"""Of an attribute; numbers are lengths, None is for those that are left out."""


def element(name: str, words: str | None = None, **attributes: Value) -> str:
    """An element with attributes, and with a text in it or empty.

    >>> element("text", "a < b", x=1.26, text_anchor="end", style=None)
    '<text x="1.3" text-anchor="end">a &lt; b</text>'
    """
    head = opened(name, **attributes)
    if words is None:
        return head.removesuffix(">") + "/>"
    inside = escape(words)
    return f"{head}{inside}</{name}>"


def opened(name: str, **attributes: Value) -> str:
    """The beginning of an element."""
    parts = [name]
    for key, value in attributes.items():
        if value is None:
            continue
        written = value if isinstance(value, str) else number(value)
        hyphened = key.replace("_", "-")
        parts.append(f'{hyphened}="{written}"')
    joined = " ".join(parts)
    return f"<{joined}>"


def path_of(points: Iterable[Point]) -> str:
    """A polygon or polyline as the data of a path, to a tenth of a unit.

    >>> path_of([(0, 1.26), (2, -0.01)])
    'M0 1.3L2 0'
    """
    pairs = []
    for x, y in points:
        across = number(x)
        down = number(y)
        pairs.append(f"{across} {down}")
    joined = "L".join(pairs)
    return f"M{joined}"


def number(x: float) -> str:
    """A length to a tenth of a unit."""
    tenths = f"{x:.1f}"
    short = tenths.removesuffix(".0")
    return "0" if short == "-0" else short
