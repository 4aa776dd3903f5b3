"""``gark check`` of Nyström methods, with its claims, what it shows and what it refuses."""

from __future__ import annotations

from pathlib import Path

import pytest

from garkcli import analyse, claims_of, compare, load, loads, render
from garkcli.api.calls import find_stability
from garkcli.catalogue.facts import shape
from garkcli.check.check_file import check_file
from garkcli.errors import MethodError, MethodFileError
from tests.cli.harness import gark

FINE = """
nystrom:
  Abar: [[], [2/81], [1/36, 1/36], [9/128, 0, 27/128], [11/60, -3/20, 9/25, 8/75]]
  A: [[], [2/9], [1/12, 1/4], [69/128, -243/128, 135/64], [-17/12, 27/4, -27/5, 16/15]]
  bbar: [19/180, 0, 63/200, 16/225, 1/120]
  b: [1/9, 0, 9/20, 16/45, 1/12]
  embedded:
    bbar: [116/1395, 0, 567/1550, 176/6975, 4/155]
    b: [107/1125, 0, 1233/2500, 1712/5625, 161/1500]
"""
CLAIMS = """
expect: {order: 4, position-order: 5, velocity-order: 4, embedded-order: 3,
  embedded-position-order: 3, embedded-velocity-order: 3}
"""
VERLET = "nystrom: {Abar: [[], [1/2]], c: [0, 1], bbar: [1/2, 0], b: [1/2, 1/2]}\n"


def _written(tmp_path: Path, text: str) -> str:
    path = tmp_path / "method.gark.yaml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_claims_hold(tmp_path: Path) -> None:
    """Fine's pair has its orders of both steps, and none is larger; the nodes are the row sums of A
    where they are left out.
    """
    assert check_file(_written(tmp_path, FINE + CLAIMS)).exit_code == 0
    larger = CLAIMS.replace("order: 5, velocity-order: 4", "order: 6, velocity-order: 5")
    outcome = check_file(_written(tmp_path, FINE + larger))
    assert [x.claim for x in outcome.failed_claims] == ["position-order", "velocity-order"]
    given = FINE.replace("  bbar: [19", "  c: [0, 2/9, 1/3, 3/4, 1]\n  bbar: [19")
    assert loads(given).tableau == loads(FINE).tableau


def test_printed_nodes_count(tmp_path: Path) -> None:
    """Nodes that are not the row sums of A are taken as they are printed: the order falls to 1."""
    text = FINE.replace("  bbar: [19", "  c: [0, 2/9, 1/3, 1/2, 1]\n  bbar: [19")
    outcome = check_file(_written(tmp_path, text + "expect: {order: 1}\n"))
    assert outcome.exit_code == 0


def test_one_embedded_row(tmp_path: Path) -> None:
    """An estimate of q alone leaves q′ as it is: that order is the method's."""
    one = FINE.replace("    b: [107/1125, 0, 1233/2500, 1712/5625, 161/1500]\n", "")
    claims = CLAIMS.replace("embedded-velocity-order: 3", "embedded-velocity-order: 4")
    assert check_file(_written(tmp_path, one + claims)).exit_code == 0


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("nystrom: {Abar: [[0]], bbar: [1/2], b: [1]}", "no nodes"),
        ("nystrom: {Abar: [[0]], c: [0], b: [1]}", "bbar"),
        ("nystrom: {Abar: [[0]], c: [0, 1], bbar: [1/2], b: [1]}", "c has 2 entries for 1 stage"),
        ("nystrom: {Abar: [[0]], c: [0], bbar: [1/2, 0], b: [1]}", "bbar has 2 entries"),
        ("nystrom: {Abar: [[0, 0]], c: [0], bbar: [1/2], b: [1]}", "Abar is 1 by 2"),
        (VERLET.replace("}", ", embedded: {}}"), "embedded"),
        (VERLET.replace("}", ", embedded: {b: [1]}}"), "embedded, b has 1 entry for 2 stages"),
        (
            "nystrom: {Abar: [[0]], c: [0], bbar: [g], b: [1]}\nparameters: {g: free}",
            "a Nyström method needs numbers, and g is free",
        ),
        (f"conjugate: true\n{VERLET}", "conjugate"),
        (VERLET.replace("}", ", dense: {degree: 1, b: [[1], [0]]}}"), "bbar missing"),
        (VERLET.replace("}", ", dense: {degree: 1, bbar: [[1]]}}"), "1 row for 2 stages"),
        (VERLET.replace("}", ", dense: {degree: 2, bbar: [[1], [1]]}}"), "1 entry for degree 2"),
        (
            VERLET.replace("}", ", dense: {degree: 1, bbar: [[1], [0]]}}"),
            "dense, b missing: the slope of q does not begin with q′",
        ),
    ],
)
def test_faults(text: str, message: str) -> None:
    """What is wrong is said, with its place."""
    with pytest.raises(MethodFileError, match=message):
        loads(text)


