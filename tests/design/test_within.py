"""``gark design`` where known numbers are rounded: values of one method within the tolerance."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from flint import fmpq

from garkcli import find_parameters, found_methods, load, minimise, search_methods, stable_values
from garkcli.design.within import DesignWithin, ValuesWithin, with_more
from garkcli.errors import MethodError
from garkcli.exact.display import to_ball, to_float
from garkcli.exact.field import Number
from garkcli.exact.rounding import in_decimals
from garkcli.methodfile.family import loads_family
from tests.cli.harness import gark
from tests.whole import in_whole, sample

SDIRK = """tolerance: 1e-10
A:
  - [0.4358665215, 0, 0]
  - [0.2820667392, 0.4358665215, 0]
  - [1.2084966491, -0.6443631706, 0.4358665215]
b: [1.2084966491, -0.6443631706, 0.4358665215]
embedded: ["?", "?", "?"]
design: {order: 3, embedded-order: 2}
"""
HEUN = """tolerance: 1e-8
A: [[0, 0], [0.66666667, 0]]
"""


def within(text: str) -> DesignWithin:
    """What is found for a file with rounded numbers."""
    found = find_parameters(loads_family(text))
    assert isinstance(found, DesignWithin)
    return found


def only(found: DesignWithin) -> ValuesWithin:
    """The one solution of the highest order."""
    assert found.best is not None
    [values] = found.best.found
    return values


def decimals(row: tuple[Number, ...], digits: int) -> str:
    """A row, rounded to so many decimal places; zeros are exact."""
    balls = (to_ball(x, digits + 10) if x else None for x in row)
    return ", ".join("0" if x is None else in_decimals(x.mid().fmpq(), digits) for x in balls)


def test_embedded_weights_of_a_rounded_method_are_a_line() -> None:
    """Three weights with two conditions, Σ bh = 1 and Σ bh c = 1/2: the printed digits of A and b
    miss conditions of their own, and leave no value; one method within the tolerance leaves a line.
    """
    found = within(SDIRK)
    values = only(found)
    assert found.best is not None
    assert (found.best.order, found.best.printed, values.dimension, values.embedded) == (
        3,
        -1,
        1,
        2,
    )
    assert 0 < values.distance <= 1
    assert values.digits == 43
    bh = [to_float(x) for x in values.values.values()]
    assert abs(sum(values.values.values()) - 1) < fmpq(1, 10**43)
    c = (0.4358665215, 0.7179332607, 1.0)
    assert sum(bh) == pytest.approx(1, abs=1e-14)
    assert sum(x * y for x, y in zip(bh, c, strict=True)) == pytest.approx(0.5, abs=1e-9)
    [free] = values.free
    moves = {free: 1.0, **{k: to_float(x[free]) for k, x in values.directions.items()}}
    assert sum(moves.values()) == pytest.approx(0, abs=1e-14)
    assert sum(moves[k] * y for k, y in zip(values.values, c, strict=True)) == pytest.approx(
        0, abs=1e-9
    )


NAMES = ("esdirk-324", "kvaerno-3", "kvaerno-4", "sdirk-4", "cash-4-3")


@pytest.mark.parametrize("name", sample(NAMES, 3))
@pytest.mark.parametrize("digits", [6, 12])
def test_embedded_rows_of_the_catalogue_are_found_again(name: str, digits: int) -> None:
    """The embedded row of a method, rounded and taken away, is among the values: with free weights
    as published, the others are as published, up to rounding. The dimension is that of the exact
    method.
    """
    method = load(name)
    tableau = method.tableau
    b, published = tableau.colours[0].b, method.embedded
    assert published is not None
    orders = {claim.key: claim.value for claim in method.claims}
    rows = "\n".join(f"  - [{decimals(row, digits)}]" for row in tableau.block(0, 0) or ())
    unknown = ", ".join(['"?"'] * len(b))
    wants = f"{{order: {orders['order']}, embedded-order: {orders['embedded-order']}}}"
    text = (
        f"tolerance: 1e-{digits}\nA:\n{rows}\nb: [{decimals(b, digits)}]\n"
        f"embedded: [{unknown}]\ndesign: {wants}\n"
    )
    values = only(within(text))
    assert values.embedded == orders["embedded-order"]
    row = [to_float(x) for x in published[0]]
    weights = dict(zip(values.values, row, strict=True))
    for unknown_weight, slopes in values.directions.items():
        moved = sum(
            to_float(a) * (weights[k] - to_float(values.values[k])) for k, a in slopes.items()
        )
        expected = to_float(values.values[unknown_weight]) + moved
        assert weights[unknown_weight] == pytest.approx(expected, abs=2000 * 10.0**-digits)


def test_weights_at_rounded_gauss_nodes_have_order_4_and_not_5() -> None:
    """Nodes and weights move together: with the nodes as printed, order 4 has no weights."""
    text = """tolerance: 1e-8
