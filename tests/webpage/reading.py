"""A page as a tree of elements, read as browsers do and refused where it is not well-formed."""

from __future__ import annotations

from collections.abc import Iterator
from xml.etree.ElementTree import Element

import html5lib


def read(page: str) -> Element:
    """The root of a page.

    Raises:
        html5lib.html5parser.ParseError: the standard does not allow it.
    """
    parser = html5lib.HTMLParser(strict=True, namespaceHTMLElements=False)
    root: Element = parser.parse(page)
    return root


def name_of(element: Element) -> str:
    """The name of an element, of SVG and MathML too; empty for a comment."""
    tag = element.tag
    return tag.rpartition("}")[2] if isinstance(tag, str) else ""


def elements(root: Element, *names: str) -> Iterator[Element]:
    """Those of some names, or all, in the order of the page."""
    for element in root.iter():
        if not names or name_of(element) in names:
            yield element


def text_of(element: Element) -> str:
    """What is read, in one line; of a formula what stands for it where there is such."""
    return " ".join("".join(_texts(element)).split())


def _texts(element: Element) -> Iterator[str]:
    if (instead := element.get("alttext")) is not None:
        yield instead
        return
    yield element.text or ""
    for part in element:
        yield from _texts(part)
        yield part.tail or ""


def by_id(root: Element, place: str) -> Element:
    """The element of a name."""
    (found,) = [x for x in root.iter() if x.get("id") == place]
    return found


def rows_of(table: Element) -> list[list[Element]]:
    """The cells of the rows of its body."""
    (body,) = elements(table, "tbody")
    return [[x for x in row if name_of(x) in ("td", "th")] for row in elements(body, "tr")]


def number_of(math: Element) -> str:
    """A number as MathML, as method files write it."""
    return _written(list(math))


def _written(parts: list[Element]) -> str:
    """Signs beside each other; what has none between it is multiplied."""
    text = ""
    for part in parts:
        found = _one(part)
        is_sign = found in "+-"
        needs_sign = text and text[-1] not in "+-(" and not is_sign
        text += f"*{found}" if needs_sign else found
    return text


def _one(part: Element) -> str:
    name = name_of(part)
    inside = list(part)
    if name == "mfrac":
        above, below = map(_one, inside)
        return f"({above})/({below})"
    if name == "msqrt":
        return f"sqrt({_written(inside)})"
    if name == "mrow":
        return f"({_written(inside)})"
    if name == "msup":
        base, power = map(_one, inside)
        return f"({base})**{power}"
    assert name in ("mn", "mo", "mi"), name
    return {"−": "-", "·": "*", "⋅": "*"}.get(part.text or "", part.text or "")
