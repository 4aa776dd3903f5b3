"""The signs of a web page: HTML with formulas as MathML."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from html import escape
from typing import TYPE_CHECKING

from garkcli.errors import printable
from garkcli.exact.display import shortest, to_latex
from garkcli.exact.letters import LETTERS
from garkcli.exact.polynomial_text import has_long_coefficients, integral, polynomial_text
from garkcli.page.exactly import definition, definition_latex, polynomial_latex, quotient_latex
from garkcli.tell.dialect import LONG, LONG_POLYNOMIAL, WHOLE, Cells, GridLayout, Plain
from garkcli.tell.latex import expression_latex

if TYPE_CHECKING:
    from garkcli.exact.cells import Interval
    from garkcli.exact.field import Number
    from garkcli.exact.polynomial import Polynomial
    from garkcli.plots.scene import Scene
    from garkcli.tableau.letters import Defined
    from garkcli.tableau.pointwise import Entries
    from garkcli.tableau.tableau import Tableau


class Html(Plain):
    """Fragments of HTML; every text of a file is escaped."""

    breadth = "any"

    def prose(self, text: str) -> str:
        return escape(printable(text))

    def formula(self, latex: str, text: str) -> str:
        return f"\\({escape(latex)}\\)"

    def expression(self, text: str, latex: Callable[[], str] | None = None) -> str:
        found = expression_latex(text) if latex is None else latex()
        return f"<code>{self.prose(text)}</code>" if found is None else self.formula(found, text)

    def good(self, text: str) -> str:
        return f'<span class="good">{text}</span>'

    def bad(self, text: str) -> str:
        return f'<span class="bad">{text}</span>'

    def note(self, text: str) -> str:
        return text

    def strong(self, text: str) -> str:
        return f"<strong>{text}</strong>"

    def number(self, x: Number) -> str:
        text = shortest(x)
        return super().number(x) if len(text) > LONG else self.formula(to_latex(x), text)

    def polynomial(self, p: Polynomial, variable: str) -> str:
        text = polynomial_text(p, variable)
        if len(text) > LONG_POLYNOMIAL or has_long_coefficients(p):
            return super().polynomial(p, variable)
        return self.formula(polynomial_latex(p, variable), text)

    def quotient(self, p: Polynomial, q: Polynomial, variable: str) -> str:
        if has_long_coefficients(*integral([p, q])):
            return super().quotient(p, q, variable)
        return self.formula(quotient_latex(p, q, variable), Plain().quotient(p, q, variable))

    def interval(self, x: Interval, variable: str) -> str:
        return super().interval(x, self.formula(variable, variable)).replace(" < ", " &lt; ")

    def code(self, text: str) -> str:
        return f"<code>{self.prose(text)}</code>"

    def headline(self, text: str) -> list[str]:
        return [f"<p>{self.strong(text)}</p>"]

    def title(self, text: str, depth: int) -> list[str]:
        return [f"<h{min(depth + 2, 6)}>{text}</h{min(depth + 2, 6)}>"]

    def sentence(self, text: str, depth: int = 1) -> list[str]:
        return [f"<p>{text}</p>"]

    def rows(self, rows: Sequence[tuple[str, str]], depth: int = 1) -> list[str]:
        body = [f"<tr><th>{label}</th><td>{text}</td></tr>" for label, text in rows]
        return ["<table>", *body, "</table>"]

    def grid(self, head: Cells, rows: Iterable[Cells], how: GridLayout = WHOLE) -> Iterator[str]:
        def row(cells: Sequence[str], tag: str) -> str:
            return f"<tr>{''.join(f'<{tag}>{x}</{tag}>' for x in cells)}</tr>"

        yield "<table>"
        yield row(head, "th")
        for cells in rows:
            yield row(cells, "td")
        yield "</table>"

    def more(self, count: int, depth: int) -> list[str]:
        return [f"<p>… {count} more</p>"]

    def definitions(self, letters: Defined, text: str) -> Iterator[str]:
        for root, letter in letters.items():
            if letter in text or LETTERS[letter].strip() in text:
                latex = definition_latex(root, letter)
                yield from self.sentence(self.formula(latex, definition(root, letter)))

    def tableau(self, tableau: Tableau, entries: Entries) -> list[str]:
        from garkcli.page.tableau_html import tableau_lines

        return tableau_lines(tableau, entries)

    def picture(self, lines: Sequence[str], depth: int) -> list[str]:
        return [f"<pre>{escape(chr(10).join(lines))}</pre>"]

    def scene(self, scene: Scene, depth: int) -> list[str]:
        from garkcli.plots.svg import svg

        return [f'<div style="max-width:32rem">{svg(panel)}</div>' for panel in scene.panels]

    def page(self, lines: Iterable[str]) -> Iterator[str]:
        yield "<div>\n"
        for line in lines:
            yield f"{line}\n"
        yield "</div>\n"
