"""gark audit --fix and --claim: what is sure is a patch, what is declared a method file."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from flint import fmpq

from garkcli.bridges.misprints import Wanted, mistyped, places
from garkcli.bridges.patching import patch_of
from tests.bridges.test_audit import PLANTED, SOURCES
from tests.cli.harness import Run, gark
from tests.whole import IS_WHOLE, in_whole

MENDED = (
    *("c, a sign", "c, a node", "c, a constant", "petsc, a digit", "petsc, a weight"),
    *("petsc, an embedded weight", "petsc, implicit first", "scipy, a digit", "scipy, a node"),
    *("scipy, E", "python, a sign", "matlab, a sign", "tsv, a digit", "tsv, a node"),
    *("printed, a weight", "printed, a digit", "latex, of two colours", "json, a node"),
    *("csv, a sign", "csv, a node", "csv, a weight"),
)
"""Planted errors that one sign or digit explains."""
LEFT = (
    *("c, an embedded weight", "c, the order", "def, transposed", "def, p", "def, a root"),
    *("petsc, the order", "petsc, symplectic", "scipy, n_stages"),
    *("julia, fsal", "json, the order", "latex, an embedded weight"),
)
"""Others: of an order, a shape, several numbers, or one that several numbers would mend."""
SUITE = {"c, a sign", "scipy, E", "tsv, a digit", "csv, a node"}
SOLVER = """\
order = 4
A = [[0, 0, 0, 0], [1 / 2, 0, 0, 0], [0, 1 / 2, 0, 0], [0, 0, 1, 0]]
b = [1 / 6, 1 / 3, 1 / 3, 1 / 6]
c = [0, 1 / 2, 1 / 2, 1]
"""


def applied(patch: str, folder: Path) -> None:
    """A patch applied to the files of a folder, line by line: every hunk where it says."""
    for part in re.split(r"^--- a/", patch, flags=re.MULTILINE)[1:]:
        name = part.partition("\n")[0].rstrip("\t")
        path = folder / name
        lines = path.read_bytes().decode().split("\n")
        heads = [*re.finditer(r"^@@ -(\d+)(?:,\d+)? \+\d+(?:,\d+)? @@\n", part, re.MULTILINE)]
        for head, following in zip(heads, [*heads[1:], None], strict=True):
            hunk = part[head.end() : following.start() if following else None].split("\n")[:-1]
            at = int(head[1]) - 1
            for line in hunk:
                sign, text = line[0], line[1:]
                if sign == "\\":
                    assert len(lines) == at  # there is no line end at the end
                elif sign == "+":
                    lines.insert(at, text)
                    at += 1
                else:
                    assert lines[at] == text
                    if sign == "-":
                        del lines[at]
                    else:
                        at += 1
        path.write_bytes("\n".join(lines).encode())


def planted(name: str, folder: Path) -> tuple[str, str, str]:
    """A file with a planted error: its name, what it was, and what it is."""
    file, old, new, _ = PLANTED[name]
    text = (SOURCES / file).read_text(encoding="utf-8")
    wrong = text.replace(old, new, 1)
    (folder / file).write_bytes(wrong.encode())
    return file, text, wrong


@pytest.mark.parametrize("name", [x for x in MENDED if IS_WHOLE or x in SUITE])
def test_a_patch_restores_a_sign_or_a_digit(name: str, tmp_path: Path) -> None:
    """The command changes nothing; with its patch the source is what it was, and has no error."""
    file, text, wrong = planted(name, tmp_path)
    run = gark("audit", file, "--fix", cwd=tmp_path)
    assert (run.code, run.err) == (1, "the patch mends 1 of 1 wrong table\n")
    assert (tmp_path / file).read_bytes() == wrong.encode()
    applied(run.out, tmp_path)
    assert (tmp_path / file).read_bytes() == text.encode()
    again = gark("audit", file, "--fix", cwd=tmp_path)
    assert (again.code, again.out, again.err) == (0, "", "")


@pytest.mark.parametrize("name", [*LEFT] if IS_WHOLE else LEFT[::4])
def test_what_is_not_sure_is_left(name: str, tmp_path: Path) -> None:
    """A declared order may be wrong, a shape needs a person, and two numbers would do as well."""
    file, _, wrong = planted(name, tmp_path)
    run = gark("audit", file, "--fix", cwd=tmp_path)
    assert (run.code, run.out) == (1, "")
    assert "mends 0 of 1 wrong table: the others have no single sign, digit or number" in run.err
    assert (tmp_path / file).read_bytes() == wrong.encode()


@pytest.mark.parametrize(
    ("old", "new", "mended"),
    [
        ("[0, 0, 1, 0]", "[0, 0, 5 / 7, 0]", "[0, 0, 1 / 1, 0]"),
        ("[0, 1 / 2, 1 / 2, 1]", "[0, 3 / 7, 1 / 2, 1]", "[0, 1 / 2, 1 / 2, 1]"),
        ("[0, 1 / 2, 1 / 2, 1]", "[0, 1 / 2, 0.33, 1]", "[0, 1 / 2, 0.5, 1]"),
    ],
)
def test_any_other_number_of_an_order_from_three_on(
    old: str, new: str, mended: str, tmp_path: Path
) -> None:
    """One entry that restores the order, or the node of a row of a method that has it."""
    (tmp_path / "solver.py").write_text(SOLVER.replace(old, new), encoding="utf-8")
    run = gark("audit", ".", "--fix", "-q", cwd=tmp_path)
    applied(run.out, tmp_path)
    assert (tmp_path / "solver.py").read_text() == SOLVER.replace(old, mended)
    assert gark("audit", ".", cwd=tmp_path).code == 0


def test_a_misprint_has_another_digit_rather_than_none() -> None:
    """2.1 for 2 was 2.0, not 2. with a digit too many."""
    (place,) = places("2.1", 0)
    wanted = Wanted(fmpq(21, 10), fmpq(2), fmpq(0))
    assert next(mistyped("2.1", place, wanted)) == "2.0"


def test_an_array_of_an_estimate_is_no_array_of_weights(tmp_path: Path) -> None:
    """Its sum is to be 0: a digit that would make it 1 is no repair."""
    table = """\
