"""Reports and figures of conserved quantities over a long time."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from flint import fmpq

from garkcli.frozen import replace
from garkcli.longtime.history import LongRun
from garkcli.longtime.longtime import long_run
from garkcli.longtime.symplecticity import Defect, Symplecticity
from garkcli.methodfile.load import load
from garkcli.plots.curves import energy_scene
from garkcli.plots.figure import figure as draw
from garkcli.plots.saving import save_scene
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.report.energy import REPORT, EnergyReport, RunClaim
from garkcli.stepping.fields import with_joined_terms
from tests.whole import in_whole

ROOT = Path(__file__).parents[2]
RECTANGULAR, RK4 = (str(ROOT / "methods" / f"{name}.gark.yaml") for name in ("rectangular", "rk4"))
GAUSS = str(ROOT / "tests" / "examples" / "valid" / "smallest.gark.yaml")


def oscillator(path: str, t_end: int = 100) -> LongRun:
    """The energy of the oscillator."""
    tableau = load(path).tableau
    problem = Oscillator.default(terms_of(tableau), fmpq(1))
    return long_run(tableau, problem, fmpq(t_end), fmpq(1, 2))


def nonlinear(path: str, name: str, t_end: int, inverse_step: int = 20) -> LongRun:
    """Another problem."""
    tableau = with_joined_terms(load(path).tableau)
    return long_run(
        tableau, hamiltonian(name, terms_of(tableau)), fmpq(t_end), fmpq(1, inverse_step)
    )


@cache
def kepler() -> LongRun:
    """A run that stays."""
    return nonlinear(RECTANGULAR, "kepler", 100)


@cache
def falling() -> LongRun:
    """The same, drifting."""
    return nonlinear(RK4, "kepler", 100)


def text(
    run: LongRun, symplecticity: Symplecticity | None = None, claims: tuple[RunClaim, ...] = ()
) -> str:
    """The report for people, with everything."""
    report = EnergyReport("m", run, symplecticity or Symplecticity(True), claims)
    return REPORT.render([report], verbosity=1)


def joined(text: str) -> str:
    """A text in one line."""
    return " ".join(text.split())


def test_noise_is_not_drawn() -> None:
    """Errors below round-off are others on every machine: there is no plot of them."""
    run = nonlinear(RK4, "kepler", 1, 2000)
    assert run.energy is not None
    assert run.energy.verdict == "round-off"
    assert "┤" not in text(run)


@pytest.mark.parametrize(
    ("run", "said"),
    [
        (lambda: oscillator(RECTANGULAR), "bounded for all time: det R(h) = 1 and |tr R(h)| < 2,"),
        (lambda: oscillator(RK4), "DRIFTS: det R(h) − 1 = -0.0002102, the energy decays for"),
        (lambda: oscillator(GAUSS), "conserved by every step, exactly"),
        (kepler, "bounded: no drift beyond its uncertainty"),
        (kepler, "no error above round-off, at most"),
        (falling, "DRIFTS: the slope is"),
        (lambda: nonlinear(RECTANGULAR, "kepler", 2), "undecided: fewer than 64 steps"),
        (
            lambda: nonlinear(RECTANGULAR, "kepler", 10),
            "undecided: the motion turns back 3 times only;",
        ),
        (lambda: nonlinear(RK4, "fput", 100), "DRIFTS: "),
    ],
)
def test_verdicts(run: Callable[[], LongRun], said: str) -> None:
    """Each verdict is said in its words, within 80 columns."""
    found = text(run())
    assert said in joined(found)
    assert max(map(len, found.splitlines())) <= 80


def test_what_is_said_of_blow_ups() -> None:
    """When it happened; no drift, no oscillation."""
    history = replace(
        kepler().invariants[0], verdict="unstable", drift=None, uncertainty=None, max_error=1e30
    )
    found = text(replace(kepler(), invariants=(history,), steps=7))
    assert "UNSTABLE: blown up after 7 steps, at t = 0.35" in found
    assert "oscillation" not in found
    assert "drift " not in found


@pytest.mark.parametrize(
    ("symplecticity", "said"),
    [
        (Symplecticity(True), "yes, by its coefficients"),
        (Symplecticity(False), "not proved by its coefficients; --symplecticity measures"),
        (
            Symplecticity(False, (Defect(fmpq(0), 1e-60, 2e-55),)),
            "not proved by its coefficients; MᵀJM − J is below",
        ),
        (Symplecticity(False, (Defect(fmpq(0), 0.25, 1e-55),)), "symplectic no; MᵀJM − J"),
        (
            Symplecticity(False, (Defect(fmpq(0), 0.25, 1e-55),)),
            "has entries up to 2.500e-01, good to 1e-55",
        ),
        (
            Symplecticity(False, (Defect(fmpq(0), 1e-60, 2e-55), Defect(fmpq(5), 0, 3e-55))),
            "is below 1e-54",
        ),
        (
            Symplecticity(False, (Defect(fmpq(0), 1e-60, 2e-55), Defect(fmpq(5), 1, 3e-55))),
            "t = 0, 5",
        ),
    ],
)
def test_symplecticity(symplecticity: Symplecticity, said: str) -> None:
    """What is proved, what is measured; what is small is below something, not zero."""
    assert said in joined(text(kepler(), symplecticity))


def test_claims() -> None:
    """Each with its verdict, and what was found where it fails."""
    found = text(
        falling(),
        claims=(RunClaim("bounded", "energy drifts", False), RunClaim("max-error: 1", "", True)),
    )
    assert "CLAIM FAILS bounded, found: energy drifts" in joined(found)
    assert "claim holds max-error: 1 " in joined(found)


def test_the_plot_is_a_detail() -> None:
    """The usual report ends before it, a quiet one is the answer."""
    report = EnergyReport("m", kepler(), Symplecticity(True))
    assert "┤" in REPORT.render([report], verbosity=1)
    assert "┤" not in REPORT.render([report])
    quiet = REPORT.render([report], verbosity=-1)
    assert quiet == "m: energy bounded, angular momentum no error above round-off\n"


@pytest.mark.parametrize(
    "make", [kepler, falling, lambda: oscillator(RECTANGULAR), lambda: oscillator(GAUSS)]
)
def test_json(make: Callable[[], LongRun]) -> None:
    """The same numbers, under names that stay."""
    run = make()
    claims = (RunClaim("bounded", "bounded", True),)
    measured = Symplecticity(False, (Defect(fmpq(1, 2), 0.25, 1e-55),))
    data = json.loads(REPORT.render([EnergyReport("m", run, measured, claims)], "json"))
    assert data["schema"] == "gark/energy/1"
    assert (data["step_exact"], data["steps"], data["drifts"]) == (
        str(run.step),
        run.steps,
        run.drifts,
    )
    assert ("hamiltonian" in data) == (data["problem"] == "kepler") == (data["digits"] is not None)
    assert (
        ("omega" in data)
        == ("determinant_minus_1" in data["symplectic"])
        == (data["problem"] == "oscillator")
    )
    assert [x["name"] for x in data["quantities"]] == [x.name for x in run.invariants]
    for found, history in zip(data["quantities"], run.invariants, strict=True):
        assert (found["max_error"], found["drift"], found["verdict"]) == (
            history.max_error,
            history.drift,
            history.verdict,
        )
        assert found["drift_in_all"] == pytest.approx(history.drift * run.end)
    assert data["symplectic"]["defects"] == [{"t": 0.5, "size": 0.25, "good_to": 1e-55}]
    assert data["claims"] == [{"claim": "bounded", "found": "bounded", "holds": True}]


def test_json_of_blow_ups_has_no_infinities() -> None:
    """What is not known is null."""
    history = replace(kepler().invariants[0], verdict="unstable", drift=None, uncertainty=None)
    data = json.loads(
        REPORT.render(
            [EnergyReport("m", replace(kepler(), invariants=(history,)), Symplecticity(True))],
            "json",
        )
    )
    found = data["quantities"][0]
    assert (found["drift"], found["drift_uncertainty"], found["drift_in_all"]) == (None, None, None)
    assert data["blew_up"]


def test_csv() -> None:
    """Every time kept, with the errors of all quantities, to the last digit."""
    rows = list(
        csv.reader(
            io.StringIO(REPORT.render([EnergyReport("m", kepler(), Symplecticity(True))], "csv"))
        )
    )
    assert rows[0] == ["t", "energy_error", "angular_momentum_error"]
    assert [float(row[0]) for row in rows[1:]] == list(kepler().times)
    for k, history in enumerate(kepler().invariants, start=1):
        assert [float(row[k]) for row in rows[1:]] == list(history.errors)


def test_csv_of_awkward_names() -> None:
    """A name with a comma or a quotation mark is one column."""
    history = replace(kepler().invariants[0], name='L, "z"')
    rows = list(
        csv.reader(
            io.StringIO(
                REPORT.render(
                    [
                        EnergyReport(
                            "m", replace(kepler(), invariants=(history,)), Symplecticity(True)
                        )
                    ],
                    "csv",
                )
            )
        )
    )
    assert rows[0] == ["t", 'L,_"z"_error']
    assert {len(row) for row in rows} == {2}


@in_whole
def test_figures_are_the_same_each_time(tmp_path: Path) -> None:
    """Byte by byte, so that a repository of figures does not change without a reason.

    The other formats are written in the same way, see the test of the same name of gark converge.
    """
    suffix = ".svg"
    for name in ("one", "two"):
        save_scene(energy_scene(falling()), tmp_path / f"{name}{suffix}")
    one, two = ((tmp_path / f"{name}{suffix}").read_bytes() for name in ("one", "two"))
    assert one == two
    assert len(one) > 5000


def test_figures_show_all_quantities() -> None:
    """A panel each, with its errors; a dashed line where there is a drift, told apart without
    colour.
    """
    bounded, drifting = draw(energy_scene(kepler())), draw(energy_scene(falling()))
    assert [len(axes.get_lines()) for axes in bounded.axes] == [2, 2]
    assert [len(axes.get_lines()) for axes in drifting.axes] == [3, 3]
    for axes, history in zip(drifting.axes, falling().invariants, strict=True):
        errors, line, _ = axes.get_lines()
        scale = history.errors[-1] / errors.get_ydata()[-1]
        assert scale == pytest.approx(10.0 ** round(float(np.log10(scale))))
        assert scale * errors.get_ydata() == pytest.approx(history.errors)
        assert errors.get_linestyle() == "-"
        assert line.is_dashed()
        assert history.name in axes.get_title(loc="left")
        (t0, t1), (e0, e1) = line.get_xdata(), line.get_ydata()
        assert scale * (e1 - e0) / (t1 - t0) == pytest.approx(history.drift)


def test_names_are_no_formulas(tmp_path: Path) -> None:
    """A name with dollars is drawn as it stands."""
    run = kepler()
    assert not isinstance(run.problem, Oscillator)
    history = replace(run.invariants[0], name=r"$\frac{ _^ $")
    named = replace(run, problem=replace(run.problem, name="$x^{ $"), invariants=(history,))
    save_scene(energy_scene(named), tmp_path / "a.svg")
    assert (tmp_path / "a.svg").stat().st_size > 5000
