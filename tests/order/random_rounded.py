"""Exact methods of the catalogue rounded to 3 to 16 digits, plain and through constructions, and the
same with a misprint: what is said of the rounded file against what is true of the exact one.

``python -m tests.order.random_rounded --cases 300 --misprints 300``. With ``--theorems`` the catalogue
is rounded too, and facts of each report that theorems join are held against each other.
"""

from __future__ import annotations

import re
import sys
from argparse import ArgumentParser
from collections.abc import Callable, Iterator, Sequence
from fractions import Fraction
from functools import cache
from pathlib import Path
from random import Random
from typing import Any, TypeAlias

from flint import arb, ctx, fmpq

import garkcli
from garkcli import loads
from garkcli.check.analysis import Analysis, analyse
from garkcli.check.check_file import check_method
from garkcli.errors import GarkError
from garkcli.exact.display import to_ball
from garkcli.exact.field import Number
from garkcli.frozen import Frozen, replace
from garkcli.methodfile.build import MethodFile
from garkcli.order.deciding import AnyOrder
from garkcli.order.dense import DenseOrder
from garkcli.tableau.stages import PointSpace
from garkcli.tableau.tableau import Tableau
from tests.order.theorems import contradictions

DATA = Path(garkcli.__file__).parent / "catalogue" / "data"
LIMIT = 8
MOST_NUMBERS = 40
DIGITS = (3, 4, 5, 6, 8, 10, 12, 15, 16)
OFF = 500
"""A misprint is so many units of the last digit: 1000 t."""
SURE = 6
"""From so many digits on nothing false should hold within the rounding."""
KINDS = {
    "plain": 4,
    "conjugate": 2,
    "adjoint": 2,
    "structure": 2,
    "transfer": 2,
    "two colours": 2,
    "three colours": 1,
    "embedded": 3,
    "dense": 1,
}
PRINTED = ("plain", "two colours", "three colours", "embedded")
"""Kinds whose tableau is what is printed: a wrong entry has a name."""
Write: TypeAlias = "Callable[[Number], str]"
Rows: TypeAlias = "Sequence[Sequence[Number]]"


class RoundsToZero(Exception):
    """An entry becomes 0, which a file means exactly."""


class Rounding:
    """Numbers to so many decimal places, with one of them off by ``misprint`` of the last.

    Attributes:
        count: numbers that are not 0 so far.
    """

    def __init__(self, digits: int, at: int = -1, misprint: int = 0) -> None:
        self.digits, self.at, self.misprint, self.count = digits, at, misprint, 0

    def __call__(self, x: Number) -> str:
        """The nearest decimal; RoundsToZero where that is 0."""
        if not x:
            return "0"
        n = nearest(x, self.digits)
        if not n:
            raise RoundsToZero
        n += self.misprint if self.count == self.at else 0
        self.count += 1
        text = str(abs(n)).rjust(self.digits + 1, "0")
        return f"{'-' if n < 0 else ''}{text[: -self.digits]}.{text[-self.digits :]}"


def nearest(x: Number, digits: int) -> int:
    """The nearest multiple of 10^−digits, in such units."""
    if isinstance(x, fmpq):
        return int((x * 10**digits + fmpq(1, 2)).floor())
    with ctx.workprec(400):
        return int((to_ball(x, digits + 60) * arb(10) ** digits + 0.5).floor().unique_fmpz())


class Source(Frozen):
    """An exact method with one coordinate a stage.

    Attributes:
        name: in the catalogue.
        method: all of it.
    """

    name: str
    method: MethodFile

    @property
    def colours(self) -> int:
        """How many."""
        return self.method.tableau.size

    @property
    def is_rational(self) -> bool:
        """Whether all entries are."""
        return all(isinstance(x, fmpq) for row in self.rows for x in row)

    @property
    def rows(self) -> list[Any]:
        """All rows of blocks, then the weights."""
        tableau = self.method.tableau
        blocks = [row for block in tableau.blocks.values() for row in block]
        return blocks + [colour.b for colour in tableau.colours]

    @property
    def positive(self) -> bool:
        """Whether it has a conjugate."""
        return all(x for colour in self.method.tableau.colours for x in colour.b)


