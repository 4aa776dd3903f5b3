"""What the suite is run under by ``make portable``: see docs/contributing/portability.md."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
import tarfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from tests.portable.venvs import CACHE, ROOT, NotHad, Venv, done, python_of, version_of

KERNELS = {
    "x86_64": ("PRESCOTT", "NEHALEM", "SANDYBRIDGE", "HASWELL"),
    "aarch64": ("ARMV8", "CORTEXA57", "NEOVERSEN1", "THUNDERX2T99"),
}
"""Kernels of OpenBLAS by processor, oldest first, as OPENBLAS_CORETYPE names them."""
SAME = {"KATMAI": "PRESCOTT"}
"""Where OpenBLAS has one kernel for two processors it tells the older one's name."""
LOCALES = ("tr_TR.utf8", "de_DE.utf8", "fr_FR.utf8", "ja_JP.utf8")
"""One of these, where there is one: another decimal sign, another capital of i."""
OURS = (
    "OPENBLAS_CORETYPE",
    "NPY_DISABLE_CPU_FEATURES",
    "PYTHONHASHSEED",
    "PYTEST_PLUGINS",
    "LANG",
    "LC_ALL",
    "TZ",
)
"""Variables that are unset unless a circumstance sets them."""
LEAST_PYTHON = (3, 11)

WHOLE: tuple[str, ...] = ()
"""All tests: no paths, so pytest takes those of pyproject.toml."""
MEASURED = (
    "tests/stepping",
    "tests/convergence",
    "tests/longtime",
    "tests/backward",
    "tests/design/test_search.py",
    "tests/problems",
    "tests/ntrees",
    "tests/report",
    "tests/docs",
    "tests/cli/test_snapshots.py",
)
"""Everything that computes in numpy's floats, or compares with a recorded text."""
RECORDED = (
    "tests/docs/test_transcripts.py",
    "tests/docs/test_python_docs.py",
    "tests/docs/test_json_docs.py",
    "tests/cli/test_snapshots.py",
)
"""Everything that compares with a recorded text."""
FILES = (
    "tests/grammar",
    "tests/methodfile",
    "tests/problems/files",
    "tests/docs",
    "tests/cli",
    "tests/integration",
)
"""Everything that reads or writes YAML."""
PACKAGED = (
    "tests/docs",
    "tests/cli/test_snapshots.py",
    "tests/methodfile/test_examples.py",
    "tests/catalogue/test_index.py",
    "tests/catalogue/test_package_data.py",
)
"""Everything that reads files beside the package."""
INSTALLED = (
    "tests/docs/test_transcripts.py",
    "tests/docs/test_command_line_docs.py",
    "tests/docs/test_ci_docs.py",
    "tests/docs/test_python_docs.py",
    "tests/docs/test_man_page.py",
    "tests/cli/test_snapshots.py",
    "tests/cli/test_names.py",
    "tests/cli/test_show.py",
    "tests/cli/test_new.py",
    "tests/cli/test_claims.py",
    "tests/cli/test_project.py",
    "tests/integration",
)
"""Commands as people use them: every one, by what the documentation and the records show."""
PROCESSES = (
    "tests/cli/test_baseline_and_jobs.py",
    "tests/cli/test_process.py",
    "tests/cli/test_signals.py",
    "tests/cli/test_streams.py",
    "tests/crew",
    "tests/methodfile/test_hostile.py",
    "tests/sweep",
)
"""Everything that starts and stops processes."""
ELSEWHERE = (
    *("tests/cli", "tests/crew", "tests/grammar", "tests/methodfile", "tests/page"),
    *("tests/problems/files", "tests/sweep"),
)
"""Everything that asks for something of the system, which may not be there."""

Environment = Callable[[Path], dict[str, str]]
"""From the interpreter to the variables to set; ``NotHad`` where they do not bring it about."""


def _plain(python: Path) -> dict[str, str]:  # noqa: ARG001 -- one of several
    return {}


