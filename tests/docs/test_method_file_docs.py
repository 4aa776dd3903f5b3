"""Documentation that is true: files in it load, commands in it say what it shows."""

import re
import shlex
from pathlib import Path

import pytest
import yaml

from garkcli.methodfile.description import FORMS
from garkcli.methodfile.load import loads
from garkcli.methodfile.problem import loads_problem
from garkcli.methodfile.reader import KEYS
from tests.cli.harness import gark

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs/method-file.md"
README = ROOT / "README.md"


def blocks(path: Path, language: str) -> list[str]:
    """The fenced blocks of a language."""
    return re.findall(
        rf"^```{language}\n(.*?)^```$", path.read_text(encoding="utf-8"), re.DOTALL | re.MULTILINE
    )


def keys(block: str) -> set[str]:
    """The words at the start of a line that a colon makes keys."""
    return set(re.findall(r"^([\w-]+):", block, re.MULTILINE))


def is_problem(block: str) -> bool:
    """Whether a block is a problem file."""
    return "variables" in keys(block)


def is_whole(block: str) -> bool:
    """Whether a block is a whole file: a form without ``...``, and with its transfer where it has
    two methods.
    """
    if "..." in block or "A11" in block or "AE" in block or not keys(block) & set(FORMS):
        return False
    methods = yaml.safe_load(block).get("methods")
    return methods is None or len(methods) == 1 or "transfer" in keys(block)


ALL = [block for path in (DOCS, README) for block in blocks(path, "yaml")]
PROBLEMS = [block for block in ALL if is_problem(block)]
WHOLE = [block for block in ALL if is_whole(block)]
FRAGMENTS = [block for block in ALL if not is_whole(block) and not is_problem(block)]


def test_the_documentation_has_files() -> None:
    """There are whole files in the documentation of the method file, and in all it shows."""
    assert any(is_whole(block) for block in blocks(DOCS, "yaml"))
    assert len(WHOLE) >= 2
    assert PROBLEMS


@pytest.mark.parametrize("block", WHOLE)
def test_a_whole_file_loads(block: str) -> None:
    """A file shown in the documentation is a method."""
    assert loads(block).tableau.size >= 1


@pytest.mark.parametrize("block", PROBLEMS)
def test_a_problem_is_a_file_of_the_repository(block: str) -> None:
    """The problem that the README shows is the file that it names, comments apart."""
    files = [path.read_text(encoding="utf-8") for path in (ROOT / "problems").glob("*.yaml")]
    assert loads_problem(block).terms
    assert block in [re.sub(r"^#.*\n", "", text, flags=re.MULTILINE) for text in files]


@pytest.mark.parametrize("block", FRAGMENTS)
def test_a_fragment_has_only_keys_of_the_format(block: str) -> None:
    """A part of a file has no key that the format does not know."""
    assert keys(block)
    assert keys(block) <= set(KEYS)


def test_every_key_is_explained() -> None:
    """Every key of the format has its place in the table of keys."""
    table = "\n".join(
        line for line in DOCS.read_text(encoding="utf-8").splitlines() if line.startswith("|")
    )
    missing = [key for key in KEYS if not re.search(rf"`{key}\b", table)]
    assert missing == []


def sessions() -> list[tuple[str, str]]:
    """Each ``$ gark …`` of the README with the text that follows it."""
    found = []
    for block in blocks(README, "console"):
        for part in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, _, shown = part.partition("\n")
            command = command.partition("  #")[0].strip()
            if command.startswith("gark "):
                found.append((command, shown.rstrip("\n")))
    return found


def agrees(shown: str, lines: list[str]) -> bool:
    """Whether ``lines`` are those shown, where a line ``...`` stands for any number of them."""
    pattern = "".join(
        r"(?:.*\n)*" if line.strip() == "..." else re.escape(line.rstrip()) + r"\n"
        for line in shown.splitlines()
    )
    return re.fullmatch(pattern, "".join(f"{line.rstrip()}\n" for line in lines)) is not None


@pytest.mark.parametrize(("command", "shown"), sessions())
def test_a_session_of_the_readme_is_real(command: str, shown: str) -> None:
    """Each command of the README, run now, shows what the README says it shows."""
    run = gark(*shlex.split(command)[1:])
    assert run.code in {0, 1}, run.err
    lines = (run.err + run.out).splitlines()
    assert agrees(shown, lines), f"{command} shows\n\n{run.out}"


def test_every_command_of_the_documentation_exists() -> None:
    """The command lines in running text name commands that exist."""
    from garkcli.cli.main import COMMANDS

    texts = [
        path.read_text(encoding="utf-8") for path in (README, *sorted((ROOT / "docs").glob("*.md")))
    ]
    named = {word for text in texts for word in re.findall(r"`gark ([a-z]+)", text)}
    assert named
    assert named <= set(COMMANDS)


def test_the_comparison_can_fail() -> None:
    """``...`` stands for lines left out, anything else has to be there."""
    assert agrees("a\n...\nd", ["a", "b", "c", "d"])
    assert agrees("a\n...", ["a"])
    assert not agrees("a\n...\nd", ["a", "b", "c"])
    assert not agrees("a", ["a", "b"])
