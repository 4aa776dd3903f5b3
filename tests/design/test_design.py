"""``gark design``: for which values of its parameters a method has an order."""

from __future__ import annotations

import json
from collections.abc import Mapping
from fractions import Fraction
from itertools import combinations, count, product
from math import prod
from pathlib import Path
from random import Random
from typing import Any

import pytest
from flint import Ordering, fmpq, fmpz_mpoly_ctx, fmpz_mpoly_vec
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli import deadline, find_order, load, loads, pair
from garkcli.deadline import until
from garkcli.design.choices import accepted_methods
from garkcli.design.conditions import FamilyConditions
from garkcli.design.design import Design, find_parameters
from garkcli.design.groebner import reduced
from garkcli.design.ideal import Ideal
from garkcli.design.parts import Changes, Pieces, charts, nodes_as_coordinates, parts_of
from garkcli.design.solutions import solutions, value_at
from garkcli.design.steps import Found, NoValue, Solutions
from garkcli.errors import NotDecided
from garkcli.exact.parametric import Parameters
from garkcli.frozen import replace
from garkcli.methodfile.family import loads_family, with_values
from garkcli.ntrees.tree import Tree
from garkcli.order.admissible import elementary_weight
from garkcli.report.design import REPORT, DesignReport
from tests.cli.harness import gark
from tests.whole import IS_WHOLE, at_most, in_whole

TAU = """parameters: {{tau: free}}
methods:
  - {{family: {}, stages: {}}}
  - {{family: {}, stages: {}}}
transfer: {{interpolation: tau, collocation: 1 - tau}}
"""
SDIRK2 = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
SDIRK3 = """parameters: {g: free, a: free, b: free, c: free, u: free, v: free, w: free}
A: [[g, 0, 0], [a, g, 0], [b, c, g]]
b: [u, v, w]
"""
EXPLICIT3 = """parameters: {c2: free, c3: free, a32: free, b2: free, b3: free}
A: [[0, 0, 0], [c2, 0, 0], [c3 - a32, a32, 0]]
b: [1 - b2 - b3, b2, b3]
"""
FULL2 = """parameters: {a: free, b: free, c: free, d: free, u: free, v: free}
A: [[a, b], [c, d]]
b: [u, v]
"""


def kinds(found: Design) -> list[str]:
    """The verdict of each order."""
    return [step.kind for step in found.steps]


def decimals(found: Design, order: int) -> list[dict[str, float]]:
    """The real solutions of one order."""
    (step,) = [x for x in found.steps if x.order == order]
    made = []
    for one in step.found:
        for root in one.solution.real:
            values = {
                name: float(value_at(one.solution.values[name], root).ball(80))
                for name in found.family.parameters
            }
            made.append(values)
    return made


@pytest.mark.parametrize(
    ("families", "wanted"),
    [
        (("gauss", 2, "lobatto-iiia", 3), ["every-value"] * 4 + ["none"]),
        (("gauss", 2, "lobatto-iiia", 4), ["every-value"] * 2 + ["solutions"] * 2 + ["none"]),
        (("gauss", 3, "lobatto-iiia", 5), ["every-value"] * 4 + ["solutions"] * 2 + ["none"]),
        (("radau-iia", 2, "lobatto-iiia", 3), ["every-value"] * 2 + ["solutions", "none"]),
    ],
)
def test_combinations(families: tuple[object, ...], wanted: list[str]) -> None:
    """Which τ combine collocation and interpolation to a pair of an order; τ = 1 is a double
    solution where one is needed, and orders at other τ are those of ``gark check``.
    """
    text = TAU.format(*families)
    found = find_parameters(loads_family(text), whose="pair")
    assert kinds(found) == wanted
    for step in found.steps:
        for one in step.found:
            assert (one.solution.values, one.solution.multiplicity) == ({"tau": 1}, 2)
    generic = wanted.count("every-value")
    for tau in ("0", "1/3", "-2"):
        method = loads(text, settings={"tau": tau})
        assert find_order(pair(method)).order == generic
    best = find_order(pair(loads(text, settings={"tau": "1"}))).order
    assert best == len(wanted) - 1


def test_sdirk_of_two_stages() -> None:
    """Order 3 for both γ = 1/2 ± √3/6 and no other, order 4 for none (Nørsett)."""
    found = find_parameters(loads_family(SDIRK2))
    assert kinds(found) == ["every-value", "every-value", "solutions", "none"]
    (one,) = found.steps[2].found
    assert str(found.steps[2].ideal.polynomials) == "[6*g^2 - 6*g + 1]"  # type: ignore[union-attr]
    assert (len(one.solution.real), one.accepted) == (2, (0, 1))
    assert one.order is not None
    assert one.order.order == 3


