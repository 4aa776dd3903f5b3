"""The catalogue as a mapping of Python."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

import garkcli
from garkcli import catalogue, load
from garkcli.catalogue.mapping import NoSuchMethod
from garkcli.errors import UsageProblem
from garkcli.methodfile.load import MethodFile
from tests.cli.harness import ROOT


def test_names_lead_to_methods() -> None:
    """In any spelling of the name or an alias the method is that of its file."""
    path = "garkcli/catalogue/data/erk/rk4.gark.yaml"
    file = load(str(ROOT / path))
    for name in ("rk4", "RK4", "catalogue:rk4"):
        found = catalogue[name]
        assert isinstance(found, MethodFile)
        assert found.tableau == file.tableau
        assert found.source == "rk4"
    assert catalogue["Stoermer Verlet"].name == "Störmer-Verlet"


def test_it_is_a_mapping() -> None:
    """Names in, names out; everything that mappings have."""
    assert isinstance(catalogue, Mapping)
    names = list(catalogue)
    assert len(catalogue) == len(names) == len(set(names)) > 20
    assert list(catalogue.keys()) == names
    assert "rk4" in catalogue
    assert "rk4" in names
    assert 4 not in catalogue
    assert bool(catalogue)
    name, method = next(iter(catalogue.items()))
    assert name == names[0]
    assert method.text == catalogue[name].text
    assert next(iter(catalogue.values())).text == method.text
    assert catalogue.get("no-such-name") is None
    assert catalogue.get("no-such-name", "none") == "none"
    assert catalogue.get("rk4").stages == (4,)


@pytest.mark.parametrize("name", ["stoermer-verlat", "methods/rk4.gark.yaml", "", 4])
def test_unknown_names_are_key_errors(name: object) -> None:
    """A KeyError whose text says what is missing, and a cure where there is one."""
    with pytest.raises(KeyError) as caught:
        catalogue[name]  # type: ignore[index]
    assert isinstance(caught.value, NoSuchMethod)
    assert "name" in caught.value.message or "no method" in str(caught.value)
    if name == "stoermer-verlat":
        assert str(caught.value).endswith("did you mean 'stoermer-verlet'?")


def test_methods_are_searched_by_what_is_known_of_them() -> None:
    """Words, numbers, ranges and truths, together; what is found has it, checked anew."""
    assert "stoermer-verlet" in catalogue.search("Störmer", "verlet")
    found = catalogue.search(order="2..4", stages="<5", symplectic=True)
    orders = []
    for name in (found[0], found[-1]):
        method = catalogue[name]
        orders.append(garkcli.find_order(method).order)
        assert max(method.stages) < 5
        assert garkcli.is_symplectic(method)
    assert orders == [4, 2]
    assert set(catalogue.search(kind="ark", folder="ark")) <= set(catalogue)
    assert catalogue.search("no such word in any reference") == []
    with pytest.raises(UsageProblem, match="did you mean 'stages'"):
        catalogue.search(stage=4)
    with pytest.raises(UsageProblem, match="nor a range"):
        catalogue.search(order="many")


def test_folders_of_ones_own_come_first(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A name of GARK_PATH hides that of the package."""
    (tmp_path / "rk4.gark.yaml").write_text("name: mine\nA: [[0]]\nb: [1]\n")
    monkeypatch.setenv("GARK_PATH", str(tmp_path))
    assert catalogue["rk4"].name == "mine"
    assert next(iter(catalogue)) == "rk4"
    assert list(catalogue).count("rk4") == 1


def test_however_it_is_imported_it_is_the_same() -> None:
    """As an attribute of the package, and as a module, whichever comes first; importing it reads
    no method and imports neither sympy nor numpy.
    """
    code = (
        "import sys, garkcli\n"
        "first = garkcli.catalogue\n"
        "heavy = {'numpy', 'sympy', 'yaml'} & set(sys.modules)\n"
        "import garkcli.catalogue as second\n"
        "from garkcli.catalogue import mapping\n"
        "print(first is second, heavy, first['rk4'].stages)"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, cwd=ROOT, timeout=60
    )
    assert done.stdout == "True set() (4,)\n", done.stderr
    assert "catalogue" in dir(garkcli)
