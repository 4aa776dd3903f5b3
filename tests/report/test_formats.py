"""The formats for machines: what each standard asks for, whatever stands in file names and
messages.
"""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple
from unittest.mock import patch
from urllib.parse import unquote

import pytest
from click.testing import CliRunner
from jsonschema import Draft7Validator

from garkcli.check.analysis import analyse
from garkcli.check.check_file import check_file
from garkcli.check.claims import verify
from garkcli.check.findings import Finding, findings
from garkcli.check.outcome import Outcome
from garkcli.cli.command import command_of
from garkcli.cli.main import gark as commands
from garkcli.errors import MethodFileError, Remark
from garkcli.frozen import replace
from garkcli.glossary.faults import findings_of
from garkcli.methodfile.load import loads
from garkcli.page.look import Look
from garkcli.report import check_findings, check_text
from garkcli.report.check_formats import FORMATS
from garkcli.report.checked import REPORT
from garkcli.webpage.page import render
from garkcli.webpage.reported import reported
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole

FAILING = "tests/examples/failing/collocation-misprinted.gark.yaml"
INVALID = "tests/examples/invalid/many-faults.gark.yaml"
GOOD = "methods/stoermer-verlet.gark.yaml"
FILES = (GOOD, FAILING, INVALID)
MIDPOINT = "methods: [{A: [[1/2]], b: [1]}]\n"
HEUN = "methods: [{family: heun}]\n"
WRONG = f"{MIDPOINT}expect: {{order: 3, symplectic: false, bound: 2, B: [5]}}\n"
UNDECIDED = (
    "A: [[0.167, 3.333], [-1.333, 0.333]]\nb: [0.333, 0.667]\ntolerance: 1e-3\n"
    "expect: {p-stable: true, order: 3}\n"
)
AWKWARD = "a%,b:c`d|e\nf.gark.yaml"

_TEXT = {
    "type": "object",
    "required": ["text"],
    "properties": {"text": {"type": "string", "minLength": 1}},
}
_POSITIVE = {"type": "integer", "minimum": 1}
_REGION = {
    "type": "object",
    "required": ["startLine"],
    "properties": {"startLine": _POSITIVE, "startColumn": _POSITIVE},
    "additionalProperties": False,
}
_PLACE = {
    "type": "object",
    "required": ["artifactLocation"],
    "properties": {
        "artifactLocation": {
            "type": "object",
            "required": ["uri"],
            "properties": {"uri": {"type": "string", "pattern": "^[A-Za-z0-9._~/%-]+$"}},
            "additionalProperties": False,
        },
        "region": _REGION,
    },
    "additionalProperties": False,
}
_LOCATION = {
    "type": "object",
    "required": ["physicalLocation"],
    "properties": {"physicalLocation": _PLACE},
    "additionalProperties": False,
}
_RESULT = {
    "type": "object",
    "required": ["message", "ruleId", "ruleIndex", "locations", "partialFingerprints"],
    "properties": {
        "ruleId": {"enum": list(findings_of("check"))},
        "ruleIndex": {"type": "integer", "minimum": 0},
        "level": {"enum": ["none", "note", "warning", "error"]},
        "message": _TEXT,
        "locations": {"type": "array", "minItems": 1, "items": _LOCATION},
        "partialFingerprints": {
            "type": "object",
            "additionalProperties": {"type": "string"},
            "minProperties": 1,
        },
        "properties": {"type": "object"},
    },
    "additionalProperties": False,
}
_RULE = {
    "type": "object",
    "required": ["id"],
    "properties": {"id": {"type": "string"}, "shortDescription": _TEXT, "help": _TEXT},
    "additionalProperties": False,
}
_DRIVER = {
    "type": "object",
    "required": ["name"],
    "properties": {
        "name": {"type": "string"},
        "version": {"type": "string"},
        "rules": {"type": "array", "items": _RULE},
    },
    "additionalProperties": False,
}
_RUN = {
    "type": "object",
    "required": ["tool", "results"],
    "properties": {
        "tool": {"type": "object", "required": ["driver"], "properties": {"driver": _DRIVER}},
        "columnKind": {"enum": ["utf16CodeUnits", "unicodeCodePoints"]},
        "results": {"type": "array", "items": _RESULT},
    },
    "additionalProperties": False,
}
SARIF = {
    "type": "object",
    "required": ["version", "runs", "$schema"],
    "properties": {
        "version": {"const": "2.1.0"},
        "$schema": {"type": "string", "pattern": "sarif.*2\\.1\\.0"},
        "runs": {"type": "array", "minItems": 1, "items": _RUN},
    },
    "additionalProperties": False,
}
"""The part of SARIF 2.1.0 that a report of ours may use: its required properties, types and
enumerations.
"""


