"""What the failing conditions tell: the likely culprit, a possible repair, the error constants."""

from __future__ import annotations

from collections.abc import Sequence

from garkcli.check.explained import repair_text
from garkcli.order.blame import Blame
from garkcli.order.constants import ErrorConstants
from garkcli.order.suggestion import Misprint
from garkcli.page.paint import Paint, folded
from garkcli.report.check_orders import size
from garkcli.tableau.tableau import Tableau
from garkcli.trees.notation import format_tree

WIDTH = 80
_MARGIN = " " * 8
_CULPRIT = "takes part in every one of them: look there first"
_SHOWN_REPAIRS = 3


def blame_lines(blame: Blame, tableau: Tableau, paint: Paint) -> list[str]:
    """The hints for people; ``tableau`` is the method of the file."""
    own = [colour.name for colour in tableau.colours]
    names = blame.names or own
    has_colours = len(names) > 1
    letter = "Â" if blame.of == "conjugate-order" else "A"
    lines = [f"  {paint('note', 'hint')}: {_failing(blame, has_colours)}"]
    if blame.culprit is not None and has_colours:
        culprit = _blocks([blame.culprit], names, letter)
        lines.append(f"{_MARGIN}{culprit} {_CULPRIT}")
    elif len(blame.in_every) > 1:
        blocks = _blocks(blame.in_every, names, letter)
        lines.append(f"{_MARGIN}in every one of them: {blocks}")
    if blame.in_none:
        blocks = _blocks(blame.in_none, names, letter)
        lines.append(f"{_MARGIN}in none of them: {blocks}")
    for repair in blame.repairs[:_SHOWN_REPAIRS]:
        lines += _repair_lines("the claimed order", repair_text(repair, own))
        if repair == blame.repairs[0] and blame.restores:
            claims = ", ".join(blame.restores)
            lines.append(f"{_MARGIN}and so would {claims}")
    return lines


def _failing(blame: Blame, has_colours: bool) -> str:
    """How many conditions fail, of which order, and whether they couple colours."""
    text = (
        f"{blame.failing} of the {blame.total} conditions of order {blame.order} fail"
    )
    if blame.total == 1:
        text = f"the one condition of order {blame.order} fails"
    if blame.of != "order":
        text = f"{blame.of}: {text}"
    if blame.only_coupling and has_colours:
        text += ", all of them coupling conditions"
    return text


def misprint_lines(found: Misprint, tableau: Tableau, paint: Paint) -> list[str]:
    """Why no tolerance is proposed: an entry looks misprinted, and which."""
    names = [colour.name for colour in tableau.colours]
    residual, explained = size(found.residual), size(found.explained)
    hint = f"  {paint('note', 'hint')}:"
    small = f"up to order {found.order} the residuals are at most {residual}"
    known = f"the digits in the file explain {explained}"
    lines = [f"{hint} {small},", f"{_MARGIN}{known}: an entry looks misprinted"]
    for repair in found.repairs[:_SHOWN_REPAIRS]:
        text = repair_text(repair, names)
        lines += _repair_lines(f"order {found.order}", text)
    return lines


def _repair_lines(order: str, repair: str) -> list[str]:
    """What would mend the method, in one line where it fits and in two otherwise."""
    start = f"{_MARGIN}{order} would hold with"
    line = f"{start} {repair}"
    if len(line) <= WIDTH:
        return [line]
    return [start, f"{_MARGIN}  {repair}"]


def _blocks(
    blocks: Sequence[tuple[int, int]], names: Sequence[str], letter: str
) -> str:
    return ", ".join(f"{letter}{{{names[l]},{names[m]}}}" for l, m in blocks)


def constants_lines(constants: ErrorConstants, colours: bool) -> list[str]:
    """The error constants for people; ``colours`` where there are several, so that trees show
    theirs.
    """
    how = "exact" if constants.is_exact else "in floats"
    lines = [f"  error coefficients of order {constants.order} ({how})"]
    kinds = [("all trees", constants.all), ("coupling trees", constants.coupling)]
    if not colours:
        kinds = kinds[:1]
    for label, norms in kinds:
        trees = f"{norms.trees:>8} trees"
        sizes = f"2-norm {norms.two:.6g}   largest {norms.largest:.6g}"
        line = f"    {label:<15}{trees}   {sizes}"
        if norms.worst is None:
            lines.append(line)
            continue
        worst = f"at {format_tree(norms.worst, colours)}"
        if len(line) + 1 + len(worst) <= WIDTH:
            lines.append(f"{line} {worst}")
        else:
            lines.append(line)
            lines += folded(f"{_MARGIN}{worst}", WIDTH, f"{_MARGIN}   ")
    return lines
