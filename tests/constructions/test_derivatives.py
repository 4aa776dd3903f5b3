"""Methods that use derivatives of f: spans, all trees, and power series that know neither trees nor
gark; R(z); files with them, and every command.
"""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from pathlib import Path
from random import Random

import pytest
from flint import fmpq

from garkcli import analyse, assert_order, claims_of, compare, conditions, load, loads, render
from garkcli.check.check_file import check_file, check_method
from garkcli.check.rare_kinds import DerivativesAnalysis
from garkcli.constructions.derivatives import Derivatives, plan
from garkcli.errors import MethodError, MethodFileError
from garkcli.order.certificate import find_order
from garkcli.stability.linear import stability_function
from tests.cli.harness import gark
from tests.constructions.test_rosenbrock import RUNGE_KUTTA, engine, fractions
from tests.oracles import derivatives_series as series
from tests.oracles.brute import brute_order
from tests.oracles.rosenbrock_series import Matrix
from tests.whole import at_most

LIMIT = 5
Method = tuple[list[Matrix], Matrix]


def method(*texts: str) -> Method:
    """The matrices of f, f′f, …, each followed by its weights."""
    return [fractions(x) for x in texts[::2]], [fractions(x)[0] for x in texts[1::2]]


TDRK4 = method("0 0; 1/2 0", "1 0", "0 0; 1/8 0", "1/6 1/3")
TDRK5 = method("0 0 0; 2/5 0 0; 1 0 0", "1 0 0", "0 0 0; 2/25 0 0; -1/4 3/4 0", "1/8 25/72 1/36")
"""R. P. K. Chan, A. Y. J. Tsai, Numer. Algorithms 53 (2010) 171."""
HERMITE = method("0 0; 1/2 1/2", "1/2 1/2", "0 0; 1/12 -1/12", "1/12 -1/12")
HERMITE_6 = method(
    *("0 0; 1/2 1/2", "1/2 1/2"),
    *("0 0; 1/10 -1/10", "1/10 -1/10"),
    *("0 0; 1/120 1/120", "1/120 1/120"),
)
TAYLOR = method("0", "1", "0", "1/2", "0", "1/6")
KNOWN = (TDRK4, TDRK5, HERMITE, HERMITE_6, TAYLOR)


def made(given: Method) -> Derivatives:
    return Derivatives(engine(given[0]), engine(given[1]))


def random_method(seed: int) -> Method:
    """Published methods, one entry changed or none, Runge–Kutta methods with second derivatives
    whose weights vanish in sum, and small fractions that meet the conditions of order 2.
    """
    dice = Random(seed)
    kind = dice.choice(["known", "known", "rk", "free", "free"])

    def number() -> Fraction:
        return Fraction(dice.randint(-2, 3), dice.randint(1, 4))

    if kind == "known":
        A, b = dice.choice(KNOWN)
        A, b = [[[*row] for row in x] for x in A], [[*row] for row in b]  # type: ignore[misc]
        if dice.random() < 0.5:
            row = dice.choice([*b, *(row for x in A for row in x)])
            row[dice.randrange(len(row))] += number()  # type: ignore[index]
        return A, b
    if kind == "rk":
        alpha, weights = dice.choice(RUNGE_KUTTA)
        s = len(weights)
        second = [[Fraction(0)] * s for _ in range(s)]
        late = [Fraction(0)] * s
        if dice.random() < 0.7:
            late[0], late[-1] = Fraction(1, 3), Fraction(-1, 3)
        return [alpha, second], [weights, late]
    s, derivatives = dice.choice([1, 2, 2, 3]), dice.choice([1, 2, 2, 3])
    is_explicit = dice.random() < 0.6
    A = [
        [
            [number() if j < i or not is_explicit else Fraction(0) for j in range(s)]
            for i in range(s)
        ]
        for _ in range(derivatives)
    ]
    free = [[number() for _ in range(s)] for _ in range(derivatives)]
    free[0][-1] += 1 - sum(free[0])
    if derivatives > 1:
        c = [sum(row, Fraction(0)) for row in A[0]]
        reached = sum(x * y for x, y in zip(free[0], c, strict=True)) + sum(free[1])
        free[1][0] += Fraction(1, 2) - reached
    return A, free  # type: ignore[return-value]


