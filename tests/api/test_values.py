"""What a session shows and takes: short values, colours from 1, whatever stands for a method."""

from __future__ import annotations

import copy
import math
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st

import garkcli
from garkcli import GarkError, MethodError, Tree, TreeError, load, loads
from tests.whole import in_whole

FAMILY = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - 1/(2*t), 1/(2*t)]"
HEUN = ([[0, 0], [1, 0]], ["1/2", "1/2"])
VERLET = load("stoermer-verlet")
OF_A_METHOD: dict[str, Callable[[Any], Any]] = {
    "find_order": garkcli.find_order,
    "find_orders": garkcli.find_orders,
    "analyse": garkcli.analyse,
    "is_symplectic": garkcli.is_symplectic,
    "simplifying": garkcli.simplifying,
    "find_stability": garkcli.find_stability,
    "find_property": lambda x: garkcli.find_property(x, "explicit"),
    "claims_of": lambda x: garkcli.claims_of(x, ["order"]),
    "with_claims": lambda x: garkcli.with_claims(x, ["order"]),
    "conjugate": garkcli.conjugate,
    "pair": garkcli.pair,
    "symplectic_pair": lambda x: garkcli.symplectic_pair(x, [1], [1]),
    "reduced": garkcli.reduced,
    "convert": garkcli.convert,
    "compare": lambda x: garkcli.compare(x, HEUN),
    "conditions": lambda x: list(garkcli.conditions(x, ["[[]]"])),
    "all_conditions": lambda x: list(garkcli.all_conditions(x, 3)),
    "elementary_weight": lambda x: garkcli.elementary_weight(x, "[[]]"),
    "converge": lambda x: garkcli.converge(x, "oscillator"),
    "long_run": lambda x: garkcli.long_run(x, "oscillator", 1, 0.5),
    "bind": lambda x: garkcli.bind(x, "pendulum"),
    "backward_analysis": lambda x: garkcli.backward_analysis(x, 3),
    "prove_method": garkcli.prove_method,
    "certificate": lambda x: garkcli.certificate(x)[:9],
    "export": lambda x: garkcli.export(x, "csv")[:9],
    "cite": garkcli.cite,
    "gark": lambda x: garkcli.gark([x, "gauss-1"]),
    "assert_order": lambda x: garkcli.assert_order(x, 2),
    "method_of": garkcli.method_of,
}


@pytest.mark.parametrize("name", OF_A_METHOD)
def test_whatever_stands_for_a_method(name: str) -> None:
    """Each call takes a value, a name, arrays; what is none is refused with the cure."""
    call = OF_A_METHOD[name]
    shown = repr(call(garkcli.from_arrays(*HEUN)))
    assert repr(call(HEUN)) == shown
    assert repr(call({"A": HEUN[0], "b": HEUN[1]})) == shown
    call("heun")
    with pytest.raises(GarkError, match=r"load\(path\)"):
        call(3)
    with pytest.raises(GarkError, match="no such file"):
        call("no-such-method")


@in_whole
def test_values_are_short() -> None:
    """Nothing that a call returns fills a screen."""
    found = garkcli.converge("rk4", "pendulum", steps=[0.5, 0.25])
    run = garkcli.long_run("rk4", "pendulum", 2, 0.1)
    family = garkcli.loads_family(FAMILY)
    design = garkcli.find_parameters(family)
    stability = garkcli.find_stability("gauss-2")
    proof, exists = garkcli.prove_method("rk4"), garkcli.prove_method_exists("kvaerno-3")
    modified = garkcli.backward_analysis(VERLET, 3)
    energies = garkcli.modified_run(VERLET, "pendulum", 2, longest=0.5)
    (audited,) = garkcli.audit("tests/bridges/sources/kutta.csv")
    bound = garkcli.bind("rk4", "pendulum")
    values = [
        *(call(HEUN) for call in OF_A_METHOD.values()),
        *(found, *found.rows, found.problem, run, *run.invariants),
        *(family, design, *design.steps, garkcli.minimise(design, "error")),
        garkcli.search_methods(family, 2, starts=1),
        *(stability, *stability.linear, stability.linear[0].R),
        *(proof, proof.method, exists, modified, modified.equation, energies),
        *energies.energies,
        garkcli.modified_formula(VERLET, "pendulum", 2),
        *(audited, audited.table, bound, bound.at(20)),
        *(garkcli.problem("van-der-pol"), *garkcli.explain("density")),
        garkcli.check_file("rk4"),
        Tree(0, [Tree(1)]),
    ]
    values.append(garkcli.catalogue)
    for value in values:
        if not isinstance(value, (str, dict, list)):
            assert len(repr(value)) < 120, repr(value)


