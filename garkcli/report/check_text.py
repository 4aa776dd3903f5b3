"""``gark check`` for people."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap
from typing import TYPE_CHECKING

from flint import arb, fmpq

from garkcli.check.analysis import Analysis, AnyOrder
from garkcli.check.outcome import Claim, Outcome
from garkcli.errors import excerpt
from garkcli.exact.display import decimal, to_decimal, to_text
from garkcli.order.certificate import Order, Witness
from garkcli.order.nonautonomous import with_time
from garkcli.order.simplifying import Simplifying
from garkcli.report.paint import Paint, aligned, beside
from garkcli.report.plain import inert, printable
from garkcli.tableau.tableau import Tableau
from garkcli.trees.drawing import draw_text
from garkcli.trees.notation import format_tree

if TYPE_CHECKING:
    from garkcli.order.rounded import RoundedOrder
    from garkcli.order.suggestion import Suggestion

_LABEL = 17


def render(outcomes: Sequence[Outcome], paint: Paint, verbosity: int = 0) -> str:
    """The report on some files.

    Args:
        outcomes: what was found.
        paint: colour or none.
        verbosity: −1 shows faults and failed claims only; 0 one file in full, several a line each;
            1 all in full.
    """
    full = verbosity > 0 or (len(outcomes) == 1 and verbosity == 0)
    blocks = [_outcome(outcome, paint, full, verbosity < 0) for outcome in outcomes]
    text = ("\n\n" if full else "\n").join(block for block in blocks if block)
    if len(outcomes) > 1 and verbosity >= 0:
        text += "\n\n" + _summary(outcomes, paint)
    return inert(text) + "\n" if text else ""


def _outcome(outcome: Outcome, paint: Paint, full: bool, quiet: bool) -> str:
    if outcome.analysis is None:
        return faults_text(outcome, paint)
    if full:
        return "\n".join(_full(outcome, outcome.analysis, paint))
    lines = [] if quiet and outcome.ok else [_line(outcome, outcome.analysis, paint)]
    lines += [_claim(outcome, claim, paint) for claim in outcome.failed_claims]
    lines += _missing(outcome, paint)
    if outcome.blame is not None:
        from garkcli.report.hints import blame_lines

        lines += blame_lines(outcome.blame, outcome.analysis.tableau, paint)
    return "\n".join(lines)


def _summary(outcomes: Sequence[Outcome], paint: Paint) -> str:
    failed = sum(not outcome.ok for outcome in outcomes)
    claims = sum(len(outcome.claims) for outcome in outcomes)
    text = f"{len(outcomes)} files, {claims} claim{'s' * (claims != 1)}: "
    text += paint.verdict(
        not failed, "all hold", f"{failed} file{'s' * (failed > 1)} failed"
    )
    silent = sum(outcome.makes_no_claim for outcome in outcomes)
    return f"{text}; {no_claims(silent)}" if silent else text


def no_claims(files: int) -> str:
    """How many files make no claim."""
    return f"{files} file{'s' * (files != 1)} make{'s' * (files == 1)} no claim"


def faults_text(outcome: Outcome, paint: Paint) -> str:
    """Every fault of a file that cannot be read, with a caret under the text."""
    source = outcome.text.splitlines()
    lines: list[str] = []
    for fault in outcome.faults:
        file = printable(outcome.file)
        place = f"{file}:{fault.line}:{fault.column}" if fault.line else file
        lines.append(f"{place}: {paint('bad', 'error')}: {printable(fault.message)}")
        if 0 < fault.line <= len(source):
            shown = source[fault.line - 1]
            lines += excerpt(shown, fault.line, fault.column, paint("bad", "^"))
        if fault.help:
            lines.append(f"      {paint('note', 'help')}: {printable(fault.help)}")
    return "\n".join(lines)


def _line(outcome: Outcome, analysis: Analysis, paint: Paint) -> str:
    mark = paint.verdict(outcome.ok, "ok  ", "FAIL")
    found = [f"order {_number(analysis.order)}"]
    if analysis.pair_order is not None and not analysis.tableau.is_partitioned:
        found.append(f"pair {_number(analysis.pair_order)}")
    claims = f"{len(outcome.claims)} claim{'s' * (len(outcome.claims) != 1)}"
    return f"{mark} {printable(outcome.file)}: {', '.join(found)}  ({claims})"


def _number(order: AnyOrder) -> str:
    return f"at least {order.order}" if order.is_lower_bound else str(order.order)


def _full(outcome: Outcome, analysis: Analysis, paint: Paint) -> list[str]:
    tableau = analysis.tableau
    file = printable(outcome.file)
    title = (
        file if outcome.name == outcome.file else f"{file}: {printable(outcome.name)}"
    )
    kind = wrap(_kind(tableau, outcome.structure, analysis.tolerance), 78)
    lines = [paint("strong", title), *(f"  {line}" for line in kind), ""]
    lines += _orders(analysis, paint)
    if analysis.suggestion is not None:
        lines += _suggested(analysis.suggestion, analysis.tolerance, paint)
    if analysis.misprint is not None:
        from garkcli.report.hints import misprint_lines

        lines += misprint_lines(analysis.misprint, tableau, paint)
    lines += ["", *_conditions(analysis)]
    lines += ["", *_properties(analysis, paint)]
    if outcome.constants is not None:
        from garkcli.report.hints import constants_lines

        lines += ["", *constants_lines(outcome.constants, tableau.size > 1)]
    if _missing(outcome, paint):
        lines += ["", *_missing(outcome, paint)]
    if outcome.claims:
        lines += ["", *(_claim(outcome, claim, paint) for claim in outcome.claims)]
    if outcome.blame is not None:
        from garkcli.report.hints import blame_lines

        lines += ["", *blame_lines(outcome.blame, tableau, paint)]
    return lines


def _kind(tableau: Tableau, structure: str, tolerance: fmpq | None) -> str:
    if tableau.is_partitioned:
        counts = [(part, tableau.stages_of(part)) for part in ("q", "p")]
        stages = ", ".join(
            f"{part}: {' + '.join(map(str, count))}" for part, count in counts
        )
    else:
        stages = ", ".join(str(tableau.space(l).stages) for l in range(tableau.size))
    colours = "1 colour" if tableau.size == 1 else f"{tableau.size} colours"
    domain = (
        "rational arithmetic"
        if tableau.degree == 1
        else f"a number field of degree {tableau.degree}"
    )
    special = "" if structure == "general" else f"for {structure} problems; "
    how = (
        f"decided in {domain}" if tolerance is None else f"within {decimal(tolerance)}"
    )
    return f"{special}{colours}, stages {stages}; {how}"


def _orders(analysis: Analysis, paint: Paint) -> list[str]:
    lines: list[str] = []
    shown: list[Witness] = []
    for label, order, tableau in (
        ("order", analysis.order, analysis.tableau),
        ("conjugate order", analysis.conjugate_order, analysis.conjugate),
        ("pair order", analysis.pair_order, analysis.pair),
    ):
        if order is None or tableau is None:
            lines += [f"  {label:{_LABEL}}none", f"      {analysis.obstacle}"]
            continue
        lines += _order(label, order, tableau, paint, shown)
    timed = analysis.nonautonomous_order
    if timed is not None and timed.order < analysis.order.order:
        lines += _nonautonomous(analysis, timed, paint, shown)
    return lines


def _nonautonomous(
    analysis: Analysis, order: AnyOrder, paint: Paint, shown: list[Witness]
) -> list[str]:
    """The order on y' = f(t, y), as the nodes are not the row sums."""
    timed = with_time(analysis.tableau)
    if timed is None:
        return []
    lines = _order("non-autonomous", order, timed, paint, shown)
    return [
        *lines,
        f"      for y' = f(t, y) with the nodes as printed; colour {timed.size} is time",
    ]


