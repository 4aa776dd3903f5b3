"""Unknown dense output: published interpolants, against all trees one by one, steps as power series
and ``gark check``.
"""

from __future__ import annotations

import json
from math import factorial, prod
from pathlib import Path
from random import Random

import pytest
from flint import fmpq, fmpq_mat, fmpq_poly

from garkcli import load, loads, minimise, search_methods
from garkcli.api.design import found_methods
from garkcli.design.design import Design, find_parameters
from garkcli.design.member import further_member
from garkcli.design.minimise.squared_error import squared_dense_error
from garkcli.errors import MethodFileError
from garkcli.exact.roots import RealRoot
from garkcli.methodfile.family import loads_family
from garkcli.order.dense import slopes
from garkcli.tableau.embedded import DenseOutput
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import gark
from tests.oracles.brute import Plain, Trees, Weights, order_of, required
from tests.oracles.series import series_order
from tests.order.test_further import order_by_values, scaled

RK4 = "A: [[], [1/2], [0, 1/2], [0, 0, 1]]\nb: [1/6, 1/3, 1/3, 1/6]\n"
CUBIC = [["1", "-3/2", "2/3"], ["0", "1", "-2/3"], ["0", "1", "-2/3"], ["0", "-1/2", "2/3"]]
DORMAND_PRINCE = load("dormand-prince-5")
"""With the interpolant of order 4 that SciPy has."""
OF_MATLAB = [
    ["1", "-183/64", "37/12", "-145/128"],
    ["0", "0", "0", "0"],
    ["0", "1500/371", "-1000/159", "1000/371"],
    ["0", "-125/32", "125/12", "-375/64"],
    ["0", "9477/3392", "-729/106", "25515/6784"],
    ["0", "-11/7", "11/3", "-55/28"],
    ["0", "3/2", "-4", "5/2"],
]
"""The interpolant of ode45 in MATLAB: ntrp45.m."""
TWO = """methods:
  - {A: [[0, 0], [1, 0]], b: [1/2, 1/2], DENSE}
  - {A: [[1/2, 0, 0], [0, 1/2, 0], [1/3, 1/3, 1/3]], b: [1/4, 1/4, 1/2], DENSE}
transfer: {blocks: {"1,2": [[0, 0, 0], [1, 0, 0]], "2,1": [[1/2, 0], [1/2, 0], [0, 1]]}}
"""
"""Two colours of two and three stages."""


def unknown(stages: int, degree: int) -> str:
    """Dense output of which nothing is known but its degree."""
    row = ", ".join(['"?"'] * degree)
    rows = ", ".join([f"[{row}]"] * stages)
    return f"dense: {{degree: {degree}, weights: [{rows}]}}"


def in_text(tableau: Tableau) -> str:
    """A and b of a method of one colour."""
    A = ", ".join(f"[{', '.join(map(str, row))}]" for row in tableau.blocks[0, 0])
    return f"A: [{A}]\nb: [{', '.join(map(str, tableau.colours[0].b))}]\n"


def design(text: str, **settings: str) -> Design:
    family = loads_family(text, settings=settings)
    return find_parameters(family, family.order)


def dimension(found: Design) -> int:
    """Of the values at the highest order; -1 for none."""
    assert found.last.ideal is not None
    return found.last.ideal.dimension


def freedom(tableau: Tableau, order: int, power: int) -> int:
    """How many weights of a power of θ the conditions of all trees up to an order leave free, tree
    by tree; -1 where they have no solution.
    """
    weights, trees = Weights(tableau), Trees(tableau)
    every = [u for n in range(1, order + 1) for u in trees.of_order(n)]
    free = 0
    for l in range(tableau.size):
        own = [u for u in every if u[0] == l]
        rows = [list(weights.stage_vector(u)) for u in own]
        right = [required(tableau, u) if order_of(u) == power else fmpq(0) for u in own]
        whole = [[*row, x] for row, x in zip(rows, right, strict=True)]
        rank = fmpq_mat(rows).rank()
        if fmpq_mat(whole).rank() > rank:
            return -1
        free += tableau.space(l).stages - rank
    return free


def test_the_cubic_of_the_classical_method() -> None:
    """Its one interpolant of degree 3 and order 3 is that of W. H. Enright, K. R. Jackson, S. P.
    Nørsett, P. G. Thomsen (1986), whose b(1) is b; order 4 has none of degree 3 or 4.
    """
    text = RK4 + unknown(4, 3) + "\ndesign: {order: 4, dense-order: 3, dense-continuity: 0}\n"
    found = design(text)
    [method] = found_methods(found)
    assert method.dense is not None
    assert [[str(x) for x in row] for row in method.dense.weights[0]] == CUBIC
    [one] = found.last.found
    assert one.dense is not None
    assert (one.dense.order, one.dense.is_lower_bound) == (3, False)
    assert order_by_values(method.tableau, method.dense, 4) == 3
    thetas = (fmpq(1, 3), fmpq(3, 2))
    stepped = [scaled(method.tableau, method.dense, x) for x in thetas]
    assert min(series_order(x, 4) for x in stepped) == 3
    for degree in (3, 4):
        more = RK4 + unknown(4, degree) + "\ndesign: {order: 4, dense-order: 4}\n"
        assert design(more).last.kind == "none"


