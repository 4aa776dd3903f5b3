"""C: numbers, arrays, heads, and the parts that all programs of a test have."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.comments import C, head
from garkcli.bridges.lines import filled
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.trials import STEPS, WORDS, Trial
from garkcli.tableau.pointwise import Row

WIDTH = 96


def c_style(macro: str, digits: int = 36) -> Style:
    """Numbers inside a macro that gives them the suffix of their type.

    A quotient of two whole numbers that the type has is right in every precision; 36 digits are
    enough for binary128.
    """
    return Style(
        digits=digits,
        longest=100,
        fraction=f"{macro}({{p}}.0) / {macro}({{q}}.0)",
        decimal=f"{macro}({{x}})",
    )


def heading(payload: Payload, *notes: str) -> list[str]:
    """The head as a comment."""
    return C.lines(head(payload, *notes))


def array(
    payload: Payload, declaration: str, rows: Sequence[Row], style: Style, indent: str = ""
) -> list[str]:
    """An array with its numbers, a line a row at least: ``declaration = {...};``."""
    lines = [f"{indent}{declaration} = {{"]
    last = len(rows) - 1
    for place, row in enumerate(rows):
        end = "" if place == last else ","
        numbers = payload.numbers(row, style)
        lines += filled(numbers, f"{indent}  ", end, width=WIDTH)
    return [*lines, f"{indent}}};"]


def side_functions(trial: Trial, sides: Sequence[int]) -> list[str]:
    """``static void f1(double t, const double *y, double *dy)`` for each of these sides."""
    lines: list[str] = []
    for place, side in enumerate(sides, start=1):
        first, second = trial.formulas(side, WORDS)
        lines += [
            f"static void f{place}(double t, const double *y, double *dy)",
            "{",
            "  (void)t;",
            f"  dy[0] = {first};",
            f"  dy[1] = {second};",
            "}",
            "",
        ]
    return lines


def error_function(trial: Trial) -> list[str]:
    """``static double distance(const double *y)`` from the solution at the end."""
    first, second = trial.final
    return [
        "static double distance(const double *y)",
        "{",
        f"  const double e0 = y[0] - {first};",
        f"  const double e1 = y[1] - ({second});",
        "  return sqrt(e0 * e0 + e1 * e1);",
        "}",
        "",
    ]


def main_function(run: str, prologue: Sequence[str] = ()) -> list[str]:
    """A loop over the numbers of steps that prints ``n error slope``.

    Args:
        run: an expression that runs n steps into y and is 0 where all is well.
        prologue: lines before the loop.
    """
    steps = ", ".join(map(str, STEPS))
    return [
        "  double before = 0.0;",
        f"  const int steps[] = {{{steps}}};",
        *prologue,
        '  printf("steps      error  slope\\n");',
        f"  for (int k = 0; k < {len(STEPS)}; k++) {{",
        "    const int n = steps[k];",
        "    double y[2];",
        f"    if ({run}) {{",
        '      fprintf(stderr, "%d steps: the solver failed\\n", n);',
        "      return 1;",
        "    }",
        "    const double error = distance(y);",
        '    printf("%5d  %.3e", n, error);',
        "    if (k > 0)",
        '      printf("  %5.2f", log2(before / error));',
        '    printf("\\n");',
        "    before = error;",
        "  }",
    ]