def test_random_methods_three_ways() -> None:
    """Spans, all trees and power series find one order; each up to 5 occurs."""
    orders = Counter[int]()
    for seed in range(at_most(40, 250)):
        given = random_method(seed)
        tableau = made(given).tableau(plan(made(given)))
        found = find_order(tableau, LIMIT).order
        assert found == brute_order(tableau, LIMIT) == series.order(*given, LIMIT, seed), seed
        orders[found] += 1
    assert {1, 2, 3, 4, 5} <= orders.keys()


@pytest.mark.parametrize(("given", "order"), [*zip(KNOWN, (4, 5, 4, 6, 3), strict=True)])
def test_published_methods(given: Method, order: int) -> None:
    """They have their orders and no larger ones, whatever more nodes the flow has; the tableau
    gives the method back.
    """
    asked = made(given)
    least = plan(asked)
    for nodes in (least, least + 2):
        tableau = asked.tableau(nodes)
        found = find_order(tableau, 20)
        assert (found.order, found.is_lower_bound) == (order, False)
        back = Derivatives.of(tableau)
        assert (back.A, back.b, back.nodes) == (asked.A, asked.b, asked.nodes)
    assert series.order(*given, order + 1) == order


@pytest.mark.parametrize("given", [*KNOWN, random_method(7), random_method(11)])
def test_stability_functions(given: Method) -> None:
    """R(z) is that of z^k for the k-th derivative, solved with numbers."""
    R = stability_function(made(given).on_test_equation)
    A, b = given
    for z in (Fraction(1, 3), Fraction(-2, 5)):
        s = range(len(b[0]))
        powers = [z ** (k + 1) for k in range(len(A))]
        rows = [
            [int(i == j) - sum(x * M[i][j] for x, M in zip(powers, A, strict=True)) for j in s]
            + [Fraction(1)]
            for i in s
        ]
        for k in s:
            pivot = next(i for i in s if i >= k and rows[i][k])
            rows[k], rows[pivot] = rows[pivot], rows[k]
            rows[k] = [x / rows[k][k] for x in rows[k]]
            for i in s:
                if i != k:
                    rows[i] = [x - rows[i][k] * y for x, y in zip(rows[i], rows[k], strict=True)]
        value = 1 + sum(
            x * w * rows[j][-1] for x, row in zip(powers, b, strict=True) for j, w in enumerate(row)
        )
        at = fmpq(z.numerator, z.denominator)
        assert R.numerator(at) / R.denominator(at) == fmpq(value.numerator, value.denominator)


FILE = """\
derivatives:
  A: [[[], [1/2]], [[], [1/8]]]
  b: [[1, 0], [1/6, 1/3]]
  embedded: [[1], [1/2]]
"""


def written(tmp_path: Path, text: str) -> str:
    path = tmp_path / "method.gark.yaml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_files(tmp_path: Path) -> None:
    """Claims hold, and none larger; embedded weights have theirs; nodes of one's own lower the
    order on f(t, y); digits are rounded by the tolerance.
    """
    text = FILE.replace("[[1], [1/2]]", "[[1, 0], [1/2, 0]]")
    claims = "expect: {order: 4, embedded-order: 2, nonautonomous-order: 4, a-stable: false}\n"
    assert check_file(written(tmp_path, text + claims)).exit_code == 0
    wrong = check_file(written(tmp_path, text + claims.replace("order: 4,", "order: 5,")))
    assert [x.claim for x in wrong.failed_claims] == ["order", "nonautonomous-order"]
    other = text.replace("  embedded", "  c: [0, 1/3]\n  embedded")
    found = claims_of(written(tmp_path, other), ["order", "nonautonomous-order"])
    assert found == {"order": "4", "nonautonomous-order": "2"}
    rounded = FILE.replace("1/6, 1/3", "0.16667, 0.33333").partition("  emb")[0]
    assert check_method(loads(f"{rounded}tolerance: 1e-5\nexpect: {{order: 4}}")).exit_code == 0
    assert claims_of(written(tmp_path, rounded), ["order"]) == {"order": "2"}


