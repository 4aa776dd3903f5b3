"""Text on a terminal, drawn by rich: colours, tables, folded words, links.

Imported only where a terminal shows the text or colours are forced: rich takes as long to import
as a short command.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterable, Sequence
from itertools import pairwise

from rich.box import Box
from rich.cells import cell_len
from rich.console import Console, JustifyMethod, OverflowMethod, RenderableType
from rich.containers import Lines
from rich.measure import Measurement
from rich.padding import Padding
from rich.style import Style
from rich.table import Table
from rich.text import Text

from garkcli.page.lines import joints, shown_width
from garkcli.page.safety import colours_alone
from garkcli.tell.dialect import Cells, Plain, are_numbers

GOOD, BAD = Style(color="green"), Style(color="red", bold=True)
NOTE, STRONG, FAINT = Style(color="cyan"), Style(bold=True), Style(dim=True)
_DOTS = ("blue", "yellow", "green", "magenta", "cyan", "red")
"""The colours 1, 2, … of the dots of a tree, repeated after the last."""
_DOT = re.compile("[●o]([0-9]+)")
_LINK = re.compile(r"(?:https?://|\b10\.[0-9]{4,9}/)[!-;=?-~]*[\w/#=&~+-]", re.ASCII)
_LINK_NUMBER = re.compile("(?<=\x1b]8;)id=[0-9-]+")
"""A random number that rich gives to each link."""
_HEADING = re.compile(r"^(?:Usage(?=:)|[A-Z][\w ,-]*(?=:$))", re.MULTILINE)
_OPTION = re.compile(r"(?<![\w-])--?(?:\[no-\])?[a-zA-Z][\w-]*")
_RULED = "    \n    \n ── \n    \n    \n    \n    \n    \n"
"""A rule below the heads of a table, as ``rich.box`` describes boxes."""
_LEAST = 20


class Folding(Text):
    """Folds at blanks and where formulas and trees may break; later lines hang."""

    hanging = 0

    def wrap(
        self,
        console: Console,
        width: int,
        *,
        justify: JustifyMethod | None = None,
        overflow: OverflowMethod | None = None,
        tab_size: int = 8,
        no_wrap: bool | None = None,
    ) -> Lines:
        lines = Lines()
        for line in self.split(allow_blank=True):
            places = [] if no_wrap else _places(line.plain, width, self.hanging)
            first, *later = line.divide(places)
            first.rstrip()
            lines.append(first)
            for piece in later:
                piece.rstrip()
                blanks = len(piece.plain) - len(piece.plain.lstrip())
                lines.append(Text(" " * self.hanging) + piece[blanks:])
        if justify:
            lines.justify(console, width, justify=justify)
        return lines

    def __rich_measure__(self, console: object, options: object) -> Measurement:
        widest = max(map(cell_len, self.plain.split("\n")), default=0)
        return Measurement(min(widest, 1), widest)


def _places(text: str, width: int, hanging: int) -> list[int]:
    """The places where lines after the first begin."""
    places = [0]
    room, later = width, max(width - hanging, 1)
    for start, end in pairwise([*joints(text), len(text)]):
        is_full = cell_len(text[places[-1] : end].rstrip()) > room
        if is_full and start > places[-1] and cell_len(text[start:end].rstrip()) <= later:
            places.append(start)
            room = later
        while cell_len(text[places[-1] : end].rstrip()) > room:
            places.append(places[-1] + room)
            room = later
    return places[1:]


class Coloured(Plain):
    def styled(self, style: Style, text: str) -> str:
        return style.render(text) if text and self.look.has_colour else text

    def good(self, text: str) -> str:
        return self.styled(GOOD, text)

    def bad(self, text: str) -> str:
        return self.styled(BAD, text)

    def note(self, text: str) -> str:
        return self.styled(NOTE, text)

    def strong(self, text: str) -> str:
        return self.styled(STRONG, text)

    def drawing(self, lines: Iterable[str]) -> list[str]:
        return [_DOT.sub(self._dot, line) for line in lines]

    def _dot(self, dot: re.Match[str]) -> str:
        return self.styled(Style(color=_DOTS[(int(dot[1]) - 1) % len(_DOTS)]), dot[0])


class Terminal(Coloured):
    """Every line fits the width of the terminal."""

    def headline(self, text: str) -> list[str]:
        return self._lines(self._folding(text, STRONG, hanging=2))

    def sentence(self, text: str, depth: int = 1) -> list[str]:
        return self._lines(self._folding(text, hanging=2), depth)

    def message(self, text: str, hanging: int = 2) -> list[str]:
        return self._lines(self._folding(text, hanging=hanging))

    def title(self, text: str, depth: int) -> list[str]:
        return self._lines(self._folding(text, STRONG, hanging=2), depth)

    def rows(self, rows: Sequence[tuple[str, str]], depth: int = 1) -> list[str]:
        table = Table.grid(padding=(0, 2, 0, 0))
        table.add_column(no_wrap=True)
        table.add_column(min_width=_LEAST)
        for label, text in rows:
            style = FAINT if shown_width(label) == len(label) else None
            table.add_row(self._folding(label, style), self._folding(text))
        return self._lines(table, depth)

    def beside(
        self, columns: Sequence[Cells], widths: Sequence[int], room: int, heads: int = 1
    ) -> Iterable[str]:
        *fixed, last = _narrowed(widths, room)
        are_right = [are_numbers(column[heads:]) for column in columns]
        left = room - sum(fixed) - 2 * len(fixed)
        fixed.append(max(min(last, left), 1))
        head = [column[0] for column in columns] if heads else []
        rows: list[Sequence[str]] = []
        for row in zip(*(column[heads:] for column in columns), strict=True):
            if len(row) > 1 and shown_width(row[0]) > fixed[0]:
                # a name is not broken, so that it can be copied
                yield from self._table(head, rows, fixed, are_right, room)
                yield from self._lines(self._folding(row[0], hanging=2), room=room)
                head, rows = [], [("", *row[1:])]
            else:
                rows.append(row)
        yield from self._table(head, rows, fixed, are_right, room)

    def _table(
        self,
        head: Cells,
        rows: Sequence[Cells],
        widths: Sequence[int],
        are_right: Sequence[bool],
        room: int,
    ) -> list[str]:
        if not head and not rows:
            return []
        # a divider and a padding make the gap of two blanks, which the widths count with
        table = Table(
            box=Box(self.spelt(_RULED), ascii=True),
            padding=(0, 1, 0, 0),
            pad_edge=False,
            show_edge=False,
            show_header=bool(head),
            header_style=STRONG,
            border_style=FAINT,
        )
        heads = map(self._folding, head or [""] * len(widths))
        for text, width, is_right in zip(heads, widths, are_right, strict=True):
            justify: JustifyMethod = "right" if is_right else "left"
            table.add_column(text, width=width, justify=justify)
        for row in rows:
            table.add_row(*map(self._folding, row))
        return self._lines(table, room=room)

    def _folding(self, text: str, style: Style | None = None, hanging: int = 0) -> Folding:
        read = Text.from_ansi(self.spelt(colours_alone(text)))
        made = Folding(read.plain, style or "", spans=read.spans)
        made.hanging = hanging
        if self.look.has_colour:
            for link in _LINK.finditer(read.plain):
                made.stylize(Style(link=_address(link[0])), *link.span())
        return made

    def _lines(self, drawn: RenderableType, depth: int = 0, room: int | None = None) -> list[str]:
        console = Console(
            # rich reads the encoding of its file, and the text comes from print
            file=io.TextIOWrapper(io.BytesIO(), encoding=self.look.encoding),
            width=room or self.width,
            force_terminal=True,
            color_system="standard" if self.look.has_colour else None,
            legacy_windows=False,
            highlight=False,
            _environ={},
        )
        with console.capture() as capture:
            console.print(Padding(drawn, (0, 0, 0, 2 * depth), expand=False))
        text = _LINK_NUMBER.sub("", capture.get())
        return [line.rstrip(" ") for line in text.removesuffix("\n").split("\n")]


def _narrowed(widths: Sequence[int], room: int) -> list[int]:
    """Widths with which a table fits a terminal: the widest column gives way."""
    made = [*widths]
    widest = made.index(max(made))
    made[widest] = max(made[widest] - max(sum(made) + 2 * len(made) - 2 - room, 0), 1)
    return made


def _address(link: str) -> str:
    return link if link.startswith("http") else f"https://doi.org/{link}"


def coloured_help(text: str) -> str:
    drawn = Text(text, end="")
    drawn.highlight_regex(_HEADING, STRONG)
    drawn.highlight_regex(_OPTION, NOTE)
    console = Console(force_terminal=True, color_system="standard", _environ={})
    with console.capture() as capture:
        console.print(drawn, soft_wrap=True, end="")
    return capture.get()
