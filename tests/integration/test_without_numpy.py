"""Exact answers without numpy, as in a browser, against those with it."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
COMMANDS = (
    ("check", "rk4", "-v"),
    ("check", "methods/collocation.gark.yaml", "methods/three-colours.gark.yaml"),
    ("check", "tests/browser/free.gark.yaml", "ros3p"),
    ("conditions", "--order", "6"),
    ("conditions", "methods/three-colours.gark.yaml", "--order", "5"),
    ("conditions", "rk4", "--order", "6", "--failing"),
    ("tableau", "gauss-2"),
    ("conjugate", "methods/collocation.gark.yaml"),
    ("stability", "ark-ars222"),
    ("stability", "methods/collocation.gark.yaml"),
    ("plot", "rk4"),
    ("plot", "gauss-3", "--what", "star"),
)
PAGES = ("rk4", "methods/collocation.gark.yaml", "ark-ars222", "tests/browser/free.gark.yaml")
ROUNDED = "dop853"
MISSING = "this needs numpy, which is not installed here"
FIGURE = re.compile(r"<figure.*?</figure>", re.DOTALL)
RUN = """
import contextlib, io, json, sys
heavy = ("numpy", "sympy", "scipy", "matplotlib")
if is_blocked:
    sys.modules.update(dict.fromkeys(heavy))  # their import fails
from garkcli.cli import main
answers = []
for arguments in commands:
    text = io.StringIO()
    with contextlib.redirect_stdout(text), contextlib.redirect_stderr(text):
        try:
            main([*arguments])
        except SystemExit as end:
            answers.append([end.code, text.getvalue()])
print(json.dumps(answers))
"""


def answers(commands: tuple[tuple[str, ...], ...], is_blocked: bool) -> list[tuple[int, str]]:
    """The exit codes and outputs of commands in a process with or without numpy."""
    script = f"is_blocked, commands = {is_blocked!r}, {commands!r}\n{RUN}"
    done = subprocess.run(
        [sys.executable, "-c", script], cwd=ROOT, capture_output=True, text=True, check=True
    )
    return [(code, text) for code, text in json.loads(done.stdout)]


def test_commands_answer_alike() -> None:
    """Orders, conditions, tableaus, stability and its pictures are the same to the letter."""
    without, with_it = answers(COMMANDS, True), answers(COMMANDS, False)
    assert len(without) == len(COMMANDS)
    for command, here, there in zip(COMMANDS, without, with_it, strict=True):
        assert here == there, command
    assert {code for code, _ in without} == {0}


def test_reports_lack_runs_in_floats_alone() -> None:
    """A sentence is in the place of the pictures of runs; the rest is the same to the letter."""
    commands = tuple(("report", name, "-v", "-o", "-") for name in PAGES)
    found = zip(answers(commands, True), answers(commands, False), strict=True)
    for name, ((code, here), (_, there)) in zip(PAGES, found, strict=True):
        assert code == 0, here
        is_run = [MISSING in figure for figure in FIGURE.findall(here)]
        assert sum(is_run) == (0 if "free" in name else 2)
        kept = [x for x, without in zip(FIGURE.findall(there), is_run, strict=True) if not without]
        assert kept == [x for x in FIGURE.findall(here) if MISSING not in x]
        assert FIGURE.sub("", here) == FIGURE.sub("", there)


def test_rounded_methods_are_refused_in_words() -> None:
    """A check and a report say that numpy is missing; no program fails."""
    checked, reported = answers((("check", ROUNDED), ("report", ROUNDED, "-o", "-")), True)
    assert checked[0] == reported[0] == 2
    assert checked[1].startswith(f"{ROUNDED}: error[missing-package]: {MISSING}")
    assert MISSING in reported[1]
    assert "<!doctype html>" in reported[1]
