"""What is wanted besides the order: equations and signs, against methods from the literature."""

from __future__ import annotations

from pathlib import Path

import pytest
from flint import fmpq

from garkcli import find_order, loads, pair
from garkcli.design.choices import accepted_methods
from garkcli.design.design import Design, find_parameters
from garkcli.design.solutions import value_at
from garkcli.design.wants import WANTS
from garkcli.errors import MethodFileError
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.family import loads_family, with_values
from garkcli.order.simplifying import simplifying
from garkcli.stability.linear import stability_function
from garkcli.tableau.embedded import Weights, with_weights
from tests.cli.harness import gark

SDIRK2 = "unknown: {stages: 2, shape: sdirk}\n"
IMEX = """unknown: {stages: 4, shape: [imex, stiffly-accurate]}
design:
  order: 3
  R-infinity: {2: 0}
  range: {gamma: [2/5, 1]}
  fix: {b1: 0, c2: gamma, c3: (1 + gamma)/2, e42: e43, e32: 2/5}
"""


def taken(found: Design, name: str) -> list[float]:
    """The values of one unknown at the solutions that are taken."""
    values = []
    for one in found.last.found:
        for index in one.accepted:
            value = value_at(one.solution.values[name], one.solution.real[index])
            values.append(float(value.ball(80)))
    return sorted(values)


def test_alexander() -> None:
    """Stiffly accurate, R(∞) = 0, three stages, order 3: γ is a root of 6γ³ − 18γ² + 9γ − 1."""
    with open("tests/examples/families/wanted.gark.yaml", encoding="utf-8") as stream:
        found = find_parameters(loads_family(stream.read()))
    assert found.last.order == 3
    assert taken(found, "gamma") == pytest.approx([0.1589838999, 0.4358665215])


def test_two_stages_that_damp() -> None:
    """Order 2 and stiffly accurate with R(∞) = 0: γ = 1 ± √2/2, and with positive weights one."""
    wanted = "design: {order: 2, stiffly-accurate: true"
    found = find_parameters(loads_family(f"{SDIRK2}{wanted}, R-infinity: 0}}"))
    assert taken(found, "gamma") == pytest.approx([0.2928932188, 1.7071067812])
    text = f"{SDIRK2}{wanted}, R-infinity: 0, positive-weights: true}}"
    assert taken(find_parameters(loads_family(text)), "gamma") == pytest.approx([0.2928932188])


@pytest.mark.parametrize(("node", "weight", "is_taken"), [("1/2", 0, False), ("2/3", 1, True)])
def test_a_weight_of_zero_is_not_positive(node: str, weight: int, is_taken: bool) -> None:
    """Two explicit stages of order 2 have b₁ = 1 − 1/(2c₂): 0 for c₂ = 1/2, 1/4 for 2/3."""
    text = "unknown: {stages: 2, shape: explicit}\ndesign: {order: 2, positive-weights: true, "
    found = find_parameters(loads_family(f"{text}fix: {{c2: {node}}}}}"))
    [one] = found.last.found
    assert one.solution.values["b1"] == fmpq(weight, 4)
    assert (bool(one.accepted), found.reaches(2)) == (is_taken, is_taken)


def test_the_value_at_infinity() -> None:
    """R(∞) of the two stages of order 3 is 1 − √3 for γ = 1/2 + √3/6 and 1 + √3 for the other."""
    text = SDIRK2 + "design: {order: 3, R-infinity: 1 - sqrt(3)}"
    assert taken(find_parameters(loads_family(text)), "gamma") == pytest.approx([0.7886751346])


