"""Names in place of files: what they mean, and what is said where they mean several things."""

from __future__ import annotations

import difflib
import os
import sys
from collections.abc import Collection
from importlib import metadata
from pathlib import Path
from typing import Any

import pytest

from garkcli import catalogue
from garkcli.errors import MethodFileError, Remark, nearest
from garkcli.methodfile.load import load
from garkcli.methodfile.naming import expanded, find_files, find_named, hidden_by, look_up
from garkcli.methodfile.shelves import PATH_VARIABLE, package

ONE = "A: [[0]]\nb: [1]\n"
HALF = "A: [[1/2]]\nb: [1]\n"


@pytest.fixture
def own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of one's own, which is on the path; the tests run beside it."""
    folder = tmp_path / "own"
    folder.mkdir()
    monkeypatch.setenv(PATH_VARIABLE, str(folder))
    monkeypatch.chdir(tmp_path)
    return folder


def put(folder: Path, name: str, text: str = ONE) -> Path:
    """A method file."""
    path = folder / f"{name}.gark.yaml"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
    return path


def fault(argument: str) -> Remark:
    """Why an argument is no method."""
    with pytest.raises(MethodFileError) as caught:
        load(argument)
    (found,) = caught.value.faults
    return found


@pytest.mark.parametrize("name", ["rk4", "RK4", "catalogue:rk4"])
def test_a_name_is_a_method(name: str) -> None:
    """It is called by its name in the catalogue, however it was typed."""
    method = load(name)
    assert method.source == "rk4"
    assert method.name == "the classical Runge-Kutta method"


def test_capitals_blanks_and_underscores_do_not_count(own: Path) -> None:
    """In names and in aliases, and of hyphens the kind does not."""
    put(own, "my-best-one", f"aliases: [Zanna's 3(2) rule]\n{ONE}")
    for name in ("My_Best ONE", "my–best−one", "ZANNA'S_3(2)-RULE"):
        assert load(name).source == "my-best-one"


@pytest.mark.parametrize(
    ("spelling", "name"),
    [
        ("ARS(2,2,2)", "ark-ars222"),
        ("SSPRK(10,4)", "ssp-104"),
        ("ARK4(3)6L[2]SA", "ark-436"),
        ("RadauIIA5", "radau-iia-3"),
        ("Radau IIA-5", "radau-iia-5"),
    ],
)
def test_letters_and_digits_are_enough(spelling: str, name: str) -> None:
    """Names as papers spell them; a name or an alias that is meant as it stands goes first."""
    method = look_up(spelling)
    assert method is not None
    assert method.name == name


def test_letters_and_digits_of_several_methods() -> None:
    """What may mean a name and an alias of another method is told, and so is nothing at all."""
    with pytest.raises(MethodFileError, match="means 2 methods: radau-iia-3, radau-iia-5"):
        look_up("radau_iia5")
    assert look_up("()") is None


def test_what_exists_is_a_file(own: Path) -> None:
    """So is whatever has a separator of paths in it, or ends as such files do."""
    assert own
    Path("mine").write_text(HALF, encoding="utf-8")
    assert load("mine").source == "mine"
    assert find_named("mine") is None
    for path in ("./rk4", "a/rk4", "rk4.yaml", "rk4.gark.yaml"):
        assert fault(path).message == "no such file"


def test_a_file_that_is_called_as_a_method(own: Path) -> None:
    """Both are meant, so neither is taken, and each has a way to be said."""
    assert own
    Path("rk4").write_text(HALF, encoding="utf-8")
    told = fault("rk4")
    assert "there is a file of this name here" in told.message
    assert "catalogue:rk4" in told.help
    assert load(f".{os.sep}rk4").tableau.spaces[0].stages == 1
    assert load("catalogue:rk4").tableau.spaces[0].stages == 4
    # also by an alias or in capitals, and where it is a folder
    Path("rk4").unlink()
    put(Path("rk4"), "inside")
    assert "there is a file of this name here" in fault("rk4").message
    assert list(find_files(["rk4"])) == ["rk4"]


def test_an_unknown_name_has_its_nearest() -> None:
    """Names and aliases are compared; else the list of all is named."""
    assert "'collocation'" in fault("colocation").help
    begun = "dormand-prince-5, dormand-prince-6, dormand-prince-8"
    assert fault("Dormand-Prince").help.endswith(begun)
    assert fault("verner").help.endswith(", …")
    assert "gark list methods" in fault("qqqqqqq").help
    assert "no method of this name" in fault("catalogue:qqqqqqq").message


def test_own_folders_come_first_and_say_so(own: Path) -> None:
    """A name of the package in a folder of one's own hides the package's."""
    path = put(own, "rk4", HALF)
    method = look_up("rk4")
    assert method is not None
    assert method.place == str(path)
    assert load("rk4").tableau.spaces[0].stages == 1
    assert hidden_by(method) == ["the package"]
    other = look_up("collocation")
    assert other is not None
    assert hidden_by(other) == []


