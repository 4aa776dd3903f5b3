"""Polynomials in unknown values: their symbols, differences, entries and names.

The name of a slope has a space in it; ``t@1`` is the value of t at the next step.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import TypeAlias

from garkcli.sources.evaluate import shown
from garkcli.sources.stages import NEAR, terms_of
from garkcli.sources.values import Array, Form, Number, SourceRecord, Terms, Value, integer, near

Place: TypeAlias = tuple[str, ...]


def symbols(forms: Iterable[Terms]) -> set[str]:
    return {name for form in forms for at in form for name in at}


def difference(x: Terms | None, y: Terms | None) -> str:
    """The name of the step between two times of an array, ``t[n + 1] - t[n]``; empty for others."""
    names = [next(iter(z))[0] for z in (x, y) if z and len(z) == 1 and len(next(iter(z))) == 1]
    heads = [match for name in names if (match := _AT_A_STEP.fullmatch(name))]
    if len(heads) != 2 or heads[0]["head"] != heads[1]["head"]:
        return ""
    is_next = int(heads[0]["by"] or 0) - int(heads[1]["by"] or 0) == 1
    are_plain = all(z and is_one(next(iter(z.values()))) for z in (x, y))
    return f"step@{heads[0]['head']}" if is_next and are_plain else ""


def difference_of_symbols(form: Terms) -> tuple[str, str] | None:
    """The two symbols of a difference; None for others."""
    by_sign = {near(x): at[0] for at, x in form.items() if len(at) == 1 and " " not in at[0]}
    if any(name.startswith("entry") for name in by_sign.values()):
        # at an unknown index
        return None
    is_one = len(form) == len(by_sign) == 2 and {*by_sign} == {1.0, -1.0}
    return (by_sign[1.0], by_sign[-1.0]) if is_one else None


def shift(form: Mapping[Place, str]) -> int | None:
    """The integer added to a name; None for other indices."""
    rest = {at: x for at, x in form.items() if at}
    by = form.get((), "0")
    is_name = [*rest.values()] == ["1"] and all(len(at) == 1 for at in rest)
    return int(by) if is_name and _SHIFT.fullmatch(by) else None


def is_sum_with_slopes(form: Terms) -> bool:
    """Whether a polynomial has a value without slopes and multiples of slopes."""
    has_slopes = any(" " in name for at in form for name in at)
    return has_slopes and any(len(at) == 1 and " " not in at[0] for at in form)


def kept_names(values: Mapping[str, Value]) -> Mapping[str, str]:
    """The names of values that are entries at the next step at the end of a turn, ``x = xs[n]``
    after ``n += 1``: these are entries at its beginning.
    """
    symbols = {name: [*form] for name, x in values.items() if (form := terms_of(x))}
    single = {name: at[0][0] for name, at in symbols.items() if len(at) == 1 and len(at[0]) == 1}
    return {name: x.removesuffix("@1") for name, x in single.items() if x.endswith("@1")}


def renamed(form: Terms | None, names: Mapping[str, str]) -> Terms | None:
    """A polynomial with other names for some symbols."""
    if form is None:
        return None
    return {tuple(sorted(names.get(x, x) for x in at)): value for at, value in form.items()}


def key_of(form: Terms) -> object:
    """A key that is equal for equal polynomials."""
    return tuple(sorted((at, str(shown(x))) for at, x in form.items()))


def is_one(value: Value) -> bool:
    return isinstance(value, Number) and abs(value.near - 1) < NEAR


def with_parts(space: Mapping[str, Value]) -> Mapping[str, Value]:
    """Values with the fields of records and the entries of arrays among them."""
    values: dict[str, Value] = {}
    for name, value in space.items():
        match value:
            case SourceRecord(fields=fields):
                values |= with_parts({f"{name}.{key}": x for key, x in fields.items()})
            case Array(items=items) if any(isinstance(x, Form) for x in value.flat()):
                values |= with_parts({f"{name}[{i}]": x for i, x in enumerate(items)})
            case _:
                values[name] = value
    return values


def components_of(value: Value) -> list[Value]:
    """The components of a vector or a record with unknown values; any other value."""
    match value:
        case Array():
            parts = [y for x in value.items for y in components_of(x)]
        case SourceRecord(kind="", fields=fields):
            parts = [y for x in fields.values() for y in components_of(x)]
        case _:
            return [value]
    return parts if any(isinstance(x, Form) for x in parts) else [value]


def keys_of(value: Value, base: int) -> tuple[object, ...]:
    """The places of the entries of a vector, or of the fields of a record; empty for others."""
    if components_of(value) == [value]:
        return ()
    if isinstance(value, Array):
        return tuple((key_of({(): integer(i + base)}),) for i in range(len(value.items)))
    return tuple(value.fields) if isinstance(value, SourceRecord) else ()


def is_of_slopes(value: Value) -> bool:
    """Whether it is a multiple of slopes, or an array with such ones, unlike an argument of f."""
    if isinstance(value, Array):
        return any(map(is_of_slopes, value.flat()))
    form = terms_of(value) or {}
    return bool(form) and all(any(" " in name for name in at) for at in form)


_SHIFT = re.compile("-?[0-9]{1,6}")
_AT_A_STEP = re.compile(r"(?P<head>.*?)(?:@(?P<by>-?[0-9]{1,6}))?")
"""A value of an array at a step, ``t@1``."""
