"""Claims on properties: what is known of classical methods, claimed in files."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli import find_property, reduced
from garkcli.check.analysis import analyse
from garkcli.check.check_file import check_method
from garkcli.check.claims import Claim, verify
from garkcli.check.every_value import every_value
from garkcli.errors import MethodFileError, UsageProblem
from garkcli.exact.field import ZERO
from garkcli.methodfile.expectations import CLAIMS
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import load, loads
from garkcli.order.meant import meant
from garkcli.order.simplifying import simplifying
from garkcli.properties import claimed
from garkcli.properties.definitions import definition, every_definition
from garkcli.properties.registry import KEYS
from garkcli.properties.subject import Subject, every_property
from garkcli.properties.verdict import Size
from garkcli.report.check import within
from garkcli.tableau.embedded import NOTHING
from tests.catalogue.catalogue import Entry, entries
from tests.catalogue.method_files import method_file
from tests.cli.harness import gark
from tests.whole import IS_WHOLE, in_whole, sample

FSAL = ("stiffly-accurate: true", "fsal: true")
KNOWN = {
    "methods: {family: gauss, stages: 3}": (
        *("symmetric: true", "algebraically-stable: true", "a-stable: true"),
        *("l-stable: false", "p-stable: true", "stage-order: 3", "implicit-stages: 3"),
        *("stiffly-accurate: false", "real-stability: infinity", "ssp-coefficient: 0"),
        *("nodes-in-unit-interval: true", "positive-weights: true", "reducible: false"),
    ),
    "methods: {family: lobatto-iiia, stages: 3}": (
        *("symmetric: true", "a-stable: true", "algebraically-stable: false"),
        *("fully-implicit: true", "implicit-stages: 2", "stage-order: 3", *FSAL),
    ),
    "methods: {family: lobatto-iiib, stages: 3}": (
        *("symmetric: true", "a-stable: true", "stiffly-accurate: false"),
        *("implicit-stages: 2", "stage-order: 1", "algebraically-stable: false"),
    ),
    "methods: {family: lobatto-iiic, stages: 3}": (
        *("symmetric: false", "l-stable: true", "algebraically-stable: true"),
        *("stiffly-accurate: true", "fsal: false", "stage-order: 2"),
    ),
    "methods: {family: radau-ia, stages: 2}": (
        *("l-stable: true", "algebraically-stable: true", "stiffly-accurate: false"),
        "stage-order: 1",
    ),
    "methods: {family: radau-iia, stages: 3}": (
        *("l-stable: true", "algebraically-stable: true", "stiffly-accurate: true"),
        *("fsal: false", "stage-order: 3", "implicit-stages: 3"),
    ),
    "methods: {family: rk4}": (
        *("explicit: true", "implicit-stages: 0", "stage-order: 1", "fsal: false"),
        *("imaginary-stability: 2*sqrt(2)", "real-stability: 2.785"),
        *("ssp-coefficient: 0", "a-stable: false", "positive-weights: true"),
    ),
    # implicit Euler, midpoint rule, trapezoidal rule
    "{A: [[1]], b: [1]}": (
        *("sdirk: true", "gamma: 1", "ssp-coefficient: infinity", "l-stable: true"),
        *("stiffly-accurate: true", "fsal: false", "algebraically-stable: true"),
        *("p-stable: false", "i-stable: true"),
    ),
    "{A: [[1/2]], b: [1]}": (
        *("ssp-coefficient: 2", "symmetric: true", "p-stable: true", "i-stable: true"),
        "algebraically-stable: true",
    ),
    "{A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}": (
        *("ssp-coefficient: 2", "esdirk: true", "gamma: 0.5", "symmetric: true", *FSAL),
        *("a-stable: true", "l-stable: false", "algebraically-stable: false"),
    ),
    # TR-BDF2
    "{parameters: {g: 1 - sqrt(2)/2, w: sqrt(2)/4},"
    " A: [[0, 0, 0], [g, g, 0], [w, w, g]], b: [w, w, g]}": (
        *("esdirk: true", "gamma: 1 - sqrt(2)/2", "l-stable: true", *FSAL),
        *("implicit-stages: 2", "stage-order: 2", "ssp-coefficient: 1 + sqrt(2)"),
    ),
    # Alexander's SDIRK of order 2, Crouzeix's of order 3
    "{parameters: {g: 1 - sqrt(2)/2}, A: [[g, 0], [1 - g, g]], b: [1 - g, g]}": (
        *("sdirk: true", "l-stable: true", "stiffly-accurate: true", "gamma: 0.2929"),
    ),
    "{parameters: {g: 1/2 + sqrt(3)/6}, A: [[g, 0], [1 - 2*g, g]], b: [1/2, 1/2]}": (
        *("sdirk: true", "a-stable: true", "l-stable: false"),
        *("algebraically-stable: true", "stiffly-accurate: false", "gamma: '>= 1/2'"),
    ),
    # SSPRK(2,2), (3,3), (4,3), (10,4)
    "{A: [[], [1]], b: [1/2, 1/2]}": ("ssp-coefficient: 1", "real-stability: 2"),
    "{A: [[], [1], [1/4, 1/4]], b: [1/6, 1/6, 2/3]}": (
        *("ssp-coefficient: 1", "imaginary-stability: sqrt(3)"),
    ),
    "{A: [[], [1/2], [1/2, 1/2], [1/6, 1/6, 1/6]], b: [1/6, 1/6, 1/6, 1/2]}": (
        *("ssp-coefficient: 2", "explicit: true", "nodes-in-unit-interval: true"),
    ),
    "{parameters: {u: 1/6, v: 1/15}, A: [[], [u], [u, u], [u, u, u], [u, u, u, u],"
    " [v, v, v, v, v], [v, v, v, v, v, u], [v, v, v, v, v, u, u],"
    " [v, v, v, v, v, u, u, u], [v, v, v, v, v, u, u, u, u]],"
    " b: [1/10, 1/10, 1/10, 1/10, 1/10, 1/10, 1/10, 1/10, 1/10, 1/10]}": (
        *("ssp-coefficient: 6", "positive-weights: true"),
    ),
    # rational nodes beside some without simple radicals
    "{methods: [{family: gauss, stages: 4}, {A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}],"
    " transfer: interpolation}": ("nodes-in-unit-interval: true", "positive-weights: true"),
}
"""Textbook methods with what the textbooks say of them."""


USUAL = {"nodes-in-unit-interval", "positive-weights"}
DIRK = USUAL | {"diagonally-implicit", "a-stable", "i-stable"}
FULL = USUAL | {"fully-implicit", "a-stable", "i-stable", "algebraically-stable"}
TRUTHS = {
    "{methods: {family: rk4}}": USUAL | {"explicit"},
    "{A: [[1]], b: [1]}": DIRK | {"sdirk", "stiffly-accurate", "l-stable", "algebraically-stable"},
    "{A: [[1/2]], b: [1]}": DIRK | {"sdirk", "symmetric", "algebraically-stable", "p-stable"},
    "{A: [[0, 0], [1/2, 1/2]], b: [1/2, 1/2]}": DIRK
    | {"esdirk", "stiffly-accurate", "fsal", "symmetric", "p-stable"},
    "{methods: {family: gauss, stages: 2}}": FULL | {"symmetric", "p-stable"},
    "{methods: {family: radau-iia, stages: 2}}": FULL | {"stiffly-accurate", "l-stable"},
    "{parameters: {g: 1 - sqrt(2)/2}, A: [[g, 0], [1 - g, g]], b: [1 - g, g]}": DIRK
    | {"sdirk", "stiffly-accurate", "l-stable"},
    "{A: [[1/3, 0], [1/2, 1/4]], b: [1/2, 1/2]}": DIRK | {"algebraically-stable"},
    "{A: [[], [1], [1, 0]], b: [1/2, 1/4, 1/4]}": USUAL | {"explicit", "reducible"},
    "{A: [[], [-1]], b: [3/2, -1/2]}": {"explicit"},
}
"""Methods with all properties that they have: Hairer, Wanner, sections IV.3, IV.6, IV.12; P-stable
are those with |R(iy)| = 1. M of the method with γ = 1/3 and 1/4 is diag(1/12, 0).
"""


@pytest.mark.parametrize("text", TRUTHS)
def test_a_method_has_its_properties_and_no_others(text: str) -> None:
    """Each property is claimed of each method."""
    keys = [x.key for x in every_property() if x.kind == "truth"]
    found = held(with_claims(text, tuple(f"{key}: true" for key in keys)))
    assert {key for key, claim in zip(keys, found, strict=True) if claim.holds} == TRUTHS[text]
    assert {claim.found for claim in found} <= {"true", "false"}
    for key in keys:
        assert {key in truths for truths in TRUTHS.values()} == {True, False}


def held(text: str, tolerance: str = "") -> list[Claim]:
    """The claims of a file held against the truth."""
    method = loads(f"{text}\n{tolerance}")
    found = analyse(method.tableau, 12, method.tolerance)
    return list(verify(method.claims, found))


def with_claims(text: str, claims: tuple[str, ...]) -> str:
    """A method file with claims."""
    expect = f"expect: {{{', '.join(claims)}}}"
    if text.startswith("{"):
        return f"{text[:-1]}, {expect}}}"
    return f"{text}\n{expect}"


@pytest.mark.parametrize("text", KNOWN)
def test_what_is_known_of_classical_methods(text: str) -> None:
    """Every claim of the table holds."""
    found = held(with_claims(text, KNOWN[text]))
    assert len(found) == len(KNOWN[text])
    assert [claim for claim in found if not claim.holds] == []


@pytest.mark.parametrize(
    ("method", "claim", "found", "why"),
    [
        ("{A: [[1/2]], b: [1]}", "l-stable: true", "false", "R(∞) = -1"),
        (
            "{A: [[], [1]], b: [1/2, 1/2]}",
            "a-stable: true",
            "false",
            "R(z) is not bounded: its numerator has the larger degree",
        ),
        ("{A: [[-1]], b: [1]}", "a-stable: true", "false", "R has a pole at z = -1"),
        (
            "{A: [[1/4]], b: [1]}",
            "a-stable: true",
            "false",
            "|R(iy)| > 1 at x = y² = 1: there -x < 0",
        ),
        ("{A: [[], [1]], b: [3/2, -1/2]}", "positive-weights: true", "false", "b[2] is -1/2"),
        ("{A: [[], [1]], b: [3/2, -1/2]}", "algebraically-stable: true", "false", "b[2] is -1/2"),
        (
            "{A: [[], [1/2]], b: [1/2, 1/2]}",
            "algebraically-stable: true",
            "false",
            "elimination of M meets -1/4 on its diagonal",
        ),
        (
            "{A: [[1/2, 1/3], [1/4, 1/5]], b: [1/2, 1/2]}",
            "diagonally-implicit: true",
            "false",
            "stages 1-2 are solved together",
        ),
        (
            "{A: [[1/2, 0], [1/4, 1/3]], b: [1/2, 1/2]}",
            "gamma: 1/2",
            "no meaning",
            "stages depend on themselves by 1/2 and by 1/3",
        ),
        ("{A: [[], [2]], b: [1/2, 1/2]}", "nodes-in-unit-interval: true", "false", "c[2] is 2"),
        ("{A: [[], [-1]], b: [1/2, 1/2]}", "ssp-coefficient: 1", "0", "a[2,1] is -1"),
        (
            "{A: [[], [1/2]], b: [0, 1]}",
            "stiffly-accurate: true",
            "false",
            "a[2,1] is 1/2, b[1] is 0",
        ),
        (
            "{A: [[], [1]], b: [1/2, 1/2]}",
            "p-stable: true",
            "false",
            "powers of the step matrix are not bounded for 0 < (hω)²",
        ),
        (
            "{A: [[1]], b: [1]}",  # meant as the other property: what to write is said
            "p-stable: true",
            "false",
            "solutions decay; i-stable claims that they are bounded",
        ),
        (
            "{A: [[], [1], [1, 0]], b: [1/2, 1/4, 1/4]}",
            "reducible: false",
            "true",
            "2 stages do the same",
        ),
        (
            "prk: {q: {A: [[0], [1]], b: [1]}, p: {A: [[1/2, 0]], b: [1/2, 1/2]}}\n"
            "structure: separable",
            "a-stable: true",
            "no meaning",
            "some stages do not depend on every vector field",
        ),
    ],
)
def test_a_claim_that_fails_says_why(method: str, claim: str, found: str, why: str) -> None:
    """The entry, the pole, the polynomial or the interval that decides."""
    (result,) = held(with_claims(method, (claim,)))
    assert not result.holds
    assert (result.found, result.why) == (found, why)


@pytest.mark.parametrize(
    ("claim", "holds"),
    [
        ("2*sqrt(2)", True),
        ("sqrt(8)", True),
        ("2.83", True),
        ("2.8284", True),
        ("2.82", False),
        ("283/100", False),
        ("'>= 2.8'", True),
        ("'>= 2*sqrt(2)'", True),
        ("'>= 2.83'", False),
        ("infinity", False),
    ],
)
def test_claims_on_real_numbers(claim: str, holds: bool) -> None:
    """Exact numbers are exact, decimals claim their digits; of rk4 |R(iy)| ≤ 1 to y = 2√2."""
    (result,) = held(f"methods: {{family: rk4}}\nexpect: {{imaginary-stability: {claim}}}")
    assert result.holds is holds


@given(st.fractions(min_value="1/100", max_value=9), st.integers(0, 6))
def test_a_number_agrees_with_its_decimals(value: object, places: int) -> None:
    """γ of a method with one stage is what its entry is rounded to, at any number of places."""
    number = fmpq(value.numerator, value.denominator)  # type: ignore[attr-defined]
    shifted = number * 10**places + fmpq(1, 2)
    whole = int(shifted.floor())
    digits = str(whole).rjust(places + 1, "0")
    decimal = f"{digits[: len(digits) - places]}.{digits[len(digits) - places :]}"
    (result,) = held(f"{{A: [[{number}]], b: [1], expect: {{gamma: {decimal}}}}}")
    assert result.holds
    other = f"{digits[: len(digits) - places]}.{digits[len(digits) - places :]}1"
    (result,) = held(f"{{A: [[{number}]], b: [1], expect: {{gamma: {other}}}}}")
    assert result.holds is (abs(number * 10 ** (places + 1) - whole * 10 - 1) * 2 <= 1)


@pytest.mark.parametrize(
    ("claim", "words"),
    [
        ("gamma: two", "'two' has no value"),
        ("gamma: 1/0", "division by zero"),
        ("a-stable: maybe", "'maybe' is not known"),
        ("implicit-stages: some", "a number or"),
        ("a-stabel: true", "unknown key 'a-stabel'"),
    ],
)
def test_claims_that_cannot_be_read(claim: str, words: str) -> None:
    """One fault each, in words."""
    with pytest.raises(MethodFileError) as caught:
        loads(f"{{A: [[1]], b: [1], expect: {{{claim}}}}}")
    (fault,) = caught.value.faults
    assert words in fault.message


def test_every_property_is_defined() -> None:
    """Each file has the properties that the list says, the keys are those that files may claim, and
    all are defined.
    """
    (folder,) = claimed.__path__
    files = {path.stem for path in Path(folder).glob("*.py")} - {"__init__"}
    assert set(KEYS.values()) == files
    assert [found.key for found in every_property()] == list(KEYS)
    assert sorted(found.key for found in every_definition()) == sorted(CLAIMS)
    for found in every_definition():
        assert definition(found.key) == found
        assert found.text.endswith(".")


def test_an_unknown_claim_has_a_suggestion() -> None:
    """A misspelt key is answered with the nearest one."""
    with pytest.raises(UsageProblem) as caught:
        definition("l-stabel")
    assert caught.value.help == "did you mean 'l-stable'?"


# -- within a tolerance


SDIRK_ROUNDED = """
A: [[0.29289321881, 0], [0.70710678119, 0.29289321881]]
b: [0.70710678119, 0.29289321881]
tolerance: 1e-10
"""


ROUNDED = (
    "A: [[0.292893, 0], [0.707106, 0.292894]]\nb: [0.707107, 0.292893]",
    "A: [[0.25, -0.038675], [0.538676, 0.25]]\nb: [0.5, 0.5]\nc: [0.211325, 0.788675]",
    "A: [[0, 0], [0.333333, 0.333334]]\nb: [0.333333, 0.666666]",
    "A: [[0, 0, 0], [0.5, 0, 0], [0.333333, 0.666667, 0]]\nb: [0.333334, 0.666666, 0]",
    "A: [[0, 0, 0], [0.292893, 0.292893, 0], [0.353553, 0.353553, 0.292894]]\n"
    "b: [0.353553, 0.353553, 0.292893]",
    "A: [[0, 0, 0], [0.333333, 0, 0], [0.333334, 0, 0]]\nb: [0.25, 0.375, 0.375]",
    "A: [[0, 0, 0, 0], [0.333333, 0, 0, 0], [0.333334, 0, 0, 0], [0, 0.333333, 0.333333, 0]]\n"
    "b: [0.25, 0, 0, 0.75]",
)
"""Methods of six digits: each property of equations holds in one of them within these alone."""


def test_equations_that_rounding_explains_say_so() -> None:
    """A property that the printed numbers have not is said to hold within the tolerance; a new one
    that asks for equations needs a method here.
    """
    explained = set()
    for text in ROUNDED:
        exact = check_method(loads(text)).analysis
        rounded = check_method(loads(f"{text}\ntolerance: 1e-6")).analysis
        assert exact is not None
        assert rounded is not None
        for key in [x.key for x in every_property() if x.asks != "signs"]:
            value = rounded.subject.verdict(key).value
            if value and value != exact.subject.verdict(key).value:
                assert within(rounded, key) == fmpq(1, 10**6), key
                explained.add(key)
    assert explained == {x.key for x in every_property() if x.asks == "equations"}


def test_rounded_coefficients() -> None:
    """Equations hold as far as rounding explains them, signs where they are sure; what neither
    shows is not decided.
    """
    claims = {
        "sdirk": "true",
        "gamma": "1 - sqrt(2)/2",
        "stiffly-accurate": "true",
        "a-stable": "true",
        "l-stable": "true",
        "positive-weights": "true",
        "nodes-in-unit-interval": "true",
        "reducible": "false",
    }
    lines = "".join(f"\n  {key}: {value}" for key, value in claims.items())
    assert all(claim.holds for claim in held(f"{SDIRK_ROUNDED}expect:{lines}"))
    open_ones = "{p-stable: true, i-stable: true}"
    found = held(f"{SDIRK_ROUNDED}expect: {open_ones}")
    assert {claim.found for claim in found} == {"not decided"}
    assert not any(claim.holds for claim in found)


@pytest.mark.parametrize(
    ("entry", "holds"),
    [
        ("0.70710678138", True),
        ("0.70710678100", True),
        ("0.70710678140", False),
        ("-0.70710678119", False),
    ],
)
def test_a_last_row_that_is_rounded_otherwise(entry: str, holds: bool) -> None:
    """Two roundings by 10⁻¹⁰ of one number differ by less than 2·10⁻¹⁰, and have one sign."""
    text = SDIRK_ROUNDED.replace("[0.70710678119, 0.29289321881]]", f"[{entry}, 0.29289321881]]")
    (found,) = held(f"{text}expect: {{stiffly-accurate: true}}")
    assert found.holds is holds


@in_whole
def test_a_weight_near_zero_is_not_decided() -> None:
    """It is positive in the file and may not be."""
    text = "{A: [[0, 0], [1/2, 0]], b: [1e-9, 0.999999999], tolerance: 1e-8,"
    (claim,) = held(f"{text} expect: {{positive-weights: true}}}}")
    assert (claim.holds, claim.found) == (None, "not decided")


def test_rounding_decides_algebraic_stability_where_it_can() -> None:
    """An explicit method is never algebraically stable; a definite form stays definite; the form of
    the method that seven digits of Gauss 2 mean is zero.
    """
    explicit = "{A: [[0, 0], [0.5, 0]], b: [0.5, 0.5], tolerance: 1e-6,"
    (claim,) = held(f"{explicit} expect: {{algebraically-stable: false}}}}")
    assert claim.holds
    definite = "{A: [[1.0]], b: [1.0], tolerance: 1e-6,"
    (claim,) = held(f"{definite} expect: {{algebraically-stable: true}}}}")
    assert claim.holds
    gauss = "{A: [[0.25, -0.0386751], [0.5386751, 0.25]], b: [0.5, 0.5], tolerance: 1e-6,"
    (claim,) = held(f"{gauss} expect: {{algebraically-stable: true}}}}")
    assert claim.holds


# -- methods of several colours


def test_an_imex_method() -> None:
    """ARS(2,2,2): an explicit colour and an ESDIRK one on shared stages, globally stiffly accurate."""
    subject = subject_of(load("methods/ark-ars222.gark.yaml"))
    assert [x.name for x in subject.shapes if x] == ["explicit", "ESDIRK"]
    assert subject.verdict("esdirk").value is True
    assert str(subject.verdict("gamma").value) == "1 - sqrt(2)/2"
    assert subject.verdict("stiffly-accurate").value is True
    assert subject.verdict("implicit-stages").value == 2
    assert subject.verdict("positive-weights").why == "b{1}[1] is -sqrt(2)/2"


def test_stages_of_several_methods_that_are_solved_together() -> None:
    """Gauss 2 and Lobatto IIIA 3 by collocation: the first Lobatto stage is explicit, the other four
    are one system; the stage order is the smaller one.
    """
    subject = subject_of(load("methods/collocation.gark.yaml"))
    assert subject.shape.systems == (((0, 0), (0, 1), (1, 1), (1, 2)),)
    assert subject.verdict("implicit-stages").value == 4
    assert subject.simplifying.stage_orders == (2, 3)
    assert subject.verdict("stage-order").value == 2


def subject_of(method: object) -> Subject:
    """A method as its properties are decided."""
    tableau = method.tableau  # type: ignore[attr-defined]
    tolerance = method.tolerance or ZERO  # type: ignore[attr-defined]
    known = meant(tableau, tolerance)
    return Subject.read(known, 1, simplifying(known, 5), 5, NOTHING)


# -- the catalogue


CATALOGUE = entries()
IMEX = {"ARK324L2SA", "ARK436L2SA", "ARK437L2SA", "ARK548L2SA", "ARK548L2SAb"}


def kind_by_name(name: str, entry: Entry) -> str:
    """What the source calls a method."""
    short = name.removeprefix("sundials_")
    if entry["kind"] in {"ark", "gark"} or short in IMEX:
        return "diagonally implicit"
    words = ("ESDIRK", "SDIRK", "KVAERNO", "CASH_5", "BILLINGTON", "TRBDF2", "IMPLICIT")
    is_implicit = any(word in short for word in (*words, "BACKWARD"))
    return "diagonally implicit" if is_implicit else "explicit"


LONG = {
    *("sprk_Sofroniou_10_36", "Feagin12", "sprk_KahanLi_8_18", "sprk_SuzukiUmeno_8_16"),
    *("sprk_McAte8_26digits", "sundials_VERNER_13_7_8"),
}
"""Methods of many stages, which take long."""


@pytest.mark.parametrize("name", sample([x for x in CATALOGUE if IS_WHOLE or x not in LONG], 6))
def test_published_methods_are_what_they_are_called(name: str) -> None:
    """Explicit and diagonally implicit methods by their names; ESDIRK methods have the γ of their
    first implicit stage; those called SA are stiffly accurate and have stage order 2.
    """
    entry = CATALOGUE[name]
    subject = subject_of(loads(method_file(entry)))
    assert subject.shape.kind == kind_by_name(name, entry)
    if "_ESDIRK" in name or "KVAERNO" in name:
        assert subject.verdict("esdirk").value is True
        assert subject.verdict("stiffly-accurate").value is True
        assert subject.verdict("fsal").value is True
        assert subject.verdict("stage-order").value == 2
    if "DORMAND_PRINCE" in name or "BOGACKI" in name or "TSITOURAS" in name:
        assert subject.verdict("fsal").value is True
        assert subject.verdict("reducible").value is True  # this subject has no embedded weights


@pytest.mark.parametrize(
    ("name", "real", "imaginary"),
    [
        ("DORMAND_PRINCE_7_4_5", 3.3066, 0.9972),
        ("BOGACKI_SHAMPINE_4_2_3", 2.5127, 1.7321),
        ("CASH_KARP_6_4_5", 3.7344, 0),
        ("FEHLBERG_6_4_5", 3.6777, 0),
        ("ZONNEVELD_5_3_4", 2.7853, 2.8284),
    ],
)
def test_stability_intervals_of_published_methods(name: str, real: float, imaginary: float) -> None:
    """The ends of the real and imaginary intervals satisfy |R| = 1, by a scan in floats."""
    subject = subject_of(loads(method_file(CATALOGUE[f"sundials_{name}"])))
    for key, wanted in (("real-stability", real), ("imaginary-stability", imaginary)):
        value = subject.verdict(key).value
        assert isinstance(value, Size)
        assert value.root is not None
        assert abs(float(value.root.ball(60)) - wanted) < 1e-4
        assert subject.linear is not None
        along = -1.0 if key == "real-stability" else 1j
        if wanted:
            inside = [wanted * k / 40 for k in range(1, 40)]
            assert all(abs(_value(subject, along * x)) < 1 + 1e-9 for x in inside)
            assert abs(_value(subject, along * (wanted + 1e-2))) > 1


def _value(subject: Subject, z: complex) -> complex:
    """R(z) of an explicit method in floats."""
    assert subject.linear is not None
    total = 0j
    for a in reversed(subject.linear.numerator.coefficients):
        total = total * z + float(fmpq(str(a)).p) / float(fmpq(str(a)).q)  # type: ignore[arg-type]
    return total


IDLE = "tableau: {A: [[[[1/2]], [[0]]], [[[ROW]], [[OWN]]]], b: [[1], [0]]}"


@pytest.mark.parametrize(("row", "own"), [("1/4", "3/4"), ("0", "0"), ("1/3", "1/5")])
def test_a_colour_that_no_step_depends_on_is_no_part_of_the_shape(row: str, own: str) -> None:
    """Its stage is neither solved for nor has it a γ, whatever its row is."""
    method = loads(IDLE.replace("ROW", row).replace("OWN", own))
    found = analyse(method.tableau).subject
    assert found.shape.implicit_stages == 1
    assert found.shape.gamma == fmpq(1, 2)
    assert found.verdict("reducible").value is False


@pytest.mark.parametrize(
    ("further", "expected"),
    [
        ("", True),
        ("embedded: [7/24, 1/4, 1/3, 1/8]", False),
        ("embedded: [1/4, 1/2, 1/4, 0]", True),
        ("dense: {degree: 1, weights: [[2/9], [1/3], [1/3], [1/9]]}", False),
    ],
)
def test_reducible_is_what_convert_reduces(further: str, expected: bool) -> None:
    """The last stage of Bogacki and Shampine's FSAL pair can be left out unless embedded weights or
    dense output use it: ``gark check``, ``find_property``, ``gark convert --to reduced`` and a file
    with a free parameter agree.
    """
    text = f"""A: [[], [1/2], [0, 3/4], [2/9, 1/3, 4/9]]
