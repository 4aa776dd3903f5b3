"""``gark check --baseline`` and ``-j``: what is worse than before, and many files at a time."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from garkcli.check.baseline import MAX_BYTES
from tests.cli.harness import ROOT, Run, gark
from tests.had import needs_fork
from tests.whole import in_whole

SLOW = "radicals-of-large-degree"
"""An unreadable example that takes seconds to be refused."""
UNREADABLE = sorted((ROOT / "tests/examples/invalid").glob("*.gark.yaml"))
QUICK = tuple(str(path.relative_to(ROOT)) for path in UNREADABLE[::4] if SLOW not in path.name)
"""Enough of them for two workers to be ahead of each other."""
GAUSS = "methods: [{family: gauss, stages: 2}]\n"
HOLDS = f"{GAUSS}expect: {{order: 4, symplectic: true}}\n"
FAILS = f"{GAUSS}expect: {{order: 5}}\n"
LOWER = "methods: [{A: [[1/3]], b: [1]}]\n"
BROKEN = "methods: [{family: gaus}]\n"
NO_BASELINES = {
    "missing": None,
    "not JSON": "order: 4",
    "empty": "",
    "no object": "[1, 2]",
    "another report": '{"schema": "gark/trees/1", "files": []}',
    "no files": '{"schema": "gark/check/1"}',
    "files of another type": '{"schema": "gark/check/1", "files": {"m": 1}}',
    "too deep": "[" * 100_000,
}


class Project:
    """A directory of method files with the report of an earlier day."""

    def __init__(self, folder: Path, **files: str) -> None:
        self.folder = folder
        self.write(**files)
        assert gark("check", ".", "--format", "json", "-o", "base.json", cwd=folder).code in {
            0,
            1,
            2,
        }

    def write(self, **files: str) -> None:
        """Write files; ``m`` is ``m.gark.yaml``."""
        for name, text in files.items():
            (self.folder / f"{name}.gark.yaml").write_text(text, encoding="utf-8")

    def compare(self, **files: str) -> Run:
        """What ``--baseline`` says once these files are written."""
        self.write(**files)
        return gark("check", ".", "--baseline", "base.json", cwd=self.folder)


def test_the_same_files_are_not_worse(tmp_path: Path) -> None:
    """Files that hold, fail and cannot be read are no worse than themselves: exit code 0."""
    run = Project(tmp_path, a=HOLDS, b=FAILS, c=BROKEN).compare()
    assert (run.code, run.out, run.err) == (0, "3 files: nothing got worse\n", "")


def test_a_claim_that_held_fails(tmp_path: Path) -> None:
    """A claim that held and holds no more is worse, and is named with its file: exit code 1."""
    run = Project(tmp_path, m=HOLDS).compare(m=HOLDS.replace("true", "false"))
    assert run.code == 1
    assert "m.gark.yaml: symplectic got worse: held -> found true\n" in run.out
    assert "1 file: 1 got worse\n" in run.out


def test_a_claim_that_is_new_has_to_hold(tmp_path: Path) -> None:
    """A claim that nobody made before is worse where it fails, and no matter where it holds."""
    project = Project(tmp_path, m=GAUSS)
    assert project.compare(m=HOLDS).code == 0
    run = project.compare(m=FAILS)
    assert (run.code, run.out.count("got worse:")) == (1, 1)
    assert "order got worse: not claimed -> found 4" in run.out


def test_an_order_that_is_lower(tmp_path: Path) -> None:
    """Without any claims a lower order is worse, each of the three on a line; a higher one is
    not.
    """
    run = Project(tmp_path, m=GAUSS).compare(m=LOWER)
    assert run.code == 1
    assert [line.partition(": ")[2] for line in run.out.splitlines()[:3]] == [
        "order got worse: 4 -> 1",
        "conjugate order got worse: 4 -> 1",
        "pair order got worse: 4 -> 1",
    ]
    (tmp_path / "up").mkdir()
    assert Project(tmp_path / "up", m=LOWER).compare(m=GAUSS).code == 0


def test_an_order_that_is_gone(tmp_path: Path) -> None:
    """A conjugate that exists no more, for a weight that is zero, is worse than any order of it."""
    run = Project(tmp_path, m="methods: [{A: [[1/2]], b: [1]}]\n").compare(
        m="methods: [{family: explicit-midpoint}]\n"
    )
    assert run.code == 1
    assert "conjugate order got worse: 2 -> None" in run.out
    assert " order got worse: 2 -> 2" not in run.out


def test_a_new_file_has_to_be_right(tmp_path: Path) -> None:
    """A file that the baseline does not know fails where a claim fails or it cannot be read, not
    where it holds.
    """
    project = Project(tmp_path, m=HOLDS)
    assert project.compare(n=HOLDS).code == 0
    failing = project.compare(n=FAILS)
    assert (failing.code, failing.out.splitlines()[0]) == (
        1,
        "n.gark.yaml: order got worse: new, expected 5 -> 4",
    )
    assert project.compare(n=BROKEN).code == 1


def test_what_failed_may_go_on_failing(tmp_path: Path) -> None:
    """A claim that failed before may fail again, with another number and after a move down the
    file.
    """
    project = Project(tmp_path, m=FAILS)
    assert project.compare(m=FAILS).code == 0
    assert project.compare(m="# later\n\n" + FAILS.replace("5", "6")).code == 0


def test_what_was_unreadable_may_stay_so(tmp_path: Path) -> None:
    """An unreadable file stays unreadable without complaint; one that becomes readable is no
    worse.
    """
    project = Project(tmp_path, m=BROKEN)
    assert project.compare(m="methods: 1").code == 0
    assert project.compare(m=HOLDS).code == 0


def test_a_file_that_cannot_be_read_any_more(tmp_path: Path) -> None:
    """A method that becomes unreadable is worse: exit code 1, one line for the file."""
    run = Project(tmp_path, m=HOLDS, n=FAILS).compare(m=BROKEN, n=BROKEN)
    assert run.code == 1
    assert run.out.count("file got worse: a method -> unreadable\n") == 2


@pytest.mark.parametrize("what", NO_BASELINES)
def test_a_baseline_that_is_none(what: str, tmp_path: Path) -> None:
    """What is no report of ``gark check`` is a usage error with a cure: exit code 2, nothing on
    stdout.
    """
    Project(tmp_path, m=HOLDS)
    text = NO_BASELINES[what]
    if text is not None:
        (tmp_path / "wrong.json").write_text(text)
    run = gark("check", ".", "--baseline", "wrong.json", cwd=tmp_path)
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith("gark: --baseline wrong.json: ")
    assert "help: make one with gark check --format json -o FILE" in run.err


def test_a_baseline_that_is_a_method_file(tmp_path: Path) -> None:
    """A method file given by mistake is refused, and so is a file of bytes."""
    Project(tmp_path, m=HOLDS)
    (tmp_path / "bytes.json").write_bytes(b"\xff\xfe\0")
    for name in ("m.gark.yaml", "bytes.json"):
        assert gark("check", ".", "--baseline", name, cwd=tmp_path).code == 2


# -- many at a time
# -----------------------------------------------------------------------------------------------


def process(*arguments: str, stdin: str = "") -> subprocess.CompletedProcess[str]:
    """``gark check`` as a process, as workers are forked from it.

    It writes UTF-8, whatever the locale, as runs in this process do.
    """
    command = [sys.executable, "-m", "garkcli", "check", *arguments]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "80"}
    environment["PYTHONIOENCODING"] = "utf-8"
    environment.pop("GITHUB_ACTIONS", None)
    return subprocess.run(
        command,
        cwd=ROOT,
        env=environment,
        input=stdin,
        capture_output=True,
        encoding="utf-8",
        timeout=60,
    )


@cache
def one_by_one() -> Run:
    """``gark check methods`` without a second process."""
    return gark("check", "methods", "-j", "1")


@pytest.mark.parametrize(
    ("options", "paths"),
    [
        pytest.param(
            ("--format", "json"), ("tests/examples/failing", *QUICK, "nowhere"), marks=in_whole
        ),
        (
            ("--format", "text", "-v", "--error-constants"),
            ("tests/examples/failing", "tests/examples/invalid/octal.gark.yaml"),
        ),
        (("--format", "sarif"), ("tests/examples/failing", "tests/report")),
    ],
)
def test_two_at_a_time_say_the_same(options: tuple[str, ...], paths: tuple[str, ...]) -> None:
    """Methods, failing and unreadable files give the same report, in the same order, one by one and
    by twos.
    """
    one = gark("check", *options, *paths)
    two = process(*options, "-j", "2", *paths)
    assert one.out == two.stdout != ""
    assert one.err == two.stderr == ""
    assert one.code == two.returncode == 2


def test_rounded_methods_two_at_a_time_say_the_same() -> None:
    """Also what a report asks of the method that the digits mean, which another process found."""
    paths = [
        f"garkcli/catalogue/data/{x}.gark.yaml" for x in ("dirk/kvaerno-3", "rosenbrock/ros34pw2")
    ]
    options = ("-v", "--properties")
    one = gark("check", *options, *paths)
    two = process(*options, "-j", "2", *paths)
    assert (one.out, one.err) == (two.stdout, two.stderr)
    assert one.code == two.returncode == 0
    assert "within" in one.out


@in_whole
def test_standard_input_among_many() -> None:
    """``-`` is read once, in its place among the files, with ``-j`` as without."""
    paths = ("methods/collocation.gark.yaml", "-", "tests/examples/failing")
    options = ("--format", "json")
    one = gark("check", *paths, *options, stdin=HOLDS)
    two = process(*paths, *options, "-j", "2", stdin=HOLDS)
    assert one.out == two.stdout
    files = [(x["file"], x["ok"]) for x in json.loads(two.stdout)["files"]]
    assert files[0] == (paths[0], True)
    assert files[1] == ("<stdin>", True)
    assert two.returncode == 1


@in_whole
def test_as_many_as_there_are_processors() -> None:
    """``-j 0`` gives the report of ``-j 1``; fewer than none are a usage error."""
    alone, many = one_by_one(), process("methods", "-j", "0")
    assert (alone.code, alone.out) == (many.returncode, many.stdout)
    assert alone.code == 0
    assert gark("check", "methods", "-j", "-1").code == 2


@pytest.mark.parametrize(
    "files",
    [
        "[5]",
        '[{"file": 5, "claims": []}]',
        '[{"file": "a"}]',
        '[{"file": "a", "claims": 5}]',
        '[{"file": "a", "claims": [{"claim": [], "holds": true}]}]',
        '[{"file": "a", "claims": [{"claim": "order", "holds": "yes"}]}]',
        '[{"file": "a", "order": "4", "claims": []}]',
        '[{"file": "a", "order": true, "claims": []}]',
        '[{"file": "a", "pair_order": NaN, "claims": []}]',
    ],
)
def test_a_damaged_baseline_is_refused(files: str, tmp_path: Path) -> None:
    """A report whose fields are not what they were is no baseline, and no fault of the program."""
    (tmp_path / "a.gark.yaml").write_text("methods: [{family: gauss, stages: 1}]\n")
    base = tmp_path / "base.json"
    base.write_text(f'{{"schema": "gark/check/1", "files": {files}}}')
    run = gark("check", "a.gark.yaml", "--baseline", "base.json", cwd=tmp_path)
    assert run.code == 2
    assert "--baseline base.json: a damaged report of gark check" in run.err


def test_a_baseline_is_a_file_of_bounded_size(tmp_path: Path) -> None:
    """Devices, pipes, directories and huge files are refused before a byte of them is read."""
    (tmp_path / "a.gark.yaml").write_text("methods: [{family: gauss, stages: 1}]\n")
    names = ["."]
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "pipe")
        names += ["pipe", "/dev/zero"]
    for name in names:
        run = gark("check", "a.gark.yaml", "--baseline", name, cwd=tmp_path)
        assert (run.code, "not a regular file" in run.err) == (2, True)
    with (tmp_path / "huge.json").open("wb") as stream:
        stream.truncate(MAX_BYTES + 1)
    run = gark("check", "a.gark.yaml", "--baseline", "huge.json", cwd=tmp_path)
    assert (run.code, f"more than {MAX_BYTES} bytes" in run.err) == (2, True)


# -- what becomes of workers


ENDING = """\
import os, signal, sys
import garkcli.cli.checking as checking
from garkcli.cli import main
check = checking.check_file
def check_file(path, **options):
    if "deadly" in path:
        {how}
    return check(path, **options)
