"""The example files: what is valid loads and keeps its claims, what is invalid is refused with its
faults.
"""

import time
from pathlib import Path

import pytest

from garkcli.check.check_file import check_file
from garkcli.check.outcome import Outcome
from garkcli.errors import MethodFileError
from garkcli.families.registry import FAMILIES
from garkcli.methodfile.description import FORMS, STRUCTURES
from garkcli.methodfile.expectations import CLAIMS
from garkcli.methodfile.file_keys import KEYS
from garkcli.methodfile.load import load
from garkcli.methodfile.transfers import ALL_RULES
from garkcli.report import remarks
from garkcli.tell.dialect import Plain
from tests.examples.snapshots import assert_recorded

EXAMPLES = Path(__file__).parents[1] / "examples"
SUFFIX = ".gark.yaml"
VALID = sorted((EXAMPLES / "valid").glob(f"*{SUFFIX}"))
INVALID = sorted((EXAMPLES / "invalid").glob(f"*{SUFFIX}"))
FAMILY_FILES = sorted((EXAMPLES / "families").glob(f"*{SUFFIX}"))
SECONDS = 5
"""Of the processor, which no refusal may take."""


def stem(path: Path) -> str:
    """The name of an example without its suffix."""
    return path.name.removesuffix(SUFFIX)


@pytest.mark.parametrize("path", VALID, ids=stem)
def test_a_valid_file_keeps_its_claims(path: Path) -> None:
    """The file loads and every claim under ``expect`` holds."""
    outcome = check_file(str(path))
    assert outcome.faults == ()
    assert [claim for claim in outcome.claims if not claim.holds] == []
    assert outcome.ok


@pytest.mark.parametrize("path", INVALID, ids=stem)
def test_an_invalid_file_is_refused_with_its_faults(
    path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The file raises MethodFileError, soon, with the recorded faults, each with a place inside the
    file and a cure.
    """
    monkeypatch.chdir(path.parent)
    start = time.process_time()
    with pytest.raises(MethodFileError) as caught:
        load(path.name)
    assert time.process_time() - start < SECONDS
    error = caught.value
    places = [(fault.line, fault.column) for fault in error.faults]
    assert places
    assert all(fault.help for fault in error.faults)
    assert min(places) >= (1, 1)
    assert places == sorted(places)
    assert max(line for line, _ in places) <= max(1, error.text.count("\n") + 1)
    outcome = Outcome(error.source, error.source, faults=error.faults, text=error.text)
    assert_recorded(
        path.with_name(f"{stem(path)}.txt"),
        "\n".join(remarks.lines(outcome.faults, outcome.file, outcome.text, Plain())) + "\n",
    )


def test_every_record_belongs_to_an_example() -> None:
    """No record outlives the invalid file it was made from."""
    records = {path.stem for path in (EXAMPLES / "invalid").glob("*.txt")}
    assert records == {stem(path) for path in INVALID}


def words(paths: list[Path]) -> str:
    """The text of all the files."""
    return "\n".join(path.read_text(encoding="utf-8") for path in paths)


@pytest.mark.parametrize(
    "vocabulary",
    [
        KEYS,
        FORMS,
        STRUCTURES,
        ALL_RULES,
        CLAIMS,
        tuple(FAMILIES),
        ("sqrt(", "cbrt(", "root(", "^", "**"),
    ],
)
def test_the_valid_files_say_every_word_of_the_format(vocabulary: tuple[str, ...]) -> None:
    """No key, form, structure, rule, claim, family or function is without an example that loads."""
    text = words(VALID + FAMILY_FILES)
    assert [word for word in vocabulary if word not in text] == []


def test_the_misprinted_table_fails_its_claim() -> None:
    """The collocation example as the paper prints it is a method, of order 2 where order 4 is
    claimed.
    """
    outcome = check_file(str(EXAMPLES / "failing" / f"collocation-misprinted{SUFFIX}"))
    assert [(x.claim, x.expected, x.found) for x in outcome.failed_claims] == [("order", "4", "2")]
    assert outcome.exit_code == 1
