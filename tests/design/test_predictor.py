"""Unknown predictors: known ones come out, and what is found passes ``gark check``."""

from __future__ import annotations

from math import sqrt
from pathlib import Path

import pytest

from garkcli.api.design import found_methods
from garkcli.design.design import Design, find_parameters
from garkcli.errors import MethodFileError
from garkcli.exact.display import to_float
from garkcli.methodfile.family import loads_family
from tests.cli.harness import gark

TRAPEZOIDAL = "A: [[0, 0], [1/2, 1/2]]\nb: [1/2, 1/2]\n"
GAUSS = """parameters: {w: sqrt(3)/6}
A: [[1/4, 1/4 - w], [1/4 + w, 1/4]]
b: [1/2, 1/2]
predictor: {old: [[["?", "?"], ["?", "?"]], [["?", "?"], ["?", "?"]]]}
"""


def design(text: str) -> Design:
    family = loads_family(text)
    return find_parameters(family, family.order)


def old_weights(found: Design) -> list[list[list[float]]]:
    """Of the one method."""
    (method,) = found_methods(found)
    assert method.predictor is not None
    return [[list(map(to_float, row)) for row in matrix] for matrix in method.predictor.old]


def test_the_line_through_the_last_two_slopes() -> None:
    """The slope of the trapezoidal rule's stage 2 is extrapolated from both of the last step."""
    text = TRAPEZOIDAL + 'predictor: {old: [[], ["?", "?"]]}\ndesign: {order: 2, %s: 2}\n'
    found = design(text % "predictor-order-equal-steps")
    assert old_weights(found) == [[[0, 0], [-0.5, 1.5]]]
    assert design(text % "predictor-order").last.kind == "none"


def test_any_ratio_asks_for_polynomials_in_it() -> None:
    matrix = '[[], ["?", "?"]]'
    text = f"{TRAPEZOIDAL}predictor: {{old: [{matrix}, {matrix}]}}\n"
    found = design(text + "design: {order: 2, predictor-order: 2}\n")
    assert old_weights(found) == [[[0, 0], [0, 1]], [[0, 0], [-0.5, 0.5]]]


def test_gauss_goes_on_by_its_collocation_polynomial() -> None:
    """Order 2 is that polynomial alone, with entries of b_j(1 + r c_i) − b_j over r; 3 has none.

    M. P. Laburta, *Starting algorithms for IRK methods*, 1997.
    """
    found = design(GAUSS + "design: {order: 4, predictor-order: 2}\n")
    (one,) = found.last.found
    assert one.predictor is not None
    assert (one.predictor.order, one.predictor.equal_steps) == (2, 2)
    first, second = old_weights(found)
    # b_1(θ) = (1 + sqrt(3)) θ/2 − sqrt(3) θ²/2: c_i b_1'(1) and c_i² b_1''(1)/2 at c_1
    c, root = (3 - sqrt(3)) / 6, sqrt(3)
    wanted = c * (1 - root) / 2, -(c**2) * root / 2
    assert first[0][0] == pytest.approx(wanted[0])
    assert second[0][0] == pytest.approx(wanted[1])
    assert design(GAUSS + "design: {order: 4, predictor-order: 3}\n").last.kind == "none"


def test_a_published_one_comes_out() -> None:
    """The slope of stage 3 of TR-BDF2 on the line through those before it, as OrdinaryDiffEq has
    it: k_3 ≈ -sqrt(2)/2 k_1 + (1 + sqrt(2)/2) k_2.
    """
    g, w = 1 - sqrt(2) / 2, sqrt(2) / 4
    text = """parameters: {g: 1 - sqrt(2)/2, w: sqrt(2)/4}
A: [[0], [g, g], [w, w, g]]
b: [w, w, g]
predictor: {old: [[], ["?", 0, "?"], []], new: [[], [], ["?", "?"]]}
design: {order: 2, predictor-order-equal-steps: 2}
"""
    (method,) = found_methods(design(text))
    assert method.predictor is not None
    row = [to_float(x) for x in method.predictor.new[0][2]]
    wanted = [w - g * sqrt(2) / 2, w + g * (1 + sqrt(2) / 2), 0]
    assert row == pytest.approx(wanted)


def test_what_is_found_passes_check(tmp_path: Path) -> None:
    file, made = tmp_path / "m.yaml", tmp_path / "n.yaml"
    text = TRAPEZOIDAL + 'predictor: {old: [[], ["?", "?"]]}\n'
    file.write_text(text + "design: {order: 2, predictor-order-equal-steps: 2}\n")
    run = gark("design", str(file), "--emit", str(made))
    assert run.code == 0
    assert "predictor order 1, 2 with equal steps" in run.out
    assert 'predictor-order-equal-steps: ">= 2"' in made.read_text()
    assert gark("check", str(made)).code == 0


def test_a_predictor_that_is_not_there() -> None:
    with pytest.raises(MethodFileError, match="needs a predictor"):
        design('A: [["?"]]\nb: [1]\ndesign: {order: 1, predictor-order: 1}\n')
