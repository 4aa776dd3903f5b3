"""Embedded weights and dense output in reports: text, JSON with its schema, markdown, tableaus."""

from __future__ import annotations

import json
import re
from pathlib import Path

import jsonschema  # type: ignore[import-untyped]
import pytest

from garkcli.api.methods import reduced
from garkcli.check.check_file import check_file
from garkcli.check.outcome import Outcome
from garkcli.check.true_claims import true_claims
from garkcli.methodfile.expectations import CLAIMS
from garkcli.methodfile.load import load, loads
from garkcli.page.look import Look
from garkcli.page.tableau_latex import tableau_lines
from garkcli.report import check_findings
from garkcli.report.check_formats import FORMATS
from garkcli.report.check_text import render
from garkcli.report.checked import REPORT
from garkcli.report.tableau import REPORT as TABLEAU
from garkcli.report.tableau import ShownTableau
from garkcli.tableau.pointwise import entries
from tests.cli.harness import gark
from tests.whole import in_whole, sample

VALID = Path(__file__).parents[1] / "examples" / "valid"
FILE = VALID / "embedded-and-dense.gark.yaml"
EXAMPLES = sorted(VALID.glob("embedded-*.gark.yaml"))


def checked(tmp_path: Path, text: str) -> Outcome:
    """What becomes of a file with this text."""
    path = tmp_path / "method.gark.yaml"
    path.write_text(text)
    return check_file(str(path))


def words(text: str) -> str:
    """A text without its line ends and margins."""
    return " ".join(text.split())


def test_text_tells_orders_estimate_and_how_pieces_fit() -> None:
    """Each has its line, with the tree that fails; the leading term of the estimate is a detail."""
    outcome = check_file(str(FILE))
    text = words(render([outcome], Look()))
    for line in (
        " embedded order 2, proved; order 3 fails at [[[]]] by 1/48 ",
        " error estimate O(h^3); b − embedded sums to 0 ",
        " dense order 3: fails at order 4: [[[[]]]], at θ^2: -1/6 instead of 0, off by -1/6 ",
        " dense output C¹, of degree 3 ",
    ):
        assert line in text
    detailed = words(render([outcome], Look(), verbosity=1))
    assert " 2-norm 0.0294628 largest 0.0208333 at [[],[]] " in detailed
    assert " degree 3 continuous yes smooth yes " in detailed


@in_whole
@pytest.mark.parametrize("path", sample(EXAMPLES, 3), ids=lambda x: x.name)
def test_no_line_is_wide_and_json_keeps_its_schema(path: Path) -> None:
    """Text fits 80 columns, and the JSON report of each example is valid."""
    outcome = check_file(str(path))
    text = render([outcome], Look())
    assert max(map(len, text.splitlines())) <= 80 + len(str(path))
    assert all(len(line) <= 80 for line in text.splitlines() if path.name not in line)
    data = json.loads(REPORT.json([outcome]))
    jsonschema.validate(data, REPORT.schema)
    (file,) = data["files"]
    embedded = outcome.analysis and outcome.analysis.embedded
    assert embedded
    assert file["embedded_order"] == embedded.order.order
    assert file["error_estimate"]["order"] == embedded.estimator.order
    assert (file["dense"] is None) == (file["dense_order"] is None)


def test_markdown_has_a_column_where_there_is_one() -> None:
    """The table has a column of embedded orders with such a method, and none without."""
    plain = check_file(str(VALID / "smallest.gark.yaml"))
    paired = check_file(str(FILE))
    head = FORMATS["markdown"]([plain, plain], Look(), 0, None, 80).splitlines()[0]
    assert head.startswith("| file | order | conjugate order |")
    assert "embedded" not in head
    head, rule, first, second = FORMATS["markdown"](
        [plain, paired], Look(), 0, None, 80
    ).splitlines()[:4]
    assert head.startswith("| file | order | embedded order | conjugate order |")
    assert rule.count("|") == head.count("|") == first.count("|")
    assert second.split(" | ")[1:3] == ["3", "2"]


PAIR = FILE.read_text().partition("expect:")[0]


