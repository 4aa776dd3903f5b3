"""What is run is the method that was given, however its file spells it; ``--pair`` and
``--conjugate`` take another one, by the same words everywhere.
"""

from __future__ import annotations

import json
from itertools import product
from pathlib import Path
from typing import Any

import pytest

import garkcli
from garkcli.cli.main import COMMANDS
from tests.cli.harness import gark, gark_once
from tests.whole import in_whole, sample

COLLOCATION = "methods/collocation.gark.yaml"
ROUNDED = """
A: [[0, 0, 0], [0.5, 0, 0], [0, 0.75, 0]]
b: [0.22222222, 0.33333333, 0.44444444]
tolerance: 1e-8
"""
EXPLICIT = "{A: [[0, 0], [1/2, 0]], b: [0, 1]}"
TAKERS = (
    "conditions",
    "converge",
    "energy",
    "export",
    "modified",
    "report",
    "plot",
    "stability",
    "tableau",
)
"""The commands that take the conjugate and the pair."""
RUNS: dict[str, tuple[str, ...]] = {
    "converge": ("--problem", "kepler", "--format", "json"),
    "energy": ("--problem", "kepler", "--t-end", "20", "--format", "json"),
    "modified": ("-n", "3", "--format", "json"),
    "stability": ("--format", "json"),
    "tableau": ("--format", "json"),
    "conditions": ("-n", "2", "--format", "json"),
    "export": ("--to", "json"),
}
"""Commands with arguments for JSON."""


def data(*arguments: str) -> Any:
    """The JSON of a run that is well."""
    run = gark_once(*arguments)
    assert run.code in {0, 1, 3}, run.err
    return json.loads(run.out)


def without_names(found: Any) -> Any:
    """A report without what it is called."""
    if isinstance(found, list):
        return [without_names(x) for x in found]
    if isinstance(found, dict):
        return {
            k: without_names(v) for k, v in found.items() if k not in {"file", "name", "reference"}
        }
    return found


