"""``gark stability`` as users see it: text within 80 columns, JSON, LaTeX, two springs, refusals."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from click.testing import CliRunner, Result

from garkcli.cli.main import gark
from garkcli.errors import GarkError

METHODS = sorted(str(path) for path in Path("methods").glob("*.gark.yaml"))


def run(*arguments: str) -> Result:
    """One run in this process."""
    return CliRunner().invoke(gark, ["stability", *arguments])


@pytest.mark.parametrize("path", METHODS[::2])
def test_methods_of_the_paper(path: str) -> None:
    """The text fits 80 columns; JSON tells the same."""
    text = run(path)
    assert text.exit_code == 0, text.output
    assert max(map(len, text.output.splitlines())) <= 80
    (data,) = json.loads(run(path, "--format", "json").output)["files"]
    said = {True: "A-stable", False: "not A-stable: ", None: "A-stable not decided"}
    first, *rest = text.output.splitlines()
    if "a_stable" in data:
        assert first.startswith(f"{path}: {said[data['a_stable']]}")
    else:
        assert "A-stable" not in text.output
    rows = [line.split() for line in rest]
    for key, label in (("p_stable", "P-stable"), ("algebraically_stable", "algebraically stable")):
        if data.get(key) is not None:
            (row,) = [" ".join(row) for row in rows if " ".join(row).startswith(label)]
            assert row.startswith(f"{label} {'yes' if data[key] else 'no: '}")


def test_the_page_shows_what_the_program_prints() -> None:
    """The transcript in docs/stability.md."""
    page = Path("docs/stability.md").read_text(encoding="utf-8")
    block = page.split("```console\n")[1].split("```")[0]
    command, _, shown = block.partition("\n")
    assert command == "$ gark stability methods/rectangular.gark.yaml"
    assert run("methods/rectangular.gark.yaml").output == shown


def test_two_springs() -> None:
    """The resonance of three colours with a slow spring of a = 1/4, exactly."""
    path = "methods/three-colours.gark.yaml"
    result = run(path, "--slow", "1/4", "--fast", "2", "--format", "json")
    (data,) = json.loads(result.output)["files"]
    assert data["kind"] == "two-frequencies"
    assert [(x["from"], x["to"]) for x in data["stable"]] == [
        ("0", "1407/160"),
        ("47/4", "1437/40"),
    ]
    assert {"factor": "4*x - 47", "multiplicity": 1} in data["factors"]


def test_latex() -> None:
    """R of the classical method as a fraction."""
    assert (
        r"\frac{z^{4}+4z^{3}+12z^{2}+24z+24}{24}"
        in run("methods/rk4.gark.yaml", "--format", "latex").output
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["methods/rk4.gark.yaml", "--slow", "1"], "--slow and --fast belong together"),
        (["methods/three-colours.gark.yaml", "--slow", "1", "--fast", "4"], "no colour '4'"),
        (["methods/three-colours.gark.yaml", "--slow", "-1", "--fast", "2"], "is not negative"),
        (["methods/rk4.gark.yaml", "--slow", "1", "--fast", "1"], "no two colours for two springs"),
    ],
)
def test_refusals(arguments: list[str], message: str) -> None:
    """What cannot be asked is refused with its reason."""
    result = run(*arguments)
    assert isinstance(result.exception, GarkError)
    assert message in result.exception.message


@pytest.mark.parametrize(
    "arguments",
    [
        ["methods/rk4.gark.yaml"],
        ["methods/rk4.gark.yaml", "--order-star"],
        ["methods/ark-ars222.gark.yaml"],
        ["methods/rk4.gark.yaml", "methods/collocation.gark.yaml"],
        ["methods/rectangular.gark.yaml", "methods/stoermer-verlet.gark.yaml"],
        ["methods/three-colours.gark.yaml", "--slow", "1/4", "--fast", "2"],
    ],
    ids=["region", "order star", "colours", "several", "traces", "springs"],
)
def test_pictures(arguments: list[str], tmp_path: Path) -> None:
    """Each kind of picture is written, with its axes labelled."""
    plot = tmp_path / "picture.svg"
    result = run(*arguments, "--plot", str(plot))
    assert result.exit_code == 0, result.output
    assert plot.read_text(encoding="utf-8").startswith("<?xml")
    assert "┤" in run(*arguments, "-v").output


def test_nothing_to_draw(tmp_path: Path) -> None:
    """Rounding leaves the oscillator open, and one colour has no linear test equation."""
    result = run("yoshida-8a", "--plot", str(tmp_path / "picture.svg"))
    assert isinstance(result.exception, GarkError)
    assert result.exception.message == "there is nothing to draw"


def test_a_region_in_text_is_that_of_the_method() -> None:
    """−2.79 is the end of the real axis of the classical method: the marks on the axis end there.
    It is drawn with details alone.
    """
    assert "┤" not in run("methods/rk4.gark.yaml").output
    lines = run("methods/rk4.gark.yaml", "-v").output.splitlines()
    (axis,) = [line for line in lines if line.strip().startswith("0 ┤")]
    below = next(k for k, line in enumerate(lines) if "└" in line)
    first, *_, last = (k for k, sign in enumerate(lines[below]) if sign == "┬")
    low, *_, high = (int(x.replace("−", "-")) for x in lines[below + 1].split())
    step = (high - low) / (last - first)
    assert abs(low + step * (axis.index("█") - first) + 2.785) < 1.5 * step
