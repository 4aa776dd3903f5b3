"""What holds for every value of free parameters, against methods with values."""

from __future__ import annotations

import json
import pickle

import jsonschema  # type: ignore[import-untyped]
import pytest
from flint import fmpq

from garkcli.check.analysis import analyse
from garkcli.check.check_file import check_file
from garkcli.check.every_facts import FamilyFact, fact_reason
from garkcli.check.every_family import every_family
from garkcli.check.every_properties import SIGNS, STABLE, find_property, is_comparing
from garkcli.check.every_value import EveryValue, every_value
from garkcli.check.outcome import Outcome
from garkcli.exact.cells import Interval
from garkcli.exact.roots import RealRoot
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import loads
from garkcli.page.look import Look
from garkcli.properties.subject import every_property
from garkcli.report.check_text import render
from garkcli.report.checked import REPORT
from tests.cli.harness import gark
from tests.whole import in_whole

SDIRK = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
TAU = """parameters: {tau: free}
methods:
  - {family: gauss, stages: 2}
  - {family: lobatto-iiia, stages: 3}
transfer: {interpolation: tau, collocation: 1 - tau}
"""
WEIGHT = "parameters: {w: free}\nA: [[0, 0], [1/(2*w), 0]]\nb: [1 - w, w]\n"
LIMIT = 12
DECIDED = {x.key for x in every_property() if is_comparing(x)} | {*STABLE, *SIGNS}
"""The properties that are decided for every value."""


@pytest.fixture(scope="module", params=[SDIRK, pytest.param(TAU, marks=in_whole), WEIGHT])
def found(request: pytest.FixtureRequest) -> tuple[str, EveryValue]:
    """A file of one parameter with what holds for every value."""
    text = request.param
    family = loads_family(text, is_design=False)
    return text, every_value(family, LIMIT)


VALUES = ("0", "1/4", "1/2", "1", "1/3", "-1/2", "5/3", "1/2 + sqrt(3)/6")


def holds_in(intervals: tuple[Interval, ...], root: RealRoot) -> bool:
    """Whether a number lies in a set."""
    for x in intervals:
        is_after = x.start is None or x.start < root
        is_before = x.end is None or root < x.end
        is_end = (x.has_start and x.start == root) or (x.has_end and x.end == root)
        if (is_after and is_before) or is_end:
            return True
    return False


def at(fact: FamilyFact, root: RealRoot) -> object:
    """What a fact says of one value of the parameter."""
    if fact.where is not None:
        return holds_in(fact.where, root)
    for special, value in fact.special:
        if special == root:
            return value
    return fact.value


def root_of(value: str) -> RealRoot:
    """A value as a root of its polynomial."""
    if "sqrt" in value:
        from flint import fmpz_poly

        return RealRoot(fmpz_poly([1, -6, 6]), 1)
    return RealRoot.rational(
        fmpq(*map(int, value.partition("/")[::2])) if "/" in value else fmpq(int(value))
    )


@pytest.mark.parametrize("value", VALUES)
def test_every_value_agrees_with_each(found: tuple[str, EveryValue], value: str) -> None:
    """Orders, B, C and D, symplecticity and properties of a method with a value are what is said
    of that value: by the ordinary certificate, without any polynomial in the parameter.
    """
    text, every = found
    [name] = every.parameters
    if every.family.poles and value == "0":
        return  # there is no such method
    method = loads(text, settings={name: value})
    ordinary = analyse(method.tableau, LIMIT)
    root = root_of(value)
    assert at(every.order.fact, root) == ordinary.order.order
    assert every.conjugate_order is not None
    assert every.pair_order is not None
    conjugate, pair = ordinary.conjugate_order, ordinary.pair_order
    expected = None if conjugate is None else conjugate.order
    assert at(every.conjugate_order.fact, root) == expected
    expected = None if pair is None else pair.order
    assert at(every.pair_order.fact, root) == expected
    for name in ("B", "C", "D", "bound"):
        assert at(every.simplifying(name), root) == getattr(ordinary.simplifying, name)
    assert at(every.symplectic, root) == ordinary.symplectic
    for key in DECIDED:
        fact = every.verdict(key)
        assert not fact.is_undecided, key
        assert root not in fact.unknown
        assert at(fact, root) == ordinary.subject.verdict(key).value, key


def test_properties_that_hold_or_not_are_decided_for_every_value() -> None:
    """A property of signs needs an entry in ``SIGNS``; numbers are decided for values alone."""
    assert {x.key for x in every_property() if x.kind == "truth"} <= DECIDED


EQUAL = f"[{', '.join(['g'] * 9)}]"


