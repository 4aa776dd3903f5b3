"""Common parts of the LaTeX reports: the preamble, and a complete document."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

PREAMBLE = (
    r"\usepackage{amsmath,longtable,tikz}",
    r"\providecommand{\mathbbm}[1]{\mathbf{#1}} "
    r"% or \usepackage{bbm} for the paper's vector of ones",
)
"""The lines of the preamble that a report needs."""


def fragment(lines: Iterable[str], is_document: bool) -> Iterator[str]:
    """Yields the lines as a complete document, or with a comment about the preamble."""
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