QUARTIC = """
  dense:
    degree: 4
    bbar: [[0, 1/2, -31/45, 53/180], [0, 0, 0, 0], [0, 0, 81/100, -99/200], [0, 0, -16/225, 32/225],
           [0, 0, -1/20, 7/120]]
"""
"""Hermite's polynomial through both ends, with g at the beginning, of Fine's pair."""


def test_dense_output(tmp_path: Path) -> None:
    """Its orders of both steps, how it fits together, and what fails beyond; the slope of the
    output is continuous where it is the velocity.
    """
    text = FINE.rstrip() + QUARTIC
    claims = "expect: {dense-order: 3, dense-position-order: 4, dense-velocity-order: 3,"
    claims += " dense-continuous: true, dense-smooth: true}\n"
    path = _written(tmp_path, text + claims)
    assert check_file(path).exit_code == 0
    shown = gark("check", "-v", path).out
    assert "dense order     3: fails at order 4" in shown
    assert "dense, q        4: fails at order 5" in shown
    larger = claims.replace("dense-order: 3", "dense-order: 4").replace("order: 4,", "order: 5,")
    failed = check_file(_written(tmp_path, text + larger)).failed_claims
    assert [x.claim for x in failed] == ["dense-order", "dense-position-order"]
    straight = (
        "\n  dense: {degree: 2, bbar: [[0, 19/180], [0, 0], [0, 63/200], [0, 16/225], [0, 1/120]],"
        " b: [[1/9, 0], [0, 0], [9/20, 0], [16/45, 0], [1/12, 0]]}\n"
    )
    rest = "expect: {dense-order: 1, dense-continuous: true, dense-smooth: false}\n"
    path = _written(tmp_path, FINE.rstrip() + straight + rest)
    assert check_file(path).exit_code == 0
    late = (
        "\n  dense: {degree: 2, bbar: [[1/10, 1/180], [0, 0], [9/50, 27/200], [-16/75, 64/225],"
        " [-1/15, 3/40]], b: [[1/9, 0], [0, 0], [9/20, 0], [16/45, 0], [1/12, 0]]}\n"
    )
    shown = gark("check", "-v", _written(tmp_path, FINE.rstrip() + late)).out
    assert "slope at start  no" in shown
    assert "slope at end    yes" in shown
    ends = text.replace("53/180]", "53/181]") + "expect: {dense-continuous: false}\n"
    assert check_file(_written(tmp_path, ends)).exit_code == 0
    without = FINE + "expect: {dense-position-order: 3}\n"
    assert check_file(_written(tmp_path, without)).exit_code == 1
    assert claims_of(loads(text))["dense-velocity-order"] == "3"


def test_rounded_dense_output(tmp_path: Path) -> None:
    """Digits that are off leave the orders within the tolerance, a wrong one does not."""
    off = QUARTIC.replace("-99/200", "-0.4950001").replace("81/100", "0.8099999")
    claims = "expect: {dense-order: 3, dense-position-order: 4, dense-velocity-order: 3}\n"
    text = "tolerance: {dense: 1e-6}\n" + FINE.rstrip() + off
    assert check_file(_written(tmp_path, text + claims)).exit_code == 0
    wrong = text.replace("-0.4950001", "-0.4850001")
    assert check_file(_written(tmp_path, wrong + claims)).exit_code == 1


def test_claims_of_other_kinds(tmp_path: Path) -> None:
    """Orders in q and q′ have no meaning for the dense output of other methods."""
    text = "A: [[0]]\nb: [1]\ndense: {degree: 1, weights: [[1]]}\n"
    found = check_file(_written(tmp_path, text + "expect: {dense-position-order: 1}\n"))
    (claim,) = found.failed_claims
    assert claim.found == "none: it is not a Nyström method"


def test_rounded_numbers(tmp_path: Path) -> None:
    """With digits that are off the orders are those within the tolerance; a digit that is wrong
    is not explained.
    """
    off = FINE.replace("19/180", "0.1055556").replace("135/64", "2.1093751")
    text = f"tolerance: 1e-6\n{off}{CLAIMS}"
    assert check_file(_written(tmp_path, text)).exit_code == 0
    wrong = text.replace("2.1093751", "2.1193751")
    assert "order" in [x.claim for x in check_file(_written(tmp_path, wrong)).failed_claims]
    embedded = FINE.replace("161/1500", "0.1074")
    text = f"tolerance: {{embedded: 1e-3}}\n{embedded}{CLAIMS}"
    assert check_file(_written(tmp_path, text)).exit_code == 0


def test_the_oscillator_is_that_of_the_partitioned_method() -> None:
    """Verlet's method in both forms has one stability on q″ = −ω²q: bounded for hω < 2."""
    one, other = (find_stability(x).oscillator for x in (loads(VERLET), load("stoermer-verlet")))
    assert one is not None
    assert other is not None
    assert one.stable == other.stable
    assert one.trace == other.trace
    assert claims_of(loads(VERLET), ["p-stable", "i-stable"]) == {
        "p-stable": "false",
        "i-stable": "false",
    }


