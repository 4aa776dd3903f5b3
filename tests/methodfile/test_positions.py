"""Where faults are: all of them, in file order, with the caret under the culprit."""

import subprocess
import sys
from pathlib import Path

import pytest

from garkcli.errors import MethodFileError, Remark
from garkcli.glossary.key import METHOD_FILE
from garkcli.grammar.source import Source
from garkcli.methodfile.load import load, loads
from garkcli.report import remarks
from garkcli.tell.dialect import Plain
from tests.whole import in_whole


def faults(text: str) -> tuple[Remark, ...]:
    """What is wrong with the text of a method file."""
    with pytest.raises(MethodFileError) as caught:
        loads(text, "m")
    return caught.value.faults


def under_caret(text: str) -> list[str]:
    """For each fault the rest of the line that its caret stands under, read off the rendered
    report.
    """
    found = faults(text)
    lines = list(remarks.lines(found, "m", text, Plain()))
    carets = [i for i, line in enumerate(lines) if line.lstrip(" |") == "^"]
    return [lines[i - 1][lines[i].index("^") :] for i in carets]


def test_all_faults_of_a_file_come_at_once_and_in_file_order() -> None:
    """Ten faults of ten kinds, read in an order that is not the file's, are reported line by
    line.
    """
    text = (
        "nam: x\n"
        "structure: nystrm\n"
        "tolerance: [1]\n"
        "parameters: {tau: 1/0x}\n"
        "methods:\n"
        "  - {family: gaus, stages: 2}\n"
        "  - A: [[0, 1], [1, yes]]\n"
        "    b: [1/2, 010]\n"
        "transfer: colocation\n"
        "expect: {order: four}\n"
    )
    found = faults(text)
    assert [fault.line for fault in found] == [1, 2, 3, 4, 6, 7, 8, 9, 10]
    assert all(fault.column > 0 for fault in found)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("name: x\n# more\nmethods: [\1]\n", (3, 11)),
        ("name: 🌲 é\nreference: \x1b[0m\n", (2, 12)),
        ("\ufeffname: ü\x7f\n", (1, 9)),
        ("\0", (1, 1)),
    ],
)
def test_signs_that_yaml_refuses(text: str, place: tuple[int, int]) -> None:
    """A control character is reported where it stands, whatever stands before it."""
    (fault,) = faults(text)
    assert "has the control character U+00" in fault.message
    assert (fault.line, fault.column) == place


@pytest.mark.parametrize("text", ["|", ">", "name: a\ntransfer: |", "a: >-", "methods: |-\n"])
def test_blocks_of_text_without_text(text: str) -> None:
    """An empty block at the end of the file is a place too."""
    assert all(fault.line >= 1 and fault.column >= 1 for fault in faults(text))


def test_one_stage_is_no_plural() -> None:
    """Sizes are counted in English."""
    (fault,) = faults("methods: [{A: [[1]], b: [1], c: [1, 2]}]")
    assert fault.message.endswith("has 2 entries for 1 stage")
    (fault,) = faults("methods: [{A: [[1, 0], [0, 1]], b: [1, 1], c: [1]}]")
    assert fault.message.endswith("has 1 entry for 2 stages")


@pytest.mark.parametrize(
    ("scalar", "culprit"),
    [
        ("1/2 + gama", "gama"),
        ("'1/2 + gama'", "gama'"),
        ('"1/2 + gama"', 'gama"'),
        ("1/2 − 1/6", "− 1/6"),
        ('"1/2 − 1/6"', '− 1/6"'),
        ("2*(1/3 + 1/0)", "0)"),
        ('"  sqrt(1 - 2)"', 'sqrt(1 - 2)"'),
        ("3**2**2", "**2"),
        ("2**99", "99"),
        ("sine(1)", "sine(1)"),
        ("1 2 3", "1 2 3"),
        ('"root(2, 1.5)"', '1.5)"'),
        ('"(1/2"', '"'),
    ],
)
def test_the_caret_stands_under_the_culprit(scalar: str, culprit: str) -> None:
    """Inside a plain or a quoted scalar the caret is at the very sign that is wrong: ``culprit`` is
    the rest.
    """
    text = f"methods:\n  - A: [[0, 0], [0, 0]]\n    b: [1/2, {scalar}]\n"
    assert scalar.endswith(culprit)
    assert under_caret(text) == [f"{culprit}]"]


def test_the_caret_finds_its_place_in_a_long_line() -> None:
    """A line that is cut to the terminal keeps the culprit in view, with the caret under it."""
    row = ", ".join(["1/7"] * 60)
    text = f"methods:\n  - A: [[{row}, oops, {row}]]\n    b: [1]\n"
    assert any(rest.startswith("oops, 1/7") for rest in under_caret(text))


def missing(path: Path) -> str:
    """The cure for a path without a file; the place of the fault is no line."""
    with pytest.raises(MethodFileError) as caught:
        load(str(path))
    (fault,) = caught.value.faults
    assert (fault.message, fault.line, fault.column) == ("no such file", 0, 0)
    return fault.help