def outcome(text: str, file: str = "m.gark.yaml", limit: int = 60) -> Outcome:
    """What ``gark check`` finds about a text."""
    try:
        method = loads(text, file)
    except MethodFileError as error:
        return Outcome(file, file, faults=error.faults, text=text)
    analysis = analyse(method.tableau, limit)
    return Outcome(
        file, method.name, method.structure, analysis, verify(method.claims, analysis), text=text
    )


def sarif(*outcomes: Outcome) -> dict[str, Any]:
    """The one run of a SARIF report that has the structure of the standard."""
    log = json.loads(check_findings.sarif(outcomes))
    Draft7Validator.check_schema(SARIF)
    assert [error.message for error in Draft7Validator(SARIF).iter_errors(log)] == []
    (run,) = log["runs"]
    assert isinstance(run, dict)
    return run


def plain(text: str) -> str:
    """A text without the escapes of Markdown."""
    return text.replace("\\", "").replace("&lt;", "<")


def words(text: str) -> str:
    """A text without its line ends and margins."""
    return " ".join(text.split())


def fingerprints(text: str, file: str = "m.gark.yaml") -> list[str]:
    """The fingerprints of all findings about a text."""
    return [x["partialFingerprints"]["gark/v1"] for x in sarif(outcome(text, file))["results"]]


# -- SARIF ---------------------------------------------------------------------------------------


