"""Mistakes in the arguments have a cure."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from garkcli.cli import options
from garkcli.cli.command import declaration_of
from garkcli.cli.options import Value, rules_of
from garkcli.cli.table import COMMANDS
from garkcli.cli.usage import MEANT
from garkcli.families.registry import FAMILIES
from garkcli.glossary.faults import code_of
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole


@pytest.mark.parametrize(
    ("line", "cure"),
    [
        ("RK4", "gark check RK4"),
        ("mine.gark.yaml", "gark check mine.gark.yaml"),
        ("order rk4", "did you mean 'check'?"),
        ("chekc rk4", "did you mean 'check'?"),
        ("check", "name a file, a folder, or a method of the catalogue"),
        ("tableau", "name a file, or a method of the catalogue"),
        ("check rk4 -format json", "several letters begin with --"),
        ("check rk4 --max-order five", "'five' is not a whole number"),
        ("check rk4 --format jsn", "did you mean 'json'?"),
        ("conditions rk4 3", "an order is --order 3"),
        ("export rk4", "gark list exports shows"),
        ("list rk4", "gark list methods rk4"),
        ("list method", "did you mean 'methods'?"),
    ],
)
def test_a_mistake_has_its_cure(line: str, cure: str) -> None:
    """The last line says what is wrong and what to write; the exit code is that of usage."""
    run = gark(*line.split())
    assert (run.code, run.out) == (2, "")
    assert cure in run.err.splitlines()[-1]


def test_words_that_are_meant_are_commands() -> None:
    """None is a command itself, and what each stands for is one."""
    assert not MEANT.keys() & COMMANDS.keys()
    assert {*MEANT.values()} <= COMMANDS.keys()


@in_whole
@pytest.mark.parametrize("arguments", [["convert", "rk4", "--to", "tableau"], ["new", "--zzz"]])
def test_a_mistake_fits_the_terminal(arguments: list[str]) -> None:
    """Its lines are as long as those of the terminal, with the same words that a pipe gets in one
    line; arguments are no options.
    """
    pty = pytest.importorskip("pty", reason="there are no pseudo-terminals")
    ours, theirs = pty.openpty()
    command = [sys.executable, "-m", "garkcli", *arguments]
    environment = {**os.environ, "COLUMNS": "60"}
    subprocess.run(command, stderr=theirs, env=environment, cwd=ROOT, check=False)
    os.close(theirs)
    shown = os.read(ours, 10_000).decode().splitlines()
    os.close(ours)
    assert max(map(len, shown[2:])) <= 60
    piped = subprocess.run(
        command, stderr=subprocess.PIPE, env=environment, cwd=ROOT, text=True, check=False
    ).stderr
    assert " ".join(" ".join(shown).split()) == " ".join(piped.split())
    assert "one of: file" not in piped


def test_rules_name_options_of_their_commands() -> None:
    """Every option that needs or excludes another is one of its command, and what is said of it is
    of the kind that the rule has.
    """
    rules = [(name, rule) for name in COMMANDS for rule in rules_of(declaration_of(name).options)]
    assert len(rules) > 40
    for name, rule in rules:
        known = [id(option) for option in declaration_of(name).all_options]
        for each in (*rule.options, *rule.others):
            assert id(each.option if isinstance(each, Value) else each) in known, name
        assert code_of(rule.message) == rule.code


def test_every_option_is_read() -> None:
    """Its command reads the value by its name, or hands it to the function that it is an argument
    of.
    """
    for name, row in COMMANDS.items():
        text = Path(ROOT, "garkcli", "cli", f"{row.file}.py").read_text(encoding="utf-8")
        text += Path(options.__file__).read_text(encoding="utf-8")
        for field, declared in options.declared_by(declaration_of(name).options).items():
            parts = declared if isinstance(declared, tuple) else ()
            owners = {x.of.partition(".")[0] for x in parts}
            is_passed = any(f'.of("{owner}")' in text for owner in owners)
            assert is_passed or re.search(rf"\b(given|self|_given)\.{field}\b", text), (name, field)


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("check rk4 --pair", "no such option --pair\nhelp: it belongs to gark report, plot,"),
        ("check rk4 --choose", "no such option --choose\nhelp: it belongs to gark design"),
        ("audit", "Missing argument 'PATH...'\nhelp: name a file or a folder"),
        ("stability rk4 --pair --conjugate", "--pair and --conjugate are two methods"),
        ("stability rk4 --slow 1", "--slow and --fast belong together"),
        ("stability rk4 --order-star", "--order-star is for the picture"),
        ("trees 3 -n 4", "the order is given twice"),
        ("trees 3 --members", "--members is about free trees"),
        ("trees 3 --symplectic --root 1", "free trees have no root"),
        ("trees 3 --document", "--document goes with --format latex"),
        ("conditions --sort worst", "--sort: values are those of a method"),
        ("conditions rk4 --shapes", "the colours are those of FILE"),
        ("conditions --set a=1", "--set is for the parameters of FILE"),
        ("convert rk4 --to reduced --stages 3", "--stages adds stages"),
        ("design rk4 --seed 0", "--seed goes with --search"),
        ("design rk4 --slow 1 --fast 1 --a-stable", "--slow and --fast say on which springs"),
        ("energy rk4 --modified --max-error 1", "--max-error does not go with --modified"),
        ("export rk4 --to c --test", "--test writes further files beside the first"),
        ("new x.yaml -o y.yaml", "FILE and -o at once"),
    ],
)
def test_options_that_do_not_go_together(line: str, said: str) -> None:
    """They are refused before anything is read, with the option that was given."""
    run = gark(*line.split())
    assert (run.code, run.out) == (2, "")
    assert said in run.err


@pytest.mark.parametrize(
    ("line", "more"),
    [
        ("trees 5", "╰─┴┬┴─╯"),
        ("conditions rk4 -n 2", "is 1/2"),
        ("check rk4", "positive weights      yes"),
        ("stability rk4", "trace"),
        ("show rk4", "diagonally implicit   no"),
        ("list families", "sequence harmonic, romberg, bulirsch"),
        ("list problems", "trees    the unbranched trees"),
        ("list transfer", "blocks   both"),
        ("cite kvaerno-4", "% coefficients: SUNDIALS"),
        ("modified rk4", "0.0003472"),
        ("tableau rk4", "weights sum  1"),
        ("tableau gauss-2", "0.538675134595"),
        ("conjugate rk4", "Â_ij = b_j − b_j a_ji / b_i"),
        ("convert rk4", "# rk4 against the method below: identical: every entry is the same"),
        ("diff rk4 kutta-38", "form    a Runge-Kutta method"),
        ("claims rk4", "# order: 4, proved; order 5 fails at [[[[[]]]]] by -1/120"),
        ("certificate rk4 --format text", "order 1  []"),
    ],
)
def test_more_is_shown_where_more_is_wanted(line: str, more: str) -> None:
    """What -v adds is not in the usual report."""
    usual, full = gark(*line.split()), gark(*line.split(), "-v")
    assert usual.code == full.code
    assert more not in usual.out
    assert more in full.out


def test_less_of_a_list_is_its_size() -> None:
    """-q leaves the heading."""
    assert gark("list", "families", "-q").out == f"{len(FAMILIES)} families\n"


@pytest.mark.parametrize(
    ("line", "left"),
    [
        ("conditions rk4", "8 conditions, all hold\n"),
        ("trees 4", "4 trees\n"),
        ("trees 20 --count", "  order 20  12826228\n"),
    ],
)
def test_less_of_trees_and_conditions_is_their_number(line: str, left: str) -> None:
    assert gark(*line.split(), "-q").out == left


@pytest.mark.parametrize(
    "arguments",
    [("check", "a\0b"), ("check", "rk4", "-o", "a\0b"), ("converge", "rk4", "--plot", "a\0.png")],
)
def test_no_argument_has_nul(arguments: tuple[str, ...]) -> None:
    """No shell can give it, but a program that calls ``main`` can: bad input, not our fault."""
    run = gark(*arguments)
    assert (run.code, "the character NUL" in run.err) == (2, True)


@pytest.mark.parametrize(
    ("arguments", "cure"),
    [
        (("-",), "it stands for a file behind a command, as in gark check -"),
        (("import", "methods/rk4.gark.yaml"), "gark check methods/rk4.gark.yaml reads it"),
        (
            ("modified", "gauss-2", "--problem", "logistic"),
            "take one with energy, such as pendulum",
        ),
        (("explain", "foo"), "gark explain lists the terms"),
        (("energy", "ros3p"), "gark stability and plot know them"),
    ],
)
def test_what_cannot_be_done_names_what_can(arguments: tuple[str, ...], cure: str) -> None:
    """The help after a refusal is a way on, not a word that nobody meant."""
    run = gark(*arguments)
    assert run.code == 2
    assert cure in run.err
    assert "did you mean" not in run.err
