"""gark claims: the truth as files claim it; --write touches nothing else of a file."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest
from hypothesis import given
from hypothesis import strategies as st

from garkcli import loads
from garkcli.check.check_file import check_file
from garkcli.methodfile.carried import write_claims
from garkcli.methodfile.expectations import CLAIMS
from garkcli.report.schemas import report_schema
from tests.cli.harness import gark
from tests.whole import sample

MIDPOINT = "A: [[0, 0], [1/2, 0]]  # explicit\nb: [0, 1]\n"
METHODS = sorted(Path("methods").glob("*.gark.yaml"))


def put(folder: Path, text: str) -> str:
    """A method file with this text."""
    path = folder / "method.gark.yaml"
    path.write_text(text, encoding="utf-8", newline="")
    return str(path)


@pytest.mark.parametrize("path", sample(METHODS, 4), ids=lambda x: x.name.split(".")[0])
def test_everything_claimed_is_true(path: Path, tmp_path: Path) -> None:
    """All claims of --all, written into a method of the paper, hold there, and a second time
    nothing is changed.
    """
    copy = put(tmp_path, path.read_text(encoding="utf-8"))
    run = gark("claims", "--write", "--all", copy)
    assert run.code == 0
    outcome = check_file(copy)
    assert outcome.failed_claims == ()
    assert len(outcome.claims) > 20
    written = Path(copy).read_text(encoding="utf-8")
    gark("claims", "--write", "--all", copy)
    assert Path(copy).read_text(encoding="utf-8") == written


def test_a_file_without_claims(tmp_path: Path) -> None:
    """It is given the usual ones; comments and everything else stay."""
    path = put(tmp_path, MIDPOINT)
    assert gark("claims", "--write", path).code == 0
    text = Path(path).read_text(encoding="utf-8")
    assert text.startswith(MIDPOINT + "expect:\n  order: 2\n")
    assert "conjugate-order" not in text
    assert check_file(path).failed_claims == ()


@pytest.mark.parametrize(
    ("text", "before", "after"),
    [
        ("---\nA: [[0]]\nb: [1]\n...\n", "b: [1]\nexpect:\n", "\n...\n"),
        ("  A: [[0]]\n  b: [1]\n", "b: [1]\n  expect:\n", "\n"),
        ("A: [[0]]\nb: [1]  # end", "# end\nexpect:\n", "\n"),
        ("A: [[0]]\r\nb: [1]\r\n", "\r\nexpect:\r\n", "\r\n"),
    ],
    ids=["end of YAML", "indented", "no end of line", "CRLF"],
)
def test_the_place_of_claims(text: str, before: str, after: str, tmp_path: Path) -> None:
    """Before the end that YAML writes, as far in as the keys, with the ends of lines that are
    there; the file can be read again.
    """
    written = write_claims("a file", text, {"order": "1", "explicit": "true"})
    assert before in written
    assert written.endswith("explicit: true" + after)
    assert ("\r" in text) == (written.count("\r\n") == written.count("\n"))
    outcome = check_file(put(tmp_path, written))
    assert (len(outcome.claims), outcome.failed_claims) == (2, ())


def test_the_claims_of_a_file(tmp_path: Path) -> None:
    """They get the values that are true, in their places, with comments beside them."""
    expect = "expect:  # mine\n    order: 3  # hoped for\n    C:\n      - [2]\n    # end\n"
    path = put(tmp_path, MIDPOINT + expect + "name: midpoint\n")
    assert gark("claims", "--write", "--key", "explicit", path).code == 0
    assert Path(path).read_text(encoding="utf-8") == MIDPOINT + (
        "expect:  # mine\n    order: 2  # hoped for\n    C:\n      [[1]]\n"
        "    explicit: true\n    # end\nname: midpoint\n"
    )


def test_claims_in_braces(tmp_path: Path) -> None:
    """New ones stand inside the braces."""
    path = put(tmp_path, MIDPOINT + "expect: {order: 1}")
    assert gark("claims", "--write", "--key", "fsal", path).code == 0
    text = Path(path).read_text(encoding="utf-8")
    assert text == MIDPOINT + "expect: {order: 2, fsal: false}"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("{A: [[0]], b: [1]}\n", "no place in this file"),
        (MIDPOINT + "expect: {}\n", "no place in this file"),
        ("A: [[0]]\nb: [1, 1]\n", "b"),
        ("parameters: {t: free}\nA: [[t]]\nb: [1]\n", "free parameters"),
    ],
)
def test_files_that_cannot_be_written(text: str, said: str, tmp_path: Path) -> None:
    """They stay as they are, and it is said why."""
    path = put(tmp_path, text)
    run = gark("claims", "--write", path)
    assert run.code == 2
    assert said in run.err
    assert Path(path).read_text(encoding="utf-8") == text


def test_what_is_asked_for(tmp_path: Path) -> None:
    """Keys that nobody knows, and writing where there is no file."""
    path = put(tmp_path, MIDPOINT)
    assert "did you mean 'order'" in gark("claims", path, "--key", "ordr").err
    run = gark("claims", "-", "--write", stdin=MIDPOINT)
    assert (run.code, "--write needs a file" in run.err) == (2, True)
    run = gark("claims", "-", "--key", "gamma", stdin=MIDPOINT)
    assert run.out.endswith("# not claimed, without a meaning or not decided: gamma\n")


def test_as_json(tmp_path: Path) -> None:
    """The report has its schema."""
    run = gark("claims", put(tmp_path, MIDPOINT), "--format", "json")
    data = json.loads(run.out)
    jsonschema.validate(data, report_schema("claims"))
    assert data["files"][0]["claims"][0] == {"claim": "order", "value": "2"}


@given(
    st.dictionaries(st.sampled_from(CLAIMS[:7]), st.integers(1, 9)),
    st.sampled_from(["", "\n", "\n# end", "\nname: x\n", "\n\n\n"]),
    st.booleans(),
)
def test_written_claims_are_read_again(before: dict[str, int], after: str, is_flow: bool) -> None:
    """Whatever stood there and follows: the claims that are read again are those written, and
    those that were not.
    """
    if is_flow:
        inside = ", ".join(f"{key}: {x}" for key, x in before.items())
        expect = f"expect: {{{inside}}}" if before else ""
    else:
        lines = [f"\n  {key}: {x}" for key, x in before.items()]
        expect = "expect:" + "".join(lines) if before else ""
    text = MIDPOINT + expect + after
    new = {"order": "2", "bound": '">= 1"'}
    written = write_claims("a file", text, new)
    found = {x.key: str(x.value) for x in loads(written).claims}
    kept = {key: str(x) for key, x in before.items()}
    assert found == {**kept, "order": "2", "bound": ">= 1"}


def test_help_of_commands() -> None:
    """The help of a command is that of its --help, and -V is the version."""
    assert gark("help", "claims").out == gark("claims", "--help").out
    assert gark("help").out == gark("--help").out
    assert gark("-V").out == gark("--version").out
    run = gark("help", "check", "claims")
    assert (run.code, run.out) == (2, "")
    assert "gark help is for one command, not for 2 words" in run.err
    run = gark("help", "chek")
    assert run.code == 2
    assert "did you mean 'check'" in run.err
