"""B, C, D, consistency and symplecticity within a tolerance, and the comparisons they rest on."""

from __future__ import annotations

from collections.abc import Callable
from random import Random

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.exact.display import to_decimal
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.families.registry import diagonal_method
from garkcli.frozen import replace
from garkcli.order.defects import Defects, RoundedDefects
from garkcli.order.rounded import RoundedTableau
from garkcli.order.simplifying import consistent_blocks, is_symplectic, simplifying
from garkcli.order.tolerance import within
from garkcli.tableau.conjugate import symplectic_defect
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation
from tests.oracles import samples
from tests.order.rounded_samples import gauss_lobatto, in_decimals, published, rounded
from tests.whole import at_most, in_whole

SMALL = fmpq(1, 10**30)


def moved(tableau: Tableau, size: fmpq) -> Tableau:
    """The first coordinate of the first block increased."""
    edge = min(tableau.blocks)
    first, *others = tableau.blocks[edge]
    block = ((first[0] + size, *first[1:]), *others)
    return replace(tableau, blocks={**tableau.blocks, edge: block})


@given(st.integers(0, 2**32 - 1))
def test_defects_are_the_sums_of_the_paper(seed: int) -> None:
    """B, C, D and symplecticity of random methods, stage by stage; balls of a tiny box hold them."""
    tableau = samples.random_additive(Random(seed))
    exact, balls = Defects(tableau), RoundedDefects(tableau, SMALL)
    for l, m in tableau.edges():
        A, back = tableau.block(l, m), tableau.block(m, l)
        assert A is not None
        assert back is not None
        b_l, b_m = tableau.colours[l].b, tableau.colours[m].b
        c_l, c_m = tableau.colours[l].c, tableau.colours[m].c
        rows, columns = range(len(b_l)), range(len(b_m))
        for k in (1, 2, 3):
            B = [sum(b_l[i] * c_l[i] ** (k - 1) for i in rows) - fmpq(1, k)]
            C = [
                sum(A[i][j] * c_m[j] ** (k - 1) for j in columns) - c_l[i] ** k / fmpq(k)
                for i in rows
            ]
            D = [
                sum(b_l[i] * c_l[i] ** (k - 1) * A[i][j] for i in rows)
                - b_m[j] * (1 - c_m[j] ** k) / fmpq(k)
                for j in columns
            ]
            for wanted, found, box in (
                (B, exact.B(l, k), balls.B(l, k)),
                (C, exact.C(l, m, k), balls.C(l, m, k)),
                (D, exact.D(l, m, k), balls.D(l, m, k)),
            ):
                assert list(found) == wanted
                assert balls.vanish(x - y for x, y in zip(wanted, box, strict=True))
        M = [
            [b_l[i] * A[i][j] + b_m[j] * back[j][i] - b_l[i] * b_m[j] for j in columns]
            for i in rows
        ]
        assert [list(row) for row in symplectic_defect(tableau, l, m)] == M


@pytest.mark.parametrize("name", samples.NAMED)
def test_exact_methods_satisfy_what_they_satisfy_exactly(name: str) -> None:
    """For methods without rounding a tolerance changes nothing, in every kind of stage space."""
    tableau = samples.NAMED[name]()
    box = RoundedTableau.within(tableau, SMALL)
    assert simplifying(box, 9) == simplifying(tableau, 9)
    assert consistent_blocks(box) == consistent_blocks(tableau)
    assert is_symplectic(box) == is_symplectic(tableau)


@pytest.mark.parametrize(
    ("stages", "digits"),
    [(2, 16), *(pytest.param(*x, marks=in_whole) for x in ((4, 30), (10, 60)))],
)
def test_decimals_satisfy_what_the_family_does(stages: int, digits: int) -> None:
    """B, C, D of Gauss × Lobatto IIIA in decimals are those of the families within one unit of the
    last place, and the pair is symplectic.
    """
    exact = samples.everywhere(collocation, f"gauss {stages}", f"lobatto-iiia {stages + 1}")
    decimal = gauss_lobatto(stages, digits)
    box = RoundedTableau.within(decimal, fmpq(1, 10**digits))
    assert simplifying(box) == simplifying(exact)
    assert simplifying(box.pair()) == simplifying(pair(exact))
    assert all(consistent_blocks(box).values())
    tight = RoundedTableau.within(decimal, fmpq(1, 10 ** (digits + 3)))
    assert not any(consistent_blocks(tight).values())
    assert is_symplectic(box.pair())
    assert not is_symplectic(box)


