"""``make release-check``: the distributions, built and tried from empty environments.

    python -m tests.portable.release [--lock]

For each Python from 3.11 to 3.14 that the machine has, the wheel and the source distribution are
installed into environments of their own, and the wheel a third time with exactly the versions and
hashes of ``action-requirements.txt``. ``build/release`` has the sums of the distributions and, for
each Python, what they were tried with: requirements with hashes, and a bill of materials.

``--lock`` writes ``action-requirements.txt`` anew: the newest versions, with the hashes of their
wheels for the systems that GitHub runs.
"""

from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Any, NamedTuple, Self

from tests.portable.circumstances import other_pythons
from tests.portable.venvs import CACHE, ROOT, NotHad, done, version_of

DIST, RECORDS, LOCK = ROOT / "dist", ROOT / "build" / "release", ROOT / "action-requirements.txt"
PYTHONS = ("3.11", "3.12", "3.13", "3.14")
"""The versions that a release is for."""
SYSTEMS = {
    "manylinux_2_28_x86_64": ("manylinux_2_17_x86_64", "manylinux2014_x86_64"),
    "manylinux_2_28_aarch64": ("manylinux_2_17_aarch64", "manylinux2014_aarch64"),
    "macosx_15_0_arm64": (),
    "win_amd64": (),
}
"""The systems of the runners, with older names that wheels for them have."""
ON_WINDOWS = ("colorama",)
"""Dependencies that pip, which knows the system of this machine alone, would leave out."""
HEAD = """\
# What the action installs, with the hashes of the wheels for Python 3.11 to 3.14 on Linux, macOS on
# Apple processors and Windows; made by python -m tests.portable.release --lock
"""
TRIALS = (
    (["--version"], "gark "),
    (["check", "rk4"], "rk4: order 4, proved"),
    (["check", "gauss-2", "-v"], "symplectic"),
    (["stability", "heun"], "real axis"),
    (["converge", "heun"], "observed"),
    (["export", "rk4", "--to", "numpy"], "import numpy"),
    (["report", "rk4", "-o", "-"], "</html>"),
    (["show", "kutta-38"], "reference"),
)
"""Commands that need every dependency, and a part of what they print."""
OF_SOURCES = ((["audit", "solver.py"], "1 table, none wrong"),)
"""Commands that need the extra for sources, which the action has."""
SOLVER = "A = [[0, 0], [1 / 2, 0]]\nb = [0, 1]\nc = [0, 1 / 2]\norder = 2\n"


class Package(NamedTuple):
    """A package that pip installed, or would install."""

    name: str
    version: str
    license: str
    hashes: frozenset[str]

    @classmethod
    def read(cls, entry: Mapping[str, Any]) -> Self:
        """One entry of a report of pip."""
        about, archive = entry["metadata"], entry["download_info"].get("archive_info", {})
        found = archive.get("hashes", {}).get("sha256")
        licensed = about.get("license_expression") or about.get("license") or ""
        short = licensed if "\n" not in licensed else ""
        return cls(about["name"], about["version"], short, frozenset({found} if found else ()))

    @property
    def requirement(self) -> str:
        """A line for pip, with all hashes."""
        where = ' ; sys_platform == "win32"' if self.name.lower() in ON_WINDOWS else ""
        hashes = "".join(f" \\\n    --hash=sha256:{x}" for x in sorted(self.hashes))
        return f"{self.name}=={self.version}{where}{hashes}\n"

    @property
    def component(self) -> dict[str, Any]:
        """A component of a bill of materials."""
        made: dict[str, Any] = {
            "type": "library",
            "name": self.name,
            "version": self.version,
            "purl": f"pkg:pypi/{self.name.lower().replace('_', '-')}@{self.version}",
            "hashes": [{"alg": "SHA-256", "content": x} for x in sorted(self.hashes)],
        }
        if self.license:
            made["licenses"] = [{"license": {"name": self.license}}]
        return made


def read_report(path: Path) -> list[Package]:
    """The packages of a report of pip, in the order of their names."""
    report = json.loads(path.read_text(encoding="utf-8"))
    return sorted(map(Package.read, report["install"]), key=lambda x: x.name.lower())


def bill(packages: Sequence[Package], version: str) -> str:
    """A bill of materials by CycloneDX 1.6: gark, and what it was tried with."""
    own, others = [], []
    for package in packages:
        (own if package.name == "garkcli" else others).append(package.component)
    document = {
        "bomFormat": "CycloneDX",
        "specVersion": "1.6",
        "version": 1,
        "metadata": {
            "component": {**own[0], "type": "application"},
            "properties": [{"name": "python", "value": version}],
        },
        "components": others,
    }
    return json.dumps(document, indent=1) + "\n"


def requirements() -> list[str]:
    """What gark, its extra for sources and its build are declared to need."""
    declared = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
    project, build = declared["project"], declared["build-system"]["requires"]
    audit = project["optional-dependencies"]["audit"]
    return [x.partition(";")[0].strip() for x in (*project["dependencies"], *audit, *build)]


