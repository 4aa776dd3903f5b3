"""``gark plot``: one look at a method."""

from __future__ import annotations

import webbrowser
from pathlib import Path
from urllib.parse import urlparse
from xml.etree import ElementTree as ET

import pytest

from garkcli import load
from tests.cli.harness import gark

METHODS = {
    "region": "rk4",
    "star": "gauss-2",
    "oscillator": "leapfrog-2",
    "convergence": "heun",
    "energy": "rk4",
    "tableau": "rk4",
    "tree": "rk4",
}
"""A method for each picture."""


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The addresses that the browser is asked for."""
    found: list[str] = []

    def note(address: str) -> bool:
        found.append(address)
        return True

    monkeypatch.setattr(webbrowser, "open", note)
    return found


@pytest.mark.parametrize("what", METHODS)
def test_each_picture_in_the_terminal_and_as_a_file(what: str, tmp_path: Path) -> None:
    """Its lines fit 60 and 80 columns, with and without UTF-8; the file is XML with its namespace
    and a shape.
    """
    for columns, encoding in ((60, ""), (80, ""), (60, "ascii"), (80, "ascii")):
        variables = {"COLUMNS": str(columns)}
        run = gark("plot", METHODS[what], "--what", what, encoding=encoding, **variables)
        assert (run.code, run.err) == (0, "")
        assert run.out.count("\n") >= 3
        assert max(map(len, run.out.splitlines())) <= columns
        assert not encoding or run.out.isascii()
    file = tmp_path / f"{what}.svg"
    assert gark("plot", METHODS[what], "--what", what, "-o", str(file)).code == 0
    root = ET.parse(file).getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert {"path", "text"} & {x.tag.rpartition("}")[2] for x in root.iter()}
    size = [float(root.attrib[x]) for x in ("width", "height")]
    assert size == [float(x) for x in root.attrib["viewBox"].split()[2:]]
    name = load(METHODS[what]).name
    title = root.findtext("{http://www.w3.org/2000/svg}title")
    assert title is not None
    assert title.startswith(f"{name}: ")
    assert root.attrib["role"] == "img"


def test_region_and_star_of_gauss() -> None:
    """Gauss damps nothing on the right, where its order star has two lobes."""
    region, star = (gark("plot", "gauss-2", "--what", x).out for x in ("region", "star"))
    axis = next(x for x in region.splitlines() if x.startswith(" 0 ┤")).index("│")
    lobes = ["".join(x[axis:] for x in y.splitlines()).count("█") for y in (region, star)]
    assert "█" in region
    assert lobes[0] == 0 < lobes[1]


def test_no_picture_has_a_reason_and_a_cure() -> None:
    """A method that the picture is not for is refused with exit code 2."""
    cases = (
        ("leapfrog-2", "region", "there is no stability function: colours drive positions"),
        ("rk4", "oscillator", "decides nothing: the determinant of a step is not 1"),
        ("ros3p", "energy", "of GARK methods, and this method is of another kind"),
        ("nystrom-4", "star", "a method of this kind has no stability function"),
        ("ars-343", "oscillator", "the determinant of a step is not 1"),
    )
    for method, what, why in cases:
        run = gark("plot", method, "--what", what)
        assert (run.code, run.out) == (2, "")
        assert f"--what {what}: " in run.err
        assert why in " ".join(run.err.split())
        assert "help: choose among" in run.err
        assert f" {what}," not in run.err.partition("help:")[2]


@pytest.mark.parametrize("method", ["leapfrog-2", "ros3p", "nystrom-4", "merk21"])
def test_the_hint_names_pictures_that_there_are(method: str) -> None:
    """Each word of the help after a refusal is a picture of that method."""
    runs = [gark("plot", method, "--what", x) for x in ("region", "oscillator")]
    refused = next(x for x in runs if x.code)
    hint = refused.err.partition("help: choose among ")[2]
    words = hint.strip().split(", ")
    assert words[-2:] == ["tableau", "tree"]
    assert all(gark("plot", method, "--what", x).code == 0 for x in words)


@pytest.mark.parametrize("method", ["rk4", "ros3p", "nystrom-4", "merk21"])
def test_tableau_and_tree_are_those_of_other_commands(method: str, tmp_path: Path) -> None:
    """The tableau of gark tableau, and the tree of gark check with the names of its colours."""
    assert gark("plot", method, "--what", "tableau").out == gark("tableau", method).out
    lines = gark("plot", method, "--what", "tree").out.splitlines()
    assert f"fails at {lines[0]} by" in gark("check", method, COLUMNS="200").out
    file = tmp_path / "tableau.svg"
    assert gark("plot", method, "--what", "tableau", "-o", str(file)).code == 0
    title, *texts = ["".join(x.itertext()) for x in ET.parse(file).getroot()]
    assert title.endswith(": tableau")
    assert [x for x in texts if x] == [x for x in gark("tableau", method).out.splitlines() if x]


@pytest.mark.parametrize(
    ("method", "shown"),
    [
        ("rk4", "Stability region"),
        ("ros3p", "Stability region"),
        ("leapfrog-2", "Oscillator"),
        ("nystrom-4", "Oscillator"),
        ("mri-gark-erk33a", "the slow method"),
    ],
)
def test_without_a_word_the_first_picture_is_shown(method: str, shown: str) -> None:
    """Whatever the kind of method, there is one look at it."""
    run = gark("plot", method)
    assert run.code == 0
    assert shown in run.out


@pytest.mark.parametrize("method", ["rodas4", "nystrom-4", "tdrk-4", "imex-nprk-21"])
def test_what_converge_draws_is_drawn(method: str) -> None:
    """Methods of other kinds have errors over step sizes too."""
    run = gark("plot", method, "--what", "convergence")
    assert run.code == 0
    assert "step size h" in run.out


def test_energy_of_the_symplectic_pair_is_the_one_of_the_pair() -> None:
    """The pair of a method is drawn with --pair."""
    assert "drifts" not in gark("plot", "rk4", "--pair", "--what", "energy").out.lower()
    assert "drifts" in gark("plot", "rk4", "--what", "energy").out.lower()


def test_open_shows_the_file(opened: list[str], tmp_path: Path) -> None:
    """The one that was written, or one in a temporary folder that is still there."""
    assert gark("plot", "rk4", "--open", "-o", "a.svg", cwd=tmp_path).code == 0
    assert gark("plot", "rk4", "--open", "--what", "tree", cwd=tmp_path).code == 0
    assert gark("report", "heun", "--no-pictures", "--open", cwd=tmp_path).code == 0
    files = [Path(urlparse(x).path) for x in opened]
    assert [x.name for x in files] == ["a.svg", "tree.svg", "heun-euler.html"]
    assert all(x.is_file() for x in files)
    for command in ("plot", "report"):
        assert gark(command, "rk4", "--open", "-o", "-").code == 2
    assert len(opened) == 3


def test_a_notebook_shows_tableau_and_region() -> None:
    """The region is there for a method with R(z), not for others."""
    shown = load("rk4")._repr_html_()
    assert "<table" in shown
    assert "Stability region" in shown
    assert "Stability region" not in load("leapfrog-2")._repr_html_()


def test_a_step_that_fails_leads_to_another_problem(tmp_path: Path) -> None:
    """The stages of this method are not solved on Kepler's problem: gark plot has no step size to
    choose, and the line of gark energy works.
    """
    (tmp_path / "own.yaml").write_text("A: [[1/4, 0], [1/2, 1/3]]\nb: [1/2, 1/2]\n")
    run = gark("plot", "own.yaml", "--what", "energy", cwd=tmp_path)
    assert run.code == 2
    assert "smaller step" not in run.err
    line = "gark energy own.yaml --plot e.svg"
    assert line in " ".join(run.err.split())
    assert gark(*line.split()[1:], cwd=tmp_path).code == 0
