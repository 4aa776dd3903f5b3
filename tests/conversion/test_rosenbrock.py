"""Rosenbrock methods as papers print them and as programs store them are the same methods."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from flint import arb, fmpq

from garkcli.constructions.rosenbrock import Rosenbrock, rosenbrock, stored, transformed
from garkcli.conversion.convert import convert
from garkcli.conversion.sheet import CannotConvert
from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.load import load, loads
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole, sample

FILES = sorted((ROOT / "garkcli/catalogue/data/rosenbrock").glob("*.gark.yaml"))
WITH_ZERO = {"lassp-34", "llssp-34"}
"""Methods with stages without a linear system, which programs have no form for."""
SLOW = {"rodas5", "rodas5p"}
OTHER = {"printed": "transformed", "transformed": "printed"}
ROS2 = "{alpha: [[], [1]], gamma: [[1/2], [-1, 1/2]], b: [1/2, 1/2], embedded: [1, 0]}"


def stem(path: Path) -> str:
    """The name of a method."""
    return path.name.removesuffix(".gark.yaml")


def own_form(method: MethodFile) -> str:
    """The form of a file."""
    return "transformed" if "  transformed:" in method.text else "printed"


def numbers(method: MethodFile) -> Iterator[Number]:
    """All numbers that decide what a method does."""
    for row in (*method.tableau.rows, *(row for rows in method.further.rows for row in rows)):
        yield from row


@cache
def exact_files() -> list[Path]:
    """Methods with exact numbers, of which all claims are decided at once."""
    return [
        x for x in FILES if "tolerance" not in x.read_text("utf-8") and stem(x) not in WITH_ZERO
    ]


@pytest.mark.parametrize("path", exact_files(), ids=stem)
def test_exact_methods_come_back(path: Path) -> None:
    """The other form is the same method, its claims hold, and from there the first form comes
    back, each number equal.
    """
    method = load(str(path))
    there = convert(method, OTHER[own_form(method)])
    back = convert(there.method, own_form(method))
    for made in (there, back):
        assert not made.left_out
        assert made.method.tableau == method.tableau
        assert made.method.further == method.further
    assert own_form(there.method) != own_form(back.method) == own_form(method)


ROUNDED = [x for x in FILES if x not in exact_files() and stem(x) not in {*WITH_ZERO, *SLOW}]


@in_whole
@pytest.mark.parametrize("path", sample(ROUNDED, 5), ids=stem)
def test_rounded_methods_stay_within_what_their_files_say(path: Path) -> None:
    """The other form of a rounded file has all its claims within a tolerance, by less than which
    its numbers differ: they have more digits. Its own form has the decimals and the tolerance of
    the file.
    """
    method = load(str(path))
    there = convert(method, OTHER[own_form(method)])
    assert not there.left_out
    assert there.method.tolerance is not None
    for x, y in zip(numbers(method), numbers(there.method), strict=True):
        assert abs(to_ball(x - y, 40)) < arb(there.method.tolerance)
    same = convert(method, own_form(method)).method
    assert same.tableau == method.tableau
    assert same.tolerance == method.tolerance


def test_the_other_form_admits_all_methods_of_the_file() -> None:
    """Where each decimal of a file is moved to the ends of its tolerance, the numbers of the other
    form stay within its tolerance.
    """
    text = """
