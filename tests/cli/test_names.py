"""Names and file names that would change what a terminal or LaTeX shows."""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli.methodfile.load import loads
from tests.cli.harness import gark

NAME = "two\\nlines \\e[2Jand \\u202emore"
METHOD = f'methods: [{{family: gauss, stages: 1}}]\nname: "{NAME}"\nexpect: {{order: 3}}\n'
COMMANDS = [
    ("check",),
    ("check", "-v"),
    ("check", "-q"),
    ("tableau",),
    ("tableau", "--format", "latex"),
    ("conjugate",),
    ("conjugate", "--format", "latex"),
    ("conjugate", "--format", "yaml"),
]


@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
@pytest.mark.parametrize("file", ["m.gark.yaml", "a\x1b[2J\nb.gark.yaml"])
def test_no_name_reaches_the_terminal_as_a_command(
    command: tuple[str, ...], file: str, tmp_path: Path
) -> None:
    """Control characters of a name are blanks, those of a file name are written out."""
    (tmp_path / file).write_text(
        METHOD if file == "m.gark.yaml" else METHOD.replace(f'name: "{NAME}"', "")
    )
    run = gark(command[0], file, *command[1:], cwd=tmp_path)
    assert all(sign.isprintable() or sign == "\n" for sign in run.out + run.err)
    if file == "m.gark.yaml":
        is_told = command not in (("check",), ("check", "-q"))
        assert run.out.count("two lines [2Jand more") == int(is_told)


def test_a_conjugate_of_an_odd_file_loads_again(tmp_path: Path) -> None:
    """The file name in the name of the conjugate is escaped as YAML asks for."""
    file = "a\x1b[2J\nb.gark.yaml"
    (tmp_path / file).write_text("methods: [{family: gauss, stages: 2}]")
    again = loads(gark("conjugate", file, "--format", "yaml", cwd=tmp_path).out)
    assert again.name == "symplectic conjugate of a [2J b.gark.yaml"
