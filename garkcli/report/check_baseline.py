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
        line = f"{x.file}: {x.what} got worse: {change}"
        lines.append(printable(line))
    how_many = str(len(found) or "nothing")
    of_these = counted(files, "file")
    lines.append(f"{of_these}: {how_many} got worse")
    text = "\n".join(lines)
    return inert(text) + "\n"
