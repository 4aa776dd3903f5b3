"""``gark energy``: options, exit codes, formats."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from tests.cli.harness import gark
from tests.whole import in_whole

RECTANGULAR, RK4 = "methods/rectangular.gark.yaml", "methods/rk4.gark.yaml"
SHORT = ("--t-end", "60", "--step", "1/20")


def test_the_figure_of_the_paper_is_the_default() -> None:
    """The oscillator with h = 1/2 to t = 10⁴, bounded, with nothing but the file given."""
    run = gark("energy", RECTANGULAR)
    assert run.code == 0
    assert "to t = 10000" in run.out
    assert "20000 of 1/2, exact" in run.out
    assert "bounded for all time" in run.out
    assert run.out.startswith("the rectangular method: energy bounded\n")
    assert run.err == ""


def test_claims_decide_the_exit_code() -> None:
    """A drift is a finding; with --bounded it is a failed claim."""
    drifting = ("energy", RK4, "--problem", "kepler", *SHORT)
    assert gark(*drifting).code == 0
    failed = gark(*drifting, "--bounded")
    assert failed.code == 1
    assert "CLAIM FAILS bounded, found: energy drifts, angular momentum drifts" in " ".join(
        failed.out.split()
    )
    held = gark(
        "energy", RECTANGULAR, "--problem", "kepler", *SHORT, "--bounded", "--max-error", "1e-4"
    )
    assert held.code == 0
    assert held.out.count("claim holds") == 2


@pytest.mark.parametrize(("limit", "code"), [("1.13e-4", 0), ("1.12e-4", 1), ("1/9000", 1)])
def test_max_error(limit: str, code: int) -> None:
    """The largest error is 1.1201e-4."""
    assert gark("energy", RECTANGULAR, "--max-error", limit).code == code


def test_what_is_undecided_is_not_bounded() -> None:
    """A claim needs a run that is long enough: it neither holds nor fails, with exit code 3 as
    without it, but for a claim on the size of the error alone.
    """
    short = ("energy", RECTANGULAR, "--problem", "kepler", "--t-end", "5")
    run = gark(*short, "--bounded")
    assert run.code == 3
    assert "claim undecided bounded, found: energy undecided" in " ".join(run.out.split())
    data = json.loads(gark(*short, "--bounded", "--format", "json").out)
    assert [claim["holds"] for claim in data["claims"]] == [None]
    assert gark(*short).code == 3
    assert gark(*short, "--max-error", "1").code == 0
    assert gark(*short, "--bounded", "--max-error", "1e-50").code == 1


def test_blow_ups_and_failed_steps_are_failures(tmp_path: Path) -> None:
    """Exit code 1, with what has happened."""
    euler = tmp_path / "euler.gark.yaml"
    euler.write_text("ark: {A: [[[0]]], b: [[1]]}")
    run = gark("energy", str(euler), "--problem", "fput", "--format", "json")
    assert run.code == 1
    assert json.loads(run.out)["blew_up"]
    assert gark("energy", str(euler)).code == 1  # the oscillator
    euler.write_text("ark: {A: [[[1]]], b: [[1]]}")
    run = gark("energy", str(euler), "--problem", "kepler", "--step", "1/2")
    assert run.code == 1
    assert run.out == ""
    assert "step 1 of size 1/2: the stage equations were not solved" in run.err


def test_symplecticity_is_measured() -> None:
    """Far below the round-off of floats where the method is symplectic, and far above where it is
    not.
    """
    for path, proved, seen in ((RECTANGULAR, True, False), (RK4, False, True)):
        run = gark(
            "energy",
            path,
            "--problem",
            "henon-heiles",
            *SHORT,
            "--symplecticity",
            "--format",
            "json",
            "-q",
        )
        found = json.loads(run.out)["symplectic"]
        assert found["proved"] is proved
        assert len(found["defects"]) == 5
        assert all(
            x["good_to"] < 1e-45 and (x["size"] > x["good_to"]) is seen for x in found["defects"]
        )


@in_whole
def test_problem_files() -> None:
    """A problem of the user's own, with its invariants and ten thousand steps."""
    run = gark("energy", RECTANGULAR, "--problem", "problems/kepler.yaml", "--format", "json")
    data = json.loads(run.out)
    assert (data["steps"], data["drifts"]) == (10_000, False)
    assert [x["name"] for x in data["quantities"]] == ["energy", "angular momentum"]


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--digits", "30"), "--digits is not for the oscillator"),
        (("--problem", "kepler", "--omega", "2"), "--omega is for the oscillator"),
        (("--problem", "kepler", "--split", "1:0,0:1"), "--split is for the oscillator"),
        (("--problem", "kepler", "--seed", "2"), "--seed is for the problems generic"),
        (("--problem", "keppler"), "did you mean 'kepler'"),
        (("--t-end", "1", "--step", "0.3"), "not a whole number of steps"),
        (("--t-end", "0"), "a positive number is expected"),
        (("--step", "sqrt(2)"), "a rational number is expected"),
        (("--max-error", "-1"), "a positive number is expected"),
        (("--omega", "-1"), "a positive number is expected"),
        (("--plot", "figure.bmp"), "no figure can be saved"),
        (("--plot", "nowhere/figure.png"), "there is no such folder"),
        (("--points", "3"), "not in the range"),
        (("--digits", "1000"), "not in the range"),
        (("--problem", "generic"), "the method has no colour for that"),
        (("--t-end", "1e9"), "limit"),
    ],
)
def test_usage(options: tuple[str, ...], said: str) -> None:
    """Wrong use has exit code 2, a reason, and no report."""
    run = gark("energy", RECTANGULAR, *options)
    assert run.code == 2
    assert said in run.err
    assert run.out == ""