def test_sdirk_of_three_stages() -> None:
    """Order 4 for the three γ that solve 24γ³ − 36γ² + 12γ − 1 = 0, all coefficients unknown."""
    found = find_parameters(loads_family(SDIRK3), 4)
    gammas = [values["g"] for values in decimals(found, 4)]
    for gamma, known in zip(gammas, (0.128886400516, 0.302534578183, 1.068579021302), strict=True):
        assert gamma == pytest.approx(known, abs=1e-11)
    (one,) = found.last.found
    assert str(one.solution.values["g"].field.modulus.degree()) == "3"  # type: ignore[union-attr]
    assert one.order is not None
    assert (one.order.order, one.solution.multiplicity) == (4, 1)


def test_gauss_from_nothing() -> None:
    """Two stages of order 4 are Gauss's method, in both orders of its stages."""
    found = find_parameters(loads_family(FULL2), 4)
    assert [x.solution.degree for x in found.last.found] == [2]
    for values in decimals(found, 4):
        nodes = sorted([values["a"] + values["b"], values["c"] + values["d"]])
        assert nodes == pytest.approx([0.211324865405, 0.788675134595])
        assert values["u"] == pytest.approx(0.5)


def test_explicit_methods_of_three_stages() -> None:
    """Order 3 is a family of dimension 2, order 4 is none; chosen nodes leave one method."""
    found = find_parameters(loads_family(EXPLICIT3), 4)
    assert kinds(found) == ["every-value", "family", "family", "none"]
    assert [step.ideal.dimension for step in found.steps[:3] if step.ideal] == [5, 4, 2]
    chosen = find_parameters(loads_family(EXPLICIT3, settings={"c2": "1/3", "c3": "2/3"}), 3)
    (one,) = chosen.last.found
    assert one.solution.values == {"a32": fmpq(2, 3), "b2": 0, "b3": fmpq(3, 4)}


@in_whole
def test_splitting_of_four_stages() -> None:
    """All real splittings of order 4 with four maps a part: Forest's and Ruth's, both ways."""
    names = [f"{letter}{i}" for letter in "ab" for i in range(1, 5)]
    rows_q = [[f"a{j}" if j < i else "0" for j in range(1, 5)] for i in range(1, 5)]
    rows_p = [[f"b{j}" if j <= i else "0" for j in range(1, 5)] for i in range(1, 5)]

    def text(rows: list[list[str]]) -> str:
        return "[" + ", ".join(f"[{', '.join(row)}]" for row in rows) + "]"

    method = f"""parameters: {{{", ".join(f"{x}: free" for x in names)}}}
prk:
  q: {{A: {text(rows_q)}, b: [a1, a2, a3, a4]}}
  p: {{A: {text(rows_p)}, b: [b1, b2, b3, b4]}}
structure: separable
"""
    found = find_parameters(loads_family(method), 4)
    real = decimals(found, 4)
    forest_ruth = 1 / (2 - 2 ** (1 / 3))
    drifts = sorted(round(values["a1"], 10) for values in real)
    assert drifts == [round(forest_ruth / 2, 10), round(forest_ruth, 10)]
    assert sum(x.solution.degree for x in found.last.found) == 10


def test_radicals_beside_unknowns() -> None:
    """√3 is an unknown with its sign: one of both γ goes with it."""
    found = find_parameters(
        loads_family("parameters: {t: free}\nA: [[t, 0], [sqrt(3)/3, t]]\nb: [1/2, 1/2]\n")
    )
    (one,) = found.steps[2].found
    assert (len(one.solution.real), one.accepted) == (2, (0,))
    (value,) = [x["t"] for x in decimals(found, 3)][:1]
    assert value == pytest.approx(0.211324865405)


def test_ranges() -> None:
    """Solutions outside of a range are told and not taken."""
    ranged = SDIRK2.replace("g: free", "g: {free: true, range: [1/2, 1]}")
    (one,) = find_parameters(loads_family(ranged), 3).last.found
    assert one.accepted == (1,)
    chosen = next(accepted_methods(find_parameters(loads_family(ranged), 3)))
    assert chosen.values == {"g": "1/2 + sqrt(3)/6"}


