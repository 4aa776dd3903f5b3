"""How values are written in a language, as far as the parser asks."""

from __future__ import annotations

from collections.abc import Mapping

from garkcli.frozen import Frozen, field
from garkcli.sources.scalars import ROOTS


class Grammar(Frozen):
    """How values are written in a language.

    Attributes:
        lists: brackets around lists with commas between the items.
        calls: brackets around the arguments of a function.
        roots: names of functions that are roots; in lower letters.
        passed: functions that pass on their last argument: types, roundings, wrappers.
        nothing: names of what is no value.
        is_implicit: whether two factors side by side are a product.
    """

    lists: Mapping[str, str] = field(default_factory=dict)
    calls: Mapping[str, str] = field(default_factory=lambda: {"(": ")"})
    roots: Mapping[str, str] = field(default_factory=lambda: ROOTS)
    passed: frozenset[str] = frozenset()
    nothing: frozenset[str] = frozenset()
    is_implicit: bool = False
