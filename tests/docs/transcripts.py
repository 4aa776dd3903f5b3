"""Pages with sessions: their files are written, their commands are run, one after the other."""

from __future__ import annotations

import importlib.util
import os
import re
import shlex
import shutil
import subprocess
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.cli.harness import ROOT, gark

FOLDERS = ("methods", "problems", "tests/examples", "tools")
"""What a page may use from the checkout."""

FILES = {"yaml", "c", "python", "toml", "julia"}
"""The languages of blocks that are files."""

PROGRAMS = ("gark", "python3", "sed", "cp", "cat", "grep", "head", "cc")
"""The programs that sessions run."""

NOT_RUN = {"make": "it installs, or runs what runs this", "pip": "it installs from an index"}
"""Commands that stand in sessions and are left out, by their first word, with the reason."""

NEEDS = {"python3 dp5_test.py": "scipy"}
"""Commands that are left out where a module is not installed, which the extra ``test`` has."""

MEANT_FOR_A_SHELL = {"|", ">", ">>", "<", "&&", ";", "&"}
"""Words that a shell takes for itself: these commands have none."""


@dataclass(frozen=True)
class Step:
    """A file to be written, or a command with what it shows.

    Attributes:
        command: the command line; empty for a file.
        text: the file, or what the command shows.
        file: the name of the file; empty for a command.
        line: the line of the page that the command stands on.
    """

    command: str
    text: str
    file: str = ""
    line: str = ""

    def block(self, shown: str) -> str:
        """The command with what it shows, as lines of the page."""
        return f"$ {self.line}\n{shown}\n" if shown else f"$ {self.line}\n"


def steps(page: Path) -> Iterator[Step]:
    """The files and commands of a page in order.

    A file is a block of YAML, C, Python, TOML or Julia after a line that ends with its name:
    `` `name.yaml`: ``. Commands are the lines of console blocks that begin with a dollar sign;
    those of ``NOT_RUN`` are left out.
    """
    text = page.read_text(encoding="utf-8")
    pattern = re.compile(
        r"(?:`([\w./-]+\.(?:yaml|c|py|toml|jl))`:\n\n)?```(\w+)\n(.*?)^```$",
        re.DOTALL | re.MULTILINE,
    )
    for name, language, block in pattern.findall(text):
        if language in FILES and name and "/" not in name:
            yield Step("", block, name)
        if language == "console":
            for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
                line, _, shown = part.partition("\n")
                command = line.partition("  #")[0].strip()
                if can_be_run(command):
                    yield Step(command, shown.rstrip("\n"), line=line)


def can_be_run(command: str) -> bool:
    """Whether a command of a session is one that is run here."""
    needed = NEEDS.get(command)
    if needed and importlib.util.find_spec(needed) is None:
        return False
    return command.split()[0] not in NOT_RUN


def agrees(shown: str, lines: list[str]) -> bool:
    """Whether ``lines`` are those shown, where a line ``...`` stands for any number of them."""
    pattern = "".join(
        r"(?:.*\n)*" if line.strip() == "..." else re.escape(line.rstrip()) + r"\n"
        for line in shown.splitlines()
    )
    return re.fullmatch(pattern, "".join(f"{line.rstrip()}\n" for line in lines)) is not None


def brought_up_to_date(shown: str, lines: list[str]) -> str:
    """The text that a page should show: all lines, or those up to the last one that stood before a
    ``...`` at its end.

    Raises AssertionError if that one has changed, or if lines are left out elsewhere.
    """
    old = shown.splitlines()
    if agrees(shown, lines):
        return shown
    *before, end = [line.rstrip() for line in old] or [""]
    if "..." not in (x.strip() for x in old):
        return "\n".join(lines)
    new = [line.rstrip() for line in lines]
    is_cut_at_its_end = end.strip() == "..." and "..." not in map(str.strip, before)
    at = [k for k, line in enumerate(new) if is_cut_at_its_end and line == before[-1]]
    assert at, "mend it by hand, it shows\n\n" + "\n".join(lines)
    last = min(at, key=lambda k: abs(k + 1 - len(before)))
    return "\n".join([*lines[: last + 1], "..."])


def prepare(folder: Path) -> None:
    """Give a folder what a checkout has."""
    for name in FOLDERS:
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copytree(ROOT / name, target)


def run(command: str, folder: Path, as_process: bool) -> tuple[int, list[str]]:
    """Run one command as a user does; its exit code, and its lines, errors first.

    ``gark`` is a process where ``as_process`` says so, and a call in this one otherwise, which
    imports nothing twice.
    """
    words = shlex.split(command)
    assert not MEANT_FOR_A_SHELL & set(words), command
    if words[0] == "gark" and not as_process:
        done = gark(*words[1:], cwd=folder)
        return int(str(done.code)), (done.err + done.out).splitlines()
    if words[0] == "gark":
        words = [sys.executable, "-m", "garkcli", *words[1:]]
    elif words[0] == "python3":
        words[0] = sys.executable
    ended = subprocess.run(
        words,
        cwd=folder,
        env={**os.environ, "PYTHONUTF8": "1", "PYTHONIOENCODING": "utf-8"},
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    return ended.returncode, (ended.stderr + ended.stdout).splitlines()
