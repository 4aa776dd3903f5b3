"""``gark check`` for people: one file in full, several a line each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from garkcli.check.findings import hints, warnings
from garkcli.check.outcome import Outcome
from garkcli.errors import counted
from garkcli.page.look import Look
from garkcli.page.safety import inert
from garkcli.report.check import claim_rows
from garkcli.report.checked import REPORT
from garkcli.report.remarks import lines as lines_of
from garkcli.report.remarks import remark_rows
from garkcli.tell.dialect import Plain
from garkcli.tell.facts import Level
from garkcli.tell.outputs import cell, one
from garkcli.tell.report import dialect_of

SHORT = {
    "order": "order",
    "embedded_order": "embedded",
    "pair_order": "symplectic pair",
    "w_order": "W",
}
"""The orders in the line of a file among others; that of the pair if it is claimed."""


def render(
    outcomes: Sequence[Outcome],
    look: Look,
    verbosity: int = 0,
    digits: int | None = None,
    width: int = 80,
) -> str:
    """Verbosity −1 has faults and failed claims, 0 one file in full, 1 everything of all."""
    is_full = verbosity > 0 or (verbosity == 0 and len(outcomes) == 1)
    level = Level.DETAIL if verbosity > 0 else Level.USUAL
    blocks = []
    for outcome in outcomes:
        d = REPORT.dialect(outcome, "text", look, verbosity <= 0, width=width, places=digits)
        if not outcome.is_read:
            lines = lines_of(outcome.faults, outcome.file, outcome.text, d)
        elif is_full:
            lines = one(REPORT.form(outcome), outcome, d, level)
        else:
            lines = _short(outcome, d, is_quiet=verbosity < 0)
        if text := "\n".join(lines):
            blocks.append(text)
    text = ("\n\n" if is_full else "\n").join(blocks)
    if len(outcomes) > 1 and verbosity >= 0:
        text += f"\n\n{_summary(outcomes, dialect_of(look=look)(look=look))}"
    return f"{inert(text)}\n" if text else ""


def _short(outcome: Outcome, d: Plain, is_quiet: bool) -> Iterator[str]:
    if not (is_quiet and outcome.ok):
        claims_pair = any(claim.claim == "pair-order" for claim in outcome.claims)
        names = {key: name for key, name in SHORT.items() if key != "pair_order" or claims_pair}
        facts = REPORT.form(outcome).named(outcome, names)
        said = [
            f"{name} {cell(facts[key], d)}"
            for key, name in names.items()
            if key in facts and facts[key].value is not None
        ]
        not_ok = d.note("open") if outcome.is_open else d.bad("FAIL")
        mark = d.good("ok  ") if outcome.ok else not_ok
        claims = counted(len(outcome.claims), "claim")
        text = f"{mark} {d.prose(outcome.file)}: {', '.join(said)}  ({claims})"
        yield from d.message(text, hanging=5)
    if is_quiet and outcome.ok:
        return
    told = [row for row in claim_rows(outcome, d) if "hold" not in row[0]]
    asides = [*([] if is_quiet else warnings(outcome)), *hints(outcome)]
    yield from d.rows([*told, *remark_rows(asides, d)])


def _summary(outcomes: Sequence[Outcome], d: Plain) -> str:
    left_open = sum(outcome.is_open for outcome in outcomes)
    failed = sum(not outcome.ok for outcome in outcomes) - left_open
    claims = sum(len(outcome.claims) for outcome in outcomes)
    words = [f"{counted(failed, 'file')} failed"] if failed else []
    words += [f"{counted(left_open, 'file')} undecided"] if left_open else []
    verdict = d.bad(", ".join(words)) if words else d.good("all hold")
    text = f"{len(outcomes)} files, {counted(claims, 'claim')}: {verdict}"
    silent = sum(outcome.makes_no_claim for outcome in outcomes)
    return f"{text}; {no_claims(silent)}" if silent else text


def no_claims(files: int) -> str:
    """``2 files make no claim``."""
    return f"{counted(files, 'file')} {'makes' if files == 1 else 'make'} no claim"
