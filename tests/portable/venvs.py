"""Virtual environments with the newest versions of all dependencies, or the oldest declared ones."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Literal

ROOT = Path(__file__).resolve().parents[2]
CACHE = ROOT / ".portable"
"""Environments and records of runs; ignored by git, and safe to delete."""
FLOOR = re.compile(r"^([\w.-]+)>=([\w.]+)$")

Versions = Literal["newest", "floors", "no-libyaml", "wheel"]
"""``wheel`` is the newest of each, and gark not from the checkout: its wheel is installed."""


class NotHad(Exception):
    """A machine has no such circumstance; the text says why."""


@dataclass(frozen=True)
class Venv:
    """An interpreter and the versions of the packages beside it."""

    python: str
    versions: Versions

    @property
    def folder(self) -> Path:
        """Where it is kept from run to run."""
        return CACHE / f"python{version_of(self.python)}-{self.versions}"


def floors() -> list[str]:
    """The declared minimum versions, those of the tests included, as pip's constraints."""
    declared = tomllib.loads(
        (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    )["project"]
    lines = (
        *declared["dependencies"],
        *declared["optional-dependencies"]["test"],
    )
    found = [FLOOR.match(line) for line in lines]
    return [f"{floor[1]}=={floor[2]}" for floor in found if floor]


@cache
def version_of(python: str) -> str:
    """``3.12`` and the like.

    Raises:
        NotHad: it does not run.
    """
    program = "import sys; print('{}.{}'.format(*sys.version_info))"
    try:
        done = subprocess.run(
            [python, "-c", program], capture_output=True, text=True, check=True
        )
    except (OSError, subprocess.CalledProcessError) as error:
        raise NotHad(f"{python} does not run") from error
    return done.stdout.strip()


@cache
def python_of(venv: Venv) -> Path:
    """The interpreter of an environment, which is made or brought up to date first.

    Raises:
        NotHad: an environment cannot be made, or some package is not to be had for it.
    """
    folder = venv.folder
    python = folder / (
        "Scripts/python.exe" if sys.platform == "win32" else "bin/python"
    )
    if not python.exists():
        done([venv.python, "-m", "venv", str(folder)])
    wanted = ["--editable", ".[test]", "build", "threadpoolctl"]
    if venv.versions == "floors":
        constraints = folder / "floors.txt"
        constraints.write_text("\n".join(floors()) + "\n", encoding="utf-8")
        wanted += ["--constraint", str(constraints)]
    else:
        wanted += ["--upgrade", "--upgrade-strategy", "eager"]
    pip = [str(python), "-m", "pip", "--quiet", "--disable-pip-version-check"]
    done([*pip, "install", *wanted])
    if venv.versions == "no-libyaml":
        _without_libyaml(folder)
    return python


def _without_libyaml(folder: Path) -> None:
    """PyYAML as it is where it was built without the library of C: its extension is removed."""
    for extension in folder.rglob("_yaml*"):
        if extension.is_dir():
            shutil.rmtree(extension)
        else:
            extension.unlink()


def done(command: list[str]) -> None:
    """Run, in the root of the project."""
    done = subprocess.run(
        command, cwd=ROOT, capture_output=True, text=True, check=False
    )
    if done.returncode:
        said = done.stderr.strip().splitlines() or ["without a word"]
        raise NotHad(f"{' '.join(command[1:4])} fails: {said[-1]}")
