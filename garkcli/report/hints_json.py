"""What the failing conditions tell, for machines: fields of ``gark check --format json``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from garkcli.exact.display import to_text
from garkcli.page.record import Field, Record, inside
from garkcli.page.schema import (
    COUNT,
    EXACT,
    FLAG,
    INTEGER,
    POSITION,
    SIZE,
    TEXT,
    Schema,
    array,
    nullable,
)
from garkcli.trees.notation import format_tree

if TYPE_CHECKING:
    from flint import arb

    from garkcli.check.analysis import Analysis
    from garkcli.check.outcome import Outcome
    from garkcli.exact.field import Number
    from garkcli.order.blame import Blame
    from garkcli.order.constants import ErrorConstants, Norms
    from garkcli.order.repairs import Repair
    from garkcli.order.suggestion import Misprint, Suggestion

BLOCK: Schema = {**array(POSITION), "minItems": 1, "maxItems": 2}
"""The colours of a block A^{l,m}, or the one of weights b^{l}."""
_BLOCKS: Schema = array(BLOCK)
_CLAIMS: Schema = {"enum": ["order", "conjugate-order", "pair-order", "embedded-order"]}


def blocks(found: Sequence[tuple[int, int]]) -> list[list[int]]:
    """Blocks (l, m) with colours counted from 1."""
    return [_block(l, m) for l, m in found]


def _block(*colours: int | None) -> list[int]:
    """The colours of a block, or the one of weights, counted from 1."""
    return [l + 1 for l in colours if l is not None]


def _is_of_weights(repair: Repair) -> bool:
    return repair.m is None or repair.i is None


def _weights(repair: Repair) -> list[int] | None:
    if not _is_of_weights(repair) or repair.is_embedded:
        return None
    return _block(repair.l, repair.m)


def _embedded(repair: Repair) -> list[int] | None:
    return _block(repair.l) if repair.is_embedded else None


def _matrix(repair: Repair) -> list[int] | None:
    if _is_of_weights(repair):
        return None
    return _block(repair.l, repair.m)


def _row(repair: Repair) -> int | None:
    if repair.i is None:
        return None
    return repair.i + 1


_REPAIR: Record[Repair] = Record(
    Field("b", BLOCK, _weights, is_optional=True),
    Field("embedded", BLOCK, _embedded, is_optional=True),
    Field("A", BLOCK, _matrix, is_optional=True),
    Field("row", nullable(INTEGER), _row),
    Field("entry", POSITION, lambda x: x.j + 1),
    Field("old", EXACT, lambda x: to_text(x.old)),
    Field("new", EXACT, lambda x: to_text(x.new)),
)


def _culprit(blame: Blame) -> list[int] | None:
    if blame.culprit is None:
        return None
    return _block(*blame.culprit)


def _in_every(blame: Blame) -> list[list[int]]:
    return blocks(blame.in_every)


def _in_none(blame: Blame) -> list[list[int]]:
    return blocks(blame.in_none)


def _upper(ball: arb) -> float:
    """A float that the number does not exceed, but for the rounding of the last digit."""
    bound = ball.upper()
    return float(bound)


_BLAME: Record[Blame] = Record(
    Field("of", _CLAIMS, lambda x: x.of),
    Field("order", POSITION, lambda x: x.order),
    Field("failing", COUNT, lambda x: x.failing),
    Field("conditions", COUNT, lambda x: x.total),
    Field("only_coupling", FLAG, lambda x: x.only_coupling),
    Field("culprit", nullable(BLOCK), _culprit),
    Field("in_every", _BLOCKS, _in_every),
    Field("in_none", _BLOCKS, _in_none),
    _REPAIR.every("repairs", lambda x: x.repairs),
    Field("restores", array(TEXT), lambda x: list(x.restores)),
)
_MISPRINT: Record[Misprint] = Record(
    Field("order", COUNT, lambda x: x.order),
    Field("residual", SIZE, lambda x: _upper(x.residual)),
    Field("explained", SIZE, lambda x: _upper(x.explained)),
    _REPAIR.every("repairs", lambda x: x.repairs),
)
_SUGGESTION: Record[Suggestion] = Record(
    Field("line", TEXT, lambda x: x.line),
    Field("order", COUNT, lambda x: x.order),
    Field("rounding", SIZE, lambda x: _upper(x.rounding)),
    Field("genuine", SIZE, lambda x: _upper(x.genuine)),
)


def _exact(number: Number | None) -> str | None:
    if number is None:
        return None
    return to_text(number)


def _worst(norms: Norms) -> str | None:
    if norms.worst is None:
        return None
    return format_tree(norms.worst)


_TEXT_OR_NULL = nullable(TEXT)
_NORMS: Record[Norms] = Record(
    Field("trees", COUNT, lambda x: x.trees),
    Field("two_norm_squared", _TEXT_OR_NULL, lambda x: _exact(x.two_squared)),
    Field("two_norm", SIZE, lambda x: x.two),
    Field("inf_norm", SIZE, lambda x: x.largest),
    Field("worst", _TEXT_OR_NULL, _worst),
    Field("worst_value", _TEXT_OR_NULL, lambda x: _exact(x.worst_value)),
)
CONSTANTS: Record[ErrorConstants] = Record(
    Field("order", POSITION, lambda x: x.order),
    Field("exact", FLAG, lambda x: x.is_exact),
    _NORMS.whole("all", lambda x: x.all),
    _NORMS.whole("coupling", lambda x: x.coupling),
)


def _analysis(outcome: Outcome) -> Analysis | None:
    return outcome.analysis


_OF_MISPRINT: Field[Analysis] = _MISPRINT.optional("misprint", lambda x: x.misprint)
_OF_SUGGESTION: Field[Analysis] = _SUGGESTION.optional("suggestion", lambda x: x.suggestion)
HINTS: tuple[Field[Outcome], ...] = (
    _BLAME.optional("blame", lambda x: x.blame),
    *inside(_analysis, [_OF_MISPRINT]),
    CONSTANTS.optional("error_constants", lambda x: x.constants),
    *inside(_analysis, [_OF_SUGGESTION]),
)
"""Each is left out where there is nothing to say."""
