"""``gark design --a-stable`` and the like: exact sets of parameter values."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from garkcli import loads, pair
from garkcli.design.stable_set import stable_set
from garkcli.design.stable_values import StableValues, Wanted
from garkcli.exact.polynomial_text import root_text
from garkcli.exact.roots import RealRoot
from garkcli.methodfile.family import loads_family
from garkcli.problems.oscillator import Oscillator, terms_of
from garkcli.stability.linear import is_a_stable, is_l_stable, stability_function
from garkcli.stability.oscillator import oscillator_stability
from garkcli.tableau.family import OSCILLATING
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import gark
from tests.whole import at_most, in_whole

THETA = "parameters: {t: free}\nA: [[0, 0], [1 - t, t]]\nb: [1 - t, t]\n"
SDIRK2 = "parameters: {t: free}\nA: [[t, 0], [1 - 2*t, t]]\nb: [1/2, 1/2]\n"
STIFF2 = "parameters: {t: free}\nA: [[t, 0], [1 - t, t]]\nb: [1 - t, t]\n"
TAU = """parameters: {{t: free}}
methods:
  - {{family: {}, stages: {}}}
  - {{family: {}, stages: {}}}
transfer: {{interpolation: t, collocation: 1 - t}}
"""
SMALL = 1 - 2**0.5 / 2
LARGE = 1 + 2**0.5 / 2


def found(text: str, wanted: Wanted, is_pair: bool = False) -> StableValues:
    """The set for a family."""
    values = stable_set(loads_family(text), wanted, "pair" if is_pair else "method")
    assert isinstance(values, StableValues)
    return values


def texts(values: StableValues) -> list[tuple[str | None, str | None, bool, bool]]:
    """The set with its ends as text."""

    def text(root: RealRoot | None) -> str | None:
        return None if root is None else root_text(root)

    return [(text(x.start), text(x.end), x.has_start, x.has_end) for x in values.found]


@pytest.mark.parametrize(
    ("text", "wanted", "known"),
    [
        (THETA, "a-stable", [("1/2", None, True, False)]),
        (THETA, "l-stable", [("1", "1", True, True)]),
        (SDIRK2, "a-stable", [("1/4", None, True, False)]),
        (
            SDIRK2,
            "l-stable",
            [
                ("1 - sqrt(2)/2", "1 - sqrt(2)/2", True, True),
                ("1 + sqrt(2)/2", "1 + sqrt(2)/2", True, True),
            ],
        ),
        (STIFF2, "l-stable", [("1 - sqrt(2)/2", "1 + sqrt(2)/2", True, True)]),
        (THETA.replace("free", "{free: true, range: [0, 1]}"), "a-stable", None),
    ],
)
def test_known_sets(text: str, wanted: Wanted, known: list[object] | None) -> None:
    """The θ-method for θ ≥ 1/2, L-stable at 1; SDIRK of two stages for γ ≥ 1/4, L-stable at
    γ = 1 ± √2/2 (Hairer and Wanner, section IV.6); a range cuts the set.
    """
    if known is None:
        known = [("1/2", "1", True, True)]
    values = found(text, wanted)
    assert texts(values) == known
    assert values.undecided == ()


IMPLICIT = "parameters: {t: free}\nA: [[t]]\nb: [1]\n"
CONSISTENT = IMPLICIT + "c: [1/8]\ndesign: {consistent: true}\n"
DIAGONAL = "parameters: {t: free}\nA: [[1, 0], [0, 1]]\nb: [t, 1 - t]\n"


@pytest.mark.parametrize(
    ("text", "known"),
    [
        (IMPLICIT, [("1/2", None, True, False)]),
        (IMPLICIT + "c: [1/8]\n", [("1/2", None, True, False)]),
        (CONSISTENT, []),
        (CONSISTENT.replace("1/8", "3/4"), [("3/4", "3/4", True, True)]),
        (IMPLICIT + "design: {fix: {t: 1/8}}\n", []),
        (DIAGONAL + "design: {positive-weights: true}\n", [("0", "1", False, False)]),
        (IMPLICIT + "design: {nodes-in-unit-interval: true}\n", [("1/2", "1", True, True)]),
    ],
)
def test_what_the_file_wants_as_well(text: str, known: list[object]) -> None:
    """Nodes that are to be row sums, fixed values and signs that are wanted cut the set as ranges
    do, nodes that are data do not: R(z) of one stage is that of the θ-method.
    """
    values = found(text, "a-stable")
    assert texts(values) == known
    assert values.has_wishes is ("design" in text)


@pytest.mark.parametrize(
    ("families", "wanted"),
    [
        (("gauss", 1, "lobatto-iiia", 2), [("1", "1", True, True)]),
        pytest.param(("gauss", 2, "lobatto-iiia", 3), [("1", "1", True, True)], marks=in_whole),
        pytest.param(("gauss", 2, "lobatto-iiia", 4), [("1", "1", True, True)], marks=in_whole),
    ],
)
def test_combinations_that_are_p_stable(families: tuple[object, ...], wanted: list[object]) -> None:
    """Gauss × Lobatto: interpolation alone, an isolated point of the parameter; of the method and
    of its symplectic pair.
    """
    text = TAU.format(*families)
    assert texts(found(text, "p-stable")) == wanted
    assert texts(found(text, "p-stable", is_pair=True)) == wanted


def decided(tableau: Tableau, wanted: Wanted) -> bool:
    """One method by the ordinary engine."""
    if wanted in OSCILLATING:
        problem = Oscillator.default(terms_of(tableau), fmpq(1))
        found = oscillator_stability(tableau, problem)
        return found.is_p_stable if wanted == "p-stable" else found.is_i_stable
    R = stability_function(tableau)
    return is_a_stable(R) if wanted == "a-stable" else is_l_stable(R)


def contains(values: StableValues, t: fmpq) -> bool:
    """Whether a rational number belongs to the set."""
    root = RealRoot.rational(t)
    for x in values.found:
        behind = x.start is None or x.start < root or (x.has_start and x.start == root)
        before = x.end is None or root < x.end or (x.has_end and x.end == root)
        if behind and before:
            return True
    return False


@pytest.mark.parametrize("wanted", ["a-stable", "l-stable", "p-stable", "i-stable"])
@pytest.mark.parametrize(
    "families",
    [
        ("gauss", 1, "lobatto-iiia", 2),
        pytest.param(("radau-iia", 2, "lobatto-iiia", 3), marks=in_whole),
        pytest.param(("gauss", 2, "lobatto-iiia", 4), marks=in_whole),
    ],
)
def test_against_single_values(families: tuple[object, ...], wanted: Wanted) -> None:
    """Many rational values, and those next to each end, are decided one by one."""
    text = TAU.format(*families)
    values = found(text, wanted)
    tried = [fmpq(k, 4) for k in range(-10, 34, 3)] + [fmpq(k) for k in range(-1, 8)]
    for x in values.found:
        for end in (x.start, x.end):
            if end is not None:
                near = fmpq(int(float(end.ball(80)) * 1000), 1000)
                tried += [near - fmpq(1, 1000), near, near + fmpq(1, 500)]
    for t in tried:
        method = loads(text, settings={"t": str(t)})
        assert contains(values, t) == decided(method.tableau, wanted), t


_ENTRY = st.tuples(st.integers(-2, 2), st.integers(-2, 2))


@in_whole
@settings(max_examples=at_most(5, 20))
@given(st.lists(_ENTRY, min_size=5, max_size=5), st.sampled_from(["a-stable", "l-stable"]))
def test_random_families(entries: list[tuple[int, int]], wanted: Wanted) -> None:
    """Of two stages with entries linear in t, one with a pole: sets against single values."""
    a, b, c, d, w = (f"({p} + {q}*t)/2" for p, q in entries)
    if any(entries[1]):  # 0/(t - 3) is 0 for every t
        b = f"{b}/(t - 3)"
    compare(f"A: [[{a}, {b}], [{c}, {d}]]\nb: [{w}, 1 - {w}]\n", wanted)


@in_whole
@settings(max_examples=at_most(2, 20))
@given(st.lists(_ENTRY, min_size=2, max_size=2), st.sampled_from([0, 1, 2]))
def test_random_families_on_the_oscillator(entries: list[tuple[int, int]], b: int) -> None:
    """The same of P- and I-stability, with two entries that are linear in t."""
    a, c = (f"({p} + {q}*t)/2" for p, q in entries)
    for wanted in ("p-stable", "i-stable"):
        compare(f"A: [[{a}, 0], [{c}, {a}]]\nb: [{b}/2, 1 - {b}/2]\n", wanted)


def test_what_damps_is_not_p_stable() -> None:
    """The θ-method has |R(iy)| ≤ 1 for θ ≥ 1/2, and = 1 for θ = 1/2 alone: R(iy) is
    (1 + (1 − θ) iy)/(1 − θ iy). In the file and as wanted of solutions likewise.
    """
    assert texts(found(THETA, "p-stable")) == [("1/2", "1/2", True, True)]
    assert texts(found(THETA, "i-stable")) == [("1/2", None, True, False)]


def compare(body: str, wanted: Wanted) -> None:
    """A set against single values."""
    text = f"parameters: {{t: free}}\n{body}"
    values = found(text, wanted)
    for k in range(-9, 10):
        t = fmpq(k, 3) if k % 2 else fmpq(k, 2)
        if t == 3:
            assert not contains(values, t) or "t - 3" not in text
            continue
        tableau = loads(text, settings={"t": str(t)}).tableau
        assert contains(values, t) == decided(tableau, wanted), (text, t)


def test_the_pair_is_that_of_the_method() -> None:
    """P-stability of the pair at its single value, and not beside it."""
    text = TAU.format("gauss", 2, "lobatto-iiia", 3)
    for t, known in (("1", True), ("99/100", False), ("1/2", False)):
        tableau = pair(loads(text, settings={"t": t})).tableau
        assert decided(tableau, "p-stable") is known


def test_as_a_command(tmp_path: Path) -> None:
    """Text, JSON, exit codes, and what is refused."""
    path = tmp_path / "theta.yaml"
    path.write_text(THETA, encoding="utf-8")
    run = gark("design", path.name, "--a-stable", cwd=tmp_path)
    assert run.code == 0
    assert run.out.endswith("method is A-stable for exactly 1/2 ≤ t\n")
    data = json.loads(gark("design", str(path), "--l-stable", "--format", "json").out)
    assert (data["schema"], data["wanted"]) == ("gark/design-stability/1", "l-stable")
    assert data["set"] == [{"point": "1"}]
    path.write_text("parameters: {t: free}\nA: [[t/9]]\nb: [1 + t*t]\n", encoding="utf-8")
    none = gark("design", str(path), "--p-stable")
    assert none.code in {0, 1}
    path.write_text("parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, 1]\n", encoding="utf-8")
    explicit = gark("design", str(path), "--a-stable")
    assert (explicit.code, "for no value of t" in explicit.out) == (1, True)
    one = gark("design", str(path), "--a-stable", "--order", "2")
    assert (one.code, "not A-stable, which is wanted" in one.out) == (1, True)
    both = gark("design", str(path), "--a-stable", "--emit", str(path) + "x")
    assert (both.code, "use one" in both.err) == (2, True)
    path.write_text(
        "parameters: {t: free, u: free, v: free}\nA: [[t + v^2]]\nb: [u]\n", encoding="utf-8"
    )
    two = gark("design", str(path), "--l-stable")
    assert (two.code, "--set v=1/2" in two.err) == (2, True)
    path.write_text("parameters: {t: free}\nA: [[sqrt(t)]]\nb: [1]\n", encoding="utf-8")
    roots = gark("design", str(path), "--a-stable")
    assert (roots.code, "roots among the coefficients" in roots.err) == (2, True)


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        (THETA, "a-stable"),
        (SDIRK2, "l-stable"),
        pytest.param(STIFF2, "a-stable", marks=in_whole),
        (CONSISTENT.replace("1/8", "3/4"), "a-stable"),
        (TAU.format("lobatto-iiia", 2, "gauss", 1), "i-stable"),
        (TAU.format("lobatto-iiia", 2, "gauss", 1), "p-stable"),
    ],
)
def test_a_root_among_the_coefficients(text: str, wanted: Wanted) -> None:
    """With t + √2 in place of t every end of the set is √2 less, and what is within stays so."""
    head, _, body = text.partition("\n")
    shifted = re.sub(r"\bt\b", "(t + sqrt(2))", body)
    moved = found(f"{head}\n{shifted}", wanted)
    values = found(text, wanted)
    assert values.found
    assert (moved.undecided, values.undecided) == ((), ())
    for x, y in zip(moved.found, values.found, strict=True):
        assert (x.has_start, x.has_end) == (y.has_start, y.has_end)
        for mine, other in ((x.start, y.start), (x.end, y.end)):
            assert (mine is None) == (other is None)
            if mine is not None and other is not None:
                assert abs(float(mine) + 2**0.5 - float(other)) < 1e-12


def test_several_roots_among_the_coefficients() -> None:
    """A root of a root, and a root of a polynomial: the values are those of the sum of the roots;
    of two square roots the positive ones are meant.
    """
    for text, root in (
        ("sqrt(2) + sqrt(3)", 2**0.5 + 3**0.5),
        ("sqrt(1 + sqrt(2))", (1 + 2**0.5) ** 0.5),
        ("root_of(x^3 - 3*x + 1, 0.347)", 0.34729635533386066),
        ("sqrt(8) - sqrt(2)", 2**0.5),
    ):
        values = found(f"parameters: {{t: free}}\nA: [['t - ({text})']]\nb: [1]\n", "a-stable")
        ((x,), open_values) = values.found, values.undecided
        assert (x.end, x.has_start, open_values) == (None, True, ())
        assert x.start is not None
        assert float(x.start) == pytest.approx(0.5 + root, abs=1e-12)


def test_other_wishes_are_not_passed_over(tmp_path: Path) -> None:
    """Solutions of the order that the file wants are looked at one by one, as with --order; what
    a set leaves out is refused, and the text says that wishes cut the set.
    """
    path = tmp_path / "wishes.yaml"
    path.write_text(f"{IMPLICIT}design: {{order: 2}}\n", encoding="utf-8")
    one = gark("design", str(path), "--a-stable")
    assert (one.code, "t = 1/2" in one.out) == (0, True)
    path.write_text(CONSISTENT, encoding="utf-8")
    none = gark("design", path.name, "--a-stable", cwd=tmp_path)
    wanted = "A-stable, and as the file wants it, for no value of t"
    assert (none.code, wanted in none.out) == (1, True)
    path.write_text(f"{IMPLICIT}design: {{l-stable: true}}\n", encoding="utf-8")
    refused = gark("design", str(path), "--a-stable")
    assert (refused.code, "L-stable" in refused.err) == (2, True)


def test_ends_that_are_algebraic_numbers(tmp_path: Path) -> None:
    """Ends of degree 3 are told by their polynomials and are decided in their fields."""
    path = tmp_path / "cubic.yaml"
    path.write_text(
        "parameters: {t: free}\nA: [[t, 0, 0], [1/2 - t, t, 0], [2*t, 1 - 4*t, t]]\n"
        "b: [1/6/(1 - 2*t)**2, 1 - 1/3/(1 - 2*t)**2, 1/6/(1 - 2*t)**2]\n",
        encoding="utf-8",
    )
    run = gark("design", str(path), "--a-stable", "--digits", "10")
    assert run.code == 0
    assert "≤ t" in run.out
    assert "a root of" in run.out


SEVENTH = "1 + (t**7 - t - 1)**2"
INSIDE = f"""parameters: {{t: free}}
methods: [{{family: gauss, stages: 1}}, {{family: lobatto-iiia, stages: 3}}]
transfer: {{interpolation: "{SEVENTH}", collocation: "1 - ({SEVENTH})"}}
"""


@in_whole
def test_a_value_inside_that_is_not_decided(tmp_path: Path) -> None:
    """With τ = 1 + p(t)², P-stable for every t as it is for τ ≥ 1, the root of p of degree 7 is not
    decided: it is no part of the set, in text and JSON, and "exactly" is not said.
    """
    path = tmp_path / "inside.yaml"
    path.write_text(INSIDE, encoding="utf-8")
    values = found(INSIDE, "p-stable")
    [root] = values.undecided
    assert root.polynomial.degree() == 7
    assert [(x.start, x.end) for x in values.found] == [(None, root), (root, None)]
    assert not any(x.has_start or x.has_end for x in values.found)
    run = gark("design", str(path), "--p-stable")
    assert run.code == 0
    assert "exactly" not in run.out
    assert "not decided     t = 1.11277568428…, a root of x^7 - x - 1: fields are too" in run.out
    data = json.loads(gark("design", str(path), "--p-stable", "--format", "json").out)
    assert [x["from_included"] or x["to_included"] for x in data["set"]] == [False, False]
    only = INSIDE.replace("{t: free}", "{t: {free: true, range: [1, 2]}}")
    assert [x.has_start for x in found(only, "p-stable").found] == [True, False]


IMEX = """parameters: {g: free}
ark:
  A: [[[0, 0], [1/2, 0]], [[g, 0], [1 - 2*g, g]]]
  b: [1/2, 1/2]
