"""What a terminal shows: the words of a pipe, drawn by rich."""

from __future__ import annotations

import io
import os
import re
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from itertools import product
from pathlib import Path
from unittest.mock import patch

import pytest

from garkcli.cli.main import main
from garkcli.page.look import Look
from garkcli.page.safety import written_out
from garkcli.tell.terminal import Terminal
from tests.cli.harness import ASKING, ROOT, gark
from tests.whole import sample

ESCAPE = re.compile(r"\x1b\[[0-9;]*m|\x1b\]8;;(?:https?://[!-~]*)?\x1b\\")
LINES = re.compile(r"[\s─-]+")
FAULTY = "tests/examples/invalid/many-faults.gark.yaml"
RUNS = [
    ("check", "methods/collocation.gark.yaml", "-v"),
    ("check", "tests/examples/failing/collocation-misprinted.gark.yaml"),
    ("check", "methods/rk4.gark.yaml", "tests/examples/failing", FAULTY),
    ("check", FAULTY),
    ("converge", "rk4"),
    ("converge", "heun", "rk4"),
    ("diff", "rk4", "kutta-38"),
    ("trees", "-N", "2", "-n", "3"),
    ("conditions", "--order", "4"),
    ("list", "methods", "heun", "--sort", "order"),
    ("show", "rk4"),
    ("explain", "reducible"),
    ("stability", "heun", "-v"),
]


class _Terminal(io.TextIOWrapper):
    """A stream that is a terminal."""

    def __init__(self, encoding: str) -> None:
        super().__init__(io.BytesIO(), encoding=encoding, write_through=True)

    def isatty(self) -> bool:
        return True

    @property
    def shown(self) -> str:
        assert isinstance(self.buffer, io.BytesIO)
        return self.buffer.getvalue().decode(self.encoding)


def shown(
    *arguments: str, columns: int = 80, encoding: str = "utf-8", cwd: Path = ROOT, **variables: str
) -> str:
    """What a terminal shows of a run, which writes its faults there too."""
    terminal = _Terminal(encoding)
    before = Path.cwd()
    with patch.dict(os.environ, {"TERM": "xterm", "COLUMNS": str(columns), **variables}):
        for name in set(ASKING) - set(variables):
            os.environ.pop(name, None)
        os.chdir(cwd)
        try:
            with (
                redirect_stdout(terminal),
                redirect_stderr(terminal),
                patch("garkcli.page.progress.PATIENCE", 3600.0),
                pytest.raises(SystemExit),
            ):
                main(arguments)
        finally:
            os.chdir(before)
    return terminal.shown


@pytest.mark.parametrize(
    ("run", "columns", "encoding"),
    sample([*product(RUNS, (60, 80), ("utf-8", "ascii"))], 6),
    ids=str,
)
def test_a_terminal_has_the_words_of_a_pipe_in_its_width(
    run: tuple[str, ...], columns: int, encoding: str
) -> None:
    """Without escapes, blanks and lines the text is that of a pipe, and no line is longer than the
    terminal.
    """
    piped = gark(*run, encoding=encoding, COLUMNS=str(columns))
    drawn = ESCAPE.sub("", shown(*run, columns=columns, encoding=encoding))
    assert LINES.sub("", drawn) == LINES.sub("", piped.out + piped.err)
    assert "\x1b" not in drawn
    assert [line for line in drawn.splitlines() if len(line) > columns] == []
    assert drawn.isascii() or encoding == "utf-8"


def test_a_word_that_no_line_holds_is_broken_where_it_is() -> None:
    """A long path begins beside what is before it; a word that fits a line is not broken."""
    d = Terminal(width=20)
    assert d.message("ok  " + "x" * 30, hanging=4) == ["ok  " + "x" * 16, "    " + "x" * 14]
    assert d.message("ok  " + "x" * 10 + " " + "y" * 10, 4) == [
        "ok  " + "x" * 10,
        "    " + "y" * 10,
    ]
    assert d.message("b{l}A{l,m}A{m,n} = 1/24", 2) == ["b{l}A{l,m}A{m,n}", "  = 1/24"]


@pytest.mark.parametrize("columns", [44, 60, 80])
def test_names_and_trees_are_not_broken(columns: int) -> None:
    """One that is too long for its column has a line of its own, as in a pipe."""
    runs = {
        ("list", "methods", "least"): "p-stable-least-error-gauss2-lobatto3",
        ("conditions", "ars-343", "--order", "3"): "[[[]_1]_1]_1",
    }
    for command, name in runs.items():
        lines = ESCAPE.sub("", shown(*command, columns=columns)).splitlines()
        assert any(name in x for x in lines)
        assert max(map(len, lines)) <= columns


