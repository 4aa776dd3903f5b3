"""``gark check``, and the commands that take or refuse multirate methods with the exact fast
solution.
"""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from garkcli import analyse as analyse_in_python
from garkcli import (
    assert_order,
    claims_of,
    compare,
    conditions,
    find_order,
    find_orders,
    load,
    loads,
)
from garkcli.check.check_file import check_file
from garkcli.check.rare_kinds import InfinitesimalAnalysis
from garkcli.errors import MethodError, MethodFileError
from garkcli.frozen import replace
from garkcli.tableau.stages import PointSpace
from tests.cli.harness import gark
from tests.whole import in_whole

ERK33 = """\
multirate:
  mri:
    c: [0, 1/3, 2/3, 1]
    gamma: [[[1/3], [-1/3, 2/3], [0, -2/3, 1]], [[0], [0, 0], [1/2, 0, -1/2]]]
    embedded: [[1/12, -1/3, 7/12]]
  fast: exact
"""
"""MRI-GARK-ERK33a of Sandu's paper."""
CLAIMS = "expect: {order: 3, slow-order: 3, nonautonomous-order: 3, embedded-order: 2}\n"


def written(folder: Path, text: str) -> str:
    path = folder / "method.gark.yaml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_claims_hold_and_larger_ones_fail(tmp_path: Path) -> None:
    """The method has its orders, and none is larger."""
    assert check_file(written(tmp_path, ERK33 + CLAIMS)).exit_code == 0
    larger = CLAIMS.replace("3,", "4,").replace("order: 2", "order: 3")
    outcome = check_file(written(tmp_path, ERK33 + larger))
    assert outcome.exit_code == 1
    assert len(outcome.failed_claims) == 4


def test_the_slow_method_may_have_a_larger_order(tmp_path: Path) -> None:
    """Heun's method of order 3 has order 2 with the exact fast solution: the coupling fails."""
    text = "multirate: {mis: {A: [[], [1/3], [0, 2/3]], b: [1/4, 0, 3/4]}, fast: exact}\n"
    claims = "expect: {order: 2, slow-order: 3}\n"
    assert check_file(written(tmp_path, text + claims)).exit_code == 0


def test_other_claims_have_no_meaning(tmp_path: Path) -> None:
    """A property of collocation is none of the method, and no other method has a slow order."""
    outcome = check_file(
        written(tmp_path, f"{ERK33}expect: {{symplectic: false, a-stable: false}}")
    )
    assert [(x.found, x.holds) for x in outcome.claims] == [
        ("none: it is a multirate method with the exact fast part", False),
        ("no meaning", False),
    ]
    outcome = check_file(written(tmp_path, "A: [[0]]\nb: [1]\nexpect: {slow-order: 1}"))
    assert outcome.claims[0].found == "none: it has no exact fast part"


def test_embedded_rows_go_with_small_steps() -> None:
    """With a fast method of order 4 embedded rows have the order that they have with the exact
    solution.
    """
    made = loads(ERK33.replace("fast: exact", "fast: rk4\n  steps: 2"))
    exact = loads(ERK33)
    for method in (made, exact):
        assert method.embedded is not None
        colours = zip(method.tableau.colours, method.embedded, strict=True)
        other = tuple(replace(colour, b=b) for colour, b in colours)
        assert find_order(replace(method.tableau, colours=other)).order == 2
    assert made.tableau.exact_to is None
    assert exact.tableau.exact_to == 4


def test_a_coupling_by_its_name() -> None:
    """``mri: NAME`` is the coupling of that method, whatever solves its fast problems."""
    by_name = loads("multirate: {mri: mri-gark-erk33a, fast: exact}")
    assert by_name.tableau == load("mri-gark-erk33a").tableau
    steps = loads("multirate: {mri: mri-gark-erk33a, fast: kutta, steps: 2}")
    spelled = loads(ERK33.replace("fast: exact", "fast: kutta\n  steps: 2"))
    assert steps.tableau == spelled.tableau
    rounded = loads("multirate: {mri: mri-gark-esdirk34a, fast: kutta, steps: 1}")
    assert rounded.tolerance == load("mri-gark-esdirk34a").tolerance


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("{slow: heun, fast: exact, coupling: collocation}", "goes with slowest-first"),
        ("{mis: heun, fast: exact, steps: 2}", "steps does not go with fast: exact"),
        ("{mis: heun, fast: rk4}", "steps missing"),
        ("{mri: rk4, fast: exact}", "no coupling of slow stages"),
        ("{mri: {c: [0, 1], gamma: [[[a]]]}, fast: exact}\nparameters: {a: free}", "is free"),
        ("{mri: {c: [0, 2], gamma: [[[2]]]}, fast: exact}", "end at 2, not at 1"),
        ("{mri: {c: [0, 1], gamma: [[[1]]], restart: sr}, fast: exact}", "omega missing"),
        (
            "{mri: {c: [0, 1], omega: [[[1]]], gamma: [[[1]]], restart: merk}, fast: exact}",
            "restart: merk goes with omega",
        ),
        (
            "{mri: {c: [0, 1], omega: [[[1]]], gamma: [[[0]], [[0]]], restart: sr}, fast: exact}",
            "gamma has 2 matrices",
        ),
        (
            "{mri: {c: [0, 1], omega: [[[1]]], gamma: [[[0]]], restart: sr, embedded: "
            "{omega: [[1]], gamma: [[0], [1]]}}, fast: exact}",
            "gamma has 2 rows",
        ),
        (
            "{mri: {c: [0, 1], omega: [[[1]]], gamma: [[[1]]], embedded: [[1]]}, fast: exact}",
            "a mapping is expected here",
        ),
        (
            "{mri: {c: [0, 1], gamma: [[[1]]], embedded: {omega: [[1]]}}, fast: exact}",
            "omega missing beside embedded rows",
        ),
        ("{mri: {c: [0, 1], gamma: [[[1]]], embedded: [[1, 0, 0]]}, fast: exact}", "3 columns"),
        ("{mis: {alpha: [[0]], beta: [[1]]}, fast: exact}", "gamma missing"),
        (
            "{mis: {alpha: [[0], [0]], beta: [[0], [0]], gamma: [[0, 1], [0]]}, fast: exact}",
            "gamma, row 1 uses a later stage",
        ),
        ("{mis: {alpha: [[0]], beta: [[1/2]], gamma: [[0]]}, fast: exact}\nname: x", ""),
    ],
)
def test_faults(text: str, message: str) -> None:
    """What is wrong is said, with its place; a step that ends early has order 0 and is read."""
    if not message:
        assert find_order(loads(f"multirate: {text}")).order == 0
        return
    with pytest.raises(MethodFileError, match=message):
        loads(f"multirate: {text}")


