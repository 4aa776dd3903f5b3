"""Certificates of rounded methods: that one within the rounding has the order."""

from __future__ import annotations

import json
from collections.abc import Iterator
from copy import deepcopy
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from flint import fmpq

import garkcli
from garkcli import from_arrays, load, loads
from garkcli.check.analysis import analyse_any
from garkcli.check.existing import prove_method_exists
from garkcli.errors import MethodError
from garkcli.order.meant import as_meant
from garkcli.order.rounded import RoundedTableau
from garkcli.report.certificate import REPORT
from tests.cli.harness import gark
from tests.integration.test_referee import ENDLESS, REFEREE, judged
from tests.whole import in_whole

ERK = """
name: three stages
A: [[0, 0, 0], [0.47140452, 0, 0], [-0.37156701, 1.23759242, 0]]
b: [0.17848614, 0.53583549, 0.28567837]
embedded: [-0.06066017, 1.06066017, 0]
tolerance: 0.5e-8
"""
"""With c₂ = √2/3 and c₃ = √3/2, which no number of the file has exactly."""
TWO = """
name: two colours
ark:
  A:
    - [[0, 0, 0], [0.29289322, 0, 0], [-0.70710678, 1.70710678, 0]]
    - [[0, 0, 0], [0, 0.29289322, 0], [0, 0.70710678, 0.29289322]]
  b: [[-0.70710678, 1.70710678, 0], [0, 0.70710678, 0.29289322]]
tolerance: 0.5e-8
"""
"""A pair of an explicit and an L-stable method of two stages."""
QUOTIENT = """
parameters: {c2: 0.66666667}
A: [[0, 0], ["1 - 1/(3*c2) + 0.49999999", 0]]
b: [0.5, "1/(3*c2)"]
tolerance: 1e-7
"""
EXACT_WEIGHTS = """
A: [[0, 0], [0.66666667, 0]]
b: [1/4, 3/4]
tolerance: 1e-8
"""
NOTHING_OPEN = """
A: [[0, 0], [0.5, 0]]
b: [1/4, 3/4]
tolerance: 1e-8
"""
"""The only condition of its order has no rounded number."""
TOGETHER = """
A: [[0, 0], [1, 0]]
b: [0.499985, 0.500000]
tolerance: 1e-5
"""
"""b₂ = 1/2 and b₁ + b₂ = 1 hold within 1e-5 each, and not together."""
DEPENDENT = """
A: [[0.25, -0.0386751346], [0.5386751346, 0.25]]
b: [0.5, 0.5]
tolerance: 1e-10
"""
"""Gauss 2: by simplifying conditions its 8 conditions are fewer, on 6 numbers."""


def certificate(text: str) -> dict[str, Any]:
    """The proof of a method file."""
    data = json.loads(REPORT.json([prove_method_exists(loads(text))]))
    assert isinstance(data, dict)
    return data