def test_symplectic_and_pair_order() -> None:
    """Two stages, symplectic, order 4, diagonal 1/4: Gauss; the pair of a combination has order 4
    for τ = 1 alone, as without ``design``.
    """
    text = "unknown: {stages: 2, shape: full}\ndesign: {order: 4, symplectic: true}"
    found = find_parameters(loads_family(text))
    assert taken(found, "c1") == pytest.approx([0.2113248654, 0.7886751346])
    pairs = """parameters: {tau: free}
methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 4}]
transfer: {interpolation: tau, collocation: 1 - tau}
design: {pair-order: 4}
"""
    found = find_parameters(loads_family(pairs), 2)
    assert taken(found, "tau") == [1]
    text = pairs.replace("design: {pair-order: 4}", "")
    assert find_order(pair(loads(text, settings={"tau": "1"}))).order == 4


def test_stage_order() -> None:
    """ESDIRK, two stages, stage order 2: c₂ = 2γ, so that order 2 is the trapezoidal rule."""
    text = "unknown: {stages: 2, shape: esdirk}\ndesign: {order: 2, stage-order: 2, fix: {c2: 1}}"
    found = find_parameters(loads_family(text))
    (one,) = found.last.found
    values = {name: str(value) for name, value in one.solution.values.items()}
    assert values == {"c2": "1", "gamma": "1/2", "b1": "1/2", "b2": "1/2"}


def test_stage_order_asks_for_the_weights_too() -> None:
    """One stage with C(2) has the node 0, for which B(2) fails: no method has stage order 2, as the
    simplifying assumptions of Euler's method say.
    """
    text = "A: [['?']]\nb: ['?']\ndesign: {stage-order: 2}\n"
    assert find_parameters(loads_family(text), 1).last.found == ()
    euler = simplifying(loads("A: [[0]]\nb: [1]\n").tableau, 9)
    assert (euler.eta, euler.stage_order) == (9, 1)


def test_stage_orders_above_the_number_of_stages() -> None:
    """B(2s + 1) has no solution, and orders above it add no equation."""
    text = "A: [[a, b], [c, d]]\nb: [e, f]\ndesign: {{stage-order: {}}}\n"
    head = f"parameters: {{{', '.join(f'{name}: free' for name in 'abcdef')}}}\n"
    highest = loads_family(head + text.format(60))
    assert highest.relations == loads_family(head + text.format(5)).relations
    assert find_parameters(highest, 1).last.found == ()


def test_an_implicit_explicit_method() -> None:
    """Four stages of order 3, R(∞) = 0 of the implicit part, Alexander's γ; the order proved from the file."""
    family = loads_family(IMEX)
    found = find_parameters(family)
    assert taken(found, "gamma") == pytest.approx([0.4358665215])
    chosen = next(accepted_methods(found))
    written = with_values(family, chosen.values, "head", "order: 3")
    assert "design" not in written
    assert find_order(loads(written)).order == 3


def test_nodes_are_filtered_by_exact_signs() -> None:
    """A node at the end of the interval is inside of it."""
    text = 'A: [[0, 0], ["?", 0]]\nb: [1/2, 1/2]\ndesign: {{order: 2, {}}}\n'
    inside = find_parameters(loads_family(text.format("nodes-in-unit-interval: true")))
    assert taken(inside, "a21") == [1]


@pytest.mark.parametrize(
    ("wanted", "nodes"),
    [
        ("consistent: true", [1 / 3, 1 / 2, 1]),
        ("nodes-ascending: true", [1 / 3, 1 / 2]),
        ("nonnegative-coefficients: true", [1 / 3, 1]),
        ("largest-coefficient: 3/4", [1 / 3]),
        ("largest-coefficient: 2", [1 / 3, 1 / 2, 1]),
    ],
)
def test_signs_and_sizes_of_coefficients(wanted: str, nodes: list[float]) -> None:
    """Heun's and Kutta's methods and that with the nodes 1 and 2/3, of order 3: Kutta's has −1 and 2,
    Heun's has no coefficient above 3/4.
    """
    found = []
    for node, texts in ((1 / 3, ("1/3", "2/3")), (1 / 2, ("1/2", "1")), (1, ("1", "2/3"))):
        family = loads_family(
            "unknown: {stages: 3, shape: explicit}\n"
            f"design: {{order: 3, fix: {{c2: {texts[0]}, c3: {texts[1]}}}, {wanted}}}\n"
        )
        if any(accepted_methods(find_parameters(family, 3))):
            found.append(node)
    assert found == nodes