@pytest.mark.parametrize("fast", ["exact", "kutta\n  steps: 2"])
def test_methods_that_stand_still(fast: str) -> None:
    """Without any slow slope, or without any time for the fast part, there is a method still, of
    order 0.
    """
    for slow in (
        "mri: {c: [0, 1], gamma: [[[0]]]}",
        "mis: {alpha: [[0]], beta: [[0]], gamma: [[0]]}",
        "mis: {alpha: [[0], [0]], beta: [[1], [-1, 0]], gamma: [[0], [0]]}",
    ):
        assert find_order(loads(f"multirate:\n  {slow}\n  fast: {fast}")).order == 0


def test_every_number_may_be_rounded(tmp_path: Path) -> None:
    """Where no number is a decimal, every one may be off, the last node too; the method is read."""
    text = "multirate: {mri: {c: [0, 1], gamma: [[[1]]]}, fast: exact}\ntolerance: 1e-6\n"
    assert check_file(written(tmp_path, f"{text}expect: {{order: 1}}")).exit_code == 0


def test_no_construction_is_made_of_it() -> None:
    """A composition of exact solutions would need collocation of its own."""
    for inside in ("adjoint: {0}", "compose: {{of: {0}, steps: [1/2, 1/2]}}"):
        with pytest.raises(MethodFileError, match="the fast part is solved exactly"):
            loads(inside.format("{multirate: {mis: heun, fast: exact}}"))


@in_whole
def test_every_command_takes_it_or_refuses_it(tmp_path: Path) -> None:
    """No command fails on such a file: it answers, or says what it is for and what to write."""
    path = written(tmp_path, ERK33)
    takes = ["check", "show", "tableau", "conditions", "claims", "certificate", "cite"]
    for command in takes:
        assert gark(command, path).code == 0, command
    assert gark("report", path, "-o", str(tmp_path / "page.html")).code == 0
    refuses = ["stability", "modified", "converge", "energy", "conjugate", "convert"]
    others = {"convert": ["--to", "reduced"]}
    for command in [*refuses, "export"]:
        more = ["--to", "numpy"] if command == "export" else others.get(command, [])
        run = gark(command, path, *more)
        assert run.code == 2, command
        assert "solved exactly" in run.err, command
        assert "fast method" in run.err, command
    assert gark("diff", path, "rk4").code == 2


def test_conditions_end_where_collocation_does(tmp_path: Path) -> None:
    """No condition is told that would be one of collocation."""
    run = gark("conditions", written(tmp_path, ERK33), "--order", "7", "--format", "json")
    assert run.code == 0
    assert "up to order 4" in run.err
    orders = [len(x["tree"].replace("_1", "").replace("_2", "").split("[")) for x in _rows(run.out)]
    assert max(orders) == 5
    with pytest.raises(MethodError, match="known up to order 3; choose trees"):
        list(conditions("merk21", ["[[[[]_1]_1]_1]_1"]))


def _rows(text: str) -> list[dict[str, str]]:
    found: list[dict[str, str]] = json.loads(text)["conditions"]
    return found


def test_the_search_ends_where_collocation_does() -> None:
    """Where collocation keeps fewer trees than a search wants, the order is a lower bound."""
    made = loads(ERK33).tableau
    flow, *others = made.spaces
    assert isinstance(flow, PointSpace)
    short = replace(made, spaces=(replace(flow, order=2), *others))
    found = find_order(short)
    assert found.is_lower_bound
    assert found.order == 2


@in_whole
def test_merk54_has_order_5() -> None:
    """All conditions of order 5 hold, of the embedded value those of order 4, and no more."""
    true = claims_of("merk54", ["order", "embedded-order", "slow-order"])
    assert true == {"order": "5", "slow-order": "5", "embedded-order": "4"}


def test_python_and_diff_take_them() -> None:
    """``analyse`` and ``assert_order`` have the order with the exact fast part; ``gark diff`` tells
    of slow entries alone, as collocation stands for the fast ones.
    """
    found = analyse_in_python("mri-gark-erk33a")
    assert isinstance(found, InfinitesimalAnalysis)
    assert (found.order.order, found.slow_order.order) == (3, 3)
    assert find_orders("mri-gark-erk33a") == {"order": 3, "embedded": 2}
    assert_order("mri-gark-erk33a", 3, embedded=2)
    with pytest.raises(AssertionError, match="order 3, not 4"):
        assert_order("mri-gark-erk33a", 4)
    compared = compare("mri-gark-erk33a", "mri-gark-erk22a")
    assert compared.relation == "different"
    assert {x.colour for x in compared.gaps} == {1}
    assert compare("mri-gark-erk33a", "mri-gark-erk33a").relation == "identical"
