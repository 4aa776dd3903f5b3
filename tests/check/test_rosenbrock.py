"""``gark check`` of Rosenbrock and W-methods: files as papers print them and as programs store
them.
"""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import pytest
from flint import fmpq

from garkcli import analyse as analyse_in_python
from garkcli import (
    assert_order,
    claims_of,
    compare,
    find_orders,
    find_stability,
    load,
    loads,
    with_claims,
)
from garkcli.check.analysis import analyse
from garkcli.check.check_file import check_file
from garkcli.check.rosenbrock import RosenbrockAnalysis
from garkcli.constructions.rosenbrock import Rosenbrock, seen
from garkcli.errors import MethodError, MethodFileError
from garkcli.frozen import replace
from garkcli.methodfile.writer import write_tableau_file
from garkcli.ntrees.kind import PLAIN
from garkcli.stability.linear import stability_function
from garkcli.tableau.conjugate import conjugate
from garkcli.tableau.embedded import Further
from garkcli.tableau.forms import pair
from garkcli.tableau.tableau import Tableau
from tests.cli.harness import gark
from tests.whole import in_whole

RODAS3 = """
rosenbrock:
  transformed:
    gamma: 1/2
    A: [[], [0], [2, 0], [2, 0, 1]]
    C: [[], [4], [1, -1], [1, -1, -8/3]]
    m: [2, 0, 1, 1]
    e: [0, 0, 0, 1]
"""
"""A. Sandu et al., Atmos. Environ. 31 (1997) 3459."""
PRINTED = """
rosenbrock:
  alpha: [[], [0], [1, 0], [3/4, -1/4, 1/2]]
  gamma: [[1/2], [1, 1/2], [-1/4, -1/4, 1/2], [1/12, 1/12, -2/3, 1/2]]
  b: [5/6, -1/6, -1/6, 1/2]
  embedded: [3/4, -1/4, 1/2, 0]
"""
CLAIMS = """
expect: {order: 3, w-order: 1, old-jacobian-order: 2, nonautonomous-order: 3, embedded-order: 2,
  l-stable: true}
"""


@pytest.mark.parametrize("text", [RODAS3, PRINTED])
def test_claims_hold(tmp_path: Path, text: str) -> None:
    """RODAS3 has its orders, and none is larger: in both forms."""
    outcome = check_file(_written(tmp_path, text + CLAIMS))
    assert outcome.exit_code == 0
    larger = CLAIMS.replace("order: 3, w-order: 1", "order: 4, w-order: 2")
    outcome = check_file(_written(tmp_path, text + larger))
    assert [x.claim for x in outcome.failed_claims] == ["order", "w-order"]
    assert outcome.exit_code == 1


def _written(tmp_path: Path, text: str) -> str:
    tmp_path.mkdir(exist_ok=True)
    path = tmp_path / "method.gark.yaml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_both_forms_are_one_method() -> None:
    """A = α Γ⁻¹ and the like, solved for α, γ, b and b̂, is what the paper's form says."""
    stored, printed = loads(RODAS3), loads(PRINTED)
    assert stored.tableau == printed.tableau
    assert stored.further == printed.further != Further()


