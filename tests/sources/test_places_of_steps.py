"""Where programs keep functions with steps: in objects, in functions that run at once, in others."""

from __future__ import annotations

import pytest

from garkcli.exact.display import to_text
from garkcli.sources.found import Find
from garkcli.sources.languages import csharp, typescript

STEP = """(f, y, t, h) {
  var k1 = f(t, y);
  var k2 = f(t + 2*h/3, y + 2*h/3*k1);
  return y + h/4*(k1 + 3*k2);
}"""
PLACES: dict[str, tuple[Find, str]] = {
    "at once": (typescript.find, f"(function () {{ function ralston{STEP}\n}}());"),
    "at once, called behind": (
        typescript.find,
        f"!function (root) {{ root.ralston = function{STEP}; }}(this);",
    ),
    "given to a call": (
        typescript.find,
        f"define(['a'], function (a) {{ function ralston{STEP} return ralston; }});",
    ),
    "of an object": (typescript.find, f"const methods = {{ ralston: function{STEP} }};"),
    "exported": (typescript.find, f"module.exports = {{ ralston{STEP} }};"),
    "of a function": (
        typescript.find,
        "const ralston = (f, h) => (y, t) => {" + STEP.partition("{")[2],
    ),
    "beside this": (
        csharp.find,
        "class A { A Self => this; A B() => this; double ralston"
        "(Func<double, double, double> f, double y, double t, double h)"
        " {" + STEP.partition("{")[2] + " }",
    ),
}


@pytest.mark.parametrize("place", PLACES)
def test_a_step_is_found_in_its_place(place: str) -> None:
    find, text = PLACES[place]
    (table,) = find(text, "x")
    assert table.name.rpartition(".")[2] == "ralston"
    assert not table.trouble
    assert [tuple(map(to_text, x)) for x in table.b] == [("1/4", "3/4")]