@pytest.fixture(scope="module")
def spelled_out(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The method of ``COLLOCATION``, block by block."""
    path = tmp_path_factory.mktemp("methods") / "spelled-out.gark.yaml"
    path.write_text(garkcli.convert(COLLOCATION, "gark").method.text, encoding="utf-8")
    assert gark("diff", COLLOCATION, str(path)).code == 0
    return str(path)


@pytest.mark.parametrize("which", [(), ("--pair",), ("--conjugate",)])
@pytest.mark.parametrize("command", RUNS)
def test_one_method_has_one_answer(command: str, which: tuple[str, ...], spelled_out: str) -> None:
    """Diagonal methods with a transfer rule, and the blocks that it makes: ``gark diff`` calls them
    identical, and every number is the same.
    """
    first, second = (data(command, x, *which, *RUNS[command]) for x in (COLLOCATION, spelled_out))
    assert without_names(first) == without_names(second)


@pytest.mark.parametrize("problem", ["oscillator", "pendulum"])
def test_an_unsymplectic_method_runs_as_one(problem: str) -> None:
    """``gark energy`` no longer calls symplectic what ``gark check`` does not."""
    energy = data("energy", COLLOCATION, "--problem", problem, "--t-end", "20", "--format", "json")
    assert energy["symplectic"]["proved"] is False
    pair = data(
        "energy", COLLOCATION, "--pair", "--problem", problem, "--t-end", "20", "--format", "json"
    )
    assert pair["symplectic"]["proved"] is True


@pytest.mark.parametrize(
    ("which", "word"), [((), ""), (("--pair",), "pair"), (("--conjugate",), "conjugate")]
)
@pytest.mark.parametrize("command", RUNS)
def test_json_says_which_method_it_is(command: str, which: tuple[str, ...], word: str) -> None:
    """In one field, and in the name where the report has one."""
    found = data(command, COLLOCATION, *which, *RUNS[command])
    (found,) = found["files"] if command == "stability" else (found,)
    assert found["derivation"] == word
    if "name" in found:
        name = "Gauss 2 and Lobatto IIIA 3, coupled by collocation"
        assert found["name"] == (f"symplectic {word} of {name}" if word else name)


@pytest.mark.parametrize(
    ("arguments", "first", "later"),
    [
        pytest.param(
            ("converge", "rk4", "--pair", "--problem", "kepler"),
            "symplectic pair of the classical",
            "predicted order  4",
            marks=in_whole,
        ),
        (("converge", "rk4", "--problem", "kepler"), "the classical", "predicted order  4"),
        pytest.param(
            ("converge", "rk4", "heun", "--conjugate", "--problem", "kepler"),
            "2 methods",
            "symplectic conjugate of Heun",
            marks=in_whole,
        ),
        (
            ("converge", "rk4", "heun", "--conjugate", "--steps", "1/8,1/16,1/32"),
            "2 methods",
            "symplectic conjugate of Heun",
        ),
        (
            ("energy", "rk4", "--pair"),
            "symplectic pair of the classical",
            "by the coefficients of the pair",
        ),
        (
            ("energy", "heun", "--conjugate", "--t-end", "9", "--problem", "pendulum"),
            "symplectic conjugate of Heun",
            "not proved by the coefficients of the conjugate",
        ),
        (
            ("modified", "rk4", "--pair", "-n", "2"),
            "symplectic pair of the classical",
            "symplectic order",
        ),
        (("stability", "rk4", "--conjugate"), "symplectic conjugate of rk4: not A-stable", "R(z)"),
        (("tableau", "rk4", "--conjugate"), "symplectic conjugate of the classical", "-2/3"),
        (
            ("energy", "rk4", "--pair", "--modified", "3", "--problem", "pendulum"),
            "symplectic pair",
            "agree",
        ),
    ],
)
def test_text_says_which_method_it_is(arguments: tuple[str, ...], first: str, later: str) -> None:
    """In its first line, and where it judges."""
    run = gark(*arguments)
    assert run.code in {0, 3}, run.err
    assert run.out.startswith(first)
    assert later in run.out


@in_whole
def test_other_reports_say_which_method_it_is(tmp_path: Path) -> None:
    """The page in its title, an exported file in its head; both of the pair, not of the method."""
    page = tmp_path / "page.html"
    run = gark("report", "rk4", "--pair", "--no-pictures", "-o", str(page))
    assert run.code in {0, 3}, run.err
    text = page.read_text(encoding="utf-8")
    assert "<title>symplectic pair of the classical Runge-Kutta method" in text
    exported = gark("export", "rk4", "--pair", "--to", "csv").out
    assert "Method: symplectic pair of the classical Runge-Kutta method" in exported
    assert exported == garkcli.export(garkcli.load("rk4").pair, "csv")


def test_a_test_of_an_export_names_the_command_with_its_option(tmp_path: Path) -> None:
    """What prints the same errors is a run of the conjugate."""
    path = tmp_path / "explicit.py"
    to = ("--to", "torchdiffeq", "--test", "-o", str(path))
    run = gark("export", "lobatto-iiic-2", "--conjugate", *to)
    assert run.code in {0, 3}, run.err
    driver = (tmp_path / "explicit_test.py").read_text(encoding="utf-8")
    assert "gark converge FILE --conjugate --problem" in driver


@pytest.mark.parametrize("which", ["", pytest.param("conjugate", marks=in_whole), "pair"])
def test_python_and_the_command_line_agree(which: str) -> None:
    """A run of a method, its conjugate and its pair has the same numbers in both."""
    method = garkcli.load(COLLOCATION)
    taken = getattr(method, which) if which else method
    option = (f"--{which}",) if which else ()
    test = garkcli.converge(taken, "kepler")
    assert json.loads(garkcli.render(test, "json")) == data(
        "converge", COLLOCATION, *option, *RUNS["converge"]
    )
    run = garkcli.long_run(taken, "kepler", 20)
    shown = json.loads(garkcli.render(run, "json"))
    told = data("energy", COLLOCATION, *option, *RUNS["energy"])
    assert {**shown, "symplectic": None} == {**told, "symplectic": None}
    assert garkcli.render(run).startswith(told["name"])


@in_whole
def test_colours_without_a_partition_say_what_they_step(spelled_out: str) -> None:
    """Each steps the whole vector field of its term; a pair, a partitioned method, a Nyström method,
    a single term and a right-hand side have nothing to say.
    """
    said = "colour l steps the whole vector field of H{l}"
    for command in ("converge", "energy"):
        for problem in ("oscillator", "pendulum"):
            assert said in gark(command, spelled_out, "--problem", problem).out
            assert said not in gark(command, spelled_out, "--pair", "--problem", problem).out
        for other in ("rk4", "stoermer-verlet"):
            assert said not in gark(command, other, "--problem", "pendulum").out
    for name in ("ros3p", "dprkn-64"):
        assert said not in gark("converge", name).out
    assert said not in gark("converge", spelled_out, "--problem", "van-der-pol").out


@in_whole
def test_the_order_of_a_rounded_pair_is_that_of_check(tmp_path: Path) -> None:
    """Its coefficients are rounded by more than those of the file: ``gark converge`` and Python hold
    it against the order that ``gark check`` finds.
    """
    path = tmp_path / "rounded.gark.yaml"
    path.write_text(ROUNDED, encoding="utf-8")
    (checked,) = data("check", str(path), "--format", "json")["files"]
    found = data("converge", str(path), "--pair", "--problem", "kepler", "--format", "json")
    assert found["predicted_order"] == checked["pair_order"] == 2
    assert garkcli.converge(garkcli.load(str(path)).pair, "kepler").predicted_order == 2


GAUSS = """
A: [[0.25, -0.03867513], [0.53867513, 0.25]]
b: [0.5, 0.5]
tolerance: 5e-9
"""


@in_whole
@pytest.mark.parametrize(
    ("option", "command"),
    sample([*product(["--conjugate", "--pair"], ["stability", "modified"])], 3),
)
def test_of_rounded_ones_it_is_that_of_one_method(
    command: str, option: str, tmp_path: Path
) -> None:
    """Conjugate and pair are those of the method that the digits mean: the rounded Gauss method is
    its own conjugate, as the exact one is, though the printed digits are not.
    """
    path = tmp_path / "rounded.gark.yaml"
    path.write_text(GAUSS, encoding="utf-8")
    found, exact = (data(command, x, option, "--format", "json") for x in (str(path), "gauss-2"))
    if command == "stability":
        (found,), (exact,) = found["files"], exact["files"]
    keys = {"stability": ("algebraically_stable",), "modified": ("symplectic", "order")}
    for key in keys[command]:
        assert found[key] == exact[key] is not None
    assert gark("report", str(path), option, "-o", str(tmp_path / "page.html")).code == 0


def test_rounded_ones_are_not_exported(tmp_path: Path) -> None:
    """The numbers of a pair are off by more than the tolerance that a file would state."""
    path = tmp_path / "rounded.gark.yaml"
    path.write_text(ROUNDED, encoding="utf-8")
    run = gark("export", str(path), "--pair", "--to", "csv")
    assert (run.code, run.out) == (2, "")
    assert "the coefficients are rounded, and those of the pair by more" in run.err


@pytest.mark.parametrize("command", TAKERS)
def test_zero_weights_and_two_at_once_are_refused(command: str, tmp_path: Path) -> None:
    """A pair that does not exist, and options that ask for two methods: with the reason."""
    path = tmp_path / "midpoint.gark.yaml"
    path.write_text(EXPLICIT, encoding="utf-8")
    further = ("--to", "csv") if command == "export" else ()
    run = gark(command, str(path), "--pair", *further)
    assert (run.code, run.out) == (2, "")
    assert "the symplectic conjugate divides by the weights b" in run.err
    both = gark(command, "rk4", "--pair", "--conjugate", *further)
    assert (both.code, both.out) == (2, "")
    assert "--pair and --conjugate are two methods" in both.err


def test_right_hand_sides_have_no_pair() -> None:
    """A pair steps positions and momenta: it is refused, not replaced by the method."""
    run = gark("converge", "rk4", "--pair", "--problem", "van-der-pol")
    assert (run.code, run.out) == (2, "")
    assert "the method drives positions and momenta, and van-der-pol has none" in run.err


def test_free_parameters_want_numbers(tmp_path: Path) -> None:
    """Stability and the page are for the method of every value, the pair for numbers."""
    path = tmp_path / "free.gark.yaml"
    path.write_text("{parameters: {t: free}, A: [[t]], b: [1]}", encoding="utf-8")
    for command in ("stability", "report"):
        run = gark(command, str(path), "--pair")
        assert run.code == 2
        assert "--pair needs numbers, and t is free" in run.err
    assert "-t + 1" in gark("tableau", str(path), "--conjugate").out


def test_the_words_are_the_same_everywhere() -> None:
    """One declaration: the same lines in the help of each command that has the options."""
    said = {
        "  --conjugate": "Take the symplectic conjugate of FILE instead.",
        "  --pair": "Take the symplectic pair of FILE instead, 2N colours.",
    }
    for command in COMMANDS:
        if command == "design":  # whose order it is, there
            continue
        text = " ".join(gark(command, "--help").out.split())
        for option, words in said.items():
            takes = command in TAKERS or (command, option) == ("conjugate", "  --pair")
            assert (f"{option.strip()} {words}" in text) is takes, command
