"""What `make browser` says where it cannot run; the rest of it is no part of this suite."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.browser.machine import NoBrowser, find_browser


def test_no_browser_is_said_with_the_cure(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Without a Chromium there is one sentence, which tells how to get one."""
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.delenv("GARK_BROWSER", raising=False)
    with pytest.raises(NoBrowser, match="no Chromium on the PATH: install"):
        find_browser()
    monkeypatch.setenv("GARK_BROWSER", str(tmp_path / "chrome"))
    with pytest.raises(NoBrowser, match="GARK_BROWSER names no file"):
        find_browser()


def test_the_named_browser_is_taken(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """GARK_BROWSER goes before the PATH."""
    chrome = tmp_path / "chrome"
    chrome.write_text("")
    monkeypatch.setenv("GARK_BROWSER", str(chrome))
    assert find_browser() == str(chrome)
