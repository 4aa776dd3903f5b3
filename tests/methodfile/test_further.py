"""Embedded weights and dense output in every form of method file: read, refused, written again."""

from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.errors import MethodFileError
from garkcli.exact.display import to_text
from garkcli.exact.field import Number
from garkcli.exact.matrix import Vector
from garkcli.frozen import replace
from garkcli.methodfile.carried import write_conjugate_of
from garkcli.methodfile.family import loads_family, with_values
from garkcli.methodfile.load import load, loads
from garkcli.methodfile.writer import write_rounded, write_tableau_file
from garkcli.order.tolerance import within
from garkcli.tableau.embedded import DenseOutput, Further, with_weights
from garkcli.tableau.pointwise import entries
from garkcli.tableau.tableau import Tableau
from tests.methodfile.test_writer import rationals, tableaus
from tests.whole import at_most

VALID = Path(__file__).parents[1] / "examples" / "valid"
TWO = "{A: [[0, 0], [1, 0]], b: [1/2, 1/2]"
HEUN = "A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\n"
FORMS = {
    "plain": (f"{HEUN}embedded: [1, 0]", [["1", "0"]]),
    "tableau": (f"tableau: {TWO}, embedded: [1, 0]}}", [["1", "0"]]),
    "one method": (f"methods: {TWO}, embedded: [1, 0]}}", [["1", "0"]]),
    "beside a family": (
        "methods: {family: gauss, stages: 2, embedded: [sqrt(3), 0]}",
        [["sqrt(3)", "0"]],
    ),
    "one stage": ("A: [[0]]\nb: 1\nembedded: 2/3", [["2/3"]]),
    "several methods": (
        f"methods: [{TWO}, embedded: [1, 0]}},"
        " {family: gauss, stages: 1, embedded: [3]}]\ntransfer: interpolation",
        [["1", "0"], ["3"]],
    ),
    "blocks": (
        "tableau: {A: [[[[0]], null], [[[1]], [[1/2]]]], b: [[1], [1]], embedded: [[2], [3]]}",
        [["2"], ["3"]],
    ),
    "ark, a row per colour": (
        "ark: {A: [[[0]], [[1]]], b: [1], embedded: [[2], [3]]}",
        [["2"], ["3"]],
    ),
    "ark, one row": (
        "ark: {A: [[[0, 0], [1, 0]], [[0, 0], [0, 1]]], b: [0, 1], embedded: [2, 3]}",
        [["2", "3"], ["2", "3"]],
    ),
    "prk": (
        f"prk: {{q: {TWO}, embedded: [1, 0]}}, p: {TWO}, embedded: [0, 1]}}}}",
        [["1", "0"], ["0", "1"]],
    ),
    "semi-separable": (
        f"methods: [{TWO}, embedded: [1, 0]}}, {TWO}, embedded: [0, 1]}}]\n"
        "transfer: interpolation\nstructure: semi-separable",
        [["1", "0"], ["1", "0"], ["0", "1"]],
    ),
    "a parameter": (f"parameters: {{w: 1/3}}\n{HEUN}embedded: [w, 1 - w]", [["1/3", "2/3"]]),
}


@pytest.mark.parametrize("form", FORMS)
def test_embedded_weights_are_read_in_every_form(form: str) -> None:
    """One exact row a colour of the tableau; V¹ and F¹ of a pair have those of colour 1."""
    text, rows = FORMS[form]
    method = loads(text)
    assert method.embedded is not None
    found = [[to_text(x) for x in row] for row in method.embedded]
    assert found == rows
    assert method.dense is None


def test_without_the_key_there_are_none() -> None:
    """A file that says nothing of further weights has none, and is falsy about them."""
    method = loads(HEUN)
    assert method.embedded is None
    assert not method.further


