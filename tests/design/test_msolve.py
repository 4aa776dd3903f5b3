"""msolve as a second engine: what it says is verified, and what is not proved is said."""

from __future__ import annotations

import sys
from importlib import metadata
from pathlib import Path
from typing import Any

import pytest
from flint import Ordering, fmpq, fmpq_mpoly, fmpz_mpoly, fmpz_mpoly_ctx

from garkcli.deadline import within
from garkcli.design import design, groebner, msolve
from garkcli.design.design import Design, find_parameters
from garkcli.design.ideal import Ideal
from garkcli.design.solutions import value_at
from garkcli.errors import NotDecided
from garkcli.exact.parametric import fraction
from garkcli.methodfile.family import loads_family
from garkcli.report.design import REPORT, DesignReport
from tests.whole import in_whole

CONTEXT = fmpz_mpoly_ctx.get(("x", "y"), Ordering.degrevlex)
X, Y = CONTEXT.gens()
CIRCLE = [X**2 + Y**2 - 1, 3 * X * Y - 1]
BASIS = "[3*x1*x2-1, \nx1^2+x2^2-1, \n3*x2^3+x1-3*x2]:"
FULL3 = "unknown: {stages: 3, shape: full}\n"
EXPLICIT4 = "unknown: {stages: 4, shape: explicit}\n"


def program(folder: Path, answer: str, ending: str = "") -> str:
    """A program that answers every question with the same text."""
    path = folder / "msolve"
    lines = [
        f"#!{sys.executable}",
        "import sys",
        ending,
        "place = sys.argv[sys.argv.index('-o') + 1]",
        f"open(place, 'w').write({answer!r})",
    ]
    path.write_text("\n".join(lines), encoding="utf-8")
    path.chmod(0o755)
    return str(path)


@pytest.mark.skipif(sys.platform == "win32", reason="a script is no program there")
def test_a_right_answer_is_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Comments are passed over, and the basis is that of python-flint."""
    path = program(tmp_path, f"#Reduced Groebner basis data\n#---\n{BASIS}\n")
    monkeypatch.setattr(groebner, "find_msolve", lambda: path)
    found = groebner.unproved_basis(CIRCLE, CONTEXT)
    own = groebner.groebner_basis(CIRCLE, CONTEXT)
    assert sorted(map(str, found)) == sorted(map(str, own))


def test_the_program_of_the_package_is_the_one_among_its_binaries(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whatever else has its name; without the package the search path is asked."""
    files = [metadata.PackagePath(f"wheel/{x}/msolve") for x in ("share", "bin", "doc")]
    for file in files:
        file.dist = metadata.PathDistribution(tmp_path / "wheel.dist-info")
    monkeypatch.setattr(msolve, "which", lambda name: f"on the path: {name}")
    monkeypatch.setattr(metadata, "files", {msolve.PACKAGE: files}.get)
    assert msolve.find_msolve() == str(tmp_path / "wheel/bin/msolve")
    monkeypatch.setattr(metadata, "files", {msolve.PACKAGE: files[::2]}.get)
    assert msolve.find_msolve() == "on the path: msolve"