@pytest.mark.parametrize("text", [SDIRK2, SDIRK3, TAU.format("gauss", 2, "lobatto-iiia", 4)])
def test_what_is_found_is_a_method_file(text: str) -> None:
    """The file with the values filled in is read again and has its claim."""
    family = loads_family(text)
    order = 4 if text is SDIRK3 else 3
    chosen = next(
        accepted_methods(find_parameters(family, order, "method" if "A:" in text else "pair"))
    )
    claim = f"order: {chosen.order}" if "A:" in text else f"pair-order: {chosen.order}"
    method = loads(with_values(family, chosen.values, "found", claim))
    assert [x.key for x in method.claims] == [claim.split(":")[0]]
    whole = method if "A:" in text else pair(method)
    assert find_order(whole).order == chosen.order


_ENTRY = st.tuples(st.integers(-2, 2), st.integers(-2, 2))


def _text(entries: list[tuple[int, int]], weight: Fraction) -> str:
    parts = [f"{a}/2 + {b}/3*t" for a, b in entries]
    return (
        f"parameters: {{t: free}}\nA: [[{parts[0]}, {parts[1]}], [{parts[2]}, {parts[3]}]]\n"
        f"b: [{weight}, 1 - {weight}]\n"
    )


@in_whole
@settings(max_examples=at_most(10, 200))
@given(
    st.lists(_ENTRY, min_size=4, max_size=4),
    st.fractions(Fraction(1, 4), Fraction(3, 4), max_denominator=4),
    st.fractions(-2, 2, max_denominator=3),
)
def test_random_families(entries: list[tuple[int, int]], weight: Fraction, t: Fraction) -> None:
    """A member has the order exactly where the ideal vanishes: at a random value and at rational
    solutions.
    """
    text = _text(entries, weight)
    found = find_parameters(loads_family(text))
    values: dict[str, Mapping[str, object]] = {str(t): {"t": fmpq(t.numerator, t.denominator)}}
    for step, one in product(found.steps, [0]):
        for solution in step.found[one:]:
            if solution.solution.field is None:
                value = solution.solution.values["t"]
                values[str(value)] = {"t": value}
    for text_of_t, value in values.items():
        order = find_order(loads(text, settings={"t": text_of_t})).order
        for step in found.steps:
            if step.ideal is None:
                continue
            zero = all(not _at(p, value["t"]) for p in step.ideal.polynomials)
            assert (order >= step.order) == zero


def _at(polynomial: object, t: object) -> object:
    total: object = fmpq(0)
    for exponents, a in polynomial.to_dict().items():  # type: ignore[attr-defined]
        total += fmpq(a) * t ** int(exponents[0])  # type: ignore[operator]
    return total


