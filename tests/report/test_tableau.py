"""Tableaus as LaTeX, decimals and method files."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from flint import fmpq
from hypothesis import given
from hypothesis import strategies as st

from garkcli.exact.display import plain_decimal
from garkcli.exact.expression import read_decimal
from garkcli.methodfile.load import load, loads
from tests.cli.harness import gark
from tests.whole import in_whole

ROOT = Path(__file__).resolve().parents[2]
EXACT = ["rectangular", "collocation", "stoermer-verlet", "prk-lobatto-iiia-iiib", "ark-ars222"]


def arrays(text: str) -> list[list[list[str]]]:
    """The rows of cells of each LaTeX array."""
    found = re.findall(r"\\begin\{array\}\{[^}]*\}\n(.*?)\\end\{array\}", text, re.DOTALL)
    rows = [body.replace("\\hline\n", "").split("\\\\") for body in found]
    return [[[cell.strip() for cell in row.split("&")] for row in body] for body in rows]


def test_the_rectangular_method_is_printed_as_in_the_paper() -> None:
    """Eq. (rectangular): Q has three rows of two, P two rows of three, beside each other."""
    run = gark("tableau", "methods/rectangular.gark.yaml", "--format", "latex")
    q, p = arrays(run.out)
    third, half = r"\frac{1}{3}", r"\frac{1}{2}"
    assert q == [
        ["0", "0", "0"],
        [half, r"\frac{1}{4}+\frac{\sqrt{3}}{8}", r"\frac{1}{4}-\frac{\sqrt{3}}{8}"],
        ["1", half, half],
        ["", half, half],
    ]
    root = r"\frac{\sqrt{3}}{6}"
    assert p[0] == [f"{half}-{root}", r"\frac{1}{6}", f"{third}-{root}", "0"]
    assert p[1] == [f"{half}+{root}", r"\frac{1}{6}", f"{third}+{root}", "0"]
    assert run.out.count(r"\[") == 1
    assert run.out.index("Q: ") < run.out.index("P: ")


def test_a_wide_pair_is_one_display_after_the_other() -> None:
    """Q and P of a pair of 2N colours have the same nodes and weights, as in eq.
    (psymplecticGARK).
    """
    run = gark("conjugate", "methods/collocation.gark.yaml", "--pair", "--format", "latex")
    q, p = arrays(run.out)
    assert run.out.count(r"\[") == 2
    assert [row[0] for row in q] == [row[0] for row in p]
    assert q[-1] == p[-1]
    assert len(q) == 6
    assert {len(row) for row in (*q, *p)} == {6}
    (alone,) = arrays(gark("tableau", "methods/collocation.gark.yaml", "--format", "latex").out)
    assert alone == q
    made = gark("conjugate", "methods/collocation.gark.yaml", "--format", "latex")
    assert arrays(made.out) == [p]


def test_a_semi_separable_pair_leaves_out_what_the_problem_lacks() -> None:
    """The paper's Q has stages of both methods and one column of blocks, its P the other way."""
    run = gark("tableau", "methods/semi-separable.gark.yaml", "--format", "latex")
    q, p = arrays(run.out)
    assert [len(q), len(q[0])] == [2 + 3 + 1, 1 + 2]
    assert [len(p), len(p[0])] == [2 + 1, 1 + 2 + 3]


@pytest.mark.parametrize("command", ["tableau", "conjugate"])
def test_a_document_is_complete(command: str) -> None:
    """With --document the arrays stand in a document, which other formats refuse."""
    arguments = (command, "methods/collocation.gark.yaml", "--document")
    text = gark(*arguments, "--format", "latex").out
    assert text.startswith("\\documentclass")
    assert text.endswith("\\end{document}\n")
    assert arrays(text) == arrays(gark(*arguments[:2], "--format", "latex").out)
    for other in ("text", "yaml", "json"):
        run = gark(*arguments, "--format", other)
        assert (run.code, run.out) == (2, "")
        assert "--format latex" in run.err