def _order(
    label: str, order: AnyOrder, tableau: Tableau, paint: Paint, shown: list[Witness]
) -> list[str]:
    """An order with its witness, drawn unless the same failure was shown before."""
    head = f"  {label:{_LABEL}}{paint('strong', _number(order))}"
    if not isinstance(order, Order):
        head += f"   within {decimal(order.tolerance)}, residuals up to {_size(order.largest_residual)}"
    witness = order.witness
    if not isinstance(order, Order) and order.undecided:
        return _undecided(head, order)
    if witness is None:
        return [
            f"{head}   every condition up to order {order.order} holds; no further was looked"
        ]
    if witness in shown:
        return [f"{head}   fails at order {witness.tree.order}, as above"]
    shown.append(witness)
    colours = tableau.size > 1
    tree = format_tree(witness.tree, colours)
    text = [
        f"fails at order {witness.tree.order}: {tree}",
        *_residual(witness),
        *_legend(witness, tableau),
    ]
    picture = draw_text(witness.tree, colours, width=30)
    if max(len(line) for line in text) + max(len(line) for line in picture) < 74:
        text = beside(text, picture)
    return [head, *(paint.dots(f"      {line}") for line in text)]


def _undecided(head: str, order: RoundedOrder) -> list[str]:
    """What is left open, and why."""
    next_order, doubt = order.order + 1, order.doubt
    if doubt is None:
        return [f"{head}; order {next_order} is too much to decide"]
    why = "a weight may be zero within it"
    if doubt.effect is not None:
        why = f"rounding may make up to {_size(doubt.effect)} of that"
    reached = (
        f"order {next_order} is not decided: residuals reach {_size(doubt.reached)}"
    )
    return [head, f"      {reached}, {why}"]


def _suggested(found: Suggestion, tolerance: fmpq | None, paint: Paint) -> list[str]:
    """The coefficients look rounded, or more so than they say: what to write into the file."""
    if tolerance is not None:
        return [
            f"  {paint('note', 'hint')}: rounding by {decimal(tolerance)} makes residuals up to "
            f"{_size(found.rounding)}: the tolerance is too tight;",
            f"        with the line  {found.line}  the order is {found.order}",
        ]
    return [
        f"  {paint('note', 'hint')}: up to order {found.order} the residuals are at most {_size(found.rounding)}, "
        f"then {_size(found.genuine)}:",
        f"        the coefficients look rounded; with the line  {found.line}  the order is {found.order}",
    ]


