"""Files are read to their end."""

import os
from pathlib import Path

import pytest

from garkcli.glossary.key import METHOD_FILE
from garkcli.grammar import reading


@pytest.mark.parametrize("said", [0, 3, 10_000])
def test_a_file_is_read_to_its_end(
    said: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where it has grown since its size was asked for, or no size is known."""
    text = "A: [[0]]\nb: [1]\n" * 20
    path = tmp_path / "m.gark.yaml"
    path.write_text(text, encoding="utf-8")
    real = os.stat(path)
    wrong = os.stat_result((*real[:6], said, *real[7:10]))
    monkeypatch.setattr(reading.os, "stat", lambda _: wrong)
    assert reading.read_text(str(path), METHOD_FILE) == (text, str(path))