def test_nodes_and_weights_of_time(tmp_path: Path) -> None:
    """A wrong d costs the order of f(t, y) alone."""
    text = PRINTED.replace("  b:", "  d: [1/2, 3/2, 0, 1/2]\n  b:")
    claims = CLAIMS.replace("nonautonomous-order: 3", "nonautonomous-order: 1")
    assert check_file(_written(tmp_path, text + claims)).exit_code == 0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("rosenbrock: {alpha: [[0]], b: [1]}", "gamma missing beside alpha, b"),
        ("rosenbrock: {alpha: [[0]], gamma: [[1], [0, 1]], b: [1]}", "gamma"),
        ("rosenbrock: {transformed: {A: [[0]], C: [[0]], gamma: 0, m: [1]}}", "of gamma is 0"),
        ("rosenbrock: {transformed: {A: [[0]], C: [[2]], gamma: 1, m: [1]}}", "C is not zero on"),
        (
            RODAS3.replace("[[], [4]", "[[0, 1, 0, 0], [4, 0, 0, 0]").replace(
                "1, -1], [1, -1, -8/3", "1, -1, 0, 0], [1, -1, -8/3, 0"
            ),
            "C is not zero on",
        ),
        ("rosenbrock: {alpha: [[0]], gamma: [[1]], b: [1], c: [0, 1]}", "c has 2 entries"),
        (
            "rosenbrock: {alpha: [[0]], gamma: [[g]], b: [1]}\nparameters: {g: free}",
            "a Rosenbrock method needs numbers, and g is free",
        ),
        (PRINTED.replace("rosenbrock", "conjugate: true\nrosenbrock"), "conjugate"),
    ],
)
def test_faults(text: str, message: str) -> None:
    """What is wrong is said, with its place."""
    with pytest.raises(MethodFileError, match=message):
        loads(text)


def test_examples_of_both_forms_are_one_method() -> None:
    """What messages tell people to write in the one form is what they tell in the other."""

    def cure(text: str) -> str:
        with pytest.raises(MethodFileError) as caught:
            loads(text)
        return caught.value.faults[0].help.removeprefix("give ")

    printed = cure("rosenbrock: 3").split(", or ")[0]
    stored = cure("rosenbrock: {transformed: 3}").split(": A = ")[0]
    method = loads(f"rosenbrock: {{transformed: {stored}}}")
    assert method.tableau == loads(f"rosenbrock: {printed}").tableau
    assert method.order == 2


def test_unknowns_are_looked_for(tmp_path: Path) -> None:
    """ROS2 is L-stable for γ = 1 ± √2/2, which α and β as the blocks of a GARK method are not."""
    text = "rosenbrock: {alpha: [[], [1]], gamma: [[g], [-2*g, g]], b: [1/2, 1/2]}"
    run = gark("design", _written(tmp_path, f"parameters: {{g: free}}\n{text}"), "--l-stable")
    assert run.code == 0
    assert "L-stable for exactly g = 1 - sqrt(2)/2 or g = 1 + sqrt(2)/2" in " ".join(
        run.out.split()
    )
    run = gark("design", "ros2")
    assert (run.code, "no free parameter" in run.err) == (2, True)


def test_sweeps_know_them(tmp_path: Path) -> None:
    """A row counts four stages and one colour of RODAS3, and one with the phase order fails."""
    _written(tmp_path, RODAS3)
    spec = tmp_path / "sweep.yaml"
    for columns, expected in (
        ("order, stages, colours", "1 3 4 1 method.gark.yaml"),
        ("order, phase-order", "failed 1 method: phase-order applies to Runge–Kutta methods only"),
    ):
        spec.write_text(f"columns: [{columns}]\nfiles: [method.gark.yaml]\n", "utf-8")
        run = gark("sweep", str(spec), "--rows", f"{columns}.jsonl", cwd=tmp_path)
        assert expected in " ".join(run.out.split())


def test_a_gark_method_with_the_same_blocks_is_another(tmp_path: Path) -> None:
    """Two vector fields with the blocks α and β are no Rosenbrock method of the catalogue."""
    tableau = load("rodas3").tableau
    plain = tuple(replace(colour, kind=PLAIN) for colour in tableau.colours)
    path = _written(tmp_path, write_tableau_file(replace(tableau, colours=plain), "blocks"))
    run = gark("check", path)
    assert "order 1, proved" in run.out
    assert "the same as" not in run.out


