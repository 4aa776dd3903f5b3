"""``--symplectic``: the independent conditions of symplectic methods on the command line."""

import csv
import io
import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Any

import pytest
from flint import fmpq

from garkcli.errors import UsageProblem
from garkcli.methodfile.load import load
from garkcli.ntrees.count import counts_of
from garkcli.ntrees.notation import parse_tree
from garkcli.ntrees.symplectic import KINDS, Kind, structure_of, superfluous_classes
from garkcli.report.trees import subject_of_method
from garkcli.tableau.forms import pair, with_linear
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole

COLLOCATION = "methods/collocation.gark.yaml"
VERLET = "methods/stoermer-verlet.gark.yaml"
TREES = ("trees", "--symplectic")
CONDITIONS = ("conditions", "--symplectic")
COUNTS = [  # docs/symplectic-conditions.md, section 4
    ("pair", 1, [1, 1, 3, 8, 27, 91, 350, 1376]),
    ("pair", 2, [2, 4, 20, 104, 662, 4544, 34032, 267904]),
    ("self-conjugate", 1, [1, 0, 1, 1, 3, 4, 11, 19]),
    ("self-conjugate", 2, [2, 1, 6, 14, 54, 175, 700, 2726]),
    ("semi-separable", 2, [2, 2, 7, 23, 95, 406, 1943, 9659]),
    ("separable", 2, [2, 1, 2, 3, 6, 10, 22, 42]),
    ("nystrom", 2, [2, 1, 2, 2, 4, 5, 10, 14]),
]
TEXT = """\
colours: 1 V1, 2 F1
order 3
  tree           σ  γ  stands for         members
  [[]_1,[]_1]_1  2  3           4  ●1 ●1  [[]_1,[]_1]_1  [[[]_1]_2]_1  [[]_1,
                                   ╰┬─╯   []_1]_2  [[[]_1]_2]_2
                                    ●1
  [[]_1,[]_2]_1  1  3           6  ●1 ●2  [[]_1,[]_2]_1  [[[]_1]_1]_1
                                   ╰┬─╯   [[[]_2]_2]_1  [[]_1,[]_2]_2
                                    ●1    [[[]_1]_1]_2  [[[]_2]_2]_2
  [[]_2,[]_2]_1  2  3           4  ●2 ●2  [[]_2,[]_2]_1  [[[]_2]_1]_1  [[]_2,
                                   ╰┬─╯   []_2]_2  [[[]_2]_1]_2
                                    ●1
3 independent conditions of order 3 for a symplectic pair of 1 Hamiltonian,
  instead of 14
"""
CONDITIONS_TEXT = """\
colours: 1 q, 2 p
order 3
  tree           σ  γ  holds  condition
  [[]_2,[]_2]_1  2  3  FAILS  b{1}ᵀ((A{1,2}𝟙) ⊙ (A{1,2}𝟙)) = 1/3   stands for 2
                              is 1/4, off by -1/12  (coupling condition)
                              [[]_2,[]_2]_1  [[[]_2]_1]_2
  [[]_1,[]_1]_2  2  3  FAILS  b{2}ᵀ((A{2,1}𝟙) ⊙ (A{2,1}𝟙)) = 1/3   stands for 2
                              is 1/2, off by 1/6  (coupling condition)
                              [[[]_1]_2]_1  [[]_1,[]_1]_2
2 independent conditions of order 3 for H = H1(p) + H2(q), instead of 4; 2 fail
"""
UNSYMPLECTIC = """
prk:
  q: {A: [[0, 0], [1, 0]], b: [1/2, 1/2]}
  p: {A: [[0, 0], [1, 0]], b: [1/2, 1/2]}
"""
WEIGHTS = """
prk:
  q: {A: [[1/2, 0], [1, 0]], b: [1, 0]}
  p: {A: [[0, 1/2], [0, 1]], b: [0, 1]}
"""
MIDPOINTS = """
methods: [{family: gauss, stages: 1}, {family: gauss, stages: 2}]
transfer: symplectic-collocation
"""
ADDITIVE = """
tableau:
  b: [[1], [1]]
  A: [[[[0]], null], [null, [[0]]]]
"""


def data(*arguments: str, stdin: str = "") -> dict[str, Any]:
    """The JSON report of a run that succeeds."""
    run = gark(*arguments, "--format", "json", stdin=stdin)
    assert run.code == 0, run.err
    found = json.loads(run.out)
    assert isinstance(found, dict)
    return found


