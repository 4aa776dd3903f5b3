"""The signs of plain text: what differs between the outputs, and nothing that knows a result.

Kinds word values through a dialect; ``Plain`` is that of pipes and of texts in JSON.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import islice, zip_longest
from typing import TYPE_CHECKING, ClassVar, Literal, NamedTuple, Self, TypeAlias

from flint import arb, fmpq

from garkcli.errors import printable
from garkcli.exact import polynomial_text as polynomials
from garkcli.exact.display import decimal, shortest, to_decimal, to_text
from garkcli.exact.field import Algebraic, Number
from garkcli.exact.letters import DIAGONAL
from garkcli.exact.polynomial_text import is_long
from garkcli.frozen import Frozen, Mutable, field, replace
from garkcli.ntrees.notation import format_tree
from garkcli.page.lines import folded, indented, shown_width
from garkcli.page.look import PLAIN, Look
from garkcli.page.plaintext import plain_text
from garkcli.page.safety import inert
from garkcli.reason import NO_REASON, Place, Reason

if TYPE_CHECKING:
    from garkcli.exact.cells import Interval
    from garkcli.exact.multivariate import Multivariate
    from garkcli.exact.polynomial import Polynomial
    from garkcli.exact.roots import RealRoot
    from garkcli.ntrees.tree import Tree
    from garkcli.order.certificate import Witness
    from garkcli.plots.scene import Scene
    from garkcli.stability.ball_polynomials import Bounds
    from garkcli.tableau.letters import Defined
    from garkcli.tableau.pointwise import Entries
    from garkcli.tableau.tableau import Tableau

LONG = 40
"""Longer exact numbers are shown as decimals where that is enough."""
LONG_POLYNOMIAL = 320
WORDS = 24
CUT = 8
NAME = 26
"""Longer names have a line of their own where a table is wide."""
AT_ONCE = 100
"""Rows of a stream that are shown at a time."""
FEW = 4


Cells: TypeAlias = Sequence[str]
_NUMBER = re.compile(r"[-−±<>≥≤~ ]*[0-9].{,20}$|$|unknown$")


def are_numbers(cells: Iterable[str]) -> bool:
    """Such cells are aligned right."""
    return all(map(_NUMBER.match, cells))


class Status(Frozen):
    """The certainty of a value, which holds ``within`` a rounding, or exactly if None."""

    within: fmpq | None = None
    at_least: bool = False
    open: Reason = NO_REASON


SURE = Status()


class GridLayout(NamedTuple):
    """The margin; whether last words may be cut; whether it is a stream."""

    depth: int = 0
    is_cut: bool = False
    is_stream: bool = False


WHOLE = GridLayout()


def _broken(text: str, width: int) -> list[str]:
    """The lines of a cell; a word that is too long for it, such as a path, is broken."""
    if "\n" in text:
        return [x for line in text.split("\n") for x in _broken(line, width)]
    if shown_width(text) <= width:
        return [text]
    lines: list[str] = []
    for line in folded(text, width, ""):
        is_long = shown_width(line) == len(line) > width
        lines += [line[i : i + width] for i in range(0, len(line), width)] if is_long else [line]
    return lines


def _cell_width(text: str) -> int:
    return max(map(shown_width, text.split("\n"))) if "\n" in text else shown_width(text)


class Plain(Mutable):
    """The signs of plain text.

    Attributes:
        digits: of decimals.
        colours: names of the colours of a method; a single one is not named.
        names: of the colours in trees, if they are not numbers.
        is_brief: whether decimals stand for roots and polynomials.
        places: significant digits in place of exact numbers; None for these.
        told: failures that were reported: the second time they are "as above".
        letters: those of roots in the numbers of a result, defined below its first line.
        is_inserted: whether LaTeX goes into a document with words of its own, which are comments.
    """

    digits: int = 12
    width: int = 80
    colours: Sequence[str] = ("1",)
    names: Sequence[str] = ()
    parameter: str = ""
    look: Look = PLAIN
    is_brief: bool = True
    places: int | None = None
    told: list[tuple[str, str]] = field(default_factory=list)
    letters: Defined | None = None
    is_inserted: bool = False

    infinity = "∞"
    breadth: ClassVar[Literal["terminal", "page", "any"]] = "terminal"

    def prose(self, text: str) -> str:
        """Words of gark, or of a file."""
        return printable(text)

    def good(self, text: str) -> str:
        return text

    def bad(self, text: str) -> str:
        return text

    def note(self, text: str) -> str:
        return text

    def drawing(self, lines: Iterable[str]) -> list[str]:
        return [*lines]

    def strong(self, text: str) -> str:
        """The text, set off as the most important part."""
        return text

    def reason(self, reason: Reason) -> str:
        return reason.told(
            self.prose, lambda x: self.prose(x) if isinstance(x, str) else x.words(self)
        )

    def known(self, text: str, status: Status) -> str:
        """Adds its rounding to a text, or that it is a lower bound."""
        if status.at_least:
            text = f"at least {text}"
        return text if status.within is None else f"{text} within {decimal(status.within)}"

    def formula(self, latex: str, text: str) -> str:
        return text

    def expression(self, text: str, latex: Callable[[], str] | None = None) -> str:
        """``latex`` makes LaTeX that method files do not write so."""
        return text

    def number(self, x: Number) -> str:
        text = shortest(x)
        is_number = isinstance(x, (fmpq, int, Algebraic))
        if is_number and (self.places is not None or len(text) > LONG):
            return f"about {to_decimal(x, self.places or 8)}"
        return self.expression(text)

    def diagonal(self, x: Number) -> str:
        """The entry γ, as a decimal if the text has its letter for it."""
        if shortest(x) == DIAGONAL:
            return f"about {to_decimal(x, self.places or 8)}"
        return self.number(x)

    def short(self, x: Number) -> str:
        text = shortest(x)
        return self.expression(text) if len(text) <= 12 else to_decimal(x, 4)

    def size(self, ball: arb) -> str:
        return "0" if ball == 0 else str(ball.upper().str(2, radius=False))

    def root(self, root: RealRoot) -> str:
        simple = polynomials.root_text(root) if root.exact is None else shortest(root.exact)
        decimals = polynomials.root_decimal(root, self.digits)
        longest = LONG if root.exact is None else polynomials.LONG_COEFFICIENT
        if len(simple or "") > (longest if self.is_brief else LONG_POLYNOMIAL):
            simple = None
        if simple is None:
            if self.is_brief:
                return f"{decimals}…"
            return f"{decimals}…, a root of {self.minimal(root)}"
        text = self.expression(simple)
        return text if root.exact is not None or self.is_brief else f"{text} = {decimals}…"

    def minimal(self, root: RealRoot) -> str:
        from garkcli.exact.polynomial import Polynomial

        is_wide = max(len(str(a)) for a in root.polynomial.coeffs()) > LONG
        if is_wide and self.breadth != "page":
            return f"a polynomial of degree {root.polynomial.degree()}, in --format json"
        return self.polynomial(Polynomial.from_flint(root.polynomial), "x")

    def polynomial(self, p: Polynomial, variable: str) -> str:
        """A long polynomial is described; long coefficients are decimals."""
        text, about = polynomials.polynomial_text(p, variable), ""
        is_wide = max(map(len, text.split()), default=0) > LONG
        if is_wide or (self.is_brief and polynomials.has_long_coefficients(p)):
            text, about = polynomials.polynomial_decimals(p, variable), "about "
        if len(about + text) > (LONG_POLYNOMIAL // 2 if self.is_brief else LONG_POLYNOMIAL):
            return f"a polynomial of degree {p.degree}, in --format json"
        return about + self.expression(text)

    def over(self, top: str, bottom: str) -> str:
        if bottom == "1":
            return top
        top, bottom = (f"({x})" if " " in x else x for x in (top, bottom))
        return f"{top} / {bottom}"

    def quotient(self, p: Polynomial, q: Polynomial, variable: str) -> str:
        """A rational function with whole coefficients, in decimals if these are long."""
        if self.is_brief and polynomials.has_long_coefficients(*polynomials.integral([p, q])):
            decimals = Plain.over(
                self, *(polynomials.polynomial_decimals(x, variable) for x in (p, q))
            )
            return f"about {self.expression(decimals)}"
        return self.over(*(self.polynomial(x, variable) for x in polynomials.integral([p, q])))

    def fraction(self, p: Multivariate, q: Multivariate) -> str:
        names = [f"z{k + 1}" for k in range(p.variables)]
        text = self.over(
            polynomials.multivariate_text(p, names), polynomials.multivariate_text(q, names)
        )
        has_long = any(is_long(a) for x in (p, q) for _, a in x.terms)
        if len(text) <= 2 * LONG_POLYNOMIAL and not (has_long and self.is_brief):
            return self.expression(text)
        text = self.over(
            polynomials.multivariate_decimals(p, names), polynomials.multivariate_decimals(q, names)
        )
        if not has_long or len(text) > 2 * LONG_POLYNOMIAL:
            return f"{len(p.terms)} terms over {len(q.terms)}, in --format json and latex"
        return f"about {text}"

    def place(self, place: Place) -> str:
        """``a[4,1]``; of several colours ``a{1,2}[4,1]``."""
        return self.prose(str(place))

    def block(self, letter: str, colours: Sequence[int]) -> str:
        names = [self.colours[l] for l in colours] if len(self.colours) > 1 else []
        return self.place(Place(letter, tuple(names)))

    def tree(self, tree: Tree | str) -> str:
        """A tree in brackets; a single colour is not named."""
        if not isinstance(tree, str):
            tree = format_tree(tree, self.names or self.has_colours(tree))
        return self.code(tree)

    def naming(self, names: Sequence[str]) -> Self:
        return replace(self, names=tuple(names)) if names else self

    def has_colours(self, tree: Tree) -> bool:
        return len(self.colours) > 1 or bool({*tree.colours} - {0})

    def code(self, text: str) -> str:
        return text

    def sketch(self, tree: Tree) -> str:
        """A picture in a cell, if the output has such."""
        return ""

    def failure(self, witness: Witness, is_rounded: bool = False, order: int | None = None) -> str:
        """The tree whose condition fails, and by how much; "as above" the second time."""
        order = order or witness.tree.order
        condition = (format_tree(witness.tree, self.names or True), to_text(witness.residual))
        if condition in self.told:
            return f"order {order} fails as above"
        self.told.append(condition)
        if witness.is_joint:
            tree = self.tree(witness.tree)
            return f"order {order} fails at {tree}: it and other conditions exclude each other"
        residual = to_decimal(witness.residual, 4) if is_rounded else self.number(witness.residual)
        return f"order {order} fails at {self.tree(witness.tree)} by {residual}"

    def table(self, rows: Sequence[Sequence[int | None]], limit: int) -> str:
        return " / ".join(" ".join(self.capped(x, limit) for x in row) for row in rows)

    def capped(self, number: int | None, limit: int) -> str:
        """A number at which a search stopped may be larger."""
        if number is None:
            return "-"
        return f"≥{number}" if number >= limit else str(number)

    def upto(self, sign: str, end: RealRoot) -> str:
        return f"{self.prose(sign)} ≤ {self.root(end)}"

    def interval(self, x: Interval, variable: str) -> str:
        if x.is_point:
            assert x.start is not None
            return f"{variable} = {self.root(x.start)}"
        text = variable
        if x.start is not None:
            text = f"{self.root(x.start)} {'≤' if x.has_start else '<'} {text}"
        if x.end is not None:
            text = f"{text} {'≤' if x.has_end else '<'} {self.root(x.end)}"
        return text

    def bounds(self, found: Bounds, before: str = "") -> str:
        low, high = found.low, found.high
        if low is None:
            return "no limit"
        if high is None:
            least = arb(low).str(self.digits, radius=False)
            return f"not decided beyond {before}{least}" if low > 0 else "not decided"
        if low == high:
            return f"{before}{low}"
        known = arb((low + high) / 2, (high - low) / 2).str(self.digits, radius=False)
        return f"{before}{known}"

    def few(self, texts: Sequence[str]) -> str:
        """The first of a list, and how many more there are."""
        more = f" and {len(texts) - FEW} more" if len(texts) > FEW else ""
        return ", ".join(texts[:FEW]) + more

    def spelt(self, text: str) -> str:
        """A text in the signs of the output, so that widths are those of what is written."""
        return text if text.isascii() else plain_text(text, self.look.encoding)

    def headline(self, text: str) -> list[str]:
        return [self.strong(line) for line in folded(self.spelt(text), self.width, "  ")]

    def message(self, text: str, hanging: int = 2) -> list[str]:
        """Programs want messages in one line; otherwise later lines hang."""
        return [text]

    def title(self, text: str, depth: int) -> list[str]:
        return [f"{'  ' * depth}{self.strong(self.spelt(text))}"]

    def sentence(self, text: str, depth: int = 1) -> list[str]:
        margin = "  " * depth
        return folded(margin + self.spelt(text), self.width, margin + "  ")

    def rows(self, rows: Sequence[tuple[str, str]], depth: int = 1) -> list[str]:
        spelt = [(self.spelt(label), self.spelt(text)) for label, text in rows]
        room = max((shown_width(label) for label, _ in spelt), default=0) + 2
        margin = "  " * depth
        lines = []
        for label, text in spelt:
            first, *rest = folded(text, max(self.width - len(margin) - room, 20), "") or [""]
            gap = " " * (room - shown_width(label))
            lines.append(f"{margin}{label}{gap}{first}".rstrip())
            lines += [margin + " " * room + line for line in rest]
        return lines

    def grid(self, head: Cells, rows: Iterable[Cells], how: GridLayout = WHOLE) -> Iterator[str]:
        """A last column of words is folded or cut if it does not fit; other columns that do not fit
        continue below, each time beside the first one. Columns of a stream are as wide as its rows
        so far. With details a row with words in other columns is its name with a line a column
        below.
        """
        if not (self.is_brief or how.is_stream):
            rows = [*rows]
            if self._is_wordy(head, rows, how):
                for name, *cells in rows:
                    yield from self.title(name, how.depth)
                    labelled = [x for x in zip(head[1:], cells, strict=True) if x[1]]
                    yield from self.rows(labelled, how.depth + 1)
                return
        find = self._stream if how.is_stream else self._aligned
        for line in find(head, rows, how):
            yield "  " * how.depth + line

    def _is_wordy(self, head: Cells, rows: Sequence[Cells], how: GridLayout) -> bool:
        """Whether a table does not fit, and has words before its last column."""
        columns = self._columns([head, *rows])
        widths = [max(map(_cell_width, column)) for column in columns]
        room = self.width - 2 * how.depth - 2 * (len(columns) - 1)
        return sum(widths) > room and any(width > WORDS for width in widths[1:-1])

    def _aligned(self, head: Cells, rows: Iterable[Cells], how: GridLayout) -> Iterator[str]:
        columns = self._columns([head, *rows])
        widths = [max(map(_cell_width, column)) for column in columns]
        room = self.width - 2 * how.depth
        is_cut = how.is_cut and self.is_brief
        if is_cut:
            widths[0] = min(widths[0], NAME)
        last = room - sum(widths[:-1]) - 2 * (len(columns) - 1)
        if widths[-1] > last >= (CUT if is_cut else WORDS):
            widths[-1] = last
            if last < WORDS:
                dots = self.spelt("…")
                columns[-1] = tuple(
                    x if len(x) <= last else x[: last - len(dots)] + dots for x in columns[-1]
                )
        widths[-1] = min(widths[-1], max(room - widths[0] - 2, WORDS))
        start = 1
        is_begun = False
        while start < len(columns) or not is_begun:
            end = start + 1
            while end < len(columns) and sum(widths[start : end + 1]) + widths[0] <= room - 2 * (
                end + 1 - start
            ):
                end += 1
            shown = [columns[0], *columns[start:end]]
            yield from self.beside(shown, [widths[0], *widths[start:end]], room)
            start = end
            is_begun = True

    def _stream(self, head: Cells, rows: Iterable[Cells], how: GridLayout) -> Iterator[str]:
        """Folds a wide table: long names have lines of their own."""
        room = self.width - 2 * how.depth - 2 * (len(head) - 1)
        heads = [head]
        widest = [0] * len(head)
        left = iter(rows)
        while some := [*islice(left, AT_ONCE)]:
            columns = self._columns([*heads, *some])
            widest = [
                max(x, *map(_cell_width, column)) for x, column in zip(widest, columns, strict=True)
            ]
            widths = [*widest]
            for least in (widest[0], NAME, CUT):
                widths[0] = min(widths[0], least)
                widths[-1] = min(widest[-1], max(room - sum(widths[:-1]), WORDS))
                if sum(widths) <= room:
                    break
            yield from self.beside(columns, widths, self.width - 2 * how.depth, len(heads))
            heads = []

    def beside(
        self, columns: Sequence[Cells], widths: Sequence[int], room: int, heads: int = 1
    ) -> Iterable[str]:
        are_right = [are_numbers(column[heads:]) for column in columns]
        for row in zip(*columns, strict=True):
            if len(row) > 1 and shown_width(row[0]) > widths[0]:
                yield from folded(row[0], room, "  ")
                row = ("", *row[1:])
            cells = [_broken(x, width) for x, width in zip(row, widths, strict=True)]
            for texts in zip_longest(*cells, fillvalue=""):
                padded = []
                for x, width, is_right in zip(texts, widths, are_right, strict=True):
                    gap = " " * (width - shown_width(x))
                    padded.append(gap + x if is_right else x + gap)
                yield "  ".join(padded).rstrip()

    def _columns(self, rows: Iterable[Cells]) -> list[tuple[str, ...]]:
        return [*zip(*([self.spelt(x) for x in row] for row in rows), strict=True)]

    def more(self, count: int, depth: int) -> list[str]:
        return [self.spelt(f"{'  ' * depth}… {count} more with -v")]

    def definitions(self, letters: Defined, text: str) -> Iterator[str]:
        from garkcli.page.exactly import definition

        for root, letter in letters.items():
            if re.search(rf"(?<![A-Za-z]){self.spelt(letter)}(?![A-Za-z])", text):
                yield from self.sentence(definition(root, letter), 1)

    def tableau(self, tableau: Tableau, entries: Entries) -> list[str]:
        from garkcli.page.tableau_text import tableau_lines

        return ["", *tableau_lines(tableau, entries, self.width, self.spelt)]

    def picture(self, lines: Sequence[str], depth: int) -> list[str]:
        return indented(lines, "  " * depth)

    def scene(self, scene: Scene, depth: int) -> list[str]:
        from garkcli.plots.terminal import COLUMNS, drawn

        columns = min(COLUMNS, self.width - 2 * depth)
        panels = (drawn(panel, self.spelt, columns) for panel in scene.panels)
        return self.picture([line for lines in panels for line in lines], depth)

    def page(self, lines: Iterable[str]) -> Iterator[str]:
        for line in lines:
            yield f"{inert(line)}\n"