def test_linear_problems_decide_more_than_a_stability(tmp_path: Path) -> None:
    """R(z) = (2 + z)/(2 − z) keeps oscillations: the claim and ``gark stability`` agree."""
    text = "rosenbrock: {alpha: [[]], gamma: [[1/2]], b: [1]}\nexpect: {p-stable: true}"
    path = _written(tmp_path, text)
    run = gark("check", path)
    assert run.code == 0
    assert "Rosenbrock, 1 stage, γ = 1/2;" in run.out
    assert "P-stable                      yes" in gark("stability", path).out


def test_what_is_for_others_is_refused() -> None:
    """No answer that is true of the colours alone is given for the method."""
    method = loads(RODAS3)
    for name in ("conjugate", "pair"):
        with pytest.raises(MethodError, match="GARK methods"):
            getattr(method, name)
    for refusing, what in (
        (conjugate, "the symplectic conjugate"),
        (pair, "the symplectic pair"),
        (analyse, "this analysis"),
    ):
        with pytest.raises(MethodError, match=f"{what} is for GARK methods"):
            refusing(method.tableau)
    outcome_of_gark = load("rk4")
    assert method.order == 3
    assert outcome_of_gark.order == 4


@in_whole
@pytest.mark.parametrize("text", [RODAS3, PRINTED])
def test_rounded_numbers(tmp_path: Path, text: str) -> None:
    """With digits that are off the orders are those within the tolerance, by the place of each:
    the coefficients, and the embedded weights.
    """
    text = text.replace("-8/3", "-2.66667").replace("5/6", "0.83333")
    off = text.replace("e: [0", "e: [0.01").replace("embedded: [3/4", "embedded: [0.76")
    for tolerance in ("1e-1", "{others: 1e-4, embedded: 1e-1}"):
        found = check_file(_written(tmp_path, f"{off}tolerance: {tolerance}\n{CLAIMS}"))
        assert found.exit_code == 0
    found = check_file(_written(tmp_path, f"{off}tolerance: {{others: 1e-4}}\n{CLAIMS}"))
    assert [x.claim for x in found.failed_claims] == ["embedded-order"]
    exact = off.replace("-2.66667", "-8/3").replace("0.83333", "5/6")
    found = check_file(_written(tmp_path, f"{exact}tolerance: {{embedded: 1e-1}}\n{CLAIMS}"))
    assert found.exit_code == 0
    assert found.rosenbrock is not None
    assert found.rosenbrock.tolerance is None


@pytest.mark.parametrize("name", ["ros34pw2", pytest.param("rodas5p", marks=in_whole)])
def test_rounded_digits_mean_what_linear_problems_show(name: str) -> None:
    """A last row that is b to the digits makes R(∞) = 0, and an order on linear problems beyond
    that of the method is kept: without it |R(iy)| passes 1 by the rounding.
    """
    found = load(name)
    assert found.tolerance is not None
    true = claims_of(found, ["a-stable", "l-stable", "dense-continuous"])
    assert true == {"a-stable": "true", "l-stable": "true", "dense-continuous": "true"}


def test_a_method_is_shown_as_papers_print_it() -> None:
    """``gark show`` draws α with c, b and embedded weights, and γ with d."""
    text = gark("show", "rodas3").out
    start = text.index("α, with c and b")
    first, second = text[start:].split("γ, with d")
    assert (
        first.split()[-11:]
        == ["b", "|", "5/6", "-1/6", "-1/6", "1/2", "embedded", "|", "3/4", "-1/4", "1/2", "0"][
            -11:
        ]
    )
    assert "3/2 |    1   1/2     0    0" in second


def test_claims_are_those_that_hold() -> None:
    """``gark claims`` has the orders of a Rosenbrock method and its stability, and no others."""
    assert claims_of("shampine-rosenbrock-4") == {
        "order": "4",
        "nonautonomous-order": "4",
        "w-order": "1",
        "old-jacobian-order": "2",
        "index-1-order": "2",
        "embedded-order": "3",
        "embedded-w-order": "1",
        "a-stable": "true",
        "l-stable": "false",
    }
    run = gark("claims", "ros3p", "-v")
    assert "# w-order: 1, proved; order 2 fails at [[]_f]_f by" in run.out


