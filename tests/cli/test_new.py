"""gark new: files from tableaus as they are pasted, and from families, with true claims."""

from __future__ import annotations

import io
import sys
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from garkcli import load, loads
from garkcli.check.check_file import check_file
from garkcli.cli.building import of_tableau_text
from garkcli.errors import MethodError, MethodFileError
from garkcli.methodfile.file_keys import KEYS
from garkcli.methodfile.pasted import Pasted, read_pasted
from tests.cli.harness import gark

RK4 = """
0   |
1/2 | 1/2
1/2 | 0    1/2
1   | 0    0    1
----+--------------------
    | 1/6  1/3  1/3  1/6
"""
IN_LATEX = r"""
0 & 0 & 0 \\
2/3 & 2/3 & 0 \\
\hline
 & 1/4 & 3/4 \\
 & 1 & 0
"""
NUMBERS = st.sampled_from(["0", "1", "-1/2", "1/3", "sqrt(2)/2", "0.25"])


def test_a_tableau_of_a_book(tmp_path: Path) -> None:
    """The classical method as it is printed: order 4 is claimed, and it is true."""
    path = tmp_path / "classical.gark.yaml"
    run = gark("new", str(path), "--tableau", "-", stdin=RK4)
    assert run.code == 0
    method = load(str(path))
    assert method.name == "classical"
    outcome = check_file(str(path))
    assert ("order", "4") in {(x.claim, x.found) for x in outcome.claims}
    assert outcome.ok
    assert method.tableau == load("methods/rk4.gark.yaml").tableau


@pytest.mark.parametrize(
    ("tableau", "said"),
    [
        ("0|;1/2|1/2;1/2|0 1/3;1|0 0 1;|1/6 1/3 1/3 1/6", "a[3,2] = 1/2 instead of 1/3"),
        ("0|;1/2|1/2;1/2|0 1/3;1|0 0 1;|1/6 1/3 1/3 1/6", "row 3 has the sum 1/3"),
        ("0|;0.3333333333|0.3333333333;0.6666666667|0 0.6666666667;|0.25 0 0.75", "tolerance: "),
    ],
)
def test_a_slip_is_hinted_at_and_not_claimed(tableau: str, said: str, tmp_path: Path) -> None:
    """The hints are those of gark check, which has them still when it reads the file."""
    path = tmp_path / "slip.yaml"
    run = gark("new", str(path), "--tableau", tableau)
    assert (run.code, said in run.err) == (0, True)
    assert "without claims" in run.err
    assert not load(str(path)).claims
    assert said in " ".join(gark("check", str(path)).out.split())
    assert "hint" not in gark("new", "--tableau", RK4).err


def test_comments_say_what_keys_mean() -> None:
    """They are the first words of what is declared of each key."""
    run = gark("new", "--tableau", "0 |; 1/2 | 1/2; | 0 1; | 1 0")
    lines = run.out.splitlines()
    assert "# the matrix of a Butcher tableau, row by row" in lines
    told = {line.partition(":")[0]: line.partition("# ")[2] for line in lines if "  # " in line}
    assert set(told) == {"b", "c", "embedded"}
    assert all(KEYS[key].text.lower().startswith(comment) for key, comment in told.items())


def test_a_line_on_standard_input() -> None:
    """Semicolons part lines there too."""
    text = "0 |; 1/2 | 1/2; | 0 1"
    piped = gark("new", "--tableau", "-", stdin=text)
    assert piped.code == 0
    assert piped.out == gark("new", "--tableau", text).out


def test_standard_input_is_text(monkeypatch: pytest.MonkeyPatch) -> None:
    """Bytes that are no UTF-8 are a fault of the input."""
    stream = io.TextIOWrapper(io.BytesIO(b"0 |\n\xff | 1\n"), "utf-8")
    monkeypatch.setattr(sys, "stdin", stream)
    with pytest.raises(MethodFileError, match="not UTF-8"):
        of_tableau_text("a method", "-")


def test_a_tableau_in_latex() -> None:
    """Signs of LaTeX part nodes and rows; a second line of weights is embedded."""
    found = read_pasted(IN_LATEX)
    assert found == Pasted((("0", "0"), ("2/3", "0")), ("1/4", "3/4"), ("0", "2/3"), ("1", "0"))


@pytest.mark.parametrize(
    "text",
    [
        "0\t\t\n1/2\t1/2\t\n1\t−1\t2\n\t1/6\t2/3\t1/6",
        "0,,,\n1/2,1/2,,\n1,-1,2,\n,1/6,2/3,1/6\n",
        "0 | \n½ | ½\n1 | −1 2\n--+--\n | 1/6 2/3 1⁄6",
        "0\n1/2 | 1/2\n1 | -1 2\n | 1/6 2/3 1/6",
        r"""\begin{array}{c|ccc} 0 & & & \\ \frac12 & \frac{1}{2} & & \\
        $1$ & -1 & 2 \\[1ex] \hline & \dfrac{1}{6} & \frac{2}{3} & 1/6 \end{array}""",
    ],
    ids=["page", "spreadsheet", "book", "bare", "latex"],
)
def test_a_tableau_from_elsewhere(text: str) -> None:
    """Kutta's method off a page, a spreadsheet, a book and a paper."""
    assert read_pasted(text) == Pasted(
        (("0", "0", "0"), ("1/2", "0", "0"), ("-1", "2", "0")),
        ("1/6", "2/3", "1/6"),
        ("0", "1/2", "1"),
    )


