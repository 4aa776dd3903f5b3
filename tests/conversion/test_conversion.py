"""Methods in other forms are the same methods, and keep what is still true of them."""

from __future__ import annotations

from itertools import chain
from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli.check.check_file import check_file
from garkcli.conversion.convert import convert
from garkcli.conversion.rosenbrock import FORMS
from garkcli.conversion.sheet import CannotConvert, Sheet, sheet_of
from garkcli.conversion.targets import TARGETS, as_canonical, as_gark
from garkcli.errors import UsageProblem
from garkcli.exact.field import ZERO, Number
from garkcli.frozen import replace
from garkcli.methodfile.load import load, loads
from garkcli.methodfile.writer import can_spell_out, write_tableau_file
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import admissible_trees, elementary_weight, is_admissible
from garkcli.tableau.embedded import DenseOutput, Further, with_weights
from garkcli.tableau.garkmethod import GarkMethod
from garkcli.tableau.tableau import Tableau
from tests.catalogue.catalogue import entries
from tests.catalogue.method_files import method_file
from tests.cli.harness import ROOT, gark
from tests.conversion.renumbered import orders_of, renumbered
from tests.methodfile.test_further import further_of
from tests.methodfile.test_writer import tableaus
from tests.whole import at_most, sample

METHODS = sorted((ROOT / "methods").glob("*.gark.yaml"))
CATALOGUE = entries()
PAIR = """
name: Bogacki-Shampine
description: the pair of two orders
reference: P. Bogacki, L. F. Shampine 1989
A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 3/4, 0, 0], [2/9, 1/3, 4/9, 0]]
b: [2/9, 1/3, 4/9, 0]
embedded: [7/24, 1/4, 1/3, 1/8]
dense:
  degree: 3
  weights: [[1, -4/3, 5/9], [0, 1, -2/3], [0, 4/3, -8/9], [0, -1, 1]]
expect: {order: 3, embedded-order: 2, fsal: true, symplectic: false}
"""


def weights_of(tableau: Tableau, trees: list[Tree]) -> list[Number]:
    """The elementary weights of trees."""
    return [elementary_weight(tableau, tree) for tree in trees]


def trees_of(tableau: Tableau, upto: int) -> list[Tree]:
    """The admissible trees up to an order."""
    found = (admissible_trees(tableau, n) for n in range(1, upto + 1))
    return list(chain.from_iterable(found))


def assert_same_method(one: GarkMethod, other: GarkMethod) -> None:
    """All trees up to order 4 have the same weights, embedded and dense ones too."""
    trees = trees_of(one.tableau, 4)
    assert len(trees_of(other.tableau, 4)) == len(trees)
    assert all(is_admissible(other.tableau, tree) for tree in trees)
    pairs = [(one.tableau, other.tableau)]
    for first, second in zip(rows(one), rows(other), strict=True):
        first_tableau = with_weights(one.tableau, first)
        pairs.append((first_tableau, with_weights(other.tableau, second)))
    for tableau, converted in pairs:
        found = weights_of(converted, trees)
        wanted = weights_of(tableau, trees)
        assert list(map(str, found)) == list(map(str, wanted))


def rows(method: GarkMethod) -> list[tuple[tuple[Number, ...], ...]]:
    """Embedded weights, and the dense ones at two places."""
    found = [] if method.embedded is None else [method.embedded]
    if method.dense is not None:
        found += [method.dense.at(x) for x in (fmpq(1, 3), fmpq(2))]
    return found


@given(st.data())
@settings(max_examples=at_most(10, 200))
def test_a_form_is_the_same_method(data: st.DataObject) -> None:
    """Whatever the tableau, each form that is not refused has the same elementary weights."""
    tableau = data.draw(tableaus())
    stages = [len(colour.b) for colour in tableau.colours]
    further = data.draw(further_of(stages, 2))
    method = loads(write_tableau_file(tableau, "it", further=further))
    to = data.draw(
        st.sampled_from([x for x in TARGETS if x not in {"pair", "recovered", *FORMS[1:]}])
    )
    try:
        made = convert(method, to).method
    except CannotConvert:
        assert to in {"ark", "prk", "recovered"} or TARGETS[to].printed
        return
    assert_same_method(method, made)


@pytest.mark.parametrize("to", ["2N", "3R", "shu-osher"])
def test_a_field_without_arguments_has_no_low_storage(to: str) -> None:
    """A form with a zero matrix would be for y' = f(y), with further trees."""
    method = loads("tableau: {A: [[null]], b: [[1]], c: [[0]]}\n")
    with pytest.raises(CannotConvert, match="form for vector fields of y"):
        convert(method, to)


COMPLETE = """
tableau:
  A: [[[[1/2]], [[1/3, 1/5]]], [[[1/7], [1]], [[0, 2], [1/4, 0]]]]
  b: [[1], [1/4, 3/4]]
  c: [[1/2], [0, 1]]
  embedded: [[1/2], [1/9, 1]]
"""