@pytest.mark.parametrize("name", EXACT)
def test_the_file_of_a_tableau_is_the_method(name: str) -> None:
    """``gark tableau --format yaml`` loads again as the same blocks at the same nodes."""
    path = f"methods/{name}.gark.yaml"
    written = loads(gark("tableau", path, "--format", "yaml").out).tableau
    shown = [json.loads(gark("tableau", path, "--format", "json").out)]
    file = gark("tableau", path, "--format", "yaml").out
    again = gark("tableau", "-", "--format", "json", stdin=file)
    shown.append(json.loads(again.out))
    assert [colour.part for colour in written.colours] == [
        colour.part for colour in load(str(ROOT / path)).tableau.colours
    ]
    assert shown[0]["A"] == shown[1]["A"]
    assert shown[0]["b"] == shown[1]["b"]


def test_what_no_file_spells_out() -> None:
    """Nodes without radicals ask for digits; pairs of several terms have no spelled-out form."""
    run = gark("tableau", "methods/gauss6-lobatto7.gark.yaml", "--format", "yaml")
    assert run.code == 2
    assert "--digits 17" in run.err
    run = gark("tableau", "methods/semi-separable.gark.yaml", "--format", "yaml", "--digits", "9")
    assert run.code == 2
    assert "--format json" in run.err


@pytest.mark.parametrize(
    ("name", "order"), [pytest.param("gauss6-lobatto7", 12, marks=in_whole), ("rectangular", 4)]
)
def test_a_rounded_file_has_the_order_within_its_tolerance(name: str, order: int) -> None:
    """Decimals of any nodes make a file whose tolerance explains what rounding did."""
    path = f"methods/{name}.gark.yaml"
    text = gark("tableau", path, "--format", "yaml", "--digits", "25").out
    found = json.loads(gark("check", "-", "--format", "json", stdin=text).out)["files"][0]
    assert found["order"] == order
    assert loads(text).tolerance == fmpq(1, 10**22)


@pytest.mark.parametrize("shape", ["text", "latex", "json", "yaml"])
@pytest.mark.parametrize("command", ["tableau", "conjugate"])
def test_digits_make_decimals_in_every_format(command: str, shape: str) -> None:
    """No root and no fraction is left, and each number is that of the exact tableau, rounded."""
    run = gark(command, "methods/collocation.gark.yaml", "--digits", "6", "--format", shape)
    assert run.code == 0
    assert "sqrt" not in run.out
    assert "/" not in run.out.replace("gark/tableau/1", "")
    assert "0.211325" in run.out


@given(st.integers(-(10**6), 10**6), st.integers(0, 12), st.integers(0, 12))
def test_plain_decimals_are_read_back(p: int, twos: int, fives: int) -> None:
    """A rational number whose decimals end is written with all of them."""
    number = fmpq(p, 2**twos * 5**fives)
    text = plain_decimal(number)
    assert "/" not in text
    assert read_decimal(text.removeprefix("-")) * (-1 if text.startswith("-") else 1) == number


def test_a_family_has_no_verdict_of_one_method(tmp_path: Path) -> None:
    """For g = 1/4 alone it is symplectic."""
    file = tmp_path / "family.gark.yaml"
    text = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
    file.write_text(text, encoding="utf-8")
    told = gark("tableau", str(file), "-v").out
    assert "weights sum  1" in told
    assert "symplectic" not in told
    assert "symplectic   yes" in gark("tableau", str(file), "-v", "--set", "g=1/4").out


@pytest.mark.parametrize(
    ("name", "said"),
    [("rectangular", "stages q: 2, p: 3"), ("semi-separable", "stages q: 2, p: 2 + 3")],
)
def test_every_command_counts_the_evaluations_of_a_colour(name: str, said: str) -> None:
    """The stages of a colour are as many as its weights, in words, in JSON and in ``gark show``."""
    file = f"methods/{name}.gark.yaml"
    tableau = load(str(ROOT / file)).tableau
    counts = [len(colour.b) for colour in tableau.colours]
    assert said in " ".join(gark("check", file, "-v").out.split())
    colours = json.loads(gark("check", file, "--format", "json").out)["files"][0]["colours"]
    assert [x["stages"] for x in colours] == counts
    assert f"stages {', '.join(map(str, counts))}" in gark("show", file).out


def test_long_nodes_and_weights_go_on_in_the_next_line() -> None:
    """Nodes and weights of a tableau too wide for a grid fit 80 columns, and none is lost."""
    run = gark("tableau", "methods/gauss6-lobatto7.gark.yaml")
    vectors = run.out.split("\n\n")[1:3]
    assert max(len(line) for part in vectors for line in part.splitlines()) <= 80
    counts = [len(x.split(",")) for part in vectors for x in re.split(r"\nb", part)]
    assert counts == [6, 6, 7, 7]


