"""What the words of reports and files mean: ``gark explain`` and docs/glossary.md."""

from __future__ import annotations

from typing import Any


def read(name: str) -> dict[str, Any]:
    """Entries of the glossary that are many and short: a file of ``data``, in its order."""
    import tomllib  # paid for by who asks what something means
    from importlib.resources import files

    return tomllib.loads(files(__name__).joinpath(f"data/{name}.toml").read_text(encoding="utf-8"))
