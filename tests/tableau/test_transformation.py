"""T and the eigenvalues of A⁻¹, against their definition and the numbers of RADAU5; the entries of
Gauss methods of many stages, against Vandermonde matrices and simplifying conditions.
"""

from __future__ import annotations

import json

import pytest
from flint import arb, arb_mat, ctx, fmpq

from garkcli import load
from garkcli.errors import MethodError
from garkcli.families.collocation import gauss, radau_iia
from garkcli.tableau import pointwise
from garkcli.tableau.forms import gark as as_tableau
from garkcli.tableau.gauss_points import gauss_rows, is_gauss
from garkcli.tableau.tableau import Tableau
from garkcli.tableau.transformation import transformation
from tests.cli.harness import gark
from tests.whole import at_most

RADAU5 = [
    ["9.1232394870892942792e-2", "-0.14125529502095420843", "-3.0029194105147424492e-2"],
    ["0.24171793270710701896", "0.20412935229379993199", "0.38294211275726193779"],
    ["0.96604818261509293619", "1", "0"],
]
"""T of radau5.f, E. Hairer, G. Wanner."""


@pytest.mark.parametrize("name", ["radau-iia-3", "radau-iia-5", "gauss-4", "lobatto-iiic-4"])
def test_the_blocks_are_those_of_the_definition(name: str) -> None:
    """T⁻¹ A⁻¹ T is diagonal but for [[α, −β], [β, α]] of each pair, and T⁻¹ is its inverse."""
    tableau = load(name).tableau
    found = transformation(tableau, 30)
    s = len(found.T)
    with ctx.workprec(300):
        A = pointwise.numeric_entries(tableau, 60).A[0][0]
        assert A is not None
        T = arb_mat([[*row] for row in found.T])
        inverse = arb_mat([[*row] for row in found.inverse])
        made = inverse * arb_mat([[*row] for row in A]).inv() * T
        wanted = [[arb(0)] * s for _ in range(s)]
        for i, value in enumerate(found.real):
            wanted[i][i] = value
        for n, (a, b) in enumerate(found.pairs):
            i = len(found.real) + 2 * n
            wanted[i][i] = wanted[i + 1][i + 1] = a
            wanted[i][i + 1], wanted[i + 1][i] = -b, b
            assert b > 0
        for row, due in zip(made.tolist(), wanted, strict=True):
            for x, y in zip(row, due, strict=True):
                assert abs(x - y) < arb(10) ** -25
        unit = (inverse * T).tolist()
        assert all(abs(unit[i][j] - (i == j)) < arb(10) ** -25 for i in range(s) for j in range(s))


def test_the_numbers_of_radau5() -> None:
    found = transformation(load("radau-iia-3").tableau, 20)
    with ctx.workprec(200):
        for row, printed in zip(found.T, RADAU5, strict=True):
            for x, text in zip(row, printed, strict=True):
                assert abs(x - arb(text)) < arb("1e-19")
        # (6 + 81^(1/3) − 9^(1/3))/30 is the inverse of the real one
        third = (6 + arb(81).root(3) - arb(9).root(3)) / 30
        assert abs(found.real[0] - 1 / third) < arb("1e-19")


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("rk4", "A has no inverse, or a double eigenvalue"),
        ("alexander-2", "A has no inverse, or a double eigenvalue"),
        ("imex-ssp2-222", "one colour"),
        ("gauss-60", "60 stages"),
    ],
)
def test_methods_without_one(name: str, message: str) -> None:
    tableau = load(name).tableau
    with pytest.raises(MethodError, match=message):
        transformation(tableau)


def test_the_command_prints_it() -> None:
    told = gark("tableau", "radau-iia-3", "--transformation").out
    assert (
        "eigenvalues of A⁻¹: 3.6378342527444957, 2.6810828736277521 ± 3.0504301992474106i" in told
    )
    run = gark("tableau", "radau-iia-3", "--transformation", "--format", "json", "--digits", "5")
    found = json.loads(run.out)["transformation"]
    assert found["real"] == ["3.6378"]
    assert found["pairs"] == [["2.6811", "3.0504"]]
    assert found["T"][2] == ["0.96605", "1.0000", "0"]
    assert "transformation" not in json.loads(gark("tableau", "rk4", "--format", "json").out)
    assert gark("tableau", "gauss-4", "--transformation", "--format", "yaml").code == 2


def of_gauss(stages: int) -> Tableau:
    return as_tableau([gauss(stages)], {})


@pytest.mark.parametrize("stages", [1, 2, 3, 6, 15])
def test_gauss_entries_by_legendre_polynomials(stages: int) -> None:
    """They are those of the Vandermonde matrices, by another way."""
    tableau = of_gauss(stages)
    assert is_gauss(tableau)
    with ctx.workprec(200):
        slow = pointwise._numeric(tableau, 60) if stages < 6 else None
    with ctx.workprec(700):
        slow = slow or pointwise._numeric(tableau, 60)
        c, A, b = gauss_rows(stages)
        assert slow is not None
        [block] = [x for x in slow.A[0] if x is not None]
        rows = [(c, slow.c[0]), (b, slow.b[0]), *zip(A, block, strict=True)]
        for row, other in rows:
            for x, y in zip(row, other, strict=True):
                assert isinstance(y, arb)
                assert x.overlaps(y)
                assert x.rad() < arb("1e-50")


def test_others_are_no_gauss_methods() -> None:
    """Radau's nodes, another matrix at Gauss's, other weights, two colours."""
    from garkcli.frozen import replace

    tableau = of_gauss(3)
    assert not is_gauss(as_tableau([radau_iia(3)], {}))
    assert not is_gauss(load("rk4").tableau)
    block = tableau.blocks[0, 0]
    moved = ((block[0][0] + fmpq(1, 7), *block[0][1:]), *block[1:])
    assert not is_gauss(replace(tableau, blocks={(0, 0): moved}))
    colour = tableau.colours[0]
    other = replace(colour, b=(*colour.b[1:], colour.b[0]))
    assert not is_gauss(replace(tableau, colours=(other,)))


def test_check_has_a_limit() -> None:
    run = gark("check", "gauss-201")
    assert run.code == 2
    assert "for at most 200 stages" in run.out + run.err


def test_many_stages() -> None:
    """Nodes, weights and matrix to 40 digits meet B, C and symplecticity."""
    stages = at_most(150, 500)
    entries = pointwise.numeric_entries(of_gauss(stages), 40)
    [[block]] = entries.A
    assert block is not None
    (c,), (b,) = entries.c, entries.b
    with ctx.workprec(300):
        for k in (1, 2, stages, 2 * stages - 1, 2 * stages):
            total = sum((w * x ** (k - 1) for w, x in zip(b, c, strict=True)), arb(0))
            assert abs(total - arb(1) / k) < arb("1e-38")
        for i in (0, 77, stages - 1):
            for k in (1, 2, stages // 2, stages):
                total = sum((a * x ** (k - 1) for a, x in zip(block[i], c, strict=True)), arb(0))
                assert abs(total - c[i] ** k / k) < arb("1e-38")
            for j in (1, stages // 2):
                assert abs(b[i] * block[i][j] + b[j] * block[j][i] - b[i] * b[j]) < arb("1e-38")