def blocks_of(text: str) -> dict[str, list[list[str]]]:
    """The blocks of a listing by their names, those in groups of columns put together again."""
    found: dict[str, list[list[str]]] = {}
    for part in text.split("\n\n"):
        head, *lines = part.splitlines()
        name = re.match(r"A\{.*?\}", head)
        if name is None:
            continue
        rows = found.setdefault(name[0], [[] for _ in lines])
        for row, line in zip(rows, lines, strict=True):
            row += re.split(" {2,}", line.strip())
    return found


@pytest.mark.parametrize(
    "run",
    [
        ("tableau", "methods/gauss6-lobatto7.gark.yaml"),
        ("conjugate", "methods/three-colours.gark.yaml"),
    ],
    ids=lambda run: run[0],
)
def test_wide_blocks_are_printed_some_columns_at_a_time(run: tuple[str, str]) -> None:
    """Together the groups of columns are the blocks of the JSON report, entry by entry; a block
    that fits 80 columns is printed whole.
    """
    text = gark(*run).out
    report = json.loads(gark(*run, "--format", "json").out)
    names = [colour["name"] for colour in report["colours"]]
    expected = {}
    for l, row in zip(names, report["A"], strict=True):
        for m, block in zip(names, row, strict=True):
            expected[f"A{{{l},{m}}}"] = block
    assert blocks_of(text) == expected
    for name, block in expected.items():
        columns = zip(*block, strict=True)
        widths = [max(map(len, column)) for column in columns]
        gaps = 2 * (len(widths) - 1)
        fits = 4 + sum(widths) + gaps <= 80
        assert (f"{name} =" in text) == fits
        assert (f"{name}, column" in text) != fits


def test_the_columns_of_a_group_are_named() -> None:
    """Three of seven columns, the next three, and the last, each group within 80 columns."""
    text = gark("tableau", "methods/gauss6-lobatto7.gark.yaml").out
    heads = re.findall(r"^A\{1,2\}, (.*) =$", text, re.MULTILINE)
    assert heads == ["columns 1 to 3 of 7", "columns 4 to 6 of 7", "column 7 of 7"]
    text = gark("conjugate", "methods/three-colours.gark.yaml").out
    assert "A{1,3}, columns 2 and 3 of 3 =" in text


@pytest.mark.parametrize("command", ["tableau", "show"])
def test_couplings_of_slow_stages_are_shown(command: str) -> None:
    """The matrices of the file: rows that lead from stage to stage, powers of τ, the embedded row."""
    text = gark(command, "mri-gark-erk33a").out
    first, _, second = text.partition("γ of τ^0, embedded = 1/12, -1/3, 7/12, 0\n")
    assert first.endswith(
        "\n\ncouplings: row i leads to the stage after stage i\n\nγ of τ^0 =\n"
        "    1/3   0     0  0\n    -1/3  2/3   0  0\n    0     -2/3  1  0\n\n"
    )
    assert second.startswith(
        "\nγ of τ^1 =\n    0    0  0     0\n    0    0  0     0\n    1/2  0  -1/2  0\n"
    )
    assert "α =\n" in gark(command, "mis4").out
    for name in ("imex-mri-sr32", "imex-mri-gark4"):
        assert max(map(len, gark(command, name).out.splitlines())) <= 80
    assert "coupling" not in gark("tableau", "mri-gark-erk33a", "--format", "latex").out


def test_nothing_is_left_out_silently_and_zero_is_zero() -> None:
    """Blocks of colours that share stages are named where they are not printed again; a zero of the
    transformation of Gauss's method has no exponent.
    """
    text = gark("tableau", "ark-ars222").out
    assert text.endswith("\n\nA{2,·} = A{1,·}\n")
    assert "·" not in gark("tableau", "rk4").out
    assert "0e-" not in gark("tableau", "gauss-2", "--transformation").out
    data = json.loads(gark("tableau", "gauss-2", "--transformation", "--format", "json").out)
    assert data["transformation"]["T"][0][0] == "0"


def test_a_single_step_size_shows_no_order() -> None:
    """The answer says so in words."""
    assert "no order observed, 4 visible: undecided" in gark("converge", "rk4", "--steps", "1").out
