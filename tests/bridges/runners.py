"""Other codes, and how a program that ``gark export --test`` wrote is built and run in each."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from tests.bridges import machine
from tests.bridges.machine import CACHE, NotHad, done, need

Command = Sequence[str]
SUNDIALS_WHEEL = "sundials4py==7.9.0"
MFEM_WHEEL = "mfem==4.10.0.1"
_ARCHIVES = (
    "arkode",
    "nvecserial",
    "sunmatrixdense",
    "sunlinsoldense",
    "sunmatrixband",
    "sunlinsolband",
    "sunnonlinsolnewton",
    "sunnonlinsolfixedpoint",
    "core",
)
_LEFT_OUT = (
    "SUNContextFunctionTable_Destroy",
    "SUNLinearSolverFunctionTable_Destroy",
    "SUNLoggerFunctionTable_Destroy",
    "SUNNonlinearSolverFunctionTable_Destroy",
    "SUNStepperFunctionTable_Destroy",
    "arkode_user_supplied_fn_table_destroy",
    "mristepinnerstepper_user_supplied_fn_table_destroy",
)
"""Functions of the Python module, which its archives call; nothing has to be destroyed here."""


@dataclass(frozen=True)
class Ready:
    """A code that is there.

    Attributes:
        version: as it says itself.
        commands: from the name of a program, without its ending, to what builds and runs it.
    """

    version: str
    commands: Callable[[str], Sequence[Command]]


@dataclass(frozen=True)
class Runner:
    """A code that runs methods.

    Attributes:
        name: in the table.
        target: of ``gark export``.
        kinds: of methods, as in ``METHODS``.
        ready: sees to it that it is there; raises ``NotHad``.
        solver: to what its programs solve implicit stages.
        reading: what is lost when the result is taken out, in units of round-off.
    """

    name: str
    target: str
    kinds: tuple[str, ...]
    ready: Callable[[], Ready]
    solver: float = 0.0
    reading: float = 0.0


EXPLICIT = ("explicit",)
IMPLICIT = ("explicit", "DIRK", "IMEX")
ALL = ("explicit", "DIRK", "IMEX", "SPRK")


def _version(*command: str) -> str:
    """The first number with a point in what a command prints."""
    said = done(command)
    found = re.search(r"\d+(\.\d+)+", said)
    return found[0] if found else said.splitlines()[0]


def _of_package(python: str, package: str) -> str:
    program = f"from importlib.metadata import version; print(version('{package}'))"
    return done([python, "-c", program])


def _module(python: str) -> Callable[[str], list[Command]]:
    return lambda stem: [[python, f"{stem}_test.py"]]


def scipy() -> Ready:
    """Of PyPI."""
    python = machine.python_with("scipy", "scipy")
    return Ready(_of_package(python, "scipy"), _module(python))


def diffrax() -> Ready:
    """Of PyPI, with JAX."""
    python = machine.python_with("diffrax", "diffrax")
    return Ready(_of_package(python, "diffrax"), _module(python))


def torchdiffeq() -> Ready:
    """Of PyPI, with the PyTorch of an interpreter that has it, or of Debian."""
    base = _python_with_torch()
    version = done([base, "-c", "import torch; print(torch.__version__)"])
    # PyTorch 1 was built for NumPy 1
    others = ["numpy<2", "scipy<1.14"] if version.startswith("1.") else []
    python = machine.python_with("torch", "torchdiffeq", *others, of=base)
    ours = _of_package(python, "torchdiffeq")
    return Ready(f"{ours}, PyTorch {version}", _module(python))


def _python_with_torch() -> str:
    for python in (sys.executable, "/usr/bin/python3"):
        if machine.works([python, "-c", "import torch"]):
            return python
    probe = ("/usr/bin/python3", "-c", "import torch")
    need(machine.Tool("PyTorch", probe, "python3-torch python3-venv"))
    return probe[0]


def octave() -> Ready:
    """Of Debian, or what there is."""
    need(machine.OCTAVE)
    options = ["--no-gui", "--quiet", "--no-history"]
    return Ready(
        _version("octave-cli", "--version"),
        lambda stem: [["octave-cli", *options[1:], "--eval", f"{stem}_test"]],
    )


def desolve() -> Ready:
    """Of Debian, or what there is."""
    need(machine.DESOLVE)
    program = "cat(as.character(packageVersion('deSolve')))"
    return Ready(done(["Rscript", "-e", program]), lambda stem: [["Rscript", f"{stem}_test.R"]])


def boost() -> Ready:
    """Of Debian, or what there is."""
    need(machine.CXX, machine.BOOST)
    line = "printf '#include <boost/version.hpp>\\nBOOST_LIB_VERSION' | c++ -E -P -x c++ -"
    version = done(["sh", "-c", line]).splitlines()[-1].strip('"')
    return Ready(version.replace("_", "."), lambda stem: _compiled(stem, []))


def _compiled(stem: str, options: Sequence[str]) -> list[Command]:
    """A program of C++, and its run."""
    build = ["c++", "-std=c++17", f"{stem}_test.cpp", *options]
    return [[*build, "-o", f"{stem}_test"], [f"./{stem}_test"]]


def mfem() -> Ready:
    """The library and the headers in a wheel of PyPI."""
    need(machine.CXX)
    root = machine.wheel(MFEM_WHEEL, "mfem/external/ser/")
    folder = root / "mfem" / "external" / "ser"
    config = (folder / "include/mfem/config/_config.hpp").read_text("utf-8")
    found = re.search(r'MFEM_VERSION_STRING "([\d.]+)"', config)
    libraries = folder / "lib"
    options = [f"-I{folder / 'include'}", f"-L{libraries}", "-lmfem", f"-Wl,-rpath,{libraries}"]
    version = found[1] if found else MFEM_WHEEL
    return Ready(version, lambda stem: _compiled(stem, options))


def sundials() -> Ready:
    """Of Debian, or what there is."""
    need(machine.CC, machine.CXX, machine.SUNDIALS)
    line = "printf '#include <sundials/sundials_config.h>\\nSUNDIALS_VERSION' | cc -E -P -"
    version = done(["sh", "-c", line]).splitlines()[-1].strip('"')
    libraries = ["-lsundials_arkode", "-lsundials_nvecserial"]
    return Ready(version, lambda stem: _of_c(stem, [], libraries))


def sundials_wheel() -> Ready:
    """The archives and the headers in a wheel of PyPI, which is for a newer Python."""
    need(machine.CC)
    folder = machine.wheel(SUNDIALS_WHEEL, "", python="3.12")
    archives = next(folder.glob("lib*/libsundials_core.a"), None)
    if archives is None:
        raise NotHad("the wheel has no archives")
    missing = CACHE / "left_out.c"
    functions = [f"void {name}(void *x) {{ (void)x; }}" for name in _LEFT_OUT]
    missing.write_text("\n".join(functions) + "\n", encoding="utf-8")
    libraries = [f"-L{archives.parent}"]
    libraries += [f"-lsundials_{name}" for name in _ARCHIVES]
    options = [f"-I{folder / 'include'}", str(missing)]
    version = SUNDIALS_WHEEL.rpartition("=")[2]
    return Ready(version, lambda stem: _of_c(stem, options, libraries))


def _of_c(
    stem: str, options: Sequence[str], libraries: Sequence[str], compiler: str = "cc"
) -> list[Command]:
    """A program of C with its table beside it, and its run."""
    build = [compiler, f"{stem}_test.c", f"{stem}.c", *options, *libraries]
    return [[*build, "-lm", "-o", f"{stem}_test"], [f"./{stem}_test"]]


def petsc() -> Ready:
    """Of Debian, or what there is."""
    need(machine.CC, machine.PETSC)
    flags = done(["pkg-config", "--cflags", "--libs", "PETSc"]).split()
    version = done(["pkg-config", "--modversion", "PETSc"])
    compiler = "mpicc" if machine.works(["mpicc", "--version"]) else "cc"
    return Ready(version, lambda stem: _of_c(stem, [], flags, compiler))


RUNNERS = (
    Runner("scipy", "scipy", EXPLICIT, scipy),
    Runner("diffrax", "diffrax", IMPLICIT, diffrax, solver=2e-12),
    # the quartic at the end of a step has coefficients of up to 32 y
    Runner("torchdiffeq", "torchdiffeq", EXPLICIT, torchdiffeq, reading=256),
    Runner("Octave", "matlab", ALL, octave, solver=1e-15),
    Runner("deSolve", "desolve", EXPLICIT, desolve),
    Runner("Boost.Odeint", "boost", EXPLICIT, boost),
    Runner("MFEM", "mfem", EXPLICIT, mfem),
    Runner("SUNDIALS", "sundials", IMPLICIT, sundials, solver=1e-13),
    Runner("SUNDIALS 7", "sundials", ALL, sundials_wheel, solver=1e-13),
    Runner("PETSc", "petsc", ALL, petsc, solver=1e-13),
)


@dataclass(frozen=True)
class Failed(Exception):
    """A program did not build, or did not run."""

    message: str


@dataclass
class Program:
    """A program in a folder.

    Attributes:
        folder: where its files are.
        stem: of the files.
        record: what was printed.
    """

    folder: Path
    stem: str
    record: list[str] = field(default_factory=list)

    def errors(self, commands: Sequence[Command]) -> list[tuple[int, float]]:
        """Build it, run it, and read what it prints: numbers of steps and errors.

        Raises:
            Failed: a command fails.
        """
        said = ""
        for command in commands:
            ended = subprocess.run(
                command,
                cwd=self.folder,
                stdin=subprocess.DEVNULL,
                capture_output=True,
                text=True,
                timeout=300,
                check=False,
            )
            said = ended.stdout
            self.record += [" ".join(command), ended.stdout, ended.stderr]
            if ended.returncode:
                last = ended.stderr.strip().splitlines() or [""]
                raise Failed(f"{command[0]}: {last[-1]}"[:200])
        return rows_of(said)


def rows_of(said: str) -> list[tuple[int, float]]:
    r"""The rows of the output of a program.

    >>> rows_of("steps  error  slope\n    8  1.5e-03\n   16  3.75e-04  2.00\n")
    [(8, 0.0015), (16, 0.000375)]
    """
    found = []
    for line in said.splitlines():
        words = line.split()
        if len(words) > 1 and words[0].isdigit():
            found.append((int(words[0]), float(words[1])))
    return found