def test_an_empty_cell_is_zero() -> None:
    """One in the middle of a row does not move those behind it to its place; a table without nodes
    has an entry before the first weight.
    """
    rows = r"0 & & & \\ 1/2 & 1/2 & & \\ 1/2 & & 1/2 & \\ & 0 & 0 & 1"
    found = read_pasted(rows.replace(r"\\", r"\\" + "\n"))
    assert found.A[2] == ("0", "1/2", "0")
    assert read_pasted("0\t0\t0\n\t1\t0\n0\t\t1/2\n1/6\t2/3\t1/6") == Pasted(
        (("0", "0", "0"), ("0", "1", "0"), ("0", "0", "1/2")), ("1/6", "2/3", "1/6")
    )


def test_a_sign_that_is_a_sum_is_left_alone() -> None:
    """1½ is not 11/2."""
    run = gark("new", "--tableau", "0 |; 1½ | 1; | 0 1")
    assert run.code == 2
    assert "write 1/2" in run.err


def test_families(tmp_path: Path) -> None:
    """Two families are coupled by collocation where no rule is named."""
    run = gark("new", "--family", "gauss:2", "--family", "lobatto-iiia:3")
    method = loads(run.out)
    assert method.tableau == load("methods/collocation.gark.yaml").tableau
    path = tmp_path / "one.gark.yaml"
    run = gark("new", "-o", str(path), "--family", "gauss:3", "--name", "x: y")
    assert load(str(path)).name == "x: y"
    assert check_file(str(path)).ok


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ([], "a new method needs --tableau or --family"),
        (["--tableau", "0;1/2 1/2;0 1"], "nodes may come first"),
        (["--tableau", "1"], "no tableau"),
        (["--tableau", "[[0,0],[1/2,0]] [0,1]"], "in brackets belongs"),
        (["--tableau", "0 |; 0,5 | 0,5; | 0 1"], "with a point: 0.5"),
        (["--tableau", "0 | 0;1 | 1"], "no line of weights"),
        (["--tableau", "1;1/2 | 1/2; | 0 1"], "no line of weights"),
        (["--tableau", "0 | 0 1;| 1"], "row 1 has 2 entries"),
        (["--tableau", "0 | 0;| 1 2"], "2 weights for 1 stage"),
        (["--tableau", "0 | 0;|1;|1;|1"], "3 lines follow"),
        (["--tableau", "0 | 0;| y"], "'y' is not a parameter"),
        (["--tableau", "0 | 0;| 1", "--family", "gauss:2"], "at once"),
        (["--tableau", "0 | 0;| 1", "--transfer", "x"], "goes with --family"),
        (["--family", "gauss"], "a name and stages are expected"),
        (["--family", "gaus:2"], "did you mean 'gauss'?"),
        (["x", "-o", "y", "--family", "gauss:2"], "FILE and -o at once"),
    ],
)
def test_what_makes_no_file(arguments: list[str], said: str) -> None:
    """One fault each, with its cure."""
    run = gark("new", *arguments)
    assert run.code == 2
    assert said in run.err
    assert "help: " in run.err


def test_no_file_is_lost(tmp_path: Path) -> None:
    """What is there is written over on demand alone."""
    path = tmp_path / "a.gark.yaml"
    path.write_text("mine", encoding="utf-8")
    arguments = ("new", str(path), "--family", "gauss:1")
    assert "is there already" in gark(*arguments).err
    assert path.read_text(encoding="utf-8") == "mine"
    assert gark(*arguments, "--force").code == 0


@given(
    st.integers(2, 4).flatmap(
        lambda s: st.tuples(
            st.lists(st.lists(NUMBERS, min_size=s, max_size=s), min_size=s, max_size=s),
            st.lists(NUMBERS, min_size=s, max_size=s),
            st.lists(NUMBERS, min_size=s, max_size=s),
        )
    ),
    st.sampled_from(["|", " | ", " & "]),
)
def test_full_rows(parts: tuple[list[list[str]], list[str], list[str]], bar: str) -> None:
    """A full matrix with nodes and weights is read as it was written, with bars and without."""
    A, b, c = parts
    rows = [f"{node}{bar}{' '.join(row)}" for node, row in zip(c, A, strict=True)]
    last = f"{bar}{' '.join(b)}"
    wanted = Pasted(tuple(map(tuple, A)), tuple(b), tuple(c))
    assert read_pasted("\n".join([*rows, last])) == wanted
    plain = [" ".join([node, *row]) for node, row in zip(c, A, strict=True)]
    assert read_pasted("\n".join([*plain, " ".join(b)])) == wanted


@given(st.text(alphabet="0123456789/|&;-+ \n\\xsqrt()", max_size=60))
def test_whatever_is_pasted(text: str) -> None:
    """It is a tableau of one shape, or an error with a cure."""
    found = None
    cure = ""
    try:
        found = read_pasted(text)
    except MethodError as error:
        cure = error.help
    if found is None:
        assert cure
        return
    assert {len(row) for row in found.A} == {len(found.A)} == {len(found.b)}


def test_it_asks(monkeypatch: pytest.MonkeyPatch) -> None:
    """At a terminal the tableau is asked for line by line."""
    monkeypatch.setattr("garkcli.cli.building.is_terminal", lambda _: True)
    answers = "midpoint\ntableau\n0 |\n1/2 | 1/2\n| 0 1\n\n"
    run = gark("new", stdin=answers)
    assert run.code == 0
    assert "A:\n  - [0, 0]\n  - [1/2, 0]\nb: [0, 1]" in run.out
    answers = "pair\nfamilies\ngauss:1\nlobatto-iiia:2\n\ninterpolation\n"
    run = gark("new", stdin=answers)
    assert run.code == 0
    assert "transfer: interpolation" in run.out
