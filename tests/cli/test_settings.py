"""``--set``: values for the parameters of a file, in every command that takes one."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.cli.harness import gark
from tests.whole import in_whole

FAMILY = "parameters: {g: free, one: 1}\nA: [[g, 0], [one - 2*g, g]]\nb: [1/2, 1/2]\n"
METHOD = "A: [[1/4, 0], [1/2, 1/4]]\nb: [1/2, 1/2]\n"
SHAPE = "unknown: {stages: 2, shape: sdirk}\n"
CHOSEN = ["--set", "g=1/4"]
SHAPED = [x for text in ("gamma=1/4", "c2=3/4", "b1=1/2", "b2=1/2") for x in ("--set", text)]
COMMANDS: dict[str, list[str]] = {
    "check": ["--format", "json"],
    "tableau": ["--format", "json"],
    "conjugate": ["--format", "json"],
    "conditions": ["--order", "3", "--format", "json"],
    "stability": ["--format", "json"],
    "certificate": [],
    "modified": ["--format", "json"],
    "reduce": ["--format", "json"],
    "energy": ["--t-end", "2", "--format", "json"],
    "converge": ["--problem", "oscillator", "--steps", "1/2,1/4,1/8", "--format", "json"],
}
EVERY_VALUE = {"check", "tableau", "conjugate", "conditions", "stability"}
"""Commands that say what holds for every value."""


@pytest.mark.parametrize("command", COMMANDS)
def test_a_chosen_method_is_the_method(command: str, tmp_path: Path) -> None:
    """A family and a shape with all values chosen say what the file with the values says."""
    path = tmp_path / "method.yaml"
    results = []
    for text, chosen in ((METHOD, []), (FAMILY, CHOSEN), (SHAPE, SHAPED)):
        path.write_text(text, encoding="utf-8")
        run = gark(command, str(path), *COMMANDS[command], *chosen)
        results.append((run.code, run.out))
    plain, of_family, of_shape = results
    assert plain[0] in {0, 1}
    assert plain[1]
    assert (of_family, of_shape) == (plain, plain)


@in_whole
@pytest.mark.parametrize("command", COMMANDS)
def test_what_is_not_chosen_is_said(command: str, tmp_path: Path) -> None:
    """A family without values is told for every value or refused, and a parameter that there is
    not is refused.
    """
    path = tmp_path / "family.yaml"
    path.write_text(FAMILY, encoding="utf-8")
    told = gark(command, str(path), *COMMANDS[command])
    says_values = "--set g=1/2 chooses one" in told.out + told.err
    if command in EVERY_VALUE:
        assert (told.code, says_values) == (0, False)
    else:
        assert (told.code, says_values) == (2, True)
    wrong = gark(command, str(path), *COMMANDS[command], *CHOSEN, "--set", "h=1")
    assert (wrong.code, "no parameter 'h'" in wrong.out + wrong.err) == (2, True)


@pytest.mark.parametrize("command", ["check", "stability", "converge"])
def test_several_files_have_no_settings(command: str, tmp_path: Path) -> None:
    """Parameters are those of one file; conditions without a file have none."""
    paths = []
    for name in "ab":
        path = tmp_path / f"{name}.yaml"
        path.write_text(FAMILY, encoding="utf-8")
        paths.append(str(path))
    run = gark(command, *paths, *CHOSEN)
    assert (run.code, "--set is for one FILE" in run.err) == (2, True)
    assert gark("conditions", *CHOSEN).code == 2
