"""Base classes of values: named fields, by which they are compared and shown. msgspec makes these
classes in C; a dataclass takes thirty times as long to import, and a command starts with a hundred.
"""

from __future__ import annotations

from typing import ClassVar, dataclass_transform

from msgspec import Struct, field
from msgspec.structs import force_setattr, replace

__all__ = ["Frozen", "FrozenBut", "Mutable", "field", "fields", "force_setattr", "replace"]


def fields(value: Struct | type[Struct]) -> tuple[str, ...]:
    return value.__struct_fields__


@dataclass_transform(frozen_default=True, field_specifiers=(field,))
class Frozen(Struct, frozen=True, dict=True):
    """A value that does not change; it may keep what it has computed (``cached_property``)."""


class FrozenBut(Frozen, eq=False):
    """A value whose fields :attr:`besides` do not count when two are compared."""

    besides: ClassVar[frozenset[str]]

    def __eq__(self, other: object) -> bool:
        return type(self) is type(other) and self._counted() == other._counted()

    def __ne__(self, other: object) -> bool:
        return not self == other

    def __hash__(self) -> int:
        return hash(self._counted())

    def _counted(self) -> tuple[object, ...]:
        return tuple(getattr(self, name) for name in fields(self) if name not in self.besides)


class Mutable(Struct, dict=True):
    """A value that changes."""