checking.check_file = check_file
main(["check", "-j", "2", *sys.argv[1:]])
"""
"""``gark check -j 2`` in which a file with a deadly name ends what checks it."""


@needs_fork
@pytest.mark.parametrize(
    ("how", "says"),
    [
        ("os.kill(os.getpid(), signal.SIGKILL)", "its check was ended by SIGKILL"),
        ("os._exit(7)", "its check was ended with exit code 7"),
        ("raise MemoryError('no room')", "internal fault: MemoryError: no room"),
    ],
)
def test_a_worker_that_dies_is_told_and_stops_nothing(how: str, says: str, tmp_path: Path) -> None:
    """The file is named, all others have their outcome, and the exit code is 3."""
    names = [f"{i:02}{'-deadly' * (i % 5 == 3)}.gark.yaml" for i in range(20)]
    for name in names:
        (tmp_path / name).write_text(HOLDS)
    done = subprocess.run(
        [sys.executable, "-c", ENDING.format(how=how), ".", "--format", "json"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        text=True,
        timeout=100,
    )
    assert done.returncode == 3, done.stderr
    files = json.loads(done.stdout)["files"]
    assert [x["file"] for x in files] == names
    for found in files:
        assert found["ok"] is ("deadly" not in found["file"])
        if not found["ok"]:
            assert says in found["errors"][0]["message"]


def test_a_fault_in_one_file_stops_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """One at a time too, a fault of ours is told with its file, and the others are checked."""
    from garkcli.cli import checking

    check = checking.check_file

    def check_file(path: str, **options: object) -> object:
        if path == "b.gark.yaml":
            raise RuntimeError("broken")
        return check(path, **options)  # type: ignore[arg-type]

    monkeypatch.setattr(checking, "check_file", check_file)
    for name in "abc":
        (tmp_path / f"{name}.gark.yaml").write_text(FAILS)
    run = gark("check", ".", cwd=tmp_path)
    assert run.code == 3
    assert "b.gark.yaml: error[internal-fault]: internal fault: RuntimeError: broken" in run.out
    assert run.out.count("found 4") == 2


@in_whole
def test_more_workers_than_a_system_waits_for() -> None:
    """``-j 256`` takes as many workers as Windows can wait for, and no more than there are files."""
    from garkcli.crew.processes import MOST_WORKERS

    assert MOST_WORKERS <= 61
    alone, many = one_by_one(), process("methods", "-j", "256")
    assert (alone.code, alone.out) == (many.returncode, many.stdout)


# -- paths that cannot be looked at


def test_a_bad_path_stops_nothing(tmp_path: Path) -> None:
    """A name that is too long, a link to itself, a link to nothing, a path through a file: each is
    told, the others are checked, and the exit code is 2.
    """
    (tmp_path / "good.gark.yaml").write_text(HOLDS)
    (tmp_path / "loop.gark.yaml").symlink_to("loop.gark.yaml")
    (tmp_path / "nothing.gark.yaml").symlink_to("nowhere")
    long = "n" * 300
    through = "good.gark.yaml/x"
    run = gark("check", long, ".", through, cwd=tmp_path)
    assert run.code == 2
    assert f"{long}: error[cannot-read]: cannot be read: File name too long" in run.out
    assert (
        "loop.gark.yaml: error[cannot-read]: cannot be read: Too many levels of symbolic links"
        in run.out
    )
    assert "nothing.gark.yaml: error[no-such-file]: no such file" in run.out
    assert f"{through}: error[cannot-read]: cannot be read: Not a directory" in run.out
    assert "ok   good.gark.yaml: order 4" in run.out


def test_a_folder_that_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is told, on its own and below another, and what is beside it is checked."""
    (tmp_path / "sub" / "closed").mkdir(parents=True)
    (tmp_path / "sub" / "m.gark.yaml").write_text(HOLDS)
    scandir = os.scandir

    def guarded(path: str) -> object:
        if str(path).endswith("closed"):
            raise PermissionError(13, "Permission denied", str(path))
        return scandir(path)

    monkeypatch.setattr(os, "scandir", guarded)
    for path in ("sub", os.path.join("sub", "closed")):
        run = gark("check", path, cwd=tmp_path)
        assert run.code == 2
        closed = os.path.join("sub", "closed")
        assert (
            f"{closed}: error[cannot-read]: this folder cannot be read: Permission denied"
            in run.out
        )
        assert ("order 4" in run.out) is (path == "sub")