@pytest.mark.parametrize(
    ("text", "key", "said"),
    [
        ("A: [[0, 0], [g, 0]]\nb: [0, 1]", "weak-stage-order", "1; at least 12 where g = 0"),
        (
            "tableau: {A: [[[[0, 0], [g, 0]], [[0], [1]]], [null, [[1/2]]]], b: [[0, 1], [1]]}",
            *("fsal", "no meaning"),
        ),
        (
            f"A: [{', '.join([EQUAL] * 9)}]\nb: [{', '.join(['1/9'] * 9)}]",
            *("symmetric", "no; yes where g = 1/18"),
        ),
    ],
)
def test_bounds_no_meaning_and_open_answers_are_told_apart(text: str, key: str, said: str) -> None:
    """A search that stopped, a question without meaning, and nine equal stages, which have too
    many renumberings to try them all.
    """
    family = every_family(loads_family(f"parameters: {{g: free}}\n{text}\n", is_design=False))
    assert str(fact_reason(find_property(family, key, LIMIT), "g")) == said


def checked(tmp_path: object, text: str) -> Outcome:
    """The outcome of a text."""
    from pathlib import Path

    path = Path(str(tmp_path), "family.yaml")
    path.write_text(text, encoding="utf-8")
    return check_file(str(path))


def test_claims_are_decided_for_every_value(tmp_path: object) -> None:
    """A claim that some value does not meet fails and says for which; one on more than every value
    needs holds.
    """
    claims = 'expect: {order: 2, a-stable: true, sdirk: true, B: [">= 2"]}\n'
    outcome = checked(tmp_path, SDIRK + claims)
    by_name = {x.claim: x for x in outcome.claims}
    assert [x.holds for x in outcome.claims] == [False, False, False, True]
    polynomial = "6*g^2 - 6*g + 1 = 0"
    assert f"3 where {polynomial}" in by_name["order"].found
    assert "1/4 ≤ g alone" in by_name["a-stable"].found
    assert by_name["sdirk"].found == "true; false where g = 0"
    assert outcome.exit_code == 1
    claims = 'expect: {order: ">= 2", positive-weights: true}\n'
    assert checked(tmp_path, SDIRK + claims).exit_code == 0


def test_ranges_are_what_every_value_means(tmp_path: object) -> None:
    """Values outside of a range do not count, its ends do."""
    inside = SDIRK.replace("free", "{free: true, range: [1/4, 3/4]}")
    claims = "expect: {order: 2, a-stable: true, sdirk: true}\n"
    outcome = checked(tmp_path, inside + claims)
    found = {x.claim: x.holds for x in outcome.claims}
    assert found == {"order": True, "a-stable": True, "sdirk": True}


def test_witness_has_its_polynomial(tmp_path: object) -> None:
    """The condition that not every value meets is told by its residual, and where it is met with
    the command that finds the values; nothing is wider than 80 columns.
    """
    text = render([checked(tmp_path, SDIRK)], Look(False), digits=None)
    said = " ".join(text.split())
    assert "every value of g: order 2; order 3 fails at [[[]]] by -g^2 + g - 1/6; " in said
    assert "; order 3 where 6*g^2 - 6*g + 1 = 0, g = 1/2 - sqrt(3)/6 or 1/2 + sqrt(3)/6" in said
    assert "symplectic no; yes where g = 1/4" in said
    assert all(len(line) <= 80 for line in text.splitlines() if str(tmp_path) not in line)


def test_given_nodes_are_data(tmp_path: object) -> None:
    """A given node fixes no unknown of its row: the order is that for every entry, and where the
    row sums are the nodes is said.
    """
    text = 'A: [[0, 0], ["?", "?"]]\nb: ["?", "?"]\nc: [0, 2/3]\n'
    outcome = checked(tmp_path, text)
    every = outcome.every
    assert every is not None
    assert len(every.parameters) == 4
    assert every.order.fact.zeros == ("b1 + b2 - 1",)
    assert every.inconsistent.value == ((0, 0),)


def test_roots_of_numbers_stay_what_they_are(tmp_path: object) -> None:
    """With sqrt(3) beside a parameter the identity of its square is used: (3 + √3)/6 makes order 3
    with a weight that is free for stages that are equal.
    """
    text = """parameters: {w: free}
A: [[(3 + sqrt(3))/6, 0, 0], [(3 + sqrt(3))/6, 0, 0], [-sqrt(3)/3, 0, (3 + sqrt(3))/6]]
b: [w, 1/2 - w, 1/2]
"""
    every = checked(tmp_path, text).every
    assert every is not None
    assert every.order.order == 3
    assert every.simplifying("B").value == (4,)


def test_roots_of_parameters_are_refused(tmp_path: object) -> None:
    """A root that depends on a parameter, and error constants, need a value: the cure is told."""
    outcome = checked(tmp_path, SDIRK.replace("1 - 2*g", "sqrt(g)"))
    assert outcome.exit_code == 2
    assert "--set" in outcome.faults[0].help


