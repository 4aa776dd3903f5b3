"""Streams of any encoding, streams that are closed, readers that go away, and names that command."""

from __future__ import annotations

import ast
import json
import os
import re
import subprocess
import sys
from itertools import product
from pathlib import Path
from types import ModuleType

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from garkcli.cli.streams import prepare
from garkcli.cli.table import COMMANDS
from garkcli.page.plaintext import ascii_form, plain_line, plain_text
from garkcli.page.safety import escaped, written_out
from tests.cli.harness import ROOT, gark, gark_once
from tests.cli.test_snapshots import RUNS
from tests.whole import in_whole, sample

LONG = {"energy-kepler", "energy-drifting", "converge-several"}
"""Runs that take seconds; what they show is in the others too."""
SHORT = [name for name in RUNS if name not in LONG]
HOSTILE = "x: \x1b[2J\u202egnp\x9b\x07"


def shown_texts() -> list[str]:
    """Every text of the package that may be shown: all but what statements on their own document,
    outside of commands, whose help that is.
    """
    texts = []
    for path in (ROOT / "garkcli").rglob("*.py"):
        source = path.read_text("utf-8")
        if source.isascii() and not re.search(r"\\[uUNx]", source):
            continue  # no sign beyond ASCII
        nodes = list(ast.walk(ast.parse(source)))
        documenting = {id(node.value) for node in nodes if isinstance(node, ast.Expr)}
        if path.parent.name == "cli":
            documenting = set()
        texts += [
            node.value
            for node in nodes
            if isinstance(node, ast.Constant)
            and isinstance(node.value, str)
            and id(node) not in documenting
        ]
    return texts


@in_whole
def test_every_sign_of_the_program_has_an_ascii_form() -> None:
    """Whatever text of the package may be shown, no sign of it becomes a code point, a question
    mark or nothing.
    """
    signs = {sign for text in shown_texts() for sign in text if sign.isprintable()}
    # limits of ranges of signs, and the sign for signs that are not shown
    signs -= {"\U00010000", "\N{REPLACEMENT CHARACTER}"}
    assert len(signs) > 100
    forms = {sign: ascii_form(sign) for sign in signs}
    assert all(form.isascii() for form in forms.values())
    assert [x for x, form in forms.items() if form != x and set(form) & {"\\", "?"}] == []
    assert "" not in forms.values()


@pytest.mark.parametrize(
    ("name", "encoding"), sample([*product(SHORT, ["cp1252", "ascii", "cp437"])], 2)
)
def test_a_run_in_another_encoding(name: str, encoding: str) -> None:
    """Each recorded run ends with the same code and says the same in what the encoding has; nothing
    becomes a question mark or a code point.
    """
    recorded, run = gark_once(*RUNS[name]), gark(*RUNS[name], encoding=encoding)
    assert run.code == recorded.code
    for meant, made in ((recorded.out, run.out), (recorded.err, run.err)):
        assert made.count("?") == meant.count("?")
        assert made.count("\\u") == meant.count("\\u")
        if "check-json" not in name:
            # what is wider in its longer forms goes on in the next line, at any place to break
            assert "".join(made.split()) == "".join(plain_text(meant, encoding).split())


def test_columns_are_as_wide_as_what_is_written() -> None:
    """Where σ and γ need more signs, what is beside them begins in one column all the same; so do
    the facts of a file.
    """
    lines = gark("trees", "-N", "2", "-n", "3", "--root", "1", encoding="ascii").out.splitlines()
    assert lines[1].split() == ["tree", "sigma", "gamma"]
    assert {line.index("o", 20) for line in lines[2:-1] if "[" in line} == {31}
    facts = gark("check", "methods/rk4.gark.yaml", "-v", encoding="ascii").out.splitlines()
    labelled = [line for line in facts if re.match(r" +(B\(|C\(|D\()", line)]
    assert len(labelled) == 3
    assert len({re.match(r" +\S+ +", line).end() for line in labelled}) == 1


