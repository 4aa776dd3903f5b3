"""diffrax: a module with a class, of explicit, diagonally implicit and implicit-explicit methods.

diffrax wants two stages at least, and nodes that are the row sums. Its cubic between steps takes
the slopes of the first and the last stage: explicit methods that have none at the end of the step
get one, whose weight is 0, and which is the first one of the next step.
"""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.comments import HASH, head
from garkcli.bridges.lines import filled
from garkcli.bridges.payload import Payload
from garkcli.bridges.python_driver import driver
from garkcli.bridges.registry import Bridge, Written
from garkcli.bridges.structure import Table, shared
from garkcli.bridges.tables import (
    ball,
    begins_at_start,
    below_diagonal,
    diagonal,
    difference,
    error_weights,
    imex_tables,
    lower_table,
    with_first_stage,
    with_last_stage,
)
from garkcli.bridges.targets.numpy_arrays import PYTHON
from garkcli.bridges.trials import WORDS, trial_of
from garkcli.exact.field import ONE, ZERO
from garkcli.tableau.pointwise import Row

_HERMITE = "diffrax.ThirdOrderHermitePolynomialInterpolation"
_INDENT = "    "
_CLOSE = 1e-8  # as numpy.allclose has it
_SINGLE = {
    "explicit": "diffrax.AbstractERK",
    "DIRK": "diffrax.AbstractDIRK",
    "SDIRK": "diffrax.AbstractSDIRK",
    "ESDIRK": "diffrax.AbstractESDIRK",
}
_IMEX = (
    "    term_structure: ClassVar = diffrax.MultiTerm[",
    "        tuple[diffrax.AbstractTerm, diffrax.AbstractTerm]",
    "    ]",
    "    calculate_jacobian: ClassVar = diffrax.CalculateJacobian.every_stage",
)
_ROOTS = (
    "    root_finder: optimistix.AbstractRootFinder = (",
    "        diffrax.with_stepsize_controller_tols(diffrax.VeryChord)()",
    "    )",
    "    root_find_max_steps: int = 10",
)
_WITHOUT = (
    "",
    "    def step(self, *arguments, **options):",
    "        # there are no embedded weights: adaptive steps are refused",
    "        y1, _, *others = super().step(*arguments, **options)",
    "        return y1, None, *others",
)
_USE_OF_TWO = "Use: diffeqsolve(MultiTerm(ODETerm(explicit), ODETerm(implicit)), {name}(), ...)."
_USE_OF_ONE = "Use: diffeqsolve(ODETerm(f), {name}(), ...)."


def write(payload: Payload) -> str:
    """A class of solvers."""
    if payload.kind == "rk":
        found = _with_stages(lower_table(payload, "diffrax"))
        return _of_one(payload, found)
    explicit, implicit = imex_tables(payload, "diffrax")
    if explicit.stages == 1:
        explicit = with_first_stage(explicit)
        implicit = with_first_stage(implicit)
    return _of_two(payload, explicit, implicit)


def _with_stages(found: Table) -> Table:
    """A table that diffrax takes: explicit ones with a stage at the end."""
    if found.is_explicit:
        has_end = begins_at_start(found) and found.is_fsal
        return found if has_end else with_last_stage(found)
    return found if found.stages > 1 else with_first_stage(found)


def _of_one(payload: Payload, found: Table) -> str:
    kind = kind_of(found)
    lines = _start(payload, _USE_OF_ONE, kind != "explicit", has_cubic(found))
    name = payload.class_name()
    lines += [f"class {name}({_SINGLE[kind]}):"]
    lines.append("    tableau: ClassVar = diffrax.ButcherTableau(")
    lines += _tableau(payload, found, 2)
    lines.append("    )")
    if has_cubic(found):
        lines.append(f"    interpolation_cls: ClassVar = {_HERMITE}.from_k")
    if kind != "explicit":
        lines += _ROOTS
    if not has_cubic(found):
        lines += ["", *_linear()]
    return "\n".join([*lines, *_methods(payload)]) + "\n"


