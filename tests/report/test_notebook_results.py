"""What notebooks show of runs, of reports and of formulas: well-formed, escaped, as commands say."""

from __future__ import annotations

from html import unescape
from xml.etree import ElementTree as ET

import pytest

import garkcli
from garkcli import loads_problem
from tests.cli.harness import gark
from tests.report.test_notebook import cells
from tests.whole import in_whole

FAMILY = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1 - 1/(2*t), 1/(2*t)]"
VERLET = "methods/stoermer-verlet.gark.yaml"
HOSTILE = """\
name: "<script>alert(1)</script>"
variables: [x]
hamiltonian: px**2/2 - cos(x)
initial: {x: 1, px: 0}
"""


def pictures(html: str) -> list[str]:
    """The titles of the pictures in it."""
    root = ET.fromstring(f"<div>{html}</div>")
    titles = [svg.findtext("title") for svg in root.iter("svg")]
    return [title for title in titles if title is not None]


@in_whole
def test_a_convergence_test_is_a_table_and_a_picture() -> None:
    """A row a step size, the verdict, and the errors drawn; without an error no picture."""
    found = garkcli.converge("rk4", "pendulum", steps=[0.5, 0.25, 0.125])
    html = found._repr_html_()
    *_, heads, coarse, _, fine = cells(html)
    assert heads == ["h", "error", "slope", "energy error", "digits"]
    assert (coarse[0], coarse[2], fine[0]) == (r"\(\frac{1}{2}\)", "", r"\(\frac{1}{8}\)")
    assert float(fine[2]) == pytest.approx(found.rows[2].slope, abs=1e-3)
    assert "observed, at least 4 visible: " in html
    assert pictures(html) == ["Convergence"]
    exact = "{variables: [x], hamiltonian: px**2/2, initial: {x: 0, px: 1}}"
    still = garkcli.converge("rk4", loads_problem(exact), 1, [0.5, 0.25])
    assert pictures(still._repr_html_()) == []


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("ros3p", "index 1, 0 = g(y, z)"),
        ("mri-gark-erk33a", "slow method"),
        ("rk4", "pair"),
        ("fine-34", "order of q"),
        ("imex-nprk-42a", "pairs of stages"),
        ("tdrk-5", "2 derivatives, 3 stages"),
    ],
)
def test_an_analysis_of_every_kind_is_shown(name: str, said: str) -> None:
    """The headline of the check and its rows, well-formed."""
    html = garkcli.analyse(name)._repr_html_()
    ET.fromstring(html)
    assert "proved; order " in html
    assert said in html


def test_a_long_run_is_a_table_and_a_picture() -> None:
    """A row an invariant; what is exactly conserved has no picture."""
    run = garkcli.long_run(VERLET, "pendulum", 50, "1/10")
    html = run._repr_html_()
    (*_, heads, row) = cells(html)
    assert heads == ["", "at the start", "largest error", "oscillation", "drift"]
    assert row[0] == "energy"
    assert 'energy <span class="good">bounded</span>' in html
    assert pictures(run._repr_html_()) == ["Energy error over a long time"]
    still = garkcli.long_run("gauss-2", "oscillator", 10)._repr_html_()
    assert '<span class="good">conserved</span> by every step, exactly' in still
    assert pictures(still) == []


@in_whole
def test_names_of_files_are_text() -> None:
    """A problem cannot bring markup of its own."""
    problem = loads_problem(HOSTILE)
    run = garkcli.long_run("rk4", problem, 2, "1/4")
    found = garkcli.converge("rk4", problem, 1, [0.5, 0.25])
    formula = garkcli.modified_run(VERLET, problem, 2, longest=0.5)
    for value in (run, found, formula):
        html = value._repr_html_()
        ET.fromstring(f"<div>{html}</div>")
        assert "<script" not in html
        assert "alert(1)" in html


def test_a_modified_equation_has_the_rows_of_its_command() -> None:
    """The answer above, and a row a term."""
    html = garkcli.backward_analysis(VERLET, 4)._repr_html_()
    assert "order 2; symplectic; energy order 2; effective order 2" in html
    *_, head, _, _, _, last = cells(html)
    assert head == ["power", "tree", "symmetry", "coefficient", "factor"]
    assert last[1:3] == ["[[]_1,[]_1]_2", "2"]