@in_whole
def test_failing_claims_have_witness_and_repair(tmp_path: Path) -> None:
    """One entry of the embedded weights changed: the claim fails, and the entry is named with the
    value that it had.
    """
    wrong = PAIR.replace("7/24", "5/24")
    outcome = checked(tmp_path, f"{wrong}expect: {{order: 3, embedded-order: 2}}")
    (failed,) = outcome.failed_claims
    assert (failed.claim, failed.found) == ("embedded-order", "0")
    text = render([outcome], Look())
    assert "would hold with embedded b[1] = 7/24 instead of 5/24" in words(text)
    junit = check_findings.junit([outcome])
    assert "fails at order 1: []: 11/12 instead of 1" in junit
    data = json.loads(REPORT.json([outcome]))
    jsonschema.validate(data, REPORT.schema)
    repair, *_ = data["files"][0]["blame"]["repairs"]
    assert repair["embedded"] == [1]
    assert (repair["entry"], repair["new"]) == (1, "7/24")


def test_claims_on_what_is_not_there_fail(tmp_path: Path) -> None:
    """A file without further weights cannot claim anything of them, and is told why."""
    text = "A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\nexpect:\n"
    text += "  embedded-order: 1\n  dense-order: 1\n  dense-smooth: true\n"
    found = [x.found for x in checked(tmp_path, text).failed_claims]
    assert found == [
        "none: there are no embedded weights",
        "none: there is no dense output",
        "none: there is no dense output",
    ]


def test_a_wrong_node_shows_in_both_orders_with_time(tmp_path: Path) -> None:
    """One node printed as 2: order 3 stays, on y' = f(t, y) it is 1, and so says the claim."""
    nodes = "c: [0, 2, 3/4, 1]\n"
    claims = "nonautonomous-order: 3, embedded-nonautonomous-order: 2"
    outcome = checked(tmp_path, f"{PAIR}{nodes}expect: {{order: 3, {claims}}}")
    found = {x.claim: x.found for x in outcome.failed_claims}
    assert found == {"nonautonomous-order": "1", "embedded-nonautonomous-order": "1"}
    text = words(render([outcome], Look()))
    assert " non-autonomous order 1, proved; order 2 fails at " in text
    assert " embedded non-autonomous order 1, proved; order 2 fails " in text
    assert " consistent no: A𝟙 differs from c: row" in text


def test_what_may_be_claimed_is_claimed_truly() -> None:
    """``gark claims`` knows the claims on further weights, and they hold in the file."""
    outcome = check_file(str(FILE))
    assert outcome.analysis is not None
    true = true_claims(outcome.analysis, CLAIMS)
    said = {x.claim: x.expected for x in outcome.claims}
    assert said.items() <= true.items()
    assert true["embedded-order"] == "2"


FAMILY = """parameters: {w: free}
A: [[0, 0], [w, 0]]
b: [1 - 1/(2*w), 1/(2*w)]
embedded: [1 - w, w]
"""


@in_whole
def test_a_family_has_the_embedded_order_of_every_value(tmp_path: Path) -> None:
    """With a free parameter the embedded order is that of every value, with those that have a
    higher one; the methods at these values agree.
    """
    outcome = checked(tmp_path, f"{FAMILY}expect: {{embedded-order: '>= 1'}}")
    assert outcome.ok
    assert outcome.every is not None
    assert outcome.every.embedded_order is not None
    assert outcome.every.embedded_order.order == 1
    text = render([outcome], Look())
    assert re.search(r"  embedded order +1[;\n]", text)
    data = json.loads(REPORT.json([outcome]))
    jsonschema.validate(data, REPORT.schema)
    at = [x for x, _ in outcome.every.embedded_order.fact.special]
    assert len(at) == 2  # w² = 1/2
    for value, order in (("1/3", 1), ("sqrt(2)/2", 2), ("-sqrt(2)/2", 2)):
        path = str(tmp_path / "method.gark.yaml")
        found = check_file(path, settings={"w": value}).analysis
        assert found is not None
        assert found.embedded is not None
        assert found.embedded.order.order == order