def test_text_of_both_commands() -> None:
    """Classes with drawings and members; conditions with what they stand for; the number that is
    left.
    """
    assert gark(*TREES, "-n", "3", "--members").out == TEXT
    assert gark(*CONDITIONS, VERLET, "-n", "3", "--only", "--members").out == CONDITIONS_TEXT


@pytest.mark.parametrize(("kind", "terms", "wanted"), COUNTS)
def test_counts_are_those_of_the_table(kind: str, terms: int, wanted: list[int]) -> None:
    """``--count`` gives the documented numbers, and the listing has as many rows."""
    asked = (*TREES, "--kind", kind, "-N", str(terms), "--upto")
    counted = data(*asked, "-n", "8", "--count")
    assert list(counted["by_order"].values()) == wanted
    assert counted["count"] == sum(wanted)
    listed = [x["order"] for x in data(*asked, "-n", "5")["classes"]]
    assert [listed.count(n) for n in range(1, 6)] == wanted[:5]


def test_counts_in_every_format() -> None:
    """Text, CSV, ndjson and LaTeX have the numbers of JSON."""
    asked = (*TREES, "-N", "2", "-n", "3", "--count")
    assert gark(*asked).out.startswith(
        "  order 3  20 instead of 104\n20 independent conditions of order 3"
    )
    assert gark(*asked, "--format", "csv").out == "kind,order,count,instead_of\npair,3,20,104\n"
    assert json.loads(gark(*asked, "--format", "ndjson").out) == data(*asked)
    assert "order 3 & 20 instead of 104 \\\\\n" in gark(*asked, "--format", "latex").out
    large = data(*TREES, "-n", "300", "--count")["count"]
    assert large > 10**200
    assert str(large) in gark(*TREES, "-n", "300", "--count").out.split()


@pytest.mark.parametrize("kind", KINDS)
def test_members_add_up_to_all_trees(kind: Kind) -> None:
    """With the superfluous ones the members are all rooted trees, each once, and each lies in its
    class.
    """
    found = data(*TREES, "--kind", kind, "-N", "2", "-n", "4", "--members")
    structure = structure_of(kind, 2)
    members = [tree for row in found["classes"] for tree in row["members"]]
    left_out = sum(len(x.members) for x in superfluous_classes(structure, 4))
    assert len(set(members)) == len(members) == found["instead_of"] - left_out
    admissible = structure.admissible
    assert found["instead_of"] == sum(counts_of(admissible, 4))
    for row in found["classes"]:
        assert row["stands_for"] == len(row["members"])
        assert row["representative"] in row["members"]
        assert len({structure.centred(parse_tree(tree)) for tree in row["members"]}) == 1


@pytest.mark.parametrize("kind", KINDS)
def test_formats_agree(kind: Kind) -> None:
    """JSON, ndjson, CSV and text list the same classes with σ, γ and the number of members."""
    asked = (*TREES, "--kind", kind, "-N", "2", "-n", "4", "--upto", "--members")
    rows = data(*asked)["classes"]
    assert rows
    assert [
        json.loads(line) for line in gark(*asked, "--format", "ndjson").out.splitlines()
    ] == rows
    in_csv = list(csv.DictReader(io.StringIO(gark(*asked, "--format", "csv").out)))
    assert [x["members"].split() for x in in_csv] == [x["members"] for x in rows]
    assert [(x["kind"], x["representative"], int(x["stands_for"])) for x in in_csv] == [
        (kind, x["representative"], x["stands_for"]) for x in rows
    ]
    in_text = re.findall(r"^  (\S+) +(\d+) +(\d+) +(\d+)(?: |$)", gark(*asked).out, re.MULTILINE)
    assert in_text == [
        (x["representative"], *(str(x[k]) for k in ("sigma", "gamma", "stands_for"))) for x in rows
    ]
    for row in rows:
        tree = parse_tree(row["representative"])
        assert (tree.order, tree.symmetry, tree.density) == (
            row["order"],
            row["sigma"],
            row["gamma"],
        )


def test_text_names_the_colours_within_80_columns() -> None:
    """The legend says which colour is V and which is F; no line is wider than the terminal."""
    run = gark(*TREES, "-N", "12", "-n", "2")
    assert run.out.startswith("colours: 1 V1, 2 V2,")
    assert "24 F12" in run.out
    assert max(map(len, run.out.splitlines())) <= 80
    assert "colours:" not in gark(*TREES, "--kind", "self-conjugate", "-n", "3").out


def test_sheet_has_a_drawing_for_each_class(tmp_path: Path) -> None:
    """``--svg`` draws the representatives, each vertex a circle."""
    target = tmp_path / "sheet.svg"
    assert gark(*TREES, "-n", "4", "--svg", str(target)).code == 0
    circles = ET.parse(target).getroot().findall(".//{http://www.w3.org/2000/svg}circle")
    assert len(circles) == 8 * 4


