"""Texts fit the terminal, and numbers are decimals where that is asked for."""

from __future__ import annotations

import csv
import io
import json
import re
from pathlib import Path

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from garkcli.cli.main import COMMANDS
from garkcli.page.lines import folded
from garkcli.page.plaintext import broken, plain_line, plain_text
from tests.cli.harness import gark
from tests.whole import in_whole

RUNS = [
    ("list",),
    *(("list", what, "-v") for what in ("families", "transfer", "problems")),
    ("--help",),
    ("trees", "-n", "7"),
    ("trees", "--tree", "[" * 40 + "[]_1,[]_1" + "]_1" * 40),
    ("conditions", "-n", "7"),
    ("conditions", "--symplectic", "-n", "6"),
    ("conditions", "-N", "2", "-n", "4", "--coloured"),
    ("conditions", "methods/rectangular.gark.yaml", "-n", "5"),
    pytest.param(
        ("conditions", "methods/collocation.gark.yaml", "-n", "5", "--pair", "--failing"),
        marks=in_whole,
    ),
    ("conditions", "methods/stoermer-verlet.gark.yaml", "-n", "3", "--pair", "--failing"),
    *((command, "--help") for command in COMMANDS),
]
OF_FILES = [
    ("check", "methods/collocation.gark.yaml"),
    ("check", "methods/ark-ars222.gark.yaml", "--error-constants"),
    ("check", "tests/examples/failing/collocation-misprinted.gark.yaml"),
    ("tableau", "methods/collocation-conjugate.gark.yaml"),
    ("conjugate", "methods/collocation.gark.yaml", "--pair"),
    ("conjugate", "methods/interpolation-conjugate.gark.yaml"),
    ("conjugate", "methods/three-colours.gark.yaml"),
    ("tableau", "methods/gauss6-lobatto7.gark.yaml"),
    ("tableau", "methods/collocation.gark.yaml", "--digits", "40"),
    ("stability", "methods/ark-ars222.gark.yaml"),
    ("stability", "methods/rectangular.gark.yaml"),
    ("converge", "methods/stoermer-verlet.gark.yaml"),
    pytest.param(
        ("converge", "methods/rk4.gark.yaml", "methods/ark-ars222.gark.yaml"), marks=in_whole
    ),
    ("energy", "methods/rectangular.gark.yaml"),
]


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
@pytest.mark.parametrize("run", RUNS, ids=lambda run: " ".join(run)[:40])
def test_a_text_fits_80_columns(run: tuple[str, ...], encoding: str) -> None:
    """No line is wider than the terminal, however long its formula or tree is."""
    lines = gark(*run, encoding=encoding).out.splitlines()
    assert [line for line in lines if len(line) > 80] == []


@pytest.mark.parametrize("run", OF_FILES, ids=lambda run: " ".join(run)[:40])
def test_a_report_of_a_file_fits_80_columns_in_ascii(run: tuple[str, ...]) -> None:
    """So does every line of a report that does not name a file, whose path may be long."""
    lines = gark(*run, encoding="ascii").out.splitlines()
    assert len(lines) > 3
    wide = [line for line in lines if len(line) > 80]
    assert [line for line in wide if ".gark.yaml" not in line] == []


def test_a_line_is_broken_in_ascii_alone() -> None:
    """What ASCII makes too wide goes on in the next line with every word; other lines stay."""
    meant = "  bound            4 = min{r, 2η+2, ξ+1, η+ζ+1}   r = 4, η = 2, ζ = 1, ξ = 4"
    wide = f"{meant} and more, which is wide anyway"
    assert len(meant) <= 80 < len(wide)
    first, second = plain_text(meant, "ascii", 80).split("\n")
    assert first == "  bound            4 = min{r, 2eta+2, xi+1, eta+zeta+1}"
    assert second == "      r = 4, eta = 2, zeta = 1, xi = 4"
    assert "\n" not in plain_text(meant, "utf-8", 80)
    assert "\n" not in plain_text(wide, "ascii", 80)
    assert "\n" not in plain_text(meant, "ascii")


@example("   ζζa", 12)  # what hangs leaves no room for two words
@given(st.text(alphabet="ab ηζ𝟙", max_size=60), st.integers(12, 30))
def test_breaking_loses_no_word(text: str, width: int) -> None:
    """A broken line has the words of the line, and is too wide only in a word that is."""
    line = f"  {plain_line(text)}"
    lines = broken(line, width)
    assert " ".join(lines).split() == line.split()
    for one in lines:
        assert len(one) <= width or len(one.split()) == 1


def test_the_conjugate_is_no_power_in_ascii() -> None:
    """Â is a letter with a hat: A^ before the colours of a block would be read as an exponent."""
    found = plain_line("conjugate nodes  yes, Â{l,m}𝟙 = c{l} for every block")
    assert "Ahat{l,m} 1 = c{l}" in found
    assert "^" not in found