def test_stages_of_several_colours_become_shared() -> None:
    """One row of stages has those of both colours, with zeros, and the method is the same."""
    method = loads(COMPLETE)
    made = convert(method, "ark").method
    assert len(made.tableau.spaces) == 1
    assert made.stages == (3, 3)
    assert_same_method(method, made)
    once_more = convert(convert(made, "gark").method, "ark").method
    assert once_more.tableau == made.tableau


def sheets_are_refused(method: GarkMethod) -> bool:
    """Whether a method has no exact entries, or no file spells them out."""
    try:
        return not can_spell_out(sheet_of(method).tableau)
    except CannotConvert:
        return True


@pytest.mark.parametrize("path", sample(METHODS, 2), ids=lambda x: x.name)
def test_methods_in_every_form(path: Path) -> None:
    """The methods of the project: what is written loads, is the same method, and its claims hold;
    what is refused has a reason and a cure.
    """
    method = load(str(path))
    for name in ("gark", "canonical"):
        try:
            made = convert(method, name).method
        except CannotConvert:
            assert sheets_are_refused(method)
            continue
        exact = sheet_of(method).tableau
        trees = trees_of(exact, 3)
        assert list(map(str, weights_of(made.tableau, trees))) == list(
            map(str, weights_of(exact, trees))
        )


@pytest.mark.parametrize("name", ["ark-ars222", "prk-lobatto-iiia-iiib", "stoermer-verlet"])
def test_there_and_back(name: str) -> None:
    """An additive and a partitioned method as GARK methods, and back again."""
    method = load(str(ROOT / "methods" / f"{name}.gark.yaml"))
    general = convert(method, "gark").method
    assert len(general.tableau.spaces) == general.tableau.size
    assert not general.tableau.is_partitioned
    back = convert(general, name.partition("-")[0].replace("stoermer", "prk"))
    assert str(back.method.A) == str(method.A)
    assert str(back.method.b) == str(method.b)
    assert str(back.method.c) == str(method.c)
    parts = [colour.part for colour in back.method.tableau.colours]
    assert parts == [colour.part for colour in method.tableau.colours]


@given(st.data())
@settings(max_examples=at_most(8, 200))
def test_the_canonical_form_knows_no_numbering(data: st.DataObject) -> None:
    """Stages renumbered, one of them twice, one more without influence: the same file."""
    tableau = data.draw(tableaus())
    stages = [len(colour.b) for colour in tableau.colours]
    further = data.draw(further_of(stages, 1))
    method = of(tableau, further)
    other = renumbered(sheet_of(method), data.draw(orders_of(sheet_of(method))))
    k = data.draw(st.integers(0, len(tableau.spaces) - 1))
    longer = with_stage_twice(other, k)
    wanted = as_canonical(method)
    assert as_canonical(of_sheet(other)) == wanted
    assert as_canonical(of_sheet(longer)) == wanted
    assert as_canonical(of_sheet(wanted)) == wanted


def of(tableau: Tableau, further: Further) -> GarkMethod:
    """A method."""
    return GarkMethod(tableau=tableau, embedded=further.embedded, dense=further.dense)


def of_sheet(sheet: Sheet) -> GarkMethod:
    """A sheet as a method."""
    return of(sheet.tableau, sheet.further)


def with_stage_twice(sheet: Sheet, k: int) -> Sheet:
    """The method with stage 1 of colour k twice: the copy has half of each entry that is seen of
    it.
    """
    old = sheet.tableau

    def doubled(row: tuple[Number, ...]) -> tuple[Number, ...]:
        half = row[0] / fmpq(2)
        return (half, *row[1:], half)

    def repeated(row: tuple[Number, ...]) -> tuple[Number, ...]:
        return (*row, row[0])

    colour = old.colours[k]
    colours = list(old.colours)
    colours[k] = replace(colour, b=doubled(colour.b), c=repeated(colour.c))
    spaces = list(old.spaces)
    spaces[k] = type(spaces[k])(repeated(spaces[k].nodes))
    blocks = {}
    for (space, m), block in old.blocks.items():
        changed = block if space != k else (*block, block[0])
        if m == k:
            changed = tuple(map(doubled, changed))
        blocks[space, m] = changed
    embedded, dense = sheet.further.embedded, sheet.further.dense
    if embedded is not None:
        embedded = (*embedded[:k], doubled(embedded[k]), *embedded[k + 1 :])
    if dense is not None:
        first, *others = dense.weights[k]
        half = tuple(x / 2 for x in first)
        own = (half, *others, half)
        dense = DenseOutput((*dense.weights[:k], own, *dense.weights[k + 1 :]))
    return Sheet(Tableau(tuple(spaces), tuple(colours), blocks), Further(embedded, dense))


