"""``gark check --baseline``: what got worse, for people."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.check.baseline import Regression
from garkcli.page.plain import inert, printable


def render(found: Sequence[Regression], files: int) -> str:
    """A line for each regression, then how many of how many files."""
    lines = [
        printable(f"{x.file}: {x.what} got worse: {x.before} -> {x.now}") for x in found
    ]
    lines.append(
        f"{files} file{'s' * (files != 1)}: {len(found) or 'nothing'} got worse"
    )
    return inert("\n".join(lines)) + "\n"