def source(path: Path) -> Source | None:
    """The exact method of a file, if it is small, with all blocks, and nodes that are row sums."""
    text = path.read_text(encoding="utf-8")
    if re.search("^(tolerance|parameters|adjoint|conjugate):", text, re.M):
        return None
    try:
        method = loads(text)
    except GarkError:
        return None
    t = method.tableau
    pairs = [(l, m) for l in range(t.size) for m in range(t.size)]
    if (
        t.size > 2
        or not t.has_fields_alone
        or len(t.spaces) != t.size
        or not all(isinstance(x, PointSpace) for x in t.spaces)
        or any(colour.part != "y" or colour.is_linear for colour in t.colours)
        or any(key not in t.blocks for key in pairs)
    ):
        return None
    found = Source(path.name.removesuffix(".gark.yaml"), method)
    if sum(1 for row in found.rows for x in row if x) > MOST_NUMBERS:
        return None
    for l, colour in enumerate(t.colours):
        if tuple(sum(row, fmpq(0)) for row in t.blocks[colour.space, l]) != tuple(colour.c):
            return None
    return found


@cache
def sources() -> tuple[Source, ...]:
    """Those of the catalogue."""
    found = (source(path) for path in sorted(DATA.glob("*/*.gark.yaml")))
    return tuple(x for x in found if x is not None)


class Case(Frozen):
    """A file and its rounding.

    Attributes:
        kind: one of ``KINDS``.
        name: the methods that it is made of.
        digits: after the point.
        exact: the file without rounding.
        text: the rounded file.
        wrong: which printed number is off, in the order of A, b, and so on; −1 for none.
        off: by how many last digits.
    """

    kind: str
    name: str
    digits: int
    exact: str
    text: str
    wrong: int = -1
    off: int = 0


def listed(rows: Any, write: Write) -> str:
    """Numbers, rows, blocks as YAML."""
    if isinstance(rows, (tuple, list)):
        return f"[{', '.join(listed(row, write) for row in rows)}]"
    return write(rows)


def table(method: Source, write: Write) -> str:
    """A and b of one colour."""
    t = method.method.tableau
    return f"A: {listed(t.blocks[0, 0], write)}, b: {listed(t.colours[0].b, write)}"


def spelled(method: Any, write: Write) -> str:
    """All blocks of a tableau."""
    spaces = [colour.space for colour in method.colours]
    A = [[method.blocks[k, m] for m in range(method.size)] for k in spaces]
    b = [colour.b for colour in method.colours]
    return f"tableau: {{A: {listed(A, write)}, b: {listed(b, write)}}}\n"


def document(kind: str, chosen: Sequence[Source], rule: str, write: Write) -> str:
    """The file of some kind."""
    one = chosen[0]
    if kind in ("structure", "transfer"):
        rows = "".join(f"- {{{table(x, write)}}}\n" for x in chosen)
        structure = "structure: semi-separable\n" if kind == "structure" else ""
        return f"methods:\n{rows}transfer: {rule}\n{structure}"
    if one.colours > 1:
        return spelled(one.method.tableau, write)
    if len(chosen) > 1:
        rows = "".join(f"- {{{table(x, str)}}}\n" for x in chosen)
        return spelled(loads(f"methods:\n{rows}transfer: {rule}\n").tableau, write)
    text = table(one, write)
    if kind == "adjoint":
        return f"adjoint: {{{text}}}\n"
    text = text.replace(", b:", "\nb:") + "\n"
    further = one.method.further
    if kind in ("embedded", "dense") and further.embedded is not None:
        text += f"embedded: {listed(further.embedded[0], write)}\n"
    if kind == "dense" and further.dense is not None:
        weights = further.dense.weights[0]
        text += f"dense: {{degree: {further.dense.degree}, weights: {listed(weights, write)}}}\n"
    return text + ("conjugate: true\n" if kind == "conjugate" else "")