def test_symplectic_within_the_rounding() -> None:
    """Gauss 3 in 20 digits is symplectic within 10⁻²⁰, not exactly."""
    tableau = in_decimals(gark([diagonal_method("gauss", 3)], {}), 20)
    assert is_symplectic(RoundedTableau.within(tableau, fmpq(1, 10**20)))
    assert not is_symplectic(tableau)
    assert not is_symplectic(RoundedTableau.within(tableau, fmpq(1, 10**22)))


def test_large_entries_of_a_symplectic_method_in_three_digits() -> None:
    """A rounding of an exactly symplectic method, whose residual 0.0013 three digits explain."""
    tableau = samples.runge_kutta(
        "167/1000, 3333/1000", "-1333/1000, 333/1000", "333/1000, 667/1000"
    )
    assert is_symplectic(RoundedTableau.within(tableau, fmpq(1, 1000)))
    assert not is_symplectic(RoundedTableau.within(tableau, fmpq(1, 10000)))


@in_whole
@given(st.sampled_from(["gauss 2", "gauss 3", "lobatto-iiic 3"]), st.integers(0, 2**32 - 1))
@settings(max_examples=at_most(6, 150))
def test_every_rounding_keeps_what_holds(name: str, seed: int) -> None:
    """B, C, D, consistency and symplecticity of a method hold within t of whatever it is rounded to
    within t.
    """
    exact = gark([samples.method(name)], {})
    decimal = rounded(in_decimals(exact, 30), Random(seed), fmpq(1, 10**6))
    box = RoundedTableau.within(decimal, fmpq(2, 10**6))
    found, wanted = simplifying(box, 9), simplifying(exact, 9)
    assert (found.r, found.eta, found.zeta) >= (wanted.r, wanted.eta, wanted.zeta)
    assert all(consistent_blocks(box).values())
    assert is_symplectic(box) >= is_symplectic(exact)


@pytest.mark.parametrize(
    "make",
    [
        lambda: in_decimals(gark([diagonal_method("gauss", 3)], {}), 20),
        pytest.param(
            lambda: in_decimals(gark([diagonal_method("gauss", 5)], {}), 20), marks=in_whole
        ),
        pytest.param(lambda: published("DP8_Hairer_853"), marks=in_whole),
    ],
)
def test_a_change_is_met_by_larger_tolerances_only(make: Callable[[], Tableau]) -> None:
    """A coefficient moved by 10⁻⁸: within 10⁻⁶ all is as before, within 10⁻¹⁰ consistency and C are
    gone.
    """
    tableau = make()
    changed = moved(tableau, fmpq(1, 10**8))
    loose, tight = fmpq(1, 10**6), fmpq(1, 10**10)
    before = simplifying(RoundedTableau.within(tableau, loose), 6)
    assert simplifying(RoundedTableau.within(changed, loose), 6) == before
    assert all(consistent_blocks(RoundedTableau.within(changed, loose)).values())
    box = RoundedTableau.within(changed, tight)
    assert not any(consistent_blocks(box).values())
    assert simplifying(box, 6).eta == 0
    assert is_symplectic(box) is False


@pytest.mark.parametrize("text", ["sqrt(2)", "cbrt(2) - 1", "sqrt(2) - sqrt(3)", "1/3", "-7/5"])
def test_within_is_exact(text: str) -> None:
    """A number against its own decimals to 200 places, from both sides; equality is met."""
    expression = parse(text)
    number = Domain([expression]).evaluate(expression)
    if isinstance(number, fmpq):
        assert within(number, abs(number))
        assert not within(number, abs(number) - fmpq(1, 10**300))
        return
    below = abs(Domain([]).evaluate(parse(to_decimal(number, 200).removeprefix("-")))) - fmpq(
        1, 10**199
    )
    assert not within(number, below)
    assert within(number, below + fmpq(1, 10**198))