@pytest.mark.parametrize(
    "command", ["check", "design --order 4 --seconds 900", "conditions -n 4", "stability"]
)
def test_products_that_would_fill_the_memory(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Coefficients of a few hundred terms, whose products are not multiplied out; one command goes
    up to the limit as it is, in ``make whole``.
    """
    is_real = command == "check" and IS_WHOLE
    if not is_real:
        monkeypatch.setattr("garkcli.exact.parametric.MAX_TERMS", 20_000)
    names = [f"x{k}" for k in range(25)]
    (tmp_path / "m.yaml").write_text(
        f"parameters: {{{', '.join(f'{x}: free' for x in names)}, "
        f"p: ({' + '.join(names)})**2, q: ({' + 2*'.join(names)})**2}}\n"
        "A: [[p, 0, 0], [p, q, 0], [q, p + q, p - q]]\nb: [p, q, 1 - p - q]\n"
    )
    name, *options = command.split()
    run = gark(name, "m.yaml", *options, cwd=tmp_path)
    assert run.code == 2
    limit = 500_000 if is_real else 20_000
    assert f"a polynomial of more than {limit} terms in the free" in run.out + run.err


def test_too_little_time() -> None:
    """Twelve unknowns without structure are left undecided, with what would help."""
    names = [f"a{i}{j}" for i in range(3) for j in range(3)]
    rows = [f"[{', '.join(names[3 * i : 3 * i + 3])}]" for i in range(3)]
    text = f"parameters: {{{', '.join(f'{x}: free' for x in [*names, 'u', 'v', 'w'])}}}\n"
    text += f"A: [{', '.join(rows)}]\nb: [u, v, w]\n"
    found = find_parameters(loads_family(text), 6, seconds=0.5)
    assert kinds(found)[-1] == "undecided"


def test_reports_fit_a_screen() -> None:
    """Whatever is said of a solution goes on in the next line where it is long."""
    ranged = SDIRK2.replace("free", "{free: true, range: [1/2, 1]}")
    double = TAU.format("gauss", 2, "lobatto-iiia", 4)
    for text, whose, said in (
        (ranged, "method", "not of this file: out of a range"),
        (double, "pair", "a double solution"),
    ):
        found = find_parameters(loads_family(text), 4, whose)
        lines = REPORT.render([DesignReport("f", found)]).splitlines()
        assert said in " ".join(line.strip() for line in lines)
        assert max(map(len, lines)) <= 80


def test_conditions_are_given_up_in_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Wherever the time is over while the conditions are made, the same ones are found later."""
    family = loads_family(SDIRK3)

    def texts(made: FamilyConditions) -> list[str]:
        return [str(x.polynomial) for x in made.of_order(4)]

    expected = texts(FamilyConditions(family.tableau, family.ring))
    for steps in range(9):
        readings = count()
        made = FamilyConditions(family.tableau, family.ring)
        with monkeypatch.context() as patched, until(steps):
            patched.setattr(deadline, "monotonic", lambda now=readings: next(now))
            with pytest.raises(NotDecided):
                texts(made)
        assert texts(made) == expected


def test_as_a_command(tmp_path: Path) -> None:
    """Text, JSON, exit codes, --set and --emit."""
    path = tmp_path / "sdirk.yaml"
    path.write_text(SDIRK2, encoding="utf-8")
    run = gark("design", str(path))
    assert run.code == 0
    assert "g = 1/2 + sqrt(3)/6 = 0.788675134595…" in run.out
    data = json.loads(gark("design", str(path), "--order", "3", "--format", "json").out)
    assert (data["verdict"], data["ideal"]) == ("solutions", ["6*g^2 - 6*g + 1"])
    assert [x["order"] for x in data["solutions"]] == [3, 3]
    assert data["schema"] == REPORT.schema_name
    assert gark("design", str(path), "--order", "4").code == 1
    made = tmp_path / "made.gark.yaml"
    assert gark("design", str(path), "--emit", str(made)).code == 0
    assert gark("check", str(made)).code == 0
    fixed = gark("design", str(path), "--set", "g=1/2")
    assert (fixed.code, "no free parameter left" in fixed.err) == (2, True)
    zero = gark("design", str(path), "--set", "g=1/0")
    assert (zero.code, "division by zero" in zero.err) == (2, True)
    nowhere = gark("design", str(path), "--emit", str(tmp_path / "no" / "x"))
    assert (nowhere.code, nowhere.out) == (2, "")
    wrong = gark("design", str(path), "--set", "h=1/2")
    assert (wrong.code, "no parameter 'h'" in wrong.err) == (2, True)
    assert gark("design", str(path), "--set", "g").code == 2
    assert gark("check", str(path)).code == 0
    refused = gark("energy", str(path))
    assert (refused.code, "gark design finds values" in refused.out + refused.err) == (2, True)


def test_an_unknown_name_is_no_value(tmp_path: Path) -> None:
    """A parameter of a family that is set to a name that the file lacks."""
    path = tmp_path / "two.yaml"
    path.write_text(SDIRK2.replace("{", "{w: free, ").replace("1/2, 1/2", "1-w, w"))
    for text in ("x", "2*x", "sqrt(x)"):
        for command in ("design", "check"):
            run = gark(command, str(path), "--set", f"g={text}")
            assert (run.code, "'x' has no value" in run.out + run.err) == (2, True)


CLASSICAL = ("1/2 1/2 1/2 1 0 1 1/6 1/3 1/3 1/6", "1/3 2/3 1 1 -1 1 1/8 3/8 3/8 1/8")
"""Kutta's methods: c2, c3, a32, c4, a42, a43 and the weights."""


@in_whole
def test_explicit_methods_of_four_stages() -> None:
    """Order 4: a family of dimension 2; no value has order 5, for the tall tree alone. One condition
    after the other leads to bases that are too large; all of them at once do not.
    """
    family = loads_family("unknown: {stages: 4, shape: explicit}\n")
    *_, four, five = find_parameters(family, 5, seconds=60).steps
    assert (four.kind, five.kind) == ("family", "none")
    assert isinstance(five, NoValue)
    assert five.witness == Tree(0, (Tree(0, (Tree(0, (Tree(0, (Tree(0),)),)),)),))
    assert elementary_weight(load("rk4").tableau, five.witness) == 0  # bᵀA⁴𝟙, and A⁴ = 0
    assert four.ideal is not None
    assert four.ideal.dimension == 2
    for values in CLASSICAL:
        known = [Fraction(x) for x in values.split()]
        for p in four.polynomials:
            terms = [(int(a), e) for e, a in p.to_dict().items()]
            assert not sum(
                a * prod(x ** int(k) for x, k in zip(known, e, strict=True)) for a, e in terms
            )


@pytest.mark.parametrize(
    ("text", "order"),
    [
        ("unknown: {stages: 2, shape: full}", 3),
        ("unknown: {stages: 3, shape: explicit}", 3),
        ("unknown: {stages: 3, shape: esdirk}\ndesign: {R-infinity: 0}", 2),
    ],
)
def test_parts_are_all_of_a_set(text: str, order: int) -> None:
    """Solved by what is linear, divisors that may vanish apart: dimension and, where some unknowns
    have values, the number of points are those of the Gröbner basis.
    """
    family = loads_family(text)
    ideal = find_parameters(family, order).last.ideal
    assert isinstance(ideal, Ideal)
    ring = family.ring
    conditions = FamilyConditions(family.tableau, ring)
    asked = [x.polynomial for k in range(1, order + 1) for x in conditions.of_order(k)]
    pieces = Pieces.of([*family.relations, *asked], ideal.nonzero, Changes(ring, ring, {}))
    assert pieces.dimension == ideal.dimension > 0
    dice = Random(3)
    compared = 0
    for chosen in combinations(ring.context.gens(), ideal.dimension):
        cuts = [x - fmpq(dice.randint(1, 9), 7) for x in chosen]
        cut = ideal.with_zeros(cuts)
        if cut.dimension == 0:
            try:
                parts = pieces.with_zeros(cuts).parts
            except NotDecided:
                continue
            compared += 1
            assert {part.dimension for part in parts} == {0}
            points = [x for part in parts for x in solutions(part.ideal)]
            assert sum(x.degree for x in points) == sum(x.degree for x in solutions(cut))
        if compared == 5:
            break
    assert compared


def test_a_part_with_one_coordinate_that_is_not_free() -> None:
    """y² = 2 and x = z: two charts, y = ±√2, in the other coordinate. Their points are those of the
    set; the point where what may not vanish does is none.
    """
    ring = Parameters(["x", "y", "z"])
    x, y, z = ring.context.gens()
    [part] = parts_of(Ideal(ring, [x - 1]).with_zeros([y**2 - 2, x - z]))
    [free] = [name for name in part.ring.names if name != "y"]
    found = charts(part)
    assert [chart.names for chart in found] == [(free,), (free,)]
    for chart, sign in zip(found, (-1, 1), strict=True):
        point = chart.point(part, [fmpq(3)])
        assert point is not None
        assert point.values["x"] == point.values["z"] == 3
        root = value_at(point.values["y"], point.real[chart.index])
        assert float(root.ball(80)) == pytest.approx(sign * 2**0.5)
        assert chart.point(part, [fmpq(1)]) is None


def test_nodes_in_place_of_unknowns() -> None:
    """A node that is a linear sum of several unknowns becomes one, by the name of its stage; a
    single unknown stays, and so does a product.
    """
    free = ", ".join(f"{x}: free" for x in "uvwxy")
    rows = "[[], [u], [v, w], [x*y, 1, 0]]"
    family = loads_family(f"parameters: {{{free}}}\nA: {rows}\nb: [0, 0, 0, 1]\n")
    changes = nodes_as_coordinates(family.tableau, family.ring)
    assert (changes.ring.names, changes.nodes) == (("u", "c3", "w", "x", "y"), ("c3", "u"))
    values = changes.values()
    assert values["v"] + values["w"] == changes.ring.parameter("c3")


@in_whole
def test_given_nodes_of_order_five() -> None:
    """Six stages with the nodes of Fehlberg: his method alone, whose coefficients are known. With
    those of Cash and Karp, and embedded weights: a family with theirs in it.
    """
    shape = "{stages: 6, shape: explicit, embedded: %s}"
    nodes = "{c2: 1/4, c3: 3/8, c4: 12/13, c5: 1, c6: 1/2}"
    fehlberg = f"unknown: {shape % 'false'}\ndesign: {{order: 5, fix: {nodes}}}"
    found = find_parameters(loads_family(fehlberg)).last
    [one] = found.found
    assert one.order is not None
    assert (one.order.order, one.solution.degree) == (5, 1)
    assert one.solution.values["b4"] == fmpq(28561, 56430)
    assert one.solution.values["a65"] == fmpq(-11, 40)
    nodes = "{c2: 1/5, c3: 3/10, c4: 3/5, c5: 1, c6: 7/8}"
    wanted = f"{{order: 5, embedded-order: 4, fix: {nodes}}}"
    family = loads_family(f"unknown: {shape % 'true'}\ndesign: {wanted}")
    found = find_parameters(family).last
    assert (found.kind, found.known.is_real) == ("family", True)
    known = load("cash-karp-5")
    values = {name: fmpq(0) for name in family.ring.names}
    for k, name in enumerate(f"b{i}" for i in range(1, 7)):
        values[name] = known.tableau.colours[0].b[k]
        values[f"bh{k + 1}"] = known.further.embedded[0][k]
        values[f"c{k + 1}"] = known.tableau.colours[0].c[k]
        for j, a in enumerate(known.tableau.block(0, 0)[k][:k], start=1):
            values[f"a{k + 1}{j}"] = a
    at = [values[name] for name in family.ring.names]
    assert not any(p(*at) for p in found.polynomials)


def test_reduced_bases() -> None:
    """That of an ideal is unique: python-flint makes the same from any other basis of it."""
    context = fmpz_mpoly_ctx.get(["x", "y", "z"], Ordering.degrevlex)
    x, y, z = context.gens()
    given = [2 * x**2 - 3 * y * z + 1, x * y - z**2, y**3 - 5 * x * z + y]
    vector: Any = fmpz_mpoly_vec(given, context)
    found = list(vector.buchberger_naive())
    made = reduced([*reversed(found), found[0] * y], context)
    theirs = fmpz_mpoly_vec(found, context).autoreduction(groebner=True)
    assert len(made) > 3
    assert {str(p) for p in made} == {str(p if p.leading_coefficient() > 0 else -p) for p in theirs}
    degrees = [p.total_degree() for p in made]
    assert degrees == sorted(degrees)


def test_long_polynomials_are_not_shown(tmp_path: Path) -> None:
    """A root of a long polynomial has its degree in the text and its polynomial in JSON; of many
    long conditions the first are shown; what is not decided comes with the cure.
    """
    path = tmp_path / "long.yaml"
    entry = " + ".join(f"{k + 1}{'0' * 110}{k + 7}*t**{k}" for k in range(4))
    path.write_text(f"parameters: {{t: free}}\nA: [['{entry}']]\nb: [1]\n", "utf-8")
    command = ("design", str(path), "--order", "2")
    assert "a root of a polynomial of degree 3," in " ".join(gark(*command).out.split())
    data = json.loads(gark(*command, "--format", "json").out)
    assert "x^3" in str(data["solutions"][0]["values"]["t"])
    path.write_text("unknown: {stages: 3, shape: sdirk}\n", "utf-8")
    run = gark("design", str(path), "--order", "3")
    assert "polynomials more with -v" in run.out
    assert len(run.out.splitlines()) < 50
    path.write_text("unknown: {stages: 3, shape: full}\n", "utf-8")
    run = gark("design", str(path), "--order", "6", "--seconds", "0.01")
    assert (run.code, "with fewer such as" in " ".join(run.out.split())) == (3, True)


def test_seconds_are_a_number(tmp_path: Path) -> None:
    """A nan is larger than no number, and no limit would ever be reached."""
    path = tmp_path / "one.gark.yaml"
    path.write_text("unknown: {stages: 1}\n", encoding="utf-8")
    run = gark("design", str(path), "--seconds", "nan")
    assert (run.code, "not a number of seconds" in run.err) == (2, True)


def test_solutions_that_are_open() -> None:
    """No accepted solution is no answer where one is open, or where there may be others."""
    [solution] = solutions(Ideal(Parameters(["x"])).with_zeros([Parameters(["x"]).context.gen(0)]))
    ideal = Ideal(Parameters(["x"]))
    order = find_order(load("rk4").tableau)
    open_ = Found(solution, order, (), open=(0,))
    none = Found(solution, order, ())
    there = Found(solution, order, (0,))
    assert Solutions(1, ideal, found=(none,)).has_methods is False
    assert Solutions(1, ideal, found=(none, open_)).has_methods is None
    assert Solutions(1, ideal, found=(there, open_)).has_methods is True
    assert Solutions(1, ideal, found=(replace(there, order=None),)).has_methods is False
    ideal.is_proved = False
    assert Solutions(1, ideal, found=(none,)).has_methods is None
