"""What programs of C++ that run an exported header have in common."""

from __future__ import annotations

from collections.abc import Iterable

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.comments import C
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Written
from garkcli.bridges.trials import STEPS, WORDS, command_of, trial_of

_WORDS = {**WORDS, "sin": "std::sin", "cos": "std::cos"}


def driver(
    payload: Payload, file: str, build: str, before: Iterable[str], steps: Iterable[str]
) -> list[Written]:
    """A program that steps through the time, and prints the errors.

    Args:
        payload: the method.
        file: the header's.
        build: the compiler with its options, and libraries.
        before: lines before ``main``; the vector field is ``field(t, y, d)``, of pointers.
        steps: the lines that make y[0] and y[1] of these, in n steps of h.

    Raises:
        CannotExport: no header can have the name of the file.
    """
    if {'"', "\\"} & set(file) or not file.isprintable():
        raise CannotExport(
            f"C++ includes a header by the name of its file, and {file} is none",
            "-o NAME.hpp, without quotes and backslashes",
        )
    trial = trial_of(payload)
    stem = file.removesuffix(".hpp")
    problem = f"{stem}_problem.yaml"
    first, second = trial.formulas(0, _WORDS)
    notes = [
        f"Runs {file}: {build.format(stem=stem)}",
        f"The same errors: {command_of(payload, problem)}",
    ]
    lines = [
        *C.lines(notes),
        "#include <cmath>",
        "#include <cstdio>",
        f'#include "{file}"',
        "",
        "static void field(double t, const double *y, double *d) {",
        f"  d[0] = {first};",
        f"  d[1] = {second};",
        "}",
        "",
        *before,
        "int main() {",
        f"  const int steps[] = {{{', '.join(map(str, STEPS))}}};",
        "  double before = 0.0;",
        '  std::printf("steps      error  slope\\n");',
        "  for (int n : steps) {",
        f"    const double h = {trial.t_end}.0 / n;",
        *(f"    {line}" for line in steps),
        f"    const double e1 = y[0] - {trial.final[0]};",
        f"    const double e2 = y[1] - {trial.final[1]};",
        "    const double error = std::sqrt(e1 * e1 + e2 * e2);",
        '    std::printf("%5d  %.3e", n, error);',
        "    if (before > 0.0)",
        '      std::printf("  %5.2f", std::log2(before / error));',
        '    std::printf("\\n");',
        "    before = error;",
        "  }",
        "}",
    ]
    text = "\n".join(lines) + "\n"
    return [Written("_test.cpp", text), Written("_problem.yaml", trial.file)]
