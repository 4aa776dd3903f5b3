"""The entries of the glossary that are many and short, as files of data."""

from __future__ import annotations

from importlib.resources import files
from typing import Any


def read(name: str) -> dict[str, Any]:
    """A file of this folder as plain data, in its order."""
    import tomllib  # paid for by who asks what something means

    text = files(__name__).joinpath(f"{name}.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)