def test_the_report_is_short() -> None:
    """All orders and the stability fit twelve lines of 80 columns; trees have the names of what
    their vertices are, so that [[]_f]_E is no tree of f alone.
    """
    text = gark("check", "ros3p").out
    assert len(text.splitlines()) <= 12
    for said in (
        "order 3, proved; order 4 fails at [[[]_f]_f',[]_f]_f",
        "with any matrix W     1, proved; order 2 fails at [[]_f]_f",
        "old Jacobian f' + hE  2, proved; order 3 fails at [[]_f]_E",
        "index 1, 0 = g(y, z)  3, proved; order 4 fails as above",
        "A-stable, not L-stable, R(∞) = 1 - sqrt(3)",
    ):
        assert said in text
    in_full = gark("check", "ros3p", "-v").out
    assert "index 1, error in z   2, proved; order 3 fails at [[[]_f]_f',[]_f]_g" in in_full
    assert "f' is f with one branch" in in_full


def test_conditions_say_which_blocks_are_alpha() -> None:
    """``gark conditions`` names α and β, and calls no condition of f and f' coupling."""
    text = gark("conditions", "ros3p").out
    assert "A{1,1} = A{1,2} is α, A{2,1} = A{2,2} is β = α + γ" in " ".join(text.split())
    assert "coupling" not in text
    assert "diagonal" not in text
    assert "coupling" in gark("conditions", "mri-gark-erk33a").out


def test_orders_on_daes(tmp_path: Path) -> None:
    """Claims on index 1 hold and larger ones fail; a singular α + γ has none, and says why."""
    path = _written(tmp_path, f"{RODAS3}expect: {{index-1-order: 3, index-1-z-order: 4}}\n")
    outcome = check_file(path)
    assert [(x.claim, x.found) for x in outcome.failed_claims] == [("index-1-z-order", "3")]
    text = "rosenbrock: {alpha: [[0]], gamma: [[0]], b: [1]}\nexpect: {index-1-order: 1}"
    (claim,) = check_file(_written(tmp_path, text)).failed_claims
    assert claim.found == "none: alpha + gamma is singular"


def test_orders_on_daes_of_rounded_numbers_fit_each_other() -> None:
    """That of both components is at most that of the method, that of y between the two, that of z
    it or one less, whichever is asked for first; what follows from another is not searched for.
    """
    names = ("index_1_order", "index_1_y_order", "index_1_z_order")
    for method, wanted in {"ros3prl2": (3, 3, 2), "grk4t": (2, 3, 1)}.items():
        found = [check_file(method).rosenbrock, check_file(method).rosenbrock]
        told = []
        for analysis, asked in zip(found, (names, names[::-1]), strict=True):
            assert analysis is not None
            orders = {name: getattr(analysis, name) for name in asked}
            told.append([orders[name] for name in names])
        assert told[0] == told[1]
        both, of_y, of_z = told[0]
        assert (both.order, of_y.order, of_z.order) == wanted
        assert both.tolerance == of_y.tolerance == of_z.tolerance == found[0].tolerance
        assert (of_y is both) == (both.order == found[0].order.order)


@in_whole
def test_digits_that_have_an_order_alone_leave_the_others(tmp_path: Path) -> None:
    """These digits have W-order 2 as they are printed, and the method with order 3 within the
    rounding has not: the W-order is that of the method, and does not keep the orders for f(t, y)
    and on DAEs from being found.
    """
    text = """
rosenbrock: {alpha: [[], [1.0]], gamma: [[0.1], [-0.2, 0.1]], b: [0.5, 0.5]}
tolerance: 0.2
"""
    found = check_file(_written(tmp_path, text)).rosenbrock
    assert found is not None
    assert found.order.order == found.nonautonomous_order.order == 3
    assert found.w_order.order == 1
    assert found.index_1_order is not None
    assert found.index_1_order.order == 2


