"""Recorded texts: compared with what is recorded, rewritten where GARK_UPDATE_SNAPSHOTS is 1."""

import os
from pathlib import Path

UPDATE = "GARK_UPDATE_SNAPSHOTS"


def assert_recorded(path: Path, text: str) -> None:
    """``text`` is what ``path`` holds; with ``GARK_UPDATE_SNAPSHOTS=1`` it is written there
    first.
    """
    if os.environ.get(UPDATE) == "1":
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    assert path.exists(), (
        f"nothing is recorded in {path.name}: run once with {UPDATE}=1 and read what it writes"
    )
    recorded = path.read_text(encoding="utf-8")
    assert text == recorded, (
        f"{path.name} records another text: read the difference, then set {UPDATE}=1"
    )
