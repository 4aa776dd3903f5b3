"""What the failing conditions tell: the likely culprit, a possible repair, the error constants."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap

from garkcli.check.explained import repair_text
from garkcli.order.blame import Blame
from garkcli.order.constants import ErrorConstants, Norms
from garkcli.order.suggestion import Misprint
from garkcli.page.paint import Paint, folded, indented
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
    hint = paint("note", "hint")
    failing = _failing(blame, has_colours)
    suspects = _suspects(blame, names)
    first, *further = _wrapped(failing)
    lines = [f"  {hint}: {first}"]
    lines += indented(further, _MARGIN)
    for text in suspects:
        lines += indented(_wrapped(text), _MARGIN)
    for place, repair in enumerate(blame.repairs[:_SHOWN_REPAIRS]):
        text = repair_text(repair, own)
        lines += _repair_lines("the claimed order", text)
        if place == 0 and blame.restores:
            claims = ", ".join(blame.restores)
            lines += indented(_wrapped(f"and so would {claims}"), _MARGIN)
    return lines


def _wrapped(text: str) -> list[str]:
    """A sentence in lines that fit behind the margin."""
    width = WIDTH - len(_MARGIN)
    return wrap(text, width, subsequent_indent="  ", break_on_hyphens=False)


def _suspects(blame: Blame, names: Sequence[str]) -> list[str]:
    """Which blocks take part in all conditions that fail, and which in none."""
    letter = "Â" if blame.of == "conjugate-order" else "A"
    culprits = [] if blame.culprit is None else [blame.culprit]
    culprit = _blocks(culprits, names, letter)
    in_every = _blocks(blame.in_every, names, letter)
    in_none = _blocks(blame.in_none, names, letter)
    texts = []
    if culprit and len(names) > 1:
        texts.append(f"{culprit} {_CULPRIT}")
    elif len(blame.in_every) > 1:
        texts.append(f"in every one of them: {in_every}")
    if in_none:
        texts.append(f"in none of them: {in_none}")
    return texts


def _failing(blame: Blame, has_colours: bool) -> str:
    """How many conditions fail, of which order, and whether they couple colours."""
    how_many = f"{blame.failing} of the {blame.total}"
    text = f"{how_many} conditions of order {blame.order} fail"
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
    residual = size(found.residual)
    explained = size(found.explained)
    order = f"order {found.order}"
    hint = paint("note", "hint")
    small = f"up to {order} the residuals are at most {residual}"
    known = f"the digits in the file explain {explained}"
    lines = [f"  {hint}: {small},"]
    lines.append(f"{_MARGIN}{known}: an entry looks misprinted")
    for repair in found.repairs[:_SHOWN_REPAIRS]:
        text = repair_text(repair, names)
        lines += _repair_lines(order, text)
    return lines


def _repair_lines(order: str, repair: str) -> list[str]:
    """What would mend the method, in one line where it fits and in two or three otherwise."""
    start = f"{_MARGIN}{order} would hold with"
    line = f"{start} {repair}"
    if len(line) <= WIDTH:
        return [line]
    inner = f"{_MARGIN}  "
    line = f"{inner}{repair}"
    if len(line) <= WIDTH:
        return [start, line]
    new, instead, old = line.partition(" instead of ")
    joint = instead.lstrip()
    return [start, new, f"{inner}{joint}{old}"]


def _blocks(blocks: Sequence[tuple[int, int]], names: Sequence[str], letter: str) -> str:
    found = []
    for l, m in blocks:
        row = names[l]
        column = names[m]
        colours = f"{row},{column}"
        found.append(f"{letter}{{{colours}}}")
    return ", ".join(found)


def constants_lines(constants: ErrorConstants, colours: bool) -> list[str]:
    """The error constants for people; ``colours`` where there are several, so that trees show
    theirs.
    """
    how = "exact" if constants.is_exact else "in floats"
    lines = [f"  error coefficients of order {constants.order} ({how})"]
    lines += _norm_lines("all trees", constants.all, colours)
    if colours:
        lines += _norm_lines("coupling trees", constants.coupling, colours)
    return lines


def _norm_lines(label: str, norms: Norms, colours: bool) -> list[str]:
    """The norms over some trees, and the tree of the largest coefficient."""
    trees = f"{norms.trees:>8} trees"
    sizes = f"2-norm {norms.two:.6g}   largest {norms.largest:.6g}"
    line = f"    {label:<15}{trees}   {sizes}"
    if norms.worst is None:
        return [line]
    tree = format_tree(norms.worst, colours)
    whole = f"{line} at {tree}"
    if len(whole) <= WIDTH:
        return [whole]
    below = folded(f"{_MARGIN}at {tree}", WIDTH, f"{_MARGIN}   ")
    return [line, *below]
