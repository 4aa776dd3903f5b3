"""Orders of the catalogue and of docs/errata.md by plain steps: the error of one step at two step
sizes, on a nonlinear problem with many digits. Nothing of gark decides here; it reads the numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import yaml
from flint import fmpq
from mpmath import eye, lu_solve, matrix, mp, mpc, mpf, odefun

from garkcli.constructions.nystrom import Nystrom
from garkcli.constructions.rosenbrock import Rosenbrock
from garkcli.exact.display import to_decimal
from garkcli.exact.field import Number
from garkcli.methodfile.load import load
from tests.whole import IS_WHOLE, in_whole, sample

ROOT = Path(__file__).resolve().parents[2]
DATA = ROOT / "garkcli" / "catalogue" / "data"
ERRATA = ROOT / "tests" / "examples" / "errata"
DIGITS = 30
Vector = Sequence[mpf]
Field = Callable[[mpf, Vector], list[mpf]]

ONE = mpf(1)
START = [mpf("0.5"), mpf("0.8")]
OTHER = matrix([[mpf("0.3"), mpf("-1.1")], [mpf("0.7"), mpf("0.2")]])
"""A matrix that is no Jacobian."""


def field(t: mpf, y: Vector) -> list[mpf]:
    """f(t, y) of a nonlinear problem; each derivative of low order counts."""
    u, v = y
    return [v * (1 + t) - u**2 + u * v / 3, u - v**2 * u + t**2 / 2]


def jacobian(t: mpf, y: Vector) -> Any:
    """∂f/∂y."""
    u, v = y
    return matrix([[v / 3 - 2 * u, 1 + t + u / 3], [1 - v**2, -2 * u * v]])


def by_time(t: mpf, y: Vector) -> list[mpf]:
    """∂f/∂t."""
    return [y[1], t]


def frozen(_: mpf, y: Vector) -> list[mpf]:
    """The autonomous problem: f at t = 0.2."""
    return field(mpf("0.2"), y)


@cache
def solution(is_frozen: bool) -> Callable[[mpf], list[mpf]]:
    """The solution from t = 0.2 on, by Taylor series."""
    found: Callable[[mpf], list[mpf]] = odefun(frozen if is_frozen else field, mpf("0.2"), START)
    return found


def exactly(x: Number) -> mpf:
    """A number of a method."""
    return mpf(int(x.p)) / int(x.q) if isinstance(x, fmpq) else mpf(to_decimal(x, DIGITS + 5))


def slope(error: Callable[[mpf], mpf], n: int = 64) -> float:
    """The power of h with which an error falls, from h = 1/n to 1/(2n)."""
    big, small = error(mpf(1) / n), error(mpf(1) / (2 * n))
    return float(mp.log(big / small, 2))


def rosenbrock_error(
    method: Rosenbrock, b: Vector, which: str = "exact", theta: mpf = ONE
) -> Callable[[mpf], mpf]:
    """The error of a step of a Rosenbrock method with weights b.

    ``which``: exact, any (another matrix), old (the Jacobian of an earlier step), time (with t).
    """
    alpha, gamma = ([[*map(exactly, row)] for row in x[0][0]] for x in (method.alpha, method.gamma))
    c, d = ([*map(exactly, x[0])] for x in method.nodes)
    with_time = which == "time"

    def error(h: mpf) -> mpf:
        t = mpf("0.2")
        f: Field = field if with_time else frozen
        J = {"any": OTHER, "old": jacobian(t, [START[0] - h, START[1] + h / 2])}.get(
            which, jacobian(t, START)
        )
        k: list[list[mpf]] = []
        for i in range(len(b)):
            y = [START[e] + h * sum(alpha[i][j] * k[j][e] for j in range(i)) for e in (0, 1)]
            right = matrix(f(t + c[i] * h, y))
            right += h * J * matrix([sum(gamma[i][j] * k[j][e] for j in range(i)) for e in (0, 1)])
            if with_time:
                right += h * d[i] * matrix(by_time(t, START))
            k.append(list(lu_solve(eye(2) - h * gamma[i][i] * J, right)))
        end = solution(not with_time)(t + h * theta)
        return max(
            abs(START[e] + h * sum(b[j] * k[j][e] for j in range(len(b))) - end[e]) for e in (0, 1)
        )

    return error


def all_rosenbrock() -> list[str]:
    """The Rosenbrock methods of one vector field; a sample in the suite."""
    names = sorted(x.name.removesuffix(".gark.yaml") for x in (DATA / "rosenbrock").iterdir())
    return sample([x for x in names if x != "rodas6p" or IS_WHOLE], 6)


@pytest.mark.parametrize("name", all_rosenbrock())
def test_rosenbrock_methods_have_the_orders_that_they_claim(name: str) -> None:
    """With the exact Jacobian, with another matrix, with one of an earlier step, and with t: the
    error of a step falls with the claimed order + 1, so that the next order fails.
    """
    with mp.workdps(DIGITS):
        found = load(str(DATA / "rosenbrock" / f"{name}.gark.yaml"))
        method = Rosenbrock.of(found.tableau)
        b = [*map(exactly, method.b[0])]
        claims = {x.key: int(str(x.value)) for x in found.claims if "order" in x.key}
        for which, key in (
            ("exact", "order"),
            ("any", "w-order"),
            ("old", "old-jacobian-order"),
            ("time", "nonautonomous-order"),
        ):
            n = {4: 64, 5: 12, 6: 12}.get(claims[key], 256)  # coefficients are rounded
            assert abs(slope(rosenbrock_error(method, b, which), n) - claims[key] - 1) < 0.5, which


@pytest.mark.parametrize(
    ("name", "part", "which", "order"),
    [
        ("rosw-ark3", "step", "exact", 3),
        ("rosw-ark3", "embedded", "exact", 1),
        ("kpp-rodas-31", "embedded", "exact", 1),
        ("scholz-4-7", "embedded", "exact", 1),
        ("rosw-2p", "dense", "exact", 1),
        ("rosw-2m", "dense", "exact", 1),
        ("rosenbrock32", "step", "time", 1),
        ("matlode-ros4", "step", "time", 1),
        ("rosw-r3prl2", "step", "any", 1),
        ("rosw-theta2", "step", "any", 1),
        ("rosw-ra3pw", "step", "any", 2),
        ("rok4a", "step", "exact", 4),
        ("rok4a", "step", "old", 3),
        ("rodas23w", "step", "exact", 2),
    ],
)
def test_errata_of_rosenbrock_methods(name: str, part: str, which: str, order: int) -> None:
    """What docs/errata.md says of libraries: the step, embedded weights, dense output at 1/2."""
    with mp.workdps(DIGITS):
        found = load(str(ERRATA / f"{name}.gark.yaml"))
        method = Rosenbrock.of(found.tableau)
        rows = {"step": method.b, "embedded": found.further.embedded}
        if found.further.dense is not None:
            rows["dense"] = found.further.dense.at(fmpq(1, 2))
        weights = rows[part]
        assert weights is not None
        theta = mpf(1) / 2 if part == "dense" else ONE
        b = [*map(exactly, weights[0])]
        # MATLODE's node is wrong in the fourth digit, which small steps show
        n = 2**14 if name == "matlode-ros4" else 512
        assert abs(slope(rosenbrock_error(method, b, which, theta), n) - order - 1) < 0.3


def test_no_l_stability() -> None:
    """RosenbrockW6S4OS, of its stored numbers: |R(3.5 i)| = 1.0064, and R falls to 0 at infinity."""
    text = (ERRATA / "rosenbrock-w6s4os.gark.yaml").read_text(encoding="utf-8")
    stored = yaml.safe_load(text)["rosenbrock"]["transformed"]
    gamma = mpf(str(stored["gamma"]))

    def value(z: mpc) -> mpc:
        u: list[mpc] = []
        for A, C in zip(stored["A"], stored["C"], strict=True):
            stage = 1 + sum(mpf(str(a)) * x for a, x in zip(A, u, strict=True))
            past = sum(mpf(str(c)) * x for c, x in zip(C, u, strict=True))
            u.append((z * stage + past) / (1 / gamma - z))
        return 1 + sum(mpf(str(m)) * x for m, x in zip(stored["m"], u, strict=True))

    assert abs(abs(value(mpc(0, 3.5))) - mpf("1.0064426")) < 1e-7
    assert abs(value(mpc(-1e9))) < 1e-7
    assert abs(value(mpc(-0.01)) - mp.exp(-0.01)) < 1e-11


def nystrom_error(method: Nystrom, is_velocity: bool) -> Callable[[mpf], mpf]:
    """The error of a step for q'' = g(q, q'), with two components, in q or in q'."""
    c, bbar, b = ([*map(exactly, x)] for x in (method.c, method.bbar, method.b))
    Abar = [[*map(exactly, row)] for row in method.Abar]
    A = [[*map(exactly, row)] for row in method.A] if method.A is not None else None
    q, p = START, [mpf("0.3"), mpf("-0.4")]

    def g(q: Vector, p: Vector) -> list[mpf]:
        if A is None:
            return [q[1] - q[0] ** 2, q[0] * q[1] - q[1] ** 3]
        return [q[1] - q[0] ** 2 - p[0] * q[1] / 2, q[0] * p[1] - q[1] * p[0] ** 2]

    def right(_: mpf, y: Vector) -> list[mpf]:
        return [*y[2:], *g(y[:2], y[2:])]

    exact = odefun(right, 0, [*q, *p])

    def error(h: mpf) -> mpf:
        k: list[list[mpf]] = []
        for i in range(len(b)):
            at = [
                q[e] + c[i] * h * p[e] + h**2 * sum(Abar[i][j] * k[j][e] for j in range(i))
                for e in (0, 1)
            ]
            slope = p
            if A is not None:
                slope = [p[e] + h * sum(A[i][j] * k[j][e] for j in range(i)) for e in (0, 1)]
            k.append(g(at, slope))
        if is_velocity:
            end = [p[e] + h * sum(x * y[e] for x, y in zip(b, k, strict=True)) for e in (0, 1)]
        else:
            moved = [sum(x * y[e] for x, y in zip(bbar, k, strict=True)) for e in (0, 1)]
            end = [q[e] + h * p[e] + h**2 * moved[e] for e in (0, 1)]
        true = exact(h)[2:] if is_velocity else exact(h)[:2]
        return max(abs(x - y) for x, y in zip(end, true, strict=True))

    return error


@pytest.mark.parametrize(
    ("path", "positions", "velocities"),
    [
        (DATA / "nystrom" / "fine-34.gark.yaml", 5, 4),
        (DATA / "errata" / "fine-34-misprint.gark.yaml", 2, 1),
        (DATA / "nystrom" / "fehlberg-rkng-56.gark.yaml", 5, 5),
        (ERRATA / "tracker-rkng-56.gark.yaml", 4, 2),
    ],
    ids=lambda x: x.name if isinstance(x, Path) else "",
)
def test_nystrom_methods_and_their_misprints(path: Path, positions: int, velocities: int) -> None:
    """The orders in q and q' of Fine's and Fehlberg's methods, right and as libraries have them."""
    with mp.workdps(DIGITS):
        method = Nystrom.of(load(str(path)).tableau)
        assert abs(slope(nystrom_error(method, False), 1024) - positions - 1) < 0.4
        assert abs(slope(nystrom_error(method, True), 1024) - velocities - 1) < 0.4


def merk_error(file: Path, is_described: bool) -> Callable[[mpf], mpf]:
    """The error of a step of a MERK method whose fast problem is solved by Taylor series.

    The forcing of stage i is Σ_k (Σ_j ω_ij^k f_S(z_j)) τ^k with τ = t/h, as in the tables; as
    SUNDIALS describes it, τ = t/(c_i h), and the sum is divided by c_i.
    """
    known = yaml.safe_load(file.read_text(encoding="utf-8"))["multirate"]["mri"]
    c, omega = known["c"], known["omega"]

    def number(x: object) -> mpf:
        p, _, q = str(x).partition("/")
        return mpf(p) / mpf(q or 1)

    def slow(y: Vector) -> list[mpf]:
        return [y[1] - y[0] ** 2 / 2, y[0] * y[1] / 3]

    def fast(y: Vector) -> list[mpf]:
        return [y[0] * y[1] - y[1], -y[0] + y[1] ** 2 / 4]

    def both(_: mpf, y: Vector) -> list[mpf]:
        return [x + z for x, z in zip(slow(y), fast(y), strict=True)]

    exact = odefun(both, 0, START)

    def error(h: mpf) -> mpf:
        values = [slow(START)]
        for i, end in enumerate(map(number, c[1:])):
            scale = end if is_described else ONE
            rows = [[*map(number, power[i])] for power in omega]
            force = [
                [sum(w * v[e] for w, v in zip(row, values, strict=False)) for e in (0, 1)]
                for row in rows
            ]

            def right(t: mpf, y: Vector, force: Any = force, scale: mpf = scale) -> list[mpf]:
                powers = [(t / (scale * h)) ** k / scale for k in range(len(force))]
                pushed = [sum(x * f[e] for x, f in zip(powers, force, strict=True)) for e in (0, 1)]
                return [x + z for x, z in zip(fast(y), pushed, strict=True)]

            z = odefun(right, 0, START)(end * h)
            values.append(slow(z))
        return max(abs(x - y) for x, y in zip(z, exact(h), strict=True))

    return error


@pytest.mark.parametrize(
    ("name", "is_described", "order"),
    [
        pytest.param("merk21", False, 2, marks=in_whole),
        ("merk21", True, 1),
        pytest.param("merk32", False, 3, marks=in_whole),
        pytest.param("merk32", True, 1, marks=in_whole),
        ("merk54", False, 5),
    ],
)
def test_merk_methods(name: str, is_described: bool, order: int) -> None:
    """With the forcing of their tables they have their order, MERK54 the conjectured 5 with a
    fast problem that is not linear; with that of the description order 1.
    """
    with mp.workdps(18):
        error = merk_error(DATA / "multirate" / f"{name}.gark.yaml", is_described)
        assert abs(slope(error, 16) - order - 1) < 0.35