def test_ranges_that_leave_no_method_are_refused(tmp_path: object) -> None:
    """A range has one number, and a denominator is zero there: bad input, with the entry."""
    text = "parameters: {t: {free: true, range: [1/2, 1/2]}, s: free}\nA: [[0, 0], [1/2, 0]]\n"
    text += "b: [1 - s, s/(2*t - 1)]\n"
    outcome = checked(tmp_path, text)
    [fault] = outcome.faults
    assert (outcome.exit_code, "denominator" in fault.message) == (2, True)


def test_too_many_parameters_are_refused(tmp_path: object) -> None:
    """Six implicit stages of unknowns would take hours: the limit and the cure are told."""
    outcome = checked(tmp_path, "unknown: {stages: 6, shape: full}")
    [fault] = outcome.faults
    assert fault.message == "42 free parameters (limit 30)"
    assert "--set" in fault.help


@in_whole
def test_report_is_as_its_schema_says(tmp_path: object) -> None:
    """JSON of families of one parameter and of several is valid; an outcome goes between
    processes.
    """
    schema = REPORT.schema
    several = "unknown: {stages: 2, shape: explicit}\n"
    outcomes = [checked(tmp_path, text) for text in (SDIRK, several)]
    data = REPORT.document(outcomes)
    jsonschema.validate(data, schema)
    assert data["files"][0]["order"]["order"] == 2
    again = pickle.loads(pickle.dumps(outcomes[0]))
    assert REPORT.document([again]) == REPORT.document(outcomes[:1])


def test_patterns_of_several_parameters_are_decided(tmp_path: object) -> None:
    """Where an entry may be zero the question is asked again without it: explicit methods are
    explicit for every value, reducible where an unknown is zero.
    """
    several = "unknown: {stages: 2, shape: explicit}\n"
    every = checked(tmp_path, several).every
    assert every is not None
    assert every.verdict("explicit").is_everywhere
    assert ("c2", True) in every.verdict("reducible").elsewhere
    assert every.verdict("positive-weights").differs


MIXED = """parameters: {t1: free, t2: free, t3: free}
methods: [gauss-2, lobatto-iiia-3]
transfer: {interpolation: t1, collocation: t2, conjugate-interpolation: t3,
           conjugate-collocation: 1 - t1 - t2 - t3}
"""


def test_what_depends_on_no_parameter_is_decided(tmp_path: object) -> None:
    """Weights and nodes have no parameters: B, and whether weights are positive and nodes within
    the step, are decided for every value, as they are for a single one, while C is not.
    """
    every = checked(tmp_path, MIXED).every
    assert every is not None
    ordinary = analyse(loads(MIXED, settings={"t1": "1/3", "t2": "1/5", "t3": "2"}).tableau, LIMIT)
    assert every.simplifying("B").is_everywhere
    assert every.simplifying("B").value == ordinary.simplifying.B == (4, 4)
    for key in ("positive-weights", "nodes-in-unit-interval"):
        assert every.verdict(key).is_everywhere
        assert every.verdict(key).value is ordinary.subject.verdict(key).value is True
    assert not every.simplifying("C").is_everywhere


def test_every_value_is_one_where_there_is_a_method() -> None:
    """A pole and the ends of a range are named with the answer, in text, LaTeX and JSON, of
    ``gark check`` and ``gark stability``; a denominator without a real zero is none.
    """
    family = (
        "parameters: {t: {free: true, range: [-1, 2]}}\n"
        'A: [[0, 0], ["1/(2*t*(t**2 + 1)*(t - 3))", 0]]\n'
        'b: ["1 - t", t]\n'
    )
    for command in ("check", "stability"):
        assert "every value of t where t ≠ 0 and -1 ≤ t ≤ 2" in gark(command, "-", stdin=family).out
        data = json.loads(gark(command, "-", "--format", "json", stdin=family).out)
        (found,) = data.get("files", [data])
        assert found["restrictions"] == ["t ≠ 0", "-1 ≤ t ≤ 2"]


@pytest.mark.parametrize(
    ("entry", "where"), [("t/(sqrt(5) - 1)", ""), ("t/(t*sqrt(5) - 1)", " where t*sqrt(5) - 1 ≠ 0")]
)
def test_restrictions_with_roots(entry: str, where: str) -> None:
    """Roots of numbers are told as they are written, and what is a number is no restriction."""
    family = f"parameters: {{t: free}}\nA: [[0, 0], ['{entry}', 0]]\nb: [1/2, 1/2]\n"
    assert f"every value of t{where}: order 1" in " ".join(
        gark("check", "-", stdin=family).out.split()
    )
