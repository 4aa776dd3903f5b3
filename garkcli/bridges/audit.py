"""The audit of tables: orders, nodes, weights and flags compared with the declared ones."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import TypeAlias

from flint import fmpq

from garkcli.bridges.constants import tables_with_constants
from garkcli.bridges.elsewhere import declared_orders, with_bases, with_declared
from garkcli.bridges.estimates import with_orders
from garkcli.bridges.finding import EXPLAINED
from garkcli.bridges.judging import Judged, at_least
from garkcli.bridges.limited import judged_within_limits
from garkcli.bridges.plausible import is_plausible, speaks
from garkcli.bridges.readers.registry import demand_grammars
from garkcli.bridges.subject import HIGH, TableSubject, read
from garkcli.check.findings import repair_text, total_text, witness_text
from garkcli.errors import MethodFileError, Remark, Severity, counted
from garkcli.exact.display import decimal
from garkcli.exact.field import ZERO
from garkcli.exact.matrix import Vector, dot
from garkcli.frozen import Frozen, replace
from garkcli.methodfile.build import MethodFile
from garkcli.methodfile.folders import no_one
from garkcli.methodfile.printed import SLACK
from garkcli.order.repair import Repair
from garkcli.order.tolerance import within
from garkcli.sources.finder import UNRECOGNISED
from garkcli.sources.found import FoundTable
from garkcli.tableau.embedded import with_weights
from garkcli.tableau.tableau import Tableau

ONE = at_least(1)
ROW_SUMS = {"stage-order": at_least(1)}
"""The claim of files whose nodes are row sums."""
LINKED, ENOUGH = 12, 10
"""Bits of evidence that link matrix and weights, from which another reading of the same numbers is
wrong; the second number if it only has order 1 and no order is declared.
"""
SURE = 60
"""Bits of evidence from which a reading counts with any order if none is declared."""
FEWEST_ROWS = 3
"""Most rows of several entries that do not show one wrong node among the others."""
MAX_BLAMED = 12


class Audited(Frozen, eq=False):
    """One table with its orders and findings.

    Attributes:
        table: as found in the source.
        method: its method; None if it has none.
        order: of the method.
        embedded_order: of the embedded weights; None without them.
        nonautonomous_order: for f(t, y); None if not applicable.
        findings: remarks on the table.
    """

    table: FoundTable
    method: MethodFile | None = None
    order: Judged | None = None
    embedded_order: Judged | None = None
    nonautonomous_order: Judged | None = None
    findings: tuple[Remark, ...] = ()

    @property
    def is_read(self) -> bool:
        """Whether there is a method to judge."""
        return self.method is not None

    @property
    def looks_like(self) -> bool:
        """Whether it may be a table, but is neither judged nor wrong in itself."""
        return not (self.is_read or self.has_errors or self.table.kind)

    @property
    def has_errors(self) -> bool:
        """Whether a finding is an error."""
        return any(x.level == "error" for x in self.findings)

    def __repr__(self) -> str:
        name = self.table.name or f"line {self.table.line}"
        findings = counted(len(self.findings), "finding")
        return f"<Audited {name} of {self.table.source}: {findings}>"


def audited(
    paths: Iterable[str], jobs: int = 1, told: Callable[[str], None] = no_one
) -> Iterator[Audited]:
    """Yields tables; ``told`` gets why arrays are left out. Raises UsageProblem."""
    sources = list(paths)
    demand_grammars(sources)
    work = partial(_tables, orders=declared_orders(sources), others=sources)
    for each in judged_within_limits(sources, work, audit, _late, jobs):
        if each is None:
            continue
        if each.table.is_unlike:
            told(f"{each.table.source}:{each.table.line}: {each.table.trouble}")
        else:
            yield each


def _tables(
    text: str, source: str, orders: Mapping[str, int], others: Sequence[str]
) -> list[FoundTable]:
    tables = with_bases(tables_with_constants(text, source, others), source, others)
    return list(with_declared(tables, text, orders))


def _late(table: FoundTable, seconds: str) -> Audited:
    return _noted(table, f"read, not judged: judging took {seconds}", "unjudged")


def audit(table: FoundTable) -> Audited | None:
    """Returns the table with its findings; None if it is no method. If another reading of it is a
    method, no finding is an error.
    """
    verdict = _audit(table)
    order = 0 if verdict is None or verdict.order is None else verdict.order.order
    is_low = order < 2 and not table.order
    # errors in assembled or recognised tables are doubtful
    is_doubt = table.is_assembled or table.is_recognised
    wrong = {"error", "warning"} if is_doubt else {"error"}
    is_wrong = verdict is not None and any(
        x.level in wrong and x.code != "order-higher" for x in verdict.findings
    )
    if verdict is None or not verdict.is_read or is_wrong or is_low:
        least = (ENOUGH if is_low else LINKED) if order else 0
        for reading in readings_of(table):
            other = _audit(reading)
            if other is None or not fits(other, table):
                continue
            turned = verdict is not None and _is_turned(verdict, other)
            # no single misprint makes all columns fit the nodes
            if reading.linked >= least or (turned and reading.c[0] is not None):
                return (
                    _transposed(verdict, other) if verdict and turned and table.is_sure else other
                )
    return verdict


def _is_turned(found: Audited, other: Audited) -> bool:
    if found.method is None or other.method is None:
        return False
    before, after = found.method.tableau, other.method.tableau
    block, turned = before.block(0, 0), after.block(0, 0)
    if block is None or turned is None or before.colours[0].b != after.colours[0].b:
        return False
    are_alike = None in found.table.c or before.colours[0].c == after.colours[0].c
    return are_alike and turned != block and turned == tuple(zip(*block, strict=True))


def _transposed(found: Audited, other: Audited) -> Audited:
    """A caller of a library must store the matrix as the library reads it."""
    assert other.order is not None
    order = other.order.order
    message = f"with the matrix transposed the order is {order}"
    finding = Remark(message, code="transposed", claims={"order": str(order)})
    others = (x for x in other.findings if x.code != "stored")
    return replace(found, findings=(finding, *others))


def settled(table: FoundTable) -> FoundTable:
    verdict = audit(table) if table.rivals else None
    return table if verdict is None else verdict.table


def fits(found: Audited, told: FoundTable) -> bool:
    if found.order is None or found.has_errors:
        return False
    if not told.order and found.table.linked >= SURE:
        return True
    return found.order.is_limited or found.order.order >= (told.order or 2)


def readings_of(table: FoundTable) -> Iterator[FoundTable]:
    """Other methods of the same numbers; kicks and drifts also for second-order equations."""
    if [[x is None for x in row] for row in table.A] == [[True, False], [False, True]]:
        yield replace(
            table, parts=("q", "p"), structure="nystrom", how="for q'' = f(q)", linked=LINKED
        )
    if table.is_recognised and table.embedded and table.order and not table.turned:
        # the order may be declared for the other weights
        yield replace(table, b=table.embedded, embedded=table.b, linked=LINKED)
    for each in table.rivals:
        names_and_orders = {
            x: getattr(table, x) for x in ("name", "line", "order", "said_order", "notes")
        }
        yield replace(each, **names_and_orders, is_sure=True, is_recognised=False)


def _audit(table: FoundTable) -> Audited | None:
    if table.kind:
        message = f"a {table.kind} table, which is not judged as one of Runge–Kutta"
        return _noted(table, message, "other-kind")
    if table.is_misshapen:
        return Audited(table, findings=(Remark(table.trouble, code="shape"),))
    if table.trouble:
        return _noted(table, table.trouble, level="warning" if table.is_source else "note")
    if table.form is not None:
        return _of_export(table)
    if table.gamma is not None or table.is_multirate:
        return _of_rosenbrock(table)
    try:
        method = read(table)
    except MethodFileError as error:
        return _noted(table, error.faults[0].message)
    if not is_plausible(table, method):
        is_like_table = table.is_assembled or speaks(table)
        return _noted(table, UNRECOGNISED) if is_like_table else None
    subject = subject_of(table, method)
    if is_unrecognised(subject):
        return _noted(subject.table, UNRECOGNISED)
    return Audited(
        subject.table,
        subject.method,
        subject.order,
        subject.embedded_order,
        subject.nonautonomous,
        findings_of(subject),
    )


def subject_of(table: FoundTable, method: MethodFile) -> TableSubject:
    is_high = not table.order or table.order >= HIGH
    return with_orders(table, method, HIGH if is_high else None)


def _of_export(table: FoundTable) -> Audited:
    from garkcli.bridges.exported import judged_export  # few sources have them

    try:
        judged = judged_export(table)
    except MethodFileError as error:
        return _noted(table, error.faults[0].message)
    return Audited(table, judged.method, judged.order, judged.embedded_order, None, judged.findings)


def _of_rosenbrock(table: FoundTable) -> Audited:
    from garkcli.bridges.rosenbrock import row_findings, with_row_orders  # few sources have them

    try:
        judged = with_row_orders(table)
    except MethodFileError as error:
        return _noted(table, error.faults[0].message)
    orders = (judged.order, judged.embedded_order, judged.timed)
    findings = tuple(row_findings(judged))
    if not table.is_sure and not any(x.help for x in findings if x.code == "order"):
        # names alone, and no number is known that makes it a method
        return _noted(judged.table, UNRECOGNISED)
    return Audited(judged.table, judged.method, *orders, findings)


def findings_of(subject: TableSubject) -> tuple[Remark, ...]:
    return tuple(_weighed(x, subject) for check in CHECKS for x in check(subject))


def is_unrecognised(subject: TableSubject) -> bool:
    """Whether an assembled table has too low an order, or several rows that miss their nodes."""
    is_far_off = subject.order.order < 2 and not subject.is_slightly_off
    return subject.table.is_assembled and (is_far_off or len(subject.wrong_rows) > 1)


def _noted(
    table: FoundTable, message: str, code: str = "unread", level: Severity = "note"
) -> Audited:
    return Audited(table, findings=(Remark(message, code=code, level=level),))


def _weighed(finding: Remark, subject: TableSubject) -> Remark:
    """A doubt if no repair mends an assembled table, a note if careless rounding explains it."""
    if finding.level != "error":
        return finding
    if _is_explained(finding.code, subject):
        code = "nodes" if finding.code == "nodes" else "open"
        return Remark(f"{finding.message}: {EXPLAINED}", code=code, level="note")
    doubts = {
        "the table is put together from single numbers": subject.table.is_assembled,
        "constants in it are of other sources": subject.table.borrows,
    }
    doubt = next((why for why, is_so in doubts.items() if is_so), "")
    if doubt:
        message = f"{finding.message}; in doubt, as {doubt}"
        return replace(finding, message=message, level="warning")
    if subject.table.is_recognised and not _is_mended(finding, subject):
        return replace(finding, level="warning")
    return finding


def _is_mended(finding: Remark, subject: TableSubject) -> bool:
    if finding.code != "nodes":
        return bool(finding.help)
    return is_one_row(subject)


def is_one_row(subject: TableSubject) -> bool:
    """Whether all rows but one sum to their nodes, and no first stage is late, as in methods of
    Oliver.
    """
    colour = subject.tableau.colours[0]
    several = sum(sum(map(bool, row)) > 1 for row in subject.block)
    is_early = any(c and not any(row) for row, c in zip(subject.block, colour.c, strict=False))
    if len(subject.misprinted_rows) != 1 or several <= FEWEST_ROWS or is_early:
        return False
    tolerance = (len(colour.b) + 1) * subject.rounded.tolerance
    moments = (sum(colour.b, ZERO) - 1, dot(colour.b, colour.c) - fmpq(1, 2))
    return all(within(x, tolerance) for x in moments)


def _is_explained(code: str, subject: TableSubject) -> bool:
    """Whether rounding by many units in the last digits explains a violation."""
    if code == "order":
        return not subject.misses_order
    if code == "nodes":
        return not subject.misprinted_rows
    if code == "weights":
        return subject.is_careless(subject.tableau, 1)
    if code not in {"embedded-order", "embedded-weights"}:
        return False
    embedded = with_weights(subject.tableau, subject.method.embedded or ())
    wanted = subject.table.embedded_order if code == "embedded-order" else None
    return subject.is_careless(embedded, wanted or 1)


def _order(subject: TableSubject) -> Iterator[Remark]:
    declared = subject.table.order
    finding = _declared_remark(subject.order, declared, "order", subject.tableau)
    if finding is None or declared is None:
        return
    if finding.level != "error":
        yield finding
    else:
        yield replace(finding, help=_culprit(subject, declared))


def _declared_remark(
    found: Judged | None, declared: int | None, what: str, tableau: Tableau
) -> Remark | None:
    """The remark on a declared order; None if it is true or undecided."""
    if found is None or declared is None or found.is_limited or found.order == declared:
        return None
    code, message = what.replace(" ", "-"), f"{what} {found.order}, declared {declared}"
    if found.order > declared:
        return Remark(message, code=f"{code}-higher", level="warning")
    if not found.is_open:
        claims = {code: str(declared)}
        return Remark(message + _witness(found, tableau), code=code, claims=claims)
    proved = f"{what} {declared} is declared, {found.order} is proved"
    why = f"rounding may be why the conditions of {found.order + 1} fail"
    return Remark(f"{proved}: {why}", code="open", level="note")


def _said(subject: TableSubject) -> Iterator[Remark]:
    """Compares the order with that in comments, which may be about something else."""
    declared, found = subject.table.said_order or 0, subject.order
    is_known = not (subject.table.order or found.is_limited or found.is_open)
    if not is_known or not found.order < declared <= HIGH:
        return
    if not subject.is_careless(subject.tableau, declared):
        message = f"order {found.order}, a comment or docstring says {declared}"
        yield Remark(message + _witness(found, subject.tableau), code="order", level="warning")


def _witness(found: Judged, tableau: Tableau) -> str:
    if found.witness is None:
        return ""
    return f"; {witness_text(found.witness, tableau.size > 1)}"


def _culprit(subject: TableSubject, declared: int) -> str:
    row = subject.wrong_rows[0] if len(subject.wrong_rows) == 1 else ""
    return "; ".join(filter(None, [row, _entry(subject, declared)]))


def _entry(
    subject: TableSubject, declared: int | None, embedded: tuple[Vector, ...] | None = None
) -> str:
    tableau, what = subject.tableau, "order"
    found: Judged | None = subject.order
    if embedded is not None:
        tableau, what = with_weights(tableau, embedded), "embedded order"
        found = subject.embedded_order
    repairs, order, _ = repairs_of(subject, tableau, found, declared, embedded is not None)
    if len(repairs) != 1:
        return ""
    repair = repair_text(repairs[0], [colour.name for colour in tableau.colours])
    return f"{what} {order} would hold with {repair}"


def repairs_of(
    subject: TableSubject,
    tableau: Tableau,
    found: Judged | None,
    declared: int | None,
    is_embedded: bool = False,
) -> tuple[Sequence[Repair], int, bool]:
    """The entries that restore the declared order, else several orders; that order; is it exact."""
    stages = sum(space.stages for space in tableau.spaces)
    if found is None or found.witness is None or stages > MAX_BLAMED:
        return (), 0, False
    if declared and found.order >= declared:
        return (), 0, False
    from garkcli.order.blame import MissedOrder, blame_of, slip_of
    from garkcli.order.deciding import order_of

    rounded = subject.digits.of(tableau, slack=100 * SLACK)
    for method in (tableau, rounded) if rounded.tolerance else (tableau,):
        missed = MissedOrder(found.witness.tree.order, declared or 0, is_embedded=is_embedded)
        blame = blame_of(method, missed) if declared else slip_of(method, missed, order_of(method))
        if blame is not None and blame.repairs:
            return blame.repairs, declared or blame.restored or 0, method is tableau
    return (), 0, False


def _embedded(subject: TableSubject) -> Iterator[Remark]:
    found, embedded = subject.embedded_order, subject.method.embedded
    if found is None or embedded is None:
        return
    declared = subject.table.embedded_order
    # the matrix is to blame, as reported with the order; or the source declares the order of the
    # estimate, the lower one of both
    is_known = subject.misses_order and 0 < found.order < (declared or 0)
    is_known = is_known or declared == subject.order.order < found.order
    if not found.order and not found.is_open:
        total = " and ".join(str(total_text(sum(b, ZERO))) for b in embedded)
        claims = {"embedded-order": ONE if declared is None else str(declared)}
        message = f"the embedded weights have the sum {total}"
        entry = _entry(subject, declared, embedded)
        yield Remark(message, entry, code="embedded-weights", claims=claims)
    elif not is_known:
        tableau = with_weights(subject.tableau, embedded)
        finding = _declared_remark(found, declared, "embedded order", tableau)
        yield from [] if finding is None else [finding]


def _sign(subject: TableSubject) -> Iterator[Remark]:
    if subject.is_sign_open:
        yield Remark(subject.sign, code="sign", level="note")


def _weights(subject: TableSubject) -> Iterator[Remark]:
    found = subject.order
    if not (found.order or found.is_open) and subject.table.order is None:
        sums = (sum(colour.b, ZERO) for colour in subject.tableau.colours)
        message = f"the weights have the sum {' and '.join(str(total_text(x)) for x in sums)}"
        yield Remark(message, code="weights", claims={"order": ONE}, help=_entry(subject, None))


def _nodes(subject: TableSubject) -> Iterator[Remark]:
    """Nodes that are not row sums, as far as they cost an order."""
    rows, declared = subject.wrong_rows, subject.table.order
    if subject.misses_order or all(x is None for x in subject.table.c):
        return
    if not rows:
        careless = subject.careless_rows
        if careless:
            yield Remark(f"{_listed(careless)}: {EXPLAINED}", code="nodes", level="note")
        return
    timed = subject.nonautonomous
    wanted = subject.order.order if declared is None else declared
    loses = timed is not None and timed.order < min(wanted, subject.order.order)
    if loses and timed is not None:
        message = f"order {timed.order} where f depends on t, and else {wanted}: {_listed(rows)}"
        claims = {"nonautonomous-order": at_least(min(wanted, subject.order.order))}
        yield Remark(message, code="nodes", claims=claims)
    elif declared is None or subject.is_misprinted or is_one_row(subject):
        is_of_weights = not subject.order.order
        entry = "" if declared or len(rows) > 1 or is_of_weights else _entry(subject, None)
        yield Remark(_listed(rows), code="nodes", claims=ROW_SUMS, help=entry)
    else:
        yield Remark(_listed(rows), code="nodes", level="note")


def _listed(rows: Sequence[str]) -> str:
    text = "; ".join(rows[:3])
    return f"{text}; and {len(rows) - 3} more" if len(rows) > 3 else text


def _flags(subject: TableSubject) -> Iterator[Remark]:
    if not subject.table.flags.get("fsal") or not subject.block:
        return
    tolerance = 2 * subject.rounded.tolerance
    pairs = zip(subject.block[-1], subject.tableau.colours[0].b, strict=True)
    if not all(within(x - y, tolerance) for x, y in pairs):
        message = "declared first same as last, and the last row is not b"
        yield Remark(message, code="fsal", claims={"fsal": "true"})


def _rounded(subject: TableSubject) -> Iterator[Remark]:
    found, tolerance = subject.order, subject.order.tolerance
    if subject.digits.short and tolerance:
        places = len(str(max(x.q for x in subject.digits.short.values()))) - 1
        message = f"the coefficients look rounded to {places} decimal places: "
        message += f"order {found.order} holds within {decimal(tolerance)}"
        yield Remark(message, code="rounded", level="note")


def _stored(subject: TableSubject) -> Iterator[Remark]:
    if subject.table.how:
        yield Remark(f"as its numbers say: {subject.table.how}", code="stored", level="note")
    for name in subject.table.idle:
        message = f"{name} has the name of nodes or weights, and fits no row of them"
        yield Remark(message, code="idle", level="warning")


def _unread(subject: TableSubject) -> Iterator[Remark]:
    lost = (x for x in subject.table.notes if " not read: " in x)
    yield from (Remark(x, code="unread", level="note") for x in lost)


_Check: TypeAlias = Callable[[TableSubject], Iterator[Remark]]
CHECKS: tuple[_Check, ...] = (
    *(_order, _said, _weights, _nodes, _embedded, _rounded, _sign, _flags, _stored, _unread),
)
