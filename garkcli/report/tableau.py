"""Tableaus of ``gark tableau``, ``conjugate``, ``convert`` and ``reduce``, declared once.

Numbers are exact strings, with floats of the same shape beside them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import chain
from typing import NamedTuple, TypeAlias, cast

from flint import arb, fmpq

from garkcli.constructions.derivatives import Derivatives, embedded_of, is_derivatives
from garkcli.constructions.infinitesimal import Coupling, slow_part
from garkcli.constructions.multirate import SLOW
from garkcli.constructions.nystrom import Nystrom, is_nystrom
from garkcli.constructions.rosenbrock import Rosenbrock, is_rosenbrock
from garkcli.exact.display import shortest, to_ball, to_float, to_text
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.matrix import Vector
from garkcli.exact.parametric import Parametric
from garkcli.frozen import replace
from garkcli.order.meant import as_meant, printed
from garkcli.order.simplifying import inconsistent_blocks, is_symplectic
from garkcli.page.cells import cell_text, remark
from garkcli.page.lines import aligned
from garkcli.page.schema import NUMBER, NUMERAL, Schema, array, nullable
from garkcli.page.tableau_text import block_lines, readable, room_for_entry, shortened, vector_lines
from garkcli.report.check import COLOURS, colours_of, wrong
from garkcli.tableau import pointwise
from garkcli.tableau.garkmethod import Derivation, GarkMethod
from garkcli.tableau.pointwise import Cell, Entries
from garkcli.tableau.tableau import Tableau
from garkcli.tableau.transformation import Transformation, transformation
from garkcli.tell.dialect import Plain, Status
from garkcli.tell.facts import Answer, Json, Kind, Level, Row, Rows, Section, itself, optional, via
from garkcli.tell.kinds import DERIVATION, TEXT, TRUTH, constant
from garkcli.tell.outputs import labelled
from garkcli.tell.parts import SAID, drawing, part, parts, rows_of, sentence, told
from garkcli.tell.report import Report

DETAIL, DATA = Level.DETAIL, Level.DATA
Grid: TypeAlias = "Sequence[Sequence[Cell]]"


class ShownTableau(NamedTuple):
    """Rounded entries have decimals for long fractions."""

    tableau: Tableau
    entries: Entries
    name: str
    derivation: Derivation = ""
    is_rounded: bool = False
    method: GarkMethod | None = None
    transformation: Transformation | None = None
    coupling: Coupling | None = None

    @property
    def readable(self) -> Entries:
        return readable(self.entries) if self.is_rounded else self.entries


def of_method(
    method: GarkMethod,
    digits: int | None = None,
    with_transformation: bool = False,
    coupling: Coupling | None = None,
) -> ShownTableau:
    """Raises MethodError if the transformation is requested, and there is none."""
    entries = method.entries
    if digits is not None:
        entries = pointwise.entries(method.tableau, digits).beside(method.further)
        entries = entries.in_decimals(digits)
    is_rounded = method.tolerance is not None
    moved = transformation(method.tableau, digits or USUAL) if with_transformation else None
    name, derivation = method.name, method.derivation
    return ShownTableau(
        method.tableau, entries, name, derivation, is_rounded, method, moved, coupling
    )


USUAL = 17


DIGITS = 12


def _float(cell: Cell | Parametric) -> float | None:
    if isinstance(cell, Parametric):
        return None
    return float(cell) if isinstance(cell, arb) else to_float(cell)


def _numeral(entries: Entries, cell: Cell) -> str:
    return cell_text(cell, entries.digits) if isinstance(cell, arb) else to_text(cell)


def _entries(entry: Schema, change: Callable[[Entries, Cell], object]) -> Rows[Entries]:
    """c, A, b and further weights with entries that ``entry`` describes."""

    def rows(entries: Entries, found: Grid | None) -> list[list[object]] | None:
        return None if found is None else [[change(entries, x) for x in row] for row in found]

    def several(entries: Entries, found: Sequence[Grid | None]) -> list[list[list[object]] | None]:
        return [rows(entries, x) for x in found]

    def predictor(key: str, entries: Entries) -> Sequence[object] | None:
        found = dict(entries.predictor).get(key)
        return None if found is None else several(entries, found)

    matrix = array(array(entry))
    one: Kind[Sequence[object]] = Kind(Json(matrix))
    blocks: Kind[Sequence[object]] = Kind(Json(array(array(nullable(matrix)))))
    powers: Kind[Sequence[object]] = Kind(Json(array(matrix)))
    return [
        Row("c", one, lambda x: rows(x, x.c), DATA),
        Row("A", blocks, lambda x: [several(x, y) for y in x.A], DATA),
        Row("b", one, lambda x: rows(x, x.b), DATA),
        optional("embedded", one, lambda x: rows(x, x.embedded), DATA),
        optional("dense", powers, lambda x: None if x.dense is None else several(x, x.dense), DATA),
        optional("predictor_old", powers, partial(predictor, "old"), DATA),
        optional("predictor_new", powers, partial(predictor, "new"), DATA),
    ]


def _consistent(x: GarkMethod) -> Answer[bool]:
    return wrong(inconsistent_blocks(as_meant(x)), "A", x.tolerance)


def _symplectic(x: GarkMethod) -> Answer[bool]:
    found = is_symplectic(as_meant(x))
    return Answer(found, Status(x.tolerance if found else None))


def _sums(x: ShownTableau, _: Plain) -> str:
    sums = (sum(row[1:], row[0]) for row in x.readable.b)
    return ", ".join(cell_text(total, x.entries.digits) for total in sums)


FORMULAS = {
    "": "",
    "conjugate": "Â_ij = b_j − b_j a_ji / b_i; conjugated again it is the method",
    "pair": "A for positions, Â_ij = b_j − b_j a_ji / b_i for momenta",
}


OF_ENTRIES: Rows[ShownTableau] = (
    Row("made_by", SAID, lambda x: FORMULAS[x.derivation]),
    itself("weights_sum", told(_sums)),
)
OF_METHOD: Rows[GarkMethod] = (
    Row("consistent", TRUTH, _consistent),
    Row("symplectic", TRUTH, _symplectic),
)
ABOUT: Section[ShownTableau] = Section(OF_ENTRIES, via(lambda x: x.method, OF_METHOD))


def _about(x: ShownTableau, d: Plain) -> list[tuple[str, str]]:
    if d.breadth == "page" or x.method is None or not x.tableau.is_gark:
        return []
    # what a method of a family is depends on its parameters
    about = Section(OF_ENTRIES) if x.tableau.has_parameters else ABOUT
    ((_, rows),) = labelled(about, x, d, DETAIL)
    return rows


def _decimals(x: ShownTableau, d: Plain) -> list[str]:
    entries = x.entries
    numbers = [*chain(*entries.c, *entries.b, *chain(*(y for row in entries.A for y in row if y)))]
    is_told = d.breadth == "terminal" and not d.is_brief and not x.is_rounded
    has_others = any(isinstance(y, Algebraic) or (isinstance(y, fmpq) and y.q > 1) for y in numbers)
    if not is_told or not has_others or x.tableau.has_parameters or not x.tableau.is_gark:
        return []
    return d.tableau(x.tableau, entries.in_decimals(DIGITS))


OF_SLOW = "the slow method, which is left where the fast part is 0"
OF_ROSENBROCK = "α, with c and b", "γ, with d, the weights of ∂f/∂t, in place of A and c"
OF_NYSTROM = "Ā, with c and b̄", "A, with c and b"
OF_POSITIONS = OF_NYSTROM[0], "b, with 0 in place of A: g depends on q alone"


def shown_parts(tableau: Tableau, whole: Entries) -> list[tuple[str, Tableau, Entries]]:
    """Returns the parts with titles: α and γ, Ā and A, or the slow method."""
    if is_derivatives(tableau):
        return [*_of_derivatives(tableau, whole)]
    if tableau.exact_to is not None:
        slow = printed(slow_part(tableau))
        embedded = whole.embedded and whole.embedded[SLOW:]
        entries = replace(pointwise.entries(slow, whole.digits), embedded=embedded)
        return [(OF_SLOW, slow, entries)]
    if is_nystrom(tableau):
        method = Nystrom.of(tableau)
        texts = OF_POSITIONS if method.A is None else OF_NYSTROM
        arrays, own = method.arrays, (slice(0, 1), slice(1, 2))
    elif is_rosenbrock(tableau):
        texts, arrays = OF_ROSENBROCK, Rosenbrock.of(tableau).arrays
        own = slice(arrays[0].size), slice(0)  # the other one has the same weights
    else:
        return [("", tableau, whole)]
    found: list[tuple[str, Tableau, Entries]] = []
    for text, array_of, rows in zip(texts, arrays, own, strict=True):
        entries = pointwise.entries(array_of, whole.digits)
        if rows.stop:
            embedded, dense = whole.embedded and whole.embedded[rows], whole.dense
            entries = replace(entries, embedded=embedded, dense=dense and dense[rows])
        found.append((text, array_of, entries))
    return found


def _of_derivatives(tableau: Tableau, whole: Entries) -> Iterator[tuple[str, Tableau, Entries]]:
    method, row = Derivatives.of(tableau), whole.embedded
    embedded = None if row is None else embedded_of(cast("Sequence[Vector]", row), tableau)
    for k, array_of in enumerate(method.arrays(len(method.A))):
        entries = pointwise.entries(array_of, whole.digits)
        if embedded is not None:
            entries = replace(entries, embedded=(embedded[k],))
        name = ("of f, with c", "of f'f")[k] if k < 2 else f"of derivative {k} of f"
        yield name, array_of, entries


def drawn(x: ShownTableau, d: Plain) -> list[str]:
    lines = []
    has_short, longest = False, room_for_entry(d.width)
    for text, tableau, own in shown_parts(x.tableau, x.entries):
        gap = [""] if d.breadth == "terminal" else []
        lines += [*gap, *d.sentence(d.prose(text), 0)] if text else []
        entries = readable(own) if x.is_rounded else own
        if d.is_brief and d.breadth != "page":
            entries = shortened(whole := entries, longest, d.spelt)
            has_short = has_short or entries != whole
        lines += d.tableau(tableau, entries)
    if x.coupling is not None and d.breadth != "page":
        lines += _of_coupling(x, x.coupling, d)
    if has_short:
        decimals = f"entries of more than {longest} signs as decimals: exact with -v"
        lines += ["", *d.sentence(d.prose(decimals), 0)]
    return lines


def _of_coupling(x: ShownTableau, coupling: Coupling, d: Plain) -> Iterator[str]:
    """The matrices by which slow stages act on the fast problems between them."""
    from garkcli.bridges.couplings import keys_of  # few methods have them

    digits = x.entries.digits
    longest = digits + len("-0.") if x.is_rounded else room_for_entry(d.width)

    def text(number: Number) -> str:
        exact = shortest(number)
        found = exact if len(exact) <= longest else cell_text(to_ball(number, digits), digits)
        return d.spelt(found)

    ((_, keys),) = keys_of(coupling).items()
    last = keys.get("embedded", {})
    gap = [""] if d.breadth == "terminal" else []
    meaning = d.prose("couplings: row i leads to the stage after stage i")
    yield from [*gap, *d.sentence(meaning, 0), *gap]
    lines: list[str] = []
    for key, letter in GREEK.items():
        if key not in keys:
            continue
        matrices = keys[key] if coupling.matrices is not None else [keys[key]]
        rows = last.get(key, ()) if isinstance(last, Mapping) else last
        for k, matrix in enumerate(matrices):
            name = d.spelt(f"{letter} of τ^{k}" if len(matrices) > 1 else letter)
            lines += block_lines(name, [[*map(text, row)] for row in matrix], d.width)
            for row in rows[k : k + 1]:
                lines += [*vector_lines(f"{name}, embedded", [*map(text, row)], d.width), ""]
    yield from d.picture(lines[:-1], 0)


GREEK = {"alpha": "α", "beta": "β", "gamma": "γ", "omega": "ω"}


def _moved(x: Transformation | None, d: Plain) -> list[str]:
    if x is None:
        return []
    pairs = [f"{a} ± {b}i" for a, b in _rounded(x, x.pairs)]
    lines = [f"eigenvalues of A⁻¹: {', '.join([*_rounded(x, [x.real])[0], *pairs])}"]
    for name, matrix in (("T", x.T), ("T⁻¹", x.inverse)):
        lines += ["", f"{name} =", *(f"    {text}" for text in aligned(_rounded(x, matrix)))]
    return ["", *d.picture(lines, 0)]


def _rounded(x: Transformation, rows: Sequence[Sequence[arb]]) -> list[list[str]]:
    least = arb(10) ** -x.digits

    def text(y: arb) -> str:
        is_zero = y.contains(0) and abs(y) < least
        return "0" if is_zero else y.str(x.digits, radius=False)

    return [[text(y) for y in row] for row in rows]


ONE: Kind[Sequence[object]] = Kind(Json(array(NUMERAL)))
SEVERAL: Kind[Sequence[object]] = Kind(Json(array(array(NUMERAL))))
MOVED: Section[Transformation] = Section(
    Row("real", ONE, lambda x: _rounded(x, [x.real])[0]),
    Row("pairs", SEVERAL, lambda x: _rounded(x, x.pairs)),
    Row("T", SEVERAL, lambda x: _rounded(x, x.T)),
    Row("T_inverse", SEVERAL, lambda x: _rounded(x, x.inverse)),
)
FLOATS: Section[Entries] = Section(_entries(NUMBER, lambda _, x: _float(x)))
TABLEAU: Section[ShownTableau] = Section(
    Row("name", TEXT, lambda x: x.name, DATA),
    Row("derivation", DERIVATION, lambda x: x.derivation, DATA),
    Row("exact", TRUTH, lambda x: x.entries.is_exact, DATA),
    sentence(lambda x: remark(x.readable)),
    itself("about", rows_of(_about), DETAIL),
    Row("colours", parts(COLOURS), lambda x: colours_of(x.tableau), DATA),
    via(lambda x: x.entries, _entries(NUMERAL, _numeral)),
    Row("float", part(FLOATS), lambda x: x.entries, DATA),
    itself("tableau", drawing(drawn)),
    itself("decimals", drawing(_decimals), DETAIL, label=""),
    optional("transformation", part(MOVED), lambda x: x.transformation, DATA),
    Row("transformed", drawing(_moved), lambda x: x.transformation, label=""),
    title=lambda x, d: d.prose(x.name),
)
SCHEMA = "gark/tableau/1"
REPORT: Report[ShownTableau] = Report.only(
    SCHEMA,
    "tableau of gark tableau, conjugate, convert and reduce",
    TABLEAU,
    lambda _: {"is_inserted": True},
    letters=lambda x: x.tableau,
)
DOCUMENT: Section[ShownTableau] = Section(
    Row("schema", constant(SCHEMA), lambda _: SCHEMA), TABLEAU.rows
)
