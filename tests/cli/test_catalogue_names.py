"""Names of the catalogue on the command line: every command takes them, and says which is meant."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from garkcli.cli.arguments import MethodType
from garkcli.cli.command import command_of
from garkcli.cli.main import COMMANDS
from garkcli.families.registry import FAMILIES
from garkcli.methodfile.naming import look_up
from tests.cli.harness import Run, gark
from tests.cli.test_completion import completions

RK4 = "catalogue/data/erk/rk4.gark.yaml"
FAMILY = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]\n"
CALLS = [
    ("check", "RK4"),
    ("tableau", "Rk4"),
    ("conjugate", "RK4", "--format", "json"),
    ("conditions", "rk4", "--order", "2"),
    ("converge", "RK4", "--problem", "oscillator"),
    ("energy", "rk4", "--t-end", "1", "--step", "1/4"),
    ("stability", "RK4"),
    ("modified", "rK4", "--order", "5"),
    ("reduce", "RK4"),
    ("certificate", "RK4"),
    ("convert", "RK4", "--stages", "5"),
    ("diff", "RK4", "RK4"),
    ("export", "RK4", "--to", "json"),
    ("cite", "RK4"),
]


@pytest.mark.parametrize("call", CALLS, ids=" ".join)
def test_every_command_takes_a_name(call: tuple[str, ...]) -> None:
    """What it writes of ``RK4`` is what it writes of the file, but for what the method is called
    and where a long line goes on.
    """
    run = gark(*call)
    path = f"garkcli/{RK4}"
    by_file = gark(call[0], path, *call[2:])
    assert run.code == by_file.code == 0, run.err
    assert run.out.split() == by_file.out.replace(path, "rk4").split()
    assert run.err == by_file.err.replace(path, "rk4")


def test_design_takes_a_name(tmp_path: Path) -> None:
    """Of a family in a folder of one's own."""
    (tmp_path / "half.gark.yaml").write_text(FAMILY)
    run = gark("design", "Half", "--order", "2", "--catalogue", str(tmp_path))
    assert run.code == 0, run.err
    assert run.out.startswith("half: order 2 for 1 solution\n")


def test_a_sweep_takes_names(tmp_path: Path) -> None:
    """Under ``files`` of its spec, beside files; both at once is a fault there too."""
    spec = tmp_path / "spec.yaml"
    spec.write_text("files: [RK4, mine.yaml]\ncolumns: [order]\n")
    (tmp_path / "mine.yaml").write_text("A: [[0]]\nb: [1]\n")
    run = gark("sweep", "spec.yaml", "--format", "json", cwd=tmp_path)
    assert run.code == 0, run.err
    rows = (tmp_path / "spec.jsonl").read_text().splitlines()
    found = [json.loads(row) for row in rows]
    orders = {row["method"]: row["order"] for row in found}
    assert orders == {"rk4": 4, "mine.yaml": 1}
    (tmp_path / "RK4").write_text("A: [[0]]\nb: [1]\n")
    run = gark("sweep", "spec.yaml", "--rows", "other.jsonl", cwd=tmp_path)
    assert run.code == 2
    assert "there is a file of this name here" in run.err


def test_claims_takes_a_name_but_writes_into_files_alone(tmp_path: Path) -> None:
    """A method of the catalogue is not the user's to change, nor is a file made of its name."""
    assert "order: 4" in gark("claims", "RK4").out
    run = gark("claims", "RK4", "--write", cwd=tmp_path)
    assert run.code == 2
    assert "--write needs a file, and RK4 is a name" in run.err
    assert list(tmp_path.iterdir()) == []


def test_every_argument_that_is_a_file_is_of_this_type() -> None:
    """No command reads a method in a way of its own, which would know no names."""
    found = {}
    for name in COMMANDS:
        command = command_of(name)
        for option in command.params:
            if option.name in {"file", "files", "first", "second"}:
                found[name] = isinstance(option.type, MethodType)
    assert len(found) >= len(CALLS)
    exempt = {"import", "new"}  # sources of other programs; a file to be written
    assert {x for x, takes in found.items() if not takes} <= exempt


def test_a_file_and_a_name_at_once_is_bad_usage(tmp_path: Path) -> None:
    """Exit code 2, with a way to say either; every command."""
    (tmp_path / "rk4").write_text("A: [[0]]\nb: [1]\n")
    for command in ("check", "tableau", "stability"):
        run = gark(command, "rk4", cwd=tmp_path)
        assert run.code == 2
        told = run.out + run.err
        assert f".{os.sep}rk4 for the file" in told
        assert "catalogue:rk4 for the method" in told
    assert gark("check", "catalogue:rk4", cwd=tmp_path).code == 0


@pytest.mark.parametrize("name", [x for x, y in FAMILIES.items() if not y.stands_alone])
def test_a_family_is_no_method_yet(name: str) -> None:
    """Not even where a method of the catalogue has the same letters; the cure is a method."""
    run = gark("check", name)
    assert run.code == 2
    assert f"{name} is a family: its methods need " in run.out
    cure = run.out.partition("write for instance ")[2].partition(", or ")[0]
    assert gark("tableau", " ".join(cure.split())).code == 0
    assert ("or sdirk-2 for the method" in " ".join(run.out.split())) is (name == "sdirk2")


