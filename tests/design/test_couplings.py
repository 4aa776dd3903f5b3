"""Unknown multirate couplings and unknowns beside α and β of Shu and Osher: published ones come out,
a step as power series and ``gark check`` agree; unknown embedded rows of every form.
"""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest

from garkcli import load, loads
from garkcli.api.design import found_methods
from garkcli.constructions.infinitesimal import Coupling
from garkcli.design.design import Design, find_parameters
from garkcli.design.minimise.squared_error import squared_error
from garkcli.errors import MethodError, MethodFileError
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.constructed.multirate import coupling_of
from garkcli.methodfile.family import loads_family
from garkcli.order.constants import error_constants
from tests.cli.harness import gark
from tests.oracles import multirate_series
from tests.whole import in_whole

SANDU = """multirate:
  mri:
    c: [0, 1/3, 2/3, 1]
    gamma:
      - [["?"], ["?", "?"], ["?", "?", "?"]]
      - [["?"], ["?", "?"], ["?", "?", "?"]]
  fast: exact
design: {order: 3}
"""


def design(text: str, **settings: str) -> Design:
    family = loads_family(text, settings=settings)
    return find_parameters(family, family.order)


def coupling(method: MethodFile) -> Coupling:
    found = coupling_of(method)
    assert found is not None
    return found


def order_by_series(method: MethodFile, limit: int) -> int:
    """With the exact fast solution, of rational numbers."""

    def rows(matrix: Any) -> list[list[Fraction]]:
        return [[Fraction(int(x.p), int(x.q)) for x in row] for row in matrix]

    found = coupling(method)
    assert found.matrices is not None
    forcing = [[rows(matrix) for matrix in part] for part in found.matrices]
    (nodes,) = rows([found.nodes])
    return multirate_series.order(multirate_series.Method("mri", nodes, forcing), limit)


def test_the_coupling_of_order_3_of_sandu() -> None:
    """His methods with nodes 0, 1/3, 2/3 and a linear forcing are a family, in which that of
    SUNDIALS is. All have the row sums that the shape writes.
    """
    found = design(SANDU)
    assert found.last.ideal is not None
    assert found.last.ideal.dimension == 2
    [method] = found_methods(design(SANDU, gamma2_32="0", gamma2_33="-1/2"))
    assert coupling(method).matrices == coupling(load("mri-gark-erk33a")).matrices
    [other] = found_methods(design(SANDU, gamma2_32="1", gamma2_33="1/7"))
    for one in (method, other):
        assert order_by_series(one, 4) == 3
    shape = "unknown: {stages: 3, shape: mri}\ndesign: {order: 3}"
    shaped = design(shape, c2="1/3", c3="2/3")
    assert shaped.last.ideal is not None
    assert shaped.last.ideal.dimension == 2
    [same] = found_methods(design(shape, c2="1/3", c3="2/3", gamma2_32="0", gamma2_33="-1/2"))
    assert coupling(same).matrices == coupling(method).matrices


def test_more_orders_than_stages() -> None:
    """The slow method alone is a Runge–Kutta method of two stages."""
    found = design("unknown: {stages: 2, shape: mri}")
    assert [(x.order, x.kind) for x in found.steps][-1] == (3, "none")


def test_what_is_found_is_claimed_and_passes_check(tmp_path: Path) -> None:
    file, made = tmp_path / "m.yaml", tmp_path / "n.gark.yaml"
    file.write_text(
        "unknown: {stages: 3, shape: mri, embedded: true}\n"
        "design: {order: 3, slow-order: 3, embedded-order: 2, nodes-ascending: true, fix:"
        " {c2: 1/3, c3: 2/3, gamma2_22: 0, gamma2_32: 0, bh1_2: 0, bh2_2: 0, bh2_3: 0}}\n"
    )
    assert gark("design", str(file), "--emit", str(made)).code == 0
    assert 'order: 3, embedded-order: 2, slow-order: ">= 3"' in made.read_text()
    assert gark("check", str(made)).code == 0
    assert order_by_series(loads(made.read_text()), 4) == 3


def test_least_error() -> None:
    """Σ e(u)² over all trees of the next order is that of the error constants."""
    tableau = load("mri-gark-erk33a").tableau
    for order in (2, 3, 4):
        constants = error_constants(tableau, order)
        assert constants is not None
        found = squared_error(tableau, order, None)
        assert found.numerator / found.denominator == constants.all.two_squared
    with pytest.raises(MethodError, match="the fast part is solved exactly"):
        squared_error(tableau, 5, None)


@pytest.mark.parametrize(("stages", "order"), [(3, 3), pytest.param(5, 4, marks=in_whole)])
def test_a_search_finds_couplings(stages: int, order: int, tmp_path: Path) -> None:
    """Three stages and a linear forcing have order 3, five have order 4 (Sandu 2019, ERK33a and
    ERK45a).
    """
    file, made = tmp_path / "m.yaml", tmp_path / "made"
    nodes = ", ".join(f"c{i + 1}: {i}/{stages}" for i in range(1, stages))
    shape = f"unknown: {{stages: {stages}, shape: mri}}\n"
    file.write_text(f"{shape}design: {{order: {order}, fix: {{{nodes}}}}}\n")
    run = gark("design", str(file), "--search", "1", "--output-dir", str(made))
    assert run.code == 0, run.err
    [path] = made.iterdir()
    assert loads(path.read_text()).order == order