def test_values_are_reported_and_the_file_claims_them(tmp_path: Path) -> None:
    """By name, power after power; ``gark check`` proves what the file claims."""
    file, written = tmp_path / "rk4.yaml", tmp_path / "made.gark.yaml"
    wanted = "design: {order: 4, dense-order: 3, dense-continuity: 0}"
    file.write_text(RK4 + unknown(4, 3) + f"\n{wanted}\n")
    run = gark("design", str(file), "--emit", str(written), "--format", "json")
    assert run.code == 0
    [solution] = json.loads(run.out)["solutions"]
    values = {f"bt{i}{k}": x for i, row in enumerate(CUBIC, 1) for k, x in enumerate(row, 1)}
    assert solution["values"] == values
    assert (solution["order"], solution["dense_order"]) == (4, 3)
    claims = 'expect: {order: 4, dense-order: ">= 3", dense-continuous: true}\n'
    assert written.read_text().endswith(claims)
    assert gark("check", str(written)).code == 0


def test_the_interpolants_of_dormand_and_prince() -> None:
    """Stage vectors up to order 4 have rank 6 of 7: a family of dimension 4, one for each power of θ.
    Continuous ones are a family of dimension 3, smooth ones of dimension 1, which has those of
    SciPy and MATLAB. Others have order 4 too; degree 5 has no order 5, as trees say.
    """
    tableau, dense = DORMAND_PRINCE.tableau, DORMAND_PRINCE.dense
    assert dense is not None
    assert [freedom(tableau, 4, k) for k in range(1, 6)] == [1, 1, 1, 1, 1]
    start = in_text(tableau) + unknown(7, 4) + "\ndesign: {order: 5, dense-order: 4"
    assert dimension(design(start + "}\n")) == 4
    assert dimension(design(start + ", dense-continuity: 0}\n")) == 3
    smooth = start + ", dense-continuity: 1}\n"
    assert dimension(design(smooth)) == 1
    [published] = found_methods(design(smooth, bt74=str(dense.weights[0][6][3])))
    assert published.dense == dense
    [of_matlab] = found_methods(design(smooth, bt74="5/2"))
    assert of_matlab.dense is not None
    assert [list(map(str, x)) for x in of_matlab.dense.weights[0]] == OF_MATLAB
    [other] = found_methods(design(smooth, bt74="2"))
    assert other.dense is not None
    assert order_by_values(tableau, other.dense, 5) == 4
    assert slopes(tableau, other.dense).are_continuous is True
    dice = Random(3)
    chosen = {f"bt7{k}": str(fmpq(dice.randrange(-9, 9), 7)) for k in range(1, 5)}
    [drawn] = found_methods(design(start + "}\n", **chosen))
    assert drawn.dense is not None
    assert order_by_values(tableau, drawn.dense, 5) == 4
    more = in_text(tableau) + unknown(7, 5) + "\ndesign: {order: 5, dense-order: 5}\n"
    assert design(more).last.kind == "none"


@pytest.mark.parametrize(("order", "degree"), [(1, 1), (1, 3), (2, 2), (2, 3), (3, 3)])
def test_two_colours_have_the_freedom_that_trees_leave(order: int, degree: int) -> None:
    """Each power of θ leaves what all trees leave of its weights; none, where some power has no
    solution.
    """
    text = TWO.replace("DENSE", unknown(2, degree), 1).replace("DENSE", unknown(3, degree), 1)
    tableau = loads(TWO.replace(", DENSE", "")).tableau
    found = design(f"{text}design: {{order: 1, dense-order: {order}}}\n")
    powers = [freedom(tableau, order, k) for k in range(1, degree + 1)]
    assert dimension(found) == (-1 if -1 in powers else sum(powers))


@pytest.mark.parametrize(
    ("rows", "dimensions"),
    [
        ("[[], [1], [1/2, 1/2]]", [6, 4, 0]),
        ("[[], [0], [1/2, 1/2]]", [6, 4, 2]),
        ("[[], [0], [1/2, 0]]", [6, 4, -1]),
    ],
)
def test_slopes_are_those_of_equal_stages(rows: str, dimensions: list[int]) -> None:
    """Heun's method with a third stage at the new value, and degree 3: weights of slopes are on the
    first stage at θ = 0 and on the last at θ = 1. Two equal first stages share theirs; without a
    stage at the new value there is none. ``gark check`` decides by trees.
    """
    text = f"A: {rows}\nb: [1/2, 1/2, 0]\n{unknown(3, 3)}\ndesign: {{order: 1, dense-order: 1"
    found = [dimension(design(f"{text}{x}}}\n")) for x in ("", ", dense-continuity: 0")]
    smooth = design(f"{text}, dense-continuity: 1}}\n")
    assert [*found, dimension(smooth)] == dimensions
    if smooth.last.kind == "none":
        return
    free = {"bt21": "1/3", "bt12": "5"} if dimensions[-1] else {}
    [method] = found_methods(design(f"{text}, dense-continuity: 1}}\n", **free))
    assert method.dense is not None
    assert slopes(method.tableau, method.dense).are_continuous is True


