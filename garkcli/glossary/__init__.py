"""The meaning of the words in reports and files: ``gark explain`` and docs/glossary.md."""

from __future__ import annotations

import re
from typing import Any


def read(name: str) -> dict[str, Any]:
    from importlib.resources import files

    path = f"data/{name}.toml"
    return parsed(path, files(__name__).joinpath(path).read_text(encoding="utf-8"))


def parsed(path: str, text: str) -> dict[str, Any]:
    r"""Returns the entries of a text; an error, as for a doubled key, names the file and the line.

    >>> parsed("data/fields.toml", "a = 1\na = 2\n")
    Traceback (most recent call last):
        ...
    ValueError: data/fields.toml, 'a = 2': Cannot overwrite a value (at line 2, column 6)
    """
    import tomllib  # paid for by who asks what something means

    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        at = re.search(r"at line (\d+)", str(error))
        line = text.splitlines()[int(at[1]) - 1] if at else ""
        raise ValueError(f"{path}, {line!r}: {error}") from None