def test_gaps_between_columns_keep_two_blanks() -> None:
    """What longer forms take is given back by gaps, but for two blanks that part the columns."""
    row = "[[]]   σ = 1  γ = 2      b{l}ᵀA{l,m}𝟙 = 1/2"
    plain = plain_line(row)
    assert plain == "[[]]   sigma = 1  gamma = 2  b{l}^T A{l,m} 1 = 1/2"
    assert re.split("  +", plain) == [plain_line(x) for x in re.split("  +", row)]


def test_folding_loses_nothing() -> None:
    """A formula in lines is the formula, and only what has no place to break is too wide."""
    text = "b{l}ᵀ((A{l,m}A{m,n}𝟙) ⊙ (A{l,u}𝟙) ⊙ (A{l,v}𝟙)) = 1/12   ∀ l,m,n,u,v"
    for width in range(12, 80):
        lines = folded(text, width, "  ")
        assert "".join(line.strip() for line in lines).replace(" ", "") == text.replace(" ", "")
        assert all(len(line) <= max(width, 16) for line in lines)


@pytest.mark.parametrize("format_", ["text", "json", "csv", "latex"])
def test_conditions_in_decimals(format_: str) -> None:
    """--digits writes values and residuals in decimals, in every format; they are the exact ones,
    rounded.
    """
    arguments = ("conditions", "methods/rk4.gark.yaml", "-n", "5", "--only", "--format", format_)
    exact, rounded = (gark(*arguments).out, gark(*arguments, "--digits", "4").out)
    assert exact != rounded
    if format_ == "json":
        pairs = zip(json.loads(exact)["conditions"], json.loads(rounded)["conditions"], strict=True)
        for before, after in pairs:
            for key in ("value", "required", "residual"):
                numerator, _, denominator = before[key].partition("/")
                meant = int(numerator) / int(denominator or 1)
                assert float(after[key]) == pytest.approx(meant, rel=1e-3)
                assert "/" not in after[key]
    if format_ == "text":
        assert not re.search(r"is -?[0-9]+/", rounded)
    assert gark("conditions", "--digits", "4").code == 2


def test_names_in_csv_are_no_formulas(tmp_path: Path) -> None:
    """A method with the name of a formula is text in a spreadsheet; numbers stay numbers."""
    for name in ("=1+1", "@SUM(A1)"):
        text = f'methods: [{{family: gauss, stages: 1}}]\nname: "{name}"\n'
        (tmp_path / f"{name[1]}.gark.yaml").write_text(text)
    arguments = ("converge", ".", "--problem", "oscillator", "--steps", "1/2,1/4")
    run = gark(*arguments, "--format", "csv", cwd=tmp_path)
    heads, *rows = csv.reader(io.StringIO(run.out))
    assert {row[heads.index("method")] for row in rows} == {"'=1+1", "'@SUM(A1)"}
    assert all(float(row[heads.index("h")]) > 0 for row in rows)


RK4 = """
A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/2, 0, 0], [0, 0, 1, 0]]
b: [1/6, 1/3, 1/3, 1/6]
expect: {order: 4}
"""
COUPLED = """
methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]
transfer: collocation
"""

WIDE = [
    ("check", "--error-constants", "coupled.yaml"),
    ("check", "broken.yaml"),
    ("stability", "--help"),
    ("energy", "--help"),
]


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
@pytest.mark.parametrize("run", [("list",), *WIDE], ids=lambda run: run[0])
def test_a_text_fits_80_columns_in_ascii_too(
    run: tuple[str, ...], encoding: str, tmp_path: Path
) -> None:
    """Hints, error constants and helps leave room for the longer ASCII forms of their signs."""
    broken = RK4.replace("1/2, 0, 0]", "1/3, 0, 0]")
    assert broken != RK4
    (tmp_path / "broken.yaml").write_text(broken, encoding="utf-8")
    (tmp_path / "coupled.yaml").write_text(COUPLED, encoding="utf-8")
    found = gark(*run, cwd=tmp_path, encoding=encoding)
    lines = found.out.splitlines()
    too_wide = [line for line in lines if len(line) > 80]
    assert too_wide == []


def test_the_lists_are_columns() -> None:
    """Every entry of gark list begins in the column of its section, and fits 80 columns."""
    sections = gark("list").out.split("\n\n")[1:3]
    for section in sections:
        entries = section.splitlines()[1:]
        begin = [re.match(r"(?:  \S+)?\s+", line) for line in entries]
        assert len({x and x.end() for x in begin}) == 1
        assert max(map(len, entries)) <= 80


def test_a_cut_column_keeps_its_line_in_ascii() -> None:
    """Three dots in place of a sign take room from the text: each method has one line, as it has
    in Unicode.
    """
    plain, ascii_ = (
        gark("list", "methods", "--sort", "order", encoding=x).out for x in ("utf-8", "ascii")
    )
    assert "..." in ascii_
    assert len(ascii_.splitlines()) == len(plain.splitlines())
    assert max(map(len, ascii_.splitlines())) <= 80
