"""``gark check`` for people."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from flint import fmpq

from garkcli.check.analysis import Analysis
from garkcli.check.findings import CLAIM
from garkcli.check.outcome import Claim, Outcome
from garkcli.errors import excerpt
from garkcli.exact.display import decimal
from garkcli.glossary.faults import code_of
from garkcli.page.paint import Paint, counted, folded, indented
from garkcli.page.plain import inert, printable
from garkcli.report.check_conditions import labelled, simplifying_lines, structure_lines
from garkcli.report.check_orders import LABEL, Shown, order_lines, order_number, suggestion_lines
from garkcli.tableau.tableau import Tableau

if TYPE_CHECKING:
    from garkcli.check.every_value import EveryValue

_WIDTH = 80


def render(
    outcomes: Sequence[Outcome], paint: Paint, verbosity: int = 0, digits: int | None = None
) -> str:
    """The report on some files.

    Args:
        outcomes: what was found.
        paint: colour or none.
        verbosity: −1 shows faults and failed claims only; 0 one file in full, several a line each;
            1 all in full.
        digits: significant digits of values and residuals; None for exact numbers.
    """
    has_several = len(outcomes) > 1
    full = verbosity > 0 or (verbosity == 0 and not has_several)
    quiet = verbosity < 0
    blocks = []
    for outcome in outcomes:
        block = _outcome(outcome, paint, full, quiet, digits)
        if block:
            blocks.append(block)
    between = "\n\n" if full else "\n"
    text = between.join(blocks)
    if has_several and not quiet:
        summary = _summary(outcomes, paint)
        text += f"\n\n{summary}"
    if not text:
        return ""
    return inert(text) + "\n"


def _outcome(outcome: Outcome, paint: Paint, full: bool, quiet: bool, digits: int | None) -> str:
    if outcome.every is not None:
        lines = _every(outcome, outcome.every, paint, full, quiet)
        return "\n".join(lines)
    analysis = outcome.analysis
    if analysis is None:
        return faults_text(outcome, paint)
    if full:
        return "\n".join(_full(outcome, analysis, paint, digits))
    lines = []
    if not (quiet and outcome.ok):
        lines.append(_line(outcome, analysis, paint))
    failed = outcome.failed_claims
    lines += [_claim(outcome, claim, paint) for claim in failed]
    lines += _missing(outcome, paint)
    if outcome.blame is not None:
        from garkcli.report.hints import blame_lines

        lines += blame_lines(outcome.blame, analysis.tableau, paint)
    return "\n".join(lines)


def _every(outcome: Outcome, found: EveryValue, paint: Paint, full: bool, quiet: bool) -> list[str]:
    """A file with free parameters."""
    from garkcli.report.every_text import every_line, every_lines

    claims = [_claim(outcome, claim, paint) for claim in outcome.claims]
    if not full:
        lines = []
        if not (quiet and outcome.ok):
            lines.append(every_line(outcome, found, paint))
        lines += [_claim(outcome, x, paint) for x in outcome.failed_claims]
        return lines + _missing(outcome, paint)
    lines = [paint("strong", line) for line in _title(outcome)]
    lines += every_lines(outcome, found, paint)
    lines += _left_behind(outcome)
    missing = _missing(outcome, paint)
    for block in (missing, claims):
        if block:
            lines += ["", *block]
    return lines


def _summary(outcomes: Sequence[Outcome], paint: Paint) -> str:
    failed = sum(not outcome.ok for outcome in outcomes)
    claims = sum(len(outcome.claims) for outcome in outcomes)
    looked_at = f"{len(outcomes)} files, {counted(claims, 'claim')}"
    failures = f"{counted(failed, 'file')} failed"
    verdict = paint.verdict(not failed, "all hold", failures)
    text = f"{looked_at}: {verdict}"
    silent = sum(outcome.makes_no_claim for outcome in outcomes)
    if silent:
        text += f"; {no_claims(silent)}"
    return text


def no_claims(files: int) -> str:
    """How many files make no claim."""
    verb = "makes" if files == 1 else "make"
    return f"{counted(files, 'file')} {verb} no claim"


def faults_text(outcome: Outcome, paint: Paint) -> str:
    """Every fault of a file that cannot be read, with a caret under the text."""
    source = outcome.text.splitlines()
    file = printable(outcome.file)
    error = paint("bad", "error")
    caret = paint("bad", "^")
    cure = paint("note", "help")
    lines: list[str] = []
    for fault in outcome.faults:
        place = file
        if fault.line:
            place += f":{fault.line}:{fault.column}"
        message = printable(fault.message)
        kind = f"{error}[{code_of(fault.message)}]"
        lines.append(f"{place}: {kind}: {message}")
        if 0 < fault.line <= len(source):
            shown = source[fault.line - 1]
            lines += excerpt(shown, fault.line, fault.column, caret)
        if fault.help:
            advice = printable(fault.help)
            lines.append(f"      {cure}: {advice}")
    return "\n".join(lines)


def _line(outcome: Outcome, analysis: Analysis, paint: Paint) -> str:
    mark = paint.verdict(outcome.ok, "ok  ", "FAIL")
    file = printable(outcome.file)
    number = order_number(analysis.order)
    found = f"order {number}"
    if analysis.embedded is not None:
        number = order_number(analysis.embedded.order)
        found += f", embedded {number}"
    pair_order = analysis.pair_order
    if pair_order is not None and not analysis.tableau.is_partitioned:
        number = order_number(pair_order)
        found += f", pair {number}"
    claims = counted(len(outcome.claims), "claim")
    return f"{mark} {file}: {found}  ({claims})"


def _wrapped(text: str, width: int = 78) -> list[str]:
    if len(text) <= width:
        return [text]
    from textwrap import wrap  # slow to import, and most texts fit

    return wrap(text, width)


def _title(outcome: Outcome) -> list[str]:
    """The file and the name of the method: below each other where they are long."""
    file = printable(outcome.file)
    name = printable(outcome.name)
    if outcome.name == outcome.file:
        return [file]
    title = f"{file}: {name}"
    if len(title) <= _WIDTH:
        return [title]
    return [f"{file}:", f"  {name}"]


def _full(outcome: Outcome, analysis: Analysis, paint: Paint, digits: int | None) -> list[str]:
    tableau = analysis.tableau
    kind = kind_text(tableau, outcome.structure, analysis.tolerance)
    lines = [paint("strong", line) for line in _title(outcome)]
    lines += indented(_wrapped(kind))
    lines.append("")
    shown = Shown(digits)
    lines += order_lines(analysis, paint, shown)
    if analysis.embedded is not None or analysis.dense is not None:
        from garkcli.report.check_further import further_lines

        lines += further_lines(analysis, paint, shown)
    lines += _left_behind(outcome)
    if analysis.suggestion is not None:
        lines += suggestion_lines(analysis.suggestion, analysis.tolerance, paint)
    if analysis.misprint is not None:
        from garkcli.report.hints import misprint_lines

        lines += misprint_lines(analysis.misprint, tableau, paint)
    lines += ["", *simplifying_lines(analysis)]
    lines += ["", *structure_lines(analysis, paint)]
    lines += ["", *_more_properties(outcome, analysis)]
    if outcome.constants is not None:
        from garkcli.report.hints import constants_lines

        lines += ["", *constants_lines(outcome.constants, tableau.size > 1)]
    missing = _missing(outcome, paint)
    if missing:
        lines += ["", *missing]
    if outcome.claims:
        lines.append("")
    for claim in outcome.claims:
        lines.append(_claim(outcome, claim, paint))
    if outcome.blame is not None:
        from garkcli.report.hints import blame_lines

        lines += ["", *blame_lines(outcome.blame, tableau, paint)]
    return lines


def _left_behind(outcome: Outcome) -> list[str]:
    """That a construction is without the further weights of what it is made from."""
    if not outcome.left_behind:
        return []
    what = " and ".join(outcome.left_behind)
    return [f"      the {what} of its parts are left behind"]


def kind_text(tableau: Tableau, structure: str, tolerance: fmpq | None) -> str:
    """What is judged, and in which arithmetic."""
    colours = counted(tableau.size, "colour")
    stages = ", ".join(_stage_counts(tableau))
    text = f"{colours}, stages {stages}"
    if structure != "general":
        text = f"for {structure} problems; {text}"
    how = _domain(tableau)
    if tolerance is not None:
        how = f"within {decimal(tolerance)}"
    return f"{text}; {how}"


def _stage_counts(tableau: Tableau) -> list[str]:
    """The numbers of stages: of each colour, or of positions and of momenta."""
    if not tableau.is_partitioned:
        spaces = map(tableau.space, range(tableau.size))
        return [str(space.stages) for space in spaces]
    counts = []
    for part in ("q", "p"):
        stages = map(str, tableau.stages_of(part))
        total = " + ".join(stages)
        counts.append(f"{part}: {total}")
    return counts


def _domain(tableau: Tableau) -> str:
    if tableau.degree == 1:
        return "decided in rational arithmetic"
    return f"decided in a number field of degree {tableau.degree}"


def _more_properties(outcome: Outcome, analysis: Analysis) -> list[str]:
    """What the method is like: what is worth a word, or everything where that was asked for."""
    from garkcli.report.check_properties import every_property_lines, property_lines

    if outcome.wants_properties:
        return every_property_lines(analysis.subject)
    lines = []
    room = _WIDTH - 2 - LABEL
    has_further = analysis.embedded is not None or analysis.dense is not None
    for label, text in property_lines(analysis.subject, has_further):
        shown = folded(text, room, "")
        lines += labelled(label, shown)
    return lines


def _missing(outcome: Outcome, paint: Paint) -> list[str]:
    """The lines on a file that does not claim what it has to."""
    if not outcome.lacks:
        return []
    messages = [CLAIM]
    if not outcome.makes_no_claim:
        messages = [*outcome.lacks, CLAIM]
    verdict = paint("bad", "NO CLAIM")
    return [f"  {verdict}         {message}" for message in messages]


def _claim(outcome: Outcome, claim: Claim, paint: Paint) -> str:
    if claim.holds:
        verdict = paint("good", "claim holds")
        return f"  {verdict}      {claim.claim}: {claim.expected}"
    file = printable(outcome.file)
    place = f"({file}:{claim.line}:{claim.column})"
    said = f"{claim.claim}: expected {claim.expected}, found {claim.found}"
    margin = 2 + LABEL
    left = _WIDTH - margin
    told = [f"{said}  {place}"]
    if len(told[0]) > left:
        told = [*folded(said, left, ""), place]
    if claim.why:
        told += folded(claim.why, left, "")
    first, *rest = told
    verdict = paint("bad", "CLAIM FAILS")
    lines = [f"  {verdict}      {first}"]
    lines += indented(rest, " " * margin)
    return "\n".join(lines)