"""


@pytest.mark.parametrize(
    ("options", "said", "known"),
    [
        (["--colour", "2"], "A-stable in colour 2 (the others with λ = 0)", True),
        (["--colour", "1"], "A-stable in colour 1 (the others with λ = 0)", False),
        ([], "A-stable (all colours with one λ)", None),
    ],
)
def test_one_colour_of_several(
    options: list[str], said: str, known: bool | None, tmp_path: Path
) -> None:
    """Colour 2 alone is the SDIRK method of its own, colour 1 is explicit; all with one λ is the
    method whose matrix is the sum of both, and each is said.
    """
    path = tmp_path / "imex.yaml"
    path.write_text(IMEX, encoding="utf-8")
    run = gark("design", str(path), "--a-stable", *options)
    assert said in " ".join(run.out.split())
    data = json.loads(gark("design", str(path), "--a-stable", *options, "--format", "json").out)
    assert data["colour"] == (int(options[1]) if options else None)
    alone = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
    if known is None:
        # y' = λ y + λ y: the sums of both matrices and weights
        both = alone.replace("[[g, 0], [1 - 2*g, g]]", "[[g, 0], [3/2 - 2*g, g]]")
        both = both.replace("b: [1/2, 1/2]", "b: [1, 1]")
        assert texts(found(IMEX, "a-stable")) == texts(found(both, "a-stable"))
        return
    values = stable_set(loads_family(IMEX), "a-stable", colour=int(options[1]) - 1)
    assert texts(values) == (texts(found(alone, "a-stable")) if known else [])
    assert run.code == (0 if known else 1)


def test_solutions_that_are_stable_in_one_colour(tmp_path: Path) -> None:
    """--colour beside --order is the wish of the file, and its verdict names the colour; a colour
    that is not there, or no kind of stability, is refused.
    """
    path = tmp_path / "imex.yaml"
    text = IMEX.replace("[[0, 0], [1/2, 0]]", "[[0, 0], [1, 0]]")
    path.write_text(text, encoding="utf-8")
    option = gark("design", str(path), "--order", "2", "--l-stable", "--colour", "2")
    path.write_text(f"{text}design: {{l-stable: {{2: true}}}}\n", encoding="utf-8")
    wish = gark("design", str(path), "--order", "2")
    assert option.out == wish.out
    assert "L-stable in colour 2" in wish.out
    assert option.code == wish.code == 0
    path.write_text(text, encoding="utf-8")
    for options, said in (
        (["--a-stable", "--colour", "3"], "no colour 3"),
        (["--p-stable", "--colour", "1"], "--colour goes with"),
        (["--colour", "1"], "--colour goes with"),
    ):
        refused = gark("design", str(path), *options)
        assert (refused.code, said in refused.err) == (2, True)


THREE_RULES = """parameters: {t1: free, t2: free}
methods: [{family: gauss, stages: 2}, {family: gauss, stages: 3}]
transfer: {interpolation: t1, conjugate-collocation: t2, legendre: 1 - t1 - t2}
"""
SUM = "parameters: {a: free, b: free}\nA: [[a - 2*b, 0], [1 - 2*a + 4*b, a - 2*b]]\nb: [1/2, 1/2]\n"


@pytest.mark.parametrize(
    ("text", "wanted", "told"),
    [
        pytest.param(
            THREE_RULES, "p-stable", "P-stable for exactly t1 = 1 + 2/3*t2", marks=in_whole
        ),
        (SUM, "a-stable", "A-stable for exactly 1/4 ≤ a - 2*b"),
        (
            SUM,
            "l-stable",
            "L-stable for exactly a = 1 - sqrt(2)/2 + 2*b or a = 1 + sqrt(2)/2 + 2*b",
        ),
        (
            IMPLICIT.replace("t: free", "s: free, t: free"),
            "a-stable",
            "A-stable for exactly 1/2 ≤ t",
        ),
        (
            "parameters: {a: free, b: free}\nA: [[1/2]]\nb: [1]\nc: [a + b]\n",
            "a-stable",
            "for every value of a, b",
        ),
    ],
)
def test_several_parameters_that_are_one_number(text: str, wanted: Wanted, told: str) -> None:
    """R depends on one linear form of the parameters: its values, told in the parameters; and with
    the second one fixed the set of the first one is the same.
    """
    report = gark("design", "-", f"--{wanted}", stdin=text)
    assert " ".join(report.out.split()).partition(" 1 - sqrt(2)/2 0.29")[0].endswith(told)
    values = found(text, wanted)
    (form,) = values.forms
    terms = dict(form.terms)
    names = values.family.parameters
    (fixed,) = [name for name in names if name != form.terms[0][0]]
    for value in (fmpq(-2), fmpq(3, 4)):
        one = stable_set(loads_family(text, settings={fixed: str(value)}), wanted)
        shift = terms.get(fixed, fmpq(0)) * value
        for t in (fmpq(k, 8) for k in range(-40, 41)):
            assert contains(values, t + shift) == contains(one, t)


def test_parameters_that_are_several_numbers() -> None:
    """Three numbers: told to fix all parameters but two. Ranges and other wants are those of a set
    in the plane: 1/4 ≤ a - 2b and b ≥ -1.
    """
    text = "parameters: {g: free, d: free, e: free}\nA: [[g, 0], [1 - d, d]]\nb: [1 - e, e]\n"
    run = gark("design", "-", "--a-stable", stdin=text)
    assert run.code == 2
    assert "give values to all but two" in run.err
    ranged = SUM.replace("a: free", "a: {free: true, range: [0, 1]}")
    run = gark("design", "-", "--a-stable", stdin=ranged)
    assert run.out.splitlines()[1:] == ["  0 ≤ a ≤ 1  b ≤ 1/2*a - 1/8"]
