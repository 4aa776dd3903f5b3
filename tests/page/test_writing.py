"""Files appear whole or not at all, and what was there keeps its kind, links and permissions."""

from __future__ import annotations

import os
import stat
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from garkcli.cli.designing import file_names, make_folder
from garkcli.errors import UsageProblem
from garkcli.page.writing import refuse_unwritable, write_whole
from tests.cli.harness import ROOT, gark
from tests.had import needs_fifos
from tests.whole import in_whole

posix = pytest.mark.skipif(os.name != "posix", reason="links and permissions of POSIX")


def mode(path: Path) -> int:
    """The permissions of a file."""
    return stat.S_IMODE(path.stat().st_mode)


def test_a_new_file(tmp_path: Path) -> None:
    """Text is UTF-8, bytes are as they are, nothing else is left in the folder."""
    write_whole(str(tmp_path / "f"), ["γ\n", b"\xff"])
    assert (tmp_path / "f").read_bytes() == "γ\n".encode() + b"\xff"
    assert [path.name for path in tmp_path.iterdir()] == ["f"]


@posix
@pytest.mark.parametrize("umask", [0o022, 0o077])
def test_permissions(umask: int, tmp_path: Path) -> None:
    """A new file has those that the user gives to files, an old one keeps its own."""
    before = os.umask(umask)
    try:
        write_whole(str(tmp_path / "new"), ["1"])
    finally:
        os.umask(before)
    assert mode(tmp_path / "new") == 0o666 & ~umask
    for kept in (0o600, 0o640, 0o755):
        (tmp_path / "old").write_text("old")
        (tmp_path / "old").chmod(kept)
        write_whole(str(tmp_path / "old"), ["new"])
        assert (mode(tmp_path / "old"), (tmp_path / "old").read_text()) == (kept, "new")


@posix
def test_links_stay_links(tmp_path: Path) -> None:
    """What a link leads to is written, through links of links, relative and absolute, also where
    nothing is there yet.
    """
    (tmp_path / "sub").mkdir()
    (tmp_path / "sub" / "file").write_text("old")
    (tmp_path / "one").symlink_to(Path("sub") / "file")
    (tmp_path / "two").symlink_to(tmp_path / "one")
    write_whole(str(tmp_path / "two"), ["new"])
    assert (tmp_path / "two").is_symlink()
    assert (tmp_path / "one").is_symlink()
    assert (tmp_path / "sub" / "file").read_text() == "new"
    (tmp_path / "ahead").symlink_to("not-yet")
    write_whole(str(tmp_path / "ahead"), ["first"])
    assert (tmp_path / "ahead").is_symlink()
    assert (tmp_path / "not-yet").read_text() == "first"


@posix
def test_a_file_of_two_names_keeps_both(tmp_path: Path) -> None:
    """Hard links still share what was written."""
    (tmp_path / "one").write_text("old and longer")
    (tmp_path / "two").hardlink_to(tmp_path / "one")
    write_whole(str(tmp_path / "one"), ["new"])
    assert (tmp_path / "two").read_text() == "new"
    assert (tmp_path / "one").samefile(tmp_path / "two")


needs_root = pytest.mark.skipif(
    not hasattr(os, "geteuid") or os.geteuid() != 0, reason="only root gives files away"
)


@needs_root
@pytest.mark.parametrize(("owner", "group"), [(12345, 12346), (12345, 0), (0, 12346)])
@pytest.mark.parametrize("place", ["file", "link", "name"])
def test_owner_and_group_stay(owner: int, group: int, place: str, tmp_path: Path) -> None:
    """A file of somebody else, or of another group, is still theirs, by whatever name it is
    written, in a folder with a sticky bit too; nothing else is left there.
    """
    tmp_path.chmod(0o1777)
    file = tmp_path / "file"
    file.write_text("old and longer")
    file.chmod(0o640)
    os.chown(file, owner, group)
    (tmp_path / "link").symlink_to("file")
    (tmp_path / "name").hardlink_to(file)
    if place != "name":
        (tmp_path / "name").unlink()
    names = {x.name for x in tmp_path.iterdir()}
    write_whole(str(tmp_path / place), ["new"])
    status = file.stat()
    assert (status.st_uid, status.st_gid, mode(file)) == (owner, group, 0o640)
    assert file.read_text() == "new"
    assert {x.name for x in tmp_path.iterdir()} == names


@needs_root
def test_a_folder_gives_its_group(tmp_path: Path) -> None:
    """In a folder whose files have its group, a file with that group or another keeps it."""
    os.chown(tmp_path, 0, 12346)
    tmp_path.chmod(0o2775)
    for group in (12346, 12347, 0):
        (tmp_path / "file").write_text("old")
        os.chown(tmp_path / "file", 0, group)
        write_whole(str(tmp_path / "file"), ["new"])
        assert ((tmp_path / "file").stat().st_gid, (tmp_path / "file").read_text()) == (
            group,
            "new",
        )


