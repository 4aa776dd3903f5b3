"""Unknown Nyström methods: shapes and "?", against a step as power series and ``gark check``."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from flint import fmpq

from garkcli import load, loads
from garkcli.api.design import found_methods
from garkcli.constructions.nystrom import Nystrom
from garkcli.design.design import Design, find_parameters
from garkcli.design.minimise.squared_error import squared_error
from garkcli.errors import MethodFileError
from garkcli.exact.parametric import fraction
from garkcli.methodfile.family import loads_family
from garkcli.order.conditions import all_conditions
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import gark
from tests.oracles import nystrom_series


def design(text: str, **settings: str) -> Design:
    family = loads_family(text, settings=settings)
    return find_parameters(family, family.order)


def orders_by_series(tableau: Tableau, limit: int) -> tuple[int, int]:
    """Of a method with rational numbers."""

    def row(numbers: Any) -> list[Fraction]:
        return [Fraction(int(x.p), int(x.q)) for x in numbers]

    found = Nystrom.of(tableau)
    A = None if found.A is None else list(map(row, found.A))
    Abar = list(map(row, found.Abar))
    method = nystrom_series.Method(Abar, A, row(found.c), row(found.bbar), row(found.b))
    return nystrom_series.orders(method, limit)


@pytest.mark.parametrize(
    ("stages", "dimensions"), [(1, {1: 1, 2: -1}), (2, {2: 3, 3: 0, 4: -1}), (3, {4: 1, 5: -1})]
)
def test_orders_of_few_stages(stages: int, dimensions: dict[int, int]) -> None:
    """Two stages have one method of order 3, three a curve of those of order 4 and no more."""
    shape = f"unknown: {{stages: {stages}, shape: nystrom}}"
    for order, dimension in dimensions.items():
        found = design(f"{shape}\ndesign: {{order: {order}}}")
        assert found.last.ideal is not None
        assert found.last.ideal.dimension == dimension


def test_the_method_of_nystrom_comes_out() -> None:
    """E. J. Nyström's of 1925, with the nodes 1/2 and 1, is the one of order 4 there."""
    text = "unknown: {stages: 3, shape: nystrom}\ndesign: {order: 4}"
    [method] = found_methods(design(text, c2="1/2", c3="1"))
    assert Nystrom.of(method.tableau) == Nystrom.of(load("nystrom-4-positions").tableau)
    assert orders_by_series(method.tableau, 5) == (4, 4)


def test_steps_have_orders_of_their_own() -> None:
    """Position and velocity orders are wanted apart: the series says the same of what is found."""
    text = """nystrom: {Abar: [[], ["?"]], c: [0, 2/3], bbar: ["?", "?"], b: ["?", "?"]}
design: {order: 2, position-order: 3, velocity-order: 2, fix: {b1: 1/4, abar21: 1/3}}
"""
    [method] = found_methods(design(text))
    assert orders_by_series(method.tableau, 4) == (3, 2)
    assert 'position-order: ">= 3", velocity-order: ">= 2"' in method.text
    assert [str(x) for x in Nystrom.of(method.tableau).bbar] == ["1/4", "1/4"]


def test_row_sums_and_the_first_of_the_next_step() -> None:
    """``consistent`` asks for Σ ā_ij = c_i²/2 and Σ a_ij = c_i; ``stiffly-accurate`` lets the last
    stage be the first of the next step, of both matrices.
    """
    text = "unknown: {stages: 3, shape: [nystrom, velocities%s]}\ndesign: {order: 2%s}"
    found = design(text % (", stiffly-accurate", ", consistent: true"), c2="1/2", bbar2="1/6")
    [method] = found_methods(found)
    one = Nystrom.of(method.tableau)
    assert one.A is not None
    assert one.Abar[-1] == one.bbar
    assert one.A[-1] == one.b
    assert [sum(row, fmpq(0)) for row in one.A] == list(one.c)
    assert [sum(row, fmpq(0)) for row in one.Abar] == [c * c / 2 for c in one.c]
    assert min(orders_by_series(method.tableau, 3)) == 2
    same = design(text % ("", ", consistent: true, stiffly-accurate: true"))
    assert same.last.ideal is not None
    shaped = design(text % (", stiffly-accurate", ", consistent: true"))
    assert shaped.last.ideal is not None
    assert same.last.ideal.dimension == shaped.last.ideal.dimension


