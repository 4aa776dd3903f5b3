"""What is wrong with YAML is said in words of the file, not of its parser."""

import pytest

from garkcli.errors import Remark
from garkcli.grammar.nodes import composed

JARGON = (
    "token",
    "stream",
    "scalar",
    "chomping",
    "expected",
    "block end",
    "not allowed",
    "anchor '",
)


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("b: [1\n", 2, 1, "a comma or ']' is missing"),
        ("b: {c: 1]\n", 1, 9, "a comma or '}' is missing"),
        ("b: {c: 1}}\n", 1, 10, "'}' closes no bracket"),
        ("b: [1,,2]\n", 1, 7, "a value is missing"),
        ("b: 1\n\tc: 2\n", 2, 1, "a tab"),
        ("b: @c\n", 1, 4, "no text begins with '@'"),
        ("b: ? c\n", 1, 4, "no text begins with '?'"),
        ("b: - c\n", 1, 4, "no item begins at this dash"),
        ("b: c: d\n", 1, 5, "no key ends at this colon"),
        ("- b\nc: 1\n", 2, 1, "no list or mapping before it"),
        ("b: 1\nc\nd: 2\n", 2, 1, "a colon is missing"),
        ("a: 1\nb: 'c\n", 2, 4, "the quotation mark is open"),
        ("b: *c\n", 1, 4, "*c stands for a value &c, which is missing"),
        ("b: &c 1\nd: &c 2\n", 2, 4, "&c has two values"),
        ("b: &\n", 1, 5, "a name is missing"),
        ("b: 1\n---\nc: 2\n", 2, 1, "another document begins"),
        ('b: "\\q"\n', 1, 6, "after a backslash"),
        ("b: |c\n", 1, 5, "the line does not end after |"),
        ("%YAML b\n---\nc: 1\n", 1, 7, "the directive or tag is not known"),
        ("b: !c!d 1\n", 1, 4, "the directive or tag is not known"),
        ("b: \x00\n", 1, 4, "the control character U+0000"),
    ],
)
def test_faults_of_yaml_are_said_in_plain_words(
    text: str, line: int, column: int, words: str
) -> None:
    fault = composed(text)
    assert isinstance(fault, Remark)
    assert (fault.line, fault.column) == (line, column)
    assert words in fault.message
    assert fault.help
    assert not [x for x in JARGON if x in fault.message]