def test_dense_output_has_a_polynomial_a_stage() -> None:
    """The coefficients of θ, θ², … are kept stage by stage, and the weights at θ are their
    values.
    """
    dense = load(str(VALID / "embedded-and-dense.gark.yaml")).dense
    assert dense is not None
    assert dense.degree == 3
    assert dense.weights[0][0] == (fmpq(1), fmpq(-4, 3), fmpq(5, 9))
    assert dense.coefficients(2) == ((fmpq(-4, 3), fmpq(1), fmpq(4, 3), fmpq(-1)),)
    assert dense.at(fmpq(1)) == ((fmpq(2, 9), fmpq(1, 3), fmpq(4, 9), fmpq(0)),)
    assert dense.at(fmpq(0)) == ((fmpq(0),) * 4,)


def test_methods_may_have_dense_output_of_different_degree() -> None:
    """The shorter polynomials get zeros, so that all have the coefficients of one degree."""
    one = "dense: {degree: 1, weights: [[1], [0]]}"
    two = "dense: {degree: 2, weights: [[1, 2], [3, 4]]}"
    method = loads(f"methods: [{TWO}, {one}}}, {TWO}, {two}}}]\ntransfer: interpolation")
    assert method.dense is not None
    assert method.dense.weights[0] == ((fmpq(1), fmpq(0)), (fmpq(0), fmpq(0)))


FAULTS = {
    "too few": (f"{HEUN}embedded: [1]", 3, "1 entry for 2 stages"),
    "a matrix": (f"{HEUN}embedded: [[1, 0]]", 3, "in a list, for one colour"),
    "an unknown": (f'{HEUN}embedded: ["?", 0]', 3, "embedded, entry 1 is unknown"),
    "one row for two": (
        "tableau:\n  A: [[[[0]], null], [null, [[0]]]]\n  b: [[1], [1]]\n  embedded: [1, 1]",
        4,
        "embedded has one row for 2 colours",
    ),
    "one part of a prk": (
        f"prk:\n  q: {TWO}, embedded: [1, 0]}}\n  p: {TWO}}}",
        2,
        "q has it and p does not",
    ),
    "inside of a row": (
        "tableau:\n  A: [[[[0]], null], [null, [[0]]]]\n  b: [[1], [1]]\n  embedded: [[1], [1, 2]]",
        4,
        "embedded^{2} has 2 entries for 1 stage",
    ),
    "dense without a degree": (f"{HEUN}dense: {{weights: [[1], [0]]}}", 3, "dense: degree missing"),
    "dense rows": (
        f"{HEUN}dense: {{degree: 1, weights: [[1]]}}",
        3,
        "dense, weights has 1 row for 2 stages",
    ),
    "dense degree": (f"{HEUN}dense: {{degree: 61, weights: [[1], [0]]}}", 3, "at most 60"),
    "dense blocks": (
        "ark:\n  A: [[[0]], [[1]]]\n  b: [1]\n  dense: {degree: 1, weights: [[[1]], [[1]], [[1]]]}",
        4,
        "dense, weights has 3 blocks for 2 colours",
    ),
}


@pytest.mark.parametrize("case", FAULTS)
def test_what_does_not_fit_is_one_fault_with_its_place(case: str) -> None:
    """Each slip is told once, on its line."""
    text, line, message = FAULTS[case]
    with pytest.raises(MethodFileError) as caught:
        loads(text)
    (fault,) = caught.value.faults
    assert message in fault.message
    assert fault.line == line


SPELLINGS = ("bhat", "b_hat", "bembed", "btilde", "b2", "embeded")


@pytest.mark.parametrize("key", SPELLINGS)
def test_other_names_are_told_the_key(key: str) -> None:
    """What other programs call embedded weights is answered with the key, at every place of b."""
    for text in (
        f"{HEUN}{key}: [1, 0]",
        f"methods: {TWO}, {key}: [1, 0]}}",
        f"methods: {{family: gauss, stages: 2, {key}: [1, 0]}}",
        f"prk: {{q: {TWO}, {key}: [1, 0]}}, p: {TWO}}}}}",
        f"ark: {{A: [[[0]]], b: [1], {key}: [1]}}",
    ):
        with pytest.raises(MethodFileError) as caught:
            loads(text)
        assert any("embedded" in x.help for x in caught.value.faults)


