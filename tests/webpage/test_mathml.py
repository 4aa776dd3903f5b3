"""Formulas as MathML: numbers can be read back exactly, and no text of a stranger becomes markup."""

from __future__ import annotations

from fractions import Fraction
from html import escape
from xml.etree.ElementTree import fromstring

from flint import arb
from hypothesis import given, settings, strategies

import garkcli
from garkcli.ntrees.notation import parse_tree
from garkcli.webpage.mathml import typeset, typeset_cell, typeset_condition, typeset_number
from tests.webpage.reading import number_of

FRACTIONS = strategies.fractions(max_denominator=10**6)
SQUARE_FREE = strategies.sampled_from([2, 3, 5, 6, 30])


@settings(max_examples=15, deadline=None)
@given(FRACTIONS, FRACTIONS, SQUARE_FREE)
def test_numbers_can_be_read_back(p: Fraction, q: Fraction, d: int) -> None:
    """P + q √d in MathML is that number again."""
    text = f"{p} + ({q})*sqrt({d})"
    number = garkcli.from_arrays([[text]], [1]).A[0][0]
    shown = number_of(fromstring(typeset_cell(number, 17)))
    again = garkcli.from_arrays([[shown]], [1]).A[0][0]
    assert str(again) == str(number)


def test_long_numbers_are_told_to_be_near() -> None:
    """A weight that is longer than a line is shown to eight digits, with the sign that says so; an
    enclosure as a decimal.
    """
    entry = f"{10**40 + 1}/{10**41 + 3}"
    long = garkcli.from_arrays([[entry]], [1]).A[0][0]
    shown = "".join(fromstring(typeset_number(long)).itertext())
    assert shown == "≈0.10000000"
    assert "1.5" in typeset_cell(arb("1.5"), 5)


def test_conditions_name_colours_where_there_are_some() -> None:
    """With colours each matrix has two and the transposed weights one; without, none has any."""
    several = fromstring(typeset_condition(parse_tree("[[]_2]_1"), True))
    assert "".join(several.itertext()) == "b{1}TA{1,2}𝟙{2}=12"
    one = fromstring(typeset_condition(parse_tree("[[]_1]_1"), False))
    assert "".join(one.itertext()) == "bTA𝟙=12"


def test_formulas_are_no_markup() -> None:
    """What is no formula is shown as text: the converter would hand it through."""
    hostile = r"\frac{1}{2}<script>alert(1)</script>"
    assert typeset(hostile) == f"<math><mtext>{escape(hostile)}</mtext></math>"
