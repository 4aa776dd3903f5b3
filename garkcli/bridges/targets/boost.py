"""Boost.Odeint: a header with a function that makes the stepper, of any type of state."""

from __future__ import annotations

from garkcli.bridges.comments import C, head
from garkcli.bridges.cpp_driver import driver
from garkcli.bridges.lines import filled
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge, Written
from garkcli.bridges.tables import below_diagonal, error_weights, explicit_table
from garkcli.bridges.trials import trial_of
from garkcli.tableau.pointwise import Row

CPP = Style()
_CONTROLLED = "make_controlled does not take it: build controlled_runge_kutta<stepper> by hand."


def write(payload: Payload) -> str:
    """A header for C++11; with embedded weights a stepper that estimates errors."""
    found = explicit_table(payload, "boost")
    name = payload.identifier("cpp")
    orders = payload.orders
    error = error_weights(found)
    notes = [] if error is None else [_CONTROLLED]
    numbers = [found.stages, orders.effective]
    kind = "explicit_generic_rk"
    if error is not None:
        kind = "explicit_error_generic_rk"
        # of the stepper, of its step, of the error estimate
        numbers += [orders.effective, orders.embedded or 0]
    arguments = ", ".join(map(str, numbers))
    lines = C.lines(head(payload, *notes))
    lines += [
        "#pragma once",
        "#include <boost/array.hpp>",
        "#include <boost/fusion/include/make_vector.hpp>",
        "#include <boost/numeric/odeint.hpp>",
        "",
        "template <class State>",
        f"using {name}_stepper = boost::numeric::odeint::{kind}<{arguments}, State>;",
        "",
        "template <class State>",
        f"{name}_stepper<State> {name}() {{",
    ]
    rows = [f"a{i}" for i in range(2, found.stages + 1)]
    for row_name, row in zip(rows, below_diagonal(found), strict=True):
        lines += _array(payload, row_name, row)
    lines += _array(payload, "b", found.b)
    arrays = ["b"]
    if error is not None:
        lines += _array(payload, "e", error)
        arrays.append("e")
    lines += _array(payload, "c", found.c)
    listed = ", ".join([*arrays, "c"])
    made = f"boost::fusion::make_vector({', '.join(rows)})"
    lines.append(f"  return {name}_stepper<State>({made}, {listed});")
    return "\n".join([*lines, "}"]) + "\n"


def _array(payload: Payload, name: str, row: Row) -> list[str]:
    begin = f"  const boost::array<double, {len(row)}> {name} = {{{{"
    return filled(payload.numbers(row, CPP), begin, "}};")


def test_driver(payload: Payload, file: str) -> list[Written]:
    """A program of C++11 with fixed steps."""
    name = payload.identifier("cpp")
    before = [
        "typedef boost::array<double, 2> state;",
        "",
        "static void f(const state &y, state &d, double t) {",
        "  field(t, y.data(), d.data());",
        "}",
        "",
    ]
    initial = ", ".join(trial_of(payload).initial)
    steps = [
        f"{name}_stepper<state> stepper = {name}<state>();",
        f"state y = {{{{{initial}}}}};",
        "for (int k = 0; k < n; ++k) stepper.do_step(f, y, k * h, h);",
    ]
    build = "c++ -std=c++11 {stem}_test.cpp"
    return driver(payload, file, build, before, steps)


BRIDGES = (
    Bridge(
        name="boost",
        summary="Boost.Odeint: a header of C++, explicit methods",
        kinds=("rk",),
        suffix=".hpp",
        write=write,
        test_driver=test_driver,
    ),
)