def test_powers_are_all_of_one_kind() -> None:
    """An encoding with ¹ and without ⁹ shows 10^19, not 10¹^9."""
    assert plain_line("3.9 · 10¹⁹", "cp1252") == "3.9 · 10^19"
    assert plain_line("3.9 · 10¹⁹", "ascii") == "3.9 * 10^19"


def test_a_bar_is_spelled_on_every_letter() -> None:
    """Ā, one character, and b̄, two, are spelled alike."""
    assert plain_line("Ā, with c and b\N{COMBINING MACRON}", "ascii") == "Abar, with c and bbar"


@given(st.text(), st.sampled_from(["ascii", "cp1252", "cp437", "latin-1"]))
def test_any_text_can_be_written(text: str, encoding: str) -> None:
    """Whatever a file is called, its plain form is in the encoding, and plain text is as it was."""
    text = written_out(text)
    made = plain_text(text, encoding)
    assert made.encode(encoding).decode(encoding) == made
    if text.isascii():
        assert made == text


@pytest.mark.parametrize("format_", ["json", "yaml"])
def test_formats_with_escapes_lose_nothing(format_: str, tmp_path: Path) -> None:
    """Where the stream lacks a sign, JSON and YAML have it as an escape, and read back the same."""
    method = "methods: [{family: gauss, stages: 2}]\nname: Störmer γ 𝟙 中\n"
    (tmp_path / "m.gark.yaml").write_text(method, encoding="utf-8")
    run = gark("conjugate", "m.gark.yaml", "--format", format_, cwd=tmp_path, encoding="cp1252")
    assert run.out.isascii()
    read = json.loads if format_ == "json" else yaml.safe_load
    assert read(run.out)["name"] == "symplectic conjugate of Störmer γ 𝟙 中"


def test_a_file_is_utf_8_whatever_the_stream_is(tmp_path: Path) -> None:
    """``-o`` writes the same bytes from a terminal without Greek."""
    arguments = ("trees", "-n", "4", "-o", "report.txt")
    gark(*arguments, cwd=tmp_path)
    first = (tmp_path / "report.txt").read_bytes()
    gark(*arguments, cwd=tmp_path, encoding="ascii")
    assert (tmp_path / "report.txt").read_bytes() == first
    assert "γ" in first.decode("utf-8")


# -- processes


def shell(command: str, **variables: str) -> subprocess.CompletedProcess[bytes]:
    """What a shell makes of a command in which gark is ``$GARK``."""
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "COLUMNS": "80"}
    environment["GARK"] = f"{sys.executable} -m garkcli"
    environment.update(variables)
    return subprocess.run(
        ["bash", "-c", command], cwd=ROOT, env=environment, capture_output=True, timeout=120
    )


