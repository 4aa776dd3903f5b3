"""What is called a method file, and those below a folder."""

from __future__ import annotations

import os

SUFFIX = ".gark.yaml"
"""How method files end."""
STDIN = "-"
"""What stands for standard input."""


def files_below(folder: str) -> list[str]:
    """All method files below a folder, and the folders that cannot be read, in order."""
    found: list[str] = []

    def keep(error: OSError) -> None:
        found.append(error.filename)

    for place, _, names in os.walk(folder, onerror=keep):
        methods = [name for name in names if name.endswith(SUFFIX)]
        found += [os.path.join(place, name) for name in methods]
    # slow to import, and of no use to a check of one file
    from pathlib import Path

    # as pathlib writes them: without ./ before
    return sorted(str(Path(path)) for path in found)
