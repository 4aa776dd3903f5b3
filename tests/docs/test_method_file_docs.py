"""Documentation that is true: files in it load, commands in it say what it shows."""

import re
from pathlib import Path

import pytest
import yaml

from garkcli.methodfile.description import FORMS
from garkcli.methodfile.file_keys import KEYS
from garkcli.methodfile.load import loads

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


def is_whole(block: str) -> bool:
    """Whether a block is a whole file: a form without ``...``, and with its transfer where it has
    two methods.
    """
    if "..." in block or "A11" in block or "AE" in block or not keys(block) & set(FORMS):
        return False
    methods = yaml.safe_load(block).get("methods")
    return methods is None or len(methods) == 1 or "transfer" in keys(block)


PAGES = (DOCS, README)
ALL = [block for path in PAGES for block in blocks(path, "yaml") if not block.startswith("- uses:")]
WHOLE = [block for block in ALL if is_whole(block)]
FRAGMENTS = [block for block in ALL if not is_whole(block)]


def test_the_documentation_has_files() -> None:
    """There are whole files in the documentation of the method file, and in all it shows."""
    assert any(is_whole(block) for block in blocks(DOCS, "yaml"))
    assert len(WHOLE) >= 2


@pytest.mark.parametrize("block", WHOLE)
def test_a_whole_file_loads(block: str) -> None:
    """A file shown in the documentation is a method."""
    assert loads(block).tableau.size >= 1


@pytest.mark.parametrize("block", FRAGMENTS)
def test_a_fragment_has_only_keys_of_the_format(block: str) -> None:
    """A part of a file has no key that the format does not know."""
    assert keys(block)
    assert keys(block) <= set(KEYS)


def test_every_key_is_explained() -> None:
    """Every key of the format has a section, or its place in the table of keys."""
    lines = DOCS.read_text(encoding="utf-8").splitlines()
    places = "\n".join(line for line in lines if line.startswith(("|", "#")))
    sections = {"tolerance": "Rounded coefficients"}
    missing = [x for x in KEYS if not re.search(rf"`{x}\b|{sections.get(x, '^$')}", places)]
    assert missing == []


def test_every_command_of_the_documentation_exists() -> None:
    """The command lines in running text name commands that exist."""
    from tests.cli.harness import NAMES

    texts = [
        path.read_text(encoding="utf-8")
        for path in (README, *sorted((ROOT / "docs").rglob("*.md")))
    ]
    named = {word for text in texts for word in re.findall(r"`gark ([a-z]+)", text)}
    assert named
    assert named <= {*NAMES, "help"}