def test_sizes_of_negative_coefficients() -> None:
    """An entry −2 is larger in size than 1, an entry −1 is not."""
    text = "parameters: {{t: free}}\nA: [[0, 0], [t, 0]]\nb: [1/2, 1/2]\n"
    text += "design: {{order: 1, largest-coefficient: 1, fix: {{t: {}}}}}\n"
    for value, count in (("-1", 1), ("-2", 0)):
        found = find_parameters(loads_family(text.format(value)), 1)
        assert len(list(accepted_methods(found))) == count


def test_ranges_that_meet() -> None:
    """A range under ``design`` and that of the parameter both hold; without a number in both the
    file is refused.
    """
    text = """parameters: {{g: {{free: true, range: [{}]}}}}
A: [[g, 0], [1 - 2*g, g]]
b: [1/2, 1/2]
design: {{range: {{g: [1/4, 1]}}}}
"""
    for own, ends, expected in (
        ("0, 1/2", ("1/4", "1/2"), []),
        ("1/2, 2", ("1/2", "1"), [0.7886751346]),
        ("0, 2", ("1/4", "1"), [0.7886751346]),
    ):
        family = loads_family(text.format(own))
        assert tuple(map(str, family.ranges["g"])) == ends
        assert taken(find_parameters(family, 3), "g") == pytest.approx(expected)
    with pytest.raises(MethodFileError, match=r"no number is in \[1/4, 1\] and in \[0, 1/8\]"):
        loads_family(text.format("0, 1/8"))


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        ("{ordr: 3}", "unknown key 'ordr'"),
        ("{fix: {c9: 1}}", "c9 is not an unknown"),
        ("{range: {gamma: [1]}}", "a range has two ends"),
        ("{range: {gamma: [1, 1/2]}}", "no number is in [1, 1/2]"),
        ("{range: {c9: [0, 1]}}", "c9 is not an unknown"),
        ("{stage-order: 0}", "at least 1"),
        ("{stage-order: 61}", "at most 60"),
        ("{order: 100000}", "at most 60"),
        ("{stiffly-accurate: {2: true}}", "no colour 2"),
        ("{stiffly-accurate: {x: true}}", "x is not a colour"),
        ("{symplectic: perhaps}", "not known"),
        ("{R-infinity: c9}", "'c9' is not a parameter"),
    ],
)
def test_faults(wanted: str, message: str) -> None:
    """What is no wish is a fault at its place."""
    with pytest.raises(MethodFileError) as caught:
        loads_family(f"{SDIRK2}design: {wanted}\n")
    (fault,) = caught.value.faults
    assert message in fault.message
    assert fault.line == 2


def test_explicit_methods_have_no_value_at_infinity() -> None:
    """R(z) is a polynomial: refused with a cure."""
    text = "unknown: {stages: 2, shape: explicit}\ndesign: {R-infinity: 0}\n"
    with pytest.raises(MethodFileError, match="R-infinity"):
        loads_family(text)


def test_what_cannot_be_met(tmp_path: object) -> None:
    """Wishes that contradict each other leave no value, before any tree."""
    path = f"{tmp_path}/wanted.yaml"
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(SDIRK2 + "design: {stiffly-accurate: true, fix: {gamma: 1, b2: 2}}\n")
    run = gark("design", path, "--order", "1")
    assert (run.code, "the other requirements cannot be met" in run.out) == (1, True)
    text = "A: [['?']]\nb: [1]\ndesign: {pair-order: 3}\n"
    run = gark("design", "-", "--order", "1", stdin=text)
    assert "requirements cannot be met, by B, C, D and the even" in " ".join(run.out.split())
    pair = "methods: [gauss-1, lobatto-iiia-2]\ntransfer: '?'\n"
    fixed = ("--set", "a12_11=1/2", "--set", "a12_12=1")
    run = gark("design", "-", "--pair", "--order", "2", *fixed, stdin=pair)
    assert "no value: the even condition fails on block (1,2)" in " ".join(run.out.split())


