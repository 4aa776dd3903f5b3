"""What notebooks show: well-formed, escaped, with the entries that are printed."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from garkcli import (
    GarkMethod,
    Tree,
    analyse,
    check_file,
    diagonal_method,
    from_arrays,
    load,
    loads,
    parse_tree,
)
from garkcli.exact.display import to_text
from garkcli.ntrees.drawing import draw_svg_sheet
from garkcli.ntrees.notation import format_tree
from garkcli.page.tableau_latex import displays
from garkcli.tableau.pointwise import entries

HOSTILE = '<script>alert("x")</script> & \x1b[2J'
TWO = loads(
    "methods: [{family: gauss, stages: 1},"
    " {family: lobatto-iiia, stages: 2}]\ntransfer: collocation"
)
EMBEDDED = from_arrays([[0, 0], [1, 0]], ["1/2", "1/2"], embedded=[1, 0], name="Heun")


def cells(html: str) -> list[list[str]]:
    """The texts of the cells of a table, row by row; it has to be well-formed."""
    root = ET.fromstring(f"<div>{html}</div>")
    return [["".join(cell.itertext()) for cell in row] for row in root.iter("tr")]


def test_a_method_is_its_tableau() -> None:
    """C beside A, then b and the embedded weights, as text."""
    assert cells(EMBEDDED._repr_html_()) == [
        ["0", "0", "0"],
        ["1", "1", "0"],
        ["", "1/2", "1/2"],
        ["", "1", "0"],
    ]
    html = EMBEDDED._repr_html_()
    assert ">Heun</caption>" in html
    assert html.count("padding:") == html.count("<td")  # no cells touch
    gauss = diagonal_method("gauss", 2)
    first = [to_text(x) for x in (gauss.c[0], *gauss.A[0])]
    assert cells(gauss._repr_html_())[0] == first


def test_several_colours_are_counted_from_one() -> None:
    """Heads over the blocks, a blank where a colour does not see another, Q and P of a pair."""
    found = cells(TWO._repr_html_())
    assert found[0] == ["", "1", "2"]
    assert found[1] == ["1/2", "1/2", "3/8", "1/8"]
    assert len(found) == 5
    apart = from_arrays([[[[0]], None], [[[1]], [["1/2"]]]], [[1], [1]])
    assert cells(apart._repr_html_())[1] == ["0", "0", ""]
    both = TWO.pair._repr_html_()
    assert both.count("<table") == 2
    assert ", Q</caption>" in both
    assert "V1" in both
    assert "F2" in both


def test_latex_is_that_of_the_command() -> None:
    """The arrays of ``gark tableau --format latex``, without its comments."""
    for method in (EMBEDDED, TWO, TWO.pair):
        shown = entries(method.tableau).beside(method.further)
        wanted = displays(method.tableau, shown)
        assert method._repr_latex_() == "\n".join(wanted)


def test_what_is_too_large_is_named() -> None:
    """A tableau that nobody looks at is not computed."""
    many = diagonal_method("gauss", 40)
    assert cells(many._repr_html_()) == []
    assert "stages 40" in many._repr_html_()
    assert many._repr_latex_() is None


def test_decimals_say_that_they_are() -> None:
    """Nodes without simple radicals are shown in decimals, with a remark."""
    html = diagonal_method("gauss", 6)._repr_html_()
    assert "no simple radicals" in html


def test_text_of_a_file_is_escaped(tmp_path: Path) -> None:
    """No name, claim or fault is markup."""
    import json

    name = json.dumps(HOSTILE)
    text = f"name: {name}\nA: [[1/2]]\nb: [1]\nexpect: {{order: 3}}\n"
    path = tmp_path / "a.gark.yaml"
    path.write_text(text, encoding="utf-8")
    bad = tmp_path / "b.gark.yaml"
    bad.write_text(f"A: [[{name}]]\nb: [1]\n", encoding="utf-8")
    for shown in (load(str(path)), check_file(str(path)), check_file(str(bad))):
        html = shown._repr_html_()
        cells(html)
        assert "<script" not in html
        assert "\x1b" not in html


def test_a_tree_is_its_picture() -> None:
    """The sheet of one tree, well-formed, with the colours counted from 1."""
    tree = parse_tree("[[]_2,[]_3]_1")
    picture = tree._repr_svg_()
    assert picture == draw_svg_sheet([tree])
    assert ET.fromstring(picture).tag.endswith("svg")
    for number in "123":
        assert f">{number}</text>" in picture
    assert Tree(0)._repr_svg_() != picture


def sentences(html: str) -> list[str]:
    """The texts of the paragraphs, the first one the answer."""
    root = ET.fromstring(f"<div>{html}</div>")
    return ["".join(part.itertext()) for part in root.iter("p")]


@pytest.mark.parametrize("method", [EMBEDDED, TWO, load("rk4")])
def test_an_analysis_is_its_report(method: GarkMethod) -> None:
    """The order with the tree at which it ends is the first paragraph; the other orders, the bound
    and symplecticity follow, of several colours in rows.
    """
    found = analyse(method)
    html = found._repr_html_()
    answer, *more = sentences(html)
    order, witness = found.order, found.order.witness
    assert witness is not None
    tree = format_tree(witness.tree, len(found.tableau.colours) > 1)
    assert answer.startswith(
        f"order {order.order}, proved; order {order.order + 1} fails at {tree}"
    )
    said = " ".join(more)
    assert f"give at least order {found.bound}" in said
    assert ("not symplectic" in said) is not found.symplectic
    assert found.pair_order is not None
    assert found.conjugate_order is not None
    if found.tableau.size == 1:
        assert f"the symplectic pair has order {found.pair_order.order}" in said
        return
    rows = {row[0]: row[1] for row in cells(html)}
    for label, of in (
        ("conjugate order", found.conjugate_order),
        ("symplectic pair", found.pair_order),
    ):
        assert rows[label].startswith(f"{of.order}, proved; ")


def test_claims_and_faults_have_rows(tmp_path: Path) -> None:
    """Which claims hold, which fail and what is found; where a file is at fault, and the cure."""
    path = tmp_path / "a.gark.yaml"
    path.write_text("A: [[1/2]]\nb: [1]\nexpect: {order: 3, symplectic: true}\n", encoding="utf-8")
    found = check_file(str(path))
    rows = {row[0]: row[1] for row in cells(found._repr_html_())}
    assert rows["CLAIM FAILS"].startswith("order: expected 3, found 2")
    assert rows["claim holds"] == "symplectic: true"
    assert repr(found).endswith(": 2 claims, 1 failed>")
    path.write_text("A: [[1/0]]\nb: [1]\n", encoding="utf-8")
    found = check_file(str(path))
    html = found._repr_html_()
    assert sentences(html)[0].endswith("a.gark.yaml: cannot be read as a method")
    rows = dict(cells(html))
    assert rows["error"].startswith("line 1, column 8: A, row 1, entry 1: division by zero")
    assert rows["help"].startswith("the divisor is exactly zero")
    assert repr(found).endswith(": 1 fault>")


def test_a_file_with_free_parameters_says_what_holds_for_all(tmp_path: Path) -> None:
    """There is no analysis of one method, but an order for every value; a claim is one of
    every value too. No mark of the page shows as text.
    """
    path = tmp_path / "a.gark.yaml"
    path.write_text(
        "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [1/2, 1/2]\nexpect: {order: 1}\n",
        encoding="utf-8",
    )
    found = check_file(str(path))
    assert found.analysis is None
    html = found._repr_html_()
    answer = sentences(html)[0]
    assert f"{path}, every value of t: order 1; order 2 fails at [[]] by " in answer
    assert answer.endswith(r"; order 2 where \(t\) = \(1\)")
    rows = {row[0]: row[1] for row in cells(html)}
    assert rows["CLAIM FAILS"].startswith("order: expected 1, found 1; 2 where t = 1")
    assert rows["symplectic"] == "no"


def test_orders_within_a_tolerance_and_of_dense_output_say_how_they_are_known() -> None:
    """The tolerance is part of what a notebook and a console show of them."""
    rounded = analyse(load("tests/examples/valid/rounded.gark.yaml"))
    assert "4 within 1e-14" in rounded.order._repr_html_()
    assert repr(rounded.order) == "<RoundedOrder 4 within 1e-14>"
    dense = analyse(load("tests/examples/valid/embedded-and-dense.gark.yaml")).dense
    assert dense is not None
    assert repr(dense.order) == "<DenseOrder 3>"
    assert dense.order._repr_html_().startswith("<p>dense order 3: fails at order 4")
