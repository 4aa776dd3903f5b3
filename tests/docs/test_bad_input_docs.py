"""docs/bad-input.md says what the invalid examples are met with, because it is made by running
them.
"""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from garkcli.errors import MethodFileError
from garkcli.glossary.faults import by_code, code_of
from garkcli.methodfile.load import load
from garkcli.report.reference import codes_page, findings_table

ROOT = Path(__file__).resolve().parents[2]
PAGE = ROOT / "docs" / "bad-input.md"
SUFFIX = ".gark.yaml"
WIDTH = 70
"""Characters of a line that are shown."""
LONGEST = 120
"""Characters of a message that are shown."""
HEAD = """# Bad input

gark names every fault of a file or of options in one run: the place, the line with a caret under the text, and the cure.
The exit code is 2. Nothing in a file is ever executed, and no file is met with a traceback. Each kind of fault has a code:
`error[unknown-key]` in text, `code` in JSON, `properties.code` in SARIF. `gark explain CODE` says what is below, and `gark explain` of a message leads to its kind.

## Files that gark does not open or does not quote

Regular files, standard input (`-`) and the streams that a shell hands over (`gark check <(make-method)`) are read. A named pipe, a device or a
socket is refused at once: reading it may never end. Those in a folder are named and left out by `gark import` and `gark audit`.

An error quotes the line that it is about, so a file may be read only where it is what it seems to be. A link in a folder that leads out of it,
and out of the folder we are in, is named and left out. A file that a link leads to from elsewhere, or whose name has no ending, is read where a line begins with a
key of its kind (`A:`, `methods:`, `variables:`, …); otherwise the error says this alone, and quotes nothing. The `paths` of `.gark.toml` stay inside the project.

No command writes over a file that it reads, by whatever name, link or pattern; `gark claims --write` alone changes its files.

## Codes

"""
FINDINGS = """
## Findings of gark check

The rules of SARIF and of `--format github`; those of `gark audit` are [on its page](audit.md#what-is-found).

"""
EXAMPLES = """
## Examples

Made by running every file of `tests/examples/invalid`; of a file with several faults the first is shown.

| kind | code | the line | message | help |
|---|---|---|---|---|
"""


def cell(text: str) -> str:
    """A text as one cell of a Markdown table; ``…`` stands for what does not fit."""
    text = " ".join("".join(x if x.isprintable() else " " for x in text).split())
    text = text if len(text) <= LONGEST else f"{text[: LONGEST - 1].rstrip()}…"
    for sign in "\\`*_|":
        text = text.replace(sign, f"\\{sign}")
    return text.replace("<", "&lt;")


def code(text: str) -> str:
    """A line of a file as code in a cell; nothing where there is no line."""
    text = "".join(
        x if x.isprintable() else "\N{REPLACEMENT CHARACTER}" for x in text.replace("\t", "    ")
    )
    text = " ".join(text.split())
    text = text if len(text) <= WIDTH else f"{text[: WIDTH - 1].rstrip()}…"
    fence = "``" if "`" in text else "`"
    return f"{fence}{text}{fence}".replace("|", "\\|") if text else ""


def around(line: str, column: int) -> str:
    """The part of a long line where the fault is."""
    start = max(0, min(column - 1 - WIDTH // 2, len(line) - WIDTH))
    return ("…" if start else "") + line[start:]


def row(path: Path) -> str:
    """One kind of bad input."""
    with pytest.raises(MethodFileError) as caught:
        load(str(path))
    fault, lines = caught.value.faults[0], caught.value.text.splitlines()
    line = around(lines[fault.line - 1], fault.column) if fault.line <= len(lines) else ""
    kind = path.name.removesuffix(SUFFIX).replace("-", " ")
    told = f"{cell(fault.message)} | {cell(fault.help)}"
    return f"| {kind} | {code_of(fault.message)} | {code(line)} | {told} |\n"


def page() -> str:
    """The whole page."""
    paths = sorted((ROOT / "tests/examples/invalid").glob(f"*{SUFFIX}"))
    rows = "".join(map(row, paths))
    found = findings_table("check")
    return HEAD + codes_page() + FINDINGS + found + EXAMPLES + rows


def test_the_page_is_what_happens() -> None:
    """Every invalid example has its row, with the message that it gets now."""
    wanted = page()
    if os.environ.get("GARK_UPDATE_SNAPSHOTS") == "1":
        PAGE.write_text(wanted, encoding="utf-8")
    assert PAGE.read_text(encoding="utf-8") == wanted


def test_every_row_has_five_cells() -> None:
    """Nothing in a message or a line breaks the table: each row has five cells, and a message."""
    _, _, table = PAGE.read_text(encoding="utf-8").partition(EXAMPLES)
    rows = table.splitlines()
    assert len(rows) == len(list((ROOT / "tests/examples/invalid").glob(f"*{SUFFIX}")))
    for line in rows:
        cells = line.replace("\\|", "").split("|")[1:-1]
        assert len(cells) == 5
        assert cells[0].strip()
        assert cells[1].strip() in by_code()
        assert cells[3].strip()
        assert all(len(x) < 2 * LONGEST for x in cells)


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a|b", "a\\|b"),
        ("a\nb", "a b"),
        ("<b>", "&lt;b>"),
        ("*a_b*", "\\*a\\_b\\*"),
        ("x" * 190, f"{'x' * 119}…"),
    ],
)
def test_a_cell_is_one(text: str, shown: str) -> None:
    """Signs of Markdown are escaped, lines are joined, and what is too long is cut."""
    assert cell(text) == shown


def test_code_is_one_cell() -> None:
    """Code keeps its signs; a pipe is escaped as tables ask for, and a backtick does not end it."""
    assert code("a|b *c*") == "`a\\|b *c*`"
    assert code("a`b") == "``a`b``"
    assert code("") == ""
