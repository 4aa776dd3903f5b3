"""A form that methods can be brought into."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from garkcli.conversion.sheet import Sheet
from garkcli.tableau.garkmethod import GarkMethod


@dataclass(frozen=True)
class Target:
    """What ``--to`` names.

    Attributes:
        name: as it is asked for.
        summary: what it is, in a line.
        convert: the entries in this form; raises ``CannotConvert`` with the reason.
        claims: what the claims of the method become, by their keys; without it each claim that
            holds of the result stays.
        makes_another: whether the result is another method, made from this one.
    """

    name: str
    summary: str
    convert: Callable[[GarkMethod], Sheet]
    claims: Mapping[str, str] = field(default_factory=dict)
    makes_another: bool = False
