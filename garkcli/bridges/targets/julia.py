"""Julia: a named tuple of any method, and what its packages of Runge-Kutta methods take."""

from __future__ import annotations

from collections.abc import Sequence

from flint import fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.comments import HASH, head
from garkcli.bridges.lines import filled
from garkcli.bridges.numbers import Style
from garkcli.bridges.payload import Payload
from garkcli.bridges.radicals import Words, has_square_roots_alone
from garkcli.bridges.registry import Bridge
from garkcli.bridges.rounding import Cell
from garkcli.bridges.structure import composition, shared, table, vanishes
from garkcli.bridges.tables import explicit_table, is_first_same_as_last
from garkcli.exact.field import Algebraic
from garkcli.exact.nodes import AlgebraicRoot
from garkcli.tableau.pointwise import Block, Row

_LARGEST = 2**63 - 1  # of Int64
_BIG = 77  # digits of a BigFloat, which has 256 bits
DECIMALS = Style(digits=_BIG, decimal='big"{x}"')
FLOATS = Style()


def _coefficient(x: fmpq) -> str:
    """A rational factor of a root, exact."""
    return f"big({x.p})" if x.q == 1 else f"(big({x.p})//{x.q})"


def _root(radicand: str, _index: int) -> str:
    return f"sqrt({radicand})"


def _no_root(root: AlgebraicRoot) -> str:
    raise TypeError(f"no square root: {root!r}")


WORDS = Words(_coefficient, _root, _no_root, "^")


def number(payload: Payload, x: Cell) -> str:
    """Exact where Julia has it: fractions with //, square roots of BigFloat; else 77 digits."""
    if payload.digits is None and isinstance(x, fmpq):
        if max(abs(int(x.p)), int(x.q)) <= _LARGEST:
            return f"{x.p}//{x.q}"
        return f'big"{x.p}"//big"{x.q}"'
    if payload.digits is not None or not isinstance(x, Algebraic):
        return payload.number(x, DECIMALS)
    if has_square_roots_alone(x):
        return WORDS.text(x)
    return payload.number(x, DECIMALS)


def row(payload: Payload, cells: Row) -> list[str]:
    """The numbers of a row."""
    return [number(payload, x) for x in cells]


def write(payload: Payload) -> str:
    """A named tuple: matrices of one vector field, vectors of these of several."""
    lines = HASH.lines(head(payload, *_notes(payload)))
    lines += ["", f"{payload.identifier('julia')} = ("]
    is_single = payload.kind == "rk"
    if is_single:
        lines += matrix(payload, "    A = ", payload.A[0][0] or (), ",")
    else:
        lines += _blocks(payload)
    rows = {"b": payload.b, "c": payload.c, "bhat": payload.embedded}
    for key, of_colours in rows.items():
        if of_colours is not None:
            lines += _rows(payload, f"    {key} = ", of_colours, is_single)
    lines.append(f"    order = {payload.orders.effective},")
    if payload.orders.embedded is not None:
        lines.append(f"    embedded_order = {payload.orders.embedded},")
    return "\n".join([*lines, ")"]) + "\n"


def _notes(payload: Payload) -> list[str]:
    if payload.kind == "rk":
        return []
    return [
        "A[l][m]: how the stages of vector field l see vector field m; nothing where they do not."
    ]


def _blocks(payload: Payload) -> list[str]:
    lines = ["    A = ["]
    for blocks in payload.A:
        lines.append("        [")
        for block in blocks:
            lines += matrix(payload, " " * 12, block, ",")
        lines.append("        ],")
    return [*lines, "    ],"]


def _rows(payload: Payload, begin: str, rows: Sequence[Row], is_single: bool) -> list[str]:
    """A vector, or a vector of vectors."""
    if is_single:
        return vector(payload, begin, rows[0], ",")
    lines = [f"{begin}["]
    for cells in rows:
        lines += vector(payload, " " * 8, cells, ",")
    return [*lines, "    ],"]


def vector(payload: Payload, begin: str, cells: Row, end: str) -> list[str]:
    """A vector in as many lines as it takes."""
    return filled(row(payload, cells), f"{begin}[", f"]{end}")


def matrix(payload: Payload, begin: str, rows: Block, end: str) -> list[str]:
    """A matrix, a row a line; or nothing.

    A long row stays one line: within brackets a line break begins a new row. Nor may there be a
    blank within an entry, which would begin a new entry. A single column in brackets would be a
    vector, and a single row looks like one.
    """
    if rows is None:
        return [f"{begin}nothing{end}"]
    height, width = len(rows), len(rows[0])
    if min(height, width) == 1:
        entries = tuple(x for cells in rows for x in cells)
        name, equals, kind = begin.rpartition("= ")
        margin = kind[: len(kind) - len(kind.lstrip())]
        made = f"{name}{equals}{margin}reshape({kind.strip()}"
        return vector(payload, made, entries, f", {height}, {width}){end}")
    lines = []
    for i, cells in enumerate(rows):
        indent = " " * len(begin) + " " if i else begin + "["
        close = f"]{end}" if i == len(rows) - 1 else ";"
        numbers = [x.replace(" ", "") for x in row(payload, cells)]
        lines.append(indent + " ".join(numbers) + close)
    return lines