def test_conditions_of_a_kind_are_those_of_its_classes() -> None:
    """Up to ``--order`` one row for each class, with its formula and how many conditions it stands
    for.
    """
    found = data(*CONDITIONS, "--kind", "semi-separable", "-n", "4")
    classes = data(*TREES, "--kind", "semi-separable", "-n", "4", "--upto")
    assert found["symplectic"] == {
        k: classes[k] for k in ("kind", "terms", "colours", "count", "instead_of")
    }
    assert [(x["tree"], x["stands_for"]) for x in found["conditions"]] == [
        (x["representative"], x["stands_for"]) for x in classes["classes"]
    ]
    assert found["conditions"][-1]["condition"].endswith(f"= 1/{found['conditions'][-1]['gamma']}")


@in_whole
def test_collocation_satisfies_all_classes_to_order_four() -> None:
    """The pair of collocation holds in all 130 classes up to order 4 and fails in all 662 of order
    5.
    """
    found = data(*CONDITIONS, COLLOCATION, "-n", "4")
    assert found["symplectic"]["colours"] == ["V1", "V2", "F1", "F2"]
    assert [x["holds"] for x in found["conditions"]] == [True] * 130
    fifth = data(*CONDITIONS, COLLOCATION, "-n", "5", "--only")["conditions"]
    assert len(fifth) == 662
    assert not any(x["holds"] for x in fifth)
    assert not any(
        x["holds"]
        for x in data("conditions", COLLOCATION, "--pair", "-n", "5", "--only")["conditions"]
    )
    failing = gark(*CONDITIONS, COLLOCATION, "-n", "5", "--only", "--failing").out
    assert " ".join(failing.split()).endswith("of 5996; 662 fail")
    assert gark(*CONDITIONS, COLLOCATION, "-n", "4", "--failing").out.endswith("; all hold\n")


@in_whole
def test_classes_that_fail_are_those_of_conditions_that_fail() -> None:
    """Where some conditions of order 5 hold and some fail, the failing classes have the failing
    conditions.
    """
    path = "methods/symplectic-gauss-lobatto4.gark.yaml"
    rows = data(*CONDITIONS, path, "-n", "5", "--only", "--members")["conditions"]
    every = data("conditions", path, "--pair", "-n", "5", "--only")["conditions"]
    failing = {tree for row in rows if not row["holds"] for tree in row["members"]}
    assert 0 < sum(row["holds"] for row in rows) < len(rows) == 662
    assert {row["tree"] for row in every if not row["holds"]} == {
        t for t in failing if t[-1] in "12"
    }


def test_conditions_of_a_class_fail_together() -> None:
    """At the first order that fails, the residuals of a class differ by their sign only."""
    every = {
        x["tree"]: fmpq(*map(int, re.findall(r"-?\d+", x["residual"])))
        for x in data("conditions", VERLET, "-n", "3", "--only")["conditions"]
    }
    for row in data(*CONDITIONS, VERLET, "-n", "3", "--only", "--members")["conditions"]:
        residual = every[row["tree"]]
        assert residual != 0
        assert {abs(every[tree]) for tree in row["members"]} == {abs(residual)}


@pytest.mark.parametrize(
    ("path", "kind", "colours"),
    [
        (VERLET, "separable", ["q", "p"]),
        ("methods/semi-separable.gark.yaml", "semi-separable", ["V1", "F1", "F2"]),
        ("methods/prk-lobatto-iiia-iiib.gark.yaml", "pair", ["q", "p"]),
        ("methods/three-colours.gark.yaml", "pair", ["V1", "V2", "V3", "F1", "F2", "F3"]),
    ],
)
def test_kind_of_a_file(path: str, kind: str, colours: list[str]) -> None:
    """A partitioned file is taken as it stands, any other as its symplectic pair."""
    found = data(*CONDITIONS, path, "-n", "3")["symplectic"]
    assert (found["kind"], found["colours"]) == (kind, colours)
    terms = str(found["terms"])
    assert (
        found["count"]
        == data(*TREES, "--kind", kind, "-N", terms, "-n", "3", "--upto", "--count")["count"]
    )


def test_nystrom_file() -> None:
    """A file for quadratic kinetic energy has the fewer classes of such problems."""
    text = (
        (ROOT / VERLET)
        .read_text(encoding="utf-8")
        .replace("structure: separable", "structure: nystrom")
    )
    found = data(*CONDITIONS, "-", "-n", "4", stdin=text)["symplectic"]
    assert (found["kind"], found["count"]) == ("nystrom", 7)


