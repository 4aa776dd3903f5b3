"""What R(z) decides of a method that is no Runge–Kutta method, in ``gark check``."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from garkcli.tell import kinds
from garkcli.tell.facts import Answer, Level, Row, Rows, Status, maybe, optional
from garkcli.tell.parts import told

if TYPE_CHECKING:
    from flint import fmpq

    from garkcli.check.order_facts import LinearSubject
    from garkcli.tell.dialect import Plain

HEADLINE, USUAL, DETAIL, DATA = Level


class OnLinearProblems(Protocol):
    """An analysis whose subject is a ``LinearSubject``."""

    @property
    def subject(self) -> LinearSubject:
        """Decides properties by R(z)."""

    @property
    def tolerance(self) -> fmpq | None:
        """The rounding of the coefficients."""


def _truth(key: str) -> Row[OnLinearProblems]:
    """A property that R(z) decides."""

    def get(a: OnLinearProblems) -> Answer[bool]:
        v = a.subject.verdict(key)
        assert v.value is None or isinstance(v.value, bool)
        return Answer(v.value, Status(open=v.reason) if v.is_undecided else Status(), v.reason)

    return maybe(key.replace("-", "_"), kinds.TRUTH, get, DATA)


def _stability_words(a: OnLinearProblems, d: Plain) -> str:
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


STABILITY: Rows[OnLinearProblems] = (
    Row("stability", told(_stability_words), lambda a: a),
    _truth("a-stable"),
    _truth("l-stable"),
    maybe("R_infinity", kinds.EXACT, lambda a: a.subject.at_infinity, DATA),
    optional(
        "R",
        kinds.ratio("z"),
        lambda a: None if a.tolerance else a.subject.on_linear_problems.linear,
        DETAIL,
        label="R(z)",
    ),
)