def test_python_takes_them() -> None:
    """``analyse`` has the orders as attributes, and orders are asserted as those of other methods:
    each holds, and one more fails with its tree.
    """
    found = analyse_in_python("ros3p")
    assert isinstance(found, RosenbrockAnalysis)
    orders = found.order, found.w_order, found.old_jacobian_order, found.nonautonomous_order
    assert [x.order for x in orders] == [3, 1, 2, 3]
    on_daes = found.index_1_order, found.index_1_y_order, found.index_1_z_order
    assert [x and x.order for x in on_daes] == [3, 3, 2]
    assert found.embedded is not None
    assert found.embedded.order.order == 2
    wanted = find_orders("ros3p")
    assert wanted == {"order": 3, "embedded": 2, "w": 1, "index_1": 3}
    assert_order("ros3p", **wanted)
    for key, order in wanted.items():
        with pytest.raises(AssertionError, match=rf"not {int(order) + 1}\n  fails at order .*_f"):
            assert_order("ros3p", **{key: int(order) + 1})
    assert find_orders("rodas4") == {"order": 4, "embedded": 3, "w": 1, "index_1": 4}
    assert "index_1" not in find_orders("lassp-34")
    with pytest.raises(AssertionError, match="alpha \\+ gamma is singular"):
        assert_order("lassp-34", index_1=1)
    with pytest.raises(MethodError, match="not a Rosenbrock method"):
        assert_order("rk4", w=4)
    assert "expect:\n  w-order: 1\n" in with_claims(loads(RODAS3), "w-order")


def test_two_are_compared(tmp_path: Path) -> None:
    """``gark diff`` finds one method in both of its forms, tells α and β apart where an entry is
    another, and refuses methods of different kinds.
    """
    forms = [_written(tmp_path / name, text) for name, text in (("a", RODAS3), ("b", PRINTED))]
    run = gark("diff", *forms)
    assert (run.code, "identical" in run.out) == (0, True)
    other = PRINTED.replace("[3/4, -1/4, 1/2]]\n  gamma", "[3/4, -1/4, 1/4]]\n  gamma")
    run = gark("diff", forms[0], _written(tmp_path / "c", other))
    assert run.code == 1
    said = " ".join(run.out.split())
    assert "α 1 of 16 row 4, entry 3 1/2 1/4 -1/4" in said
    assert "β = α + γ 1 of 16 row 4, entry 3 -1/6 -5/12 -1/4" in said
    run = gark("diff", forms[0], "rk4")
    assert (run.code, "different kinds" in run.err) == (2, True)


SEVERAL = """\
rosenbrock:
  blocks:
    alpha: [[[[], [1]], [[], [1]]], [[[], [1]], [[], [1]]]]
    gamma: [[[[g], [-2*g, g]], null], [null, null]]
    b: [[1/2, 1/2], [1/2, 1/2]]
    embedded: [[1, 0], [1, 0]]
parameters: {g: 1 - sqrt(2)/2}
"""