A: [[0.25000000, -0.03867513], [0.53867513, 0.25000000]]
b: ["?", "?"]
"""
    found = within(text)
    values = only(found)
    assert [to_float(x) for x in values.values.values()] == pytest.approx([0.5, 0.5], abs=1e-14)
    assert (found.reaches(4), found.reaches(5)) == (True, None)
    assert found.best is not None
    assert found.best.printed == -1


@in_whole
def test_unknowns_that_are_not_linear_are_found_numerically() -> None:
    """Two entries of a Gauss method: both orders of its stages, and no other."""
    text = """tolerance: 1e-8
A: [[0.25000000, "?"], ["?", 0.25000000]]
b: [0.50000000, 0.50000000]
c: [0.21132487, 0.78867513]
design: {order: 4}
"""
    found = within(text)
    assert found.best is not None
    assert not found.best.is_linear
    root = 3**0.5 / 6
    for values in found.best.found:
        pair = sorted(to_float(x) for x in values.values.values())
        assert pair == pytest.approx([0.25 - root, 0.25 + root], abs=1e-12)
    assert "by Newton's method from 100 starts" in " ".join(
        gark("design", "-", stdin=text).out.split()
    )


def test_known_numbers_that_fail_for_certain_are_proved_to_fail(tmp_path: Path) -> None:
    """Order 2 asks for b c = 1/2: 0.2667 by known numbers alone is no rounding of it."""
    file = tmp_path / "heun.yaml"
    text = HEUN + 'b: [0.60000000, 0.40000000]\nembedded: ["?", "?"]\ndesign: {order: 2}\n'
    file.write_text(text, encoding="utf-8")
    found = within(text)
    assert found.reaches(2) is False
    answer = gark("design", str(file))
    assert answer.code == 1
    assert "the condition of [[]] concerns known numbers alone" in " ".join(answer.out.split())


def test_ranges_hold_for_values_within() -> None:
    """b₂ = 3/4 alone has order 2, to the digits that 2/3 has: outside of a range it does not count,
    and no verdict is about other values.
    """
    free = "parameters: {{t: {{free: true, range: [{}]}}}}\nb: [1 - t, t]\ndesign: {{order: 2}}\n"
    inside, outside = within(HEUN + free.format("1/2, 1")), within(HEUN + free.format("0.1, 0.3"))
    assert to_float(only(inside).values["t"]) == pytest.approx(0.75, abs=1e-8)
    assert (inside.reaches(2), outside.reaches(2)) == (True, None)


@in_whole
def test_the_file_that_is_written_passes_the_check(tmp_path: Path) -> None:
    """--emit writes decimals and claims, which ``gark check`` confirms within the tolerance."""
    file, made = tmp_path / "sdirk.yaml", tmp_path / "made.gark.yaml"
    file.write_text(SDIRK, encoding="utf-8")
    assert gark("design", str(file), "--emit", str(made), "-q").code == 0
    checked = gark("check", str(made))
    assert checked.code == 0, checked.out
    assert "order: 3, embedded-order: 2" in checked.out
    [method] = found_methods(within(SDIRK))
    assert method.tolerance == fmpq(1, 10**10)


def test_what_needs_exact_numbers_says_so(tmp_path: Path) -> None:
    """A minimum, a search, stable values and what holds for every value would rest on last digits:
    they are refused, in Python too, with what helps.
    """
    file = tmp_path / "sdirk.yaml"
    file.write_text(SDIRK, encoding="utf-8")
    options = (["--minimise", "error"], ["--search", "4"], ["--a-stable"], ["--choose", "bh1=0"])
    runs = [gark("design", str(file), *option) for option in options]
    runs += [gark(command, str(file)) for command in ("check", "stability", "conditions")]
    for run in runs:
        assert run.code == 2
        assert "rounded" in run.err + run.out
        assert "gark design" in run.err + run.out
    family = loads_family(SDIRK)
    for call in (
        lambda: minimise(family, "error"),
        lambda: search_methods(family, 3),
        lambda: stable_values(family, "a-stable"),
    ):
        with pytest.raises(MethodError, match="rounded"):
            call()


def test_data_have_values_and_directions(tmp_path: Path) -> None:
    """JSON has what the text says: decimals, never floats."""
    file = tmp_path / "sdirk.yaml"
    file.write_text(SDIRK, encoding="utf-8")
    data = json.loads(gark("design", str(file), "--format", "json").out)
    [step] = data["orders"]
    [solution] = step["solutions"]
    assert (data["schema"], data["tolerance"]) == ("gark/design-within/1", "1e-10")
    assert (step["printed_dimension"], solution["dimension"]) == (-1, 1)
    assert all(isinstance(x, str) for x in solution["values"].values())


def test_a_tolerance_without_rounded_numbers_changes_nothing() -> None:
    """Where every entry is unknown no number is rounded, and the answer is exact."""
    text = 'A: [[0, 0], ["?", 0]]\nb: ["?", "?"]\ndesign: {order: 2}\n'
    exact, rounded = (find_parameters(loads_family(x)) for x in (text, f"{text}tolerance: 1e-9\n"))
    assert [x.ideal.polynomials for x in exact.steps] == [
        x.ideal.polynomials for x in rounded.steps
    ]


def test_equal_digits_prove_nothing_where_rounding_lets_unknowns_matter() -> None:
    """As printed b c = 0.4 for every t, as both nodes are 0.4. They may differ by rounding, and a
    large t makes more of it: order 2 is not decided, where one node twice proves that it fails.
    """
    text = "tolerance: 1e-8\nparameters: {t: free}\nb: [1 - t, t]\ndesign: {order: 2}\n"
    apart = within(f"{text}A: [[0.40000000, 0], [0, 0.400000000]]\n")
    same = within(
        f"{text}parameters: {{t: free, c: 0.40000000}}\nA: [[c, 0], [0, c]]\n".replace(
            "parameters: {t: free}\n", ""
        )
    )
    assert (apart.reaches(2), same.reaches(2)) == (None, False)


A_PRODUCT_OF_DIFFERENCES = """tolerance: 1e-6
A: [[0, 0, 0], ["?", 0, 0], [0.4, 0, 0]]
b: [0.7, {}, 0.3]
design: {{order: 2}}
"""


@pytest.mark.parametrize(
    "weight",
    ["(0.5 - 0.5)*(0.25 - 0.25)", "0.5 - 0.50", "sqrt(0.25) - 0.5", "0.5*sqrt(2) - sqrt(0.5)"],
)
def test_a_weight_that_rounding_alone_makes_zero_proves_nothing(weight: str) -> None:
    """As printed the unknown a₂₁ is in no condition of order 2. But b₂ may be 1e-12, and a₂₁ 4e11;
    a weight of 0 proves that order 2 fails.
    """
    found = within(A_PRODUCT_OF_DIFFERENCES.format(weight))
    assert found.reaches(2) is None
    assert within(A_PRODUCT_OF_DIFFERENCES.format(0)).reaches(2) is False


def test_where_stages_are_joined_nothing_is_decided() -> None:
    """As printed the last stage is the first of the next step; with other last digits it is not,
    and no number of the method made is one of the file.
    """
    text = """tolerance: 1e-6
