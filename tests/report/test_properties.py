"""Properties in the reports of gark check, and what a claim means."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft7Validator

import garkcli
from garkcli.errors import UsageProblem
from garkcli.methodfile.expectations import CLAIMS
from garkcli.properties.registry import KEYS
from garkcli.report.checked import REPORT
from garkcli.report.meaning import REPORT as MEANINGS
from tests.cli.harness import ROOT, gark
from tests.whole import sample

METHODS = sorted((ROOT / "methods").glob("*.yaml"))
STAGES = "A: [[0, 0, 0], [1/4, 1/4, 0], [1/3, 1/3, 1/3]]\nb: [1/3, 1/3, 1/3]\n"


def report(*arguments: str, stdin: str = "") -> dict[str, Any]:
    """The only file of a JSON report, which its schema allows."""
    run = gark("check", *arguments, "--format", "json", stdin=stdin)
    data = json.loads(run.out)
    assert list(Draft7Validator(REPORT.schema).iter_errors(data)) == []
    (file,) = data["files"]
    return dict(file)


@pytest.mark.parametrize("path", sample(METHODS, 4), ids=lambda x: x.name)
def test_every_property_of_every_method(path: Path) -> None:
    """Text of 80 columns and JSON by its schema; both tell the same as the call in Python."""
    text = gark("check", str(path), "--properties")
    assert text.code == 0
    block = text.out.partition("\n  explicit ")[2]
    assert max(map(len, block.splitlines())) <= 80
    found = report(str(path), "--properties")
    listed = {x["property"]: x for x in found["every_property"]}
    assert list(listed) == list(KEYS)
    short = found["properties"]
    for key in ("explicit", "fsal", "symmetric", "reducible", "implicit-stages"):
        assert short[key.replace("-", "_")] == listed[key]["value"]
    verdict = garkcli.find_property(garkcli.load(str(path)), "l-stable")
    assert listed["l-stable"]["value"] == verdict.value
    assert listed["l-stable"]["why"] == verdict.why


def test_the_line_of_a_plain_check() -> None:
    """What is worth a word, and no more: two γ are none. With details each property has a row."""
    text = " ".join(gark("check", "-", stdin=STAGES).out.split())
    assert " diagonally implicit, 3 stages; " in text
    assert " stiffly accurate, first same as last" in text
    assert "symmetric" not in text
    assert "γ" not in text
    rows = gark("check", "-", "-v", stdin=STAGES).out
    assert re.search(r"^    implicit stages +2$", rows, re.MULTILINE)
    assert re.search(r"^    symmetric +no: ", rows, re.MULTILINE)


def test_systems_and_renumberings_in_json() -> None:
    """Gauss 2 and Lobatto IIIA 3: who is solved with whom; x → 1 − x. Of the rectangular method
    spelled out, the numbers of stages.
    """
    found = report("methods/collocation.gark.yaml")["properties"]
    first, second = ({"colours": ["1"], "stages": [1, 2]}, {"colours": ["2"], "stages": [2, 3]})
    assert found["solved_together"] == [[first, second]]
    assert [x["stages"] for x in found["renumbering"]] == ["1 - x", "1 - x"]
    found = report("methods/rectangular.gark.yaml")["properties"]
    assert [x["stages"] for x in found["renumbering"]] == [[2, 1], [3, 2, 1]]
    assert [x["kind"] for x in found["by_colour"]] == [None, None]


def test_a_failed_claim_says_why_in_every_format() -> None:
    """The reason is in the text, the JSON and the formats for machines."""
    text = f"{STAGES}expect: {{esdirk: true}}\n"
    why = "stages depend on themselves by 1/4 and by 1/3"
    (claim,) = report("-", stdin=text)["claims"]
    assert claim["why"] == why
    for format in ("text", "github", "sarif", "junit", "markdown"):
        run = gark("check", "-", "--format", format, stdin=text)
        assert run.code == 1
        assert why in " ".join(run.out.split()), format


def test_a_stage_order_at_the_limit_is_a_lower_bound() -> None:
    """With --max-order 1 no more is known; a claim on more raises the limit."""
    text = "methods: {family: gauss, stages: 3}\n"
    found = report("-", "--max-order", "1", stdin=text)["properties"]
    assert (found["stage_order"], found["stage_order_is_lower_bound"]) == (1, True)
    claimed = f"{text}expect: {{stage-order: 3}}\n"
    run = gark("check", "-", "--max-order", "1", stdin=claimed)
    assert run.code == 0


@pytest.mark.parametrize("key", CLAIMS)
def test_every_claim_is_explained(key: str) -> None:
    """As text of 80 columns with its source, in ASCII too, and as JSON by its schema."""
    run = gark("explain", key)
    assert (run.code, run.err) == (0, "")
    lines = run.out.splitlines()
    assert f"{key}: claim under expect" in lines
    assert max(map(len, lines)) <= 80
    assert any(line.startswith("  source  ") for line in lines)
    assert gark("explain", key, encoding="ascii").out.isascii()
    told = gark("explain", key, "--format", "json")
    data = json.loads(told.out)
    claimed = [x["name"] for x in data["meanings"] if x["kind"] == "claim under expect"]
    assert claimed == [key]
    assert gark("check", "--explain", key, "--format", "json") == told  # its former name
    assert list(Draft7Validator(MEANINGS.schema).iter_errors(data)) == []


def test_an_unknown_key_has_a_suggestion() -> None:
    """Exit code 2, and the nearest key; so has a check of no file its usage."""
    run = gark("explain", "stiffly-acurate")
    assert (run.code, run.out) == (2, "")
    assert "did you mean 'stiffly-accurate'?" in run.err
    none = gark("check")
    assert none.code == 2
    assert "Missing argument 'FILE...'" in none.err


def test_the_calls_in_python() -> None:
    """A property by its name, within the tolerance of the method or without; a smaller method."""
    method = garkcli.loads(f"name: a\n{STAGES}")
    assert garkcli.find_property(method, "ssp-coefficient").value is not None
    with pytest.raises(UsageProblem):
        garkcli.find_property(method, "stable")
    same = garkcli.reduced(method)
    assert same is not None
    assert same.tableau is method.tableau
    rounded = garkcli.loads("A: [[0.333333]]\nb: [1]\ntolerance: 1e-6")
    assert garkcli.find_property(rounded, "real-stability").is_undecided
    assert not garkcli.find_property(rounded, "real-stability", 0).is_undecided


@pytest.mark.parametrize(
    ("text", "properties", "conjugate"),
    [
        ("A: [[0, 0], [1/2, 0]]\nb: [0, 1]\n", r"no: $b_{1}$ is $0$", r"weights b, $b_{1} = 0$"),
        (
            "methods:\n- {A: [[0, 0], [1, 0]], b: [-1/2, 3/2]}\n- {family: gauss, stages: 1}\n"
            "transfer: collocation\n",
            r"no: $b^{(1)}_{1}$ is $-\frac{1}{2}$",
            "1, proved",
        ),
    ],
)
def test_reasons_are_formulas_in_latex(text: str, properties: str, conjugate: str) -> None:
    """Entries have indices there, and colours where there are several."""
    out = gark("check", "-", "--format", "latex", stdin=text).out
    assert f"positive weights & {properties} " in out
    assert re.search(rf"conjugate order & .*{re.escape(conjugate)}", out)
    assert (r"^{(" in out) == ("methods" in text)