def test_colours_count_from_one() -> None:
    """In entries, trees, arguments and errors."""
    assert VERLET.A[1, 1] is None
    assert str(VERLET.A[1, 2]) == "((1/2, 0),)"
    assert str(VERLET.b) == "{1: (1,), 2: (1/2, 1/2)}"
    assert list(VERLET.A) == [(1, 1), (1, 2), (2, 1), (2, 2)]
    again = garkcli.from_arrays(VERLET.A, VERLET.b, VERLET.c)
    assert garkcli.compare(again, VERLET).sameness is not None
    for key in (0, 3, (0, 1)):
        with pytest.raises(KeyError, match="count from 1, the last is 2"):
            VERLET.b[key]
    with pytest.raises(KeyError, match=r"not a pair .* is \(2, 2\)"):
        VERLET.A[0]
    tree = garkcli.parse_tree("[[]_2]_1")
    assert (repr(tree), tree.colour) == ("<Tree [[]_2]_1>", 1)
    with pytest.raises(MethodError, match=r"\[\[\]_2\]_1 has colour 2"):
        garkcli.elementary_weight("rk4", "[[]_2]_1")
    with pytest.raises(MethodError, match="forces: there is no colour 0"):
        garkcli.symplectic_pair("rk4", [1], [0])
    with pytest.raises(MethodError, match="A: 0 is not a pair of colours"):
        garkcli.from_arrays({0: [[1]]}, {1: [1]})
    with pytest.raises(MethodError, match="b: 'x' is not a colour"):
        garkcli.from_arrays({(1, 1): [[1]]}, {"x": [1]})
    assert garkcli.count_trees(3, 2, linear=[1, 2]) == 8


def test_trees_that_there_are_none_of() -> None:
    """Texts, orders and colours that are no trees' are errors of the program, with their place."""
    with pytest.raises(TreeError, match="at character 3; "):
        garkcli.elementary_weight("rk4", "[[")
    with pytest.raises(ValueError, match="edges must be"):
        garkcli.count_trees(3, 2, edges=[[True]])
    for call in (
        lambda: garkcli.trees(0),
        lambda: garkcli.trees(2.5),
        lambda: garkcli.count_trees(3, 0),
        lambda: garkcli.find_order("rk4", limit=0),
        lambda: garkcli.diagonal_method("gauss", "two"),
    ):
        with pytest.raises(GarkError) as caught:
            call()
        assert caught.value.help
    with pytest.raises(MethodError, match="a tree is expected, not int"):
        garkcli.format_tree(3)  # type: ignore[arg-type]
    with pytest.raises(MethodError, match="a tree is expected, not int"):
        next(garkcli.conditions("rk4", 4))  # type: ignore[arg-type]


def test_what_names_nothing_is_refused() -> None:
    """Problems, objectives and formats, with the nearest that there is."""
    with pytest.raises(GarkError, match="pendulum"):
        garkcli.converge("rk4", "pendulm")
    with pytest.raises(GarkError, match="a problem is expected, not int"):
        garkcli.converge("rk4", 3)  # type: ignore[arg-type]
    with pytest.raises(GarkError, match="is not Hamiltonian"):
        garkcli.modified_formula("rk4", "van-der-pol", 2)
    with pytest.raises(GarkError, match="did you mean 'error'"):
        garkcli.minimise(garkcli.loads_family(FAMILY), "eror")
    with pytest.raises(GarkError, match="did you mean 'text'"):
        garkcli.cite("rk4", format="txt")
    with pytest.raises(MethodError, match="steps: '1/4' is not a list"):
        garkcli.converge("rk4", steps="1/4")
    with pytest.raises(MethodError, match="steps: there is none"):
        garkcli.converge("rk4", "pendulum", steps=[])
    with pytest.raises(GarkError, match=r"shares .* are not pairs"):
        garkcli.Oscillator(1, [1, 2])  # type: ignore[list-item]
    with pytest.raises(GarkError, match="did you mean 'order'"):
        garkcli.claims_of("rk4", ["ordr"])
    with pytest.raises(MethodError, match="takes a list of methods"):
        garkcli.gark("gauss-2")
    with pytest.raises(MethodError, match="a pair of no colour"):
        garkcli.symplectic_pair("rk4", [], [])
    with pytest.raises(MethodError, match="a family is expected, not int"):
        garkcli.find_parameters(3)  # type: ignore[arg-type]
    with pytest.raises(MethodError, match="settings: 3 is not a mapping"):
        load("rk4", settings=3)  # type: ignore[arg-type]


def test_a_start_has_as_many_numbers_as_unknowns() -> None:
    """Of any kind; what steps may be given without its digits."""
    bound = garkcli.bind("rk4", "pendulum")
    found = garkcli.integrate(bound, 0.1, 3, initial=["1", "1/2"])
    assert found == garkcli.integrate(bound.at(), "1/10", 3)
    assert found == garkcli.integrate(bound, 0.1, 3, np.array([1.0, 0.5]))
    for start in ([1], [1, 2, 3]):
        with pytest.raises(MethodError, match="for 2 unknowns"):
            garkcli.integrate(bound, 0.1, 3, initial=start)
        with pytest.raises(MethodError, match="for 2 unknowns"):
            list(garkcli.trajectory(bound, 0.1, 3, initial=start))


def test_one_of_several_goes_for_itself() -> None:
    """A tree and a key need no list around them."""
    (one,) = garkcli.conditions("rk4", "[[]]")
    assert one.holds
    assert garkcli.claims_of("rk4", "order") == {"order": "4"}


