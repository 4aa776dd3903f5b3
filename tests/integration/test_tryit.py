"""The answers of the page that runs in a browser, and what the page consists of."""

from __future__ import annotations

import importlib.util
import json
import re
from pathlib import Path
from types import ModuleType

import pytest

from garkcli import load
from garkcli.webpage.page import report_page

ROOT = Path(__file__).resolve().parents[2]
WRONG = (
    "A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/3, 0, 0], [0, 0, 1, 0]]\n"
    "b: [1/6, 1/3, 1/3, 1/6]\nexpect: {order: 4}\n"
)


@pytest.fixture
def answers(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    """The module of the page, whose file is in a folder of its own."""
    monkeypatch.chdir(tmp_path)
    spec = importlib.util.spec_from_file_location("answers", ROOT / "tryit" / "answers.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_a_wrong_entry_is_named_beside_its_tree(answers: ModuleType) -> None:
    """The text is that of the command; the picture has the tree [[]], two dots and a line."""
    found = json.loads(answers.checked(WRONG, 100))
    assert found["sign"] == "fails"
    assert "order 2 fails at [[]] by -1/18" in found["said"]
    assert "a[3,2] = 1/2 instead of 1/3" in " ".join(found["said"].split())
    assert found["tree"].count("<use ") == 2
    assert "[[]]" in found["tree"]
    narrow = json.loads(answers.checked(WRONG, 40))["said"]
    assert max(map(len, narrow.splitlines())) <= 40
    assert narrow.split() == found["said"].split()


def test_signs_tell_files_apart(answers: ModuleType) -> None:
    """A claim that holds, none, and what is no method."""
    signs = {
        "A: [[0]]\nb: [1]\nexpect: {order: 1}\n": "holds",
        "A: [[0]]\nb: [1]\n": "holds",
        "A: [[0]]\nb: [1": "fault",
    }
    assert {x: json.loads(answers.checked(x, 80))["sign"] for x in signs} == signs
    assert answers.drawn("A: [[0]]\nb: [1") == ""


def test_pictures_and_reports(answers: ModuleType) -> None:
    """The region is drawn, and the report lists the conditions to order six."""
    assert answers.drawn(WRONG).startswith('<svg class="plot"')
    page = answers.reported(WRONG)
    Path(answers.NAME).write_text(WRONG, encoding="utf-8")
    assert page == report_page(answers.NAME, order=6)
    assert page.count('class="tree"') > 37


def test_what_takes_too_long_is_said(answers: ModuleType, monkeypatch: pytest.MonkeyPatch) -> None:
    """In words, by the check and the report; no program fails."""
    monkeypatch.setattr(answers, "SECONDS", 0.0)
    found = json.loads(answers.checked("methods: [gauss-9]\n", 80))
    assert found["sign"] == "fault"
    assert "not decided in the time" in found["said"]
    assert "not decided in the time" in answers.reported("methods: [gauss-9]\n")


def test_choices_are_all_there_is(answers: ModuleType) -> None:
    """RK4 has its file, a name that is none a reason; two families make a method with each rule."""
    found = json.loads(answers.choices())
    assert "gauss" in found["families"]
    assert "kutta-3" in found["methods"]
    assert "collocation" in found["rules"]
    assert json.loads(answers.named("rk4"))["text"] == load("rk4").text
    assert "no such" in json.loads(answers.named("no such"))["error"]
    text = "methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]\ntransfer: "
    for rule in found["rules"]:
        assert json.loads(answers.checked(text + rule, 80))["sign"] == "holds", rule


def test_the_page_loads_nothing_from_elsewhere() -> None:
    """Its files name no address, and its policy allows none."""
    files = [*(ROOT / "tryit").glob("*.*s"), *(ROOT / "tryit").glob("*.html")]
    assert len(files) >= 5
    for path in files:
        assert not re.search(r"https?:|//\w", path.read_text(encoding="utf-8")), path
