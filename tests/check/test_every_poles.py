"""Every value beside poles, where there is no method, against ordinary verdicts."""

from __future__ import annotations

import pytest
from flint import fmpq

from garkcli.check.analysis import analyse
from garkcli.errors import MethodFileError
from garkcli.exact.roots import RealRoot
from garkcli.methodfile.load import loads
from tests.check.test_every_value import LIMIT, at, checked

BESIDE_POLES = {
    "the set starts at a pole": """parameters: {t: free}
A: [[0, 0], [1/t, 0]]
b: [1 - t/(t^2 + 1), t/(t^2 + 1)]
""",
    "the set starts at a pole in the range": """parameters:
  t: {free: true, range: [-1, 3]}
A: [[0, 0], [1/t, 0]]
b: [1 - t/8, t/8]
""",
    "the range ends at a pole": """parameters: {t: {free: true, range: [0, 1]}}
A: [[0, 0], [1/(1 - t), 0]]
b: [1/2, 1/2]
""",
    "the range starts at a pole": """parameters: {t: {free: true, range: [0, 1]}}
A: [[0, 0], [1/t, 0]]
b: [1/2, 1/2]
""",
    "a pole is inside": """parameters: {t: free}
A: [[0, 0], [1/t, 0]]
b: [1/2, 1/2]
""",
}
VALUES = {
    "the set starts at a pole": ("-1", "-1/9", "1/9", "5"),
    "the set starts at a pole in the range": ("-1", "-1/9", "1/9", "3"),
    "the range ends at a pole": ("0", "1/2", "8/9"),
    "the range starts at a pole": ("1/9", "1/2", "1"),
    "a pole is inside": ("-1", "-1/9", "1/9", "5"),
}


@pytest.mark.parametrize("case", BESIDE_POLES)
def test_sets_beside_poles(case: str, tmp_path: object) -> None:
    """A set that ends at a pole is all only if no method lies beyond: the claim holds exactly
    where each value meets it, and each is what the ordinary engine says of it.
    """
    text = BESIDE_POLES[case]
    claim = "expect: {positive-weights: true}\n"
    outcome = checked(tmp_path, text + claim)
    assert outcome.every is not None
    fact = outcome.every.verdict("positive-weights")
    verdicts = []
    for value in VALUES[case]:
        method = loads(text, settings={"t": value})
        found = analyse(method.tableau, LIMIT)
        verdict = found.subject.verdict("positive-weights").value
        root = RealRoot.rational(fmpq(*map(int, value.split("/"))))
        assert at(fact, root) == verdict
        verdicts.append(verdict)
    assert [x.holds for x in outcome.claims] == [all(verdicts)]
    assert fact.is_everywhere == all(verdicts)


def test_cancelled_denominators_are_poles(tmp_path: object) -> None:
    """With t/t in the file there is no method for t = 0: it is no exception, as it is of the file
    without it, and the ordinary reader refuses the value.
    """
    text = "parameters: {t: free}\nA: [[0, 0], [t, 0]]\nb: [0, t/t]\n"
    plain = text.replace("t/t", "1")
    found = []
    for one in (text, plain):
        every = checked(tmp_path, one).every
        assert every is not None
        found.append(every.simplifying("C").special)
    zero = RealRoot.rational(fmpq(0))
    assert [zero in dict(x) for x in found] == [False, True]
    with pytest.raises(MethodFileError, match="division by zero"):
        loads(text, settings={"t": "0"})


def test_cancelled_denominators_that_are_zero(tmp_path: object) -> None:
    """A range with one number in it that makes a divisor zero is bad input."""
    text = """parameters: {t: {free: true, range: [1/2, 1/2]}, s: free}
A: [[0, 0], [1/2, 0]]
b: [1 - s, s*(2*t - 1)/(2*t - 1)]
"""
    [fault] = checked(tmp_path, text).faults
    assert "divides by 2*t - 1" in fault.message
