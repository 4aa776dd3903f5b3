"""One digit of a table with many digits changed: gark audit finds it, in every language.

Every second table and one digit of each in the suite; in ``make whole`` all, and four digits.
"""

from __future__ import annotations

from collections.abc import Sequence

import pytest

from garkcli import catalogue
from garkcli.bridges.audit import audit
from garkcli.bridges.readers.registry import find_tables, readers_for
from garkcli.bridges.rounding import rounded
from garkcli.errors import Remark
from garkcli.exact.field import Number
from tests.whole import IS_WHOLE, in_whole, sample

TABLES = {
    "tsitouras-5": ("c", 16),
    "dop853": ("jl", 17),
    "cash-4-2": ("py", 18),
    "cash-4-3": ("f90", 20),
    "kvaerno-3": ("c", 17),
    "kvaerno-4": ("jl", 16),
    "kvaerno-5": ("py", 16),
    "esdirk-324": ("f90", 18),
    "billington-2": ("c", 20),
    "calvo-montijano-randez-6": ("jl", 17),
    "ssp-54": ("py", 17),
    "dormand-prince-5": ("f90", 16),
    "gauss-3": ("c", 16),
    "radau-iia-3": ("jl", 18),
    "lobatto-iiic-4": ("py", 16),
    "verner-6-efficient": ("f90", 17),
    "bogacki-shampine-5": ("c", 16),
    "sanz-serna-abia-4": ("jl", 20),
    "fehlberg-5": ("py", 17),
    "cash-karp-5": ("f90", 16),
}
"""Methods of the catalogue with the language and the digits that they are printed in."""
PLACES = (6, 8, 10, 12)
Texts = list[str]


def _printed(x: Number, digits: int) -> str:
    """A number rounded to so many digits; a short decimal as people write it."""
    found = rounded(x, digits)
    text = f"{found:.{digits - 1 - found.adjusted()}f}"
    short = text.rstrip("0")
    return f"{short}0" if len(short.lstrip("-")) < 8 else text


def _c(A: Sequence[Texts], b: Texts, c: Texts, order: int) -> str:
    rows = ",\n".join("{" + ", ".join(row) + "}" for row in A)
    s = len(b)
    return (
        f"static const double m_A[{s}][{s}] = {{{rows}}};\n"
        f"static const double m_b[{s}] = {{{', '.join(b)}}};\n"
        f"static const double m_c[{s}] = {{{', '.join(c)}}};\nstatic const int m_order = {order};\n"
    )


def _julia(A: Sequence[Texts], b: Texts, c: Texts, order: int) -> str:
    rows = "\n".join(map(" ".join, A))
    return (
        f"function constructM(T::Type = Float64)\n    A = [{rows}]\n    c = [{', '.join(c)}]\n"
        f"    α = [{'; '.join(b)}]\n    return ExplicitRKTableau(map(T, A), c, α, {order})\nend\n"
    )


def _python(A: Sequence[Texts], b: Texts, c: Texts, order: int) -> str:
    rows = ",\n".join(f"[{', '.join(row)}]" for row in A)
    return (
        f"class M(RungeKutta):\n    order = {order}\n    A = np.array([{rows}])\n"
        f"    B = np.array([{', '.join(b)}])\n    C = np.array([{', '.join(c)}])\n"
    )


def _fortran(A: Sequence[Texts], b: Texts, c: Texts, order: int) -> str:
    """Scalars with names; nothing says which order they have."""
    del order
    named = [(f"a{i}{j}", x) for i, row in enumerate(A, 1) for j, x in enumerate(row, 1)]
    named += [(f"{word}{i}", x) for word, row in (("b", b), ("c", c)) for i, x in enumerate(row, 1)]
    lines = [f"    real(wp), parameter :: {name} = {x}_wp" for name, x in named if x != "0.0"]
    return "\n".join(["subroutine step()", *lines, "end subroutine\n"])


WRITERS = {"c": _c, "jl": _julia, "py": _python, "f90": _fortran}


def _findings(A: Sequence[Texts], b: Texts, c: Texts, order: int, suffix: str) -> list[Remark]:
    name = f"m.{suffix}"
    found = find_tables(WRITERS[suffix](A, b, c, order), name, readers_for(name))
    audited = [audit(table) for table in found]
    assert len(audited) == 1
    assert audited[0] is not None
    assert audited[0].is_read
    return list(audited[0].findings)


def _changed(text: str, place: int) -> str:
    """The digit at a place, without zeros in front, one higher."""
    first = next(i for i, x in enumerate(text) if x in "123456789")
    digits = [i for i, x in enumerate(text) if x.isdigit() and i >= first]
    at = digits[place - 1]
    return f"{text[:at]}{(int(text[at]) + 1) % 10}{text[at + 1 :]}"


LONG = {
    *("dop853", "calvo-montijano-randez-6", "kvaerno-5", "lobatto-iiic-4", "fehlberg-5"),
    "tsitouras-5",
}
"""Methods that take long."""


@in_whole
@pytest.mark.parametrize("name", sample([x for x in TABLES if IS_WHOLE or x not in LONG], 2))
def test_a_changed_digit_is_found(name: str) -> None:
    """A digit one higher is an error, or a note where rounding might be as careless; the table as
    it is printed has neither.
    """
    suffix, digits = TABLES[name]
    method = catalogue[name]
    tableau = method.tableau
    order = next(int(x.value) for x in method.claims if x.key == "order")
    block = tableau.block(0, 0)
    assert block is not None
    rows = [*block, tableau.colours[0].b, tableau.colours[0].c]
    texts = [[_printed(x, digits) if x else "0.0" for x in row] for row in rows]
    assert not _findings(texts[:-2], texts[-2], texts[-1], order, suffix)
    long = [(i, j) for i, row in enumerate(texts) for j, x in enumerate(row) if len(x) >= digits]
    for number in range(len(PLACES)) if IS_WHOLE else [list(TABLES).index(name) % len(PLACES)]:
        place = PLACES[number]
        i, j = long[number * len(long) // len(PLACES)]
        changed = [list(row) for row in texts]
        changed[i][j] = _changed(texts[i][j], place)
        found = _findings(changed[:-2], changed[-2], changed[-1], order, suffix)
        told = f"{texts[i][j]} to {changed[i][j]}"
        assert found, told
        assert place == 12 or any(x.level != "note" for x in found), told
