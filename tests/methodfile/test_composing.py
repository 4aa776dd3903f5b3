"""Files are read and composed as by PyYAML itself, within limits."""

import os
from pathlib import Path

import pytest
import yaml
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.methodfile import reading
from garkcli.methodfile.composing import TooLargeError, compose
from garkcli.methodfile.source import METHOD_FILE

PIECES = ["a", "1/2", ": ", "- ", ", ", "[", "]", "{", "}", "\n", "  ", "'", "? ", "# x"]
PIECES += [":", ",", "#", " ", "\r\n", "\u2028", "\ufeff", "\t", "---\n", "|\n", "&a ", "*a"]
FORMS = sorted(Path("methods").glob("*.yaml")) + sorted(
    Path("tests/examples/invalid").glob("*.yaml")
)


def places(node: yaml.Node | None) -> object:
    """A node with all in it: kind, tag, text, style, where it begins and ends."""
    if node is None:
        return None
    marks = [(m.index, m.line, m.column) for m in (node.start_mark, node.end_mark)]
    value = node.value
    if isinstance(node, yaml.SequenceNode):
        value = [places(x) for x in node.value]
    if isinstance(node, yaml.MappingNode):
        value = [(places(k), places(x)) for k, x in node.value]
    return type(node), node.tag, value, getattr(node, "style", None), marks


def found(read: object, text: str) -> object:
    """What becomes of a text: its nodes, or what is complained about and where."""
    try:
        return places(read(text))  # type: ignore[operator]
    except TooLargeError:
        return None
    except yaml.YAMLError as error:
        return str(error)


def by_pyyaml(text: str) -> yaml.Node | None:
    """The nodes by PyYAML's own loader."""
    return yaml.compose(text, Loader=yaml.SafeLoader)


@given(st.lists(st.sampled_from(PIECES), max_size=25).map("".join))
@settings(max_examples=200)
def test_composing_is_pyyaml_s(text: str) -> None:
    """The same nodes at the same places, or the same complaint, whatever the text."""
    assert found(compose, text) == found(by_pyyaml, text)


@pytest.mark.parametrize("path", FORMS, ids=lambda path: path.stem)
def test_files_are_composed_as_by_pyyaml(path: Path) -> None:
    """So do the methods of the paper and all invalid examples."""
    text = path.read_text(encoding="utf-8", errors="replace")
    ours = found(compose, text)
    assert ours is None or ours == found(by_pyyaml, text)


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