def _of_two(payload: Payload, explicit: Table, implicit: Table) -> str:
    cubic = has_cubic(explicit) and has_cubic(implicit)
    is_implicit = not implicit.is_explicit
    lines = _start(payload, _USE_OF_TWO, is_implicit, cubic)
    bases = "diffrax.AbstractRungeKutta"
    if is_implicit:
        bases += ", diffrax.AbstractImplicitSolver"
    lines += [f"class {payload.class_name()}({bases}):"]
    lines.append("    tableau: ClassVar = diffrax.MultiButcherTableau(")
    for found in (explicit, implicit):
        lines.append("        diffrax.ButcherTableau(")
        lines += _tableau(payload, found, 3)
        lines.append("        ),")
    lines.append("    )")
    jacobian = _IMEX[-1] if is_implicit else _IMEX[-1].replace("every_stage", "never")
    lines += [*_IMEX[:-1], jacobian]
    if is_implicit:
        lines += _ROOTS
    lines += ["", *(_cubic_of_two() if cubic else _linear())]
    return "\n".join([*lines, *_methods(payload)]) + "\n"


def kind_of(found: Table) -> str:
    """Which base class has it."""
    if found.is_explicit:
        return "explicit"
    entries = diagonal(found)
    if len(set(entries)) == 1:
        return "SDIRK"
    is_single = len(set(entries[1:])) == 1
    return "ESDIRK" if is_single and begins_at_start(found) else "DIRK"


def has_cubic(found: Table) -> bool:
    """Whether the first and the last stage are the slopes at both ends."""
    return begins_at_start(found) and found.A[-1] == found.b and found.c[-1] == ONE


def _start(payload: Payload, use: str, is_implicit: bool, cubic: bool) -> list[str]:
    """The head and the imports."""
    between = "the cubic through both ends and their slopes" if cubic else "linear"
    notes = [use.format(name=payload.class_name()), f"Between steps: {between}."]
    lines = HASH.lines(head(payload, *notes))
    lines += ["", "from typing import ClassVar", "", "import diffrax"]
    lines.append("import numpy as np")
    if is_implicit:
        lines.append("import optimistix")
    return [*lines, "", ""]


def _tableau(payload: Payload, found: Table, depth: int) -> list[str]:
    """The arguments of a ``ButcherTableau``."""
    _check_nodes(payload, found)
    margin = _INDENT * depth
    rows = below_diagonal(found)
    error = error_weights(found) or (ZERO,) * found.stages
    lines = _array(payload, f"{margin}c=", found.c[1:])
    lines += _array(payload, f"{margin}b_sol=", found.b)
    lines += _array(payload, f"{margin}b_error=", error)
    lines += _arrays(payload, "a_lower", rows, margin)
    if found.is_explicit:
        return lines
    lines += _array(payload, f"{margin}a_diagonal=", diagonal(found))
    # a stage is first sought where the one before it was
    guesses = [(*(ZERO,) * (len(row) - 1), ONE) for row in rows]
    lines += _arrays(payload, "a_predictor", guesses, margin)
    (first,) = payload.numbers(found.c[:1], PYTHON)
    return [*lines, f"{margin}c1={first},"]


def _check_nodes(payload: Payload, found: Table) -> None:
    """Diffrax compares the nodes with the row sums; explicit methods have 0 first.

    Raises:
        CannotExport: a node is none.
    """
    for i, (row, node) in enumerate(zip(found.A, found.c, strict=True), 1):
        rest = node
        for x in row:
            rest = difference(rest, x)
        if abs(ball(rest)) > _CLOSE:
            raise CannotExport(
                f"diffrax's nodes are the row sums; node {i} of {payload.name} is not",
                "json, numpy and matlab have any nodes",
            )


def _arrays(payload: Payload, name: str, rows: Sequence[Row], margin: str) -> list[str]:
    lines = [f"{margin}{name}=("]
    for row in rows:
        lines += _array(payload, margin + _INDENT, row)
    return [*lines, f"{margin}),"]