def test_files_of_several_colours(tmp_path: Path) -> None:
    """Every order is that of the tableau that the kernel takes; one colour in blocks is that
    without; claims hold and none larger; convert and JSON give every block back.
    """
    g, one, half, zero = "1 - sqrt(2)/2", fmpq(1), fmpq(1, 2), fmpq(0)
    made = loads(SEVERAL)
    alpha, none = ((zero, zero), (one, zero)), ((zero, zero), (zero, zero))
    gamma = loads(
        f"rosenbrock: {{alpha: [[], [1]], gamma: [[{g}], [-2*({g}), {g}]], b: [1/2, 1/2]}}"
    )
    full = Rosenbrock.of(gamma.tableau).gamma[0][0]
    plain = Rosenbrock(((alpha,) * 2,) * 2, ((full, none), (none, none)), ((half, half),) * 2)
    assert made.tableau == plain.tableau
    in_blocks = loads(
        f"rosenbrock: {{blocks: {{alpha: [[[[], [1]]]], gamma: [[[[{g}], [-2*({g}), {g}]]]],"
        " b: [[1/2, 1/2]]}}"
    )
    assert in_blocks.tableau == gamma.tableau
    path = tmp_path / "several.gark.yaml"
    claims = "expect: {order: 2, w-order: 2, old-jacobian-order: 2, embedded-order: 1}\n"
    path.write_text(SEVERAL + claims, encoding="utf-8")
    assert check_file(str(path)).exit_code == 0
    path.write_text(SEVERAL + claims.replace("{order: 2", "{order: 3"), encoding="utf-8")
    assert [x.claim for x in check_file(str(path)).failed_claims] == ["order"]
    assert claims_of(str(path), ["index-1-order"]) == {}
    other = tmp_path / "other.gark.yaml"
    assert gark("convert", str(path), "-o", str(other)).code == 0
    assert load(str(other)).tableau == made.tableau
    assert load(str(other)).embedded == made.embedded
    data = json.loads(gark("export", str(path), "--to", "json").out)
    assert (len(data["alpha"]), data["gamma"][1], data["b"][1]) == (
        2,
        [[["0", "0"], ["0", "0"]]] * 2,
        ["1/2", "1/2"],
    )
    assert "json" in gark("export", str(path), "--to", "c").err
    assert gark("convert", str(path), "--to", "transformed").code == 2
    moved = loads(SEVERAL.replace("null]]", "[[], [1/7]]]]"))
    gaps = {(x.kind, x.colour, x.seen) for x in compare(made, moved).gaps}
    assert gaps == {("beta", 3, 1), ("c + d", 3, None)}


def test_stability_of_several_colours() -> None:
    """R(z₁, z₂) of one step on ẏ = λ₁y + λ₂y, both stages solved with numbers."""
    tableau = seen(loads(SEVERAL.replace("1 - sqrt(2)/2", "1/4")).tableau, "on_test_equation")
    assert isinstance(tableau, Tableau)
    z, w, g = Fraction(1, 3), Fraction(-2, 5), Fraction(1, 4)
    k1 = z / (1 - z * g)
    second = 1 + k1 + w
    k2 = (z * second - 2 * g * z * k1) / (1 - z * g)
    value = 1 + (k1 + k2 + w + w * second) / 2
    R = stability_function(tableau, [fmpq(5), fmpq(-6)])
    at = fmpq(1, 15)
    assert R.numerator(at) / R.denominator(at) == fmpq(value.numerator, value.denominator)


def test_several_colours_have_no_radii_for_nonlinear_problems() -> None:
    """Absolute monotonicity of A = β says nothing of a step that is another on such problems."""
    found = find_stability(loads(SEVERAL)).colours
    assert found is not None
    assert found.R is not None
    assert found.radii == ()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{alpha: [[[[1]]]], gamma: [[[[1]]]]}", "b"),
        ("{alpha: [[[[1]]]], gamma: [[[[1]]]], b: [[1], [1]]}", "alpha has 1 row for 2 colours"),
        ("{alpha: [[[[1]], null]], gamma: [[[[1]]]], b: [[1]]}", "alpha, row 1 has 2 blocks"),
        ("{alpha: [[[[1, 1]]]], gamma: [[[[1]]]], b: [[1]]}", "should be 1 by 1"),
        ("{alpha: [[[[1]]]], gamma: [[[[1]]]], b: [[1]], c: [[0, 1]]}", "has 2 entries"),
    ],
)
def test_faults_of_blocks(text: str, message: str) -> None:
    """What is wrong is said, with its place."""
    with pytest.raises(MethodFileError, match=message):
        loads(f"rosenbrock: {{blocks: {text}}}")