def test_sarif_of_real_files_has_the_structure_of_the_standard() -> None:
    """A good, a failing and an unreadable file give a log with every required property, one result a finding."""
    log = json.loads(gark("check", *FILES, "--format", "sarif").out)
    assert [error.message for error in Draft7Validator(SARIF).iter_errors(log)] == []
    (run,) = log["runs"]
    files = [
        x["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] for x in run["results"]
    ]
    assert files.count(FAILING) == 2  # a claim and a hint
    assert files.count(INVALID) > 3
    assert GOOD not in files


LOSING = """
methods:
  - {family: lobatto-iiia, stages: 3}
  - {A: [[0, 0, 0, 0], [1/3, 0, 0, 0], [-1/3, 1, 0, 0], [1, -1, 1, 0]], b: [1/8, 3/8, 3/8, 1/8]}
transfer: {rule: legendre, degree: 4}
"""


def written(folder: Path, text: str) -> Path:
    """A file with a text."""
    path = folder / "m.gark.yaml"
    path.write_text(text, encoding="utf-8")
    return path


def undecided(folder: Path) -> Outcome:
    """A rounded file of which one claim fails, one is undecided."""
    path = folder / "rounded.gark.yaml"
    path.write_text(UNDECIDED, encoding="utf-8")
    return check_file(str(path))


EXAMPLES = {
    "unreadable": "methods: 1\n",
    "claim": f"{MIDPOINT}expect: {{order: 3}}\n",
    "undecided": UNDECIDED.replace(", order: 3", ""),
    "no-claim": MIDPOINT,
    "loses-pair-order": LOSING,
    "weights": "A: [[0, 0], [1/2, 0]]\nb: [1, 1]\n",
    "misprint": "A: [[0, 0, 0, 0], [1/2, 0, 0, 0], [0, 1/3, 0, 0], [0, 0, 1, 0]]\nb: [1/6, 1/3, 1/3, 1/6]\n",
    "looks-rounded": "A: [[0.25, -0.0386751346], [0.5386751346, 0.25]]\nb: [1/2, 1/2]\n",
    "failing-conditions": "A: [[0, 0], [1/2, 0]]\nb: [1/2, 1/2]\nexpect: {order: 3}\n",
}
"""A file for each kind of finding: a new kind needs one."""
BESIDE = {"claim": ["failing-conditions"], "weights": ["misprint"], "failing-conditions": ["claim"]}
"""The other findings on such a file, the errors first."""
PLACES = {"weights": (2, 4), "misprint": (1, 39), "failing-conditions": (3, 17)}
"""The places of findings that are not about a whole file: a row, an entry, a claim."""
LABELS = {
    "claim": ("CLAIM FAILS", "FAIL"),
    "undecided": ("undecided", "open"),
    "no-claim": ("NO CLAIM", "FAIL"),
    **dict.fromkeys(["weights", "misprint", "looks-rounded", "failing-conditions"], ("hint",) * 2),
}
"""The words for people in place of level and code, of one file and in the line of several."""
SIGNS = {"claim": "fails</span>", "undecided": "undecided</span>", "no-claim": "claims nothing"}
"""The signs of findings on claims in the page; others have their codes."""


class Example(NamedTuple):
    """A file and a finding on it."""

    outcome: Outcome
    finding: Finding

    @property
    def remark(self) -> Remark:
        return self.finding.remark

    @property
    def is_hint(self) -> bool:
        return self.remark.level == "hint"

    @property
    def begin(self) -> str:
        """What is wrong, without the reason."""
        return self.remark.message.partition("; ")[0]

    def text(self, format: str, *others: Outcome) -> str:
        return words(FORMATS[format]([self.outcome, *others], Look(), 0, None, 80))


@pytest.fixture(params=findings_of("check"))
def example(request: pytest.FixtureRequest, tmp_path: Path) -> Example:
    made = check_file(str(written(tmp_path, EXAMPLES[request.param])))
    made = replace(made, needs_claims=request.param == "no-claim")
    beside = BESIDE.get(request.param, [])
    assert sorted(x.rule for x in findings(made)) == sorted([request.param, *beside])
    return Example(made, next(x for x in findings(made) if x.rule == request.param))


def other() -> Outcome:
    return outcome(MIDPOINT.replace("1/2", "0"), "other.gark.yaml")


def test_text_has_every_finding_once(example: Example) -> None:
    """One file and several, with code and level or with a label, and with the cure; a hint has them
    with -v.
    """
    alone, short = LABELS.get(example.finding.rule, (example.remark.code, example.remark.code))
    one, several = example.text("text"), example.text("text", other())
    assert (alone in one, short in several) == (True, True)
    for text in (one, several):
        assert text.count(example.begin) == (example.finding.rule != "no-claim")  # its label
        assert example.remark.help in text or example.is_hint
        assert example.finding.rule in LABELS or example.remark.level in text
    if example.is_hint:
        whole = words(FORMATS["text"]([example.outcome], Look(), 1, None, 80))
        assert f"({example.remark.code}) help {example.remark.help}" in whole


def test_markdown_has_every_finding(example: Example) -> None:
    """With its code in the list, of several files; of one in the table, claims in both."""
    one, several = example.text("markdown"), example.text("markdown", other())
    for text in (one, several):
        assert example.remark.code in text or example.is_hint
        assert example.remark.help in plain(text) or example.is_hint
    assert example.remark.code in several
    assert example.remark.help in several
    assert several.count(plain(example.begin)) == 1
    times = 2 if example.finding.rule in {"claim", "undecided"} else 1
    assert plain(one).count(plain(example.begin)) == times
    assert example.remark.level == "error" or f"{example.remark.level}: " in several


def test_latex_and_the_page_have_every_finding(example: Example) -> None:
    """Claims have a table of their own in the page."""
    label, _ = LABELS.get(example.finding.rule, (example.remark.code, ""))
    assert label in example.text("latex")
    assert f"({example.remark.code})" in example.text("latex") or example.finding.rule in SIGNS
    page = render([reported(example.outcome.file, None, has_pictures=False)], has_details=True)
    assert SIGNS.get(example.finding.rule, f">{example.remark.code}</span>") in page


def test_json_has_every_finding(example: Example) -> None:
    """All of them in one list, also the faults; the place is null where the file is meant."""
    [data, silent] = REPORT.document([example.outcome, other()])["files"]
    assert silent["findings"] == []
    assert len(data["findings"]) == 1 + len(BESIDE.get(example.finding.rule, []))
    [told] = [x for x in data["findings"] if x["message"] == example.remark.message]
    place = {key: told.pop(key) or 1 for key in ("line", "column")}
    assert {**told, **place} == {
        key: getattr(example.remark, key)
        for key in ("line", "column", "code", "message", "help", "level")
    }


def test_formats_of_ci_have_every_finding(example: Example) -> None:
    """SARIF and GitHub with level, code and cure; JUnit as a case or in the output of one."""
    remark, rule = example.remark, example.finding.rule
    [result] = [x for x in sarif(example.outcome)["results"] if x["ruleId"] == rule]
    code = result.get("properties", {}).get("code", rule)
    level = "note" if example.is_hint else remark.level
    assert (code, result["level"]) == (remark.code, level)
    assert result["message"]["text"].startswith(remark.message)
    assert result["message"]["text"].endswith(remark.help)
    told = annotations(example.outcome, level="notice" if example.is_hint else remark.level)
    [(place, text)] = [x for x in told if x[0]["title"] == f"gark: {rule}"]
    assert (place["line"], place["col"]) == (str(remark.line), str(remark.column))
    assert (remark.line, remark.column) == PLACES.get(rule, (remark.line, remark.column))
    assert text.startswith(remark.message)
    assert text.endswith(remark.help)
    suite = junit(example.outcome)
    in_suite = " ".join([*(str(x.attrib) for x in suite.iter()), *suite.itertext()])
    assert example.begin.rpartition(": expected")[2] in in_suite
    assert rule in in_suite or remark.help in in_suite or "hint: " in in_suite


def test_sarif_names_its_rules(example: Example) -> None:
    """Each result's rule index points at the rule with the result's rule id, in words."""
    run = sarif(example.outcome)
    rules = run["tool"]["driver"]["rules"]
    assert [x["id"] for x in rules] == list(findings_of("check"))
    [result] = [x for x in run["results"] if x["ruleId"] == example.finding.rule]
    named = rules[result["ruleIndex"]]
    assert named["id"] == result["ruleId"] == example.finding.rule
    kind = findings_of("check")[example.finding.rule]
    assert kind.text.startswith(named["shortDescription"]["text"])
    assert named["help"]["text"].startswith(kind.cure)


@pytest.mark.parametrize("format", ["sarif", "github", "markdown", "json", "junit", "text"])
def test_a_warning_fails_nothing(format: str, tmp_path: Path) -> None:
    """A rule that loses the order has one; a degree that keeps the order has none."""
    run = gark("check", str(written(tmp_path, LOSING)), "--format", format)
    assert run.code == 0
    assert "loses symplectic pair order 4" in words(run.out)
    good = gark("check", str(written(tmp_path, LOSING.replace("4}", "2}"))), "--format", format)
    assert "loses symplectic pair order" not in good.out
    quiet = gark("check", str(written(tmp_path, LOSING)), "--quiet")
    assert (quiet.code, quiet.out) == (0, "")


def test_sarif_has_the_codes_of_faults() -> None:
    """What is wrong with a file that cannot be read has its code, other results have none."""
    run = sarif(outcome(WRONG), outcome("methods: 1\n"))
    codes = {x["ruleId"]: x.get("properties") for x in run["results"]}
    assert codes == {"claim": None, "unreadable": {"code": "list-expected"}}


def test_sarif_points_at_the_claim() -> None:
    """The region of a failed claim is where its value stands, in characters and not in bytes."""
    text = f"{MIDPOINT}expect: {{'C': [[9]], order: 3}} # é\n".replace(
        "methods", "name: αβγ\nmethods"
    )
    text = text.replace("expect: {", "expect: { ? 'bound'\n : '>= 7', ")
    found = sarif(outcome(text))["results"]
    regions = [x["locations"][0]["physicalLocation"]["region"] for x in found]
    lines = text.splitlines()
    values = [lines[region["startLine"] - 1][region["startColumn"] - 1 :] for region in regions]
    assert [value[:4] for value in values] == ["'>= ", "[[9]", "3} #"]


def test_a_region_starts_at_one_where_no_place_is_known() -> None:
    """A file that is not there has no line; the region is still one of the standard."""
    fault = Outcome("nowhere.gark.yaml", "nowhere", faults=(Remark("no such file"),))
    (result,) = sarif(fault)["results"]
    assert result["locations"][0]["physicalLocation"]["region"] == {
        "startLine": 1,
        "startColumn": 1,
    }


def test_fingerprints_do_not_move() -> None:
    """Lines inserted above and other blanks leave every fingerprint as it was."""
    moved = "# a comment\n\nname: later named\n" + WRONG.replace("{order", "{   order")
    assert len(fingerprints(WRONG)) == 3
    assert fingerprints(moved) == fingerprints(WRONG)
    bad = "methods: [{family: gaus, stages: 2}]\ncolour: red\n"
    assert len(fingerprints(bad)) == len(set(fingerprints(bad))) >= 1
    assert fingerprints(f"# a comment\n\n{bad}") == fingerprints(bad)


def test_fingerprints_tell_findings_apart() -> None:
    """Two claims, two files, and two faults with the same words have different fingerprints."""
    assert len(set(fingerprints(WRONG))) == 3
    assert not set(fingerprints(WRONG)) & set(fingerprints(WRONG, "n.gark.yaml"))
    same = Outcome("m", "m", faults=(Remark("no", "", 1, 1), Remark("no", "", 2, 1)))
    assert len({x.fingerprint for x in findings(same)}) == 2


def test_a_claim_that_still_fails_keeps_its_fingerprint() -> None:
    """The same claim with another number is the same finding."""
    assert fingerprints(f"{MIDPOINT}expect: {{order: 3}}") == fingerprints(
        f"{MIDPOINT}expect: {{order: 4}}"
    )


@pytest.mark.parametrize(
    "file", [AWKWARD, "späße/m.gark.yaml", "C:m.gark.yaml", "a b.gark.yaml", "#1?.gark.yaml"]
)
def test_a_file_name_is_a_uri(file: str) -> None:
    """Any file name becomes a URI reference that gives the name back."""
    run = sarif(outcome(WRONG, file))
    uris = {
        x["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] for x in run["results"]
    }
    assert {unquote(uri) for uri in uris} == {file}


def test_undecided_claims_do_not_fail(tmp_path: Path) -> None:
    """A claim that is undecided is no failure: a warning of SARIF and GitHub, a skipped case of JUnit; Python and
    the text tell both apart.
    """
    found = undecided(tmp_path)
    assert [x.claim for x in found.failed_claims] == ["order"]
    assert [x.claim for x in found.undecided_claims] == ["p-stable"]
    levels = {x["ruleId"]: x["level"] for x in sarif(found)["results"]}
    assert levels == {"claim": "error", "undecided": "warning", "failing-conditions": "note"}
    (suite,) = junit(found)
    tags = {(case.get("name") or "").partition(":")[0]: [x.tag for x in case] for case in suite}
    assert tags == {"is a method": ["system-out"], "p-stable": ["skipped"], "order": ["failure"]}
    still_open = replace(found, claims=found.undecided_claims)
    summary = REPORT.document([found, still_open])["summary"]
    assert summary == {"files": 2, "failed": 1, "undecided": 1, "without_claims": 0}
    text = check_findings.github([found])
    assert re.findall("^::(error|warning) .*::(.*): expected", text, re.M) == [
        ("error", "order"),
        ("warning", "p-stable"),
    ]


# -- JUnit --------------------------------------------------------------------------------------------------------


def junit(*outcomes: Outcome) -> ET.Element:
    """A JUnit report whose counts are those of its cases."""
    root = ET.fromstring(check_findings.junit(outcomes))
    assert (root.tag, {suite.tag for suite in root}) == ("testsuites", {"testsuite"})
    for part in (root, *root):
        for count, path in (
            ("tests", ".//testcase"),
            ("failures", ".//failure"),
            ("errors", ".//error"),
            ("skipped", ".//skipped"),
        ):
            assert part.get(count) == str(len(part.findall(path)))
    assert all(case.get("name") and case.get("classname") for case in root.iter("testcase"))
    return root


def test_junit_has_a_case_a_claim() -> None:
    """Each claim of a file is a case beside the one that says the file is a method; the failed ones fail."""
    suite, other = junit(outcome(WRONG), outcome(MIDPOINT, "n.gark.yaml"))
    names = [case.get("name") for case in suite]
    assert names == ["is a method", "order: 3", "symplectic: false", "bound: 2", "B: [5]"]
    failed = [case.get("name") for case in suite if case.find("failure") is not None]
    assert failed == ["order: 3", "symplectic: false", "B: [5]"]
    assert [case.get("name") for case in other] == ["is a method"]
    assert {case.get("line") for case in suite[1:]} == {"2"}


def test_junit_of_an_unreadable_file_is_one_error() -> None:
    """A file that is no method is one case in error with every fault in its text."""
    (suite,) = junit(outcome("methods: [{family: gauss, stages: x}]\ncolour: red\n"))
    (case,) = suite
    (error,) = case
    assert (case.get("name"), error.tag) == ("is a method", "error")
    assert error.get("message")
    assert len((error.text or "").splitlines()) == 2
    assert re.match(r"1:\d+: ", error.text or "")


def test_junit_of_real_files() -> None:
    """The counts of a whole run are those of its files: one claim fails, one file is in error."""
    root = ET.fromstring(gark("check", *FILES, "--format", "junit").out)
    assert (root.get("failures"), root.get("errors")) == ("1", "1")
    assert [suite.get("name") for suite in root] == list(FILES)


@pytest.mark.parametrize(
    "sign", ["\0", "\x07", "\x1b", "\ud800", "\uffff", "\x7f", "<", "&", '"', "\n", "]]>"]
)
def test_junit_parses_whatever_a_file_is_called(sign: str) -> None:
    """What XML cannot write is replaced, other control characters are written out, all else stays."""
    file = f"a{sign}b.gark.yaml"
    faulty = Outcome(file, file, faults=(Remark(f"unknown {sign}", f"no {sign}", 1, 1),))
    (suite, broken) = junit(outcome(WRONG, file), faulty)
    allowed = sign not in {"\0", "\x07", "\x1b", "\ud800", "\uffff"}
    assert (
        suite.get("name")
        == broken.get("name")
        == (file.replace("\x7f", "\\x7f") if allowed else "a\N{REPLACEMENT CHARACTER}b.gark.yaml")
    )


# -- GitHub -------------------------------------------------------------------------------------------------------

_COMMAND = re.compile(r"::[a-z]+ ((?:[a-z]+=[^,:\n]*)(?:,[a-z]+=[^,:\n]*)*)::(.*)")


def annotations(*outcomes: Outcome, level: str = "error") -> list[tuple[dict[str, str], str]]:
    """The annotations as the runner of GitHub reads them: properties and text, unescaped."""
    found = []
    for line in check_findings.github(outcomes).split("\n"):
        if line.startswith(f"::{level} "):
            match = _COMMAND.fullmatch(line)
            assert match, line
            properties = dict(part.split("=", 1) for part in match[1].split(","))
            found.append(
                (
                    {key: _unescaped(value) for key, value in properties.items()},
                    _unescaped(match[2]),
                )
            )
    return found


def _unescaped(text: str) -> str:
    for code, sign in (("%0D", "\r"), ("%0A", "\n"), ("%3A", ":"), ("%2C", ","), ("%25", "%")):
        text = text.replace(code, sign)
    return text


def test_each_finding_is_an_annotation_in_its_place() -> None:
    """A failed claim is annotated on its own line and column, with rule and message."""
    found = annotations(outcome(WRONG), outcome(MIDPOINT))
    places = [(x["file"], x["line"], x["col"], x["title"]) for x, _ in found]
    assert places[0] == ("m.gark.yaml", "2", "17", "gark: claim")
    assert [text for _, text in found] == [
        "order: expected 3, found 2; fails at order 3: [[[]]]: 1/4 instead of 1/6, off by 1/12",
        "symplectic: expected false, found true",
        "B: expected [5], found [2]",
    ]


def test_claims_that_fail_for_one_reason_say_so(tmp_path: Path) -> None:
    """One wrong entry of Gauss 2 fails its orders and symplecticity: each finding names that entry,
    which restores them; a claim that stays wrong is not among them.
    """
    claims = "order: 4, conjugate-order: 4, pair-order: 5, symplectic: true, B: [4]"
    rows = "A: [[1/4, 1/4 - sqrt(3)/6], [1/4 + sqrt(3)/6, 1/3]]\nb: [1/2, 1/2]\n"
    file = tmp_path / "gauss.gark.yaml"
    file.write_text(f"{rows}expect: {{{claims}}}\n")
    found = check_file(str(file))
    assert found.blame is not None
    assert found.blame.restores == ("conjugate-order", "symplectic")
    repair = "a[2,2] = 1/4 instead of 1/3"
    consequence = f"it fails with order, and would hold with {repair}"
    assert [(x.remark.message.partition(":")[0], x.remark.help) for x in findings(found)] == [
        ("order", f"the claimed order would hold with {repair}"),
        ("conjugate-order", consequence),
        ("pair-order", ""),
        ("symplectic", consequence),
        ("B", ""),
        (
            "the one condition of order 2 fails; the claimed order would hold with a[2,2] = 1/4 instead of 1/3, and so would conjugate-order, symplectic",
            "compare the number with the paper",
        ),
    ]
    text = check_text.render([found], Look())
    assert f"would hold with {repair}, and so would conjugate-order, symplectic" in words(text)
    (data,) = REPORT.document([found])["files"]
    assert data["blame"]["restores"] == ["conjugate-order", "symplectic"]


def test_a_failed_claim_on_a_bound_says_what_it_is_made_of() -> None:
    """The message has the formula and its numbers, of the pair for the pair; nothing where a zero
    weight leaves no pair.
    """
    claims = "bound: 3, sharp-bound: 3, pair-sharp-bound: 3"
    found = annotations(outcome(f"{HEUN}expect: {{{claims}}}\n"))
    numbers = "r = 2, η = 1, ζ = 1, ξ = 2, χ = 2"
    printed, sharper = ("min{r, 2η+2, ξ+1, η+ζ+1}", "min{r, 2η+2, ξ+1, χ+2, η+ζ+3}")
    assert [text for _, text in found] == [
        f"bound: expected 3, found 2; 2 = {printed} with {numbers}",
        f"sharp-bound: expected 3, found 2; 2 = {sharper} with {numbers}",
        f"pair-sharp-bound: expected 3, found 2; 2 = {sharper} with {numbers}",
    ]
    midpoint = "methods: [{family: explicit-midpoint}]\nexpect: {pair-sharp-bound: 2}\n"
    ((_, text),) = annotations(outcome(midpoint))
    assert text == "pair-sharp-bound: expected 2, found none: a weight is zero"


@pytest.mark.parametrize(
    "file", [AWKWARD, "%0A.gark.yaml", "::error ::.gark.yaml", "a\r\nb", "x,line=9.gark.yaml"]
)
def test_annotations_escape_file_names(file: str) -> None:
    """Percent, newline, comma and colon in a file name come back as they were and add no property."""
    found = annotations(outcome(WRONG, file))
    assert [x["file"] for x, _ in found] == [file] * 3
    assert {frozenset(x) for x, _ in found} == {frozenset({"file", "line", "col", "title"})}


def test_annotations_escape_messages() -> None:
    """Percent signs and line ends in messages and cures come back as they were."""
    fault = Remark("100%\nof %0A, a: b\r", "cure %25", 3, 4)
    ((place, text),) = annotations(Outcome("m", "m", faults=(fault,)))
    assert text == "100%\nof %0A, a: b\r; cure %25"
    assert (place["line"], place["col"]) == ("3", "4")


@in_whole
def test_the_format_auto_knows_where_it_runs() -> None:
    """``auto`` annotates under GITHUB_ACTIONS=true alone, and is text anywhere else."""
    outcomes = {}
    for value in ("true", "false", ""):
        with patch.dict("os.environ", {"GITHUB_ACTIONS": value}):
            outcomes[value] = CliRunner().invoke(commands, ["check", str(ROOT / FAILING)]).output
    assert outcomes["true"].startswith("::error file=")
    assert outcomes["false"] == outcomes[""]
    assert "::error" not in outcomes[""]
    asked = CliRunner().invoke(
        commands, ["check", str(ROOT / FAILING), "--format", "text"], env={"GITHUB_ACTIONS": "true"}
    )
    assert asked.output == outcomes[""]


# -- Markdown -----------------------------------------------------------------------------------------------------


def rows(outcomes: Sequence[Outcome]) -> list[list[str]]:
    """The cells of the table, where a pipe after a backslash belongs to a cell."""
    lines = FORMATS["markdown"](outcomes, Look(), 0, None, 80).split("\n")
    table = [line for line in lines if line.startswith("|")]
    return [[cell.strip() for cell in re.split(r"(?<!\\)\|", line)[1:-1]] for line in table]


def test_markdown_has_a_row_a_file() -> None:
    """Orders, bound and claims stand under their heads; what fails is set off."""
    head, rule, wrong, right, bad = rows([outcome(WRONG), outcome(MIDPOINT), outcome("methods: 1")])
    labels = [
        "file",
        "order",
        "conjugate order",
        "symplectic pair",
        "bound",
        "symplectic",
        "claims",
    ]
    assert head == labels
    assert set(rule) == {"---"}
    assert wrong == ["m.gark.yaml", "2", "2", "2", "2", "yes", "**3 of 4 fail**"]
    assert right[-1] == "none"
    assert bad == ["m.gark.yaml", "", "", "", "", "", "cannot be read"]


def test_markdown_of_one_file_is_its_report() -> None:
    """The answer is set off, labels and words are a table, findings with their places follow."""
    text = FORMATS["markdown"]([outcome(WRONG)], Look(), 0, None, 80)
    first, *_ = text.splitlines()
    assert first == "**m.gark.yaml: order 2, proved; order 3 fails at `[[[]]]` by 1/12**"
    failing = "| CLAIM FAILS | order: expected 3, found 2"
    assert len([line for line in text.splitlines() if line.startswith(failing)]) == 1
    assert len([line for line in text.splitlines() if line.startswith("- `m.gark.yaml:2:")]) == 3


def test_markdown_says_what_is_a_lower_bound() -> None:
    """An order at which the search stopped is not shown as the order."""
    limited = outcome("methods: [{family: gauss, stages: 3}]", limit=2)
    _, _, row, _ = rows([limited, outcome(MIDPOINT)])
    assert row[1:4] == ["at least 2"] * 3
    alone = FORMATS["markdown"]([limited], Look(), 0, None, 80)
    assert alone.startswith("**m.gark.yaml: order at least 2; ")


@pytest.mark.parametrize("file", [AWKWARD, "|", "a`b", "a\nb|c", "<b>", "*a*_b_[c](d)"])
def test_markdown_cells_hold_any_file_name(file: str) -> None:
    """Pipes, backticks and line ends of a file name stay inside their cell and their code, and no
    sign of it is markup.
    """
    pair = [outcome(WRONG, file), outcome(MIDPOINT)]
    text = FORMATS["markdown"](pair, Look(), 0, None, 80)
    _, _, row, _ = rows(pair)
    assert len(row) == 7
    shown = row[0].replace("&lt;", "<")
    assert re.sub(r"\\([^a-z])", r"\1", shown) == file.replace("\n", "\\n")
    assert not re.search(r"[|*_`\[\]<]", re.sub(r"\\[^a-z]", "", row[0]))
    assert len([line for line in text.split("\n") if line.startswith("- `")]) == 3


def test_markdown_escapes_messages() -> None:
    """A message cannot start a tag or a column, and is one line."""
    text = FORMATS["markdown"](
        [Outcome("m", "m", faults=(Remark("a <b> | c\nd \\", "", 1, 1),))], Look(), 0, None, 80
    )
    assert "| error | line 1, column 1: a &lt;b> \\| c\\nd \\\\ (fault) |" in text


def test_no_format_forgets_a_finding() -> None:
    """Text, annotations, SARIF, JUnit and Markdown of one run have the same findings."""
    outcomes = [
        outcome(WRONG),
        outcome("methods: [{family: gaus, stages: 2}]\ncolour: red\n", "n.gark.yaml"),
    ]
    messages = [x.remark.message for each in outcomes for x in findings(each)]
    assert len(messages) >= 4
    cases = [x for x in junit(*outcomes).iter() if x.tag in {"failure", "error"}]
    in_junit = " ".join(f"{case.get('message')} {case.text}" for case in cases)
    # JUnit has the parts of a message in places of their own
    parts = [x for message in messages for x in message.partition(": ")[2].split("; ")]
    assert all(part in in_junit for part in parts)
    results = [x["message"]["text"] for x in sarif(*outcomes)["results"]]
    shown = [text for _, text in annotations(*outcomes)]
    for said in (results, shown):
        assert all(x.startswith(message) for x, message in zip(said, messages, strict=True))
    markdown = FORMATS["markdown"](outcomes, Look(), 0, None, 80)
    assert all(message in markdown for message in messages)
    text = check_text.render(outcomes, Look(False))
    assert all(message.partition("; ")[0] in text for message in messages)


# -- witness, hint, missing claims -----------------------------------------------------------------

BLAMED = "methods: [{A: [[0, 0], [1/3, 0]], b: [0, 1]}]\nexpect: {order: 2}\n"


def blamed(tmp_path: Path) -> Outcome:
    """A method that misses its claim by one entry."""
    file = tmp_path / "m.gark.yaml"
    file.write_text(BLAMED)
    return check_file(str(file))


def test_every_format_for_machines_has_witness_and_hint(tmp_path: Path) -> None:
    """The tree whose condition fails, by how much, and the entry that would mend it."""
    found = blamed(tmp_path)
    texts = {
        "sarif": json.loads(check_findings.sarif([found]))["runs"][0]["results"][0]["message"][
            "text"
        ],
        "junit": ET.fromstring(check_findings.junit([found])).find(".//failure").text,  # type: ignore[union-attr]
        "github": check_findings.github([found]).splitlines()[0],
        "markdown": FORMATS["markdown"]([found], Look(), 0, None, 80),
        "json": json.dumps(REPORT.document([found])),
    }
    for name, text in texts.items():
        assert text is not None, name
        assert "[[]]" in text or "[[]_1]_1" in text, name
        assert "-1/6" in text, name
        assert "1/2" in text, name
    assert "a[2,1] = 1/2 instead of 1/3" in texts["sarif"]


def test_files_without_claims_are_counted_and_may_fail(tmp_path: Path) -> None:
    """They are counted in every summary; with --require-claims each of them fails."""
    for name in "ab":
        (tmp_path / f"{name}.gark.yaml").write_text(MIDPOINT)
    (tmp_path / "c.gark.yaml").write_text(f"{MIDPOINT}expect: {{order: 2}}\n")
    run = gark("check", ".", cwd=tmp_path)
    assert (run.code, run.out.rstrip().endswith("all hold; 2 files make no claim")) == (0, True)
    run = gark("check", ".", "--require-claims", cwd=tmp_path)
    assert (run.code, run.out.count("NO CLAIM")) == (1, 2)
    data = json.loads(gark("check", ".", "--require-claims", "--format", "json", cwd=tmp_path).out)
    assert data["summary"] == {"files": 3, "failed": 2, "undecided": 0, "without_claims": 2}
    assert [file["ok"] for file in data["files"]] == [False, False, True]
    junit_report = gark("check", ".", "--require-claims", "--format", "junit", cwd=tmp_path).out
    assert ET.fromstring(junit_report).get("failures") == "2"
    for name in ("github", "sarif", "markdown"):
        shown = gark("check", ".", "--require-claims", "--format", name, cwd=tmp_path).out
        assert shown.count("the file makes no claim") >= 2, name


def test_the_formats_are_the_choice() -> None:
    """One dictionary is what can be asked for and what writes it."""
    (option,) = [x for x in command_of("check").params if x.name == "format"]
    assert list(option.type.choices) == ["auto", *FORMATS]  # type: ignore[attr-defined]