A = [[0, 0, 0, 0], [1 / 2, 0, 0, 0], [0, 3 / 4, 0, 0], [2 / 9, 1 / 3, 4 / 9, 0]]
b = [2 / 9, 1 / 3, 4 / 9, 0]
c = [0, 1 / 2, 3 / 4, 1]
{} = [7 / 24, 1 / 4, 1 / 3, 1 / 9]
"""
    (tmp_path / "t.py").write_text(table.format("b_err"), encoding="utf-8")
    assert gark("audit", "t.py", "--fix", cwd=tmp_path).out == ""
    (tmp_path / "t.py").write_text(table.format("bhat"), encoding="utf-8")
    run = gark("audit", "t.py", "--fix", cwd=tmp_path)
    assert "+bhat = [7 / 24, 1 / 4, 1 / 3, 1 / 8]\n" in run.out


PROGRAMS = {"patch": ("patch", "-p1", "-s", "-i"), "git": ("git", "apply")}


@in_whole
@pytest.mark.skipif(not any(map(shutil.which, PROGRAMS)), reason="there is no such program")
def test_programs_apply_the_patch(tmp_path: Path) -> None:
    """Of a tree with folders, a blank in a name, line ends of Windows, and no line end at the end;
    a file that is not wrong is not in it.
    """
    wrong = SOLVER.replace("[0, 0, 1, 0]", "[0, 0, 2, 0]")
    texts = {
        "src/a b.py": wrong,
        "src/dos.py": wrong.replace("\n", "\r\n"),
        "src/end.py": "huge = 1e99999\n" + wrong.removesuffix("\n"),
        "src/right.py": SOLVER,
    }
    tree = tmp_path / "tree"
    (tree / "src").mkdir(parents=True)
    for name, text in texts.items():
        (tree / name).write_bytes(text.encode())
    run = gark("audit", "src", "--fix", "-o", "x.patch", cwd=tree)
    assert (run.code, run.out) == (1, "")
    assert "the patch mends 3 of 3 wrong tables" in run.err
    for program in filter(shutil.which, PROGRAMS):
        folder = tmp_path / program
        shutil.copytree(tree, folder)
        command = [*PROGRAMS[program], "x.patch"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr + done.stdout
        for name, text in texts.items():
            right = text.replace("[0, 0, 2, 0]", "[0, 0, 1, 0]")
            assert (folder / name).read_bytes() == right.encode()


def refused(run: Run) -> str:
    """What a run that cannot do what is asked for says, in one line."""
    assert (run.code, run.out) == (2, "")
    return " ".join(run.err.split())


def test_what_has_no_patch(tmp_path: Path) -> None:
    """Standard input has no name, another format no hunks; a file elsewhere, in Latin-1, or with
    signs that command a terminal is left out.
    """
    wrong = SOLVER.replace("[0, 0, 1, 0]", "[0, 0, 2, 0]")
    (tmp_path / "m.py").write_text(wrong, encoding="utf-8")
    (tmp_path / "below").mkdir()
    assert "is not a file" in refused(gark("audit", "-", "--fix", stdin=wrong))
    for more in (["--format", "json"], ["-o", "x.json"]):
        run = gark("audit", "m.py", "--fix", *more, cwd=tmp_path)
        assert "--fix writes a patch, not json" in refused(run)
    above = gark("audit", "../m.py", "--fix", cwd=tmp_path / "below")
    assert (above.code, above.out) == (1, "")
    assert "../m.py is left out of the patch" in above.err
    heads = (b"# na\xefve\n", b"\xef\xbb\xbf", b"# \x1b[31m\n")
    for text in (head + wrong.encode() for head in heads):
        (tmp_path / "m.py").write_bytes(text)
        run = gark("audit", "m.py", "--fix", cwd=tmp_path)
        assert run.out == ""
        assert "m.py is left out of the patch" in run.err
    assert patch_of("m.py", "a\nb", "a\nc").endswith("+c\n\\ No newline at end of file\n")
    assert patch_of("m.py", "::error::a\nb\n", "::error::a\nc\n") == ""


def test_claims_fail_where_declarations_are_false(tmp_path: Path) -> None:
    """A file for each table of a folder, or one file; gark check reads them and exits as gark audit
    does, and says the same order.
    """
    (tmp_path / "right.py").write_text(SOLVER, encoding="utf-8")
    wrong = SOLVER.replace("[0, 0, 1, 0]", "[0, 0, 2, 0]")
    (tmp_path / "wrong.py").write_text(wrong, encoding="utf-8")
    run = gark("audit", ".", "--claim", "claims", cwd=tmp_path)
    assert run.code == 1
    assert "wrote 2 method files into claims" in run.err
    names = sorted(x.name for x in (tmp_path / "claims").iterdir())
    assert names == ["right.gark.yaml", "wrong.gark.yaml"]
    assert gark("check", "claims/right.gark.yaml", cwd=tmp_path).code == 0
    checked = gark("check", "claims/wrong.gark.yaml", cwd=tmp_path)
    assert checked.code == 1
    assert "order: expected 4, found 1" in checked.out
    several = gark("audit", ".", "--claim", "m.gark.yaml", cwd=tmp_path)
    assert several.code == 2
    assert "--claim m.gark.yaml is one method file, and 2 methods are found" in several.err
    assert "--claim m.json" in refused(gark("audit", ".", "--claim", "m.json", cwd=tmp_path))
    one = gark("audit", "right.py", "--claim", "m.gark.yaml", cwd=tmp_path)
    assert one.code == 0
    assert "expect: {order: 4}" in (tmp_path / "m.gark.yaml").read_text(encoding="utf-8")


DORMAND_PRINCE = """
static const double dp_c[7] = {0.0, 1.0/5.0, 3.0/10.0, 4.0/5.0, 8.0/9.0, 1.0, 1.0};
static const double dp_a[7][7] = {
  {0},
  {1.0/5.0},
  {3.0/40.0, 9.0/40.0},
  {44.0/45.0, -56.0/15.0, 32.0/9.0},
  {19372.0/6561.0, -25360.0/2187.0, 64448.0/6561.0, -212.0/729.0},
  {9017.0/3168.0, -355.0/33.0, 46732.0/5247.0, 49.0/176.0, -5103.0/18656.0},
  {35.0/384.0, 0.0, 500.0/1113.0, 125.0/192.0, -2187.0/6784.0, 11.0/84.0}
};
static const double dp_b[7] =
  {35.0/384.0, 0.0, 500.0/1113.0, 125.0/192.0, -2187.0/6784.0, 11.0/84.0, 0.0};
