"""Text from strangers in reports: no command, no formula, no turned direction of writing."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from garkcli.check.outcome import Outcome
from garkcli.errors import Remark, printable
from garkcli.page.look import Look
from garkcli.page.safety import csv_cell, inert
from garkcli.report import check_findings, check_text
from garkcli.report.check_formats import FORMATS

TURNED = "a\N{RIGHT-TO-LEFT OVERRIDE}b\x1b[2J\x9b1m"
"""A name that turns text, clears a terminal, and colours it by a control character of one byte."""


@given(st.text())
def test_printable_text_is_one_line_without_controls(text: str) -> None:
    """Nothing is left that a terminal acts on, and plain text stays as it is."""
    shown = printable(text)
    assert shown.isprintable()
    assert printable(shown) == shown
    assert len(shown.splitlines()) <= 1


@given(st.lists(st.sampled_from([" ", ":", "::", "#", "[", "error", "\n", "\t", "\xa0", "x"])))
def test_no_line_is_a_workflow_command(parts: list[str]) -> None:
    """However a line is made, after blanks it does not begin with two colons, nor has ##[ in it."""
    shown = inert("".join(parts))
    assert not any(line.strip().startswith("::") for line in shown.split("\n"))
    assert "##[" not in shown


@pytest.mark.parametrize("text", ["=1+1", "+cmd", "-cmd|x", "@sum", "\tx", "\rx"])
def test_no_cell_is_a_formula(text: str) -> None:
    """A spreadsheet takes the cell for text; numbers with a sign stay numbers."""
    assert csv_cell(text) == f"'{text}"
    assert csv_cell("-1/2x") == "'-1/2x"
    assert csv_cell("-2.5e-16") == "-2.5e-16"


def test_every_format_writes_faults_without_controls() -> None:
    """The name of the file, the line that is shown, the message and its cure."""
    fault = Remark(f"no {TURNED}", f"not {TURNED}", 1, 2)
    outcome = Outcome(f"::error::{TURNED}", "m", faults=(fault,), text=f"x{TURNED}")
    texts = [
        check_text.render([outcome], Look()),
        check_findings.github([outcome]),
        FORMATS["markdown"]([outcome], Look(), 0, None, 80),
        check_findings.junit([outcome]),
        check_findings.sarif([outcome]),
    ]
    for text in texts:
        assert all(x.isprintable() or x == "\n" for x in text)
    assert not texts[0].lstrip().startswith("::")


def test_the_caret_stands_under_the_text_as_it_is_shown() -> None:
    """What is written out before the column moves the caret."""
    outcome = Outcome("f", "f", faults=(Remark("wrong", "", 1, 3),), text="a\x1bb")
    _, line, caret = check_text.render([outcome], Look()).splitlines()
    assert line.index("b", line.index("x1b") + 3) == caret.index("^")
