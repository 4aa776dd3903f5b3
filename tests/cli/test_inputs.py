"""Files that a command reads: what is no file is refused, no input is written over, and nothing
leads out of a project.
"""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from garkcli.files import NotAFile, begin_of
from tests.cli.harness import NAMES, ROOT, Run, gark
from tests.whole import in_whole, sample

METHOD = "A: [[0, 0], [1/2, 0]]\nb: [0, 1]\n"
FAMILY = "parameters: {t: free}\nA: [[t]]\nb: [1]\n"
PROBLEM = "variables: [x]\nhamiltonian: [px**2/2, x**2/2]\ninitial: {x: 1, px: 0}\nt_end: 1/10\n"
SPEC = "files: [m.gark.yaml]\ncolumns: [order]\n"
SECRET = "T0PSECRET"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with a file of each kind."""
    texts = {"m.gark.yaml": METHOD, "n.gark.yaml": METHOD, "family.yaml": FAMILY}
    texts |= {"problem.yaml": PROBLEM, "spec.yaml": SPEC, "source.csv": "0,0\n,1\n"}
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def refused(run: Run, *words: str) -> None:
    """Exit code 2, with some words."""
    assert run.code == 2
    for word in words:
        assert word in run.out + run.err


# -- what is no file
# ------------------------------------------------------------------------------------------

READERS = (
    *("import F", "audit F", "check F", "diff m.gark.yaml F", "report F", "sweep F"),
    *("check m.gark.yaml --baseline F", "converge m.gark.yaml --problem F", "tableau F"),
)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
@pytest.mark.parametrize("command", READERS)
def test_a_named_pipe_is_refused_at_once(command: str, folder: Path) -> None:
    """Nobody may ever write to it, so that reading would not end."""
    os.mkfifo(folder / "pipe.yaml")
    run = gark(*command.replace("F", "pipe.yaml").split(), cwd=folder)
    refused(run, "pipe.yaml", "not a regular file")


@pytest.mark.parametrize("command", ["import F", "audit F", "check F"])
@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="no such device here")
def test_a_device_is_refused(command: str, folder: Path) -> None:
    """It is not opened: it may have no end."""
    refused(gark(*command.replace("F", "/dev/zero").split(), cwd=folder), "not a regular file")


WAITING = """
import os, sys, stat
from garkcli.cli import main
os.mkfifo(sys.argv[1])
held = os.open(sys.argv[1], os.O_RDWR)
stat.S_ISREG = lambda mode: True
main(sys.argv[2:])
"""
"""Run gark beside a pipe that passes for a file, as /proc/kmsg does, and has nothing to give."""


@in_whole
@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
@pytest.mark.parametrize("command", sample([*READERS, "sweep spec.yaml --rows F"], 3))
def test_what_passes_for_a_file_is_not_waited_for(command: str, folder: Path) -> None:
    """The system calls it a regular file, and yet it has nothing to give: a word, and no wait."""
    pipe = "pipe.jsonl" if "--rows" in command else "pipe.yaml"
    done = subprocess.run(
        [sys.executable, "-c", WAITING, pipe, *command.replace("F", pipe).split()],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == 2
    assert "not a regular file" in done.stdout + done.stderr


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_a_pipe_is_not_opened(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """To open some devices has effects; what takes the place of a file since is not read."""
    pipe, file = tmp_path / "pipe", tmp_path / "file"
    os.mkfifo(pipe)
    file.touch()
    opened = []
    with monkeypatch.context() as patched:
        patched.setattr(os, "open", lambda *x: opened.append(x))
        with pytest.raises(NotAFile):
            begin_of(str(pipe), 10)
    assert not opened
    status = file.stat()
    with monkeypatch.context() as patched:
        patched.setattr(os, "stat", lambda _: status)
        with pytest.raises(NotAFile):
            begin_of(str(pipe), 10)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_a_pipe_is_no_page(folder: Path) -> None:
    """What has the name of the page is looked into only if it is a file."""
    os.mkfifo(folder / "rk4.html")
    held = os.open(folder / "rk4.html", os.O_RDWR | os.O_NONBLOCK)
    try:
        refused(gark("report", "rk4", cwd=folder), "rk4.html exists already, and is not a page")
    finally:
        os.close(held)


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
@pytest.mark.parametrize("command", ["import", "audit"])
def test_a_pipe_in_a_folder_is_named_and_left_out(command: str, folder: Path) -> None:
    """The other files of the folder are read."""
    os.mkfifo(folder / "pipe.py")
    run = gark(command, ".", cwd=folder)
    assert run.code == 0
    assert "pipe.py is left out: it is no ordinary file" in run.err


@in_whole
@pytest.mark.skipif(not Path("/dev/fd").exists(), reason="streams have no names here")
@pytest.mark.parametrize(
    "command",
    ["check {0}", "check {0} {1} -j 2", "tableau {0}", "diff {0} {1}", "audit {2}", "import {2}"],
)
def test_streams_that_a_shell_hands_over_are_read(command: str, folder: Path) -> None:
    """``gark check <(cat m.yaml)``: a pipe that is called /dev/fd/63."""
    streams, pids = [], []
    for name in ("m.gark.yaml", "n.gark.yaml", "source.csv"):
        reading, writing = os.pipe()
        os.write(writing, (folder / name).read_bytes())
        os.close(writing)
        streams.append(reading)
        pids.append(f"/dev/fd/{reading}")
    try:
        done = subprocess.run(
            [sys.executable, "-m", "garkcli", *command.format(*pids).split()],
            cwd=folder,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            pass_fds=streams,
            capture_output=True,
            text=True,
            timeout=60,
        )
    finally:
        for stream in streams:
            os.close(stream)
    assert done.returncode == 0, done.stderr
    assert done.stdout


# -- no input is written over
# ---------------------------------------------------------------------------------

OVER_INPUTS = (
    *("check m.gark.yaml -o m.gark.yaml", "check . -o m.gark.yaml", "check *.yaml -o n.gark.yaml"),
    *("tableau m.gark.yaml -o m.gark.yaml", "conjugate m.gark.yaml -o m.gark.yaml"),
    *("conditions m.gark.yaml -n 2 -o m.gark.yaml", "reduce m.gark.yaml -o m.gark.yaml"),
    *("convert m.gark.yaml --to gark -o m.gark.yaml", "claims m.gark.yaml -o m.gark.yaml"),
    *("claims m.gark.yaml --write -o m.gark.yaml", "diff m.gark.yaml n.gark.yaml -o n.gark.yaml"),
    *("stability m.gark.yaml -o m.gark.yaml", "modified m.gark.yaml -o m.gark.yaml"),
    *("converge m.gark.yaml -o m.gark.yaml", "energy m.gark.yaml -o m.gark.yaml"),
    *("converge m.gark.yaml --problem problem.yaml -o problem.yaml",),
    *("show ./m.gark.yaml -o m.gark.yaml", "cite m.gark.yaml -o m.gark.yaml"),
    *(
        "report . -o n.gark.yaml",
        "plot m.gark.yaml -o m.gark.yaml",
        "certificate m.gark.yaml -o m.gark.yaml",
    ),
    *("design family.yaml --order 2 -o family.yaml",),
    *("design family.yaml --order 2 --emit family.yaml",),
    *("sweep spec.yaml --rows rows.jsonl -o spec.yaml",),
    *("sweep spec.yaml --rows rows.jsonl -o m.gark.yaml", "lsp --once m.gark.yaml -o m.gark.yaml"),
    *("export m.gark.yaml --to json -o m.gark.yaml", "audit source.csv -o source.csv"),
    *("list methods --catalogue . -o m.gark.yaml", "show n --catalogue . -o n.gark.yaml"),
    "check m.gark.yaml --baseline source.csv -o source.csv",
)
WRITES_NO_INPUT = {
    *("trees", "list", "explain", "schema"),  # they read none; list reads catalogues
    "new",  # refuses what is there
    "import",  # writes method files, which no format of it is
}


@pytest.mark.parametrize("command", OVER_INPUTS)
def test_no_input_is_written_over(command: str, folder: Path) -> None:
    """Neither the file of the argument, nor one in a folder, of a pattern, of a spec, of a
    catalogue; nor by a link whose ending says nothing of what it holds.
    """
    *words, target = command.split()
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert gark(*words, target, cwd=folder).code == 2
    (folder / "out").symlink_to(target)
    run = gark(*words, "out", cwd=folder)
    if "--baseline" not in command:  # which is none, and refused as such
        refused(run, "cannot write", "the command reads it")
    assert run.code == 2
    (folder / "out").unlink()
    after = {path.name: path.read_bytes() for path in folder.iterdir()}
    after.pop("rows.jsonl", None)
    assert after == before


def test_every_command_that_reads_is_among_them() -> None:
    """A command that is added has a line above."""
    assert {x.split()[0] for x in OVER_INPUTS} | WRITES_NO_INPUT == NAMES | {"list"}


@pytest.mark.parametrize("place", ["./m.gark.yaml", "link.yaml", "hard.yaml", "absolute"])
def test_an_input_by_another_name(place: str, folder: Path) -> None:
    """Links and other paths to the file that is read."""
    (folder / "link.yaml").symlink_to("m.gark.yaml")
    os.link(folder / "m.gark.yaml", folder / "hard.yaml")
    place = str(folder / "m.gark.yaml") if place == "absolute" else place
    for one, other in (("m.gark.yaml", place), (place, "m.gark.yaml")):
        refused(gark("tableau", one, "-o", other, cwd=folder), "the command reads it")
    assert (folder / "m.gark.yaml").read_text() == METHOD


def test_standard_input_that_is_a_file(folder: Path) -> None:
    """``gark tableau - -o m.yaml < m.yaml``."""
    with (folder / "m.gark.yaml").open() as stream:
        done = subprocess.run(
            [sys.executable, "-m", "garkcli", "tableau", "-", "-o", "m.gark.yaml"],
            cwd=folder,
            env={**os.environ, "PYTHONPATH": str(ROOT)},
            stdin=stream,
            capture_output=True,
            text=True,
            timeout=60,
        )
    assert done.returncode == 2
    assert "the command reads it" in done.stderr
    assert (folder / "m.gark.yaml").read_text() == METHOD


def test_the_settings_of_a_project_are_an_input(folder: Path) -> None:
    """``gark check -o .gark.toml`` in a project whose settings are read from there."""
    (folder / ".gark.toml").write_text("require-claims = false\n", encoding="utf-8")
    for command in ("check m.gark.yaml -o .gark.toml", "check . -o ./.gark.toml"):
        refused(gark(*command.split(), cwd=folder), "cannot write", "the command reads it")
    assert (folder / ".gark.toml").read_text() == "require-claims = false\n"


@pytest.mark.parametrize(
    "command",
    ["sweep spec.yaml --rows new -o new", "design family.yaml --order 2 --emit new -o ./new"],
)
def test_what_was_just_written_is_not_written_over(command: str, folder: Path) -> None:
    """The rows of a sweep and its report, the report of a design and its method: one of them."""
    refused(gark(*command.split(), cwd=folder), "cannot write", "has just written it")
    assert (folder / "new").read_text()


def test_what_is_meant_to_be_written(folder: Path) -> None:
    """Claims go into the file; a report goes where another one was; a file is forgotten when the
    command is over.
    """
    assert gark("claims", "m.gark.yaml", "--write", cwd=folder).code == 0
    assert "expect" in (folder / "m.gark.yaml").read_text()
    for _ in range(2):
        assert gark("check", "m.gark.yaml", "-o", "report.txt", cwd=folder).code == 0
    assert gark("tableau", "m.gark.yaml", "-o", "n.gark.yaml", cwd=folder).code == 0


# -- nothing leads out of a project
# ---------------------------------------------------------------------------


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """A repository with links to a file with a secret beside it."""
    (tmp_path / "secrets").mkdir()
    (tmp_path / "secrets" / "environ").write_text(f"TOKEN={SECRET}\0HOME=/root\0")
    (tmp_path / "secrets" / "hosts.yml").write_text(f"token: {SECRET}\nuser: [x\n")
    (tmp_path / "secrets" / "keys.py").write_text(f"key = {SECRET!r}\n")
    root = tmp_path / "repository"
    methods = root / "methods"
    methods.mkdir(parents=True)
    (root / ".git").mkdir()
    (methods / "m.gark.yaml").write_text(METHOD)
    (root / "shared.gark.yaml").write_text(METHOD)
    (methods / "inside.gark.yaml").symlink_to("../shared.gark.yaml")
    (methods / "environ.gark.yaml").symlink_to("../../secrets/environ")
    (methods / "hosts.gark.yaml").symlink_to("../../secrets/hosts.yml")
    (methods / "keys.py").symlink_to("../../secrets/keys.py")
    (methods / "folder").symlink_to("../../secrets")
    return root


@pytest.mark.parametrize(
    "path",
    [
        *("/proc/self/environ", "../secrets/hosts.yml", "methods/environ.gark.yaml"),
        *("methods/folder", "methods/folder/*.yml", "../secrets/*", "methods/../../secrets"),
    ],
)
@pytest.mark.parametrize("format", ["text", "json", "sarif", "github"])
def test_paths_of_a_project_stay_in_it(path: str, format: str, checkout: Path) -> None:
    """Whoever writes .gark.toml reads no file of the machine that checks it."""
    (checkout / ".gark.toml").write_text(f'paths = ["{path}"]\n')
    run = gark("check", "--format", format, cwd=checkout)
    refused(run, f".gark.toml:1:1: error[elsewhere]: paths: {path} leads out of the project")
    assert SECRET not in run.out + run.err


@pytest.mark.parametrize("path", ["methods", ".", "methods/*.yaml", "**/*.yaml"])
@pytest.mark.parametrize("is_project", [True, False])
def test_links_out_of_a_folder_are_named(path: str, is_project: bool, checkout: Path) -> None:
    """They are left out, and the others are checked: a link inside of the repository too."""
    arguments = [] if is_project else [path]
    if is_project:
        (checkout / ".gark.toml").write_text(f'paths = ["{path}"]\n')
    run = gark("check", *arguments, cwd=checkout)
    assert run.code == 0
    assert SECRET not in run.out + run.err
    for name in ("environ", "hosts"):
        assert f"{name}.gark.yaml is left out: it is a link out of" in run.err
    assert "methods/inside.gark.yaml" in run.out.replace("\\", "/")


def test_a_pattern_goes_through_no_link_to_a_folder(checkout: Path) -> None:
    """A folder of a pattern that is a link is left out, and no name of its files is shown."""
    (checkout / ".gark.toml").write_text('paths = ["*/folder/*.yml"]\n')
    run = gark("check", cwd=checkout)
    refused(run, "folder is left out: it is a link out of .")
    assert SECRET not in run.out + run.err


@pytest.mark.parametrize(
    "command",
    [
        "check methods/environ.gark.yaml",
        "check methods/hosts.gark.yaml",
        "check methods/folder/hosts.yml",
        "check ../secrets/environ",
        "tableau methods/hosts.gark.yaml",
        "converge midpoint --problem methods/hosts.gark.yaml",
        "sweep methods/hosts.gark.yaml",
        "show hosts --catalogue methods",
        "report methods",
        "audit methods",
        "import methods",
    ],
)
def test_no_error_quotes_a_file_elsewhere(command: str, checkout: Path) -> None:
    """A link to a file that has no key of a method file is not read on, whatever it is called."""
    run = gark(*command.split(), cwd=checkout)
    assert SECRET not in run.out + run.err
    assert run.code == (0 if command == "report methods" else 2)


def test_files_without_an_ending(folder: Path) -> None:
    """They are read where they have a key of a method file, as YAML, in braces or as JSON."""
    texts = (
        METHOD,
        f"# a comment\n{METHOD}",
        "{A: [[0]], b: [1]}",
        '{\n  "A": [[0]],\n "b": [1]\n}',
    )
    for text in texts:
        (folder / "method").write_text(text)
        assert gark("check", "./method", cwd=folder).code == 0
    (folder / "method").write_text(f"token: {SECRET}\n")
    run = gark("check", "./method", cwd=folder)
    refused(run, "no key of a method file is in this file, and its name has no ending")
    assert SECRET not in run.out + run.err