@in_whole
def test_links_that_lead_back_are_not_followed(tmp_path: Path) -> None:
    """A folder with links to itself is read once, as a folder and by a pattern; names with a dot in
    front have to be asked for; a folder with the name of a method file is a folder.
    """
    for name in ("a", "b", ".hidden", "c.gark.yaml"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "m.gark.yaml").write_text(HOLDS)
        (tmp_path / name / "up").symlink_to("..")
        (tmp_path / name / "here").symlink_to(".")

    def files(*arguments: str) -> list[str]:
        report = json.loads(gark("check", *arguments, "--format", "json", cwd=tmp_path).out)
        return [x["file"].replace(os.sep, "/") for x in report["files"]]

    named = ["a/m.gark.yaml", "b/m.gark.yaml", "c.gark.yaml/m.gark.yaml"]
    assert files(".") == [".hidden/m.gark.yaml", *named]
    assert files("**/*.yaml") == named
    assert files("[ab]") == named[:2]
    assert files("?/*.gark.yaml") == named[:2]
    assert files("[b]/m*") == named[1:2]
    assert files("nothing/*.yaml") == ["nothing/*.yaml"]
    assert files(f"{tmp_path}/*/m.gark.yaml")[0] == f"{tmp_path}/a/m.gark.yaml"


@in_whole
def test_an_undecided_claim_in_a_baseline(tmp_path: Path) -> None:
    """A report with a claim that is undecided is a baseline: the same file is no worse."""
    (tmp_path / "open.gark.yaml").write_text(
        "A: [[0.167, 3.333], [-1.333, 0.333]]\nb: [0.333, 0.667]\ntolerance: 1e-3\n"
        "expect: {p-stable: true, order: 2}\n",
        encoding="utf-8",
    )
    first = gark("check", "open.gark.yaml", "--format", "json", "-o", "o.json", cwd=tmp_path)
    assert first.code == 3
    again = gark("check", "open.gark.yaml", "--baseline", "o.json", cwd=tmp_path)
    assert (again.code, "damaged" in again.err) == (0, False)
    (tmp_path / "open.gark.yaml").write_text(
        "A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\nexpect: {p-stable: true, order: 2}\n", encoding="utf-8"
    )
    assert gark("check", "open.gark.yaml", "--baseline", "o.json", cwd=tmp_path).code == 1
