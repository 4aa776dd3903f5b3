"""The meaning of the words in reports and files: ``gark explain`` and docs/glossary.md."""

from __future__ import annotations

from typing import Any


def read(name: str) -> dict[str, Any]:
    """Returns the entries of a file in ``data``, in their order."""
    import tomllib  # paid for by who asks what something means
    from importlib.resources import files

    return tomllib.loads(files(__name__).joinpath(f"data/{name}.toml").read_text(encoding="utf-8"))
