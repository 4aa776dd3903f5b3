"""Letters for roots of cubics: in texts, LaTeX, pages and files, defined once and read again."""

from __future__ import annotations

import json
import re

import pytest

from garkcli.bridges.preparing import prepared
from garkcli.bridges.readers.latex_numbers import without_letters
from garkcli.bridges.registry import bridges
from garkcli.exact.expression import parse
from garkcli.exact.letters import Letters, lettered
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.exact.rewriting import format_expression
from garkcli.methodfile.load import load, loads
from garkcli.methodfile.writer import write_method
from garkcli.page.look import Look
from garkcli.report.notebook import method_html, method_latex
from garkcli.tell.dialect import Plain
from garkcli.webpage.page import report_page
from tests.cli.harness import gark

GAMMA = "root_of(6*x**3-18*x**2+9*x-1, 0.4358665215)"
DEFINED = f"γ = {GAMMA} = 0.435866521508…"
ZERO = r"6\gamma ^{3}-18\gamma ^{2}+9\gamma -1 = 0, \quad \gamma \approx 0.435866521508"
CUBICS = ["ars-343", "norsett-3", "alexander-3", "least-error-gauss2-lobatto3"]


@pytest.mark.parametrize(
    "command",
    [
        *("tableau ars-343", "show ars-343", "tableau ars-343 --format latex"),
        *("stability alexander-3", "check alexander-3 -v --format latex"),
    ],
)
def test_a_root_is_written_once(command: str) -> None:
    """In texts and in LaTeX it is defined, and then its letter."""
    text = gark(*command.split()).out
    assert text.count(ZERO if "latex" in command else DEFINED) == 1
    assert text.replace(DEFINED, "").count("root_of") == 0
    assert "operatorname{root}" not in text
    assert text.count("gamma" if "latex" in command else "γ") > 5


def test_tables_fit_the_terminal() -> None:
    """Of 80 columns and of 60, in ASCII too; entries that are too long for a line are decimals, exact
    with -v and in JSON.
    """
    for name in CUBICS:
        assert max(map(len, gark("tableau", name).out.splitlines())) <= 80
        for encoding in ("ascii", "utf-8"):
            narrow = gark("tableau", name, encoding=encoding, COLUMNS="60").out
            assert max(map(len, narrow.splitlines())) <= 60
    text = gark("tableau", "ars-343").out
    assert "    -1.426515695375 + 4.7060627815*γ - 1.597121973525*γ**2\n" in text
    short = gark("tableau", "ars-343", COLUMNS="48").out
    assert "    0.32127888627204225  0.39665437448218725\n" in short
    assert "\nentries of more than 44 signs as decimals: exact\n  with -v\n" in short
    assert "signs as decimals" not in gark("tableau", "ars-343", "-v", COLUMNS="48").out
    data = json.loads(gark("tableau", "ars-343", "--format", "json").out)
    assert data["A"][0][0][2][0].startswith(f"-11412125563/8000000000 + 9412125563*{GAMMA}/")


def test_exact_coefficients_in_decimals_are_the_same_number() -> None:
    """The text of an entry is that entry."""
    entry = load("ars-343").tableau.blocks[0, 0][2][0]
    shown = f"-1.426515695375 + 4.7060627815*{GAMMA} - 1.597121973525*{GAMMA}**2"
    assert loads(f'{{A: [["{shown}"]], b: [1]}}').tableau.blocks[0, 0][0][0] == entry


def test_a_root_that_is_no_diagonal_is_another_letter() -> None:
    """γ is the entry on the diagonal of A, and nothing else."""
    assert "ξ = root_of(790*x**3-" in gark("tableau", "least-error-gauss2-lobatto3").out
    assert "ξ = root_of(6*x**3" in gark("conjugate", "alexander-3").out


def test_letters_that_a_check_has_for_conditions_are_no_roots() -> None:
    """η, ξ and ζ are numbers of simplifying assumptions there; γ has its value, not its letter."""
    root = '"root_of(x^3 - x - 1, 1.32)"'
    text = f"A: [[{GAMMA!r}, 0], [{root}, 1/2]]\nb: [1/2, 1/2]\n"
    found = gark("check", "-", "--format", "latex", "-v", stdin=text).out
    assert r"6\kappa ^{3}-18\kappa ^{2}+9\kappa -1 = 0" in found
    assert r"\mu ^{3}-\mu -1 = 0" in found
    assert r"\frac{\kappa }{2}+\frac{\mu }{2}" in found
    shown = gark("check", "alexander-3", "-v", "--format", "latex").out
    assert "$\\gamma$ & about 0.43586652" in shown
    assert "γ γ" not in gark("check", "alexander-3", "--format", "markdown").out


def test_a_report_without_the_root_does_not_define_it() -> None:
    """The lines on ARS(3,4,3) are decimals."""
    assert "γ" not in gark("stability", "ars-343").out


@pytest.mark.parametrize("name", CUBICS)
def test_files_name_roots_and_are_read_again(name: str) -> None:
    """A spelled-out file has the root as a parameter, and the same entries."""
    text = gark("convert", name, "--to", "spelled-out").out
    assert text.count("root_of") == 1
    assert (
        gark("diff", "-", name, stdin=text).out.splitlines()[0].endswith("every entry is the same")
    )


def test_latex_is_read_again() -> None:
    """The letter is taken from its definition."""
    method = load("ars-343")
    text = bridges()["latex"].written(prepared(method))
    assert text.count(rf"\[ {ZERO} \]") == 1
    assert "operatorname{root}" not in text
    plain = without_letters(text)
    assert plain.count(r"\operatorname{root}(6x^{3}-18x^{2}+9x-1,x\approx0.435866521508)") > 20
    assert r"\gamma" not in plain


def test_pages_and_notebooks_define_it_too() -> None:
    page = report_page("alexander-3", pictures=False)
    assert page.count("root_of") == 1
    assert f'alttext="{DEFINED}"' in page
    method = load("alexander-3")
    assert (method_latex(method) or "").startswith(rf"\[ {ZERO} \]")
    assert f"<p>{DEFINED}</p>" in method_html(method)


def test_letters_end_with_the_text() -> None:
    """Seven roots have six letters, each for one root; outside they are written out."""
    roots = [parse(f"root_of(x^3 - {k}, 1.5)") for k in (2, 3, 5, 6, 7, 9, 10)]
    first = roots[0]
    assert isinstance(first, AlgebraicRoot)
    with lettered(Letters(first)):
        texts = [format_expression(root) for root in [*roots, *roots]]
    assert texts[:6] == texts[7:13] == ["γ", "ξ", "η", "ζ", "κ", "μ"]
    assert re.fullmatch(r"root_of\(x\*\*3-10, .*\)", texts[6])
    assert format_expression(first).startswith("root_of")


@pytest.mark.parametrize("encoding", ["ascii", "utf-8"])
def test_letters_are_words_of_a_text(encoding: str) -> None:
    """In ASCII ξ is xi, which is no part of "axis"; η is eta, no part of beta."""
    letters = Letters()
    with lettered(letters):
        for k in (2, 3):
            format_expression(parse(f"root_of(x^3 - {k}, 1.5)"))
    d = Plain(look=Look(encoding=encoding))
    assert len(letters.of) == 2
    assert [*d.definitions(letters.of, "real axis, beta")] == []
    first = d.spelt("2 ξ + 1")
    assert len([*d.definitions(letters.of, first)]) == 1


def test_rounded_files_have_no_letters() -> None:
    assert "parameters" not in write_method(load("rk4").tableau, "rk4", None)
