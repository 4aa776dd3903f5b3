"""What R(z) decides of a method that is no Runge–Kutta method, in ``gark check``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from garkcli.tell import kinds
from garkcli.tell.facts import Answer, Level, Row, Status, maybe, optional
from garkcli.tell.parts import told

if TYPE_CHECKING:
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


def _truth(key: str) -> Row:
    """A property that R(z) decides."""

    def get(a: Any) -> Answer:
        v = a.subject.verdict(key)
        return Answer(v.value, Status(open=v.reason) if v.is_undecided else Status(), v.reason)

    return maybe(key.replace("-", "_"), kinds.TRUTH, get, DATA)


def _stability_words(a: Any, d: Plain) -> str:
    """``A-stable, R(∞) = 0``."""
    words = []
    for key, name in (("a-stable", "A-stable"), ("l-stable", "L-stable")):
        v = a.subject.verdict(key)
        if v.is_undecided:
            words.append(f"{name} not decided: {d.reason(v.reason)}")
        else:
            words.append(d.known(name if v.value else f"not {name}", Status(a.tolerance)))
            if not v.value and key == "a-stable":
                words[-1] += f": {d.reason(v.reason)}" if v.reason else ""
                break
    limit = a.subject.at_infinity
    if limit is not None and limit:
        words.append(f"{d.prose('R(∞)')} = {d.number(limit)}")
    return ", ".join(words)


STABILITY = (
    Row("stability", told(_stability_words), "."),
    _truth("a-stable"),
    _truth("l-stable"),
    maybe("R_infinity", kinds.EXACT, "subject.at_infinity", DATA),
    optional(
        "R",
        kinds.ratio("z"),
        lambda a: None if a.tolerance else a.subject.on_linear_problems.linear,
        DETAIL,
        label="R(z)",
    ),
)
"""The rows of an analysis whose ``subject`` is a ``LinearSubject``."""