def test_sorting_keeps_explicit_methods_explicit() -> None:
    """Stages come after those that they need, whatever their nodes are."""
    text = "{A: [[0, 0, 0], [1, 0, 0], [1/3, 1/6, 0]], b: [1/6, 1/6, 2/3]}"
    made = convert(loads(text), "canonical").method
    assert str(made.A) == "((0, 0, 0), (1, 0, 0), (1/3, 1/6, 0))"


def test_what_a_file_says_stays() -> None:
    """Name, description, reference, embedded and dense weights, and the claims that hold."""
    made = convert(loads(PAIR), "canonical", 5)
    method = made.method
    assert (method.name, made.left_out) == ("Bogacki-Shampine", ())
    assert "P. Bogacki" in str(method.reference)
    assert method.description == "the pair of two orders"
    assert [x.key for x in method.claims] == ["order", "embedded-order", "fsal", "symplectic"]
    assert_same_method(loads(PAIR), method)


def test_stages_that_do_nothing_come_first() -> None:
    """They see nothing and have no weight; a longer method than wanted is refused."""
    made = convert(loads(PAIR), stages=6).method
    assert made.stages == (6,)
    assert [row[:2] for row in made.A] == [(ZERO, ZERO)] * 6
    assert made.A[0] == made.A[1] == (ZERO,) * 6
    with pytest.raises(CannotConvert, match="4 stages, more than 3"):
        convert(loads(PAIR), stages=3)


def test_the_pair_is_claimed_what_was_claimed_of_it(tmp_path: Path) -> None:
    """The orders of the pair become those of the method; all of its claims hold."""
    method = load(str(ROOT / "methods" / "collocation.gark.yaml"))
    made = convert(method, "pair")
    assert {x.key for x in made.method.claims} == {"order", "bound", "sharp-bound"}
    assert "conjugate-order" in made.left_out
    path = tmp_path / "pair.gark.yaml"
    path.write_text(made.method.text, encoding="utf-8")
    assert check_file(str(path)).ok
    assert made.method.stages == (2, 3, 2, 3)
    further = convert(loads(PAIR.replace("4/9, 0]\n", "2/9, 2/9]\n")), "pair")
    assert further.loses_further


def test_claims_that_do_not_hold_are_left_out_and_named() -> None:
    """Of a symplectic partitioned method with shared stages the GARK method is not symplectic."""
    path = "methods/prk-lobatto-iiia-iiib.gark.yaml"
    run = gark("convert", path, "--to", "gark")
    assert run.code == 0
    assert run.err == f"{path}: claims that are left out: symplectic\n"
    assert [x.key for x in loads(run.out).claims] == ["order"]


@pytest.mark.parametrize(
    ("text", "to", "why"),
    [
        ("methods: {family: gauss, stages: 6}", "gark", "no simple radicals"),
        (COMPLETE, "prk", "neither have the same stages"),
        (COMPLETE + "linear: [2]\n", "ark", "colour 2 is linear"),
        (COMPLETE.replace("[[1/3, 1/5]]", "null"), "ark", "do not depend"),
        (PAIR, "prk", "has 1 colour"),
        (
            "{methods: [{family: gauss, stages: 2}, {family: gauss, stages:"
            " 3}], transfer: collocation, structure: semi-separable}",
            "spelled-out",
            "spells out a GARK method",
        ),
    ],
)
def test_what_has_no_such_form_is_refused(text: str, to: str, why: str) -> None:
    """With the reason and a cure; the program ends with 2."""
    with pytest.raises(CannotConvert, match=why) as caught:
        convert(loads(text), to)
    assert caught.value.help
    run = gark("convert", "-", "--to", to, stdin=text)
    assert (run.code, run.out) == (2, "")


def test_no_such_form() -> None:
    """The forms are named."""
    with pytest.raises(UsageProblem, match="no form 'gurk'"):
        convert(loads(PAIR), "gurk")


def test_published_tables_have_canonical_forms() -> None:
    """Of additive and explicit tables with superfluous stages: smaller, the same order by their
    own claims, rounded digits as they are printed.
    """
    for name in ("ASCHER_121", "sundials_BOGACKI_SHAMPINE_4_2_3"):
        method = loads(method_file(CATALOGUE[name]))
        made = convert(method, "canonical").method
        assert sum(made.stages) < sum(method.stages)
        assert made.tolerance == method.tolerance
        again = convert(made, "canonical").method
        assert again.text == made.text


def test_other_formats() -> None:
    """The tableau as text, JSON and LaTeX."""
    path = "methods/ark-ars222.gark.yaml"
    shown = gark("convert", path, "--to", "gark", "--format", "json")
    assert '"schema": "gark/tableau/1"' in shown.out
    assert "sqrt(2)" in gark("convert", path, "--format", "text").out


def test_every_form_has_a_name() -> None:
    """Its name and its line are there."""
    for name, target in TARGETS.items():
        assert target.name == name
        assert target.summary
    assert as_gark(loads(COMPLETE)).tableau == loads(COMPLETE).tableau
