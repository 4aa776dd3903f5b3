"""Orders that comments and docstrings say of tables."""

from __future__ import annotations

import time
from pathlib import Path

import pytest

from garkcli.bridges.audit import audited
from garkcli.bridges.said import order_said
from tests.whole import in_whole

HEUN = "A = [[0, 0], [1, 0]]\nb = [0.5, 0.5]\nc = [0, 1]\n"
INDENTED = "".join(f"    {line}\n" for line in HEUN.splitlines())
JULIA = "    A = [0 0; 1 0]\n    b = [1//2, 1//2]\n    c = [0, 1]\n"
C = "static const double A[2][2] = {{0, 0}, {1, 0}}, b[2] = {0.5, 0.5}, c[2] = {0, 1};\n"
FORTRAN = """!  Heun's method of {}.

subroutine heun(t, x, h, xf)
    call f(t, x, f1)
    call f(t + h, x + h*f1, f2)
    xf = x + h*(f1 + f2)/2.0_wp
end subroutine
"""
SAID = {
    "above.py": "# the method of order {}\n" + HEUN,
    "behind.py": HEUN.replace("\nb", "  # order {}\nb"),
    "function.py": 'def heun():\n    """A method, order {}."""\n' + INDENTED,
    "class.py": 'class Heun(Solver):\n    """\n    A method.\n\n    Order: {}\n    """\n'
    + INDENTED,
    "docstring.jl": '"""\nHeun, order {}\n"""\nfunction heun()\n' + JULIA + "end\n",
    "above.c": "/* Heun,\n   order {} */\n" + C,
    "head.f90": FORTRAN.format("order {}"),
}


def findings(name: str, text: str, folder: Path) -> list[tuple[str, str]]:
    """The codes and levels of what is wrong with the one table of a source."""
    (folder / name).write_text(text, encoding="utf-8")
    (found,) = audited([str(folder / name)])
    assert found.order is not None
    assert found.order.order == 2
    return [(x.code, x.level) for x in found.findings]


@pytest.mark.parametrize("name", SAID)
def test_an_order_in_words(name: str, tmp_path: Path) -> None:
    """Order 2 is right and 3 a warning, never an error; a lower one says nothing."""
    for said, expected in ((1, []), (2, []), (3, [("order", "warning")])):
        assert findings(name, SAID[name].replace("{}", str(said)), tmp_path) == expected


@pytest.mark.parametrize(
    "text",
    [
        "# of order 3\n\n" + HEUN,
        "# of order 3, embedded in order 4\n" + HEUN,
        "# for third-order equations, stage order 3\n" + HEUN,
        "# References: Third-order methods\n" + HEUN,
        'def other():\n    """Order 3."""\n\n\n' + HEUN,
        "order = 2\n# order 3\n" + HEUN,
    ],
)
def test_words_about_something_else(text: str, tmp_path: Path) -> None:
    """A line between, two orders, other orders, titles, another function; a declared order is what
    counts.
    """
    assert findings("x.py", text, tmp_path) == []


@pytest.mark.parametrize(
    ("text", "order"),
    [
        ("Fourth-order Runge-Kutta", 4),
        ("Cassity's order five method", 5),
        ("a 10th order method of order 10", 10),
        ("Dormand and Prince, order 5(4)", 5),
        ("5th order, or 4th order", None),
        ("of order 1.5", None),
        ("the second-order equation", None),
        ("fifth-order WENO, 4th-order finite differences, third-order upwind fluxes", None),
        ("reorder 4 entries, in order", None),
        ("a (3-ε)-order 3rd-stage scheme", None),
        ("second-order accurate for one part and third-order\n    accurate for the other", None),
    ],
)
def test_what_words_say(text: str, order: int | None) -> None:
    """One number of the method, and no other."""
    assert order_said(text) == order


@in_whole
def test_long_lines_take_no_time() -> None:
    """A line of a hundred thousand characters that almost says an order."""
    began = time.process_time()
    for part in ("a", "order ", "- ", "4", "order of", "\t"):
        order_said(part * (100_000 // len(part)))
    assert time.process_time() - began < 5
