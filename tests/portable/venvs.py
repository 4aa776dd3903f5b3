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

from tests.portable.no_unix import put_into

ROOT = Path(__file__).resolve().parents[2]
CACHE = ROOT / ".portable"
"""Environments and records of runs; ignored by git, and safe to delete."""
FLOOR = re.compile(r"^([\w.-]+)>=([\w.]+)( *;.*)?$")
"""A declared minimum version; behind a semicolon, where it is needed."""
EXTRAS = ("audit", "cluster", "lsp", "parquet", "plot")
"""What users may have beside the program."""
MSOLVE = "design"
"""One more; it needs a newer numpy than the program does."""
BARE = ("hypothesis", "jsonschema", "pytest", "pytest-xdist")
"""What runs the tests of commands that need nothing but the program."""

Versions = Literal["newest", "floors", "tested", "no-libyaml", "no-unix", "wheel"]
"""``newest`` and ``floors`` have the extras too, which not every Python has; all but ``floors`` are
of the newest of each.
``wheel`` has what a user has: a wheel of gark, not the checkout, with what reads sources and
searches for the best.
"""


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
    """The declared minimum versions as pip's constraints, each once: those of the program, of what
    users may have beside it, and of the tests.
    """
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    groups = declared["optional-dependencies"]
    extra = [line for name in (*EXTRAS, "test") for line in groups[name]]
    lines = [*declared["dependencies"], *extra]
    found = [FLOOR.match(line) for line in lines]
    return sorted({f"{x[1]}=={x[2]}{x[3] or ''}" for x in found if x}, key=str.lower)


@cache
def version_of(python: str) -> str:
    """``3.12`` and the like.

    Raises:
        NotHad: it does not run.
    """
    program = "import sys; print('{}.{}'.format(*sys.version_info))"
    try:
        done = subprocess.run([python, "-c", program], capture_output=True, text=True, check=True)
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
    python = folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    if not python.exists():
        done([venv.python, "-m", "venv", str(folder)])
    wanted = [*_wanted(venv.versions), "build", "threadpoolctl"]
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
    if venv.versions == "no-unix":
        _without_unix(python)
    return python


def _wanted(versions: Versions) -> list[str]:
    """What pip installs: gark, and what is beside it."""
    if versions == "wheel":
        return [".[audit,design]", *BARE]
    extras = {"newest": (*EXTRAS, MSOLVE), "floors": EXTRAS}
    return ["--editable", f".[{','.join(['test', *extras.get(versions, ())])}]"]


def _without_libyaml(folder: Path) -> None:
    """PyYAML as it is where it was built without the library of C: its extension is removed."""
    for extension in folder.rglob("_yaml*"):
        if extension.is_dir():
            shutil.rmtree(extension)
        else:
            extension.unlink()


def _without_unix(python: Path) -> None:
    """What is run at the start of each process takes away what Windows lacks."""
    program = "import sysconfig; print(sysconfig.get_path('purelib'))"
    packages = subprocess.run([python, "-c", program], capture_output=True, text=True, check=True)
    put_into(Path(packages.stdout.strip()))


def done(command: list[str]) -> None:
    """Run, in the root of the project."""
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        said = done.stderr.strip().splitlines() or ["without a word"]
        raise NotHad(f"{' '.join(command[1:4])} fails: {said[-1]}")
