""".gark.toml and [tool.gark]: what gark check does where no option says otherwise."""

from __future__ import annotations

import json
import os
from pathlib import Path
from time import process_time

import pytest

from garkcli.cli.project import find_project
from garkcli.methodfile import naming
from tests.cli.harness import gark

PATIENCE = 10.0
"""Seconds of processor time that hostile settings may take on a slow machine."""
METHOD = "A: [[0, 0], [1/2, 0]]\nb: [0, 1]\n"


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A repository with two method files in a folder, one with claims."""
    (tmp_path / ".git").mkdir()
    folder = tmp_path / "tables"
    folder.mkdir()
    (folder / "with.gark.yaml").write_text(METHOD + "expect: {order: 2}\n")
    (folder / "without.gark.yaml").write_text(METHOD)
    return tmp_path


def put(folder: Path, name: str, text: str) -> None:
    """A file of the project."""
    (folder / name).write_text(text, encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "head"), [(".gark.toml", ""), ("pyproject.toml", "[tool.gark]\n")]
)
def test_paths_and_format(project: Path, name: str, head: str) -> None:
    """Without FILE the paths are checked, from whatever folder of the project; options win."""
    put(project, name, head + 'paths = ["tables"]\nformat = "json"\n')
    below = project / "tables"
    for here in (project, below):
        run = gark("check", cwd=here)
        assert run.code == 0
        assert len(json.loads(run.out)["files"]) == 2
    run = gark("check", "--format", "text", cwd=project)
    assert "2 files" in run.out
    run = gark("check", "with.gark.yaml", cwd=below)
    assert len(json.loads(run.out)["files"]) == 1


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        (".gark.toml", "format = ['json']", "format: a single value is expected here"),
        (".gark.toml", "require-claims = [['a']]", "a single value is expected here"),
        ("pyproject.toml", "tool = {gark = 1}", "tool.gark is not a table"),
        ("pyproject.toml", "[tool]\ngark.jobs = 'x'", "[tool.gark], jobs: a whole number"),
        ("pyproject.toml", "[a]\njobs = 1\n[tool]\ngark.jobs = -1", "pyproject.toml:4:1"),
        ("pyproject.toml", "[a]\njobs = 1\n[tool]\ngark = {jobs = -1}", "pyproject.toml:1:1"),
        ("pyproject.toml", "['tool']\ngark = {jobs = -1}", "[tool.gark], jobs: a whole number"),
    ],
)
def test_values_of_another_kind(project: Path, name: str, text: str, message: str) -> None:
    """A list where a word belongs, a number where a table does: said, with place and cure."""
    put(project, name, text)
    run = gark("check", "tables", cwd=project)
    assert (run.code, message in run.err) == (2, True)


def test_other_tools_are_not_read(project: Path) -> None:
    """A pyproject.toml that speaks of gark elsewhere, or has no table of tools, means nothing."""
    for text in ("# tool.gark\ntool = 1\n", "[project]\nname = 'gark'\n"):
        put(project, "pyproject.toml", text)
        assert gark("check", "tables", cwd=project).code == 0


def test_the_cure_adds_the_claims_that_are_required(project: Path) -> None:
    """Also to a file that makes other claims."""
    put(project, ".gark.toml", 'require-claims = ["order", "stage-order"]\n')
    file = "tables/with.gark.yaml"
    run = gark("check", file, cwd=project)
    assert (run.code, run.out.count("NO CLAIM")) == (1, 2)
    _, command, line = " ".join(run.out.split()).partition("gark claims FILE --write")
    keys = line.split()[: 2 * line.count("--key")]
    typed = [*command.replace("FILE", file).split()[1:], *keys]
    assert gark(*typed, cwd=project).code == 0
    assert gark("check", file, cwd=project).code == 0


def test_claims_that_are_required(project: Path) -> None:
    """A list names claims without which a file fails; true asks for any."""
    put(project, ".gark.toml", 'require-claims = ["order", "symplectic"]\n')
    run = gark("check", "tables", cwd=project)
    assert run.code == 1
    assert run.out.count("the file does not claim symplectic") == 1
    text = " ".join(run.out.split())
    assert "gark claims FILE --write --key symplectic" in text
    assert "gark claims FILE --write --key order --key symplectic" in text
    for format in ("github", "junit", "sarif", "markdown"):
        told = gark("check", "tables", "--format", format, cwd=project)
        assert told.code == 1
    put(project, ".gark.toml", "require-claims = true\n")
    run = gark("check", "tables/with.gark.yaml", cwd=project)
    assert run.code == 0
    assert gark("check", "tables", cwd=project).code == 1


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("path = []\n", "did you mean 'paths'?"),
        ("paths = 'x'\n", "paths: a list is expected here"),
        (
            "paths = []\n",
            'paths is empty\n    1 | paths = []\n      | ^\n      help: write ["methods"]',
        ),
        ("paths = [3]\n", 'paths: 3 is not "3"'),
        ("require-claims = 'yes'\n", 'require-claims: "yes" is not true'),
        ('max-order = "12"\n', 'max-order: "12" is not 12'),
        ('require-claims = ["ordr"]\n', "did you mean 'order'?"),
        ("format = 'yaml'\n", "format: 'yaml' is not known"),
        ("max-order = true\n", "max-order: a whole number of at least 1 is expected"),
        ("jobs = 1000\n", "jobs: a whole number of at most 256 is expected"),
        ("paths = [\n", "TOML is expected"),
    ],
)
def test_what_means_nothing(project: Path, text: str, said: str) -> None:
    """One fault with the file and the cure."""
    put(project, ".gark.toml", text)
    run = gark("check", "tables", cwd=project)
    assert run.code == 2
    assert ".gark.toml" in run.err
    assert said in run.err


def test_what_is_not_ours(project: Path) -> None:
    """A pyproject.toml that does not speak of gark is passed over, broken or not, and so is what
    stands above the repository.
    """
    put(project, "pyproject.toml", "[tool.other\n")
    assert gark("check", "tables", cwd=project).code == 0
    (project / "pyproject.toml").unlink()
    inner = project / "inner"
    (inner / ".git").mkdir(parents=True)
    put(project, ".gark.toml", 'paths = ["tables"]\n')
    assert "Missing argument" in gark("check", cwd=inner).err


OUT = (
    *(
        "../outside",
        "../outside/*",
        "*/../../outside/*",
        "**/../../outside/*",
        "tables/../../outside",
    ),
    *("./*/.././../outside/*", "tables/*/../../../outside/hidden.gark.yaml", "[!.]*/../../outside"),
    *(
        "[.][.]/outside/*",
        ".*/outside/*",
        ".*/*/*",
        "{here}/../outside",
        "{here}/*/../../outside/*",
    ),
    *(
        "folder/*",
        "*/*",
        "**/*.yaml",
        "*/hidden*",
        "f*/hidden.gark.yaml",
        "folder/hidden.gark.yaml",
    ),
    *(
        "one.gark.yaml",
        "one*",
        "*",
        "folder",
        "f*",
        "folder/..",
        "tables/back/*",
        "*/back/outside/*",
    ),
)
"""Paths of which some lead out of a project, by dots, links, patterns or from the root."""


@pytest.mark.parametrize("given", OUT)
@pytest.mark.parametrize(
    ("name", "head"), [(".gark.toml", ""), ("pyproject.toml", "[tool.gark]\n")]
)
def test_nothing_outside_is_read(project: Path, given: str, name: str, head: str) -> None:
    """Whatever the paths of a project are, and from whatever folder of it gark runs: no file
    outside is quoted or so much as named, and none but links of the project are spoken of.
    """
    here, outside = project / "here", project / "outside"
    here.mkdir()
    outside.mkdir()
    (project / ".git").rename(here / ".git")
    tables = (project / "tables").rename(here / "tables")
    secret = "A: [[0, 0], [1/2, 0]]\nb: [0, TOPSECRET]\n"
    (outside / "hidden.gark.yaml").write_text(secret, encoding="utf-8")
    (here / "folder").symlink_to(outside, target_is_directory=True)
    (tables / "back").symlink_to(project, target_is_directory=True)
    (here / "one.gark.yaml").symlink_to(outside / "hidden.gark.yaml")
    (here / ".hidden").symlink_to(outside, target_is_directory=True)
    path = given.format(here=here.as_posix())
    put(here, name, f"{head}paths = [{json.dumps(path)}]\n")
    for place in (here, tables):
        run = gark("check", cwd=place)
        said = (run.out + run.err).replace(given, "")
        said = said.replace("folder/hidden.gark.yaml: error[no-such-file]", "")
        assert run.code in {0, 1, 2}
        assert "TOPSECRET" not in said
        assert "hidden.gark" not in said


def test_links_inside_are_followed(project: Path) -> None:
    """A pattern finds what is in the project, also by links and dots that stay in it."""
    (project / "again").symlink_to(project / "tables", target_is_directory=True)
    for given in ("tables/../*/with.*", "**/**/with.*", "t*/../tables/with.gark.yaml"):
        put(project, ".gark.toml", f"paths = [{json.dumps(given)}]\n")
        run = gark("check", cwd=project / "tables")
        assert run.code == 0
        assert "with.gark.yaml: order 2" in run.out


def test_stars_in_a_row_say_no_more_than_one(
    project: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each of them would go through all folders below each match of those before it."""
    (project / "a/b/c/d").mkdir(parents=True)
    walks: list[str] = []
    folders = naming._folders
    monkeypatch.setattr(naming, "_folders", lambda x: walks.append(x) or folders(x))
    (project / "tables/with.gark.yaml").rename(project / "a/b/c/d/deep.gark.yaml")
    put(project, ".gark.toml", f"paths = [{json.dumps('**/' * 12 + 'deep*')}]\n")
    assert gark("check", cwd=project).code == 0
    assert len(walks) == 1