def choose(kind: str, dice: Random) -> tuple[list[Source], str]:
    """Methods for a file of some kind, and a rule for blocks between them."""
    one = [x for x in sources() if x.colours == 1]
    rule = dice.choice(("collocation", "interpolation", "legendre"))
    if kind in ("structure", "transfer", "three colours") or (
        kind == "two colours" and dice.random() < 0.5
    ):
        small = [x for x in one if x.is_rational and len(x.method.tableau.colours[0].b) <= 3]
        count = 3 if kind == "three colours" else 2
        if count == 2 and dice.random() < 0.3:
            small = [x for x in one if len(x.method.tableau.colours[0].b) <= 3]
        return [dice.choice(small) for _ in range(count)], rule
    if kind == "two colours":
        return [dice.choice([x for x in sources() if x.colours == 2])], ""
    if kind in ("embedded", "dense"):
        further = [x for x in one if getattr(x.method.further, kind) is not None]
        return [dice.choice(further)], ""
    if kind == "conjugate":
        one = [x for x in one if x.positive]
    return [dice.choice(one)], ""


def case(dice: Random, kinds: Sequence[str], off: int = 0) -> Case:
    """A random file; with a number that is off by so many last digits, up or down."""
    while True:
        kind = dice.choices(kinds, [KINDS[x] for x in kinds])[0]
        chosen, rule = choose(kind, dice)
        digits = dice.choice(DIGITS)
        try:
            count = Rounding(digits)
            exact = document(kind, chosen, rule, str)
            document(kind, chosen, rule, count)
            wrong = dice.randrange(count.count) if off else -1
            units = dice.choice((-off, off))
            write = Rounding(digits, wrong, units)
            text = document(kind, chosen, rule, write)
            loads(exact)
        except (RoundsToZero, GarkError):
            continue
        name = " ".join([*(x.name for x in chosen), rule]).strip()
        text += f"tolerance: 5e-{digits + 1}\n"
        return Case(kind, name, digits, exact, text, wrong, units)


ORDERS = ("order", "conjugate order", "pair order", "embedded order", "dense order")


def orders(found: Analysis) -> dict[str, AnyOrder | DenseOrder | None]:
    """All orders of a method."""
    embedded, dense = found.embedded, found.dense
    return {
        "order": found.order,
        "conjugate order": found.conjugate_order,
        "pair order": found.pair_order,
        "embedded order": None if embedded is None else embedded.order,
        "dense order": None if dense is None else dense.order,
    }


def facts(found: Analysis) -> dict[str, Any]:
    """What is said of a method: numbers, and lists of numbers."""
    said: dict[str, Any] = {k: None if x is None else x.order for k, x in orders(found).items()}
    s = found.simplifying
    said.update(B=s.B, C=sum(s.C, ()), D=sum(s.D, ()), symplectic=found.symplectic)
    said["weak stage order"] = found.subject.verdict("weak-stage-order").value
    said["stiffly accurate"] = found.subject.verdict("stiffly-accurate").value
    return said


def analysis(method: MethodFile) -> Analysis:
    """What a check finds, without hints."""
    return analyse(method.tableau, LIMIT, method.tolerance, method.further)


def less(one: Any, other: Any) -> bool:
    """Whether a fact says less than another in some place."""
    if isinstance(one, tuple):
        return any(map(less, one, other))
    return one is not None and other is not None and one < other


class Judged(Frozen):
    """What is said of a rounded file, against what is true of the exact one.

    Attributes:
        case: the file.
        true: of the exact file.
        said: of the rounded one.
        open: which orders are left undecided.
    """

    case: Case
    true: dict[str, Any]
    said: dict[str, Any]
    open: tuple[str, ...]

    @property
    def lower(self) -> list[str]:
        """What is true and is denied; an order that is undecided is not denied."""
        return [k for k in self.true if k not in self.open and less(self.said[k], self.true[k])]

    @property
    def higher(self) -> list[str]:
        """What is false, and holds within the rounding."""
        return [k for k in self.true if less(self.true[k], self.said[k])]

    @property
    def refuted(self) -> list[str]:
        """Orders that are denied though nothing else holds in their place."""
        return [] if self.higher else [k for k in self.lower if k in ORDERS]

    def __str__(self) -> str:
        changed = {k: (self.true[k], self.said[k]) for k in self.true if k in self.lower}
        more = {k: (self.true[k], self.said[k]) for k in self.higher}
        of = self.case
        return f"{of.kind}, {of.name}, {of.digits} digits: denied {changed} new {more} {self.open}"