static const double dp_e[7] =
  {71.0/57600.0, 0.0, -71.0/16695.0, 71.0/1920.0, -17253.0/339200.0, 22.0/525.0, -1.0/40.0};
"""
"""The pair of Dormand and Prince, with an estimate of long denominators."""


@pytest.mark.parametrize("order", ["", "static const int dp_order = 5;\n"])
def test_the_entry_of_a_wrong_row(order: str, tmp_path: Path) -> None:
    """Three digits of a fraction change places: the row does not sum to its node, and one entry has
    a value with which the order holds, declared or not. The patch writes that.
    """
    path = tmp_path / "dopri.c"
    text = DORMAND_PRINCE + order
    path.write_text(text.replace("18656", "18565"), encoding="utf-8")
    run = gark("audit", path.name, cwd=tmp_path)
    said = " ".join(run.out.split())
    assert "row 6 has the sum" in said
    assert "order 5 would hold with a[6,5] = -5103/18656 instead of -5103/18565" in said
    run = gark("audit", path.name, "--fix", cwd=tmp_path)
    applied(run.out, tmp_path)
    assert path.read_text(encoding="utf-8") == text


def test_the_weight_of_a_wrong_sum(tmp_path: Path) -> None:
    """Without a declared order the wrong sum of the weights names the weight."""
    path = tmp_path / "dopri.c"
    path.write_text(DORMAND_PRINCE.replace("2187.0/6784", "2187.0/6748"), encoding="utf-8")
    said = " ".join(gark("audit", path.name, cwd=tmp_path).out.split())
    assert "order 5 would hold with b[5] = -2187/6784 instead of -2187/6748" in said


ROS3P = """
struct Ros3p {
  static const int order = 3;
  const double gamma = 0.7886751345948129;
  const double b[3] = {0.6666666666666666, 0, 0.3333333333333333}, c[3] = {0, 1, 1};
  const double a[3][3] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}};
  const double g[3][3] = {{0, 0, 0}, {-1, 0, 0}, {-0.7886751345948129, -1.0773502691896258, 0}};
};
"""


@pytest.mark.parametrize(
    ("old", "new", "is_sure"),
    [
        ("0.3333333333333333", "0.3333333333833333", True),
        ("{0.6666666666666666", "{-0.6666666666666666", True),
        ("-1.0773502691896258", "-1.0873502691896258", False),
    ],
)
def test_a_digit_of_a_rosenbrock_method(old: str, new: str, is_sure: bool, tmp_path: Path) -> None:
    """Another digit of its neighbour would mend γ₃₂ as well, as b₃ alone sees both."""
    path = tmp_path / "ros3p.hpp"
    path.write_text(ROS3P.replace(old, new))
    run = gark("audit", path.name, "--fix", cwd=tmp_path)
    assert run.code == 1
    applied(run.out, tmp_path)
    assert (path.read_text() == ROS3P) is is_sure