@pytest.mark.parametrize(
    ("text", "order"),
    [(ERK, 3), (TWO, 2), (QUOTIENT, 2), (EXACT_WEIGHTS, 2), (NOTHING_OPEN, 1), (TOGETHER, 1)],
)
def test_the_referee_agrees(
    text: str, order: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One colour with embedded weights, two colours, entries that are quotients of what is printed,
    conditions that hold exactly, an order that only a sum of conditions excludes.
    """
    data = certificate(text)
    assert judged(data, tmp_path) == 0
    assert data["method"]["order"] == order
    (line,) = capsys.readouterr().out.splitlines()[1:]
    count = len(data["method"]["conditions"])
    assert line.startswith(f"  method: order {order} of one within the radii, proved by {count} ")
    assert line.endswith(f"; order {order + 1} of none")


@pytest.mark.parametrize("name", ["kvaerno-3", "cash-4-2", "carpenter-kennedy-4", "ssp-53"])
def test_methods_of_the_catalogue(name: str, tmp_path: Path) -> None:
    """The order is that of ``gark check``, and the centre lies around the method that all its
    verdicts are about.
    """
    method = load(name)
    found = prove_method_exists(method)
    data = json.loads(REPORT.json([found]))
    assert judged(data, tmp_path) == 0
    rounded = as_meant(method)
    assert isinstance(rounded, RoundedTableau)
    order = garkcli.analyse(method).order.order
    assert (data["method"]["order"], found.order.order) == (order, order)
    box, shifts = rounded.search.box, rounded.search.settled.shifts
    moved = zip(box.numbers, box.radii, shifts, strict=True)
    meant = {x: x + t * shift for x, t, shift in moved}
    for x in found.numbers:
        near = meant[x.printed]
        assert isinstance(near, fmpq)
        assert abs(near - x.centre) <= x.width or not x.width
        assert x.width <= x.radius / 10**6


@in_whole
def test_trees_of_other_vertices(tmp_path: Path) -> None:
    """A rounded Rosenbrock method, whose second colour has one branch a vertex: without a tree, or
    without what its vertices are like, the proof is none.
    """
    method = load("ros34pw2")
    data = json.loads(REPORT.json([prove_method_exists(method)]))
    assert judged(data, tmp_path) == 0
    assert data["method"]["order"] == analyse_any(method).order.order == 3
    for key in ("vertices", "conditions"):
        forged = deepcopy(data)
        if key == "vertices":
            forged["method"]["colours"][1][key] = None
        else:
            forged["method"][key].pop()
        assert judged(forged, tmp_path) == 1


def test_such_a_method_exists() -> None:
    """Newton's method by hand, in plain fractions: near the centre c₂ and c₃ stay, the weights
    follow from three linear equations, a₃₂ from the last. All are within the radii, and the exact
    certificate says order 3.
    """
    a21, a31, a32, *_ = (Fraction(x["centre"]) for x in certificate(ERK)["numbers"])
    c2, c3 = a21, a31 + a32
    b2 = (c3 / 2 - Fraction(1, 3)) / (c2 * (c3 - c2))
    b3 = (Fraction(1, 3) - c2 / 2) / (c3 * (c3 - c2))
    a32 = 1 / (6 * b3 * c2)
    solved = [a21, c3 - a32, a32, 1 - b2 - b3, b2, b3]
    for x, number in zip(solved, certificate(ERK)["numbers"], strict=True):
        assert abs(x - Fraction(number["printed"])) <= Fraction(number["radius"])
        assert abs(x - Fraction(number["centre"])) <= Fraction(number["width"])
    exact = [fmpq(x.numerator, x.denominator) for x in solved]
    rows = [[fmpq(0)] * 3, [exact[0], fmpq(0), fmpq(0)], [*exact[1:3], fmpq(0)]]
    assert garkcli.find_order(from_arrays(rows, exact[3:])).order == 3


def test_what_is_not_in_the_method_is_left_out() -> None:
    """The embedded weights are no numbers of the proof, and numbers are short."""
    data = certificate(ERK)
    printed = [x["printed"] for x in data["numbers"]]
    assert printed == [
        *("0.47140452", "-0.37156701", "1.23759242"),
        *("0.17848614", "0.53583549", "0.28567837"),
    ]
    assert all(len(x["centre"]) < 24 for x in data["numbers"])
    assert all(len(a) < 9 for x in data["method"]["conditions"] for a in x["W"])


SILENT = {"name", "version", "linear", "schema"}
"""What claims nothing, but for the assumption that a colour is linear, which the referee says."""


def leaves(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Where a text, a number or a truth is."""
    if isinstance(data, (dict, list)):
        for key, value in data.items() if isinstance(data, dict) else enumerate(data):
            yield from leaves(value, (*path, key))
    elif data is not None and not any(x in SILENT for x in path):
        yield path


def forged(data: dict[str, Any], path: tuple[Any, ...]) -> dict[str, Any]:
    """The same with something else at a place: numbers are larger by 1, trees have a leaf more."""
    data = deepcopy(data)
    *holders, key = path
    holder: Any = data
    for x in holders:
        holder = holder[x]
    value = holder[key]
    if key in {"tree", "drives"}:
        holder[key] = f"[{value}]_1" if key == "tree" else "z"
    elif isinstance(value, str):
        holder[key] = str(Fraction(value) + 1) if key != "factor" else "0"
    else:
        holder[key] = value + 1
    return data


@in_whole
@pytest.mark.parametrize("text", [ERK, TWO], ids=["erk", "two"])
def test_a_forged_proof_is_found_out(text: str, tmp_path: Path) -> None:
    """Whatever single field is changed, the referee proves nothing: a printed number, a radius that
    the centre does not bear out, the place of an entry, the order, a tree, W, the witness.
    """
    data = certificate(text)
    for path in leaves(data):
        if path[-1] != "radius":
            assert judged(forged(data, path), tmp_path) != 0, path
    for k in range(len(data["numbers"])):
        # one larger radius is another claim, which is true where the witness has no such number
        small = deepcopy(data)
        small["numbers"][k]["radius"] = "0"
        assert judged(small, tmp_path) == 1


def test_larger_radii_are_another_claim(tmp_path: Path) -> None:
    """Among methods within 1 of the digits some have order 2."""
    data = certificate(TOGETHER)
    for x in data["numbers"]:
        x["radius"] = "1"
    assert judged(data, tmp_path) == 1


@pytest.mark.parametrize("key", ["numbers", "conditions", "witness"])
def test_nothing_can_be_left_out(key: str, tmp_path: Path) -> None:
    """A number, a condition, a term of the sum that excludes the next order."""
    data = certificate(TOGETHER)
    holder = data if key == "numbers" else data["method"]
    holder[key].pop()
    assert judged(data, tmp_path) != 0


def test_without_a_witness_the_order_is_a_lower_bound(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Then nothing is said of the next order."""
    data = certificate(ERK)
    data["method"]["witness"] = None
    assert judged(data, tmp_path) == 0
    assert "order 4" not in capsys.readouterr().out


def test_a_box_that_moves_nothing(tmp_path: Path) -> None:
    """Without a width no number moves, and a condition that is missed by anything may fail; a
    negative width is none.
    """
    for width in ("0", "-0.0000000001"):
        data = certificate(ERK)
        for x in data["numbers"]:
            x["width"] = width
        assert judged(data, tmp_path) == 1


@pytest.mark.parametrize("number", ENDLESS, ids=["power", "small", "below", "digits"])
def test_no_number_is_without_end(number: str, tmp_path: Path) -> None:
    """Numbers beyond the digits of a text are refused wherever they are."""
    data = certificate(EXACT_WEIGHTS)
    for path in leaves(data):
        *holders, key = path
        changed = deepcopy(data)
        holder: Any = changed
        for x in holders:
            holder = holder[x]
        holder[key] = number
        assert judged(changed, tmp_path) != 0, path


@pytest.mark.parametrize(
    "entry", [0, 9, "x", [], ["+", 1], ["^", 1, 1], ["/", 1, "0"], ["/", 1, ["-", 1, 1]], 1.5, None]
)
def test_what_is_no_entry_is_no_proof(entry: object, tmp_path: Path) -> None:
    """Numbers that are not printed, other signs, a division by what may be zero."""
    data = certificate(ERK)
    data["method"]["blocks"][0]["A"][1][0] = entry
    assert judged(data, tmp_path) in {1, 2}


def test_a_small_file_takes_no_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """The referee says which limit a proof is beyond: trees that are needed are counted no further
    than to the limit, as those listed are; an order without conditions has an end.
    """
    proof = certificate(EXACT_WEIGHTS)

    def refused(data: dict[str, Any], why: str) -> None:
        assert judged(data, tmp_path) == 2
        assert why in capsys.readouterr().out

    def with_order(order: int) -> dict[str, Any]:
        return {**proof, "method": {**proof["method"], "order": order}}

    refused(with_order(10**9), "1000000000 as order (limit 60)")
    refused(with_order(60), "2001 trees (limit 2000)")
    listed = proof["method"]["conditions"] * 1001
    many = {**proof, "method": {**proof["method"], "conditions": listed}}
    refused(many, "2003 trees (limit 2000)")
    refused({**proof, "name": "1" * 301}, "301 digits of a number (limit 300)")
    monkeypatch.setattr(REFEREE, "MOST_STEPS", 20)
    refused(proof, "21 steps (limit 20)")
    monkeypatch.setattr(REFEREE, "MOST_BYTES_ROUNDED", 500)
    refused(proof, "bytes (limit 500)")


def test_what_is_not_proved_is_refused(tmp_path: Path) -> None:
    """With the reason and the cure: conditions that depend on each other, radicals, no order;
    exact coefficients have another proof, also beside rounded embedded weights.
    """
    radical = "A: [[0, 0], [sqrt(2)/2, 0]]\nb: [0.29289322, 0.70710678]\ntolerance: 1e-8\n"
    for text, why in (
        (DEPENDENT, "its conditions depend on each other"),
        (radical, "an entry is made of irrational numbers"),
        ("A: [[0]]\nb: [0.9]\ntolerance: 1e-6\n", "there is no order to prove"),
    ):
        with pytest.raises(MethodError, match=why) as caught:
            prove_method_exists(loads(text))
        assert caught.value.code == "rounded"
        assert "--recognise" in str(caught.value)
    with pytest.raises(MethodError, match="are exact"):
        garkcli.prove_method_exists("rk4")
    embedded = "A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\nembedded: [0.99999999, 0]\ntolerance: 1e-8\n"
    with pytest.raises(MethodError, match="are exact"):
        prove_method_exists(loads(embedded))
    assert garkcli.prove_method(loads(embedded)).method.order.order == 2
    file = tmp_path / "rounded.gark.yaml"
    file.write_text(DEPENDENT)
    run = gark("certificate", str(file))
    assert (run.code, run.out) == (2, "")


@in_whole
def test_reports_tell_it(tmp_path: Path) -> None:
    """The answer for people, the conditions with -v; no file for Coq."""
    file = tmp_path / "rounded.gark.yaml"
    file.write_text(ERK)
    text = gark("certificate", str(file), "--format", "text", "-v").out
    assert text.startswith("three stages: order 3 within 5e-9: a method is proved to exist by 4 ")
    assert "no method within the tolerance has order 4: a condition excludes it" in " ".join(
        text.split()
    )
    assert "order 2     [[]]\n" in text
    assert json.loads(gark("certificate", str(file)).out) == json.loads(
        garkcli.certificate(load(file))
    )
    assert gark("certificate", str(file), "--format", "coq").code == 2
