"""Comments of any text as lines of ASCII; ``*/`` becomes ``* /``, as do other signs of comments."""

from __future__ import annotations

from collections.abc import Iterable
from textwrap import wrap

from garkcli.bridges.payload import Payload
from garkcli.errors import counted, printable
from garkcli.exact.display import decimal
from garkcli.frozen import Frozen
from garkcli.page.plaintext import plain_line

WIDTH = 76
"""Columns of a comment without its mark; Fortran and readers take at most 100."""
_DANGEROUS = ("*/", "/*", "*)", "(*", "??", "]]", "%}", "%{", "=#", "#=")
"""Signs that begin or end a comment in one of the languages, or are trigraphs of C."""


class Comment(Frozen):
    """The signs of comments: ``mark`` before each line, lines ``begin`` and ``end`` around all."""

    mark: str
    begin: str = ""
    end: str = ""

    @property
    def _pairs(self) -> tuple[str, ...]:
        marks = (self.begin.strip(), self.end.strip())
        return tuple(x[i : i + 2] for x in marks for i in range(len(x) - 1))

    def lines(self, texts: Iterable[str]) -> list[str]:
        """Comment lines; long texts are broken, except commands, which begin with a blank."""
        lines = [self.begin] if self.begin else []
        for text in texts:
            plain = harmless(text, self._pairs)
            broken = wrap(plain, WIDTH) or [""]
            if text.startswith(" "):
                broken = [plain]
            lines += [f"{self.mark}{line}".rstrip() for line in broken]
        return [*lines, self.end] if self.end else lines


HASH = Comment("# ")
C = Comment(" * ", begin="/*", end=" */")
BANG = Comment("! ")
PERCENT = Comment("% ")
STARRED = Comment("   ", begin="(*", end="*)")
XML = Comment("  ", begin="<!--", end="-->")


def harmless(text: str, forbidden: tuple[str, ...] = ()) -> str:
    r"""A text that stays within any comment; ``forbidden`` are further pairs of signs to separate.

    >>> harmless("Größe */ int x; \\"), harmless("a-->b\n??/", ("--",))
    ('Grosse * / int x; /', 'a- ->b\\n? ?/')
    """
    plain = plain_line(printable(text).replace("ß", "ss"))
    for pair in (*_DANGEROUS, *forbidden):
        # twice, for three in a row
        for _ in range(2):
            plain = plain.replace(pair, f"{pair[0]} {pair[1]}")
    # a line of C that ends with it continues in the next one
    return plain[:-1] + "/" if plain.endswith("\\") else plain


def head(payload: Payload, *notes: str) -> list[str]:
    """No text from the method is in the first two lines, where Python looks for an encoding."""
    colours = counted(payload.size, "vector field")
    stages = ", ".join(map(str, payload.stages[payload.kind == "mri" :]))
    fields = f"stages {stages}" if payload.own else f"{colours}, stages {stages}"
    lines = [
        f"Written by gark {payload.version}.",
        f"A method for {problem_class(payload)}; {fields}.",
        f"Method: {payload.name}",
        f"Proved by gark: {payload.orders.sentence()}.",
    ]
    if payload.moved_within is not None:
        near = f"within {decimal(payload.moved_within)} of those of its file"
        lines.append(f"Numbers: {near}, with more digits, so that the orders hold.")
    if payload.reference:
        lines.append(f"Reference: {payload.reference}")
    return [*lines, *notes]


_CLASSES = {
    "rk": "y' = f(t, y)",
    "ark": "y' = {terms}, all at the same stages",
    "prk": "q' = f(q, p), p' = g(q, p)",
    "row": "y' = f(t, y) with its Jacobian, linearly implicit",
    "nystrom": "q'' = g(t, q, q')",
    "positions": "q'' = g(t, q)",
    "nprk": "y' = F(y, y), the two arguments at stages of their own",
    "derivatives": "y' = f(t, y) with derivatives of f along the solution",
    "gark": "y' = {terms}, each at stages of its own",
    "mri": "y' = {terms}, f1 fast and solved exactly",
}


def problem_class(payload: Payload) -> str:
    if payload.own is not None:
        is_in_positions = payload.kind == "nystrom" and "A" not in payload.own
        return _CLASSES["positions" if is_in_positions else payload.kind]
    if payload.kind == "prk" and payload.structure != "general":
        return _PARTS[payload.structure]
    if payload.tableau.is_partitioned and payload.kind != "prk":
        return "Hamiltonian problems that are split, a pair (q, p) a term"
    names = [f"f{l}(t, y)" for l in range(1, payload.size + 1)]
    terms = " + ".join(names) if len(names) < 4 else "f1(t, y) + ... + fN(t, y)"
    return _CLASSES[payload.kind].format(terms=terms)


_PARTS = {
    "separable": "q' = f(p), p' = g(q)",
    "semi-separable": "q' = f(q, p), p' = g(q)",
    "nystrom": "q' = p, p' = g(q)",
}
