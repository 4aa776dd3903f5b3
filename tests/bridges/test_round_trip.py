"""import(export(m)) = m: exactly where the format is exact, correctly rounded where it is not.

A sample of the catalogue in every run; all of it in ``make whole``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import cache
from math import ulp
from pathlib import Path
from unittest.mock import patch

import pytest
from flint import arb, ctx, fmpq

from garkcli.bridges.cannot import CannotExport
from garkcli.bridges.importing import entry_text
from garkcli.bridges.orders import Orders
from garkcli.bridges.payload import Payload
from garkcli.bridges.preparing import prepared
from garkcli.bridges.readers.registry import reader_named
from garkcli.bridges.registry import bridges
from garkcli.bridges.subject import read
from garkcli.exact.display import to_ball
from garkcli.exact.domain import Domain
from garkcli.exact.expression import parse
from garkcli.exact.field import Algebraic
from garkcli.frozen import replace
from garkcli.methodfile.load import load
from garkcli.sources.found import FoundTable
from tests.whole import IS_WHOLE
from tests.whole import sample as part_of

ROOT = Path(__file__).parents[2]
CATALOGUE = sorted((ROOT / "garkcli/catalogue/data").glob("*/*.gark.yaml"))
SHOWN = ("paper", "found", "sprk", "splitting", "gark", "rkn")
EVERY = 32
"""Of the other folders every thirty-second method is in the sample."""
READERS = {
    "json": "json",
    "csv": "csv",
    "numpy": "python",
    "matlab": "matlab",
    "rklab": "matlab",
    "julia": "julia",
    "ordinarydiffeq": "julia",
    "climatimesteppers": "julia",
    "rungekutta-jl": "tsv",
    "mathematica": "mathematica",
    "latex": "latex",
    "c": "c",
    "fortran": "fortran",
    "petsc": "petsc",
    "sundials": "c",
}
"""What writes, and what reads it."""
_PLAIN = re.compile(r"-?[0-9]*\.?[0-9]+\.?(?:e[-+]?[0-9]+)?")
BITS = 1200


def sample() -> list[Path]:
    """The methods of this run: few of each folder, and all of them where that is asked for."""
    if IS_WHOLE:
        return CATALOGUE
    few = CATALOGUE[::EVERY]
    special = [x for x in CATALOGUE if x.parent.name in SHOWN]
    # dense output, and nodes that are no sums of rows
    others = [
        x for x in CATALOGUE if x.name.split(".")[0] in {"dormand-prince-5", "lobatto-iiib-2"}
    ]
    return sorted({*few, *special[::10], *others})


@cache
def payload(path: Path) -> Payload:
    """A method as writers get it; its orders are the matter of other tests."""
    with patch("garkcli.bridges.preparing.find_orders", lambda *_: Orders(2, embedded=1)):
        return prepared(load(str(path)))


def is_same(text: str, exact: object) -> bool:
    """Whether a text is a number, or the decimal or the float nearest to it."""
    if isinstance(exact, fmpq) and entry_text(text) == str(exact):
        return True
    if not _PLAIN.fullmatch(text) and not isinstance(exact, arb):
        return _equal(text, str(exact))
    return _is_nearest(text, exact)


@cache
def _equal(text: str, other: str) -> bool:
    """Whether two texts are the same number, in one field."""
    expressions = [parse(text), parse(other)]
    domain = Domain(expressions)
    first, second = map(domain.evaluate, expressions)
    return bool(first == second) or _is_nearest(text, second)


def _is_nearest(text: str, exact: object) -> bool:
    """Whether a text differs by no more than half a unit of its last place, or half of that of a
    float; ``exact`` is a number or an enclosure of it.
    """
    ball = exact
    if isinstance(exact, Algebraic):
        ball = to_ball(exact, 300)
    value = Domain([parse(text)]).evaluate(parse(text))
    with ctx.workprec(BITS):
        given = arb(value) if isinstance(value, fmpq) else to_ball(value, 300)
        off = abs(arb(ball) - given)
        if not _PLAIN.fullmatch(text):
            # a quotient or a root of whole numbers that was rounded as a float
            return bool(off <= _half_ulp(float(given.mid())))
        if off <= _last_place(text) / 2:
            return True
        # the shortest decimal that brings a float back
        nearest = float(text)
        stored = Fraction(nearest)
        middle = arb(fmpq(stored.numerator, stored.denominator))
        return bool(abs(arb(ball) - middle) <= _half_ulp(nearest))


def _half_ulp(x: float) -> fmpq:
    unit = Fraction(ulp(x))
    return fmpq(unit.numerator, 2 * unit.denominator)


def _last_place(text: str) -> fmpq:
    mantissa, _, exponent = text.partition("e")
    return fmpq(10) ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


def blocks(table: FoundTable) -> list[list[object]]:
    """``A[l][m]`` of a table, shared stages once for each colour."""
    rows = table.A if len(table.A) > 1 else table.A * table.colours
    return [list(row) for row in rows]


def differing(table: FoundTable, wanted: Payload) -> Iterator[str]:
    """The names of the arrays that are not those of the method."""
    order = range(wanted.size)
    yield from _rows("b", table.b, wanted.b)
    nodes = table.c if len(table.c) > 1 else table.c * wanted.size
    if None not in nodes:
        yield from _rows("c", nodes, wanted.c)  # type: ignore[arg-type]
    if table.embedded is not None or wanted.embedded is not None:
        yield from _rows("embedded", table.embedded or (), wanted.embedded)
    if table.dense is not None:
        for ours, theirs in zip(table.dense, wanted.dense or (), strict=True):
            yield from _rows("dense", ours, theirs)
    found = blocks(table)
    for l in order:
        for m in order:
            block, exact = found[l][m], wanted.A[l][m]
            if (block is None) != (exact is None):
                yield f"A[{l}][{m}]"
            elif exact is not None:
                yield from _rows(f"A[{l}][{m}]", block, exact)  # type: ignore[arg-type]


def _rows(
    name: str, found: Sequence[Sequence[str]], wanted: Sequence[Sequence[object]] | None
) -> Iterator[str]:
    wanted = wanted or ()
    if [len(row) for row in found] != [len(row) for row in wanted]:
        yield name
        return
    for row, exact in zip(found, wanted, strict=True):
        if not all(is_same(x, y) for x, y in zip(row, exact, strict=True)):
            yield name


def of_one_table(target: str, method: Payload) -> bool:
    """Whether a target writes all of a method into one table on the method's own stages.

    SUNDIALS has two tables for two vector fields, and PETSc pads stages.
    """
    if target == "sundials":
        return method.kind == "rk"
    if target == "petsc":
        return method.kind in {"rk", "ark"}
    return True


@pytest.mark.parametrize("target", READERS)
def test_what_is_written_is_read(target: str) -> None:
    """Each method of the sample: one table is found, a method file can be made of it, and every
    entry is what it was.
    """
    bridge = bridges()[target]
    reader = reader_named(READERS[target])
    count = 0
    # few methods have the 2N form
    of_erk = part_of([x for x in CATALOGUE if x.parent.name == "erk"], 2)
    for path in of_erk if target == "climatimesteppers" else sample():
        if not load(str(path)).tableau.is_gark:
            continue  # test_rosenbrock_sources.py reads Rosenbrock methods; others are not written
        method = payload(path)
        if target in {"rungekutta-jl", "climatimesteppers"}:
            method = replace(method, embedded=None)
        # by weights with the sum 3 no matrix is known to be a tableau
        is_known = target != "rklab" or path.name != "verner-6-misprint.gark.yaml"
        if not (is_known and of_one_table(target, method)):
            continue
        try:
            text = bridge.written(method)
        except CannotExport:
            continue
        (table,) = reader.find(text, f"x{bridge.suffix}")
        assert table.trouble == "", path.name
        table = _in_order(table, method)
        assert read(table).tableau.size == method.size
        wrong = set(differing(table, method))
        assert wrong == set(), path.name
        assert table.dense or not method.dense or "dense output" in bridge.lacks, path.name
        count += 1
    assert count >= 5


def _in_order(table: FoundTable, method: Payload) -> FoundTable:
    """The colours of a table as the method has them: in PETSc an implicit method has an explicit
    one beside it, and of two colours the explicit one is first.
    """
    if table.format != "petsc" or table.colours != 2:
        return table
    if method.size == 1:
        return replace(
            table,
            A=((table.A[0][1],),),
            b=table.b[1:],
            c=table.c[-1:],
            embedded=table.embedded and table.embedded[1:],
        )
    turned = replace(
        table,
        A=tuple(row[::-1] for row in table.A[::-1]),
        b=table.b[::-1],
        c=table.c[::-1],
        embedded=table.embedded and table.embedded[::-1],
    )
    return turned if any(differing(table, method)) else table


def test_every_format_that_reads_back_is_here() -> None:
    """A target that says that it is read back is in this test."""
    assert {x.name for x in bridges().values() if x.reads_back} <= set(READERS)
