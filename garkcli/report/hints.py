"""What the failing conditions tell: the likely culprit, a possible repair, the error constants."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from flint import arb

from garkcli.check.explained import repair_text
from garkcli.check.outcome import Outcome
from garkcli.exact.display import to_text
from garkcli.order.blame import Blame, Repair
from garkcli.order.constants import ErrorConstants, Norms
from garkcli.order.suggestion import Misprint
from garkcli.report.paint import Paint
from garkcli.tableau.tableau import Tableau
from garkcli.trees.notation import format_tree


def blame_lines(blame: Blame, tableau: Tableau, paint: Paint) -> list[str]:
    """The hints for people; ``tableau`` is the method of the file."""
    own = [colour.name for colour in tableau.colours]
    names = blame.names or own
    letter = "Â" if blame.of == "conjugate-order" else "A"
    failing = (
        f"{blame.failing} of the {blame.total} conditions of order {blame.order} fail"
    )
    if blame.total == 1:
        failing = f"the one condition of order {blame.order} fails"
    if blame.of != "order":
        failing = f"{blame.of}: {failing}"
    coupling = (
        ", all of them coupling conditions"
        if blame.only_coupling and len(names) > 1
        else ""
    )
    lines = [f"  {paint('note', 'hint')}: {failing}{coupling}"]
    if blame.culprit is not None and len(names) > 1:
        culprit = _block(blame.culprit, names, letter)
        lines.append(
            f"        {culprit} takes part in every one of them: look there first"
        )
    elif len(blame.in_every) > 1:
        lines.append(
            f"        in every one of them: {_blocks(blame.in_every, names, letter)}"
        )
    if blame.in_none:
        lines.append(
            f"        in none of them: {_blocks(blame.in_none, names, letter)}"
        )
    lines += [
        f"        the claimed order would hold with {repair_text(repair, own)}"
        for repair in blame.repairs[:3]
    ]
    return lines


def misprint_lines(found: Misprint, tableau: Tableau, paint: Paint) -> list[str]:
    """Why no tolerance is proposed: an entry looks misprinted, and which."""
    names = [colour.name for colour in tableau.colours]
    residual, explained = size(found.residual), size(found.explained)
    lines = [
        f"  {paint('note', 'hint')}: up to order {found.order} the residuals are at most {residual}: "
        f"an entry looks misprinted",
        f"        the digits in the file explain {explained}",
    ]
    lines += [
        f"        order {found.order} would hold with {repair_text(repair, names)}"
        for repair in found.repairs[:3]
    ]
    return lines


def size(ball: arb) -> str:
    """A bound in two digits."""
    return "0" if ball == 0 else ball.upper().str(2, radius=False)


def _block(block: tuple[int, int], names: Sequence[str], letter: str = "A") -> str:
    return f"{letter}{{{names[block[0]]},{names[block[1]]}}}"


def _blocks(
    blocks: Sequence[tuple[int, int]], names: Sequence[str], letter: str
) -> str:
    return ", ".join(_block(block, names, letter) for block in blocks)


def constants_lines(constants: ErrorConstants, colours: bool) -> list[str]:
    """The error constants for people; ``colours`` where there are several, so that trees show
    theirs.
    """
    how = "exact" if constants.is_exact else "in floats"
    lines = [f"  error coefficients of order {constants.order} ({how})"]
    kinds = [("all trees", constants.all), ("coupling trees", constants.coupling)]
    for label, norms in kinds if colours else kinds[:1]:
        worst = (
            "" if norms.worst is None else f" at {format_tree(norms.worst, colours)}"
        )
        lines.append(
            f"    {label:<15}{norms.trees:>8} trees   2-norm {norms.two:.6g}   largest {norms.largest:.6g}{worst}"
        )
    return lines


def hints_data(outcome: Outcome) -> dict[str, Any]:
    """Blame and error constants for machines; only what there is."""
    data: dict[str, Any] = {}
    blame, constants = outcome.blame, outcome.constants
    if blame is not None:
        data["blame"] = {
            "of": blame.of,
            "order": blame.order,
            "failing": blame.failing,
            "conditions": blame.total,
            "only_coupling": blame.only_coupling,
            "culprit": None
            if blame.culprit is None
            else [k + 1 for k in blame.culprit],
            "in_every": [[l + 1, m + 1] for l, m in blame.in_every],
            "in_none": [[l + 1, m + 1] for l, m in blame.in_none],
            "repairs": [_repair(repair) for repair in blame.repairs],
        }
    misprint = outcome.analysis.misprint if outcome.analysis else None
    if misprint is not None:
        data["misprint"] = {
            "order": misprint.order,
            "residual": float(misprint.residual.upper()),
            "explained": float(misprint.explained.upper()),
            "repairs": [_repair(repair) for repair in misprint.repairs],
        }
    if constants is not None:
        data["error_constants"] = {
            "order": constants.order,
            "exact": constants.is_exact,
            "all": _norms(constants.all),
            "coupling": _norms(constants.coupling),
        }
    return data


def _repair(repair: Repair) -> dict[str, Any]:
    weights = repair.m is None or repair.i is None
    place = {
        "b" if weights else "A": [repair.l + 1]
        if repair.m is None
        else [repair.l + 1, repair.m + 1],
        "row": None if repair.i is None else repair.i + 1,
        "entry": repair.j + 1,
    }
    return {**place, "old": to_text(repair.old), "new": to_text(repair.new)}


def _norms(norms: Norms) -> dict[str, Any]:
    return {
        "trees": norms.trees,
        "two_norm_squared": None
        if norms.two_squared is None
        else to_text(norms.two_squared),
        "two_norm": norms.two,
        "inf_norm": norms.largest,
        "worst": None if norms.worst is None else format_tree(norms.worst),
        "worst_value": None
        if norms.worst_value is None
        else to_text(norms.worst_value),
    }
