"""``gark converge`` and ``gark energy`` on problems that are not Hamiltonian."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path

import pytest

from tests.cli.harness import gark

ARS = "methods/ark-ars222.gark.yaml"
RK4 = "methods/rk4.gark.yaml"
BODY = "problems/rigid-body.yaml"
PROTHERO = "problems/prothero-robinson.yaml"


def test_the_slope_that_stiffness_leaves() -> None:
    """Beside the classical order and the stage order, as text and as JSON; exit code 0."""
    options = ("--problem", "prothero-robinson", "--stiffness", "1e6")
    text = gark("converge", ARS, *options)
    assert text.code == 0, text.err
    assert "reduced by stiffness" in text.out
    assert "classical order 2, stage order 1" in " ".join(text.out.split())
    assert "energy error" not in text.out
    data = json.loads(gark("converge", ARS, *options, "--format", "json").out)
    assert data["verdict"] == "reduced"
    assert data["agrees"] is False
    assert data["stiffness"] == "1000000"
    assert data["stiff"]["classical_order"] == 2
    assert data["stiff"]["stage_order"] == 1
    assert data["stiff"]["slope"] == data["observed_order"] == pytest.approx(1, abs=0.1)
    assert data["short"]["observed_order"] == pytest.approx(2, abs=0.05)
    assert {step["energy_error"] for step in data["steps"]} == {None}


def test_files_and_built_in_problems_are_the_same() -> None:
    """The same errors for the same stiffness."""
    steps = ("--steps", "1/4,1/8", "--stiffness", "100", "--format", "csv")
    own = gark("converge", ARS, "--problem", PROTHERO, *steps)
    built_in = gark("converge", ARS, "--problem", "prothero-robinson", *steps)
    assert own.code == built_in.code
    assert own.out == built_in.out
    first = next(csv.reader(io.StringIO(own.out)))
    assert first == ["h", "h_exact", "error", "slope", "digits"]


def test_methods_are_compared() -> None:
    """An explicit one, an IMEX one and a GARK method of one file, on one problem."""
    files = (ARS, RK4, "methods/collocation.gark.yaml")
    run = gark("converge", *files, "--problem", "van-der-pol", "--format", "json")
    assert run.code == 0, run.err
    results = json.loads(run.out)["results"]
    assert [x["observed_order"] for x in results] == pytest.approx([2, 4, 4], abs=0.05)
    assert "van-der-pol, stiffness 1" in gark("converge", ARS, RK4, "--problem", "van-der-pol").out


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--stiffness", "10"), "--stiffness is for a problem that has one"),
        (("--problem", "kepler", "--stiffness", "10"), "not for kepler"),
        (("--problem", "van-der-pol", "--stiffness", "0"), "a positive number"),
        (("--problem", "van-der-pol", "--seed", "3"), "--seed is for"),
        (("--problem", BODY, "--stiffness", "3"), "no parameter called stiffness"),
    ],
)
def test_stiffness_that_would_change_nothing(options: tuple[str, ...], message: str) -> None:
    """Is refused, with the problems that have one."""
    run = gark("converge", ARS, *options)
    assert run.code == 2
    assert message in run.err


def test_momenta_are_for_hamiltonian_problems() -> None:
    """A method that drives positions and momenta."""
    run = gark("converge", "methods/stoermer-verlet.gark.yaml", "--problem", "van-der-pol")
    assert run.code == 2
    assert "drives positions and momenta" in run.err


def test_invariants_are_followed() -> None:
    """RK4 loses both quadratic invariants of the rigid body, the implicit midpoint rule keeps them."""
    options = ("--problem", BODY, "--t-end", "100", "--step", "1/10")
    run = gark("energy", RK4, *options, "--format", "json")
    assert run.code == 0, run.err
    found = json.loads(run.out)
    names = [x["name"] for x in found["quantities"]]
    assert names == ["momentum", "kinetic energy"]
    assert {x["verdict"] for x in found["quantities"]} == {"drifts"}
    assert found["symplectic"] is None
    text = gark("energy", RK4, *options)
    assert text.out.splitlines()[0].endswith(": momentum DRIFTS, kinetic energy DRIFTS")
    assert "symplectic" not in text.out
    assert gark("energy", RK4, *options, "--bounded").code == 1
    assert gark("energy", RK4, *options, "--max-error", "1e-20").code == 1


def test_the_midpoint_rule_keeps_quadratic_invariants(tmp_path: Path) -> None:
    """To round-off."""
    file = tmp_path / "midpoint.gark.yaml"
    file.write_text("methods: [{family: gauss, stages: 1}]\n", encoding="utf-8")
    run = gark(
        "energy",
        str(file),
        "--problem",
        BODY,
        "--t-end",
        "100",
        "--step",
        "1/10",
        "--bounded",
        "--format",
        "json",
    )
    assert run.code == 0, run.err
    verdicts = {x["verdict"] for x in json.loads(run.out)["quantities"]}
    assert verdicts <= {"round-off", "bounded"}


def test_nothing_to_follow() -> None:
    """Without invariants, and symplecticity of what is not Hamiltonian: refused with the cure."""
    run = gark("energy", RK4, "--problem", "van-der-pol")
    assert run.code == 2
    assert "no energy and no invariants" in run.err
    assert "give invariants" in run.err
    run = gark("energy", RK4, "--problem", BODY, "--symplecticity")
    assert run.code == 2
    assert "--symplecticity is for Hamiltonian problems" in run.err


def test_the_list_has_them() -> None:
    """``gark list`` shows all built-in problems."""
    names = {x["name"] for x in json.loads(gark("list", "--format", "json").out)["problems"]}
    assert names >= {"prothero-robinson", "van-der-pol", "reaction-diffusion", "generic-rhs"}
