"""How large a method that is made from others may become."""

from __future__ import annotations

from garkcli.errors import MethodError

MAX_STAGES = 400
"""Most stages of all colours together, before equal ones are put together."""


def refuse_large(stages: int, cure: str) -> None:
    """Refuse a method before it is made.

    Raises:
        MethodError: it would have more stages than ``MAX_STAGES``.
    """
    if stages > MAX_STAGES:
        message = f"a method of {stages} stages (limit {MAX_STAGES})"
        raise MethodError(message, cure, code="too-many")