def test_what_is_for_others_is_refused() -> None:
    """No answer that is true of the colours alone is given for the method."""
    method = loads(FINE)
    for name in ("conjugate", "pair"):
        with pytest.raises(MethodError, match="GARK methods"):
            getattr(method, name)
    assert method.order == 4


def test_a_claim_of_another_kind_fails(tmp_path: Path) -> None:
    """A Runge–Kutta method has no order of positions, and a Nyström method no order with any
    matrix.
    """
    rk = _written(tmp_path, "A: [[0]]\nb: [1]\nexpect: {position-order: 1}")
    (claim,) = check_file(rk).failed_claims
    assert claim.found == "none: it is not a Nyström method"
    (claim,) = check_file(_written(tmp_path, VERLET + "expect: {w-order: 1}")).failed_claims
    assert claim.found == "none: it is not a Rosenbrock method"


def test_the_report_and_the_arrays(tmp_path: Path) -> None:
    """The report says the orders of q and q′ in a few lines; ``gark show`` draws Ā with b̄, and
    A with b, or that there is none.
    """
    text = gark("check", _written(tmp_path, FINE)).out
    assert len(text.splitlines()) <= 14
    assert "order of q      5, proved; order 6 fails at [[[]_q]_q]_q by 1/21600" in text
    assert "order of q′     4, proved; order 5 fails as above" in text
    shown = gark("show", _written(tmp_path, FINE)).out
    assert "\n\nĀ, with c and b̄\n\n" in shown
    assert "\n\nA, with c and b\n\n" in shown
    first, second = shown[shown.index("Ā, with c and b̄") :].split("A, with c and b")[-2:]
    assert "19/180" in first
    assert "-243/128" in second
    assert "g depends on q alone" in gark("show", _written(tmp_path, VERLET)).out


def test_trees_have_names_in_every_report(tmp_path: Path) -> None:
    """Error constants name the vertices and say nothing of coupled fields, as there is one;
    ``gark conditions`` says what the colours and the blocks are, without A where there is none.
    """
    path = _written(tmp_path, FINE)
    text = " ".join(gark("check", path, "--error-constants").out.split())
    assert "of order 5: 2-norm 0.0058575, largest 0.00208333 at [[[[]_q']_q']_q',[]_q']_q'" in text
    assert "coupling" not in text
    told = " ".join(gark("conditions", path, "--order", "2").out.split())
    assert "q'0 is q′ as it begins; A{1,1} = A{2,1} is Ā, A{1,2} = A{2,2} is A, A{1,3}" in told
    other = _written(tmp_path, VERLET)
    told = " ".join(gark("conditions", other, "--order", "2").out.split())
    assert "A{1,1} = A{2,1} is Ā, A{1,3} = A{2,3} is c order" in told


def test_differences(tmp_path: Path) -> None:
    """``gark diff`` names the matrices and rows once, and refuses methods of another kind."""
    found = gark("diff", "fine-34", "fine-34-misprint")
    assert found.code == 1
    text = " ".join(found.out.split())
    assert "Nyström, 5 stages" in text
    assert "of q 5 against 2; of q′ 4 against 1" in text
    assert text.count("row 4, entry 2") == 1
    changed = FINE.replace("19/180", "20/180").replace("116/1395", "0").replace("2/81", "2/80")
    other = _written(tmp_path, changed)
    gaps = compare(load("fine-34"), load(other)).gaps
    assert [x.kind for x in gaps] == ["Abar", "bbar", "embedded bbar"]
    refused = gark("diff", "fine-34", "rk4")
    assert refused.code == 2
    assert "methods of different kinds" in refused.err


def test_python_renders_what_is_found() -> None:
    """What ``analyse`` returns is printed as ``gark check`` prints it."""
    assert "order of q′     4, proved" in render(analyse("fine-34"))


def test_one_number_of_stages() -> None:
    """The list, ``gark show`` and the index have the stages of g, once."""
    (line,) = (x for x in gark("list", "methods", "--kind", "rkn").out.splitlines() if "1210" in x)
    assert line.split()[:4] == ["dprkn-1210", "12(10)", "17", "rkn"]
    assert "rkn, 1 colour, stages 5\n" in gark("show", "fine-34").out
    assert shape(load("fine-34"))["stages_by_colour"] == [5]


def test_misprint_of_a_program() -> None:
    """−234/128 for −243/128 in Fine's pair leaves order 1."""
    assert claims_of("fine-34-misprint", ["order", "position-order"]) == {
        "order": "1",
        "position-order": "2",
    }
    assert load("fine-34").order == 4


def test_claims_are_those_that_hold(tmp_path: Path) -> None:
    """``gark claims`` has both orders, and those of the embedded weights."""
    found = claims_of(_written(tmp_path, FINE))
    assert found == {
        "order": "4",
        "position-order": "5",
        "velocity-order": "4",
        "embedded-order": "3",
        "embedded-position-order": "3",
        "embedded-velocity-order": "3",
    }
