"""Methods are found among numbers, whatever these are called and however they are stored."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
import pytest

from garkcli.frozen import replace
from garkcli.recognise.choosing import readings_of
from garkcli.recognise.evidence import conditions, evidence, order_of, unit_of
from garkcli.recognise.given import Entry, Given, Group
from garkcli.recognise.readings import Reading
from garkcli.sources.languages import python

if TYPE_CHECKING:
    from garkcli.arrays import Floats

A = np.array([[0, 0, 0, 0], [1 / 3, 0, 0, 0], [-1 / 3, 1, 0, 0], [1, -1, 1, 0]])
b, c = np.array([1, 3, 3, 1]) / 8, np.array([0, 1 / 3, 2 / 3, 1])


def given(name: str, x: Floats) -> Given:
    """An array whose numbers count for 5 bits each."""
    rows = tuple(
        tuple(Entry(v, abs(v) * 4e-16, 5.0 * bool(v), 1) for v in row)
        for row in np.atleast_2d(x).tolist()
    )
    return Given(name, 1, rows, is_matrix=x.ndim > 1)


def read(*arrays: Floats) -> list[Reading]:
    """The readings of arrays without names."""
    of = [given(f"x{i}", x) for i, x in enumerate(arrays)]
    return [x for x in readings_of([Group((0, None), 1, "", of)]) if x.is_enough]


def test_residuals_are_those_of_the_trees() -> None:
    """The 3/8 rule has order 4; its first five conditions are those that papers print."""
    found = [residuals for residuals, _ in conditions(A, b)]
    assert [len(x) for x in found[:5]] == [1, 1, 2, 4, 9]
    by_hand = sorted([b.sum() - 1, b @ c - 1 / 2, b @ c**2 - 1 / 3, b @ A @ c - 1 / 6])
    assert sorted(np.concatenate(found[:3])) == pytest.approx(by_hand)
    assert order_of(A, b, 0.0) == 4
    assert np.abs(found[4]).max() > 1e-3


STORED: dict[str, Callable[[], tuple[Floats, ...]]] = {
    "": lambda: (A, b, c),
    "columns are stages": lambda: (A.T, b, c),
    "the first row of zeros is left out": lambda: (A[1:, :3], b, c),
    "the first column has the nodes": lambda: (np.column_stack([c, A]), b),
    "the weights are the last row": lambda: (np.vstack([A, b]), c),
    "rows 2 to s, and the weights below them": lambda: (np.vstack([A[1:], b]), c),
    "a tableau with its nodes and weights in one matrix": lambda: (
        np.vstack([np.column_stack([c, A]), [4, *b]]),
    ),
    "a tableau with its nodes and weights in one matrix, row by row": lambda: (
        np.vstack([np.column_stack([c, A]), [4, *b]]).ravel(),
    ),
    "row by row": lambda: (A.ravel(), b, c),
    "the triangle row by row": lambda: (A[np.tril_indices(4, -1)], b, c),
}


@pytest.mark.parametrize("how", STORED)
def test_the_same_method_however_it_is_stored(how: str) -> None:
    """One reading, which has the method and says how it is stored."""
    (found,) = read(*STORED[how]())
    assert found.how.split(";")[0] == how
    assert found.rows["A"][..., 0] == pytest.approx(A)
    assert found.rows["b"][:, 0] == pytest.approx(b)
    assert found.order == 4


def test_other_numbers_are_none() -> None:
    """One weight is another: nothing is read; neither is a Vandermonde matrix, nor the identity."""
    assert read(A, np.array([1, 3, 2, 5]) / 8, c) == []
    assert read(np.vander(c), b, c) == []
    assert read(np.eye(4), b, np.ones(4)) == []


def test_heun_in_one_row() -> None:
    """Few numbers, with names."""
    heun = [
        given(x, np.array(y, dtype=float))
        for x, y in (("a", [0, 0, 1, 0]), ("b", [0.5, 0.5]), ("c", [0, 1]))
    ]
    (found,) = readings_of([Group((0, None), 1, "", heun, speaks=True)])
    assert found.is_enough


def test_names_speak_for_combinations() -> None:
    """A method of order 2 in the form of Shu and Osher has few numbers: their names decide."""
    alpha = np.array([[1, 0, 0], [0, 1, 0], [1 / 3, 0, 2 / 3]])
    beta = np.diag([1 / 2, 1 / 2, 1 / 3])
    found = [
        readings_of([Group((0, None), 1, "", [given(x, alpha), given(y, beta)], speaks=True)])
        for x, y in (("alpha_v", "beta_v"), ("as_", "bs_"), ("x", "y"))
    ]
    readings = [next(iter(x)) for x in found]
    assert [x.form for x in readings] == ["Shu–Osher"] * 3
    assert [x.names for x in readings] == [2, 2, 0]
    assert readings[0].bits == readings[1].bits == readings[2].bits + 3


def test_embedded_weights_and_what_is_idle() -> None:
    """Weights of a lower order are embedded ones; what is called b and is none is idle."""
    low = np.array([1 / 4, 0, 3 / 4, 0])
    (found,) = read(A, b, c, low)
    assert found.rows["embedded"][:, 0] == pytest.approx(low)
    arrays = [given(x, y) for x, y in (("a", A), ("w", b), ("c", c), ("b", 2 * b))]
    (found,) = readings_of([Group((0, None), 1, "", arrays)])
    assert [x.name for x in found.idle] == ["b"]


def test_other_forms() -> None:
    """Williamson's registers, Shu and Osher's combinations, Verlet's kicks and drifts, Nyström."""
    (found,) = read(np.array([0, -5 / 9, -153 / 128]), np.array([1 / 3, 15 / 16, 8 / 15]))
    assert (found.form, found.order) == ("2N", 3)
    alpha = np.array([[1, 0, 0], [3 / 4, 1 / 4, 0], [1 / 3, 0, 2 / 3]])
    beta = np.array([[1, 0, 0], [0, 1 / 4, 0], [0, 0, 2 / 3]])
    at = np.tril_indices(3)
    for arrays in ((alpha, beta), (alpha[at], beta[at])):
        (found,) = read(*arrays)
        assert (found.form, found.order) == ("Shu–Osher", 3)
    t = 1 / (2 - 2 ** (1 / 3))
    drifts = np.array([t, 1 - t, 1 - t, t]) / 2
    (found,) = read(drifts, np.array([t, 1 - 2 * t, t, 0]))
    assert (found.form, found.order) == ("drift-first", 4)
    bar = np.array([[0, 0, 0], [1 / 8, 0, 0], [0, 1 / 2, 0]])
    weights = np.array([1 / 6, 2 / 3, 1 / 6])
    (found,) = read(bar, weights, np.array([1 / 6, 1 / 3, 0]), np.array([0, 1 / 2, 1]))
    assert (found.form, found.order) == ("nystrom", 4)


