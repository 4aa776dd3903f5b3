"""Claims: a number, a bound, a table; each holds exactly where it is true."""

from pathlib import Path

import pytest

from garkcli.check.analysis import Analysis, analyse
from garkcli.check.check_file import check_file
from garkcli.check.claims import Claim, verify
from garkcli.methodfile.load import loads

METHOD = "methods: [{family: gauss, stages: 2}, {family: lobatto-iiia, stages: 3}]\ntransfer: collocation\n"


@pytest.fixture(scope="module")
def analysis() -> Analysis:
    """The truth about the collocation example: order 4, B (4, 4), C (2 3; 3 3), D (2 1; 2 1)."""
    return analyse(loads(METHOD).tableau)


def claim(text: str, found: Analysis) -> Claim:
    """The one claim of a file, held against what was found."""
    (verified,) = verify(loads(f"{METHOD}expect: {{{text}}}").claims, found)
    return verified


@pytest.mark.parametrize(
    ("text", "holds"),
    [
        ("order: 4", True),
        ("order: 3", False),
        ("order: 5", False),
        ('order: ">= 4"', True),
        ('order: ">=2"', True),
        ('order: ">= 5"', False),
        ("order: '4'", True),
        ("conjugate-order: 4", True),
        ("pair-order: 4", True),
        ("pair-order: 2", False),
        ("bound: 4", True),
        ("bound: 3", False),
        ("pair-bound: 3", True),
        ("sharp-bound: 4", True),
        ("sharp-bound: 5", False),
        ('sharp-bound: ">= 4"', True),
        ("pair-sharp-bound: 4", True),
        ("pair-sharp-bound: 3", False),
        ("B: [4, 4]", True),
        ("B: [4, 3]", False),
        ("B: [4]", False),
        ("B: [4, 4, 4]", False),
        ("C: [[2, 3], [3, 3]]", True),
        ("C: [[2, 3], [3, 4]]", False),
        ("C: [[2, 3], [3, null]]", False),
        ("C: [[2, 3]]", False),
        ('C: [[">= 2", 3], [">= 1", ">= 3"]]', True),
        ("D: [[2, 1], [2, 1]]", True),
        ("D: [[2, 2], [1, 1]]", False),
        ("symplectic: false", True),
        ("symplectic: true", False),
    ],
)
def test_a_claim_holds_where_it_is_true(text: str, holds: bool, analysis: Analysis) -> None:
    """A claim is neither held to less nor to more than it says."""
    assert claim(text, analysis).holds is holds


def test_a_claim_says_what_was_expected_and_found(analysis: Analysis) -> None:
    """The verdict carries both sides as a file would write them, and the place of the claim."""
    found = claim('C: [[">= 2", 3], [3, null]]', analysis)
    assert (found.claim, found.expected, found.found) == (
        "C",
        "[[>= 2, 3], [3, null]]",
        "[[2, 3], [3, 3]]",
    )
    assert (found.line, found.column) == (3, 13)


def test_null_stands_for_a_block_that_does_not_exist() -> None:
    """Only null agrees with an absent block; a number, even a bound, does not."""
    prk = "prk: {q: {A: [[0]], b: [1]}, p: {A: [[1]], b: [1], c: [1]}}\nstructure: separable\n"
    tables = {
        '[[null, 1], [">= 1", null]]': True,
        '[[">= 0", 1], [">= 1", null]]': False,
        '[[null, null], [">= 1", null]]': False,
    }
    for table, holds in tables.items():
        method = loads(f"{prk}expect: {{C: {table}}}")
        (found,) = verify(method.claims, analyse(method.tableau))
        assert found.holds is holds, table


def test_no_conjugate_is_no_order() -> None:
    """Where a weight is zero there is no conjugate order: every claim on it fails and says why."""
    method = loads(
        'methods: [{family: explicit-midpoint}]\nexpect: {conjugate-order: ">= 0", pair-order: 2}'
    )
    for found in verify(method.claims, analyse(method.tableau)):
        assert not found.holds
        assert found.found == "none: a weight is zero"


def test_rounded_coefficients_have_their_order_within_the_tolerance() -> None:
    """Gauss 2 to fifteen digits has order 4 within 1e-13, though order 1 exactly."""
    rounded = Path(__file__).parents[1] / "examples" / "valid" / "rounded.gark.yaml"
    outcome = check_file(str(rounded))
    assert outcome.analysis is not None
    assert outcome.analysis.order.order == 4
