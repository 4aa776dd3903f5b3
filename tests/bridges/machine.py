"""What ``make bridges`` needs of a machine: programs and headers, packages of Python, wheels.

What is missing is installed where that is possible: by apt for root on a machine that has it, by
pip into environments below ``.bridges``. What cannot be had is said, with the reason.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CACHE = ROOT / ".bridges"
"""Environments, wheels, programs and their output; ignored by git, and safe to delete."""
PIP = ("-m", "pip", "--quiet", "--disable-pip-version-check")
_MINUTES = 60  # seconds
_LONGEST = 15 * _MINUTES  # of an installation


class NotHad(Exception):
    """A machine does not have what a target needs; the text says why."""


@dataclass(frozen=True)
class Tool:
    """Something that a command shows to be there, and the package of Debian that brings it."""

    name: str
    probe: tuple[str, ...]
    package: str


OCTAVE = Tool("Octave", ("octave-cli", "--version"), "octave")
DESOLVE = Tool("deSolve of R", ("Rscript", "-e", "library(deSolve)"), "r-cran-desolve")
CC = Tool("a C compiler", ("cc", "--version"), "gcc libc6-dev")
CXX = Tool("a C++ compiler", ("c++", "--version"), "g++")
FORTRAN = Tool("gfortran", ("gfortran", "--version"), "gfortran")


def header(name: str, title: str, package: str) -> Tool:
    """A header that the compiler of C++ finds."""
    line = f"printf '#include <{name}>\\n' | c++ -E -x c++ -"
    return Tool(title, ("sh", "-c", line), package)


BOOST = header("boost/numeric/odeint.hpp", "Boost.Odeint", "libboost-dev")
SUNDIALS = header("sundials/sundials_config.h", "SUNDIALS", "libsundials-dev")
PETSC = Tool("PETSc", ("pkg-config", "--exists", "PETSc"), "petsc-dev")


def need(*tools: Tool) -> None:
    """See that all are there, and install what is not.

    Raises:
        NotHad: something is not to be had.
    """
    missing = [tool for tool in tools if not works(tool.probe)]
    if not missing:
        return
    packages = " ".join(tool.package for tool in missing).split()
    names = " and ".join(tool.name for tool in missing)
    _install(names, tuple(packages))
    for tool in missing:
        if not works(tool.probe):
            raise NotHad(f"{tool.name} does not run")


def works(command: Sequence[str]) -> bool:
    """Whether a command runs and succeeds."""
    try:
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, timeout=_MINUTES, check=False
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0


@cache
def _install(names: str, packages: tuple[str, ...]) -> None:
    """By apt.

    Raises:
        NotHad: there is none, or it is not for us, or it fails.
    """
    if shutil.which("apt-get") is None:
        raise NotHad(f"{names}: install it by hand, there is no apt here")
    if os.name != "posix" or os.geteuid() != 0:
        listed = " ".join(packages)
        raise NotHad(f"{names}: as root, apt-get install {listed}")
    _updated()
    quiet = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    command = ["apt-get", "install", "-y", "-q", "--no-install-recommends"]
    done([*command, *packages], quiet)


@cache
def _updated() -> None:
    """The lists of packages, once."""
    done(["apt-get", "update", "-q"])


def done(command: Sequence[str], variables: dict[str, str] | None = None) -> str:
    """Run something that has to succeed; what it prints.

    Raises:
        NotHad: it fails.
    """
    try:
        ended = subprocess.run(
            command,
            cwd=ROOT,
            env=variables,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=_LONGEST,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise NotHad(f"{command[0]} does not end well: {error}") from error
    if ended.returncode:
        said = ended.stderr.strip().splitlines() or ["without a word"]
        words = " ".join(map(str, command[:4]))
        raise NotHad(f"{words} fails: {said[-1]}")
    return ended.stdout.strip()


@cache
def python_with(name: str, *packages: str, of: str = sys.executable) -> str:
    """The interpreter of an environment with these packages, made where it is not there.

    Args:
        name: of its folder.
        packages: as pip has them.
        of: the interpreter that makes it; another one than ours lends its own packages.

    Raises:
        NotHad: it cannot be made, or a package is not to be had.
    """
    folder = CACHE / name
    python = folder / "bin" / "python"
    record = folder / "packages.txt"
    listed = "\n".join(packages)
    is_made = python.exists() and record.exists()
    if is_made and record.read_text(encoding="utf-8") == listed:
        return str(python)
    lent = [] if of == sys.executable else ["--system-site-packages"]
    done([of, "-m", "venv", *lent, str(folder)])
    done([str(python), *PIP, "install", *packages])
    record.write_text(listed, encoding="utf-8")
    return str(python)


@cache
def wheel(requirement: str, inside: str, python: str = "") -> Path:
    """The folder with the unpacked files of a wheel whose names begin with ``inside``.

    Args:
        requirement: as pip has it.
        inside: the beginning of the names that are kept.
        python: the version of Python that the wheel is for, where that is not ours.

    Raises:
        NotHad: there is no such wheel.
    """
    folder = CACHE / "wheels" / requirement
    if (folder / "unpacked").exists():
        return folder
    options = ["--no-deps", "--only-binary", ":all:", "--dest", str(folder)]
    if python:
        options.append(f"--python-version={python}")
    done([sys.executable, *PIP, "download", *options, requirement])
    (archive,) = folder.glob("*.whl")
    with zipfile.ZipFile(archive) as opened:
        names = [x for x in opened.namelist() if x.startswith(inside)]
        opened.extractall(folder, names)
    archive.unlink()
    (folder / "unpacked").touch()
    return folder
