"""``gark show --reference``: BibTeX that says what the file says, keys that tell publications apart."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from garkcli.families.registry import FAMILIES
from garkcli.frozen import replace
from garkcli.page.latex import ascii_letters, letters
from garkcli.reference import ZANNA, Reference
from garkcli.report.calls import references
from garkcli.report.citation import Cited, keys, render, title, together
from tests.cli.harness import ROOT, gark
from tests.whole import in_whole

DORMAND = """
name: DP
reference:
  authors: J. R. Dormand, P. J. Prince
  title: "A family of embedded Runge–Kutta formulae: 100 % & more"
  year: 1980
  journal: J. Comput. Appl. Math.
  volume: 6
  number: 1
  pages: 19 – 26
  where: table 2
  doi: 10.1016/0771-050X(80)90013-3
A: [[0]]
b: [1]
"""


def cited(**fields: object) -> Cited:
    """A method with a reference."""
    reference = Reference(title="T", **fields)  # type: ignore[arg-type]
    return Cited(("m",), str(reference), reference)


def bibtex(**fields: object) -> str:
    """The entry of a reference."""
    return render([cited(**fields)], "bibtex")


def test_an_article_is_an_entry(tmp_path: Path) -> None:
    """Every field in its place, signs of LaTeX escaped, capitals kept, a range of pages."""
    (tmp_path / "dp.gark.yaml").write_text(DORMAND, encoding="utf-8")
    run = gark("cite", "dp", "--catalogue", str(tmp_path))
    assert run.code == 0
    assert run.err == ""
    assert run.out == (
        "% dp\n"
        "@article{Dormand1980,\n"
        "  author = {J. R. Dormand and P. J. Prince},\n"
        "  title = {A family of embedded {Runge}--{Kutta} formulae: 100 \\% \\& more},\n"
        "  journal = {J. Comput. Appl. Math.},\n"
        "  volume = {6},\n"
        "  number = {1},\n"
        "  pages = {19--26},\n"
        "  year = {1980},\n"
        "  note = {table 2},\n"
        "  doi = {10.1016/0771-050X(80)90013-3},\n"
        "}\n"
    )


def test_a_file_that_is_no_method_is_no_reference(tmp_path: Path) -> None:
    """A misspelt family is a fault, not a method without a reference."""
    (tmp_path / "a.yaml").write_text("methods: [gaus-2]\n", encoding="utf-8")
    run = gark("cite", str(tmp_path / "a.yaml"))
    assert (run.code, "did you mean 'gauss'?" in run.err) == (2, True)


@pytest.mark.parametrize(
    ("fields", "kind"),
    [
        ({"journal": "J"}, "article"),
        ({"book": "B", "publisher": "P"}, "incollection"),
        ({"publisher": "P"}, "book"),
        ({"institution": "I"}, "techreport"),
        ({"type": "thesis", "institution": "I"}, "phdthesis"),
        ({"type": "thesis", "institution": "I", "note": "Master's thesis"}, "mastersthesis"),
        ({"type": "software", "publisher": "P"}, "misc"),
        ({}, "misc"),
    ],
    ids=str,
)
def test_the_kind_of_an_entry(fields: dict[str, str], kind: str) -> None:
    """By what the file says, or by the fields that it has."""
    entry = bibtex(**fields)
    assert f"@{kind}{{" in entry
    home = "school" if kind.endswith("thesis") else "institution"
    assert (f"  {home} = {{I}}" in entry) == ("institution" in fields)


def test_keys_are_of_ascii_and_tell_publications_apart() -> None:
    """The same whatever the order; groups and files without authors have one too."""
    first = cited(authors=("S. P. Nørsett",), year="1974", journal="A")
    second = cited(authors=("S. P. Nørsett",), year="1974", journal="B")
    assert keys([first, second]) == ["Norsett1974a", "Norsett1974b"]
    assert keys([second, first]) == ["Norsett1974b", "Norsett1974a"]
    assert keys([cited(authors=("The NodePy developers",))]) == ["NodePy"]
    plain = Cited(("dir.d/my method.gark.yaml",), "somewhere", None)
    assert keys([plain]) == ["mymethod"]


def test_methods_of_one_publication_are_together() -> None:
    """Another table of it makes no other publication; another year does. None is told twice."""
    one = cited(authors=("A. B",), year="1999", where="table 1")
    two = replace(cited(authors=("A. B",), year="1999", where="table 2"), methods=("n",))
    three = cited(authors=("A. B",), year="2000", where="table 1")
    found = together([one, two, one, three, Cited(("x",), "", None)])
    assert [x.methods for x in found] == [("m", "n"), ("m",), ("x",)]
    bare = together([Cited(("x",), "", None), Cited(("y",), "", None)])
    assert [x.methods for x in bare] == [("x",), ("y",)]


def test_a_method_without_a_reference_says_so(tmp_path: Path) -> None:
    """In every format, and on stderr where the report goes to a file."""
    (tmp_path / "m.gark.yaml").write_text("A: [[0]]\nb: [1]\n")
    run = gark("cite", "m.gark.yaml", cwd=tmp_path)
    assert run.code == 0
    assert run.out == "% m.gark.yaml: no reference in its file\n"
    assert run.err == "note: no reference in the file of m.gark.yaml\n"
    text = gark("cite", "m.gark.yaml", "--format", "text", cwd=tmp_path)
    assert re.search(r"  m\.gark\.yaml +no reference in its file\n", text.out)
    data = gark("cite", "m.gark.yaml", "--format", "json", cwd=tmp_path)
    (found,) = json.loads(data.out)["references"]
    assert (found["text"], found["reference"], found["bibtex"]) == (None,) * 3


def test_a_coupled_file_cites_its_families_and_the_paper(tmp_path: Path) -> None:
    """Also inside a construction and with free parameters; a file with a reference only that."""
    coupled = (
        "methods: [gauss-2, lobatto-iiic-3]\ntransfer: {interpolation: t, collocation: 1 - t}\n"
    )
    texts = {
        "free": "parameters: {t: free}\n" + coupled,
        "own": "reference: Nobody 1999\nparameters: {t: 1}\n" + coupled,
        "legendre": "methods: [gauss-2, gauss-3]\ntransfer: legendre\n",
        "made": "compose: {of: {family: gauss, stages: 1}, steps: [1/2, 1/2]}\n",
    }
    for name, text in texts.items():
        (tmp_path / name).write_text(text)
    works = {x: [one.text for one in references([str(tmp_path / x)])] for x in texts}
    gauss = str(FAMILIES["gauss"].reference)
    assert works["free"] == [gauss, str(ZANNA)]
    assert works["own"] == ["Nobody 1999"]
    assert works["legendre"] == works["made"] == [gauss]


def test_a_reference_of_plain_text_is_a_note(tmp_path: Path) -> None:
    """Its parts are not guessed."""
    text = "reference: Runge 1895 {p. 4}\nA: [[0]]\nb: [1]\n"
    (tmp_path / "m.gark.yaml").write_text(text)
    run = gark("cite", "m.gark.yaml", cwd=tmp_path)
    assert "@misc{m,\n  note = {Runge 1895 \\{p. 4\\}},\n}\n" in run.out


def test_a_family_is_cited_too(tmp_path: Path) -> None:
    """No value of its parameters is needed for that."""
    text = "reference: me\nparameters: {t: free}\nA: [[t]]\nb: [1]\n"
    (tmp_path / "m.gark.yaml").write_text(text)
    assert gark("cite", "m.gark.yaml", cwd=tmp_path).code == 0


@pytest.mark.parametrize(
    ("text", "spelt"),
    [
        ("Störmer", r"St{\"o}rmer"),
        ("Kværnø", r"Kv{\ae}rn{\o}"),
        ("Lambert, ß", r"Lambert, {\ss}"),
        ("Muñoz, Ç", r"Mu{\~n}oz, {\c C}"),
        ("García", r"Garc{\'\i}a"),
        ("Čech, Őry, Ångström", r"{\v C}ech, {\H O}ry, {\r A}ngstr{\"o}m"),
        ("γ, Σ, λ", r"$\gamma$, $\Sigma$, $\lambda$"),
        (
            "a_b^c ~ {d} \\ # $",
            r"a\_b\textasciicircum{}c \textasciitilde{} \{d\} \textbackslash{} \# \$",
        ),
        ("漢", "漢"),
    ],
)
def test_letters_of_latex(text: str, spelt: str) -> None:
    """Accents as commands in braces, so that BibTeX takes each for one letter."""
    assert letters(text) == spelt


def test_titles_keep_their_capitals() -> None:
    """But for the first letter, which every style keeps."""
    assert title("On SDIRK methods") == "On {SDIRK} methods"
    assert title("SDIRK methods") == "{SDIRK} methods"
    assert title("über Reihen") == r"{\"u}ber {Reihen}"


SIGNS = "aBÄéçßŁ{}\\%$#~_^&<> –−γΣ漢İ\u0301,."
"""Letters with and without a form in LaTeX, signs that mean something there."""


@given(st.text(SIGNS, max_size=40))
def test_an_entry_has_balanced_braces(text: str) -> None:
    """Whatever the text, no brace and no sign of a comment gets out of its field."""
    for spelt in (letters(text), title(text)):
        bare = re.sub(r"\\[\\{}%]", "", spelt)
        depth = 0
        for sign in bare:
            depth += (sign == "{") - (sign == "}")
            assert depth >= 0
            assert sign != "%"
        assert depth == 0


@given(st.text(SIGNS, max_size=40))
def test_keys_are_letters_and_digits(text: str) -> None:
    """Whatever the name."""
    found = ascii_letters(text)
    assert found == "" or (found.isascii() and found.isalnum())


@in_whole
def test_a_folder_of_the_catalogue_has_entries() -> None:
    """Each method is in one entry, no two entries have one key."""
    run = gark("cite", "catalogue:dirk", "--format", "json")
    found = json.loads(run.out)["references"]
    names = [name for one in found for name in one["methods"]]
    arguments = ("list", "methods", "--folder", "dirk", "--format", "json")
    listed = json.loads(gark(*arguments).out)
    assert sorted(names) == sorted(entry["name"] for entry in listed)
    kept = [one["key"] for one in found if one["bibtex"]]
    assert len(kept) == len(set(kept))


def test_the_program_and_its_paper() -> None:
    """``gark show gark --reference``: what CITATION.cff says, and the paper with its number in the archive."""
    data = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    found = json.loads(gark("cite", "gark", "--format", "json").out)["references"]
    program, paper = (x["reference"] for x in found)
    assert program["title"] == data["title"]
    assert program["note"] == f"version {data['version']}"
    [cited] = data["references"]
    assert paper["title"] == cited["title"]
    assert "eprint = {2001.07185}" in found[1]["bibtex"]


@pytest.mark.parametrize("name", FAMILIES)
def test_every_family_has_a_reference(name: str) -> None:
    """By its name alone, and by a member that the catalogue does not have."""
    [found] = json.loads(gark("cite", name, "--format", "json").out)["references"]
    assert found["reference"]["authors"]
    member = FAMILIES[name]
    if member.keys == ("stages",) and not member.is_single:
        again = gark("cite", f"{name}-{49 if name == 'ssp3' else 31}").out
        assert again.splitlines()[1:] == found["bibtex"].splitlines()[1:]


def test_a_family_before_what_sounds_alike() -> None:
    """``sdirk2`` is a family, though the catalogue has sdirk-2; braces mean a family, too."""
    assert "Solving {Ordinary}" in gark("cite", "sdirk2").out
    braces = gark("cite", "{family: gauss, stages: 2}").out
    assert braces.splitlines()[1:] == gark("cite", "gauss-7").out.splitlines()[1:]
