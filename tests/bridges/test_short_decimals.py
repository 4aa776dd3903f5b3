"""Tables of four or five decimal places: what their rounding explains is no error."""

from __future__ import annotations

import pytest

from garkcli import loads
from garkcli.bridges.audit import Audited, audit
from garkcli.bridges.claiming import imported
from garkcli.exact.display import decimal
from garkcli.methodfile.load import loads as load_file
from garkcli.sources.languages import python

KUTTA_38 = """
A = [[0, 0, 0, 0], [0.3333, 0, 0, 0], [-0.3333, 1, 0, 0], [1, -1, 1, 0]]
b = [0.125, 0.375, 0.375, 0.125]
c = [0, 0.3333, 0.6667, 1]
order = 4
"""
RK4 = """
A = [[0, 0, 0, 0], [0.5, 0, 0, 0], [0, 0.5, 0, 0], [0, 0, 1, 0]]
b = [0.1667, 0.3333, 0.3333, 0.1667]
c = [0, 0.5, 0.5, 1]
order = 4
"""
FIVE = KUTTA_38.replace("0.3333", "0.33333").replace("0.6667", "0.66667")


def audited(text: str) -> Audited:
    (table,) = python.find(text, "x.py")
    found = audit(table)
    assert found is not None
    return found


@pytest.mark.parametrize(("text", "places"), [(KUTTA_38, 4), (RK4, 4), (FIVE, 5)])
@pytest.mark.parametrize("is_declared", [True, False])
def test_the_order_holds_within_the_last_place(text: str, places: int, is_declared: bool) -> None:
    """The note says how wide, and `gark check` finds the order of the printed numbers within that,
    and no order within a tenth of it.
    """
    found = audited(text if is_declared else text.replace("order = 4", ""))
    assert found.order is not None
    assert found.order.order == 4
    (note,) = found.findings
    assert (note.code, note.level) == ("rounded", "note")
    assert f"{places} decimal places: order 4 holds within 1e-{places}" in note.message
    rows = dict(line.split(" = ") for line in text.strip().splitlines())
    file = "".join(f"{x}: {rows[x]}\n" for x in "Abc")
    assert loads(f"{file}tolerance: 1e-{places}\n").order == 4
    assert loads(f"{file}tolerance: 1e-{places + 1}\n").order < 4


def test_zeros_before_few_digits_are_no_further_digits() -> None:
    """0.062502 beside numbers of five places has five digits."""
    text = FIVE.replace("0.125, 0.375, 0.375", "0.062502, 0.37500, 0.4375")
    found = audited(text.replace("order = 4", ""))
    assert {x.level for x in found.findings} <= {"note"}


def test_the_file_has_the_tolerance() -> None:
    (table,) = python.find(RK4, "x.py")
    method = imported(table, "rk4")
    assert method.tolerance is not None
    assert decimal(method.tolerance) == "1e-4"
    assert load_file(method.text, "x").tolerance == method.tolerance


WRONG = {
    "two units of the last place": ("0.3333, 0.3333", "0.3333, 0.3335", "order"),
    "a digit": ("0.1667]", "0.1767]", "order"),
    "an entry": ("[0, 0.5, 0, 0]", "[0, 0.6, 0, 0]", "order"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_the_last_place_does_not_explain_is_an_error(name: str) -> None:
    before, after, code = WRONG[name]
    assert RK4.count(before) == 1
    found = audited(RK4.replace(before, after))
    errors = [x for x in found.findings if x.level == "error"]
    assert [x.code for x in errors] == [code]


def test_a_longer_number_makes_the_others_exact() -> None:
    """Beside 0.16666667 the number 0.3333 is what the program computes with."""
    found = audited(RK4.replace("[0.1667", "[0.16666667"))
    assert {(x.code, x.level) for x in found.findings} >= {("order", "error")}


def test_three_places_are_exact() -> None:
    """Eighths have three places: 0.626 is no rounded 0.625."""
    text = "A = [[0, 0, 0], [0.375, 0, 0], [0.125, {}, 0]]\nb = [0.125, 0.375, 0.5]\n"
    text += "c = [0, 0.375, 0.75]\n"
    assert [x.code for x in audited(text.format("0.625")).findings] == []
    assert [x.code for x in audited(text.format("0.626")).findings] == ["nodes"]


def test_fractions_are_exact() -> None:
    """1/3 is no decimal: nothing of the table looks rounded."""
    found = audited(KUTTA_38.replace("0, 0.3333, 0.6667", "0, 1/3, 2/3"))
    assert any(x.level == "error" for x in found.findings)