def test_more_orders_than_powers() -> None:
    """The reason is told."""
    found = design(RK4 + unknown(4, 3) + "\ndesign: {order: 4, dense-order: 5}\n")
    [why] = found.family.impossible
    assert (found.last.kind, why) == (
        "none",
        "no value has dense order 5: it is no larger than the degree 3",
    )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (RK4 + "design: {dense-order: 3}", "needs dense output"),
        (
            TWO.replace("DENSE", unknown(2, 2), 1).replace("DENSE", unknown(3, 2))
            + "design: {dense-order: {2: 1}}",
            "for all colours together",
        ),
        (
            'A: [[], ["?"]]\nb: ["?", "?"]\n' + unknown(2, 2) + "\ndesign: {dense-continuity: 1}",
            "without unknowns",
        ),
        (RK4 + unknown(4, 3) + "\ndesign: {dense-continuity: 2}", "at most 1"),
    ],
)
def test_what_is_refused(text: str, message: str) -> None:
    with pytest.raises(MethodFileError, match=message):
        loads_family("parameters: {t: free}\n" + text)


def of_errors(tableau: Tableau, dense: DenseOutput, order: int) -> fmpq:
    """∫ Σ e_θ(u)² dθ tree by tree, each error a polynomial in θ."""
    weights, total = Weights(tableau), fmpq(0)
    for u in Trees(tableau).of_order(order):
        v, powers = weights.stage_vector(u), max(dense.degree, order)
        error = [fmpq(0)] * (powers + 1)
        for k in range(1, dense.degree + 1):
            row = dense.coefficients(k)[u[0]]
            error[k] = sum((a * x for a, x in zip(row, v, strict=True)), start=fmpq(0))
        error[order] -= required(tableau, u)
        square = fmpq_poly(error) ** 2
        total += square.integral()(fmpq(1)) / symmetry(u) ** 2
    return total


def symmetry(u: Plain) -> int:
    """σ(u)."""
    return prod(map(symmetry, u[1])) * prod(factorial(u[1].count(v)) for v in {*u[1]})


@pytest.mark.parametrize("text", [RK4 + unknown(4, 2), TWO.replace("DENSE", unknown(0, 0))])
def test_the_error_over_theta_is_that_of_all_trees(text: str) -> None:
    """At random weights, one colour and two, trees above and below the degree."""
    plain = TWO.replace(", DENSE", "") if "methods" in text else text.split("dense")[0]
    tableau = loads(plain).tableau
    random = Random(5)
    rows = [
        tuple(tuple(fmpq(random.randint(-9, 9), 7) for _ in range(2)) for _ in colour.b)
        for colour in tableau.colours
    ]
    dense = DenseOutput(tuple(rows))
    for order in (1, 2, 3, 4):
        found = squared_dense_error(tableau, dense, order, None)
        assert found.numerator / found.denominator == of_errors(tableau, dense, order)


def test_the_least_error_over_theta() -> None:
    """Of RK4's cubics of order 2 the least has order 3, and so no error; where b4(θ) has no θ² there
    is one, which a search finds too, and methods beside it have more.
    """
    text = RK4 + unknown(4, 3) + "\ndesign: {order: 4, dense-order: 2, dense-continuity: 0}\n"
    none = minimise(loads_family(text), "dense-error")
    assert none.value == RealRoot.rational(fmpq(0))
    family = loads_family(text, settings={"bt42": "0"})
    least = minimise(family, "dense-error")
    assert least.value is not None
    assert least.value.exact is not None
    assert least.extent == "all"
    [method] = search_methods(family, 4, 6, objective="dense-error", most=1).methods
    assert float(method.objective or "") == pytest.approx(float(least.value), rel=1e-9)
    [best] = least.minimisers
    values = {x: fmpq(str(y)) for x, y in best.found.solution.values.items()}
    further = further_member(family.further, family.ring, values)
    assert further.dense is not None
    tableau = loads(text.split("dense")[0]).tableau
    assert of_errors(tableau, further.dense, 3) == least.value.exact
    assert order_by_values(tableau, further.dense, 4) == 2


@pytest.mark.parametrize(
    ("wanted", "says"),
    [
        ("", ["embedded", "dense"]),
        ("design: {embedded-order: 1}", ["dense"]),
        ("design: {embedded-order: 1, dense-order: 1}", []),
    ],
)
def test_unknowns_of_which_nothing_is_asked(wanted: str, says: list[str]) -> None:
    """The report names the key that asks for an order of them."""
    text = (
        'A: [[0, 0], [1, 0]]\nb: [1/2, 1/2]\nembedded: ["?", "?"]\n'
        f'dense: {{degree: 2, weights: [["?", "?"], ["?", "?"]]}}\n{wanted}\n'
    )
    run = gark("design", "-", stdin=text)
    assert run.code == 0
    for label in ("embedded", "dense"):
        said = f"no condition is on its unknowns: {label}-order under design asks for some"
        assert (said in " ".join(run.out.split())) is (label in says)
