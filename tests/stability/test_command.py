"""``gark stability`` as users see it: text within 80 columns, JSON, LaTeX, two springs, refusals."""

from __future__ import annotations

import json
from itertools import count
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from jsonschema import Draft7Validator

from garkcli import report_schema
from garkcli.cli.main import gark, main
from garkcli.errors import GarkError, NotDecided
from tests.whole import in_whole, sample

METHODS = sorted(str(path) for path in Path("methods").glob("*.gark.yaml"))


def run(*arguments: str) -> Result:
    """One run in this process."""
    return CliRunner().invoke(gark, ["stability", *arguments])


@pytest.mark.parametrize("path", sample(METHODS[::2], 3))
def test_methods_of_the_paper(path: str) -> None:
    """The text fits 80 columns; JSON tells the same."""
    text = run(path)
    assert text.exit_code == 0, text.output
    assert max(map(len, text.output.splitlines())) <= 80
    (data,) = json.loads(run(path, "--format", "json").output)["files"]
    said = {True: "A-stable", False: "not A-stable: ", None: "A-stable not decided"}
    first, *rest = text.output.splitlines()
    if data.get("pair"):
        implicit = {x["name"]: x for x in data["colours"]}[data["pair"]["implicit"]]
        assert first.startswith(f"{path}: implicit part L-stable; ") == implicit["l_stable"]
    elif "a_stable" in data:
        assert first.startswith(f"{path}: {said[data['a_stable']]}")
    else:
        assert "A-stable" not in text.output
    rows = [line.split() for line in rest]
    for key, label in (("p_stable", "P-stable"), ("algebraically_stable", "algebraically stable")):
        if data.get(key) is not None:
            (row,) = [" ".join(row) for row in rows if " ".join(row).startswith(label)]
            assert row.startswith(f"{label} {'yes' if data[key] else 'no: '}")


def test_parts_come_first() -> None:
    """Of an implicit-explicit method: its parts, then both, each interval cut off and not rounded.

    The explicit Euler step is stable on [−2, 0], that of ARS(3,4,3) as the one of RK4 nearly is; with
    one λ for both none of this could be seen.
    """
    first, *rest = " ".join(run("imex-euler").output.split()).partition(" R(z1, z2, …)")
    assert first.startswith(
        "ars-111: implicit part L-stable; explicit part: real interval [−2, 0], no imaginary"
        " interval; coupled: real interval [−2, 0], no imaginary interval"
    )
    assert "A-stable" not in "".join(rest).replace("algebraically stable", "")
    (data,) = json.loads(run("ars-343", "--format", "json").output)["files"]
    ends = [data["colours"][0]["real_interval"], data["pair"]["real_interval"]]
    assert [float(x["to"]["decimal"]) for x in ends] == pytest.approx([2.78529356483] * 2)
    square = float(data["colours"][0]["imaginary_interval"]["to"]["decimal"])
    assert 2.828 < square**0.5 < 2.8284271247
    text = " ".join(run("ars-343").output.split())
    assert "explicit part: real interval [−2.785, 0], imaginary interval [−2.828i, 2.828i]" in text
    assert "one λ for both parts" in run("ars-343", "-v").output


def test_rounded_parts_come_first_too() -> None:
    """What is coupled is not decided, and a table has the columns of all its methods."""
    text = " ".join(run("ark-324").output.split())
    assert "within 1e-25: implicit part L-stable; explicit part: real interval [−3.664, 0]" in text
    assert "coupled not decided: coefficients are rounded" in text
    table = run("ark-324", "rk4", "--format", "markdown").output.splitlines()
    assert table[0].startswith("| file | implicit part | explicit part | coupled | A-stable |")
    assert table[2].split("|")[2].strip() == "L-stable"
    assert table[2].split("|")[5].strip() == ""
    assert table[3].split("|")[2].strip() == ""


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
        pytest.param(["methods/ark-ars222.gark.yaml"], marks=in_whole),
        pytest.param(["methods/rk4.gark.yaml", "methods/collocation.gark.yaml"], marks=in_whole),
        ["methods/rectangular.gark.yaml", "methods/stoermer-verlet.gark.yaml"],
        pytest.param(
            ["methods/three-colours.gark.yaml", "--slow", "1/4", "--fast", "2"], marks=in_whole
        ),
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


@in_whole
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


LATE = "not decided: it takes longer than --seconds"


def late(*_: object) -> None:
    """Work that the time is not enough for."""
    raise NotDecided(is_late=True)