def shadowed(folder: Path, *arguments: str) -> Run:
    """A run with a folder that has a method called as one of the package."""
    (folder / "rk4.gark.yaml").write_text("A: [[1/2]]\nb: [1]\n")
    return gark("check", "rk4", "--catalogue", str(folder), *arguments, cwd=folder)


def test_a_name_that_hides_another_is_told(tmp_path: Path) -> None:
    """On stderr, so the report is as ever; not with ``-q``."""
    run = shadowed(tmp_path)
    assert run.code == 0
    assert ": order 2, proved; " in run.out
    place = tmp_path / "rk4.gark.yaml"
    note = f"note: rk4 is {place}, which hides that of the package"
    assert run.err == f"{note}\n"
    assert shadowed(tmp_path, "-q").err == ""


def test_folders_are_there_for_one_run(tmp_path: Path) -> None:
    """``--catalogue`` goes before GARK_PATH, and leaves nothing behind."""
    first, second = tmp_path / "a", tmp_path / "b"
    for folder, text in ((first, "A: [[1/2]]"), (second, "A: [[0]]")):
        folder.mkdir()
        (folder / "mine.gark.yaml").write_text(f"{text}\nb: [1]\n")
    before = os.environ.get("GARK_PATH")
    run = gark(*("check", "mine", "--catalogue", str(first)), GARK_PATH=str(second))
    assert ": order 2, proved; " in run.out
    run = gark("check", "mine", GARK_PATH=str(second))
    assert ": order 1, proved; " in run.out
    assert os.environ.get("GARK_PATH") == before
    assert gark("check", "mine").code == 2


def test_a_folder_that_is_none(tmp_path: Path) -> None:
    """It is named, as it may be misspelt; one that the variable could not hold as well."""
    run = gark("check", "rk4", "--catalogue", str(tmp_path / "none"))
    assert run.code == 2
    assert "is not a folder" in run.err
    odd = tmp_path / f"a{os.pathsep}b"
    if os.name == "posix":
        odd.mkdir()
        run = gark("check", "rk4", "--catalogue", str(odd))
        assert run.code == 2
        assert "which is between folders" in run.err


def test_side_by_side(tmp_path: Path) -> None:
    """Workers know the same names."""
    (tmp_path / "mine.gark.yaml").write_text("A: [[0]]\nb: [1]\n")
    run = gark(
        *("check", "mine", "rk4", "--jobs", "2", "--format", "json"),
        *("--catalogue", str(tmp_path)),
    )
    found = json.loads(run.out)["files"]
    assert [x["file"] for x in found] == ["mine", "rk4"]


def test_names_are_completed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With files and folders that begin so; aliases where no name does; then files alone."""
    (tmp_path / "own").mkdir()
    text = "aliases: [zanna-1, Zanna one]\nA: [[0]]\nb: [1]\n"
    (tmp_path / "own" / "mine.gark.yaml").write_text(text)
    (tmp_path / "colloquium").mkdir()
    (tmp_path / "collected.yaml").write_text("")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("GARK_PATH", "own")
    found = [value for _, value in completions("check", "coll")]
    assert found[:2] == ["collocation", "collocation-conjugate"]
    assert found[-2:] == ["collected.yaml", f"colloquium{os.sep}"]
    assert completions("tableau", "Stoermer_V") == [("plain", "stoermer-verlet")]
    assert completions("stability", "zan") == [("plain", "zanna-1")]
    assert completions("stability", "./coll") == [("file", "./coll")]
    assert completions("stability", "qqq") == [("file", "qqq")]


def test_a_star_tells_methods_apart() -> None:
    """Lobatto IIIC* of two stages is Heun's method, and no other spelling of Lobatto IIIC."""
    assert "fully implicit, 2 stages" in gark("check", "lobatto-iiic-2").out
    assert "explicit, 2 stages" in gark("check", "lobatto-iiic*-2").out


@pytest.mark.parametrize("name", ["no\udcffne", 'rk4", "aliases": ["RK44', "no\\ne"])
def test_a_name_is_never_read_as_json(name: str) -> None:
    """Half a sign, quotes and a backslash are in no name, although the index is text."""
    assert look_up(name) is None


@pytest.mark.parametrize("stem", ["sdirk10", "gauss", "rk44x"])
def test_a_file_of_this_stem_comes_first(stem: str, tmp_path: Path) -> None:
    """Before names of the catalogue that look alike, and before families."""
    (tmp_path / f"{stem}.yaml").write_text("A: [[1/2]]\nb: [1]\n", encoding="utf-8")
    run = gark("check", stem, cwd=tmp_path)
    assert (run.code, f"did you mean '{stem}.yaml'?" in run.err + run.out) == (2, True)