def test_stability_has_the_rows_of_its_command() -> None:
    """Each label of the text is one of the table, in its order; the answer is above."""
    html = garkcli.find_stability("rk4")._repr_html_()
    answer, *rows = gark("stability", "rk4").out.splitlines()
    assert answer.removeprefix("rk4: ") in html
    labels = [row[0] for row in cells(html)]
    assert len(labels) > 5
    begun = [line[2:] for line in rows if line[2:3].strip()]
    assert len(begun) == len(labels)
    assert all(line.startswith(label) for line, label in zip(begun, labels, strict=True))
    assert dict(cells(html))["imaginary axis"] == r"|y| ≤ 2.82842712475, y² ≤ \(8\)"


def test_a_comparison_has_the_rows_of_its_command() -> None:
    """The answer is above, and each label of the text is in a table."""
    html = garkcli.compare("rk4", "heun")._repr_html_()
    answer, *rows = gark("diff", "rk4", "heun").out.splitlines()
    assert answer.partition(": ")[2] in "".join(ET.fromstring(html).itertext())
    labels = {row[0] for row in cells(html)}
    begun = {line[2:].partition("  ")[0] for line in rows if line[2:3].strip()}
    assert begun == labels - {""}


def test_open_ends_of_intervals_are_no_markup() -> None:
    """The signs of ``0 ≤ x < 8`` are text in a page that is well-formed."""
    html = garkcli.find_stability("methods/rectangular.gark.yaml")._repr_html_()
    text = "".join(ET.fromstring(html).itertext())
    assert "oscillator stable, x = (hω)²: 0 ≤ x < 8, " in text.replace("\\(", "").replace("\\)", "")


def test_a_design_says_what_was_found() -> None:
    """For which values, and the least one."""
    family = garkcli.loads_family(FAMILY)
    design = garkcli.find_parameters(family)
    shown = dict(cells(design._repr_html_()))
    assert shown["order 1 to 2"] == r"every value where \(t\) ≠ 0"
    html = garkcli.minimise(design, "error")._repr_html_()
    assert r"\(t\) = \(\frac{2}{3}\): order 2 of the method, proved" in html


def test_a_witness_is_its_tree_and_its_condition() -> None:
    """Drawn, with the weight and what it should be; so is a condition."""
    witness = garkcli.find_order("rk4").witness
    assert witness is not None
    html = witness._repr_html_()
    ET.fromstring(f"<div>{html}</div>")
    assert "<svg" in html
    assert "[[[[[]]]]]: 0 instead of 1/120, off by -1/120" in html
    order = garkcli.find_order("rk4")._repr_html_()
    assert order.endswith(html)
    assert order.startswith("<p>order 4, proved; order 5 fails at <code>[[[[[]]]]]</code> by ")
    limited = garkcli.find_order("rk4", limit=3)._repr_html_()
    assert limited == "<p>order at least 3; the search stopped here</p>"
    holding, failing = (next(garkcli.conditions(x, "[[[]]]")) for x in ("rk4", "heun"))
    assert "[[[]]]: 1/6 = 1/6" in holding._repr_html_()
    assert "0 instead of 1/6" in failing._repr_html_()


def test_formulas_are_latex() -> None:
    """Of a stability function and of a modified Hamiltonian, in the signs that notebooks read."""
    stability = garkcli.find_stability("gauss-1")
    (linear,) = stability.linear
    assert linear.R._repr_latex_() == r"$R(z) = \frac{z+2}{-z+2}$"
    latex = stability._repr_latex_()
    report = gark("stability", "gauss-1", "--format", "latex").out
    values = [line.partition(" &= ")[2].removesuffix(r" \\") for line in latex.splitlines()[1:-1]]
    assert values == [r"\frac{z+2}{-z+2}", r"\frac{-2x+8}{x+4}", "1"]
    assert all(f"& ${value}$ " in report for value in values)
    formula = garkcli.modified_formula(VERLET, "pendulum", 3)
    latex = formula._repr_latex_()
    assert latex.startswith(r"\begin{align*}")
    assert r"\frac{\sin^{2}" in unescape(latex)