def test_folders_of_the_path_come_in_its_order(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Folders that there are not are passed over, as in the path of programs."""
    put(tmp_path / "a", "twice", HALF)
    put(tmp_path / "b", "twice")
    folders = [str(tmp_path / x) for x in ("none", "b", "a", "b")]
    monkeypatch.setenv(PATH_VARIABLE, os.pathsep.join(["", *folders]))
    method = look_up("twice")
    assert method is not None
    assert method.shelf == str(tmp_path / "b")
    assert hidden_by(method) == [str(tmp_path / "a")]


def test_an_alias_of_several_methods_says_which(own: Path) -> None:
    """They are named; one name in two folders of one place has its files told."""
    put(own, "one", f"aliases: [theirs]\n{ONE}")
    put(own, "two", f"aliases: [Theirs]\n{ONE}")
    told = fault("theirs")
    assert "means 2 methods: one, two" in told.message
    put(own / "x", "same")
    put(own / "y", "same")
    told = fault("same")
    assert os.path.join("x", "same.gark.yaml") in told.message


def test_a_name_goes_before_an_alias(own: Path) -> None:
    """Also before the alias of a folder that is looked into earlier."""
    put(own, "mine", f"aliases: [rk4, collocation]\n{ONE}")
    assert load("rk4").source == "rk4"
    assert load("collocation").source == "collocation"


def test_own_files_with_faults_are_told_when_they_are_meant(own: Path) -> None:
    """A file that is no YAML does not stand in the way of other names and aliases."""
    put(own, "bad", "aliases: [a\n: b")
    put(own, "good", f"aliases: [fine]\n{ONE}")
    assert load("fine").source == "good"
    with pytest.raises(MethodFileError) as caught:
        load("bad")
    assert caught.value.source == "bad"


def test_all_of_a_folder_of_the_catalogue(own: Path) -> None:
    """``catalogue:`` is every method, with a folder those of it; own ones included."""
    put(own / "found", "mine")
    every = list(find_files(["catalogue:"]))
    assert every == [f"catalogue:{name}" for name in catalogue]
    found = expanded("catalogue:found")
    assert "catalogue:mine" in found
    assert "catalogue:rk4" not in found
    assert list(find_files(["catalogue:rk4"])) == ["catalogue:rk4"]


def test_packages_of_others(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """An entry point names a package whose resources are method files, in folders too."""
    site = tmp_path / "site"
    put(site / "theirs" / "sub", "their-method", f"aliases: [th1]\n{HALF}")
    put(site / "theirs", "rk4", HALF)
    (site / "theirs" / "__init__.py").write_text("")
    entry_point(site, "others", "theirs")
    monkeypatch.syspath_prepend(str(site))
    assert load("Their Method").tableau.spaces[0].stages == 1
    assert load("th1").source == "their-method"
    # the package goes before others
    assert load("rk4").tableau.spaces[0].stages == 4
    assert "catalogue:their-method" in expanded("catalogue:sub")
    monkeypatch.delitem(sys.modules, "theirs", raising=False)


def entry_point(site: Path, name: str, value: str) -> None:
    """What an installed package says of itself."""
    info = site / f"{name}-1.0.dist-info"
    info.mkdir(parents=True)
    (info / "METADATA").write_text(f"Name: {name}\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text(f"[gark.catalogue]\n{name} = {value}\n")


def test_a_package_of_others_that_is_broken(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is told where it is needed, and does not stand in the way of what comes before."""
    site = tmp_path / "site"
    entry_point(site, "broken", "not_there_at_all")
    monkeypatch.syspath_prepend(str(site))
    assert load("rk4").source == "rk4"
    told = fault("their-method")
    assert "not_there_at_all cannot be imported" in told.message


def test_names_do_not_read_files() -> None:
    """The index has names and aliases: of the package's files the one that is meant is read."""
    for method in package().methods["rk4"]:
        assert package().called(method) == package().entries["rk4"]["aliases"]


def test_names_from_python() -> None:
    """Whatever files there are beside."""
    assert catalogue["Stoermer_Verlet"].source == "stoermer-verlet"
    assert catalogue["catalogue:rk4"].source == "rk4"
    assert set(catalogue) >= {"rk4", "collocation", "imex6-order4"}


def test_many_missing_names_cost_little(monkeypatch: pytest.MonkeyPatch) -> None:
    """Packages are looked for once, and a misspelt word among many is compared letter by letter
    with few of them; the nearest is still found.
    """
    asked: list[str] = []
    monkeypatch.setattr(metadata, "entry_points", lambda group: asked.append(group) or [])
    monkeypatch.syspath_prepend("/a/path/of/this/test")
    for number in range(20):
        assert "no such file" in fault(f"nothing-{number}").message
    assert len(asked) == 1

    compared: list[int] = []
    search = difflib.get_close_matches

    def counting(word: str, known: Collection[str], **limits: Any) -> list[str]:
        compared.append(len(known))
        return search(word, known, **limits)

    monkeypatch.setattr(difflib, "get_close_matches", counting)
    words = ["metod", *(f"method-{number}.yaml" for number in range(1000))]
    assert nearest("metodx", words) == "metod"
    assert nearest("method-12x.yaml", words).startswith("method-12")
    assert max(compared) <= 20