def test_a_path_is_no_name(project: Path) -> None:
    """The paths of a project are files: neither methods of the catalogue nor standard input."""
    for given in ("rk4", "-", "catalogue:", "gauss-2"):
        put(project, ".gark.toml", f"paths = [{json.dumps(given)}]\n")
        run = gark("check", cwd=project, stdin=METHOD)
        assert (run.code, "no such file" in run.out) == (2, True)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('paths = ["a\\u0000b"]', "paths: 'a\\x00b' is not the name of a file"),
        ("paths = [" + '"x", ' * 1001 + "]", "1001 paths (limit 1000)"),
        ("a = " + "[" * 5000 + "]" * 5000, "nested too deeply"),
        ("a = " + "{a = " * 5000 + "1" + "}" * 5000, "nested too deeply"),
        ("a." * 200_000 + "a = 1", "nested too deeply"),
        ("a." * 90 + "a = 1", "unknown key 'a'"),
        ("[" + "paths." * 90 + "a]", "a list is expected here"),
        ("a = " + ("{" + "a." * 90 + "a = ") * 50 + "1" + "}" * 50, "unknown key 'a'"),
        ("paths = " + "[" * 50 + "]" * 50, "a single value is expected here"),
        ("\n".join(f"a{n} = 1" for n in range(20_000)), " | a200 = 1"),
        ("\n" * 500_000 + "a = 1", "unknown key 'a'"),
        ("#" + " " * 500_000 + "\na = 1", "unknown key 'a'"),
    ],
    ids=[
        "nul",
        "many",
        "lists",
        "tables",
        "dots",
        "names",
        "head",
        "names-in-tables",
        "inside",
        "keys",
        "lines",
        "blank",
    ],
)
@pytest.mark.parametrize(
    ("name", "head"), [(".gark.toml", ""), ("pyproject.toml", "[tool.gark]\n")]
)
def test_hostile_settings(project: Path, text: str, said: str, name: str, head: str) -> None:
    """Settings of any depth, number and length are refused with place and cure, soon."""
    if head and text.startswith("["):
        head, text = "", text.replace("[", "[tool.gark.")
    put(project, name, head + text + "\n")
    start = process_time()
    run = gark("check", cwd=project)
    assert process_time() - start < PATIENCE
    assert run.code == 2
    assert said in run.err
    assert "help: " in run.err


def test_paths_on_another_drive_stay_whole(project: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no path leads there from here, as on Windows, they are taken as they are written."""
    place = str(project / "tables")
    put(project, ".gark.toml", f"paths = [{json.dumps(place)}]\n")
    relative = os.path.relpath

    def without_other_drives(path: str, start: str = os.curdir) -> str:
        if path == place:
            raise ValueError("path is on mount 'D:', start on mount 'C:'")
        return relative(path, start)

    monkeypatch.chdir(project)
    monkeypatch.setattr(os.path, "relpath", without_other_drives)
    assert find_project().paths == (place,)