def _size(ball: arb) -> str:
    """A bound in two digits."""
    return "0" if ball == 0 else ball.upper().str(2, radius=False)


def _legend(witness: Witness, tableau: Tableau) -> list[str]:
    """What the numbers of the colours mean, where colours have other names."""
    named = [
        f"{l + 1} is {tableau.colours[l].name}" for l in sorted(witness.tree.colours)
    ]
    plain = all(colour.name == str(l + 1) for l, colour in enumerate(tableau.colours))
    return [] if plain else [f"colour {', '.join(named)}"]


def _residual(witness: Witness) -> list[str]:
    value, residual = to_text(witness.value), to_text(witness.residual)
    if len(value) > 60 or len(residual) > 60:
        value, residual, required = (
            to_decimal(witness.value, 8),
            to_decimal(witness.residual, 4),
            witness.required,
        )
        shown = (
            required if len(str(required)) <= 60 else f"about {to_decimal(required, 8)}"
        )
        return [f"about {value} instead of {shown}, off by {residual}"]
    if len(value) + len(residual) < 50:
        return [f"{value} instead of {witness.required}, off by {residual}"]
    return [f"value    {value}", f"required {witness.required}", f"residual {residual}"]


def _conditions(analysis: Analysis) -> list[str]:
    found = analysis.simplifying
    limit = analysis.limit
    rows = [f"  {'B(r)':{_LABEL}}{'  '.join(_capped(x, limit) for x in found.B)}"]
    for label, table in (("C(eta)", found.C), ("D(zeta)", found.D)):
        cells = [
            ["-" if x is None else _capped(x, limit) for x in row] for row in table
        ]
        rows += [
            f"  {label if i == 0 else '':{_LABEL}}{line}"
            for i, line in enumerate(aligned(cells))
        ]
    rows += _bound("bound", found, analysis.bound)
    both = analysis.pair_simplifying
    if both is not None and both is not found and analysis.pair_bound is not None:
        rows += _bound("pair bound", both, analysis.pair_bound)
    return rows


def _capped(number: int, limit: int) -> str:
    return f">={number}" if number >= limit else str(number)


def _bound(label: str, found: Simplifying, bound: int) -> list[str]:
    """The bound with its formula; within a tolerance residuals may not bear out what that gives."""
    r, eta, zeta, xi = found.r, found.eta, found.zeta, found.xi
    formula = f"min{{r, 2η+2, ξ+1, η+ζ+1}}   r = {r}, η = {eta}, ζ = {zeta}, ξ = {xi}"
    if bound == found.bound:
        return [f"  {label:{_LABEL}}{bound} = {formula}"]
    return [
        f"  {label:{_LABEL}}{bound}   {found.bound} is not decided within the tolerance,",
        f"  {'':{_LABEL}}{found.bound} = {formula}",
    ]


def _properties(analysis: Analysis, paint: Paint) -> list[str]:
    names = [colour.name for colour in analysis.tableau.colours]
    near = (
        "" if analysis.tolerance is None else f" within {decimal(analysis.tolerance)}"
    )
    lines = [
        f"  {'consistent':{_LABEL}}{_consistent(analysis.inconsistent, names, 'A', near, paint)}"
    ]
    if analysis.conjugate is not None:
        text = _consistent(analysis.conjugate_inconsistent, names, "Â", near, paint)
        lines.append(f"  {'conjugate nodes':{_LABEL}}{text}")
    own = (
        "its own conjugate"
        if not analysis.tableau.is_partitioned
        else "each part the conjugate of the other"
    )
    lines.append(
        f"  {'symplectic':{_LABEL}}{f'yes{near}, {own}' if analysis.symplectic else 'no'}"
    )
    return lines


def _consistent(
    wrong: Sequence[tuple[int, int]],
    names: Sequence[str],
    letter: str,
    near: str,
    paint: Paint,
) -> str:
    if not wrong:
        return (
            f"{paint('good', 'yes' + near)}, {letter}{{l,m}}𝟙 = c{{l}} for every block"
        )
    blocks = ", ".join(f"{letter}{{{names[l]},{names[m]}}}𝟙" for l, m in wrong[:4])
    more = f" and {len(wrong) - 4} more" if len(wrong) > 4 else ""
    return (
        f"{paint('bad', 'no')}: {blocks}{more} differ{'s' * (len(wrong) == 1)} from c"
    )


def _missing(outcome: Outcome, paint: Paint) -> list[str]:
    """The line on a file that has to make a claim and makes none."""
    if not (outcome.needs_claims and outcome.makes_no_claim):
        return []
    return [f"  {paint('bad', 'NO CLAIM')}         write what holds under expect"]


def _claim(outcome: Outcome, claim: Claim, paint: Paint) -> str:
    if claim.holds:
        return f"  {paint('good', 'claim holds')}      {claim.claim}: {claim.expected}"
    place = f"{printable(outcome.file)}:{claim.line}:{claim.column}"
    return (
        f"  {paint('bad', 'CLAIM FAILS')}      {claim.claim}: expected {claim.expected}, found {claim.found}"
        f"  ({place})"
    )