def test_the_rest_is_decided_where_one_part_is_late(monkeypatch: pytest.MonkeyPatch) -> None:
    """A(α) of a method that is not A-stable; all other fields are the same."""
    path = "rk4"
    (before,) = json.loads(run(path, "--format", "json").output)["files"]
    monkeypatch.setattr("garkcli.stability.summary.largest_sector", late)
    (after,) = json.loads(run(path, "--format", "json").output)["files"]
    assert before | {"A_alpha": None} == after
    assert f"A(α)-stable                   {LATE}" in run(path).output


@pytest.mark.parametrize(
    ("part", "method", "label"),
    [
        ("usual_oscillator", "rk4", "oscillator stable, x = (hω)²"),
        ("algebraic_stability", "rk4", "algebraically stable"),
        ("linear_problems.is_a_stable", "gauss-2", "A-stable"),
        ("linear_problems.real_set", "rk4", "real axis"),
        ("ssp_coefficient", "rk4", "SSP coefficient"),
        ("stability_fraction", "methods/ark-ars222.gark.yaml", "R(z1, z2, …)"),
        ("additive_radius", "methods/ark-ars222.gark.yaml", "additive SSP radii"),
    ],
)
def test_what_is_late_is_not_decided(
    part: str, method: str, label: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each part by itself, in text and in JSON that keeps its schema."""
    monkeypatch.setattr(f"garkcli.stability.summary.{part}", late)
    text = " ".join(run(method).output.split())
    assert f"{label} {LATE}" in text
    data = json.loads(run(method, "--format", "json").output)
    assert not [*Draft7Validator(report_schema("stability")).iter_errors(data)]


def test_without_time_for_r_nothing_is_said(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """All else is about R: the exit code is that of what is not decided."""
    monkeypatch.setattr("garkcli.stability.linear.stability_function", late)
    monkeypatch.setattr("sys.argv", ["gark", "stability", "gauss-2"])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 3
    assert "not decided in the time there is" in capsys.readouterr().err


STIFFLY_ACCURATE = "A: [[41/43, 0], [6/43, 37/43]]\nb: [6/43, 37/43]\n"


def test_claims_that_are_late_are_not_decided(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """A clock on which every reading is 100 s later than the one before, and a method that no other test
    has decided already.
    """
    readings = count(step=100)
    monkeypatch.setattr("garkcli.deadline.os.times", lambda: (next(readings), 0, 0, 0, 0))
    path = tmp_path / "claims.gark.yaml"
    path.write_text(f"{STIFFLY_ACCURATE}expect: {{a-stable: true, l-stable: true}}\n")
    result = CliRunner().invoke(gark, ["check", str(path)])
    text = " ".join(result.output.split())
    reason = "found not decided; it takes longer than 10 s of processor time"
    for name in ("a-stable", "l-stable"):
        assert f"claim undecided {name}: expected true, {reason}" in text


def test_the_oscillator_is_read_aloud() -> None:
    """Alone it is the headline, with a colon before the interval; the root of its end is named."""
    assert run("stoermer-verlet").output.startswith(
        "stoermer-verlet: oscillator stable, x = (hω)²: 0 ≤ x < 4, hω to 2\n"
    )
    assert "oscillator stable, x = (hω)²  0 ≤ x ≤ 8, hω to 2.82" in run("rk4").output


def test_a_single_term_has_no_parentheses() -> None:
    """R of the implicit Euler method, and of the midpoint rule."""
    assert "  1 / (-z + 1)\n" in run("backward-euler").output
    assert " (z + 2) / (-z + 2)\n" in run("implicit-midpoint").output


def test_long_radicals_are_decimals(tmp_path: Path) -> None:
    """Heun's method of order 3 in decimals: the end of the interval on the imaginary axis is that of
    three digits in print, and the root of 33 digits is in JSON.
    """
    path = tmp_path / "heun.yaml"
    path.write_text("A: [[], [0.333333], [0, 0.666667]]\nb: [0.25, 0, 0.75]\n", encoding="utf-8")
    text = " ".join(run(str(path)).stdout.split())
    assert "|y| ≤ 1.73204907552, y² ≤ 2.999994… SSP" in text
    assert "sqrt" not in text
    (data,) = json.loads(run(str(path), "--format", "json").stdout)["files"]
    assert "sqrt(3086410493871142)" in data["imaginary_interval"]["to"]