@st.composite
def further_of(draw: st.DrawFn, stages: list[int], degree: int) -> Further:
    """Embedded weights, dense output, or both."""

    def row(length: int) -> Vector:
        return draw(st.tuples(*[rationals] * length))

    embedded = tuple(row(s) for s in stages)
    blocks = [tuple(row(degree) for _ in range(s)) for s in stages]
    dense = DenseOutput(tuple(blocks))
    kept = draw(st.sampled_from([(1, 0), (0, 1), (1, 1)]))
    return Further(embedded if kept[0] else None, dense if kept[1] else None)


@given(st.data())
@settings(max_examples=at_most(12, 40))
def test_a_written_file_has_the_same_further_weights(data: st.DataObject) -> None:
    """Whatever the tableau, embedded weights and dense output survive writing and reading."""
    tableau = data.draw(tableaus())
    stages = [len(colour.b) for colour in tableau.colours]
    degree = data.draw(st.integers(1, 3))
    further = data.draw(further_of(stages, degree))
    again = loads(write_tableau_file(tableau, "it", further=further))
    assert again.further == further
    assert again.tableau == tableau


EXAMPLES = sorted(VALID.glob("embedded-*.gark.yaml"))


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda x: x.name)
def test_examples_come_back_from_their_spelled_out_file(path: Path) -> None:
    """Each form is written so that it has the same further weights: exactly, and rounded within
    its digits.
    """
    method = load(str(path))
    text = write_tableau_file(method.tableau, "again", further=method.further)
    assert texts(loads(text).further) == texts(method.further)
    decimals = entries(method.tableau).in_decimals(20)
    rounded = loads(write_rounded(method.tableau, decimals, "rounded", method.further))
    assert shape(rounded.further) == shape(method.further)
    assert rounded.embedded is None or method.embedded is not None
    for row, exact in zip(rounded.embedded or (), method.embedded or (), strict=True):
        for x, y in zip(row, exact, strict=True):
            assert within(x - y, fmpq(1, 10**18))


def texts(further: Further) -> list[str]:
    """Every number as text, in order."""
    found: list[str] = []

    def noted(number: Number) -> Number:
        found.append(to_text(number))
        return number

    further.changed(noted)
    return found


def shape(further: Further) -> object:
    """How many numbers there are where."""
    return further.changed(lambda _: fmpq(0))


def test_the_file_of_a_conjugate_leaves_them_out() -> None:
    """What is written with ``conjugate: true`` has no further weights, at the top or inside."""
    beside = "embedded: [1, 0], dense: {degree: 1, weights: [[1], [0]]}"
    for text in (
        f"methods: {TWO}, {beside}}}",
        f"{HEUN}embedded: [1, 0]",
        f"tableau: {TWO}, {beside}}}",
    ):
        method = loads(text)
        assert method.further
        conjugated = loads(write_conjugate_of(method, "conjugate"))
        assert conjugated.is_conjugate
        assert not conjugated.further


def test_a_family_keeps_them_as_functions_of_its_parameters() -> None:
    """Free parameters may stand in embedded weights, and the file with values has them."""
    text = "parameters: {w: free}\nA: [[0, 0], [w, 0]]\nb: [1 - 1/(2*w), 1/(2*w)]\n"
    family = loads_family(f"{text}embedded: [1 - w, w]")
    assert family.further.embedded is not None
    assert str(family.further.embedded[0][1]) == "w"
    made = loads(with_values(family, {"w": "2/3"}, "found", "order: 2"))
    assert made.embedded == ((fmpq(1, 3), fmpq(2, 3)),)


@given(tableaus())
@settings(max_examples=at_most(8, 20))
def test_a_tableau_with_its_own_weights_is_itself(tableau: Tableau) -> None:
    """Putting b in place of b changes nothing, and other weights change nothing else."""
    own = tuple(colour.b for colour in tableau.colours)
    assert with_weights(tableau, own) == tableau
    zeros = tuple(tuple(fmpq(0) for _ in row) for row in own)
    changed = with_weights(tableau, zeros)
    back = [replace(colour, b=row) for colour, row in zip(changed.colours, own, strict=True)]
    assert replace(changed, colours=tuple(back)) == tableau
