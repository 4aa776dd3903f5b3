"""One vocabulary: groups of commands, names of families, spellings, places of results."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from garkcli import diagonal_method, load
from garkcli.cli.table import COMMANDS, FORMER
from garkcli.exact.expression import parse
from garkcli.glossary.fields import field_text
from garkcli.glossary.term import by_word
from tests.cli.harness import gark
from tests.whole import in_whole


def test_the_help_has_groups() -> None:
    """Each group is a heading, each command is below it once; old names are not listed."""
    lines = gark("--help").out.splitlines()
    groups = list(dict.fromkeys(row.group for row in COMMANDS.values()))
    assert [x[:-1] for x in lines if x.endswith(":") and x[:-1] in groups] == groups
    for name, row in COMMANDS.items():
        (place,) = [i for i, x in enumerate(lines) if x.startswith(f"  {name} ")]
        heading = next(x for x in reversed(lines[:place]) if x.endswith(":"))
        assert heading == f"{row.group}:"


def test_an_old_name_is_another_command() -> None:
    """``gark reduce`` is ``gark convert --to reduced``."""
    assert not COMMANDS.keys() & FORMER.keys()
    twice = "{A: [[1/2, 0], [1/4, 1/4]], b: [1/2, 1/2]}"
    old = gark("reduce", "-", stdin=twice)
    assert gark("convert", "-", "--to", "reduced", stdin=twice) == old
    assert "1/2" in old.out
    assert gark("convert", "rk4", "--to", "reduced", "--stages", "5").code == 2


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("conjugate rk4 --format yaml", "tableau rk4 --conjugate --format yaml"),
        ("conjugate rk4 --pair", "tableau rk4 --pair"),
        ("cite rk4", "show rk4 --reference"),
        ("cite rk4", "show rk4 --format bibtex"),
        ("cite gark rk4 --format text", "show gark rk4 --reference --format text"),
        ("cite rk4 --format json", "show rk4 --format json --reference"),
        ("cite rk4 -o x.txt", "show rk4 --reference -o x.txt"),
        ("certificate heun", "export heun --to certificate"),
        ("certificate heun --format coq", "export heun --to certificate --format coq"),
        (
            "certificate kvaerno-3 --format text -v",
            "export kvaerno-3 --to certificate --format text -v",
        ),
        ("reduce heun --format json", "convert heun --to reduced --format json"),
        ("check --explain b-series", "explain b-series"),
        ("check --explain order -q", "explain order -q"),
        ("conjugate gauss-2", "tableau gauss-2 --conjugate"),
        ("conjugate gauss-2 --pair --format json", "tableau gauss-2 --pair --format json"),
        ("cite --help", "show --help"),
        ("help reduce", "convert --help"),
    ],
)
def test_former_names(old: str, new: str, tmp_path: Path) -> None:
    """What they wrote, to the letter, into the file too; the help names them no more."""
    files = []
    runs = []
    for words in (old, new):
        runs.append(gark(*words.split(), cwd=tmp_path))
        made = tmp_path / "x.txt"
        files.append(made.read_text(encoding="utf-8") if made.exists() else "")
        made.unlink(missing_ok=True)
    assert runs[0] == runs[1]
    assert files[0] == files[1]
    assert (runs[0].out or files[0]) or runs[0].code == 2
    for name in FORMER:
        assert f"  {name} " not in gark("--help").out
    assert "--explain" not in gark("check", "--help").out + gark("check", "--zzz").err


def test_what_a_merged_command_refuses() -> None:
    """Options of one half are not taken for the other."""
    for words, said in (
        ("export heun --to certificate --pair", "a certificate has no --pair"),
        ("export heun --to certificate --digits 4", "a certificate has no --digits"),
        ("export heun --to c --format text", "--format is for certificates"),
        ("export heun --to certificate -o x.c", "no .c file can be written here"),
        ("show heun rk4 --format json", "--format json shows one method"),
    ):
        run = gark(*words.split())
        assert (run.code, run.out) == (2, ""), words
        assert said in run.err, words
    both = gark("show", "heun", "rk4")
    assert both.out == f"{gark('show', 'heun').out}\n{gark('show', 'rk4').out}"


@pytest.mark.parametrize("name", ["gauss-4", "gauss:4", "{family: gauss, stages: 4}"])
def test_a_family_by_any_name(name: str) -> None:
    """In place of a file, in Python, and as a method of a file."""
    assert "order 8, proved; order 9 fails" in " ".join(gark("check", name).out.split())
    assert load(name).stages == (4,)
    assert gark("check", "-", stdin=f"methods: [{name}]").out.startswith("<stdin>: order 8")
    assert gark("show", name).code == 0


def test_a_family_of_the_catalogue_or_not() -> None:
    """A size that no file of the catalogue has; single methods; what is no member."""
    assert diagonal_method("gauss-7") == diagonal_method("gauss:7") == diagonal_method("gauss", 7)
    assert "order: 2" in gark("new", "--family", "gauss-2", "--family", "heun").out
    assert "did you mean" in gark("check", "gaus-7").out
    assert gark("check", "gauss-7000").code == 2
    assert "needs --tableau" not in gark("new", "--family", "gauss").err


@pytest.mark.parametrize(
    ("written", "shown"),
    [
        ("design --minimize nothing rk4", "no objective 'nothing'"),
        ("trees 3 --colors 2 --colors-used 1,2", "[[]_1,[]_2]_1"),
        ("conditions --colored -N 2", "b{1}"),
        ("trees 4 --count", "order 4  4"),
        ("trees --order 4 --count", "order 4  4"),
        ("trees 4 --order 4", "the order is given twice"),
        ("check rk4 gauss-2 -j 0", "gauss-2"),
        ("check rk4 --color never", "rk4"),
    ],
)
def test_spellings(written: str, shown: str) -> None:
    """American and British ones, an order without its option, all processors."""
    run = gark(*written.split())
    assert shown in run.out + run.err


@in_whole
def test_places_of_results(tmp_path: Path) -> None:
    """A page has a name by default; ``-o -`` is standard output; ``--output-dir`` is a folder; all
    say what they wrote.
    """
    page = gark("report", "rk4", "--no-pictures", "-n", "2", cwd=tmp_path)
    assert (page.out, page.err) == ("", "wrote rk4.html\n")
    assert (tmp_path / "rk4.html").stat().st_size > 0
    two = gark("report", "rk4", "heun", "--no-pictures", "-n", "1", cwd=tmp_path)
    assert two.err == "wrote report.html\n"
    pair = gark("report", "{family: gauss, stages: 1}", "--pair", "--no-pictures", cwd=tmp_path)
    assert pair.err == "wrote family-gauss-stages-1-pair.html\n"
    assert gark("tableau", "rk4", "-o", "-", cwd=tmp_path).out == gark("tableau", "rk4").out
    (tmp_path / "t.csv").write_text(gark("export", "rk4", "--to", "csv").out)
    made = gark("import", "t.csv", "--output-dir", "made", cwd=tmp_path)
    assert made.err == "wrote 1 method file into made\n"
    assert len(list((tmp_path / "made").iterdir())) == 1


def test_a_tableau_from_a_file(tmp_path: Path) -> None:
    """``--tableau @FILE``."""
    (tmp_path / "t.txt").write_text("0 |\n1/2 | 1/2\n | 0 1\n")
    made = gark("new", "--tableau", "@t.txt", cwd=tmp_path)
    assert "[1/2, 0]" in made.out
    assert gark("new", "--tableau", "@no.txt", cwd=tmp_path).code == 2


def test_what_people_write_in_files() -> None:
    """``√3`` for ``sqrt(3)``, ``yes`` for ``true``."""
    text = "{A: [[1/4, 1/4-√3/6], [1/4+√3/6, 1/4]], b: [1/2, 1/2], expect: {symplectic: yes}}"
    run = gark("check", "-", stdin=text)
    assert run.code == 0
    assert "order 4, proved" in run.out
    assert "the same as  gauss-2" in run.out
    assert parse("√(3/4)").radicand == parse("3/4")  # type: ignore[attr-defined]
    for wrong in ("√", "2√3", "√√", "√-3"):
        assert gark("check", "-", stdin=f"{{A: [['{wrong}']], b: [1]}}").code == 2
    assert gark("check", "-", stdin="{A: [['" + "√" * 10000 + "2']], b: [1]}").code == 2


def test_the_order_that_observations_are_held_against() -> None:
    """Where a problem hides what fails, the observed order agrees with the visible one, in the
    output as in the glossary and the fields of JSON; the predicted one is that of every problem.
    """
    hiding = "{A: [[], [1/3], [0, 1/2]], b: [0, 0, 1]}"
    asked = ("converge", "-", "--problem", "oscillator")
    shown = " ".join(gark(*asked, stdin=hiding).out.split())
    assert "order 3.00 observed, 3 visible: they agree" in shown
    assert "predicted order 2" in shown
    found = json.loads(gark(*asked, "--format", "json", stdin=hiding).out)
    assert (found["visible_order"], found["predicted_order"], found["agrees"]) == (3, 2, True)
    words = by_word()
    assert words["visible order"] is not words["predicted order"]
    assert "for every problem" in words["predicted order"].text
    assert "observed on the problem" in words["visible order"].text
    for told in (words["agree"].text, field_text(("converge", "agrees"))):
        assert "visible" in told
        assert "predicted" not in told