@dataclass(frozen=True)
class Circumstance:
    """One way to run the suite.

    Attributes:
        name: what ``--only`` calls it.
        what: in words.
        venv: the interpreter and the packages.
        tests: paths for pytest.
        environment: what is set for it.
        wrapper: a command that runs the command after it.
        tree: from the interpreter to the folder that the tests run in.
    """

    name: str
    what: str
    venv: Venv
    tests: tuple[str, ...] = WHOLE
    environment: Environment = _plain
    wrapper: tuple[str, ...] = ()
    tree: Callable[[Path], Path] = lambda python: ROOT  # noqa: ARG005 -- one of several

    def variables(self) -> dict[str, str]:
        """The whole environment of the run.

        Raises:
            NotHad: this machine has no such circumstance.
        """
        inherited = {key: value for key, value in os.environ.items() if key not in OURS}
        return {**inherited, **self.environment(python_of(self.venv))}


def circumstances() -> Iterator[Circumstance]:
    """All of them, the quickest to fail first."""
    newest = Venv(sys.executable, "newest")
    what = "the newest versions; other orders of sets, another time zone"
    # at once, as what they may break is different
    yield Circumstance("newest", what, newest, WHOLE, _hash_seed)
    floors = Venv(sys.executable, "floors")
    yield Circumstance("floors", "the oldest declared version of each dependency", floors)
    no_libyaml = Venv(sys.executable, "no-libyaml")
    yield Circumstance("no-libyaml", "PyYAML without libyaml", no_libyaml, FILES)
    what = "the tree of the source distribution"
    yield Circumstance("sdist", what, newest, PACKAGED, tree=_source_distribution)
    what = "the wheel, without the sources of the package"
    wheel = Venv(sys.executable, "wheel")
    yield Circumstance("wheel", what, wheel, INSTALLED, tree=_without_the_package)
    for name in KERNELS.get(platform.machine(), ()):
        what = f"the {name} kernel of OpenBLAS"
        yield Circumstance(f"kernel-{name.lower()}", what, newest, MEASURED, _kernel(name))
    what = "numpy with its SIMD features disabled"
    yield Circumstance("no-simd", what, newest, MEASURED, _no_simd)
    what = "functions of libm and LAPACK off by units of the last place"
    yield Circumstance("noise", what, newest, RECORDED, _noise)
    yield Circumstance("locale", "the locale of another country", newest, FILES, _locale)
    yield Circumstance("ascii", "a locale and streams of ASCII", newest, FILES, _ascii)
    ignoring = ("sh", "-c", 'trap "" INT; exec "$@"', "sh")
    what = "started with ^C ignored, as in the background of a script"
    yield Circumstance("background", what, newest, PROCESSES, wrapper=ignoring)
    what = "without resource, locks, FIFOs, signals and forks"
    no_unix = Venv(sys.executable, "no-unix")
    yield Circumstance("no-unix", what, no_unix, ELSEWHERE)
    for python in other_pythons():
        version = version_of(python)
        what = f"Python {version} with the newest versions"
        yield Circumstance(f"python{version}", what, Venv(python, "tested"))


def other_pythons() -> list[str]:
    """Interpreters of other versions than this one: those of ``GARK_PYTHONS``, separated as in
    ``PATH``; else those on ``PATH`` and those of pyenv. One of each version.
    """
    asked = os.environ.get("GARK_PYTHONS")
    found: dict[str, str] = {}
    for python in asked.split(os.pathsep) if asked else _interpreters():
        try:
            version = version_of(python)
        except NotHad:  # pyenv has commands for versions that are not chosen
            continue
        found.setdefault(version, python)
    found.pop(version_of(sys.executable), None)
    return [python for version, python in sorted(found.items()) if _number(version) >= LEAST_PYTHON]


def _number(version: str) -> tuple[int, ...]:
    return tuple(map(int, version.split(".")))


def _interpreters() -> Iterator[str]:
    """Commands that may be Pythons new enough."""
    for minor in range(LEAST_PYTHON[1], LEAST_PYTHON[1] + 10):
        if command := shutil.which(f"python3.{minor}"):
            yield command
    if pyenv := shutil.which("pyenv"):
        root = subprocess.run([pyenv, "root"], capture_output=True, text=True, check=False)
        yield from map(str, sorted(Path(root.stdout.strip()).glob("versions/3.*/bin/python")))