def _array(payload: Payload, begin: str, row: Row) -> list[str]:
    numbers = payload.numbers(row, PYTHON)
    return filled(numbers, f"{begin}np.array([", "], dtype=float),")


def _cubic_of_two() -> list[str]:
    return [
        "    @staticmethod",
        "    def interpolation_cls(*, t0, t1, y0, y1, k):",
        f"        return {_HERMITE}.from_k(",
        "            t0=t0, t1=t1, y0=y0, y1=y1, k=k[0] + k[1]",
        "        )",
    ]


def _linear() -> list[str]:
    return [
        "    @staticmethod",
        "    def interpolation_cls(*, t0, t1, y0, y1, k):",
        "        return diffrax.LocalLinearInterpolation(t0=t0, t1=t1, y0=y0, y1=y1)",
    ]


def _methods(payload: Payload) -> list[str]:
    """The order, that of the error estimate, and the step where there is none."""
    orders = payload.orders
    lines = ["", "    def order(self, terms):", f"        return {orders.effective}"]
    if orders.embedded is None:
        return [*lines, *_WITHOUT]
    least = min(orders.effective, orders.embedded) + 1
    if least != orders.effective:
        lines += ["", "    def error_order(self, terms):", f"        return {least}"]
    return lines


def test_driver(payload: Payload, file: str) -> list[Written]:
    """A program with constant steps; implicit stages are solved until rounding ends it."""
    name = payload.class_name()
    single = payload.kind == "rk"
    explicit, implicit = (0, 0) if single else _roles(payload)
    is_implicit = "root_finder" in write(payload)
    imports = ["import diffrax", "import equinox", "import jax"]
    imports.append("import jax.numpy as jnp")
    body = ['jax.config.update("jax_enable_x64", True)', "", ""]
    sides = [explicit] if single else [explicit, implicit]
    for l, side in enumerate(sides):
        first, second = _side(payload, side)
        body += [f"def f{l}(t, y, args):"]
        body += [f"    return jnp.stack([{first}, {second}])", "", ""]
    options = ""
    if is_implicit:
        imports.append("import optimistix")
        options = "root_finder=optimistix.Newton(rtol=1e-12, atol=1e-12)"
    terms = [f"diffrax.ODETerm(f{l})" for l in range(len(sides))]
    term = terms[0] if single else f"diffrax.MultiTerm({', '.join(terms)})"
    body += [
        f"solver = table.{name}({options})",
        f"terms = {term}",
        "",
        "",
        "@equinox.filter_jit",
        "def solved(h):",
        "    found = diffrax.diffeqsolve(",
        "        terms, solver, 0.0, float(t_end), h, jnp.array(y0),",
        "        stepsize_controller=diffrax.ConstantStepSize(),",
        "    )",
        "    return found.ys[-1]",
        "",
        "",
    ]
    return driver(payload, file, imports, body, ["y = solved(jnp.array(h))"])


def _side(payload: Payload, side: int) -> tuple[str, str]:
    """A right-hand side of the problem; of a pair (q, p) each has one of the two."""
    trial = trial_of(payload)
    if payload.kind != "prk":
        return trial.formulas(side, _WORDS)
    first, second = trial.formulas(0, _WORDS)
    return (first, "0.0*y[1]") if side == 0 else ("0.0*y[0]", second)


_WORDS = {**WORDS, "sin": "jnp.sin", "cos": "jnp.cos"}


def _roles(payload: Payload) -> tuple[int, int]:
    """Which vector fields are the explicit and the implicit one."""
    first, _ = shared(payload)
    return (0, 1) if first.is_explicit else (1, 0)


BRIDGES = (
    Bridge(
        name="diffrax",
        summary="diffrax: a module with a class, explicit, DIRK and IMEX methods",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".py",
        write=write,
        test_driver=test_driver,
    ),
)