def judged(of: Case) -> Judged:
    """What is said of a file, and what is true."""
    found = analysis(loads(of.text))
    undecided = tuple(k for k, x in orders(found).items() if getattr(x, "undecided", None))
    return Judged(of, facts(analysis(loads(of.exact))), facts(found), undecided)


def fraction(x: Any) -> Fraction:
    """A rational number of flint."""
    return Fraction(int(x.p), int(x.q))


Place: TypeAlias = "tuple[int, int | None, int | None, int]"
"""An entry as ``blame`` names it: colours and indices; of weights j alone."""


def places(of: Case) -> list[Place]:
    """The printed numbers of a file by their entries, in order; embedded weights are those of b."""
    method = loads(of.exact)
    t = method.tableau
    found: list[Place] = []
    for l, colour in enumerate(t.colours):
        for m in range(t.size):
            block = t.blocks[colour.space, m]
            found += [(l, m, i, j) for i, row in enumerate(block) for j, x in enumerate(row) if x]
    rows = [colour.b for colour in t.colours]
    if of.kind == "embedded":
        rows += method.further.embedded or ()
    for n, row in enumerate(rows):
        found += [(n % t.size, None, None, j) for j, x in enumerate(row) if x]
    return found


class Misprinted(Frozen):
    """What is said of a file with a misprint.

    Attributes:
        case: the file.
        is_free: whether the exact method keeps its orders with the wrong number alone: it is
            another method of these orders.
        is_found: whether a claim of the true orders fails, or an entry is named.
        named: the entries that hints name, the likeliest first.
    """

    case: Case
    is_free: bool
    is_found: bool
    named: tuple[Place, ...]

    @property
    def place(self) -> Place:
        """The wrong entry."""
        return places(self.case)[self.case.wrong]

    def __str__(self) -> str:
        of = self.case
        found = "found" if self.is_found else "not found"
        return f"{of.kind}, {of.name}, {of.digits} digits: {found}, {self.place} in {self.named}"


def own_orders(found: Analysis) -> dict[str, int]:
    """What a file would claim of its orders."""
    said = {"order": found.order.order}
    if found.embedded is not None:
        said["embedded-order"] = found.embedded.order.order
    return said


def misprinted(of: Case) -> Misprinted:
    """What is said of a file with a misprint, where it claims the true orders."""
    true = own_orders(analysis(loads(of.exact)))
    method, number = loads(of.exact), [-1]
    place, units = places(of)[of.wrong], of.off * fmpq(1, 10**of.digits)

    def changed(x: Number) -> str:
        number[0] += bool(x)
        return str(x + units if x and number[0] == of.wrong else x)

    wrong = loads(document(of.kind, [Source(of.name, method)], "", changed))
    now = own_orders(analysis(wrong))
    claims = ", ".join(f"{key}: {value}" for key, value in true.items())
    outcome = check_method(loads(f"{of.text}expect: {{{claims}}}\n"), LIMIT)
    assert outcome.analysis is not None
    hints = outcome.remark, outcome.blame
    repairs = [x for hint in hints if hint is not None for x in hint.repairs]
    named = tuple((x.l, x.m, x.i, x.j) for x in repairs)
    is_found = bool(named) or not all(claim.holds for claim in outcome.claims)
    assert place == places(of)[of.wrong]
    return Misprinted(of, all(now[k] >= true[k] for k in true), is_found, named)


def rounded_method(method: MethodFile, digits: int) -> Analysis:
    """All of a method with so many digits after the point, nodes as row sums where they are."""
    t = method.tableau

    def off(x: Number) -> Number:
        return fmpq(nearest(x, digits), 10**digits) if x else x

    blocks = {key: tuple(tuple(map(off, row)) for row in block) for key, block in t.blocks.items()}
    colours = []
    for l, colour in enumerate(t.colours):
        c = tuple(map(off, colour.c))
        for m in range(t.size):
            block = t.block(l, m)
            if block is not None and sums(block) == tuple(colour.c):
                c = sums(blocks[colour.space, m])
                break
        colours.append(replace(colour, b=tuple(map(off, colour.b)), c=c))
    spaces = [PointSpace(next(x.c for x in colours if x.space == k)) for k in range(len(t.spaces))]
    tableau = Tableau(tuple(spaces), tuple(colours), blocks)
    return analyse(tableau, LIMIT, fmpq(1, 2 * 10**digits), method.further.changed(off))


