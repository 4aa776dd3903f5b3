"""B, C and D of many colours: rows that are the same are looked at once, with the same outcome."""

from __future__ import annotations

from random import Random
from unittest.mock import patch

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.families.registry import diagonal_method
from garkcli.order.defects import Defects
from garkcli.order.simplifying import consistent_blocks, simplifying
from garkcli.tableau.forms import additive
from garkcli.tableau.polynomial_space import MAX_MOMENTS, PolynomialSpace
from garkcli.tableau.tableau import Tableau
from tests.oracles import samples


def conditions_one_by_one(tableau: Tableau, limit: int) -> list[list[int | None]]:
    """η^{l,m} of every pair of colours, each found on its own."""
    defects = Defects(tableau)
    found: list[list[int | None]] = []
    for l in range(tableau.size):
        row: list[int | None] = []
        for m in range(tableau.size):
            if tableau.block(l, m) is None:
                row.append(None)
                continue
            failing = (k for k in range(1, limit + 1) if any(defects.C(l, m, k)))
            row.append(next(failing, limit + 1) - 1)
        found.append(row)
    return found


@given(st.integers(0, 2**32 - 1))
def test_shared_rows_have_their_own_conditions(seed: int) -> None:
    """Additive and partitioned methods, whose colours share stages, and some that share none."""
    dice = Random(seed)
    make = dice.choice([samples.random_additive, samples.random_partitioned, samples.random_graph])
    tableau = make(dice)
    found = simplifying(tableau, 6)
    assert [list(row) for row in found.C] == conditions_one_by_one(tableau, 6)
    assert all(
        holds == (found.C[l][m] != 0) for (l, m), holds in consistent_blocks(tableau).items()
    )


def test_the_work_on_an_additive_method_grows_with_its_colours() -> None:
    """Forty colours with one matrix each take forty rows of C and D, not sixteen hundred."""
    A = [((fmpq(0), fmpq(0)), (fmpq(1, 2), fmpq(0)))] * 40
    b = [(fmpq(0), fmpq(1))] * 40
    calls = []
    real = Defects.C

    def counted(self: Defects, l: int, m: int, k: int) -> tuple[fmpq, ...]:
        calls.append((l, m))
        return real(self, l, m, k)  # type: ignore[return-value]

    with patch.object(Defects, "C", counted):
        found = simplifying(additive(A, b, None), 10)
    assert found.eta == 1
    assert len(set(calls)) == 40


@pytest.mark.parametrize("stages", [3, 6])
def test_moments_are_kept_and_right(stages: int) -> None:
    """The moments of weights are found once; more functionals than are kept give the same."""
    method = diagonal_method("gauss", stages)
    space = method.space
    assert isinstance(space, PolynomialSpace)
    fresh = PolynomialSpace(space.modulus)
    for k in range(MAX_MOMENTS + 3):
        functional = tuple(x + k for x in method.b)
        assert space.gram(functional) == fresh.gram(functional) == fresh.gram(functional)
    one = space.gram(method.b)[0]
    assert one == tuple(fmpq(1, k) for k in range(1, stages + 1))