@in_whole
def test_figures_are_written(tmp_path: Path) -> None:
    """Nothing else is left behind; the test of the same name of gark converge tries all formats."""
    plot = str(tmp_path / "a.png")
    arguments = ("--problem", "kepler", *SHORT, "--plot", plot)
    run = gark("energy", RECTANGULAR, *arguments)
    assert run.code == 0
    assert f"wrote {tmp_path}" in run.err
    assert [x.name for x in tmp_path.iterdir()] == ["a.png"]


def test_csv_keeps_the_extremes() -> None:
    """As many rows as points, about, and the largest error among them."""
    run = gark("energy", RECTANGULAR, "--format", "csv", "--points", "100")
    head, *rows = run.out.splitlines()
    assert head == "t,energy_error"
    assert 90 <= len(rows) <= 100
    errors = [float(row.split(",")[1]) for row in rows]
    assert f"{max(map(abs, errors)):.4e}" == "1.1201e-04"
    assert (rows[0], rows[-1].split(",")[0]) == ("0.0,0.0", "10000.0")


@in_whole
def test_more_digits() -> None:
    """What floats hide is shown."""
    run = gark(
        "energy",
        "methods/gauss6-lobatto7.gark.yaml",
        "--problem",
        "pendulum",
        "--t-end",
        "40",
        "--digits",
        "40",
    )
    assert run.code == 0
    assert "400 of 1/10, 40 digits" in run.out
    assert "bounded: no drift" in run.out


def test_a_directory_is_no_method(tmp_path: Path) -> None:
    """One file is followed: a directory is refused, with one of its files as a proposal where it
    has any.
    """
    run = gark("energy", "methods")
    assert run.code == 2
    assert "methods: error[folder]: a directory, where one method file is expected" in run.err
    assert "such as methods/ark-ars222.gark.yaml" in run.err
    assert "no .gark.yaml files in this directory" in gark("energy", str(tmp_path)).err


def test_problem_at_rest(tmp_path: Path) -> None:
    """Where nothing moves nothing is seen: undecided, and no claim holds."""
    path = tmp_path / "rest.yaml"
    path.write_text(
        'variables: [x]\nhamiltonian: ["px**2/2", "1 - cos(x)"]\ninitial: {x: 0, px: 0}\n'
    )
    run = gark("energy", RECTANGULAR, "--problem", str(path), "--t-end", "100", "--step", "1/10")
    assert run.code == 3
    assert "undecided: the solution does not move; start elsewhere" in run.out
    claimed = ("--problem", str(path), "--t-end", "100", "--step", "1/10", "--bounded")
    assert gark("energy", RECTANGULAR, *claimed).code == 3


@pytest.mark.parametrize("method", ["rk4", "rounded"])
@pytest.mark.parametrize(
    ("field", "invariant"),
    [
        ("rhs: {x: px, px: -x}", "log(px)"),
        ("rhs: {x: px, px: -x}", "sqrt(px)"),
        ("hamiltonian: px**2/2 + x**2/2", "exp(exp(20*x))"),
    ],
)
def test_an_invariant_that_ends_first(
    tmp_path: Path, method: str, field: str, invariant: str
) -> None:
    """An invariant has no value from some time on, or none in floats: every format says so, also
    where the rounding of coefficients is weighed, and the plot shows what came before.
    """
    problem, rounded = tmp_path / "turning.yaml", tmp_path / "rounded.gark.yaml"
    problem.write_text(
        f"variables: [x{', px' if 'rhs' in field else ''}]\n{field}\n"
        f'initial: {{x: 1/10, px: 1}}\ninvariants: {{I: "{invariant}"}}\n'
    )
    rounded.write_text("{A: [[0, 0], [1, 0]], b: [0.5, 0.5], tolerance: 1e-6}")
    file = str(rounded) if method == "rounded" else method
    arguments = ("energy", file, "--problem", str(problem), "--step", "1/10", "--t-end", "20")
    shown = gark(*arguments)
    assert shown.code == 3
    assert "undecided: it has no value at t = " in shown.out
    assert "┤" in gark(*arguments, "-v").out
    *_, found = json.loads(gark(*arguments, "--format", "json").out)["quantities"]
    assert (found["verdict"], found["doubt"]) == ("undecided", "value")
    assert gark(*arguments, "--format", "csv").code == 3


def test_a_picture_has_the_name_of_the_method(tmp_path: Path) -> None:
    """The title says which method it shows, and on which problem."""
    path = tmp_path / "energy.svg"
    gark("energy", "rk4", "--t-end", "10", "--plot", str(path))
    drawn = path.read_text(encoding="utf-8")
    assert "the classical Runge-Kutta method" in drawn
    assert "Oscillator, h = " in drawn
