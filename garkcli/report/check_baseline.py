"""``gark check --baseline``: what got worse, for people."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.check.baseline import Regression
from garkcli.page.paint import counted
from garkcli.page.plain import inert, printable


def render(found: Sequence[Regression], files: int) -> str:
    """A line for each regression, then how many of how many files."""
    lines = []
    for x in found:
        change = f"{x.before} -> {x.now}"
        lines.append(printable(f"{x.file}: {x.what} got worse: {change}"))
    how_many = str(len(found) or "nothing")
    lines.append(f"{counted(files, 'file')}: {how_many} got worse")
    return inert("\n".join(lines)) + "\n"