@pytest.mark.skipif(sys.platform == "win32", reason="a script is no program there")
@pytest.mark.parametrize("is_there", [True, False])
def test_msolve_has_what_python_flint_leaves_of_the_time(
    is_there: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """2a = 1, of the midpoint rule: python-flint has no time here where msolve is there, whose
    answer is not proved to be all; without msolve it has the whole time, and proves its own.
    """
    path = program(tmp_path, "[2*x1-1]:")
    for module in (design, groebner):
        monkeypatch.setattr(module, "find_msolve", lambda: path if is_there else None)
    monkeypatch.setattr(design, "SHARE", 0.0)
    last = find_parameters(loads_family('A: [["?"]]\nb: [1]\n'), 2, seconds=60).last
    assert last.ideal is not None
    assert (last.kind, last.ideal.is_proved) == ("solutions", not is_there)
    [one] = last.found
    assert one.solution.values == {"a11": fmpq(1, 2)}


WRONG = {
    "no basis of it": "[x1-1, x2]:",
    "no Gröbner basis": "[3*x1*x2-1, x1^2+x2^2-1]:",
    "infinitely many": "[1, 2, -1, []]:",
    "no answer": "",
    "nonsense": "[x1+sin(x2)]:",
    "another unknown": "[x3]:",
}


@pytest.mark.skipif(sys.platform == "win32", reason="a script is no program there")
@pytest.mark.parametrize("answer", WRONG.values(), ids=WRONG.keys())
def test_a_wrong_answer_is_not(
    answer: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A basis of something else, of nothing, or no basis leaves the question open."""
    path = program(tmp_path, answer)
    monkeypatch.setattr(groebner, "find_msolve", lambda: path)
    with pytest.raises(NotDecided):
        groebner.unproved_basis(CIRCLE, CONTEXT)


@pytest.mark.parametrize("way", [groebner._at_once, groebner._in_turn])
def test_the_fewest_polynomials_without_a_common_zero(way: Any) -> None:
    """X, Y and 2 X + 3 Y have the origin in common; the fourth misses it, the fifth is not used."""
    polynomials = [X, Y, 2 * X + 3 * Y, X * Y - 1, X + 1]
    basis, used = way([], polynomials, CONTEXT, False)
    assert ([str(p) for p in basis], used) == (["1"], 4)
    basis, used = way([], polynomials[:3], CONTEXT, False)
    assert (sorted(map(str, basis)), used) == (["x", "y"], 3)


@pytest.mark.skipif(sys.platform == "win32", reason="a script is no program there")
@pytest.mark.parametrize(
    "ending", ["sys.exit(1)", "import time; time.sleep(60)", "raise MemoryError"]
)
def test_a_program_that_fails_leaves_it_open(
    ending: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A code, no end in time, a crash: not decided, and nothing else."""
    path = program(tmp_path, BASIS, ending)
    monkeypatch.setattr(groebner, "find_msolve", lambda: path)
    with within(0.5), pytest.raises(NotDecided):
        groebner.unproved_basis(CIRCLE, CONTEXT)


def test_a_question_has_no_sign_in_front() -> None:
    """A leading plus ends the program; unknowns have names of ours."""
    text = msolve._question([X - 1, -Y + 2], CONTEXT)
    assert text == "x1,x2\n0\n1*x1^1-1,\n-1*x2^1+2\n"


def _by_msolve(text: str, order: int, monkeypatch: pytest.MonkeyPatch) -> Design:
    """A design by msolve alone, where it is installed."""
    if msolve.find_msolve() is None:
        pytest.skip("msolve is not installed")
    monkeypatch.setattr(design, "SHARE", 0.001)
    return find_parameters(loads_family(text), order, seconds=100)


def test_gauss_from_three_stages(monkeypatch: pytest.MonkeyPatch) -> None:
    """Three stages of order 6, twelve unknowns: Gauss's method in the six orders of its stages."""
    found = _by_msolve(FULL3, 6, monkeypatch)
    nodes = []
    for one in found.last.found:
        assert one.order is not None
        assert one.order.order == 6
        for root in one.solution.real:
            values = [value_at(one.solution.values[f"c{i}"], root) for i in (1, 2, 3)]
            nodes.append(tuple(float(value.ball(80)) for value in values))
    gauss = (0.1127016654, 0.5, 0.8872983346)
    assert len(nodes) == 6
    for found_nodes in nodes:
        assert sorted(found_nodes) == pytest.approx(gauss)
    text = REPORT.render([DesignReport("full.yaml", found)])
    assert "that there are no others is not" in " ".join(text.split())


CLASSICAL = {"RK4": {"c2": "1/2", "c3": "1/2"}, "3/8 rule": {"c2": "1/3", "c3": "2/3"}}


@pytest.mark.parametrize("name", CLASSICAL)
def test_classical_methods_of_four_stages(name: str) -> None:
    """With the nodes of Kutta's 3/8 rule there is that method; with those of the classical one
    a family with b₃ free, in which 1/3 gives it.
    """
    nodes = CLASSICAL[name]
    found = find_parameters(loads_family(EXPLICIT4, settings=nodes), 4, seconds=30)
    if name == "RK4":
        assert found.last.ideal is not None
        assert (found.last.kind, found.last.ideal.dimension) == ("family", 1)
        nodes = {**nodes, "b3": "1/3"}
        found = find_parameters(loads_family(EXPLICIT4, settings=nodes), 4, seconds=30)
    (one,) = found.last.found
    values = {x: str(value) for x, value in one.solution.values.items()}
    if name == "RK4":
        assert values == {
            "c4": "1", "a32": "1/2", "a42": "0", "a43": "1", "b1": "1/6", "b2": "1/3", "b4": "1/6",
        }  # fmt: skip
    else:
        assert values == {
            "c4": "1", "a32": "1", "a42": "-1", "a43": "1", "b1": "1/8", "b2": "3/8", "b3": "3/8", "b4": "1/8",
        }  # fmt: skip


RK4 = {"c2": "1/2", "c3": "1/2", "c4": "1", "a32": "1/2", "a42": "0", "a43": "1",
       "b1": "1/6", "b2": "1/3", "b3": "1/3", "b4": "1/6"}  # fmt: skip
KUTTA = {"c2": "1/3", "c3": "2/3", "c4": "1", "a32": "1", "a42": "-1", "a43": "1",
         "b1": "1/8", "b2": "3/8", "b3": "3/8", "b4": "1/8"}  # fmt: skip


def test_explicit_methods_of_four_stages_and_order_four(monkeypatch: pytest.MonkeyPatch) -> None:
    """All of them: a family of dimension 2 with c₄ = 1 (W. Kutta 1901), among them both classical
    methods, and not what has another c₄.
    """
    found = _by_msolve(EXPLICIT4, 4, monkeypatch)
    family = found.family
    ideal = found.last.ideal
    assert ideal is not None
    assert (found.last.kind, ideal.dimension) == ("family", 2)
    ring = family.ring
    assert ideal.contains(ring.parameter("c4").numerator - 1)
    for classical in (RK4, KUTTA):
        point = [fmpq(*map(int, classical[x].split("/"))) for x in ring.names]
        assert not any(fmpq_at(p, point) for p in ideal.polynomials)
    point[ring.names.index("c4")] += 1
    assert any(fmpq_at(p, point) for p in ideal.polynomials)


def fmpq_at(p: fmpz_mpoly, point: list[fmpq]) -> fmpq:
    """A polynomial at a point; an unknown that keeps denominators from vanishing has none."""
    total = fmpq(0)
    for exponents, a in p.to_dict().items():
        term = fmpq(a)
        for x, exponent in zip(point, exponents, strict=False):
            term *= x ** int(exponent)
        total += term
    return total


IMEX4 = """unknown: {{stages: 4, shape: [imex, stiffly-accurate]}}
design: {{R-infinity: {{2: 0}}, fix: {{{}}}}}
"""


def has_alexander(found: Design) -> bool:
    """Whether 6γ³ − 18γ² + 9γ − 1 is zero at all methods that are found."""
    g = found.family.ring.parameter("gamma").numerator
    return vanishes(found, 6 * g**3 - 18 * g**2 + 9 * g - 1)


def vanishes(found: Design, p: fmpq_mpoly) -> bool:
    """Whether a polynomial is zero at all methods of the last order."""
    ideal, ring = found.last.ideal, found.family.ring
    if isinstance(ideal, Ideal):
        return ideal.contains(p)
    assert ideal is not None
    return all(
        part.ideal.contains(fraction(part.expressed(p, ring), part.ring)[0]) for part in ideal.parts
    )


def test_implicit_explicit_methods_of_four_stages() -> None:
    """Order 3, stiffly accurate with R(∞) = 0 of the implicit part and c₂ = γ, from twelve unknowns: a
    proved family of dimension 3 with c₄ = 1, in which γ is a root of 6γ³ − 18γ² + 9γ − 1 as in the
    method of U. Ascher, S. Ruuth, R. Spiteri (1997).
    """
    family = loads_family(IMEX4.format("c2: gamma"))
    found = find_parameters(family, 3, seconds=30)
    ideal = found.last.ideal
    assert ideal is not None
    assert (found.last.kind, ideal.dimension) == ("family", 3)
    assert ideal.is_proved
    assert vanishes(found, family.ring.parameter("c4").numerator - 1)
    assert has_alexander(found)


def test_implicit_explicit_methods_by_msolve(monkeypatch: pytest.MonkeyPatch) -> None:
    """The same γ without a choice of nodes, where the first stage has no weight."""
    found = _by_msolve(IMEX4.format("b1: 0"), 3, monkeypatch)
    assert found.last.kind == "family"
    assert has_alexander(found)


@in_whole
def test_no_stiffly_accurate_sdirk() -> None:
    """Four stages, singly diagonally implicit, the last row b: order 4 for none, proved."""
    text = "unknown: {stages: 4, shape: [sdirk, stiffly-accurate]}\n"
    found = find_parameters(loads_family(text), 4)
    assert [step.kind for step in found.steps] == ["family"] * 3 + ["none"]