tolerance: 1e-6
rosenbrock: {alpha: [[], [1.0]], gamma: [[0.292893], [-0.585786, 0.292893]], b: [0.5, 0.5]}
"""
    made = convert(loads(text), "transformed").method
    assert made.tolerance is not None
    A, C, diagonal, m = _stored(made)
    shift = fmpq(1, 10**6)
    furthest = fmpq(0)
    for one in (-1, 1):
        for other in (-1, 1):
            g = fmpq(292893, 10**6) + one * shift
            h = fmpq(-585786, 10**6) + other * shift
            zero = fmpq(0)
            b = (fmpq(1, 2) + other * shift,) * 2
            moved = stored(
                rosenbrock(((zero, zero), (1 + one * shift, zero)), ((g, zero), (h, g)), b)
            )
            pairs = [(moved.A[1][0], A), (moved.C[1][0], C), (moved.gamma[0], diagonal)]
            pairs += zip(moved.m, m, strict=True)
            furthest = max(furthest, *(abs(x - y) for x, y in pairs))
    assert made.tolerance / 3 < furthest <= made.tolerance


def _stored(method: MethodFile) -> tuple[fmpq, fmpq, fmpq, tuple[fmpq, ...]]:
    found = stored(Rosenbrock.of(method.tableau))
    return found.A[1][0], found.C[1][0], found.gamma[0], found.m


def test_program_form_of_random_methods() -> None:
    """A = α Γ⁻¹, C and m are those of the definition: the stages u = Γ k of a linear problem are
    the same by both, and ``transformed`` is the inverse of ``stored``.
    """
    alpha = ((fmpq(0),) * 3, (fmpq(1, 3), fmpq(0), fmpq(0)), (fmpq(2), fmpq(-1, 5), fmpq(0)))
    gamma = (
        (fmpq(1, 2), fmpq(0), fmpq(0)),
        (fmpq(4), fmpq(1, 3), fmpq(0)),
        (fmpq(-1), fmpq(7, 2), fmpq(2)),
    )
    b = (fmpq(1, 7), fmpq(2, 7), fmpq(5))
    method = rosenbrock(alpha, gamma, b)
    found = stored(method)
    assert transformed(found.A, found.C, found.gamma, found.m) == method
    z = fmpq(3, 11)
    k: list[fmpq] = []
    u: list[fmpq] = []
    for i in range(3):
        # k_i = z (1 + Σ (α_ij + γ_ij) k_j), and (1/γ_ii − z) u_i = z (1 + Σ A_ij u_j) + Σ C_ij u_j
        known = sum(((alpha[i][j] + gamma[i][j]) * k[j] for j in range(i)), fmpq(0))
        k.append(z * (1 + known) / (1 - z * gamma[i][i]))
        before = sum((found.A[i][j] * u[j] for j in range(i)), fmpq(0))
        linear = sum((found.C[i][j] * u[j] for j in range(i)), fmpq(0))
        u.append((z * (1 + before) + linear) / (1 / found.gamma[i] - z))
    by_k = sum((x * y for x, y in zip(b, k, strict=True)), fmpq(0))
    assert by_k == sum((x * y for x, y in zip(found.m, u, strict=True)), fmpq(0))


@pytest.mark.parametrize("path", [x for x in FILES if stem(x) in WITH_ZERO], ids=stem)
def test_no_program_form_with_a_zero(path: Path) -> None:
    """Programs divide by the γ_ii."""
    with pytest.raises(CannotConvert, match="programs divide by it"):
        convert(load(str(path)), "transformed")


@pytest.mark.parametrize(
    ("method", "to", "stages", "why"),
    [
        ("ros3p", "ark", None, "a Rosenbrock method has no form ark"),
        ("ros3p", "recovered", None, "has no form recovered"),
        ("ros3p", "printed", 5, "has a γ, which is not 0"),
        ("rk4", "transformed", None, "for Rosenbrock methods"),
    ],
)
def test_refusals_say_why(method: str, to: str, stages: int | None, why: str) -> None:
    """Forms of other kinds are refused."""
    with pytest.raises(CannotConvert, match=why):
        convert(load(method), to, stages)


def test_command(tmp_path: Path) -> None:
    """The command writes a file that gark checks, with the parameters as numbers; the default is
    the form of the file.
    """
    file = tmp_path / "ros2.gark.yaml"
    file.write_text(f"rosenbrock: {ROS2}\nexpect: {{order: 2, embedded-order: 1}}\n", "utf-8")
    made = tmp_path / "made.gark.yaml"
    assert gark("convert", str(file), "--to", "transformed", "-o", str(made)).code == 0
    assert gark("check", str(made)).code == 0
    text = made.read_text("utf-8")
    assert "    A:\n      - []\n      - [2]\n" in text
    assert "    e: [1, 1]\n" in text
    assert "  transformed:" in gark("convert", str(made)).out
    assert "  transformed:" not in gark("convert", str(file)).out
