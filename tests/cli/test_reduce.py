"""gark reduce: smaller methods as files, and what is written where nothing is to reduce."""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli.api.methods import reduced
from garkcli.exact.field import ZERO
from garkcli.frozen import replace
from garkcli.methodfile.load import load, loads
from garkcli.order.certificate import find_order
from tests.catalogue.catalogue import entries
from tests.catalogue.method_files import method_file
from tests.cli.harness import ROOT, gark

CATALOGUE = entries()
REDUCIBLE = [
    "sundials_DORMAND_PRINCE_7_4_5",
    "sundials_BOGACKI_SHAMPINE_4_2_3",
    "sundials_TSITOURAS_7_4_5",
    "ASCHER_121",
    "IMEXSSP3_Conde",
    "sprk_Leapfrog_2_2",
    "sprk_CandyRozmus_4_4",
]
TWICE = """
name: the midpoint rule, twice
A: [[1/2, 0], [1/4, 1/4]]
b: [1/2, 1/2]
expect: {order: 2}
"""


@pytest.mark.parametrize("name", REDUCIBLE)
def test_published_methods_are_reduced(name: str, tmp_path: Path) -> None:
    """The file that is written is a method with fewer stages and the same order, its rounding kept,
    and nothing more is to reduce in it.
    """
    before, after = tmp_path / "before.gark.yaml", tmp_path / "after.gark.yaml"
    before.write_text(method_file(CATALOGUE[name]), encoding="utf-8")
    run = gark("reduce", str(before), "-o", str(after))
    assert (run.code, run.out) == (0, "")
    old, new = load(str(before)), load(str(after))
    assert sum(new.stages) < sum(old.stages)
    assert new.tolerance == old.tolerance
    again = reduced(new)
    assert again is not None
    assert again.stages == new.stages
    if old.tolerance is None:
        assert find_order(new.tableau).order == find_order(old.tableau).order
    assert gark("check", str(after)).code == 0
    again = gark("reduce", str(after))
    assert again.out == after.read_text(encoding="utf-8")
    assert again.err.endswith("nothing to reduce\n")


def test_shared_stages_stay_shared() -> None:
    """An additive method is written as one: its stages are not doubled."""
    made = gark("reduce", "-", stdin=method_file(CATALOGUE["ASCHER_121"]))
    tableau = loads(made.out).tableau
    assert len(tableau.spaces) == 1
    assert tableau.size == 2


def test_equal_stages_become_one() -> None:
    """The midpoint rule with its stage written twice; claims are left behind."""
    made = gark("reduce", "-", stdin=TWICE)
    assert made.err == "-: stages 2 become 1\n"
    assert "expect" not in made.out
    method = loads(made.out)
    assert method.name == "the midpoint rule, twice, reduced"
    assert str(method.A) == str(((loads("{A: [[1/2]], b: [1]}").A[0][0],),))


@pytest.mark.parametrize("path", sorted((ROOT / "methods").glob("*.yaml")), ids=lambda x: x.name)
def test_nothing_to_reduce(path: Path) -> None:
    """No method of the project has a stage too many; each is written as it is, with a note."""
    run = gark("reduce", str(path))
    assert run.code == 0
    assert run.out == path.read_text(encoding="utf-8")
    assert run.err == f"{path}: nothing to reduce\n"


def test_other_formats() -> None:
    """The smaller tableau as text and as JSON."""
    assert "1/2 | 1/2" in gark("reduce", "-", "--format", "text", stdin=TWICE).out
    assert '"stages": 1' in gark("reduce", "-", "--format", "json", stdin=TWICE).out


def test_what_is_not_compared_is_refused() -> None:
    """Gauss 6 with its block replaced by zeros: all stages are equal, which is not looked for at
    irrational nodes.
    """
    method = loads("methods: {family: gauss, stages: 6}")
    zeros = dict.fromkeys(method.tableau.blocks, ((ZERO,) * 6,) * 6)
    flat = replace(method, tableau=replace(method.tableau, blocks=zeros))
    assert reduced(flat) is None


def test_why_it_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """The command says it with a cure."""
    monkeypatch.setattr("garkcli.api.methods.smallest", lambda *_: None)
    run = gark("reduce", "rk4")
    assert (run.code, run.out) == (2, "")
    assert run.err.startswith("gark: rk4: the nodes have no simple radicals")


def test_what_no_file_says_is_refused() -> None:
    """A semi-separable method that is reducible has no file of its own, but a JSON report."""
    text = """
methods:
  - {A: [[1/4, 1/4], [1/4, 1/4]], b: [1/2, 1/2]}
  - {A: [[1/2]], b: [1]}
transfer: {blocks: {"2,1": [[1/4, 1/4]]}}
structure: semi-separable
"""
    run = gark("reduce", "-", stdin=text)
    assert (run.code, run.out) == (2, "")
    assert "cannot be spelled out" in run.err
    assert gark("reduce", "-", "--format", "json", stdin=text).code == 0