def test_method_that_is_its_own_conjugate() -> None:
    """A symplectic GARK method has the undirected free trees; ``--pair`` asks for those of its
    pair.
    """
    found = data(*CONDITIONS, "-", "-n", "4", stdin=MIDPOINTS)
    assert (found["symplectic"]["kind"], found["symplectic"]["count"]) == ("self-conjugate", 23)
    assert {x["holds"] for x in found["conditions"] if x["order"] < 3} == {True}
    assert (
        data(*CONDITIONS, "-", "-n", "2", "--pair", stdin=MIDPOINTS)["symplectic"]["kind"] == "pair"
    )


def test_blocks_that_a_file_lacks() -> None:
    """Where two colours do not see each other, classes with an edge between them have no
    condition.
    """
    found = data(*CONDITIONS, "-", "-n", "3", stdin=ADDITIVE)
    assert found["symplectic"]["count"] == len(found["conditions"]) == 2 * 5
    assert found["symplectic"]["instead_of"] == 2 * 20
    assert all("1" not in x["tree"] or "2" not in x["tree"] for x in found["conditions"])


def test_term_that_is_linear_in_part() -> None:
    """A term with one linear vector field of two is refused: the structure knows no such
    Hamiltonian.
    """
    tableau = with_linear(pair(load(str(ROOT / COLLOCATION)).tableau), ["V1"])
    with pytest.raises(UsageProblem, match="colour F1 is not linear"):
        subject_of_method(tableau, range(1, 3))


@pytest.mark.parametrize("text", [UNSYMPLECTIC, WEIGHTS])
def test_file_that_is_not_symplectic(text: str) -> None:
    """A partitioned method that is not symplectic is refused, with the reason."""
    run = gark(*CONDITIONS, "-", stdin=text)
    assert (run.code, run.out) == (2, "")
    assert "the method is not symplectic: " in run.err
    assert ("different weights" in run.err) == (text == WEIGHTS)
    assert (gark(*CONDITIONS, "-", "--pair", "-n", "1", stdin=text).code == 0) == (
        text == UNSYMPLECTIC
    )


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (
            (*TREES, "--kind", "separable", "-N", "3", "-n", "2"),
            "separable problems have 2 terms, not 3",
        ),
        ((*CONDITIONS, "--kind", "nystrom", "-N", "1"), "nystrom problems have 2 terms, not 1"),
        ((*TREES,), "which order?"),
        ((*TREES, "-n", "3", "--root", "1"), "free trees have no root"),
        ((*TREES, "--tree", "[]_1"), "free trees have no root"),
        ((*TREES, "-n", "3", "--colours-used", "1"), "free trees have no root"),
        (("trees", "-n", "3", "--members"), "--members is about free trees"),
        (("conditions", "--kind", "pair"), "--kind is about free trees"),
        ((*TREES, "-n", "2", "--members", "--format", "latex"), "--members do not fit"),
        ((*CONDITIONS, "--coloured"), "free trees have colours"),
        ((*CONDITIONS, COLLOCATION, "--kind", "pair"), "the kind is that of FILE"),
        ((*CONDITIONS, COLLOCATION, "-N", "2"), "the colours are those of FILE"),
        ((*CONDITIONS, "--failing"), "values are those of a method"),
        ((*CONDITIONS, "methods/ark-ars222.gark.yaml"), "divides by the weights"),
    ],
)
def test_options_that_do_not_go_together(arguments: tuple[str, ...], message: str) -> None:
    """Each is a problem of usage, told in words, without a report."""
    run = gark(*arguments)
    assert (run.code, run.out) == (2, "")
    assert message in run.err


@pytest.mark.parametrize("arguments", [("trees", "-N", "2"), ("conditions",), TREES, CONDITIONS])
def test_pictures_in_latex_are_cells(arguments: tuple[str, ...]) -> None:
    """No empty line is within the table, and what is between the begin and the end of a picture is
    indented.
    """
    text = gark(*arguments, "-n", "3", "--format", "latex").out
    lines = text.partition("\\end{longtable}")[0].splitlines()
    assert all(line.strip() for line in lines)
    starts = [k for k, line in enumerate(lines) if line.startswith("\\begin{tikzpicture}")]
    assert starts
    for k in starts:
        end = next(i for i in range(k, len(lines)) if "\\end{tikzpicture}" in lines[i])
        assert lines[end].startswith("\\end{tikzpicture} &")
        assert all(line.startswith("  \\") for line in lines[k + 1 : end])