def test_heads_of_tables_are_ruled_off() -> None:
    """Below the heads there is a line, in the signs that the terminal has."""
    for encoding, sign in (("utf-8", "─"), ("ascii", "-")):
        lines = ESCAPE.sub("", shown("converge", "rk4", encoding=encoding)).splitlines()
        heads = next(i for i, line in enumerate(lines) if line.split()[:2] == ["h", "error"])
        assert set(lines[heads + 1].strip()) == {sign}
        assert len(lines[heads + 1]) >= len(lines[heads])


def test_colours_are_never_the_only_information() -> None:
    """NO_COLOR and ``--color never`` leave the layout and take every escape."""
    run = ("diff", "rk4", "kutta-38")
    coloured = shown(*run)
    assert "\x1b[1;31m" in coloured
    for plain in (shown(*run, NO_COLOR="1"), shown(*run, "--color", "never")):
        assert plain == ESCAPE.sub("", coloured)


def test_a_dumb_terminal_is_a_pipe() -> None:
    """A terminal that says it can do nothing gets the text of a pipe to the letter."""
    piped = gark("diff", "rk4", "kutta-38")
    assert shown("diff", "rk4", "kutta-38", TERM="dumb") == piped.out


def test_one_file_knows_what_a_terminal_is() -> None:
    """A second rule for it would differ sooner or later."""
    package = ROOT / "garkcli"
    rules = ("isatty", "get_terminal_size", '"TERM"')
    knowing = {
        path.name
        for path in package.rglob("*.py")
        if any(x in path.read_text(encoding="utf-8") for x in rules)
    }
    assert knowing == {"terminal.py"}


def test_sites_are_links(tmp_path: Path) -> None:
    """An address and a DOI lead to their sites, without the full stop behind them; what is no site
    does not, whatever a file says.
    """
    reference = "A. Author, doi:10.1137/0733052 (see https://example.org/a_(b).html). file:///etc"
    method = f"A: [[0]]\nb: [1]\nreference: '{reference}'\n"
    (tmp_path / "m.yaml").write_text(method, encoding="utf-8")
    drawn = shown("show", "m.yaml", cwd=tmp_path, columns=120)
    links = re.findall(r"\x1b\]8;;([!-~]+)\x1b\\", drawn)
    assert links == ["https://doi.org/10.1137/0733052", "https://example.org/a_(b).html"]


def test_what_a_file_says_commands_no_terminal() -> None:
    """Escapes, markup and links in words of a file are shown as text, wherever they are."""
    hostile = "[red]x[/red] \x1b]8;;https://example.org\x1b\\y\x1b]8;;\x1b\\ \x1b[2J"
    d = Terminal(look=Look(True, is_drawn=True), width=200)
    lines = [
        *d.headline(hostile),
        *d.rows([(hostile, hostile)]),
        *d.message(hostile),
        *d.grid(["head"], [[hostile]]),
    ]
    told = "\n".join(lines)
    assert told.count("[red]x[/red]") == told.count(r"\x1b[2J") == 5
    assert ESCAPE.sub("", told).replace("\n", "").isprintable()


def test_a_link_shows_where_it_leads() -> None:
    """A link with the text of another site is written out."""
    for shown_as, is_kept in (
        ("example.org", True),
        ("\x1b[1mexample\x1b[0m", True),
        ("y.org", False),
    ):
        link = f"a \x1b]8;;https://example.org/\x1b\\{shown_as}\x1b]8;;\x1b\\ b"
        assert (written_out(link, coloured=True) == link) is is_kept
        assert "\x1b" not in written_out(link)


def test_the_help_has_the_same_words() -> None:
    """Headings and options are coloured, and nothing else differs."""
    drawn = shown("check", "--help")
    assert ESCAPE.sub("", drawn) == gark("check", "--help").out
    assert "\x1b[36m--baseline\x1b[0m" in drawn
    assert "\x1b[1mOutput\x1b[0m:" in drawn


SCRIPT = """
import sys
from garkcli.cli.main import main
try:
    main(sys.argv[1:])
except SystemExit:
    print("rich" in sys.modules, file=sys.stderr)
"""


@pytest.mark.parametrize("arguments", [("check", "rk4"), ("check", FAULTY), ("check", "--help")])
def test_pipes_do_not_pay_for_the_terminal(arguments: tuple[str, ...]) -> None:
    """Without a terminal rich is not imported."""
    command = [sys.executable, "-c", SCRIPT, *arguments]
    environment = {k: x for k, x in os.environ.items() if k not in ASKING}
    done = subprocess.run(command, cwd=ROOT, env=environment, capture_output=True, text=True)
    assert done.stderr.splitlines()[-1] == "False"