b: [2/9, 1/3, 4/9, 0]
{further}
"""
    method = loads(text)
    checked = analyse(method.tableau, further=method.further).subject.verdict("reducible")
    assert checked.value is find_property(method, "reducible").value is expected
    smaller = reduced(method)
    assert smaller is not None
    assert (smaller.stages < method.stages) is expected
    family = f"parameters: {{g: free}}\n{text}".replace("[0, 3/4]", "[g, 3/4 - g]")
    every = every_value(loads_family(family, is_design=False), 4)
    assert every.verdict("reducible").value is expected


@pytest.mark.parametrize("A", ["[[1/4]]", "[[1/4, 1], [0, 1/3]]", "[[0, 1], [1, 0]]"])
def test_stages_that_no_step_depends_on_are_implicit_all_the_same(A: str) -> None:
    """Without weights no stage matters, and what a program solves for is solved for still; a single
    such stage stays as every method has one.
    """
    stages = A.count("[") - 1
    method = loads(f"{{A: {A}, b: {[0] * stages}}}")
    found = analyse(method.tableau).subject
    assert found.verdict("explicit").value is False
    assert found.verdict("implicit-stages").value == stages
    reducible = found.verdict("reducible")
    assert reducible.value is (stages > 1)
    if stages == 1:
        assert reducible.why == "no step depends on stage 1, but a method keeps one stage"


def test_stage_order_is_that_of_b_and_c() -> None:
    """Weights that sum to 3/4 have stage order 0 though C(1) holds; a search that stops says so."""
    low = loads("{A: [[0, 0], [1, 0]], b: [1/2, 1/4]}")
    found = analyse(low.tableau)
    assert found.simplifying.eta == 1
    assert found.subject.verdict("stage-order").value == found.simplifying.stage_order == 0
    gauss = analyse(loads("methods: [{family: gauss, stages: 4}]").tableau, 3)
    assert gauss.subject.verdict("stage-order").is_at_least
    assert gauss.simplifying.is_open(gauss.bound)
    assert not analyse(loads("methods: [{family: gauss, stages: 4}]").tableau).simplifying.is_open(
        8
    )


OPEN = """
A: [[0.167, 3.333], [-1.333, 0.333]]
b: [0.333, 0.667]
tolerance: 1e-3
expect: {p-stable: true, WHAT}
"""


@pytest.mark.parametrize(
    ("other", "code", "answers"),
    [pytest.param("order: 2", 3, [None, True], marks=in_whole), ("order: 3", 1, [None, False])],
)
def test_an_undecided_claim_neither_holds_nor_fails(
    other: str, code: int, answers: list[bool | None]
) -> None:
    """Rounding leaves a sign open: exit code 3, and 1 where another claim fails. ``null`` in JSON,
    said so in text, and skipped in JUnit.
    """
    text = OPEN.replace("WHAT", other)
    run = gark("check", "-", stdin=text)
    assert (run.code, "claim undecided  p-stable: expected true" in run.out) == (code, True)
    assert ("CLAIM FAILS" in run.out) == (False in answers)
    several = gark("check", "-", "rk4", stdin=text).out
    words = {3: ("open <stdin>", "1 file undecided"), 1: ("FAIL <stdin>", "1 file failed")}[code]
    assert all(x in several for x in words)
    table = gark("check", "-", "rk4", "--format", "markdown", stdin=text).out
    assert ("1 of 2 fail, 1 of 2 undecided" if code == 1 else "1 of 2 undecided") in table
    data = json.loads(gark("check", "-", "--format", "json", stdin=text).out)
    assert [claim["holds"] for claim in data["files"][0]["claims"]] == answers
    junit = gark("check", "-", "--format", "junit", stdin=text).out
    assert f'failures="{answers.count(False)}" errors="0" skipped="1"' in junit


@pytest.mark.parametrize(
    ("order", "holds"), [("5", False), ("7", None), ('">= 6"', True), ('">= 7"', None)]
)
def test_a_search_that_stops_leaves_larger_orders_open(order: str, holds: bool | None) -> None:
    """Gauss 3 has order 6; a search up to 6 knows no more than that it is 6 or more."""
    method = loads(f"methods: [{{family: gauss, stages: 3}}]\nexpect: {{order: {order}}}\n")
    assert [x.holds for x in verify(method.claims, analyse(method.tableau, limit=6))] == [holds]


def test_a_claim_for_every_value_may_be_open() -> None:
    """Values that differ refute a claim on algebraic stability for every value; where nothing but
    more parameters is in the way it is undecided.
    """
    text = 'parameters: {g: {free: true, range: [1/2, 1]}, k: {free: true, range: [1/2, 1]}}\nA: [["g", 0], ["1 - g - k", "k"]]\nb: [1/2, 1/2]\nexpect: {CLAIM: true}\n'
    found = {}
    for claim in ("a-stable", "symplectic"):
        run = gark("check", "-", "--format", "json", stdin=text.replace("CLAIM", claim))
        (judged,) = json.loads(run.out)["files"][0]["claims"]
        found[claim] = (judged["holds"], run.code)
    assert found == {"a-stable": (None, 3), "symplectic": (False, 1)}
