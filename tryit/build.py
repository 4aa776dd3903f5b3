"""``make page``: gark as a static page in build/page, which any server of files may hand out.

pip brings the compiled wheels for Pyodide and npm Pyodide itself, both from where they always do;
what is pure Python is copied from where it is installed.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
import tarfile
from base64 import b64encode
from collections.abc import Iterator
from hashlib import sha256
from importlib.metadata import distribution
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from garkcli.plots.svg import STYLE

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent
TARGET = ROOT / "build" / "page"
PYODIDE = "pyodide@314"
RUNTIME = ("pyodide.mjs", "pyodide.asm.mjs", "pyodide.asm.wasm", "python_stdlib.zip")
COMPILED = ("python-flint", "msgspec")
PURE = ("click", "Jinja2", "latex2mathml", "MarkupSafe", "PyYAML")
"""Those with a part in C do without it."""
PAGE = ("tryit.js", "worker.js")
STATIC = ROOT / "garkcli" / "webpage" / "static"
SUFFIXES = {".py", ".json", ".toml", ".txt", ".html", ".css", ".js", ".jinja", ".yaml"}
LEFT_OUT = {"pytest_plugin.py"}
EPOCH = (1980, 1, 1, 0, 0, 0)
"""The time of all files of an archive: equal contents make equal archives."""


def main() -> None:
    """Builds the page."""
    shutil.rmtree(TARGET, ignore_errors=True)
    TARGET.mkdir(parents=True)
    with TemporaryDirectory() as scratch:
        lock = copy_runtime(Path(scratch))
        wheels = copy_wheels(Path(scratch), lock)
    archive = TARGET / "gark.zip"
    pack(archive)
    run("node", str(HERE / "compile.mjs"), str(TARGET), archive.name)
    (TARGET / "wheels.json").write_text(json.dumps([*wheels, archive.name]), encoding="utf-8")
    for name in PAGE:
        shutil.copy(HERE / name, TARGET / name)
    colours = (STATIC / "colours.css").read_text(encoding="utf-8")
    css = (HERE / "tryit.css").read_text(encoding="utf-8")
    (TARGET / "tryit.css").write_text(colours + css + STYLE, encoding="utf-8")
    html = (HERE / "index.html").read_text(encoding="utf-8")
    (TARGET / "index.html").write_text(html.replace("{{ policy }}", policy()), encoding="utf-8")
    size = sum(x.stat().st_size for x in TARGET.iterdir()) / 1e6
    print(f"wrote {TARGET.relative_to(ROOT)}, {size:.0f} MB: python -m http.server -d build/page")


def policy() -> str:
    """The content security policy: nothing comes from elsewhere, and nothing goes there.

    The report in its frame runs its one script.
    """
    script = (STATIC / "page.js").read_bytes()
    report = b64encode(sha256(script).digest()).decode()
    return (
        "default-src 'none'; connect-src 'self'; worker-src 'self'; "
        f"script-src 'self' 'wasm-unsafe-eval' 'sha256-{report}'; "
        "style-src 'self' 'unsafe-inline'; img-src data:; form-action 'none'; base-uri 'none'"
    )


def copy_runtime(scratch: Path) -> dict[str, str]:
    """Copies Pyodide and returns what it is built for."""
    run("npm", "pack", PYODIDE, "--silent", "--pack-destination", str(scratch))
    (archive,) = scratch.glob("pyodide-*.tgz")
    with tarfile.open(archive) as files:
        files.extractall(scratch, filter="data")
    for name in RUNTIME:
        shutil.copy(scratch / "package" / name, TARGET / name)
    text = (scratch / "package" / "pyodide-lock.json").read_text(encoding="utf-8")
    info: dict[str, str] = json.loads(text)["info"]
    # its own list names packages that are not here
    own = json.dumps({"info": info, "packages": {}})
    (TARGET / "pyodide-lock.json").write_text(own, encoding="utf-8")
    return info


def copy_wheels(scratch: Path, info: dict[str, str]) -> list[str]:
    """Copies the wheels of compiled packages for a build of Pyodide, and returns their names."""
    major, minor, *_ = info["python"].split(".")
    run(
        *(sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check"),
        *("--no-deps", "--only-binary", ":all:", "--dest", str(scratch)),
        *("--implementation", "cp", "--python-version", f"{major}.{minor}"),
        *("--abi", f"cp{major}{minor}"),
        *("--platform", f"pyemscripten_{info['abi_version']}_{info['arch']}"),
        *COMPILED,
    )
    wheels = sorted(scratch.glob("*.whl"))
    for wheel in wheels:
        shutil.copy(wheel, TARGET / f"{wheel.stem}.zip")  # an ending that every server knows
    return [f"{wheel.stem}.zip" for wheel in wheels]


def pack(archive: Path) -> None:
    """Writes gark, what it needs of pure Python, and the answers of the page."""
    with ZipFile(archive, "w", ZIP_DEFLATED, compresslevel=9) as packed:
        for path, name in sorted(contents(), key=lambda pair: pair[1]):
            info = ZipInfo(name, EPOCH)
            info.compress_type = ZIP_DEFLATED
            packed.writestr(info, path.read_bytes())


def contents() -> Iterator[tuple[Path, str]]:
    """The files of the archive, with their places in it."""
    yield HERE / "answers.py", "answers.py"
    folder = ROOT / "garkcli"
    for path in folder.rglob("*"):
        if path.suffix in SUFFIXES and path.name not in LEFT_OUT:
            yield path, f"garkcli/{path.relative_to(folder).as_posix()}"
    for package in PURE:
        for file in distribution(package).files or ():
            is_about = file.name == "METADATA" or "license" in file.as_posix().lower()
            if ".." not in file.parts and (file.suffix in SUFFIXES or is_about):
                yield Path(str(file.locate())), file.as_posix()


def run(*command: str) -> None:
    """Runs a command; ends with its error."""
    try:
        subprocess.run(command, check=True)
    except FileNotFoundError:
        sys.exit(f"make page needs {command[0]}, which is not installed")
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)


if __name__ == "__main__":
    main()
