"""A file with free parameters is read once, and its refusal reaches other processes."""

from __future__ import annotations

import pickle

import pytest

from garkcli.check.check_file import check_file
from garkcli.errors import HasFreeParameters
from garkcli.grammar import source
from garkcli.methodfile.family import family_of
from garkcli.methodfile.load import loads

TEXT = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - 1/(2*t), 1/(2*t)]\n"


def test_a_file_is_read_once(monkeypatch: pytest.MonkeyPatch, tmp_path: object) -> None:
    """Its text goes through YAML once for all that is said of every value."""
    path = f"{tmp_path}/family.gark.yaml"
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(TEXT)
    texts: list[str] = []
    composed = source.composed
    monkeypatch.setattr(source, "composed", lambda text: texts.append(text) or composed(text))
    outcome = check_file(path)
    assert outcome.every is not None
    assert texts == [TEXT]


def test_a_refusal_from_another_process_is_read_again() -> None:
    """Nodes of YAML stay where they are; the family is the same."""
    with pytest.raises(HasFreeParameters) as caught:
        loads(TEXT)
    again = pickle.loads(pickle.dumps(caught.value))
    assert again.reading is None
    first, second = (str(family_of(x).tableau.blocks) for x in (again, caught.value))
    assert first == second
