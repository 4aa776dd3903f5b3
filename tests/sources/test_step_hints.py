"""Hints of a step: a sum of what f is given and a multiple of its slope."""

from __future__ import annotations

import pytest

from garkcli.sources.languages.python import PythonLowering
from garkcli.sources.step_hints import Hints, may_add_multiples

NO_STEPS = {
    "no multiple of a slope": "y = x + f(t, x)",
    "a number times a slope": "y = x + 2*f(t, x)",
    "a name that f is not given": "y = z + h*f(t, x)",
    "a factor that f is given": "y = z + x*f(t, x)",
    "mathematics": "y = x + h*max(t, x)",
    "a function of arrays": "y = x + h*np.asarray(x, dtype=float)",
    "one call of one argument": "y = x + h*f(x)",
    "no sum": "y = h*f(t, x)",
    "a slope below the line": "y = x + h/f(t, x)",
    "a comparison of a slope": "y = x + (h*f(t, x) < h)",
    "a value of another function of the base": "y = x.scan(t) + h*f(t, x)",
    "a module that f is given": "y = np.pi*h + math + h*f(math.pi, x)",
    "a function that makes an array": "y = n + h*zeros(n, m)",
}


@pytest.mark.parametrize("name", NO_STEPS)
def test_names_rule_out_a_step(name: str) -> None:
    """Statements that are almost a step of Euler; with the last change undone they may be one."""
    assert not _hints(NO_STEPS[name]).fields
    assert _hints(NO_STEPS[name] + "\ny = x + h*f(t, x)").fields


def test_a_slope_of_stages() -> None:
    """A function is given a multiple of its own slope, also when a loop comes back to it, or two
    functions of each other's.
    """
    loop = "for i in range(s):\n    k = f(t, y)\n    y = y + h*k"
    assert _hints("k = f(t, x)\nl = f(t, x + h*k)").of_stages
    assert _hints(loop).of_stages
    assert _hints("k = f(v)\nl = g(x)\nk = f(v + h*l)\nl = g(x + h*k)").of_stages
    assert not _hints("k = f(t, x)\nl = g(t, x + h*k)").of_stages
    assert not _hints("k = sqrt(x)\nl = sqrt(x + h*k)").of_stages
    assert not _hints("y = x + h*k\nk = f(t, y)\nz = x + h*k").of_stages
    assert not _hints("k = f(abs(x))\nl = f(abs(x + h*k))\ny = x + abs(h*l)").of_stages
    # the functions with stages have no multiple in the sum
    assert not _hints("l = g(s, f(s, h*g(s, z)))\ny = x + h*f(t, x)").of_stages


def _hints(text: str) -> Hints:
    return Hints(PythonLowering(text).module(), ())


def test_functions_of_a_source_are_followed() -> None:
    """A sum may be in a function that is given a slope."""
    text = "k = f(t, x)\ny = moved(x, k)"
    assert not _hints(text).fields
    assert Hints(PythonLowering(text).module(), {"moved"}).fields


def test_multiples_without_a_base() -> None:
    """A caller may add an increment to its value."""
    assert _hints("return h*f(t, x)").are_any
    assert not _hints("return 2*f(t, x)").are_any
    assert not _hints("return h*sqrt(t, x)").are_any


@pytest.mark.parametrize("text", ["x + f(t, x)", "h*f(t, x)", "copy(x, f(t, x))"])
def test_without_sums_and_products_there_are_no_fields(text: str) -> None:
    assert not may_add_multiples(PythonLowering(text).module(), ())
    assert not _hints(text).fields


@pytest.mark.parametrize("text", ["x += h*f(t, x)", "x - h*f(t, x)", "x.plus(f(t, x))", "g(x)"])
def test_sums_and_products_and_what_may_be_such(text: str) -> None:
    assert may_add_multiples(PythonLowering(text).module(), {"g"})
