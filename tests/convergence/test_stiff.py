"""Stiff problems: the order at stiffness 1, the slope that stiffness leaves, and the page about it."""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

import pytest
from flint import fmpq

from garkcli import converge, loads
from garkcli.convergence.result import Convergence
from garkcli.methodfile.build import MethodFile
from garkcli.order.meant import meant
from garkcli.order.simplifying import simplifying
from garkcli.order.weak_stages import weak_stage_order
from garkcli.problems.builtin import problem
from garkcli.stepping.integrator import StepFailed
from tests.catalogue.catalogue import entries
from tests.catalogue.method_files import method_file
from tests.whole import IS_WHOLE, in_whole, renewed_in_whole, sample

PAGE = Path(__file__).resolve().parents[2] / "docs" / "stiff-problems.md"
DATA = PAGE.parents[1] / "garkcli" / "catalogue" / "data" / "dirk"
BEGIN, END = "<!-- slopes -->\n", "<!-- end of slopes -->\n"
HEAD = (
    "| method | order | stage order | weak | Prothero–Robinson, 1 | 10⁶ | van der Pol, 1 | 10⁶ |\n"
    "|---|---|---|---|---|---|---|---|\n"
)
FAMILIES = {
    "RK4": ("rk4", 4),
    "Gauss 1": ("gauss", 1),
    "Gauss 2": ("gauss", 2),
    "Gauss 3": ("gauss", 3),
    "Gauss 4": ("gauss", 4),
    "Radau IIA 1": ("radau-iia", 1),
    "Radau IIA 2": ("radau-iia", 2),
    "Radau IIA 3": ("radau-iia", 3),
    "Lobatto IIIA 3": ("lobatto-iiia", 3),
    "Lobatto IIIC 2": ("lobatto-iiic", 2),
    "Lobatto IIIC 3": ("lobatto-iiic", 3),
}
CATALOGUE = {
    "SDIRK 4 of Hairer and Wanner": "sundials_SDIRK_5_3_4",
    "IMEX ARS(2,2,2)": "sciml_ARS222",
    "IMEX ARS(2,3,2)": "sciml_ARS232",
    "IMEX ARS(3,4,3)": "sciml_ARS343",
    "IMEX ARS(4,4,3)": "sciml_ARS443",
    "IMEX KenCarp3": "sciml_KenCarp3",
    "IMEX ARK3(2)4L[2]SA": "sundials_ARK324L2SA",
    "IMEX SSP3(4,3,3)": "sciml_IMEXSSP3433",
}
WEAK = {
    "DIRK(4,3,2)": "wso-432",
    "DIRK(4,3,3)": "wso-433",
    "DIRK(6,4,3)": "wso-643",
    "DIRK(7,4,4)": "wso-744",
    "DIRK(12,5,4)": "wso-1254",
    "DIRK(12,5,5)": "wso-1255",
}
"""Stages, order and weak stage order, and names in the catalogue of gark."""
SHOWN = (
    "RK4", "Gauss 2", "Gauss 3", "Radau IIA 2", "Radau IIA 3", "Lobatto IIIA 3", "Lobatto IIIC 3",
    "SDIRK 4 of Hairer and Wanner", "IMEX ARS(2,2,2)", "IMEX ARS(3,4,3)", "IMEX ARS(4,4,3)",
    "IMEX SSP3(4,3,3)", "DIRK(4,3,3)", "DIRK(7,4,4)", "DIRK(12,5,5)",
)  # fmt: skip
"""The rows of the page."""
TESTS = [
    (name, stiffness) for name in ("prothero-robinson", "van-der-pol") for stiffness in (1, 10**6)
]
# Hairer and Wanner II, table IV.15.1: the power of h in the global error, with z = λh
LITERATURE = {
    "Gauss 1": 2,
    "Gauss 2": 2,
    "Gauss 3": 4,
    "Gauss 4": 4,
    "Radau IIA 1": 1,
    "Radau IIA 2": 2,
    "Radau IIA 3": 3,
    "Lobatto IIIA 3": 2,
    "Lobatto IIIC 2": 1,
    "Lobatto IIIC 3": 2,
}


@cache
def method(name: str) -> MethodFile:
    """The method of a row."""
    if name in WEAK:
        return loads((DATA / f"{WEAK[name]}.gark.yaml").read_text(encoding="utf-8"))
    if name in CATALOGUE:
        return loads(method_file(entries()[CATALOGUE[name]]))
    family, stages = FAMILIES[name]
    return loads(f"methods: [{{family: {family}, stages: {stages}}}]")


@cache
def measured(name: str, on: str, stiffness: int) -> Convergence:
    """The convergence test of a method."""
    found = method(name)
    solved = problem(on, found.tableau.size, stiffness=fmpq(stiffness))
    return converge(found.tableau, solved, tolerance=found.tolerance)


def shown(name: str, on: str, stiffness: int) -> str:
    """A cell of the table."""
    try:
        order = measured(name, on, stiffness).observed_order
    except StepFailed:
        return "fails"
    assert order is not None
    return f"{order:.1f}"


def row(name: str) -> list[str]:
    """The cells of a method."""
    found = method(name)
    tolerance = fmpq(0) if found.tolerance is None else found.tolerance
    order = measured(name, "prothero-robinson", 1).predicted_order
    rounded = meant(found.tableau, tolerance)
    stage_order = simplifying(rounded).eta
    weak = weak_stage_order(rounded, [found.tableau.size - 1], 9)
    numbers = map(str, (order, stage_order, weak))
    return [name, *numbers, *(shown(name, *test) for test in TESTS)]