def write_ordinarydiffeq(payload: Payload) -> str:
    """A function that makes the ``ExplicitRKTableau`` of any type of numbers."""
    found = explicit_table(payload, "ordinarydiffeq")
    orders = payload.orders
    name = payload.identifier("julia")
    usage = f"solve(problem, ExplicitRK(tableau = {name}())), with OrdinaryDiffEq"
    notes = [f"Use: {usage}."]
    if found.embedded is None:
        notes.append("There are no embedded weights: adaptive = false, dt = h.")
    lines = HASH.lines(head(payload, *notes))
    lines += ["", "import DiffEqBase", "", f"function {name}(::Type{{T}} = Float64) where {{T}}"]
    lines += matrix(payload, "    A = T", found.A, "")
    lines += vector(payload, "    c = T", found.c, "")
    lines += vector(payload, "    b = T", found.b, "")
    options = [f"fsal = {_flag(is_first_same_as_last(found))}"]
    if found.embedded is not None:
        lines += vector(payload, "    bhat = T", found.embedded, "")
        options += ["αEEst = bhat", f"adaptiveorder = {orders.embedded}"]
    lines.append("    return DiffEqBase.ExplicitRKTableau(")
    given = ", ".join(options)
    lines.append(f"        A, c, b, {orders.effective}; {given},")
    return "\n".join([*lines, "    )", "end"]) + "\n"


def _flag(is_true: bool) -> str:
    return "true" if is_true else "false"


def write_rootedtrees(payload: Payload) -> str:
    """The method of RootedTrees: one table, or several of the same stages, padded with zeros."""
    lines = HASH.lines(head(payload))
    lines += ["", "using RootedTrees", ""]
    name = payload.identifier("julia")
    if payload.kind == "rk":
        found = table(payload)
        lines += matrix(payload, "A = ", found.A, "")
        lines += vector(payload, "b = ", found.b, "")
        lines += vector(payload, "c = ", found.c, "")
        lines.append(f"{name} = RungeKuttaMethod(A, b, c)")
        return "\n".join(lines) + "\n"
    tables = shared(payload)
    lines.append("As = [")
    for found in tables:
        lines += matrix(payload, "    ", found.A, ",")
    lines += _vectors(payload, "bs", [found.b for found in tables])
    lines += _vectors(payload, "cs", [found.c for found in tables])
    lines.append(f"{name} = AdditiveRungeKuttaMethod(As, bs, cs)")
    return "\n".join(lines) + "\n"


def _vectors(payload: Payload, name: str, rows: Sequence[Row]) -> list[str]:
    """The end of the list before, and a vector of vectors."""
    lines = ["]", f"{name} = ["]
    for cells in rows:
        lines += vector(payload, "    ", cells, ",")
    return [*lines, "]"] if name == "cs" else lines


def write_tsv(payload: Payload) -> str:
    """The table that ``from_file`` of RungeKutta.jl reads, which has no room for a head.

    The first column has the nodes, the last row the weights.
    """
    found = table(payload)
    lines = [f"# {payload.orders.effective} {found.stages} Float64"]
    for c, cells in zip(found.c, found.A, strict=True):
        lines.append("\t".join(payload.numbers((c, *cells), FLOATS)))
    last = ["0.0", *payload.numbers(found.b, FLOATS)]
    return "\n".join([*lines, "\t".join(last)]) + "\n"


def write_splitting(payload: Payload) -> str:
    """The coefficients of GeometricIntegrators: q for a[1], p for b[1], q for a[2], …"""
    found = composition(payload)
    if found is None:
        raise CannotExport(
            "geometricintegrators has compositions of the flows of q' = f(p) and p' = g(q);"
            f" {payload.name} is none",
            "json, numpy, matlab and julia have every method for a pair (q, p)",
        )
    drifts, kicks = found.drift_first
    pairs = len(drifts)
    while vanishes(drifts[pairs - 1]) and vanishes(kicks[pairs - 1]):
        pairs -= 1
    note = "In the order of time: q for a[1], p for b[1], q for a[2], ..."
    lines = HASH.lines(head(payload, note))
    lines += ["", "using GeometricIntegrators", ""]
    lines += vector(payload, "a = ", drifts[:pairs], "")
    lines += vector(payload, "b = ", kicks[:pairs], "")
    name = payload.identifier("julia")
    order = payload.orders.effective
    made = f"SplittingCoefficientsGeneral(:{name}, {order}, a, b)"
    return "\n".join([*lines, f"{name} = {made}"]) + "\n"


BRIDGES = (
    Bridge(
        name="julia",
        summary="Julia: a named tuple, fractions and square roots exact",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".jl",
        write=write,
        reads_back=True,
    ),
    Bridge(
        name="ordinarydiffeq",
        summary="Julia: ExplicitRKTableau of OrdinaryDiffEq, explicit methods",
        kinds=("rk",),
        suffix=".jl",
        write=write_ordinarydiffeq,
        reads_back=True,
    ),
    Bridge(
        name="rootedtrees",
        summary="Julia: the method of RootedTrees, with any number of vector fields",
        kinds=("rk", "ark", "prk", "gark"),
        suffix=".jl",
        write=write_rootedtrees,
    ),
    Bridge(
        name="rungekutta-jl",
        summary="Julia: the table in tabs of RungeKutta.jl",
        kinds=("rk",),
        suffix=".tsv",
        write=write_tsv,
        reads_back=True,
    ),
    Bridge(
        name="geometricintegrators",
        summary="Julia: splitting coefficients of GeometricIntegrators",
        kinds=("prk",),
        suffix=".jl",
        write=write_splitting,
    ),
)