@needs_fifos
def test_a_pipe_is_written_through(tmp_path: Path) -> None:
    """A FIFO gets the report and stays one."""
    fifo = tmp_path / "pipe"
    os.mkfifo(fifo)
    read: list[str] = []
    reader = threading.Thread(target=lambda: read.append(fifo.read_text()))
    reader.start()
    write_whole(str(fifo), ["a", "b"])
    reader.join(timeout=60)
    assert read == ["ab"]
    assert stat.S_ISFIFO(fifo.stat().st_mode)


@in_whole
@posix
@pytest.mark.parametrize(
    ("name", "redirection"),
    [
        ("/dev/stdout", ">"),
        ("/dev/fd/1", ">"),
        ("/proc/self/fd/1", ">"),
        ("link", ">"),
        ("/dev/stdout", ">>"),
        ("link", ">>"),
        ("/dev/fd/1", "| cat >"),
        ("link", "| cat >"),
    ],
)
def test_the_devices_of_streams(name: str, redirection: str, tmp_path: Path) -> None:
    """``-o /dev/stdout`` is standard output, whatever that is, at the place where it is; neither
    the device nor a link to it is replaced.
    """
    if name.startswith("/proc") and not Path("/proc/self/fd").exists():
        pytest.skip("this system has no /proc")
    (tmp_path / "link").symlink_to("/dev/stdout")
    target = tmp_path / "target"
    target.write_text("before\n")
    command = f'{sys.executable} -m garkcli list -o "{name}" {redirection} target'
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        timeout=60,
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")
    before = "before\n" if redirection == ">>" else ""
    assert target.read_text("utf-8") == before + gark("list").out
    assert Path("/dev/stdout").is_symlink()
    assert (tmp_path / "link").is_symlink()


@posix
def test_a_device_stays_a_device() -> None:
    """``-o /dev/null`` throws away; the device is still there."""
    assert gark("list", "-o", "/dev/null").code == 0
    assert stat.S_ISCHR(Path("/dev/null").stat().st_mode)


def test_what_fails_leaves_the_old_file(tmp_path: Path) -> None:
    """Pieces that end in an error change nothing and leave nothing."""
    (tmp_path / "f").write_text("old")

    def pieces() -> Iterator[str]:
        yield "new"
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_whole(str(tmp_path / "f"), pieces())
    assert (tmp_path / "f").read_text() == "old"
    assert [path.name for path in tmp_path.iterdir()] == ["f"]


@posix
@pytest.mark.parametrize(
    ("place", "why"),
    [
        ("nowhere/f", "there is no such folder"),
        (".", "it is a folder"),
        ("loop", "too many links"),
        ("n" * 300, "File name too long"),
        ("file/f", "Not a directory"),
    ],
)
def test_no_place_is_said_before_the_work(place: str, why: str, tmp_path: Path) -> None:
    """Where nothing can be written a command says so before it reads its files."""
    (tmp_path / "loop").symlink_to("loop")
    (tmp_path / "file").write_text("")
    with pytest.raises(UsageProblem, match=why):
        refuse_unwritable(str(tmp_path / place))
    with pytest.raises(UsageProblem, match="cannot write"):
        write_whole(str(tmp_path / place), ["x"])
    for command in ("check", "tableau", "conjugate", "converge", "energy"):
        run = gark(command, "no such file", "-o", str(tmp_path / place))
        assert run.code == 2
        assert run.err.startswith("gark: cannot write ")
        assert why in run.err


def test_a_stream_of_a_number_that_no_system_has() -> None:
    """It is a place that cannot be written to, and no fault of the program."""
    with pytest.raises(UsageProblem, match="cannot write"):
        write_whole("/dev/fd/99999999999", ["a"])


def test_an_empty_name_is_told_as_such() -> None:
    """It is no folder."""
    with pytest.raises(UsageProblem, match="is empty"):
        refuse_unwritable("")
    with pytest.raises(UsageProblem, match="is empty"):
        make_folder("")


@pytest.mark.parametrize(
    ("source", "name"),
    [
        ("-", "method-1.gark.yaml"),
        ("<stdin>", "method-1.gark.yaml"),
        ("asks/sdirk.gark.yaml", "sdirk-1.gark.yaml"),
    ],
)
def test_names_of_methods_found(source: str, name: str) -> None:
    """After the file of the family; standard input has no name."""
    assert Path(next(file_names("found", source))) == Path("found", name)
