"""deSolve of R: a method for ``rk``, always with variable steps.

With ``varstep = FALSE`` deSolve reads only the entries right below the diagonal of A.
"""

from __future__ import annotations

import json

from garkcli.bridges.comments import HASH, head
from garkcli.bridges.lines import filled
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.registry import Bridge, Written
from garkcli.bridges.tables import explicit_table, is_first_same_as_last
from garkcli.bridges.trials import STEPS, WORDS, command_of, trial_of
from garkcli.tableau.pointwise import Row

R = Style(fraction="{p}/{q}", point=False)
"""R reads decimals through long double, which rounds some twice: those of floats come back."""
_WITHOUT = (
    "There are no embedded weights: every error estimate is 0. Take fixed steps, one from each",
    "of the times to the next: hini = h, hmax = h.",
)


def write(payload: Payload) -> str:
    """A list of class ``rkMethod``."""
    found = explicit_table(payload, "desolve")
    orders = payload.orders
    embedded = found.b if found.embedded is None else found.embedded
    order = orders.effective if orders.embedded is None else orders.embedded
    notes = [f"Use: rk(y0, times, f, parms, method = {payload.identifier('r')})."]
    if found.embedded is None:
        notes += [" ".join(_WITHOUT)]
    name = payload.identifier("r")
    lines = HASH.lines(head(payload, *notes))
    lines += [
        "",
        f"{name} <- list(",
        f'  ID = "{name}",',
        "  varstep = TRUE,",
        f"  FSAL = {'TRUE' if is_first_same_as_last(found) else 'FALSE'},",
    ]
    lines += _matrix(payload, found.A)
    lines += _row(payload, "b1", embedded)
    lines += _row(payload, "b2", found.b)
    lines += _row(payload, "c", found.c)
    lines += [
        f"  stage = {found.stages},",
        f"  Qerr = {min(order, orders.effective)}",
        ")",
        f'class({name}) <- c("list", "rkMethod")',
    ]
    return "\n".join(lines) + "\n"


def _matrix(payload: Payload, rows: tuple[Row, ...]) -> list[str]:
    lines = ["  A = rbind("]
    for i, row in enumerate(rows):
        end = ")" if i == len(rows) - 1 else "),"
        lines += filled(payload.numbers(row, R), "    c(", end)
    return [*lines, "  ),"]


def _row(payload: Payload, name: str, row: Row) -> list[str]:
    return filled(payload.numbers(row, R), f"  {name} = c(", "),")


def test_driver(payload: Payload, file: str) -> list[Written]:
    """A program with steps from each of the times to the next."""
    trial = trial_of(payload)
    stem = file.removesuffix(".R")
    problem = f"{stem}_problem.yaml"
    first, second = trial.formulas(0, {**WORDS, "y1": "y[1]", "y2": "y[2]"})
    notes = [
        f"Runs {file}: Rscript {stem}_test.R, where both are",
        f"The same errors: {command_of(payload, problem)}",
    ]
    lines = [
        *HASH.lines(notes),
        "library(deSolve)",
        f"source({json.dumps(file, ensure_ascii=False)})",
        f"f <- function(t, y, parms) list(c({first}, {second}))",
        f"final <- c({', '.join(trial.final)})",
        "before <- NA",
        'cat("steps      error  slope\\n")',
        f"for (n in c({', '.join(map(str, STEPS))})) {{",
        f"  h <- {trial.t_end}/n",
        f"  times <- seq(0, {trial.t_end}, length.out = n + 1)",
        f"  run <- rk(c({', '.join(trial.initial)}), times, f, NULL,",
        f"            method = {payload.identifier('r')},",
        "            rtol = 1e3, atol = 1e6, hini = h, hmax = h)",
        "  error <- sqrt(sum((run[n + 1, 2:3] - final)^2))",
        '  slope <- if (is.na(before)) "" else sprintf("  %5.2f", log2(before/error))',
        '  cat(sprintf("%5d  %.3e%s\\n", n, error, slope))',
        "  before <- error",
        "}",
    ]
    text = "\n".join(lines) + "\n"
    return [Written("_test.R", text), Written("_problem.yaml", trial.file)]


BRIDGES = (
    Bridge(
        name="desolve",
        summary="deSolve of R: a method for rk, explicit methods",
        kinds=("rk",),
        suffix=".R",
        write=write,
        test_driver=test_driver,
    ),
)
