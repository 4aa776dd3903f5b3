"""Rosenbrock methods as papers print them, and in the form that programs store."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from operator import sub
from typing import TYPE_CHECKING, Any, TypeAlias

from flint import fmpq

from garkcli.constructions.rosenbrock import Rosenbrock, stored
from garkcli.conversion.recovered import nearest
from garkcli.conversion.sheet import CannotConvert
from garkcli.errors import MethodError
from garkcli.exact.affine import Affine
from garkcli.exact.display import plain_decimal, to_ball, to_text
from garkcli.exact.enclosing import midpoint
from garkcli.exact.field import ZERO, Number
from garkcli.exact.matrix import Vector
from garkcli.grammar.editing import number_text, quoted, row_text
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.carried import is_transformed
from garkcli.methodfile.writer import Written, tolerance_of_file, tolerance_text
from garkcli.order.meant import as_meant, with_further
from garkcli.tableau.embedded import Further, from_colours
from garkcli.tableau.garkmethod import GarkMethod

if TYPE_CHECKING:
    from garkcli.order.rounded import RoundedTableau
    from garkcli.tableau.tableau import Tableau

PRINTED = "printed"
"""The form with α, γ and b."""
TRANSFORMED = "transformed"
"""The form with A, C, γ_ii and m."""
FORMS = ("spelled-out", PRINTED, TRANSFORMED)
_Parts: TypeAlias = "dict[str, tuple[Vector, ...]]"
"""The rows of each key; a vector has one row."""
_Texts: TypeAlias = "Mapping[str, Sequence[Sequence[str]]]"
_MATRICES = {"alpha", "gamma", "A", "C", "dense"}
_NOISE = 2.0**-40
"""Smaller parts of a radius come from the arithmetic with forms only."""
_SPARE = 100


def text_in_form(method: GarkMethod, to: str, name: str) -> str:
    """The file of a Rosenbrock method of one colour in one of ``FORMS``; CannotConvert without it.

    Exact numbers stay exact. New decimals get two digits more than the tolerance, which is enlarged
    to cover all methods that the old file admits.
    """
    if method.tableau.size > 2 and to == TRANSFORMED:
        message = "programs store Rosenbrock methods of one colour, and this one has more"
        raise CannotConvert(message, "--to spelled-out has all of its blocks")
    own = TRANSFORMED if isinstance(method, MethodFile) and is_transformed(method) else PRINTED
    wanted = own if to == "spelled-out" else to
    try:
        parts = _parts(method.tableau, method.further, wanted)
    except MethodError as error:
        raise CannotConvert(error.message, error.help) from None
    rounded = with_further(as_meant(method))
    tolerance: Written | None = None
    if rounded is None:
        texts: _Texts = {key: [list(map(to_text, row)) for row in parts[key]] for key in parts}
    else:
        places = _Places(rounded, wanted, tuple(parts), is_other=wanted != own)
        texts = {key: list(places.texts(key, rows)) for key, rows in parts.items()}
        tolerance = places.tolerance if wanted != own else tolerance_of_file(method, method.further)
    return _file(texts, wanted, name, tolerance)


def _parts(tableau: Tableau, further: Further, form: str) -> _Parts:
    method = Rosenbrock.of(tableau).without_row_sums
    if len(method.b) > 1:
        return _blocks(method, further)
    if form == TRANSFORMED:
        made = stored(method, further)
        further = made.further
        diagonal = made.gamma[:1] if len(set(made.gamma)) == 1 else made.gamma
        parts = {"gamma": (diagonal,), "A": made.A, "C": made.C, "m": (made.m,)}
        if further.embedded is not None:
            parts["e"] = (tuple(map(sub, made.m, further.embedded[0])),)
    else:
        parts = {"alpha": method.alpha[0][0], "gamma": method.gamma[0][0], "b": method.b}
        if further.embedded is not None:
            parts["embedded"] = further.embedded[:1]
    if method.c is not None:
        parts["c"] = method.c
    if method.d is not None:
        parts["d"] = method.d
    if further.dense is not None:
        parts["dense"] = further.dense.weights[0]
    return parts


def _blocks(method: Rosenbrock, further: Further) -> _Parts:
    parts: _Parts = {}
    for key, blocks in (("alpha", method.alpha), ("gamma", method.gamma)):
        for l, row in enumerate(blocks, start=1):
            parts |= {f"{key} {l} {m}": block for m, block in enumerate(row, start=1)}
    rows = {"b": method.b, "c": method.c, "d": method.d}
    if further.embedded is not None:
        rows["embedded"] = further.embedded[: len(method.b)]
    return parts | {key: x for key, x in rows.items() if x is not None}


class _Places:
    """Affine forms in rounded numbers; ``is_other``: the form is not that of the file."""

    def __init__(
        self, rounded: RoundedTableau, form: str, keys: Sequence[str], is_other: bool
    ) -> None:
        search = rounded.search
        around = search.box.around([ZERO] * len(search.box.numbers)).made
        every = _parts(*from_colours(around, search.printed_further), form)
        self._forms = {key: every[key] for key in keys}
        self._noise = _NOISE * float(min(search.box.radii, default=ZERO))
        self._is_other = is_other
        self._radii = {
            key: max((self._radius(x) for row in rows for x in row), default=0.0)
            for key, rows in self._forms.items()
        }
        self._rounded: set[str] = set()
        self._units = {key: _unit(self.largest(key)) for key in self._forms}

    def _radius(self, x: Any) -> float:
        return x.reach if isinstance(x, Affine) and x.reach > self._noise else 0.0

    def largest(self, key: str) -> float:
        """The largest radius of the numbers that share a tolerance with those of a key."""
        kind = _kind(key)
        return max(x for other, x in self._radii.items() if _kind(other) == kind)

    @property
    def tolerance(self) -> Written | None:
        found = {}
        for key in self._forms:
            if _kind(key) in self._rounded:
                found[_kind(key)] = _rounded_up(self.largest(key), self._units[key])
        if set(found.values()) == {found.get("others")}:
            return found["others"]
        return found or None

    def texts(self, key: str, rows: Sequence[Vector]) -> Iterator[list[str]]:
        for row, forms in zip(rows, self._forms[key], strict=True):
            # equal γ_ii are written once, and each has a form
            yield [self._text(key, *pair) for pair in zip(row, forms, strict=False)]

    def _text(self, key: str, x: Number, form: Any) -> str:
        if not self._radius(form):
            return to_text(x)
        if self._is_other:
            unit = self._units[key]
            known = x if isinstance(x, fmpq) else midpoint(to_ball(x, len(str(unit.q)) + 20))
            x = nearest(known, unit)
        if not x:
            return "0"
        self._rounded.add(_kind(key))
        text = plain_decimal(x) if isinstance(x, fmpq) else to_text(x)
        # a whole number would be exact
        return f"{text}.0" if text.lstrip("-").isdecimal() else text


def _kind(key: str) -> str:
    return {"e": "embedded"}.get(key, key if key in {"embedded", "dense"} else "others")


def _unit(radius: float) -> fmpq:
    """The unit of the last place for numbers with a radius."""
    unit = fmpq(1)
    while radius and float(unit.p) / float(unit.q) * _SPARE > radius:
        unit /= 10
    return unit


def _rounded_up(radius: float, unit: fmpq) -> fmpq:
    """A radius plus the rounding to a unit, in two digits."""
    whole = fmpq(*radius.as_integer_ratio()) + unit / 2
    step = unit * 10
    return step * -((-whole / step).floor())


def _file(texts: _Texts, form: str, name: str, tolerance: Written | None) -> str:
    lines = ["gark: 1", f"name: {quoted(name)}", "rosenbrock:"]
    if "alpha 1 1" in texts:
        lines += ["  blocks:", *_lines_of_blocks(texts)]
        texts = {}
    indent = "  "
    if form == TRANSFORMED:
        lines.append("  transformed:")
        indent = "    "
    for key, rows in texts.items():
        is_matrix = key in _MATRICES and not (key == "gamma" and form == TRANSFORMED)
        if not is_matrix:
            (row,) = rows
            is_number = key == "gamma" and len(row) == 1
            lines.append(f"{indent}{key}: {number_text(row[0]) if is_number else row_text(row)}")
            continue
        lines.append(f"{indent}{key}:")
        if key == "dense":
            lines += [f"{indent}  degree: {len(rows[0])}", f"{indent}  weights:"]
            lines += [f"{indent}  - {row_text(row)}" for row in rows]
        else:
            lines += [f"{indent}  - {row_text(row)}" for row in _lower(rows)]
    if tolerance is not None:
        lines.append(f"tolerance: {tolerance_text(tolerance)}")
    return "\n".join(lines) + "\n"


def _lines_of_blocks(texts: _Texts) -> Iterator[str]:
    N = len(texts["b"])

    def block(key: str) -> str:
        rows = texts[key]
        if all(x == "0" for row in rows for x in row):
            return "null"
        return f"[{', '.join(map(row_text, rows))}]"

    for key in ("alpha", "gamma"):
        yield f"    {key}:"
        for l in range(1, N + 1):
            yield f"    - [{', '.join(block(f'{key} {l} {m}') for m in range(1, N + 1))}]"
    for key in ("b", "c", "d", "embedded"):
        if key in texts:
            yield f"    {key}: [{', '.join(map(row_text, texts[key]))}]"


def _lower(rows: Sequence[Sequence[str]]) -> Iterator[Sequence[str]]:
    """A triangular matrix without its zeros; other matrices unchanged."""
    for behind in (0, 1):
        if all(x == "0" for i, row in enumerate(rows) for x in row[i + behind :]):
            return (row[: i + behind] for i, row in enumerate(rows))
    return iter(rows)
