"""What `make browser` needs of the machine: a Chromium."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILT = ROOT / "build" / "browser"
"""Where pages and screenshots go."""
SITE = ROOT / "build" / "docs"
"""Where `make docs` has put the site."""
NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
SWITCHES = (
    "--no-sandbox",  # in containers there is none
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
)


class NoBrowser(Exception):
    """There is none; the text says how to get one."""


def find_browser() -> str:
    """The Chromium of the machine: the one that GARK_BROWSER names, else one on the PATH.

    Raises:
        NoBrowser: there is none.
    """
    given = os.environ.get("GARK_BROWSER", "")
    if given:
        if Path(given).is_file():
            return given
        raise NoBrowser(f"GARK_BROWSER names no file: {given}")
    for name in NAMES:
        path = shutil.which(name)
        if path is not None:
            return path
    raise NoBrowser(
        "There is no Chromium on the PATH: install one (apt install chromium, brew install "
        "--cask chromium), or name one with GARK_BROWSER=/path/to/chrome make browser."
    )