@in_whole
@pytest.mark.parametrize(
    "variables",
    [
        {"PYTHONIOENCODING": "cp1252"},
        {"LC_ALL": "C"},
        {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
        {"LC_ALL": "POSIX", "PYTHONIOENCODING": "ascii:strict"},
    ],
    ids=str,
)
def test_a_process_without_utf_8(variables: dict[str, str]) -> None:
    """The program writes Greek into a pipe of another encoding, without a fault."""
    done = shell("$GARK trees -N 2 -n 3; $GARK --help", **variables)
    assert (done.returncode, done.stderr) == (0, b"")
    questions = sum(row.summary.count("?") for row in COMMANDS.values())
    assert done.stdout.count(b"?") == questions  # those of the help
    assert b"sigma" in done.stdout or "σ" in done.stdout.decode("utf-8")


@pytest.mark.parametrize(
    ("command", "code", "says"),
    [
        ("$GARK check methods/rk4.gark.yaml >&-", 2, b"standard output is closed"),
        ("$GARK --help >&-", 2, b"standard output is closed"),
        ("$GARK check methods/rk4.gark.yaml -q >&-", 0, b""),
        ("$GARK check - <&-", 2, b"standard input is closed"),
        ("$GARK check methods/rk4.gark.yaml <&-", 0, b""),
        ("$GARK check nowhere 2>&-", 2, b""),
        ("$GARK check methods/rk4.gark.yaml <&- >&- 2>&-", 2, b""),
    ],
)
def test_a_closed_stream(command: str, code: int, says: bytes) -> None:
    """A stream that is closed is a problem only of what needs it, and no fault of the program."""
    done = shell(command)
    assert done.returncode == code
    assert says in done.stdout + done.stderr
    assert b"fault" not in done.stderr
    assert b"Traceback" not in done.stderr


@in_whole
def test_a_closed_stream_takes_no_file(tmp_path: Path) -> None:
    """With standard output closed a report in a file is whole, and is not mixed with anything."""
    target = tmp_path / "report"
    done = shell(f"$GARK check rk4 -o {target} <&- >&- 2>&-")
    assert done.returncode == 0
    assert target.read_text() == gark("check", "rk4").out


@in_whole
@pytest.mark.parametrize("command", ["trees -N 3 -n 8", "--help"])
def test_nobody_reads_the_report(command: str) -> None:
    """The exit code is that of a program that SIGPIPE ends, never that of a claim that fails."""
    done = shell(f"$GARK {command} | true; exit ${{PIPESTATUS[0]}}")
    # a short text may be in the pipe before its reader goes
    assert done.returncode in ({141} if "trees" in command else {0, 141})
    assert done.stderr == b""


@in_whole
def test_somebody_stops_reading() -> None:
    """What fills a pipe ends with 141 when its reader stops."""
    done = shell("$GARK trees -N 3 -n 9 --yes | head -1; exit ${PIPESTATUS[0]}")
    assert (done.returncode, done.stderr) == (141, b"")


# -- names that command


@pytest.mark.parametrize(
    "arguments",
    [
        ("tableau", "--format", "text"),
        ("tableau", "--format", "json"),
        ("conjugate", "--format", "yaml"),
        ("check", "--format", "text"),
        ("check", "--format", "json"),
        ("check", "--format", "sarif"),
        ("check", "--format", "junit"),
        ("converge", "--steps", "1/2,1/4"),
        ("converge", "--steps", "1/2,1/4", "--format", "csv"),
        ("energy", "--t-end", "20"),
        ("conditions", "--order", "2"),
    ],
    ids=" ".join,
)
@pytest.mark.parametrize("file", [f"{HOSTILE}.gark.yaml", "a\n::error::b.gark.yaml", "\udcff.yaml"])
def test_a_file_name_gives_no_orders(arguments: tuple[str, ...], file: str, tmp_path: Path) -> None:
    """No sign of a file name reaches a terminal or the runner of a job as an order, for a method
    and for a file that is none, and bytes that are no UTF-8 are no fault.
    """
    for text in ("methods: [{family: gauss, stages: 2}]\n", f'methods: [{{family: "{HOSTILE}"}}]'):
        try:
            (tmp_path / file).write_text(text, encoding="utf-8")
        except UnicodeEncodeError:
            pytest.skip("names of files are ASCII here")
        run = gark(arguments[0], file, *arguments[1:], cwd=tmp_path, GITHUB_ACTIONS="true")
        assert run.code in (0, 2)
        shown = run.out + run.err
        assert all(sign.isprintable() or sign == "\n" for sign in shown)
        assert not any(line.lstrip().startswith("::") for line in shown.splitlines())


def test_options_that_do_not_exist_are_named_harmlessly() -> None:
    """What was typed is shown, and orders nothing."""
    for wrong in ("--a\x1b[2J", "--problem=\x1b[2J\u202e", "-\x9b", "\x1b]0;x\x07"):
        run = gark("converge", "methods/rk4.gark.yaml", wrong)
        assert run.code == 2
        assert all(sign.isprintable() or sign == "\n" for sign in run.out + run.err)
        run = gark(wrong)
        assert run.code == 2
        assert all(sign.isprintable() or sign == "\n" for sign in run.out + run.err)


@given(st.text())
def test_escapes_are_those_of_the_format(text: str) -> None:
    """A JSON text with every sign that does not print written out reads back the same."""
    whole = json.dumps({"name": text}, ensure_ascii=False)
    made = written_out(whole, "json")
    assert made.replace("\n", "").isprintable()
    assert json.loads(made) == {"name": text}
    assert all(json.loads(f'"{escaped(sign, "json")}"') == sign for sign in text[:5])


# -- colour


@pytest.mark.parametrize(
    ("variables", "coloured"),
    [
        ({}, False),
        ({"FORCE_COLOR": "1"}, True),
        ({"FORCE_COLOR": "0"}, False),
        ({"FORCE_COLOR": ""}, False),
        ({"FORCE_COLOR": "1", "NO_COLOR": "1"}, False),
        ({"FORCE_COLOR": "1", "NO_COLOR": ""}, True),
    ],
)
def test_colour_as_the_environment_asks(variables: dict[str, str], coloured: bool) -> None:
    """FORCE_COLOR colours where there is no terminal, reports and errors alike; NO_COLOR wins; an
    option is stronger than both.
    """
    file = "methods/collocation.gark.yaml"
    assert ("\x1b[" in gark("check", file, **variables).out) is coloured
    invalid = "tests/examples/invalid/octal.gark.yaml"
    assert ("\x1b[" in gark("tableau", invalid, **variables).err) is coloured
    assert "\x1b[" in gark("check", file, "--color", "always", **variables).out
    assert "\x1b[" not in gark("check", file, "--color", "never", **variables).out


@given(st.sampled_from("ωαΩ²⁴ᵀ"), st.sampled_from("hqM"))
def test_words_of_two_letters_do_not_run_together(sign: str, letter: str) -> None:
    """A spelled letter beside a letter, and a letter after an exponent, have a gap between them."""
    assert plain_line(f"{sign}{letter}") == f"{ascii_form(sign)} {letter}"
    gap = "" if ascii_form(sign).startswith("^") else " "
    assert plain_line(f"{letter}{sign}") == f"{letter}{gap}{ascii_form(sign)}"


def test_consoles_of_windows_are_told_to_show_colours(monkeypatch: pytest.MonkeyPatch) -> None:
    """There, once; nothing is looked for elsewhere."""
    told: list[str] = []
    console = ModuleType("colorama")
    console.just_fix_windows_console = lambda: told.append("told")  # type: ignore[attr-defined]
    monkeypatch.setitem(sys.modules, "colorama", console)
    prepare()
    assert told == []
    monkeypatch.setattr(sys, "platform", "win32")
    prepare()
    assert told == ["told"]


def test_messages_fit_a_terminal(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What goes to standard error is folded at words for a terminal, excerpts are not; a pipe gets a
    line a message.
    """
    file = tmp_path / "x.yaml"
    file.write_text("A: [[0, 0], [1, 0]]\nb: [1/2, 1/2, and-a-word-that-is-no-number]\n")
    commands = (
        ["show", "x.yaml"],
        ["show", "no-such-method-of-the-catalogue"],
        ["tableau", "rk4", "--digits", "0"],
    )
    piped = [gark(*command, cwd=tmp_path).err for command in commands]
    for module in ("terminal", "cli.streams"):
        name = f"garkcli.{module}.is_terminal"
        monkeypatch.setattr(name, lambda stream: stream is sys.stderr)
    for command, line in zip(commands, piped, strict=True):
        shown = gark(*command, cwd=tmp_path, COLUMNS="44", NO_COLOR="1").err
        assert shown.split() == line.split()
        long = [x for x in shown.splitlines() if len(x) > 44]
        assert all(" " not in x.strip() or "|" in x for x in long)
        assert len(shown.splitlines()) > len(line.splitlines())
