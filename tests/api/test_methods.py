"""The functions of the package take whatever has a tableau, within the tolerance of its file."""

from __future__ import annotations

import inspect
import pydoc
import re
from pathlib import Path

import pytest
from flint import fmpq

import garkcli
from garkcli import (
    GarkMethod,
    Tableau,
    analyse,
    conditions,
    conjugate,
    converge,
    diagonal_method,
    elementary_weight,
    find_order,
    gark,
    is_symplectic,
    load,
    loads,
    method_of,
    pair,
    simplifying,
)
from garkcli.check.analysis import analyse as analyse_tableau
from garkcli.errors import MethodError, MethodFileError
from garkcli.families.registry import diagonal_method as of_registry
from garkcli.order.certificate import find_order as exact_order
from garkcli.problems.oscillator import Oscillator
from garkcli.tableau import forms
from garkcli.transfer import RULES
from tests.whole import in_whole

GAUSS = loads("methods: [{family: gauss, stages: 2}]")
ROUNDED = loads(
    "A: [[0.25, -0.038675134594813], [0.538675134594813, 0.25]]\nb: [0.5, 0.5]\ntolerance: 1e-14"
)
OFF_DIAGONAL = [(1, 2), (2, 1)]
KINDS = {
    "file": GAUSS,
    "tableau": GAUSS.tableau,
    "family": diagonal_method("gauss", 2),
    "diagonal method": of_registry("gauss", 2),
}


@pytest.mark.parametrize("kind", KINDS)
def test_every_kind_of_method_is_taken(kind: str) -> None:
    """A file, a tableau, a family: the same order, conditions, weights and convergence."""
    method = KINDS[kind]
    tree = _trees()[0]
    assert find_order(method).order == 4
    assert analyse(method).order.order == 4
    assert is_symplectic(method)
    assert find_order(conjugate(method)).order == 4
    assert find_order(pair(method)).order == 4
    assert simplifying(method).B == (4,)
    assert elementary_weight(method, tree) == fmpq(1, tree.density)
    assert all(not condition.residual for condition in conditions(method, _trees()))


def _trees() -> list[garkcli.Tree]:
    """A few trees of one colour."""
    leaf = garkcli.Tree(0, ())
    stem = garkcli.Tree(0, (leaf,))
    return [stem, garkcli.Tree(0, (stem,)), garkcli.Tree(0, (leaf, leaf))]


def test_the_tolerance_of_a_file_is_honoured() -> None:
    """Rounded coefficients have their order within the tolerance of the file, in every question."""
    assert exact_order(ROUNDED.tableau).order == 2
    assert find_order(ROUNDED).order == 4
    assert is_symplectic(ROUNDED)
    assert simplifying(ROUNDED).B == (4,)
    assert all(condition.holds for condition in conditions(ROUNDED, _trees()))
    wanted = analyse_tableau(ROUNDED.tableau, tolerance=ROUNDED.tolerance)
    assert analyse(ROUNDED).order == wanted.order
    assert find_order(conjugate(ROUNDED)) == wanted.conjugate_order
    assert find_order(pair(ROUNDED)) == wanted.pair_order


def test_a_given_tolerance_goes_before_that_of_the_file() -> None:
    """0 asks for the exact answer, a text for another tolerance, and nonsense is refused."""
    assert find_order(ROUNDED, tolerance=0).order == 2
    assert find_order(ROUNDED, tolerance="1e-13").order == 4
    assert find_order(ROUNDED.tableau, tolerance=fmpq(1, 10**13)).order == 4
    with pytest.raises(MethodError, match="between 0 and 1"):
        find_order(ROUNDED, tolerance=2)


def test_a_conjugate_goes_back() -> None:
    """The conjugate of the conjugate is the method itself."""
    back = conjugate(conjugate(ROUNDED))
    assert back is ROUNDED
    assert conjugate(ROUNDED).name == f"symplectic conjugate of {ROUNDED.name}"
    assert isinstance(conjugate(ROUNDED.tableau), Tableau)


def test_convergence_takes_a_method() -> None:
    """``converge`` runs with the method as it was loaded."""
    oscillator = Oscillator.default(1, fmpq(1))
    found, wanted = (converge(pair(GAUSS), oscillator), converge(pair(GAUSS.tableau), oscillator))
    assert [(row.h, str(row.error)) for row in found.rows] == [
        (row.h, str(row.error)) for row in wanted.rows
    ]


