"""``make walk``: the README and the tutorials as a newcomer does them.

    python -m tests.portable.walk [--shell zsh] [PAGE…]

The wheel is made and installed with the extras ``audit`` and ``design`` into an environment of its
own. Each page begins in an empty folder: its files are written, and its commands are typed into a
shell, one after the other. What they print has to be what the page shows.
"""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from pathlib import Path

from tests.docs.blocks import blocks
from tests.docs.transcripts import agrees, steps
from tests.portable.venvs import CACHE, ROOT, done

PAGES = (
    "README.md",
    "docs/tutorial-student.md",
    "docs/tutorial-maintainer.md",
    "docs/tutorial-designer.md",
    "docs/tutorial-paper.md",
)


def installed() -> Path:
    """The folder of the commands of a new environment that has the wheel and what the pages need."""
    folder = CACHE / "walk"
    shutil.rmtree(folder, ignore_errors=True)
    done([sys.executable, "-m", "venv", str(folder)])
    commands = folder / ("Scripts" if sys.platform == "win32" else "bin")
    pip = [str(commands / "python"), "-m", "pip", "--quiet"]
    done([*pip, "--disable-pip-version-check", "install", f"{ROOT}[audit,design]"])
    return commands


def walk(page: Path, commands: Path, folder: Path, shell: str) -> list[str]:
    """What is not as a page shows it, for each command a text.

    Args:
        page: with the session.
        commands: where ``gark`` is.
        folder: an empty one.
        shell: its name.
    """
    path = os.pathsep.join([str(commands), os.environ["PATH"]])
    env = {**os.environ, "PATH": path, "PYTHONUTF8": "1"}
    wrong = []
    for step in steps(page):
        if step.file:
            (folder / step.file).write_text(step.text, encoding="utf-8")
            continue
        run = subprocess.run(
            [shell, "-c", step.command],
            cwd=folder,
            env=env,
            capture_output=True,
            encoding="utf-8",
            check=False,
        )
        printed = run.stderr + run.stdout
        if run.returncode > 1 or not agrees(step.text, printed.splitlines()):
            wrong.append(f"$ {step.command}\n{printed}")
    return wrong + list(_wrong_examples(page, env, folder))


def _wrong_examples(page: Path, env: dict[str, str], folder: Path) -> Iterator[str]:
    """Examples of Python on a page that do not print what it shows."""
    examples = [x.text for x in blocks(page) if x.language == "python"]
    text = "\n".join(x for x in examples if x.startswith(">>> "))
    if not text:
        return
    (folder / "examples.txt").write_text(text, encoding="utf-8")
    run = subprocess.run(
        ["python", "-m", "doctest", "examples.txt"],
        cwd=folder,
        env=env,
        capture_output=True,
        encoding="utf-8",
        check=False,
    )
    if run.returncode:
        yield run.stdout + run.stderr


def main(arguments: Sequence[str] | None = None) -> int:
    """Walk, tell of each page, and return an exit code."""
    parser = argparse.ArgumentParser(prog="make walk")
    parser.add_argument("pages", nargs="*", default=PAGES, metavar="PAGE")
    parser.add_argument("--shell", default="bash")
    asked = parser.parse_args(arguments)
    commands, failed = installed(), False
    for name in asked.pages:
        page = ROOT / name
        with tempfile.TemporaryDirectory() as folder:
            wrong = walk(page, commands, Path(folder), asked.shell)
        count = sum(bool(step.command) for step in steps(page))
        print(f"{name}: {count} commands, {len(wrong)} not as shown")
        print("\n".join(wrong), end="\n" if wrong else "")
        failed = failed or bool(wrong)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