@pytest.mark.parametrize(("weights", "is_read"), [([2 / 9, 1 / 3, 0], True), ([1 / 9, 1], False)])
def test_single_weights_beside_a_last_row(weights: list[float], is_read: bool) -> None:
    """Bogacki and Shampine's last row are the weights, of which some have names of their own, too;
    other values with these names say that the weights are elsewhere.
    """
    rows = np.array([[0, 0, 0, 0], [1 / 2, 0, 0, 0], [0, 3 / 4, 0, 0], [2 / 9, 1 / 3, 4 / 9, 0]])
    of = [given("a", rows), given("b", np.array(weights)), given("c", rows.sum(1))]
    made = [replace(x, is_made=True) for x in of]
    found = [x for x in readings_of([Group((0, None), 1, "", made)]) if x.is_enough]
    assert [x.how for x in found] == ["b is the last row"] * is_read


def test_short_numbers_among_long_ones_are_exact() -> None:
    """0.107925 beside numbers of 16 digits is no rounded number; among short ones it is."""
    long, short = [0.3, 1e-16, 52.0, 1.0], [0.107925, 1e-6, 20.0, 1.0]
    assert unit_of(np.array([long, short, long])) == 1e-16
    assert unit_of(np.array([long, short, short])) == 1e-6
    assert unit_of(None) == 0


@pytest.mark.parametrize("has_nodes", [False, True])
def test_order_two_nearly(has_nodes: bool) -> None:
    """Nearly equal numbers tie weights to a matrix where nodes speak for it, too."""
    matrix = np.array([[1 / 2 - 1e-9, 0], [1 / 2 - 1e-9, 0]])
    of = given("A", matrix).numbers, given("b", np.array([1 / 4, 3 / 4])).numbers
    nodes = given("c", matrix.sum(1)).numbers if has_nodes else None
    assert evidence(*of, nodes).nearly == (2 if has_nodes else 1)


@pytest.mark.parametrize("text", ["5/12", "0.41666667"])
def test_rounded_fractions_are_short_numbers(text: str) -> None:
    """Short numbers meet order 2 by chance, and say little also as decimals."""
    sixth = "1/6" if "/" in text else "0.16666667"
    source = f"def f():\n    t = [0, 1, 2, 3, 4, 5]\n    check(t, [{text}, {text}, {sixth}, 0])\n"
    assert not any(x.b for x in python.find(source, "x"))