def test_gark_puts_diagonal_methods_together() -> None:
    """By a rule, or with the blocks that the rule makes; and what does not go is refused."""
    gauss, lobatto = (diagonal_method("gauss", 2), diagonal_method("lobatto-iiia", 3))
    l, m = of_registry("gauss", 2), of_registry("lobatto-iiia", 3)
    rule = RULES["interpolation"]
    wanted = forms.gark([l, m], {(0, 1): rule(l, m), (1, 0): rule(m, l)})
    made = gark([gauss, lobatto], "interpolation")
    assert made.tableau.blocks == wanted.blocks
    again = gark([gauss, lobatto], {key: made.A[key] for key in OFF_DIAGONAL})
    assert str(again.A) == str(made.A)
    with pytest.raises(MethodError, match=r"\(0, 1\) is not a block"):
        gark([gauss, lobatto], {(0, 1): [[1]]})
    with pytest.raises(MethodError, match="no transfer rule"):
        gark([gauss, lobatto], "interpolate")
    with pytest.raises(MethodError, match="not a diagonal method"):
        gark([pair(gauss), gauss])


def test_what_is_no_method_is_refused() -> None:
    """A path to nowhere, or nothing at all, is no method; the error says how to get one."""
    with pytest.raises(MethodFileError, match="no such file"):
        find_order("methods/no-such.gark.yaml")
    with pytest.raises(MethodError, match="a method is expected, not NoneType") as caught:
        simplifying(None)  # type: ignore[arg-type]
    assert "load(path)" in caught.value.help


def test_entries_are_those_that_are_printed() -> None:
    """One colour gives a matrix and rows, several give blocks; without simple radicals enclosures."""
    assert [str(x) for x in GAUSS.c] == ["1/2 - sqrt(3)/6", "1/2 + sqrt(3)/6"]
    two = loads("methods: [{family: gauss, stages: 1}, {family: kutta}]\ntransfer: collocation")
    assert two.stages == (1, 3)
    assert len(two.A[2, 1]) == 3
    assert two.b[1] == (1,)
    five = diagonal_method("gauss", 5)
    assert abs(float(five.c[0]) - 0.046910077030668) < 1e-15
    assert method_of(GAUSS) is GAUSS


def test_representations_are_short() -> None:
    """What a session shows of a method fits a line."""
    shown = [
        GAUSS,
        GAUSS.tableau,
        pair(GAUSS),
        diagonal_method("gauss", 40),
        analyse(GAUSS),
        analyse(ROUNDED),
        find_order(ROUNDED),
    ]
    assert max(len(repr(x)) for x in shown) < 80
    assert repr(GAUSS) == "<MethodFile <text>: 1 colour, stages 2>"


def test_the_package_lists_its_names() -> None:
    """``dir`` has every public name, each of which is there, documented, and found again."""
    shown = {name for name in dir(garkcli) if not name.startswith("__")}
    assert shown == set(garkcli.__all__)
    for name in garkcli.__all__:
        thing = getattr(garkcli, name)
        assert inspect.getdoc(thing)
        assert getattr(garkcli, name) is thing
    with pytest.raises(AttributeError, match="no attribute 'find_oder'"):
        garkcli.find_oder  # noqa: B018 -- the misspelt name is the point


def test_help_of_the_package_has_every_name() -> None:
    """What ``help(garkcli)`` begins with names all that is public, and nothing else."""
    told = inspect.getdoc(garkcli)
    assert told is not None
    words = set(re.findall(r"\w+", told))
    assert set(garkcli.__all__) <= words
    named = {word for word in words if "_" in word}
    assert named <= set(garkcli.__all__)


def test_help_of_the_package_is_written() -> None:
    """``help(garkcli)`` asks each public class for its signature: its types are there to be read."""
    assert "class MethodFile(" in pydoc.render_doc(garkcli, renderer=pydoc.plaintext)


def test_the_example_of_a_file_on_disk(tmp_path: Path) -> None:
    """A file that ``from_arrays`` wrote loads as the same method."""
    made = garkcli.from_arrays([[0, 0], ["1/2", 0]], [0, 1], name="midpoint")
    path = tmp_path / "m.gark.yaml"
    path.write_text(made.text, encoding="utf-8")
    loaded = load(str(path))
    assert loaded.tableau == made.tableau
    assert loaded.name == made.name == "midpoint"
    assert isinstance(loaded, GarkMethod)


@pytest.mark.parametrize("name", ["rk4", pytest.param("collocation", marks=in_whole)])
def test_a_method_answers_by_itself(name: str, tmp_path: Path) -> None:
    """What the functions find, asked of one colour and of several alike."""
    method = load(name)
    assert method.check().order == find_order(method)
    assert repr(method.stability()) == repr(garkcli.find_stability(method))
    assert method.converge().observed_order == garkcli.converge(method).observed_order
    assert method.converge("pendulum").observed_order is not None
    assert method.to_latex() == garkcli.render(method, "latex")
    assert method.plot(tmp_path / "region.svg").axes
    assert (tmp_path / "region.svg").stat().st_size > 1000


def test_load_says_what_it_takes() -> None:
    """A number is neither a path nor a name."""
    with pytest.raises(MethodError, match="a path or a name is expected, not int"):
        load(3)  # type: ignore[arg-type]
