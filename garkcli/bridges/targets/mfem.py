"""MFEM: a header with a function that makes an ``ExplicitRKSolver``."""

from __future__ import annotations

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.comments import C, head
from garkcli.bridges.cpp_driver import driver
from garkcli.bridges.lines import filled
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge, Written
from garkcli.bridges.structure import vanishes
from garkcli.bridges.tables import below_diagonal, explicit_table
from garkcli.bridges.trials import trial_of
from garkcli.tableau.pointwise import Row

CPP = Style()


def write(payload: Payload) -> str:
    """A header for C++11; the solver keeps pointers to the numbers, which are static."""
    found = explicit_table(payload, "mfem")
    if not vanishes(found.c[0]):
        raise CannotExport(
            f"the first node of mfem's methods is 0; that of {payload.name} is not",
            "boost, json and numpy have such methods",
        )
    name = payload.identifier("cpp")
    stages = found.stages
    lower = tuple(x for row in below_diagonal(found) for x in row)
    lines = C.lines(head(payload, "The caller deletes the solver."))
    lines += ["#pragma once", '#include "mfem.hpp"', "", f"inline mfem::ODESolver *{name}() {{"]
    # an array in C++ has one number at least
    lines += _array(payload, "a", lower or found.b)
    lines += _array(payload, "b", found.b)
    lines += _array(payload, "c", found.c[1:] or found.c)
    made = f"mfem::ExplicitRKSolver({stages}, a, b, c)"
    return "\n".join([*lines, f"  return new {made};", "}"]) + "\n"


def _array(payload: Payload, name: str, row: Row) -> list[str]:
    begin = f"  static const double {name}[] = {{"
    return filled(payload.numbers(row, CPP), begin, "};")


def test_driver(payload: Payload, file: str) -> list[Written]:
    """A program with fixed steps."""
    before = [
        "class Problem : public mfem::TimeDependentOperator {",
        "public:",
        "  Problem() : mfem::TimeDependentOperator(2, 0.0) {}",
        "  void Mult(const mfem::Vector &y, mfem::Vector &d) const override {",
        "    field(GetTime(), y.GetData(), d.GetData());",
        "  }",
        "};",
        "",
    ]
    first, second = trial_of(payload).initial
    steps = [
        "Problem problem;",
        f"mfem::ODESolver *solver = {payload.identifier('cpp')}();",
        "solver->Init(problem);",
        "mfem::Vector y(2);",
        f"y[0] = {first};",
        f"y[1] = {second};",
        "double t = 0.0, dt = h;",
        "for (int k = 0; k < n; ++k) solver->Step(y, t, dt);",
        "delete solver;",
    ]
    build = "c++ -std=c++17 {stem}_test.cpp -lmfem"
    return driver(payload, file, build, before, steps)


BRIDGES = (
    Bridge(
        name="mfem",
        summary="MFEM: a header of C++, explicit methods",
        kinds=("rk",),
        suffix=".hpp",
        write=write,
        test_driver=test_driver,
    ),
)
