"""What is called a method file, and those below a folder."""

from __future__ import annotations

import os
from collections.abc import Callable

from garkcli.errors import printable
from garkcli.files import leads_away

SUFFIX = ".gark.yaml"
"""How method files end."""


def no_one(text: str) -> None:
    """Who is told where nobody asks."""
    del text


def files_below(folder: str, told: Callable[[str], None] = no_one) -> list[str]:
    """All method files below a folder, and the folders that cannot be read, in order.

    Args:
        folder: to look in; links to folders are not followed.
        told: who is told of links that lead out of it, and are left out.
    """
    found: list[str] = []

    def keep(error: OSError) -> None:
        found.append(error.filename)

    for place, _, names in os.walk(folder, onerror=keep):
        methods = [name for name in names if name.endswith(SUFFIX)]
        found += [os.path.join(place, name) for name in methods]
    # slow to import, and of no use to a check of one file
    from pathlib import Path

    # as pathlib writes them: without ./ before
    return within(sorted(str(Path(path)) for path in found), folder, told)


def within(paths: list[str], folder: str, told: Callable[[str], None]) -> list[str]:
    """Those of some paths that are no links out of a folder; who asks is told of the others."""
    kept = []
    for path in paths:
        if os.path.lexists(path) and leads_away(path, folder):
            told(f"{printable(path)} is left out: it is a link out of {printable(folder or '.')}")
        else:
            kept.append(path)
    return kept