def _asked(python: Path, program: str, variables: dict[str, str], cwd: Path | None = None) -> str:
    """What a program prints under ``variables``.

    Raises:
        NotHad: it fails.
    """
    done = subprocess.run(
        [str(python), "-c", program],
        cwd=cwd,
        env={**os.environ, **variables},
        capture_output=True,
        text=True,
        check=False,
    )
    if done.returncode < 0:
        raise NotHad(f"this processor cannot run it (signal {-done.returncode})")
    if done.returncode:
        raise NotHad(done.stderr.strip().splitlines()[-1])
    return done.stdout.strip()


_WHICH_KERNEL = """
import numpy
from threadpoolctl import threadpool_info
square = numpy.arange(90000.0).reshape(300, 300)
square @ square, numpy.linalg.eigvals(square)
print(*{pool.get("architecture", pool["internal_api"]) for pool in threadpool_info()})
"""


def _kernel(name: str) -> Environment:
    """One kernel of OpenBLAS, after a look whether numpy takes it and the processor runs it."""

    def environment(python: Path) -> dict[str, str]:
        variables = {"OPENBLAS_CORETYPE": name}
        taken = _asked(python, _WHICH_KERNEL, variables)
        if SAME.get(taken.upper(), taken.upper()) != name:
            raise NotHad(f"numpy computes with {taken or 'no OpenBLAS'} all the same")
        return variables

    return environment


_FEATURES = """
import numpy
print(*numpy.show_config(mode="dicts")["SIMD Extensions"].get("found", []))
"""


def _no_simd(python: Path) -> dict[str, str]:
    """Every feature disabled that numpy finds beyond those it was built for."""
    found = _asked(python, _FEATURES, {})
    if not found:
        raise NotHad("numpy finds no features beyond those it was built for")
    variables = {"NPY_DISABLE_CPU_FEATURES": found}
    if left := _asked(python, _FEATURES, variables):
        raise NotHad(f"numpy uses {left} all the same")
    return variables


_PLUGIN = "tests.portable.noise"


def _noise(python: Path) -> dict[str, str]:  # noqa: ARG001 -- any
    return {"PYTEST_PLUGINS": _PLUGIN, "GARK_NOISE": "1"}


def _hash_seed(python: Path) -> dict[str, str]:  # noqa: ARG001 -- any
    return {"PYTHONHASHSEED": "20261122", "TZ": "Pacific/Apia"}


_SET_LOCALE = "import locale; print(locale.setlocale(locale.LC_ALL, ''))"


def _locale(python: Path) -> dict[str, str]:
    """The first of ``LOCALES`` that is installed."""
    for name in LOCALES:
        try:
            _asked(python, _SET_LOCALE, {"LC_ALL": name})
        except NotHad:
            continue
        return {"LC_ALL": name}
    raise NotHad(f"none of {', '.join(LOCALES)} is installed")


_ENCODING = "import sys; print(sys.stdout.encoding)"


def _ascii(python: Path) -> dict[str, str]:
    """The C locale, which Python does not replace by one of UTF-8."""
    variables = {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"}
    encoding = _asked(python, _ENCODING, variables)
    if "utf" in encoding.lower():
        raise NotHad(f"streams are of {encoding} all the same")
    return variables


_WHERE = "import garkcli; print(garkcli.__file__)"


def _source_distribution(python: Path, name: str = "sdist") -> Path:
    """Made, and unpacked where nothing else is."""
    folder = CACHE / name
    shutil.rmtree(folder, ignore_errors=True)
    done([str(python), "-m", "build", "--sdist", "--outdir", str(folder), "."])
    (archive,) = folder.glob("*.tar.gz")
    with tarfile.open(archive) as file:
        file.extractall(folder, filter="data")
    archive.unlink()
    (tree,) = folder.iterdir()
    return tree


def _without_the_package(python: Path) -> Path:
    """The tree of the source distribution, whose wheel is installed and whose package is gone."""
    tree = _source_distribution(python, "wheel")
    pip = [str(python), "-m", "pip", "--quiet", "--disable-pip-version-check"]
    done([*pip, "install", "--force-reinstall", "--no-deps", str(tree)])
    for folder in ("garkcli", "garkcli.egg-info", "build"):
        shutil.rmtree(tree / folder, ignore_errors=True)
    place = _asked(python, _WHERE, {}, cwd=tree)
    if "site-packages" not in place:
        raise NotHad(f"the package is taken from {place}")
    return tree
