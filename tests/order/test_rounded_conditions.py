"""B, C, D, consistency and symplecticity within a tolerance, and the comparisons they rest on."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.exact.display import to_decimal
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.families.registry import diagonal_method
from garkcli.order.defects import is_symplectic_within
from garkcli.order.simplifying import consistent_blocks, simplifying
from garkcli.order.tolerance import form_within, functional_within, vector_within, within
from garkcli.tableau.conjugate import is_symplectic
from garkcli.tableau.forms import gark, pair
from garkcli.tableau.tableau import Tableau
from garkcli.transfer import collocation
from tests.oracles import samples
from tests.order.rounded_samples import gauss_lobatto, in_decimals, published

SMALL = fmpq(1, 10**30)


def moved(tableau: Tableau, size: fmpq) -> Tableau:
    """The first coordinate of the first block increased."""
    edge = min(tableau.blocks)
    first, *others = tableau.blocks[edge]
    block = ((first[0] + size, *first[1:]), *others)
    return replace(tableau, blocks={**tableau.blocks, edge: block})


@pytest.mark.parametrize("name", samples.NAMED)
@pytest.mark.parametrize("tolerance", [fmpq(0), SMALL])
def test_exact_methods_satisfy_what_they_satisfy_exactly(name: str, tolerance: fmpq) -> None:
    """For methods without rounding a tolerance, also of zero, changes nothing, in every kind of
    stage space.
    """
    tableau = samples.NAMED[name]()
    assert simplifying(tableau, 9, tolerance) == simplifying(tableau, 9)
    assert consistent_blocks(tableau, tolerance) == consistent_blocks(tableau)
    assert is_symplectic_within(tableau, tolerance) == is_symplectic(tableau)


@pytest.mark.parametrize(("stages", "digits"), [(2, 16), (4, 30), (10, 60)])
def test_decimals_satisfy_what_the_family_does(stages: int, digits: int) -> None:
    """B, C, D of Gauss × Lobatto IIIA in decimals are those of the families, and the pair is
    symplectic.
    """
    decimal = gauss_lobatto(stages, digits)
    exact = samples.everywhere(collocation, f"gauss {stages}", f"lobatto-iiia {stages + 1}")
    tolerance = fmpq(1, 10 ** (digits - 3))
    assert simplifying(decimal, tolerance=tolerance) == simplifying(exact)
    assert simplifying(pair(decimal), tolerance=tolerance) == simplifying(pair(exact))
    assert all(consistent_blocks(decimal, tolerance).values())
    assert not any(consistent_blocks(decimal, fmpq(1, 10 ** (digits + 3))).values())
    assert is_symplectic_within(pair(decimal), tolerance)
    assert not is_symplectic_within(decimal, tolerance)


def test_symplectic_within_the_rounding() -> None:
    """Gauss 3 in 20 digits is symplectic within 10⁻¹⁹, not exactly."""
    tableau = in_decimals(gark([diagonal_method("gauss", 3)], {}), 20)
    assert is_symplectic_within(tableau, fmpq(1, 10**19))
    assert not is_symplectic(tableau)
    assert not is_symplectic_within(tableau, fmpq(1, 10**22))


@pytest.mark.parametrize(
    "make", [lambda: gark([diagonal_method("gauss", 5)], {}), lambda: published("DP8_Hairer_853")]
)
def test_a_change_is_met_by_larger_tolerances_only(make: Callable[[], Tableau]) -> None:
    """A coefficient moved by 10⁻⁸: within 10⁻⁶ all is as before, within 10⁻¹⁰ consistency and C are
    gone.
    """
    tableau = make()
    changed = moved(tableau, fmpq(1, 10**8))
    loose, tight = fmpq(1, 10**6), fmpq(1, 10**10)
    assert simplifying(changed, 6, loose) == simplifying(tableau, 6, loose)
    assert all(consistent_blocks(changed, loose).values())
    assert not any(consistent_blocks(changed, tight).values())
    assert simplifying(changed, 6, tight).eta == 0
    assert is_symplectic_within(changed, tight) is False


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


@given(st.fractions(0, 1), st.fractions(0, 1))
def test_values_at_nodes_decide(x: Fraction, t: Fraction) -> None:
    """In the space of Gauss 2 the element x has its nodes as values, (3 ± √3)/6: within t when both
    are.
    """
    space = diagonal_method("gauss", 2).space
    tolerance = fmpq(str(t))
    scale = fmpq(str(x))
    vector = tuple(scale * y for y in space.nodes)
    upper = scale * fmpq(7886751345948128822, 10**19)  # (3 + √3)/6, rounded down
    if abs(upper - tolerance) > fmpq(1, 10**15):
        assert vector_within(space, vector, tolerance) == (upper < tolerance)


def test_functionals_and_forms_at_nodes() -> None:
    """The weights of Gauss 2 are both 1/2; as a form on two copies of its space they are the
    diagonal.
    """
    method = diagonal_method("gauss", 2)
    assert functional_within(method.space, method.b, fmpq(1, 2) + SMALL)
    assert not functional_within(method.space, method.b, fmpq(1, 2) - SMALL)
    gram = method.space.gram(method.b)
    assert form_within(method.space, method.space, gram, fmpq(1, 2) + SMALL)
    assert not form_within(method.space, method.space, gram, fmpq(1, 2) - SMALL)