@pytest.mark.parametrize(
    ("last", "order", "why"),
    [
        ("radau-iia-2", 4, "B(4) fails on colour 2"),
        ("lobatto-iiia-2", 3, "B(3) fails on colour 2"),
        ("{A: [[], [1], [1/4, 1/4]], b: [1/6, 1/6, 2/3]}", 3, "D(1) fails on block (2,2)"),
    ],
)
def test_a_diagonal_method_that_excludes_the_pair_order_is_named(
    last: str, order: int, why: str
) -> None:
    """Its colour and its condition; by the trees its pair alone has an order less."""
    text = f"methods: [gauss-2, {last}]\ntransfer: '?'\n"
    run = gark("design", "-", stdin=f"{text}design: {{pair-order: {order}}}\n")
    assert f"no value has symplectic pair order {order}: {why}" in " ".join(run.out.split())
    asked = gark("design", "-", "--pair", "--order", str(order), stdin=text)
    assert f"no real value: {why}" in " ".join(asked.out.split())
    assert (run.code, asked.code) == (1, 1)
    assert find_order(pair(loads(f"methods: [{last}]"))).order == order - 1


def test_every_want_has_a_file() -> None:
    """Each is found by its key and says what it is."""
    for key in WANTS:
        want = WANTS[key]
        assert (want.key, bool(want.summary)) == (key, True)


def test_as_a_command(tmp_path: object) -> None:
    """The order of the file is what the exit code is about."""
    path = f"{tmp_path}/wanted.yaml"
    with open(path, "w", encoding="utf-8") as stream:
        stream.write(SDIRK2 + "design: {order: 4}\n")
    assert gark("design", path).code == 1
    assert gark("design", path, "--order", "3").code == 0


PAIR_OF_ORDER_60 = """parameters: {tau: free}
methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]
transfer: {interpolation: tau, collocation: 1 - tau}
design: {pair-order: 60}
"""


def test_what_is_not_worked_out_in_time() -> None:
    """Conditions of a pair that take longer than there is are left unsettled, and then nothing is
    decided; in time they are the same as without a limit.
    """
    family = loads_family(PAIR_OF_ORDER_60, deadline=0.0)
    assert family.unsettled == ("pair-order",)
    found = find_parameters(family, 3)
    assert [step.kind for step in found.steps] == ["undecided"]
    text = PAIR_OF_ORDER_60.replace("60", "4")
    settled = loads_family(text, deadline=float("inf"))
    assert settled.unsettled == ()
    assert settled.relations == loads_family(text).relations


@pytest.mark.parametrize("options", [["--search", "8"], ["--p-stable"]])
def test_nothing_goes_by_what_is_not_worked_out(options: list[str], tmp_path: Path) -> None:
    """Neither a search nor a set of stable values passes over it."""
    path = tmp_path / "pair.gark.yaml"
    path.write_text(PAIR_OF_ORDER_60, encoding="utf-8")
    order = ["--order", "3"] if "--search" in options else []
    done = gark("design", str(path), "--seconds", "0.001", *options, *order)
    assert done.code == 2
    assert "the demand pair-order under design was not worked" in done.err
    told = gark("design", str(path), "--seconds", "0.001")
    assert told.code == 3
    assert "the conditions of pair-order under design" in " ".join(told.out.split())


