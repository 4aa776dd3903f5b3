"""Solutions that are as stable as is wanted, their files, and how their values are written."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest
from flint import fmpq, fmpq_poly, fmpz_poly

from garkcli.design.choices import accepted_methods
from garkcli.design.design import Design, find_parameters
from garkcli.errors import MethodFileError
from garkcli.exact.domain import square_free
from garkcli.exact.field import NumberField
from garkcli.exact.polynomial_text import root_text
from garkcli.exact.roots import RealRoot
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import loads
from garkcli.report.schemas import report_schema
from garkcli.stability.linear import is_a_stable, is_l_stable, stability_function
from tests.cli.harness import gark

SDIRK = "parameters: {g: free}\nA: [[g, 0], [1 - 2*g, g]]\nb: [1/2, 1/2]\n"
THREE = "unknown: {stages: 3, shape: sdirk}\ndesign: {order: 4, a-stable: true}\n"


@pytest.fixture(scope="module")
def three() -> Design:
    """SDIRK methods of three stages and order 4, A-stable ones wanted."""
    return find_parameters(loads_family(THREE))


def test_of_three_methods_one_is_a_stable(three: Design) -> None:
    """S. P. Nørsett 1974: of the three γ of order 4 the largest alone is A-stable; that method says the same when it
    is loaded with its values as roots of a polynomial.
    """
    [found] = three.last.found
    assert (found.accepted, found.unstable, found.open) == ((2,), (0, 1), ())
    [chosen] = accepted_methods(three)
    gamma = chosen.values["gamma"]
    assert "root_of(3*x**3 - 3*x + 1" in gamma
    method = loads(THREE.split("design")[0], settings=chosen.values)
    assert is_a_stable(stability_function(method.tableau))


def test_order_and_stability_as_a_command(tmp_path: Path) -> None:
    """Both solutions of order 3 are told, one is taken and written with both claims, which hold;
    no solution is L-stable; where every value has the order the set of values is given.
    """
    path, made = tmp_path / "family.yaml", tmp_path / "made.yaml"
    path.write_text(SDIRK, encoding="utf-8")
    asked = ["design", str(path), "--order", "3"]
    run = gark(*asked, "--a-stable", "--emit", str(made))
    assert run.code == 0
    assert "not A-stable, which is wanted" in run.out
    text = made.read_text(encoding="utf-8")
    assert "expect: {order: 3, a-stable: true}" in text
    assert gark("check", str(made)).code == 0
    assert gark(*asked, "--l-stable").code == 1
    both = gark(*asked, "--a-stable", "--format", "json").out
    data = json.loads(both)
    jsonschema.validate(data, report_schema("design"))
    assert [x["stable"] for x in data["solutions"]] == [False, True]
    every = gark("design", str(path), "--order", "2", "--l-stable", "--format", "json")
    data = json.loads(every.out)
    jsonschema.validate(data, report_schema("design"))
    assert [x["point"] for x in data["stable"][0]["set"]] == ["1 - sqrt(2)/2", "1 + sqrt(2)/2"]


def test_wishes_that_have_no_meaning(tmp_path: Path) -> None:
    """P-stability of one colour is refused with its cure; so is a search, whose methods need not be
    exact.
    """
    text = "unknown: {stages: 2, shape: imex}\ndesign: {p-stable: {2: true}}\n"
    with pytest.raises(MethodFileError, match="meant of the whole method"):
        loads_family(text)
    path = tmp_path / "family.yaml"
    path.write_text(THREE, encoding="utf-8")
    refused = gark("design", str(path), "--order", "4", "--search", "3")
    assert (refused.code, "gark check" in refused.err) == (2, True)


IMEX = """unknown: {stages: 4, shape: [imex, stiffly-accurate]}
design:
  order: 3
  R-infinity: {2: 0}
  l-stable: {2: true}
  fix: {b1: 0, c2: gamma, c3: (1 + gamma)/2, e42: e43, e32: 2/5}
"""


def test_implicit_explicit_methods_with_an_l_stable_part() -> None:
    """Four stages of order 3: of the three γ with R(∞) = 0, the roots of 6γ³ − 18γ² + 9γ − 1, one
    makes the implicit part L-stable, 0.4358… (R. Alexander 1977); its method is proved.
    """
    found = find_parameters(loads_family(IMEX))
    [one] = found.last.found
    assert (one.accepted, one.unstable) == ((1,), (0, 2))
    [chosen] = accepted_methods(found)
    assert chosen.order == 3
    method = loads(IMEX.split("design")[0], settings=chosen.values)
    R = stability_function(method.tableau, [fmpq(0), fmpq(1)])
    assert is_l_stable(R)


def test_all_solutions_are_written(tmp_path: Path) -> None:
    """Each of several solutions has a file of its own, whose claim gark check proves."""
    path, folder = tmp_path / "two.gark.yaml", tmp_path / "all"
    path.write_text(SDIRK, encoding="utf-8")
    run = gark("design", str(path), "--order", "3", "--output-dir", str(folder))
    assert run.code == 0
    files = sorted(folder.iterdir())
    assert [x.name for x in files] == ["two-1.gark.yaml", "two-2.gark.yaml"]
    texts = [x.read_text(encoding="utf-8") for x in files]
    assert texts[0] != texts[1]
    assert gark("check", *map(str, files), "--require-claims").code == 0
    none = gark("design", str(path), "--order", "2", "--output-dir", str(folder))
    assert (none.code, "no order has finitely many" in none.err) == (2, True)


def test_radicands_have_no_square_factors() -> None:
    """Squares of large primes are taken out: (x − 1)² = 2 · 10007² has the roots 1 ± 10007 √2."""
    prime = 10007
    root = RealRoot(fmpz_poly([1 - 2 * prime**2, -2, 1]), 1)
    assert root_text(root) == f"1 + {prime}*sqrt(2)"
    large = fmpq(3 * prime**2 * 1000003**2)
    assert square_free(large) == 3
    beyond = fmpq(2 * (2**61 - 1) ** 2)  # 123 bits, the square of a prime
    assert square_free(beyond) == 2


def test_elements_without_radicals_are_written_in_theta() -> None:
    """A field of which only the polynomial is known has elements that can be printed."""
    field = NumberField(fmpq_poly([-2, 0, 0, 1]), ())
    assert str(field.element(fmpq_poly([1, fmpq(-1, 2), 3]))) == ("1 - theta/2 + 3*theta**2")
