"""The method files in a folder."""

from __future__ import annotations

import os
from collections.abc import Callable

from garkcli.errors import printable
from garkcli.files import leads_away

SUFFIX = ".gark.yaml"


def no_one(told: object) -> None:
    del told


def files_below(folder: str, told: Callable[[str], None] = no_one) -> list[str]:
    """Returns method files, and folders that cannot be read; links are not followed."""
    paths: list[str] = []

    def keep(error: OSError) -> None:
        paths.append(error.filename)

    for place, _, names in os.walk(folder, onerror=keep):
        paths += [os.path.join(place, name) for name in names if name.endswith(SUFFIX)]
    # slow to import, and of no use to a check of one file
    from pathlib import Path

    # as pathlib writes them: without ./ before
    return within(sorted(str(Path(path)) for path in paths), folder, told)


def within(paths: list[str], folder: str, told: Callable[[str], None]) -> list[str]:
    """The paths that are not links out of a folder; ``told`` learns of the others."""
    kept = []
    for path in paths:
        if os.path.lexists(path) and leads_away(path, folder):
            told(f"{printable(path)} is left out: it is a link out of {printable(folder or '.')}")
        else:
            kept.append(path)
    return kept