@renewed_in_whole
def test_the_page_is_measured() -> None:
    """The table of docs/stiff-problems.md, cell by cell: some rows, in ``make whole`` all;
    GARK_UPDATE_SNAPSHOTS writes it.
    """
    head, begin, rest = PAGE.read_text(encoding="utf-8").partition(BEGIN)
    table, end, tail = rest.partition(END)
    assert begin
    assert end
    is_renewed = bool(os.environ.get("GARK_UPDATE_SNAPSHOTS"))
    names = SHOWN if IS_WHOLE or is_renewed else SHOWN[1::8]
    rows = [row(name) for name in names]
    if is_renewed:
        made = HEAD + "".join(f"| {' | '.join(cells)} |\n" for cells in rows)
        PAGE.write_text(head + begin + made + end + tail, encoding="utf-8")
        return
    assert table.startswith(HEAD)
    lines = table.removeprefix(HEAD).splitlines()
    assert [line.split(" | ")[0] for line in lines] == [f"| {name}" for name in SHOWN]
    there_are = dict(zip(SHOWN, lines, strict=True))
    for line, cells in zip((there_are[name] for name in names), rows, strict=True):
        printed = line.strip("| ").split(" | ")
        for k, (there, here) in enumerate(zip(printed, cells, strict=True)):
            is_measured = k > 3 and "fails" not in (there, here)
            # a cell may be on the edge between two tenths
            assert abs(float(there) - float(here)) < 0.11 if is_measured else there == here


@pytest.mark.parametrize("name", sample([*FAMILIES, *CATALOGUE], 5))
def test_all_show_their_order_where_nothing_is_stiff(name: str) -> None:
    """At stiffness 1 the observed order is that of the method, on both problems."""
    for on in ("prothero-robinson", "van-der-pol"):
        result = measured(name, on, 1)
        assert result.verdict == "agree"
        assert result.stiff is None
        assert result.observed_order == pytest.approx(result.predicted_order, abs=0.05)


@in_whole
@pytest.mark.parametrize("name", sample([*WEAK], 6))
def test_slopes_are_the_weak_stage_orders(name: str) -> None:
    """Where the stage order is 1, the slope on the stiff problem is the weak stage order that the
    source gives the method.
    """
    result = measured(name, "prothero-robinson", 10**6)
    assert result.stiff is not None
    wanted = int(name.rstrip(")").split(",")[-1])
    assert (result.stiff.stage_order, result.stiff.weak_stage_order) == (1, wanted)
    assert result.observed_order == pytest.approx(wanted, abs=0.1)


@pytest.mark.parametrize(("name", "power"), sample([*LITERATURE.items()], 2))
def test_slopes_are_those_of_the_literature(name: str, power: int) -> None:
    """Global errors on the equation of Prothero and Robinson with λh → ∞."""
    result = measured(name, "prothero-robinson", 10**6)
    assert result.stiff is not None
    assert result.observed_order == pytest.approx(power, abs=0.1)
    is_reduced = power < result.predicted_order
    assert result.verdict == ("reduced" if is_reduced else "agree")
    if is_reduced:
        assert result.short_order == pytest.approx(result.predicted_order, abs=0.05)


@in_whole
def test_imex_methods_are_reduced() -> None:
    """Those that are, each on its problems; the verdict is no disagreement."""
    on_prothero_robinson = {
        "IMEX ARS(2,2,2)": 1,
        "IMEX ARS(3,4,3)": 2,
        "IMEX KenCarp3": 2,
        "IMEX ARK3(2)4L[2]SA": 2,
        "IMEX SSP3(4,3,3)": 2,
    }
    for name, order in sample([*on_prothero_robinson.items()], 4):
        result = measured(name, "prothero-robinson", 10**6)
        assert result.verdict == "reduced"
        assert result.observed_order == pytest.approx(order, abs=0.1)
    on_van_der_pol = {
        "IMEX ARS(3,4,3)": 2,
        "IMEX KenCarp3": 2,
        "IMEX ARK3(2)4L[2]SA": 2,
        "IMEX SSP3(4,3,3)": 1,
    }
    for name, order in sample([*on_van_der_pol.items()], 4):
        result = measured(name, "van-der-pol", 10**6)
        assert result.verdict == "reduced"
        assert result.observed_order == pytest.approx(order, abs=0.1)


def test_what_is_not_stable_disagrees() -> None:
    """RK4 with large steps: errors are far larger than the solution, and a slope says nothing."""
    solved = problem("prothero-robinson", 1, stiffness=fmpq(10**6))
    steps = [fmpq(1), fmpq(1, 2), fmpq(1, 4)]
    result = converge(method("RK4").tableau, solved, steps=steps)
    assert result.verdict == "disagree"
    assert result.stiff is not None
    assert not result.stiff.is_stable


@in_whole
def test_resolved_stiffness_is_none() -> None:
    """Steps far below 1/λ show the classical order, and the run is not called stiff."""
    solved = problem("prothero-robinson", 1, stiffness=fmpq(1000))
    steps = [fmpq(1, 2**k) for k in (14, 15, 16)]
    result = converge(method("RK4").tableau, solved, steps=steps)
    assert result.stiff is None
    assert result.verdict == "agree"
