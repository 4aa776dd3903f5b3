"""A method written to a file is the same method when the file is read again."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.errors import MethodError, ZeroWeight
from garkcli.exact.display import to_text
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Number
from garkcli.exact.matrix import Matrix
from garkcli.methodfile.carried import write_conjugate_of
from garkcli.methodfile.load import load, loads
from garkcli.methodfile.writer import can_spell_out, write_tableau_file
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.forms import separable_prk, spelled_out, with_linear
from garkcli.tableau.pointwise import in_points
from garkcli.tableau.tableau import Tableau
from tests.whole import at_most, sample

ROOT = Path(__file__).parents[2]
FILES = [
    path
    for folder in ("methods", "tests/examples/valid")
    for path in sorted((ROOT / folder).glob("*.gark.yaml"))
    if load(str(path)).tableau.has_fields_alone  # others have no blocks to spell out
]

rationals = st.builds(fmpq, st.integers(-50, 50), st.integers(1, 50))


def matrices(rows: int, columns: int) -> st.SearchStrategy[Matrix]:
    """Matrices of small fractions."""
    row = st.tuples(*[rationals] * columns)
    return st.tuples(*[row] * rows)


@st.composite
def tableaus(draw: st.DrawFn) -> Tableau:
    """Up to three colours of up to three stages, with absent blocks and linear colours."""
    sizes = draw(st.lists(st.integers(1, 3), min_size=1, max_size=3))
    vectors = [draw(st.tuples(*[rationals] * s)) for s in sizes]
    nodes = [draw(st.tuples(*[rationals] * s)) for s in sizes]
    A = [[draw(st.none() | matrices(s, t)) for t in sizes] for s in sizes]
    linear = draw(st.sets(st.integers(0, len(sizes) - 1)))
    return spelled_out(A, vectors, nodes, linear)


@given(tableaus(), st.text(st.characters(exclude_categories=["C", "Z"]), min_size=1))
def test_a_spelled_out_file_loads_as_the_same_tableau(tableau: Tableau, name: str) -> None:
    """Blocks, absent blocks, nodes, weights, linear colours and the name survive writing and
    reading.
    """
    method = loads(write_tableau_file(tableau, name, note="written\nby a test"))
    assert method.tableau == tableau
    assert method.name == name


@given(st.data())
@settings(max_examples=at_most(10, 25))
def test_a_partitioned_file_loads_as_the_same_tableau(data: st.DataObject) -> None:
    """Rectangular parts of a separable or Nyström method come back with their nodes."""
    s, t = data.draw(st.integers(1, 3)), data.draw(st.integers(1, 3))
    q = (data.draw(matrices(t, s)), data.draw(matrices(1, s))[0], data.draw(matrices(1, t))[0])
    p = (data.draw(matrices(s, t)), data.draw(matrices(1, t))[0], data.draw(matrices(1, s))[0])
    tableau = with_linear(separable_prk(q, p), data.draw(st.sampled_from([[], ["q"]])))
    assert loads(write_tableau_file(tableau, "prk")).tableau == tableau


def same_entries(one: Tableau, other: Tableau) -> bool:
    """Whether two tableaus have exactly the same entries, though each in a number field of its
    own.
    """
    texts = [to_text(x) for tableau in (one, other) for x in all_entries(tableau)]
    expressions = [parse(text) for text in texts]
    domain = Domain(expressions)
    values = [domain.evaluate(x) for x in expressions]
    half = len(values) // 2
    return shape(one) == shape(other) and values[:half] == values[half:]


def spelled(tableau: Tableau) -> Tableau:
    """The tableau with a coordinate a stage, where its nodes have simple radicals."""
    return in_points(tableau) or tableau


def all_entries(tableau: Tableau) -> Iterator[Number]:
    """Every weight, node and entry of a block, colour by colour."""
    for colour in tableau.colours:
        yield from (*colour.b, *colour.c)
    for l, m in tableau.edges():
        for row in tableau.block(l, m) or ():
            yield from row


def shape(tableau: Tableau) -> object:
    """What a tableau has besides its numbers: stages, blocks, linear colours."""
    colours = [(len(colour.b), colour.is_linear) for colour in tableau.colours]
    return colours, list(tableau.edges())


def has_conjugate(path: Path) -> bool:
    """Whether it is a GARK method, and no weight of the file is in the way of a conjugate."""
    try:
        conjugate(load(str(path)).tableau)
    except (ZeroWeight, MethodError):
        return False
    return True


CONJUGABLE = [path for path in FILES if has_conjugate(path)]


@pytest.mark.parametrize(
    "path", sample(CONJUGABLE, 3), ids=lambda path: path.name.removesuffix(".gark.yaml")
)
def test_the_file_of_a_conjugate_is_the_conjugate_and_back(path: Path) -> None:
    """A file with ``conjugate: true`` put in loads as the conjugate; put in twice it is the
    original exactly.
    """
    method = load(str(path))
    once = loads(write_conjugate_of(method, "conjugate of it"))
    conjugated = conjugate(method.tableau)
    assert same_entries(spelled(once.tableau), spelled(conjugated))
    assert once.name == "conjugate of it"
    twice = loads(write_conjugate_of(once, "again"))
    assert same_entries(spelled(twice.tableau), spelled(method.tableau))
    assert twice.is_conjugate == method.is_conjugate


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.name.removesuffix(".gark.yaml"))
def test_a_file_spelled_out_is_the_same_method(path: Path) -> None:
    """A method with simple radicals, written entry by entry, loads with the same entries."""
    exact = in_points(load(str(path)).tableau)
    if exact is None or not can_spell_out(exact):
        pytest.skip("cannot be spelled out")
    again = loads(write_tableau_file(exact, "again"))
    assert same_entries(again.tableau, exact)


def test_most_files_take_part() -> None:
    """The two tests above are not vacuous: most example files have a conjugate."""
    assert len(CONJUGABLE) > len(FILES) * 2 // 3