def test_dense_claims_of_a_family_need_values(tmp_path: Path) -> None:
    """Dense output is judged for values: a claim on it is refused with that cure."""
    text = FAMILY + "dense: {degree: 1, weights: [[1 - w], [w]]}\n"
    outcome = checked(tmp_path, f"{text}expect: {{dense-order: 1}}")
    assert not outcome.is_read
    assert "--set w=1/2" in outcome.faults[0].help
    assert checked(tmp_path, text).is_read


def test_tableaus_show_them_in_every_format() -> None:
    """Text has a row under b and a block per colour, JSON both with floats, LaTeX a row and the
    polynomials.
    """
    method = load(str(FILE))
    found = entries(method.tableau).beside(method.further)
    shown = ShownTableau(method.tableau, found, "it")
    text = TABLEAU.render([shown])
    assert "embedded | 7/24  1/4  1/3  1/8" in text
    assert "    0  4/3   -8/9" in text
    narrow = TABLEAU.render([shown], width=20)
    assert "embedded = 7/24," in narrow
    assert "{1}" not in narrow
    data = json.loads(TABLEAU.json([shown]))
    jsonschema.validate(data, TABLEAU.schema)
    assert data["embedded"] == [["7/24", "1/4", "1/3", "1/8"]]
    assert data["float"]["dense"][0][1] == [0.0, 1.0, pytest.approx(-2 / 3)]
    latex = "\n".join(tableau_lines(method.tableau, found))
    assert r"& \frac{7}{24} & \frac{1}{4}" in latex
    assert r"b_{4}(\theta) &= -\theta^{2}+\theta^{3}" in latex
    assert "embedded" not in TABLEAU.render([shown._replace(entries=entries(method.tableau))])
    assert "embedded | 7/24  1/4  1/3  1/8" in TABLEAU.render([shown], "markdown")
    assert r"& \frac{7}{24} & \frac{1}{4}" in TABLEAU.render([shown], "latex")
    assert "<td" in TABLEAU.html(shown)


def test_latex_of_sums_and_zeros() -> None:
    """Coefficients that are sums stand in parentheses, and the zero polynomial is 0."""
    method = loads(
        "A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\n"
        "dense: {degree: 2, weights: [[1 - sqrt(2), -1], [0, 0]]}"
    )
    found = entries(method.tableau).beside(method.further)
    latex = "\n".join(tableau_lines(method.tableau, found))
    assert r"\left(1-\sqrt{2}\right)\theta-\theta^{2}" in latex
    assert r"b_{2}(\theta) &= 0" in latex


def test_reducing_keeps_the_stages_that_further_weights_need() -> None:
    """The last stage of an FSAL pair stays, as embedded weights and dense output look at it; equal
    stages become one, and their weights of each kind are added.
    """
    method = load(str(FILE))
    same = reduced(method)
    assert same is not None
    assert same.stages == (4,)
    assert same.further == method.further
    doubled = loads(
        "A: [[0, 0, 0], [1, 0, 0], [1, 0, 0]]\nb: [1/2, 1/4, 1/4]\n"
        "embedded: [1, 1/3, -1/3]\n"
        "dense: {degree: 2, weights: [[1, -1/2], [0, 1/3], [0, 1/6]]}"
    )
    smaller = reduced(doubled)
    assert smaller is not None
    assert smaller.stages == (2,)
    assert [str(x) for x in smaller.embedded[0]] == ["1", "0"]
    assert [[str(x) for x in row] for row in smaller.dense.weights[0]] == [
        ["1", "-1/2"],
        ["0", "1/2"],
    ]


def test_companions_are_without_and_the_commands_say_so() -> None:
    """The tableau and the file of a conjugate and of a pair have no further weights, with a note;
    those of the method itself have them.
    """
    path = str(VALID / "embedded-ark.gark.yaml")
    own = gark("tableau", path, "--format", "yaml")
    assert loads(own.out).further == load(path).further
    for options in ([], ["--pair"]):
        run = gark("conjugate", path, *options, "--format", "yaml")
        assert run.code == 0
        assert "left out" in run.err
        assert not loads(run.out).further
