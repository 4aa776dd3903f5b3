"""Extrapolation: orders by two ways, and the families that are extrapolations of Euler's method."""

from __future__ import annotations

import pytest

from garkcli.api.methods import find_order
from garkcli.errors import MethodFileError
from garkcli.families.registry import diagonal_method
from garkcli.methodfile.family import loads_family
from garkcli.methodfile.load import loads
from garkcli.tableau.forms import gark
from tests.oracles.series import series_order
from tests.whole import in_whole

MIDPOINT = "{family: gauss, stages: 1}"
VERLET = "{splitting: {scheme: strang}}"
ORDERS = {
    "{of: explicit-euler, order: 3}": ((4,), 3),
    "{of: explicit-euler, sequence: [1, 4, 2]}": ((5,), 3),
    "{of: heun, order: 4}": ((10,), 4),
    f"{{of: {MIDPOINT}, order: 6}}": ((6,), 6),
    f"{{of: {MIDPOINT}, order: 4, sequence: romberg}}": ((3,), 4),
    f"{{of: {MIDPOINT}, sequence: [1, 2, 3], symmetric: false}}": ((6,), 4),
    f"{{of: {VERLET}, order: 4}}": ((4, 3), 4),
    "{of: {splitting: {scheme: lie, of: explicit-euler}}, order: 3}": ((4, 6), 3),
    "{of: {family: gauss, stages: 2}, order: 8, from: 4}": ((12,), 8),
}
"""What is extrapolated, its stages and its order."""


@pytest.mark.parametrize("text", ORDERS)
def test_orders(text: str) -> None:
    """An order a row, two of a symmetric method; the certificate and a power series agree."""
    stages, order = ORDERS[text]
    method = loads(f"extrapolate: {text}")
    assert method.stages == stages
    assert find_order(method).order == order
    if order <= 4:
        assert series_order(method.tableau, order + 1) == order


@pytest.mark.parametrize("sequence", ["harmonic", "romberg", "bulirsch"])
def test_the_families_are_extrapolations(sequence: str) -> None:
    """Euler's methods, extrapolated by the construction, are the families that are written down
    stage by stage, coefficient for coefficient.
    """
    for base, name in (
        ("explicit-euler", "extrapolated-euler"),
        ("{family: radau-iia, stages: 1}", "extrapolated-implicit-euler"),
    ):
        made = loads(f"extrapolate: {{of: {base}, order: 4, sequence: {sequence}}}")
        family = diagonal_method(name, 4, sequence=sequence)
        assert made.tableau == gark([family], {})


@in_whole
def test_rounded_methods_are_extrapolated_within_their_tolerance() -> None:
    """The order of a rounded base is the one within its tolerance."""
    base = f"{{compose: {{of: {MIDPOINT}, scheme: yoshida-6}}}}"
    method = loads(f"extrapolate: {{of: {base}, sequence: [1, 2]}}")
    assert method.tolerance is not None
    assert find_order(method).order == 8


@pytest.mark.parametrize(
    ("rounded", "exact"),
    [
        ("{A: [[], [0.6666666666666667]], b: [0.25, 0.75]}", "{A: [[], [2/3]], b: [1/4, 3/4]}"),
        (
            "{A: [[0.25, -0.0386751345948129], [0.5386751345948129, 0.25]], b: [0.5, 0.5]}",
            "{family: gauss, stages: 2}",
        ),
        pytest.param(
            "{adjoint: {A: [[], [0.6666666666666667]], b: [0.25, 0.75]}}",
            "{adjoint: {A: [[], [2/3]], b: [1/4, 3/4]}}",
            marks=in_whole,
        ),
    ],
)
def test_the_tolerance_of_the_file_holds_for_its_methods(rounded: str, exact: str) -> None:
    """A method that is spelled out in decimals is extrapolated as the one that it is meant to be:
    with as many rows, though its exact order is smaller.
    """
    text = f"extrapolate: {{of: {rounded}, order: 6}}\ntolerance: 1e-15"
    method = loads(text)
    meant = loads(f"extrapolate: {{of: {exact}, order: 6}}")
    assert method.stages == meant.stages
    assert find_order(method).order == 6


def test_free_parameters() -> None:
    """A base with free parameters is extrapolated when its order and symmetry are said."""
    text = "parameters: {t: free}\nextrapolate: {of: {A: [[0, 0], [t, 0]], b: [0, 1]}, sequence: [1, 2]%s}"
    with pytest.raises(MethodFileError, match="free parameters"):
        loads_family(text % "")
    family = loads_family(text % ", from: 1, symmetric: false")
    assert family.parameters == ("t",)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{order: 4}", "of missing"),
        ("{of: heun}", "neither order nor sequence is given"),
        ("{of: heun, order: 2}", "has order 2 already"),
        ("{of: heun, sequence: [2, 2]}", "2 appears twice"),
        ("{of: heun, sequence: [2]}", "two numbers are needed"),
        ("{of: heun, sequence: harmonc, order: 3}", "is not known"),
        ("{of: heun, sequence: [1, 2], order: 3}", "determine the order"),
        ("{of: {A: [[0]], b: [2]}, order: 3}", "order 0"),
        ("{of: rk4, order: 30, sequence: romberg}", "limit 200"),
        ("{of: {family: gauss, stages: 7}, order: 16}", "no simple|without simple"),
        ("{of: rk4, order: 40}", "stages \\(limit 400\\)"),
    ],
)
def test_faults(text: str, message: str) -> None:
    """What cannot be extrapolated is told where it stands, as one fault."""
    with pytest.raises(MethodFileError, match=message) as caught:
        loads(f"extrapolate: {text}")
    assert len(caught.value.faults) == 1