def sums(block: Rows) -> tuple[Number, ...]:
    """Of rows."""
    return tuple(sum(row, fmpq(0)) for row in block)


def catalogued() -> Iterator[tuple[str, MethodFile]]:
    """GARK methods of the catalogue with one coordinate a stage and few numbers."""
    for path in sorted(DATA.glob("*/*.gark.yaml")):
        try:
            method = loads(path.read_text(encoding="utf-8"))
        except GarkError:
            continue
        t = method.tableau
        if t.exact_to is not None or not t.has_fields_alone:
            continue
        few = sum(1 for block in t.blocks.values() for row in block for x in row if x)
        if few <= MOST_NUMBERS and all(isinstance(x, PointSpace) for x in t.spaces):
            yield path.name.removesuffix(".gark.yaml"), method


def run_theorems(digits: Sequence[int]) -> int:
    """The catalogue with so many digits: how many reports contradict themselves."""
    count, bad = 0, 0
    for name, method in catalogued():
        for d in digits:
            count += 1
            found = contradictions(rounded_method(method, d))
            bad += bool(found)
            if found:
                print(f"{name}, {d} digits: {', '.join(found)}", flush=True)
    print(f"reports of the catalogue: {count}, {bad} contradict themselves")
    return bad


def percent(part: int, whole: int) -> str:
    return f"{part} of {whole} ({100 * part / max(whole, 1):.1f} %)"


def run_rounded(dice: Random, cases: int) -> list[Judged]:
    """Random files, what is odd among them printed."""
    found = []
    for _ in range(cases):
        one = judged(case(dice, list(KINDS)))
        found.append(one)
        if one.lower or one.open or (one.higher and one.case.digits >= SURE):
            print(one, flush=True)
    sure = [x for x in found if x.case.digits >= SURE]
    print(f"rounded files: {cases}, {len(sure)} with {SURE} digits or more")
    print(f"  true orders refuted: {sum(bool(x.refuted) for x in found)}")
    print(f"  false statements confirmed at {SURE} digits: {sum(bool(x.higher) for x in sure)}")
    print(f"  an order left open: {percent(sum(bool(x.open) for x in found), cases)}")
    denied = [x for x in found if x.lower and not x.refuted]
    print(f"  something true of the source is not true of the method found: {len(denied)}")
    return found


def run_misprints(dice: Random, cases: int) -> list[Misprinted]:
    """Random files with a misprint, what is not found printed."""
    found: list[Misprinted] = []
    free = 0
    while len(found) < cases:
        one = misprinted(case(dice, PRINTED, OFF))
        if one.is_free:
            free += 1
            continue
        found.append(one)
        if one.place not in one.named:
            print(one, flush=True)
    seen = [x for x in found if x.is_found]
    named = [x for x in seen if x.place in x.named]
    first = [x for x in named if x.place == x.named[0]]
    print(f"misprints: {cases}, besides {free} of numbers that the orders leave free")
    print(f"  found: {percent(len(seen), cases)}")
    print(f"  of these the right entry is named: {percent(len(named), len(seen))}")
    print(f"  and before all others: {percent(len(first), len(seen))}")
    return found


def main(arguments: Sequence[str]) -> int:
    parser = ArgumentParser()
    parser.add_argument("--cases", type=int, default=300, help="rounded files")
    parser.add_argument("--misprints", type=int, default=300, help="files with a misprint")
    parser.add_argument(
        "--theorems", action="store_true", help="the catalogue with 5, 8, 12 digits"
    )
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args(arguments)
    dice = Random(given.seed)
    rounded = run_rounded(dice, given.cases)
    run_misprints(dice, given.misprints)
    bad = run_theorems((5, 8, 12)) if given.theorems else 0
    sure = [x for x in rounded if x.case.digits >= SURE]
    return int(bad > 0 or any(x.refuted for x in rounded) or any(x.higher for x in sure))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