def test_a_missing_file_has_no_line_and_a_cure(tmp_path: Path) -> None:
    """The file of the folder that was meant, or what is there, or that nothing is."""
    path = tmp_path / "midpiont.gark.yaml"
    assert missing(path) == "no file of this folder ends in .yaml"
    (tmp_path / ".gark.yaml").touch()
    (tmp_path / "rk4.gark.yaml").touch()
    assert missing(path) == "there are: rk4.gark.yaml"
    (tmp_path / "midpoint.gark.yaml").touch()
    assert "midpoint.gark.yaml'?" in missing(path)
    assert missing(tmp_path / "x" / "y.yaml").startswith("there is no folder")


def test_a_fault_is_told_once_where_one_node_is_used_twice() -> None:
    """An anchor that is read for several blocks has one mistake, which is reported once, at its
    place.
    """
    text = "tableau:\n  A: [[&a [[x]], *a], [null, *a]]\n  b: [[1], [1]]\n"
    found = faults(text)
    assert [(fault.line, fault.column) for fault in found] == [(2, 13)]
    assert "also at" not in found[0].message


def test_limits_are_part_of_the_fault() -> None:
    """A file that would exhaust the machine is refused with the limit it passes."""
    assert (
        "50000 values"
        in faults("a: &a [" + "1, " * 1000 + "1]\nb: [" + "*a, " * 500 + "*a]\n")[0].message
    )
    assert "12 deep" in faults("methods: " + "[" * 40 + "]" * 40)[0].message
    assert "1000 digits" in faults("methods: [{A: [[1e2000]], b: [1]}]")[0].message
    assert "20000" in faults(f"methods: [{{A: [[{'1+' * 10001}1]], b: [1]}}]")[0].message


def test_the_rest_of_a_file_is_read_where_coefficients_are_missing() -> None:
    """Faults of other keys are reported beside a form that cannot be read."""
    text = "tableau: {b: [[1]]}\ntransfer: collocation\nconjugate: perhaps\nexpect: {order: four}\n"
    assert [fault.line for fault in faults(text)] == [1, 2, 3, 4]


def test_every_block_that_cannot_be_made_is_reported() -> None:
    """Weights that do not sum to 1, a zero weight and coinciding nodes are reported in one run."""
    text = (
        "methods: [{family: gauss, stages: 2}, {family: rk4}, {A: [[0]], b: [0]}]\n"
        "transfer:\n"
        "  default: collocation\n"
        "  blocks:\n"
        '    "1,3": {interpolation: 1/2, collocation: 1/3}\n'
        '    "3,1": conjugate-collocation\n'
        '    "1,2": interpolation\n'
    )
    assert {5, 6, 7} <= {fault.line for fault in faults(text)}


def test_faults_of_one_place_keep_the_order_they_were_met_in() -> None:
    """What a file is told does not depend on the hash seed of the run."""
    source = Source("m", "", METHOD_FILE)
    messages = [f"fault {n}" for n in range(40)]
    for message in messages:
        source.fault(None, message, code="doubled")
    assert [fault.message for fault in source.error().faults] == messages


@in_whole
def test_yaml_nested_without_end_is_refused(tmp_path: Path) -> None:
    """A file of 100 000 opening brackets is refused with a fault; the process survives it."""
    path = tmp_path / "deep.gark.yaml"
    path.write_text("methods: " + "[" * 100_000 + "]" * 100_000)
    run = subprocess.run(
        [sys.executable, "-m", "garkcli", "check", str(path)], capture_output=True, text=True
    )
    assert run.returncode == 2
    assert "12 deep" in run.stdout


def test_half_a_surrogate_pair_is_reported_where_it_stands() -> None:
    """A text from Python can have one; it is no fault of the program."""
    with pytest.raises(MethodFileError) as caught:
        loads("name: x\nreference: a\ud800b\n")
    (fault,) = caught.value.faults
    assert (fault.line, fault.column) == (2, 13)


@pytest.mark.parametrize(("names", "cure"), [("[x, y]", "{x: free, y: free}"), ("x", "{x: free}")])
def test_names_without_values_are_one_fault(names: str, cure: str) -> None:
    """Coefficients that use such a name are no further faults; the cure has the names."""
    (fault,) = faults(f"parameters: {names}\nA: [[0, 0], [x, 0]]\nb: [1 - x, 1/(2*x)]\n")
    assert (fault.line, fault.column) == (1, 13)
    assert fault.help == f"write parameters: {cure}"


def test_a_key_of_elsewhere_keeps_its_value() -> None:
    """The cure has what the file says; an example where that is no short text."""
    method = "A: [[0]]\nb: [1]\n"
    (fault,) = faults(f"{method}order: 1\nsymplectic: false\n")
    assert fault.help == "write expect: {order: 1, symplectic: false}"
    (fault,) = faults(f"{method}order: '>= 1'\n")
    assert fault.help == 'write expect: {order: ">= 1"}'
    (fault,) = faults(f"{method}order: [1]\n")
    assert fault.help == "write expect: {order: 4}"
