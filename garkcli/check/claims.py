"""The verification of the claims of a file."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from garkcli.check.analysis import Analysis, AnyAnalysis
from garkcli.frozen import Frozen
from garkcli.methodfile.description import ClaimText
from garkcli.methodfile.expectations import AtLeast, ClaimedNumber
from garkcli.properties.registry import KEYS
from garkcli.properties.verdict import NoProperties, Size, Verdict
from garkcli.reason import NO_REASON, Reason

if TYPE_CHECKING:
    from garkcli.check.order_facts import LinearSubject
    from garkcli.properties.subject import Subject


AnySubject: TypeAlias = "Subject | LinearSubject | NoProperties"


class Claim(Frozen):
    """A claim under ``expect`` and whether it holds.

    Attributes:
        claim: its key under ``expect``.
        expected: the claimed value as text.
        found: the actual value as text.
        holds: whether they agree; None if undecided.
        line: the line of the claim in the file, from 1.
        column: its column, from 1.
        reason: the reason against a property that is claimed.
    """

    claim: str
    expected: str
    found: str
    holds: bool | None
    line: int
    column: int
    reason: Reason = NO_REASON

    @property
    def why(self) -> str:
        """The reason as text."""
        return str(self.reason)


def verify(claims: tuple[ClaimText, ...], analysis: AnyAnalysis) -> tuple[Claim, ...]:
    return tuple(_held_against(claim, analysis) for claim in claims)


def _held_against(claim: ClaimText, analysis: AnyAnalysis) -> Claim:
    if claim.key in KEYS:
        return verify_property(claim, analysis.subject)
    value = found_value(claim.key, analysis)
    shown = claimed_text(value)
    if value is None:
        shown = f"none: {_why_none(claim.key, analysis)}"
    is_open = claim.key == "dense-smooth" and analysis.dense is not None and value is None
    return claim_of(claim, shown, None if is_open else agrees(claim.value, value))


def _why_none(key: str, analysis: AnyAnalysis) -> str:
    kind = getattr(analysis, "kind", "a GARK method")
    if key in OF_ROSENBROCK and kind != "a Rosenbrock method":
        return "it is not a Rosenbrock method"
    if key in OF_NYSTROM and kind != "a Nyström method":
        return "it is not a Nyström method"
    if key in OF_INFINITESIMAL and kind != "a multirate method with the exact fast part":
        return "it has no exact fast part"
    if key.startswith("embedded") and analysis.embedded is None:
        return "there are no embedded weights"
    if key.startswith("dense") and analysis.dense is None:
        return "there is no dense output"
    if key.startswith("predictor") and getattr(analysis, "predictor", None) is None:
        return "there is no predictor"
    if key in OF_DAE:
        several = analysis.tableau.size > 2
        return "it has several colours" if several else "alpha + gamma is singular"
    if key == "dense-smooth":
        return "not decided"
    if key.endswith("nonautonomous-order"):
        return "a vector field is linear, or nodes differ"
    return "a weight is zero" if isinstance(analysis, Analysis) else f"it is {kind}"


PLACES = {
    **{letter: f"simplifying.{letter}" for letter in "BCD"},
    "embedded-order": "embedded.order",
    "embedded-nonautonomous-order": "embedded.nonautonomous_order",
    "dense-order": "dense.order",
    "dense-continuous": "dense.ends_at_step",
    "dense-smooth": "dense.is_smooth",
    "predictor-order": "predictor.order",
    "predictor-order-equal-steps": "predictor.equal_steps",
    "dense-position-order": "dense.position_order",
    "dense-velocity-order": "dense.velocity_order",
}
"""The attributes of an analysis for claims with other names."""
_OF_DENSE_STEPS = ("dense-position-order", "dense-velocity-order")
OF_DENSE = ("dense-order", "dense-continuous", "dense-smooth", *_OF_DENSE_STEPS)
OF_DAE = ("index-1-order", "index-1-y-order", "index-1-z-order", "embedded-index-1-order")
OF_ROSENBROCK = (
    *("w-order", "old-jacobian-order", "embedded-w-order", "embedded-old-jacobian-order"),
    *OF_DAE,
)
OF_NYSTROM = (
    *("position-order", "velocity-order", "embedded-position-order", "embedded-velocity-order"),
    *_OF_DENSE_STEPS,
)
OF_INFINITESIMAL = ("slow-order",)


_OF_OTHERS = frozenset({*OF_ROSENBROCK, *OF_NYSTROM, *OF_INFINITESIMAL})


def found_value(key: str, analysis: AnyAnalysis) -> object:
    """Returns the value for a claim, None if not applicable."""
    value: Any = analysis
    if not isinstance(analysis, Analysis) and key not in OF_DENSE:
        view = analysis.view(key)
        value = None if view is None else view[0]
    elif isinstance(analysis, Analysis) and key in _OF_OTHERS:
        return None
    else:
        for name in PLACES.get(key, key.replace("-", "_")).split("."):
            value = value and getattr(value, name, None)
    if hasattr(value, "is_lower_bound"):
        # an order at which nothing is known to fail is at least that large, no more
        return AtLeast(value.order) if value.is_lower_bound else value.order
    return capped(value, analysis.limit)


def verify_property(claim: ClaimText, subject: AnySubject) -> Claim:
    verdict = subject.verdict(claim.key)
    return claim_of(claim, _value_text(verdict), _holds(claim, verdict, subject), verdict.reason)


def _value_text(verdict: Verdict) -> str:
    if verdict.value is None:
        return "not decided" if verdict.is_undecided else "no meaning"
    if verdict.is_at_least:
        return f">= {verdict.value}"
    return claimed_text(verdict.value)


def _holds(claim: ClaimText, verdict: Verdict, subject: AnySubject) -> bool | None:
    value, wanted = verdict.value, claim.value
    if verdict.is_undecided:
        return None
    if isinstance(value, Size):
        return isinstance(wanted, ClaimedNumber) and wanted.agrees(value.root, subject.rounding)
    if verdict.is_at_least and isinstance(value, int):
        return agrees(wanted, AtLeast(value))
    return agrees(wanted, value)


def claim_of(claim: ClaimText, value: str, holds: bool | None, reason: Reason = NO_REASON) -> Claim:
    mark = claim.node.start_mark
    return Claim(
        claim=claim.key,
        expected=claimed_text(claim.value),
        found=value,
        holds=holds,
        line=mark.line + 1,
        column=mark.column + 1,
        reason=NO_REASON if holds else reason,
    )


def agrees(wanted: object, value: object) -> bool | None:
    """Returns whether a claimed value agrees with an actual one; None if a lower bound decides
    nothing.

    >>> agrees(AtLeast(3), 4), agrees(3, AtLeast(4)), agrees(5, AtLeast(4))
    (True, False, None)
    """
    if isinstance(wanted, list):
        if not isinstance(value, list) or len(value) != len(wanted):
            return False
        answers = [agrees(x, y) for x, y in zip(wanted, value, strict=True)]
        return False if False in answers else None if None in answers else True
    if isinstance(value, AtLeast):
        least = wanted.least if isinstance(wanted, AtLeast) else wanted
        if not isinstance(least, int):
            return False
        if isinstance(wanted, AtLeast) and value.least >= least:
            return True
        return None if least >= value.least else False
    if isinstance(wanted, AtLeast):
        return isinstance(value, int) and value >= wanted.least
    return type(wanted) is type(value) and wanted == value


def capped(value: object, limit: int) -> object:
    if isinstance(value, (list, tuple)):
        return [capped(x, limit) for x in value]
    is_number = isinstance(value, int) and not isinstance(value, bool)
    return AtLeast(limit) if is_number and value == limit else value


def claimed_text(value: object) -> str:
    if isinstance(value, (list, tuple)):
        inside = ", ".join(claimed_text(x) for x in value)
        return f"[{inside}]"
    if value is None:
        return "null"
    if isinstance(value, bool):
        return str(value).lower()
    return str(value)