@pytest.mark.parametrize(
    ("text", "polynomials"),
    [
        (
            "multirate: {mri: {c: [0, 1/2, 1], gamma: [[[1/2], [-1/2, 1]]],"
            ' embedded: [["?", "?"]]}, fast: exact}\ndesign: {embedded-order: 1}',
            {"2*bh1_1 + 2*bh1_2 - 1"},
        ),
        (
            'multirate: {mis: {A: [[], [1/2]], b: [0, 1], embedded: ["?", "?"]}, fast: exact}\n'
            "design: {embedded-order: 1}",
            {"bh1 + bh2 - 1"},
        ),
        (
            "multirate: {slow: rk4, fast: exact, coupling: {gamma: [[2/3, 1/3, 1/3, -1/3],"
            ' [-1, 0, 0, 1]], embedded: [["?", "?", 0, 0]]}}\ndesign: {embedded-order: 2}',
            {"bh1_2 - 1", "bh1_1"},
        ),
        (
            "multirate: {mri: {c: [0, 1, 1], omega: [[[1], [-1/2, 1/2]]], gamma:"
            ' [[[1], [-1/2, 0, 1/2]]], embedded: {omega: [["?", "?"]], gamma: [["?", "?"]]}},'
            " fast: exact}\ndesign: {embedded-order: 1}",
            {"omegah1_1 + omegah1_2", "gammah1_1 + gammah1_2"},
        ),
        (
            "rosenbrock: {transformed: {gamma: 1/2, A: [[], [0], [2, 0], [2, 0, 1]], C: [[], [4],"
            ' [1, -1], [1, -1, -8/3]], m: [2, 0, 1, 1], e: [0, 0, "?", "?"]}}\n'
            "design: {embedded-order: 2}",
            set(),
        ),
        (
            "parameters: {g: 1/2}\nrosenbrock:\n  blocks:\n"
            "    alpha: [[[[], [1]], [[], [1]]], [[[], [1]], [[], [1]]]]\n"
            "    gamma: [[[[g], [-2*g, g]], null], [null, null]]\n"
            "    b: [[1/2, 1/2], [1/2, 1/2]]\n"
            '    embedded: [["?", 0], ["?", 0]]\ndesign: {embedded-order: 1}',
            {"bh1_1 - 1", "bh2_1 - 1"},
        ),
    ],
    ids=["mri", "mis", "predictor", "two parts", "transformed", "blocks"],
)
def test_unknown_embedded_weights_of_every_form(text: str, polynomials: set[str]) -> None:
    """The equations are those of order 1 or 2 of the embedded step."""
    found = design(text + ("\n" if "}" in text else ""))
    assert {str(x) for x in found.steps[0].polynomials} == polynomials


def test_shu_and_osher_come_out() -> None:
    """With the first slopes of two rows alone the third-order method is theirs, of SSP coefficient
    1; its file has α and β.
    """
    text = """unknown: {stages: 3, shape: shu-osher}
design: {order: 3, fix: {alpha22: 1/4, alpha32: 0, beta21: 0, beta31: 0, beta32: 0, beta33: 2/3}}
"""
    [method] = found_methods(design(text))
    assert method.form == "shu-osher"
    assert method.tableau.blocks == load("ssp33").tableau.blocks
    by_place = """shu-osher:
  alpha: [[1], [3/4, "?"], [1/3, 0, "?"]]
  beta: [["?"], [0, "?"], [0, 0, "?"]]
design: {order: 3, fix: {alpha22: 1/4, beta33: 2/3}}
"""
    names = loads_family(by_place).parameters
    assert names == ("alpha22", "alpha33", "beta11", "beta22", "beta33")
    # 3/4 and 1/3 are no choice: what is missing from 1 is the value at the beginning
    [same] = [x for x in found_methods(design(by_place)) if x.tableau == method.tableau]
    assert same.order == 3


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("unknown: {stages: 2, shape: [mri, dirk]}", "dirk does not go with mri"),
        ("unknown: {stages: 2, shape: [shu-osher, dirk]}", "dirk does not go with shu-osher"),
        (
            "unknown: {stages: 2, shape: mri}\ndesign: {stage-order: 1}",
            "stage-order is not for multirate infinitesimal methods",
        ),
        (
            "unknown: {stages: 2, shape: dirk}\ndesign: {slow-order: 1}",
            "slow-order is for multirate infinitesimal methods",
        ),
        (
            "parameters: {t: free}\n"
            "low-storage: {form: 2S, gamma1: [0, t], gamma2: [1, 1/2], delta: [1, 1], beta: [1, 1]}",
            r"the step begins at \(t \+ 1\) y, not at y",
        ),
    ],
)
def test_what_is_refused(text: str, message: str) -> None:
    with pytest.raises(MethodFileError, match=message):
        loads_family(text)


def test_check_wants_numbers(tmp_path: Path) -> None:
    """``gark check`` says nothing of every value where the fast part is exact."""
    file = tmp_path / "m.yaml"
    file.write_text("unknown: {stages: 2, shape: mri}\n")
    run = gark("check", str(file))
    assert run.code == 2
    assert "a parameter is free, and the fast part is solved exactly" in run.out + run.err
