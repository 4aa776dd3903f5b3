"""What a file may claim of a method, and be right: the truth as it is written under ``expect``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from garkcli.check.analysis import Analysis
from garkcli.check.claims import AnyAnalysis, claimed_text, found_value
from garkcli.exact.polynomial_text import root_decimal, root_text
from garkcli.frozen import Frozen
from garkcli.methodfile.expectations import CLAIMS, AtLeast
from garkcli.properties.property import Size
from garkcli.properties.registry import KEYS, find

ORDERS = ("order", "conjugate-order", "pair-order", "symplectic", "embedded-order", "dense-order")
"""What is always worth claiming."""
OF_ROSENBROCK = (
    *("order", "w-order", "old-jacobian-order", "nonautonomous-order", "index-1-order"),
    *("embedded-order", "embedded-w-order", "dense-order"),
    *("a-stable", "l-stable"),
)
"""The same of Rosenbrock methods."""
OF_NYSTROM = (
    *("order", "position-order", "velocity-order"),
    *("embedded-order", "embedded-position-order", "embedded-velocity-order"),
    *("dense-order", "dense-position-order", "dense-velocity-order"),
)
"""Claims on the orders of Nyström methods."""
OF_INFINITESIMAL = ("order", "slow-order", "nonautonomous-order", "embedded-order")
"""The same of multirate methods with the exact fast solution."""
OF_DERIVATIVES = ("order", "embedded-order", "a-stable", "l-stable")
"""The same of methods that use derivatives."""
OF_OTHER_KINDS = {
    "a Rosenbrock method": OF_ROSENBROCK,
    "a Nyström method": OF_NYSTROM,
    "a nonlinearly partitioned method": ("order", "embedded-order"),
    "a multiderivative method": OF_DERIVATIVES,
    "a multirate method with the exact fast part": OF_INFINITESIMAL,
}
"""Claims on the orders of methods that are no GARK methods, by kind."""
DIGITS = 12
"""Of numbers without simple radicals; a decimal claims no further ones."""


class TrueClaims(Frozen):
    """What may be claimed of one method.

    Attributes:
        file: its path as given.
        claims: values as they are written in YAML, by key.
        left: what was requested and has no meaning for the method, or is not decided.
        analysis: that decides them.
    """

    file: str
    claims: Mapping[str, str]
    left: tuple[str, ...]
    analysis: AnyAnalysis


def usual_keys(analysis: AnyAnalysis) -> list[str]:
    """The claims that a file without any is given: orders, whether it is symplectic, its stage
    order, and those properties that a plain check decides and that it has.
    """
    if not isinstance(analysis, Analysis):
        return [*true_claims(analysis, OF_OTHER_KINDS[analysis.kind])]
    found = [*true_claims(analysis, ORDERS)]
    if analysis.inconsistent and analysis.nonautonomous_order is not None:
        found.append("nonautonomous-order")
    for key in KEYS:
        if not find(key).is_cheap:
            continue
        if analysis.subject.verdict(key).value is True or key == "stage-order":
            found.append(key)
    return found


def true_claims(analysis: AnyAnalysis, keys: Iterable[str]) -> dict[str, str]:
    """The truth of some claims, each as it is written in YAML.

    Args:
        analysis: of a method.
        keys: of claims; one without a meaning for the method, or that is not decided, is left out.

    Returns:
        Texts by key, in the order of the documentation.
    """
    wanted = set(keys)
    found = {}
    for key in CLAIMS:
        if key not in wanted:
            continue
        text = _text(key, analysis)
        if text is not None:
            found[key] = text
    return found


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
    found = found_value(key, analysis)
    return None if found is None else _written(found)


def _written(value: object) -> str:
    """A value in YAML; ``>= 4`` would begin a folded text there, so it is in quotes."""
    if isinstance(value, list):
        return f"[{', '.join(map(_written, value))}]"
    text = claimed_text(value)
    return f'"{text}"' if isinstance(value, AtLeast) else text
