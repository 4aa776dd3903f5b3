"""``gark design --p-stable`` and the like: sets of parameter values as text and as JSON."""

from __future__ import annotations

from collections.abc import Iterator
from textwrap import wrap
from typing import Any, get_args

from garkcli.design.springs_kind import TwoSprings
from garkcli.design.stable_values import StableValues, Wanted
from garkcli.exact.cells import Interval
from garkcli.exact.polynomial import Polynomial
from garkcli.exact.polynomial_text import polynomial_text, root_decimal, root_text
from garkcli.exact.roots import RealRoot
from garkcli.page.exactly import ALGEBRAIC, root_data
from garkcli.page.json_text import to_json
from garkcli.page.plain import printable
from garkcli.page.schema import FLAG, POSITION, TEXT, Schema, array, nullable, one_of, published
from garkcli.tableau.family import Stability

SCHEMA = "gark/design-stability/1"


def render_text(source: str, values: StableValues, digits: int, width: int) -> str:
    """The set for people.

    Args:
        source: the file.
        values: the set.
        digits: of numbers without simple radicals.
        width: columns to fill.
    """
    lines = [printable(source), f"  {printable(values.family.name)}"]
    lines += set_lines(values, digits, width)
    return "\n".join(lines) + "\n"


def set_lines(values: StableValues, digits: int, width: int) -> list[str]:
    """The set, without its file."""
    name = values.parameter
    wanted = Stability(values.wanted, values.colour)
    stable = wanted.in_words(values.family.tableau)
    lines: list[str] = []
    if values.two_springs is not None:
        stable = "stable"
        lines += [f"  {_springs_text(values.two_springs)}"]
    if values.has_wishes:
        stable += ", and as the file wants it,"
    if not values.found:
        none = "no value that is decided" if values.undecided else "no value"
        lines += _said(f"the {values.whose} is {stable} for {none} of {name}", width)
    elif values.is_everything:
        lines += _said(f"the {values.whose} is {stable} for every value of {name}", width)
    else:
        end = "for" if values.undecided else "for exactly"
        lines += [*_said(f"the {values.whose} is {stable} {end}", width), ""]
        for interval in values.found:
            lines += _interval(interval, name, digits, width)
    if values.undecided:
        lines += ["", "  and it is not decided, as fields are too large, for"]
        for root in values.undecided:
            lines += _point(root, name, digits, width)
    return lines


def _said(text: str, width: int) -> list[str]:
    return wrap(text, width, initial_indent="  ", subsequent_indent="  ", break_on_hyphens=False)


def _springs_text(two_springs: TwoSprings) -> str:
    """What is asked of the method."""
    text = f"two springs, (hω_slow)² = {two_springs.slow}, "
    greatest = two_springs.greatest
    if greatest is None:
        return text + "every (hω_fast)²"
    return text + f"every (hω_fast)² up to {greatest}"


def _springs_data(two_springs: TwoSprings | None) -> dict[str, Any] | None:
    if two_springs is None:
        return None
    greatest = two_springs.greatest
    return {
        "slow": str(two_springs.slow),
        "fast": two_springs.fast + 1,
        "up_to": None if greatest is None else str(greatest),
    }


def _interval(interval: Interval, name: str, digits: int, width: int) -> Iterator[str]:
    start, end = interval.start, interval.end
    if interval.is_point:
        assert start is not None
        yield from _point(start, name, digits, width)
        return
    text = name
    if start is not None:
        text = f"{_number(start, digits)} {_relation(interval.has_start)} {text}"
    if end is not None:
        text = f"{text} {_relation(interval.has_end)} {_number(end, digits)}"
    yield f"    {text}"
    for root in (start, end):
        if root is not None and root.exact is None:
            text = _meaning(root, digits)
            indent = " " * 6
            yield from wrap(text, width, initial_indent=indent, subsequent_indent=indent + "  ")


def _relation(is_included: bool) -> str:
    return "≤" if is_included else "<"


def _point(root: RealRoot, name: str, digits: int, width: int) -> Iterator[str]:
    if root.exact is not None:
        yield f"    {name} = {root_text(root)}"
        return
    text = f"{name} = {_meaning(root, digits)}"
    yield from wrap(text, width, initial_indent=" " * 4, subsequent_indent=" " * 6)


def _number(root: RealRoot, digits: int) -> str:
    return root_text(root) or f"{root_decimal(root, digits)}…"


def _meaning(root: RealRoot, digits: int) -> str:
    """What an irrational number is: decimals, with its radicals or the polynomial."""
    decimals = f"{root_decimal(root, digits)}…"
    simple = root_text(root)
    if simple is not None:
        return f"{simple} = {decimals}"
    polynomial = polynomial_text(Polynomial.from_flint(root.polynomial), "x")
    return f"{decimals}, a root of {polynomial}"


def render_json(source: str, values: StableValues, digits: int) -> str:
    """The set for programs: exact numbers as text, or as roots of polynomials."""
    found = [_interval_data(interval, digits) for interval in values.found]
    data = {
        "schema": SCHEMA,
        "file": source,
        "name": values.family.name,
        "of": values.whose,
        "unknowns": [values.parameter],
        "wanted": values.wanted,
        "colour": _colour(values),
        "springs": _springs_data(values.two_springs),
        "set": found,
        "undecided": [root_data(root, digits) for root in values.undecided],
    }
    return to_json(data) + "\n"


def set_data(values: StableValues, digits: int) -> dict[str, Any]:
    """The set as a part of another report."""
    return {
        "wanted": values.wanted,
        "colour": _colour(values),
        "set": [_interval_data(x, digits) for x in values.found],
        "undecided": [root_data(root, digits) for root in values.undecided],
    }


def _colour(values: StableValues) -> int | None:
    return None if values.colour is None else values.colour + 1


def set_schema() -> Schema:
    """The JSON Schema of ``set_data``."""
    properties = stable_values_schema()["properties"]
    parts = ("wanted", "colour", "set", "undecided")
    return _object({name: properties[name] for name in parts})


def _interval_data(interval: Interval, digits: int) -> dict[str, Any]:
    start, end = interval.start, interval.end
    if start is not None and interval.is_point:
        return {"point": root_data(start, digits)}
    return {
        "from": None if start is None else root_data(start, digits),
        "to": None if end is None else root_data(end, digits),
        "from_included": interval.has_start,
        "to_included": interval.has_end,
    }


def stable_values_schema() -> Schema:
    """The JSON Schema of these reports."""
    point = _object({"point": ALGEBRAIC})
    end = nullable(ALGEBRAIC)
    ends = {"from": end, "to": end, "from_included": FLAG, "to_included": FLAG}
    document = _object(
        {
            "schema": {"const": SCHEMA},
            "file": TEXT,
            "name": TEXT,
            "of": {"enum": ["method", "conjugate", "pair"]},
            "unknowns": array(TEXT),
            "wanted": {"enum": [*get_args(Wanted)]},
            "colour": nullable(POSITION),
            "springs": nullable(_object({"slow": TEXT, "fast": POSITION, "up_to": nullable(TEXT)})),
            "set": array(one_of(point, _object(ends))),
            "undecided": array(ALGEBRAIC),
        }
    )
    return published("report of gark design with --a-stable and the like: stability", document)


def _object(fields: dict[str, Schema]) -> Schema:
    return {
        "type": "object",
        "required": list(fields),
        "properties": fields,
        "additionalProperties": False,
    }