def test_embedded_weights_of_both_steps(tmp_path: Path) -> None:
    file, made = tmp_path / "m.yaml", tmp_path / "n.gark.yaml"
    file.write_text(
        "unknown: {stages: 3, shape: [nystrom, stiffly-accurate], embedded: true}\n"
        "design: {order: 3, embedded-order: 2, embedded-velocity-order: 2,"
        " fix: {c2: 1/2, bh3: 1/8, bbarh3: 0, bbarh1: 1/2}}\n"
    )
    run = gark("design", str(file), "--emit", str(made))
    assert run.code == 0, run.err
    assert "embedded order 2 with error" in " ".join(run.out.split())
    assert gark("check", str(made)).code == 0
    method = loads(made.read_text())
    assert method.embedded is not None
    assert [str(x) for x in method.embedded[1]] == ["1/8", "3/4", "1/8"]


def test_dense_output() -> None:
    """The slope of the output in q is that in q′ for Störmer and Verlet's method."""
    text = """nystrom:
  Abar: [[], [1/2]]
  c: [0, 1]
  bbar: [1/2, 0]
  b: [1/2, 1/2]
  dense: {degree: 2, bbar: [["?", "?"], ["?", "?"]], b: [["?", "?"], ["?", "?"]]}
design: {order: 2, dense-order: 2}
"""
    found = design(text)
    assert found.last.ideal is not None
    assert found.last.ideal.dimension == 2
    [method] = found_methods(design(text, bbart11="0", bbart22="0"))
    assert method.dense is not None
    assert method.order == 2
    assert gark("check", "-", stdin=method.text).code == 0


@pytest.mark.parametrize("name", ["nystrom-4", "nystrom-4-positions", "dprkn-43"])
def test_sums_of_squared_errors(name: str) -> None:
    """Σ e(u)² by tensors is that over a list of all trees, in which q counts two orders; with an
    unknown in a denominator too.
    """
    tableau = load(name).tableau
    for order in range(1, 7):
        errors = [
            (x.value - x.required) / x.tree.symmetry
            for x in all_conditions(tableau, order)
            for _ in x.trees
        ]
        found = squared_error(tableau, order, None)
        assert found.numerator / found.denominator == sum((e * e for e in errors), fmpq(0))


def test_sums_with_denominators() -> None:
    text = """parameters: {t: free}
nystrom: {Abar: [[], [1/(2*t^2)]], c: [0, 1/t], bbar: [1/3, 1/(6*t)], b: [1 - 1/(2*t), 1/(2*t)]}
"""
    family = loads_family(text)
    for order in (3, 4, 5, 6):
        found = squared_error(family.tableau, order, family.ring)
        quotient = family.ring.quotient(found.numerator, found.denominator)
        numerator, denominator = fraction(quotient, family.ring)
        at = [fmpq(2, 3)] + [fmpq(0)] * (len(family.ring.names) - 1)
        tableau = loads(text, settings={"t": "2/3"}).tableau
        plain = squared_error(tableau, order, None)
        assert numerator(*at) / denominator(*at) == plain.numerator / plain.denominator


def test_a_search_finds_order_5_and_the_least_error(tmp_path: Path) -> None:
    """Four stages have order 5 (Hairer, Nørsett, Wanner II.14); the certificate says so."""
    file = tmp_path / "m.yaml"
    file.write_text("unknown: {stages: 4, shape: nystrom}\ndesign: {order: 5}\n")
    made = tmp_path / "made"
    run = gark("design", str(file), "--search", "2", "--output-dir", str(made))
    assert run.code == 0
    for path in made.iterdir():
        assert orders_by_series(loads(path.read_text()).tableau, 6)[1] == 5
    run = gark("design", str(file), "--search", "1", "--minimise", "error")
    assert "least error found" in run.out


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("unknown: {stages: 2, shape: [nystrom, dirk]}", "dirk does not go with nystrom"),
        ("unknown: {stages: 2, shape: velocities}", "velocities are those of a nystrom shape"),
        ("unknown: {stages: 1, shape: [nystrom, stiffly-accurate]}", "last node 1"),
        (
            "unknown: {stages: 2, shape: nystrom}\ndesign: {symplectic: true}",
            "symplectic is not for Nyström methods",
        ),
        (
            "unknown: {stages: 2, shape: nystrom}\ndesign: {w-order: 2}",
            "w-order is for Rosenbrock methods",
        ),
        (
            "unknown: {stages: 2, shape: explicit}\ndesign: {position-order: 2}",
            "position-order is for Nyström methods",
        ),
    ],
)
def test_what_is_refused(text: str, message: str) -> None:
    with pytest.raises(MethodFileError, match=message):
        loads_family(text)
