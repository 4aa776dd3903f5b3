"""What the LaTeX reports share: the preamble they need, and a complete document that
compiles.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

PREAMBLE = (
    r"\usepackage{amsmath,longtable,tikz}",
    r"\providecommand{\mathbbm}[1]{\mathbf{#1}} "
    r"% or \usepackage{bbm} for the paper's vector of ones",
)
"""What a document needs that includes a report."""


def fragment(lines: Iterable[str], is_document: bool) -> Iterator[str]:
    """The lines as a document of their own, or to be included in one whose preamble they name."""
    if is_document:
        yield "\\documentclass{article}\n"
        yield from (line + "\n" for line in PREAMBLE)
        yield "\\usepackage[margin=2cm]{geometry}\n\\begin{document}\n"
        yield from lines
        yield "\\end{document}\n"
        return
    yield "% the preamble needs\n"
    yield from (f"%   {line}\n" for line in PREAMBLE)
    yield from lines