parameters: {t: free}
compose: {of: {A: [[0, 0, 0], [t, 0, 0], [0.2, 0.8, 0]], b: [0.2, 0.8, 0]}, steps: [1/2, 1/2]}
design: {order: 2}
"""
    assert within(text).reaches(2) is None
    # b c = 0.32 ≠ 1/2 without the unknown proves nothing of it either
    other = "[[0, 0, 0, 0], [0.4, 0, 0, 0], [t, 0, 0, 0], [0.2, 0.8, 0, 0]], b: [0.2, 0.8, 0, 0]"
    known = text.replace("[[0, 0, 0], [t, 0, 0], [0.2, 0.8, 0]], b: [0.2, 0.8, 0]", other)
    assert known != text
    assert within(known).reaches(2) is None


def values_at(t: int, is_admitted: bool, free: tuple[str, ...] = ()) -> ValuesWithin:
    """One solution, or an example of a family."""
    return ValuesWithin(
        values={"t": fmpq(t)},
        directions={},
        free=free,
        distance=0.0,
        is_admitted=is_admitted,
        digits=40,
        order=2,
    )


def test_a_family_is_kept_in_place_of_single_solutions() -> None:
    """Whichever is found first; what is admitted goes before, be it a family or not."""
    lone, again, other = values_at(1, True), values_at(1, True), values_at(2, True)
    family = values_at(3, True, ("t",))
    outside, wide = values_at(4, False), values_at(5, False, ("t",))

    def kept(*values: ValuesWithin) -> list[ValuesWithin]:
        found: list[ValuesWithin] = []
        for x in values:
            found = with_more(found, x)
        return found

    assert kept(lone, again, other) == [lone, other]
    assert kept(lone, family) == kept(family, lone) == kept(lone, other, family) == [family]
    assert kept(outside, wide) == kept(wide, outside) == [wide]
    assert kept(wide, lone) == kept(lone, wide) == [lone]
    assert kept(wide, family) == kept(outside, lone, wide, family) == [family]


def test_values_at_which_embedded_weights_divide_by_zero_are_no_method() -> None:
    """Order 2 asks for x = 1/2, where b̂ = (1/(x − 1/2), 1) is none: order 1 is the highest."""
    text = "tolerance: 1e-8\nparameters: {x: free}\nA: [[0, 0], [1.0, 0]]\nb: [1 - x, x]\n"
    assert only(within(text)).order == 2
    found = within(f'{text}embedded: ["1/(x - 1/2)", 1]\n')
    assert (found.reaches(1), found.reaches(2)) == (True, None)
