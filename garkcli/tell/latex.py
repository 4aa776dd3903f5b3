"""The signs of LaTeX: text with formulas between dollars."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from itertools import chain, islice
from typing import TYPE_CHECKING

from garkcli.errors import ExpressionError, printable
from garkcli.exact.display import to_latex
from garkcli.exact.letters import LETTERS
from garkcli.exact.polynomial_text import root_text
from garkcli.ntrees.notation import format_latex, parse_tree
from garkcli.page.exactly import definition_latex, multivariate_latex, polynomial_latex
from garkcli.page.latex import greek
from garkcli.tell.dialect import WHOLE, Cells, GridLayout, Plain

if TYPE_CHECKING:
    from garkcli.exact.cells import Interval
    from garkcli.exact.field import Number
    from garkcli.exact.multivariate import Multivariate
    from garkcli.exact.polynomial import Polynomial
    from garkcli.exact.roots import RealRoot
    from garkcli.ntrees.tree import Tree
    from garkcli.plots.scene import Scene
    from garkcli.reason import Place
    from garkcli.stability.ball_polynomials import Bounds
    from garkcli.tableau.letters import Defined
    from garkcli.tableau.pointwise import Entries
    from garkcli.tableau.tableau import Tableau

SIGNS = {
    **{sign: rf"${command}$" for sign, command in {
        "|": "|", "≤": r"\le", "≥": r"\ge", "≠": r"\ne", "≈": r"\approx", "∞": r"\infty", "−": "-",
        "⁻": "^-", "²": "^2", "³": "^3", "ᵀ": r"^{\mathsf T}", "½": r"\frac12", "𝟙": r"\mathbf 1",
        "→": r"\to", "↔": r"\leftrightarrow", "·": r"\cdot", "⊙": r"\odot", "×": r"\times",
        "±": r"\pm", "‖": r"\|", "√": r"\surd", "∂": r"\partial", "∫": r"\int", "Σ": r"\sum",
        "Π": r"\prod", "…": r"\dots", "⋯": r"\cdots", "𝒜": r"\mathcal A", "ℓ": r"\ell",
        "Â": r"\hat A", "Ā": r"\bar A", "ẏ": r"\dot y", "<": "<", ">": ">",
        "\N{PRIME}": r"^\prime", "\N{DOUBLE PRIME}": r"^{\prime\prime}",
    }.items()},
    "\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}",
    **{sign: f"\\{sign}" for sign in "&%#_{}$"},
}  # fmt: skip
_ABOVE = {
    "\N{COMBINING CIRCUMFLEX ACCENT}": "hat",
    "\N{COMBINING TILDE}": "tilde",
    "\N{COMBINING DIAERESIS}": "ddot",
    "\N{COMBINING MACRON}": "bar",
}
_COMMAND, _UNSEEN = re.compile(r"\\([A-Za-z]+|.)"), str.maketrans("", "", "{}$^_")
PAGE, GAP, PICTURE = 96, 2.5, 8
"""The widths of a page, a gap between columns and a drawn tree, in letters."""
ON_A_PAGE, MEASURED = 30, 1000
"""Rows of a table on a page, some of them folded; rows that determine its widths."""
_SIGN = re.compile(rf"\|[^|]+\||[A-Za-z][{''.join(_ABOVE)}]|[^A-Za-z0-9 ]")


def _sign(found: re.Match[str]) -> str:
    sign = found[0]
    if sign.startswith("|") and len(sign) > 1:
        return f"$|{_SIGN.sub(_sign, sign[1:-1]).replace('$', '')}|$"
    if len(sign) > 1:
        return rf"$\{_ABOVE[sign[1]]} {sign[0]}$"
    return SIGNS.get(sign) or greek(sign)


def expression_latex(text: str) -> str | None:
    """Returns the LaTeX; None if method files do not write the text, or it is too large."""
    from garkcli.exact.expression import parse
    from garkcli.exact.rewriting import format_expression

    try:
        return format_expression(parse(text), latex=True)
    except ExpressionError:
        return None


def place_latex(place: Place, name: Callable[[str], str] = str) -> str:
    """``name`` makes the names of colours."""
    base = {"â": r"\hat a", "Â": r"\hat A"}.get(place.letter, place.letter)
    if place.colours:
        base += rf"^{{({','.join(map(name, place.colours))})}}"
    if place.indices:
        base += f"_{{{','.join(str(i + 1) for i in place.indices)}}}"
    return base


def _width(cell: str) -> int:
    """Letters, about: a command is one, a picture some."""
    return PICTURE if "tikzpicture" in cell else len(_COMMAND.sub("x", cell).translate(_UNSEEN))


def _most(widths: Sequence[int], room: int) -> int:
    """The width to which wider columns are folded, so that all have room."""
    for k, width in enumerate(sorted(widths)):
        share = room // (len(widths) - k)
        if width > share:
            return share
        room -= width
    return max(widths)


class Latex(Plain):
    infinity = r"$\infty$"
    breadth = "page"

    def prose(self, text: str) -> str:
        return _SIGN.sub(_sign, printable(text))

    def good(self, text: str) -> str:
        return text

    bad = note = good

    def strong(self, text: str) -> str:
        return rf"\textbf{{{text}}}"

    def formula(self, latex: str, text: str) -> str:
        return f"${latex}$"

    def expression(self, text: str, latex: Callable[[], str] | None = None) -> str:
        found = expression_latex(text) if latex is None else latex()
        return rf"\texttt{{{self.prose(text)}}}" if found is None else f"${found}$"

    def number(self, x: Number) -> str:
        return f"${to_latex(x)}$"

    short = number

    def polynomial(self, p: Polynomial, variable: str) -> str:
        return f"${polynomial_latex(p, variable)}$"

    def over(self, top: str, bottom: str) -> str:
        return top if bottom == "$1$" else rf"$\frac{{{top.strip('$')}}}{{{bottom.strip('$')}}}$"

    def fraction(self, p: Multivariate, q: Multivariate) -> str:
        names = [f"z_{{{k + 1}}}" for k in range(p.variables)]
        return self.over(*(f"${multivariate_latex(x, names)}$" for x in (p, q)))

    def root(self, root: RealRoot) -> str:
        if root.exact is not None:
            return self.number(root.exact)
        text = root_text(root)
        return super().root(root).replace("…", r"\dots") if text is None else self.expression(text)

    def place(self, place: Place) -> str:
        return f"${place_latex(place, self.prose)}$"

    def tree(self, tree: Tree | str) -> str:
        found = parse_tree(tree) if isinstance(tree, str) else tree
        return f"${format_latex(found, self.names or self.has_colours(found))}$"

    def code(self, text: str) -> str:
        return rf"\texttt{{{self.prose(text)}}}"

    def sketch(self, tree: Tree) -> str:
        from garkcli.ntrees.drawing import tikz

        return tikz(tree, colours=len(self.colours) > 1).strip()

    def upto(self, sign: str, end: RealRoot) -> str:
        return rf"{self.prose(sign)} $\le$ {self.root(end)}"

    def interval(self, x: Interval, variable: str) -> str:
        return super().interval(x, f"${variable}$").replace("≤", r"$\le$").replace("<", "$<$")

    def bounds(self, found: Bounds, before: str = "") -> str:
        return super().bounds(found, self.prose(before))

    def capped(self, number: int | None, limit: int) -> str:
        return self.prose(super().capped(number, limit))

    def headline(self, text: str) -> list[str]:
        return [f"% {text}" if self.is_inserted else rf"\subsection*{{{text}}}"]

    def title(self, text: str, depth: int) -> list[str]:
        return [rf"\subsubsection*{{{text}}}"]

    def sentence(self, text: str, depth: int = 1) -> list[str]:
        return [f"% {text}"] if self.is_inserted else [f"{text.removesuffix('.')}.", ""]

    def rows(self, rows: Sequence[tuple[str, str]], depth: int = 1) -> list[str]:
        body = [rf"{label} & {text} \\" for label, text in rows]
        begin, end = r"\noindent\begin{tabular}{lp{.7\linewidth}}", r"\end{tabular}"
        return [begin, r"\hline", *body, r"\hline", end, ""]

    def grid(self, head: Cells, rows: Iterable[Cells], how: GridLayout = WHOLE) -> Iterator[str]:
        """Wide columns are folded; a long table goes on over pages, below its head."""
        left = iter(rows)
        first = [*islice(left, MEASURED)]
        widths = [max(map(_width, column)) for column in zip(head, *first, strict=True)]
        most = _most(widths, int(PAGE - GAP * len(head)))
        folded = rf">{{\raggedright\arraybackslash}}p{{{most / PAGE:.2f}\linewidth}}"
        columns = "".join("l" if x <= most else folded for x in widths)
        is_long = how.is_stream or len(first) > ON_A_PAGE
        kind = "longtable" if is_long else "tabular"
        if not how.is_stream and (is_long or "p" in columns):
            yield r"% \usepackage{array,longtable}"
        begin = rf"\begin{{{kind}}}{{{columns}}}"
        yield begin if is_long else rf"\noindent{begin}"
        yield r"\hline"
        yield rf"{' & '.join(head)} \\"
        yield r"\hline\endhead" if is_long else r"\hline"
        for row in chain(first, left):
            yield rf"{' & '.join(row)} \\"
        yield r"\hline"
        yield rf"\end{{{kind}}}"
        yield ""

    def definitions(self, letters: Defined, text: str) -> Iterator[str]:
        for root, letter in letters.items():
            if LETTERS[letter].strip() in text:
                yield rf"\[ {definition_latex(root, letter)} \]"

    def tableau(self, tableau: Tableau, entries: Entries) -> list[str]:
        from garkcli.page.tableau_latex import tableau_lines

        return tableau_lines(tableau, entries)

    def picture(self, lines: Sequence[str], depth: int) -> list[str]:
        return []

    def scene(self, scene: Scene, depth: int) -> list[str]:
        return []

    def page(self, lines: Iterable[str]) -> Iterator[str]:
        return (f"{line}\n" for line in lines)