@pytest.mark.parametrize(
    ("ends", "least", "greatest"),
    [
        ("[0, sqrt(2)/2]", 0.0, 0.5**0.5),
        ("[-1*sqrt(2), sqrt(2)]", -(2**0.5), 2**0.5),
        ("[sqrt(2) - 1, 'root(2, 3)']", 2**0.5 - 1, 2 ** (1 / 3)),
    ],
)
@pytest.mark.parametrize("is_own", [True, False])
def test_ranges_with_algebraic_ends(ends: str, least: float, greatest: float, is_own: bool) -> None:
    """Solutions g = k/16 are taken just where they are between the ends, compared in floats; the
    range is that of the parameter, or under ``design``.
    """
    wanted = (-23, -22, 0, 6, 7, 11, 12, 20, 21, 22, 23)
    zeros = "*".join(f"(g - {k}/16)" for k in wanted)
    own = f"{{free: true, range: {ends}}}" if is_own else "free"
    wish = "" if is_own else f"design: {{range: {{g: {ends}}}}}\n"
    text = f"parameters: {{g: {own}}}\nA: [['1/2']]\nb: ['1 + {zeros}']\n{wish}"
    found = find_parameters(loads_family(text), 1).last.found
    values = {
        float(at["g"].ball(80)): index in x.accepted
        for x in found
        for index, at in enumerate(x.solution.real_values)
    }
    assert sorted(values) == [k / 16 for k in wanted]
    assert all(taken == (least <= g <= greatest) for g, taken in values.items())


@pytest.mark.parametrize(
    ("ends", "why"),
    [
        ("[sqrt(2), 1]", "the first end is larger than the second"),
        ("[-1, sqrt(3)/6]", "the polynomial of an end has another zero in the range"),
        ("[sqrt(2), sqrt(2)]", "both ends are one number"),
        ("[0, sqrt(-1)]", "an even root of a negative number"),
    ],
)
def test_ranges_that_are_refused(ends: str, why: str) -> None:
    """The ends are in order and real, and no other zero of their polynomials is between them."""
    with pytest.raises(MethodFileError, match=why):
        loads_family(
            f"parameters: {{g: free}}\nA: [[g]]\nb: [1]\ndesign: {{range: {{g: {ends}}}}}\n"
        )
    with pytest.raises(MethodFileError, match=why):
        loads_family(f"parameters: {{g: {{free: true, range: {ends}}}}}\nA: [[g]]\nb: [1]\n")


def test_the_order_of_the_stability_function() -> None:
    """R(z) of four explicit stages of order 3 is that of RK4 where its own order is 4."""
    text = (
        "unknown: {stages: 4, shape: explicit}\n"
        "design: {order: 3, stability-order: 4, fix: {c2: 1/2, c3: 3/4, c4: 1, a42: 1/10, b4: 1/5}}"
    )
    found = find_parameters(loads_family(text), 3)
    methods = [loads(with_values(found.family, x.values, "", "")) for x in accepted_methods(found)]
    assert methods
    for method in methods:
        R = stability_function(method.tableau)
        assert list(R.numerator.coefficients) == [1, 1, fmpq(1, 2), fmpq(1, 6), fmpq(1, 24)]
    assert {find_order(x).order for x in methods} == {3}


def test_embedded_weights_that_damp() -> None:
    """R̂(∞) = 0: the numerator of R̂ has the smaller degree."""
    text = (
        "unknown: {stages: 2, shape: sdirk, embedded: true}\n"
        "design: {order: 2, embedded-order: 1, embedded-R-infinity: 0, fix: {gamma: 1/3, c2: 1}}"
    )
    found = find_parameters(loads_family(text), 2)
    [chosen] = accepted_methods(found)
    method = loads(with_values(found.family, chosen.values, "", ""))
    assert method.embedded is not None
    R = stability_function(with_weights(method.tableau, found_weights(method)))
    assert R.numerator.degree < R.denominator.degree
    assert stability_function(method.tableau).numerator.degree == 2


def found_weights(method: MethodFile) -> Weights:
    """The embedded weights of a method of one colour."""
    weights = method.further.embedded
    assert weights is not None
    return weights
