"""Reference solutions against solutions that are known."""

from __future__ import annotations

import pytest
from flint import arb, ctx, fmpq

from garkcli.convergence import reference as module
from garkcli.convergence.reference import ReferenceSolution, magnitude, reference
from garkcli.doing import telling
from garkcli.errors import UsageProblem
from garkcli.problems.builtin import hamiltonian
from garkcli.problems.files.load import loads_problem
from garkcli.stepping.integrator import StepFailed
from tests.listener import Listener
from tests.whole import in_whole, sample


@in_whole
def test_period_of_kepler() -> None:
    """After its period the planet is where it began, to the digits asked for."""
    problem = hamiltonian("kepler", 2)
    with ctx.workprec(300):
        period = 2 * arb.pi()
        near = fmpq(int((period * 10**60).floor().unique_fmpz() or 0), 10**60)
    for digits in sample([16, 30], 2):
        end = reference(problem, near).to(digits)
        with ctx.workprec(300):
            assert (
                max(abs(a - arb(b)) for a, b in zip(end, problem.initial, strict=True))
                < arb(10) ** -digits
            )


@in_whole
@pytest.mark.parametrize(
    ("digits", "t_end"),
    sample([(16, fmpq(30)), (25, fmpq(30)), (16, fmpq(2)), (40, fmpq(2)), (25, fmpq(1, 10))], 3),
    ids=str,
)
def test_linear_springs(digits: int, t_end: fmpq) -> None:
    """The split oscillator is x'' = −x + 25/4 (y − x), y'' = −25/4 (y − x): solved by its
    eigenvectors.
    """
    problem = hamiltonian("split-oscillator", 2)
    found = ReferenceSolution(problem.unsplit(), t_end).to(digits)
    with ctx.workprec(400):
        k = arb(25) / 4
        root = (1 + 4 * k * k).sqrt()
        expected = [arb(0)] * 4
        x, y, px, py = (arb(z) for z in problem.initial)
        for sign in (1, -1):
            rate = (1 + 2 * k + sign * root) / 2  # the squared frequency
            direction = (k - rate) / k  # of x where y is 1, from the second equation
            norm = direction**2 + 1
            q, p = (direction * x + y) / norm, (direction * px + py) / norm
            w = rate.sqrt()
            now = q * (w * t_end).cos() + p / w * (w * t_end).sin()
            speed = p * (w * t_end).cos() - w * q * (w * t_end).sin()
            for i, part in enumerate((direction * now, now, direction * speed, speed)):
                expected[i] += part
        allowed = arb(10) ** -digits * magnitude(found, problem)
        assert max(abs(a - b) for a, b in zip(found, expected, strict=True)) < allowed


def test_all_splits_share_one_solution() -> None:
    """Two and three terms of the pendulum, one computation; more digits once are enough for fewer
    later.
    """
    two, three = (reference(hamiltonian("pendulum", n), fmpq(1)) for n in (2, 3))
    assert two is three
    two.to(30)
    assert two.to(20) == two.y
    assert two.digits == 30


def test_how_far_it_is_can_be_seen() -> None:
    """What is computed is told, with the number of steps; in the end all of them are done."""
    who = Listener()
    with telling(who):
        ReferenceSolution(hamiltonian("pendulum", 1), fmpq(1)).to(18)
    steps = [work for work in who.told if work.total is not None]
    assert {work.what for work in steps} == {"reference solution, 18 digits"}
    assert steps
    assert all(work.done == work.total for work in steps)


@in_whole
@pytest.mark.parametrize("digits", sample([16, 21], 2))
def test_collision_has_no_solution(digits: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """A planet without angular momentum falls into the sun at t = π/√8: nothing is made up
    beyond, however few steps are tried.
    """
    from garkcli.frozen import replace

    monkeypatch.setattr(module, "MAX_TRIED", 200)
    monkeypatch.setattr(module, "_REFINED", 8)
    problem = replace(hamiltonian("kepler", 1), initial=(fmpq(1), fmpq(0), fmpq(0), fmpq(0)))
    with pytest.raises((StepFailed, UsageProblem)):
        ReferenceSolution(problem, fmpq(2)).to(digits)


@in_whole
def test_a_solution_that_ends_is_told_when() -> None:
    """q̈ = 4q³ leaves every bound at ∫ dq/√(2q⁴ − 1) from 1 to ∞, 0.7531…: that is told, no step
    size.
    """
    from garkcli.frozen import replace
    from garkcli.problems.vectorfield import symbols

    ((x,), (p,)) = (symbols(("x",), group) for group in ("q", "p"))
    problem = replace(
        hamiltonian("pendulum", 2), terms=(p**2 / 2, -(x**4)), initial=(fmpq(1), fmpq(1))
    )
    with pytest.raises(
        UsageProblem, match=r"no solution is found at t = 2: .* fail at t = 0\.75"
    ) as told:
        ReferenceSolution(problem.unsplit(), fmpq(2)).to(16)
    assert "final time before 0.75" in (told.value.help or "")


@in_whole
def test_what_is_not_smooth_is_seen_by_its_error() -> None:
    """At t = 0 sqrt(t) has no derivative: the error falls like the power 3/2 of the step, and far
    fewer steps than are allowed tell that these would not do.
    """
    problem = loads_problem("{variables: [y], rhs: {y: sqrt(t)*y}, initial: {y: 1}, t_end: 1}")
    with telling(listener := Listener()), pytest.raises(UsageProblem, match="hardly reduce"):
        ReferenceSolution(problem, fmpq(1)).to(21)
    assert max(work.total or 0 for work in listener.told) < module.MAX_STEPS // 50


def test_search_has_an_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """With too few steps allowed it is said, with the time and the digits."""
    monkeypatch.setattr(module, "MAX_STEPS", 10)
    with pytest.raises(UsageProblem, match="t = 2 is not found to 40 digits in 10 steps"):
        ReferenceSolution(hamiltonian("kepler", 1), fmpq(2)).to(40)
