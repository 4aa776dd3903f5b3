"""YAML in ASCII has the values of the text in Unicode."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

from garkcli.grammar.editing import in_ascii

ROOT = Path(__file__).resolve().parents[2]


@pytest.mark.parametrize(
    "text",
    [
        "title: näher\n",
        "a: 'it''s ö'\nb: \"ö \\\" ü\"\n",
        "a: |\n  erste Zeile ß\n  zweite\nb: 1\n",
        "a: >-\n  gefaltet ä\n  und ö\nb: [ü, 𝟙, x]\n",
        "ключ: {α: 1/2}  # Bemerkung é\n",
    ],
)
def test_values_stay(text: str) -> None:
    """Of plain, quoted, block and folded scalars, of keys, beyond the basic plane; comments too."""
    found = in_ascii(text)
    assert found.isascii()
    assert yaml.safe_load(found) == yaml.safe_load(text)


def test_files_of_the_catalogue_stay() -> None:
    files = sorted((ROOT / "garkcli" / "catalogue" / "data").rglob("*.yaml"))
    assert len(files) > 400
    texts = [path.read_text(encoding="utf-8") for path in files]
    changed = [text for text in texts if not text.isascii()]
    assert len(changed) > 50
    for text in changed:
        assert yaml.load(in_ascii(text), yaml.BaseLoader) == yaml.load(text, yaml.BaseLoader)
