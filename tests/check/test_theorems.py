"""No report about a rounded method contradicts itself: facts that theorems join agree."""

from __future__ import annotations

import pytest

from garkcli import loads
from garkcli.check.analysis import Analysis
from garkcli.frozen import replace
from tests.order.random_rounded import DATA, analysis, rounded_method
from tests.order.theorems import contradictions
from tests.whole import sample

NAMES = [
    "rk4",
    "bogacki-shampine-3",
    "gauss-2",
    "lobatto-iiia-3",
    "lobatto-iiib-3",
    "lobatto-iiic-3",
    "radau-iia-3",
    "tr-bdf2",
    "alexander-2",
    "imex-gark-2a",
    "imex-ssp3-433",
    "collocation",
]


def of_catalogue(name: str, digits: int) -> Analysis:
    """What a check says of a method with so many digits."""
    path = next(DATA.glob(f"*/{name}.gark.yaml"))
    return rounded_method(loads(path.read_text(encoding="utf-8")), digits)


@pytest.mark.parametrize("name", sample(NAMES, 3))
def test_facts_that_theorems_join_agree(name: str) -> None:
    """Orders of a method, its conjugate and its pair, their bounds, B, C, D, the criterion and
    properties, with 5, 8 or 12 digits.
    """
    digits = (5, 8, 12)[NAMES.index(name) % 3]
    assert contradictions(of_catalogue(name, digits)) == []


def test_contradictions_are_found() -> None:
    """The comparison says something: reports with one fact changed contradict themselves."""
    found = of_catalogue("lobatto-iiia-3", 8)
    low, high = (replace(found.order, order=n) for n in (1, 6))
    for changed, text in (
        (replace(found, order=low), "order ≥ bound"),
        (replace(found, order=high), "B(order)"),
        (replace(found, pair_order=high), "pair order ≤ order"),
        (replace(found, conjugate_order=low), "conjugate order ≥ min(order, 2)"),
        (replace(found, symplectic=True, pair_order=low), "symplectic: pair order = order"),
        (replace(found, pair_order=low), "criterion ≤ pair order"),
    ):
        assert text in contradictions(changed)


TEXTS = {
    "halfway between decimals": (
        "A: [[0, 0], [0.57813, -0.07812]]\nb: [0.50000, 0.50000]\ntolerance: 5e-6\n"
    ),
    "met to second order": (
        "A: [[0, 0, 0], [0.208, 0.333, -0.042], [0.167, 0.667, 0.167]]\n"
        "b: [0.167, 0.667, 0.167]\nconjugate: true\ntolerance: 5e-4\n"
    ),
}


@pytest.mark.parametrize("name", TEXTS)
def test_reports_that_were_contradictions(name: str) -> None:
    """Order 4 with B(0), and what is like it."""
    assert contradictions(analysis(loads(TEXTS[name]))) == []
