"""The true claims of a method, as written under ``expect``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from garkcli.check.analysis import Analysis, AnyAnalysis
from garkcli.check.claims import claimed_text, found_value
from garkcli.exact.polynomial_text import root_decimal, root_text
from garkcli.frozen import Frozen
from garkcli.methodfile.expectations import CLAIMS, AtLeast
from garkcli.properties.registry import KEYS
from garkcli.properties.subject import find
from garkcli.properties.verdict import Size

ORDERS = (
    *("order", "conjugate-order", "pair-order", "symplectic", "embedded-order", "dense-order"),
    *("predictor-order", "predictor-order-equal-steps"),
)
OF_ROSENBROCK = (
    *("order", "w-order", "old-jacobian-order", "nonautonomous-order", "index-1-order"),
    *("embedded-order", "embedded-w-order", "dense-order"),
    *("a-stable", "l-stable"),
)
OF_NYSTROM = (
    *("order", "position-order", "velocity-order"),
    *("embedded-order", "embedded-position-order", "embedded-velocity-order"),
    *("dense-order", "dense-position-order", "dense-velocity-order"),
)
OF_INFINITESIMAL = ("order", "slow-order", "nonautonomous-order", "embedded-order")
OF_DERIVATIVES = ("order", "embedded-order", "a-stable", "l-stable")
OF_OTHER_KINDS = {
    "a Rosenbrock method": OF_ROSENBROCK,
    "a Nyström method": OF_NYSTROM,
    "a nonlinearly partitioned method": ("order", "embedded-order"),
    "a multiderivative method": OF_DERIVATIVES,
    "a multirate method with the exact fast part": OF_INFINITESIMAL,
}
DIGITS = 12
"""A decimal claims these digits only."""


class TrueClaims(Frozen):
    """True claims in YAML by key; those ``left`` do not apply or are undecided."""

    file: str
    claims: Mapping[str, str]
    left: tuple[str, ...]
    analysis: AnyAnalysis


def usual_keys(analysis: AnyAnalysis) -> list[str]:
    """Returns the claims that a file without any is given: orders, and properties that it has."""
    if not isinstance(analysis, Analysis):
        return [*true_claims(analysis, OF_OTHER_KINDS[analysis.kind])]
    keys = [*true_claims(analysis, ORDERS)]
    if analysis.inconsistent and analysis.nonautonomous_order is not None:
        keys.append("nonautonomous-order")
    for key in KEYS:
        if not find(key).is_cheap:
            continue
        if analysis.subject.verdict(key).value is True or key == "stage-order":
            keys.append(key)
    return keys


def true_claims(analysis: AnyAnalysis, keys: Iterable[str]) -> dict[str, str]:
    wanted = set(keys)
    claims = {}
    for key in CLAIMS:
        if key not in wanted:
            continue
        text = _text(key, analysis)
        if text is not None:
            claims[key] = text
    return claims


def _text(key: str, analysis: AnyAnalysis) -> str | None:
    if key in KEYS:
        verdict = analysis.subject.verdict(key)
        value = verdict.value
        if value is None:
            return None
        if isinstance(value, Size):
            if value.root is None or value.root.exact is not None:
                return str(value)
            return root_text(value.root) or root_decimal(value.root, DIGITS)
        if verdict.is_at_least and isinstance(value, int):
            return _written(AtLeast(value))
        return claimed_text(value)
    claimed = found_value(key, analysis)
    return None if claimed is None else _written(claimed)


def _written(value: object) -> str:
    """Returns a value in YAML, with quotes around ``>= 4``, which would begin a folded text."""
    if isinstance(value, list):
        return f"[{', '.join(map(_written, value))}]"
    text = claimed_text(value)
    return f'"{text}"' if isinstance(value, AtLeast) else text