def test_stability_is_that_of_the_method() -> None:
    """Hermite's method of order 4 has the R(z) of Gauss with two stages, and its verdicts."""
    text = (
        "derivatives: {A: [[[], [1/2, 1/2]], [[], [1/12, -1/12]]], b: [[1/2, 1/2], [1/12, -1/12]]}"
    )
    found = analyse(loads(text))
    assert isinstance(found, DerivativesAnalysis)
    gauss = analyse("gauss-2").subject
    for key in ("a-stable", "l-stable", "i-stable", "p-stable"):
        assert found.subject.verdict(key).value == gauss.verdict(key).value
    assert found.subject.at_infinity == 1
    assert found.subject.verdict("ssp-coefficient").value is None
    assert "A-stable, not L-stable" in render(found)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{A: [[]]}", "b"),
        ("{A: [[], []], b: [[1]]}", "b has 1 row for 2 matrices"),
        ("{A: [[[0, 1]]], b: [[1]]}", "A, matrix 1 has 2 entries for 1 stage"),
        ("{A: [[], []], b: [[1, 0], [1]]}", "b, row 2"),
        ("{A: [[]], b: [[1]], c: [0, 1]}", "c"),
        ("{A: [[]], b: [[1]], embedded: [[1], [1]]}", "embedded has 2 rows for 1 matrix"),
        ("{A: [], b: [[1]]}", "A is empty"),
        ("{A: [[]], b: [[g]]}\nparameters: {g: free}", "needs numbers, and g is free"),
        ("{A: [[]], b: [[1]]}\nconjugate: true", "conjugate"),
    ],
)
def test_faults(text: str, message: str) -> None:
    """What is wrong is said, with its place."""
    with pytest.raises(MethodFileError, match=message):
        loads(f"derivatives: {text}")


def test_every_command_takes_it_or_refuses_it(tmp_path: Path) -> None:
    """No command fails on such a file: it answers, or says why it does not."""
    path = written(tmp_path, FILE.replace("[[1], [1/2]]", "[[1, 0], [1/2, 0]]"))
    for command in ("check", "show", "tableau", "conditions", "claims", "certificate", "stability"):
        assert gark(command, path).code == 0, command
    assert gark("report", path, "-o", str(tmp_path / "page.html")).code == 0
    assert gark("export", path, "--to", "numpy").code == 0
    others = {"convert": ["--to", "reduced"]}
    for command in ("modified", "energy", "conjugate", "convert"):
        run = gark(command, path, *others.get(command, []))
        assert run.code == 2, command
        assert "derivatives of f are used" in run.err, command
    free = tmp_path / "free.gark.yaml"
    text = FILE.partition("  emb")[0].replace("[], [1/2]", "[], [x]")
    free.write_text("parameters: {x: free}\n" + text, "utf-8")
    run = gark("design", str(free))
    assert run.code == 2
    assert "derivatives of f are used" in run.err
    with pytest.raises(MethodError, match="derivatives of f"):
        loads(FILE.partition("  emb")[0]).conjugate  # noqa: B018
    with pytest.raises(MethodError, match="known up to order 5"):
        list(conditions(path, ["[[[[[[]]]]]]"]))


def test_what_differs_is_told_by_derivative() -> None:
    """``gark diff`` has the entries of the file, not those of the tableau."""
    one, other = load("tdrk-4"), load("tdrk-5")
    assert compare(one, one).relation == "identical"
    assert compare(one, other).relation == "different"
    moved = loads(FILE.replace("1/8", "1/7").partition("  emb")[0])
    plain = loads(FILE.partition("  emb")[0])
    gaps = compare(plain, moved).gaps
    assert [(x.kind, x.colour, x.seen, x.entries) for x in gaps] == [("A", 1, 1, 4)]
    assert_order(one, 4)