@given(st.integers(2, 10**6))
@settings(max_examples=5, deadline=None)
def test_entries_are_numbers_of_others(n: int) -> None:
    """The float of a root is the nearest one; NumPy and SymPy take entries as they are."""
    ((x,),) = loads(f"A: [[1 + sqrt({n})]]\nb: [1]").A
    if math.isqrt(n) ** 2 != n:
        exact = sympy.Integer(1) + sympy.sqrt(n)
        assert float(x) == float(exact.evalf(60))
        assert sympy.sympify(x) == exact


def test_entries_of_two_methods_are_compared() -> None:
    """The same number is the same wherever it was read, and may be reckoned with."""
    one, other = load("gauss-2"), load("gauss-2")
    assert one.A == other.A
    assert one.A[0][1] - other.A[0][1] == 0
    assert len({one.A[0][1], other.A[0][1]}) == 1
    assert one.A[0][1] != load("gauss-3").A[0][1]
    assert one.A[0][1] != other.A[1][0]


def test_arrays_of_entries() -> None:
    """A tableau is an array of floats, and a matrix of exact numbers."""
    method = load("gauss-3")
    A = np.array(method.A, dtype=float)
    assert A.shape == (3, 3)
    assert np.allclose(A.sum(axis=1), np.array(method.c, dtype=float))
    assert sympy.Matrix(method.A).trace() == sympy.Rational(1, 2)
    assert np.array(load("gauss-6").A, dtype=float).shape == (6, 6)


@pytest.mark.parametrize("name", ["rk4", "gauss-2", "stoermer-verlet"])
def test_methods_are_equal_copied_and_sent(name: str) -> None:
    """A method read once more, a deep copy and one from another process are equal to it, and with
    radicals too; so are its conjugate and the entries, and equal ones have one hash.
    """
    method = load(name)
    sent = pickle.loads(pickle.dumps(method))
    for other in (load(name), copy.deepcopy(method), sent):
        assert other == method
        assert hash(other) == hash(method)
        assert other.conjugate == method.conjugate
        assert other.b == method.b
    assert load("heun") != method
    assert sent.order == method.order


@pytest.mark.parametrize(
    "call",
    [
        lambda: load("no-such-file.yaml"),
        lambda: loads("A: [[0]]"),
        lambda: garkcli.parse_tree("[[]"),
        lambda: garkcli.conjugate(([[0]], [0])),
        lambda: garkcli.catalogue["no-such-name"],
        lambda: VERLET.A[0, 1],
    ],
)
def test_errors_reach_another_process(call: Callable[[], object]) -> None:
    """A pool of processes hands on what was raised: the error is the same on the other side."""
    with pytest.raises(GarkError) as caught:
        call()
    error = caught.value
    sent = pickle.loads(pickle.dumps(error))
    assert type(sent) is type(error)
    assert str(sent) == str(error)
    assert vars(sent) == vars(error)


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (lambda: garkcli.symplectic_pair("rk4", 1, 1), "such as [1]"),  # type: ignore[arg-type]
        (lambda: garkcli.convert("rk4", 3), "no form 3"),  # type: ignore[arg-type]
        (lambda: loads(b"A: [[0]]"), "a text is expected, not bytes"),  # type: ignore[arg-type]
        (lambda: garkcli.found_methods(None), "not NoneType"),  # type: ignore[arg-type]
        (lambda: garkcli.from_arrays([[0]], None), "b is missing"),
        (lambda: garkcli.from_arrays([{0, 1}, {1, 0}], [0, 1]), "a set is not an array"),
        (lambda: garkcli.from_arrays({(3, 3): [[0]]}, {1: [1], 3: [1]}), "b: nothing for colour 2"),
        (lambda: garkcli.from_arrays([[10**5000]], [1]), "more than 1000 digits"),
    ],
)
def test_what_is_of_another_kind_is_said(call: Callable[[], object], said: str) -> None:
    """What Python lets through is refused in the words of the interface."""
    with pytest.raises(GarkError) as caught:
        call()
    assert said in str(caught.value)


def test_colours_of_numpy_are_colours() -> None:
    """What a loop over arrays gives may name the colours."""
    one = np.int64(1)
    made = garkcli.from_arrays({(one, one): [["1/2"]]}, {one: [1]})
    assert made.order == 2


def test_powers_of_entries_are_whole() -> None:
    """A power that is no whole number is refused as numbers refuse it."""
    entry = load("gauss-2").A[0][1]
    assert entry**-1 * entry == 1
    with pytest.raises(TypeError):
        entry**0.5


@pytest.mark.parametrize("rule", ["collocation", "interpolation", "legendre"])
def test_methods_of_two_number_fields_are_coupled(rule: str) -> None:
    """As the file with the same methods, whose numbers come from one field."""
    names = ["gauss-2", "gauss-3"]
    made = garkcli.gark(names, rule)
    read = garkcli.loads(f"methods: [{', '.join(names)}]\ntransfer: {rule}")
    assert garkcli.compare(made, read).relation == "identical"
