"""What editors are told of a file, without the protocol."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from garkcli.check.check_file import check_method
from garkcli.check.findings import findings
from garkcli.editor import judging
from garkcli.editor.judging import TextSpan, judged
from garkcli.editor.wording import choices_at, meaning_at
from garkcli.methodfile.load import loads
from tests.cli.harness import gark

KUTTA = "A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, {a}, 0, 0], [0, 0, 1, 0]]\nb: [1/6, 1/3, {b}, 1/6]\nexpect: {{order: 4}}\n"
IN_LINES = "expect:\n  order: 4\nb:\n- 1/6\n- 1/3\n- 1/3\n- 1/5\nA:\n- [0, 0, 0, 0]\n- [1/2, 0, 0, 0]\n- [0, 1/2, 0, 0]\n- [0, 0, 1, 0]\n"


@pytest.mark.parametrize(
    ("text", "old", "new"),
    [
        (KUTTA.format(a="1/3", b="1/3"), "1/3", "1/2"),
        (KUTTA.format(a="1/2", b="1/6"), "1/6", "1/3"),
        (IN_LINES, "1/5", "1/6"),
    ],
)
def test_a_fix_mends_the_file(text: str, old: str, new: str) -> None:
    """The change is at the entry that the check names; with it the claim holds."""
    assert check_method(loads(text)).exit_code == 1
    claim, *hints = judged(text, "mine.yaml").remarks
    (fix,) = claim.fixes
    assert [x.fixes for x in hints if x.remark.code == "misprint"] == [(fix,)]
    assert hints[-1].span == fix.span
    lines = text.splitlines()
    line = lines[fix.span.line]
    assert (line[fix.span.start : fix.span.end], fix.text) == (old, new)
    lines[fix.span.line] = line[: fix.span.start] + fix.text + line[fix.span.end :]
    mended = "\n".join(lines) + "\n"
    assert check_method(loads(mended)).exit_code == 0
    assert judged(mended, "mine.yaml").remarks == ()


def test_remarks_are_those_of_the_command() -> None:
    """Message, cure, place and code, and the orders above the first key that makes a method."""
    text = "name: wrong\n" + KUTTA.format(a="1/3", b="1/3")
    found = judged(text, "mine.yaml")
    outcome = check_method(loads(text, "mine.yaml"))
    assert [x.remark for x in found.remarks] == [x.remark for x in findings(outcome)]
    assert found.remarks[0].span == TextSpan(3, 16, 17)
    assert found.line == 1
    # the conjugate and the pair of a method of one colour are not asked for
    assert found.lens == ("order 1, proved; order 2 fails at [[]] by -1/18",)


def test_couplings_have_a_lens_and_no_wrong_fix() -> None:
    """Where an entry is made by a rule there is no place to mend."""
    text = "methods: [gauss-2, lobatto-iiia-3]\ntransfer: collocation\nexpect: {order: 5}\n"
    found = judged(text, "mine.yaml")
    assert [(x.remark.code, x.fixes) for x in found.remarks] == [
        ("claim", ()),
        ("failing-conditions", ()),
    ]
    assert [x.split(",")[0] for x in found.lens] == [
        "order 4",
        "conjugate order 4",
        "symplectic pair 4",
    ]


def test_faults_have_their_place() -> None:
    """A fault of YAML, and a key that was meant."""
    (fault,) = judged("A: [[0]\nb: [1]\n", "x.yaml").remarks
    assert fault.remark.line > 0
    (wrong,) = judged("A: [[0]]\nb: [1]\ntolerence: 1e-9\n", "x.yaml").remarks
    assert [x.text for x in wrong.fixes] == ["tolerance"]
    assert wrong.span == TextSpan(2, 0, 9)


@pytest.mark.parametrize(
    ("text", "wrong", "meant"),
    [
        ("A: [[0]]\nb: [1]\ntolerence: 1e-9\n", "tolerence", "tolerance"),
        ("methods: [{family: gaus, stages: 2}]\n", "gaus", "gauss"),
        ("methods: [gaus-2]\n", "gaus-2", "gauss-2"),
        ("methods: [gauss-2, gauss-2]\ntransfer: colocation\n", "colocation", "collocation"),
        ("parameters: {theta: 1/2}\nA: [[tehta]]\nb: [1]\n", "tehta", "theta"),
    ],
)
def test_a_misspelt_word_is_written_as_it_was_meant(text: str, wrong: str, meant: str) -> None:
    """The whole word, and only that, is replaced; then the file is a method."""
    view = judged(text, "x.yaml").remarks[0]
    (fix,) = view.fixes
    line = text.splitlines()[fix.span.line]
    assert (line[fix.span.start : fix.span.end], fix.text) == (wrong, meant)
    assert check_method(loads(text.replace(wrong, meant))).is_read


def test_a_value_is_not_replaced_by_the_name_that_was_meant() -> None:
    """The remark on a misspelt name may be at its value."""
    text = "unknown: {shape: explicit, stages: 2}\ndesign: {order: 2, fix: {a12: 1/2}}\n"
    for view in judged(text, "x.yaml").remarks:
        assert all(fix.text != "a21" for fix in view.fixes)


def test_long_work_is_given_up(monkeypatch: pytest.MonkeyPatch) -> None:
    """The lens says so, and nothing is underlined."""
    monkeypatch.setattr(judging, "SECONDS", 0.0)
    found = judged("methods: [gauss-9]\n", "x.yaml")
    assert (found.remarks, found.lens) == ((), (judging.LATE,))


def test_words_of_flow_and_of_blocks() -> None:
    """The key below others is meant, in braces too."""
    lines = ["expect: {order: 4, ", "compose:", "  steps: 2", "  fr"]
    assert meaning_at(lines, 0, 10).startswith("**order**")
    assert meaning_at(lines, 2, 3).startswith("**compose.steps**")
    assert meaning_at(lines, 0, 16) == ""
    assert {"order", "symplectic"} <= {x.word for x in choices_at(lines, 0, len(lines[0]))}
    assert {"steps", "from"} <= {x.word for x in choices_at(lines, 3, 4)}


def test_the_command_prints_it(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """And names what to install where there is no pygls."""
    (tmp_path / "mine.yaml").write_text(IN_LINES, encoding="utf-8")
    run = gark("lsp", "--once", "mine.yaml", cwd=tmp_path)
    assert run.code == 1
    found = json.loads(run.out)
    assert found["remarks"][0]["fixes"][0]["text"] == "1/6"
    assert found["line"] == 2
    monkeypatch.setattr("garkcli.cli.editing.find_spec", lambda _: None)
    missing = gark("lsp")
    assert missing.code == 2
    assert 'pip install "garkcli[lsp]"' in missing.err


def test_a_fix_of_decimals_is_a_decimal() -> None:
    """As the message has it; what it replaces is told as the file has it."""
    text = "A: [[0, 0], [1, 0]]\nb: [0.2928932, 5.0e-1]\nexpect: {order: 1}\n"
    fixes = [x for view in judged(text, "x.yaml").remarks for x in view.fixes]
    assert ("Write 0.7071068 in place of 5.0e-1", "0.7071068") in [(x.title, x.text) for x in fixes]
