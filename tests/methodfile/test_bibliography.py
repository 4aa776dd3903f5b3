"""``reference`` and ``aliases``: what they may be, what is read, and what bad ones get."""

from __future__ import annotations

import jsonschema
import pytest
import yaml

from garkcli.errors import MethodFileError, Remark
from garkcli.frozen import fields
from garkcli.methodfile.bibliography import REFERENCE
from garkcli.methodfile.carried import write_conjugate_of
from garkcli.methodfile.file_keys import method_file_schema
from garkcli.methodfile.load import loads
from garkcli.reference import Reference

METHOD = "A: [[0]]\nb: [1]\n"
FIELDS = """
reference:
  authors: J. R. Dormand, P. J. Prince
  title: "A family of embedded\\n Runge-Kutta formulae"
  year: 1980
  journal: J. Comput. Appl. Math.
  volume: 6
  number: 1
  pages: 19-26
  where: table 2
"""


def faults(text: str) -> list[Remark]:
    """What a file is refused for."""
    with pytest.raises(MethodFileError) as caught:
        loads(METHOD + text)
    return list(caught.value.faults)


def test_fields_are_read_and_put_in_one_line() -> None:
    """Whoever wants text has text, whoever wants fields has fields."""
    method = loads(METHOD + FIELDS)
    reference = method.bibliography
    assert reference is not None
    assert reference.authors == ("J. R. Dormand", "P. J. Prince")
    assert reference.title == "A family of embedded Runge-Kutta formulae"
    assert reference.year == "1980"
    assert method.reference == str(reference)
    assert method.reference.startswith("J. R. Dormand, P. J. Prince, A family of embedded")
    assert method.reference.endswith("J. Comput. Appl. Math. 6(1) (1980), 19-26, table 2")


@pytest.mark.parametrize(
    "authors",
    [
        "[A. Ab, B. Cd, E. Fg]",
        "A. Ab, B. Cd, E. Fg",
        "A. Ab, B. Cd and E. Fg",
        "A. Ab, B. Cd, and E. Fg",
        "A. Ab & B. Cd & E. Fg",
    ],
)
def test_authors_in_any_of_the_usual_ways(authors: str) -> None:
    """A list, or one text with the signs that people put between names."""
    text = f"reference: {{title: T, authors: {authors}}}"
    if not authors.startswith("["):
        text = f'reference: {{title: T, authors: "{authors}"}}'
    reference = loads(METHOD + text).bibliography
    assert reference is not None
    assert reference.authors == ("A. Ab", "B. Cd", "E. Fg")


def test_plain_text_stays_a_reference() -> None:
    """As files have had it; fields are not guessed from it."""
    method = loads(METHOD + "reference: Runge 1895\naliases: Euler")
    assert (method.reference, method.bibliography) == ("Runge 1895", None)
    assert method.aliases == ("Euler",)


@pytest.mark.parametrize(
    ("reference", "text"),
    [
        (Reference(title="T", year="2001"), "T, 2001"),
        (Reference(title="T", publisher="P"), "T, P"),
        (Reference(title="T", book="B", publisher="P"), "T, in B, P"),
        (Reference(title="T", institution="I", number="7"), "T, I 7"),
    ],
    ids=str,
)
def test_the_line_of_other_works(reference: Reference, text: str) -> None:
    """Books, chapters and reports, with what they have."""
    assert str(reference) == text


@pytest.mark.parametrize(
    ("text", "message", "cure"),
    [
        ("reference: {authors: X}", "title missing", "title"),
        ("reference: {title: T, yaer: 1999}", "unknown key 'yaer'", "'year'"),
        ("reference: {title: T, year: soon}", "not 'soon'", "1980"),
        ("reference: {title: T, type: poem}", "'poem'", "article"),
        ("reference: [a, b]", "a single value", ""),
        ("reference: {title: [T]}", "a single value", ""),
        ("aliases: [a, a]", "'a' appears twice", "keep one"),
        ("aliases: [a/b]", "'a/b' has a separator", "hyphen"),
        ('aliases: [""]', "an empty name", "leave it out"),
        ("aliases: [[a]]", "a single value", ""),
        (f"aliases: {'x' * 101}", "more than 100 characters", "shorten"),
        ("alias: [a]", "unknown key 'alias'", "'aliases'"),
    ],
)
def test_what_is_wrong_is_one_fault_with_its_cure(text: str, message: str, cure: str) -> None:
    """Each mistake is told once, where it stands."""
    (fault,) = faults(text)
    assert message in fault.message
    assert cure in fault.help
    assert fault.line == 3


def test_the_schema_agrees() -> None:
    """Editors accept what is read, and refuse what it can know to be wrong."""
    validator = jsonschema.Draft7Validator(method_file_schema())
    good = (FIELDS, "reference: text\n", "aliases: [a, B c]", "aliases: a")
    for text in good:
        assert validator.is_valid(yaml.safe_load(METHOD + text)), text
    bad = (
        "reference: {authors: X}",
        "reference: {title: T, yaer: 1999}",
        "reference: {title: T, type: poem}",
        "aliases: [a, a]",
        "aliases: [a/b]",
    )
    for text in bad:
        assert not validator.is_valid(yaml.safe_load(METHOD + text)), text


def test_the_conjugate_has_no_aliases() -> None:
    """They are names of the other method; the reference stays with the coefficients."""
    method = loads(METHOD + FIELDS + "aliases: [a]")
    conjugate = loads(write_conjugate_of(method, "c"))
    assert conjugate.aliases == ()
    assert conjugate.bibliography == method.bibliography


def test_every_field_is_documented() -> None:
    """The page of method files names each key of a reference."""
    from pathlib import Path

    page = Path(__file__).parents[2] / "docs/method-file.md"
    text = page.read_text(encoding="utf-8")
    part = text.partition("### `reference`")[2].partition("\n### ")[0]
    keys = [key.name for key in REFERENCE.inside()]
    assert sorted(keys) == sorted(fields(Reference))
    assert [x for x in keys if x not in part] == []