def lock() -> None:
    """Writes the requirements of the action.

    The oldest Python chooses the versions, which the others take too.
    """
    wanted = requirements()
    found: dict[str, Package] = {}
    pip = [sys.executable, "-m", "pip", "--quiet", "--disable-pip-version-check"]
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "report.json"
        for python in PYTHONS:
            for system, older in SYSTEMS.items():
                tags = [x for name in (system, *older) for x in ("--platform", name)]
                where = [*tags, "--python-version", python, "--only-binary", ":all:"]
                how = ["--dry-run", "--ignore-installed", "--target", folder]
                done([*pip, "install", *how, *where, "--report", str(report), *wanted])
                for package in read_report(report):
                    before = found.setdefault(package.name, package)
                    assert before.version == package.version, package.name
                    found[package.name] = before._replace(hashes=before.hashes | package.hashes)
            wanted = [f"{x.name}=={x.version}" for x in found.values()]
    lines = [found[name].requirement for name in sorted(found, key=str.lower)]
    LOCK.write_text(HEAD + "".join(lines), encoding="utf-8")
    print(f"{LOCK.name}: {len(lines)} packages")


def built() -> tuple[Path, Path]:
    """The wheel, made from the source distribution, and that."""
    shutil.rmtree(DIST, ignore_errors=True)
    python = _environment(sys.executable, "build")
    done([str(python), "-m", "pip", "install", "--quiet", "build"])
    done([str(python), "-m", "build", "--outdir", str(DIST), "."])
    (wheel,), (source,) = DIST.glob("*.whl"), DIST.glob("*.tar.gz")
    sums = [f"{sha256(x.read_bytes()).hexdigest()}  {x.name}\n" for x in (source, wheel)]
    (RECORDS / "SHA256SUMS").write_text("".join(sums), encoding="utf-8")
    return wheel, source


def _environment(python: str, name: str) -> Path:
    """The interpreter of an environment that has nothing."""
    folder = CACHE / f"release-{name}"
    shutil.rmtree(folder, ignore_errors=True)
    done([python, "-m", "venv", str(folder)])
    return folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")


def trials(python: str, version: str, wheel: Path, source: Path) -> Iterator[str]:
    """Yields what was tried with one Python; records the packages."""
    for archive, name in ((wheel, "wheel"), (source, "sdist")):
        place = _environment(python, f"{version}-{name}")
        report = RECORDS / f"report-{version}.json"
        pip = [str(place), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        done([*pip, "--report", str(report), str(archive)])
        _try(place)
        if archive is wheel:
            packages = read_report(report)
            others = "".join(x.requirement for x in packages if x.name != "garkcli")
            (RECORDS / f"tested-{version}.txt").write_text(others, encoding="utf-8")
            (RECORDS / f"sbom-{version}.json").write_text(bill(packages, version), encoding="utf-8")
        report.unlink()
        yield f"{version} {name}: {len(TRIALS)} commands"
    place = _environment(python, f"{version}-locked")
    pip = [str(place), "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    done([*pip, "--require-hashes", "--only-binary", ":all:", "--requirement", str(LOCK)])
    done([*pip, "--no-deps", str(wheel)])
    done([str(place), "-m", "pip", "check"])
    tried = (*TRIALS, *OF_SOURCES)
    _try(place, tried)
    yield f"{version} wheel, by hashes: {len(tried)} commands"


def _try(python: Path, tried: Sequence[tuple[list[str], str]] = TRIALS) -> None:
    """Runs commands in a folder that has one source.

    Raises:
        NotHad: one fails, or prints something else.
    """
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "solver.py").write_text(SOLVER, encoding="utf-8")
        for arguments, part in tried:
            command = [str(python), "-I", "-m", "garkcli", *arguments]
            run = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
            if run.returncode or part not in run.stdout:
                raise NotHad(f"gark {' '.join(arguments)} fails: {run.stderr or run.stdout}")


def main() -> int:
    """Returns 1 if a distribution fails."""
    parser = argparse.ArgumentParser(description="The distributions of a release, tried.")
    parser.add_argument("--lock", action="store_true", help="write action-requirements.txt anew")
    if parser.parse_args().lock:
        lock()
        return 0
    os.environ.pop("PYTHONPATH", None)  # what is there would count as installed
    shutil.rmtree(RECORDS, ignore_errors=True)
    RECORDS.mkdir(parents=True)
    pythons = {version_of(x): x for x in (sys.executable, *other_pythons())}
    try:
        wheel, source = built()
        print(f"built {source.name} and {wheel.name}")
        for version in PYTHONS:
            if version not in pythons:
                print(f"{version}: this machine has none")
                continue
            for line in trials(pythons[version], version, wheel, source):
                print(line)
    except NotHad as error:
        print(error, file=sys.stderr)
        return 1
    print(f"records in {RECORDS.relative_to(ROOT)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
