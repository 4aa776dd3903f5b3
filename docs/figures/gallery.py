"""The pictures of docs/gallery.md, by the commands that stand there below each of them.

    python docs/figures/gallery.py [FOLDER [NAME…]]

writes them into ``gallery`` beside this file, or into FOLDER; those that are named, or all.
``make figures`` does the former.
"""

from __future__ import annotations

import os
import re
import shlex
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from garkcli.cli import main

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
PAGE = ROOT / "docs" / "gallery.md"
_ENTRY = re.compile(r"^!\[[^\]]+\]\(figures/gallery/([\w.-]+)\)\n\n`gark ([^`]+)`$", re.MULTILINE)


def commands() -> dict[str, list[str]]:
    """The words of the command of each picture on the page, without the first."""
    text = PAGE.read_text(encoding="utf-8")
    return {name: shlex.split(words) for name, words in _ENTRY.findall(text)}


def draw(words: Sequence[str], name: str, folder: Path) -> None:
    """Run a command whose last word is the name of its picture.

    Raises:
        SystemExit: it fails.
    """
    *others, last = words
    assert last == name, f"{name} is drawn as {last}"
    found = [_in_checkout(word) for word in others]
    try:
        main([*found, str(folder / name)])
    except SystemExit as end:
        if end.code not in (0, 1, None):
            raise


def _in_checkout(word: str) -> str:
    """Paths of the page are those of a checkout."""
    is_path = "/" in word and (ROOT / word).is_file()
    return str(ROOT / word) if is_path else word


def draw_all(wanted: Mapping[str, Sequence[str]], folder: Path) -> None:
    """The pictures into a folder; what commands write besides goes elsewhere."""
    before = Path.cwd()
    with TemporaryDirectory() as place:
        os.chdir(place)
        try:
            for name, words in wanted.items():
                draw(words, name, folder)
        finally:
            os.chdir(before)


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if sys.argv[1:] else HERE / "gallery"
    names = sys.argv[2:]
    every = commands()
    chosen = {name: every[name] for name in names or every}
    draw_all(chosen, folder.resolve())
